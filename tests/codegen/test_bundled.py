"""The bundled robots: every number of the NAO's arms is the published one, save the corrections that the file's header names."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.bundled import bundled_robots, load_bundled
from cga_codegen.robots.model import ModelError

DATA = Path(__file__).parents[1] / "data"
ARM = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw"]
VERSIONS = [("nao", "V50"), ("nao_v32", "V32")]
TENSOR = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"]
MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])


@pytest.fixture(scope="module")
def facts():
    return json.loads((DATA / "nao_facts.json").read_text())


def numbers(text):
    return [float(word) for word in text.split()]


def hand_poses(name, q_right, q_left):
    """Both hands by Pinocchio's own reading of the file."""
    model = pinocchio.buildModelFromUrdf(str(bundled_robots()[name]))
    data = model.createData()
    q = np.zeros(model.nq)
    for side, values in (("R", q_right), ("L", q_left)):
        for joint, value in zip(ARM, values, strict=True):
            q[model.joints[model.getJointId(side + joint)].idx_q] = value
    pinocchio.framesForwardKinematics(model, data, q)
    return [data.oMf[model.getFrameId(frame)].homogeneous.copy() for frame in ("RHand", "LHand")]


def test_names_and_files():
    robots = bundled_robots()
    assert {"nao", "nao_v32"} <= set(robots) and list(robots) == sorted(robots)
    for name, path in robots.items():
        assert path.is_file() and load_bundled(name).name == name


def test_an_unknown_name_lists_the_known_ones():
    with pytest.raises(ModelError, match="no bundled robot is called 'noa'; bundled robots: .*nao, nao_v32"):
        load_bundled("noa")


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_every_number_of_the_file_is_the_published_one(name, version, facts):
    robot = ET.parse(bundled_robots()[name]).getroot()
    links = {link.get("name"): link for link in robot.findall("link")}
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    assert set(joints) == set(facts["links"][version])
    assert set(links) == {"torso"} | {fact["child"] for fact in facts["links"][version].values()}
    for key, fact in facts["links"][version].items():
        joint, body = joints[key], links[fact["child"]].find("inertial")
        assert joint.find("parent").get("link") == fact["parent"] and joint.find("child").get("link") == fact["child"]
        xyz = fact["xyz"] if (key, version) != ("RHand", "V50") else "0.05775 0 -0.01231"
        assert joint.find("origin").get("xyz") == xyz and joint.find("origin").get("rpy") == fact["rpy"]
        if key.endswith("Hand"):
            assert joint.get("type") == "fixed"
        else:
            assert joint.get("type") == "revolute" and joint.find("axis").get("xyz") == fact["axis"]
            assert joint.find("limit").attrib == fact["limit"]
        assert float(body.find("mass").get("value")) == fact["mass"]
        assert body.find("origin").get("xyz") == fact["com"] and body.find("origin").get("rpy") == "0 0 0"
        assert {k: float(v) for k, v in body.find("inertia").attrib.items()} == fact["inertia"]


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_the_model_holds_the_published_numbers_to_the_last_bit(name, version, facts):
    model = load_bundled(name)
    for joint in model.joints:
        fact = facts["links"][version][joint.name]
        assert joint.placement.translation == tuple(numbers(fact["xyz"])) and joint.axis == tuple(numbers(fact["axis"]))
        assert np.array_equal(joint.placement.rotation, np.eye(3))
        side, k = ("right", "left")[joint.name[0] == "L"], ARM.index(joint.name[1:])
        assert [joint.lower, joint.upper] == facts["limits"][version][side][k]
        assert (joint.velocity, joint.effort) == (float(fact["limit"]["velocity"]), float(fact["limit"]["effort"]))
        if not joint.name.endswith("WristYaw"):  # the wrist also carries the hand: next test
            assert joint.inertia.mass == fact["mass"] and joint.inertia.com == tuple(numbers(fact["com"]))
            assert joint.inertia.tensor == tuple(fact["inertia"][k] for k in TENSOR)


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_the_hand_goes_along_with_the_wrist(name, version, facts):
    for side in "RL":
        wrist, hand = (facts["links"][version][side + key] for key in ("WristYaw", "Hand"))
        (joint,) = (j for j in load_bundled(name).joints if j.name == side + "WristYaw")
        (m1, c1), (m2, c2) = (wrist["mass"], np.array(numbers(wrist["com"]))), (hand["mass"], np.array(numbers(hand["xyz"])))
        if (side, version) == ("R", "V50"):
            c2[2] = -0.01231
        com = (m1 * c1 + m2 * c2) / (m1 + m2)
        reduced, d = m1 * m2 / (m1 + m2), c1 - c2  # two bodies: the parallel-axis terms sum to the reduced mass at their distance
        tensor = reduced * (d @ d * np.eye(3) - np.outer(d, d))
        entries = [tensor[i, k] + wrist["inertia"][n] + hand["inertia"][n] for n, i, k in zip(TENSOR, *np.triu_indices(3), strict=True)]
        assert joint.inertia.mass == m1 + m2
        assert np.allclose(joint.inertia.com, com, rtol=1e-14, atol=0)
        assert np.allclose(joint.inertia.tensor, entries, rtol=1e-11, atol=0)


