"""Paper C, Table 1 and eq. 1: the modified Denavit-Hartenberg table is the NAO's published URDF, and erratum E1 (q2 is not theta2).

Reproduced: Table 1 for both arms and all body versions, with theta = q + (0, pi/2, 0, 0, 0) and a fixed turn behind frame 5.
Not reproduced as printed: the singular q2 of section 5.1 and eq. 19, if it is read as the theta2 of Table 1.
"""

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.bundled import bundled_robots
from cga_codegen.robots.from_dh import nao_mdh

DATA = Path(__file__).parents[1] / "data"
ORACLE = json.loads((DATA / "nao.json").read_text())
FACTS = json.loads((DATA / "nao_facts.json").read_text())
ARM = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw"]
OFFSET = np.array([0, np.pi / 2, 0, 0, 0])
R_FIX = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
VERSIONS = [("V32", "nao_v32"), ("V33", "nao"), ("V40", "nao"), ("V50", "nao")]


def eq1(gamma, b, d, alpha, theta, r):
    """rot_z(gamma) trans_z(b) rot_x(alpha) trans_x(d) rot_z(theta) trans_z(r), multiplied out from elementary matrices."""

    def rot_z(a, z):
        return np.array([[math.cos(a), -math.sin(a), 0, 0], [math.sin(a), math.cos(a), 0, 0], [0, 0, 1, z], [0, 0, 0, 1]])

    def rot_x(a, x):
        return np.array([[1, 0, 0, x], [0, math.cos(a), -math.sin(a), 0], [0, math.sin(a), math.cos(a), 0], [0, 0, 0, 1]])

    return rot_z(gamma, b) @ rot_x(alpha, d) @ rot_z(theta, r)


def table1(version, side, theta):
    """Frames 1..5 (right) or 6..10 (left) of Table 1 as printed, in the torso frame."""
    c = FACTS["constants"][version]
    b1, r1, d3, r3, r5 = (c[k] for k in ("ShoulderOffsetZ", "ShoulderOffsetY", "ElbowOffsetY", "UpperArmLength", "LowerArmLength"))
    s = -1 if side == "R" else 1
    h = np.pi / 2
    rows = [(0, b1, 0, -h, s * r1), (0, 0, 0, h, 0), (0, 0, s * d3, h, r3), (0, 0, 0, -h, 0), (0, 0, 0, h, r5)]
    frames, m = [], np.eye(4)
    for (gamma, b, d, alpha, r), angle in zip(rows, theta, strict=True):
        m = m @ eq1(gamma, b, d, alpha, angle, r)
        frames.append(m)
    return frames


class Urdf:
    """The bundled file, by Pinocchio alone."""

    def __init__(self, name):
        self.model = pinocchio.buildModelFromUrdf(str(bundled_robots()[name]))
        self.data = self.model.createData()

    def joints(self, side, q):
        """Homogeneous matrices of the five joint frames, and of the hand."""
        full = np.zeros(self.model.nq)
        ids = [self.model.getJointId(side + joint) for joint in ARM]
        full[[self.model.joints[k].idx_q for k in ids]] = q
        pinocchio.framesForwardKinematics(self.model, self.data, full)
        hand = self.data.oMf[self.model.getFrameId(side + "Hand")].homogeneous.copy()
        return [self.data.oMi[k].homogeneous.copy() for k in ids], hand


@cache
def constants_of(version, frame):
    """Joint placements and tool of a chain of `nao_mdh`, whose joints all turn about z."""
    chain = nao_mdh(version).chain(frame)
    assert all(joint.axis == (0.0, 0.0, 1.0) for joint in chain.joints)
    return [joint.placement.matrix() for joint in chain.joints], chain.tool.matrix()


def placed(version, frame, q):
    placements, tool = constants_of(version, frame)
    m = np.eye(4)
    for placement, angle in zip(placements, q, strict=True):
        m = m @ placement @ eq1(0, 0, 0, 0, angle, 0)
    return m @ tool


@pytest.mark.parametrize(("version", "name"), VERSIONS)
@pytest.mark.parametrize("side", "RL")
def test_table_1_is_the_urdf(version, name, side):
    """Frame 5, the five oriented axis lines, the hand; the printed table, and the model made of it: 1000 poses, 1e-14."""
    urdf = Urdf(name)
    axes = [FACTS["axes_at_zero"][joint] for joint in ARM]
    rng = np.random.default_rng(31)
    worst = 0.0
    for q in rng.uniform(-np.pi, np.pi, (1000, 5)):
        printed = table1(version, side, q + OFFSET)
        joints, hand = urdf.joints(side, q)
        errors = [
            printed[4][:3, :3] - joints[4][:3, :3] @ R_FIX,
            printed[4][:3, 3] - joints[4][:3, 3],
            placed(version, "mdh5" if side == "R" else "mdh10", q) - printed[4],
            placed(version, side + "WristYaw", q) - joints[4],
            placed(version, side + "Hand", q) - hand,
        ]
        for mdh, joint, axis in zip(printed, joints, axes, strict=True):
            direction = joint[:3, :3] @ axis
            errors += [mdh[:3, 2] - direction, np.cross(mdh[:3, 3] - joint[:3, 3], direction)]
        worst = max(worst, *(np.abs(error).max() for error in errors))
    assert worst < 1e-14


