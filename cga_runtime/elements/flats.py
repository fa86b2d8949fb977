"""Lines and planes: elements that pass through infinity (paper A, eq. 2 with ei as a factor)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, parts, read, stack, times, unit
from cga_runtime.elements.element import Element, carried, rotated, set_fields, vectors, within_reach
from cga_runtime.elements.through_points import pair_through, plane_through, refuse


@dataclass(frozen=True, eq=False)
class Line(Element, kind="line"):
    """The line through `center` along `direction`, both (..., 3): the centre becomes the foot of the origin, the direction unit."""

    center: Array
    direction: Array
    blades = ("e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """The line from a to b. Raises DegenerateError where they coincide."""
        first, second = vectors(a, b)
        faults, edge = pair_through(np.stack([first, second], axis=-2))
        refuse("line", faults)
        return cls(first, edge)

    @classmethod
    def from_point_direction(cls, point: ArrayLike, direction: ArrayLike) -> Self:
        """The line through a point along a direction of any length. Raises DegenerateError for a zero direction."""
        return cls(*vectors(point, direction))

    def __post_init__(self) -> None:
        x, d = vectors(self.center, self.direction)
        within_reach(x, "line: its point")
        n = unit(d, "line")
        set_fields(self, x.shape[:-1], center=x - times(dot(n, x), n), direction=n)

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.center.shape[:-1]

    @cached_property
    def coefficients(self) -> Array:
        """d1 e01i + d2 e02i + m3 e12i + d3 e03i - m2 e13i + m1 e23i with the moment m = x cross d, (..., 6)."""
        d, m = parts(self.direction), parts(np.cross(self.center, self.direction))
        return stack(d[0], d[1], m[2], d[2], -m[1], m[0])

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        return type(self)(carried(d, rotation, t, self.center), rotated(rotation, self.direction))


@dataclass(frozen=True, eq=False)
class Plane(Element, kind="plane"):
    """The points with n.x = offset: unit normal (..., 3), offset (...). A normal of another length is divided out of both."""

    normal: Array
    offset: Array
    blades = ("e012i", "e013i", "e023i", "e123i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The plane through three points, its normal by their right-hand rule. DegenerateError where they are collinear or coincide."""
        first, second, third = vectors(a, b, c)
        faults, normal = plane_through(np.stack([first, second, third], axis=-2))
        refuse("plane", faults)
        return cls.from_point_normal(first, normal)

    @classmethod
    def from_point_normal(cls, point: ArrayLike, normal: ArrayLike) -> Self:
        """The plane through a point, square to a normal of any length. Raises DegenerateError for a zero normal."""
        x, n = vectors(point, normal)
        n = unit(n, "plane")
        return cls(n, dot(n, within_reach(x, "plane: its point")))

    @classmethod
    def from_normal_offset(cls, normal: ArrayLike, offset: ArrayLike) -> Self:
        """The plane n.x = offset, n of any length. Raises DegenerateError for a zero normal."""
        return cls(read(normal, "normal of a plane", 3), read(offset, "offset of a plane"))

    def __post_init__(self) -> None:
        n, offset = read(self.normal, "normal of a plane", 3), read(self.offset, "offset of a plane")
        batch = one_batch("plane", n.shape[:-1], offset.shape)
        direction = unit(n, "plane")
        largest = np.abs(n).max(axis=-1)
        with np.errstate(over="ignore"):
            height = offset / largest / norm(n / largest[..., None])
        within_reach(height[..., None], "plane: its foot")
        set_fields(self, batch, normal=direction, offset=height)

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.offset.shape

    @cached_property
    def center(self) -> Array:
        """Foot of the origin, (..., 3)."""
        return times(self.offset, self.normal)

    @cached_property
    def coefficients(self) -> Array:
        """n3 e012i - n2 e013i + n1 e023i + offset e123i, (..., 4)."""
        x, y, z = parts(self.normal)
        return stack(z, -y, x, self.offset)

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        normal = rotated(rotation, self.normal)
        return type(self)(normal, d * self.offset + dot(normal, t))
