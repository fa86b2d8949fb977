"""pinocchio.Model to RobotModel: which joints are taken, what of each is read, and the same kinematics and dynamics as Pinocchio's."""

import math

import numpy as np
import pinocchio as pin
import pytest
from joint_by_joint import Peer, body, motor_of, random_rotation

from cga_codegen.kernels import dynamics, tree_kinematics
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.bundled import bundled_robots
from cga_codegen.robots.errors import BadNumberError, DuplicateNameError, UnsupportedJointError
from cga_codegen.robots.from_pinocchio import load_pinocchio
from cga_codegen.robots.model import ModelError

OBLIQUE = np.array([2.0, -3.0, 6.0]) / 7.0
UNBOUNDED = """<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/>
<axis xyz="2 -3 6"/></joint></robot>"""  # Python cannot make its joint directly
TURNING = {
    "RX": (pin.JointModelRX(), "revolute", (1.0, 0.0, 0.0)),
    "RY": (pin.JointModelRY(), "revolute", (0.0, 1.0, 0.0)),
    "RZ": (pin.JointModelRZ(), "revolute", (0.0, 0.0, 1.0)),
    "unaligned": (pin.JointModelRevoluteUnaligned(OBLIQUE), "revolute", tuple(OBLIQUE)),
    "RUBX": (pin.JointModelRUBX(), "continuous", (1.0, 0.0, 0.0)),
    "RUBY": (pin.JointModelRUBY(), "continuous", (0.0, 1.0, 0.0)),
    "RUBZ": (pin.JointModelRUBZ(), "continuous", (0.0, 0.0, 1.0)),
    "unbounded": (pin.buildModelFromXML(UNBOUNDED).joints[1].extract(), "continuous", tuple(OBLIQUE)),
}
SLIDING = {
    "PX": (pin.JointModelPX(), "prismatic", (1.0, 0.0, 0.0)),
    "PY": (pin.JointModelPY(), "prismatic", (0.0, 1.0, 0.0)),
    "PZ": (pin.JointModelPZ(), "prismatic", (0.0, 0.0, 1.0)),
    "slides": (pin.JointModelPrismaticUnaligned(OBLIQUE), "prismatic", tuple(OBLIQUE)),
}
PLACED = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.4, 0.5), np.array([0.1, 0.2, 0.3]))


def row(*joints, root=None):
    """A row of joints, each with a body; root: a joint before them."""
    rng, model = np.random.default_rng(4), pin.Model()
    model.name, last = "row", 0
    for k, joint in enumerate([*([root] if root else []), *joints]):
        last = model.addJoint(last, joint, PLACED, f"j{k}")
        model.addJointFrame(last)
        given = body(rng)
        model.appendBodyToJoint(last, pin.Inertia(given.mass, np.array(given.com), given.matrix()), PLACED)
        model.addBodyFrame(f"link{k}", last, PLACED, -1)
    return model


def check(model, q_peer, q, v, a):
    """Our kernels at q against Pinocchio's at its own position."""
    ours, data = load_pinocchio(model), model.createData()
    tree, at = Tree.of(ours), ours.coordinates
    first = 8 if at.floating else 0
    moved = [(ratio * q[first + k], joint.kind) for (k, ratio, _), joint in zip(at.motions, ours.joints[int(at.floating) :], strict=True)]
    c = [1 if kind == "prismatic" else math.cos(x) for x, kind in moved]
    s = [x if kind == "prismatic" else math.sin(x) for x, kind in moved]
    base = {"base": list(q[:8])} if at.floating else {}
    tau = dynamics.inverse_dynamics(tree, c, s, v, a, **base)
    expected = pin.rnea(model, data, q_peer, v, a)
    assert np.abs(np.array(tau) - expected).max() < 2e-14 * max(1.0, np.abs(expected).max())
    pin.framesForwardKinematics(model, data, q_peer)
    poses = np.array(tree_kinematics.frames(tree, c, s, **base)).reshape(-1, 4, 4)
    first_of = {frame.name: k for k, frame in reversed(list(enumerate(model.frames)))}
    for frame, pose in zip(ours.frames, poses, strict=True):
        if frame.name in first_of:
            assert np.abs(pose - data.oMf[first_of[frame.name]].homogeneous).max() < 4e-15
    return ours


