"""Conventions against the libraries they belong to: Pinocchio's SE3, Motion, Force, frames, MuJoCo's quaternions, Jacobians, scipy."""

from functools import partial

import mujoco
import numpy as np
import pinocchio as pin
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from cga_runtime import conventions, quaternions
from cga_runtime.conventions import FRAMES, convert_twist, convert_wrench
from cga_runtime.motors import Motor

close = partial(np.testing.assert_allclose, rtol=0)
S = 0.5**0.5
SPECIAL = np.array(  # x y z w
    [[0, 0, 0, 1], [0, 0, 0, -1], [1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 1, 0], [0, S, 0, S], [0, 0, S, -S], [0.6, -0.8, 0, 1e-10]]
)
REFERENCE = {name: getattr(pin.ReferenceFrame, name) for name in FRAMES}


@pytest.fixture
def xyzw(rng):
    """Unit quaternions x y z w, the special ones first."""
    q = np.concatenate([SPECIAL, rng.normal(size=(40, 4))])
    return q / np.linalg.norm(q, axis=1, keepdims=True)


@pytest.fixture
def placements(rng, xyzw):
    """The same rotations as pinocchio.SE3, with random positions."""
    return [pin.XYZQUATToSE3(np.concatenate([rng.normal(size=3), q])) for q in xyzw]


# ---- rotations


def test_rotations_as_in_scipy(xyzw):
    turns = Rotation.from_quat(xyzw)
    wxyz = Rotation.from_quat(xyzw).as_quat(scalar_first=True)
    close(quaternions.matrix_from_quaternion(xyzw, "xyzw"), turns.as_matrix(), atol=1e-14)
    close(quaternions.matrix_from_quaternion(wxyz, "wxyz"), turns.as_matrix(), atol=1e-14)
    for order, scalar_first in (("xyzw", False), ("wxyz", True)):
        ours = quaternions.quaternion_from_matrix(turns.as_matrix(), order)
        theirs = Rotation.from_matrix(turns.as_matrix()).as_quat(canonical=True, scalar_first=scalar_first)
        generic = np.abs(xyzw[:, 3]) > 1e-9  # scipy and we may choose another sign of a half turn
        close(ours[generic], theirs[generic], atol=1e-14)
        close(np.abs((ours * theirs).sum(-1)), 1.0, atol=1e-14)
    axis, angle = np.array([2, -3, 6]) / 7, 1.1
    rotor = quaternions.convert_quaternion(Rotation.from_rotvec(angle * axis).as_quat(), "xyzw", "rotor")
    c, s = np.cos(angle / 2), np.sin(angle / 2)
    close(rotor, [c, -s * axis[2], s * axis[1], -s * axis[0]], atol=1e-14)  # R = c - s a I3


def test_rotations_as_in_mujoco(xyzw):
    for q in xyzw:
        wxyz, theirs, back = quaternions.convert_quaternion(q, "xyzw", "wxyz"), np.zeros(9), np.zeros(4)
        mujoco.mju_quat2Mat(theirs, wxyz)
        close(quaternions.matrix_from_quaternion(wxyz, "wxyz"), theirs.reshape(3, 3), atol=1e-14)
        mujoco.mju_mat2Quat(back, theirs)
        assert abs(back @ quaternions.quaternion_from_matrix(theirs.reshape(3, 3), "wxyz")) == pytest.approx(1.0, abs=1e-14)


def test_positions_and_quaternions_as_in_pinocchio(placements, xyzw):
    for placement, q in zip(placements, xyzw, strict=True):
        motor = quaternions.motor_from_position_quaternion(placement.translation, q, "xyzw")
        close(motor.pose(), placement.homogeneous, atol=1e-14)
        position, ours = quaternions.position_quaternion_from_motor(Motor.from_pose(placement.homogeneous), "xyzw")
        close(position, pin.SE3ToXYZQUAT(placement)[:3], atol=1e-14)
        assert abs(ours @ pin.SE3ToXYZQUAT(placement)[3:]) == pytest.approx(1.0, abs=1e-14)
        close(quaternions.matrix_from_quaternion(ours, "xyzw"), pin.Quaternion(q).matrix(), atol=1e-14)


# ---- twists and wrenches


