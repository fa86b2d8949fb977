"""Derivatives of gravity, bias and forward dynamics by q from those of inverse dynamics, analytically (for optimisers).

Gravity and bias are inverse dynamics without motion and without acceleration. From tau = ID(q, v, a(q, v, tau)): da/dq = -M^-1 dID/dq, at
the acceleration a. For a base that stands, where velocities are rates of q.
"""

from __future__ import annotations

from cga_codegen.kernels import dynamics, dynamics_derivatives
from cga_codegen.kernels.tree import Tree
from cga_codegen.kernels.vectors import Scalar, Vector


def gravity_by_q(tree: Tree, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of gravity by q, n x n."""
    still = [0] * tree.coordinates.nv
    return dynamics_derivatives.inverse_dynamics_by_q(tree, c, s, still, still)


def bias_by_q(tree: Tree, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Derivative of C(q, v) v + g(q) by q, n x n."""
    return dynamics_derivatives.inverse_dynamics_by_q(tree, c, s, v, [0] * tree.coordinates.nv)


def forward_dynamics_by_q(tree: Tree, c: Vector, s: Vector, v: Vector, tau: Vector) -> list[Scalar]:
    """Derivative of forward dynamics by q, n x n: -M^-1 dID/dq."""
    a = dynamics.forward_dynamics(tree, c, s, v, tau)
    return _minus_solved(tree, c, s, dynamics_derivatives.inverse_dynamics_by_q(tree, c, s, v, a))


def _minus_solved(tree: Tree, c: Vector, s: Vector, entries: Vector) -> list[Scalar]:
    """-M^-1 times a square matrix, row-major."""
    n = tree.coordinates.nv
    mass = dynamics.mass_matrix(tree, c, s)
    rows = [mass[n * i : n * i + n] for i in range(n)]
    columns = [dynamics.solved(rows, [-entries[n * i + j] for i in range(n)]) for j in range(n)]
    return [column[i] for i in range(n) for column in columns]
