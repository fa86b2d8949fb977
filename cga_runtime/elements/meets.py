"""Where two elements meet: the blade of equation 5 of paper A, which always exists, and the real intersection, which need not.

The blade holds all cases at once; its squared radius is negative where two elements miss each other, zero where they touch. What it cannot
hold is the intersection of elements that lie in one plane or sphere (coplanar lines and circles), for which it is zero. `intersection` is
elementary geometry on centres, directions and radii and so keeps their accuracy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array, norm
from cga_runtime.elements.element import Element
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import Point, PointPair
from cga_runtime.elements.rounds import Circle, Sphere
from cga_runtime.elements.through_points import COINCIDENT, FLAT
from cga_runtime.errors import DegenerateError, UnknownNameError, WrongSizeError
from cga_runtime.multivectors import Multivector, times

ROUNDING = 1e-12
"""Lengths smaller than this part of the sizes and distances at hand count as zero."""

Shared = Line | Circle | PointPair | Point


def meet(a: Element | Multivector, b: Element | Multivector) -> Multivector:
    """Y = (A* ^ B*)*, X* = X I, of any two multivectors (paper A, eq. 5); batch dimensions broadcast.

    The sign is that of X* = X I on both sides; with X* = -X I it is the other one (similarity.md, section 9). Without blades where the
    grades alone make it zero (a point and a point). Raises WrongSizeError; NotFiniteError where it is too large for a float.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        return times(a.dual(), b.dual(), "outer").dual()


def intersection(a: Element, b: Element, tolerance: float = COINCIDENT) -> Shared:
    """What two of line, circle, plane and sphere have in common: a Line, Circle, PointPair or Point.

    Single elements only. Elements that touch, or miss each other by no more than `tolerance` (m), meet in a Point. Direction, normal and
    order of points are those of `meet(a, b)`, which is a positive multiple of the intersection. Where the meet is no pair (circles, and
    lines in the plane of a circle), two points are ordered along the line, or along n_a x (c_b - c_a) for circles in one plane, or along
    n_a x n_b for circles in two.

    Raises DegenerateError, with the reason, where they are parallel, skew, disjoint, or one lies in the other; UnknownNameError for other
    kinds (for points take `contains` of distances.py); WrongSizeError for batches.
    """
    for element in (a, b):
        if not isinstance(element, Line | Circle | Plane | Sphere):
            name = element.kind if isinstance(element, Element) else type(element).__name__
            raise UnknownNameError("kind of element to intersect", name, ("line", "circle", "plane", "sphere"))
        if element.batch:
            raise WrongSizeError(f"intersection: a {element.name} of batch shape {element.batch} given, single elements needed")
    swapped = (a.kind, b.kind) not in _TABLE
    first, second = (b, a) if swapped else (a, b)
    size = max(float(length) for x in (a, b) for length in (norm(x.center), getattr(x, "radius", 0.0)))
    return _TABLE[first.kind, second.kind](first, second, tolerance + ROUNDING * size)


def _plane_plane(a: Plane, b: Plane, tolerance: float) -> Shared:
    across = np.cross(a.normal, b.normal)
    if norm(across) <= FLAT:
        same = abs(a.offset - b.offset * (a.normal @ b.normal)) <= tolerance
        raise _none(a, b, "are one plane" if same else "are parallel")
    through = (a.offset * np.cross(b.normal, across) + b.offset * np.cross(across, a.normal)) / (across @ across)
    return Line(through, -across)


def _line_plane(a: Line, b: Plane, tolerance: float) -> Shared:
    slope, height = a.direction @ b.normal, b.offset - a.center @ b.normal
    if abs(slope) <= FLAT:
        raise _none(a, b, "share the whole line, which lies in the plane" if abs(height) <= tolerance else "are parallel")
    return Point(a.center + a.direction * (height / slope))


def _line_line(a: Line, b: Line, tolerance: float) -> Shared:
    across, between = np.cross(a.direction, b.direction), b.center - a.center
    sine = norm(across)
    if sine <= FLAT:
        raise _none(a, b, "are one line" if norm(np.cross(between, a.direction)) <= tolerance else "are parallel")
    gap = abs(between @ across) / sine
    if gap > tolerance:
        raise _none(a, b, f"are skew, {gap:.3g} m apart")
    feet = [x.center + x.direction * (np.cross(between, y.direction) @ across / sine**2) for x, y in ((a, b), (b, a))]
    return Point(0.5 * (feet[0] + feet[1]))


def _sphere_sphere(a: Sphere, b: Sphere, tolerance: float) -> Shared:
    between = b.center - a.center
    ahead, half = _lens(a, b, float(norm(between)), a.radius, b.radius, tolerance)
    center = a.center + between * (ahead / norm(between))
    return Point(center) if half <= COINCIDENT else Circle(center, -between, np.asarray(half))


def _plane_sphere(a: Plane, b: Sphere, tolerance: float, sign: float = 1.0) -> Shared:
    height = b.center @ a.normal - a.offset
    if abs(height) > b.radius + tolerance:
        raise _none(a, b, f"are disjoint, {abs(height) - b.radius:.3g} m apart")
    half = _half_chord(b.radius, abs(height), tolerance)
    center = b.center - height * a.normal
    return Point(center) if half <= COINCIDENT else Circle(center, sign * a.normal, np.asarray(half))


def _line_sphere(a: Line, b: Sphere, tolerance: float) -> Shared:
    return _chord(a, b, a.direction, _foot(a, b.center), tolerance)


def _circle_plane(a: Circle, b: Plane, tolerance: float) -> Shared:
    across, height = np.cross(a.normal, b.normal), a.center @ b.normal - b.offset
    sine = norm(across)
    if sine <= FLAT:
        raise _none(a, b, "share the whole circle, which lies in the plane" if abs(height) <= tolerance else "are parallel")
    along = across / sine
    return _chord(a, b, along, a.center - np.cross(along, a.normal) * (height / sine), tolerance)


