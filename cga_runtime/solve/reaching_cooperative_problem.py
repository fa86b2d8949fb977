"""The nonlinear programs behind `reach` for cooperative systems, built once for each kind of problem and kept.

min |q - q_ref|^2 / 2 (- w log manipulability) subject to the joint limits and, with l = 0.1 m,

    P(x_i(q)).s / l = 0               for the planes and spheres s on which end point i must lie
    r P(~V x V / r).s_u / l = 0       for the points x that the primitive must contain, seen from its own frame, and the planes and spheres
                                      s_u of its unit primitive; V is its similarity, r its radius (1 m of flat ones)
    kept(q) >= 0                      orientation and degeneracy margin (see reaching_degeneracy.py)

The gradients of the first rows belong to different points each, so that they are independent wherever the arms are not singular. The
controllable rows of log(~V V_d) (paper A, eq. 44) say the same as the first for a target of the system's kind. Measured on 50 targets
of each kind for Pandas around a table they are no match for them: circles take 33 iterations instead of 15, and spheres, which depend on
centre and radius alone, are never reached from a start where the four points lie in one plane (400 iterations instead of 8).
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.errors import DegenerateError
from cga_runtime.kernels import Unit
from cga_runtime.solve.ipopt import Attempt, Bounds, Program
from cga_runtime.solve.reaching_containment import Wish, unit_duals
from cga_runtime.solve.reaching_degeneracy import APART, kept, volume
from cga_runtime.spaces.closed_chain import LENGTH
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.similarity_twists import turned_back


@dataclass(frozen=True)
class CooperativeForm:
    """What tells one program from another: kernels and places of joints, how many conditions each end point has and how many points the
    primitive must contain, which options add expressions, and whether the equations are elastic (see ipopt.py).

    `system` gives the expressions; forms with the same kernels are equal.
    """

    kind: str
    fused: bool
    units: tuple[Unit, ...]
    places: tuple[tuple[int, ...], ...]
    ends: tuple[int, ...]
    through: int
    directed: bool
    guarded: bool
    spread: bool
    weighted: bool
    elastic: bool
    system: Cooperative = field(compare=False)

    @classmethod
    def of(cls, system: Cooperative, wish: Wish, margin: float, weight: float) -> CooperativeForm:
        """The form of a problem. Elastic where an arm has no more free joints than its end point has conditions, or all have not."""
        ends, through = tuple(len(s) for s in wish.ends), len(wish.through)
        places = tuple(tuple(int(j) for j in index) for index in system.joints.index)
        free = system.lower < system.upper  # IPOPT takes a joint that its limits fix out of the program
        tight = [int(free[list(place)].sum()) <= k for k, place in zip(ends, places, strict=True) if k]
        directed = wish.direction is not None
        guarded = (directed or margin > 0.0) and not wish.places_ends
        units = tuple(chain.unit for chain in system.chains)
        spread = margin > 0.0 and len(units) > 2 and not (system.about.round and (wish.same or through > 1))
        form = cls(system.kind, system.fused, units, places, ends, through, directed, guarded, spread, weight != 0.0, False, system)
        return replace(form, elastic=any(tight) or int(free.sum()) <= form.equations)

    @property
    def equations(self) -> int:
        """Number of equations, which come before the inequalities."""
        return sum(self.ends) + (self.through * len(unit_duals(self.kind)) if self.through else 0)


class FromStart(Program):
    """A program with two more parameters, which each start fixes for its run: the side of four points, and the chart of V."""

    def __init__(self, form: CooperativeForm, variables: Any, parameters: Any, objective: Any, constraints: Any) -> None:
        super().__init__("reach", variables, parameters, objective, constraints, form.equations if form.elastic else 0)
        self._system, self._equalities = form.system, np.arange(constraints.shape[0]) < form.equations

    def solve(self, start: Array, parameters: Array, bounds: Bounds) -> Attempt:
        """One run, on the side and in the chart that suit its start."""
        return super().solve(start, np.append(parameters, from_start(self._system, start)), bounds)

    def bounds(self, lower: Array, upper: Array) -> Bounds:
        """Joint limits; zero for the equations; zero at least for the inequalities."""
        return Bounds(lower, upper, np.zeros(len(self._equalities)), np.where(self._equalities, 0.0, np.inf))


def from_start(system: Cooperative, start: Array) -> Array:
    """Side of four points, and the chart of V, at a start."""
    points, about = system.points(start), system.about
    side, chart = (-1.0 if volume(points) < 0.0 else 1.0), 1.0
    if about.reference is not None:
        with suppress(DegenerateError):  # without a direction any chart will do
            chart = -1.0 if about.direction(points) @ about.reference < 0.0 else 1.0
    return np.array([side, chart])


def parameters(wish: Wish, reference: Array, margin: float, weight: float) -> Array:
    """The numbers of one problem in the program's order, but for those that each start fixes."""
    direction = np.zeros(3) if wish.direction is None else wish.direction
    return np.concatenate([reference, *(s.ravel() for s in wish.ends), wish.through.ravel(), direction, [margin, weight]])


