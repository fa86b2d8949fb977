"""The command `cga`. Results go to standard output (with --json as one JSON object), progress and logs to standard error.

Exit status: 0 done; 1 a solver did not succeed; 2 bad input, with one sentence saying what was given and what is accepted.
"""

from __future__ import annotations

import logging
import sys
import warnings
from collections.abc import Callable
from typing import Annotated

import typer

from cga_runtime import __version__
from cga_runtime.commands.export import export
from cga_runtime.commands.loops import mobility, schemes, singularities
from cga_runtime.commands.reports import bench, report
from cga_runtime.commands.robots import generate, robots
from cga_runtime.commands.solving import ik, reach
from cga_runtime.commands.terminal import log as log
from cga_runtime.commands.terminal import say
from cga_runtime.commands.terminal import show as show
from cga_runtime.errors import CgaError, KernelWarning

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, help=__doc__)

COMMANDS: tuple[Callable[..., None], ...] = (robots, generate, export, report, mobility, singularities, schemes, bench)
WITH_NUMBERS: tuple[Callable[..., None], ...] = (reach, ik)
for command in COMMANDS:
    app.command()(command)
for command in WITH_NUMBERS:
    app.command(context_settings={"ignore_unknown_options": True})(command)  # or a point that begins with a minus would be taken for one


class _Said(logging.Handler):
    """What kernels are generated at first use, on standard error."""

    def emit(self, record: logging.LogRecord) -> None:
        say(record.getMessage())


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
    logger, said = logging.getLogger("cga_runtime"), _Said()
    logger.setLevel(logging.INFO)
    logger.addHandler(said)
    warnings.simplefilter("once", KernelWarning)
    warnings.showwarning = lambda message, *rest, **more: log.print(
        f"warning: {message}", style="yellow", highlight=False, markup=False, soft_wrap=True
    )
    try:
        app()
    except CgaError as error:
        log.print(f"{type(error).__name__}: {error}", style="red", highlight=False, markup=False, soft_wrap=True)
        sys.exit(2)
    finally:  # a process may go on after a command
        logger.removeHandler(said)


if __name__ == "__main__":
    main()
