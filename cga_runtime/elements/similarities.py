"""The similarity that takes one element to another of its kind, and the way from one to the other (paper A, section 3.3 and Figure 4).

There is no unique one; the gauge here is the translator of the foot or centre, the rotor of the direction in one of two charts (charts.py),
and the dilator of the radius (similarity.md, section 5, where equations 21-27 of the paper are corrected):

    V_S(X_u, X) = T(c) R(a -> n) D(r),   X_u the unit primitive with direction a; R = 1 for point and sphere, D = 1 for point, line, plane.

V X_u ~V = X for the unit primitives that `Element.coefficients` are. Spheres are taken without orientation.
"""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, one_batch, read, stack, times
from cga_runtime.elements.charts import REFERENCE, TURN_AXIS, direction_of, read_chart, rotor_between
from cga_runtime.elements.element import Element, rotated
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import Point, PointPair
from cga_runtime.elements.rounds import Circle, Sphere
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.versors import Rotor, Similarity

E = TypeVar("E", bound=Element)

GAUGES = ("direct", "composed")
UNIT: dict[str, Element] = {
    "point": Point(np.zeros(3)),
    "point_pair": PointPair.from_points((0.0, -1.0, 0.0), (0.0, 1.0, 0.0)),
    "line": Line.from_point_direction(np.zeros(3), (0.0, 1.0, 0.0)),
    "circle": Circle(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array(1.0)),
    "plane": Plane.from_normal_offset((0.0, 0.0, 1.0), 0.0),
    "sphere": Sphere.from_center_radius(np.zeros(3), 1.0),
}
CONTROLLABLE: dict[str, tuple[str, ...]] = {
    "point": ("e1i", "e2i", "e3i"),
    "point_pair": ("e12", "e23", "e0i", "e1i", "e2i", "e3i"),
    "line": ("e12", "e23", "e1i", "e3i"),
    "circle": ("e13", "e23", "e0i", "e1i", "e2i", "e3i"),
    "plane": ("e13", "e23", "e3i"),
    "sphere": ("e0i", "e1i", "e2i", "e3i"),
}
"""Bivectors that move the unit primitive of a kind (paper A, table 1); the others of a similarity's seven leave it where it is."""


def unit_primitive(kind: str) -> Element:
    """X_u of a kind: e0, e02 - e2i/2, e02i, e012 + e12i/2, e012i, e0123 - e123i/2 (paper A, table 1; similarity.md, section 2).

    That is: the origin, the points -e2 and +e2, the axis of e2, the unit circle with normal e3, the plane of e1 and e2, the unit sphere.
    Raises UnknownNameError.
    """
    if kind not in UNIT:
        raise UnknownNameError("kind of element", kind, UNIT)
    return UNIT[kind]


def similarity_of(x: Element, chart: int | ArrayLike | None = None) -> Similarity:
    """V_S(X_u, X) = T(c) R(a -> n) D(r) (paper A, eq. 28), batch shape of x and chart.

    chart: +1 the shortest arc, -1 the other chart (see charts.py), an integer or integers (...); None takes the shortest arc unless
    a.n < SEAM = -0.995. Points and spheres take any. Raises DegenerateError within 1e-9 rad of the pole of a chart asked for,
    UnknownNameError for what is no element or chart, WrongSizeError.
    """
    center, rotor, radius = _frame(x, chart)
    return Similarity.from_parts(center, Rotor(rotor), radius)


def similarity_between(x1: E, x2: E, gauge: str = "direct", chart: int | ArrayLike | None = None) -> Similarity:
    """A similarity V with V X1 ~V = X2 for two elements of one kind (paper A, eq. 20), batch dimensions broadcast.

    "direct": R = R(n1 -> n2), d = r2 / r1, t = c2 - d R c1, singular only where n1 and n2 are opposite. Chart +1 is the shortest arc from
    n1 to n2; chart -1 first turns by pi about R1 e1, with R1 the rotor of `similarity_of(x1)`. "composed": V_S(X_u, X2) ~V_S(X_u, X1), both
    in the chart given. chart=None: as in `similarity_of`, with n1.n2 for the direct gauge.

    Raises WrongSizeError for two kinds and for batches that do not broadcast, UnknownNameError for the gauge and for what is no element or
    chart, DegenerateError at the pole of a chart asked for.
    """
    _one_kind(x1, x2)
    if gauge not in GAUGES:
        raise UnknownNameError("gauge", gauge, GAUGES)
    composed = gauge == "composed"
    (c1, rotor1, r1), (c2, rotor2, r2) = (_frame(x, chart if composed else None) for x in (x1, x2))
    rotor = Rotor(rotor2) * ~Rotor(rotor1) if composed else _direct_rotor(x1, x2, rotor1, chart)
    d = r2 / r1
    return Similarity.from_parts(c2 - times(d, rotated(rotor.matrix(), c1)), rotor, d)


