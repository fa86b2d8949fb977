"""The nearest point of an element, the distance from it, and the outer product with it (paper A, eqs. 3, 4 and 9).

All of it is elementary geometry. Equation 4, (P.X) X^-1, gives the foot only on lines and planes, and there as an element that is no point;
on round elements it is none at all (similarity.md, section 9).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, read, times
from cga_runtime.elements.element import Element
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import Point, PointPair
from cga_runtime.elements.rounds import Circle, Sphere
from cga_runtime.elements.through_points import COINCIDENT, Rows
from cga_runtime.errors import DegenerateError, UnknownNameError
from cga_runtime.multivectors import Multivector
from cga_runtime.multivectors import times as product
from cga_runtime.versors import Translator

CENTRAL = 1e-12
"""Points closer to a centre, an axis or a middle plane than this, relative to the distances at hand, have no one nearest point."""


def project(x: ArrayLike | Point, onto: Element) -> Array:
    """The point of an element nearest to x (..., 3) (m), (..., 3): the foot on lines and planes, the nearer one of a point pair.

    Raises DegenerateError where several are nearest (the centre of a sphere, the axis of a circle, the middle plane of a point pair),
    UnknownNameError for what is no element, WrongSizeError, NotFiniteError.
    """
    points = _points(x, onto)
    match onto:
        case Point():
            return np.array(np.broadcast_to(onto.center, np.broadcast_shapes(points.shape, onto.center.shape)))
        case PointPair():
            rise = dot(points - onto.center, onto.direction)
            _one_nearest(np.abs(rise), norm(points) + norm(onto.center) + onto.radius, "in the middle plane of the point pair")
            return np.where((rise > 0.0)[..., None], onto.points[..., 1, :], onto.points[..., 0, :])
        case Line():
            return onto.center + times(dot(points - onto.center, onto.direction), onto.direction)
        case Plane():
            return points - times(dot(points, onto.normal) - onto.offset, onto.normal)
        case Circle():
            step = points - onto.center
            away = step - times(dot(step, onto.normal), onto.normal)
            _one_nearest(norm(away), norm(points) + norm(onto.center) + onto.radius, "on the axis of the circle")
            return onto.center + times(onto.radius / norm(away), away)
        case Sphere():
            step = points - onto.center
            _one_nearest(norm(step), norm(points) + norm(onto.center) + onto.radius, "at the centre of the sphere")
            return onto.center + times(onto.radius / norm(step), step)
    raise AssertionError  # _points knows all kinds


def distance(x: ArrayLike | Point, element: Element) -> Array:
    """Euclidean distance (m) of points x (..., 3) from an element, (...), never negative; the batch dimensions of both broadcast.

    Raises UnknownNameError for what is no element, WrongSizeError, NotFiniteError, DegenerateError beyond 1e60 m.
    """
    points = _points(x, element)
    return _DISTANCES[element.kind](points, element)


def contains(element: Element, x: ArrayLike | Point, tolerance: ArrayLike = COINCIDENT) -> Rows:
    """Whether points x (..., 3) lie on an element, within `tolerance` (m), (...). Raises what `distance` raises."""
    return np.asarray(distance(x, element) <= read(tolerance, "tolerance"))


def incidence(x: ArrayLike | Point, element: Element) -> Multivector:
    """P(x) ^ X of the unit primitive X, which is zero exactly for points of the element (paper A, eq. 3).

    Calculated in coordinates with x as the origin, where it is e0 ^ X, and carried back: far from the origin the product itself would drown
    in its rounding. Raises what `distance` raises.
    """
    there = Translator.from_vector(_points(x, element))
    near = product(_ORIGIN, element.transformed(~there), "outer")
    moved = there * near * ~there
    return Multivector(np.stack([moved[name] for name in _blades(element)], axis=-1), _blades(element))


_ORIGIN = Multivector([1.0], ["e0"])


def _blades(element: Element) -> tuple[str, ...]:
    """Those of P ^ X."""
    point, other = (Multivector(np.zeros(len(blades)), blades) for blades in (Point.blades, element.blades))
    return product(point, other, "outer").blades


def _points(x: ArrayLike | Point, element: Element) -> Array:
    if not isinstance(element, Element):
        raise UnknownNameError("kind of element", type(element).__name__, Element.kinds)
    points = x.center if isinstance(x, Point) else Point(x).center
    one_batch(f"distance from a {element.name}", points.shape[:-1], element.batch)
    return points


def _one_nearest(length: Array, size: Array, where: str) -> None:
    if (length <= CENTRAL * size).any():
        raise DegenerateError(f"project: a point {where} has no one nearest point; distance needs none")


def _to_point(x: Array, onto: Point) -> Array:
    return norm(x - onto.center)


def _to_point_pair(x: Array, onto: PointPair) -> Array:
    return np.asarray(norm(x[..., None, :] - onto.points).min(axis=-1))


def _to_line(x: Array, onto: Line) -> Array:
    return norm(np.cross(x - onto.center, onto.direction))


def _to_plane(x: Array, onto: Plane) -> Array:
    return np.asarray(np.abs(dot(x, onto.normal) - onto.offset))


def _to_circle(x: Array, onto: Circle) -> Array:
    step = x - onto.center
    height = dot(step, onto.normal)
    return np.asarray(np.hypot(height, norm(step - times(height, onto.normal)) - onto.radius))


def _to_sphere(x: Array, onto: Sphere) -> Array:
    return np.asarray(np.abs(norm(x - onto.center) - onto.radius))


_DISTANCES: dict[str, Callable[[Array, Any], Array]] = {
    "point": _to_point,
    "point_pair": _to_point_pair,
    "line": _to_line,
    "plane": _to_plane,
    "circle": _to_circle,
    "sphere": _to_sphere,
}
