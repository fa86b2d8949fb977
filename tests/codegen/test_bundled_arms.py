"""The bundled arms and the humanoid: each file against figures that come from somewhere else; and what holds for the hands' files too."""

import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.bundled import bundled_robots, load_bundled
from cga_codegen.robots.from_urdf import load_urdf

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "dynamics.json").read_text())
TAGS = {"robot", "link", "inertial", "origin", "mass", "inertia", "joint", "parent", "child", "axis", "limit", "mimic"}  # no mesh, no more
SIDES = ("left", "right")
LEG = [f"{{}}_{part}_joint" for part in ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")]
ARM = [
    f"{{}}_{part}_joint" for part in ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll", "wrist_pitch", "wrist_yaw")
]
WAIST = ["waist_yaw_joint", "waist_roll_joint", "waist_pitch_joint"]

# name: joints, kg of all links, kg that moves, {frame of interest: joints between it and the base}, what the header names
ROBOTS = {
    "panda": (9, 17.451901, 16.822132,
              {"panda_link8": 7, "panda_hand": 7, "panda_hand_tcp": 7, "panda_leftfinger": 8, "panda_rightfinger": 8},
              ("example-robot-data 6.0.0", "franka_description", "Apache-2.0", "Franka Robotics GmbH")),
    "iiwa14": (7, 29.9, 22.849622, {"lbr_link_ee": 7}, ("lbr_description 1.x", "104198c3e290", "MIT", "Martin Huber")),
    "ur5": (6, 20.9939, 16.9939, {"tool0": 6, "ee_link": 6, "base": 0},
            ("example-robot-data 6.0.0", "ur_description", "BSD 3-Clause", "W. Meeussen")),
    "g1": (29, 33.34114202, 29.52714202,
           {"left_rubber_hand": 10, "right_rubber_hand": 10, "left_ankle_roll_link": 6, "torso_link": 3, "pelvis": 0},
           ("example-robot-data 6.0.0", "unitree_ros", "BSD-3-Clause", "Unitree Robotics")),
    "leap_hand": (16, 0.746, 0.509, {f"{finger}_tip_head": 4 for finger in ("index", "middle", "ring", "thumb")},
                  ("dex-urdf", "77eb4ac0837a", "LEAP_Hand_Sim", "MIT", "Ananye Agarwal")),
    "robotiq_3f": (11, 1.8134924, 0.5635979, {"finger_1_link_3": 4, "finger_2_link_3": 4, "finger_middle_link_3": 3, "tool0": 0},
                   ("robotiq_3f_gripper_visualization 1.0.0", "47026c60e476", "BSD 3-Clause", "robosuite", "MIT")),
    "tm5_700": (6, 19.674, 18.674, {"flange": 6}, ("tmr_ros2", "2ff05b0dd8a7", "BSD-3-Clause", "Techman Robot Inc.", "Denavit-Hartenberg")),
}  # fmt: skip


def turn(axis, angle):
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def rigid(rotation=None, translation=(0, 0, 0)):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = np.eye(3) if rotation is None else rotation, translation
    return matrix


def pose(model, frame, q):
    """4x4 of a frame in the base, by products of matrices; q by joint name (rad, m), missing ones 0."""
    frame = model.frame(frame)
    matrix = np.eye(4)
    for joint in (model.joints[k] for k in model.path(frame.joint)):
        value = joint.ratio * q.get(joint.follows, 0.0) if joint.follows else q.get(joint.name, 0.0)
        step = rigid(None, value * np.array(joint.axis)) if joint.kind == "prismatic" else rigid(turn(joint.axis, value))
        matrix = matrix @ joint.placement.matrix() @ step
    return matrix @ frame.placement.matrix()


def named(model, values):
    return {joint.name: value for joint, value in zip(model.joints, values, strict=False)}


def tensor(inertia):
    xx, xy, xz, yy, yz, zz = inertia.tensor
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def merged(bodies):
    """Mass, centre and tensor of (mass, centre, tensor) held together: masses and first moments add, tensors by parallel axes."""
    mass = sum(m for m, _, _ in bodies)
    com = sum(m * c for m, c, _ in bodies) / mass
    return mass, com, sum(t + m * ((c - com) @ (c - com) * np.eye(3) - np.outer(c - com, c - com)) for m, c, t in bodies)


# ---- every file


@pytest.mark.parametrize("name", ROBOTS)
def test_counts_frames_and_tree(name):
    model, (count, _, _, frames, _) = load_bundled(name), ROBOTS[name]
    assert (model.name, len(model.joints)) == (name, count) and ET.parse(bundled_robots()[name]).getroot().get("name") == name
    assert all(-1 <= joint.parent < k for k, joint in enumerate(model.joints))
    assert len({joint.name for joint in model.joints}) == count and len({frame.name for frame in model.frames}) == len(model.frames)
    assert {frame: len(model.path(model.frame(frame).joint)) for frame in frames} == frames


@pytest.mark.parametrize("name", ROBOTS)
def test_no_file_has_anything_but_links_and_joints(name):
    root = ET.parse(bundled_robots()[name]).getroot()
    assert {element.tag for element in root.iter()} <= TAGS and {element.tag for element in root} == {"link", "joint"}
    assert "mesh" not in bundled_robots()[name].read_text().replace("no meshes", "")


@pytest.mark.parametrize("name", ROBOTS)
def test_the_header_names_source_licence_and_changes(name):
    header = re.search(r"<!--(.*?)-->", bundled_robots()[name].read_text(), re.DOTALL)[1]
    for word in (*ROBOTS[name][4], "Sources", "Licence", "Changes"):
        assert word in header
    notices = re.findall(r"LICENSE\.\w+\.txt", header)
    assert notices
    for notice in notices:  # the notice speaks of this file and holds the conditions
        text = (bundled_robots()[name].parent / notice).read_text()
        assert f"{name}.urdf" in text and "AS IS" in text


@pytest.mark.parametrize("name", ROBOTS)
def test_masses_are_positive_and_their_sum_is_known(name):
    _, total, moving, _, _ = ROBOTS[name]
    masses = [float(mass.get("value")) for mass in ET.parse(bundled_robots()[name]).getroot().iter("mass")]
    assert sum(masses) == pytest.approx(total, rel=1e-14) and min(masses) >= 0.0
    assert sum(joint.inertia.mass for joint in load_bundled(name).joints) == pytest.approx(moving, rel=1e-14)
    for joint in load_bundled(name).joints:
        low, middle, high = np.linalg.eigvalsh(tensor(joint.inertia))
        assert joint.inertia.mass > 0 and low > 0 and high <= low + middle  # a body has such a tensor


@pytest.mark.parametrize("name", ROBOTS)
def test_limits_are_finite_and_not_empty(name):
    for joint in load_bundled(name).joints:
        assert joint.lower < joint.upper and np.isfinite([joint.lower, joint.upper]).all()
        assert 0 < joint.velocity < np.inf and 0 < joint.effort < np.inf


def test_the_page_about_the_robots_lists_every_one_with_its_mass():
    page = (Path(__file__).parents[2] / "docs" / "robots.md").read_text()
    rows = {line.split("|")[1].strip(): line for line in page.splitlines() if line.startswith("| ")}
    assert set(bundled_robots()) <= set(rows)
    for name, (_, total, moving, frames, _) in ROBOTS.items():
        row = next(line for line in page.splitlines() if line.startswith(f"| {name} |"))
        assert row.endswith(f"| {total:.3f} | {moving:.3f} |") and all(f"`{frame}`" in row for frame in frames)


# ---- Panda and iiwa 14 against the figures of the dynamics' oracle


def placement_of_motor(m):
    """4x4 of M = (1 - t ei / 2) (w - v I3), components 1 e23 e13 e12 e1i e2i e3i e123i."""
    w, v, d, s = m[0], np.array([-m[1], m[2], -m[3]]), -2 * np.array(m[4:7]), 2 * m[7]  # d = w t + t x v, s = t . v
    angle = 2 * np.arctan2(np.linalg.norm(v), w)
    axis = v / np.linalg.norm(v) if np.linalg.norm(v) > 0 else v
    return rigid(turn(axis, angle), w * d + s * v - np.cross(d, v))


@pytest.mark.parametrize(("name", "frame"), [("panda", "panda_link8"), ("iiwa14", "lbr_link_ee")])
def test_seven_joints_as_in_the_oracle(name, frame):
    model, oracle = load_bundled(name), ORACLE[name]
    assert oracle["ee_frame"] == frame and model.path(model.frame(frame).joint) == tuple(range(7))
    for k, (joint, given) in enumerate(zip(model.joints, oracle["joints"], strict=False)):
        assert (joint.lower, joint.upper, joint.parent) == (oracle["lower"][k], oracle["upper"][k], k - 1)
        assert joint.axis == tuple(given["axis"])
        assert np.allclose(joint.placement.matrix(), placement_of_motor(given["motor_MF"]), rtol=0, atol=1e-15)
        bodies = [(joint.inertia.mass, np.array(joint.inertia.com), tensor(joint.inertia))]
        if k == 6:  # the oracle's last body holds the fingers (Panda), locked at 0
            for finger in model.joints[7:]:
                r, p = np.array(finger.placement.rotation), np.array(finger.placement.translation)
                bodies.append((finger.inertia.mass, r @ finger.inertia.com + p, r @ tensor(finger.inertia) @ r.T))
        mass, com, moments = merged(bodies)
        assert mass == pytest.approx(given["mass"], rel=1e-15)
        assert np.allclose(com, given["com"], rtol=0, atol=1e-16) and np.allclose(moments, given["inertia_com"], rtol=0, atol=1e-17)


@pytest.mark.parametrize(("name", "frame", "locked"), [("panda", "panda_link8", 2), ("iiwa14", "lbr_link_ee", 0)])
def test_poses_and_dynamics_as_in_the_oracle(name, frame, locked):
    robot = load_bundled(name)
    model = pinocchio.buildModelFromUrdf(str(bundled_robots()[name]))  # the file by Pinocchio's own reading
    model = pinocchio.buildReducedModel(model, list(range(8, 8 + locked)), pinocchio.neutral(model))
    data = model.createData()
    for sample in ORACLE[name]["samples"]:
        q, v, a = (np.array(sample[key]) for key in ("q", "qd", "qdd"))
        expected = rigid(sample["ee_rotation"], sample["ee_translation"])
        assert np.allclose(pose(robot, frame, named(robot, q)), expected, rtol=0, atol=5e-15)
        upper = np.triu(pinocchio.crba(model, data, q))
        assert np.allclose(upper, np.triu(sample["M"]), rtol=0, atol=2e-15)
        assert np.allclose(pinocchio.rnea(model, data, q, v, a), sample["tau"], rtol=0, atol=2e-14)


def test_the_second_finger_of_the_panda_mimics_the_first():
    model = load_bundled("panda")
    first, second = model.joints[7:]
    assert [first.kind, second.kind] == ["prismatic"] * 2 and (first.follows, first.lower, first.upper) == ("", 0.0, 0.04)
    assert (second.name, second.follows, second.ratio) == ("panda_finger_joint2", "panda_finger_joint1", 1.0)
    assert first.axis == (0.0, 1.0, 0.0) and second.axis == (0.0, -1.0, 0.0)
    left, right = (pose(model, f"panda_{side}finger", {"panda_finger_joint1": 0.03})[:3, 3] for side in SIDES)
    assert np.linalg.norm(left - right) == pytest.approx(0.06, rel=1e-14)


# ---- UR5 and TM5-700 against their Denavit-Hartenberg tables


def test_ur5_is_the_maker_s_table():
    model, q = load_bundled("ur5"), np.random.default_rng(5).uniform(-np.pi, np.pi, 6)
    a, d = [0, -0.425, -0.39225, 0, 0, 0], [0.089159, 0, 0, 0.10915, 0.09465, 0.0823]
    expected = np.eye(4)
    for k, alpha in enumerate([np.pi / 2, 0, 0, np.pi / 2, -np.pi / 2, 0]):
        expected = expected @ rigid(turn((0, 0, 1), q[k]), (0, 0, d[k])) @ rigid(turn((1, 0, 0), alpha), (a[k], 0, 0))
    found = np.linalg.inv(pose(model, "base", {})) @ pose(model, "tool0", named(model, q))
    assert np.allclose(found, expected, rtol=0, atol=2e-11)  # the file has quarter turns to eleven decimals, 5e-12 rad short


TM5_LENGTHS = {"d": (0.1452, 0, 0, -0.1223, 0.106, 0.11315), "a": (0, 0, 0.329, 0.3115, 0, 0)}
TM5_ALPHA, TM5_OFFSET = np.deg2rad([0, -90, 0, 0, -90, -90]), np.deg2rad([0, -90, 0, -90, 0, 180])
TM5_Q = [-1.2187411525722882, 2.6931475602920427, 2.4980881172290674, -0.11453743019952878, -1.0298327699718672, 0.21260873898001886]
TM5_TABLE = [-0.2617082899604938, 0.1887572036853508, -0.06060352284247936]  # positions of the flange: the paper's lengths, the maker's
TM5_NOMINAL = [-0.2623502954413533, 0.18892808896727808, -0.061704715447321576]
TM5_ROTATION = [
    [-0.792660693573181, -0.15850578242979216, -0.5886976658696745],
    [-0.2722172232538244, 0.9560283309810916, 0.1091220130197647],
    [0.5455151768998376, 0.24675037446339898, -0.8009540838737957],
]


def test_tm5_700_is_the_table_of_the_paper():
    model, rng = load_bundled("tm5_700"), np.random.default_rng(7)
    for q in rng.uniform([j.lower for j in model.joints], [j.upper for j in model.joints], (50, 6)):
        expected = np.eye(4)
        for alpha, a, d, theta in zip(TM5_ALPHA, TM5_LENGTHS["a"], TM5_LENGTHS["d"], q + TM5_OFFSET, strict=True):
            expected = expected @ rigid(turn((1, 0, 0), alpha), (a, 0, 0)) @ rigid(turn((0, 0, 1), theta), (0, 0, d))
        assert np.allclose(pose(model, "flange", named(model, q)), expected, rtol=0, atol=3e-15)


def test_tm5_700_at_the_published_places():
    model = load_bundled("tm5_700")
    upright, at_zero = (pose(model, "flange", named(model, q))[:3, 3] for q in (np.zeros(6), -TM5_OFFSET))
    assert np.allclose(upright, [0, -0.23545, 0.8917], rtol=0, atol=1e-15)
    assert np.allclose(at_zero, [0.6405, -0.23545, 0.0392], rtol=0, atol=1e-15)
    assert np.allclose(pose(model, "flange", named(model, TM5_Q)), rigid(TM5_ROTATION, TM5_TABLE), rtol=0, atol=1e-15)
    text = bundled_robots()["tm5_700"].read_text()
    for ours, makers in (("0 0 0.1452", "0 0 0.1451"), ("0.3115 0 -0.1223", "0.3115 0 -0.1222"), ("0 -0.11315 0", "0 -0.1144 0")):
        assert text.count(f'"{ours}"') == 1
        text = text.replace(f'"{ours}"', f'"{makers}"')
    nominal = load_urdf(text)
    assert np.allclose(pose(nominal, "flange", named(nominal, TM5_Q)), rigid(TM5_ROTATION, TM5_NOMINAL), rtol=0, atol=1e-15)


def test_tm5_700_limits():
    joints = load_bundled("tm5_700").joints
    assert np.allclose(np.rad2deg([joint.upper for joint in joints]), [270, 180, 155, 180, 180, 270], rtol=1e-15)
    assert [joint.lower for joint in joints] == [-joint.upper for joint in joints]
    assert np.allclose(np.rad2deg([joint.velocity for joint in joints]), [180, 180, 180, 225, 225, 225], rtol=1e-15)
    assert [joint.effort for joint in joints] == [157.0] * 3 + [43.0] * 3


# ---- the humanoid


def test_g1_has_legs_waist_and_arms():
    names = [joint.name for joint in load_bundled("g1").joints]
    legs, arms = ([part.format(side) for side in SIDES for part in parts] for parts in (LEG, ARM))
    assert names == legs + WAIST + arms
    assert [name for name in names if name not in legs] == WAIST + arms and len(WAIST + arms) == 17  # the upper body


def test_g1_is_symmetric():
    model = load_bundled("g1")
    joints = {joint.name: joint for joint in model.joints}
    for part in LEG + ARM:
        left, right = (joints[part.format(side)] for side in SIDES)
        assert (left.velocity, left.effort, left.axis) == (right.velocity, right.effort, right.axis)
        pitch = left.axis == (0.0, 1.0, 0.0)  # a reflection in y = 0 keeps pitch and turns roll and yaw round
        assert (right.lower, right.upper) == ((left.lower, left.upper) if pitch else (-left.upper, -left.lower))
        assert left.inertia.mass == right.inertia.mass
    q = np.random.default_rng(29).uniform(-1, 1, len(LEG + ARM))
    value = {part.format(side): x * (1 if side == "left" or joints[part.format(side)].axis[1] else -1)
             for part, x in zip(LEG + ARM, q, strict=True) for side in SIDES}  # fmt: skip
    for frame in ("{}_rubber_hand", "{}_ankle_roll_link"):
        left, right = (pose(model, frame.format(side), value)[:3, 3] for side in SIDES)
        assert np.allclose(left * [1, -1, 1], right, rtol=0, atol=2e-5)  # one shoulder is published 0.01 mm nearer than the other
