"""Inertias read from MJCF: Pinocchio, given the joints and inertias of the RobotModel, agrees with MuJoCo on M(q), gravity and all forces.

MuJoCo's free joint moves with the velocity of its origin along the world's axes and the angular velocity in its own; Pinocchio's (and ours)
has both in its own: v = B v_mujoco, B = diag(R^T, 1), hence M_mujoco = B^T M B and tau_mujoco = B^T tau.
"""

from pathlib import Path

import mujoco
import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.from_mjcf import load_mjcf, load_mjmodel
from cga_codegen.robots.model import RobotModel

FOLDER = Path(__file__).resolve().parents[1] / "data" / "mjcf"
ROBOTS = ("quadruped", "gantry", "hand")
TOLERANCE = 1e-14
"""Relative to the largest entry."""


def pinocchio_model(robot: RobotModel):
    """Every joint with a coordinate of its own, also those that follow."""
    model = pinocchio.Model()
    model.gravity.linear = np.array(robot.gravity)
    for joint in robot.joints:
        if joint.kind == "floating":
            made = pinocchio.JointModelFreeFlyer()
        else:
            slides = joint.kind == "prismatic"
            made = (pinocchio.JointModelPrismaticUnaligned if slides else pinocchio.JointModelRevoluteUnaligned)(np.array(joint.axis))
        placement = pinocchio.SE3(np.array(joint.placement.rotation), np.array(joint.placement.translation))
        index = model.addJoint(joint.parent + 1, made, placement, joint.name)
        if joint.inertia is not None:
            body = pinocchio.Inertia(joint.inertia.mass, np.array(joint.inertia.com), joint.inertia.matrix())
            model.appendBodyToJoint(index, body, pinocchio.SE3.Identity())
    model.armature = np.concatenate([np.zeros(6) if joint.kind == "floating" else [joint.armature] for joint in robot.joints])
    return model


def state(model, robot: RobotModel, rng):
    """Random position, velocity and acceleration: MuJoCo's data with qpos and qvel, Pinocchio's q, v, a, and B and MuJoCo's columns of v.

    The velocities are those of a mechanism in which also the joints that follow may move by themselves: a stricter test.
    """
    data = mujoco.MjData(model)
    value = {joint.name: rng.uniform(-1.5, 1.5) for joint in robot.joints}
    for j in robot.joints:
        if j.follows:
            value[j.name] = j.ratio * value[j.follows]
    names = [model.joint(j).name or f"joint{j}" for j in range(model.njnt)]
    floating = robot.joints[0].kind == "floating"
    turn, q, columns = np.eye(3), [], []
    for joint in robot.joints:
        j = 0 if joint.kind == "floating" else names.index(joint.name)
        address = model.jnt_qposadr[j]
        if joint.kind == "floating":
            quaternion = rng.normal(size=4)
            quaternion /= np.linalg.norm(quaternion)
            data.qpos[:3], data.qpos[3:7] = rng.normal(size=3), quaternion
            mujoco.mju_quat2Mat(flat := np.zeros(9), quaternion)
            turn = flat.reshape(3, 3)
            q += [*data.qpos[:3], *quaternion[1:], quaternion[0]]
            columns += range(6)
        else:
            q.append(value[joint.name])
            columns.append(model.jnt_dofadr[j])
            data.qpos[address] = value[joint.name]
    for e in np.flatnonzero(model.eq_active0):  # MuJoCo's values of joints that follow or are held, from its own polynomials
        y, x, a = model.eq_obj1id[e], model.eq_obj2id[e], model.eq_data[e]
        moved = data.qpos[model.jnt_qposadr[x]] - model.qpos0[model.jnt_qposadr[x]] if x >= 0 else 0.0
        data.qpos[model.jnt_qposadr[y]] = model.qpos0[model.jnt_qposadr[y]] + a[0] + a[1] * moved
    v, a = rng.normal(size=(2, len(columns)))
    data.qvel[columns] = v
    b, db = np.eye(len(columns)), np.zeros((len(columns), len(columns)))
    if floating:
        x, y, z = v[3:6]
        b[:3, :3] = turn.T
        db[:3, :3] = -np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) @ turn.T  # the base turns: d/dt R^T = -[w]x R^T
    return data, np.array(q), b @ v, b @ a + db @ v, a, b, columns


