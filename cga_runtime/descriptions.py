"""The door to the generator's readers: robots of any source become descriptions, JSON text that the rest of the runtime stands on."""

from __future__ import annotations

import importlib.util
import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from cga_runtime.errors import MissingExtraError, RobotFileError, UnknownNameError


@dataclass(frozen=True)
class Options:
    """How a robot is read: see `load_robot`."""

    base: str = "fixed"
    lock: tuple[tuple[str, float], ...] = ()
    mimic: str = "follow"
    gravity: tuple[float, ...] | None = None
    snap: float | None = None
    ignore_constraints: bool = False

    @property
    def keeps_the_base(self) -> bool:
        """Whether a description that was already read will do."""
        return (self.base, self.mimic) == ("fixed", "follow")


DEFAULT = Options()


def read_robot(file: Path, options: Options = DEFAULT, name: str | None = None) -> str:
    """Description (JSON text) of a URDF, an MJCF, or a Denavit-Hartenberg table in JSON.

    Raises RobotFileError naming what is wrong, MissingExtraError without pinocchio or mujoco.
    """
    from cga_codegen.robots.from_dh import read_table
    from cga_codegen.robots.from_mjcf import load_mjcf
    from cga_codegen.robots.from_urdf import load_urdf
    from cga_codegen.robots.safe_xml import holds_mjcf

    def read() -> Any:
        if file.suffix.lower() == ".json":
            require_urdf_for(options, str(file))
            return read_table(file)
        if holds_mjcf(file):
            require_urdf_for(options, str(file))
            _require("mujoco", "reading an MJCF", "mujoco", "mujoco")
            return load_mjcf(file, name, ignore_constraints=options.ignore_constraints)
        require_pinocchio()
        return load_urdf(file, name, base=options.base, mimic=options.mimic)  # type: ignore[arg-type]  # checked there

    return _described(read, options)


def describe(source: Any, options: Options) -> str:
    """Description (JSON text) of a pinocchio.Model, a mujoco.MjModel, or a Denavit-Hartenberg table (a dict)."""
    from cga_codegen.robots.from_dh import load_table
    from cga_codegen.robots.from_mjcf import load_mjmodel
    from cga_codegen.robots.from_pinocchio import load_pinocchio

    compiled = partial(load_mjmodel, ignore_constraints=options.ignore_constraints)
    readers: dict[tuple[str, str], Callable[[Any], Any]]
    readers = {("pinocchio", "Model"): load_pinocchio, ("mujoco", "MjModel"): compiled, ("builtins", "dict"): load_table}
    kind = type(source)
    for (package, name), reader in readers.items():
        if kind.__name__ == name and kind.__module__.split(".")[0].removesuffix("_pywrap_default") == package:
            require_urdf_for(options, f"a {kind.__name__}")
            return _described(partial(reader, source), options)
    accepted = "a bundled name, a path, a pinocchio.Model, a mujoco.MjModel or a table (dict)"
    raise RobotFileError(f"a {kind.__module__}.{kind.__qualname__} was given; {accepted} is needed")


def require_urdf_for(options: Options, source: str) -> None:
    """Raises RobotFileError where the base or the mimicking of joints would be chosen, and not the source a URDF."""
    if not options.keeps_the_base:
        raise RobotFileError(f"{source}: base={options.base!r} and mimic={options.mimic!r} given; only the reading of a URDF has a choice")


def changed(description: str, options: Options) -> str:
    """A description with other options: locked joints, gravity, snapped placements."""
    from cga_codegen.robots.model import RobotModel

    return _described(lambda: RobotModel.from_json(json.loads(description)), options)


def _described(read: Callable[[], Any], options: Options) -> str:
    """JSON text of what `read` gives, options applied."""
    from cga_codegen.robots.model import ModelError, as_vector

    try:
        model = read()
        if options.snap is not None:
            model = model.snapped(options.snap)
        if options.lock:
            model = model.locked(dict(options.lock))
        if options.gravity is not None:
            model = replace(model, gravity=as_vector(options.gravity, "gravity"))
    except ModelError as error:
        raise RobotFileError(str(error)) from error
    return json.dumps(model.to_json(), sort_keys=True)


def bundled_files() -> dict[str, Path]:
    """The URDFs of the bundled robots by name."""
    from cga_codegen.robots.bundled import bundled_robots

    return bundled_robots()


def bundled_file(name: str) -> Path:
    """The URDF of a bundled robot (for peers that read URDFs). Raises UnknownNameError."""
    files = bundled_files()
    if name not in files:
        raise UnknownNameError("bundled robot", name, files)
    return files[name]


def _require(package: str, part: str, called: str, extra: str) -> None:
    if importlib.util.find_spec(package) is None:
        raise MissingExtraError(part, called, extra)


def require_pinocchio() -> None:
    """Raises MissingExtraError without it."""
    _require("pinocchio", "reading a URDF", "pinocchio (pip name: pin)", "urdf")
