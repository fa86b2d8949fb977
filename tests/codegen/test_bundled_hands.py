"""The bundled hands: fingers against the makers' numbers and against plane geometry, bodies against their principal moments."""

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.bundled import bundled_robots, load_bundled

FINGERS = ("finger_1", "finger_2", "finger_middle")


def turn(axis, angle):
    return pinocchio.AngleAxis(angle, np.array(axis, float)).toRotationMatrix()


def poses(name, q, *frames):
    """4x4 of frames of the file by Pinocchio's own reading; q by joint name, missing ones 0."""
    model = pinocchio.buildModelFromUrdf(str(bundled_robots()[name]))
    data, values = model.createData(), np.zeros(model.nq)
    for joint, value in q.items():
        values[model.joints[model.getJointId(joint)].idx_q] = value
    pinocchio.framesForwardKinematics(model, data, values)
    return [data.oMf[model.getFrameId(frame)].homogeneous.copy() for frame in frames]


def moments(joint):
    xx, xy, xz, yy, yz, zz = joint.inertia.tensor
    return np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


# ---- LEAP Hand

SIM = [  # LEAP_Hand_Sim, from which dex-urdf is made: placements of joints, m and quarter turns (rpy / 90 degrees)
    ("1", (-0.0070952, 0.0230578, -0.0187224), (1, 1, 0)),
    ("5", (-0.0070952, -0.0223922, -0.0187224), (1, 1, 0)),
    ("9", (-0.0070952, -0.0678422, -0.0187224), (1, 1, 0)),
    ("12", (-0.0693952, -0.0012422, -0.0216224), (0, 1, 0)),
    *((name, (-0.0122, 0.0381, 0.0145), (-1, 0, 1)) for name in ("0", "4", "8")),
    *((name, (0.015, 0.0143, -0.013), (1, -1, 0)) for name in ("2", "6", "10")),
    *((name, (0, -0.0361, 0.0002), (0, 0, 0)) for name in ("3", "7", "11")),
    ("13", (0, 0.0143, -0.013), (1, -1, 0)),
    ("14", (0, 0.0145, -0.017), (-1, 0, 0)),
    ("15", (0, 0.0466, 0.0002), (0, 0, 2)),
]
CHAINS = {"index": "1 0 2 3", "middle": "5 4 6 7", "ring": "9 8 10 11", "thumb": "12 13 14 15"}


def test_leap_hand_is_that_of_its_makers_to_a_tenth_of_a_millimetre():
    joints = {joint.name: joint for joint in load_bundled("leap_hand").joints}
    assert sorted(joints, key=int) == [str(k) for k in range(16)] == sorted((name for name, _, _ in SIM), key=int)
    (palm,) = poses("leap_hand", {}, "palm_lower")
    for name, xyz, (roll, pitch, yaw) in SIM:
        found = joints[name].placement.matrix()
        found = np.linalg.inv(palm) @ found if joints[name].parent == -1 else found
        expected = turn((0, 0, 1), yaw * np.pi / 2) @ turn((0, 1, 0), pitch * np.pi / 2) @ turn((1, 0, 0), roll * np.pi / 2)
        assert np.abs(found[:3, 3] - xyz).max() < 1e-4
        assert np.allclose(found[:3, :3], expected, rtol=0, atol=1e-15)
        assert joints[name].axis == (0.0, 0.0, -1.0)


def test_leap_hand_has_four_fingers_of_four_joints():
    model = load_bundled("leap_hand")
    for finger, names in CHAINS.items():
        chain = model.chain(f"{finger}_tip_head")
        assert [joint.name for joint in chain.joints] == names.split()
    limits = {joint.name: (joint.lower, joint.upper) for joint in model.joints}
    for k, pair in enumerate([(-0.314, 2.23), (-1.047, 1.047), (-0.506, 1.885), (-0.366, 2.042)]):
        assert all(limits[CHAINS[finger].split()[k]] == pair for finger in ("index", "middle", "ring"))
    assert [limits[name] for name in CHAINS["thumb"].split()] == [(-0.349, 2.094), (-0.47, 2.443), (-1.2, 1.9), (-1.34, 1.88)]
    masses = {joint.name: joint.inertia.mass for joint in model.joints}
    for finger in ("index", "middle", "ring"):
        assert [masses[name] for name in CHAINS[finger].split()] == [0.044, 0.032, 0.037, 0.016]
    assert [masses[name] for name in CHAINS["thumb"].split()] == [0.032, 0.003, 0.038, 0.049]


