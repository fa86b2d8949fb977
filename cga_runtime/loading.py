"""Loads robots: by bundled name, from URDF and MJCF files, from models of Pinocchio and MuJoCo, and from Denavit-Hartenberg tables."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from cga_runtime import descriptions
from cga_runtime.descriptions import Options
from cga_runtime.errors import RobotFileError, UnknownNameError, WrongSizeError
from cga_runtime.kernels import finite, generated_folder, library
from cga_runtime.robot import Robot

_ENDINGS = (".urdf", ".xml", ".mjcf", ".json")


def bundled_robots(folder: str | Path | None = None) -> list[str]:
    """Names of the robots that come with the package, or whose kernels lie in a generated folder."""
    if folder is not None:
        return sorted(library(Path(folder)).manifest["robots"])
    return sorted({*library(generated_folder()).manifest["robots"], *descriptions.bundled_files()})


def load_robot(
    source: Any,
    folder: str | Path | None = None,
    *,
    base: str = "fixed",
    lock: Mapping[str, float] | None = None,
    mimic: str = "follow",
    gravity: Sequence[float] | None = None,
    snap: float | None = None,
    ignore_constraints: bool = False,
) -> Robot:
    """A robot by bundled name, by path to a URDF or MJCF, from a pinocchio.Model or a mujoco.MjModel, from a Denavit-Hartenberg table
    (a dict, or a path to it as .json), or by name from a generated `folder` (made by `cga generate FILE -o DIR`).

    A table: {"name": "arm", "convention": "standard", "rows": [{"name": "j1", "d": 0.1, "alpha": 1.57, "lower": -2, "upper": 2}, ...]},
    keys of a row "a", "alpha", "d", "theta", or with "modified" Khalil and Kleinfinger's "gamma", "b", "alpha", "d", "theta", "r"; m and
    rad; as needed "kind" ("revolute", "prismatic", ...), "antecedent" (the row before, in a tree), "sign", "velocity", "effort".

    base: of a URDF, "fixed" or "floating"; in MJCF and models the file says. lock: joints held at a value (rad or m), by name or shell
    pattern, {"left_hip_*": 0.0}; what they carry is then carried by the joint before. mimic: "follow" (a mimicking joint has no coordinate
    of its own), or "independent". gravity: m/s^2 in the base frame, default: the file's, or (0, 0, -9.81). snap: placements this close to
    right angles become right angles, each rotation as a whole; default: none, files are taken as they are (1.5708 is not pi/2).
    ignore_constraints: of MJCF, leaves out what would close loops (connect, weld, tendons), which is refused otherwise.

    Raises UnknownNameError (listing the names), RobotFileError for what cannot be used, WrongSizeError and NotFiniteError for options that
    are no numbers, StaleKernelError for damaged kernels, MissingExtraError where Pinocchio or MuJoCo is needed and not installed.
    """
    options = replace(_options(base, lock, mimic, gravity, snap), ignore_constraints=bool(ignore_constraints))
    if isinstance(source, str) and source.lstrip().startswith("<"):
        raise RobotFileError("the text of a robot description was given; a path to its file is needed")
    if not isinstance(source, str | os.PathLike):
        return Robot(descriptions.describe(source, options))
    home = library(Path(folder) if folder is not None else generated_folder())
    known = home.manifest["robots"]
    if str(source) in known and (options.keeps_the_base or folder is not None):
        record = known[str(source)]
        description = home.read(record["description"])
        descriptions.require_urdf_for(options, str(source))
        return Robot(description, home, record) if options == Options() else Robot(descriptions.changed(description, options))
    files = descriptions.bundled_files() if folder is None else {}
    if str(source) in files:
        return Robot(descriptions.read_robot(files[str(source)], options, str(source)))
    if _names_a_file(Path(source)):
        return Robot(descriptions.read_robot(Path(source), options))
    raise UnknownNameError("robot", str(source), sorted({*known, *files}), "Or name a URDF or MJCF file")


def _options(
    base: str, lock: Mapping[str, float] | None, mimic: str, gravity: Sequence[float] | None, snap: float | None
) -> Options:
    """The options, checked."""
    for what, given, known in (("base", base, ("fixed", "floating")), ("mimic", mimic, ("follow", "independent"))):
        if given not in known:
            raise UnknownNameError(what, given, known)
    if lock is not None and not isinstance(lock, Mapping):
        raise WrongSizeError(f"lock: a {type(lock).__name__} was given, a mapping of joint names to values is needed")
    held = sorted((str(name), _numbers(value, f"lock of {name!r}", ())[0]) for name, value in (lock or {}).items())
    near = None if snap is None else _numbers(snap, "snap", ())[0]
    if near is not None and near < 0.0:
        raise WrongSizeError(f"snap: {near:g} given, zero or a positive number is needed")
    return Options(base, tuple(held), mimic, None if gravity is None else _numbers(gravity, "gravity", (3,)), near)


def _numbers(values: Any, what: str, shape: tuple[int, ...]) -> tuple[float, ...]:
    array = finite(values, what)
    if array.shape != shape:
        raise WrongSizeError(f"{what}: shape {array.shape} given, {shape} needed")
    return tuple(float(x) for x in array.ravel())


def _names_a_file(path: Path) -> bool:
    try:
        return path.suffix.lower() in _ENDINGS or path.exists()
    except (OSError, ValueError):  # too long for a file name, or a zero character in it
        return False
