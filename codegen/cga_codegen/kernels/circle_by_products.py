"""The analytic circle similarity Jacobian by products of multivectors, paper A, appendix B, eqs. (78)-(91), corrected.

A second derivation, over any scalar (float, complex, casadi.SX, mpmath, arrays): tests hold it against the kernels, and it is never
generated. The kernels start from points, which keeps the digits that X_c loses far from the origin (similarity.md, section 3).

Throughout x is the cooperative circle X_c = P1 ^ P2 ^ P3, type CIRCLE, of any positive size, and dx one column of its Jacobian J_c^A (15),
the derivative along one coordinate. Lengths are in m. Corrections to the printed text (similarity.md, section 9):

- (79): the second term carries the sign of X ~X, which is -1 for a circle. It is known from the type, so it is an argument here.
- (82): e0i is missing. With it the formula belongs to B_D = +log(1/r) e0i, where (24) is 1/r and cancels the wrong sign of (69).
- (25), (88): the coefficient of the last term is +1, not -1/2, with e0 . ei = -1.
- (26): R = 1 + N2 N1, not its reverse.
- (90): <.>_0 is not the scalar part but the weight, the coefficient of e0, and the derivative of the weight was misplaced.

Degenerate circles are not caught here: collinear points give a division by zero or what the scalar makes of it.
"""

from __future__ import annotations

from collections.abc import Sequence

from cga_codegen.algebra.blade_types import CIRCLE, DILATOR, ORIGIN, POINT, ROTOR, SCALAR, SIMILARITY, TRANSLATOR, type_of
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA
from cga_codegen.kernels.vectors import Scalar

EUCLIDEAN_VECTOR = type_of(CGA.masks("e1 e2 e3"))
ONE = Multivector(SCALAR, [1])
E0 = Multivector(ORIGIN, [1])
EI = Multivector(type_of(CGA.masks("ei")), [1])
E0I = Multivector(type_of(CGA.masks("e0i")), [1])
AXIS = Multivector(type_of(CGA.masks("e3")), [1])
"""Normal of the unit circle e012 + e12i / 2."""


def squared(x: Multivector) -> Scalar:
    """<X ~X>_0, negative for a circle."""
    return x.scalar_product(~x)


def normalized(x: Multivector, sign: int) -> Multivector:
    """X |X ~X|^(-1/2) (78); `sign` is that of X ~X, known from the type."""
    return x.scaled((sign * squared(x)) ** -0.5)


def normalized_derivative(x: Multivector, dx: Multivector, sign: int) -> Multivector:
    """|X ~X|^(-1/2) dX - sign/2 |X ~X|^(-3/2) X <dX ~X + X ~dX>_0 (79, corrected: the sign)."""
    size = sign * squared(x)
    change = 2 * x.scalar_product(~dx)
    return dx.scaled(size**-0.5) - x.scaled(sign * 0.5 * size**-1.5 * change)


def inverse(x: Multivector) -> Multivector:
    """~X (X ~X)^(-1) (80), for X with a scalar X ~X."""
    return (~x).scaled(1 / squared(x))


def inverse_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """(X ~X)^(-1) ~dX - 2 (X ~X)^(-2) ~X <X ~dX>_0 (81)."""
    size = squared(x)
    return (~dx).scaled(1 / size) - (~x).scaled(2 * x.scalar_product(~dx) / size**2)


def projected_infinity(x: Multivector) -> Multivector:
    """P_oo = (X . ei) X^(-1) (24, 83), a vector with P_oo ~P_oo = -1/r^2."""
    return ((x | EI) * inverse(x)).project(POINT)


def projected_infinity_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """J_oo = (ei . dX) X^(-1) + (ei . X) d(X^(-1)) (84); for circles ei . X = X . ei."""
    return ((EI | dx) * inverse(x) + (EI | x) * inverse_derivative(x, dx)).project(POINT)


def dilator(x: Multivector) -> Multivector:
    """V_D = exp(log(1/r) e0i) = cosh(log(r)/2) + sinh(log(r)/2) e0i (23, corrected), with 1/r = |P_oo| (24)."""
    root = (-squared(projected_infinity(x))) ** -0.25
    return Multivector(DILATOR, [0.5 * (root + 1 / root), 0.5 * (root - 1 / root)])


