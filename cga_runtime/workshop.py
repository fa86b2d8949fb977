"""The door to the generator: makes kernels that are not checked in, on demand, and keeps their text in the cache.

Everything here works on plain data (a robot's description as JSON), so that the rest of the runtime does not know the generator.
"""

from __future__ import annotations

import json
import logging
import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

from cga_runtime.cache import cache_folder, digest, locked
from cga_runtime.descriptions import DEFAULT, Options, read_robot, require_pinocchio
from cga_runtime.errors import (
    CacheError,
    ChainError,
    DegenerateError,
    FolderError,
    RobotFileError,
    StaleKernelError,
)
from cga_runtime.kernels import Library, Unit, library

Say = Callable[[str], None]
LOG = logging.getLogger("cga_runtime")
"""Says what is generated at first use, and how many operations it has, before it is compiled."""


@dataclass(frozen=True)
class ChainOrder:
    """What defines a chain: the robot's description (JSON text), the end frame, and the options of `Robot.chain`."""

    description: str
    frame: str
    root: str | None
    placement: tuple[tuple[float, ...], ...] | None
    offset: tuple[float, float, float]
    tool: tuple[tuple[float, ...], ...] | None = None


def chain_unit(order: ChainOrder) -> Unit:
    """Kernels of any chain."""
    return _unit({"chain": asdict(order)}, lambda: _chain(order))


def loop_unit(right: ChainOrder, left: ChainOrder) -> Unit:
    """Kernels of any two chains as a closed loop."""
    return _unit({"right": asdict(right), "left": asdict(left)}, lambda: _loop(right, left))


def tree_unit(description: str, kernel: str) -> Unit:
    """One kernel of a whole robot."""
    return _unit({"tree": description, "kernel": kernel}, lambda: _model(description))


def chain_geometry(order: ChainOrder) -> list[tuple[bool, Any, Any, Any]]:
    """For each joint of a chain: whether it slides, rotation rows and translation of its placement, and its axis, as plain floats."""
    return [(j.kind == "prismatic", j.placement.rotation, j.placement.translation, j.axis) for j in _chain(order).joints]


def generate_folder(
    file: Path, out: Path, frames: Sequence[str], pairs: Sequence[tuple[str, str]], say: Say, options: Options = DEFAULT
) -> dict[str, Any]:
    """Behind `cga generate FILE -o DIR`: kernels of a robot, its chains (default: to every tip) and loops. Returns its record."""
    from cga_codegen.emit.lower import LoweringError
    from cga_codegen.emit.manifest import GeneratedFolderError
    from cga_codegen.generate import Selection, generate
    from cga_codegen.robots.model import ModelError

    model = _model(read_robot(file, options))
    try:
        chains = list(dict.fromkeys([*(frames or model.tips()), *(frame for pair in pairs for frame in pair)]))
        generate([(model, Selection(chains, pairs))], out, say)
    except GeneratedFolderError as error:
        raise FolderError(str(error)) from error
    except (ModelError, LoweringError) as error:
        raise RobotFileError(str(error)) from error
    record: dict[str, Any] = Library(out).manifest["robots"][model.name]
    return record


def generate_checked_in(out: Path, say: Say) -> None:
    """Behind `cga generate` without a file: the folder that the package carries, made anew."""
    from cga_codegen.emit.manifest import GeneratedFolderError
    from cga_codegen.generate import checked_in_robots, generate

    require_pinocchio()
    try:
        generate(checked_in_robots(), out, say)
    except GeneratedFolderError as error:
        raise FolderError(str(error)) from error


def prove(say: Say) -> dict[str, int]:
    """The exact proofs of the algebra's laws, each named as it is done: law -> cases."""
    from cga_codegen.cli import prove as run

    return run(say)


def _model(description: str) -> Any:
    """The generator's model of a description."""
    from cga_codegen.robots.model import RobotModel

    return RobotModel.from_json(json.loads(description))


def _chain(order: ChainOrder) -> Any:
    """The generator's chain of an order."""
    from cga_codegen.robots.model import ModelError, Placement

    model = _model(order.description)
    try:
        at = None if order.placement is None else Placement.from_matrix(order.placement)
        tool = None if order.tool is None else Placement.from_matrix(order.tool, "tool")
    except ModelError as error:
        raise DegenerateError(str(error)) from error
    try:
        return model.chain(order.frame, order.root, at, order.offset, tool=tool)
    except ModelError as error:
        raise ChainError(str(error)) from error


def _loop(right: ChainOrder, left: ChainOrder) -> Any:
    from cga_codegen.generate import loop_name
    from cga_codegen.kernels.closed_chain import Loop

    return Loop(loop_name(right.frame, left.frame), _chain(right), _chain(left))


def _unit(key: dict[str, Any], subject: Callable[[], Any]) -> Unit:
    """The cached unit of a key, generated now if it is not there or damaged."""
    from cga_codegen import __version__
    from cga_codegen.catalogue import CHAIN_KERNELS, LOOP_KERNELS, TREE_KERNELS, chain_unit, loop_unit, tree_unit
    from cga_codegen.emit.lower import LoweringError
    from cga_codegen.emit.manifest import GeneratedFolderError, manifest_text, write_folder
    from cga_codegen.robots.model import ModelError

    kernels = [f"{k.name} {k.function.__module__}" for k in (*CHAIN_KERNELS, *LOOP_KERNELS, *TREE_KERNELS)]
    name = digest(json.dumps([__version__, _generator_digest(), kernels, key], sort_keys=True).encode())[:32]
    folder = cache_folder("generated") / name
    try:
        with locked(folder):
            if not _complete(folder):
                made = subject()
                if "tree" in key:
                    texts, record = tree_unit(made, key["kernel"])
                else:
                    texts, record = loop_unit(made) if "right" in key else chain_unit(made)
                operations = sum(kernel.counts.total for kernel in record.kernels)
                LOG.info("%s: %d kernels, %d operations", record.title, len(record.kernels), operations)
                with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".build-") as build:
                    write_folder(Path(build) / "fresh", texts, manifest_text(__version__, texts, [record], {}))
                    _install(Path(build) / "fresh", folder)
    except (ModelError, LoweringError) as error:
        raise (ChainError if "tree" not in key else DegenerateError)(str(error)) from error
    except GeneratedFolderError as error:
        raise CacheError(str(error)) from error
    except OSError as error:
        raise CacheError(f"cannot write {error.filename or folder}: {error.strerror}") from error
    opened = library(folder)
    return opened.unit(next(iter(opened.manifest["units"])))


def _install(fresh: Path, folder: Path) -> None:
    """Renames a finished folder into place; what lies there is moved aside if it is damaged, and kept if another process was quicker."""
    if folder.exists() and not _complete(folder):
        os.rename(folder, fresh.with_name("damaged"))
    try:
        os.rename(fresh, folder)
    except OSError:
        if not _complete(folder):
            raise


@cache
def _generator_digest() -> str:
    """Digest of the generator's own sources: kernels kept by another version of it are not used."""
    import cga_codegen

    folder = Path(cga_codegen.__file__).parent
    return digest(b"".join(file.read_bytes() for file in sorted(folder.rglob("*.py"))))


def _complete(folder: Path) -> bool:
    """Whether a generated folder is there, holds a unit, and all its files match."""
    try:
        found = Library(folder)
        for path in found.manifest["files"]:
            found.read(path)
    except StaleKernelError:
        return False
    return bool(found.manifest["units"]) and bool(found.manifest["files"])
