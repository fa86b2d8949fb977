"""Points and pairs of points (paper A, eqs. 1 and 2)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, parts, read, stack, times, unit
from cga_runtime.elements.element import Element, carried, set_fields, vectors, within_reach
from cga_runtime.elements.through_points import pair_through, refuse


@dataclass(frozen=True, eq=False)
class Point(Element, kind="point"):
    """The point at `center`, (..., 3)."""

    center: Array
    blades = ("e0", "e1", "e2", "e3", "ei")

    def __init__(self, x: ArrayLike) -> None:
        center = within_reach(read(x, "point", 3), "point: it")
        set_fields(self, center.shape[:-1], center=center)

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.center.shape[:-1]

    @cached_property
    def coefficients(self) -> Array:
        """e0 + x + x^2/2 ei, (..., 5)."""
        return stack(1.0, *parts(self.center), 0.5 * dot(self.center, self.center))

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        return type(self)(carried(d, rotation, t, self.center))


@dataclass(frozen=True, eq=False)
class PointPair(Element, kind="point_pair"):
    """Two points in order: `points` (..., 2, 3)."""

    points: Array
    blades = ("e01", "e02", "e12", "e03", "e13", "e23", "e0i", "e1i", "e2i", "e3i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """First a, then b; the direction leads from a to b. Raises DegenerateError where they coincide."""
        return cls(np.stack(vectors(a, b), axis=-2))

    def __post_init__(self) -> None:
        points = read(self.points, "point pair", 2, 3)
        refuse(self.name, pair_through(points)[0])
        object.__setattr__(self, "points", points)

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.points.shape[:-2]

    @cached_property
    def center(self) -> Array:
        """Midpoint, (..., 3)."""
        return np.asarray(self.points.mean(axis=-2))

    @cached_property
    def direction(self) -> Array:
        """Unit vector from the first to the second point, (..., 3)."""
        return unit(self.points[..., 1, :] - self.points[..., 0, :], "point pair")

    @cached_property
    def radius(self) -> Array:
        """Half the distance of the points, (...)."""
        return 0.5 * norm(self.points[..., 1, :] - self.points[..., 0, :])

    @cached_property
    def coefficients(self) -> Array:
        """P1 ^ P2 / (2 r^2), (..., 10), as P1 ^ (P2 - P1): differences of large numbers would cost digits far from the origin."""
        a = self.points[..., 0, :]
        edge = self.points[..., 1, :] - a
        rise = dot(edge, self.center)
        d, m = parts(edge), parts(np.cross(a, edge))
        mixed = parts(times(rise, a) - times(0.5 * dot(a, a), edge))
        whole = stack(d[0], d[1], m[2], d[2], -m[1], m[0], rise, *mixed)
        return times(0.5 / self.radius**2, whole)

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        return type(self)(carried(d[..., None], rotation[..., None, :, :], t[..., None, :], self.points))
