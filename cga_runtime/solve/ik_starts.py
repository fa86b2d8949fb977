"""Random restarts for inverse kinematics: targets that are not reached yet start again, several starts of one target side by side where
few are left (paper B, section VI-C, with the joint limits that its figures leave out)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import Array
from cga_runtime.robot import Chain
from cga_runtime.solve.gauss_newton import gauss_newton
from cga_runtime.solve.ik_targets import Goal
from cga_runtime.solve.levenberg_marquardt import Box, Rows, descend, search
from cga_runtime.spaces.cooperative import Cooperative

LANES = 128
"""Starts that run side by side where few targets are left: so many cost little more than one."""
DESCENT = 200
"""Downhill steps from the best start of a target that was not reached."""


@dataclass(frozen=True)
class Starts:
    """Where a search may begin: how often, from what first, how long, and what counts as reached."""

    arm: Chain | Cooperative
    box: Box
    first: Array | None
    restarts: int
    iterations: int
    tolerance: float
    rng: np.random.Generator

    def of(self, rows: Rows, begun: int) -> Array:
        """The next starts of each of the targets `rows`, of which `begun` were used: (len(rows), lanes, n)."""
        if begun == 0 and self.first is not None:
            return self.box.clip(self.first[rows])[:, None]
        lanes = min(max(1, LANES // len(rows)), self.restarts + 1 - begun)
        return self.arm.random(self.rng, (len(rows), lanes))


@dataclass(frozen=True)
class Outcome:
    """For each target of a block: q (m, n), iterations and starts (m,), and the status it has if it is not reached."""

    q: Array
    iterations: NDArray[np.intp]
    starts: NDArray[np.intp]
    status: NDArray[np.str_]


def levenberg_marquardt(goal: Goal, rows: Rows, starts: Starts) -> Outcome:
    """Search from start after start; targets that no start reaches end at the bottom of the valley of the best one."""
    q, cost = np.empty((len(rows), starts.arm.n)), np.full(len(rows), np.inf)
    iterations, used = np.zeros(len(rows), dtype=np.intp), np.zeros(len(rows), dtype=np.intp)
    left, begun = np.arange(len(rows)), 0
    while len(left) and begun <= starts.restarts:
        begin = starts.of(rows[left], begun)
        lanes = begin.shape[1]
        begin = begin.reshape(-1, starts.arm.n)
        found = search(goal.evaluate, np.repeat(rows[left], lanes), begin, starts.box, starts.tolerance, starts.iterations)
        begun += lanes
        used[left] = begun
        iterations[left] += found.iterations.reshape(-1, lanes).sum(axis=1)
        best = found.cost.reshape(-1, lanes).argmin(axis=1) + lanes * np.arange(len(left))
        better = found.cost[best] < cost[left]
        q[left[better]], cost[left[better]] = found.q[best[better]], found.cost[best[better]]
        left = left[cost[left] > starts.tolerance * starts.tolerance]
    status = np.full(len(rows), "iteration_limit")
    if len(left):
        low, stationary = descend(goal.error, rows[left], q[left], starts.box, starts.tolerance, DESCENT)
        q[left] = low.q
        iterations[left] += low.iterations
        status[left[stationary]] = "least_squares"
    return Outcome(q, iterations, used, status)


def plain_gauss_newton(goal: Goal, rows: Rows, starts: Starts) -> Outcome:
    """Gauss-Newton from one start each."""
    found, stalled = gauss_newton(goal.evaluate, rows, starts.of(rows, 0)[:, 0], starts.tolerance, starts.iterations)
    return Outcome(found.q, found.iterations, np.ones(len(rows), dtype=np.intp), np.where(stalled, "stalled", "iteration_limit"))
