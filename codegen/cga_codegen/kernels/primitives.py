"""Primitives of one to four points: outer product (paper A, 14-17), centre, direction and radius, and how near to degenerate they are.

Centre, direction and radius come from the points and their differences, never back from the coefficients, where they lose digits as a power
of distance over size (paper A, eqs. 24, 25, 27, replaced; similarity.md, section 3). With the points x1 ... xk, a = x2 - x1, b = x3 - x1,
d = x4 - x1:

    point        c = x1
    point pair   n = a/|a|            c = (x1 + x2)/2               r = |a|/2
    line         n = a/|a|            c = x1 - n (n.x1)             the foot of the origin
    circle       N = a x b, n = N/|N| c = x1 + y                    r = |y|, y = ((a.a) b - (b.b) a) x N / (2 N.N)
    plane        n as of the circle   c = n (n.x1)                  the foot of the origin
    sphere                            c = x1 + y                    r = |y|, [a; b; d] y = [a.a, b.b, d.d]/2
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import casadi

from cga_codegen.algebra.blade_types import CIRCLE, LINE, PLANE, POINT, POINT_PAIR, SPHERE, BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.vectors import Axes, Scalar, Vector, combine, cross, dot, minus, plus, times

Axis = Literal["e2", "e3"]
Points = Sequence[Vector]


@dataclass(frozen=True)
class Kind:
    """A primitive: its number of points, blades, reference direction (none for point and sphere), whether it has a radius, and the
    bivectors of its own frame that move it (paper A, table 1, as a dimension)."""

    name: str
    count: int
    type: BladeType
    axis: Axis | None
    round: bool
    controllable: tuple[str, ...]


_MOVES = ("e1i", "e2i", "e3i")
KINDS = {
    kind.name: kind
    for kind in (
        Kind("point", 1, POINT, None, False, _MOVES),
        Kind("point_pair", 2, POINT_PAIR, "e2", True, ("e12", "e23", "e0i", *_MOVES)),
        Kind("line", 2, LINE, "e2", False, ("e12", "e23", "e1i", "e3i")),
        Kind("circle", 3, CIRCLE, "e3", True, ("e13", "e23", "e0i", *_MOVES)),
        Kind("plane", 3, PLANE, "e3", False, ("e13", "e23", "e3i")),
        Kind("sphere", 4, SPHERE, None, True, ("e0i", *_MOVES)),
    )
}
"""The six primitives of one to four points."""

NOTHING, BARELY = 1e-300, 1e-200
"""Added to squares that may be zero under a root, and under a fraction, so that measures of degeneracy and their gradients are total.
No sum of squares of lengths above 1e-30 m notices."""


@dataclass(frozen=True)
class Frame:
    """Where a primitive stands: centre (of flat ones the foot of the origin), unit direction, radius; None where it has none.

    edges: from x1 to the other points. arm: from x1 to the centre of circle and sphere, not by way of the centre's coordinates.
    """

    centre: list[Scalar]
    direction: list[Scalar] | None
    radius: Scalar | None
    edges: Axes
    arm: list[Scalar] | None = None


def split(points: Vector) -> list[list[Scalar]]:
    """Row-major (k, 3) as vectors."""
    return [[points[3 * k + i] for i in range(3)] for k in range(len(points) // 3)]


def _root(x: Scalar) -> Scalar:
    return casadi.sqrt(x)


def _unit(v: Vector) -> tuple[list[Scalar], Scalar]:
    """v/|v| and |v|."""
    length = _root(dot(v, v))
    return [x / length for x in v], length


def _arm(edges: Points) -> list[Scalar]:
    """y = centre - x1 of circle and sphere."""
    normal = cross(edges[0], edges[1])
    if len(edges) == 2:
        a, b = edges
        return [x / (2 * dot(normal, normal)) for x in cross(minus(times(dot(a, a), b), times(dot(b, b), a)), normal)]
    u, v, w = edges
    right, whole = [0.5 * dot(e, e) for e in edges], dot(normal, w)
    return [x / whole for x in combine([cross(v, w), cross(w, u), normal], right)]  # Cramer's rule


def frame(kind: Kind, x: Points) -> Frame:
    """Centre, direction, radius and edges of the primitive through the points x."""
    edges = [minus(other, x[0]) for other in x[1:]]
    normal = None if kind.axis is None else edges[0] if kind.count == 2 else cross(edges[0], edges[1])
    direction, length = (None, 1) if normal is None else _unit(normal)
    match kind.name:
        case "point":
            return Frame(list(x[0]), direction, None, edges)
        case "point_pair":
            return Frame([0.5 * (p + q) for p, q in zip(*x, strict=True)], direction, 0.5 * length, edges)
        case "line":
            assert direction is not None
            return Frame(minus(x[0], times(dot(direction, x[0]), direction)), direction, None, edges)
        case "plane":
            assert direction is not None
            return Frame(times(dot(direction, x[0]), direction), direction, None, edges)
        case _:
            arm = _arm(edges)
            return Frame(plus(x[0], arm), direction, _root(dot(arm, arm)), edges, arm)


def by_rows(columns: Sequence[Sequence[Scalar]]) -> list[Scalar]:
    """Row-major entries of the matrix with these columns."""
    return [column[i] for i in range(len(columns[0])) for column in columns]


_INFINITY = Multivector.from_blades(POINT, ei=1)


def _wedge(kind: Kind, factors: Sequence[Multivector]) -> Multivector:
    whole = factors[0]
    for factor in factors[1:]:
        whole = whole ^ factor
    return (whole if kind.round or kind.count == 1 else whole ^ _INFINITY).project(kind.type)


def _point(x: Vector) -> Multivector:
    return Multivector(POINT, [1, *x, 0.5 * dot(x, x)])


def primitive(kind: Kind, points: Vector) -> list[Scalar]:
    """The primitive X = P1 ^ ... ^ Pk, of line and plane ^ ei, P = e0 + x + x^2/2 ei: its size is the weight (paper A, eq. 14)."""
    return list(_wedge(kind, [_point(x) for x in split(points)]).coefficients)


def primitive_jacobian(kind: Kind, points: Vector) -> list[Scalar]:
    """Derivative of the primitive by the points: one factor after the other is replaced by its derivative (paper A, eqs. 15-17)."""
    x = split(points)
    columns = []
    for k in range(kind.count):
        for i in range(3):
            moved = Multivector(POINT, [0, *(int(j == i) for j in range(3)), x[k][i]])
            columns.append(_wedge(kind, [moved if j == k else _point(y) for j, y in enumerate(x)]).coefficients)
    return by_rows(columns)


def degeneracy(kind: Kind, points: Vector) -> list[Scalar]:
    """How far a primitive is from degenerate: |a| (m) of two points, the sine |a x b|/(|a||b|) of three, |det[a, b, d]|/(|a||b||d|) of
    four; 1 for a point (paper A, section 5.3; similarity.md, section 8). Total: 0 where points coincide."""
    first, *others = split(points)
    edges = [minus(other, first) for other in others]
    if not edges:
        return [1.0 + 0 * points[0]]
    if len(edges) == 1:
        return [_root(dot(edges[0], edges[0]) + NOTHING)]
    normal = cross(edges[0], edges[1])
    volume = dot(normal, edges[-1])
    top = dot(normal, normal) if len(edges) == 2 else volume * volume
    below: Scalar = 1
    for edge in edges:
        below = below * dot(edge, edge)
    return [_root(top + NOTHING) / _root(below + BARELY)]


def guard(kind: Kind, points: Vector) -> list[Scalar]:
    """What is looked at before the rest is trusted. Total.

    `degeneracy`; cosine and squared sine between direction and reference direction (without one 0 and 1); the sum of the squares of the
    points (m^2); the squared distances of all pairs of points (m^2).
    """
    x = split(points)
    reach: Scalar = 0
    for point in x:
        reach = reach + dot(point, point)
    pairs = [minus(other, one) for k, other in enumerate(x) for one in x[:k]]
    cosine: Scalar = 0
    sine: Scalar = 1
    if kind.axis is not None:
        edges = [minus(other, x[0]) for other in x[1:]]
        normal = edges[0] if kind.count == 2 else cross(edges[0], edges[1])
        along = ("e1", "e2", "e3").index(kind.axis)
        square = dot(normal, normal) + NOTHING
        cosine = normal[along] / _root(square)
        sine = sum((y * y for k, y in enumerate(normal) if k != along), 0) / square
    return [*degeneracy(kind, points), cosine, sine, reach, *(dot(pair, pair) for pair in pairs)]


def degeneracy_gradient(kind: Kind, points: Vector) -> list[Scalar]:
    """Derivative of `degeneracy` by the points."""
    value = casadi.vertcat(*degeneracy(kind, points))
    entries: list[Scalar] = casadi.densify(casadi.gradient(value, casadi.vertcat(*points))).elements()
    return entries