def test_adjoints_as_in_pinocchio(placements, rng):
    poses = np.array([placement.homogeneous for placement in placements])
    ad, coad = conventions.adjoint(poses, "linear_first"), conventions.coadjoint(poses, "force_first")
    close(ad, [placement.toActionMatrix() for placement in placements], atol=1e-14)
    close(coad, [placement.toDualActionMatrix() for placement in placements], atol=1e-14)
    for placement in placements:
        v, f = pin.Motion(rng.normal(size=6)), pin.Force(rng.normal(size=6))
        pose = Motor.from_pose(placement.homogeneous)
        world = conventions.twist_in_frame(v.vector, pose, "LOCAL", "WORLD", order="linear_first")
        close(world, v.se3Action(placement).vector, atol=1e-14)
        local = conventions.twist_in_frame(v.vector, pose, "WORLD", "LOCAL", order="linear_first")
        close(local, v.se3ActionInverse(placement).vector, atol=1e-14)
        pushed = conventions.wrench_in_frame(f.vector, pose, "LOCAL", "WORLD", order="force_first")
        close(pushed, f.se3Action(placement).vector, atol=1e-14)
        back = conventions.wrench_in_frame(f.vector, pose, "WORLD", "LOCAL", order="force_first")
        close(back, f.se3ActionInverse(placement).vector, atol=1e-14)
        bivectors = convert_twist(v.vector, "linear_first", "bivector"), convert_wrench(f.vector, "force_first", "bivector")
        assert conventions.power(*bivectors, "bivector", "bivector") == pytest.approx(v.dot(f), abs=1e-14)


def test_hat_is_the_generator_of_motions(rng):
    for order in conventions.TWIST_ORDERS:
        twist = rng.normal(size=6)
        motion = pin.exp6(pin.Motion(convert_twist(twist, order, "linear_first")))
        close(expm(conventions.hat(twist, order)), motion.homogeneous, atol=1e-14)
        close(conventions.vee(conventions.hat(twist, order), order), twist, atol=0)


def tree(rng):
    """A random humanoid of Pinocchio's, in a random state."""
    pin.seed(7)  # before the model, which is random too
    model = pin.buildSampleModelHumanoidRandom()
    model.lowerPositionLimit[:7], model.upperPositionLimit[:7] = -1.0, 1.0
    return model, pin.randomConfiguration(model), rng.normal(size=model.nv)


@pytest.mark.parametrize("source", FRAMES)
@pytest.mark.parametrize("target", FRAMES)
def test_jacobians_and_velocities_change_frames_as_in_pinocchio(source, target, rng):
    model, q, v = tree(rng)
    data = model.createData()
    pin.forwardKinematics(model, data, q, v)
    pin.computeJointJacobians(model, data, q)
    pin.updateFramePlacements(model, data)
    for frame in range(1, model.nframes, 9):
        pose = data.oMf[frame].homogeneous
        given, wanted = (pin.getFrameJacobian(model, data, frame, REFERENCE[name]) for name in (source, target))
        close(conventions.jacobian_in_frame(given, pose, source, target, order="linear_first"), wanted, atol=1e-14)
        swapped = convert_twist(given, "linear_first", "bivector", axis=-2)
        ours = conventions.jacobian_in_frame(swapped, pose, source, target, order="bivector")
        close(convert_twist(ours, "bivector", "linear_first", axis=-2), wanted, atol=1e-14)
        given, wanted = (pin.getFrameVelocity(model, data, frame, REFERENCE[name]).vector for name in (source, target))
        close(conventions.twist_in_frame(given, pose, source, target, order="linear_first"), wanted, atol=4e-14)


ARM = """<mujoco><worldbody><body name="upper" pos="0.1 0.2 0.3" quat="0.8 0.6 0 0"><joint name="a" axis="0 0 1"/><geom size="0.1"/>
<body name="lower" pos="0 0.4 0.1" euler="20 30 40"><joint name="b" axis="1 2 2"/><joint name="c" type="slide" axis="0 1 0"/>
<geom size="0.1"/></body></body></worldbody></mujoco>"""


def test_jacobians_as_in_mujoco(rng):
    """mj_jac at a body's origin is LOCAL_WORLD_ALIGNED, at the world's origin WORLD; mj_objectVelocity is angular first."""
    model = mujoco.MjModel.from_xml_string(ARM)
    data, body = mujoco.MjData(model), model.body("lower").id
    data.qpos, data.qvel = rng.normal(size=3), rng.normal(size=3)
    mujoco.mj_forward(model, data)
    linear, angular, linear0, angular0 = np.zeros((4, 3, model.nv))
    mujoco.mj_jac(model, data, linear, angular, data.xpos[body], body)
    mujoco.mj_jac(model, data, linear0, angular0, np.zeros(3), body)
    pose = quaternions.motor_from_position_quaternion(data.xpos[body], data.xquat[body], "wxyz", normalize=True)
    close(pose.pose()[:3, :3].ravel(), data.xmat[body], atol=1e-14)
    aligned, world = np.concatenate([linear, angular]), np.concatenate([linear0, angular0])
    ours = conventions.jacobian_in_frame(aligned, pose, "LOCAL_WORLD_ALIGNED", "WORLD", order="linear_first")
    close(ours, world, atol=1e-14)
    for local, frame in ((0, "LOCAL_WORLD_ALIGNED"), (1, "LOCAL")):
        velocity = np.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, local)
        twist = conventions.twist_in_frame(world @ data.qvel, pose, "WORLD", frame, order="linear_first")
        close(convert_twist(twist, "linear_first", "angular_first"), velocity, atol=1e-14)
