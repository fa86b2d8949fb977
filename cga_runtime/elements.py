"""Points, point pairs, lines, circles, planes, spheres and motors: small immutable objects over CGA coordinates (paper A, sections 2-4).

Null basis e0 e1 e2 e3 ei with e0.ei = -1; P(x) = e0 + x + x^2/2 ei. Coefficients stand in canonical blade order (ascending bit mask,
e0 = 1, e1 = 2, e2 = 4, e3 = 8, ei = 16) and are those of the unit primitive, <X ~X> = -1 (a point has e0 coefficient 1). Orientation is
kept: with its points in another order a direction may turn round. Arrays are float64 and read-only, lengths in metres; every argument may
have leading batch dimensions, and the results have them too.

Centres, directions and radii come from the points, never back from the coefficients, where they would lose accuracy as a power of
distance / size (paper A, eqs. 23-27, replaced by formulas on the points).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, parts, read, stack, times, unit
from cga_runtime.errors import DegenerateError
from cga_runtime.motors import Motor

__all__ = ["Circle", "Line", "Motor", "Plane", "Point", "PointPair", "Sphere"]

COINCIDENT = 1e-9
"""Points closer than this (m), or than 1e-12 of their distance from the origin, count as one point; a smaller radius as zero."""
FLAT = 1e-9
"""Smallest sine between two edges that span a plane, and smallest |det| of three edges, over their lengths, that span space."""


@dataclass(frozen=True, eq=False)
class Point:
    """The point at `center`, (..., 3)."""

    center: Array
    blades: ClassVar[tuple[str, ...]] = ("e0", "e1", "e2", "e3", "ei")

    def __init__(self, x: ArrayLike) -> None:
        center = read(x, "point", 3)
        _set(self, center.shape[:-1], center=center)

    @cached_property
    def coefficients(self) -> Array:
        """e0 + x + x^2/2 ei, (..., 5)."""
        return stack(1.0, *parts(self.center), 0.5 * dot(self.center, self.center))


@dataclass(frozen=True, eq=False)
class PointPair:
    """Two points in order: `points` (..., 2, 3)."""

    points: Array
    blades: ClassVar[tuple[str, ...]] = ("e01", "e02", "e12", "e03", "e13", "e23", "e0i", "e1i", "e2i", "e3i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """First a, then b; the direction leads from a to b. Raises DegenerateError where they coincide."""
        first, second = _points(a, b)
        return cls(np.stack([first, second], axis=-2))

    def __post_init__(self) -> None:
        points = read(self.points, "point pair", 2, 3)
        _edge(points[..., 0, :], points[..., 1, :], "point pair")
        object.__setattr__(self, "points", points)

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
        """P1 ^ P2 / (2 r^2), (..., 10)."""
        a, b = self.points[..., 0, :], self.points[..., 1, :]
        d, m = parts(b - a), parts(np.cross(a, b))
        mixed = parts(0.5 * (times(dot(b, b), a) - times(dot(a, a), b)))
        whole = stack(d[0], d[1], m[2], d[2], -m[1], m[0], dot(b - a, self.center), *mixed)
        return times(0.5 / self.radius**2, whole)


@dataclass(frozen=True, eq=False)
class Line:
    """The line through `center` along `direction`, both (..., 3): the centre becomes the foot of the origin, the direction unit."""

    center: Array
    direction: Array
    blades: ClassVar[tuple[str, ...]] = ("e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """The line from a to b. Raises DegenerateError where they coincide."""
        first, second = _points(a, b)
        return cls(first, _edge(first, second, "line"))

    @classmethod
    def from_point_direction(cls, point: ArrayLike, direction: ArrayLike) -> Self:
        """The line through a point along a direction of any length. Raises DegenerateError for a zero direction."""
        return cls(*_points(point, direction))

    def __post_init__(self) -> None:
        x, d = _points(self.center, self.direction)
        n = unit(d, "line")
        _set(self, x.shape[:-1], center=x - times(dot(n, x), n), direction=n)

    @cached_property
    def coefficients(self) -> Array:
        """d1 e01i + d2 e02i + m3 e12i + d3 e03i - m2 e13i + m1 e23i with the moment m = x cross d, (..., 6)."""
        d, m = parts(self.direction), parts(np.cross(self.center, self.direction))
        return stack(d[0], d[1], m[2], d[2], -m[1], m[0])


@dataclass(frozen=True, eq=False)
class Circle:
    """Centre (..., 3), unit normal (..., 3) and radius (...)."""

    center: Array
    normal: Array
    radius: Array
    blades: ClassVar[tuple[str, ...]] = ("e012", "e013", "e023", "e123", "e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The circle through three points, its normal by their right-hand rule. DegenerateError where they are collinear or coincide."""
        x, *_ = _points(a, b, c)
        first, second, n = _corner(a, b, c, "circle")
        y = times(0.5 / dot(n, n), np.cross(times(dot(first, first), second) - times(dot(second, second), first), n))
        return cls(x + y, n, norm(y))

    def __post_init__(self) -> None:
        c, n = read(self.center, "centre of a circle", 3), read(self.normal, "normal of a circle", 3)
        batch = one_batch("circle", c.shape[:-1], n.shape[:-1], np.shape(self.radius))
        _set(self, batch, center=c, normal=unit(n, "circle"), radius=_radius(self.radius, "circle"))

    @cached_property
    def coefficients(self) -> Array:
        """B ^ (P(c) + r^2/2 ei) / r, B the normal's bivector carried to the centre: B + (c cross n) ei, (..., 10)."""
        c, r = self.center, self.radius
        moment = np.cross(c, self.normal)
        n, w = parts(self.normal), parts(moment)
        m = parts(times(0.5 * (dot(c, c) + r * r), self.normal) - np.cross(moment, c))
        whole = stack(n[2], -n[1], n[0], dot(self.normal, c), w[0], w[1], m[2], w[2], -m[1], m[0])
        return times(1.0 / r, whole)


