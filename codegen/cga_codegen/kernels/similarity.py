"""The similarity of a primitive, V = T(c) R(a -> n) D(r), and its Jacobians, from points (paper A, sections 3.3 and 3.4).

V carries the unit primitive of its kind (direction a = e2 or e3, centre at the origin, radius 1) to the primitive through the points. The
gauge is "translator of the centre, shortest arc, dilator of the radius" (similarity.md, section 5). Two charts, input `chart` = +1 or -1:
the arc leads from a; or from -a, after half a turn about e1. Each is singular only where n is opposite to where its arc begins.

Body Jacobians need no versor products. They are, with om = n x dn + 2 n ((n x a).dn)/|a + n|^2 (similarity.md, section 6),

    rows e23, e13, e12 = (+, -, +) components of R^T om;  e0i = -d log r;  e1i, e2i, e3i = R^T dc / r

The horizontal one leaves out the turn about n, which moves nothing, and all rows outside the controllable blades. Here its rows come from
the points at once, in the primitive's frame: the twist that moves the primitive as its points move across it (see `_horizontal`); that
takes a quarter of the operations of dn, dc and d log r. The rotor is R = h a with h = (a + n)/|a + n|, in a form that
loses nothing near the antipode, where (1 + n a) normalised (paper A, eq. 26) loses eps/delta^2 at the angle delta from it.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi

from cga_codegen.algebra.blade_types import SIMILARITY, SIMILARITY_BIVECTOR
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.primitives import Frame, Kind, Points, by_rows, frame, split
from cga_codegen.kernels.vectors import Axes, Scalar, Vector, cross, dot, plus, times


@dataclass(frozen=True)
class Standing:
    """A primitive's frame, its rotor (1 e12 e13 e23), the columns of its rotation, where the arc of its chart begins (a), and |a + n|^2."""

    frame: Frame
    rotor: list[Scalar]
    axes: Axes
    pole: list[Scalar]
    square: Scalar

    @property
    def size(self) -> Scalar:
        """Radius; 1 of flat ones."""
        return 1 if self.frame.radius is None else self.frame.radius


