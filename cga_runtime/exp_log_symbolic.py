"""Exponential and logarithm of versors as casadi.Function: the formulas of exp_log over symbols, for optimisation and control.

Derivatives of first and second order are finite and those of the functions themselves everywhere, at the identity too. At angle pi,
where log jumps, they are those of the side on which it lies.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from cga_runtime.errors import UnknownNameError
from cga_runtime.exp_log import BIVECTORS, BLADES, CHARTS, exp, log
from cga_runtime.smooth import casadi_field


def exp_function(group: str, chart: str = "split") -> Any:
    """casadi.Function bivector (k) -> versor of the group, components in canonical order. Raises UnknownNameError."""
    _known(group, chart)
    return _functions(group, chart)[0]


def log_function(group: str, chart: str = "split") -> Any:
    """casadi.Function versor -> bivector (k), components in canonical order, shortest rotation. Raises UnknownNameError."""
    _known(group, chart)
    return _functions(group, chart)[1]


@cache
def _functions(group: str, chart: str) -> tuple[Any, Any]:
    import casadi

    made = []
    for formula, name, given, result, size in (
        (exp, "exp", "bivector", "versor", len(BIVECTORS[group])),
        (log, "log", "versor", "bivector", len(BLADES[group])),
    ):
        x = casadi.SX.sym(given, size)
        y = casadi.vertcat(*formula(casadi_field(), group, casadi.vertsplit(x), chart))
        made.append(casadi.Function(f"{group}_{name}_{chart}", [x], [y], [given], [result]))
    return made[0], made[1]


def _known(group: str, chart: str) -> None:
    if group not in BLADES:
        raise UnknownNameError("group of versors", group, BLADES)
    if chart not in CHARTS:
        raise UnknownNameError("chart", chart, CHARTS)
