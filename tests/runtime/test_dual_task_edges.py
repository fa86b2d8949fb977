"""The dual task space at the identity, at the half turn, in second derivatives, and where it is refused."""

import copy
import pickle

import casadi
import numpy as np
import pytest
from two_arm_poses import differences, poses, relative, split, turned, velocities

import cga_runtime as cga
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.spaces.dual_task import MOTORS, DualTaskSpace

CHARTS = ("split", "lie")
FACING = np.array([[-1, 0, 0, 0.9], [0, -1, 0, 0.1], [0, 0, 1, 0.2], [0, 0, 0, 1.0]])
"""A second robot that faces the first: equal joint positions make the relative rotation a half turn."""
ROUNDOFF = 2e-14


@pytest.fixture(scope="module")
def panda():
    return cga.load_robot("panda").chain("panda_link8")


@pytest.fixture(scope="module")
def pandas(panda):
    return DualTaskSpace(panda, panda.robot.chain("panda_link8", placement=FACING))


def close(a, b, tolerance):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance)


def pose(motor):
    return cga.Motor(motor).pose()


# ---- the identity and the half turn


def test_one_hand_taken_twice(panda, rng):
    space, q = DualTaskSpace(panda, panda), panda.random(rng, 5)
    assert space.n == 7
    close(space.relative(q), np.broadcast_to(np.eye(8)[0], (5, 8)), ROUNDOFF)
    close(space.relative_twist_jacobian(q), 0.0, ROUNDOFF)
    for chart in CHARTS:
        close(space.absolute(q, chart), panda.motor(q), ROUNDOFF)
        close(space.absolute_jacobian(q, chart), panda.motor_jacobian(q), ROUNDOFF)


@pytest.fixture(scope="module")
def meeting(pandas):
    """Both end frames in one place, to 1e-11."""
    q = pandas.random(np.random.default_rng(4), 10)
    q[:, 7:] = cga.inverse_kinematics(pandas.second, pandas.first.pose(q[:, :7]), tolerance=1e-12).q
    return q[np.abs(pandas.relative(q)[:, 1:]).max(axis=-1) < 1e-11][0]


def test_hands_that_almost_meet(pandas, meeting, rng):
    """Relative rotations from 1e-16 to 0.1: the absolute twist tends to the mean of both, in both charts."""
    direction = rng.standard_normal(14)
    v1, w1, v2, w2 = velocities(pandas, meeting)
    mean = 0.5 * np.concatenate([v1 + v2, w1 + w2])
    for size in (0.0, *10.0 ** np.arange(-16, 0)):
        at = meeting + size * direction
        close(turned(pandas, at), size * np.linalg.norm((w1 - w2) @ direction), 4 * size**2 + 1e-11)
        for chart in CHARTS:
            close(pandas.absolute_twist_jacobian(at, chart, "LOCAL_WORLD_ALIGNED"), mean, 3 * size + 1e-11)
            close(pandas.absolute_jacobian(at, chart), np.asarray(pandas.casadi(f"absolute_jacobian_{chart}")(at)), ROUNDOFF)
            close(pandas.absolute(at, chart), np.asarray(pandas.casadi(f"absolute_{chart}")(at))[:, 0], ROUNDOFF)


@pytest.fixture
def opposite(pandas, rng):
    """Equal joint positions of robots that face each other, and a rate of q by which the relative rotation passes the half turn."""
    arm = pandas.first.random(rng)
    rate = np.eye(14)[6]
    passing = pandas.relative_jacobian(np.tile(arm, 2))[0] @ rate  # of the scalar part
    assert abs(passing) > 0.1
    return np.tile(arm, 2), rate / passing


@pytest.mark.parametrize("chart", CHARTS)
def test_the_mean_jumps_by_a_half_turn_at_a_half_turn(pandas, opposite, chart):
    q, rate = opposite
    assert abs(pandas.relative(q)[0]) < 1e-15
    before, after = (pose(pandas.absolute(q + size * rate, chart)) for size in (-1e-9, 1e-9))
    jump = np.linalg.inv(before) @ after
    relative_axis = pandas.relative(q)[1:4]  # the same plane of rotation, of length one
    rotor = cga.Motor.from_pose(jump).coefficients[:4]
    close(rotor[0], 0.0, 1e-8)
    close(abs(rotor[1:] @ relative_axis), 1.0, ROUNDOFF)
    close(jump @ jump if chart == "lie" else jump[:3, 3], np.eye(4) if chart == "lie" else 0.0, 1e-8)
    at = pose(pandas.absolute(q, chart))
    assert min(np.abs(at - before).max(), np.abs(at - after).max()) < 1e-8


