"""A pinocchio.Model to `RobotModel`: its joints in its order, its frames, its inertias, armatures, limits and gravity.

Frames are those of Pinocchio, in its order: "universe", then for each joint (moving or fixed) a frame of its name, and for each link a
frame of its name. Where a joint and a link share a name, the first in that order keeps it; if the later one lies elsewhere, it is called
"NAME:joint" or "NAME:link" (a link always coincides with its own joint, so this is rare).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_codegen.robots.errors import BadNumberError, DuplicateNameError, UnsupportedJointError
from cga_codegen.robots.model import Frame, Inertia, Joint, Kind, Placement, RobotModel, as_rotation, as_vector

_KINDS: dict[str, Kind] = {
    **{f"JointModel{name}": "revolute" for name in ("RX", "RY", "RZ", "RevoluteUnaligned")},
    **{f"JointModel{name}": "continuous" for name in ("RUBX", "RUBY", "RUBZ", "RevoluteUnboundedUnaligned")},
    **{f"JointModel{name}": "prismatic" for name in ("PX", "PY", "PZ", "PrismaticUnaligned")},
    "JointModelFreeFlyer": "floating",
}
"""Pinocchio's names of the joints that can be represented."""
_MIMIC = "JointModelMimic"


def load_pinocchio(model: Any) -> RobotModel:
    """The robot of a pinocchio.Model: one-degree-of-freedom joints in a tree, a free flyer at the root, mimicking joints.

    A continuous joint is one angle without limits here, where Pinocchio has a cosine and a sine. Raises UnsupportedJointError for any
    other joint (spherical, planar, composite, helical, ...), DuplicateNameError, BadNumberError.
    """
    joints = tuple(_joint_of(model, index) for index in range(1, model.njoints))
    gravity = as_vector(model.gravity.linear, "gravity")
    return RobotModel(str(model.name), joints, frames_of(model, str(model.name)), f"pinocchio.Model {model.name}", gravity)


def _joint_of(model: Any, index: int) -> Joint:
    joint, name = model.joints[index], str(model.names[index])
    follows, ratio, shift = "", 1.0, 0.0
    shortname = str(joint.shortname())
    if shortname == _MIMIC:
        mimic = joint.extract()
        leader = model.mimicked_joints[list(model.mimicking_joints).index(index)]
        follows, ratio, shift = str(model.names[leader]), mimic.scaling, mimic.offset
        shortname = _mimicking(_screw(model, index))
    if shortname not in _KINDS or (_KINDS[shortname] == "floating" and index > 1):
        known = "revolute, continuous and prismatic joints, and a free flyer at the root,"
        raise UnsupportedJointError(f"{model.name}: joint {name!r} is a {shortname}; {known} can be represented")
    kind = _KINDS[shortname]
    limits = [-np.inf, np.inf, np.inf, np.inf]
    armature = 0.0
    if not follows and kind != "floating":
        armature = float(model.armature[joint.idx_v])
        limits[2:] = model.velocityLimit[joint.idx_v], model.effortLimit[joint.idx_v]
        if kind != "continuous":
            limits[:2] = model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q]
    if kind == "floating" and np.any(model.armature[joint.idx_v : joint.idx_v + joint.nv]):
        raise UnsupportedJointError(f"{model.name}: joint {name!r} floats and has an armature, which no rotor gives; set it to zero")
    limits = [float(x) for x in limits]
    if np.isnan(limits).any() or limits[0] > limits[1] or min(limits[2:]) < 0.0 or not 0.0 <= armature < np.inf:
        given = f"{model.name}: joint {name!r} has limits {limits} (lower, upper, velocity, effort) and armature {armature}"
        raise BadNumberError(f"{given}; lower <= upper is needed, and of the others none may be negative")
    body = model.inertias[index]
    if not (np.isfinite(body.inertia).all() and 0.0 <= body.mass < np.inf):
        raise BadNumberError(f"{model.name}: the body of joint {name!r} has mass {body.mass} or an inertia that is not finite")
    inertia = Inertia.from_matrix(body.mass, body.lever, body.inertia) if body.mass > 0.0 or np.any(body.inertia) else None
    found = pinocchio_joint(model, index, kind, (limits[0], limits[1], limits[2], limits[3]), inertia)
    return follow(found, follows, float(ratio), float(shift), armature)


def follow(joint: Joint, leader: str, ratio: float, shift: float, armature: float = 0.0) -> Joint:
    """The joint made to mimic `leader` (unless ""); the constant part of its motion moves into its placement."""
    placement = joint.placement @ joint.motion(shift) if shift != 0.0 else joint.placement
    return Joint(**{**vars(joint), "placement": placement, "follows": leader, "ratio": ratio, "armature": armature})


def pinocchio_joint(model: Any, index: int, kind: Kind, limits: tuple[float, float, float, float], inertia: Inertia | None) -> Joint:
    """Pinocchio's joint `index` (0 is the universe, hence the shift of parents by one)."""
    name = str(model.names[index])
    axis = np.zeros(3)
    if kind != "floating":
        screw = _screw(model, index)
        axis = screw[:3] if kind == "prismatic" else screw[3:]
        axis = axis / np.linalg.norm(axis)
        if str(model.joints[index].shortname()) == _MIMIC and model.joints[index].extract().scaling < 0.0:
            axis = -axis  # Pinocchio's is multiplied by the ratio
    where = f"joint {name!r}"
    placement = placement_of(model.jointPlacements[index], where)
    return Joint(name, kind, int(model.parents[index]) - 1, placement, as_vector(axis, f"axis of {where}"), *limits, inertia)


def _screw(model: Any, index: int) -> NDArray[np.float64]:
    """Of a joint with one degree of freedom: linear, angular, in the joint's frame."""
    import pinocchio

    data = model.joints[index].createData()
    model.joints[index].calc(data, pinocchio.neutral(model))
    return np.array(data.S, dtype=np.float64).reshape(6)


def _mimicking(screw: NDArray[np.float64]) -> str:
    """Kind of a mimicking joint by its screw, since Pinocchio does not show the joint inside; a ratio of 0 leaves nothing to see."""
    slides, turns = (bool(part.any()) for part in (screw[:3], screw[3:]))
    kinds = {(True, False): "JointModelPrismaticUnaligned", (False, True): "JointModelRevoluteUnaligned"}
    if not slides and not turns:
        return f"{_MIMIC} of ratio 0"
    return kinds.get((slides, turns), f"{_MIMIC} of a helix")


def placement_of(pose: Any, what: str) -> Placement:
    """Of a pinocchio.SE3."""
    return Placement(as_rotation(pose.rotation, what), as_vector(pose.translation, what))


def frames_of(model: Any, source: str) -> tuple[Frame, ...]:
    """Pinocchio's frames in its order, names made unique (see the head of this file)."""
    import pinocchio

    frames: dict[str, Frame] = {}
    for found in model.frames:
        name = str(found.name)
        frame = Frame(name, int(found.parentJoint) - 1, placement_of(found.placement, f"frame {name!r}"))
        if name in frames:
            first = frames[name]
            if (first.joint, first.placement) == (frame.joint, frame.placement):
                continue
            name += ":link" if found.type == pinocchio.FrameType.BODY else ":joint"
            if name in frames:
                raise DuplicateNameError(
                    f"{source}: frame {name!r} stands for two places; rename one of the joints and links that share a name"
                )
            frame = Frame(name, frame.joint, frame.placement)
        frames[name] = frame
    return tuple(frames.values())

