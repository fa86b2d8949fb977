"""Pairs against exact fractions, over numpy and as casadi functions, which must not simplify the rounding errors away."""

from fractions import Fraction

import casadi
import numpy as np
import pytest

from cga_runtime.pairs import pair, paired
from cga_runtime.smooth import NUMPY, casadi_field
from cga_runtime.versors import Similarity

COUNT = 60


def results(f, a, b, c, d):
    """High and low of sum, difference, product, quotient, square, and of a sum of products."""
    wide, lift = paired(f)
    a, b, c, d = (lift(x) for x in (a, b, c, d))
    root = wide.sqrt(a * a + b * b)
    return [x for p in (a + b, a - b, a * b, a / b, root, a * b + c * d - 0.5 * a) for x in (p.high, p.low)]


@pytest.mark.parametrize("kind", ["numpy", "casadi"])
def test_pairs_keep_twice_the_digits(kind, rng):
    values = rng.normal(size=(COUNT, 4)) * 10 ** rng.uniform(-3, 3, (COUNT, 4))
    if kind == "numpy":
        found = np.stack(results(NUMPY, *values.T), axis=-1)
    else:
        x = casadi.SX.sym("x", 4)
        function = casadi.Function("pairs", [x], [casadi.vertcat(*results(casadi_field(), *casadi.vertsplit(x)))])
        found = np.array(function.map(COUNT)(values.T)).T
    for row, made in zip(values, found, strict=True):
        a, b, c, d = (Fraction(x) for x in row)
        exact = [Fraction(high) + Fraction(low) for high, low in made.reshape(-1, 2)]
        for value, expected, size in (
            (exact[0], a + b, abs(a)),
            (exact[1], a - b, abs(a)),
            (exact[2], a * b, abs(a * b)),
            (exact[3], a / b, abs(a / b)),
            (exact[4] * exact[4], a * a + b * b, a * a + b * b),
            (exact[5], a * b + c * d - a / 2, abs(a * b) + abs(c * d) + abs(a)),
        ):
            assert abs(value - expected) <= size * Fraction(1, 10**30)


def test_fields_without_pairs_are_left_alone():
    from cga_runtime.jets import JETS

    wide, lift = paired(JETS)
    assert wide is JETS and lift(2.0) == 2.0 and pair(2.0).low == 0.0


@pytest.mark.parametrize("chart", ["split", "lie"])
def test_lengths_near_the_largest_float_are_no_reason_to_fail(chart):
    b = np.array([0.3, -0.2, 0.5, 1.5, 2e303, -1e304, 3e302])
    versor = Similarity.exp(b, chart)
    np.testing.assert_allclose(versor.log(chart), b, rtol=1e-14)
