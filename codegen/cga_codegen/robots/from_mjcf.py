"""MJCF to `RobotModel`, through MuJoCo's own parser and compiler: its defaults, classes, angles, frames, copies and inferred inertias.

MuJoCo never opens a file: it gets the text that `mjcf_file` has checked. Meshes are not read.
"""

from __future__ import annotations

import os
import re
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from cga_codegen.robots.errors import BadNumberError, BrokenFileError, DuplicateNameError, UnsafeFileError
from cga_codegen.robots.from_mjmodel import import_mujoco
from cga_codegen.robots.from_mjmodel import load_mjmodel as load_mjmodel
from cga_codegen.robots.mjcf_file import MjcfFile, read_mjcf
from cga_codegen.robots.model import ModelError, RobotModel
from cga_codegen.robots.safe_xml import shown

MAX_BODIES = 1000
"""MuJoCo's compiler needs quadratic time in the length of a row of bodies."""
_NAMED = {
    "repeated name": DuplicateNameError,
    **dict.fromkeys(("in attribute", "does not have enough data", "has too much data"), BadNumberError),
}
"""Words in MuJoCo's messages that have an error of their own here."""
_ONE_AT_A_TIME = threading.Lock()


def load_mjcf(
    path_or_text: str | os.PathLike[str],
    name: str | None = None,
    folder: str | os.PathLike[str] | None = None,
    *,
    ignore_constraints: bool = False,
) -> RobotModel:
    """The robot of an MJCF file (or of its text), as MuJoCo compiles it; what of it is read, and how, see `load_mjmodel`.

    Files to include or attach may lie in the file's own folder and below; `folder` names another one (a text has none without it). Meshes,
    height fields and images are neither needed nor opened: a moving body whose inertia would come from a mesh needs an <inertial>, or
    compile the file with MuJoCo and give the mujoco.MjModel to `load_mjmodel`. Other shapes give inertia as in MuJoCo.

    name: the model's name, default: the file's. ignore_constraints: leave out what changes the tree's mechanism. MuJoCo's warnings are
    neither shown nor written to its log file. Raises a named child of ModelError (`cga_codegen.robots.errors`).
    """
    file = read_mjcf(path_or_text, folder)
    mujoco = import_mujoco()
    refusal: Exception | None = None
    with _quiet(mujoco) as said:
        try:
            model = _compiled(mujoco, file)
        except ModelError:
            raise
        except (ValueError, mujoco.FatalError) as error:
            refusal = error
    if any("NaN" in words for words in said):
        raise BadNumberError(f"{file.source}: a number is given as nan; finite numbers are needed")
    if refusal is not None:
        words = re.sub(r",? line \d+", "", " ".join(str(refusal).split()))  # lines of our text, not of the file
        named = next((kind for part, kind in _NAMED.items() if part in words), BrokenFileError)
        raise named(f"{file.source}: MuJoCo refuses it ({shown(words)}); an MJCF that it can compile is needed")
    return load_mjmodel(model, name or file.name, ignore_constraints=ignore_constraints, source=file.source)


def _compiled(mujoco: Any, file: MjcfFile) -> Any:
    """The MjModel, without its meshes."""
    spec = mujoco.MjSpec.from_string(file.xml, **({"include": file.models} if file.models else {}))
    if len(spec.bodies) > MAX_BODIES:
        raise UnsafeFileError(f"{file.source}: {len(spec.bodies)} bodies given, at most {MAX_BODIES} are read")
    ball = mujoco.mjtGeom.mjGEOM_SPHERE
    of_files = (mujoco.mjtGeom.mjGEOM_MESH, mujoco.mjtGeom.mjGEOM_SDF, mujoco.mjtGeom.mjGEOM_HFIELD)
    front = [(spec.worldbody, False)]  # bodies, and whether they move
    while front:
        body, moves = front.pop()
        front.extend((child, moves or len(child.joints) > 0) for child in body.bodies)
        for geom in body.geoms:
            if geom.type in of_files or geom.meshname or geom.hfieldname:
                if moves and geom.type != mujoco.mjtGeom.mjGEOM_HFIELD:
                    _refuse_inertia_of_mesh(mujoco, spec, body, geom, file.source)
                geom.type, geom.size, geom.mass, geom.density = ball, [1.0, 1.0, 1.0], 0.0, 0.0
                geom.meshname = geom.hfieldname = ""
    for site in spec.sites:
        if site.type in of_files:
            site.type, site.size = ball, [1.0, 1.0, 1.0]
            if hasattr(site, "meshname"):  # older MuJoCos have no sites of this kind
                site.meshname = ""
    return spec.compile()


def _refuse_inertia_of_mesh(mujoco: Any, spec: Any, body: Any, geom: Any, source: str) -> None:
    """A shape of a moving body counts unless the body has an <inertial>, or the shape no mass or a group that is not counted."""
    options = getattr(geom, "compiler", spec.compiler)  # an attached model may have options of its own
    low, high = options.inertiagrouprange
    massless = geom.mass == 0.0 or (np.isnan(geom.mass) and geom.density == 0.0)
    given = body.explicitinertial and options.inertiafromgeom != mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE
    if not (given or massless or not low <= geom.group <= high):
        raise BrokenFileError(
            f"{source}: the inertia of body {body.name!r} would come from mesh {geom.meshname!r}, which is not read; give the body an "
            "<inertial> (MuJoCo writes them with saveinertial), or give the compiled mujoco.MjModel"
        )


@contextmanager
def _quiet(mujoco: Any) -> Iterator[list[str]]:
    """MuJoCo's warnings go into the list, and neither to the screen nor into MUJOCO_LOG.TXT."""
    said: list[str] = []
    with _ONE_AT_A_TIME, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        before = mujoco.get_mju_user_warning()
        mujoco.set_mju_user_warning(said.append)
        try:
            yield said
        finally:
            mujoco.set_mju_user_warning(before)
