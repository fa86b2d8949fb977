"""URDF to `RobotModel`, through Pinocchio: its joint order, its frames, its merging of links that fixed joints hold together.

Frames are those of Pinocchio, in its order: "universe", then for each joint (moving or fixed) a frame of its name, and for each link a
frame of its name. Where a joint and a link share a name, the first in that order keeps it; if the later one lies elsewhere, it is called
"NAME:joint" or "NAME:link" (a link always coincides with its own joint, so this is rare).

Meshes, materials, sensors, transmissions, damping and friction are not read.
"""

from __future__ import annotations

import os
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from cga_codegen.robots.errors import BrokenFileError, DuplicateNameError
from cga_codegen.robots.model import Frame, Inertia, Joint, Kind, ModelError, Placement, RobotModel, as_rotation, as_vector
from cga_codegen.robots.urdf_file import Body, Limits, Mimic, read_urdf

Array = NDArray[np.float64]


def load_urdf(path_or_text: str | os.PathLike[str], name: str | None = None, *, mimic: Mimic = "refuse") -> RobotModel:
    """The robot of a URDF file (or of its text), on a fixed base: the root link is the base.

    Joints come in Pinocchio's order, one coordinate each; a continuous joint is an angle without limits (lower -inf, upper inf), where
    Pinocchio has a cosine and a sine. Axes are unit vectors. Inertias are those of all links that a joint carries rigidly, as in
    Pinocchio: about their common centre of mass, in the joint's frame (m, kg, kg m^2); None if the file gives no mass.

    name: the model's name, default: the file's. mimic: a mimicking joint is refused, or, with "independent", read as a joint of its own
    (what Pinocchio does without a word).

    Raises a named child of ModelError (`cga_codegen.robots.errors`).
    """
    file = read_urdf(path_or_text, mimic)
    try:
        import pinocchio
    except ImportError:
        raise ModelError("reading a URDF needs Pinocchio, which is not installed; type `pip install 'cga-robotics[urdf]'`") from None
    try:
        model = pinocchio.buildModelFromXML(file.xml)
    except ValueError as error:
        raise BrokenFileError(f"{file.source}: Pinocchio refuses it ({error}); a URDF is needed") from None
    inertias = _inertias(model, file.bodies)
    joints = tuple(
        _joint(model, index, file.kinds[joint], file.limits[joint], inertias.get(index))
        for index, joint in enumerate(model.names)
        if index > 0
    )
    return RobotModel(name or file.name, joints, _frames(model, file.source), file.source)


def _joint(model: Any, index: int, kind: str, limits: Limits, inertia: Inertia | None) -> Joint:
    """Pinocchio's joint `index` (0 is the universe, hence the shift by one)."""
    import pinocchio

    name = str(model.names[index])
    data = model.joints[index].createData()
    model.joints[index].calc(data, pinocchio.neutral(model))
    screw = np.asarray(data.S).reshape(6)  # linear, angular, in the joint's frame
    axis = screw[:3] if kind == "prismatic" else screw[3:]
    return Joint(
        name,
        cast(Kind, kind),
        int(model.parents[index]) - 1,
        _placement(model.jointPlacements[index], f"joint {name!r}"),
        as_vector(axis, f"axis of joint {name!r}"),
        *limits,
        inertia,
    )


def _placement(pose: Any, what: str) -> Placement:
    return Placement(as_rotation(pose.rotation, what), as_vector(pose.translation, what))


def _inertias(model: Any, bodies: dict[str, Body]) -> dict[int, Inertia]:
    """Of each joint (Pinocchio's index): the bodies it carries rigidly, merged about their common centre of mass.

    A body alone keeps the file's numbers to the last digit; model.inertias would round them (mass times lever over mass).
    """
    import pinocchio

    carried: dict[int, list[tuple[float, Array, Array]]] = {}
    for frame in model.frames:
        body = bodies.get(frame.name) if frame.type == pinocchio.FrameType.BODY else None
        if body is None or (body.mass == 0.0 and not any(body.tensor)):
            continue
        what = f"inertial of link {frame.name!r}"
        link = _placement(frame.placement, what)
        place = link @ Placement(as_rotation(pinocchio.rpy.rpyToMatrix(*body.rpy), what), as_vector(body.xyz, what))
        r, (xx, xy, xz, yy, yz, zz) = np.array(place.rotation), body.tensor
        tensor = r @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ r.T
        carried.setdefault(int(frame.parentJoint), []).append((body.mass, np.array(place.translation), tensor))
    return {joint: _merged(parts) for joint, parts in carried.items()}


def _merged(parts: list[tuple[float, Array, Array]]) -> Inertia:
    """m = sum m_i, c = sum m_i c_i / m, I = sum I_i + m_i (|d|^2 1 - d d^T) with d = c_i - c (parallel axes)."""
    mass, com, tensor = parts[0]
    if len(parts) > 1:
        mass = sum(m for m, _, _ in parts)
        com = sum((m * c for m, c, _ in parts), np.zeros(3)) / mass if mass > 0.0 else com
        tensor = np.zeros((3, 3))
        for m, c, inertia in parts:
            d = c - com
            tensor = tensor + inertia + m * (np.sum(d * d) * np.eye(3) - d[:, None] * d)
    entries = tuple(float(tensor[i, k]) + 0.0 for i, k in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)))
    return Inertia(mass, as_vector(com, "centre of mass"), cast(Any, entries))


def _frames(model: Any, source: str) -> tuple[Frame, ...]:
    import pinocchio

    frames: dict[str, Frame] = {}
    for found in model.frames:
        name = str(found.name)
        frame = Frame(name, int(found.parentJoint) - 1, _placement(found.placement, f"frame {name!r}"))
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
