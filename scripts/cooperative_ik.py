"""Inverse kinematics of cooperative systems: how many of 10^3 random targets of each kind are reached, and how fast.

    ./run shell python scripts/cooperative_ik.py [TARGETS] [SEED]

First table. reached: the share that is reached inside the joint limits. iterations, starts: means over all targets, of all starts of a
target together. flattest: the least degeneracy of a target. worst: the largest error (m, rad). Second table: the share that one start
reaches, and its mean iterations, by equations of three forms and by the paper's method; of spheres also by their radius and by that of the
start over it, targets in brackets.
"""

import sys
from collections.abc import Iterator

import numpy as np
from rich.console import Console
from rich.table import Column, Table

from cga_runtime.experiments.cooperative_ik import Form, forms, measure, systems

HEADS = ("system", "joints", "targets", "skipped", "flattest", "reached", "iterations", "starts", "us", "worst")
RADII = (0.0, 1.0, 2.0, 5.0, 20.0, np.inf)
RATIOS = (0.0, 0.1, 0.5, np.inf)
"""Between these radii (m), and ratios of the start's radius to the wanted one, spheres are counted apart."""


def main(count: int, seed: int) -> None:
    """Measures and prints both tables."""
    table = Table(*(Column(head, no_wrap=True) for head in HEADS), title=f"Cooperative inverse kinematics, seed {seed}")
    others = Table("system", "incidence", "similarity", "logarithm", "paper", title="One start each")
    for name, system in systems():
        row = measure(name, system, count, seed)
        table.add_row(
            name,
            str(row.joints),
            str(row.targets),
            str(row.skipped),
            f"{row.flattest:.1e}",
            f"{row.success:.2%}",
            f"{row.iterations:.1f}",
            f"{row.starts:.2f}",
            f"{1e6 * row.seconds / row.targets:.0f}",
            f"{row.worst:.1e}",
        )
        found = forms(system, count, seed)
        others.add_row(name, *(f"{form.success.mean():.1%} {form.iterations.mean():.1f}" for form in found))
        if system.kind == "sphere":
            for words in (*apart(found, found[0].radius, RADII, "m"), *apart(found, found[0].begun, RATIOS, "of r")):
                others.add_row(*words)
    console = Console(width=140)
    console.print(table)
    console.print(others)


def apart(found: list[Form], by: np.ndarray, bounds: tuple[float, ...], unit: str) -> Iterator[list[str]]:
    """Rows of the second table, targets between the bounds."""
    for least, most in zip(bounds, bounds[1:], strict=False):
        chosen = (by > least) & (by <= most)
        if chosen.any():
            yield [f"  {least:g} to {most:g} {unit} ({chosen.sum()})", *(f"{form.success[chosen].mean():.1%}" for form in found)]


if __name__ == "__main__":
    given = [int(word) for word in sys.argv[1:]]
    main(*given, *(1000, 101)[len(given) :])
