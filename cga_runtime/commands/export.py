"""The command `cga export ROBOT -o DIR`: a robot's kernels as a C99 library that stands alone."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from cga_runtime.commands.terminal import AsJson, Base, Lock, RobotName, locks, say, show
from cga_runtime.exporting import export_folder
from cga_runtime.loading import load_robot


def export(
    robot: RobotName,
    folder: Annotated[Path, typer.Option("--out", "-o", help="Folder for the library.")],
    frame: Annotated[list[str] | None, typer.Option(help="End frame of a chain (repeat for more). Default: every tip.")] = None,
    lock: Lock = None,
    base: Base = "fixed",
    dynamics: Annotated[bool, typer.Option(help="Also kernels of the whole robot: frames, centre of mass, dynamics.")] = True,
    derivatives: Annotated[int, typer.Option(min=0, max=2, help="Highest derivative of the functions for CasADi.")] = 2,
    kernel: Annotated[list[str] | None, typer.Option(help="A kernel that is wanted (repeat for more). Default: all.")] = None,
    json_: AsJson = False,
) -> None:
    """Export a robot's kernels as a C99 library (CMake, header, example) whose functions CasADi loads too, with derivatives."""
    loaded = load_robot(robot, base=base, lock=locks(lock))
    made = export_folder(loaded, folder, frame or (), dynamics=dynamics, derivatives=derivatives, kernels=kernel, say=say)
    functions = {name: function["operations"] for name, function in made["functions"].items()}
    result = {"folder": str(folder), "library": f"cga_{made['robot']}", "functions": functions, "left_out": made["left_out"]}

    def table() -> Table:
        view = Table("function", "operations", "first derivative", "second", title=f"cga_{made['robot']} in {folder}")
        for name, operations in functions.items():
            view.add_row(name, *map(str, operations))
        return view

    show(result, json_, table)
