"""Hyperspheres through five lifted points: their accuracy against exact rationals, and what constant and balanced lifts mean."""

from fractions import Fraction
from itertools import permutations

import numpy as np
import pytest

from cga_runtime.elements import Sphere
from cga_runtime.errors import DegenerateError, WrongSizeError
from cga_runtime.spaces.cooperative_kernels import primitive_unit
from cga_runtime.spaces.hypersphere import LIFT, Hypersphere

CONSTANT = {"one": np.array([0.0, 0.0, 0.0, 0.0, LIFT]), "several": np.array([0.03, -0.05, 0.0, 0.08, 0.02])}


@pytest.fixture(params=[*CONSTANT, "balanced"])
def lift(request):
    """Points -> their lifts."""
    if request.param == "balanced":
        return balanced
    return lambda points: np.broadcast_to(CONSTANT[request.param], points.shape[:-1])


def balanced(points, length=LIFT):
    return length * primitive_unit("hypersphere").kernel("dependency")(points)


def through(points, lift):
    return Hypersphere.from_points(points, lift(points))


def close(found, expected, tolerance):
    assert np.shape(found) == np.shape(expected)
    assert np.abs(found - expected).max() <= tolerance * np.abs(expected).max()


@pytest.mark.parametrize("distance", [0.0, 100.0])
def test_accuracy(lift, rng, distance):
    """Within 2e-15 times the condition of the edges of the exact hypersphere through points centimetres apart."""
    points = distance + rng.uniform(-0.05, 0.05, (20, 5, 3))
    found = through(points, lift)
    for k, x in enumerate(np.concatenate([points, lift(points)[..., None]], axis=-1)):
        rows = [[Fraction(float(b)) - Fraction(float(a)) for a, b in zip(x[0], y, strict=True)] for y in x[1:]]
        numbers, right = np.array(rows, dtype=float), [sum(t * t for t in row) / 2 for row in rows]
        arm = np.linalg.solve(numbers, np.array(right, dtype=float))
        for _ in range(2):  # refined with exact residuals
            rest = [b - sum(t * Fraction(float(y)) for t, y in zip(row, arm, strict=True)) for row, b in zip(rows, right, strict=True)]
            arm = arm + np.linalg.solve(numbers, np.array(rest, dtype=float))
        bound = 2e-15 * np.linalg.cond(numbers) * np.linalg.norm(arm)
        assert abs(found.radius[k] - np.linalg.norm(arm)) < bound
        assert np.abs(found.center[k] - (x[0] + arm)).max() < bound + 2e-16 * distance


def test_one_lift_gives_the_sphere_of_four_and_the_power_of_the_fifth(rng):
    points = rng.uniform(-0.1, 0.1, (8, 5, 3))
    found = Hypersphere.from_points(points, CONSTANT["one"])
    sphere = Sphere.from_points(*np.moveaxis(points[:, :4], 1, 0))
    close(found.center[:, :3], sphere.center, 1e-11)
    close(found.radius**2 - found.center[:, 3] ** 2, sphere.radius**2, 1e-11)
    power = ((points[:, 4] - sphere.center) ** 2).sum(-1) - sphere.radius**2
    close(found.powers(LIFT)[:, 0], power, 1e-11)
    close(found.center[:, 3], (power + LIFT**2) / (2 * LIFT), 1e-11)
    again = Hypersphere.from_slice(sphere.center, sphere.radius, found.center[:, 3])
    close(again.radius, found.radius, 1e-11)
    close(again.center, found.center, 1e-11)


def test_rigid_motions_carry_it_and_scaling_does_not(lift, rng):
    points = rng.uniform(-0.1, 0.1, (5, 3))
    turn, shift = np.linalg.qr(rng.standard_normal((3, 3)))[0], np.array([0.3, -0.2, 0.1])
    turn = turn * np.linalg.det(turn)
    before, after = through(points, lift), through(points @ turn.T + shift, lift)
    close(after.center, np.append(turn @ before.center[:3] + shift, before.center[3]), 1e-11)
    close(after.radius, before.radius, 1e-11)
    assert abs(through(2 * points, lift).radius / before.radius - 2) > 1e-3
    scaled = Hypersphere.from_points(2 * points, 2 * lift(points))
    close(scaled.center, 2 * before.center, 1e-14)


