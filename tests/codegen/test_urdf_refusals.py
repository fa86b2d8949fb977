"""Hostile and broken URDF input: each is refused by a named child of ModelError with one sentence, silently, before Pinocchio sees it."""

import os
import subprocess
import sys

import pytest

from cga_codegen.robots.errors import (
    BadNumberError,
    BrokenFileError,
    DuplicateNameError,
    TreeError,
    UnsafeFileError,
    UnsupportedJointError,
)
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import ModelError

LIMIT = '<limit lower="-1" upper="1.5" velocity="3" effort="4"/>'
AB = '<link name="a"/><link name="b"/>'
ABC = AB + '<link name="c"/>'
TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


def urdf(body):
    return f'<robot name="r">{body}</robot>'


def joint(name="j", parent="a", child="b", kind="revolute", inside=LIMIT):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


def limit(text):
    return urdf(AB + joint(inside=f"<limit {text}/>"))


def origin(text):
    return urdf(AB + joint(inside=f"<origin {text}/>" + LIMIT))


def axis(text):
    return urdf(AB + joint(inside=f'<axis xyz="{text}"/>' + LIMIT))


def mass(text, tensor=TENSOR):
    return urdf(f'<link name="a"/><link name="b"><inertial><mass value="{text}"/>{tensor}</inertial></link>' + joint())


LAUGHS = (
    '<?xml version="1.0"?>\n<!-- ha -->\n<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {new} "{10 * f"&{old};"}">' for old, new in zip("abcdefgh", "bcdefghi", strict=True))
    + ']>\n<robot name="&i;"/>'
)
EXTERNAL = '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/hostname">]><robot name="&x;"><link name="a"/></robot>'