@pytest.mark.parametrize("chart", CHARTS)
def test_near_a_half_turn_all_is_finite_and_symmetric(pandas, opposite, chart):
    q, rate = opposite
    exchanged = DualTaskSpace(pandas.second, pandas.first)
    sizes = 10.0 ** np.arange(-13, -1)
    near = q + np.concatenate([-sizes, sizes])[:, None] * rate
    assert np.abs(turned(pandas, near) - np.pi).min() < 1e-7
    found = pandas.absolute(near, chart)
    close(pose(exchanged.absolute(np.roll(near, 7, axis=-1), chart)), pose(found), ROUNDOFF)
    close(pose(found)[:, :3, :3], split(*poses(pandas, near))[:, :3, :3], ROUNDOFF)
    jacobian = pandas.casadi(f"absolute_jacobian_{chart}")
    close(pandas.absolute_jacobian(near, chart), [np.asarray(jacobian(x)) for x in near], ROUNDOFF)
    # at the half turn itself, either side
    assert np.isfinite(pandas.absolute_jacobian(q, chart)).all() and np.isfinite(np.asarray(jacobian(q))).all()
    assert np.linalg.norm(pandas.absolute_twist_jacobian(q, chart), ord=2) < 3.0
    step = np.linalg.inv(poses(pandas, q)[1]) @ pose(pandas.absolute(q, chart))
    close((step @ step)[:3, :3], relative(*poses(pandas, q))[:3, :3], ROUNDOFF)


@pytest.mark.parametrize("name", MOTORS)
def test_second_derivatives_are_those_of_the_jacobian(pandas, meeting, rng, name):
    """Where the arms are far apart, and where their end frames coincide."""
    far, along = pandas.random(rng, 30), 0.3 * rng.standard_normal(14)
    far = far[turned(pandas, far) < 2.5][0]
    word, _, chart = name.partition("_")
    x = casadi.SX.sym("x", 14)
    jacobian = pandas.casadi(f"{word}_jacobian_{chart}" if chart else f"{word}_jacobian")
    second = casadi.Function("second", [x], [casadi.jtimes(jacobian(x), x, casadi.DM(along))])
    method = getattr(pandas, f"{word}_jacobian")
    for q in (far, meeting):
        close(np.asarray(second(q)), differences(lambda at: method(at, *([chart] if chart else [])), q, along), 1e-10)


# ---- copies, refusals


def test_copies_serve_as_well(pandas, rng):
    q = pandas.random(rng)
    pandas.casadi("relative")
    for other in (copy.deepcopy(pandas), pickle.loads(pickle.dumps(pandas))):
        np.testing.assert_array_equal(other.absolute(q), pandas.absolute(q))
        close(np.asarray(other.casadi("relative")(q))[:, 0], pandas.relative(q), ROUNDOFF)
    assert repr(pandas) == "<DualTaskSpace panda_link8 + panda_link8: 14 joints>"
    np.testing.assert_array_equal(pandas.lower, np.tile(pandas.first.lower, 2))
    np.testing.assert_array_equal(pandas.upper, np.tile(pandas.first.upper, 2))


def test_what_has_no_meaning_is_named(pandas, panda):
    q = np.zeros(14)
    for call in (pandas.absolute, pandas.absolute_jacobian, pandas.absolute_twist_jacobian):
        with pytest.raises(UnknownNameError, match="unknown chart 'screw'; known: split, lie"):
            call(q, "screw")
        with pytest.raises(WrongSizeError, match=r"q: shape \(7,\) given, \(\.\.\., 14\) needed: 1:panda_joint1"):
            call(q[:7])
        with pytest.raises(NotFiniteError, match="q holds NaN or infinity"):
            call(np.full(14, np.nan))
    for twist in (pandas.relative_twist_jacobian, pandas.absolute_twist_jacobian):
        with pytest.raises(UnknownNameError, match="unknown frame of reference 'local'; known: LOCAL, WORLD"):
            twist(q, frame="local")
        with pytest.raises(UnknownNameError, match="unknown order 'vw'; known: linear_first"):
            twist(q, order="vw")
    with pytest.raises(
        UnknownNameError, match="unknown function 'absolute'; known: relative, absolute_split, absolute_lie, relative_jacobian"
    ):
        pandas.casadi("absolute")
    with pytest.raises(DegenerateError, match="point pair"):
        DualTaskSpace(panda, panda).point_pair(np.zeros(7))
    with pytest.raises(UnknownNameError, match="unknown chain 'Robot'"):
        DualTaskSpace(panda, panda.robot)
