"""Points, point pairs, lines, circles, planes, spheres and motors as small immutable objects over CGA coordinates (paper A, sections 2 to 4).

Null basis e0 e1 e2 e3 ei with e0.ei = -1; P(x) = e0 + x + x^2/2 ei. Coefficients stand in canonical blade order (ascending bit mask, e0 = 1,
e1 = 2, e2 = 4, e3 = 8, ei = 16) and belong to the unit primitive, <X ~X> = -1 (a point has e0 coefficient 1); orientation is kept: swapped
points turn a direction round. Arrays are float64 and read-only, in metres; leading batch dimensions are allowed everywhere.

Centres, directions and radii come from the points they were made of, never back from the coefficients, where they would lose accuracy as
a power of distance / size (paper A, with the point formulas instead of eqs. 24-27).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.errors import DegenerateError, NotFiniteError, WrongSizeError

Array = NDArray[np.float64]

COINCIDENT = 1e-9
"""Points closer than this (m), or than 1e-12 of their distance from the origin, count as one point; smaller radii as zero."""
FLAT = 1e-9
"""Smallest sine between two edges, and smallest |det| over the product of three, that still spans a plane or a space."""
RIGID = 1e-9
"""Largest deviation of a motor from M ~M = 1, and of a pose from a rotation and a translation."""


@dataclass(frozen=True, eq=False)
class Point:
    """The point x, (..., 3)."""

    center: Array
    blades: ClassVar[tuple[str, ...]] = ("e0", "e1", "e2", "e3", "ei")

    def __post_init__(self) -> None:
        _freeze(self, center=read(self.center, "a point", 3))

    @cached_property
    def coefficients(self) -> Array:
        """e0 + x + x^2/2 ei, (..., 5)."""
        x = self.center
        return _components(np.ones(x.shape[:-1]), x, 0.5 * dot(x, x))


@dataclass(frozen=True, eq=False)
class PointPair:
    """Two points in order, (..., 2, 3). Raises DegenerateError where they coincide."""

    points: Array
    blades: ClassVar[tuple[str, ...]] = ("e01", "e02", "e12", "e03", "e13", "e23", "e0i", "e1i", "e2i", "e3i")

    def __post_init__(self) -> None:
        points = read(self.points, "a point pair", 2, 3)
        _edge(points[..., 0, :], points[..., 1, :], "point pair")
        _freeze(self, points=points)

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """The pair (a, b): first a, then b; its direction points from a to b."""
        return cls(np.stack(_points(a, b), axis=-2))

    @cached_property
    def center(self) -> Array:
        """Midpoint, (..., 3)."""
        return 0.5 * (self.points[..., 0, :] + self.points[..., 1, :])

    @cached_property
    def direction(self) -> Array:
        """Unit vector from the first to the second point, (..., 3)."""
        return unit(self.points[..., 1, :] - self.points[..., 0, :], "direction of a point pair")

    @cached_property
    def radius(self) -> Array:
        """Half the distance of the points, (...)."""
        return np.asarray(0.5 * norm(self.points[..., 1, :] - self.points[..., 0, :]))

    @cached_property
    def coefficients(self) -> Array:
        """P1 ^ P2 / (2 r^2), (..., 10)."""
        (x1, x2), d = np.moveaxis(self.points, -2, 0), self.points[..., 1, :] - self.points[..., 0, :]
        m = np.cross(x1, d)
        mixed = 0.5 * (x1 * dot(x2, x2)[..., None] - x2 * dot(x1, x1)[..., None])
        parts = _components(d[..., :2], m[..., 2], d[..., 2], -m[..., 1], m[..., 0], dot(d, self.center), mixed)
        return np.asarray(parts / (2.0 * self.radius**2)[..., None])


@dataclass(frozen=True, eq=False)
class Line:
    """The line through `center` along `direction`, both (..., 3); the centre is moved to the foot of the origin, the direction to length 1."""

    center: Array
    direction: Array
    blades: ClassVar[tuple[str, ...]] = ("e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    def __post_init__(self) -> None:
        x, d = _points(self.center, self.direction)
        n = unit(d, "direction of a line")
        _freeze(self, center=x - n * dot(n, x)[..., None], direction=n)

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike) -> Self:
        """The line from a to b. Raises DegenerateError where they coincide."""
        first, second = _points(a, b)
        return cls(first, _edge(first, second, "line"))

    @classmethod
    def from_point_direction(cls, point: ArrayLike, direction: ArrayLike) -> Self:
        """The line through a point along a direction of any length but zero."""
        return cls(*_points(point, direction))

    @cached_property
    def coefficients(self) -> Array:
        """Direction d and moment m = x cross d: d1 e01i + d2 e02i + m3 e12i + d3 e03i - m2 e13i + m1 e23i, (..., 6)."""
        d, m = self.direction, np.cross(self.center, self.direction)
        return _components(d[..., :2], m[..., 2], d[..., 2], -m[..., 1], m[..., 0])


@dataclass(frozen=True, eq=False)
class Circle:
    """Centre (..., 3), unit normal (..., 3), by the right-hand rule of its points, and radius (...)."""

    center: Array
    normal: Array
    radius: Array
    blades: ClassVar[tuple[str, ...]] = ("e012", "e013", "e023", "e123", "e01i", "e02i", "e12i", "e03i", "e13i", "e23i")

    def __post_init__(self) -> None:
        c, n = _points(self.center, self.normal)
        _freeze(self, center=c, normal=unit(n, "normal of a circle"), radius=_radius(self.radius, "circle"))

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The circle through three points. Raises DegenerateError where they are collinear or coincide."""
        (x1, x2, x3), n = _points(a, b, c), _normal(a, b, c, "circle")
        e, f = x2 - x1, x3 - x1
        y = np.cross(dot(e, e)[..., None] * f - dot(f, f)[..., None] * e, n) / (2.0 * dot(n, n))[..., None]
        return cls(x1 + y, n, np.asarray(norm(y)))

    @cached_property
    def coefficients(self) -> Array:
        """N(c) ^ (P(c) + r^2/2 ei) / r with N(c) the normal's bivector through the centre, (..., 10)."""
        c, n, r = self.center, self.normal, self.radius
        w, k = np.cross(c, n), 0.5 * (dot(c, c) + r * r)[..., None]
        last = k * n - np.cross(w, c)
        parts = _components(
            *(n[..., 2], -n[..., 1], n[..., 0], dot(n, c)), w[..., :2], last[..., 2], w[..., 2], -last[..., 1], last[..., 0]
        )
        return np.asarray(parts / r[..., None])