@pytest.mark.parametrize("index", [0, 2, 3, 4])
def test_no_other_offset_fits(index):
    """The pi/2 belongs to joint 2 alone: moved to another joint, the table leaves the URDF."""
    offset = np.zeros(5)
    offset[index] = np.pi / 2
    joints, _ = Urdf("nao").joints("R", np.full(5, 0.3))
    assert np.abs(table1("V50", "R", np.full(5, 0.3) + offset)[4][:3, :3] - joints[4][:3, :3] @ R_FIX).max() > 0.1


@pytest.mark.parametrize("pose", ORACLE["fk"], ids=[f"pose{k}" for k in range(len(ORACLE["fk"]))])
def test_reference_poses(pose):
    version, urdf = "V50", Urdf("nao")
    for side, q in (("R", pose["q"][:5]), ("L", pose["q"][5:])):
        reference = pose[side]
        joints, hand = urdf.joints(side, q)
        assert np.allclose(placed(version, "mdh5" if side == "R" else "mdh10", q), reference["mdh5"], rtol=0, atol=1e-14)
        assert np.allclose(placed(version, side + "Hand", q), reference["hand"], rtol=0, atol=1e-14)
        assert np.allclose(placed(version, side + "WristYaw", q), reference["wrist"], rtol=0, atol=1e-14)
        assert np.allclose(joints[0][:3, 3], reference["U"], rtol=0, atol=1e-14)
        assert np.allclose(joints[3][:3, 3], reference["S"], rtol=0, atol=1e-14)
        assert np.allclose(hand, reference["hand"], rtol=0, atol=1e-14)
        screws = np.array(reference["screws"])
        for k in range(5):
            frame = placed(version, f"mdh{k + 1 + 5 * (side == 'L')}", q[: k + 1])
            direction, origin = frame[:3, 2], frame[:3, 3]
            assert np.allclose(screws[:, k], [*direction, *np.cross(origin, direction)], rtol=0, atol=1e-14)


def pitch_distance(version, side, theta2):
    """Distance of the S centre (origin of frame 3) from the ShoulderPitch axis (z of frame 1), for Table 1's own angle theta2."""
    frames = table1(version, side, [0.4, theta2, -0.2, 0.7, 0.1])
    return np.linalg.norm(np.cross(frames[2][:3, 3] - frames[0][:3, 3], frames[0][:3, 2]))


def singular_q(version, side):
    """Section 5.1 and eq. 19: tan(q2) = -r3/d3, tan(q7) = r3/d3; atan2 because V3.2 has d3 = 0."""
    c = FACTS["constants"][version]
    return math.atan2((-1 if side == "R" else 1) * c["UpperArmLength"], c["ElbowOffsetY"])


@pytest.mark.parametrize("version", ["V32", "V50"])
@pytest.mark.parametrize("side", "RL")
def test_erratum_e1_printed_reading_fails(version, side):
    """Taken as theta2 of Table 1, the printed angle puts the S centre not on the ShoulderPitch axis but as far from it as it can be."""
    c = FACTS["constants"][version]
    farthest = math.hypot(c["UpperArmLength"], c["ElbowOffsetY"])  # 0.106066 m, V3.2: 0.09 m
    assert abs(pitch_distance(version, side, singular_q(version, side)) - farthest) < 1e-15


@pytest.mark.parametrize("version", ["V32", "V50"])
@pytest.mark.parametrize("side", "RL")
def test_erratum_e1_corrected_reading_holds(version, side):
    """Taken as the robot's own q2 = theta2 - pi/2 it lies on the axis; in theta: tan(theta2) = d3/r3, tan(theta7) = -d3/r3."""
    c = FACTS["constants"][version]
    theta = singular_q(version, side) + np.pi / 2
    assert pitch_distance(version, side, theta) < 1e-15
    sign = 1 if side == "R" else -1
    assert abs(math.tan(theta) - sign * c["ElbowOffsetY"] / c["UpperArmLength"]) < 1e-15
    urdf = Urdf("nao" if version == "V50" else "nao_v32")
    joints, _ = urdf.joints(side, [0.4, singular_q(version, side), -0.2, 0.7, 0.1])
    assert np.abs((joints[3][:3, 3] - joints[0][:3, 3])[[0, 2]]).max() < 1e-15  # the axis is y through U


def test_erratum_e1_numbers():
    expected = ORACLE["singular"]
    assert abs(singular_q("V50", "R") - expected["q2_star_right_V33"]) < 1e-15
    assert abs(singular_q("V50", "L") - expected["q7_star_left_V33"]) < 1e-15
    assert abs(singular_q("V32", "R") - expected["q2_star_V32"]) < 1e-15
    assert abs(singular_q("V50", "R") + np.pi / 2 - expected["theta2_MDH_star"]) < 1e-15
