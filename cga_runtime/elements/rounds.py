"""Circles and spheres: elements with a centre and a radius (paper A, eq. 2)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, one_batch, parts, read, stack, times, unit
from cga_runtime.elements.element import Element, carried, positive_radius, rotated, set_fields, vectors, within_reach
from cga_runtime.elements.through_points import circle_through, refuse, sphere_through


@dataclass(frozen=True, eq=False)
class Circle(Element, kind="circle"):
    """Centre (..., 3), unit normal (..., 3) and radius (...)."""

    center: Array
    normal: Array
    radius: Array
    blades = ("e012", "e013", "e023", "e123", "e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The circle through three points, its normal by their right-hand rule. DegenerateError where they are collinear or coincide."""
        faults, center, normal, radius = circle_through(np.stack(vectors(a, b, c), axis=-2))
        refuse("circle", faults)
        return cls(center, normal, radius)

    def __post_init__(self) -> None:
        c, n = read(self.center, "centre of a circle", 3), read(self.normal, "normal of a circle", 3)
        batch = one_batch("circle", c.shape[:-1], n.shape[:-1], np.shape(self.radius))
        radius = positive_radius(self.radius, "circle")
        set_fields(self, batch, center=within_reach(c, "circle: its centre"), normal=unit(n, "circle"), radius=radius)

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.radius.shape

    @cached_property
    def coefficients(self) -> Array:
        """B ^ (P(c) + r^2/2 ei) / r, B the normal's bivector carried to the centre: B + (c cross n) ei, (..., 10)."""
        c, r = self.center, self.radius
        moment = np.cross(c, self.normal)
        n, w = parts(self.normal), parts(moment)
        m = parts(times(0.5 * (dot(c, c) + r * r), self.normal) - np.cross(moment, c))
        whole = stack(n[2], -n[1], n[0], dot(self.normal, c), w[0], w[1], m[2], w[2], -m[1], m[0])
        return times(1.0 / r, whole)

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        return type(self)(carried(d, rotation, t, self.center), rotated(rotation, self.normal), d * self.radius)


@dataclass(frozen=True, eq=False)
class Sphere(Element, kind="sphere"):
    """Centre (..., 3) and radius (...). Spheres are not oriented: the e0123 coefficient is positive."""

    center: Array
    radius: Array
    blades = ("e0123", "e012i", "e013i", "e023i", "e123i")

    @classmethod
    def from_center_radius(cls, center: ArrayLike, radius: ArrayLike) -> Self:
        """The sphere of a centre and a radius. Raises DegenerateError for a radius that is not positive."""
        return cls(read(center, "centre of a sphere", 3), read(radius, "radius of a sphere"))

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Self:
        """The sphere through four points in any order. Raises DegenerateError where they are coplanar or coincide."""
        faults, center, radius = sphere_through(np.stack(vectors(a, b, c, d), axis=-2))
        refuse("sphere", faults)
        return cls(center, radius)

    def __post_init__(self) -> None:
        c = read(self.center, "centre of a sphere", 3)
        batch = one_batch("sphere", c.shape[:-1], np.shape(self.radius))
        set_fields(self, batch, center=within_reach(c, "sphere: its centre"), radius=positive_radius(self.radius, "sphere"))

    @property
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""
        return self.radius.shape

    @cached_property
    def coefficients(self) -> Array:
        """(e0123 + c3 e012i - c2 e013i + c1 e023i + (c^2 - r^2)/2 e123i) / r, (..., 5)."""
        c, r = self.center, self.radius
        x, y, z = parts(c)
        return times(1.0 / r, stack(1.0, z, -y, x, 0.5 * (dot(c, c) - r * r)))

    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        return type(self)(carried(d, rotation, t, self.center), d * self.radius)
