"""Denavit-Hartenberg tables to `RobotModel`: the modified convention of Khalil and Kleinfinger (1986), for trees, and the standard one.

Modified, paper C eq. 1:   T_j = rot_z(gamma) trans_z(b) rot_x(alpha) trans_x(d) rot_z(theta) trans_z(r)
Standard:                  T_j = rot_z(theta) trans_z(d) trans_x(a) rot_x(alpha)

T_j maps coordinates of frame j to those of the antecedent's frame: a row names its antecedent, so that a table may be a tree.

The joint variable q moves theta = sign q + theta_0 (revolute, continuous) or r, in the standard convention d, = sign q + r_0 (prismatic).
Angles in rad, lengths in m. A row's frame, as the convention defines it, has the row's name in the model.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from importlib.resources import files
from typing import Any, Literal, TypeVar

import numpy as np

from cga_codegen.robots.errors import BadNumberError, BrokenFileError, DuplicateNameError, TreeError, UnsupportedJointError
from cga_codegen.robots.model import Frame, Joint, ModelError, Placement, RobotModel, as_rotation, as_vector
from cga_codegen.robots.safe_xml import file_text

RowKind = Literal["revolute", "continuous", "prismatic", "fixed"]


@dataclass(frozen=True)
class Row:
    """What the rows of both conventions share. antecedent: the name of an earlier row, "" for the base."""

    name: str
    antecedent: str = ""
    kind: RowKind = "revolute"
    sign: int = 1
    lower: float = -math.inf
    upper: float = math.inf
    velocity: float = math.inf
    effort: float = math.inf


@dataclass(frozen=True)
class ModifiedRow(Row):
    """A row of the modified table; theta (revolute) or r (prismatic) is its value at q = 0."""

    gamma: float = 0.0
    b: float = 0.0
    alpha: float = 0.0
    d: float = 0.0
    theta: float = 0.0
    r: float = 0.0


@dataclass(frozen=True)
class StandardRow(Row):
    """A row of the standard table; theta (revolute) or d (prismatic) is its value at q = 0."""

    theta: float = 0.0
    d: float = 0.0
    a: float = 0.0
    alpha: float = 0.0


AnyRow = TypeVar("AnyRow", bound=Row)


def load_mdh(rows: Sequence[ModifiedRow], name: str, base: Placement | None = None, source: str = "MDH table") -> RobotModel:
    """The tree of a modified table. The joint's frame is frame j itself, its axis +-z; base: frame 0 in the model's base frame.

    Frames: "base" (frame 0) and one a row. Raises children of ModelError: unknown antecedents, names twice, numbers that are not finite.
    """

    def before(row: ModifiedRow) -> Placement:  # rot_z(theta) and trans_z(r) commute, so that the constants all stand before the motion
        return _screw_z(row.gamma, row.b) @ _screw_x(row.alpha, row.d) @ _screw_z(row.theta, row.r)

    return _tree(rows, before, lambda _: Placement(), name, base, source)


def load_dh(rows: Sequence[StandardRow], name: str, base: Placement | None = None, source: str = "DH table") -> RobotModel:
    """The chain (or tree) of a standard table. Joint j turns about z of the frame before it; frame j lies behind the joint's link.

    Frames: "base" (frame 0) and one a row. Raises as `load_mdh`.
    """
    return _tree(rows, lambda row: _screw_z(row.theta, row.d), lambda row: _screw_x(row.alpha, row.a), name, base, source)


def _screw_z(angle: float, length: float) -> Placement:
    """rot_z(angle) trans_z(length), the turn about z and the way along it commute."""
    c, s = math.cos(angle), math.sin(angle)
    return Placement(as_rotation([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]], "rot_z"), as_vector((0.0, 0.0, length), "trans_z"))


def _screw_x(angle: float, length: float) -> Placement:
    """rot_x(angle) trans_x(length)."""
    c, s = math.cos(angle), math.sin(angle)
    return Placement(as_rotation([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]], "rot_x"), as_vector((length, 0.0, 0.0), "trans_x"))


def _tree(
    rows: Sequence[AnyRow],
    before: Callable[[AnyRow], Placement],
    after: Callable[[AnyRow], Placement],
    name: str,
    base: Placement | None,
    source: str,
) -> RobotModel:
    """T_j(q) = before(row) motion_z(sign q) after(row), hung on the frame of the antecedent row."""
    joints: list[Joint] = []
    frames = {"": Frame("base", -1, base or Placement())}
    for row in rows:
        _check(row, frames, f"{name}: row {row.name!r}")
        antecedent = frames[row.antecedent]
        placement = antecedent.placement @ before(row)
        if row.kind == "fixed":
            frames[row.name] = Frame(row.name, antecedent.joint, placement @ after(row))
            continue
        axis = (0.0, 0.0, float(row.sign))
        limits = (row.lower, row.upper, row.velocity, row.effort)
        joints.append(Joint(row.name, row.kind, antecedent.joint, placement, axis, *limits))
        frames[row.name] = Frame(row.name, len(joints) - 1, after(row))
    return RobotModel(name, tuple(joints), tuple(frames.values()), source)


def _check(row: Row, frames: dict[str, Frame], label: str) -> None:
    if not row.name or row.name == "base" or row.name in frames:
        raise DuplicateNameError(f"{label}: the name is empty, 'base' or given twice; each row needs a name of its own")
    if row.antecedent not in frames:
        raise TreeError(f"{label}: no earlier row is called {row.antecedent!r}; rows follow their antecedent, '' is the base")
    if row.kind not in ("revolute", "continuous", "prismatic", "fixed"):
        raise UnsupportedJointError(f"{label} is of kind {row.kind!r}; revolute, continuous, prismatic and fixed are read")
    if row.sign not in (1, -1):
        raise BadNumberError(f"{label}: sign is {row.sign!r}; 1 or -1 is needed")
    for key, value in vars(row).items():
        if key not in Row.__dataclass_fields__ and not math.isfinite(value):
            raise BadNumberError(f"{label}: {key} is {value}; a finite number is needed")
    if not row.lower <= row.upper:
        raise BadNumberError(f"{label}: limits are {row.lower:g} and {row.upper:g}; lower <= upper is needed")
    if not (row.velocity >= 0.0 and row.effort >= 0.0):
        raise BadNumberError(f"{label}: velocity and effort limits are {row.velocity:g} and {row.effort:g}; none may be negative")


_TABLES: dict[str, tuple[type[Row], Callable[..., RobotModel]]] = {"modified": (ModifiedRow, load_mdh), "standard": (StandardRow, load_dh)}


def load_table(table: Any) -> RobotModel:
    """The robot of a table as plain data: {"name": ..., "convention": "modified" or "standard", "rows": [{"name": ..., "d": ...}, ...]}.

    A row's keys are those of ModifiedRow or StandardRow (lengths m, angles rad); "base" may hold a 4x4 pose of frame 0.
    """
    if not isinstance(table, dict) or not {"name", "convention", "rows"} <= table.keys() <= {"name", "convention", "rows", "base"}:
        raise BrokenFileError("DH table: a mapping with the keys name, convention and rows (and perhaps base) is needed")
    if not isinstance(table["name"], str):
        raise BrokenFileError(f"DH table: name {table['name']!r} given; a word is needed")
    if not isinstance(table["convention"], str) or table["convention"] not in _TABLES:
        raise BrokenFileError(f"DH table: convention {table['convention']!r} given; 'modified' or 'standard' is needed")
    kind, load = _TABLES[table["convention"]]
    keys = {key: field.type for key, field in kind.__dataclass_fields__.items()}
    rows = []
    for number, row in enumerate(table["rows"] if isinstance(table["rows"], list) else [None], 1):
        label = f"DH table: row {number}"
        if not isinstance(row, dict) or "name" not in row or not row.keys() <= keys.keys():
            raise BrokenFileError(f"{label}: a mapping with a name and keys among {', '.join(keys)} is needed")
        for key, value in row.items():
            wanted: tuple[type, ...] = (str,) if keys[key] in ("str", "RowKind") else (int, float)
            if not isinstance(value, wanted) or isinstance(value, bool):
                raise BadNumberError(f"{label}: {key} is {value!r}; a {'word' if wanted == (str,) else 'number'} is needed")
            if isinstance(value, int) and abs(value) > 2**53:  # float() would round it, or overflow
                raise BadNumberError(f"{label}: {key} is an integer of {value.bit_length()} bits; at most 53 are read")
        rows.append(kind(**row))
    base = None if table.get("base") is None else Placement.from_matrix(table["base"], "DH table: base")
    return load(rows, table["name"], base)


def read_table(path: str | os.PathLike[str]) -> RobotModel:
    """The robot of a table in a JSON file. Raises children of ModelError."""
    text, source = file_text(path, "DH table")
    try:
        table = json.loads(text)
    except (ValueError, RecursionError) as error:  # ValueError: also an integer of thousands of digits
        raise BrokenFileError(f"{source}: not JSON ({error}); a DH table is needed") from None
    return replace(load_table(table), source=source)


def nao_mdh(version: str = "V50") -> RobotModel:
    """Both arms of the NAO from Table 1 of paper C; version "V32", "V33", "V40" or "V50". Kinematics only: no masses.

    Joints in the paper's order (1-5 right, 6-10 left), named and directed as in the URDF: theta = q + offset, where the offset is pi/2 for
    the two ShoulderRolls and 0 otherwise. Frames: "torso" (frame 0), "mdh1" .. "mdh10" as the table defines them; one frame for each joint
    name and the hands "RHand", "LHand" as in the bundled URDF, whose joint frames are all parallel to the torso's at q = 0.
    """
    data = json.loads((files("cga_codegen.robots") / "bundled" / "nao_mdh.json").read_text(encoding="utf-8"))
    if version not in data["versions"]:
        raise ModelError(f"no NAO version is called {version!r}; versions: {', '.join(data['versions'])}")
    constants: dict[str, float] = {"0": 0.0, "pi/2": math.pi / 2.0, **data["constants"][data["versions"][version]["constants"]]}
    limits = data["limits"][data["versions"][version]["limits"]]

    def value(symbol: str) -> float:
        return -constants[symbol[1:]] if symbol.startswith("-") else constants[symbol]

    table: list[dict[str, Any]] = [dict(zip(data["columns"], row, strict=True)) for row in data["rows"]]
    names = {0: "", **{row["j"]: row["joint"] for row in table}}
    rows = []
    for row in table:
        geometry: dict[str, Any] = {key: value(row[key]) for key in ("gamma", "b", "d", "alpha", "theta", "r")}
        lower, upper, velocity, effort = limits[row["joint"]]
        rows.append(ModifiedRow(row["joint"], names[row["a"]], lower=lower, upper=upper, velocity=velocity, effort=effort, **geometry))
    return _with_urdf_frames(load_mdh(rows, f"nao_mdh_{version}", source="nao_mdh.json"), constants)


def _with_urdf_frames(model: RobotModel, constants: dict[str, float]) -> RobotModel:
    """The same joints with frames as in the URDF: the origin of frame j, and the torso's directions at q = 0.

    The turn between the two does not depend on q; for frames 5 and 10 it is the R_fix of mdh5 = wrist R_fix: columns e_y, e_z, e_x.
    """
    frames = [replace(model.frame("base"), name="torso")]
    at_zero: list[Placement] = []
    for index, joint in enumerate(model.joints):
        at_zero.append((at_zero[joint.parent] if joint.parent >= 0 else Placement()) @ joint.placement)
        upright = Placement(as_rotation(np.array(at_zero[index].rotation).T, joint.name))
        frames += [Frame(f"mdh{index + 1}", index, Placement()), Frame(joint.name, index, upright)]
        if joint.name.endswith("WristYaw"):
            tool = Placement(translation=(constants["HandOffsetX"], 0.0, -constants["HandOffsetZ"]))
            frames.append(Frame(f"{joint.name[0]}Hand", index, upright @ tool))
    return replace(model, frames=tuple(frames))