@lru_cache(maxsize=64)
def program(form: CooperativeForm) -> FromStart:
    """The program of a form, built at first use and kept."""
    import casadi

    system, n = form.system, form.system.n
    q, reference, direction = casadi.SX.sym("q", n), casadi.SX.sym("q_ref", n), casadi.SX.sym("n", 3)
    duals, inside = casadi.SX.sym("duals", 5, sum(form.ends)), casadi.SX.sym("through", 3, form.through)
    margin, weight, side, chart = (casadi.SX.sym(name) for name in ("margin", "weight", "side", "chart"))
    points = system.casadi("points")(q)
    x = [points[i, :].T for i in range(points.shape[0])]
    conditions = iter(casadi.horzsplit(duals)) if sum(form.ends) else iter(())
    constraints = [incidence(point, next(conditions)) / LENGTH for point, count in zip(x, form.ends, strict=True) for _ in range(count)]
    if form.through:
        constraints += _through(system, q, chart, inside)
    if form.guarded:
        constraints += kept(x, direction if form.directed else None, side, margin, APART if form.spread else 0.0)
    objective = casadi.sumsqr(q - reference) / 2
    if form.weighted:
        objective -= weight * log_manipulability(system, q, chart)
    given = casadi.vertcat(reference, casadi.vec(duals), casadi.vec(inside), direction, margin, weight, side, chart)
    return FromStart(form, q, given, objective, casadi.vertcat(*constraints))


def incidence(x: Any, s: Any) -> Any:
    """P.s of a point x (3, 1) and a dual vector (e0, e1, e2, e3, ei): s.x - s_i - s_0 x^2 / 2."""
    import casadi

    return casadi.dot(s[1:4], x) - s[4] - s[0] * casadi.sumsqr(x) / 2


def _through(system: Cooperative, q: Any, chart: Any, inside: Any) -> list[Any]:
    """Conditions for points (3, p) to lie on the primitive."""
    import casadi

    parts = system._source.symbolic("parts", q, chart)
    rotor, centre, size = parts[:4].elements(), parts[4:7], parts[7]
    found = []
    for x in casadi.horzsplit(inside):
        own = casadi.vertcat(*turned_back(rotor, (x - centre).elements())) / size
        found += [size * incidence(own, casadi.DM(s)) / LENGTH for s in unit_duals(system.kind)]
    return found


def log_manipulability(system: Cooperative, q: Any, chart: Any) -> Any:
    """log sqrt(det(J J^T)) of the controllable rows of the horizontal Jacobian."""
    import casadi

    rows = system._source.symbolic("horizontal_jacobian", q, chart)[system.about.rows, :]
    return casadi.sum(casadi.log(casadi.vec(casadi.ldl(rows @ rows.T)[0]))) / 2
