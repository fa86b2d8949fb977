"""Hyperspheres through n + 1 points of R^n in G(n + 1, 1): the cooperative primitive of more than four chains (paper A, section 5.6).

End points lie in R^3, and five of them, taken as points of R^4, lie in the hyperplane x4 = 0 whatever the joints do: in G(5,1)

    P1 ^ ... ^ P5 = w e0123i,  w = det[a_i, a_i^2/2],  a_i = x_i+1 - x_1,

flat, with the in-sphere determinant w (`insphere`; zero where the five lie on one sphere of R^3) as its only number. So each point is given
more coordinates, its lift h_i (m): X_i = (x_i, h_i). The hypersphere through the X_i, centre C = (c, c4) and radius r, says of the points

    |x_i - c|^2 - rho^2 = 2 h_i c4 - h_i^2,  rho^2 = r^2 - c4^2:

their signed powers with respect to the slice at x4 = 0, a sphere of centre c and radius rho. With h = (0, 0, 0, 0, l) that is the sphere
through the first four points, and c4 = (p + l^2)/(2 l) with the power p of the fifth: five numbers of five chains. Lifts that are an affine
function of the points, equal ones above all, leave the X_i in one hyperplane.

A hypersphere has no direction. V = T(C) D(r), of components 1 e0i e1i ... eni, carries the unit one to it, and each bivector moves it: rows
e0i e1i ... eni = (-d log r, dC/r). A point's motion along it does not count; across it, along the unit radius u_i, it is
u_i.dX_i = u_i.dC + dr: the affine function through these values has dC as its slope and dr as its value at the centre.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi

from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import AlgebraError, conformal, grade
from cga_codegen.kernels.primitives import BARELY, NOTHING, Kind, Points, by_rows, split
from cga_codegen.kernels.vectors import Axes, Scalar, Vector, cross, dot, minus, plus, times


def hypersphere(n: int) -> Kind:
    """The hypersphere of n + 1 points of R^n as a kind of primitive, n at least 3; of n = 3 it is the sphere. Raises AlgebraError."""
    if n < 3:
        raise AlgebraError(f"hypersphere of R^{n}: end points have three coordinates")
    algebra = conformal(n)
    infinity = algebra.mask("ei")
    blades = BladeType("hypersphere", tuple(mask for mask in algebra.blades if grade(mask) == n + 1), algebra)
    return Kind("hypersphere", n + 1, blades, None, True, tuple(algebra.blade_name(1 << k | infinity) for k in range(n + 1)))


HYPERSPHERE = hypersphere(4)
"""Of five chains."""


@dataclass(frozen=True)
class Standing:
    """Where a hypersphere stands: centre, radius, unit radii u_i, and for each point the share s_i of its value in the affine function
    through all values f_i at the u_i: f(u) = (sum_i f_i s_i).(u, 1), over r."""

    centre: list[Scalar]
    radius: Scalar
    arm: list[Scalar]
    outward: Axes
    shares: Axes


def _lifted(kind: Kind, points: Vector, lifts: Vector) -> list[list[Scalar]]:
    """The points of R^n: x y z, and n - 3 lifts of each."""
    more = kind.count - 4
    return [[*x, *(lifts[more * i + k] for k in range(more))] for i, x in enumerate(split(points))]


def _edges(x: Points) -> Axes:
    return [minus(other, x[0]) for other in x[1:]]


def _determinant(rows: Axes, from_above: bool = True) -> Scalar:
    """Expanded row by row, from the first or from the last on."""
    if len(rows) == 1:
        return rows[0][0]
    row, rest = (rows[0], rows[1:]) if from_above else (rows[-1], rows[:-1])
    total: Scalar = 0
    for k, x in enumerate(row):
        term = x * _determinant([other[:k] + other[k + 1 :] for other in rest], from_above)
        total = total + term if (k + (0 if from_above else len(rows) - 1)) % 2 == 0 else total - term
    return total


def _cofactors(rows: Axes) -> Axes:
    """The derivative of the determinant by each entry; expanded from the end that is nearer to the row left out, so that they share
    minors."""
    size, found = len(rows), []
    for i in range(size):
        rest = rows[:i] + rows[i + 1 :]
        minors = [_determinant([row[:k] + row[k + 1 :] for row in rest], 2 * i < size) for k in range(size)]
        found.append([minor if (i + k) % 2 == 0 else -minor for k, minor in enumerate(minors)])
    return found


def _stand(kind: Kind, points: Vector, lifts: Vector) -> Standing:
    x = _lifted(kind, points, lifts)
    edges = _edges(x)
    cofactors = _cofactors(edges)
    whole = dot(cofactors[0], edges[0])
    arm = [0] * len(edges)
    for row, edge in zip(cofactors, edges, strict=True):  # edge.arm = edge^2/2, by Cramer's rule
        arm = plus(arm, times(0.5 * dot(edge, edge), row))
    arm = [y / whole for y in arm]
    slopes = [[y / whole for y in row] for row in cofactors]
    radius = casadi.sqrt(dot(arm, arm))
    slopes = [[-sum(column[1:], column[0]) for column in zip(*slopes, strict=True)], *slopes]
    shares = [[*slope, (int(i == 0) + dot(slope, arm)) / radius] for i, slope in enumerate(slopes)]
    outward = [[(y - z) / radius for y, z in zip(edge, arm, strict=True)] for edge in [[0] * len(arm), *edges]]
    return Standing(plus(x[0], arm), radius, arm, outward, shares)


def parts(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """Centre and radius (m) of the hypersphere, from the differences of its points."""
    at = _stand(kind, points, lifts)
    return [*at.centre, at.radius]


def slice(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """Centre (m) of the slice of R^3 and its squared radius r^2 - c4^2 - ... (m^2): negative where the slice is empty."""
    at, h = _stand(kind, points, lifts), _lifted(kind, points, lifts)[0][3:]
    inside, beyond = at.arm[:3], at.arm[3:]
    square = dot(inside, inside)  # |x1 - c|^2 - h1^2 - 2 h1.(C - X1): nothing large cancels where the first chain has no lift
    for a, b in zip(h, beyond, strict=True):
        square = square - a * (a + 2 * b)
    return [*at.centre[:3], square]


def similarity(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """V = T(C) D(r) with V X_u ~V = X over its weight and radius; components 1 e0i e1i ... eni (paper A, eq. 28, in G(n + 1, 1))."""
    at = _stand(kind, points, lifts)
    root = casadi.sqrt(at.radius)
    return [0.5 * (root + 1 / root), 0.5 * (root - 1 / root), *times(-0.5 / root, at.centre)]


def primitive(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """X = P1 ^ ... ^ Pn+1 of the lifted points; the weight det[X_i+1 - X_1] leads (paper A, eq. 14)."""
    algebra = kind.type.signature
    point = BladeType("point", tuple(1 << k for k in range(algebra.dimension)), algebra)
    factors = [Multivector(point, [1, *x, 0.5 * dot(x, x)]) for x in _lifted(kind, points, lifts)]
    whole = factors[0]
    for factor in factors[1:]:
        whole = whole ^ factor
    return list(whole.project(kind.type).coefficients)


def _rows(kind: Kind, at: Standing, coordinates: range) -> list[Scalar]:
    """Rows e0i e1i ... eni by these coordinates of each point, row-major; e0i = -d log r."""
    columns = [[share[-1], *share[:-1]] for share in at.shares]
    return [
        (-column[k] if k == 0 else column[k]) * u[i]
        for k in range(kind.count)
        for column, u in zip(columns, at.outward, strict=True)
        for i in coordinates
    ]


def geometric_jacobian(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """J_G = -2 ~V dV by the points, rows e0i e1i ... eni, in the hypersphere's own frame (paper A, eq. 30, in G(n + 1, 1))."""
    return _rows(kind, _stand(kind, points, lifts), range(3))


