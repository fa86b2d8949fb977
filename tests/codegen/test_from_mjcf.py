"""MJCF files: joints, frames and limits agree with MuJoCo's own kinematics of the same file (inertias: test_from_mjcf_dynamics.py)."""

import math
import os
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest

from cga_codegen.robots.from_mjcf import load_mjcf, load_mjmodel
from cga_codegen.robots.model import RobotModel

FOLDER = Path(__file__).resolve().parents[1] / "data" / "mjcf"
ROBOTS = ("quadruped", "gantry", "hand")
EXACT = 5e-15
"""Rounding of some products of rotations and of lengths below 2 m."""
PENDULUM = (
    """<mujoco model="pendulum"><worldbody><body name="rod"><joint name="pivot" {}/><geom size="0.1"/></body></worldbody>{}</mujoco>"""
)


def compiled(name):
    """MuJoCo's own reading of the file."""
    return mujoco.MjModel.from_xml_path(str(FOLDER / f"{name}.xml"))


def world(joints, q, base):
    """Placements of the links in the world, the base's first (4x4), joint by joint. q: name -> value of each joint that follows none."""
    at = [np.eye(4)]
    for joint in joints:
        move = base
        if joint.kind != "floating":
            value = joint.ratio * q[joint.follows or joint.name]
            x, y, z = joint.axis
            cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
            move = np.eye(4)
            if joint.kind == "prismatic":
                move[:3, 3] = value * np.array(joint.axis)
            else:
                move[:3, :3] += math.sin(value) * cross + (1.0 - math.cos(value)) * cross @ cross
        at.append(at[joint.parent + 1] @ joint.placement.matrix() @ move)
    return at


def posture(model, robot: RobotModel, rng):
    """Random values: MuJoCo's data with its kinematics done and all its joint constraints fulfilled, and the robot's placements."""
    data = mujoco.MjData(model)
    q = {joint.name: rng.uniform(-1.5, 1.5) for joint in robot.joints if not joint.follows and joint.kind != "floating"}
    for j in range(model.njnt):
        address, name = model.jnt_qposadr[j], model.joint(j).name or f"joint{j}"
        if name in q:
            data.qpos[address] = q[name]
        elif model.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            data.qpos[:7] = rng.normal(size=7)
            data.qpos[3:7] /= np.linalg.norm(data.qpos[3:7])
    for e in np.flatnonzero(model.eq_active0):  # in the file's order: followers of followers come later
        y, x, a = model.eq_obj1id[e], model.eq_obj2id[e], model.eq_data[e]
        moved = data.qpos[model.jnt_qposadr[x]] - model.qpos0[model.jnt_qposadr[x]] if x >= 0 else 0.0
        data.qpos[model.jnt_qposadr[y]] = model.qpos0[model.jnt_qposadr[y]] + a[0] + a[1] * moved
    mujoco.mj_kinematics(model, data)
    base = np.eye(4)
    if robot.joints[0].kind == "floating":
        mujoco.mju_quat2Mat(flat := np.zeros(9), data.qpos[3:7])
        base[:3, :3], base[:3, 3] = flat.reshape(3, 3), data.qpos[:3]
    return data, world(robot.joints, q, base)


def frames(robot, at):
    """Name -> placement in the world."""
    return {frame.name: at[frame.joint + 1] @ frame.placement.matrix() for frame in robot.frames}


@pytest.mark.parametrize("name", ROBOTS)
def test_every_body_and_site_is_where_mujoco_has_it(name):
    model, robot = compiled(name), load_mjcf(FOLDER / f"{name}.xml")
    rng = np.random.default_rng(1)
    named = [("site", s, model.site(s).name) for s in range(model.nsite) if model.site(s).name]
    named += [("body", b, model.body(b).name or f"body{b}") for b in range(model.nbody)]
    for _ in range(10):
        data, at = posture(model, robot, rng)
        found = frames(robot, at)
        for kind, index, title in named:
            matrix = found.get(f"{title}:{kind}", found.get(title))
            place, turn = (data.xpos, data.xmat) if kind == "body" else (data.site_xpos, data.site_xmat)
            np.testing.assert_allclose(matrix[:3, 3], place[index], atol=EXACT, rtol=0, err_msg=title)
            np.testing.assert_allclose(matrix[:3, :3], turn[index].reshape(3, 3), atol=EXACT, rtol=0, err_msg=title)
    assert {frame.name.split(":")[0] for frame in robot.frames} == {title for *_, title in named} | {
        model.joint(j).name or f"joint{j}" for j in range(model.njnt) if model.joint(j).name != "stuck"
    } | ({"stuck"} if name == "gantry" else set())