@dataclass(frozen=True, eq=False)
class Plane:
    """Unit normal n (..., 3) and offset (...): the points with n.x = offset. A normal of another length is divided out of both."""

    normal: Array
    offset: Array
    blades: ClassVar[tuple[str, ...]] = ("e012i", "e013i", "e023i", "e123i")

    def __post_init__(self) -> None:
        n, offset = read(self.normal, "normal of a plane", 3), read(self.offset, "offset of a plane")
        direction = unit(n, "normal of a plane")
        offset = offset / norm(n)
        _freeze(self, normal=np.broadcast_to(direction, (*offset.shape, 3)), offset=offset)

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike) -> Self:
        """The plane through three points, normal by the right-hand rule. Raises DegenerateError where they are collinear or coincide."""
        return cls.from_point_normal(a, _normal(a, b, c, "plane"))

    @classmethod
    def from_point_normal(cls, point: ArrayLike, normal: ArrayLike) -> Self:
        """The plane through a point, square to a normal of any length but zero."""
        x, n = _points(point, normal)
        n = unit(n, "normal of a plane")
        return cls(n, dot(n, x))

    @classmethod
    def from_normal_offset(cls, normal: ArrayLike, offset: ArrayLike) -> Self:
        """The plane n.x = offset; both are divided by |n|."""
        return cls(np.asarray(normal), np.asarray(offset))

    @cached_property
    def center(self) -> Array:
        """Foot of the origin, (..., 3)."""
        return np.asarray(self.normal * self.offset[..., None])

    @cached_property
    def coefficients(self) -> Array:
        """n3 e012i - n2 e013i + n1 e023i + offset e123i, (..., 4)."""
        n = self.normal
        return _components(n[..., 2], -n[..., 1], n[..., 0], self.offset)


