"""Hostile and broken MJCF input: each is refused by a named child of ModelError with one sentence, silently, and MuJoCo opens no file."""

import os

import mujoco
import numpy as np
import pytest

from cga_codegen.robots.errors import (
    BadNumberError,
    BrokenFileError,
    DuplicateNameError,
    TreeError,
    UnsafeFileError,
    UnsupportedJointError,
)
from cga_codegen.robots.from_mjcf import load_mjcf, load_mjmodel
from cga_codegen.robots.model import ModelError

BALL = '<geom size="0.1"/>'
JOINT = '<joint name="j"/>' + BALL
MESH = '<geom type="mesh" mesh="shell"/>'
INERTIAL = '<inertial pos="0 0 0" mass="{}" diaginertia="{}"/>'
SHELL = '<asset><mesh name="shell" file="/etc/hostname"/></asset>'


def mjcf(inside, rest=""):
    """A file with what the world holds, and the rest."""
    return f'<mujoco model="m"><worldbody>{inside}</worldbody>{rest}</mujoco>'


def body(inside, name="b"):
    return f'<body name="{name}">{inside}</body>'


def hinge(attributes="", more=BALL):
    return mjcf(body(f'<joint name="j" {attributes}/>{more}'))


def two(equality, tail=""):
    """Two hinges and a third, with a constraint."""
    joints = "".join(body(f'<joint name="{name}"/>{BALL}', f"b{name}") for name in "jkl")
    return mjcf(joints, f"<equality>{equality}</equality>{tail}")


