"""Inverse kinematics, checked by Pinocchio's kinematics and logarithms, by elementary distances, and by SciPy's least squares."""

import numpy as np
import pytest
from inverse_kinematics_oracle import EQUAL, KINDS, ONE, Peer, inside, primitives, single, split_error
from scipy.optimize import least_squares

import cga_runtime as cga
from cga_runtime.solve import inverse_kinematics as module
from cga_runtime.solve.ik_targets import goal
from cga_runtime.solve.inverse_kinematics import inverse_kinematics
from cga_runtime.solve.levenberg_marquardt import Box, descend

# ---- solutions


def test_poses_that_can_be_reached(arm, rng) -> None:
    peer, wanted = Peer(), arm.pose(arm.random(rng, (2, 150)))
    found = inverse_kinematics(arm, wanted)
    assert found.q.shape == (2, 150, 5) and inside(arm, found.q)
    for field in (found.success, found.residual, found.iterations, found.starts, found.status):
        assert field.shape == (2, 150)
    assert found.success.all() and (found.status == "reached").all() and (found.residual <= 1e-6).all()
    for target, q in zip(wanted.reshape(-1, 4, 4), found.q.reshape(-1, 5), strict=True):
        assert np.linalg.norm(split_error(target, peer.at(arm, q)[0])[0]) <= 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_primitives_that_can_be_reached(arm, rng, kind) -> None:
    target = primitives(arm.point(arm.random(rng, 60)), rng)[kind]
    found = inverse_kinematics(arm, target)
    assert found.success.all() and inside(arm, found.q)
    assert max(cga.distance(arm.point(found.q[k]), single(target, k)) for k in range(60)) <= 1e-6


def test_either_point_of_a_pair(arm, rng) -> None:
    ends = arm.point(arm.random(rng, 40))
    away = ends + 10.0
    for pair in (cga.PointPair.from_points(ends, away), cga.PointPair.from_points(away, ends)):
        found = inverse_kinematics(arm, pair)
        assert found.success.all()
        np.testing.assert_allclose(arm.point(found.q), ends, rtol=0, atol=1e-6)


def test_prismatic_and_endless_joints(skew, rng) -> None:
    chain = skew.chain("left_tip")
    q = chain.random(rng, 80)
    for target in (chain.pose(q), cga.Point(chain.point(q))):
        found = inverse_kinematics(chain, target)
        assert found.success.all() and inside(chain, found.q)


def test_a_joint_that_mimics_another(rng) -> None:
    """The Panda's second finger slides as far as the first one: two coordinates, the wrist's and the fingers'."""
    finger = cga.load_robot("panda").chain("panda_rightfinger", root="panda_link6")
    q = finger.random(rng, 40)
    found = inverse_kinematics(finger, finger.pose(q))
    assert finger.n == 2 and found.success.all() and inside(finger, found.q)
    np.testing.assert_allclose(found.q, q, rtol=0, atol=1e-5)  # nothing else leads there


