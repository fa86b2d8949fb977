"""A robot as screws and motors: a tree of joints with fixed placements and axes, inertias, named frames; and the chains cut from it.

A joint of kind "floating" stands for a moving base: its position is a motor (8 numbers), its velocity a twist in its own axes (6 numbers,
linear first, as in Pinocchio). A joint that mimics another has no coordinate of its own: it moves by `ratio` times that joint's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any, Literal

from cga_codegen.robots.placement import Inertia as Inertia
from cga_codegen.robots.placement import ModelError as ModelError
from cga_codegen.robots.placement import Placement as Placement
from cga_codegen.robots.placement import Rows3 as Rows3
from cga_codegen.robots.placement import Vector3 as Vector3
from cga_codegen.robots.placement import as_rotation as as_rotation
from cga_codegen.robots.placement import as_vector as as_vector
from cga_codegen.robots.placement import merged

Kind = Literal["revolute", "continuous", "prismatic", "floating"]

GRAVITY: Vector3 = (0.0, 0.0, -9.81)
"""m/s^2 in the base frame (floating base: in the world)."""

_LIMITS = {"lower": -math.inf, "upper": math.inf, "velocity": math.inf, "effort": math.inf}


@dataclass(frozen=True)
class Joint:
    """A joint. `placement` is that of its frame in the parent joint's frame at q = 0; `axis` is a unit vector in its own frame (floating:
    0 0 0); `parent` is the index of the parent joint, -1 for the base. Limits in rad (m), rad/s (m/s), N m (N). `armature` is the rotor's
    inertia seen at the joint (kg m^2, kg). `follows` names the joint that it mimics, q = ratio q_followed (an offset is in the placement).
    """

    name: str
    kind: Kind
    parent: int
    placement: Placement
    axis: Vector3
    lower: float
    upper: float
    velocity: float
    effort: float
    inertia: Inertia | None = None
    follows: str = ""
    ratio: float = 1.0
    armature: float = 0.0

    def motion(self, q: float) -> Placement:
        """The motion of the joint at a value of its own (rad or m); the identity for a floating joint."""
        if self.kind == "floating":
            return Placement()
        return Placement.shift(self.axis, q) if self.kind == "prismatic" else Placement.turn(self.axis, q)


@dataclass(frozen=True)
class Frame:
    """A named frame fixed to a joint's link (`joint` -1: to the base)."""

    name: str
    joint: int
    placement: Placement


@dataclass(frozen=True)
class Coordinates:
    """What q and v of a robot or a chain hold, and how they move its joints.

    names, kinds: one a coordinate, the floating base first if there is one (8 numbers of q, 6 of v), all others one number each.
    motions: for each joint but the floating one the index among these others, the ratio, and whether the joint slides (what mimics may
    slide where its leader turns: a rack and its pinion).
    """

    names: tuple[str, ...]
    kinds: tuple[Kind, ...]
    motions: tuple[tuple[int, float, bool], ...]

    @property
    def floating(self) -> bool:
        """Whether the base moves."""
        return "floating" in self.kinds

    @property
    def nq(self) -> int:
        """Numbers in q."""
        return len(self.names) + (7 if self.floating else 0)

    @property
    def nv(self) -> int:
        """Numbers in v: degrees of freedom."""
        return len(self.names) + (5 if self.floating else 0)

    @cached_property
    def columns(self) -> tuple[tuple[int, float], ...]:
        """For each screw (six of the floating base, then one a joint) its column among the velocities, and its ratio."""
        first = 6 if self.floating else 0
        return (*((k, 1.0) for k in range(first)), *((first + k, ratio) for k, ratio, _ in self.motions))


def coordinates(joints: Sequence[Joint]) -> Coordinates:
    """The coordinates of joints: those of the independent ones in their order, then of joints that are followed but not among them."""
    leaders = [joint.name for joint in joints if not joint.follows]
    names = tuple(dict.fromkeys([*leaders, *(joint.follows for joint in joints if joint.follows)]))
    kinds = {joint.follows or joint.name: joint.kind for joint in sorted(joints, key=lambda joint: not joint.follows)}
    floating = bool(joints) and joints[0].kind == "floating"
    ones = names[1:] if floating else names
    moving = [(j, ones.index(j.follows or j.name)) for j in joints if j.kind != "floating"]
    motions = [(k, j.ratio if j.follows else 1.0, j.kind == "prismatic") for j, k in moving]
    return Coordinates(names, tuple(kinds[name] for name in names), tuple(motions))


