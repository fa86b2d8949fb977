"""Paper C in conformal algebra: screws as bivectors, lines as their duals, and the NAO's factors as products (e0.ei = -1, null basis).

Identities of single screws are checked exactly, over fractions; those of the arms on the package's screws. The six-screw determinant is
not an outer product of bivectors: the last tests say why, and with which sign it is a bracket of coefficients.
"""

import math
from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest
from scipy.linalg import expm

from cga_codegen.algebra.blade_types import POINT, SCALAR, TRANSLATOR, TWIST, WRENCH, BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA
from cga_codegen.kernels.screws import Screw, bracket
from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.mobility import Wrench
from cga_runtime.loading import load_robot

ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))
SHOULDERS = np.array([[0, -0.098, 0.1], [0, 0.098, 0.1]])
INFINITY, ORIGIN = Multivector.from_blades(POINT, ei=1), Multivector.from_blades(POINT, e0=1)
NAMES_TWIST, NAMES_WRENCH = "e23 e13 e12 e1i e2i e3i", "e23 e13 e12 e01 e02 e03"


def element(names, values):
    """A multivector with these components, whatever the order of the names."""
    pairs = sorted(zip((CGA.mask(name) for name in names.split()), values, strict=True))
    return Multivector(BladeType("element", tuple(mask for mask, _ in pairs)), tuple(value for _, value in pairs))


def twist(w, v):
    return element(NAMES_TWIST, (w[0], -w[1], w[2], *v))


def wrench(f, m):
    return element(NAMES_WRENCH, (m[0], -m[1], m[2], *f))


def vector(x):
    return element("e1 e2 e3", x)


def point(p):
    return element("e0 e1 e2 e3 ei", (1, *p, sum(x * x for x in p) / 2))


# I5 = e1 ^ e2 ^ e3 ^ e0 ^ ei, one vector after the other; its inverse is its reverse, because I5 ~I5 = -I5^2 = 1
I5 = vector((1, 0, 0)) ^ vector((0, 1, 0)) ^ vector((0, 0, 1)) ^ ORIGIN ^ INFINITY
I5_INVERSE = -I5
I3 = element("e123", (1,))


def values(x, names):
    return list(x.at(names))


def zero(x, tolerance=0):
    return all(abs(value) <= tolerance for value in x.coefficients)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def draws(count, vectors, seed):
    """Tuples of integer vectors as fractions: every identity below is then exact."""
    numbers = np.random.default_rng(seed).integers(-9, 10, (count, vectors, 3))
    return [[[Fraction(int(x), 4) for x in vector] for vector in row] for row in numbers]


UNIT = [[Fraction(2, 7), Fraction(-3, 7), Fraction(6, 7)], [Fraction(3, 5), 0, Fraction(-4, 5)], [0, Fraction(1), 0]]


def bivectors(q):
    return [Multivector(TWIST, column) for column in LOOP.screws(q).T]


def poses(count, seed):
    return LOOP.random(np.random.default_rng(seed), count)


def test_coefficients():
    """(1,2,3; 4,5,6): twist (1,-2,3,4,5,6), wrench (4,-5,6,1,2,3) in the blades' order of the paper's algebra; e13 carries the minus."""
    assert values(twist((1, 2, 3), (4, 5, 6)), NAMES_TWIST) == [1, -2, 3, 4, 5, 6]
    assert values(wrench((1, 2, 3), (4, 5, 6)), NAMES_WRENCH) == [4, -5, 6, 1, 2, 3]
    # the package stores them by ascending masks
    assert TWIST.blade_names == ("e12", "e13", "e23", "e1i", "e2i", "e3i")
    assert WRENCH.blade_names == ("e01", "e02", "e12", "e03", "e13", "e23")
    assert values(Multivector(TWIST, Screw([1, 2, 3], [4, 5, 6]).bivector()), NAMES_TWIST) == [1, -2, 3, 4, 5, 6]
    stored = Wrench(np.array([1.0, 2, 3]), np.array([4.0, 5, 6]), 0.0, None).bivector()
    assert values(Multivector(WRENCH, stored), NAMES_WRENCH) == [4, -5, 6, 1, 2, 3]