@dataclass(frozen=True, eq=False)
class Plane:
    """The points with n.x = offset: unit normal (..., 3), offset (...). A normal of another length is divided out of both."""

    normal: Array
    offset: Array
    blades: ClassVar[tuple[str, ...]] = ("e012i", "e013i", "e023i", "e123i")

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The plane through three points, its normal by their right-hand rule. DegenerateError where they are collinear or coincide."""
        *_, n = _corner(a, b, c, "plane")
        return cls.from_point_normal(a, n)

    @classmethod
    def from_point_normal(cls, point: ArrayLike, normal: ArrayLike) -> Self:
        """The plane through a point, square to a normal of any length. Raises DegenerateError for a zero normal."""
        x, n = _points(point, normal)
        n = unit(n, "plane")
        return cls(n, dot(n, x))

    @classmethod
    def from_normal_offset(cls, normal: ArrayLike, offset: ArrayLike) -> Self:
        """The plane n.x = offset, n of any length. Raises DegenerateError for a zero normal."""
        return cls(read(normal, "normal of a plane", 3), read(offset, "offset of a plane"))

    def __post_init__(self) -> None:
        n, offset = read(self.normal, "normal of a plane", 3), read(self.offset, "offset of a plane")
        batch = one_batch("plane", n.shape[:-1], offset.shape)
        _set(self, batch, normal=unit(n, "plane"), offset=offset / norm(n))

    @cached_property
    def center(self) -> Array:
        """Foot of the origin, (..., 3)."""
        return times(self.offset, self.normal)

    @cached_property
    def coefficients(self) -> Array:
        """n3 e012i - n2 e013i + n1 e023i + offset e123i, (..., 4)."""
        x, y, z = parts(self.normal)
        return stack(z, -y, x, self.offset)


@dataclass(frozen=True, eq=False)
class Sphere:
    """Centre (..., 3) and radius (...). Spheres are not oriented: the e0123 coefficient is positive."""

    center: Array
    radius: Array
    blades: ClassVar[tuple[str, ...]] = ("e0123", "e012i", "e013i", "e023i", "e123i")

    @classmethod
    def from_center_radius(cls, center: ArrayLike, radius: ArrayLike) -> Self:
        """The sphere of a centre and a radius. Raises DegenerateError for a radius that is not positive."""
        return cls(read(center, "centre of a sphere", 3), read(radius, "radius of a sphere"))

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Self:
        """The sphere through four points in any order. Raises DegenerateError where they are coplanar or coincide."""
        x, *others = _points(a, b, c, d)
        edges = np.stack([_edge(x, other, "sphere") for other in others], axis=-2)
        lengths = norm(edges)
        if (np.abs(np.linalg.det(edges / lengths[..., None])) <= FLAT).any():
            raise DegenerateError("sphere: its four points lie in one plane")
        y = np.asarray(np.linalg.solve(edges, 0.5 * (lengths * lengths)[..., None])[..., 0], dtype=np.float64)
        return cls(x + y, norm(y))

    def __post_init__(self) -> None:
        c = read(self.center, "centre of a sphere", 3)
        batch = one_batch("sphere", c.shape[:-1], np.shape(self.radius))
        _set(self, batch, center=c, radius=_radius(self.radius, "sphere"))

    @cached_property
    def coefficients(self) -> Array:
        """(e0123 + c3 e012i - c2 e013i + c1 e023i + (c^2 - r^2)/2 e123i) / r, (..., 5)."""
        c, r = self.center, self.radius
        x, y, z = parts(c)
        return times(1.0 / r, stack(1.0, z, -y, x, 0.5 * (dot(c, c) - r * r)))


def _set(element: Any, batch: tuple[int, ...], **fields: Array) -> None:
    """Fields of a frozen element, brought to one batch shape, read-only; radius and offset are scalars, the others vectors."""
    for name, value in fields.items():
        shape = batch if name in ("radius", "offset") else (*batch, 3)
        frozen = np.broadcast_to(value, shape).copy()
        frozen.flags.writeable = False
        object.__setattr__(element, name, frozen)


def _points(*points: ArrayLike) -> tuple[Array, ...]:
    """Vectors of one batch shape, each (..., 3)."""
    arrays = [read(x, "point or direction", 3) for x in points]
    batch = one_batch("points", *(x.shape[:-1] for x in arrays))
    return tuple(np.broadcast_to(x, (*batch, 3)) for x in arrays)


def _edge(a: Array, b: Array, what: str) -> Array:
    """b - a, or DegenerateError where the points coincide."""
    edge = b - a
    if (norm(edge) <= np.maximum(COINCIDENT, 1e-12 * norm(a))).any():
        raise DegenerateError(f"{what}: two of its points coincide (within {COINCIDENT:.0e} m)")
    return edge


def _corner(a: ArrayLike, b: ArrayLike, c: ArrayLike, what: str) -> tuple[Array, Array, Array]:
    """b - a, c - a and their cross product, or DegenerateError where the points are collinear or coincide."""
    x1, x2, x3 = _points(a, b, c)
    _edge(x2, x3, what)
    first, second = _edge(x1, x2, what), _edge(x1, x3, what)
    n = np.cross(first, second)
    if (norm(n) <= FLAT * norm(first) * norm(second)).any():
        raise DegenerateError(f"{what}: its three points lie on one line")
    return first, second, n


def _radius(radius: ArrayLike, what: str) -> Array:
    """A positive radius."""
    r = read(radius, f"radius of a {what}")
    if (r <= COINCIDENT).any():
        raise DegenerateError(f"{what}: radius {r.min():.3g} given, a positive one is needed (more than {COINCIDENT:.0e} m)")
    return r
