"""Nearest points, distances and incidence: no sampled point is nearer, exact rational products, and the questions that have no answer."""

import warnings
from fractions import Fraction

import element_draws as draws
import numpy as np
import pytest
from element_draws import COUNTS

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector as Exact
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.distances import contains, distance, incidence, project


def spread(x, rng, count):
    """Points of an element, dense near everything that the test points can be near to."""
    v = rng.normal(size=(count, 3))
    match x:
        case Point():
            return x.center[None]
        case PointPair():
            return x.points
        case Line():
            return x.center + rng.uniform(-20, 20, (count, 1)) * x.direction
        case Plane():
            v = rng.uniform(-10, 10, (count, 3))
            return v - (v @ x.normal - x.offset)[:, None] * x.normal
        case Circle():
            away = np.cross(v, x.normal)
            return x.center + x.radius * away / np.linalg.norm(away, axis=-1, keepdims=True)
        case Sphere():
            return x.center + x.radius * v / np.linalg.norm(v, axis=-1, keepdims=True)


@pytest.mark.parametrize("kind", COUNTS)
def test_the_projection_lies_on_the_element_and_no_other_point_is_nearer(kind, rng):
    for _ in range(10):
        x = draws.random(kind, rng)
        points = 2.0 * rng.normal(size=(30, 3))
        feet, lengths = project(points, x), distance(points, x)
        assert feet.shape == (30, 3) and lengths.shape == (30,)
        size = max(1.0, np.linalg.norm(x.center), getattr(x, "radius", 1.0))
        assert distance(feet, x).max() < 5e-15 * size and contains(x, feet, 1e-13 * size).all()
        np.testing.assert_allclose(np.linalg.norm(points - feet, axis=-1), lengths, rtol=1e-13, atol=5e-15 * size)
        np.testing.assert_allclose(project(feet, x), feet, rtol=0, atol=2e-14 * size)
        others = np.linalg.norm(points[:, None] - spread(x, rng, 3000), axis=-1).min(axis=1)
        assert (others >= lengths - 1e-14 * size).all()


def test_known_distances():
    circle = Circle(np.array([0, 0, 1.0]), np.array([0, 0, 1.0]), np.array(3.0))
    assert distance((0, 0, 5), circle) == 5.0 and distance((7, 0, 4), circle) == 5.0 and distance((0, -3, 1), circle) == 0.0
    np.testing.assert_allclose(project((7, 0, 4), circle), (3, 0, 1), atol=1e-15)
    pair = PointPair.from_points((0, 0, 0), (4, 0, 0))
    assert distance((4, 3, 0), pair) == 3.0 and project((3, 1, 0), pair).tolist() == [4, 0, 0] and distance((2, 0, 0), pair) == 2.0
    assert distance(Point((1, 2, 3)), Plane((0, 0, 2), 2.0)) == 2.0 and project(Point((1, 2, 3)), Plane((0, 0, 2), 2.0)).tolist() == [
        1,
        2,
        1,
    ]
    sphere = Sphere.from_center_radius((0, 0, 0), 2.0)
    assert distance((0, 0, 0), sphere) == 2.0 and project((0, 0, 0.5), sphere).tolist() == [0, 0, 2.0]
    assert contains(sphere, [(2, 0, 0), (2, 1e-3, 0), (0, 0, 0)], 1e-6).tolist() == [True, True, False]
    assert contains(sphere, (2 + 5e-10, 0, 0)) and not contains(sphere, (2 + 2e-9, 0, 0))


def test_batches_broadcast(rng):
    x, points = draws.random(Circle, rng, 4, 1), rng.normal(size=(5, 3))
    assert distance(points, x).shape == contains(x, points).shape == (4, 5) and project(points, x).shape == (4, 5, 3)
    assert incidence(points, x).coefficients.shape == (4, 5, 5)
    np.testing.assert_allclose(distance(points, x)[2, 3], distance(points[3], draws.row(x, (2, 0))), rtol=1e-14)
    assert project(points, draws.random(Point, rng)).shape == (5, 3)


def exact_incidence(x, element):
    """P ^ X in rational numbers from the floats of the coefficients."""
    p = [Fraction(float(c)) for c in x]
    point = Exact(blade_types.POINT, (Fraction(1), *p, sum(c * c for c in p) / 2))
    whole = point ^ Exact(blade_types.FULL, tuple(Fraction(float(c)) for c in draws.full(element)))
    return np.array([float(whole.coefficient(mask)) for mask in range(32)])


