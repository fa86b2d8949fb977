"""Outer products of points against exact rational arithmetic, near and far from the origin; weights and handedness."""

from fractions import Fraction
from functools import reduce

import element_draws as draws
import numpy as np
import pytest
from element_draws import COUNTS, ORACLE, ORACLE_NAMES, make

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector as Exact
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.joins import handedness, join, weight
from cga_runtime.multivectors import NAMES, Multivector

FLAT = (Line, Plane)


def rational(points, flat):
    """The 32 coefficients of P1 ^ P2 ... (^ ei), in rational numbers."""
    rows = [[Fraction(float(c)) for c in x] for x in points]
    factors = [Exact(blade_types.POINT, (Fraction(1), *x, sum(c * c for c in x) / 2)) for x in rows]
    factors += [Exact(blade_types.POINT, (Fraction(0),) * 4 + (Fraction(1),))] * flat
    whole = reduce(lambda a, b: a ^ b, factors)
    return np.array([float(whole.coefficient(mask)) for mask in range(32)])


@pytest.mark.parametrize("kind", COUNTS)
def test_the_primitives_of_the_oracle(kind):
    for case in ORACLE["primitives"][ORACLE_NAMES[kind]]:
        points = np.array(case["points"])
        whole = join(*points, flat=kind in FLAT)
        np.testing.assert_allclose(draws.full(whole), case["X"], rtol=0, atol=1e-14 * np.abs(case["X"]).max())
        assert weight(*points) == pytest.approx(case["weight"], rel=1e-14, abs=0)
        x = make(kind, points)
        np.testing.assert_allclose(x.center, case["c"], rtol=0, atol=1e-14 * max(1.0, np.abs(case["c"]).max()))
        if case["n"] is not None:
            np.testing.assert_allclose(getattr(x, "normal", None) if kind in (Circle, Plane) else x.direction, case["n"], atol=1e-14)
        if case["r"] is not None:
            assert x.radius == pytest.approx(case["r"], rel=1e-14, abs=0)


@pytest.mark.parametrize("kind", COUNTS)
@pytest.mark.parametrize(("spread", "distance"), [(1.0, 0.0), (1.0, 1.0), (0.01, 10.0), (0.01, 1000.0), (1e-5, 1e3), (1e6, 1e3)])
def test_joins_are_exact_to_rounding_at_any_distance(kind, spread, distance, rng):
    direction = rng.normal(size=3)
    for _ in range(5):
        points = spread * rng.normal(size=(COUNTS[kind], 3)) + distance * direction / np.linalg.norm(direction)
        exact, ours = rational(points, kind in FLAT), draws.full(join(*points, flat=kind in FLAT))
        edges, reach = np.linalg.norm(points[1:] - points[0], axis=-1).prod(), np.linalg.norm(points, axis=-1).max()
        for order in range(3):  # coefficients of different powers of a length; an outer product is no larger than its edges' lengths
            of_order = [k for k, name in enumerate(NAMES) if 1 - ("0" in name) + ("i" in name) == order]
            np.testing.assert_allclose(ours[of_order], exact[of_order], rtol=0, atol=2e-15 * edges * reach**order)


def test_differences_of_points_are_what_saves_the_digits(rng):
    points = 0.01 * rng.normal(size=(3, 3)) + 100.0 * np.ones(3)
    exact, plain = rational(points, False), draws.full(Point(points[0]) ^ Point(points[1]) ^ Point(points[2]))
    e0 = [k for k, name in enumerate(NAMES) if "0" in name and "i" not in name]
    off = [np.abs(x[e0] - exact[e0]).max() / np.abs(exact[e0]).max() for x in (plain, draws.full(join(*points)))]
    assert off[0] > 1e-10 and off[1] < 1e-14