def _circle_sphere(a: Circle, b: Sphere, tolerance: float) -> Shared:
    between = b.center - a.center
    height = between @ a.normal
    if abs(height) > b.radius + tolerance:
        raise _none(a, b, f"are disjoint, the plane of the circle {abs(height) - b.radius:.3g} m from the sphere")
    return _coplanar(a, b, between - height * a.normal, _half_chord(b.radius, abs(height), tolerance), tolerance)


def _line_circle(a: Line, b: Circle, tolerance: float) -> Shared:
    foot = _foot(a, b.center)
    slope, height = a.direction @ b.normal, (b.center - foot) @ b.normal
    if abs(slope) <= FLAT:
        if abs(height) > tolerance:
            raise _none(a, b, "are disjoint, the line parallel to the plane of the circle")
        return _chord(a, b, a.direction, foot, tolerance)
    hit = foot + a.direction * (height / slope)
    gap = abs(norm(hit - b.center) - b.radius)
    if gap > tolerance:
        raise _none(a, b, f"are disjoint, the line passes the plane of the circle {gap:.3g} m from the circle")
    return Point(hit)


def _circle_circle(a: Circle, b: Circle, tolerance: float) -> Shared:
    between = b.center - a.center
    height = between @ a.normal
    if norm(np.cross(a.normal, b.normal)) <= FLAT:
        if abs(height) > tolerance:
            raise _none(a, b, "are disjoint, in parallel planes")
        return _coplanar(a, b, between - height * a.normal, float(b.radius), tolerance)
    cut = _circle_plane(a, Plane.from_point_normal(b.center, b.normal), tolerance)
    ends = cut.points if isinstance(cut, PointPair) else [cut.center]
    shared = [x for x in ends if abs(norm(x - b.center) - b.radius) <= tolerance]
    if not shared:
        raise _none(a, b, "are disjoint")
    return cut if len(shared) == 2 else Point(shared[0])


def _coplanar(a: Circle, b: Element, between: Array, radius: float, tolerance: float) -> Shared:
    """Of a circle and one of that radius in its plane, whose centre lies `between` from its own."""
    distance = float(norm(between))
    ahead, half = _lens(a, b, distance, a.radius, radius, tolerance)
    along = between / distance
    aside, center = np.cross(a.normal, along), a.center + ahead * along
    return Point(center) if half <= COINCIDENT else PointPair.from_points(center - half * aside, center + half * aside)


def _lens(a: Element, b: Element, distance: float, first: Any, second: Any, tolerance: float) -> tuple[float, float]:
    """Of two circles or spheres whose centres have a distance: how far their common points lie ahead of the first centre, and aside."""
    r, s = float(first), float(second)
    if distance <= tolerance and abs(r - s) <= tolerance:
        raise _none(a, b, f"are one {a.name}" if a.kind == b.kind else "share the whole circle, which lies in the sphere")
    if distance > r + s + tolerance:
        raise _none(a, b, f"are disjoint, {distance - r - s:.3g} m apart")
    if distance < abs(r - s) - tolerance:
        raise _none(a, b, "are disjoint, one inside the other")
    if distance >= r + s - tolerance:
        return r, 0.0
    if distance <= abs(r - s) + tolerance:
        return math.copysign(r, r - s), 0.0
    ahead = 0.5 * (distance + (r - s) * (r + s) / distance)
    factors = (distance + r + s) * (distance + r - s) * (distance - r + s) * (r + s - distance)  # of the triangle's area
    return ahead, 0.5 * math.sqrt(max(factors, 0.0)) / distance


def _chord(a: Element, b: Element, along: Array, foot: Array, tolerance: float) -> Shared:
    """Of a line along a unit vector and a circle in whose plane it lies, or a sphere, `foot` the point of the line next to its centre."""
    ball = a if isinstance(a, Circle) else b
    assert isinstance(ball, Circle | Sphere)
    gap = float(norm(foot - ball.center))
    if gap > ball.radius + tolerance:
        raise _none(a, b, f"are disjoint, {gap - ball.radius:.3g} m apart")
    half = _half_chord(ball.radius, gap, tolerance)
    return Point(foot) if half <= COINCIDENT else PointPair.from_points(foot - half * along, foot + half * along)


def _half_chord(radius: Any, gap: Any, tolerance: float) -> float:
    """Half the length of a chord that passes a centre at a distance; 0 where it touches."""
    return 0.0 if gap >= radius - tolerance else math.sqrt((radius - gap) * (radius + gap))


def _foot(line: Line, x: Array) -> Array:
    return np.asarray(line.center + line.direction * ((x - line.center) @ line.direction))


def _none(a: Element, b: Element, why: str) -> DegenerateError:
    both = f"the two {a.name}s" if a.kind == b.kind else f"the {a.name} and the {b.name}"
    return DegenerateError(f"intersection: {both} {why}")


_TABLE: dict[tuple[str, str], Callable[[Any, Any, float], Shared]] = {
    ("plane", "plane"): _plane_plane,
    ("line", "plane"): _line_plane,
    ("line", "line"): _line_line,
    ("sphere", "sphere"): _sphere_sphere,
    ("plane", "sphere"): _plane_sphere,
    ("sphere", "plane"): lambda a, b, tolerance: _plane_sphere(b, a, tolerance, sign=-1.0),
    ("line", "sphere"): _line_sphere,
    ("circle", "plane"): _circle_plane,
    ("circle", "sphere"): _circle_sphere,
    ("line", "circle"): _line_circle,
    ("circle", "circle"): _circle_circle,
}