def test_balanced_lifts_are_those_of_least_squares(rng):
    for length in (LIFT, 1e-6):
        points = rng.uniform(-0.1, 0.1, (5, 3))
        h, found = balanced(points, length), through(points, lambda x, length=length: balanced(x, length))
        assert abs(np.linalg.norm(h) - length) < 1e-15 and abs(h.sum()) < 1e-15 and np.abs(h @ points).max() < 1e-16
        fit, (rest,), *_ = np.linalg.lstsq(np.column_stack([2 * points, np.ones(5)]), (points**2).sum(1) + h**2)
        close(found.center[:3], fit[:3], 1e-8)
        rho_square = ((points[0] - found.center[:3]) ** 2).sum() - h[0] * (2 * found.center[3] - h[0])
        close(rho_square, fit[3] + fit[:3] @ fit[:3], 1e-8)
        if length < 1e-3:
            close(abs(2 * length * found.center[3]), np.sqrt(rest), 1e-6)


def test_balanced_lifts_treat_points_alike(rng):
    points = rng.uniform(-0.1, 0.1, (5, 3))
    found = through(points, balanced)
    signs = set()
    for order in list(permutations(range(5)))[1::5]:
        other = through(points[list(order)], balanced)
        even = round(np.linalg.det(np.eye(5)[list(order)]))  # an odd exchange turns the dependency round: a mirror image
        signs.add(even)
        close(other.center, found.center * [1, 1, 1, even], 1e-11)
        close(other.radius, found.radius, 1e-11)
    assert signs == {1, -1}


def test_balanced_lifts_hold_where_constant_ones_fail(rng):
    """Four coplanar tips, as those of parallel fingers with the thumb."""
    points = rng.uniform(-0.1, 0.1, (5, 3))
    points[:4, 2] = 0.05
    with pytest.raises(DegenerateError, match="with one that differs, where the other four points are coplanar"):
        Hypersphere.from_points(points, CONSTANT["one"])
    assert through(points, balanced).radius < 1.0
    points[4, 2] = 0.05
    for lifts in (CONSTANT["one"], balanced(points)):
        with pytest.raises(DegenerateError, match="with balanced lifts, where all five are"):
            Hypersphere.from_points(points, lifts)


def test_points_that_coincide_are_named(rng):
    points, lifts = rng.uniform(-0.1, 0.1, (2, 5, 3)), CONSTANT["one"]
    with pytest.raises(DegenerateError, match="lie in one hyperplane"):
        Hypersphere.from_points(points, np.zeros(5))
    points[1, 4] = points[1, 0]  # the lift holds them apart
    assert Hypersphere.from_points(points, lifts).radius.shape == (2,)
    points[1, 2] = points[1, 0]
    with pytest.raises(DegenerateError, match=r"points 1 and 3 coincide, lifts included \(within 1e-09 m\)"):
        Hypersphere.from_points(points, lifts)


def test_shapes_are_checked(rng):
    points = rng.uniform(-0.1, 0.1, (3, 5, 3))
    assert Hypersphere.from_points(points[0], np.tile(CONSTANT["one"], (4, 1))).center.shape == (4, 4)
    with pytest.raises(WrongSizeError, match="points and lifts: batch dimensions"):
        Hypersphere.from_points(points, np.tile(CONSTANT["one"], (2, 1)))
    with pytest.raises(WrongSizeError, match="centre, radius and height: batch dimensions"):
        Hypersphere.from_slice(points[:, 0], np.ones(2), 0.1)
    with pytest.raises(DegenerateError, match="radius 0 given, a positive one is needed"):
        Hypersphere(np.zeros(4), 0.0)
    assert not through(points[0], balanced).center.flags.writeable