REFUSED = {
    "billion laughs": (
        LAUGHS,
        UnsafeFileError,
        "a document type declaration (DOCTYPE, entities) is given; remove it, a URDF needs none",
    ),
    "external entity": (EXTERNAL, UnsafeFileError, "a document type declaration (DOCTYPE, entities) is given"),
    "unknown entity": (urdf("&x;"), BrokenFileError, "not well-formed XML (undefined entity"),
    "broken XML": ("<robot><link></robot>", BrokenFileError, "not well-formed XML (mismatched tag: line 1, column 15); a URDF"),
    "cut off": ("<robot name='r'><link ", BrokenFileError, "not well-formed XML (unclosed token: line 1, column 16); a URDF"),
    "lone surrogate": ("<robot name='\ud800'/>", BrokenFileError, "not well-formed XML ("),
    "another format": ("<mujoco/>", BrokenFileError, "the root element is <mujoco>; a URDF has <robot>"),
    "xacro": (
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="x" value="1"/></robot>',
        BrokenFileError,
        "contains xacro macros; expand it first with `xacro FILE > robot.urdf`",
    ),
    "no links": (urdf(""), BrokenFileError, "no <link> is given; a robot has at least one"),
    "no name": (urdf("<link/>"), BrokenFileError, "a <link> has no name; every joint and link needs one"),
    "no joint name": (urdf(AB + joint(name="")), BrokenFileError, "a <joint> has no name; every joint and link needs one"),
    "same joints": (
        urdf(ABC + joint() + joint(child="c")),
        DuplicateNameError,
        "two joints are called 'j'; names must be unique",
    ),
    "same links": (urdf(AB + '<link name="b"/>' + joint()), DuplicateNameError, "two links are called 'b'; names must be unique"),
    "joint universe": (
        urdf(AB + joint(name="universe")),
        DuplicateNameError,
        "a joint is called 'universe', which is the fixed world; another name is needed",
    ),
    "link universe": (
        urdf('<link name="a"/><link name="universe"/>' + joint(child="universe")),
        DuplicateNameError,
        "link 'universe' is not the root, but the fixed world is so called; rename it",
    ),
    "frame thrice": (
        urdf(
            ABC
            + '<link name="c:link"/>'
            + joint(name="c")
            + joint("k", "b", "c:link", "fixed", "")
            + joint("m", "c:link", "c", "fixed", '<origin xyz="0 0 1"/>')
        ),
        DuplicateNameError,
        "frame 'c:link' stands for two places; rename one of the joints and links that share a name",
    ),
    "unknown parent": (
        urdf(AB + joint(parent="z")),
        TreeError,
        "joint 'j': its parent link 'z' does not exist; add a <link> of that name",
    ),
    "unknown child": (urdf(AB + joint(child="z")), TreeError, "joint 'j': its child link 'z' does not exist; add a <link>"),
    "two roots": (
        urdf(ABC + joint()),
        TreeError,
        "2 links have no parent joint ('a', 'c'); exactly one root is needed",
    ),
    "six roots": (
        urdf("".join(f'<link name="{k}"/>' for k in "abcdef")),
        TreeError,
        "6 links have no parent joint ('a', 'b', 'c', 'd', ...); e",
    ),
    "two parents": (
        urdf(ABC + joint(child="c") + joint("k", "b", "c")),
        TreeError,
        "link 'c' is the child of joints 'j' and 'k'; a tree has no loops",
    ),
    "a ring": (
        urdf(AB + joint() + joint("k", "b", "a")),
        TreeError,
        "link 'a' hangs in a loop of joints; every link must be reached from one root",
    ),
    "a ring beside the tree": (
        urdf(ABC + joint("k", "b", "c") + joint("m", "c", "b")),
        TreeError,
        "link 'b' hangs in a loop of joints; every link must be reached from one root",
    ),
    "its own parent": (urdf(AB + joint(parent="b")), TreeError, "link 'b' hangs in a loop of joints"),
    "no parent": (
        urdf(AB + '<joint name="j" type="fixed"><child link="b"/></joint>'),
        BrokenFileError,
        "joint 'j' has no parent link; each joint names a parent and a child",
    ),
    "two origins": (
        urdf(AB + joint(inside="<origin/><origin/>" + LIMIT)),
        BrokenFileError,
        "joint 'j': 2 <origin> elements given, at most one is read",
    ),
    "a quaternion": (origin('quat_xyzw="0 0 0 1"'), BrokenFileError, "joint 'j': <origin> has 'quat_xyzw'; xyz and rpy are read"),
    "floating": (
        urdf(ABC + joint() + joint("k", "b", "c", kind="floating")),
        UnsupportedJointError,
        "joint 'k' floats, but does not carry the whole robot; only a floating base can be represented",
    ),
    "planar": (urdf(AB + joint(kind="planar")), UnsupportedJointError, "joint 'j' is of type 'planar'; revolute"),
    "no type": (urdf(AB + joint(kind="")), UnsupportedJointError, "joint 'j' is of type ''; revolute"),
    "mimics nobody": (
        urdf(ABC + joint() + joint("k", "b", "c", inside='<mimic joint="z"/>' + LIMIT)),
        UnsupportedJointError,
        "joint 'k' mimics 'z', which is no moving joint; name one that moves, or ask for mimic='independent'",
    ),
    "mimics itself": (
        urdf(ABC + joint(inside='<mimic joint="k"/>' + LIMIT) + joint("k", "b", "c", inside='<mimic joint="j"/>' + LIMIT)),
        UnsupportedJointError,
        "joint 'j' mimics itself in the end; one joint must move by itself",
    ),
    "mimics without a name": (
        urdf(ABC + joint() + joint("k", "b", "c", inside="<mimic/>" + LIMIT)),
        BrokenFileError,
        "joint 'k': its <mimic> names no joint; the name of a moving joint is needed",
    ),
    "mimics by a word": (
        urdf(ABC + joint() + joint("k", "b", "c", inside='<mimic joint="j" multiplier="minus one"/>' + LIMIT)),
        BadNumberError,
        "joint 'k': mimic: multiplier is 'minus one'; one number is needed",
    ),
    "nan in an origin": (origin('xyz="0 nan 0"'), BadNumberError, "joint 'j': origin xyz is '0 nan 0'; a finite number is needed"),
    "overflow": (origin('rpy="0 0 1e999"'), BadNumberError, "joint 'j': origin rpy is '0 0 1e999'; a finite number is needed"),
    "two numbers": (origin('xyz="0 1"'), BadNumberError, "joint 'j': origin xyz is '0 1'; 3 numbers are needed"),
    "commas": (origin('xyz="0,1,2"'), BadNumberError, "joint 'j': origin xyz is '0,1,2'; 3 numbers are needed"),
    "underscore": (origin('xyz="0 1_0 2"'), BadNumberError, "joint 'j': origin xyz is '0 1_0 2'; 3 numbers are needed"),
    "zero axis": (axis("0 0.0 -0"), BadNumberError, "joint 'j': axis is 0 0 0; a direction other than zero is needed"),
    "infinite axis": (axis("inf 0 0"), BadNumberError, "joint 'j': axis is 'inf 0 0'; a finite number is needed"),
    "empty axis": (axis(""), BadNumberError, "joint 'j': axis is ''; 3 numbers are needed"),
    "negative mass": (mass("-0.1"), BadNumberError, "link 'b': mass is -0.1; zero or a positive number is needed"),
    "mass nan": (mass("nan"), BadNumberError, "link 'b': mass: value is 'nan'; a finite number is needed"),
    "mass of a universe": (mass("1e50"), BadNumberError, "link 'b': mass: value is '1e50'; less than 1e+50 is needed"),
    "far away": (origin('xyz="0 0 -1e308"'), BadNumberError, "joint 'j': origin xyz is '0 0 -1e308'; less than 1e+50 is needed"),
    "mass word": (mass("heavy"), BadNumberError, "link 'b': mass: value is 'heavy'; one number is needed"),
    "negative inertia": (
        mass("1", TENSOR.replace('izz="1"', 'izz="-1"')),
        BadNumberError,
        "link 'b': izz is -1; zero or a positive number is needed",
    ),
    "no inertia": (mass("1", ""), BrokenFileError, "link 'b': inertia: 'ixx' is missing; it has no default"),
    "no limit": (
        urdf(AB + joint(inside="")),
        BrokenFileError,
        "joint 'j' is revolute and has no <limit>; lower, upper, velocity and effort are needed",
    ),
    "no effort": (limit('velocity="1"'), BrokenFileError, "joint 'j': limit: 'effort' is missing; it has no default"),
    "limits crossed": (
        limit('lower="2" upper="1" velocity="1" effort="1"'),
        BadNumberError,
        "joint 'j': lower limit 2 is above upper limit 1; lower <= upper is needed",
    ),
    "negative effort": (
        limit('velocity="1" effort="-1"'),
        BadNumberError,
        "joint 'j': velocity and effort limits are 1 and -1; none may be negative",
    ),
    "a thousand and one links": (
        urdf("".join(f'<link name="{k}"/>' for k in range(1001)) + "".join(joint(f"j{k}", k, k + 1, "fixed", "") for k in range(1000))),
        UnsafeFileError,
        "1001 links given, at most 1000 are read",
    ),
    "a text of 20 MB": ("<" + "x" * 20_000_000, UnsafeFileError, "20000001 characters given, at most 20000000 are read"),
}


