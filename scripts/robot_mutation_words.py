"""What scripts/robot_mutations.py starts from and puts in: sound robot files, and numbers, names and elements that trouble readers."""

from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FILES = {
    "urdf": (*sorted((ROOT / "codegen/cga_codegen/robots/bundled").glob("*.urdf")), ROOT / "tests/data/skew.urdf"),
    "mjcf": tuple(sorted((ROOT / "tests/data/mjcf").rglob("*.xml"))),
}
LIMIT = '<limit lower="-1" upper="1.5" velocity="3" effort="4"/>'
BODY = '<inertial><mass value="2"/><inertia ixx="1" ixy="0.1" ixz="0" iyy="2" iyz="0" izz="1.5"/></inertial>'


def body(name: str) -> str:
    return f'<link name="{name}">{BODY}</link>'


def hinge(name: str, kind: str, parent: str, child: str, inside: str = LIMIT) -> str:
    ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="0.1 0 0.3" rpy="0 0.2 0"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


SMALL = {
    "urdf": (
        '<robot name="mimics">' + "".join(map(body, "abcde")) + hinge("j", "revolute", "a", "b", '<axis xyz="0 0 1"/>' + LIMIT)
        + hinge("k", "revolute", "b", "c", '<axis xyz="0 1 -1"/><mimic joint="j" multiplier="-0.5" offset="0.1"/>' + LIMIT)
        + hinge("l", "continuous", "c", "d", '<axis xyz="1 2 -2"/><mimic joint="k"/>') + hinge("m", "fixed", "d", "e", "") + "</robot>",
        '<robot name="boat">' + "".join(map(body, "abc")) + hinge("sea", "floating", "a", "b", "")
        + hinge("mast", "continuous", "b", "c", '<axis xyz="0 1 0"/>') + "</robot>",
        '<robot name="slides">' + "".join(map(body, "abc")) + hinge("j", "prismatic", "a", "b", '<axis xyz="-1 0 0"/>' + LIMIT)
        + hinge("k", "prismatic", "a", "c", '<mimic joint="j" multiplier="3"/>' + LIMIT) + "</robot>",
        '<robot name="stone"><link name="a"/></robot>',
    ),
    "mjcf": (
        '<mujoco model="arm"><compiler angle="radian"/><default><joint damping="1"/></default><worldbody><body name="a"><freejoint/>'
        '<geom size="0.1"/><body name="b" pos="0 0 1" euler="0.1 0.2 0.3"><joint name="j" axis="0 1 0" range="-1 1"/>'
        '<inertial mass="2" pos="0 0 0.1" diaginertia="1 2 1.5"/><site name="s"/></body></body></worldbody></mujoco>',
        '<mujoco><worldbody><body><joint name="j" type="slide" range="0 1"/><geom type="box" size="1 2 3"/><body><joint name="k"/>'
        '<geom type="capsule" fromto="0 0 0 0 0 1" size="0.1"/></body></body></worldbody><equality><joint joint1="j" joint2="k" '
        'polycoef="0 2 0 0 0"/></equality><actuator><motor joint="j" ctrlrange="-1 1" gear="3"/></actuator></mujoco>',
    ),
}  # fmt: skip
NUMBERS = (
    *("nan", "-NaN", "inf", "-inf", "1e308", "-1e308", "1e49", "-1e49", "9.9e24", "1e-320", "5e-324", "-0", "0", "1e999", "1e-9", "1.5708"),
    *(
        "9" * 400,
        "0." + "0" * 400 + "1",
        "\u0661\u0662",
        "\uff11",
        "\u00bd",
        "\u22121",
        "1,5",
        "1_000",
        "0x1p3",
        "one",
        "",
        "  ",
        "1e",
        "--1",
    ),
    *(
        "+1",
        "-1",
        "-1e-13",
        "1e+05",
        "1d3",
        "True",
        "${pi/2}",
        "1 0",
        "1\u00a02",
        "1\t2",
        "1;2",
        "1e3e3",
        "3.141592653589793",
        "1e5",
        "1000000",
    ),
)
NAMES = (
    *(
        "",
        " ",
        *("universe", "root_joint", "world", "base_link", "universe", "root_joint"),
        "a",
        "b",
        "j",
        "k",
        "c:link",
        "../../etc/passwd",
        "a\nb",
        "a\tb",
        "\u00e9",
        "\U0001d4b3",
        "\x7f",
    ),
    *("<&>\"'", "x" * 300, "y" * 100_000, "name with spaces", "%s%n", "{}", "None", "\u202eabc", "joint", "0", "\ufffd"),
)
KINDS = (
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "floating",
    "planar",
    "spherical",
    "",
    "Revolute",
    "hinge",
    "slide",
    "ball",
    "free",
    "x" * 1000,
)
SPLICES = (
    *(
        '<mimic joint="j" multiplier="1e49"/>',
        '<mimic joint="j" multiplier="0"/>',
        '<mimic joint="k" offset="9e49"/>',
        "<mimic/>",
        '<mimic joint="l"/>',
    ),
    *('<axis xyz="0 0 0"/>', '<axis xyz="1e-320 0 0"/>', '<axis xyz="1e308 -1e308 1e308"/>', '<axis xyz="1 1e-200 0"/>', "<axis/>"),
    *('<limit lower="2" upper="1" velocity="1" effort="1"/>', '<limit velocity="-1" effort="1"/>', "<limit/>", LIMIT),
    *('<inertial><mass value="-1"/></inertial>', BODY, BODY.replace('"2"', '"9"'), BODY.replace('ixx="1"', 'ixx="-1"'), "<inertial/>"),
    *(BODY.replace('value="2"', 'value="1e-320"'), BODY.replace('value="2"', 'value="0"'), BODY.replace('ixy="0.1"', 'ixy="1e49"')),
    *('<origin quat_xyzw="0 0 0 1"/>', '<origin xyz="1e49 1e49 1e49" rpy="1e49 -1e49 3"/>', '<origin rpy="0 1.5707963267948966 0"/>'),
    *('<link name="a"/>', body("new"), hinge("new", "fixed", "a", "new", ""), hinge("new", "floating", "a", "b", ""), "<robot/>"),
    *(
        '<visual><geometry><mesh filename="package://no/mesh.dae"/></geometry></visual>',
        '<collision><geometry><box size="nan"/></geometry></collision>',
    ),
    *(
        '<safety_controller k_velocity="x"/>',
        "<transmission/>",
        "<gazebo><plugin/></gazebo>",
        '<material name="m"><color rgba="1"/></material>',
    ),
    *(
        '<xacro:macro xmlns:xacro="http://www.ros.org/wiki/xacro" name="m"/>',
        '<q:link xmlns:q="urn:z" name="z"/>',
        "<include file='/etc/passwd'/>",
    ),
    *(
        '<joint type="ball"/>',
        "<freejoint/>",
        '<geom size="1"/>',
        '<replicate count="9"><geom size="1"/></replicate>',
        '<composite type="rope"/>',
    ),
)
PROLOGUES = (
    '<!DOCTYPE robot [<!ENTITY a "aaa"><!ENTITY b "&a;&a;">]>',
    '<!DOCTYPE robot SYSTEM "file:///dev/zero">',
    "<?xml version='1.0'?>",
    "<?xml version='1.1'?>",
    "<?xml version='1.0' encoding='utf-16'?>",
    "<?xml version='1.0' encoding='utf-7'?>",
    "\ufeff",
    "\n \t",
    "<!-- -- -->",
    "<?xml version='1.0' encoding='iso-8859-1'?>",
    "<?xml version='1.0' encoding='koi8-r'?>",
    "<?xml version='1.0' encoding=''?>",
    "<?a b?>",
    "\0",
    "<?xml-stylesheet href='x'?>",
    "<!-- " + "c" * 100_000 + " -->",
    "xyz",
    "<robot/>",
)
INSERTS = (
    "<![CDATA[<link name='z'/>]]>",
    "<!-- x -->",
    "&x;",
    "&#0;",
    "&#xD800;",
    "&#65;",
    "&amp;",
    "<",
    ">",
    '"',
    "]]>",
    "\0",
    "\ud800",
    "<?x?>",
    " x='1' x='2'",
)
ENCODINGS = ("utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1", "cp037", "utf-7")


@cache
def seeds(form: str) -> tuple[str, ...]:
    return (*SMALL[form], *(path.read_text(encoding="utf-8") for path in FILES[form]))
