"""Nonlinear programs solved by IPOPT through CasADi: built once, solved often, from several starts, each result judged by the caller.

min f(x, p) subject to x in [lower, upper] and g(x, p) in its bounds. Gradients, Jacobians and the Hessian of the Lagrangian are exact
(automatic differentiation of the expressions).

IPOPT refuses programs with more equations than free variables, even where the equations have a common solution. Their leading equations
g_i = 0 can be made elastic: g_i = a_i - b_i with a, b >= 0 and rho sum(a + b) + far sum((a + b)^2) added to f. The linear part makes the
penalty exact: a solution of the equations stays a solution where rho exceeds its multipliers. Where there is none, and the equations are
missed by more than rho / far, the quadratic part prevails: the result is near to one with the least sum of squares.
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
PENALTY = 1e3
"""rho, in units of f per unit of an equation."""
FAR = 1e4
"""far, in units of f per squared unit of an equation."""
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
    """What IPOPT returned from one start; `status` is its own word, e.g. Solve_Succeeded. iterations: 0 where it did not start."""

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
    """A program over SX expressions, of whose constraints the first `elastic` ones are equations made elastic.

    `solver` is the casadi.Function of nlpsol; its variables are x, a, b.
    """

    def __init__(self, name: str, variables: Any, parameters: Any, objective: Any, constraints: Any, elastic: int = 0) -> None:
        import casadi

        self._elastic = elastic
        self._equations: Any = casadi.Function("equations", [variables, parameters], [constraints[:elastic, :]]) if elastic else None
        if elastic:
            above, below = casadi.SX.sym("a", elastic), casadi.SX.sym("b", elastic)
            variables = casadi.vertcat(variables, above, below)
            constraints = casadi.vertcat(constraints[:elastic, :] - above + below, constraints[elastic:, :])
            objective += PENALTY * casadi.sum(above + below) + FAR * casadi.sumsqr(above + below)
        problem = {"x": variables, "p": parameters, "f": objective, "g": constraints}
        self.solver: Any = casadi.nlpsol(name, "ipopt", problem, OPTIONS)

    def solve(self, start: Array, parameters: Array, bounds: Bounds) -> Attempt:
        """One run from `start`; the result lies inside the bounds of the variables."""
        first = start
        if self._elastic:
            error = np.asarray(self._equations(start, parameters), dtype=np.float64).ravel()
            first = np.concatenate([start, np.maximum(error, 0.0), np.maximum(-error, 0.0)])
        found = self.solver(
            x0=first,
            p=parameters,
            lbx=np.concatenate([bounds.lower, np.zeros(2 * self._elastic)]),
            ubx=np.concatenate([bounds.upper, np.full(2 * self._elastic, np.inf)]),
            lbg=bounds.constraints_lower,
            ubg=bounds.constraints_upper,
        )
        stats = self.solver.stats()
        # CasADi leaves the count unset where IPOPT gives up before its first iteration; the record of iterations is then empty
        iterations = int(stats["iter_count"]) if stats.get("iterations", {}).get("obj") else 0
        x = np.asarray(found["x"], dtype=np.float64).ravel()[: len(start)]
        return Attempt(np.clip(x, bounds.lower, bounds.upper), str(stats["return_status"]), iterations)

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