def test_frames_and_order_are_a_contract():
    for name in ("nao", "nao_v32"):
        model = load_bundled(name)
        assert [joint.name for joint in model.joints] == [side + joint for side in "LR" for joint in ARM]
        assert [joint.parent for joint in model.joints] == [-1, 0, 1, 2, 3, -1, 5, 6, 7, 8]
        assert [f.name for f in model.frames if not f.name.startswith("L")] == [
            "universe", "torso", "l_wrist", "l_gripper",
            "RShoulderPitch", "RShoulder", "RShoulderRoll", "RBicep", "RElbowYaw", "RElbow", "RElbowRoll", "RForeArm",
            "RWristYaw", "r_wrist", "RHand", "r_gripper",
        ]  # fmt: skip
        hand, gripper = model.frame("RHand"), model.frame("r_gripper")
        assert (hand.joint, hand.placement) == (gripper.joint, gripper.placement) and hand.joint == 9


def test_the_hand_at_zero_and_the_exchanged_digits():
    right, left = hand_poses("nao", np.zeros(5), np.zeros(5))
    assert np.allclose(right[:3, 3], [0.21870, -0.113, 0.08769], rtol=0, atol=1e-15)  # -0.01213 would give 0.08787
    assert np.allclose(left[:3, 3], [0.21870, 0.113, 0.08769], rtol=0, atol=1e-15)
    right, _ = hand_poses("nao_v32", np.zeros(5), np.zeros(5))
    assert np.allclose(right[:3, 3], [0.19855, -0.098, 0.0841], rtol=0, atol=1e-15)


@pytest.mark.parametrize("name", ["nao", "nao_v32"])
def test_the_left_hand_mirrors_the_right(name, facts):
    rng = np.random.default_rng(11)
    signs = np.array(facts["mirror"]["signs"])
    worst = 0.0
    for q in rng.uniform(-np.pi, np.pi, (1000, 5)):
        right, left = hand_poses(name, q, signs * q)
        worst = max(worst, np.abs(MIRROR @ right @ MIRROR - left).max())
    assert worst < 1e-14


@pytest.mark.parametrize("name", ["nao", "nao_v32"])
def test_the_limits_mirror_too(name):
    joints = {joint.name: joint for joint in load_bundled(name).joints}
    for key in ARM:
        right, left = joints["R" + key], joints["L" + key]
        assert (left.lower, left.upper) == ((right.lower, right.upper) if key == "ShoulderPitch" else (-right.upper, -right.lower))


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_masses_mirror_but_inertias_do_not(name, version, facts):
    published = {joint: value for v, joint, value in facts["inertia_asymmetry_rel"] if v == version}
    joints = {joint.name: joint.inertia for joint in load_bundled(name).joints}
    signs = np.array([1, -1, 1, 1, -1, 1])  # a reflection in y = 0 turns xy and yz round
    for key in ARM:
        right, left = joints["R" + key], joints["L" + key]
        assert right.mass == left.mass
        asymmetry = np.abs(signs * right.tensor - left.tensor).max() / np.abs([right.tensor, left.tensor]).max()
        assert abs(asymmetry - published.get(key, 0.0)) < 5.1e-4  # three digits are given; the ElbowYaws' 3e-4 are not listed


def test_the_masses_of_v5():
    masses = {joint.name[1:]: joint.inertia.mass for joint in load_bundled("nao").joints}
    assert masses == {
        "ShoulderPitch": 0.09304, "ShoulderRoll": 0.15777, "ElbowYaw": 0.06483, "ElbowRoll": 0.07761, "WristYaw": 0.18533 + 2e-6,
    }  # fmt: skip


@pytest.mark.parametrize("name", ["nao", "nao_v32"])
def test_every_inertia_is_that_of_a_body(name):
    for joint in load_bundled(name).joints:
        xx, xy, xz, yy, yz, zz = joint.inertia.tensor
        principal = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert principal[0] > 0 and principal[2] <= principal[0] + principal[1]


@pytest.mark.parametrize("name", ["nao", "nao_v32"])
def test_the_header_names_sources_and_licence(name):
    text = bundled_robots()[name].read_text()
    for word in ("nao_description 0.5.15", "BSD", "University of Freiburg", "Aldebaran", "Changes", "LICENSE.nao_description.txt"):
        assert word in text
    assert "mesh" not in text.replace("no meshes", "") and (bundled_robots()[name].parent / "LICENSE.nao_description.txt").is_file()