def dilator_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """-1/4 (P_oo ~P_oo)^(-1) <J_oo ~P_oo + P_oo ~J_oo>_0 e0i V_D (82, corrected: e0i)."""
    p, change = projected_infinity(x), projected_infinity_derivative(x, dx)
    twice = 2 * change.scalar_product(~p)
    return (E0I * dilator(x)).scaled(-0.25 * twice / squared(p)).project(DILATOR)


def scaled_normal(x: Multivector) -> Multivector:
    """N = E* + (E* . e0) ei with E = X ^ ei (25, corrected: +1), linear in X; its length is twice the triangle's area, its ei part 0."""
    plane = (x ^ EI).dual()
    return plane + EI.scaled(plane.scalar_product(E0))


def normal(x: Multivector) -> Multivector:
    """The unit normal, right-handed around the three points."""
    return normalized(scaled_normal(x), 1)


def normal_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """(87) of J_N = J_E* + (e0 . J_E*) ei (88, corrected: +1), J_E = dX ^ ei (89)."""
    return normalized_derivative(scaled_normal(x), scaled_normal(dx), 1)


def scaled_rotor(x: Multivector) -> Multivector:
    """1 + N2 N1 = 1 + N2 . N1 + N2 ^ N1 (26, corrected), from N1 = e3 to N2 = N, with the squared size 2 (1 + N1 . N2)."""
    return (ONE + normal(x) * AXIS).project(ROTOR)


def rotor(x: Multivector) -> Multivector:
    """V_R, the shortest turn of e3 to the normal. Its digits go as the square of the angle between the normal and -e3."""
    return normalized(scaled_rotor(x), 1)


def rotor_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """(85) of J_R = e3 . J_N - e3 ^ J_N (86) = J_N e3."""
    change = normal_derivative(x, dx)
    return normalized_derivative(scaled_rotor(x), ((AXIS | change) - (AXIS ^ change)).project(ROTOR), 1)


def scaled_centre(x: Multivector) -> Multivector:
    """P_c = X ei X (27): the centre as a point of weight 2 w^2, w the length of the scaled normal."""
    return (x * EI * x).project(POINT)


def scaled_centre_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """J_P = dX ei X + X ei dX (91)."""
    return (dx * EI * x + x * EI * dx).project(POINT)


def translator(x: Multivector) -> Multivector:
    """V_T = 1 - (P_c / w - e0) ^ ei / 2 (22, 64), w = -ei . P_c."""
    centre = scaled_centre(x)
    place = centre.scaled(-1 / EI.scalar_product(centre)).project(EUCLIDEAN_VECTOR)
    return (ONE - (place ^ EI).scaled(0.5)).project(TRANSLATOR)


def translator_derivative(x: Multivector, dx: Multivector) -> Multivector:
    """-1/2 w^(-1) (J_P - (w'/w) P_c) ^ ei (90, corrected), w = -ei . P_c, w' = -ei . J_P."""
    centre, change = scaled_centre(x), scaled_centre_derivative(x, dx)
    weight, weight_change = -EI.scalar_product(centre), -EI.scalar_product(change)
    moved = (change - centre.scaled(weight_change / weight)).scaled(1 / weight)
    return (moved.project(EUCLIDEAN_VECTOR) ^ EI).scaled(-0.5).project(TRANSLATOR)


def similarity(x: Multivector) -> Multivector:
    """V_Sc = V_S(X_u, X_c) = V_T V_R V_D (18, 28), from the unit circle e012 + e12i / 2 to x, up to its size: w r (V_S X_u ~V_S) = x."""
    return (translator(x) * rotor(x) * dilator(x)).project(SIMILARITY)


def analytic_jacobian(x: Multivector, columns: Sequence[Multivector]) -> list[Multivector]:
    """The columns of J_Sc^A (29), SIMILARITY elements, from X_c and the columns of J_c^A (15), CIRCLE elements."""
    x = x.project(CIRCLE)
    t, r, d = translator(x), rotor(x), dilator(x)
    found = []
    for dx in columns:
        change = translator_derivative(x, dx) * r * d + t * rotor_derivative(x, dx) * d + t * r * dilator_derivative(x, dx)
        found.append(change.project(SIMILARITY))
    return found