# ---- joints


@pytest.mark.parametrize("name", [*TURNING, *SLIDING])
def test_joints_of_one_degree_of_freedom(name):
    joint, kind, axis = (TURNING | SLIDING)[name]
    model = row(joint, pin.JointModelRY())
    found = load_pinocchio(model).joints[0]
    assert (found.kind, found.name, found.parent, found.follows) == (kind, "j0", -1, "")
    assert np.allclose(found.axis, axis, rtol=0, atol=2e-16)
    assert np.array_equal(found.placement.matrix(), PLACED.homogeneous)
    rng = np.random.default_rng(5)
    q, v, a = rng.normal(size=(3, 2))
    check(model, pin.integrate(model, pin.neutral(model), q), q, v, a)


def composite():
    joint = pin.JointModelComposite()
    joint.addJoint(pin.JointModelRX())
    joint.addJoint(pin.JointModelRY())
    return joint


REFUSED = [
    pin.JointModelSpherical(), pin.JointModelSphericalZYX(), pin.JointModelPlanar(), pin.JointModelTranslation(), composite(),
    pin.JointModelHX(0.1), pin.JointModelHY(0.1), pin.JointModelHZ(0.1), pin.JointModelHelicalUnaligned(OBLIQUE, 0.1),
    pin.JointModelUniversal(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])), pin.JointModelFreeFlyer(),
]  # fmt: skip


@pytest.mark.parametrize("joint", REFUSED, ids=[joint.shortname() for joint in REFUSED])
def test_other_joints_are_refused_by_name(joint):
    accepted = "revolute, continuous and prismatic joints, and a free flyer at the root, can be represented"
    with pytest.raises(UnsupportedJointError) as refusal:
        load_pinocchio(row(pin.JointModelRX(), joint))
    assert str(refusal.value) == f"row: joint 'j1' is a {joint.shortname()}; {accepted}"


def test_a_free_flyer_at_the_root():
    rng = np.random.default_rng(6)
    model = row(pin.JointModelRUBY(), pin.JointModelPX(), root=pin.JointModelFreeFlyer())
    model.gravity.linear = np.array([1.0, -2.0, -9.0])
    for _ in range(3):
        rotation, t = random_rotation(rng), rng.normal(size=3)
        q, v, a = rng.normal(size=2), rng.normal(size=8), rng.normal(size=8)
        peer = np.array([*t, *pin.Quaternion(rotation).coeffs(), math.cos(q[0]), math.sin(q[0]), q[1]])
        ours = check(model, peer, [*motor_of(rotation, t), *q], v, a)
    assert (ours.joints[0].kind, ours.joints[0].axis, ours.coordinates.nq, ours.coordinates.nv) == ("floating", (0.0, 0.0, 0.0), 10, 8)
    assert ours.gravity == (1.0, -2.0, -9.0) and ours.source == "pinocchio.Model row" and ours.name == "row"


def test_a_free_flyer_with_rotors_is_refused():
    model = row(root=pin.JointModelFreeFlyer())
    model.armature = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.1])
    with pytest.raises(UnsupportedJointError, match="^row: joint 'j0' floats and has an armature, which no rotor gives; set it to zero$"):
        load_pinocchio(model)


def test_joints_beside_a_free_flyer_are_refused():
    model = row(root=pin.JointModelFreeFlyer())
    model.addJoint(0, pin.JointModelRX(), PLACED, "beside")
    with pytest.raises(ModelError, match="^row: joint 'beside' does not hang on the floating base$"):
        load_pinocchio(model)


# ---- joints that mimic


