"""Whole configurations against Pinocchio and MuJoCo: one robot described for both, with its joints in three different orders."""

from functools import partial
from types import SimpleNamespace

import mujoco
import numpy as np
import pinocchio as pin
import pytest

from cga_runtime import configurations, conventions
from cga_runtime.configurations import from_mujoco, from_pinocchio, to_mujoco, to_pinocchio
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.motors import Motor

close = partial(np.testing.assert_allclose, rtol=0)
INERTIAL = '<inertial><mass value="2"/><origin xyz="0.1 0 0.2"/><inertia ixx="1" iyy="1.2" izz="1.3" ixy="0" ixz="0" iyz="0"/></inertial>'


def _joint(name, kind, parent, child, origin, axis, mimic=""):
    limit = "" if kind == "continuous" else '<limit lower="-2" upper="2" effort="1" velocity="1"/>'
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{origin}"/><axis xyz="{axis}"/>{limit}{mimic}</joint>'
    )


URDF = "".join(
    [
        '<robot name="mixed">',
        *(f'<link name="{link}">{INERTIAL}</link>' for link in ("base", "wheel", "mast", "head")),
        '<link name="finger"/>',
        _joint("wheel_spin", "continuous", "base", "wheel", "0 0.3 0", "0 1 0"),
        _joint("mast_lift", "prismatic", "base", "mast", "0.1 0 0.2", "0 0 1"),
        _joint("head_turn", "revolute", "mast", "head", "0 0 0.4", "1 0 0"),
        "{}</robot>",
    ]
)
MIMIC = _joint("finger_close", "revolute", "head", "finger", "0 0.1 0", "0 0 1", '<mimic joint="head_turn" multiplier="2" offset="0.1"/>')
FIXED = '<joint name="finger_close" type="fixed"><parent link="head"/><child link="finger"/></joint>'

BODY = '<inertial mass="2" pos="0.1 0 0.2" diaginertia="1 1.2 1.3"/>'
MJCF = f"""<mujoco><compiler autolimits="true"/><worldbody><body name="base"><freejoint name="root_joint"/>{BODY}
<body name="wheel" pos="0 0.3 0"><joint name="wheel_spin" axis="0 1 0"/>{BODY}</body>
<body name="mast" pos="0.1 0 0.2"><joint name="mast_lift" type="slide" axis="0 0 1"/>{BODY}
<body name="head" pos="0 0 0.4"><joint name="head_turn" axis="1 0 0"/>{BODY}</body></body></body></worldbody></mujoco>"""

NAMES = ("root_joint", "head_turn", "wheel_spin", "mast_lift")
ROBOT = SimpleNamespace(joint_names=NAMES, joint_kinds=("floating", "revolute", "continuous", "prismatic"))
FIXED_BASE = SimpleNamespace(joint_names=NAMES[1:], joint_kinds=ROBOT.joint_kinds[1:])
WAYS = [(to_pinocchio, from_pinocchio), (to_mujoco, from_mujoco)]


@pytest.fixture(scope="module")
def pinocchio_model():
    return pin.buildModelFromXML(URDF.format(FIXED), pin.JointModelFreeFlyer())


@pytest.fixture(scope="module")
def mujoco_model():
    return mujoco.MjModel.from_xml_string(MJCF)


def names_of(model):
    if isinstance(model, pin.Model):
        return list(model.names)[1:]
    return [model.joint(k).name for k in range(model.njnt)]


def states(rng, count):
    """Random q and v of ROBOT; motors of both signs, the first the identity, the next ones half turns."""
    q = rng.uniform(-1, 1, (count, 4))
    q[:4] = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [-1, 0, 0, 0]]
    turn = np.zeros((count, 8))
    turn[:, :4] = q / np.linalg.norm(q, axis=1, keepdims=True)
    shift = np.concatenate([np.ones((count, 1)), np.zeros((count, 3)), rng.normal(size=(count, 3)), np.zeros((count, 1))], axis=1)
    motor = Motor(shift) * Motor(turn)
    return np.concatenate([motor.coefficients, rng.uniform(-3, 3, (count, 3))], axis=1), rng.normal(size=(count, 9))


