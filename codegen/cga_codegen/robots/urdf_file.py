"""Reads a URDF with the standard library and checks all of it that matters to kinematics and dynamics, before any other parser sees it.

The tree of joints is written out again as a small URDF (names, origins, axes; numbers as shortest round-trip decimals). Pinocchio then
parses that text and never the user's: it stays silent, and never meets what it would crash on (thousands of links in a row), drop without
a word (a loop beside the tree, an inertial without inertia) or accept (negative masses, lower limits above upper ones). Limits and masses
are kept here, to the last digit.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal
from xml.sax.saxutils import quoteattr

from cga_codegen.robots.errors import (
    BadNumberError,
    BrokenFileError,
    DuplicateNameError,
    TreeError,
    UnsafeFileError,
    UnsupportedJointError,
)
from cga_codegen.robots.safe_xml import read_xml
from cga_codegen.robots.urdf_tree import LARGEST, Follow, check_base, check_tree, leaders

MAX_LINKS = 1000
"""Pinocchio descends link by link on the C stack (10,000 links in a row are a segmentation fault) and needs quadratic time."""
MAX_NAME = 200
"""Characters in a name: names stand in messages and become names of files."""
MOVING = ("revolute", "continuous", "prismatic")

Limits = tuple[float, float, float, float]
Mimic = Literal["follow", "independent"]


@dataclass(frozen=True)
class Body:
    """A link's inertial as given: mass (kg), its frame in the link's (xyz in m, rpy in rad), xx xy xz yy yz zz in that frame (kg m^2)."""

    mass: float
    xyz: tuple[float, ...]
    rpy: tuple[float, ...]
    tensor: tuple[float, ...]


@dataclass(frozen=True)
class UrdfFile:
    """A checked robot description: `xml` is what Pinocchio may read (the tree); `kinds` and `limits` (lower, upper, velocity, effort) are
    those of the moving joints, `bodies` those of the links that have an inertial, `follows` those of the mimicking joints."""

    name: str
    source: str
    xml: str
    kinds: dict[str, str]
    limits: dict[str, Limits]
    bodies: dict[str, Body]
    follows: dict[str, Follow]
    floats: bool


def read_urdf(path_or_text: str | os.PathLike[str], mimic: Mimic = "follow") -> UrdfFile:
    """Read and check a URDF given as a path, or as its text (a string whose first character that is not blank is "<").

    Raises a named child of ModelError (see `cga_codegen.robots.errors`).
    """
    robot, source = read_xml(path_or_text, "URDF")
    return _Check(source, mimic).robot(robot)


class _Check:
    """One pass over the parsed elements; `where` names the file in every message."""

    def __init__(self, where: str, mimic: Mimic) -> None:
        self.where, self.mimic = where, mimic

    def robot(self, robot: ET.Element) -> UrdfFile:
        for element in robot.iter():
            if "xacro" in element.tag.partition("}")[0]:  # the tag is {namespace}name
                raise BrokenFileError(f"{self.where}: contains xacro macros; expand it first with `xacro FILE > robot.urdf`")
        if robot.tag.endswith("}robot"):  # some programs give the whole file a namespace
            space = robot.tag.removesuffix("robot")
            for element in robot.iter():
                element.tag = element.tag.removeprefix(space)
        if robot.tag != "robot":
            raise BrokenFileError(f"{self.where}: the root element is <{robot.tag[:80]}>; a URDF has <robot>")
        title = self.name(robot, "robot")
        links, joints = robot.findall("link"), robot.findall("joint")
        if not links:
            raise BrokenFileError(f"{self.where}: no <link> is given; a robot has at least one")
        if len(links) > MAX_LINKS:
            raise UnsafeFileError(f"{self.where}: {len(links)} links given, at most {MAX_LINKS} are read")
        link_names, joint_names = self.names(links), self.names(joints)
        bodies = {str(link.get("name")): self.body(link) for link in links}
        parts = [f"<link name={quoteattr(name)}/>" for name in bodies]
        kinds: dict[str, str] = {}
        limits: dict[str, Limits] = {}
        follows: dict[str, Follow] = {}
        ends: dict[str, tuple[str, str]] = {}
        floating: list[str] = []
        for joint in joints:
            key = str(joint.get("name"))
            label = f"{self.where}: joint {key!r}"
            kind = self.kind(joint, label)
            ends[key] = self.end(joint, "parent", link_names, label), self.end(joint, "child", link_names, label)
            if kind in MOVING:
                kinds[key], limits[key] = kind, self.limits(joint, kind, label)
                mimic = self.only(joint, "mimic", label)
                if mimic is not None and self.mimic == "follow":
                    follows[key] = self.follow(mimic, label)
            parts.append(self.joint(joint, kind, ends[key], label))
            if kind == "floating":
                floating.append(key)
        check_tree(self.where, link_names, ends)
        check_base(self.where, floating, ends)
        if "universe" in joint_names:
            raise DuplicateNameError(f"{self.where}: a joint is called 'universe', which is the fixed world; another name is needed")
        xml = f"<robot name={quoteattr(title)}>\n" + "\n".join(parts) + "\n</robot>\n"
        given = {name: body for name, body in bodies.items() if body is not None}
        return UrdfFile(title, self.where, xml, kinds, limits, given, leaders(self.where, follows, kinds), bool(floating))

    def names(self, elements: Iterable[ET.Element]) -> set[str]:
        seen: set[str] = set()
        for element in elements:
            name = self.name(element)
            if name in seen:
                raise DuplicateNameError(f"{self.where}: two {element.tag}s are called {name!r}; names must be unique")
            seen.add(name)
        return seen

    def name(self, element: ET.Element, default: str = "") -> str:
        name = element.get("name") or default
        if not name:
            raise BrokenFileError(f"{self.where}: a <{element.tag}> has no name; every joint and link needs one")
        if len(name) > MAX_NAME:
            given = f"a <{element.tag}> has a name of {len(name)} characters ({name[:40]!r}...)"
            raise BrokenFileError(f"{self.where}: {given}; at most {MAX_NAME} are read")
        return name

    def only(self, element: ET.Element, tag: str, label: str) -> ET.Element | None:
        found = element.findall(tag)
        if len(found) > 1:
            raise BrokenFileError(f"{label}: {len(found)} <{tag}> elements given, at most one is read")
        return found[0] if found else None

    def numbers(self, text: str, count: int, what: str, below: float = math.inf) -> tuple[float, ...]:
        words = text.split()
        try:
            values = tuple(float(word) for word in words)
            if "_" in text or not text.isascii() or len(values) != count:  # float() reads 1_000 and Arabic digits, XML Schema does not
                raise ValueError
        except ValueError:
            wanted = "one number is" if count == 1 else f"{count} numbers are"
            raise BadNumberError(f"{what} is {text[:80]!r}; {wanted} needed") from None
        if not all(map(math.isfinite, values)):
            raise BadNumberError(f"{what} is {text[:80]!r}; a finite number is needed")
        if max(map(abs, values)) >= below:
            raise BadNumberError(f"{what} is {text[:80]!r}; less than {below:g} is needed")
        return values

    def number(
        self, element: ET.Element | None, attribute: str, label: str, default: float | None = None, below: float = math.inf
    ) -> float:
        text = None if element is None else element.get(attribute)
        if text is None:
            if default is None:
                raise BrokenFileError(f"{label}: {attribute!r} is missing; it has no default")
            return default
        return self.numbers(text, 1, f"{label}: {attribute}", below)[0]

    def origin(self, element: ET.Element, label: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
        origin = self.only(element, "origin", label)
        if origin is None:
            return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        if unknown := set(origin.keys()) - {"xyz", "rpy"}:
            raise BrokenFileError(f"{label}: <origin> has {sorted(unknown)[0][:80]!r}; xyz and rpy are read")
        xyz = self.numbers(origin.get("xyz", "0 0 0"), 3, f"{label}: origin xyz", LARGEST)
        return xyz, self.numbers(origin.get("rpy", "0 0 0"), 3, f"{label}: origin rpy", LARGEST)

    def body(self, link: ET.Element) -> Body | None:
        label = f"{self.where}: link {link.get('name')!r}"
        inertial = self.only(link, "inertial", label)
        if inertial is None:
            return None
        mass = self.number(self.only(inertial, "mass", label), "value", f"{label}: mass", below=LARGEST)
        if mass < 0.0:
            raise BadNumberError(f"{label}: mass is {mass:g}; zero or a positive number is needed")
        inertia = self.only(inertial, "inertia", label)
        tensor = {k: self.number(inertia, k, f"{label}: inertia", below=LARGEST) for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
        for key in ("ixx", "iyy", "izz"):
            if tensor[key] < -1e-12:  # published files hold rounding errors such as -5e-20; a gram at a millimetre has 1e-9
                raise BadNumberError(f"{label}: {key} is {tensor[key]:g}; zero or a positive number is needed")
        return Body(mass, *self.origin(inertial, label), tuple(tensor.values()))

    def kind(self, joint: ET.Element, label: str) -> str:
        kind = joint.get("type", "")
        if kind not in (*MOVING, "fixed", "floating"):
            raise UnsupportedJointError(f"{label} is of type {kind[:80]!r}; revolute, continuous, prismatic, fixed and floating are read")
        return kind

    def follow(self, mimic: ET.Element, label: str) -> Follow:
        leader = mimic.get("joint")
        if not leader:
            raise BrokenFileError(f"{label}: its <mimic> names no joint; the name of a moving joint is needed")
        ratio = self.number(mimic, "multiplier", f"{label}: mimic", 1.0, LARGEST)
        return Follow(leader, ratio, self.number(mimic, "offset", f"{label}: mimic", 0.0, LARGEST))

    def end(self, joint: ET.Element, side: str, links: set[str], label: str) -> str:
        element = self.only(joint, side, label)
        name = None if element is None else element.get("link")
        if not name:
            raise BrokenFileError(f"{label} has no {side} link; each joint names a parent and a child")
        if name not in links:
            raise TreeError(f"{label}: its {side} link {name[:80]!r} does not exist; add a <link> of that name")
        return name

    def axis(self, joint: ET.Element, label: str) -> tuple[float, ...]:
        element = self.only(joint, "axis", label)
        values = (1.0, 0.0, 0.0) if element is None else self.numbers(element.get("xyz", ""), 3, f"{label}: axis")
        largest = max(map(abs, values))
        if largest == 0.0:
            raise BadNumberError(f"{label}: axis is 0 0 0; a direction other than zero is needed")
        scaled = tuple(x / largest for x in values)  # first, so that squares of 1e-200 or 1e200 neither vanish nor overflow
        length = math.sqrt(sum(x * x for x in scaled))
        return tuple(x / length for x in scaled)

    def limits(self, joint: ET.Element, kind: str, label: str) -> Limits:
        element = self.only(joint, "limit", label)
        if kind == "continuous":
            rates = [math.inf if element is None else self.number(element, k, f"{label}: limit", math.inf) for k in ("velocity", "effort")]
            lower, upper = -math.inf, math.inf
        else:
            if element is None:
                raise BrokenFileError(f"{label} is {kind} and has no <limit>; lower, upper, velocity and effort are needed")
            rates = [self.number(element, k, f"{label}: limit") for k in ("velocity", "effort")]
            lower, upper = (self.number(element, k, f"{label}: limit", 0.0) for k in ("lower", "upper"))  # 0 is the format's default
        if lower > upper:
            raise BadNumberError(f"{label}: lower limit {lower:g} is above upper limit {upper:g}; lower <= upper is needed")
        if min(rates) < 0.0:
            raise BadNumberError(f"{label}: velocity and effort limits are {rates[0]:g} and {rates[1]:g}; none may be negative")
        return lower, upper, rates[0], rates[1]

    def joint(self, joint: ET.Element, kind: str, ends: tuple[str, str], label: str) -> str:
        xyz, rpy = self.origin(joint, label)
        motion = ""
        if kind in MOVING:  # the limits are read above; these only satisfy the parser
            motion = f'<axis xyz="{_decimals(self.axis(joint, label))}"/><limit lower="0" upper="0" velocity="0" effort="0"/>'
        return (
            f'<joint name={quoteattr(str(joint.get("name")))} type="{kind}"><parent link={quoteattr(ends[0])}/>'
            f'<child link={quoteattr(ends[1])}/><origin xyz="{_decimals(xyz)}" rpy="{_decimals(rpy)}"/>{motion}</joint>'
        )


def _decimals(values: Iterable[float]) -> str:
    return " ".join(repr(x) for x in values)
