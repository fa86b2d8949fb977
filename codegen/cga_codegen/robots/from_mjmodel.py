"""A mujoco.MjModel to `RobotModel`: its joints in its order with MuJoCo's own values of q, its bodies and sites as frames, its inertias.

MuJoCo moves a body by its joints in a row, each about its anchor p (in the body) and axis a, from the value ref at which the file draws it:
hinge T(p) R(a, q - ref) T(-p), slide T(a (q - ref)). Here each joint has its frame at its anchor, with the axes of its body; ref is folded
into its placement, so that q is MuJoCo's qpos as it is. The inertia of a body lies on the last of its joints; a body without joints is
carried by the joint before it, as a link on a fixed joint.
"""

from __future__ import annotations

import math
from glob import escape
from typing import Any

import numpy as np

from cga_codegen.robots.errors import BadNumberError, DuplicateNameError, UnsupportedJointError
from cga_codegen.robots.from_pinocchio import follow
from cga_codegen.robots.mjmodel_joints import Follows, MjJoints
from cga_codegen.robots.model import Frame, Inertia, Joint, Kind, ModelError, Placement, RobotModel, Vector3, as_rotation, as_vector
from cga_codegen.robots.placement import merged

LARGEST = 1e50
"""Lengths, masses and inertias stay below it, so that no product of a few of them overflows."""
UNIT = 1e-9
"""How far the length of an axis or a quaternion may be from 1."""

_NUMBERS = {
    "body": ("pos", "quat", "ipos", "iquat", "mass", "inertia"),
    "jnt": ("pos", "axis"),
    "dof": ("armature",),
    "site": ("pos", "quat"),
    "eq": ("data",),
    "actuator": ("gear", "armature"),
}
"""What is read of a model and must be finite."""


def load_mjmodel(model: Any, name: str | None = None, *, ignore_constraints: bool = False, source: str = "") -> RobotModel:
    """The robot of a mujoco.MjModel: hinges and slides in a tree on the world, or on one free joint (a floating base).

    q is MuJoCo's qpos, joint by joint (a free joint's seven numbers are a motor here). A hinge without range is "continuous": an angle
    without limits. `effort` is the largest force that the joint's actuators can exert together, within the joint's actuatorfrcrange;
    infinite where one of them has no limit, or none acts on the joint itself. Velocities have no limit in MuJoCo. `armature` includes that
    of the actuators (times gear^2).

    Joint constraints (equality/joint) that are linear make one joint follow the other: the follower leaves q; one that is constant locks
    its joint, which leaves q too. Constraints of other kinds (connect, weld, tendon, curved polynomials) change the mechanism, and
    armatures of a free joint or a tendon lie in no joint's own coordinate: they are refused, unless ignore_constraints leaves them out.
    Springs, damping, friction, contacts, tendons, fluid forces and gravity compensation are not read: they are forces besides the
    rigid-body dynamics. Bodies with mocap stand still where the model has them.

    Frames: "world", then for each body in MuJoCo's order its joints, itself, its sites. Where two share a name, the first keeps it; one
    that lies elsewhere is called "NAME:joint", "NAME:body" or "NAME:site". Bodies and joints without name are "body3", "joint2" (MuJoCo's
    index), the floating base's joint "root_joint"; sites without name are left out.

    name: default: the model's own. source: what messages call it. Raises UnsupportedJointError, TreeError, BadNumberError,
    DuplicateNameError.
    """
    mujoco = import_mujoco()
    if not isinstance(model, mujoco.MjModel):
        raise ModelError(f"a {type(model).__name__} was given; a mujoco.MjModel is needed")
    title = name or bytes(model.names).split(b"\0", 1)[0].decode(errors="replace")
    title = "robot" if title in ("", "MuJoCo Model") else title  # MuJoCo's own for a file without name
    reader = _Reader(mujoco, model, source or f"mujoco.MjModel {title}")
    reader.check_numbers()
    follows, held = reader.joints.constraints(ignore_constraints)
    if not ignore_constraints:
        reader.joints.refuse_other_armatures()
    joints, frames = reader.tree(follows)
    robot = RobotModel(title, joints, frames, reader.label, reader.gravity())
    return robot.locked({escape(key): value for key, value in held.items()}) if held else robot