TENDONS = '<tendon><fixed name="t" armature="{}"><joint joint="j" coef="1"/></fixed></tendon>'
LAUGHS = "".join(body(BALL + 9 * f'<attach body="n{k}" prefix="p"/>', f"n{k + 1}") for k in range(9))
REFUSED = {
    "an entity": (
        '<!DOCTYPE a [<!ENTITY x "y">]><mujoco model="&x;"/>',
        UnsafeFileError,
        "a document type declaration (DOCTYPE, entities) is given",
    ),
    "a URDF": ("<robot/>", BrokenFileError, "MJCF text: the root element is <robot>; read it as a URDF"),
    "another format": ("<html/>", BrokenFileError, "MJCF text: the root element is <html>; an MJCF has <mujoco>"),
    "cut off": ("<mujoco><worldbody", BrokenFileError, "not well-formed XML (unclosed token"),
    "deep": (
        mjcf("<frame>" * 249 + "</frame>" * 249),
        UnsafeFileError,
        "more than 250 elements lie within each other; at most 250 are read",
    ),
    "very deep": (mjcf("<frame>" * 99_999 + "</frame>" * 99_999), UnsafeFileError, "more than 250 elements lie within each other"),
    "many elements": (mjcf(20_000 * BALL), UnsafeFileError, "more than 20000 elements are given; at most 20000 are read"),
    "many copies": (
        mjcf(f'<replicate count="1000000000">{BALL}</replicate>'),
        BadNumberError,
        "replicate count is '1000000000'; a whole number",
    ),
    "no number of copies": (
        mjcf(f'<replicate count="nan">{BALL}</replicate>'),
        BadNumberError,
        "replicate count is 'nan'; a whole number from 1",
    ),
    "copies of copies": (
        mjcf(4 * '<replicate count="100">' + BALL + 4 * "</replicate>"),
        UnsafeFileError,
        "more than 20000 elements with all copies made; at most 20000 are read",
    ),
    "attached nine times nine times": (mjcf(body(BALL, "n0") + LAUGHS), UnsafeFileError, "more than 20000 elements with all copies made"),
    "attached to itself": (mjcf(body('<attach body="b" prefix="p"/>')), TreeError, "'b' is attached inside itself; a robot has an end"),
    "attached before it is there": (mjcf(body('<attach body="c" prefix="p"/>')), BrokenFileError, "'c' is to be attached; a body or frame"),
    "copies that actuators mention": (
        mjcf(f'<replicate count="900">{body(JOINT)}</replicate>', "<actuator>" + 30 * '<motor joint="j"/>' + "</actuator>"),
        UnsafeFileError,
        "more than 20000 elements with all copies made",
    ),
    "many bodies": (
        mjcf(f'<replicate count="1001"><body>{BALL}</body></replicate>'),
        UnsafeFileError,
        "1002 bodies given, at most 1000 are read",
    ),
    "include without folder": (
        mjcf('<include file="a.xml"/>'),
        UnsafeFileError,
        "<include> names file 'a.xml', but a text has no folder; say which with folder=...",
    ),
    "include of nothing": (mjcf("<include/>"), BrokenFileError, "<include> names no file; give file=..."),
    "soft body": (
        mjcf('<flexcomp name="f"/>'),
        UnsupportedJointError,
        "<flexcomp> makes a soft body, which cannot be represented; rigid bodies",
    ),
    "soft constraint": (two('<flex flex="f"/>'), UnsupportedJointError, "an equality <flex> of soft bodies is given; joint is read"),
    "unknown element": (
        mjcf("<bodie/>"),
        BrokenFileError,
        "MuJoCo refuses it (XML Error: Schema violation: unrecognized element Element 'bodie')",
    ),
    "unknown attribute": (
        hinge('axiss="1 0 0"'),
        BrokenFileError,
        "unrecognized attribute: 'axiss' Element 'joint'); an MJCF that it can compile",
    ),
    "unknown kind": (hinge('type="cam"'), BrokenFileError, "invalid keyword: 'cam'"),
    "unknown class": (hinge('class="leg"'), BrokenFileError, "unknown default class"),
    "text for a number": (hinge('pos="0 zero 0"'), BadNumberError, "bad format in attribute 'pos'"),
    "too few numbers": (hinge('pos="0 0"'), BadNumberError, "attribute 'pos' does not have enough data"),
    "huge": (hinge('pos="1e999 0 0"'), BadNumberError, "number is too large in attribute 'pos'"),
    "large": (
        hinge('pos="0 1e60 0"'),
        BadNumberError,
        "MJCF text: jnt 'j': pos is [0.0, 1e+60, 0.0]; finite numbers below 1e+50 are needed",
    ),
    "nan": (hinge('axis="nan 0 1"'), BadNumberError, "MJCF text: a number is given as nan; finite numbers are needed"),
    "inf": (hinge('axis="inf 0 1"'), BadNumberError, "jnt 'j': axis is [nan, 0.0, 0.0]; finite numbers below 1e+50"),
    "long axis": (hinge('axis="1e200 0 1"'), BadNumberError, "jnt 'j': axis is [0.0, 0.0, 0.0]; a direction or a rotation has length 1"),
    "zero axis": (hinge('axis="0 0 0"'), BrokenFileError, "axis too small in joint"),
    "limits": (hinge('range="2 1"'), BadNumberError, "joint 'j': its range is 2 to 1; lower <= upper is needed"),
    "no mass": (hinge(more=""), BrokenFileError, "mass and inertia of moving bodies must be larger than mjMINVAL"),
    "impossible": (hinge(more=INERTIAL.format(1, "1 1 3")), BrokenFileError, "inertia must satisfy A + B >= C"),
    "one name": (mjcf(body(BALL) + body(BALL)), DuplicateNameError, "repeated name 'b' in body"),
    "one frame name": (
        mjcf(body(f'<joint name="b" pos="1 0 0"/>{BALL}<site name="b:body"/>') + '<site name="b:body" pos="1 1 1"/>'),
        DuplicateNameError,
        "repeated name 'b:body' in site",
    ),
    "two frames": (
        mjcf('<site name="b:body" pos="1 1 1"/>' + body(f'<joint name="b" pos="1 0 0"/>{BALL}')),
        DuplicateNameError,
        "frame 'b:body' stands for two places; rename one of the bodies, joints and sites",
    ),
    "ball": (hinge('type="ball"'), UnsupportedJointError, "joint 'j' is a ball; hinges, slides and one free joint at the root are read"),
    "two free bodies": (
        mjcf(body(f'<freejoint name="f"/>{BALL}') + body(f'<freejoint name="g"/>{BALL}', "c")),
        UnsupportedJointError,
        "joint 'f' is free and does not carry joint 'g'; one free joint is read, as the base of the whole robot",
    ),
    "free beside": (
        mjcf(body(f'<joint name="j"/>{BALL}') + body(f'<freejoint name="f"/>{BALL}', "c")),
        UnsupportedJointError,
        "joint 'f' is free and does not carry joint 'j'",
    ),
    "free within": (mjcf(body(BALL + body(f"<freejoint/>{BALL}", "c"))), BrokenFileError, "free joint can only be used on top level"),
    "mesh": (
        mjcf(body(f"<joint/>{MESH}"), SHELL),
        BrokenFileError,
        "the inertia of body 'b' would come from mesh 'shell', which is not read; give the body an <inertial>",
    ),
    "mesh, although": (
        mjcf(body(f"<joint/>{INERTIAL.format(1, '1 1 1')}{MESH}"), SHELL + '<compiler inertiafromgeom="true"/>'),
        BrokenFileError,
        "the inertia of body 'b' would come from mesh 'shell', which is not read",
    ),
    "fitted mesh": (mjcf(body('<joint/><geom type="box" mesh="shell"/>'), SHELL), BrokenFileError, "would come from mesh 'shell'"),
    "loop": (
        two('<connect name="c" body1="bj" body2="bk" anchor="0 0 0"/>'),
        TreeError,
        "equality 'c' is of kind connect, which closes a loop",
    ),
    "weld": (
        two('<weld body1="bj" body2="bk"/>'),
        TreeError,
        "equality 0 is of kind weld, which closes a loop; linear joint constraints are read",
    ),
    "tendon": (two('<tendon tendon1="t"/>', TENDONS.format(0)), TreeError, "equality 0 is of kind tendon, which closes a loop"),
    "curved": (
        two('<joint joint1="j" joint2="k" polycoef="0 1 0.5 0 0"/>'),
        UnsupportedJointError,
        "equality 0 is not linear; one linear joint",
    ),
    "second": (
        two('<joint joint1="j" joint2="k"/><joint name="e" joint1="j" joint2="l"/>'),
        UnsupportedJointError,
        "equality 'e' is the second of joint 'j'; one linear joint constraint a joint is read, with ignore_constraints=True it is left out",
    ),
    "ring": (
        two('<joint joint1="j" joint2="k"/><joint joint1="k" joint2="j"/>'),
        UnsupportedJointError,
        "joint 'j' follows itself in the end; one joint must move by itself",
    ),
    "free armature": (
        mjcf(body(f'<joint name="f" type="free" armature="1"/>{BALL}')),
        UnsupportedJointError,
        "joint 'f' is free and has an armature; give it armature=0, or write <freejoint/>; with ignore_constraints=True it is left out",
    ),
    "tendon armature": (two("", TENDONS.format(2)), UnsupportedJointError, "a tendon has an armature, which couples joints"),
}
IGNORED = ("loop", "weld", "tendon", "curved", "second", "free armature", "tendon armature")


