"""A nonlinear program solved by IPOPT through CasADi: built once from symbols, then solved for many parameters and starts.

Derivatives are those of the expressions (exact Jacobian and Hessian); expressions come from the generated kernels.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

OPTIONS: Mapping[str, Any] = {
    "ipopt.tol": 1e-9,
    "ipopt.max_iter": 200,
    "ipopt.hessian_approximation": "exact",
    "ipopt.linear_solver": "mumps",
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "print_time": False,
    "error_on_fail": False,
    "show_eval_warnings": False,
}


@dataclass(frozen=True)
class IpoptResult:
    """What one call of IPOPT ended with; `status` is IPOPT's own word, `constraints` the values at x."""

    x: Array
    objective: float
    constraints: Array
    converged: bool
    status: str
    iterations: int
    seconds: float


class Ipopt:
    """min objective(x, p) subject to lower <= constraints(x, p) <= upper and bounds on x given at each call."""

    def __init__(self, name: str, x: Any, p: Any, objective: Any, constraints: Any, lower: ArrayLike, upper: ArrayLike) -> None:
        import casadi

        self.name = name
        self.lower, self.upper = np.asarray(lower, dtype=np.float64), np.asarray(upper, dtype=np.float64)
        self._solver = casadi.nlpsol("nlp", "ipopt", {"x": x, "p": p, "f": objective, "g": constraints}, dict(OPTIONS))

    def solve(self, guess: ArrayLike, parameters: ArrayLike, lower: ArrayLike, upper: ArrayLike) -> IpoptResult:
        """One solve from `guess` with bounds `lower` <= x <= `upper`. Never raises for a program that has no solution: see `converged`."""
        begin = perf_counter()
        result = self._solver(x0=guess, p=parameters, lbx=lower, ubx=upper, lbg=self.lower, ubg=self.upper)
        seconds = perf_counter() - begin
        stats = self._solver.stats()
        x = np.asarray(result["x"]).ravel()
        return IpoptResult(
            x=x,
            objective=float(result["f"]),
            constraints=np.asarray(result["g"]).ravel(),
            converged=bool(stats["success"]) and bool(np.isfinite(x).all()),
            status=str(stats["return_status"]),
            iterations=int(stats["iter_count"]),
            seconds=seconds,
        )