@dataclass(frozen=True)
class Chain:
    """The joints from a root frame to an end frame, in order; `tool` places the end frame in the last joint's frame.

    Joint placements are relative to the joint before (the first: to the root frame). `name` identifies the chain among those of a robot.
    """

    robot: str
    name: str
    joints: tuple[Joint, ...]
    tool: Placement

    @cached_property
    def coordinates(self) -> Coordinates:
        """What q and v hold."""
        return coordinates(self.joints)

    @property
    def n(self) -> int:
        """Number of velocity coordinates."""
        return self.coordinates.nv


@dataclass(frozen=True)
class RobotModel:
    """A tree of joints on a fixed base (or with a floating joint first), with named frames. Parents come before children.

    gravity: m/s^2, in the base frame.
    """

    name: str
    joints: tuple[Joint, ...]
    frames: tuple[Frame, ...]
    source: str = ""
    gravity: Vector3 = GRAVITY

    def __post_init__(self) -> None:
        for k, joint in enumerate(self.joints):
            if not -1 <= joint.parent < k:
                raise ModelError(f"{self.name}: joint {joint.name!r} comes before its parent")
            if k > 0 and "floating" in (joint.kind, self.joints[0].kind if joint.parent < 0 else ""):
                wrong = "floats; only the base may" if joint.kind == "floating" else "does not hang on the floating base"
                raise ModelError(f"{self.name}: joint {joint.name!r} {wrong}")
            if joint.follows and not any(j.name == joint.follows and not j.follows and j.kind != "floating" for j in self.joints):
                raise ModelError(f"{self.name}: joint {joint.name!r} mimics {joint.follows!r}; the name of an independent joint is needed")

    @cached_property
    def coordinates(self) -> Coordinates:
        """What q and v hold."""
        return coordinates(self.joints)

    def frame(self, name: str) -> Frame:
        """The frame of that name; a ModelError lists the valid names."""
        if found := next((frame for frame in self.frames if frame.name == name), None):
            return found
        raise ModelError(f"{self.name} has no frame {name!r}; frames: {', '.join(f.name for f in self.frames)}")

    def tips(self) -> tuple[str, ...]:
        """For each joint without children, the last frame on it: the natural ends of chains."""
        parents = {joint.parent for joint in self.joints}
        last = {frame.joint: frame.name for frame in self.frames}
        return tuple(last.get(k, joint.name) for k, joint in enumerate(self.joints) if k not in parents)

    def path(self, joint: int) -> tuple[int, ...]:
        """Indices of the joints from the base to `joint`, in order."""
        up: list[int] = []
        while joint >= 0:
            up.append(joint)
            joint = self.joints[joint].parent
        return tuple(reversed(up))

    def chain(
        self,
        frame: str,
        root: str | None = None,
        placement: Placement | None = None,
        offset: Vector3 = (0.0, 0.0, 0.0),
        name: str | None = None,
        tool: Placement | None = None,
    ) -> Chain:
        """The chain from `root` (default: the base; with a floating base: the world) to `frame`.

        placement: where the robot's base (or the root frame) stands in the world. tool: placement of the end frame in `frame`; offset: a
        point fixed in the end frame, which becomes its origin. The root must lie on the path to the frame (a chain runs outwards only).
        """
        end = self.frame(frame)
        path = self.path(end.joint)
        start = self.frame(root) if root is not None else None
        if start is not None and start.joint >= 0:
            if start.joint not in path:
                raise ModelError(f"{self.name}: root {root!r} does not lie between the base and {frame!r}")
            path = path[path.index(start.joint) + 1 :]
        before = placement or Placement()
        if start is not None:
            before = before @ start.placement.inverse()
        joints: list[Joint] = []
        for k, index in enumerate(path):
            joint = self.joints[index]
            joints.append(replace(joint, parent=k - 1, placement=before @ joint.placement))
            before = Placement()
        last = before @ end.placement  # with no joint between, `before` still holds the world and the root
        last = last @ (tool or Placement()) @ Placement(translation=as_vector(offset, "offset"))
        return Chain(self.name, name or frame, tuple(joints), last)

    def locked(self, values: Mapping[str, float]) -> RobotModel:
        """The robot with some joints held at a value (rad or m); what they carry is then carried by the joint before.

        A key is a joint's name or a shell pattern ("left_hip_*"). Joints that mimic a locked one are locked with it. Raises ModelError for
        a key that no joint matches, a mimicking or floating joint named outright, a value that is not finite, and when nothing is left.
        """
        held = self._held(values)
        if len(held) == len(self.joints):
            raise ModelError(f"{self.name}: every joint would be locked; leave at least one to move")
        index: dict[int, int] = {-1: -1}
        at: dict[int, Placement] = {-1: Placement()}
        kept: list[Joint] = []
        bodies: dict[int, list[Inertia]] = {}
        for k, joint in enumerate(self.joints):
            place = at[joint.parent] @ joint.placement
            if k in held:
                index[k], at[k] = index[joint.parent], place @ joint.motion(held[k])
            else:
                index[k], at[k] = len(kept), Placement()
                kept.append(replace(joint, parent=index[joint.parent], placement=place))
            if joint.inertia is not None and index[k] >= 0:
                bodies.setdefault(index[k], []).append(joint.inertia.placed(at[k]) if k in held else joint.inertia)
        joints = [replace(joint, inertia=merged(bodies[k]) if k in bodies else None) for k, joint in enumerate(kept)]
        frames = [Frame(f.name, index[f.joint], at[f.joint] @ f.placement if f.joint in held else f.placement) for f in self.frames]
        return replace(self, joints=tuple(joints), frames=tuple(frames))

    def _held(self, values: Mapping[str, float]) -> dict[int, float]:
        """Joint index -> value, for `locked`."""
        by_name: dict[str, float] = {}
        for key, value in values.items():
            if not math.isfinite(value):
                raise ModelError(f"{self.name}: joint {key!r} cannot be locked at {value}; a finite number is needed")
            found = [j for j in self.joints if j.name == key]  # first, since names may hold brackets
            found = found or [j for j in self.joints if fnmatchcase(j.name, key) and not (j.follows or j.kind == "floating")]
            if not found:
                raise ModelError(f"{self.name} has no joint {key!r} to lock; joints: {', '.join(j.name for j in self.joints)}")
            for joint in found:
                if joint.follows or joint.kind == "floating":
                    why = f"mimics {joint.follows!r}: lock that one" if joint.follows else "is the floating base: load it fixed"
                    raise ModelError(f"{self.name}: joint {joint.name!r} cannot be locked, it {why}")
                by_name[joint.name] = value
        held = {}
        for k, joint in enumerate(self.joints):
            if (joint.follows or joint.name) in by_name:
                held[k] = by_name[joint.follows or joint.name] * joint.ratio
        return held

    def snapped(self, tolerance: float) -> RobotModel:
        """The robot whose placements within `tolerance` of right angles are right angles, each rotation as a whole (1.5708 for pi/2)."""
        joints = [replace(joint, placement=joint.placement.snapped(tolerance)) for joint in self.joints]
        frames = [Frame(frame.name, frame.joint, frame.placement.snapped(tolerance)) for frame in self.frames]
        return replace(self, joints=tuple(joints), frames=tuple(frames))

    def to_json(self) -> dict[str, Any]:
        """Plain data: what `from_json` reads. JSON has no infinity, so a missing limit becomes None."""
        data = asdict(self)
        for joint in data["joints"]:
            joint.update({key: joint[key] if math.isfinite(joint[key]) else None for key in _LIMITS})
        return data

    @classmethod
    def from_json(cls, data: dict[str, Any]) -> RobotModel:
        """The inverse of `to_json` (lists become tuples, rotations are checked again)."""

        def placement(d: dict[str, Any], what: str) -> Placement:
            return Placement(as_rotation(d["rotation"], what), as_vector(d["translation"], what))

        def inertia(d: dict[str, Any] | None) -> Inertia | None:
            return None if d is None else Inertia(float(d["mass"]), as_vector(d["com"], "com"), tuple(d["tensor"]))

        def joint(d: dict[str, Any]) -> Joint:
            limits = {key: _LIMITS[key] if d[key] is None else float(d[key]) for key in _LIMITS}
            geometry = {"placement": placement(d["placement"], d["name"]), "axis": as_vector(d["axis"], d["name"])}
            return Joint(**{**d, **limits, **geometry, "inertia": inertia(d["inertia"])})

        joints = tuple(joint(d) for d in data["joints"])
        frames = tuple(Frame(f["name"], f["joint"], placement(f["placement"], f["name"])) for f in data["frames"])
        return cls(data["name"], joints, frames, data["source"], as_vector(data["gravity"], "gravity"))