@pytest.mark.parametrize("name", ROBOTS)
def test_every_joint_has_its_frame_at_its_anchor_and_its_axis_along_mujocos(name):
    model, robot = compiled(name), load_mjcf(FOLDER / f"{name}.xml")
    rng = np.random.default_rng(2)
    for _ in range(10):
        data, at = posture(model, robot, rng)
        for joint in robot.joints:
            j = model.joint(joint.name).id if joint.name != "joint8" else 8
            if joint.kind == "floating":
                continue
            matrix, along, anchor = frames(robot, at)[joint.name], data.xaxis[j], data.xanchor[j]
            if joint.kind == "prismatic":  # MuJoCo gives the anchor before the joint has moved it
                anchor = anchor + along * (data.qpos[model.jnt_qposadr[j]] - model.qpos0[model.jnt_qposadr[j]])
            np.testing.assert_allclose(matrix[:3, 3], anchor, atol=EXACT, rtol=0, err_msg=joint.name)
            np.testing.assert_allclose(matrix[:3, :3] @ joint.axis, along, atol=EXACT, rtol=0, err_msg=joint.name)
            np.testing.assert_allclose(np.linalg.norm(joint.axis), 1.0, atol=EXACT)
            if j + 1 == model.njnt or model.jnt_bodyid[j + 1] != model.jnt_bodyid[j]:  # the body's last: its axes are the body's
                turn = data.xmat[model.jnt_bodyid[j]].reshape(3, 3)
                np.testing.assert_allclose(matrix[:3, :3], turn, atol=EXACT, rtol=0, err_msg=joint.name)


def test_joints_in_mujocos_order_with_its_limits():
    robot = load_mjcf(FOLDER / "quadruped.xml")
    model = compiled("quadruped")
    assert robot.name == "quadruped" and robot.source == "quadruped.xml" and robot.gravity == (0.3, -0.2, -9.7)
    assert [joint.name for joint in robot.joints] == [model.joint(j).name for j in range(model.njnt)]
    assert robot.coordinates.floating and robot.coordinates.nv == model.nv == 12
    degrees = {"FL_abduct": (-35, 35), "FL_hip": (-80, 100), "FL_knee": (-120, -10), "HR_abduct": (-35, 35), "HR_hip": (-80, 100)}
    efforts = {"FL_abduct": 20.0, "FL_hip": 12.5, "FL_knee": math.inf, "HR_abduct": math.inf, "HR_hip": 24.0}
    armatures = {"FL_abduct": 0.03, "FL_hip": 0.02, "HR_hip": 0.0, "base": 0.0}
    joints = {joint.name: joint for joint in robot.joints}
    for name, limits in degrees.items():
        np.testing.assert_allclose((joints[name].lower, joints[name].upper), np.radians(limits), rtol=1e-15)
        assert joints[name].effort == efforts[name] and joints[name].velocity == math.inf
    assert {name: joints[name].armature for name in armatures} == armatures
    assert joints["FL_abduct"].inertia is None and joints["FL_hip"].inertia is not None  # two joints in one body
    assert robot.tips() == ("FL_foot", "HR_foot")


def test_linear_constraints_make_joints_follow_and_constant_ones_lock():
    robot = load_mjcf(FOLDER / "gantry.xml")
    joints = {joint.name: joint for joint in robot.joints}
    assert list(joints) == ["x", "y", "turn", "tilt", "lead", "driven", "second"]
    assert robot.coordinates.names == ("x", "y", "turn", "tilt", "lead")
    assert (joints["driven"].follows, joints["driven"].ratio) == ("lead", -1.5)
    assert joints["second"].follows == "lead" and math.isclose(joints["second"].ratio, -0.3)  # follows a follower
    assert joints["second"].inertia is not None and robot.frame("end").joint == list(joints).index("second")
    kinds = {"x": "prismatic", "y": "prismatic", "turn": "continuous", "tilt": "revolute", "lead": "revolute"}
    assert {name: joints[name].kind for name in kinds} == kinds
    limits = {"x": (-0.4, 0.6), "y": (-math.inf, math.inf), "turn": (-math.inf, math.inf), "tilt": (-2.0, 1.5)}
    assert {name: (joints[name].lower, joints[name].upper) for name in limits} == limits
    efforts = {"x": 18.0, "y": math.inf, "turn": math.inf, "tilt": 7.0, "lead": math.inf}  # 1.5 * 6 * 2; min(3 * 5, 7)
    assert {name: joints[name].effort for name in efforts} == efforts
    assert joints["turn"].armature == 0.15 + 0.02 * 5.0**2


