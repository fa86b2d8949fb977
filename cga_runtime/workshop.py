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
    CgaError,
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
    return _unit({"chain": asdict(order)}, lambda units: units.chain_unit(_chain(order)))


def loop_unit(right: ChainOrder, left: ChainOrder) -> Unit:
    """Kernels of any two chains as a closed loop."""
    return _unit({"right": asdict(right), "left": asdict(left)}, lambda units: units.loop_unit(_loop(right, left)))


def tree_unit(description: str, kernel: str) -> Unit:
    """One kernel of a whole robot."""
    return _unit({"tree": description, "kernel": kernel}, lambda units: units.tree_unit(_model(description), kernel), DegenerateError)


@dataclass(frozen=True)
class TeamOrder:
    """What defines a cooperative system: the primitive, the chains, and for each the system's coordinate of each of its own."""

    primitive: str
    chains: tuple[ChainOrder, ...]
    index: tuple[tuple[int, ...], ...]
    names: tuple[str, ...]
    kinds: tuple[str, ...]


def team_unit(order: TeamOrder) -> Unit:
    """Kernels of a cooperative system from its joint positions."""
    return _unit({"team": asdict(order)}, lambda units: units.team_unit(_team(order)))


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


def _team(order: TeamOrder) -> Any:
    from cga_codegen.kernels.cooperative import Team
    from cga_codegen.kernels.primitives import KINDS

    chains = tuple(_chain(chain) for chain in order.chains)
    name = "_".join([order.primitive, *(chain.frame for chain in order.chains)])
    return Team(name, KINDS[order.primitive], chains, order.index, order.names, order.kinds)


def _unit(key: dict[str, Any], make: Callable[[Any], Any], refusal: type[CgaError] = ChainError) -> Unit:
    """The cached unit of a key, generated now by `make` (given the generator's module of units) if it is not there or damaged; what the
    generator refuses is raised as `refusal`."""
    from cga_codegen import __version__, units
    from cga_codegen.catalogue import CHAIN_KERNELS, LOOP_KERNELS, TREE_KERNELS
    from cga_codegen.emit.lower import LoweringError
    from cga_codegen.emit.manifest import GeneratedFolderError, manifest_text, write_folder
    from cga_codegen.robots.model import ModelError

    kernels = [f"{k.name} {k.function.__module__}" for k in (*CHAIN_KERNELS, *LOOP_KERNELS, *TREE_KERNELS)]
    name = digest(json.dumps([__version__, _generator_digest(), kernels, key], sort_keys=True).encode())[:32]
    folder = cache_folder("generated") / name
    try:
        with locked(folder):
            if not _complete(folder):
                texts, record = make(units)
                operations = sum(kernel.counts.total for kernel in record.kernels)
                LOG.info("%s: %d kernels, %d operations", record.title, len(record.kernels), operations)
                with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".build-") as build:
                    write_folder(Path(build) / "fresh", texts, manifest_text(__version__, texts, [record], {}))
                    _install(Path(build) / "fresh", folder)
    except (ModelError, LoweringError) as error:
        raise refusal(str(error)) from error
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
