"""Nonlinear programs solved by IPOPT through CasADi: built once, solved often, from several starts, each result judged by the caller.

min f(x, p) subject to x in [lower, upper] and g(x, p) in its bounds. Gradients, Jacobians and the Hessian of the Lagrangian are exact
(automatic differentiation of the expressions).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ITERATIONS = 200
"""Iterations that one start may take."""
OPTIONS: dict[str, Any] = {
    "ipopt.tol": 1e-9,
    "ipopt.max_iter": ITERATIONS,
    "ipopt.bound_relax_factor": 0.0,  # by default results lie up to 1e-8 outside, and clipping them opens a closed chain by as much
    "ipopt.linear_solver": "mumps",  # the only sparse solver in CasADi's wheels that ran everywhere
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",  # no banner
    "print_time": False,
    "show_eval_warnings": False,  # a start where an expression is not finite is IPOPT's status, not a message on the terminal
    "error_on_fail": False,
    "calc_lam_p": False,
}


@dataclass(frozen=True)
class Attempt:
    """What IPOPT returned from one start; `status` is its own word, e.g. Solve_Succeeded."""

    x: Array
    status: str
    iterations: int


@dataclass(frozen=True)
class Best:
    """The attempt with the least violation; `iterations`, `starts` and `seconds` (wall time) are those of all attempts together."""

    attempt: Attempt
    violation: float
    iterations: int
    starts: int
    seconds: float


@dataclass(frozen=True)
class Bounds:
    """Bounds of the variables and of the constraints."""

    lower: Array
    upper: Array
    constraints_lower: Array
    constraints_upper: Array


class Program:
    """A program over SX expressions. `solver` is the casadi.Function of nlpsol."""

    def __init__(self, name: str, variables: Any, parameters: Any, objective: Any, constraints: Any) -> None:
        import casadi

        problem = {"x": variables, "p": parameters, "f": objective, "g": constraints}
        self.solver: Any = casadi.nlpsol(name, "ipopt", problem, OPTIONS)

    def solve(self, start: Array, parameters: Array, bounds: Bounds) -> Attempt:
        """One run from `start`; the result lies inside the bounds of the variables."""
        found = self.solver(
            x0=start,
            p=parameters,
            lbx=bounds.lower,
            ubx=bounds.upper,
            lbg=bounds.constraints_lower,
            ubg=bounds.constraints_upper,
        )
        stats = self.solver.stats()
        x = np.clip(np.asarray(found["x"], dtype=np.float64).ravel(), bounds.lower, bounds.upper)
        return Attempt(x, str(stats["return_status"]), int(stats["iter_count"]))

    def solve_from(self, starts: Iterable[Array], parameters: Array, bounds: Bounds, violation: Callable[[Array], float]) -> Best:
        """Runs from start after start until the violation of a result, measured by the caller, is at most 1; keeps the best.

        The judgement is the caller's alone: a result is not trusted for its status, nor refused for it.
        """
        begun = time.perf_counter()
        best: tuple[float, Attempt] | None = None
        count = iterations = 0
        for start in starts:
            attempt = self.solve(start, parameters, bounds)
            measured = violation(attempt.x)
            count, iterations = count + 1, iterations + attempt.iterations
            if best is None or measured < best[0]:
                best = (measured, attempt)
            if measured <= 1.0:
                break
        assert best is not None, "the caller gives at least one start"
        return Best(best[1], best[0], iterations, count, time.perf_counter() - begun)
