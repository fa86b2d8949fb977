"""Rotors from one direction to another in both charts: the oracle, 50 digits near the poles, seams, hysteresis, and refusals."""

import element_draws as draws
import mpmath
import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.charts import POLE, REFERENCE, TURN_AXIS, chart_of, rotor_between
from cga_runtime.elements.similarities import similarity_between, similarity_of
from cga_runtime.versors import Rotor

AXIS = np.array(TURN_AXIS)
E3 = np.array([0.0, 0.0, 1.0])


def units(rng, *shape):
    v = rng.normal(size=(*shape, 3))
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def near(a, side, angle):
    """The unit vector at an angle from a, towards `side`, a unit vector square to it, rounded from 50 digits."""
    with mpmath.workdps(50):
        c, s = mpmath.cos(mpmath.mpf(angle)), mpmath.sin(mpmath.mpf(angle))
        return np.array([float(c * mpmath.mpf(p) + s * mpmath.mpf(q)) for p, q in zip(a, side, strict=True)])


def test_the_rotors_of_the_oracle():
    for case in draws.ORACLE["rotor_between"]:
        a, n = np.array(case["a"], dtype=float), np.array(case["n"])
        tolerance = 1e-9  # its short rotor is itself off by eps / angle; at 1e-9 from the pole the scalar part is all of that
        np.testing.assert_allclose(rotor_between(a, n, AXIS, -1, "test"), case["safe"], rtol=0, atol=2e-16)
        np.testing.assert_allclose(rotor_between(a, n, AXIS, 1, "test"), case["short"], rtol=0, atol=tolerance)
    assert {kind.replace("_", ""): list(a) for kind, a in REFERENCE.items()} == draws.ORACLE["refdir"]


@pytest.mark.parametrize("chart", [1, -1])
def test_both_charts_carry_a_to_n(chart, rng):
    a, n = units(rng, 500), units(rng, 500)
    axis = np.cross(a, units(rng, 500))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    rotor = Rotor(rotor_between(a, n, axis, chart, "test"))
    np.testing.assert_allclose((rotor.matrix() @ a[..., None])[..., 0], n, rtol=0, atol=2e-15)
    if chart == 1:  # the shortest arc turns by the angle between them, about an axis square to both
        turn = rotor.vector()
        np.testing.assert_allclose(
            np.linalg.norm(turn, axis=-1), np.arctan2(np.linalg.norm(np.cross(a, n), axis=-1), (a * n).sum(-1)), atol=1e-14
        )
        assert np.abs((turn * a).sum(-1)).max() < 1e-14 and np.abs((turn * n).sum(-1)).max() < 1e-14
    else:  # the half turn, then the shortest arc from -a
        half = Rotor.from_vector(np.pi * axis)
        arc = Rotor(rotor_between(-a, n, axis, 1, "test"))
        np.testing.assert_allclose((arc * half).coefficients, rotor.coefficients, atol=1e-14)


def exact_short(a, n):
    """R = (a + n) a / |a + n| of the unit vectors along a and n, in 50 digits."""
    with mpmath.workdps(50):
        a, n = ([mpmath.mpf(float(c)) for c in v] for v in (a, n))
        a, n = ([c / mpmath.sqrt(sum(d * d for d in v)) for c in v] for v in (a, n))
        h = [p + q for p, q in zip(a, n, strict=True)]
        h = [c / mpmath.sqrt(sum(d * d for d in h)) for c in h]
        scalar = sum(p * q for p, q in zip(h, a, strict=True))
        return np.array([float(x) for x in (scalar, *(h[i] * a[j] - h[j] * a[i] for i, j in ((0, 1), (0, 2), (1, 2))))])


@pytest.mark.parametrize("angle", [1.0, 1e-3, 1e-5, 1e-7, 2e-9])
def test_near_the_pole_n_keeps_all_digits_and_the_turn_about_it_as_many_as_it_has(angle, rng):
    for _ in range(5):
        a = units(rng)
        side = np.cross(a, units(rng))
        side /= np.linalg.norm(side)
        n = near(-a, side, angle)
        rotor = rotor_between(a, n, side, 1, "test")
        np.testing.assert_allclose(rotor, exact_short(a, n), rtol=0, atol=5e-16 / angle)
        np.testing.assert_allclose(Rotor(rotor).matrix() @ a, n, rtol=0, atol=1e-15)
        other = rotor_between(a, -n, side, -1, "test")  # the pole of the other chart
        np.testing.assert_allclose(Rotor(other).matrix() @ a, -n, rtol=0, atol=1e-15)


