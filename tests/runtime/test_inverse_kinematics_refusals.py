"""What inverse kinematics refuses, and how it says so."""

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.errors import ChainError, DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.solve.inverse_kinematics import inverse_kinematics

POSE = np.eye(4)


def bent(**changes):
    """The identity pose with entries changed: {"r01": 0.1, ...}."""
    pose = np.eye(4)
    for name, value in changes.items():
        pose[int(name[1]), int(name[2])] = value
    return pose


BAD_TARGETS = [
    (np.eye(3), WrongSizeError, "pose: shape (3, 3) given, (..., 4, 4) needed"),
    (np.zeros((5, 3)), WrongSizeError, "(..., 4, 4) needed"),
    (1.0, WrongSizeError, "(..., 4, 4) needed"),
    ("panda", WrongSizeError, "not an array of numbers"),
    ([[1.0, 2.0], [3.0]], UnknownNameError, "unknown kind of target 'list'; known: poses (..., 4, 4), Motor, Point, PointPair, Line"),
    (None, UnknownNameError, "unknown kind of target 'NoneType'"),
    ({"x": 1.0}, UnknownNameError, "unknown kind of target 'dict'"),
    (bent(r03=np.nan), NotFiniteError, "pose holds NaN or infinity"),
    (bent(r03=np.inf), NotFiniteError, "pose holds NaN or infinity"),
    (bent(r00=1.1), DegenerateError, "not a rotation"),
    (bent(r01=1e-6), DegenerateError, "R^T R is off by 1.0e-06"),
    (bent(r00=-1.0), DegenerateError, "reflection"),
    (bent(r30=1.0), DegenerateError, "last row must be 0 0 0 1"),
    (bent(r03=1e60), DegenerateError, "a coordinate of"),
    (cga.Point([1e60, 0.0, 0.0]), DegenerateError, "a coordinate of 1.0e+60 m given, at most 1e+50 m"),
]


@pytest.mark.parametrize(("target", "error", "words"), BAD_TARGETS)
def test_targets(arm, target, error, words) -> None:
    with pytest.raises(error) as caught:
        inverse_kinematics(arm, target)
    assert words in str(caught.value)


def test_one_bad_pose_among_good_ones(arm) -> None:
    with pytest.raises(DegenerateError, match="not a rotation"):
        inverse_kinematics(arm, np.array([POSE, bent(r00=1.1), POSE]))


BAD_OPTIONS = [
    ({"q0": np.zeros(7)}, WrongSizeError, "q0: shape (7,) given, (..., 5) needed"),
    ({"q0": np.zeros((3, 5))}, WrongSizeError, "q0: shape (3, 5) given, (5,) or (5,) needed"),
    ({"q0": np.full(5, np.nan)}, NotFiniteError, "q0 holds NaN"),
    ({"q0": "home"}, WrongSizeError, "q0: not an array of numbers"),
    ({"rng": 7}, UnknownNameError, "unknown rng 'int'; known: numpy.random.Generator. Make one with numpy.random.default_rng(seed)"),
    ({"method": "newton"}, UnknownNameError, "unknown method 'newton'; known: levenberg_marquardt, gauss_newton"),
    ({"method": ["newton"]}, UnknownNameError, "unknown method ['newton']"),
    ({"method": "gauss_newton", "limits": True}, UnknownNameError, "unknown option of gauss_newton 'limits'"),
    ({"method": "gauss_newton", "restarts": 3}, UnknownNameError, "unknown option of gauss_newton 'restarts'"),
    ({"restarts": -1}, WrongSizeError, "restarts: -1 given, at least 0 needed"),
    ({"restarts": 1.5}, WrongSizeError, "restarts: 1.5 given, an integer"),
    ({"max_iterations": -1}, WrongSizeError, "max_iterations: -1 given"),
    ({"tolerance": 0.0}, WrongSizeError, "tolerance: 0.0 given, a positive number is needed"),
    ({"tolerance": -1e-6}, WrongSizeError, "a positive number is needed"),
    ({"tolerance": [1e-6, 1e-6]}, WrongSizeError, "a positive number is needed"),
    ({"tolerance": np.nan}, NotFiniteError, "tolerance holds NaN"),
    ({"weights": 1.0}, WrongSizeError, "two numbers from 0 to 1e+12 needed"),
    ({"weights": (1.0, 1.0, 1.0)}, WrongSizeError, "two numbers"),
    ({"weights": (0.0, 0.0)}, WrongSizeError, "not both 0"),
    ({"weights": (-1.0, 1.0)}, WrongSizeError, "two numbers from 0"),
    ({"weights": (1.0, 1e13)}, WrongSizeError, "two numbers from 0 to 1e+12"),
    ({"weights": (1.0, np.nan)}, NotFiniteError, "weights holds NaN"),
]


@pytest.mark.parametrize(("options", "error", "words"), BAD_OPTIONS)
def test_options(arm, options, error, words) -> None:
    with pytest.raises(error) as caught:
        inverse_kinematics(arm, POSE, **options)
    assert words in str(caught.value)


def test_a_batch_and_the_starts_of_another(arm) -> None:
    with pytest.raises(WrongSizeError, match=r"one start for each target"):
        inverse_kinematics(arm, np.array([POSE, POSE]), np.zeros((3, 2, 5)))
    with pytest.raises(WrongSizeError, match="do not broadcast"):
        inverse_kinematics(arm, np.array([POSE, POSE]), np.zeros((3, 5)))


def test_a_primitive_needs_a_weight_of_lengths(arm) -> None:
    with pytest.raises(WrongSizeError, match="lengths are all that a Point measures"):
        inverse_kinematics(arm, cga.Point([0.1, 0.2, 0.3]), weights=(0.0, 1.0))


def test_what_is_no_arm(nao) -> None:
    with pytest.raises(UnknownNameError, match="unknown arm 'Robot'; known: a Chain, from Robot.chain"):
        inverse_kinematics(nao, POSE)
    with pytest.raises(ChainError):  # no joints: refused where the chain is cut
        nao.chain("torso")


def test_a_floating_base() -> None:
    floating = cga.load_robot("nao", base="floating")
    with pytest.raises(ChainError, match="its base floats"):
        inverse_kinematics(floating.chain("RHand"), POSE)