def _axes(rotor: Vector) -> Axes:
    """Columns of the rotation matrix of a rotor."""
    w, x, y, z = rotor[0], -rotor[3], rotor[2], -rotor[1]
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
        [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
        [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ]


def stand(kind: Kind, points: Vector, chart: Vector) -> Standing:
    """Frame and rotor in the chart +1 or -1."""
    at = frame(kind, split(points))
    if kind.axis is None or at.direction is None:
        return Standing(at, [1, 0, 0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0], 2)
    sense = chart[0]
    pole = [sense if name == kind.axis else 0 for name in ("e1", "e2", "e3")]
    # a + n = u + (1 + a.n) a with u square to a; 1 + a.n = ((1 + a.n)^2 + u^2)/2 loses nothing near the pole, |a + n|^2 = 2 (1 + a.n)
    along = ("e1", "e2", "e3").index(kind.axis)
    rise = 1 + sense * at.direction[along]
    across = [0 if k == along else x for k, x in enumerate(at.direction)]
    rise = 0.5 * (rise * rise + dot(across, across))
    length = casadi.sqrt(2 * rise)
    h = [(sense * rise if k == along else x) / length for k, x in enumerate(at.direction)]
    # h times the pole, in components 1 e12 e13 e23
    arc = times(sense, [h[1], h[0], 0, -h[2]] if kind.axis == "e2" else [h[2], 0, h[0], h[1]])
    turned = [arc[3], arc[2], -arc[1], -arc[0]]  # arc times -e23, the half turn about e1
    first, second = 0.5 * (1 + sense), 0.5 * (1 - sense)
    rotor = plus(times(first, arc), times(second, turned))
    return Standing(at, rotor, _axes(rotor), pole, 2 * rise)


def _packed(rotor: Vector, t: Vector, size: Scalar) -> list[Scalar]:
    """Components of T(t) R D(size), 1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i (similarity.md, section 4)."""
    root = casadi.sqrt(size) if not isinstance(size, int) else 1
    grown, shrunk = (root, 1 / root) if not isinstance(size, int) else (1, 1)
    even = times(0.5 * (grown + shrunk), rotor) if not isinstance(size, int) else list(rotor)
    odd = times(0.5 * (grown - shrunk), rotor) if not isinstance(size, int) else [0, 0, 0, 0]
    a, b12, b13, b23 = times(-0.5 * shrunk, rotor)
    x, y, z = t
    e1i, e2i, e3i = a * x - b12 * y - b13 * z, a * y + b12 * x - b23 * z, a * z + b13 * x + b23 * y
    return [*even, odd[0], e1i, e2i, odd[1], e3i, odd[2], odd[3], b12 * z - b13 * y + b23 * x]


def similarity(kind: Kind, points: Vector, chart: Vector) -> list[Scalar]:
    """V with V X_u ~V = X over its weight (paper A, eq. 28)."""
    at = stand(kind, points, chart)
    return _packed(at.rotor, at.frame.centre, at.size)


def parts(kind: Kind, points: Vector, chart: Vector) -> list[Scalar]:
    """The factors of V: rotor 1 e12 e13 e23, centre (m), radius (m; 1 of flat ones)."""
    at = stand(kind, points, chart)
    return [*at.rotor, *at.frame.centre, at.size]


Rows = dict[str, Axes]
"""Rows of a Jacobian by the points: for each blade and each point the vector whose product with the point's motion counts."""


def _shares(edges: Axes, first: Vector) -> list[list[Scalar]]:
    """For each point i the share s_i of its height h_i in the affine function through all heights: h(x) = (sum_i h_i s_i).(x, 1).

    edges: from the first point to the others, and `first` that point, in two or three coordinates.
    """
    if len(edges) == 2:
        (p, q), (u, v) = edges
        whole = p * v - q * u
        others = [[v / whole, -u / whole], [-q / whole, p / whole]]
    else:
        across = [cross(edges[1], edges[2]), cross(edges[2], edges[0]), cross(edges[0], edges[1])]
        whole = dot(across[2], edges[2])
        others = [[x / whole for x in row] for row in across]
    own = [-sum(column[1:], column[0]) for column in zip(*others, strict=True)]
    slopes = [own, *others]
    return [[*slope, int(i == 0) - dot(slope, first)] for i, slope in enumerate(slopes)]


def _horizontal(kind: Kind, at: Standing, x: Points) -> Rows:
    """Rows of the controllable blades: the twist, in the primitive's frame and in units of its radius, that moves it as its points move.

    A point's motion along the primitive does not count; across it must be that of the twist there. A circle has two such directions at
    each point, along its normal and its radius: two affine functions over its plane, which share one matrix.
    """
    if kind.name == "point":
        return {f"e{k + 1}i": [axis] for k, axis in enumerate(at.axes)}
    e1, e2, e3 = at.axes
    edges, r = at.frame.edges, at.frame.radius
    if kind.name == "point_pair":
        one, two, three = ([y / (2 * r) for y in axis] for axis in (e1, e2, e3))  # type: ignore[operator]
        moves = {f"e{k + 1}i": [axis, axis] for k, axis in enumerate((one, two, three))}
        turns = {"e12": [one, _negative(one)], "e23": [_negative(three), three]}
        return turns | {"e0i": [two, _negative(two)]} | moves
    if kind.name == "line":
        length = dot(e2, edges[0])
        one, three = ([y / length for y in axis] for axis in (e1, e3))
        before = dot(e2, x[0])
        after = before + length
        moves = {name: [times(after, axis), times(-before, axis)] for name, axis in (("e1i", one), ("e3i", three))}
        return {"e12": [one, _negative(one)], "e23": [_negative(three), three]} | moves
    if kind.name == "plane":
        flat = [[dot(e1, edge), dot(e2, edge)] for edge in edges]
        heights = _shares(flat, [dot(e1, x[0]), dot(e2, x[0])])
        return {name: [times(share[k], e3) for share in heights] for k, name in enumerate(("e13", "e23", "e3i"))}
    assert at.frame.arm is not None and r is not None
    outward = [[-y / r for y in at.frame.arm], *([(d - y) / r for d, y in zip(edge, at.frame.arm, strict=True)] for edge in edges)]
    if kind.name == "sphere":
        shares = [[y / r for y in share] for share in _shares([[y / r for y in edge] for edge in edges], outward[0])]
        names = ("e1i", "e2i", "e3i", "e0i")
        return {name: _along(outward, shares, k) for k, name in enumerate(names)}
    flat = [[dot(e1, edge) / r, dot(e2, edge) / r] for edge in edges]
    shares = [[y / r for y in share] for share in _shares(flat, [dot(e1, outward[0]), dot(e2, outward[0])])]
    turns = {name: [times(share[k], e3) for share in shares] for k, name in enumerate(("e13", "e23", "e3i"))}
    return turns | {name: _along(outward, shares, k) for k, name in enumerate(("e1i", "e2i", "e0i"))}


def _along(outward: Axes, shares: Axes, k: int) -> Axes:
    """Rows along the radii; the last share is the growth of the radius, and e0i = -d log r."""
    sign = -1 if k == len(shares[0]) - 1 else 1
    return [times(sign * share[k], u) for share, u in zip(shares, outward, strict=True)]


def _negative(v: Vector) -> list[Scalar]:
    return [-x for x in v]


def _spun(kind: Kind, at: Standing, rows: Rows) -> Rows:
    """The other rows of the body Jacobian, which depend on the gauge: the turn about n, and how a foot moves along its flat."""
    n = at.frame.direction
    if n is None:
        return rows
    square = at.square
    pole, foot = ([dot(axis, v) for axis in at.axes] for v in (at.pole, at.frame.centre))
    # om.n = -2 om.a / |a + n|^2, where om is the turn across n
    first, second = ("e12", "e23") if kind.axis == "e2" else ("e13", "e23")
    turning = {"e12": (pole[2], 1), "e13": (-pole[1], -1), "e23": (pole[0], 1)}
    spin = "e13" if kind.axis == "e2" else "e12"
    sign = turning[spin][1]
    more = {spin: _sums(rows, {first: -2 * sign * turning[first][0] / square, second: -2 * sign * turning[second][0] / square})}
    if kind.name == "line":  # c.n = 0, so that dc.n = -c.dn with dn = om x n
        more["e2i"] = _sums(rows, {"e12": foot[0], "e23": -foot[2]})
    if kind.name == "plane":  # c = n (n.c), so that dc across n is (n.c) dn
        more["e1i"] = _sums(rows, {"e13": -foot[2]})
        more["e2i"] = _sums(rows, {"e23": -foot[2]})
    return rows | more


def _sums(rows: Rows, weights: dict[str, Scalar]) -> Axes:
    """A linear combination of rows."""
    (name, weight), *others = weights.items()
    total = [times(weight, v) for v in rows[name]]
    for name, weight in others:
        total = [plus(u, times(weight, v)) for u, v in zip(total, rows[name], strict=True)]
    return total


def _matrix(kind: Kind, rows: Rows) -> list[Scalar]:
    """Row-major, 7 x 3 k."""
    zero: Axes = [[0, 0, 0]] * kind.count
    return [x for name in SIMILARITY_BIVECTOR.blade_names for vector in rows.get(name, zero) for x in vector]


def horizontal_jacobian(kind: Kind, points: Vector, chart: Vector) -> list[Scalar]:
    """The geometric Jacobian without the motions that leave the primitive where it is: rows of the controllable blades, others zero."""
    return _matrix(kind, _horizontal(kind, stand(kind, points, chart), split(points)))


def geometric_jacobian(kind: Kind, points: Vector, chart: Vector) -> list[Scalar]:
    """J_G = -2 ~V dV by the points, rows e12 e13 e23 e0i e1i e2i e3i, in the primitive's own frame (paper A, eq. 30)."""
    at = stand(kind, points, chart)
    return _matrix(kind, _spun(kind, at, _horizontal(kind, at, split(points))))


def analytic_jacobian(kind: Kind, points: Vector, chart: Vector) -> list[Scalar]:
    """dV = -1/2 V J_G by the points (paper A, eq. 29)."""
    halved = Multivector(SIMILARITY, [x if isinstance(x, int) and x == 0 else -0.5 * x for x in similarity(kind, points, chart)])
    entries, width = geometric_jacobian(kind, points, chart), 3 * kind.count
    twists = [Multivector(SIMILARITY_BIVECTOR, entries[column::width]) for column in range(width)]
    return by_rows([(halved * twist).project(SIMILARITY).coefficients for twist in twists])


def _rate_of(values: list[Scalar], points: Vector, velocities: Vector) -> list[Scalar]:
    """Derivative of values by the points, along velocities of theirs."""
    entries = casadi.vertcat(*[casadi.SX(x) for x in values])
    along = casadi.jtimes(entries, casadi.vertcat(*points), casadi.vertcat(*velocities))
    found: list[Scalar] = casadi.densify(along).elements()
    return found


def geometric_jacobian_derivative(kind: Kind, points: Vector, chart: Vector, velocities: Vector) -> list[Scalar]:
    """Time derivative of `geometric_jacobian` where the points move with `velocities` (m/s)."""
    return _rate_of(geometric_jacobian(kind, points, chart), points, velocities)


def horizontal_jacobian_derivative(kind: Kind, points: Vector, chart: Vector, velocities: Vector) -> list[Scalar]:
    """Time derivative of `horizontal_jacobian` where the points move with `velocities` (m/s)."""
    return _rate_of(horizontal_jacobian(kind, points, chart), points, velocities)
