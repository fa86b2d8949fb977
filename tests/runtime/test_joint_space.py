"""The joints of several chains as one q: shared joints, names, limits and places."""

import dataclasses

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.errors import ChainError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.spaces.joints import JointSpace

APART = np.eye(4)
APART[0, 3] = 1.0


@pytest.fixture(scope="module")
def humanoid():
    return cga.load_robot("g1")


@pytest.fixture(scope="module")
def arms(humanoid):
    """The G1's arms: both begin with the three joints of its waist."""
    return [humanoid.chain(f"{side}_rubber_hand") for side in ("left", "right")]


@pytest.fixture(scope="module")
def panda():
    return cga.load_robot("panda").chain("panda_link8")


def test_a_shared_waist_stands_in_q_once(arms):
    left, right = arms
    joints = JointSpace.of(arms)
    waist = ("waist_yaw_joint", "waist_roll_joint", "waist_pitch_joint")
    assert left.joint_names[:3] == right.joint_names[:3] == waist
    assert joints.n == 17 and joints.joint_names == (*left.joint_names, *right.joint_names[3:])
    np.testing.assert_array_equal(joints.index[0], range(10))
    np.testing.assert_array_equal(joints.index[1], [0, 1, 2, *range(10, 17)])


def test_the_order_of_the_chains_is_the_order_of_the_joints(arms):
    left, right = arms
    joints = JointSpace.of([right, left])
    assert joints.joint_names == (*right.joint_names, *left.joint_names[3:])


def test_a_robot_loaded_twice_is_one_robot(arms):
    left, right = arms[0], cga.load_robot("g1").chain("right_rubber_hand")
    assert right.robot is not left.robot and JointSpace.of([left, right]).n == 17


def test_limits_are_those_of_the_chains(arms):
    joints = JointSpace.of(arms)
    for name in ("lower", "upper", "velocity_limit"):
        for chain, place in zip(arms, joints.index, strict=True):
            np.testing.assert_array_equal(getattr(joints, name)[place], getattr(chain, name))
        assert np.isfinite(getattr(joints, name)).all() and getattr(joints, name).shape == (17,)


def test_of_two_limits_of_a_shared_joint_the_narrower_holds(humanoid, arms):
    left, right = arms[0], humanoid.chain("right_rubber_hand")
    right.lower, right.upper, right.velocity_limit = right.lower + 0.125, right.upper + 0.125, right.velocity_limit / 2
    joints = JointSpace.of([left, right])
    np.testing.assert_array_equal(joints.lower[:3], left.lower[:3] + 0.125)
    np.testing.assert_array_equal(joints.upper[:3], left.upper[:3])
    np.testing.assert_array_equal(joints.velocity_limit[:3], left.velocity_limit[:3] / 2)
    np.testing.assert_array_equal(joints.upper[joints.index[1][3:]], right.upper[3:])


def test_names_are_numbered_by_robot_where_they_are_not_distinct(panda, arms):
    apart = panda.robot.chain("panda_link8", placement=APART)
    iiwa = cga.load_robot("iiwa14").chain("lbr_link_ee")
    joints = JointSpace.of([panda, apart, iiwa])
    expected = [f"1:{name}" for name in panda.joint_names] + [f"2:{name}" for name in panda.joint_names]
    assert joints.joint_names == (*expected, *(f"3:{name}" for name in iiwa.joint_names))
    assert JointSpace.of([panda, iiwa]).joint_names == (*panda.joint_names, *iiwa.joint_names)
    # a chain met before keeps its robot's number
    assert JointSpace.of([panda, apart, panda]).joint_names == JointSpace.of([panda, apart]).joint_names
    mixed = JointSpace.of([arms[0], panda, arms[1], apart])
    assert {name[:2] for name in np.array(mixed.joint_names)[np.concatenate([mixed.index[0], mixed.index[2]])]} == {"1:"}
    assert mixed.joint_names[10:17] == tuple(f"2:{name}" for name in panda.joint_names)
    assert mixed.joint_names[-7:] == tuple(f"3:{name}" for name in panda.joint_names)
    assert mixed.n == 17 + 14 and len(set(mixed.joint_names)) == mixed.n


