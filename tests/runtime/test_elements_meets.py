"""Meets and intersections: elementary geometry on both sides, the blade of equation 5 against the real intersection, and every refusal."""

import warnings

import element_draws as draws
import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector as Exact
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.distances import contains, distance
from cga_runtime.elements.meets import intersection, meet
from cga_runtime.elements.reading import element_of
from cga_runtime.motors import Motor
from cga_runtime.multivectors import Multivector

(X, Y, Z), ORIGIN = np.eye(3), np.zeros(3)


def samples(x):
    """Points of an element, some on each side of its centre."""
    match x:
        case Point():
            return x.center[None]
        case PointPair():
            return x.points
        case Line():
            return x.center + np.linspace(-3, 3, 7)[:, None] * x.direction
        case Circle():
            u, v = np.linalg.svd(x.normal[None])[2][1:]
            angle = np.linspace(0, 6, 7)[:, None]
            return x.center + x.radius * (np.cos(angle) * u + np.sin(angle) * v)


def on(x, rng):
    """A random point of a line, circle, plane or sphere."""
    v = rng.normal(size=3)
    match x:
        case Line():
            return x.center + rng.normal() * x.direction
        case Plane():
            return v - (v @ x.normal - x.offset) * x.normal
        case Circle():
            away = np.cross(v, x.normal)
            return x.center + x.radius * away / np.linalg.norm(away)
        case Sphere():
            return x.center + x.radius * v / np.linalg.norm(v)


GENERIC = [(Plane, Plane, Line), (Line, Plane, None), (Sphere, Sphere, Circle), (Plane, Sphere, Circle), (Line, Sphere, PointPair)]
GENERIC += [(Circle, Plane, PointPair), (Circle, Sphere, PointPair)]


@pytest.mark.parametrize(("first", "second", "shared"), GENERIC)
def test_the_meet_is_a_positive_multiple_of_the_intersection_or_imaginary(first, second, shared, rng):
    seen = {"real": 0, "none": 0}
    for _ in range(60):
        given = draws.random(first, rng), draws.random(second, rng)
        for a, b in (given, given[::-1]):
            blade = meet(a, b)
            try:
                found = intersection(a, b)
            except cga.DegenerateError as error:
                assert "disjoint" in str(error)
                with pytest.raises(cga.DegenerateError, match="imaginary"):
                    element_of(blade)
                seen["none"] += 1
                continue
            seen["real"] += 1
            size = max(1.0, np.linalg.norm(found.center), np.linalg.norm(a.center), np.linalg.norm(b.center))
            size = max(size, *(getattr(x, "radius", 0.0) for x in given))
            assert distance(samples(found), a).max() < 1e-11 * size and distance(samples(found), b).max() < 1e-11 * size
            if shared is None:  # of a line and a plane: the flat point P ^ ei
                expected = Point(found.center) ^ Multivector([1.0], ["ei"])
            else:
                assert type(found) is shared
                expected = found
            lines = draws.full(blade), draws.full(expected)
            factor = (lines[0] @ lines[1]) / (lines[1] @ lines[1])
            assert factor > 0 or shared is None
            np.testing.assert_allclose(lines[0], factor * lines[1], rtol=0, atol=1e-10 * np.abs(lines[0]).max())
    assert seen["real"] >= 30 and (seen["none"] >= 4 or first in (Plane, Line) and second is Plane)


def test_meets_are_those_of_the_exact_algebra(rng):
    for first, second in [(Line, Line), (Circle, Circle), (Line, Circle), *((a, b) for a, b, _ in GENERIC)]:
        a, b = draws.random(first, rng), draws.random(second, rng)
        exact = [Exact(blade_types.FULL, tuple(draws.full(x))).dual() for x in (a, b)]
        reference = np.array([float((exact[0] ^ exact[1]).dual().coefficient(mask)) for mask in range(32)])
        np.testing.assert_allclose(draws.full(meet(a, b)), reference, rtol=0, atol=1e-13 * np.abs(reference).max())
        opposite = draws.full(meet(a, b).dual().dual())  # X** = -X: the meet with X* = -X I on both sides
        np.testing.assert_array_equal(opposite, -draws.full(meet(a, b)))
    assert meet(draws.random(Plane, rng, 4, 1), draws.random(Sphere, rng, 3)).coefficients.shape == (4, 3, 10)
    assert meet(Point(ORIGIN), Point(X)).blades == ()


@pytest.mark.parametrize("kinds", [(Line, Line), (Line, Circle), (Circle, Circle)])
def test_curves_through_one_point_meet_there(kinds, rng):
    for _ in range(40):
        first = draws.random(kinds[0], rng)
        x = on(first, rng)
        second = Line.from_points(x, rng.normal(size=3)) if kinds[1] is Line else Circle.from_points(x, *rng.normal(size=(2, 3)))
        for a, b in ((first, second), (second, first)):
            found = intersection(a, b, tolerance=1e-8)
            assert isinstance(found, Point)
            sine = np.linalg.norm(np.cross(*(getattr(c, "direction", None) if c.kind == "line" else c.normal for c in (a, b))))
            np.testing.assert_allclose(found.center, x, atol=1e-8 / min(1.0, sine))


