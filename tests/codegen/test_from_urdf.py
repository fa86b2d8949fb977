"""URDF files: the model agrees with Pinocchio's own reading, and the doors are shut to everything else (see test_urdf_refusals.py)."""

import math
import re

import numpy as np
import pinocchio
import pytest

from cga_codegen.robots.bundled import bundled_robots
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import Inertia, RobotModel

LIMIT = '<limit lower="-1" upper="1.5" velocity="3" effort="4"/>'
TWO_LINKS = '<link name="a"/><link name="b"/>'
MIXED = """<?xml version="1.0"?>
<!-- every kind of joint, oblique axes, links held by fixed joints, an inertial that is turned, meshes that do not exist -->
<robot name="mixed">
  <material name="grey"/>
  <link name="base"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="plate"/>
  <joint name="bolt" type="fixed"><parent link="base"/><child link="plate"/><origin xyz="0.1 -0.2 0.3" rpy="0.4 0.5 -0.6"/></joint>
  <link name="arm">
    <inertial><origin xyz="0.1 0.2 -0.3" rpy="0.7 -0.2 0.1"/><mass value="2.5"/>
      <inertia ixx="0.02" ixy="0.001" ixz="-0.002" iyy="0.03" iyz="0.003" izz="0.025"/></inertial>
    <visual><geometry><mesh filename="package://nowhere/arm.dae"/></geometry></visual>
    <collision><geometry><mesh filename="missing.stl" scale="0 0 nan"/></geometry></collision>
  </link>
  <joint name="spin" type="continuous"><parent link="plate"/><child link="arm"/><origin xyz="0 0 0.5" rpy="0 1.57079632679 0"/>
    <axis xyz="1 2 -2"/><limit velocity="7" effort="8"/><dynamics damping="1" friction="2"/></joint>
  <link name="rail"/>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="rail"/><origin rpy="0 0 1.5708"/><axis xyz="-3 0 0"/>
    <limit lower="-0.2" upper="0.6" velocity="0.5" effort="30"/><safety_controller k_velocity="1"/></joint>
  <link name="tool"><inertial><origin xyz="0 0 0.1"/><mass value="0.4"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.0015"/></inertial></link>
  <joint name="flange" type="fixed"><parent link="rail"/><child link="tool"/><origin xyz="0.2 0 0" rpy="-0.3 0 0.9"/></joint>
  <link name="camera"><inertial><origin xyz="0.01 0.02 0.03" rpy="0 0 1"/><mass value="0.1"/>
    <inertia ixx="1e-5" ixy="1e-6" ixz="0" iyy="2e-5" iyz="0" izz="1.5e-5"/></inertial></link>
  <joint name="clamp" type="fixed"><parent link="tool"/><child link="camera"/><origin xyz="0 0.3 0" rpy="1 0 0"/></joint>
  <link name="elbow"><inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
  <joint name="bend" type="revolute"><parent link="arm"/><child link="elbow"/><origin xyz="0 0.1 0"/>
    <limit velocity="1" effort="0"/></joint>
  <transmission name="t"/><gazebo reference="arm"><anything/></gazebo>
</robot>
"""


def urdf(body, name="r"):
    return f'<robot name="{name}">{body}</robot>'


def joint(name="j", parent="a", child="b", kind="revolute", inside='<axis xyz="0 0 1"/>' + LIMIT):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


def pose(model: RobotModel, name, q):
    """Rodrigues' formula along `RobotModel.chain`."""
    names = {j.name: k for k, j in enumerate(model.joints)}
    chain = model.chain(name)
    m = np.eye(4)
    for j in chain.joints:
        value, local = q[names[j.name]], np.eye(4)
        x, y, z = j.axis
        k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        if j.kind == "prismatic":
            local[:3, 3] = np.array(j.axis) * value
        else:
            local[:3, :3] += math.sin(value) * k + (1 - math.cos(value)) * k @ k
        m = m @ j.placement.matrix() @ local
    return m @ chain.tool.matrix()


@pytest.mark.parametrize("text", [MIXED, *(path.read_text() for path in bundled_robots().values())], ids=["mixed", *bundled_robots()])
def test_frames_agree_with_pinocchio(text):
    model, reference = load_urdf(text), pinocchio.buildModelFromXML(text)
    data = reference.createData()
    assert [j.name for j in model.joints] == list(reference.names)[1:]
    assert [j.parent for j in model.joints] == [p - 1 for p in list(reference.parents)[1:]]
    assert [f.name for f in model.frames] == [f.name for f in reference.frames]
    rng = np.random.default_rng(41)
    for _ in range(20):
        q = rng.uniform(-3, 3, len(model.joints))
        full = np.zeros(reference.nq)
        for j, value in zip(list(reference.joints)[1:], q, strict=True):
            full[j.idx_q : j.idx_q + j.nq] = value if j.nq == 1 else (math.cos(value), math.sin(value))
        pinocchio.framesForwardKinematics(reference, data, full)
        for k, frame in enumerate(model.frames):
            assert np.allclose(pose(model, frame.name, q), data.oMf[k].homogeneous, rtol=0, atol=1e-14)