HAND = """<robot name="hand"><link name="palm"/>{links}
<joint name="knuckle" type="{kind}"><parent link="palm"/><child link="l0"/><origin xyz="0 0 0.1" rpy="0.1 0 0.2"/><axis xyz="1 2 2"/>
{limit}</joint>
<joint name="tip" type="{follower}"><parent link="l0"/><child link="l1"/><origin xyz="0.05 0 0" rpy="0 0.3 0"/><axis xyz="2 -3 6"/>{limit}
<mimic joint="knuckle" multiplier="{ratio}" offset="{offset}"/></joint></robot>"""
INERTIAL = """<inertial><origin xyz="0.01 0.02 0.03"/><mass value="0.3"/>
<inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/></inertial>"""


def hand(kind="revolute", follower=None, ratio=-0.7, offset=0.2):
    limit = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'
    links = "".join(f'<link name="l{k}">{INERTIAL}</link>' for k in range(2))
    return HAND.format(links=links, kind=kind, follower=follower or kind, limit=limit, ratio=ratio, offset=offset)


@pytest.mark.parametrize("ratio", [-0.7, 1.0, 2.5])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
@pytest.mark.parametrize("follower", ["revolute", "prismatic"])
def test_mimicking_joints(kind, follower, ratio):
    """Pinocchio's model of one degree of freedom, and its model of two projected, which does not know of mimicking."""
    text = hand(kind, follower, ratio)
    model = pin.buildModelFromXML(text, mimic=True)
    ours = load_pinocchio(model)
    tip = ours.joints[1]
    assert (model.nv, ours.coordinates.nv) == (1, 1) and (tip.follows, tip.ratio, tip.kind) == ("knuckle", ratio, follower)
    assert np.allclose(tip.axis, OBLIQUE, rtol=0, atol=1e-15)  # the file's, whatever the sign of the ratio
    both, q, v, a = pin.buildModelFromXML(text), 0.4, 1.3, -0.8
    g = np.array([1.0, ratio])
    data, x = both.createData(), np.array([q, ratio * q + 0.2])
    pin.framesForwardKinematics(both, data, x)
    expected = g @ pin.rnea(both, data, x, g * v, g * a)
    moved = [(1.0, y) if how == "prismatic" else (math.cos(y), math.sin(y)) for how, y in ((kind, q), (follower, ratio * q))]
    c, s = zip(*moved, strict=True)
    tree = Tree.of(ours)
    assert dynamics.inverse_dynamics(tree, c, s, [v], [a]) == pytest.approx([expected], rel=1e-14)
    poses = np.array(tree_kinematics.frames(tree, c, s)).reshape(-1, 4, 4)
    for frame, pose in zip(ours.frames, poses, strict=True):
        assert np.abs(pose - data.oMf[both.getFrameId(frame.name)].homogeneous).max() < 1e-15


def test_mimicking_joints_that_are_refused():
    with pytest.raises(UnsupportedJointError, match="^hand: joint 'tip' is a JointModelMimic of ratio 0; revolute, continuous"):
        load_pinocchio(pin.buildModelFromXML(hand(ratio=0.0), mimic=True))


# ---- numbers


def test_limits_armature_and_bodies():
    model = row(pin.JointModelRX(), pin.JointModelPZ(), pin.JointModelRUBZ())
    model.armature = np.array([0.1, 0.2, 0.3])
    model.lowerPositionLimit, model.upperPositionLimit = np.array([-1.0, -0.2, -2, -2]), np.array([1.5, 0.3, 2, 2])
    model.velocityLimit, model.effortLimit = np.array([1.0, 2.0, 3.0]), np.array([4.0, 5.0, np.inf])
    ours = load_pinocchio(model)
    assert [j.armature for j in ours.joints] == [0.1, 0.2, 0.3]
    assert [(j.lower, j.upper) for j in ours.joints] == [(-1.0, 1.5), (-0.2, 0.3), (-math.inf, math.inf)]
    assert [(j.velocity, j.effort) for j in ours.joints] == [(1.0, 4.0), (2.0, 5.0), (3.0, math.inf)]
    for k, joint in enumerate(ours.joints, 1):
        body = model.inertias[k]
        assert joint.inertia.mass == body.mass and np.array_equal(joint.inertia.com, body.lever)
        assert np.allclose(joint.inertia.matrix(), body.inertia, rtol=0, atol=0)
    model.inertias[2] = pin.Inertia.Zero()
    assert load_pinocchio(model).joints[1].inertia is None