def test_point_flow():
    """P.B = (PB - BP)/2 is the velocity w x p + v of the point, with the rate of |p|^2/2 on ei."""
    for w, v, p in draws(50, 3, 90):
        moved = point(p).commutator(twist(w, v))
        rate = [x + y for x, y in zip(cross(w, p), v, strict=True)]
        assert values(moved, "e0 e1 e2 e3 ei") == [0, *rate, dot(p, rate)]
        assert values(point(p) | twist(w, v), "e1 e2 e3 ei") == [*rate, dot(p, rate)]


def test_motor():
    """exp(-B/2), summed in the algebra, moves points as the matrix exponential of (w, v) does."""
    rng = np.random.default_rng(91)
    for w, v, p in rng.standard_normal((20, 3, 3)):
        motor = term = Multivector(SCALAR, (1.0,))
        for k in range(1, 40):
            term = (term * twist(w, v)).scaled(-0.5 / k)
            motor = motor + term
        matrix = np.zeros((4, 4))
        matrix[:3, :3], matrix[:3, 3] = np.cross(np.eye(3), w), v
        moved = motor * point(p) * ~motor
        np.testing.assert_allclose(values(moved, "e1 e2 e3"), (expm(matrix) @ [*p, 1])[:3], atol=1e-13)
        np.testing.assert_allclose(values(moved, "e0 e123"), [1, 0], atol=1e-13)


def test_power_and_reciprocity():
    """f.v + m.w = -(B.W); two screws are reciprocal when B1 ^ B2 = (w1.v2 + w2.v1) e123i vanishes."""
    for w, v, f, m in draws(50, 4, 92):
        assert twist(w, v).scalar_product(wrench(f, m)) == -(dot(f, v) + dot(m, w))
        meet = twist(w, v) ^ twist(f, m)
        assert values(meet, "e123i") == [dot(w, m) + dot(f, v)]
        assert zero(meet - element("e123i", values(meet, "e123i")))


def test_pitch():
    """B ^ B = 2 (w.v) e123i and -B.B = w.w, so h = (w.v)/(w.w); a line has B ^ B = 0."""
    for w, v, p in draws(50, 3, 93):
        b = twist(w, v)
        assert values(b ^ b, "e123i") == [2 * dot(w, v)] and -b.scalar_product(b) == dot(w, w)
        turn = twist(w, cross(p, w))
        assert zero(turn ^ turn)


@pytest.mark.parametrize("unit", UNIT)
def test_axis_as_dual_line(unit):
    """B = (P ^ Q ^ ei) I5^-1 with sign +1 for Q - P = unit; the same as T e_axis ~T; a point's distance from it is |P.B|."""
    assert dot(unit, unit) == 1
    for p, x in draws(20, 2, 94):
        q = [a + b for a, b in zip(p, unit, strict=True)]
        axis = twist(unit, cross(p, unit))
        line = point(p) ^ point(q) ^ INFINITY
        assert zero(line * I5_INVERSE - axis) and I5.scalar_product(I5) == -1
        t = element("1 e1i e2i e3i", (1, *(-a / 2 for a in p)))
        assert t.type == TRANSLATOR and zero(t * twist(unit, (0, 0, 0)) * ~t - axis)
        assert zero(point(p) | axis) and zero(point(q) | axis)
        off = point(x) | axis
        foot = cross([a - b for a, b in zip(x, p, strict=True)], unit)
        assert off.scalar_product(off) == dot(foot, foot)
        direction = ORIGIN.left_contraction(axis ^ INFINITY) * I3
        assert values(direction, "e1 e2 e3") == unit and zero(direction - vector(unit))


