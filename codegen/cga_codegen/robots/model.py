"""A robot as screws and motors: joints with fixed placements and axes, inertias, named frames; and the chains cut from it.

Everything is plain tuples of floats, so that a model is immutable, compares by value, and goes to JSON and back without loss.
A placement maps coordinates of the child frame to the parent frame: x_parent = R x_child + p (metres).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal, cast

import numpy as np
from numpy.typing import NDArray

Vector3 = tuple[float, float, float]
Rows3 = tuple[Vector3, Vector3, Vector3]
Kind = Literal["revolute", "continuous", "prismatic"]

ROTATION_TOLERANCE = 1e-9
"""Largest entry of R^T R - 1 that a file may have; beyond it the rotation is refused, not repaired."""
SNAP_TOLERANCE = 1e-11
"""A whole rotation this close to a signed permutation is replaced by it (never single entries: see `as_rotation`)."""


_LIMITS = {"lower": -math.inf, "upper": math.inf, "velocity": math.inf, "effort": math.inf}


class ModelError(ValueError):
    """A robot description that cannot be represented; the message names the element and what is accepted."""


def as_vector(values: Iterable[float], what: str) -> Vector3:
    """Three finite floats, or a ModelError that names `what`."""
    numbers = tuple(float(x) + 0.0 for x in values)
    if len(numbers) != 3 or not np.all(np.isfinite(numbers)):
        raise ModelError(f"{what}: {numbers} given, three finite numbers are needed")
    return numbers


def as_rotation(rows: Any, what: str) -> Rows3:
    """A checked rotation: orthonormal to ROTATION_TOLERANCE with determinant +1, else a ModelError.

    A rotation within SNAP_TOLERANCE of a signed permutation matrix becomes that matrix as a whole. Snapping single entries
    would leave SO(3) (measured: 4e-8 off on one robot), so either all nine entries are replaced or none.
    """
    r: NDArray[np.float64] = np.array(rows, dtype=np.float64)
    if r.shape != (3, 3) or not np.all(np.isfinite(r)):
        raise ModelError(f"{what}: a rotation is a finite 3x3 matrix, got shape {r.shape}")
    defect = float(np.abs(r.T @ r - np.eye(3)).max())
    if defect > ROTATION_TOLERANCE or np.linalg.det(r) < 0:
        raise ModelError(f"{what}: not a rotation (R^T R - 1 is {defect:.1e}, det {np.linalg.det(r):+.3f})")
    snapped = np.round(r)
    if np.abs(r - snapped).max() <= SNAP_TOLERANCE and np.array_equal(snapped.T @ snapped, np.eye(3)):
        r = snapped
    r = r + 0.0  # -0.0 would print as "-0.0" and break byte-for-byte determinism
    return cast(Rows3, tuple(tuple(float(x) for x in row) for row in r))


@dataclass(frozen=True)
class Placement:
    """Rigid placement x_parent = rotation x_child + translation."""

    rotation: Rows3 = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    translation: Vector3 = (0.0, 0.0, 0.0)

    @classmethod
    def from_matrix(cls, matrix: Any, what: str = "placement") -> Placement:
        """From a 4x4 homogeneous matrix; refuses anything that is not a rigid motion."""
        m = np.array(matrix, dtype=np.float64)
        if m.shape != (4, 4) or not np.array_equal(m[3], [0.0, 0.0, 0.0, 1.0]):
            raise ModelError(f"{what}: a 4x4 matrix with last row 0 0 0 1 is needed")
        return cls(as_rotation(m[:3, :3], what), as_vector(m[:3, 3], what))

    def matrix(self) -> NDArray[np.float64]:
        """The 4x4 homogeneous matrix."""
        m = np.eye(4)
        m[:3, :3], m[:3, 3] = self.rotation, self.translation
        return m

    def __matmul__(self, other: Placement) -> Placement:
        r, p = np.array(self.rotation), np.array(self.translation)
        return Placement(
            as_rotation(r @ np.array(other.rotation), "composed placement"),
            as_vector(r @ np.array(other.translation) + p, "composed placement"),
        )

    def inverse(self) -> Placement:
        """The placement of the parent in the child."""
        rt = np.array(self.rotation).T
        return Placement(as_rotation(rt, "inverse placement"), as_vector(-rt @ np.array(self.translation), "inverse placement"))


@dataclass(frozen=True)
class Inertia:
    """Mass (kg), centre of mass in the joint frame (m), inertia about the centre of mass (xx, xy, xz, yy, yz, zz; kg m^2)."""

    mass: float
    com: Vector3
    tensor: tuple[float, float, float, float, float, float]


@dataclass(frozen=True)
class Joint:
    """A joint with one degree of freedom. `placement` is that of its frame in the parent joint's frame at q = 0; `axis` is a unit
    vector in its own frame; `parent` is the index of the parent joint, -1 for the base. Limits in rad (m), rad/s (m/s), N m (N)."""

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


@dataclass(frozen=True)
class Frame:
    """A named frame fixed to a joint's link (`joint` -1: to the base)."""

    name: str
    joint: int
    placement: Placement


@dataclass(frozen=True)
class Chain:
    """The joints from a root frame to an end frame, in order; `tool` places the end frame in the last joint's frame.

    Joint placements are relative to the joint before (the first: to the root frame). `name` identifies the chain among those of a robot.
    """

    robot: str
    name: str
    joints: tuple[Joint, ...]
    tool: Placement

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.joints)


@dataclass(frozen=True)
class RobotModel:
    """A tree of joints on a fixed base, with named frames. Parents come before children."""

    name: str
    joints: tuple[Joint, ...]
    frames: tuple[Frame, ...]
    source: str = ""

    def frame(self, name: str) -> Frame:
        """The frame of that name; a ModelError lists the valid names."""
        for frame in self.frames:
            if frame.name == name:
                return frame
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
    ) -> Chain:
        """The chain from `root` (default: the base) to `frame`.

        placement: where the robot's base (or the root frame) stands in the world. offset: a point fixed in the end frame, which becomes
        its origin.
        The root must lie on the path to the frame (a chain runs outwards only).
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
        tool = before @ end.placement  # with no joint between, `before` still holds the world and the root
        tool = tool @ Placement(translation=as_vector(offset, "offset"))
        return Chain(self.name, name or frame, tuple(joints), tool)

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
        return cls(data["name"], joints, frames, data.get("source", ""))