def test_lines_and_circles_of_one_plane_meet_in_pairs(rng):
    motor = Motor.exp(rng.normal(size=6))
    unit, shifted = Circle(ORIGIN, Z, 1.0), Circle(X, Z, 1.0)
    high = 0.75**0.5
    expected = PointPair.from_points((0.5, -high, 0), (0.5, high, 0))
    line = Line.from_point_direction((0.5, 7, 0), (0, 2, 0))
    for a, b, pair in ((unit, shifted, expected), (line, unit, expected), (unit, line, expected)):
        for move in (Motor.exp(np.zeros(6)), motor):
            found = intersection(a.transformed(move), b.transformed(move))
            assert draws.off(found, pair.transformed(move)) < 1e-14
    back = intersection(shifted, unit)
    assert draws.off(back, PointPair.from_points(*expected.points[::-1])) < 1e-14
    spheres = Sphere.from_center_radius(ORIGIN, 2.0), Sphere.from_center_radius((1, 0, 0), 2.0)
    tilted = [
        intersection(Plane.from_point_normal(p, n), spheres[0]) for p, n in (((0.5, 0, 0), (1, 0.2, 0)), ((0.5, 0, 0), (1, -0.3, 0.1)))
    ]
    found = intersection(*tilted)  # two circles of one sphere that cross twice
    assert isinstance(found, PointPair) and all(contains(x, found.points, 1e-14).all() for x in tilted)
    assert np.dot(found.direction, np.cross(tilted[0].normal, tilted[1].normal)) > 0


TOUCHING = [
    (Sphere.from_center_radius(ORIGIN, 1.0), Sphere.from_center_radius(3 * X, 2.0), X),
    (Sphere.from_center_radius(ORIGIN, 1.0), Sphere.from_center_radius(X, 2.0), -X),
    (Sphere.from_center_radius(X, 2.0), Sphere.from_center_radius(ORIGIN, 1.0), -X),
    (Plane(Z, 1.0), Sphere.from_center_radius(ORIGIN, 1.0), Z),
    (Line.from_point_direction(Y, X), Sphere.from_center_radius(ORIGIN, 1.0), Y),
    (Line.from_point_direction(Y, X), Circle(ORIGIN, Z, 1.0), Y),
    (Circle(ORIGIN, Z, 1.0), Plane(X, -1.0), -X),
    (Circle(ORIGIN, Z, 1.0), Sphere.from_center_radius(3 * X, 2.0), X),
    (Circle(ORIGIN, Z, 1.0), Sphere.from_center_radius(Z + X, 1.0), X),  # the sphere touches the circle's plane
    (Circle(ORIGIN, Z, 1.0), Circle(3 * X, Z, 2.0), X),
    (Circle(ORIGIN, Z, 1.0), Circle(X, Y, 2.0), -X),
    (Line.from_point_direction(ORIGIN, X), Line.from_point_direction(X, Y), X),
    (Line.from_point_direction(X, Z), Circle(ORIGIN, Z, 1.0), X),
    (Line.from_point_direction(ORIGIN, (1, 1, 1)), Plane(X, 2.0), (2, 2, 2)),
]


@pytest.mark.parametrize("case", TOUCHING, ids=lambda case: f"{case[0].kind}-{case[1].kind}")
def test_elements_that_touch_meet_in_a_point(case):
    a, b, x = case
    for first, second in ((a, b), (b, a)):
        found = intersection(first, second)
        assert isinstance(found, Point)
        np.testing.assert_allclose(found.center, x, atol=1e-15)
    if {a.kind, b.kind} <= {"sphere", "plane", "line"} and {a.kind, b.kind} != {"line"} and {a.kind, b.kind} != {"line", "plane"}:
        with pytest.raises(cga.DegenerateError, match="its radius is zero"):
            element_of(meet(a, b))