def test_included_files_attached_models_and_copies():
    robot = load_mjcf(str(FOLDER / "hand.xml"))
    fingers = [f"{part}_{k}" for k in range(3) for part in ("bend", "curl")]
    assert [joint.name for joint in robot.joints] == ["palm", "T_swing", *fingers, "joint8"]
    assert [joint.parent for joint in robot.joints] == [-1, 0, 0, 2, 0, 4, 0, 6, 0]
    assert robot.name == "hand"
    text = (FOLDER / "hand.xml").read_text()
    assert replace(load_mjcf(text, "hand", FOLDER), source="hand.xml") == robot
    assert [f.name for f in robot.frames[:4]] == ["world", "palm", "palm:body", "palm:site"]
    swing = robot.joints[1]
    np.testing.assert_allclose((swing.lower, swing.upper, swing.effort), (*np.radians((-30, 60)), 2.0), rtol=1e-15)


@pytest.mark.parametrize("name", ROBOTS)
def test_the_compiled_model_gives_the_same_robot(name):
    robot, same = load_mjcf(FOLDER / f"{name}.xml"), load_mjmodel(compiled(name), name)
    assert replace(same, source=robot.source) == robot
    assert RobotModel.from_json(robot.to_json()) == robot


def test_gravity_and_constraints_can_be_switched_off():
    assert load_mjcf(PENDULUM.format("", '<option><flag gravity="disable"/></option>')).gravity == (0.0, 0.0, 0.0)
    second = '<equality><joint joint1="pivot"/></equality>'
    with pytest.raises(ValueError, match="every joint would be locked"):
        load_mjcf(PENDULUM.format("", second))
    assert len(load_mjcf(PENDULUM.format("", second + '<option><flag equality="disable"/></option>')).joints) == 1


def test_made_up_names_avoid_given_ones():
    child = '<body><joint/><geom size="1"/></body>'
    robot = load_mjcf(f'<mujoco><worldbody><body name="body2"><freejoint/><geom size="1"/>{child}</body></worldbody></mujoco>')
    assert robot.name == "robot" and [joint.name for joint in robot.joints] == ["root_joint", "joint1"]
    assert [frame.name for frame in robot.frames] == ["world", "root_joint", "body2", "joint1", "body2_"]


def test_what_a_scene_holds_besides_the_robot_is_neither_needed_nor_opened(tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    scene = """<asset><mesh file="/nowhere.obj"/><texture type="2d" name="t" file="no.png"/><material name="m" texture="t"/>
        <hfield name="h" file="no.png" size="1 1 1 1"/></asset><visual><global offwidth="1"/></visual>
        <contact><exclude body1="no" body2="rod"/></contact>
        <worldbody><geom type="hfield" hfield="h"/><geom type="mesh" mesh="nowhere" material="m"/><camera/></worldbody>
        <sensor><touch site="none"/></sensor><keyframe><key qpos="1 2 3"/></keyframe><size nuser_body="1000000000"/>
        <extension><plugin plugin="mujoco.none"/></extension><compiler settotalmass="3"/>"""
    robot = load_mjcf(PENDULUM.format("", scene))
    assert robot.joints[0].inertia is not None and robot.joints[0].inertia.mass == 3.0
    assert os.listdir(tmp_path) == [] and capfd.readouterr() == ("", "")  # no MUJOCO_LOG.TXT, no warning on the screen
    before = mujoco.get_mju_user_warning()
    load_mjcf(PENDULUM.format("", scene))
    assert mujoco.get_mju_user_warning() is before
