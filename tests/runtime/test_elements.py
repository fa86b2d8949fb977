"""Primitives and motors against the algebra: outer products of points, exact rational radii, dense sandwich products, and refusals."""

from dataclasses import FrozenInstanceError
from fractions import Fraction
from functools import reduce

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector
from cga_runtime.elements import Circle, Line, Motor, Plane, Point, PointPair, Sphere

KINDS = {
    PointPair: (2, blade_types.POINT_PAIR),
    Line: (2, blade_types.LINE),
    Circle: (3, blade_types.CIRCLE),
    Plane: (3, blade_types.PLANE),
    Sphere: (4, blade_types.SPHERE),
}
ROUND = (PointPair, Circle, Sphere)
INFINITY = Multivector(blade_types.POINT, (0, 0, 0, 0, 1))


def conformal(x) -> Multivector:
    return Multivector(blade_types.POINT, (1, *x, sum(c * c for c in x) / 2))


def wedge(kind, points) -> Multivector:
    """X = P1 ^ P2 ^ ... (^ ei for the flat ones), in the algebra."""
    factors = [conformal(x) for x in points] + ([] if kind in ROUND else [INFINITY])
    return reduce(lambda a, b: a ^ b, factors).project(KINDS[kind][1])


@pytest.mark.parametrize("kind", KINDS)
def test_coefficients_are_the_unit_outer_product_of_the_points(kind, rng):
    count, blades = KINDS[kind]
    points = rng.uniform(-2, 2, (40, count, 3))
    made = kind.from_points(*np.moveaxis(points, 1, 0))
    assert kind.blades == blades.blade_names
    assert made.coefficients.shape == (40, len(blades))
    for k in range(40):
        x = wedge(kind, points[k])
        size = abs((x * ~x).coefficient(0)) ** 0.5
        # a sphere through points of the other handedness is the same sphere: its weight is signed
        sign = -1.0 if kind is Sphere and x.coefficients[0] < 0 else 1.0
        reference = sign * np.array(x.coefficients) / size
        np.testing.assert_allclose(made.coefficients[k], reference, rtol=0, atol=1e-12 * np.abs(reference).max())
        unit = Multivector(blades, tuple(made.coefficients[k]))
        scale = np.abs(made.coefficients[k]).max()
        assert (unit * ~unit).coefficient(0) == pytest.approx(-1.0, abs=1e-13 * scale**2)
        for point in points[k]:
            assert np.abs(np.array((conformal(point) ^ unit).coefficients)).max() < 1e-13 * scale**2


def test_a_point_is_a_null_vector_with_e0_coefficient_one(rng):
    x = rng.normal(size=(5, 3))
    p = Point(x)
    np.testing.assert_array_equal(p.coefficients[:, 0], 1.0)
    np.testing.assert_array_equal(p.coefficients[:, 1:4], x)
    one = Multivector(blade_types.POINT, tuple(p.coefficients[2]))
    assert (one * one).coefficient(0) == pytest.approx(0.0, abs=1e-15)
    assert Point.blades == blade_types.POINT.blade_names


def test_unit_primitives_of_the_paper():
    # table 1 of paper A with the weights of its canonical elements
    assert PointPair.from_points((0, -1, 0), (0, 1, 0)).coefficients.tolist() == [0, 1, 0, 0, 0, 0, 0, 0, -0.5, 0]
    assert Line.from_point_direction((0, 7, 0), (0, 3, 0)).coefficients.tolist() == [0, 1, 0, 0, 0, 0]
    assert Circle.from_points((1, 0, 0), (0, 1, 0), (-1, 0, 0)).coefficients.tolist() == [1, 0, 0, 0, 0, 0, 0.5, 0, 0, 0]
    assert Plane.from_points((1, 0, 0), (0, 1, 0), (-1, 0, 0)).coefficients.tolist() == [1, 0, 0, 0]
    assert Sphere.from_center_radius((0, 0, 0), 1).coefficients.tolist() == [1, 0, 0, 0, -0.5]


