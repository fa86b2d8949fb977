"""Derivatives of kernels of a tree by casadi's automatic differentiation, over the same inputs (c, s and the base's motor, never q).

The chain rule through those inputs is written here: dc = -s dq, ds = c dq for a turning joint, ds = dq for a sliding one, and
dM = -1/2 M V for the motor of a floating base that moves with the twist V in its own axes (paper A, eq. 8).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import casadi

from cga_codegen.algebra.blade_types import MOTOR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels import dynamics
from cga_codegen.kernels.tree import Tree
from cga_codegen.kernels.vectors import Scalar, Vector

_TWISTS = ((0, 0, 0, 1, 0, 0), (0, 0, 0, 0, 1, 0), (0, 0, 0, 0, 0, 1), (0, 0, 1, 0, 0, 0), (0, -1, 0, 0, 0, 0), (1, 0, 0, 0, 0, 0))
"""The six twists of a base, linear first, as bivectors e12 e13 e23 e1i e2i e3i."""


def coriolis(tree: Tree, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """C(q, v), n x n, by Christoffel's symbols: half the derivative by v, by automatic differentiation. For a base that stands.

    The Coriolis force is a quadratic form in v whose symbols are symmetric, so that its derivative is 2 C.
    """
    return [0.5 * entry for entry in inverse_dynamics_by_v(tree, c, s, v)]


def inverse_dynamics_by_v(tree: Tree, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Derivative of inverse dynamics by v, n x n, by automatic differentiation."""
    still = [0] * len(tree.screws)
    rates = casadi.vertcat(*v)
    forces = tree.gathered(dynamics.newton_euler(tree, c, s, tree.rates(v), still, [0, 0, 0]))
    return _row_major(casadi.jacobian(_column(forces), rates))


def inverse_dynamics_by_q(tree: Tree, c: Vector, s: Vector, v: Vector, a: Vector, base: Vector | None = None) -> list[Scalar]:
    """Derivative of inverse dynamics by q, n x n, by automatic differentiation; of a floating base by motions in its own axes."""
    return _row_major(_by_q(tree, lambda: dynamics.inverse_dynamics(tree, c, s, v, a, base), c, s, base))


def _by_q(tree: Tree, values: Callable[[], list[Scalar]], c: Vector, s: Vector, base: Vector | None) -> Any:
    outputs = _column(values())
    by_c, by_s = casadi.jacobian(outputs, _column(c)), casadi.jacobian(outputs, _column(s))
    columns: list[Any] = []
    if tree.floating and base is not None:
        by_motor, motor = casadi.jacobian(outputs, _column(base)), Multivector(MOTOR, base)
        for twist in _TWISTS:
            rate = (motor * Multivector(TWIST, twist)).scaled(-0.5).project(MOTOR)
            columns.append(casadi.mtimes(by_motor, _column(rate.coefficients)))
    for body in tree.bodies:
        k = body.number
        if body.slides:
            columns.append(by_s[:, k])
        elif not body.floats:
            columns.append(by_s[:, k] * c[k] - by_c[:, k] * s[k])
    entries = casadi.horzcat(*columns)
    gather = casadi.DM.zeros(len(columns), tree.coordinates.nv)
    for row, (column, ratio) in enumerate(tree.coordinates.columns):
        gather[row, column] = ratio
    return casadi.mtimes(entries, casadi.sparsify(gather))


def _column(values: Vector) -> Any:
    return casadi.vertcat(*[casadi.SX(value) for value in values])


def _row_major(matrix: Any) -> list[Scalar]:
    entries: list[Scalar] = casadi.densify(matrix.T).nz[:].elements()
    return entries