@pytest.mark.parametrize("text", [MIXED, *(path.read_text() for path in bundled_robots().values())], ids=["mixed", *bundled_robots()])
def test_inertias_agree_with_pinocchio(text):
    """Pinocchio merges the links that fixed joints hold together, in another order of sums; the base's own mass goes nowhere."""
    model, reference = load_urdf(text), pinocchio.buildModelFromXML(text)
    for j, body in zip(model.joints, list(reference.inertias)[1:], strict=True):
        if body.mass == 0.0:
            assert j.inertia is None
            continue
        xx, xy, xz, yy, yz, zz = j.inertia.tensor
        assert math.isclose(j.inertia.mass, body.mass, rel_tol=1e-15)
        assert np.allclose(j.inertia.com, body.lever, rtol=1e-14, atol=1e-17)
        assert np.allclose([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], body.inertia, rtol=1e-13, atol=1e-17)


def test_kinds_axes_and_limits_of_the_mixed_robot():
    joints = {j.name: j for j in load_urdf(MIXED).joints}
    spin, slide, bend = joints["spin"], joints["slide"], joints["bend"]
    assert (spin.kind, slide.kind, bend.kind) == ("continuous", "prismatic", "revolute")
    assert np.allclose(spin.axis, np.array([1, 2, -2]) / 3, rtol=0, atol=1e-16) and slide.axis == (-1.0, 0.0, 0.0)
    assert bend.axis == (1.0, 0.0, 0.0)  # the format's default
    assert (spin.lower, spin.upper, spin.velocity, spin.effort) == (-math.inf, math.inf, 7.0, 8.0)
    assert (slide.lower, slide.upper, slide.velocity, slide.effort) == (-0.2, 0.6, 0.5, 30.0)
    assert (bend.lower, bend.upper, bend.velocity, bend.effort) == (0.0, 0.0, 1.0, 0.0)
    assert bend.inertia is None
    for kind in ("revolute", "prismatic"):
        reference = pinocchio.buildModelFromXML(urdf(TWO_LINKS + joint(kind=kind)))
        (j,) = load_urdf(urdf(TWO_LINKS + joint(kind=kind))).joints
        assert [j.lower, j.upper] == [reference.lowerPositionLimit[0], reference.upperPositionLimit[0]] == [-1.0, 1.5]
        assert [j.velocity, j.effort] == [reference.velocityLimit[0], reference.effortLimit[0]] == [3.0, 4.0]


@pytest.mark.parametrize(("angle", "snapped"), [("1.57079632679", True), ("1.5708", False)])
def test_a_right_angle_is_what_the_file_says_unless_it_is_snapped_as_a_whole(angle, snapped):
    text = urdf(TWO_LINKS + joint(inside=f'<origin rpy="0 {angle} 0"/>' + LIMIT))
    raw = pinocchio.buildModelFromXML(text).jointPlacements[1].rotation
    model = load_urdf(text)
    assert not np.array_equal(raw, np.round(raw))
    assert np.array_equal(model.joints[0].placement.rotation, raw)
    assert np.array_equal(model.snapped(1e-11).joints[0].placement.rotation, np.round(raw) if snapped else raw)


def test_a_continuous_joint_may_have_no_limit_at_all():
    (j,) = load_urdf(urdf(TWO_LINKS + joint(kind="continuous", inside=""))).joints
    assert (j.lower, j.upper, j.velocity, j.effort) == (-math.inf, math.inf, math.inf, math.inf)


def test_axes_are_unit_vectors_at_any_scale():
    for scale in ("1e-200", "1e200", "5e-324"):
        (j,) = load_urdf(urdf(TWO_LINKS + joint(inside=f'<axis xyz="{scale} 0 {scale}"/>' + LIMIT))).joints
        assert np.allclose(j.axis, np.sqrt([0.5, 0.0, 0.5]), rtol=0, atol=1e-15)