def test_the_fingers_of_the_leap_hand_are_one_finger_three_times():
    q = np.random.default_rng(16).uniform(-0.3, 1, 4)
    fingers = ("index", "middle", "ring")
    value = {name: x for finger in fingers for name, x in zip(CHAINS[finger].split(), q, strict=True)}
    index, middle, ring = poses("leap_hand", value, *(f"{finger}_tip_head" for finger in fingers))
    for other, across, forward in ((middle, -0.0454, -0.0001), (ring, -0.0908, -0.00009)):  # the palm's x points along the base's z
        shift = other[:3, 3] - index[:3, 3]
        assert np.allclose(shift, [0, across, forward], rtol=0, atol=1e-5 + 1e-15)  # joint 11 is published 0.01 mm nearer
        assert np.allclose(other[:3, :3], index[:3, :3], rtol=0, atol=1e-15)


# ---- Robotiq 3-Finger Gripper

ROBOSUITE = {  # mass, principal moments, by link of a finger
    0: (0.0494545, (9.98401e-06, 1.10443e-05, 1.39633e-05)),
    1: (0.0859984, (1.50124e-05, 5.9524e-05, 6.46024e-05)),
    2: (0.0461767, (5.90767e-06, 1.67626e-05, 1.70717e-05)),
    3: (0.0227212, (2.01594e-06, 4.69221e-06, 5.48529e-06)),
}


@pytest.mark.parametrize("finger", FINGERS)
def test_robotiq_fingers_are_planar_chains(finger):
    rng = np.random.default_rng(3)
    for q in rng.uniform(-1, 1, (5, 3)):
        value = {f"{finger}_joint_{k + 1}": x for k, x in enumerate(q)}
        base, end = poses("robotiq_3f", value, f"{finger}_link_0", f"{finger}_link_3")
        tip = np.linalg.inv(base) @ end
        z = 0.02 + np.exp(1j * q[0]) * (0.05 - 0.028j + np.exp(1j * (q[1] - 0.52)) * 0.039)  # the plane of the finger, complex
        assert np.allclose(tip[:3, 3], [z.real, z.imag, 0], rtol=0, atol=1e-15)
        assert np.allclose(tip[:3, :3], turn((0, 0, 1), q.sum() - 0.52), rtol=0, atol=1e-15)


def test_robotiq_spreads_two_of_three_fingers():
    joints = {joint.name: joint for joint in load_bundled("robotiq_3f").joints}
    one, two = joints["palm_finger_1_joint"], joints["palm_finger_2_joint"]
    assert (one.lower, one.upper) == (-0.1784, 0.192) == (-two.upper, -two.lower) and one.axis == two.axis == (0.0, 1.0, 0.0)
    first, second, middle = poses("robotiq_3f", {}, *(f"{finger}_link_0" for finger in FINGERS))
    assert np.allclose(first[:3, 3], [-0.0455, 0.0214, 0.036]) and np.allclose(second[:3, 3], [-0.0455, 0.0214, -0.036])
    assert np.allclose(middle[:3, 3], [0.0455, 0.0214, 0]) and np.array_equal(first[:3, :3], second[:3, :3])
    rounded = 1e-3  # of the source's 1.57
    assert np.allclose(first[:3, :3], np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]), rtol=0, atol=rounded)
    assert np.allclose(middle[:3, :3], np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), rtol=0, atol=rounded)
    limits = [(0.0495, 1.2218), (0.0, 1.5708), (-1.2217, -0.0523)]
    assert all([(joints[f"{f}_joint_{k}"].lower, joints[f"{f}_joint_{k}"].upper) for k in (1, 2, 3)] == limits for f in FINGERS)


def test_robotiq_bodies_have_the_published_moments():
    joints = {joint.name: joint for joint in load_bundled("robotiq_3f").joints}
    for finger in FINGERS:
        for link, (mass, principal) in ROBOSUITE.items():
            name = f"{finger}_joint_{link}" if link else f"palm_{finger}_joint"
            if name not in joints:  # the middle finger's first link is a part of the palm
                continue
            assert joints[name].inertia.mass == mass
            assert np.allclose(moments(joints[name]), principal, rtol=1e-5, atol=0)
            x, y, z = joints[name].inertia.com
            assert abs(z) < 1e-3 and np.hypot(x, y) < 0.04  # near the finger's plane and within the part
            assert link == 2 or abs(z) < 3e-7  # the shape of link 2 is set off by 7.5 mm in its file