# ---- one robot, three orders


def test_the_three_orders_differ(pinocchio_model, mujoco_model):
    orders = {NAMES, tuple(names_of(pinocchio_model)), tuple(names_of(mujoco_model))}
    assert len(orders) == 3 and {frozenset(order) for order in orders} == {frozenset(NAMES)}


def test_bodies_move_alike_in_pinocchio_and_mujoco(pinocchio_model, mujoco_model, rng):
    """Poses and velocities of every body; MuJoCo's and Pinocchio's numbers both come from one q and v of ours."""
    data, simulated = pinocchio_model.createData(), mujoco.MjData(mujoco_model)
    for q, v in zip(*states(rng, 20), strict=True):
        theirs = to_pinocchio(ROBOT, q, v, names=names_of(pinocchio_model))
        simulated.qpos, simulated.qvel = to_mujoco(ROBOT, q, v, names=names_of(mujoco_model))
        pin.forwardKinematics(pinocchio_model, data, *theirs)
        pin.updateFramePlacements(pinocchio_model, data)
        mujoco.mj_forward(mujoco_model, simulated)
        for link in ("base", "wheel", "mast", "head"):
            frame, body, velocity = pinocchio_model.getFrameId(link), mujoco_model.body(link).id, np.zeros(6)
            close(simulated.xpos[body], data.oMf[frame].translation, atol=1e-14)
            close(simulated.xmat[body].reshape(3, 3), data.oMf[frame].rotation, atol=1e-14)
            mujoco.mj_objectVelocity(mujoco_model, simulated, mujoco.mjtObj.mjOBJ_XBODY, body, velocity, 1)
            expected = pin.getFrameVelocity(pinocchio_model, data, frame, pin.ReferenceFrame.LOCAL).vector
            close(conventions.convert_twist(velocity, "angular_first", "linear_first"), expected, atol=1e-14)
        base = data.oMf[pinocchio_model.getFrameId("base")].homogeneous
        close(Motor(q[:8]).pose(), base, atol=1e-14)
        local = pin.getFrameVelocity(pinocchio_model, data, pinocchio_model.getFrameId("base"), pin.ReferenceFrame.LOCAL).vector
        close(v[:6], local, atol=1e-14)


def test_forces_and_accelerations_convert_as_said(pinocchio_model, mujoco_model, rng):
    """tau as v; the acceleration of a floating joint with R (a + w x v). Both sides' inverse dynamics must then agree."""
    simulated, data = mujoco.MjData(mujoco_model), pinocchio_model.createData()
    there = {"names": names_of(pinocchio_model)}
    names = names_of(mujoco_model)
    for (q, v), a in zip(zip(*states(rng, 20), strict=True), rng.normal(size=(20, 9)), strict=True):
        q_pin, v_pin = to_pinocchio(ROBOT, q, v, **there)
        tau_pin = pin.rnea(pinocchio_model, data, q_pin, v_pin, to_pinocchio(ROBOT, q, a, **there)[1])
        simulated.qpos, simulated.qvel = to_mujoco(ROBOT, q, v, names=names)
        spatial = a.copy()
        spatial[:3] += np.cross(v[3:6], v[:3])
        simulated.qacc = to_mujoco(ROBOT, q, spatial, names=names)[1]
        mujoco.mj_inverse(mujoco_model, simulated)
        tau = from_pinocchio(ROBOT, q_pin, tau_pin, **there)[1]
        close(from_mujoco(ROBOT, simulated.qpos, simulated.qfrc_inverse, names=names)[1], tau, atol=1e-12)
        assert simulated.qfrc_inverse @ simulated.qvel == pytest.approx(tau @ v, abs=1e-12)


