"""URDF to `RobotModel`, through Pinocchio: its joint order, its frames, its merging of links that fixed joints hold together.

Meshes, materials, sensors, transmissions, damping and friction are not read.
"""

from __future__ import annotations

import os
import warnings
from typing import Any, Literal, cast

import numpy as np

from cga_codegen.robots.errors import BrokenFileError, DuplicateNameError, InertiaWarning
from cga_codegen.robots.from_pinocchio import follow, frames_of, pinocchio_joint, placement_of
from cga_codegen.robots.model import Inertia, Joint, Kind, ModelError, Placement, RobotModel, as_rotation, as_vector
from cga_codegen.robots.placement import merged
from cga_codegen.robots.urdf_file import Body, Mimic, UrdfFile, read_urdf

Base = Literal["fixed", "floating"]
ROOT = "root_joint"
"""Name of the joint of a floating base, as in Pinocchio."""
UNSOUND = 1e-6
"""How far, relative to its size, an inertia may fall short of the triangle inequality before a warning is due (files round to 3 digits)."""


def load_urdf(
    path_or_text: str | os.PathLike[str], name: str | None = None, *, base: Base = "fixed", mimic: Mimic = "follow"
) -> RobotModel:
    """The robot of a URDF file (or of its text). The root link is the base: fixed, or floating.

    Joints come in Pinocchio's order, one coordinate each; a continuous joint is an angle without limits (lower -inf, upper inf), where
    Pinocchio has a cosine and a sine. Axes are unit vectors. Inertias are those of all links that a joint carries rigidly, as in
    Pinocchio: about their common centre of mass, in the joint's frame (m, kg, kg m^2); None if the file gives no mass.

    name: the model's name, default: the file's. mimic: a mimicking joint follows its leader (whose coordinate moves both), or, with
    "independent", is read as a joint of its own. Limits of joints that follow are kept but bind nobody, as in Pinocchio.

    Warns (InertiaWarning) of inertias that no body has. Raises a named child of ModelError (`cga_codegen.robots.errors`).
    """
    if mimic not in ("follow", "independent"):
        raise ModelError(f"mimic={mimic!r} given; 'follow' or 'independent' is needed")
    file = read_urdf(path_or_text, mimic)
    if base == "floating" and file.floats:
        raise ModelError(f"{file.source}: base='floating' given, but the file has a floating joint of its own")
    if base not in ("fixed", "floating"):
        raise ModelError(f"{file.source}: base={base!r} given; 'fixed' or 'floating' is needed")
    if base == "floating" and ROOT in file.kinds:
        raise DuplicateNameError(f"{file.source}: a joint is called {ROOT!r}, which is the floating base; another name is needed")
    try:
        import pinocchio
    except ImportError:
        raise ModelError("reading a URDF needs Pinocchio, which is not installed; type `pip install 'cga-robotics[urdf]'`") from None
    try:
        root = (pinocchio.JointModelFreeFlyer(),) if base == "floating" else ()
        model = pinocchio.buildModelFromXML(file.xml, *root)
    except ValueError as error:
        raise BrokenFileError(f"{file.source}: Pinocchio refuses it ({error}); a URDF is needed") from None
    inertias = _inertias(model, file)
    joints = tuple(_joint(model, index, file, inertias.get(index)) for index in range(1, model.njoints))
    return RobotModel(name or file.name, joints, frames_of(model, file.source), file.source)


def _joint(model: Any, index: int, file: UrdfFile, inertia: Inertia | None) -> Joint:
    name = str(model.names[index])
    if name not in file.kinds:  # the free flyer that was asked for, or the file's own
        return pinocchio_joint(model, index, "floating", (-np.inf, np.inf, np.inf, np.inf), inertia)
    joint = pinocchio_joint(model, index, cast(Kind, file.kinds[name]), file.limits[name], inertia)
    leader = file.follows.get(name)
    return joint if leader is None else follow(joint, leader.joint, leader.ratio, leader.shift)


def _inertias(model: Any, file: UrdfFile) -> dict[int, Inertia]:
    """Of each joint (Pinocchio's index): the bodies it carries rigidly, merged about their common centre of mass.

    A body alone keeps the file's numbers to the last digit; model.inertias would round them (mass times lever over mass).
    """
    import pinocchio

    carried: dict[int, list[Inertia]] = {}
    for frame in model.frames:
        body = file.bodies.get(frame.name) if frame.type == pinocchio.FrameType.BODY else None
        if body is None or (body.mass == 0.0 and not any(body.tensor)):
            continue
        what = f"inertial of link {frame.name!r}"
        _warn_of_unsound(body, f"{file.source}: {what}")
        place = placement_of(frame.placement, what)
        turned = Placement(as_rotation(pinocchio.rpy.rpyToMatrix(*body.rpy), what), as_vector(body.xyz, what))
        given = Inertia(body.mass, (0.0, 0.0, 0.0), cast(Any, tuple(x + 0.0 for x in body.tensor)))
        carried.setdefault(int(frame.parentJoint), []).append(given.placed(place @ turned))
    return {joint: merged(parts) for joint, parts in carried.items()}


def _warn_of_unsound(body: Body, what: str) -> None:
    """Principal moments a <= b <= c of a body satisfy 0 <= a and c <= a + b; a body without mass has no inertia."""
    xx, xy, xz, yy, yz, zz = body.tensor
    low, middle, high = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    lack = max(-low, high - middle - low)
    if body.mass == 0.0:
        warnings.warn(f"{what}: an inertia without mass", InertiaWarning, stacklevel=2)
    elif lack > UNSOUND * high:
        moments = f"{low:.4g}, {middle:.4g}, {high:.4g}"
        warnings.warn(
            f"{what}: no body has the principal moments {moments} kg m^2 (none may exceed the sum of the others); used as given",
            InertiaWarning,
            stacklevel=2,
        )
