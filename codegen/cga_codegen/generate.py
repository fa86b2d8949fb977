"""Assembles generated folders: the algebra's tables, what serves every robot, and the kernels of robots, with their manifest."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from cga_codegen import __version__
from cga_codegen.catalogue import TREE_KERNELS, MassError
from cga_codegen.emit.manifest import UnitRecord, manifest_text, write_folder
from cga_codegen.emit.print_products import product_files
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.kernels.primitives import KINDS
from cga_codegen.robots.bundled import bundled_robots
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import ModelError, RobotModel
from cga_codegen.units import chain_unit, cooperative_unit, hypersphere_unit, identifier, loop_unit, screws_unit, tree_unit


@dataclass(frozen=True)
class Selection:
    """Which kernels of a robot lie in a generated folder: chains to frames, closed chains of two of them, and kernels of the whole (those
    that divide by an inertia which the robot lacks are left out)."""

    chains: Sequence[str]
    loops: Sequence[tuple[str, str]] = ()
    tree: Sequence[str] = tuple(kernel.name for kernel in TREE_KERNELS)


_NAO = Selection(("RHand", "LHand"), (("RHand", "LHand"),), ())
CHECKED_IN: dict[str, Selection] = {
    "nao": _NAO,
    "nao_v32": _NAO,
    "panda": Selection(("panda_link8",)),
    "tm5_700": Selection(("flange",)),
}

Progress = Callable[[str], None]


def loop_name(right: str, left: str) -> str:
    """Name of the closed chain of two end frames."""
    return f"{right}_with_{left}"


def robot_record(model: RobotModel, selection: Selection) -> dict[str, Any]:
    """What the manifest says of a robot: its description and where its kernels are."""
    folder = f"robots/{identifier(model.name)}"
    return {
        "description": f"{folder}/robot.json",
        "chains": {chain: f"{folder}/{identifier(chain)}" for chain in selection.chains},
        "loops": {loop_name(*pair): f"{folder}/{identifier(loop_name(*pair))}" for pair in selection.loops},
        "tree": {name: f"{folder}/tree_{name}" for name in selection.tree},
    }


def _loop(model: RobotModel, right: str, left: str) -> Loop:
    loop = Loop(loop_name(right, left), model.chain(right), model.chain(left))
    if shared := sorted({joint.name for joint in loop.right.joints} & {joint.name for joint in loop.left.joints}):
        raise ModelError(f"{model.name}: the chains to {right} and {left} share joints ({', '.join(shared)}); a loop needs separate arms")
    return loop


def generate_robot(model: RobotModel, selection: Selection, say: Progress) -> tuple[dict[str, str], list[UnitRecord], dict[str, Any]]:
    """Texts, records and manifest entry of one robot. Raises ModelError for a frame that does not exist or does not move, for a pair of
    chains that share joints, and for kernels that do not exist."""
    record = robot_record(model, selection)
    files = {record["description"]: json.dumps(model.to_json(), indent=1, sort_keys=True) + "\n"}
    units: list[UnitRecord] = []
    makers: list[Callable[[], tuple[dict[str, str], UnitRecord]]] = []
    makers += [partial(chain_unit, model.chain(frame)) for frame in selection.chains]
    makers += [partial(loop_unit, _loop(model, *pair)) for pair in selection.loops]
    makers += [partial(tree_unit, model, name) for name in selection.tree]
    for make in makers:
        try:
            texts, unit = make()
        except MassError as error:
            say(f"{model.name}: left out: {error}")
            record["tree"] = {name: path for name, path in record["tree"].items() if name != error.kernel}
            continue
        say(f"{unit.title}: {len(unit.kernels)} kernels, {sum(k.counts.total for k in unit.kernels)} operations")
        if known := sorted(files.keys() & texts.keys()):
            raise ModelError(f"{model.name}: two chains or loops would be called {known[0]}; generate them into separate folders")
        files.update(texts)
        units.append(unit)
    return files, units, record


def generate(robots: Sequence[tuple[RobotModel, Selection]], folder: Path, say: Progress) -> None:
    """Writes a complete generated folder: the algebra, and the chosen kernels of the given robots."""
    files = dict(product_files())
    units, records = [], {}
    for texts, record in (screws_unit(), *(cooperative_unit(kind) for kind in KINDS.values()), hypersphere_unit()):
        files.update(texts)
        units.append(record)
    for model, selection in robots:
        texts, made, records[model.name] = generate_robot(model, selection, say)
        files.update(texts)
        units += made
    write_folder(folder, files, manifest_text(__version__, files, units, records))


def checked_in_robots() -> list[tuple[RobotModel, Selection]]:
    """The robots of CHECKED_IN, read from their bundled files."""
    return [(load_urdf(bundled_robots()[name], name=name), selection) for name, selection in CHECKED_IN.items()]