@pytest.mark.parametrize("kind", COUNTS)
def test_a_join_is_the_unit_primitive_times_weight_and_radius(kind, rng):
    points = rng.normal(size=(50, COUNTS[kind], 3))
    each = np.moveaxis(points, 1, 0)
    x, w = make(kind, points), weight(*each)
    scale = w * (x.radius if kind in (PointPair, Circle, Sphere) else 1.0)
    whole = join(*each, flat=kind in FLAT)
    assert whole.blades == kind.blades and whole.coefficients.shape == (50, len(kind.blades))
    assert draws.off(Multivector(x.coefficients * scale[:, None], x.blades), whole) < 1e-12
    if kind is Sphere:
        assert (w < 0).any() and (w > 0).any()
        np.testing.assert_array_equal(handedness(*each), np.sign(w))
        np.testing.assert_array_equal(handedness(*each[[1, 0, 2, 3]]), -np.sign(w))


def test_elements_and_multivectors_are_factors_too(rng):
    points = rng.normal(size=(4, 3))
    sphere = join(*points)
    for factors in (
        (PointPair.from_points(*points[:2]), points[2], points[3]),
        (Circle.from_points(*points[:3]), Point(points[3])),
        (join(*points[:2]), join(*points[2:])),
        (points[0], PointPair.from_points(*points[1:3]), points[3]),
    ):
        found = join(*factors)
        ratio = found["e0123"] / sphere["e0123"]
        np.testing.assert_allclose(found.coefficients / ratio, sphere.coefficients, atol=1e-13 * np.abs(sphere.coefficients).max())
    assert (
        draws.off(join(PointPair.from_points(*points[:2]), flat=True), Multivector(*_scaled(Line.from_points(*points[:2]), points))) < 1e-13
    )
    assert join(*rng.normal(size=(5, 3))).blades == ("e0123i",)


def _scaled(line, points):
    """P1 ^ P2 ^ ei / (2 r^2), r = |x2 - x1| / 2."""
    return line.coefficients * 2.0 / np.linalg.norm(points[1] - points[0]), line.blades


def test_what_depends_vanishes_and_has_no_weight():
    x = np.array([1.0, 2.0, 3.0])
    assert not join(x, x).coefficients.any() and weight(x, x) == 0.0
    line = [k * np.array([1.0, 2.0, 0.5]) for k in range(3)]
    assert weight(*line) == 0.0 and not join(*line, flat=True).coefficients.any()
    circle = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)]
    assert weight(*circle) == 0.0 and not join(*circle).coefficients.any()
    with pytest.raises(cga.DegenerateError, match="handedness: the four points make no sphere"):
        handedness(*circle)


def test_wrong_factors_are_named(rng):
    x = rng.normal(size=3)
    with pytest.raises(cga.WrongSizeError, match="join: no factor given"):
        join()
    with pytest.raises(cga.WrongSizeError, match="join: the factors have more than five dimensions"):
        join(*rng.normal(size=(6, 3)))
    with pytest.raises(cga.WrongSizeError, match="or one of them twice"):
        join(Line.from_points(x, 2 * x), flat=True)
    with pytest.raises(cga.WrongSizeError, match="weight: 5 points given, 1 to 4 needed"):
        weight(*rng.normal(size=(5, 3)))
    with pytest.raises(cga.WrongSizeError, match="handedness: 3 points given, 4 needed"):
        handedness(*rng.normal(size=(3, 3)))
    with pytest.raises(cga.WrongSizeError, match="weight: batch dimensions"):
        weight(np.zeros((2, 3)), np.zeros((3, 3)))
    with pytest.raises(cga.WrongSizeError, match=r"point: shape \(2,\)"):
        join((1, 2))
    with pytest.raises(cga.NotFiniteError, match="join: the outer product is too large for a float"):
        join((1e60, 0, 0), (-1e60, 0, 0), (0, 3e59, 0), (0, 3e59, 4e59))
    with pytest.raises(cga.NotFiniteError, match="point holds NaN"):
        join((0, 0, np.nan))