NUMBERS = [
    ("lowerPositionLimit", np.array([np.nan]), r"limits \[nan, 1.0, 1.0, 1.0\]"),
    ("lowerPositionLimit", np.array([2.0]), r"limits \[2.0, 1.0, 1.0, 1.0\]"),
    ("velocityLimit", np.array([-1.0]), r"limits \[-1.0, 1.0, -1.0, 1.0\]"),
    ("effortLimit", np.array([np.nan]), r"limits \[-1.0, 1.0, 1.0, nan\]"),
    ("armature", np.array([-0.1]), r"armature -0.1"),
    ("armature", np.array([np.nan]), r"armature nan"),
]


@pytest.mark.parametrize(("key", "value", "said"), NUMBERS)
def test_numbers_that_no_robot_has(key, value, said):
    model = row(pin.JointModelRX())
    model.lowerPositionLimit, model.upperPositionLimit = np.array([-1.0]), np.array([1.0])
    model.velocityLimit, model.effortLimit = np.array([1.0]), np.array([1.0])
    setattr(model, key, value)
    with pytest.raises(BadNumberError, match=rf"^row: joint 'j0' has .*{said}"):
        load_pinocchio(model)


def test_bodies_that_are_not_finite():
    for mass in (math.nan, math.inf):
        model = row(pin.JointModelRX())
        model.inertias[1].mass = mass
        with pytest.raises(BadNumberError, match=f"^row: the body of joint 'j0' has mass {mass} or an inertia that is not finite$"):
            load_pinocchio(model)


def test_gravity_that_is_not_finite():
    model = row(pin.JointModelRX())
    model.gravity.linear = np.array([0.0, np.nan, 0.0])
    with pytest.raises(ModelError, match=r"^gravity: \(0.0, nan, 0.0\) given, three finite numbers are needed$"):
        load_pinocchio(model)


# ---- frames


def test_frames_of_one_name():
    model = row(pin.JointModelRX())
    model.addBodyFrame("j0", 1, pin.SE3.Identity(), -1)  # where the joint is: one frame
    assert [f.name for f in load_pinocchio(model).frames] == ["universe", "j0", "link0"]
    model = row(pin.JointModelRX())
    model.addBodyFrame("j0", 1, PLACED, -1)
    found = load_pinocchio(model)
    assert [f.name for f in found.frames] == ["universe", "j0", "link0", "j0:link"]
    assert np.array_equal(found.frame("j0:link").placement.matrix(), PLACED.homogeneous)
    model.addFrame(pin.Frame("link0", 1, 0, PLACED * PLACED, pin.FrameType.OP_FRAME))
    assert load_pinocchio(model).frames[-1].name == "link0:joint"
    model.addFrame(pin.Frame("link0", 1, 0, PLACED * PLACED * PLACED, pin.FrameType.SENSOR))
    with pytest.raises(DuplicateNameError, match="^row: frame 'link0:joint' stands for two places; rename one"):
        load_pinocchio(model)


# ---- whole models


@pytest.mark.parametrize("name", ["g1", "leap_hand", "ur5"])
def test_bundled_files_by_way_of_a_model(name):
    model = pin.buildModelFromUrdf(str(bundled_robots()[name]))
    rng = np.random.default_rng(7)
    q, v, a = rng.normal(size=(3, model.nv))
    check(model, q, q, v, a)


def test_sample_models():
    rng = np.random.default_rng(8)
    arm = pin.buildSampleModelManipulator()
    q, v, a = rng.normal(size=(3, arm.nv))
    ours = check(arm, q, q, v, a)
    assert np.array_equal(Peer(ours).model.jointPlacements[3].homogeneous, arm.jointPlacements[3].homogeneous)
    human = pin.buildSampleModelHumanoid()
    rotation, t = random_rotation(rng), rng.normal(size=3)
    q, v, a = rng.normal(size=human.nq - 7), *rng.normal(size=(2, human.nv))
    check(human, np.array([*t, *pin.Quaternion(rotation).coeffs(), *q]), [*motor_of(rotation, t), *q], v, a)
