"""The nonlinear programs behind `reach`: expressions of the generated kernels, built once for each kind of problem and kept.

min |q - q_ref|^2 / 2 (- w log det(S S^T), S the screws of a closed chain) subject to the joint limits and

    P(x_i(q)).s_k / l = 0              for the planes and spheres s_k that make up the target of point i (l = 0.1 m)
    10 <M_R X ~M_L>_2 = 0              the six closure equations of a grasp X: a motor is +-1 where its bivector part vanishes
    sigma_i f_i(q) sin q4_i / l >= m   limb margin of arm i, sigma_i its sign at the start
    D_a(q) / D_a(q_start) >= fraction  scheme margin: the determinant of the passive screws (paper C, section 5)

Targets, grasp, margins and reference are parameters or bounds, so that one program serves all problems of its kind.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.kernels import Unit
from cga_runtime.robot import Chain
from cga_runtime.solve.ipopt import Bounds, Program
from cga_runtime.spaces.closed_chain import LENGTH, ClosedChain

CLOSURE_SCALE = 10.0


@dataclass(frozen=True)
class Form:
    """What distinguishes programs: the kernels, the number of planes and spheres for each moved point, and the options that add expressions.

    `subject` are the moved points' chains and the closed chain, if there is one; they are equal where their kernels are.
    """

    units: tuple[Unit, ...]
    rows: tuple[int, ...]
    limb: bool = False
    scheme: tuple[int, ...] | None = None
    conditioned: bool = False
    chains: tuple[Chain, ...] = field(default=(), compare=False)
    loop: ClosedChain | None = field(default=None, compare=False)

    @property
    def n(self) -> int:
        """Number of joints."""
        return self.loop.n if self.loop is not None else sum(chain.n for chain in self.chains)


@dataclass(frozen=True)
class Margins:
    """Lower bounds of the margin constraints, and what they are relative to: the signs of the limb factors and D_a at the start."""

    limb: float | None = None
    limb_signs: tuple[float, float] = (1.0, 1.0)
    scheme: float | None = None
    determinant: float = 1.0


@dataclass(frozen=True)
class Values:
    """Numbers of one problem: dual vectors of the targets (sum of rows, 5), q_ref, and for a closed chain the grasp and the rest."""

    duals: Array
    reference: Array
    grasp: Array | None = None
    object_point: Array | None = None
    margins: Margins = Margins()
    conditioning_weight: float = 0.0

    def vector(self) -> Array:
        """The parameters in the program's order."""
        parts = [self.duals.ravel(), self.reference]
        if self.grasp is not None and self.object_point is not None:
            m = self.margins
            parts += [self.grasp, self.object_point, np.array([*m.limb_signs, m.determinant, self.conditioning_weight])]
        return np.concatenate(parts)


def bounds(form: Form, margins: Margins, lower: Array, upper: Array) -> Bounds:
    """Joint limits, equations, and margins in the program's order."""
    equations = sum(form.rows) + (6 if form.loop is not None else 0)
    least = [0.0] * equations
    least += [margins.limb, margins.limb] if margins.limb is not None else []
    least += [margins.scheme] if margins.scheme is not None else []
    greatest = np.full(len(least), np.inf)
    greatest[:equations] = 0.0
    return Bounds(lower, upper, np.array(least), greatest)


@lru_cache(maxsize=64)
def program(form: Form) -> Program:
    """The program of a form, built at its first use (tens to hundreds of milliseconds) and kept."""
    import casadi

    q, reference = casadi.SX.sym("q", form.n), casadi.SX.sym("q_ref", form.n)
    duals = casadi.SX.sym("duals", 5, sum(form.rows))
    objective = casadi.sumsqr(q - reference) / 2
    parameters = [casadi.vec(duals), reference]
    if form.loop is None:
        first = np.cumsum([0, *(chain.n for chain in form.chains)])
        points = [chain.kernel("point").symbolic(q[first[i] : first[i + 1]]) for i, chain in enumerate(form.chains)]
        constraints = [incidence(points, duals, form.rows)]
    else:
        grasp, object_point, rest = casadi.SX.sym("grasp", 8), casadi.SX.sym("object_point", 3), casadi.SX.sym("rest", 4)
        parameters += [grasp, object_point, rest]
        pose = form.loop.right.kernel("pose").symbolic(q[: form.loop.right.n])
        constraints = [incidence([pose[:3, :3] @ object_point + pose[:3, 3]], duals, form.rows)]
        constraints.append(CLOSURE_SCALE * form.loop.kernel("closure_error").symbolic(q, grasp))
        if form.limb:
            factors = form.loop.kernel("limb_factors").symbolic(q)
            constraints.append(rest[:2] * factors[:, 0] * factors[:, 1] / LENGTH)
        if form.scheme is not None:
            constraints.append(form.loop.symbolic_determinant(q, form.scheme) / rest[2])
        if form.conditioned:
            screws = form.loop.kernel("screws").symbolic(q)
            pivots, _, _ = casadi.ldl(screws @ screws.T)
            objective -= rest[3] * casadi.sum1(casadi.log(casadi.vec(pivots)))
    return Program("reach", q, casadi.vertcat(*parameters), objective, casadi.vertcat(*constraints))


def incidence(points: list[Any], duals: Any, rows: tuple[int, ...]) -> Any:
    """P.s / LENGTH for each point and each of its dual vectors (e0, e1, e2, e3, ei): s.x - s_ei - s_e0 x^2/2."""
    import casadi

    values, column = [], 0
    for x, count in zip(points, rows, strict=True):
        half_square = casadi.dot(x, x) / 2
        for k in range(column, column + count):
            values.append((casadi.dot(duals[1:4, k], x) - duals[4, k] - duals[0, k] * half_square) / LENGTH)
        column += count
    return casadi.vertcat(*values)
