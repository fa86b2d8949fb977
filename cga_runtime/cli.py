"""The command `cga`. Results go to standard output (with --json as one JSON object), progress and logs to standard error.

Exit status: 0 done; 1 a solver did not succeed; 2 bad input, with one sentence saying what was given and what is accepted.
"""

from __future__ import annotations

import json
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Column, Table

from cga_runtime import __version__
from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.errors import CgaError, KernelWarning, WrongSizeError
from cga_runtime.loading import bundled_robots, load_robot
from cga_runtime.robot import Robot

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, help=__doc__)
log = Console(stderr=True)
out = Console()

AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
RobotName = Annotated[str, typer.Argument(help="A bundled robot's name or a URDF file.")]
Frames = Annotated[str, typer.Option("--frames", help="End frames of the two arms: right,left.")]
Position = Annotated[str, typer.Option("--q", help="Joint positions (rad), comma-separated: right arm, then left. Default: mid-range.")]


@contextmanager
def progress_bar(title: str) -> Iterator[Callable[[int, int], None]]:
    """A rich progress bar on standard error, as a callback (done, total)."""
    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:>3.0f}%"), TimeElapsedColumn())
    with Progress(*columns, console=log, transient=True) as bar:
        task = bar.add_task(title, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def show(result: dict[str, Any], as_json: bool, table: Callable[[], Table] | None = None) -> None:
    """Prints a result: one JSON object, or a table (default: its keys and values)."""
    if as_json:
        print(json.dumps(result, allow_nan=False))
        return
    if table is not None:
        out.print(table())
        return
    rows = Table(show_header=False)
    for key, value in result.items():
        rows.add_row(key.replace("_", " "), str(value))
    out.print(rows)


def numbers(text: str, what: str) -> list[float]:
    """Comma-separated numbers; WrongSizeError names what they were for."""
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise WrongSizeError(f"{what}: {text!r} given, numbers separated by commas needed") from None


def joint_numbers(text: str) -> list[int]:
    """Comma-separated joint numbers; WrongSizeError for anything that is not whole."""
    values = numbers(text, "--scheme")
    if not all(value.is_integer() for value in values):  # which NaN and infinity are not
        raise WrongSizeError(f"--scheme: {text!r} given, joint numbers separated by commas needed")
    return [int(value) for value in values]


def two_arms(robot: Robot, frames: str) -> ClosedChain:
    """The closed chain of two end frames, given as "right,left"."""
    names = [name.strip() for name in frames.split(",")]
    if len(names) != 2:
        raise WrongSizeError(f"--frames: {frames!r} given, two frame names separated by a comma needed")
    return ClosedChain(robot.chain(names[0]), robot.chain(names[1]))


def configuration(loop: ClosedChain, q: str) -> Any:
    """Positions from the command line, default mid-range."""
    return loop.check(numbers(q, "--q")) if q else 0.5 * (loop.lower + loop.upper)


@app.command()
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


@app.command()
def generate(
    file: Annotated[Path | None, typer.Argument(help="A URDF; without it, the kernels that the package carries.")] = None,
    folder: Annotated[Path | None, typer.Option("--out", "-o", help="Folder for the generated text.")] = None,
    frame: Annotated[list[str] | None, typer.Option(help="End frame of a chain (repeat for more). Default: every tip.")] = None,
    loop: Annotated[list[str] | None, typer.Option(help="A closed chain right,left of two end frames (repeat for more).")] = None,
    prove: Annotated[bool, typer.Option(help="First prove the laws of the algebra, exactly.")] = False,
    json_: AsJson = False,
) -> None:
    """Generate kernels (C and Python text with a manifest) for a robot, and print their operation counts."""
    from cga_runtime import workshop
    from cga_runtime.kernels import Library

    def say(line: str) -> None:
        log.print(line, highlight=False)

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
        workshop.generate_folder(file, folder, frame or [], [(pair[0], pair[1]) for pair in pairs], say)
    units = Library(folder).manifest["units"]
    result = {"folder": str(folder), "units": {path: {k: v["operations"] for k, v in u["kernels"].items()} for path, u in units.items()}}

    def table() -> Table:
        heads = (Column("unit, kernel", no_wrap=True), "operations", "before lowering", "by AD")
        view = Table(*heads, title="arithmetic operations; by AD: of CasADi's derivative instead")
        for path, unit in units.items():
            view.add_row(path)
            for name, k in unit["kernels"].items():
                ad = k.get("operations_by_differentiation", "")
                view.add_row(f"  {name}", str(k["operations"]), str(k["casadi_instructions"]), str(ad))
        return view

    show(result, json_, table)


@app.command()
def report(
    robot: RobotName = "nao",
    folder: Annotated[Path, typer.Option("--out", help="Folder for report.json and index.html.")] = Path("out/nao"),
    json_: AsJson = False,
) -> None:
    """Analyse a robot's two arms and write report.json and a self-contained index.html."""
    from cga_runtime.report.build import build_report

    with progress_bar("report") as bar:
        data = build_report(robot, folder, progress=bar)
    result = {"report": str(folder / "report.json"), "page": str(folder / "index.html"), "seconds": data["seconds"]}
    show(result, json_)


@app.command()
def mobility(robot: RobotName = "nao", q: Position = "", frames: Frames = "RHand,LHand", json_: AsJson = False) -> None:
    """Mobility and motion type of two arms that hold one object."""
    found = (loop := two_arms(load_robot(robot), frames)).mobility(configuration(loop, q))
    result = {
        "joint_mobility": found.joint_mobility,
        "object_dof": found.object_dof,
        "motion": found.motion,
        "limb_ranks": list(found.limb_ranks),
        "constraint_rank": found.constraint_rank,
        "constraint_wrenches": found.constraint_wrenches.tolist(),
    }
    show(result, json_)


@app.command()
def singularities(
    robot: RobotName = "nao",
    q: Position = "",
    kind: Annotated[str, typer.Option(help="limb, constraint or actuation.")] = "limb",
    scheme: Annotated[str, typer.Option(help="Actuated joints of kind actuation, e.g. 1,3,7,8.")] = "",
    within_limits: Annotated[bool, typer.Option(help="Search inside the joint limits only.")] = False,
    frames: Frames = "RHand,LHand",
    json_: AsJson = False,
) -> None:
    """The nearest singularity of a kind; exit status 1 if none was found."""
    loop = two_arms(load_robot(robot), frames)
    actuated = joint_numbers(scheme) if scheme else None
    found = loop.nearest_singularity(configuration(loop, q), kind, actuated, within_limits=within_limits)
    show(found.to_json(), json_)
    raise typer.Exit(0 if found.success else 1)


@app.command()
def schemes(
    robot: RobotName = "nao",
    samples: Annotated[int, typer.Option(min=1, help="Poses sampled for the statistics of mu.")] = 3000,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the sample.")] = 0,
    frames: Frames = "RHand,LHand",
    json_: AsJson = False,
) -> None:
    """The atlas of actuation schemes: class, reason, orbit, exact certificate, conditioning."""
    from cga_runtime.analysis.schemes import atlas, summary

    loop = two_arms(load_robot(robot), frames)
    with progress_bar("schemes") as bar:
        rows = atlas(loop, samples, seed, bar)

    def table() -> Table:
        view = Table("actuated", "class", "mu median", "mu 5 %", "reason")
        for row in sorted(rows, key=lambda r: -r["mu_median"]):
            view.add_row(str(row["actuated"]), row["class"], f"{row['mu_median']:.3f}", f"{row['mu_p05']:.3f}", row["reason"])
        return view

    show({**summary(rows), "table": rows}, json_, table)


@app.command(context_settings={"ignore_unknown_options": True})  # or a point that begins with a minus would be taken for one
def reach(
    point: Annotated[str, typer.Argument(help="Target point x,y,z (m) in the robot's base frame.")],
    robot: Annotated[str, typer.Option(help="A bundled robot's name or a URDF file.")] = "nao",
    frame: Annotated[str, typer.Option(help="End frame of the arm.")] = "RHand",
    start: Annotated[str, typer.Option("--q", help="Start positions (rad). Default: mid-range.")] = "",
    json_: AsJson = False,
) -> None:
    """Joint positions that bring a frame's origin to a point, inside the limits; exit status 1 if none was found."""
    from cga_runtime.elements import Point
    from cga_runtime.solve.reaching import reach as solve

    arm = load_robot(robot).chain(frame)
    found = solve(arm, Point(numbers(point, "point")), np.array(numbers(start, "--q")) if start else None)
    result = {
        "success": bool(found.success),
        "status": found.status,
        "q": found.q.tolist(),
        "joint_names": list(arm.joint_names),
        "residual": float(found.residual),
        "iterations": int(found.iterations),
        "seconds": float(found.seconds),
    }
    show(result, json_)
    raise typer.Exit(0 if found.success else 1)


@app.command()
def bench(
    folder: Annotated[Path, typer.Option("--out", help="Folder for table.md and bench.json.")] = Path("out/bench"),
    json_: AsJson = False,
) -> None:
    """Time kernels against Pinocchio through Python, in one process; values are checked before anything is timed."""
    from cga_runtime.experiments.bench import run, write

    rows = run()
    write(rows, folder)
    if json_:
        print(json.dumps(rows, allow_nan=False))
        return
    view = Table("group", "robot", "operation", "ours (ns)", "Pinocchio (ns)", "ratio", "value error")
    for r in rows:
        times = (f"{r['ours_ns']:.0f}", f"{r['peer_ns']:.0f}", f"{r['ratio']:.2f}")
        view.add_row(r["group"], r["robot"], r["operation"], *times, f"{r['value_error']:.1e}")
    out.print(view)


def _version(wanted: bool) -> None:
    if wanted:
        print(f"cga-robotics {__version__}")
        raise typer.Exit


Version = Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")]


@app.callback()
def _options(version: Version = False) -> None:
    pass


def main() -> None:
    """Entry point: named errors become one sentence on standard error and exit status 2."""
    warnings.simplefilter("once", KernelWarning)
    warnings.showwarning = lambda message, *rest, **more: log.print(
        f"warning: {message}", style="yellow", highlight=False, markup=False, soft_wrap=True
    )
    try:
        app()
    except CgaError as error:
        log.print(f"{type(error).__name__}: {error}", style="red", highlight=False, markup=False, soft_wrap=True)
        sys.exit(2)


if __name__ == "__main__":
    main()
