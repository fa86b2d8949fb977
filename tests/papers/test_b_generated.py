"""The generated kernels of both oracle arms against the oracle's samples: what users call gives the paper's numbers."""

import json
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "dynamics.json").read_text())
ARMS = {"panda": {"panda_finger_joint1": 0.0}, "iiwa14": {}}
SPATIAL = [3, 4, 5, 0, 1, 2]  # rows of the oracle: e23 e13 e12 e1i e2i e3i = (w1, -w2, w3, v1, v2, v3)
SIGNS = np.array([1, -1, 1, 1, 1, 1])[:, None]
MOTOR = ["1", "e23", "e13", "e12", "e1i", "e2i", "e3i", "e123i"]


@pytest.fixture(scope="module", params=ARMS)
def arm(request):
    """The robot, its chain to the oracle's end frame, and the samples."""
    data = ORACLE[request.param]
    robot = cga.load_robot(request.param, lock=ARMS[request.param])
    return robot, robot.chain(data["ee_frame"]), data


def close(found, expected, tolerance):
    """To a tolerance relative to the largest entry (or to one)."""
    expected = np.array(expected)
    assert np.shape(found) == expected.shape
    assert np.abs(found - expected).max() <= tolerance * max(1.0, np.abs(expected).max())


def test_joints_and_limits(arm):
    robot, chain, data = arm
    assert robot.nv == chain.n == data["dof"]
    assert robot.lower.tolist() == data["lower"] and robot.upper.tolist() == data["upper"]


def test_dynamics(arm):
    robot, _, data = arm
    for sample in data["samples"]:
        q, v, a = (np.array(sample[key]) for key in ("q", "qd", "qdd"))
        close(robot.mass_matrix(q), sample["M"], 1e-14)
        close(robot.coriolis(q, v), sample["C"], 1e-14)
        close(robot.coriolis(q, v) @ v, sample["Cqd"], 1e-14)
        close(robot.gravity(q), sample["g"], 1e-14)
        close(robot.inverse_dynamics(q, v, a), sample["tau"], 1e-14)
        close(robot.forward_dynamics(q, v, sample["tau"]), sample["qdd_from_tau"], 1e-12)
        close(robot.bias(q, v), np.array(sample["Cqd"]) + sample["g"], 1e-14)


def test_kinematics(arm):
    _, chain, data = arm
    for sample in data["samples"]:
        q, v = np.array(sample["q"]), np.array(sample["qd"])
        close(chain.pose(q)[:3, :3], sample["ee_rotation"], 1e-14)
        close(chain.pose(q)[:3, 3], sample["ee_translation"], 1e-14)
        motor = chain.motor(q)[[cga.Motor.blades.index(blade) for blade in MOTOR]]
        expected = np.array(sample["ee_motor"])
        close(motor * np.sign(motor @ expected), expected, 1e-14)  # M and -M are one motion
        for key, frame in (("J_geo_spatial", "WORLD"), ("J_geo_body", "LOCAL")):
            close(SIGNS * chain.jacobian(q, frame)[SPATIAL], sample[key], 1e-14)
        close(SIGNS * chain.jacobian_derivative(q, v, "WORLD")[SPATIAL], sample["Jdot_geo_spatial"], 1e-14)