def compare(model, robot: RobotModel, rng, count):
    """The largest differences of M and of M a + bias, relative to the largest entries."""
    other = pinocchio_model(robot)
    work = other.createData()
    worst = [0.0, 0.0]
    for _ in range(count):
        data, q, v, a, qacc, b, columns = state(model, robot, rng)
        mujoco.mj_forward(model, data)
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        expected = full[np.ix_(columns, columns)]
        mass = pinocchio.crba(other, work, q)
        mass = np.triu(mass) + np.triu(mass, 1).T
        force = expected @ qacc + data.qfrc_bias[columns]
        worst[0] = max(worst[0], np.abs(b.T @ mass @ b - expected).max() / np.abs(expected).max())
        found = b.T @ pinocchio.rnea(other, work, q, v, a)
        worst[1] = max(worst[1], np.abs(found - force).max() / np.abs(force).max())
    return worst


@pytest.mark.parametrize("name", ROBOTS)
def test_mass_matrix_and_forces_are_those_of_mujoco(name):
    model, robot = mujoco.MjModel.from_xml_path(str(FOLDER / f"{name}.xml")), load_mjcf(FOLDER / f"{name}.xml")
    worst = compare(model, robot, np.random.default_rng(3), 20)
    assert max(worst) < TOLERANCE, worst


@pytest.mark.parametrize(("name", "hinge"), [("quadruped", "HR_knee"), ("gantry", "turn"), ("hand", "bend_1")])
def test_a_wrong_inertia_or_a_wrong_placement_would_be_seen(name, hinge):
    """The comparison above can fail: one number of one link or joint is changed a little."""
    model = mujoco.MjModel.from_xml_path(str(FOLDER / f"{name}.xml"))
    joint = model.joint(hinge)
    changes = (("body_mass", 1e-6), ("body_ipos", 1e-5), ("body_inertia", 1e-5), ("jnt_pos", 1e-5), ("jnt_axis", 0.0), ("qpos0", 1e-5))
    for field, size in changes:
        changed = mujoco.MjModel.from_xml_path(str(FOLDER / f"{name}.xml"))
        at = joint.qposadr if field == "qpos0" else joint.id if field.startswith("jnt") else joint.bodyid
        getattr(changed, field)[at] += size
        if field == "jnt_axis":
            changed.jnt_axis[at] = -changed.jnt_axis[at]
        worst = compare(model, load_mjmodel(changed), np.random.default_rng(4), 3)
        assert max(worst) > 100.0 * TOLERANCE, (field, worst)


def test_inertia_of_links_held_together_is_that_of_the_whole():
    """Mass and centre of mass of all that the floating base carries when nothing moves, against MuJoCo's subtree."""
    model, robot = mujoco.MjModel.from_xml_path(str(FOLDER / "quadruped.xml")), load_mjcf(FOLDER / "quadruped.xml")
    trunk = robot.joints[0].inertia
    parts = [model.body(name).id for name in ("trunk", "head", "lidar")]
    data = mujoco.MjData(model)
    data.qpos[:7] = 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0
    mujoco.mj_kinematics(model, data)
    mass = model.body_mass[parts].sum()
    centre = model.body_mass[parts] @ data.xipos[parts] / mass
    tensor = np.zeros((3, 3))
    for b in parts:
        turn, d = data.ximat[b].reshape(3, 3), data.xipos[b] - centre
        tensor += turn @ np.diag(model.body_inertia[b]) @ turn.T + model.body_mass[b] * (d @ d * np.eye(3) - np.outer(d, d))
    np.testing.assert_allclose(trunk.mass, mass, rtol=1e-15)
    np.testing.assert_allclose(trunk.com, centre, atol=1e-16)
    np.testing.assert_allclose(trunk.matrix(), tensor, rtol=0, atol=2e-15)
    assert sum(joint.inertia.mass for joint in robot.joints if joint.inertia) == pytest.approx(model.body_mass.sum(), rel=1e-15)


def test_a_model_changed_in_memory_is_read_as_it_is():
    model = mujoco.MjModel.from_xml_path(str(FOLDER / "gantry.xml"))
    model.opt.gravity = 0.0, 1.0, 2.0
    model.qpos0[model.joint("turn").qposadr] = 0.4
    model.dof_armature[:] += 0.5
    robot = load_mjmodel(model, "changed")
    assert (robot.name, robot.source, robot.gravity) == ("changed", "mujoco.MjModel changed", (0.0, 1.0, 2.0))
    worst = compare(model, robot, np.random.default_rng(5), 5)
    assert max(worst) < TOLERANCE, worst