def import_mujoco() -> Any:
    """The package, or a ModelError that says how to get it."""
    try:
        import mujoco
    except ImportError:
        raise ModelError("reading MJCF needs MuJoCo, which is not installed; type `pip install 'cga-robotics[mujoco]'`") from None
    return mujoco


class _Reader:
    """Reads one model; `label` names it in every message."""

    def __init__(self, mujoco: Any, model: Any, label: str) -> None:
        self.mujoco, self.model, self.label = mujoco, model, label
        self.joints = MjJoints(mujoco, model, label)
        self.bodies = self.joints.unique("BODY", model.nbody, "body")

    def check_numbers(self) -> None:
        m, moved = self.model, (self.joints.hinge, self.joints.slide)
        names = {"body": self.bodies, "jnt": self.joints.names}
        for word, fields in _NUMBERS.items():
            for field in fields:
                values = np.asarray(getattr(m, f"{word}_{field}", ()), dtype=np.float64)  # older MuJoCos: none for actuators
                for index, row in enumerate(values.reshape(len(values), -1) if len(values) else ()):
                    label = f"{self.label}: {word} {names[word][index] if word in names else index!r}: {field} is {row.tolist()}"
                    if not np.all(np.abs(row) < LARGEST):
                        raise BadNumberError(f"{label}; finite numbers below {LARGEST:g} are needed")
                    unit = field in ("quat", "iquat") or (field == "axis" and self.joints.kind(index) in moved)
                    if unit and abs(np.linalg.norm(row) - 1.0) > UNIT:
                        raise BadNumberError(f"{label}; a direction or a rotation has length 1")
                    if field in ("mass", "inertia", "armature") and np.any(row < 0.0):
                        raise BadNumberError(f"{label}; zero or a positive number is needed")
        for j in range(m.njnt):
            if self.joints.kind(j) in moved and not abs(self.joints.reference(j)) < LARGEST:
                where = f"{self.label}: jnt {self.joints.names[j]!r}: ref is {self.joints.reference(j)}"
                raise BadNumberError(f"{where}; a finite number below {LARGEST:g} is needed")

    def gravity(self) -> Vector3:
        off = int(self.model.opt.disableflags) & int(self.mujoco.mjtDisableBit.mjDSBL_GRAVITY)
        return as_vector(np.zeros(3) if off else self.model.opt.gravity, f"{self.label}: gravity")

    def tree(self, follows: Follows) -> tuple[tuple[Joint, ...], tuple[Frame, ...]]:
        m = self.model
        self.refuse_what_has_no_place()
        joints: list[Joint] = []
        carried: dict[int, list[Inertia]] = {}
        frames: dict[str, Frame] = {}
        at: list[tuple[int, Placement]] = []  # of each body: the joint that carries it, and its placement in that joint's frame
        for b in range(m.nbody):
            label = f"{self.label}: body {self.bodies[b]!r}"
            link, place = -1, Placement()
            if b > 0:
                link, place = at[m.body_parentid[b]]
                place = place @ pose(m.body_quat[b], m.body_pos[b], label)
            for j in range(m.body_jntadr[b], m.body_jntadr[b] + m.body_jntnum[b]):
                joint, place = self.joint(j, link, place, follows)
                link = len(joints)
                joints.append(joint)
                self.add(frames, Frame(joint.name, link, Placement()), "joint")
            at.append((link, place))
            self.add(frames, Frame(self.bodies[b], link, place), "body")
            for s in np.flatnonzero(m.site_bodyid == b).tolist():
                if name := self.joints.given("SITE", s):
                    self.add(frames, Frame(name, link, place @ pose(m.site_quat[s], m.site_pos[s], f"{self.label}: site {name!r}")), "site")
            if m.body_mass[b] > 0.0 or np.any(m.body_inertia[b]):
                turned = place @ pose(m.body_iquat[b], m.body_ipos[b], label)
                xx, yy, zz = (float(x) for x in m.body_inertia[b])
                principal = Inertia(float(m.body_mass[b]), (0.0, 0.0, 0.0), (xx, 0.0, 0.0, yy, 0.0, zz))
                carried.setdefault(link, []).append(principal.placed(turned))
        done = [Joint(**{**vars(joint), "inertia": merged(carried[k]) if k in carried else None}) for k, joint in enumerate(joints)]
        return tuple(done), tuple(frames.values())

    def refuse_what_has_no_place(self) -> None:
        m, told = self.model, self.joints
        for j in range(m.njnt):
            label = f"{self.label}: joint {told.names[j]!r}"
            if told.kind(j) == told.ball:
                raise UnsupportedJointError(f"{label} is a ball; hinges, slides and one free joint at the root are read")
            if told.kind(j) == told.free:
                base = m.body_rootid[m.jnt_bodyid[j]]
                if others := [k for k in range(m.njnt) if k < j or m.body_rootid[m.jnt_bodyid[k]] != base]:
                    why = f"does not carry joint {told.names[others[0]]!r}"
                    raise UnsupportedJointError(f"{label} is free and {why}; one free joint is read, as the base of the whole robot")

    def joint(self, j: int, parent: int, place: Placement, follows: Follows) -> tuple[Joint, Placement]:
        """A joint of a body that has `place` in the joint before, and the body's placement in its frame."""
        m, told = self.model, self.joints
        label = f"{self.label}: joint {told.names[j]!r}"
        if told.kind(j) == told.free:  # qpos places the body in the world, whatever body_pos
            return Joint(told.names[j], "floating", -1, Placement(), (0.0, 0.0, 0.0), -math.inf, *3 * (math.inf,)), Placement()
        anchor = as_vector(m.jnt_pos[j], label)
        low, high = (float(x) for x in m.jnt_range[j])
        if not low <= high:
            raise BadNumberError(f"{label}: its range is {low:g} to {high:g}; lower <= upper is needed")
        low, high = (low, high) if m.jnt_limited[j] else (-math.inf, math.inf)
        turns: Kind = "revolute" if m.jnt_limited[j] else "continuous"
        kind: Kind = "prismatic" if told.kind(j) == told.slide else turns
        axis = as_vector(m.jnt_axis[j], label)
        start = place @ Placement(translation=anchor)
        joint = Joint(told.names[j], kind, parent, start, axis, low, high, math.inf, told.effort(j))
        leader, ratio, shift = follows.get(j, (-1, 1.0, 0.0))
        joint = follow(joint, told.names[leader] if leader >= 0 else "", ratio, shift - told.reference(j), told.armature(j))
        return joint, Placement(translation=as_vector([-x for x in anchor], label))

    def add(self, frames: dict[str, Frame], frame: Frame, kind: str) -> None:
        name = frame.name
        if name in frames:
            if (frames[name].joint, frames[name].placement) == (frame.joint, frame.placement):
                return
            name = f"{name}:{kind}"
            if name in frames:
                raise DuplicateNameError(f"{self.label}: frame {name!r} stands for two places; rename one of the bodies, joints and sites")
        frames[name] = Frame(name, frame.joint, frame.placement)


def pose(quat: Any, position: Any, what: str) -> Placement:
    """From MuJoCo's quaternion (w, x, y, z) and position: R = 1 + 2 w [u]x + 2 [u]x^2, u = (x, y, z)."""
    w, x, y, z = (float(n) for n in np.asarray(quat) / np.linalg.norm(quat))
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return Placement(as_rotation(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross, what), as_vector(position, what))