def test_bracket_of_screws():
    """The commutator S1 x S2 is the Lie bracket [S2, S1]: (w2 x w1, w2 x v1 + v2 x w1)."""
    for w1, v1, w2, v2 in draws(50, 4, 95):
        one, two = twist(w1, v1), twist(w2, v2)
        rate = cross(w2, w1), [a + b for a, b in zip(cross(w2, v1), cross(v2, w1), strict=True)]
        assert zero(one.commutator(two) - twist(*rate))
        assert zero((one * two - two * one).scaled(Fraction(1, 2)) - twist(*rate))
        assert zero(Screw(w2, v2).bracket(Screw(w1, v1)).multivector() - twist(*rate))


def test_rates_of_the_arms_screws():
    """dS_j/dq_k = S_j x S_k for k < j in the same arm, else exactly 0 (central differences, 2e-10)."""
    h = 1e-5
    for q in poses(5, 96):
        screws = bivectors(q)
        for k in range(10):
            rates = (LOOP.screws(q + h * np.eye(10)[k]) - LOOP.screws(q - h * np.eye(10)[k])) / (2 * h)
            for j in range(10):
                carried = k < j and k // 5 == j // 5
                expected = screws[j].commutator(screws[k]).project(TWIST).coefficients if carried else np.zeros(6)
                np.testing.assert_allclose(rates[:, j], np.array(expected, float), atol=2e-10 if carried else 0)


def test_limb_factors():
    """(A . S1)^2 = f^2, A the S centre as a conformal point; d3 ^ d4 ^ d5 = -sin(q4) I3; A.S_j = 0: axes 3, 4, 5 run through A."""
    for q in poses(30, 97):
        screws, centres, factors = bivectors(q), LOOP.kernel("wrist_centres")(q), LOOP.kernel("limb_factors")(q)
        for k in (0, 1):
            arm, a = screws[5 * k : 5 * k + 5], point(centres[k])
            off = a | arm[0]
            assert abs(off.scalar_product(off) - factors[k, 0] ** 2) < 1e-17
            d3, d4, d5 = (ORIGIN.left_contraction(s ^ INFINITY) * I3 for s in arm[2:])
            assert abs((d3 ^ d4 ^ d5).coefficient(CGA.mask("e123")) + math.sin(q[5 * k + 3])) < 1e-15
            assert all(zero(a | s, 1e-15) for s in arm[2:]) and all(zero(point(SHOULDERS[k]) | s, 1e-15) for s in arm[:2])
            away = a | arm[1]
            assert abs(away.scalar_product(away) - (0.105**2 + 0.015**2)) < 1e-16  # |US| from axis 2, whatever the pose
    straight = bivectors(np.array([0.3, -0.4, 0.0, 0.8, 0.1, 0.2, 0.1, 0.5, -0.3, 0.4]))  # q3 = 0: axes 2 and 4 are parallel
    two, four, five = (ORIGIN.left_contraction(straight[j] ^ INFINITY) * I3 for j in (1, 3, 4))
    assert zero(two ^ four, 1e-16) and not zero(two ^ five, 0.1)


def test_constraint_wrenches():
    """zeta = U ^ A ^ ei: its dual wedges to zero with every screw of the arm; as a wrench it is |UA| times the kernel's unit force."""
    for q in poses(30, 98):
        screws, centres, rows = bivectors(q), LOOP.kernel("wrist_centres")(q), LOOP.kernel("constraint_wrenches")(q)
        for k in (0, 1):
            zeta = point(SHOULDERS[k]) ^ point(centres[k]) ^ INFINITY
            dual = zeta * I5_INVERSE
            for s in screws[5 * k : 5 * k + 5]:
                assert zero(dual ^ s, 1e-16)
                assert abs(s.scalar_product(Multivector(WRENCH, rows[k]))) < 1e-16
            assert not zero(dual ^ screws[6 - 5 * k], 1e-4)
            f, m = rows[k][[0, 1, 3]], np.array([rows[k][5], -rows[k][4], rows[k][2]])
            size = np.linalg.norm(centres[k] - SHOULDERS[k])
            assert zero(dual - twist(size * f, size * m), 1e-15)