@pytest.mark.parametrize("kind", COUNTS)
def test_incidence_is_the_outer_product_with_the_point(kind, rng):
    for _ in range(8):
        element, x = draws.random(kind, rng), rng.normal(size=3)
        ours, exact = incidence(x, element), exact_incidence(x, element)
        assert ours.blades == (Point(x) ^ element).blades
        np.testing.assert_allclose(draws.full(ours), exact, rtol=0, atol=1e-13 * np.abs(element.coefficients).max() * (1 + x @ x))
        foot = project(x, element)
        assert np.abs(incidence(foot, element).coefficients).max() < 1e-13 * np.abs(element.coefficients).max() * (1 + foot @ foot)


def test_incidence_far_from_the_origin_tells_on_from_off():
    place = np.array([100.0, 0.0, 0.0])
    sphere = Sphere.from_center_radius(place, 1 / 64)
    on, off = incidence(place + (0, 1 / 64, 0), sphere), incidence(place + (0, 1 / 64 + 1e-12, 0), sphere)
    assert on.coefficients.tolist() == [0.0] and off.coefficients[0] == pytest.approx(1e-12, rel=1e-3, abs=0)
    plain = Point(place + (0, 1 / 64 + 1e-12, 0)) ^ sphere
    assert abs(plain.coefficients[0] - 1e-12) >= 1e-12  # all rounding


def test_planes_and_spheres_give_lengths(rng):
    x = rng.normal(size=(20, 3))
    plane, sphere = draws.random(Plane, rng), draws.random(Sphere, rng)
    np.testing.assert_allclose(np.abs(incidence(x, plane).coefficients[:, 0]), distance(x, plane), rtol=1e-12)
    away = np.linalg.norm(x - sphere.center, axis=-1)
    np.testing.assert_allclose(
        np.abs(incidence(x, sphere).coefficients[:, 0]), np.abs(away**2 - sphere.radius**2) / 2 / sphere.radius, rtol=1e-11
    )


def test_equation_4_has_the_foot_only_on_flat_elements(rng):
    """(P.X) X^-1 (paper A, eq. 4): e1..e3 over e0 is the foot on lines and planes, but the element is no point; on spheres neither."""
    x = rng.normal(size=3)
    for kind in (Line, Plane, Sphere):
        element = draws.random(kind, rng)
        projected = (Point(x) | element) * element  # X^-1 = +-X, a factor that the quotient below does not see
        found = np.array([projected[name] for name in ("e1", "e2", "e3")]) / projected["e0"]
        null = (projected.grade(1) * projected.grade(1))["1"] / projected["e0"] ** 2
        assert np.allclose(found, project(x, element), atol=1e-12) == (kind is not Sphere)
        assert abs(null) > 1e-3


NOWHERE = [
    ((1, 2, 3), Sphere.from_center_radius((1, 2, 3), 5.0), "a point at the centre of the sphere has no one nearest point"),
    ((1, 2, 9), Circle((1, 2, 3), (0, 0, 1), 5.0), "a point on the axis of the circle"),
    ((1, 2, 3), Circle((1, 2, 3), (0, 1, 1), 5.0), "a point on the axis of the circle"),
    ((1 + 4e-16, 2, 3), Sphere.from_center_radius((1, 2, 3), 5.0), "a point at the centre of the sphere"),
    ((0.1 + 0.2, 5, -7), PointPair.from_points((0.2, 0, 0), (0.4, 0, 0)), "a point in the middle plane of the point pair"),
    ((0, 5, -7), PointPair.from_points((1, 0, 0), (-1, 0, 0)), "a point in the middle plane of the point pair"),
]


@pytest.mark.parametrize(("x", "element", "message"), NOWHERE)
def test_where_several_points_are_nearest_there_is_no_projection(x, element, message):
    with warnings.catch_warnings(), pytest.raises(cga.DegenerateError, match=f"project: {message}"):
        warnings.simplefilter("error")
        project(x, element)
    assert np.isfinite(distance(x, element)) and not contains(element, x)
    beside = np.array(x) + (1e-6, 0.0, 0.0)
    assert distance(project(beside, element), element) < 1e-14
    with pytest.raises(cga.DegenerateError):  # one row of many
        project([beside, x], element)


def test_wrong_arguments_are_named():
    ball = Sphere.from_center_radius((0, 0, 0), 1.0)
    with pytest.raises(cga.UnknownNameError, match="unknown kind of element 'ndarray'; known: .*sphere"):
        distance((0, 0, 0), np.zeros(3))
    with pytest.raises(cga.WrongSizeError, match=r"point: shape \(2,\) given"):
        project((0, 0), ball)
    with pytest.raises(cga.WrongSizeError, match="distance from a sphere: batch dimensions"):
        distance(np.zeros((2, 3)), Sphere.from_center_radius(np.zeros((3, 3)), 1.0))
    with pytest.raises(cga.NotFiniteError, match="point holds NaN"):
        contains(ball, (0, 0, np.nan))
    with pytest.raises(cga.DegenerateError, match="point: it lies more than"):
        distance((1e200, 0, 0), ball)
