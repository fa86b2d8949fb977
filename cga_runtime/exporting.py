"""The door to the generator's exporter: a robot's kernels as a C99 library that stands alone, with functions for `casadi.external`."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from cga_runtime.errors import FolderError, RobotFileError, UnknownNameError, WrongSizeError
from cga_runtime.robot import Robot

ORDERS = (0, 1, 2)


def export_folder(
    robot: Robot,
    out: str | Path,
    frames: Sequence[str] = (),
    *,
    dynamics: bool = True,
    derivatives: int = 2,
    kernels: Sequence[str] | None = None,
    say: Callable[[str], None] = lambda line: None,
) -> dict[str, Any]:
    """Writes a library of the robot's kernels: C99 sources, header, CMake files, an example and a README. Returns its manifest.

    frames: ends of the chains, from the base (default: all tips). dynamics: also the kernels of the whole robot. derivatives: up to which
    order functions for CasADi carry them (0, 1, 2). kernels: names of those that are wanted (default: all). say: is told of each function
    and its operations. A folder that such an export made before is overwritten; others are refused.

    Raises UnknownNameError, WrongSizeError, FolderError, RobotFileError (a frame that does not move, names that would become the same).
    """
    from cga_codegen.catalogue import CHAIN_KERNELS, TREE_KERNELS
    from cga_codegen.emit.lower import LoweringError
    from cga_codegen.emit.manifest import GeneratedFolderError
    from cga_codegen.export import export_robot
    from cga_codegen.robots.model import ModelError, RobotModel

    of_chains, of_tree = ([kernel.name for kernel in table] for table in (CHAIN_KERNELS, TREE_KERNELS if dynamics else ()))
    wanted = [*of_chains, *of_tree] if kernels is None else list(kernels)
    for kind, names, known in (("frame", frames, robot.frame_names), ("kernel", wanted, [*of_chains, *of_tree])):
        for name in names:
            if name not in known:
                raise UnknownNameError(kind, name, known)
    if derivatives not in ORDERS:
        raise WrongSizeError(f"derivatives: {derivatives!r} given, 0, 1 or 2 needed")
    model = RobotModel.from_json(json.loads(robot._description))
    chosen = ([name for name in names if name in wanted] for names in (of_tree, of_chains))
    tree, chains = chosen
    try:
        return export_robot(model, Path(out), (frames or robot.tips) if chains else (), tree, say, derivatives, chains)
    except GeneratedFolderError as error:
        raise FolderError(str(error)) from error
    except (ModelError, LoweringError) as error:
        raise RobotFileError(str(error)) from error