def test_one_chain_is_its_own_space(panda):
    joints = JointSpace.of([panda])
    assert joints.joint_names == panda.joint_names
    np.testing.assert_array_equal(joints.index[0], range(7))
    np.testing.assert_array_equal(joints.lower, panda.lower)


def test_the_same_chain_twice_shares_all(panda):
    joints = JointSpace.of([panda, panda])
    assert joints.n == 7
    np.testing.assert_array_equal(joints.index, [range(7), range(7)])


def test_random_positions_fill_the_limits(arms, rng):
    joints = JointSpace.of(arms)
    q = joints.random(rng, (40, 50))
    assert q.shape == (40, 50, 17)
    where = (q - joints.lower) / (joints.upper - joints.lower)
    assert where.min() >= 0.0 and where.max() <= 1.0
    assert (where.min(axis=(0, 1)) < 0.01).all() and (where.max(axis=(0, 1)) > 0.99).all()
    assert joints.random(rng).shape == (17,) and joints.random(rng, 3).shape == (3, 17) and joints.random(rng, ()).shape == (17,)


def test_random_positions_of_joints_without_limits_lie_within_half_a_turn(panda, rng):
    free = dataclasses.replace(JointSpace.of([panda]), lower=np.full(7, -np.inf), upper=np.full(7, np.inf))
    q = free.random(rng, 1000)
    assert np.abs(q).max() <= np.pi and (np.abs(q).max(axis=0) > 3.0).all()


def test_spread_puts_columns_in_their_places(arms, rng):
    joints = JointSpace.of(arms)
    for k, chain in enumerate(arms):
        part = rng.standard_normal((2, 6, chain.n))
        whole = joints.spread(part, k)
        assert whole.shape == (2, 6, 17)
        rates = rng.standard_normal((2, 17))
        np.testing.assert_allclose(whole @ rates[..., None], part @ rates[..., joints.index[k], None], rtol=0, atol=1e-14)
        others = np.setdiff1d(range(17), joints.index[k])
        assert len(others) == 7 and not whole[..., others].any()


def test_positions_are_checked(panda):
    joints = JointSpace.of([panda])
    assert joints.check(range(7)).dtype == np.float64 and joints.check(np.zeros((2, 0, 7))).shape == (2, 0, 7)
    with pytest.raises(WrongSizeError, match=r"q: shape \(6,\) given, \(\.\.\., 7\) needed: panda_joint1, "):
        joints.check(np.zeros(6))
    with pytest.raises(WrongSizeError, match=r"q: shape \(\) given"):
        joints.check(0.0)
    with pytest.raises(NotFiniteError, match=r"q holds NaN or infinity: nan at index \(2,\)"):
        joints.check([0, 0, np.nan, 0, 0, 0, 0])
    with pytest.raises(WrongSizeError, match="-1 given, at least 0 needed"):
        joints.random(np.random.default_rng(0), -1)


def test_what_cannot_be_joined_is_named(humanoid, arms, panda):
    with pytest.raises(WrongSizeError, match="no chains given"):
        JointSpace.of([])
    with pytest.raises(UnknownNameError, match="unknown chain 'Robot'; known: a Chain, from Robot.chain"):
        JointSpace.of([panda, panda.robot])
    other = humanoid.chain("right_elbow_link", root="torso_link")
    with pytest.raises(ChainError, match=r"chains of g1\w* begin in different frames \('the base' and 'torso_link'\)"):
        JointSpace.of([arms[0], panda, other])
    # another placement is another robot, whose own root may be anything
    placed = humanoid.chain("right_elbow_link", root="torso_link", placement=APART)
    assert JointSpace.of([arms[0], placed]).n == arms[0].n + placed.n


def test_a_floating_base_is_refused(panda):
    floating = cga.load_robot("nao", base="floating").chain("LHand")
    with pytest.raises(ChainError, match=r"its base floats, a joint space needs fixed ones: Robot\.chain\(frame, root=\.\.\.\)"):
        JointSpace.of([panda, floating])
