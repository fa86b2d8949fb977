"""Elements read back from coefficients of any scale and sign (paper A, eqs. 24-27, corrected in similarity.md, section 3).

The kind is read off the grade, and off the part with e0 but without ei: where it vanishes, the element is flat. In units of the length

    l = max(|X1| / |X0|, sqrt(|X2| / |X0|)),   X0 with e0, X2 with ei, X1 with both or neither,

a round element has |X0| = 1 and no coefficient above 1, so that all thresholds below are relative, whatever its size and place.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cga_runtime.coordinates import Array, dot, norm, stack, times
from cga_runtime.elements.element import Element
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import Point, PointPair
from cga_runtime.elements.rounds import Circle, Sphere
from cga_runtime.elements.through_points import FARTHEST, Rows
from cga_runtime.errors import DegenerateError, UnknownNameError
from cga_runtime.multivectors import Multivector
from cga_runtime.multivectors import times as product

REACH = 1e12
"""An element whose centre is farther than this (m) counts as flat ..."""
NEAR = 1e9
"""... if it passes the origin within this distance (m); otherwise it lies too far to be read. A round one then has r > 0.999 |c|."""
MIXED = 1e-12
"""Coefficients of other grades than one must be below this, relative to the largest."""
NO_BLADE = 1e-6
"""Largest |X ^ X| of a blade (of the dual for circles) and |P^2| of a point, relative: what outer products of rounded points leave."""
NO_RADIUS = 1e-14
"""A squared radius below this, in units of l^2, cannot be told from zero, nor its sign be seen."""
PITCH = 1e-9
"""Largest pitch d.m / d^2 of a line, relative to its distance from the origin; or this many metres."""

Read = tuple[Element, Array]


def element_of(x: Multivector | Element, kind: str | None = None) -> Read:
    """The element and the weight w (...) of a multivector X (...), which may have any scale and sign.

    X = w element.coefficients for points, lines and planes, X = w r element.coefficients for point pairs, circles and spheres (see
    joins.py). Point pairs, lines, circles and planes are oriented: w > 0, and -X is the element turned round. Spheres and points are not:
    w has the sign of X. All rows of a batch must be of one kind, of `kind` where one is named.

    What X holds is less than what points hold: with the centre at the distance L and points of spread s, or a radius s, the error of the
    radius grows as a power of L / s. Largest relative error of 60 random elements with s = 0.01: from `coefficients` or `join`, 3e-9 at
    L = 10 and 1e-7 at L = 100 (square of L / s); from outer products of points as they come (P1 ^ P2 ^ P3), 3e-6 at L = 10 and 1e-4
    (circles), 1e-3 (spheres), 2e-3 (point pairs) at L = 100. From points themselves it is 5e-15: take radii and centres from them.

    Raises DegenerateError for zero, for a mixture of grades, for what is no blade, for imaginary rounds (squared radius below zero), for
    radius zero, for elements at infinity and flat points, and for another kind than the one named; UnknownNameError for its name.
    """
    if kind is not None and kind not in Element.kinds:
        raise UnknownNameError("kind of element", kind, Element.kinds)
    largest = np.abs(x.coefficients).max(axis=-1, initial=0.0)
    _complain(largest == 0.0, "zero")
    scaled = x.coefficients / largest[..., None]
    grade = _grade(x.blades, scaled)
    kept = [k for k, name in enumerate(x.blades) if _grade_of(name) == grade]
    part = Multivector(scaled[..., kept], [x.blades[k] for k in kept])
    order = np.array([_order(name) for name in part.blades])
    sizes = [norm(part.coefficients[..., order == k]) for k in range(3)]
    flat = np.asarray(sizes[0] * REACH <= sizes[1])
    if flat.any() and not flat.all():
        raise DegenerateError(f"multivector: flat and round elements in one batch, the first flat one at index {_first(flat)}")
    found = _FLAT[grade](part) if flat.any() else _round(grade, part, order, sizes)
    if kind is not None and found[0].kind != kind:
        raise DegenerateError(f"{kind.replace('_', ' ')}: the multivector is a {found[0].name}{_FLATTENED.get((kind, found[0].kind), '')}")
    return found[0], np.asarray(largest * found[1])


def _grade(blades: tuple[str, ...], scaled: Array) -> int:
    """The one grade of all rows."""
    grades = np.array([_grade_of(name) for name in blades])
    present = [k for k in range(6) if (np.abs(scaled[..., grades == k]) > MIXED).any()] or sorted({*grades.tolist()})  # of an empty batch
    if len(present) > 1:
        raise DegenerateError(f"multivector: grades {', '.join(map(str, present))} are mixed; an element has one grade")
    if present[0] not in _FLAT:
        raise DegenerateError(f"multivector: grade {present[0]} given; elements have grades 1 to 4")
    return present[0]


def _grade_of(blade: str) -> int:
    return 0 if blade == "1" else len(blade) - 1


def _order(blade: str) -> int:
    """0 with e0, 2 with ei, 1 with both or neither: the power of a length that a coefficient is."""
    return 1 - ("0" in blade) + ("i" in blade)


def _round(grade: int, part: Multivector, order: Array, sizes: list[Array]) -> Read:
    with np.errstate(over="ignore"):
        length = np.maximum(sizes[1] / sizes[0], np.sqrt(sizes[2] / sizes[0]))
    _complain(~(length <= FARTHEST), "its centre or its radius is too large to be read")
    length = np.where(length == 0.0, 1.0, length)
    y = Multivector(part.coefficients / (sizes[0][..., None] * length[..., None] ** order), part.blades)
    bivector = y.dual() if grade == 3 else y
    if grade in (2, 3):
        outer = np.abs(product(bivector, bivector, "outer").coefficients).max(axis=-1, initial=0.0)
        _complain(outer > NO_BLADE, "no blade: it is not the outer product of points (a sum of several elements)")
    element, sign = _ROUND[grade](y, length)
    return element, sign * sizes[0]


def _point(y: Multivector, length: Array) -> Read:
    v = stack(y["e1"], y["e2"], y["e3"])
    _complain(np.abs(dot(v, v) - 2.0 * y["e0"] * y["ei"]) > NO_BLADE, "a vector that is not null: the dual of a sphere or of a plane")
    return Point(times(length / y["e0"], v)), y["e0"]


def _point_pair(y: Multivector, length: Array) -> Read:
    d, g = stack(y["e01"], y["e02"], y["e03"]), stack(y["e1i"], y["e2i"], y["e3i"])
    m, rise = stack(y["e23"], -y["e13"], y["e12"]), y["e0i"]
    radius = _radius(rise * rise - dot(m, m) - 2.0 * dot(d, g))
    center = times(rise, d) + np.cross(d, m)
    ends = [times(length, center + times(sign * radius, d)) for sign in (-1.0, 1.0)]
    return PointPair.from_points(*ends), np.ones_like(radius)


def _circle(y: Multivector, length: Array) -> Read:
    n, w = stack(y["e023"], -y["e013"], y["e012"]), stack(y["e01i"], y["e02i"], y["e03i"])
    m, height = stack(y["e23i"], -y["e13i"], y["e12i"]), y["e123"]
    radius = _radius(2.0 * dot(n, m) - height * height + dot(w, w))
    center = times(height, n) + np.cross(n, w)
    return Circle(times(length, center), n, length * radius), np.ones_like(radius)


def _sphere(y: Multivector, length: Array) -> Read:
    sign = y["e0123"]
    center = times(sign, stack(y["e023i"], -y["e013i"], y["e012i"]))
    radius = _radius(dot(center, center) - 2.0 * sign * y["e123i"])
    return Sphere(times(length, center), length * radius), sign


def _radius(square: Array) -> Array:
    """Of a squared radius in units of l^2."""
    _complain(
        np.abs(square) <= NO_RADIUS, "its radius is zero, as far as its coefficients tell: two elements that touch, or too small a one"
    )
    _complain(square < 0.0, "imaginary: its squared radius is negative, it holds no real point")
    return np.sqrt(square)


def _line(x: Multivector) -> Read:
    d, m = stack(x["e01i"], x["e02i"], x["e03i"]), stack(x["e23i"], -x["e13i"], x["e12i"])
    size, moment = norm(d), norm(m)
    _complain(size * NEAR <= moment, _BEYOND)
    _complain(np.abs(x["e123"]) > PITCH * size, "no blade: a part e123 beside a direction")
    pitch = np.abs(dot(d, m)) / size
    _complain(pitch > PITCH * (moment + size), "no blade: its moment is not square to its direction (a sum of several lines)")
    return Line(times(1.0 / size**2, np.cross(d, m)), times(1.0 / size, d)), size


def _plane(x: Multivector) -> Read:
    normal = stack(x["e023i"], -x["e013i"], x["e012i"])
    size = norm(normal)
    _complain(size * NEAR <= np.abs(x["e123i"]), _BEYOND)
    return Plane(times(1.0 / size, normal), x["e123i"] / size), size


def _no_element(x: Multivector) -> Read:
    raise DegenerateError(f"multivector: {_BEYOND}, or is a flat point (a point joined with infinity)")


def _first(rows: Rows) -> tuple[int, ...]:
    return tuple(int(k) for k in np.argwhere(rows)[0])


def _complain(rows: Array | Rows, what: str) -> None:
    """DegenerateError where any row has the fault."""
    if np.any(rows):
        raise DegenerateError(f"multivector: {what}{f', at index {_first(np.asarray(rows))}' if np.ndim(rows) else ''}")


_BEYOND = f"lies at infinity, or farther than {REACH:.0e} m (a flat element: {NEAR:.0e} m) from the origin"
_ROUND: dict[int, Callable[[Multivector, Array], Read]] = {1: _point, 2: _point_pair, 3: _circle, 4: _sphere}
_FLAT: dict[int, Callable[[Multivector], Read]] = {1: _no_element, 2: _no_element, 3: _line, 4: _plane}
_FLATTENED = {("circle", "line"): ", its radius is infinite", ("sphere", "plane"): ", its radius is infinite"}
