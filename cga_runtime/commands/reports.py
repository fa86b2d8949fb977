"""Commands that write reports: the analysis of a robot's arms, and the benchmarks."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.table import Table

from cga_runtime.commands.terminal import AsJson, RobotName, out, progress_bar, show


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
