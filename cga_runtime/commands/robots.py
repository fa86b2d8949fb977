"""Commands on robots: which there are, and their kernels as text."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.table import Column, Table

from cga_runtime.commands.terminal import AsJson, Base, Lock, locks, say, show
from cga_runtime.errors import WrongSizeError
from cga_runtime.loading import bundled_robots, load_robot


def robots(json_: AsJson = False) -> None:
    """List the bundled robots."""
    rows = [load_robot(name) for name in bundled_robots()]
    result = {"robots": [{"name": r.name, "joints": r.nq, "frames": list(r.frame_names), "source": r.source} for r in rows]}

    def table() -> Table:
        view = Table("robot", "joints", "source")
        for r in rows:
            view.add_row(r.name, str(r.nq), r.source)
        return view

    show(result, json_, table)


def generate(
    file: Annotated[
        Path | None, typer.Argument(help="A bundled robot, a URDF, an MJCF or a table (.json). Default: what the package carries.")
    ] = None,
    folder: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the generated text.")] = None,
    frame: Annotated[list[str] | None, typer.Option(help="End frame of a chain (repeat for more). Default: every tip.")] = None,
    loop: Annotated[list[str] | None, typer.Option(help="A closed chain right,left of two end frames (repeat for more).")] = None,
    base: Base = "fixed",
    lock: Lock = None,
    prove: Annotated[bool, typer.Option(help="First prove the laws of the algebra, exactly.")] = False,
    json_: AsJson = False,
) -> None:
    """Generate kernels (C and Python text with a manifest) for a robot, and print their operation counts."""
    from cga_runtime import workshop
    from cga_runtime.descriptions import Options, bundled_files
    from cga_runtime.kernels import Library

    proved = workshop.prove(say) if prove else None
    if folder is None:
        if proved is not None and file is None:
            show({"proved": proved}, json_)
            return
        raise WrongSizeError("generate: say where to write with -o DIR")
    if file is None:
        workshop.generate_checked_in(folder, say)
    else:
        pairs = [tuple(part.strip() for part in text.split(",")) for text in loop or []]
        if any(len(pair) != 2 for pair in pairs):
            raise WrongSizeError("--loop takes two frame names separated by a comma")
        file = bundled_files().get(str(file), file)
        options = Options(base, tuple(sorted(locks(lock).items())))
        workshop.generate_folder(file, folder, frame or [], [(pair[0], pair[1]) for pair in pairs], say, options)
    units = Library(folder).manifest["units"]
    result = {"folder": str(folder), "units": {path: {k: v["operations"] for k, v in u["kernels"].items()} for path, u in units.items()}}

    def table() -> Table:
        heads = (Column("unit, kernel", no_wrap=True), "operations", "SX instructions", "by AD")
        view = Table(*heads, title="arithmetic operations (sin and cos of the joints come on top); by AD: of CasADi's derivative instead")
        for path, unit in units.items():
            view.add_row(path)
            for name, k in unit["kernels"].items():
                ad = k.get("operations_by_differentiation", "")
                view.add_row(f"  {name}", str(k["operations"]), str(k["casadi_instructions"]), str(ad))
        return view

    show(result, json_, table)