def geometric_jacobian_by_lifts(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """J_G = -2 ~V dV by the lifts, rows e0i e1i ... eni: for lifts that change with the points."""
    return _rows(kind, _stand(kind, points, lifts), range(3, kind.count - 1))


def degeneracy(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """|det| of the n edges over their lengths: 0 where the lifted points lie in one hyperplane or coincide (similarity.md, section 8)."""
    edges = _edges(_lifted(kind, points, lifts))
    whole, below = _determinant(edges), 1
    for edge in edges:
        below = below * dot(edge, edge)
    return [casadi.sqrt(whole * whole + NOTHING) / casadi.sqrt(below + BARELY)]


def _gradient(value: Scalar, by: Vector) -> list[Scalar]:
    entries: list[Scalar] = casadi.densify(casadi.gradient(value, casadi.vertcat(*by))).elements()
    return entries


def degeneracy_gradient(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """Derivative of `degeneracy` by the points."""
    return _gradient(degeneracy(kind, points, lifts)[0], points)


def degeneracy_gradient_by_lifts(kind: Kind, points: Vector, lifts: Vector) -> list[Scalar]:
    """Derivative of `degeneracy` by the lifts."""
    return _gradient(degeneracy(kind, points, lifts)[0], lifts)


def insphere(kind: Kind, points: Vector) -> list[Scalar]:
    """The in-sphere determinant det[a_i, a_i^2/2] of five points (m^5): P1 ^ ... ^ P5 = w e0123i without lifts; 0 where they lie on one
    sphere or plane."""
    return [_determinant([[*edge, 0.5 * dot(edge, edge)] for edge in _edges(split(points))])]


def insphere_gradient(kind: Kind, points: Vector) -> list[Scalar]:
    """Derivative of `insphere` by the points."""
    return _gradient(insphere(kind, points)[0], points)


def _volumes(points: Vector) -> list[Scalar]:
    """The signed volumes (times six) of the tetrahedra without the first, second ... of five points."""
    a, b, c, d = _edges(split(points))
    others = [-dot(cross(b, c), d), dot(cross(a, c), d), -dot(cross(a, b), d), dot(cross(a, b), c)]
    return [-sum(others[1:], others[0]), *others]


def dependency(kind: Kind, points: Vector) -> list[Scalar]:
    """The affine dependency m of five points of R^3, of length one: sum m_i = 0, sum m_i x_i = 0; 0 where all five are coplanar.

    m_i is a multiple of the signed volume of the tetrahedron without the i-th point, and det[X_i+1 - X_1] one of m.h: of all lifts with
    |h| = l those h = l m have the largest determinant.
    """
    volumes = _volumes(points)
    length = casadi.sqrt(dot(volumes, volumes) + NOTHING)
    return [x / length for x in volumes]


def dependency_jacobian(kind: Kind, points: Vector) -> list[Scalar]:
    """Derivative of `dependency` by the points: (1 - m m^T) of that of the volumes, over their length."""
    volumes = _volumes(points)
    length = casadi.sqrt(dot(volumes, volumes) + NOTHING)
    unit = [x / length for x in volumes]
    rates = casadi.jacobian(casadi.vertcat(*volumes), casadi.vertcat(*points))
    columns = [casadi.densify(rates[:, k] / length).elements() for k in range(len(points))]
    return by_rows([minus(column, times(dot(unit, column), unit)) for column in columns])