def interpolate(x1: E, x2: E, s: ArrayLike, chart: str = "split") -> E:
    """V1 exp(s log V_e) X_u: the element at s (...) on the way from x1 (s = 0) to x2 (s = 1) (paper A, Figure 4).

    V1 = V_S(X_u, X1), V_e = ~V1 V12 V1 with the direct similarity V12: the way in the frame of X1. chart "split": the centre (of a flat
    element, the foot of x1 carried along) moves straight, the direction on the shortest arc, the radius as r1^(1-s) r2^s. "lie": one motion
    with constant twist, a screw, or a spiral where the radius changes. s outside [0, 1] goes on beyond. The dimensions of s and the batches
    of x1 and x2 broadcast.

    Raises WrongSizeError for two kinds, UnknownNameError for the chart, NotFiniteError, DegenerateError where it leaves the floats.
    """
    _one_kind(x1, x2)
    steps = read(s, "s")
    one_batch("interpolate", x1.batch, x2.batch, steps.shape)
    (c1, rotor1, r1), (c2, _, r2) = _frame(x1), _frame(x2)
    start = Rotor(rotor1)
    turn = ~start * _direct_rotor(x1, x2, rotor1, None) * start
    ahead = times(1.0 / r1, rotated((~start).matrix(), c2 - c1))
    way = Similarity.from_parts(ahead, turn, r2 / r1).log(chart)
    with np.errstate(over="ignore"):
        part = Similarity.exp(times(steps, way), chart)
    # the product V1 exp(s log V_e) by its factors: its twelve components lose the smaller of two very different scales
    center = c1 + times(r1, rotated(start.matrix(), part.translation()))
    whole = Similarity.from_parts(center, start * part.rotation(), r1 * part.scale())
    moved: E = UNIT[x1.kind].transformed(whole)  # type: ignore[assignment]  # the unit primitive is of the kind of x1
    return moved


def _frame(x: Element, chart: int | ArrayLike | None = None) -> tuple[Array, Array, Array]:
    """c (..., 3), the components (..., 4) of R, and r (...) of V_S(X_u, X)."""
    if not isinstance(x, Element):
        raise UnknownNameError("kind of element", type(x).__name__, Element.kinds)
    radius = np.asarray(getattr(x, "radius", np.ones(x.batch)))
    if x.kind in REFERENCE:
        rotor = rotor_between(np.array(REFERENCE[x.kind]), direction_of(x), np.array(TURN_AXIS), chart, x.name)
    else:
        charts = np.ones(()) if chart is None else read_chart(chart)
        rotor = stack(np.ones(one_batch("chart", x.batch, charts.shape)), 0.0, 0.0, 0.0)
    return x.center, rotor, radius


def _direct_rotor(x1: Element, x2: Element, rotor1: Array, chart: int | ArrayLike | None) -> Rotor:
    if x1.kind not in REFERENCE:
        return Rotor(_frame(x1, chart)[1])
    axis = rotated(Rotor(rotor1).matrix(), np.array(TURN_AXIS))
    return Rotor(rotor_between(direction_of(x1), direction_of(x2), axis, chart, f"two {x1.name}s"))


def _one_kind(x1: Element, x2: Element) -> None:
    for x in (x1, x2):
        if not isinstance(x, Element):
            raise UnknownNameError("kind of element", type(x).__name__, Element.kinds)
    if x1.kind != x2.kind:
        raise WrongSizeError(f"a {x1.name} and a {x2.name} given; a similarity takes an element to one of its own kind only")
    one_batch(f"two {x1.name}s", x1.batch, x2.batch)