def test_poses_out_of_reach_give_the_least_squares(arm, rng) -> None:
    """Five joints do not turn the hand as one likes. SciPy, from many starts, finds nothing better, and agrees that it is a minimum."""
    wanted = arm.pose(arm.random(rng, 5))
    wanted[:, :3, :3] = np.roll(wanted[:, :3, :3], 1, axis=0)
    found = inverse_kinematics(arm, wanted)
    assert (found.status == "least_squares").all() and not found.success.any() and (found.starts == 201).all() and inside(arm, found.q)
    options = {"bounds": (arm.lower, arm.upper), "xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-12}
    for k in range(5):
        evaluate = goal(arm, wanted[k], EQUAL).evaluate

        def solve(q, evaluate=evaluate):
            start = np.clip(q, arm.lower + 1e-9, arm.upper - 1e-9)  # SciPy wants starts inside
            return least_squares(lambda q: evaluate(ONE, q[None])[0][0], start, lambda q: evaluate(ONE, q[None])[1][0], **options)

        best = min(np.sqrt(2 * solve(q).cost) for q in arm.random(rng, 8))
        assert found.residual[k] <= best + 1e-9
        assert np.sqrt(2 * solve(found.q[k]).cost) == pytest.approx(found.residual[k], abs=1e-9)
        e, jacobian = evaluate(ONE, found.q[k][None])
        slope = (e[:, None] @ jacobian)[0, 0]
        free = (found.q[k] > arm.lower) & (found.q[k] < arm.upper)
        assert np.abs(slope[free]).max() < 1e-6
        assert (slope[found.q[k] == arm.lower] > 0).all() and (slope[found.q[k] == arm.upper] < 0).all()


def test_points_out_of_reach(arm, rng) -> None:
    """The arm stretches towards them: the nearest of 10^4 random positions is not nearer. Far ones give numbers, not NaN."""
    x = arm.point(arm.random(rng, 5)) * 4.0
    found = inverse_kinematics(arm, cga.Point(x))
    assert (found.status == "least_squares").all()
    tried = arm.point(arm.random(rng, 10_000))
    for k in range(5):
        assert found.residual[k] <= np.linalg.norm(tried - x[k], axis=1).min()
    far = np.eye(4)
    far[:3, 3] = 1e50
    for target in (far, cga.Point(far[:3, 3]), cga.Plane([1.0, 2.0, 3.0], 1e50)):
        found = inverse_kinematics(arm, target)
        assert not found.success and found.residual > 1e49 and np.isfinite(found.q).all() and inside(arm, found.q)
        assert found.status in ("least_squares", "iteration_limit")


def test_descent_to_a_minimum_that_is_not_zero(arm, rng) -> None:
    wanted = arm.pose(arm.random(rng, 50))
    wanted[:, :3, 3] *= 2.0
    rows, start = np.arange(50), arm.random(rng, 50)
    evaluate, box = goal(arm, wanted, EQUAL).evaluate, Box(arm.lower, arm.upper)
    found, stationary = descend(evaluate, rows, start, box, 1e-9, 200)
    e, _ = evaluate(rows, start)
    assert stationary.all() and (found.cost <= (e * e).sum(axis=1)).all() and found.iterations.max() < 100
    again, still = descend(evaluate, rows, found.q, box, 1e-9, 200)
    assert still.all() and (again.iterations == 0).all() and (again.q == found.q).all()


# ---- options


def test_equal_calls_give_equal_results(arm, rng) -> None:
    wanted = arm.pose(arm.random(rng, 30))
    first, second = inverse_kinematics(arm, wanted), inverse_kinematics(arm, wanted, rng=np.random.default_rng(0))
    assert (first.q == second.q).all() and (first.iterations == second.iterations).all()
    assert not (first.q == inverse_kinematics(arm, wanted, rng=np.random.default_rng(1)).q).all()


def test_one_target_has_no_leading_dimensions(arm, rng) -> None:
    pose = arm.pose(arm.random(rng))
    for target in (pose, pose.tolist(), cga.Motor.from_pose(pose)):
        found = inverse_kinematics(arm, target)
        assert found.q.shape == (5,) and found.residual.shape == found.status.shape == () and found.success and found.status == "reached"
    none = inverse_kinematics(arm, np.empty((3, 0, 4, 4)))
    assert none.q.shape == (3, 0, 5) and none.success.shape == (3, 0)


def test_the_first_start(arm, rng) -> None:
    q = arm.random(rng, 40)
    at = inverse_kinematics(arm, arm.pose(q), q)
    assert (at.iterations == 0).all() and (at.starts == 1).all() and (at.q == q).all()
    near = inverse_kinematics(arm, arm.pose(q), np.clip(q + 0.01, arm.lower, arm.upper))
    assert (near.starts == 1).mean() > 0.9 and np.median(np.abs(near.q - q).max(axis=1)) < 1e-5
    outside = inverse_kinematics(arm, arm.pose(q), np.full(5, 50.0))
    assert outside.success.all() and inside(arm, outside.q)


def test_weights(arm, rng) -> None:
    pose = arm.pose(arm.random(rng, 30))
    turned = pose.copy()
    turned[:, :3, :3] = pose[::-1, :3, :3]
    place = inverse_kinematics(arm, turned, weights=(1.0, 0.0))
    assert place.success.all()
    np.testing.assert_allclose(arm.point(place.q), turned[:, :3, 3], rtol=0, atol=1e-6)
    moved = pose.copy()
    moved[:, :3, 3] += 5.0
    turn = inverse_kinematics(arm, moved, weights=(0.0, 1.0))
    assert turn.success.all()
    np.testing.assert_allclose(arm.pose(turn.q)[:, :3, :3], moved[:, :3, :3], rtol=0, atol=1e-6)
    millimetres = inverse_kinematics(arm, pose, weights=(1000.0, 1.0), tolerance=1e-3)
    assert millimetres.success.all() and (np.linalg.norm(arm.point(millimetres.q) - pose[:, :3, 3], axis=1) <= 1e-6).all()


def test_without_limits(arm, rng) -> None:
    """Positions beyond the limits are found where they are allowed, and only there."""
    q = arm.upper + rng.uniform(0.3, 0.5, (30, 5))
    free, held = inverse_kinematics(arm, arm.pose(q), limits=False), inverse_kinematics(arm, arm.pose(q))
    assert free.success.all() and not inside(arm, free.q)
    assert not held.success.all() and inside(arm, held.q)


def test_starts_and_iterations_are_limited(arm, rng) -> None:
    wanted = arm.pose(arm.random(rng, 200))
    one = inverse_kinematics(arm, wanted, restarts=0)
    assert (one.starts == 1).all() and 0.4 < one.success.mean() < 1.0
    assert (one.iterations <= 15 + 200).all() and set(one.status.tolist()) == {"reached", "least_squares"}
    plain = inverse_kinematics(arm, wanted, method="gauss_newton", max_iterations=3)
    assert plain.iterations.max() == 3 and "iteration_limit" in plain.status
    assert (plain.success == (plain.status == "reached")).all()


def test_many_targets_are_solved_in_blocks(arm, rng, monkeypatch) -> None:
    monkeypatch.setattr(module, "BLOCK", 7)
    q = arm.random(rng, 20)
    found = inverse_kinematics(arm, arm.pose(q), q + 0.01)
    assert found.success.all()
    np.testing.assert_allclose(arm.pose(found.q), arm.pose(q), rtol=0, atol=1e-6)