def test_orientation_follows_the_order_of_the_points(rng):
    a, b, c, d = rng.normal(size=(4, 3))
    for kind, points in ((PointPair, (a, b)), (Line, (a, b)), (Circle, (a, b, c)), (Plane, (a, b, c))):
        there, back = kind.from_points(*points), kind.from_points(*points[1::-1], *points[2:])
        np.testing.assert_allclose(there.coefficients, -back.coefficients, atol=1e-13)
    n = np.cross(b - a, c - a)
    np.testing.assert_allclose(Plane.from_points(a, b, c).normal, n / np.linalg.norm(n), atol=1e-15)
    np.testing.assert_allclose(Line.from_points(a, b).direction, (b - a) / np.linalg.norm(b - a), atol=1e-15)
    np.testing.assert_allclose(Sphere.from_points(a, b, c, d).coefficients, Sphere.from_points(b, a, c, d).coefficients, atol=1e-11)


def test_parameters_agree_with_the_constructors_that_take_them(rng):
    for _ in range(20):
        center, normal, radius = rng.normal(size=3), rng.normal(size=3), rng.uniform(0.1, 3)
        sphere = Sphere.from_points(*(center + radius * u / np.linalg.norm(u) for u in rng.normal(size=(4, 3))))
        np.testing.assert_allclose(sphere.center, center, atol=1e-9)  # random tetrahedra may be nearly flat
        plane = Plane.from_normal_offset(5.0 * normal, 5.0 * (normal @ center))
        np.testing.assert_allclose(plane.coefficients, Plane.from_point_normal(center, normal).coefficients, atol=1e-14)
        assert plane.center @ plane.normal == pytest.approx(plane.offset, abs=1e-14)
        line = Line.from_point_direction(center, normal)
        assert line.center @ line.direction == pytest.approx(0.0, abs=1e-14)
        assert np.linalg.norm(np.cross(line.center - center, line.direction)) < 1e-14
        u = np.linalg.svd(normal[None])[2][1:]
        circle = Circle.from_points(*(center + radius * (np.cos(t) * u[0] + np.sin(t) * u[1]) for t in (0.3, 2.0, 4.4)))
        np.testing.assert_allclose((*circle.center, circle.radius), (*center, radius), atol=1e-13)
        pair = PointPair.from_points(center, center + normal)
        np.testing.assert_allclose(pair.center, center + normal / 2, atol=1e-15)
        assert pair.radius == pytest.approx(np.linalg.norm(normal) / 2) and pair.points[1] == pytest.approx(center + normal)


def exact_circle(points):
    """Squared radius of the circle through three points, in rational numbers: (|a| |b| |c|)^2 / (4 |a x b|^2)."""
    (x1, x2, x3) = ([Fraction(float(c)) for c in x] for x in points)
    a, b, c = ([q - p for p, q in zip(u, v, strict=True)] for u, v in ((x1, x2), (x1, x3), (x2, x3)))
    n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    square = [sum(p * p for p in v) for v in (a, b, c, n)]
    return float(square[0] * square[1] * square[2] / (4 * square[3])) ** 0.5


def test_small_circles_far_away_keep_their_radius(rng):
    # size 0.01 at distance 100: read off the trivector the radius would be wrong by 4e-5
    worst = 0.0
    for _ in range(50):
        points = 100.0 * np.ones(3) / 3**0.5 + 0.01 * rng.normal(size=(3, 3))
        exact = exact_circle(points)
        worst = max(worst, abs(Circle.from_points(*points).radius / exact - 1) / max(1.0, exact / 0.01))
    assert worst < 5e-15


def test_batches_broadcast(rng):
    x, n = rng.normal(size=(4, 1, 3)), rng.normal(size=(2, 3))
    plane = Plane.from_point_normal(x, n)
    assert plane.normal.shape == (4, 2, 3) and plane.offset.shape == (4, 2) and plane.coefficients.shape == (4, 2, 4)
    sphere = Sphere.from_center_radius(x, (0.5, 0.7))
    assert sphere.center.shape == (4, 2, 3) and sphere.radius[3, 1] == 0.7 and sphere.coefficients.shape == (4, 2, 5)
    np.testing.assert_array_equal(plane.coefficients[3, 1], Plane.from_point_normal(x[3, 0], n[1]).coefficients)
    assert Circle(x, n, 2.0).radius.shape == (4, 2)


def test_elements_do_not_change(rng):
    given = rng.normal(size=3)
    point = Point(given)
    with pytest.raises(FrozenInstanceError):
        point.center = given
    with pytest.raises(ValueError, match="read-only"):
        point.center[0] = 1.0
    before = point.center.copy()
    given[:] = 0.0
    np.testing.assert_array_equal(point.center, before)


