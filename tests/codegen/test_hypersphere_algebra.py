"""Conformal algebra of R^n in exact rationals: points, versors and hyperspheres of more than four points, and what lifts mean."""

import random
from fractions import Fraction

import numpy as np
import pytest
from exact_hyperspheres import (
    determinant,
    edges,
    embedded,
    nonzero,
    on_hypersphere,
    rational,
    span,
    through,
    unit_hypersphere,
    vectors,
    versors,
)

from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA, G51, AlgebraError, conformal, grade
from cga_codegen.kernels import hypersphere

DIMENSIONS = (3, 4, 5)  # the sphere of four chains, the hyperspheres of five and of six


def test_conformal_signatures():
    assert conformal(3) == CGA and conformal(4) == G51 and G51.name == "G51"
    for n in (1, 2, 3, 4, 5):
        algebra = conformal(n)
        assert algebra.basis == ("e0", *(f"e{k}" for k in range(1, n + 1)), "ei") and algebra.determinant == -1
        assert algebra.gram[0] == (*[0] * (n + 1), -1) and algebra.gram[n] == tuple(int(k == n) for k in range(n + 2))
    for n in (0, 18):
        with pytest.raises(AlgebraError, match=rf"R\^{n}: 1 to 17 dimensions"):
            conformal(n)
    with pytest.raises(AlgebraError, match=r"R\^2: end points have three coordinates"):
        hypersphere.hypersphere(2)


@pytest.mark.parametrize("n", DIMENSIONS)
def test_points_are_null_and_versors_move_them_as_in_g41(n):
    draw = random.Random(n)
    infinity = Multivector(vectors(n), [*[0] * (n + 1), 1])
    x, y, t, d = rational(draw, n), rational(draw, n), rational(draw, n), Fraction(7, 3)
    assert nonzero(embedded(n, x) * embedded(n, x)) == {} and nonzero(embedded(n, x) | infinity) == {"1": -1}
    distance = sum((a - b) ** 2 for a, b in zip(x, y, strict=True))
    assert nonzero(embedded(n, x) | embedded(n, y)) == {"1": -distance / 2}
    translator = Multivector(versors(n), [1, 0, *(-a / 2 for a in t)])
    dilator = Multivector(versors(n), [d + 1, d - 1, *[0] * n])  # times 2 sqrt(d), which is no rational number
    moved = translator * embedded(n, x) * ~translator
    assert nonzero(moved - embedded(n, [a + b for a, b in zip(x, t, strict=True)])) == {}
    grown = dilator * embedded(n, x) * ~dilator
    assert nonzero(grown - embedded(n, [d * a for a in x]).scaled(4)) == {}  # D P ~D = P(d x)/d, times 4 d
    assert nonzero(dilator * infinity * ~dilator) == {"ei": 4 * d * d}  # D ei ~D = d ei
    assert (translator * dilator).type == versors(n) == (translator * dilator * translator).type


@pytest.mark.parametrize("n", DIMENSIONS)
def test_the_versor_carries_the_unit_hypersphere_to_the_points(n):
    """V X_u ~V = X / (w r) with the weight w = det[X_i+1 - X_1], of either sign."""
    draw = random.Random(10 + n)
    signs = set()
    for _ in range(6):
        c, r = rational(draw, n), Fraction(draw.randint(1, 20), 7)
        x = [on_hypersphere(draw, c, r) for _ in range(n + 1)]
        whole, weight = span(n, x), determinant(edges(x))
        signs.add(weight > 0)
        versor = Multivector(versors(n), [1, 0, *(-a / 2 for a in c)]) * Multivector(versors(n), [r + 1, r - 1, *[0] * n])
        assert nonzero(versor * ~versor) == {"1": 4 * r}
        moved = versor * unit_hypersphere(n) * ~versor
        assert nonzero(moved - whole.scaled(4 / weight)) == {}
        assert whole.coefficient(conformal(n).pseudoscalar >> 1) == weight
    assert signs == {True, False}


@pytest.mark.parametrize("n", DIMENSIONS)
def test_rotations_leave_a_hypersphere_and_the_other_bivectors_do_not(n):
    algebra, x = conformal(n), unit_hypersphere(n)
    assert nonzero(x * ~x) == {"1": -1}
    moving = []
    for mask in (m for m in algebra.blades if grade(m) == 2):
        name = algebra.blade_name(mask)
        change = nonzero(Multivector(BladeType(name, (mask,), algebra), [1]).commutator(x))
        if "0" not in name and "i" not in name:
            assert change == {}
        elif "i" in name:
            moving.append((name, change))
    assert tuple(name for name, _ in moving) == hypersphere.hypersphere(n).controllable
    columns = [[change.get(algebra.blade_name(m), 0) for m in x.type.masks] for _, change in moving]
    assert np.linalg.matrix_rank(np.array(columns, dtype=float)) == n + 1


def test_five_points_of_space_span_a_flat_hyperplane_weighted_by_their_in_sphere_determinant():
    draw = random.Random(3)
    x = [rational(draw, 3) for _ in range(5)]
    weight = determinant([[*a, sum(t * t for t in a) / 2] for a in edges(x)])
    assert nonzero(span(4, [[*p, Fraction(0)] for p in x])) == {"e0123i": weight} and weight != 0
    assert nonzero(span(3, x)) == {"e0123i": weight}  # in G(4,1) it is the pseudoscalar: no algebra above is needed for it
    level = nonzero(span(4, [[*p, Fraction(2)] for p in x]))
    assert set(level) == {"e0123i", "e1234i"}  # equal lifts: the plane x4 = 2, flat as well
    cospherical = [on_hypersphere(draw, [1, 2, 3], Fraction(5, 2)) for _ in range(5)]
    assert nonzero(span(4, [[*p, Fraction(0)] for p in cospherical])) == {}


def test_what_lifts_mean():
    """One lift: the sphere of the four others and the power of the fifth. Any lifts: powers 2 h c4 - h^2 with respect to the slice. They
    fail where they are an affine function of the points: the affine dependency m of five points has m.h = 0 there."""
    draw = random.Random(4)
    x, lift = [rational(draw, 3) for _ in range(5)], Fraction(1, 20)
    centre, square = through([[*p, h] for p, h in zip(x, (0, 0, 0, 0, lift), strict=True)])
    small, radius = through(x[:4])
    power = sum((a - b) ** 2 for a, b in zip(x[4], small, strict=True)) - radius
    assert centre == [*small, (power + lift * lift) / (2 * lift)] and square - centre[3] ** 2 == radius
    h = rational(draw, 5)
    lifted = [[*p, a] for p, a in zip(x, h, strict=True)]
    centre, square = through(lifted)
    rho = square - centre[3] ** 2
    powers = [sum((a - b) ** 2 for a, b in zip(p, centre[:3], strict=True)) - rho for p in x]
    assert powers == [2 * a * centre[3] - a * a for a in h]
    m = [(-1) ** i * determinant(edges(x[:i] + x[i + 1 :])) for i in range(5)]
    assert sum(m) == 0 and all(sum(a * p[k] for a, p in zip(m, x, strict=True)) == 0 for k in range(3))
    assert determinant(edges(lifted)) == sum(a * b for a, b in zip(m, h, strict=True))
    slope = rational(draw, 3)
    affine = [[*p, sum(a * b for a, b in zip(slope, p, strict=True)) + 7] for p in x]
    assert determinant(edges(affine)) == 0