@pytest.mark.parametrize(("text", "error", "message"), REFUSED.values(), ids=REFUSED.keys())
def test_what_is_wrong_is_named(text, error, message, capfd):
    with pytest.raises(error) as caught:
        load_urdf(text)
    assert type(caught.value) is error and isinstance(caught.value, ModelError)
    said = str(caught.value)
    assert said.startswith("URDF text: " + message) and "\n" not in said and len(said) < 300
    assert capfd.readouterr() == ("", "")


def test_deep_nesting_does_not_end_the_process():
    """In a process of its own: a stack overflow would take the test run along."""
    code = """
from cga_codegen.robots.from_urdf import load_urdf
load_urdf('<robot name="r">' + '<x>' * 500000 + '</x>' * 500000 + '<link name="a"/></robot>')
links = ''.join(f'<link name="{k}"/>' for k in range(1000))
joints = ''.join(f'<joint name="j{k}" type="fixed"><parent link="{k}"/><child link="{k + 1}"/></joint>' for k in range(999))
print(len(load_urdf(f'<robot>{links}{joints}</robot>').frames))
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, env=environment)
    assert (done.returncode, done.stdout, done.stderr) == (0, "2000\n", "")


def test_without_pinocchio_the_next_command_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(ModelError) as caught:
        load_urdf(urdf(AB + joint()))
    assert str(caught.value) == "reading a URDF needs Pinocchio, which is not installed; type `pip install 'cga-robotics[urdf]'`"
