"""What `reach` does with a cooperative system: its primitive onto, into or around a target (paper A, sections 3.6, 5.3 and 5.7).

The primitive is kept from degenerating, and every result is measured again with the chains' numpy view and elementary geometry.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cga_runtime.coordinates import Array, norm
from cga_runtime.errors import DegenerateError, WrongSizeError
from cga_runtime.solve.reaching_containment import wish
from cga_runtime.solve.reaching_cooperative_problem import CooperativeForm, parameters, program
from cga_runtime.solve.reaching_degeneracy import APART, FLOORS, degeneracy
from cga_runtime.solve.reaching_grasp import MARGIN_TOLERANCE, Check, number
from cga_runtime.solve.reaching_search import Search
from cga_runtime.spaces.cooperative import Cooperative

ASIDE = 0.05
"""How far, as a fraction of the way to a random position, a search is begun from a q0 where the end points are degenerate."""


def cooperative_search(
    system: Cooperative, target: Any, position: Array, degeneracy_margin: float | None = None, manipulability_weight: float = 0.0
) -> Search:
    """The search for joint positions near `position` (n,), which need not be inside the limits; see `reach` for the rest.

    Raises UnknownNameError (a target without meaning for the system), WrongSizeError, NotFiniteError, DegenerateError (a
    manipulability_weight where the manipulability has no bound).
    """
    goal = wish(system.about, target, system.points(position).mean(axis=0))
    count = len(system.chains)
    margin = FLOORS[count] if degeneracy_margin is None else number(degeneracy_margin, "degeneracy_margin")
    if margin < 0.0:
        raise WrongSizeError(f"degeneracy_margin: {margin:g} given, zero or more needed")
    weight = number(manipulability_weight, "manipulability_weight")
    if weight and not (goal.places_ends or (goal.same and system.kind != "plane" and degeneracy_margin)):
        raise DegenerateError(
            f"manipulability_weight: the manipulability of a {system.kind} grows without bound where it degenerates or shrinks; it needs a "
            "target of the system's kind, not a plane, and of line, circle and sphere a degeneracy_margin"
        )
    form = CooperativeForm.of(system, goal, margin, weight)
    made = program(form)

    def residual(q: Array) -> float:
        points = system.points(q)
        try:
            primitive = system.about.through(points)
        except DegenerateError:
            return np.inf
        return goal.departure(primitive, goal.target, points.mean(axis=0))

    def more(q: Array) -> list[Check]:
        if goal.places_ends and degeneracy_margin is None:
            return []  # the target alone decides
        points = system.points(q)
        measure = degeneracy(points)
        missed = f"degeneracy margin not kept: {measure:.4g}, at least {margin:g} wanted"
        found = [Check((margin - measure) / MARGIN_TOLERANCE, missed)]
        if form.spread:
            apart = float(norm(points[1] - points[0]))
            found.append(Check((APART - apart) / MARGIN_TOLERANCE, f"its first two end points are {apart:.2g} m apart, {APART:g} wanted"))
        return found

    given = parameters(goal, position, margin, weight)
    limits = made.bounds(system.lower, system.upper)
    first = _begin(system, np.clip(position, system.lower, system.upper))
    return Search(made, given, limits, first, system.random, residual, more)


def _begin(system: Cooperative, q: Array) -> Array:
    """q, or where its end points are degenerate, and conditions have no gradient, a position near by."""
    if degeneracy(system.points(q)) >= FLOORS[len(system.chains)]:
        return q
    return np.asarray(q + ASIDE * (system.random(np.random.default_rng(0)) - q))