@pytest.mark.parametrize("case", REFUSED)
def test_refused_by_name_in_one_sentence_and_silently(case, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    text, error, message = REFUSED[case]
    with pytest.raises(error) as caught:
        load_mjcf(text)
    assert type(caught.value) is error and message in str(caught.value)
    assert "\n" not in str(caught.value) and ", line" not in str(caught.value).partition("refuses it")[2]
    assert os.listdir(tmp_path) == [] and capfd.readouterr() == ("", "")


@pytest.mark.parametrize("case", IGNORED)
def test_what_a_tree_cannot_hold_is_left_out_when_asked(case):
    robot = load_mjcf(REFUSED[case][0], ignore_constraints=True)
    follows = {"second": ["k", "", ""]}.get(case, [""] * len(robot.joints))
    assert [joint.follows for joint in robot.joints] == follows
    if case == "tendon armature":
        assert [joint.armature for joint in robot.joints] == [0.0, 0.0, 0.0]


def test_meshes_that_give_no_inertia_are_not_needed():
    massless = ('mass="0"', 'density="0"', 'class="looks"')
    without = "".join(f'<frame pos="1 0 0"><geom type="mesh" mesh="shell" {why}/></frame>' for why in massless)
    classes = '<default><default class="looks"><geom type="mesh" mesh="shell" group="3"/></default></default>'
    shapes = f'{BALL}{without}<site name="s" type="box" size="1 1 1"/>'
    for inside in (f"<joint/>{shapes}", f"<joint/>{INERTIAL.format(2, '1 1 1')}{MESH}{shapes}", MESH):
        robot = load_mjcf(mjcf(body(inside), SHELL + classes + '<compiler inertiagrouprange="0 2"/>'))
        masses = [joint.inertia.mass for joint in robot.joints]
        assert masses == ([] if inside == MESH else [2.0] if "inertial" in inside else [pytest.approx(4.0 / 3.0 * np.pi, rel=1e-14)])


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("body_mass", -1.0, "body 'b': mass is [-1.0]; zero or a positive number is needed"),
        ("body_quat", 0.5, "body 'b': quat is [0.5, 0.5, 0.5, 0.4]; a direction or a rotation has length 1"),
        ("jnt_axis", np.nan, "jnt 'j': axis is [nan, nan, nan]; finite numbers below 1e+50 are needed"),
        ("qpos0", np.inf, "jnt 'j': ref is inf; a finite number below 1e+50 is needed"),
        ("jnt_actfrcrange", np.nan, "joint 'j': a force limit of its actuators is nan; numbers are needed"),
    ],
)
def test_numbers_of_a_compiled_model_are_checked_too(field, value, message):
    model = mujoco.MjModel.from_xml_string(hinge('actuatorfrcrange="-1 1"'))
    getattr(model, field)[-1] = value
    if field == "body_quat":
        model.body_quat[-1, 3] = 0.4
    with pytest.raises(BadNumberError) as caught:
        load_mjmodel(model)
    assert str(caught.value) == f"mujoco.MjModel m: {message}"


def test_something_else_than_a_model_is_refused():
    with pytest.raises(ModelError, match=r"^a str was given; a mujoco.MjModel is needed$"):
        load_mjmodel("robot.xml")
