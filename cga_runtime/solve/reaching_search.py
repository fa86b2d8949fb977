"""The search of `reach`: a program solved from start after start, and what each result is measured by."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.solve.ipopt import Bounds, Program
from cga_runtime.solve.reaching_grasp import Check

STARTS = 20
TOLERANCE = 1e-6


@dataclass(frozen=True)
class Solution:
    """Joint positions that reach a target, or the best attempt.

    q: (n,), always inside the limits. success: target reached within the tolerance, grasp closed, margins kept, all measured anew.
    status: "reached", or each of target, closure and margins that q misses, and IPOPT's word for its run; where it was given elastic
    equations (see reaching_problem.py) it also succeeds at a point that misses them. residual: largest distance (m) of a moved point
    from its target; of a cooperative primitive see `reach`. iterations, starts, seconds (wall time): of all starts together;
    iterations_last: of the start that gave q.
    """

    q: Array
    success: bool
    status: str
    iterations: int
    residual: float
    seconds: float
    starts: int
    iterations_last: int


@dataclass(frozen=True)
class Search:
    """A program with its numbers, where to begin, and how results are judged: their distance from the target (m), and further checks.

    draw: one random position inside the limits.
    """

    program: Program
    parameters: Array
    bounds: Bounds
    first: Array
    draw: Callable[[np.random.Generator], Array]
    residual: Callable[[Array], float]
    more: Callable[[Array], list[Check]]

    def run(self, starts: int, seed: int, tolerance: float) -> Solution:
        """The first result that passes, or the best of `starts`."""

        def checks(q: Array) -> list[Check]:
            miss = self.residual(q)
            return [Check(miss / tolerance, f"closest result {miss:.2g} m away"), *self.more(q)]

        def violation(q: Array) -> float:
            return max(check.violation for check in checks(q))

        best = self.program.solve_from(self._starts(starts, seed), self.parameters, self.bounds, violation)
        q, miss = best.attempt.x, self.residual(best.attempt.x)
        success = best.violation <= 1.0
        if success:
            status = f"reached (IPOPT: {best.attempt.status})"
        else:
            missed = "; ".join(check.missed for check in checks(q) if not check.violation <= 1.0)
            status = f"unreachable or not found in {best.starts} starts: {missed} (IPOPT: {best.attempt.status})"
        return Solution(q, success, status, best.iterations, miss, best.seconds, best.starts, best.attempt.iterations)

    def _starts(self, count: int, seed: int) -> Iterator[Array]:
        """The first one, then random ones inside the limits, every other one half as far away: margins are kept more easily near by."""
        yield self.first
        rng = np.random.default_rng(seed)
        for k in range(count - 1):
            drawn = self.draw(rng)
            yield 0.5 * (self.first + drawn) if k % 2 == 0 else drawn
