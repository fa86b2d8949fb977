"""Chains against Pinocchio on the bundled URDFs: poses, Jacobians in three frames, their derivatives, and the motor; 10^4 random q."""

import numpy as np
import pinocchio as pin
import pytest

import cga_runtime as cga
from cga_codegen.robots.bundled import bundled_robots as bundled_files
from cga_runtime.loading import load_robot
from cga_runtime.robot import FRAMES, Chain

DRAWS = 10_000
FRAME = {name: getattr(pin.ReferenceFrame, name) for name in FRAMES}


class Peer:
    """Pinocchio's answers for a chain of the same URDF."""

    def __init__(self, robot: str, chain: Chain) -> None:
        self.model = pin.buildModelFromUrdf(str(bundled_files()[robot]))
        self.data = self.model.createData()
        self.frame = self.model.getFrameId(chain.frame)
        joints = [self.model.joints[self.model.getJointId(name)] for name in chain.joint_names]
        self.columns = [joint.idx_v for joint in joints]

    def at(self, q, v):
        full_q, full_v = pin.neutral(self.model), np.zeros(self.model.nv)
        full_q[self.columns], full_v[self.columns] = q, v
        pin.forwardKinematics(self.model, self.data, full_q, full_v)
        pin.updateFramePlacements(self.model, self.data)
        pin.computeJointJacobiansTimeVariation(self.model, self.data, full_q, full_v)
        return self.data.oMf[self.frame]

    def jacobian(self, frame):
        return pin.getFrameJacobian(self.model, self.data, self.frame, FRAME[frame])[:, self.columns]

    def jacobian_derivative(self, frame):
        return pin.getFrameJacobianTimeVariation(self.model, self.data, self.frame, FRAME[frame])[:, self.columns]


@pytest.mark.parametrize("robot", ["nao", "nao_v32"])
@pytest.mark.parametrize("hand", ["RHand", "LHand"])
def test_kinematics_equals_pinocchio(robot, hand):
    chain = load_robot(robot).chain(hand)
    peer = Peer(robot, chain)
    rng = np.random.default_rng(20)
    q = rng.uniform(-np.pi, np.pi, (DRAWS, chain.n))
    v = rng.standard_normal((DRAWS, chain.n))
    poses = chain.pose(q)
    jacobians = {frame: chain.jacobian(q, frame) for frame in FRAMES}
    rates = {frame: chain.jacobian_derivative(q, v, frame) for frame in FRAMES}
    worst = 0.0
    for k in range(DRAWS):
        worst = max(worst, np.abs(poses[k] - peer.at(q[k], v[k]).homogeneous).max())
        for frame in FRAMES:
            worst = max(worst, np.abs(jacobians[frame][k] - peer.jacobian(frame)).max())
            worst = max(worst, np.abs(rates[frame][k] - peer.jacobian_derivative(frame)).max() / (1.0 + np.abs(v[k]).max()))
    assert worst < 1e-13


@pytest.mark.parametrize("robot", ["nao", "nao_v32"])
def test_point_motor_and_screws_agree_with_the_pose(robot):
    chain = load_robot(robot).chain("LHand")
    q = np.random.default_rng(21).uniform(-np.pi, np.pi, (DRAWS, chain.n))
    pose, motor = chain.pose(q), chain.motor(q)
    assert np.abs(chain.point(q) - pose[:, :3, 3]).max() < 1e-15
    # rotation and translation read off the motor's components by the formulas for T(t) R, not by the kernel's recursion
    a, b12, b13, b23, e1i, e2i, e3i, e123i = motor.T
    quaternion = pin.Quaternion
    for k in range(0, DRAWS, 100):
        rotation = quaternion(a[k], -b23[k], b13[k], -b12[k]).toRotationMatrix()
        assert np.abs(rotation - pose[k, :3, :3]).max() < 1e-13
    x = a * e1i + b12 * e2i + b13 * e3i + b23 * e123i
    y = a * e2i - b12 * e1i + b23 * e3i - b13 * e123i
    z = a * e3i - b13 * e1i - b23 * e2i + b12 * e123i
    t = -2.0 * np.stack([x, y, z], axis=-1)
    assert np.abs(t - pose[:, :3, 3]).max() < 1e-14
    assert np.abs((motor[:, :4] ** 2).sum(axis=1) - 1.0).max() < 1e-14
    world = chain.jacobian(q, "WORLD", order="bivector")
    assert np.array_equal(world, chain.screws(q))


def test_orders_are_the_same_rows():
    chain = load_robot("nao").chain("RHand")
    q = chain.random(np.random.default_rng(22), (3, 4))
    linear, angular, bivector = (chain.jacobian(q, "LOCAL", order) for order in ("linear_first", "angular_first", "bivector"))
    assert np.array_equal(linear[..., :3, :], angular[..., 3:, :]) and np.array_equal(linear[..., 3:, :], angular[..., :3, :])
    assert np.array_equal(bivector[..., 0, :], linear[..., 5, :])
    assert np.array_equal(bivector[..., 1, :], -linear[..., 4, :])
    assert np.array_equal(bivector[..., 2, :], linear[..., 3, :])
    assert np.array_equal(bivector[..., 3:, :], linear[..., :3, :])


@pytest.mark.parametrize("frame", FRAMES)
def test_hessian_gives_the_jacobian_derivative(frame):
    chain = load_robot("nao").chain("RHand")
    rng = np.random.default_rng(23)
    q, v = chain.random(rng, 200), rng.standard_normal((200, chain.n))
    from_hessian = np.einsum("...ijk,...k->...ij", chain.hessian(q, frame), v)
    assert np.abs(from_hessian - chain.jacobian_derivative(q, v, frame)).max() < 1e-14


def test_limits_and_names_are_the_files():
    robot = load_robot("nao")
    peer = pin.buildModelFromUrdf(str(bundled_files()["nao"]))
    assert list(robot.joint_names) == list(peer.names)[1:]
    assert np.array_equal(robot.lower, peer.lowerPositionLimit) and np.array_equal(robot.upper, peer.upperPositionLimit)
    assert np.array_equal(robot.velocity_limit, peer.velocityLimit) and np.array_equal(robot.effort_limit, peer.effortLimit)
    q = robot.random(np.random.default_rng(24), 500)
    assert q.shape == (500, robot.nq) and (q >= robot.lower).all() and (q <= robot.upper).all()


def test_columns_of_frames_that_stand_still_are_zero(skew):
    q = np.zeros((2, skew.nq))
    assert np.array_equal(skew.jacobian(q, "base"), np.zeros((2, 6, skew.nv)))


def test_reaching_with_a_floating_base_is_refused():
    chain = load_robot("ur5", base="floating").chain("tool0")
    assert repr(chain) == "<Chain ur5/tool0: 7 joints>" and chain.effort_limit.shape == (12,)
    with pytest.raises(cga.ChainError, match=r"^<Chain ur5/tool0: 7 joints>: its base floats, reaching needs a fixed one"):
        cga.reach(chain, cga.Point([0.1, 0.2, 0.3]))


def test_text_in_place_of_a_path_is_named():
    with pytest.raises(cga.RobotFileError, match=r"^the text of a robot description was given; a path to its file is needed$"):
        load_robot(' <robot name="r"><link name="a"/></robot>')