@pytest.mark.parametrize("kind", [PointPair, Line, Circle, Plane])
def test_at_its_pole_a_chart_is_refused_and_the_other_works(kind):
    a = np.array(REFERENCE[kind.kind])

    def along(n):
        match kind.kind:
            case "point_pair":
                return PointPair.from_points(-np.array(n), n)
            case "line":
                return Line.from_point_direction((0, 0, 0), n)
            case "circle":
                return Circle(np.zeros(3), np.array(n), 1.0)
        return Plane.from_normal_offset(n, 0.0)

    for chart, pole in ((1, -a), (-1, a)):
        for n in (pole, pole + 0.9 * POLE * AXIS):
            with pytest.raises(cga.DegenerateError, match=rf"{kind.kind.replace('_', ' ')}: chart \{chart:+d} has no rotor at its pole"):
                similarity_of(along(n), chart)
            for other in (-chart, None):
                x = along(n).transformed(Rotor((1.0, 0, 0, 0)))
                moved = along(a).transformed(similarity_of(x, other))
                assert draws.off(moved, x) < 1e-15
        similarity_of(along(pole + 1.1 * POLE * AXIS), chart)
    with pytest.raises(cga.DegenerateError, match=r"two \w+( pair)?s: chart \+1 has no rotor"):
        similarity_between(along(a), along(-a), chart=1)
    assert draws.off(along(a).transformed(similarity_between(along(a), along(-a))), along(-a)) < 1e-15


def test_without_a_chart_the_shortest_arc_is_taken_up_to_the_seam():
    for angle, chart in ((np.arccos(-0.995) - 1e-6, 1), (np.arccos(-0.995) + 1e-6, -1), (np.pi, -1), (0.0, 1)):
        plane = Plane.from_normal_offset((0.0, np.sin(angle), np.cos(angle)), 0.3)
        np.testing.assert_array_equal(similarity_of(plane).coefficients, similarity_of(plane, chart).coefficients)


def test_charts_of_a_batch(rng):
    circles = draws.random(Circle, rng, 60)
    chart = np.where(rng.random(60) < 0.5, 1, -1)
    both = {c: similarity_of(circles, c).coefficients for c in (1, -1)}
    np.testing.assert_array_equal(similarity_of(circles, chart).coefficients, np.where(chart[:, None] > 0, both[1], both[-1]))
    assert similarity_of(draws.row(circles, 0), chart).coefficients.shape == (60, 12)
    assert similarity_of(draws.random(Sphere, rng), chart).coefficients.shape == (60, 12)


def test_the_recommended_chart_and_its_hysteresis():
    def at(cosine):
        return Circle(np.zeros(3), np.array([0.0, (1 - cosine**2) ** 0.5, cosine]), 1.0)

    assert [int(chart_of(at(c))) for c in (1.0, 0.0, -0.499, -0.501, -1.0)] == [1, 1, 1, -1, -1]
    chart, seen = None, []
    for cosine in (0.5, -0.49, -0.7, -0.89, -0.91, -0.89, -0.4, 0.4, 0.89, 0.91, 0.5, -0.6):
        chart = chart_of(at(cosine), chart)
        seen.append(int(chart))
    assert seen == [1, 1, 1, 1, -1, -1, -1, -1, -1, 1, 1, 1]
    batch = Circle(np.zeros((3, 3)), np.array([(0, 0, 1.0), (0, 0, -1.0), (0, 1.0, 0)]), 1.0)
    assert chart_of(batch).tolist() == [1, -1, 1]
    assert chart_of(batch, [-1, -1, -1]).tolist() == [1, -1, -1] and chart_of(batch, 1).tolist() == [1, -1, 1]
    for free in (Point(np.zeros((2, 3))), Sphere(np.zeros((2, 3)), 1.0)):
        assert chart_of(free).tolist() == [1, 1] and chart_of(free, -1).tolist() == [-1, -1]


def test_elements_do_not_see_the_change_of_chart(rng):
    circle = draws.random(Circle, rng, 40)
    moved = [Circle(np.zeros(3), E3, 1.0).transformed(similarity_of(circle, chart)) for chart in (1, -1)]
    assert draws.off(moved[0], moved[1]) < 1e-14


def test_wrong_charts_are_named(rng):
    circle = draws.random(Circle, rng, 3)
    for wrong in (0, 2, [1, 1, -3]):
        with pytest.raises(cga.UnknownNameError, match="unknown chart .*; known: 1, -1"):
            similarity_of(circle, wrong)
        with pytest.raises(cga.UnknownNameError, match="unknown chart"):
            chart_of(circle, wrong)
        with pytest.raises(cga.UnknownNameError, match="unknown chart"):
            similarity_of(Point((0, 0, 0)), wrong)
    with pytest.raises(cga.WrongSizeError, match="chart: not an array of numbers"):
        similarity_of(circle, "short")
    np.testing.assert_array_equal(similarity_of(circle, np.float64(-1.0)).coefficients, similarity_of(circle, -1).coefficients)
    with pytest.raises(cga.WrongSizeError, match="batch dimensions"):
        similarity_of(circle, [1, 1])
    with pytest.raises(cga.WrongSizeError, match="batch dimensions"):
        chart_of(circle, [1, 1])
    with pytest.raises(cga.UnknownNameError, match="unknown kind of element 'int'"):
        chart_of(3)
