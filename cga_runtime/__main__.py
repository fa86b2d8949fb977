"""`python -m cga_runtime` and the command `cga`: the command line, or one sentence if its packages are not installed."""

from __future__ import annotations

import sys
from importlib.util import find_spec

from cga_runtime.errors import MissingExtraError


def main() -> None:
    """Entry point of the command `cga`."""
    for package in ("typer", "rich"):
        if find_spec(package) is None:
            print(f"MissingExtraError: {MissingExtraError('the command line', package, 'cli')}", file=sys.stderr)
            sys.exit(2)
    from cga_runtime.cli import main as run

    run()


if __name__ == "__main__":
    main()
