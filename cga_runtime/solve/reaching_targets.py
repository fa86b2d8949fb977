"""What a point must satisfy to lie on a primitive, as inner products in CGA.

Every primitive is an intersection of planes and spheres s, and P lies on s exactly where P.s = 0 (paper A, section 2). A plane is the dual
vector s = n + offset ei, a sphere s = (e0 + c + (c^2 - r^2)/2 ei) / r, scaled so that P.s is a length near the primitive. A line is two
planes square to each other, a point three: independent gradients, whereas P ^ X = 0 would have dependent rows.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.elements import Circle, Line, Plane, Point, Sphere

Target = Point | Line | Circle | Plane | Sphere


def _plane(normal: Array, point: Array) -> Array:
    return np.array([0.0, *normal, normal @ point])


def _sphere(center: Array, radius: Array) -> Array:
    return np.array([1.0, *center, 0.5 * (center @ center - radius**2)]) / radius


def _square_to(direction: Array) -> tuple[Array, Array]:
    """Two unit vectors that make a right-handed frame with a unit vector."""
    axis = np.eye(3)[np.argmin(np.abs(direction))]
    first = np.cross(direction, axis)
    first = first / np.linalg.norm(first)
    return first, np.cross(direction, first)


def _point_duals(target: Point) -> list[Array]:
    return [_plane(axis, target.center) for axis in np.eye(3)]


def _line_duals(target: Line) -> list[Array]:
    return [_plane(normal, target.center) for normal in _square_to(target.direction)]


def _circle_duals(target: Circle) -> list[Array]:
    return [_plane(target.normal, target.center), _sphere(target.center, target.radius)]


def _plane_duals(target: Plane) -> list[Array]:
    return [_plane(target.normal, target.center)]


def _sphere_duals(target: Sphere) -> list[Array]:
    return [_sphere(target.center, target.radius)]


_TABLE: dict[type, Callable[..., list[Array]]] = {
    Point: _point_duals,
    Line: _line_duals,
    Circle: _circle_duals,
    Plane: _plane_duals,
    Sphere: _sphere_duals,
}

KINDS: tuple[type, ...] = tuple(_TABLE)
"""Primitives that a single point can lie on."""


def duals(target: Target) -> Array:
    """Dual vectors (e0, e1, e2, e3, ei) of the planes and spheres that make up a primitive, (k, 5): k = 3 for a point, 2 for a line or
    circle, 1 for a plane or sphere."""
    return np.array(_TABLE[type(target)](target))
