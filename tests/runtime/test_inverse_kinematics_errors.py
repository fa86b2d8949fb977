"""The errors that inverse kinematics drives to zero, and their Jacobians, against Pinocchio's logarithms and elementary distances."""

import numpy as np
import pinocchio
import pytest
from inverse_kinematics_oracle import EQUAL, KINDS, ONE, Peer, primitives, single, split_error

import cga_runtime as cga
from cga_runtime.solve.ik_targets import goal
from cga_runtime.solve.inverse_kinematics import inverse_kinematics


def test_the_error_of_a_pose_and_its_jacobian(arm, rng) -> None:
    peer, targets, q = Peer(), arm.random(rng, 20), arm.random(rng, 20)
    targets[0] = q[0]  # no error
    targets[1] = q[1] + 1e-9  # hardly any
    wanted = [peer.at(arm, at)[0] for at in targets]
    e, jacobian = goal(arm, np.array(wanted), (2.0, 3.0)).evaluate(np.arange(20), q)
    for k in range(20):
        pose, body = peer.at(arm, q[k])
        error, turn = split_error(wanted[k], pose)
        np.testing.assert_allclose(e[k], np.repeat([2.0, 3.0], 3) * error, rtol=0, atol=1e-13)
        rates = np.concatenate([2.0 * turn @ body[:3], 3.0 * pinocchio.Jlog3(turn) @ body[3:]])
        np.testing.assert_allclose(jacobian[k], rates, rtol=0, atol=1e-10 if k == 1 else 1e-12)  # Jlog3 loses digits at 1e-9


@pytest.mark.parametrize("turned", [0.3, 1.0, 1e-5, 1e-3])
def test_the_error_near_its_limits(arm, rng, turned) -> None:
    """Half turns but for `turned`, and small turns: the derivative along a line is the difference quotient."""
    q = arm.random(rng, 8)
    pose = arm.pose(q)
    for angle in (np.pi - turned, turned):
        target = pose.copy()
        target[:, :3, :3] = pose[:, :3, :3] @ pinocchio.exp3(angle * np.array([0.6, 0.0, 0.8])).T
        wanted, direction = goal(arm, target, EQUAL), rng.normal(size=5)
        rows, h = np.arange(8), 1e-6
        e, jacobian = wanted.evaluate(rows, q)
        np.testing.assert_allclose(np.linalg.norm(e[:, 3:], axis=1), angle, rtol=1e-9)
        slope = (wanted.evaluate(rows, q + h * direction)[0] - wanted.evaluate(rows, q - h * direction)[0]) / (2 * h)
        if angle + h * np.abs(direction).sum() < np.pi:  # else the short way round changes within the step
            np.testing.assert_allclose(jacobian @ direction, slope, rtol=0, atol=1e-7)


def test_the_long_way_round(arm, rng) -> None:
    """As printed, the error turns by up to 2 pi: by 2 pi less than the short way where the motors' signs differ."""
    q = arm.random(rng, 30)
    motors, rows = arm.motor(arm.random(rng, 30)), np.arange(30)
    either = [goal(arm, cga.Motor(sign * motors), EQUAL, shortest=False) for sign in (1, -1)]
    short, _ = goal(arm, cga.Motor(motors), EQUAL).evaluate(rows, q)
    (one, jacobian), (other, _) = (wanted.evaluate(rows, q) for wanted in either)
    angles = np.linalg.norm(one[:, 3:], axis=1) + np.linalg.norm(other[:, 3:], axis=1)
    np.testing.assert_allclose(angles, 2 * np.pi, rtol=1e-12)
    shorter = np.minimum(np.linalg.norm(one, axis=1), np.linalg.norm(other, axis=1))
    np.testing.assert_allclose(shorter, np.linalg.norm(short, axis=1), rtol=1e-12)
    h = 1e-6 * rng.normal(size=5)
    slope = either[0].evaluate(rows, q + h)[0] - either[0].evaluate(rows, q - h)[0]
    np.testing.assert_allclose(2 * jacobian @ h, slope, rtol=0, atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_the_error_of_a_primitive_is_the_distance(arm, rng, kind) -> None:
    target = primitives(arm.point(arm.random(rng, 12)), rng)[kind]
    q, h, rows = arm.random(rng, 12), 1e-6, np.arange(12)
    e, jacobian = goal(arm, target, (3.0, 1.0)).evaluate(rows, q)
    for k in range(12):
        alone = single(target, k)
        assert np.linalg.norm(e[k]) == pytest.approx(3.0 * cga.distance(arm.point(q[k]), alone), rel=1e-12)
        steps = q[k] + h * np.eye(5), q[k] - h * np.eye(5)
        slope = [
            (cga.distance(arm.point(a), alone) ** 2 - cga.distance(arm.point(b), alone) ** 2) / (4 * h) for a, b in zip(*steps, strict=True)
        ]
        np.testing.assert_allclose(e[k] @ jacobian[k], 9.0 * np.array(slope), rtol=0, atol=1e-8)


def test_a_centre_is_no_trap(arm, rng) -> None:
    """At the centre of a sphere no direction leads away from it, and the search goes on from elsewhere."""
    q = arm.random(rng)
    found = inverse_kinematics(arm, cga.Sphere(arm.point(q), 0.05), q)
    assert found.success and found.starts > 1
    e, jacobian = goal(arm, cga.Sphere(arm.point(q), 0.05), EQUAL).evaluate(ONE, q[None])
    assert e[0] == pytest.approx(-0.05) and np.isfinite(jacobian).all()
