"""The nonlinear programs behind `reach`: expressions of the generated kernels, built once for each kind of problem and kept.

min |q - q_ref|^2 / 2 (- w log det(S S^T), S the screws of a closed chain) subject to the joint limits and

    P(x_i(q)).s_k / l = 0              for the planes and spheres s_k that make up the target of point i; l = 0.1 m
    10 <M_R X ~M_L>_2 = 0              the six closure equations of a grasp X: a motor is +-1 where its bivector part vanishes
    sigma_i f_i(q) sin q4_i / l >= m   limb margin of arm i, sigma_i its sign at q0
    D_a(q) / D_a(q0) >= fraction       scheme margin: the determinant of the passive joints' screws (paper C, section 5)

Where an arm, or a closed chain, has no more joints than equations these are made elastic (see ipopt.py): in general they have isolated
solutions or none, and IPOPT refuses programs with more equations than joints.

Targets, grasp, margins and q_ref are parameters or bounds, so that one program serves all problems of its kind.
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
from cga_runtime.solve.reaching_grasp import Held
from cga_runtime.spaces.closed_chain import LENGTH, ClosedLoop

CLOSURE_SCALE = 10.0
CLOSURE_ROWS = 6


@dataclass(frozen=True)
class Form:
    """What tells one program from another: kernels, number of planes and spheres for each moved point, options that add expressions, and
    whether the equations are elastic.

    `chains` and `loop` give the kernels; forms with the same kernels are equal.
    """

    units: tuple[Unit, ...]
    rows: tuple[int, ...]
    limb: bool
    scheme: tuple[int, ...] | None
    conditioned: bool
    elastic: bool
    chains: tuple[Chain, ...] = field(compare=False)
    loop: ClosedLoop | None = field(compare=False)

    @classmethod
    def of(cls, chains: tuple[Chain, ...], rows: tuple[int, ...], held: Held | None) -> Form:
        """The form of a problem; `chains` are the arms, of a closed chain both."""
        units = tuple(chain.unit for chain in chains)
        free = [int((chain.lower < chain.upper).sum()) for chain in chains]  # IPOPT takes a joint that its limits fix out of the program
        if held is None:
            elastic = any(joints <= k for joints, k in zip(free, rows, strict=True))
            return cls(units, rows, False, None, False, elastic, chains, None)
        options = (held.limb_margin is not None, held.scheme, held.conditioning_weight != 0.0, sum(free) <= sum(rows) + CLOSURE_ROWS)
        return cls((*units, held.loop.unit), rows, *options, chains, held.loop)

    @property
    def n(self) -> int:
        """Number of joints."""
        return sum(chain.n for chain in self.chains)

    @property
    def equations(self) -> int:
        """Number of equations, which come before the margins."""
        return sum(self.rows) + (0 if self.loop is None else CLOSURE_ROWS)


def parameters(duals: Array, reference: Array, held: Held | None) -> Array:
    """The numbers of one problem in the program's order: dual vectors of the targets (sum of rows, 5), q_ref, and how an object is held."""
    parts = [duals.ravel(), reference]
    if held is not None:
        parts += [held.grasp, held.object_point, held.limb_signs, np.array([held.determinant, held.conditioning_weight])]
    return np.concatenate(parts)


def bounds(form: Form, held: Held | None, lower: Array, upper: Array) -> Bounds:
    """Joint limits; zero for the equations; the margins, in the program's order."""
    margins: list[float] = []
    if held is not None and held.limb_margin is not None:
        margins += [held.limb_margin, held.limb_margin]
    if held is not None and held.scheme is not None:
        margins.append(held.scheme_fraction)
    least = np.array([0.0] * form.equations + margins)
    return Bounds(lower, upper, least, np.where(np.arange(len(least)) < form.equations, 0.0, np.inf))


@lru_cache(maxsize=64)
def program(form: Form) -> Program:
    """The program of a form, built at first use (a tenth of a second, more with margins) and kept."""
    import casadi

    q, reference = casadi.SX.sym("q", form.n), casadi.SX.sym("q_ref", form.n)
    duals = casadi.SX.sym("duals", 5, sum(form.rows))  # stored by columns: the rows of the numpy array
    objective = casadi.sumsqr(q - reference) / 2
    given = [casadi.vec(duals), reference]
    if form.loop is None:
        first = np.cumsum([0, *(chain.n for chain in form.chains)])
        points = [chain.kernel("point").symbolic(q[int(a) : int(b)]) for chain, a, b in zip(form.chains, first, first[1:], strict=False)]
        constraints = [_incidence(points, duals, form.rows)]
    else:
        grasp, object_point = casadi.SX.sym("grasp", 8), casadi.SX.sym("object_point", 3)
        signs, determinant, weight = casadi.SX.sym("limb_signs", 2), casadi.SX.sym("determinant"), casadi.SX.sym("weight")
        given += [grasp, object_point, signs, determinant, weight]
        pose = form.loop.right.kernel("pose").symbolic(q[: form.loop.right.n])
        constraints = [_incidence([pose[:3, :3] @ object_point + pose[:3, 3]], duals, form.rows)]
        constraints.append(CLOSURE_SCALE * form.loop.kernel("closure_error").symbolic(q, grasp))
        if form.limb:
            factors = form.loop.kernel("limb_factors").symbolic(q)
            constraints.append(signs * factors[:, 0] * factors[:, 1] / LENGTH)
        if form.scheme is not None:
            constraints.append(form.loop.symbolic_determinant(q, form.scheme) / determinant)
        if form.conditioned:
            screws = form.loop.kernel("screws").symbolic(q)
            pivots = casadi.ldl(screws @ screws.T)[0]
            objective -= weight * casadi.sum(casadi.log(casadi.vec(pivots)))
    return Program("reach", q, casadi.vertcat(*given), objective, casadi.vertcat(*constraints), form.equations if form.elastic else 0)


def _incidence(points: list[Any], duals: Any, rows: tuple[int, ...]) -> Any:
    """P.s / LENGTH for each point and its dual vectors (e0, e1, e2, e3, ei): s.x - s_i - s_0 x^2 / 2."""
    import casadi

    values: list[Any] = []
    for x, count in zip(points, rows, strict=True):
        half_square = casadi.dot(x, x) / 2
        for _ in range(count):
            s = duals[:, len(values)]
            values.append((casadi.dot(s[1:4], x) - s[4] - s[0] * half_square) / LENGTH)
    return casadi.vertcat(*values)