UNIT = Circle(ORIGIN, Z, 1.0)
BALL = Sphere.from_center_radius(ORIGIN, 1.0)
AXIS = Line.from_point_direction(ORIGIN, Z)
FLOOR = Plane(Z, 0.0)
NONE = [
    (FLOOR, Plane(Z, 1.0), "the two planes are parallel"),
    (FLOOR, Plane(-Z, 1.0), "the two planes are parallel"),
    (FLOOR, Plane(-Z, 0.0), "the two planes are one plane"),
    (Plane(Z, 1.0), Plane(-Z, -1.0), "the two planes are one plane"),
    (Line.from_point_direction(Z, X), FLOOR, "the line and the plane are parallel"),
    (Line.from_point_direction(Y, X), FLOOR, "the line and the plane share the whole line, which lies in the plane"),
    (AXIS, Line.from_point_direction(X, -Z), "the two lines are parallel"),
    (AXIS, Line.from_point_direction(5 * Z, -Z), "the two lines are one line"),
    (AXIS, Line.from_point_direction(X, Y), "the two lines are skew, 1 m apart"),
    (BALL, Sphere.from_center_radius(4 * X, 1.0), "the two spheres are disjoint, 2 m apart"),
    (BALL, Sphere.from_center_radius(0.1 * X, 3.0), "the two spheres are disjoint, one inside the other"),
    (BALL, Sphere.from_center_radius(ORIGIN, 2.0), "the two spheres are disjoint, one inside the other"),
    (BALL, Sphere.from_center_radius(ORIGIN, 1.0), "the two spheres are one sphere"),
    (BALL, Plane(Z, 3.0), "the plane and the sphere are disjoint, 2 m apart"),
    (Line.from_point_direction(3 * X, Z), BALL, "the line and the sphere are disjoint, 2 m apart"),
    (UNIT, Plane(Z, 3.0), "the circle and the plane are parallel"),
    (UNIT, FLOOR, "the circle and the plane share the whole circle, which lies in the plane"),
    (UNIT, Plane(X, 3.0), "the circle and the plane are disjoint, 2 m apart"),
    (UNIT, BALL, "the circle and the sphere share the whole circle, which lies in the sphere"),
    (UNIT, Sphere.from_center_radius(5 * Z, 1.0), "the circle and the sphere are disjoint, the plane of the circle 4 m from the sphere"),
    (UNIT, Sphere.from_center_radius(5 * X, 1.0), "the circle and the sphere are disjoint, 3 m apart"),
    (UNIT, Sphere.from_center_radius(ORIGIN, 3.0), "the circle and the sphere are disjoint, one inside the other"),
    (Line.from_point_direction(Z, X), UNIT, "the line and the circle are disjoint, the line parallel to the plane of the circle"),
    (Line.from_point_direction(3 * Y, X), UNIT, "the line and the circle are disjoint, 2 m apart"),
    (AXIS, UNIT, "the line and the circle are disjoint, the line passes the plane of the circle 1 m from the circle"),
    (UNIT, Circle(Z, -Z, 1.0), "the two circles are disjoint, in parallel planes"),
    (UNIT, Circle(ORIGIN, -Z, 1.0), "the two circles are one circle"),
    (UNIT, Circle(ORIGIN, Z, 2.0), "the two circles are disjoint, one inside the other"),
    (UNIT, Circle(X, Y, 0.5), "the two circles are disjoint"),
    (UNIT, Circle(3 * X, Y, 0.5), "the two circles are disjoint"),
]


@pytest.mark.parametrize(("a", "b", "why"), NONE)
def test_refusals_say_why(a, b, why):
    for first, second in ((a, b), (b, a)):
        with warnings.catch_warnings(), pytest.raises(cga.DegenerateError) as error:
            warnings.simplefilter("error")
            intersection(first, second)
        assert str(error.value).startswith(f"intersection: {why}")


def test_the_tolerance_is_a_length():
    near = Line.from_point_direction(1e-3 * X, Y)
    with pytest.raises(cga.DegenerateError, match="skew, 0.001 m apart"):
        intersection(
            Line.from_point_direction(ORIGIN, Z + Y).transformed(Motor.exp(np.zeros(6))), Line.from_point_direction(1e-3 * X, Y - Z)
        )
    assert isinstance(intersection(AXIS, near, tolerance=2e-3), Point)
    apart = Sphere.from_center_radius((2 + 1e-6) * X, 1.0)
    with pytest.raises(cga.DegenerateError, match="disjoint, 1e-06 m apart"):
        intersection(BALL, apart)
    assert isinstance(intersection(BALL, apart, tolerance=1e-5), Point)
    overlapping = intersection(BALL, Sphere.from_center_radius((2 - 1e-8) * X, 1.0))
    assert isinstance(overlapping, Circle) and overlapping.radius == pytest.approx(1e-4, rel=1e-6, abs=0)  # sqrt(2 r gap / 2)


def test_small_intersections_far_away_keep_their_size(rng):
    place = np.array([100.0, -60.0, 80.0])
    a, b = Sphere.from_center_radius(place, 0.01), Sphere.from_center_radius(place + (0.01, 0, 0), 0.01)
    gap = b.center[0] - a.center[0]
    assert intersection(a, b).radius == pytest.approx((0.01**2 - gap**2 / 4) ** 0.5, rel=1e-14, abs=0)
    assert abs(element_of(meet(a, b))[0].radius / intersection(a, b).radius - 1) > 1e-13  # which the meet does not


def test_other_kinds_and_batches_are_refused(rng):
    for wrong in (Point(ORIGIN), PointPair.from_points(ORIGIN, X)):
        with pytest.raises(cga.UnknownNameError, match=f"to intersect '{wrong.kind}'; known: line, circle, plane, sphere"):
            intersection(BALL, wrong)
    with pytest.raises(cga.UnknownNameError, match="to intersect 'ndarray'"):
        intersection(ORIGIN, BALL)
    with pytest.raises(cga.WrongSizeError, match=r"intersection: a circle of batch shape \(2,\) given, single elements needed"):
        intersection(draws.random(Circle, rng, 2), BALL)