LINE_POINTS = ((1, 0, 0), (2, 0, 0), (3, 0, 0))
REFUSED = [
    (lambda: PointPair.from_points((1, 0, 0), (1, 0, 0)), cga.DegenerateError, "point pair: two of its points coincide"),
    (lambda: Line.from_points((100, 0, 0), (100, 5e-10, 0)), cga.DegenerateError, "line: two of its points coincide"),
    (lambda: Line.from_points((1e4, 0, 0), (1e4, 5e-9, 0)), cga.DegenerateError, "line: two of its points coincide"),
    (lambda: Line.from_point_direction((1, 0, 0), (0, 0, 0)), cga.DegenerateError, "line: its direction is zero"),
    (lambda: Circle.from_points(*LINE_POINTS), cga.DegenerateError, "circle: its three points lie on one line"),
    (lambda: Circle.from_points((1, 0, 0), (1, 0, 0), (0, 1, 0)), cga.DegenerateError, "circle: two of its points coincide"),
    (lambda: Circle.from_points((0, 1, 0), (1, 0, 0), (1, 0, 0)), cga.DegenerateError, "circle: two of its points coincide"),
    (lambda: Plane.from_points(*LINE_POINTS), cga.DegenerateError, "plane: its three points lie on one line"),
    (lambda: Plane.from_points((0.1, 0.2, 0.3), (0.2, 0.4, 0.6), (0.7, 1.4, 2.1)), cga.DegenerateError, "lie on one line"),
    (lambda: Plane.from_normal_offset((0, 0, 0), 1), cga.DegenerateError, "plane: its direction is zero"),
    (lambda: Sphere.from_points(*LINE_POINTS, (0, 1, 0)), cga.DegenerateError, "sphere: its four points lie in one plane"),
    (lambda: Sphere.from_points((1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)), cga.DegenerateError, "four points lie in one plane"),
    (lambda: Sphere.from_points((1, 0, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1)), cga.DegenerateError, "two of its points coincide"),
    (lambda: Sphere.from_center_radius((0, 0, 0), 0.0), cga.DegenerateError, "sphere: radius 0 given, a positive one is needed"),
    (lambda: Sphere.from_center_radius((0, 0, 0), -2.0), cga.DegenerateError, "sphere: radius -2 given"),
    (lambda: Circle(np.zeros(3), np.array([0, 0, 1.0]), -1.0), cga.DegenerateError, "circle: radius -1 given"),
    (lambda: Point((1, 2)), cga.WrongSizeError, r"point: shape \(2,\) given, \(..., 3\) needed"),
    (lambda: Point("here"), cga.WrongSizeError, "point: not an array of numbers"),
    (lambda: Point((1, 2, np.nan)), cga.NotFiniteError, "point holds NaN or infinity"),
    (lambda: Plane.from_normal_offset((0, 0, 1), np.inf), cga.NotFiniteError, "offset of a plane holds NaN or infinity"),
    (lambda: Line.from_points(np.zeros((2, 3)), np.ones((5, 3))), cga.WrongSizeError, r"batch dimensions \(2,\), \(5,\) do not broadcast"),
    (lambda: Sphere.from_center_radius(np.zeros((2, 3)), np.ones(5)), cga.WrongSizeError, "sphere: batch dimensions"),
    (lambda: Motor((1, 0, 0)), cga.WrongSizeError, r"motor: shape \(3,\) given"),
    (lambda: Motor((1, 0, 0, 0, 0, 0, 0, np.inf)), cga.NotFiniteError, "motor holds NaN or infinity"),
    (lambda: Motor((1.1, 0, 0, 0, 0, 0, 0, 0)), cga.DegenerateError, "M ~M must be 1; its scalar part is off by 2.1e-01"),
    (lambda: Motor((1, 0, 0, 0, 0, 0, 0, 0.5)), cga.DegenerateError, "its e123i part by"),
    (lambda: Motor.from_pose(np.diag([1, 1, -1, 1])), cga.DegenerateError, "a reflection"),
    (lambda: Motor.from_pose(np.diag([2, 1, 1, 1])), cga.DegenerateError, r"not a rotation, R\^T R is off by 3.0e\+00"),
    (lambda: Motor.from_pose(np.ones((4, 4)) - np.ones((4, 4)) + np.diag([1, 1, 1, 2])), cga.DegenerateError, "last row must be 0 0 0 1"),
    (lambda: Motor.from_pose(np.eye(3)), cga.WrongSizeError, r"pose: shape \(3, 3\) given"),
]


