"""Regenerates a folder of kernels: `python -m cga_codegen.cli generate` for the checked-in one, and the functions behind `cga generate`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from cga_codegen.algebra.signature import AlgebraError
from cga_codegen.emit.lower import LoweringError
from cga_codegen.emit.manifest import GeneratedFolderError
from cga_codegen.generate import Progress, checked_in_robots, generate
from cga_codegen.robots.model import ModelError


def prove(say: Progress) -> dict[str, int]:
    """Runs the exact proofs of the algebra's laws, naming each as it is done: law -> cases. Raises AlgebraError with a counterexample."""
    from cga_codegen.algebra import proofs

    results = proofs.prove(lambda result: say(f"proved: {result.name} ({result.cases} cases)"))
    return {result.name: result.cases for result in results}


def main(arguments: Sequence[str] | None = None) -> int:
    """`generate [-o DIR] [--prove]`; exit status 0, or 2 with one sentence."""
    parser = argparse.ArgumentParser(prog="python -m cga_codegen.cli", description="Regenerate the checked-in kernels.")
    commands = parser.add_subparsers(dest="command", required=True)
    command = commands.add_parser("generate", help="write the checked-in robots' kernels")
    command.add_argument("-o", "--out", type=Path, default=Path(__file__).parents[2] / "generated")
    command.add_argument("--prove", action="store_true", help="first prove the laws of the algebra, exactly")
    options = parser.parse_args(arguments)

    def say(line: str) -> None:
        print(line, file=sys.stderr)

    try:
        if options.prove:
            prove(say)
        generate(checked_in_robots(), options.out, say)
    except (ModelError, AlgebraError, LoweringError, GeneratedFolderError) as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        return 2
    print(f"wrote {options.out}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