def test_a_joint_and_a_link_may_share_a_name():
    """A joint's own link coincides with it: one frame. A link of that name elsewhere is called NAME:link, a joint NAME:joint."""
    links = '<link name="a"/><link name="b"/><link name="c"/>'
    same = load_urdf(urdf(TWO_LINKS + joint(name="b")))
    assert [f.name for f in same.frames] == ["universe", "a", "b"]
    fixed = joint(name="k", parent="b", child="c", kind="fixed", inside='<origin xyz="0 0 1"/>')
    link_later = load_urdf(urdf(links + joint(name="c") + fixed))
    assert [f.name for f in link_later.frames] == ["universe", "a", "c", "b", "k", "c:link"]
    assert link_later.frame("c").placement.translation == (0.0, 0.0, 0.0)
    assert link_later.frame("c:link").placement.translation == (0.0, 0.0, 1.0)
    joint_later = load_urdf(urdf(links + joint(name="q") + joint(name="a", parent="b", child="c")))
    assert [f.name for f in joint_later.frames] == ["universe", "a", "q", "b", "a:joint", "c"]
    assert (joint_later.frame("a").joint, joint_later.frame("a:joint").joint) == (-1, 1)


def test_a_point_mass_is_an_inertia():
    """A mass without extent counts; two of them, 2 kg at 3 m and 1 kg at 0 m along x, have I = 2 * 1 / 3 * 3^2 = 6 across x."""

    def point(name, mass, x):
        tensor = '<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>'
        return f'<link name="{name}"><inertial><origin xyz="{x} 0 0"/><mass value="{mass}"/>{tensor}</inertial></link>'

    one = load_urdf(urdf('<link name="a"/>' + point("b", 2, 3) + joint()))
    assert one.joints[0].inertia == Inertia(2.0, (3.0, 0.0, 0.0), (0.0,) * 6)
    fixed = joint(name="k", parent="b", child="c", kind="fixed", inside="")
    two = load_urdf(urdf('<link name="a"/>' + point("b", 2, 3) + point("c", 1, 0) + joint() + fixed))
    assert two.joints[0].inertia == Inertia(3.0, (2.0, 0.0, 0.0), (0.0, 0.0, 0.0, 6.0, 0.0, 6.0))


def test_a_moment_of_inertia_may_be_negative_by_rounding_only():
    """-5.4e-20 stands in a widely used file; -1 is refused (test_urdf_refusals.py)."""
    body = '<link name="b"><inertial><mass value="1"/><inertia ixx="-5.4e-20" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
    assert load_urdf(urdf('<link name="a"/>' + body + joint())).joints[0].inertia.tensor[0] == -5.4e-20


def test_a_robot_without_joints_is_a_robot():
    model = load_urdf(urdf('<link name="a"/>'))
    assert model.joints == () and [f.name for f in model.frames] == ["universe", "a"]


def test_names_with_odd_characters_survive():
    odd = "q &amp; &lt;a&gt; &quot;b&quot; &#955;"
    model = load_urdf(urdf(TWO_LINKS + joint(name=odd), name=odd))
    assert model.name == model.joints[0].name == 'q & <a> "b" λ'


def test_a_mimicking_joint_may_be_taken_as_one_of_its_own():
    mimicking = joint(name="k", child="c", inside='<mimic joint="j"/>' + LIMIT)
    text = urdf(TWO_LINKS + '<link name="c"/>' + joint() + mimicking)
    assert [j.name for j in load_urdf(text, mimic="independent").joints] == ["j", "k"]


def test_the_name_is_the_callers_or_the_files():
    assert load_urdf(MIXED).name == "mixed" and load_urdf(MIXED, name="mine").name == "mine"
    assert load_urdf("<robot><link name='a'/></robot>").name == "robot"


def test_paths_and_texts_of_every_form(tmp_path):
    expected = load_urdf(MIXED)
    plain = re.sub(r"<\?xml.*?\?>\n", "", MIXED)
    files = {
        "utf8.urdf": MIXED.encode(),
        "bom.urdf": b"\xef\xbb\xbf" + MIXED.encode(),
        "utf16.urdf": plain.encode("utf-16"),
        "latin1.urdf": ('<?xml version="1.0" encoding="ISO-8859-1"?><!-- \xe9 -->' + plain).encode("latin-1"),
        "blanks.urdf": b"\n  " + plain.encode(),
    }
    for name, data in files.items():
        (tmp_path / name).write_bytes(data)
        for given in (tmp_path / name, str(tmp_path / name)):
            model = load_urdf(given)
            assert model.source == name  # no folder: what is generated must not depend on it
            assert (model.joints, model.frames) == (expected.joints, expected.frames)
    for text in ("\ufeff" + MIXED, "\n\t " + MIXED, plain):
        assert load_urdf(text) == expected


def test_a_comment_that_speaks_of_a_doctype_is_no_doctype():
    assert load_urdf("<!-- no <!DOCTYPE robot> here --><?note <!DOCTYPE?>" + urdf('<link name="a"/>')).name == "r"


def test_nothing_is_printed(capfd):
    load_urdf(MIXED)
    assert capfd.readouterr() == ("", "")