def test_neutral_and_integrate_as_in_pinocchio(pinocchio_model, rng):
    names = names_of(pinocchio_model)
    neutral = from_pinocchio(ROBOT, pin.neutral(pinocchio_model), names=names)
    assert neutral.tolist() == [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]
    np.testing.assert_array_equal(to_pinocchio(ROBOT, neutral, names=names), pin.neutral(pinocchio_model))
    for q, v in zip(*states(rng, 20), strict=True):
        moved = pin.integrate(pinocchio_model, *to_pinocchio(ROBOT, q, 0.1 * v, names=names))
        ours = from_pinocchio(ROBOT, moved, names=names)
        step = pin.exp6(pin.Motion(0.1 * v[:6])).homogeneous
        close(Motor(ours[:8]).pose(), Motor(q[:8]).pose() @ step, atol=1e-14)
        close(np.exp(1j * ours[8:]), np.exp(1j * (q[8:] + 0.1 * v[6:])), atol=1e-14)  # the continuous one may wrap


def test_free_joint_as_mujoco_integrates_it(mujoco_model, rng):
    """mj_integratePos over a short time, by central differences of the base's pose: qvel is what we say it is."""
    names, h = names_of(mujoco_model), 1e-5
    for q, v in zip(*states(rng, 20), strict=True):
        qpos, qvel = to_mujoco(ROBOT, q, v, names=names)
        after, before = qpos.copy(), qpos.copy()
        mujoco.mj_integratePos(mujoco_model, after, qvel, h)
        mujoco.mj_integratePos(mujoco_model, before, qvel, -h)
        poses = [Motor(from_mujoco(ROBOT, moved, names=names)[:8]).pose() for moved in (after, before)]
        rate = (poses[0] - poses[1]) / (2 * h)
        close(np.linalg.inv(Motor(q[:8]).pose()) @ rate, conventions.hat(v[:6], "linear_first"), atol=1e-9)


def test_mimic_joints_have_no_coordinate(rng):
    """With mimic=True Pinocchio's follower takes no number of q: its name is left out."""
    model = pin.buildModelFromXML(URDF.format(MIMIC), pin.JointModelFreeFlyer(), mimic=True)
    names = [name for name in names_of(model) if model.joints[model.getJointId(name)].nq]
    assert "finger_close" in names_of(model) and "finger_close" not in names
    q, v = states(rng, 5)
    there, rates = to_pinocchio(ROBOT, q, v, names=names)
    assert there.shape == (5, model.nq) and rates.shape == (5, model.nv)
    close(from_pinocchio(ROBOT, there, names=names), q, atol=1e-14)


# ---- round trips


@pytest.mark.parametrize(("there", "back"), WAYS)
@pytest.mark.parametrize("names", [None, NAMES, NAMES[::-1], NAMES[3:0:-1], ("mast_lift", "root_joint", "head_turn", "wheel_spin")])
@pytest.mark.parametrize("robot", [ROBOT, FIXED_BASE])
def test_round_trips(there, back, names, robot, rng):
    q, v = states(rng, 24)
    if robot is FIXED_BASE:
        q, v, names = q[:, 8:], v[:, 6:], names and [name for name in names if name != "root_joint"]
    q, v = q.reshape(4, 6, -1), v.reshape(4, 6, -1)
    position, rate = there(robot, q, v, names=names)
    np.testing.assert_array_equal(there(robot, q, names=names), position)
    q_back, v_back = back(robot, position, rate, names=names)
    close(q_back, q, atol=1e-14)  # motors with their sign
    close(v_back, v, atol=1e-14)
    np.testing.assert_array_equal(back(robot, position[2, 3], rate[2, 3], names=names)[1], v_back[2, 3])
    assert there(robot, q[0, 0], v, names=names)[1].shape == v.shape and position.flags.writeable


def test_angles_wrap_only_where_pinocchio_keeps_a_circle():
    q = np.array([7.0, 7.0, 7.0])
    close(from_pinocchio(FIXED_BASE, to_pinocchio(FIXED_BASE, q)), [7.0, 7.0 - 2 * np.pi, 7.0], atol=1e-14)
    np.testing.assert_array_equal(from_mujoco(FIXED_BASE, to_mujoco(FIXED_BASE, q)), q)
    assert from_pinocchio(FIXED_BASE, [0, -1, 0, 0])[1] == np.pi
    none = SimpleNamespace(joint_names=(), joint_kinds=())
    assert to_mujoco(none, np.zeros((2, 0))).size == 0 and configurations.RATES["floating"] == 6


