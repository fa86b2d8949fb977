"""Which rotor takes one direction to another: two charts, since no one choice is continuous for all directions (similarity.md, section 5).

Chart +1 is the shortest arc from a to n, R = h a with h = (a + n) / |a + n|; it fails at n = -a, its pole. Chart -1 turns by pi about a
fixed axis square to a first, which brings a to -a (the rotor F), and takes the shortest arc from there: R = h (-a) F with
h = (n - a) / |n - a|; its pole is n = a. Both take a to n; they differ by a turn about n, which no element along n sees. In a control loop
the chart is state: `chart_of` tells when to change it, and V jumps there, X does not.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import Array, dot, norm, one_batch, parts, read, stack, times, unit
from cga_runtime.elements.element import Element
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import PointPair
from cga_runtime.elements.rounds import Circle
from cga_runtime.errors import DegenerateError, UnknownNameError
from cga_runtime.kernels import products

Charts = NDArray[np.int64]

SEAM = -0.995
"""chart=None is the shortest arc, paper A's, down to this cosine of the angle between a and n (174 degrees), and chart -1 beyond. The
recommended seam for control, where the gauge spin 2 / (pi - angle) of the shortest arc matters, is -0.5: `chart_of`."""
RECOMMENDED = -0.5
"""Cosine at which `chart_of` changes charts without a previous one."""
KEPT = -0.9
"""Cosine to the pole's opposite down to which `chart_of` keeps the previous chart: 154 degrees."""
POLE = 1e-9
"""Smallest angle (rad) from the pole of a chart asked for. R takes a to n to 1e-15 there too, but
its turn about n is known to 1e-16 / angle only."""

REFERENCE: dict[str, tuple[float, float, float]] = {
    "point_pair": (0.0, 1.0, 0.0),
    "line": (0.0, 1.0, 0.0),
    "circle": (0.0, 0.0, 1.0),
    "plane": (0.0, 0.0, 1.0),
}
"""Direction a of the unit primitives that have one: e2 of point pair and line, e3 of circle and plane."""
TURN_AXIS = (1.0, 0.0, 0.0)
"""Axis e1 of the half turn of chart -1, square to all reference directions."""


def direction_of(x: Element) -> Array:
    """The direction n of an element with one, (..., 3): of a point pair or line, or the normal of a circle or plane."""
    match x:
        case PointPair() | Line():
            return x.direction
        case Circle() | Plane():
            return x.normal
    raise UnknownNameError("kind of element with a direction", x.kind, REFERENCE)


def chart_of(x: Element, previous: int | Charts | None = None) -> Charts:
    """The recommended chart of an element, +1 or -1, (...).

    +1 where a.n >= -0.5, else -1. With the chart `previous` (...) of the last call that one is kept as long as previous (a.n) > -0.9, so
    that directions near the seam do not make it flicker. +1, or the previous one, for points and spheres, which need none. Raises
    UnknownNameError for what is no element, and for charts other than +1 and -1; WrongSizeError.
    """
    if not isinstance(x, Element):
        raise UnknownNameError("kind of element", type(x).__name__, Element.kinds)
    ahead = dot(np.array(REFERENCE[x.kind]), direction_of(x)) if x.kind in REFERENCE else np.ones(x.batch)
    if previous is None:
        return np.where(ahead >= RECOMMENDED, 1, -1)
    last = read_chart(previous)
    one_batch("chart", last.shape, ahead.shape)
    keeps = last * ahead > KEPT if x.kind in REFERENCE else np.ones_like(ahead, dtype=np.bool_)
    return np.where(keeps, last, -last)


def read_chart(chart: int | ArrayLike) -> Charts:
    """+1 and -1, (...)."""
    given = read(chart, "chart")
    wrong = given[np.abs(given) != 1.0]
    if wrong.size:
        raise UnknownNameError("chart", float(wrong.flat[0]), (1, -1))
    return given.astype(np.int64)


def rotor_between(a: Array, n: Array, axis: Array, chart: int | ArrayLike | None, what: str) -> Array:
    """Components 1 e12 e13 e23 (..., 4) of the rotor that takes a unit vector a to n, both (..., 3), in a chart.

    axis: that of the half turn of chart -1, a unit vector square to a. Raises DegenerateError within POLE of the pole of a chart asked for.
    """
    charts = np.where(dot(a, n) < SEAM, -1, 1) if chart is None else read_chart(chart)
    one_batch("chart", charts.shape, np.broadcast_shapes(a.shape, n.shape)[:-1])
    start = times(charts.astype(np.float64), a)
    h = _halfway(start, n, what, charts)
    scalar, (x, y, z) = dot(h, start), parts(np.cross(h, start))
    arc = stack(scalar, z, -y, x)
    x, y, z = parts(axis)
    turned = stack(*products().rotor_rotor(parts(arc), (np.zeros_like(x), -z, y, -x)))
    return np.where((charts < 0)[..., None], turned, arc)


def _halfway(a: Array, n: Array, what: str, charts: Charts) -> Array:
    """(a + n) / |a + n|; where they are nearly opposite a + n = u + |u|^2 / (1 - a.n) a, u the part of n square to a, loses no digits."""
    ahead = dot(a, n)
    u = np.cross(np.cross(a, n), a)
    h = np.where((ahead < 0.0)[..., None], u + times(dot(u, u) / (1.0 - np.minimum(ahead, 0.0)), a), a + n)
    pole = norm(h) <= POLE
    if pole.any():
        chart = np.broadcast_to(charts, pole.shape)[pole].flat[0]
        raise DegenerateError(
            f"{what}: chart {chart:+d} has no rotor at its pole (within {POLE:.0e} rad); take chart {-chart:+d} there, or None"
        )
    return unit(h, what)
