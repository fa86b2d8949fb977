"""What all commands share: two consoles, progress, results as tables or JSON, and the options that several of them take."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from cga_runtime.errors import WrongSizeError

log = Console(stderr=True)
out = Console()

AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
RobotName = Annotated[str, typer.Argument(help="A bundled robot's name, or a URDF or MJCF file.")]
Base = Annotated[str, typer.Option(help="Of a URDF: fixed or floating.")]
Lock = Annotated[list[str] | None, typer.Option(help="A joint to hold, JOINT=VALUE (repeat for more; patterns: left_hip_*=0).")]


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


def say(line: str) -> None:
    """A line of progress on standard error."""
    log.print(line, highlight=False, markup=False, soft_wrap=True)


def locks(texts: list[str] | None) -> dict[str, float]:
    """Joints and values of --lock JOINT=VALUE; WrongSizeError for anything else."""
    held = {}
    for text in texts or []:
        name, _, value = text.rpartition("=")
        try:
            held[name] = float(value)
        except ValueError:
            name = ""
        if not name:
            raise WrongSizeError(f"--lock: {text!r} given, JOINT=VALUE (rad or m) needed")
    return held