def test_factors_of_example_2():
    """The line AB against axis 6: |f_R f_L sin(q1 - q6)|; the point B against the plane of s4, s5 through A: |n45 . (B - A)|."""
    for q in poses(30, 99):
        screws, (a, b), factors = bivectors(q), LOOP.kernel("wrist_centres")(q), LOOP.kernel("limb_factors")(q)
        line = (point(a) ^ point(b) ^ INFINITY) * I5_INVERSE
        offset = (line ^ screws[5]).coefficient(CGA.mask("e123i"))
        assert abs(abs(offset) - abs(factors[0, 0] * factors[1, 0] * math.sin(q[0] - q[5]))) < 1e-16
        s4, s5 = LOOP.twists(q)[:3, 3], LOOP.twists(q)[:3, 4]
        plane = point(a) ^ vector(s4) ^ vector(s5) ^ INFINITY
        height = (point(b) ^ plane).coefficient(CGA.mask("e0123i"))
        assert abs(abs(height) - abs(np.cross(s4, s5) @ (b - a))) < 1e-15


def test_gradient_of_a_determinant():
    """dD/dq_k = sum over passive j > k of the same arm of det(column j replaced by S_j x S_k); D_q1 + D_q6 = 0."""
    for actuated in ((1, 3, 7, 8), (1, 2, 3, 7), (4, 5, 6, 10)):
        passive = [j for j in range(10) if j + 1 not in actuated]
        for q in poses(10, 100):
            screws, gradient = bivectors(q), LOOP.determinant_gradient(q, actuated)
            for k in range(10):
                total = 0.0
                for place, j in enumerate(passive):
                    if k < j and k // 5 == j // 5:
                        columns = LOOP.screws(q)[:, passive]
                        columns[:, place] = screws[j].commutator(screws[k]).project(TWIST).coefficients
                        columns[3:] /= 0.1
                        total += np.linalg.det(columns)
                assert abs(total - gradient[k]) < 1e-13
            assert abs(gradient[0] + gradient[5]) < 1e-13


def test_a_determinant_is_no_outer_product():
    """Two bivectors wedge to a 4-vector and three to nothing (grade 6 in five dimensions): six screws have a bracket, not a wedge."""
    one, two, three = (twist(w, v) for w, v in draws(3, 2, 101))
    assert all(mask.bit_count() == 4 for mask in (one ^ two).type.masks) and not zero(one ^ two)
    assert len((one ^ two ^ three).type) == 0


def test_sign_of_the_bracket():
    """In rows e23 e13 e12 e1i e2i e3i the e13 sign makes det = -det of (w, v); in ascending masks e12 e13 e23 ... it is +det."""
    paper = {order: _sign(order) for order in (("e23", "e13", "e12"), ("e12", "e13", "e23"))}
    assert paper == {("e23", "e13", "e12"): -1, ("e12", "e13", "e23"): 1}
    for columns in np.random.default_rng(102).integers(-4, 5, (30, 6, 6)):
        screws = [Screw([int(x) for x in c[:3]], [int(x) for x in c[3:]]) for c in columns]
        rows = np.array([s.bivector() for s in screws]).T
        exact = sum(math.prod(int(columns[j][i]) for j, i in enumerate(p)) * _parity(p) for p in permutations(range(6)))
        assert bracket([int(x) for x in rows.ravel()]) == [exact]  # exact integers, by the definition of a determinant


def _parity(p):
    return (-1) ** sum(p[i] > p[j] for i in range(len(p)) for j in range(i + 1, len(p)))


def _sign(order):
    """Determinant of the map (w_x, w_y, w_z) -> coefficients of w_x e23 - w_y e13 + w_z e12 in that order of blades."""
    matrix = [twist(w, (0, 0, 0)).at(" ".join(order)) for w in np.eye(3, dtype=int).tolist()]
    return round(np.linalg.det(np.array(matrix, float)))