@pytest.mark.parametrize(("make", "error", "message"), REFUSED)
def test_refusals_say_what_is_wrong(make, error, message):
    with pytest.raises(error, match=message):
        make()


def test_circles_and_spheres_just_above_the_threshold_are_made():
    thin = Circle.from_points((-1, 0, 0), (0.3, 1e-8, 0), (1, 0, 0))
    assert thin.radius == pytest.approx(0.455 / 1e-8, rel=1e-3)  # the known growth 0.455 / h of this circle
    assert Sphere.from_points((1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, 0, 1e-8)).radius == pytest.approx(0.5e8, rel=1e-6)


# ---- motors


def poses(rng, count):
    """Random rigid motions, with turns by 0, tiny angles, exactly pi and nearly pi about coordinate and other axes."""
    angles = np.concatenate([[0.0, 1e-12, 1e-6, np.pi, np.pi - 1e-9, -np.pi + 1e-9], rng.uniform(-np.pi, np.pi, count - 6)])
    axes = rng.normal(size=(count, 3))
    axes[3:6] = np.eye(3)
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    k = np.zeros((count, 3, 3))
    k[:, (2, 0, 1), (1, 2, 0)], k[:, (1, 2, 0), (2, 0, 1)] = axes, -axes
    result = np.zeros((count, 4, 4))
    turn = angles[:, None, None]
    result[:, :3, :3] = np.eye(3) + np.sin(turn) * k + (1 - np.cos(turn)) * k @ k  # Rodrigues
    result[:, :3, 3], result[:, 3, 3] = rng.normal(size=(count, 3)), 1.0
    return result


def test_poses_come_back_from_their_motors(rng):
    given = poses(rng, 200)
    motors = Motor.from_pose(given)
    assert (motors.coefficients[:, 0] >= 0).all()
    np.testing.assert_allclose(motors.pose(), given, atol=1e-14)
    np.testing.assert_allclose(Motor(-motors.coefficients).pose(), given, atol=1e-14)
    np.testing.assert_array_equal(Motor.from_pose(given[7]).coefficients, motors.coefficients[7])
    assert Motor.from_pose(np.eye(4)).coefficients.tolist() == [1, 0, 0, 0, 0, 0, 0, 0]


def test_motors_carry_points_as_sandwich_products(rng):
    for pose, x in zip(poses(rng, 30), rng.normal(size=(30, 3)), strict=True):
        motor = Multivector(blade_types.MOTOR, tuple(Motor.from_pose(pose).coefficients))
        moved = motor.sandwich(conformal(x))
        np.testing.assert_allclose(moved.at("e0 e1 e2 e3"), (1.0, *(pose[:3, :3] @ x + pose[:3, 3])), atol=1e-13)


def test_product_and_reverse_are_those_of_the_algebra(rng):
    a, b = (Motor.from_pose(poses(rng, 40)) for _ in range(2))
    product = a * b
    for k in range(40):
        left, right = (Multivector(blade_types.MOTOR, tuple(m.coefficients[k])) for m in (a, b))
        np.testing.assert_allclose(product.coefficients[k], (left * right).at(Motor.blades), atol=1e-14)
        np.testing.assert_array_equal((~a).coefficients[k], (~left).at(Motor.blades))
    np.testing.assert_allclose(product.pose(), a.pose() @ b.pose(), atol=1e-14)
    np.testing.assert_allclose((a * ~a).coefficients, np.eye(8)[0] * np.ones((40, 1)), atol=1e-14)
    with pytest.raises(TypeError):
        a * 2.0
    assert Motor.blades == blade_types.MOTOR.blade_names


def test_motors_of_a_chain_are_motors_of_its_poses(arm, rng):
    q = arm.random(rng, 50)
    kernel, made = arm.motor(q), Motor.from_pose(arm.pose(q)).coefficients
    np.testing.assert_allclose(kernel * np.sign(kernel[:, :1]), made * np.sign(made[:, :1]), atol=1e-14)