def test_normalising_is_asked_for():
    rounded = np.array([0, 0, 0, 0.7071, 0, 0.7071, 0, 1, 2, 3])  # as a keyframe of an MJCF file has it
    motor = from_mujoco(ROBOT, rounded, normalize=True)[:8]
    close(motor, [0.5**0.5, 0, 0.5**0.5, 0, 0, 0, 0, 0], atol=1e-14)
    close(from_pinocchio(FIXED_BASE, [0.5, 3, 4, 0.2], normalize=True), [0.5, np.arctan2(4, 3), 0.2], atol=1e-14)
    with pytest.raises(DegenerateError, match="off 1 by 1.9e-05 .*; normalize=True divides by the norm"):
        from_mujoco(ROBOT, rounded)


# ---- refusals

Q = np.array([1.0, *[0] * 10])
KNOWN = "head_turn, wheel_spin, mast_lift"
REFUSED = [
    (lambda: to_pinocchio(ROBOT, Q[:10]), WrongSizeError, r"q: shape \(10,\) given, \(..., 11\) needed"),
    (lambda: from_pinocchio(ROBOT, Q[:10]), WrongSizeError, r"q: shape \(10,\) given, \(..., 11\) needed"),
    (lambda: from_mujoco(ROBOT, Q), WrongSizeError, r"q: shape \(11,\) given, \(..., 10\) needed"),
    (lambda: to_mujoco(ROBOT, Q, np.ones(10)), WrongSizeError, r"v: shape \(10,\) given, \(..., 9\) needed"),
    (lambda: to_mujoco(ROBOT, np.tile(Q, (2, 1)), np.ones((3, 9))), WrongSizeError, r"q and v: batch dimensions \(2,\), \(3,\)"),
    (lambda: to_mujoco(ROBOT, Q + np.inf), NotFiniteError, "q holds NaN or infinity"),
    (lambda: to_mujoco(ROBOT, Q, [np.nan] * 9), NotFiniteError, "v holds NaN or infinity"),
    (lambda: to_mujoco(ROBOT, 2 * Q), DegenerateError, "M ~M must be 1"),
    (lambda: from_mujoco(ROBOT, np.ones(10)), DegenerateError, "quaternion: its squared norm is off 1 by 3.0e"),
    (lambda: from_pinocchio(FIXED_BASE, np.ones(4)), DegenerateError, r"joint: the squared norm of \(cos, sin\) is off 1 by 1.0e"),
    (lambda: from_pinocchio(FIXED_BASE, np.zeros(4), normalize=True), DegenerateError, "continuous joint: its direction is zero"),
    (lambda: to_mujoco(FIXED_BASE, Q[:3], names=["elbow", *NAMES[1:]]), UnknownNameError, f"unknown joint 'elbow'; known: {KNOWN}. names"),
    (lambda: to_mujoco(FIXED_BASE, Q[:3], names=NAMES[1:3]), UnknownNameError, "other model 'mast_lift'; known: head_turn, wheel_spin. E"),
    (lambda: to_mujoco(FIXED_BASE, Q[:3], names=NAMES[1:] * 2), WrongSizeError, f"joint 'head_turn' given 2 times, each of {KNOWN} needed"),
    (
        lambda: to_mujoco(SimpleNamespace(joint_names=("a",), joint_kinds=("ball",)), Q[:4]),
        UnknownNameError,
        "unknown joint kind 'ball'; known: floating, revolute, continuous, prismatic",
    ),
    (
        lambda: to_mujoco(SimpleNamespace(joint_names=("a", "a"), joint_kinds=("revolute",)), Q[:2]),
        WrongSizeError,
        "1 distinct of 2 joint names and 1 joint kinds given",
    ),
]


@pytest.mark.parametrize(("make", "error", "message"), REFUSED)
def test_refusals_say_what_is_wrong(make, error, message):
    with pytest.raises(error, match=message):
        make()
