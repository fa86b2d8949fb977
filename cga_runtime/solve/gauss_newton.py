"""Gauss-Newton with a line search, without joint limits: the inverse kinematics that paper B measures (section VI-C).

A step is d = -J^+ e, shortened to d/2, d/4, ... until |e|^2 falls by at least SUFFICIENT of what its slope promises. Where no length of
the step does, the start has stalled: a local minimum, or a singularity.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import Array
from cga_runtime.solve.levenberg_marquardt import Evaluate, Found, Rows

HALVINGS = 16
"""How often a step is halved before the start counts as stalled; on the panda 10 lose two percent of the successes."""
SUFFICIENT = 1e-4
"""Armijo's fraction of the decrease that the slope promises."""
SINGULAR = 1e-10
"""Singular values of J below this fraction of the largest count as zero."""


def gauss_newton(evaluate: Evaluate, rows: Rows, q: Array, tolerance: float, iterations: int) -> tuple[Found, NDArray[np.bool_]]:
    """At most `iterations` steps from each of the starts q (m, n): where they end, and which of them stalled."""
    at, taken = q.copy(), np.zeros(len(q), dtype=np.intp)
    e, jacobian = evaluate(rows, at)
    cost = np.einsum("mk,mk->m", e, e)
    stalled = np.zeros(len(q), dtype=bool)
    for _ in range(iterations):
        live = np.flatnonzero(~stalled & (cost > tolerance * tolerance))
        if not len(live):
            break
        step = -np.einsum("mik,mk->mi", np.linalg.pinv(jacobian[live], rcond=SINGULAR), e[live])
        slope = 2.0 * np.einsum("mki,mk,mi->m", jacobian[live], e[live], step)
        length = 1.0
        taken[live] += 1
        for _ in range(HALVINGS + 1):
            trial = at[live] + length * step
            e_trial, jacobian_trial = evaluate(rows[live], trial)
            cost_trial = np.einsum("mk,mk->m", e_trial, e_trial)
            lower = cost_trial < cost[live] + SUFFICIENT * length * slope
            better = live[lower]
            at[better], e[better], jacobian[better], cost[better] = trial[lower], e_trial[lower], jacobian_trial[lower], cost_trial[lower]
            live, step, slope = live[~lower], step[~lower], slope[~lower]
            if not len(live):
                break
            length *= 0.5
        stalled[live] = True
    return Found(at, cost, taken), stalled