@dataclass(frozen=True, eq=False)
class Sphere:
    """Centre (..., 3) and radius (...). A sphere has no orientation: its e0123 coefficient is positive."""

    center: Array
    radius: Array
    blades: ClassVar[tuple[str, ...]] = ("e0123", "e012i", "e013i", "e023i", "e123i")

    def __post_init__(self) -> None:
        c, r = read(self.center, "centre of a sphere", 3), _radius(self.radius, "sphere")
        batch = np.broadcast_shapes(c.shape[:-1], r.shape)
        _freeze(self, center=np.broadcast_to(c, (*batch, 3)), radius=np.broadcast_to(r, batch))

    @classmethod
    def from_center_radius(cls, center: ArrayLike, radius: ArrayLike) -> Self:
        """The sphere of a centre and a positive radius."""
        return cls(np.asarray(center), np.asarray(radius))

    @classmethod
    def from_points(cls, a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> Self:
        """The sphere through four points, in any order. Raises DegenerateError where they are coplanar or coincide."""
        x1, x2, x3, x4 = _points(a, b, c, d)
        edges = np.stack([_edge(x1, x, "sphere") for x in (x2, x3, x4)], axis=-2)
        lengths = norm(edges)
        if (np.abs(np.linalg.det(edges / lengths[..., None])) <= FLAT).any():
            raise DegenerateError("sphere: its four points lie in one plane; use a Plane")
        y = np.linalg.solve(edges, 0.5 * (lengths**2)[..., None])[..., 0]
        return cls(x1 + y, np.asarray(norm(y)))

    @cached_property
    def coefficients(self) -> Array:
        """(e0123 + c3 e012i - c2 e013i + c1 e023i + (c^2 - r^2)/2 e123i) / r, (..., 5)."""
        c, r = self.center, self.radius
        parts = _components(np.ones(r.shape), c[..., 2], -c[..., 1], c[..., 0], 0.5 * (dot(c, c) - r * r))
        return np.asarray(parts / r[..., None])


@dataclass(frozen=True, eq=False)
class Motor:
    """A rigid motion M = T(t) R, (..., 8), x -> M x ~M. Raises DegenerateError where M ~M is not 1."""

    coefficients: Array
    blades: ClassVar[tuple[str, ...]] = ("1", "e12", "e13", "e23", "e1i", "e2i", "e3i", "e123i")

    def __post_init__(self) -> None:
        m = read(self.coefficients, "a motor", 8)
        rotor, ideal = m[..., :4], _even(m[..., 4:])
        norm_error, ideal_error = np.abs(dot(rotor, rotor) - 1.0), np.abs(dot(rotor, ideal)) / (1.0 + norm(ideal))
        if max(norm_error.max(initial=0.0), ideal_error.max(initial=0.0)) > RIGID:
            raise DegenerateError(
                f"not a motor: M ~M must be 1, but its scalar part is off by {norm_error.max(initial=0.0):.1e} "
                f"and its e0123i-free part by {ideal_error.max(initial=0.0):.1e}; Motor.from_pose makes one from a matrix"
            )
        _freeze(self, coefficients=m)

    @classmethod
    def from_pose(cls, pose: ArrayLike) -> Self:
        """The motor of a homogeneous matrix (..., 4, 4), with scalar part >= 0. DegenerateError if it is not a rotation and a translation."""
        matrix = read(pose, "a pose", 4, 4)
        r, t = matrix[..., :3, :3], matrix[..., :3, 3]
        error = np.abs(np.swapaxes(r, -1, -2) @ r - np.eye(3)).max(initial=0.0)
        if error > RIGID or (np.linalg.det(r) < 0.0).any() or (matrix[..., 3, :] != (0.0, 0.0, 0.0, 1.0)).any():
            raise DegenerateError(f"not a pose: a rotation matrix, a translation and the row 0 0 0 1 are needed (R^T R is off by {error:.1e})")
        (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = np.moveaxis(r, (-2, -1), (0, 1))
        # rows are the quaternion (w, x, y, z) times four of one of its components; the row of the largest one is accurate
        rows = np.stack(
            [
                _components(1 + xx + yy + zz, zy - yz, xz - zx, yx - xy),
                _components(zy - yz, 1 + xx - yy - zz, xy + yx, xz + zx),
                _components(xz - zx, xy + yx, 1 - xx + yy - zz, yz + zy),
                _components(yx - xy, xz + zx, yz + zy, 1 - xx - yy + zz),
            ],
            axis=-2,
        )
        best = np.argmax(np.diagonal(rows, axis1=-2, axis2=-1), axis=-1)[..., None, None]
        w, x, y, z = np.moveaxis(unit(np.take_along_axis(rows, best, axis=-2)[..., 0, :], "a quaternion"), -1, 0)
        rotor = _components(w, -z, y, -x) * np.where(w < 0.0, -1.0, 1.0)[..., None]
        translator = _even(_components(-0.5 * t, np.zeros(t.shape[:-1])))
        return cls(_components(rotor, _odd(_rotor_product(translator, rotor))))

    def pose(self) -> Array:
        """Homogeneous matrix, (..., 4, 4)."""
        a, b12, b13, b23 = np.moveaxis(self.coefficients[..., :4], -1, 0)
        w, x, y, z = a, -b23, b13, -b12
        matrix = np.zeros((*a.shape, 4, 4))
        matrix[..., 0, :3] = _components(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y))
        matrix[..., 1, :3] = _components(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x))
        matrix[..., 2, :3] = _components(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
        matrix[..., :3, 3] = -2.0 * _odd(_rotor_product(_even(self.coefficients[..., 4:]), self.coefficients[..., :4] * REVERSE))[..., :3]
        matrix[..., 3, 3] = 1.0
        return matrix

    def __mul__(self, other: Motor) -> Motor:
        """Geometric product: first `other`, then self; 48 products in the table, written as three quaternion products."""
        if not isinstance(other, Motor):
            return NotImplemented
        (r1, r2), (i1, i2) = ((self.coefficients[..., :4], other.coefficients[..., :4]), (_even(self.coefficients[..., 4:]), _even(other.coefficients[..., 4:])))
        return Motor(_components(_rotor_product(r1, r2), _odd(_rotor_product(r1, i2) + _rotor_product(i1, r2))))

    def __invert__(self) -> Motor:
        """Reverse, the inverse motion."""
        return Motor(self.coefficients * np.array([1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, 1.0]))
