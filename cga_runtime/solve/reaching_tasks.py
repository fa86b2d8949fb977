"""A series of reaching problems of each kind for two arms, with what their solution took: the numbers behind the report's table.

Targets come from random configurations inside the limits, so that every problem has a solution. The search begins at mid-range, or for an
object that is held at one closed configuration.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, count
from cga_runtime.elements import Line, Plane, Point, PointPair, Sphere
from cga_runtime.solve.reaching import STARTS, Solution, middle, reach
from cga_runtime.solve.reaching_grasp import Held, hold
from cga_runtime.spaces.closed_chain import ClosedLoop
from cga_runtime.spaces.loop_walk import walk

Problem = tuple[Any, Any, Array, dict[str, Any]]
"""What is moved, the target, where the search begins, and further options of `reach`."""
Series = Callable[[np.random.Generator], Iterator[Problem]]
"""Endless problems of one task."""

GRASP_POSE = (0.6, -0.35, 0.9, 0.9, 0.2, 0.6, 0.35, -0.9, -0.9, -0.2)
"""A mirror-symmetric pose of the NAO's arms (rad), at which the hands grasp the object of the last three tasks."""
SCHEME = (1, 3, 7, 8)
"""Actuated joints of the scheme task: for the NAO the scheme with the best median conditioning."""
LIMB_MARGIN = 0.35
SCHEME_FRACTION = 0.5
SPHERE_RADII = (0.03, 0.15)
WALK = 20
"""Steps on the grasp manifold from one target to the next."""


def run_tasks(
    loop: ClosedLoop,
    tries: int = 100,
    seed: int = 0,
    progress: Callable[[str], None] = lambda line: None,
    *,
    closed_q0: ArrayLike | None = None,
    starts: int = STARTS,
    scheme: Sequence[int] = SCHEME,
    limb_margin: float = LIMB_MARGIN,
    scheme_fraction: float = SCHEME_FRACTION,
) -> dict[str, dict[str, Any]]:
    """Solves `tries` problems of each task, each from `starts` positions at most; a line to `progress` after each task.

    Tasks: point, line, plane, sphere (right arm); point_pair, both_on_line (both arms); rigid_grasp, rigid_grasp_limb_margin,
    rigid_grasp_scheme_margin (an object that the hands hold at closed_q0, by default GRASP_POSE where that is within the limits, else
    mid-range; targets come from configurations that keep the margin). The limb task is left out for arms without wrist centre.
    Values: tried, solved, solved_first_start, and of the solved problems iterations_median, iterations_max (of all starts together),
    seconds_median; None where none was solved. Raises what `reach` raises for closed_q0, scheme and margins.
    """
    tries, seed = count(tries, "tries"), count(seed, "seed")
    closed = _closed(loop) if closed_q0 is None else loop.check(closed_q0)
    results: dict[str, dict[str, Any]] = {}
    for index, (name, make) in enumerate({**_free_tasks(loop), **_held_tasks(loop, closed, scheme, limb_margin, scheme_fraction)}.items()):
        problems = make(np.random.default_rng([seed, index]))
        solutions = []
        for _ in range(tries):
            what, target, q0, options = next(problems)
            solutions.append(reach(what, target, q0, starts=starts, seed=seed, **options))
        results[name] = _summary(solutions)
        progress(f"{name}: {results[name]['solved']} of {tries} solved, {results[name]['solved_first_start']} from the first start")
    return results


def _closed(loop: ClosedLoop) -> Array:
    pose = np.array(GRASP_POSE)
    inside = loop.n == len(pose) and bool(((loop.lower <= pose) & (pose <= loop.upper)).all())
    return pose if inside else middle(loop.lower, loop.upper)


def _free_tasks(loop: ClosedLoop) -> dict[str, Series]:
    """The right arm to a primitive, and both arms to a point pair or a line."""
    arm, arms = loop.right, (loop.right, loop.left)
    q1, q2 = middle(arm.lower, arm.upper), middle(loop.lower, loop.upper)

    def sphere(x: Array, rng: np.random.Generator) -> Sphere:
        n, r = rng.normal(size=3), rng.uniform(*SPHERE_RADII)
        return Sphere.from_center_radius(x + r * n / np.linalg.norm(n), r)

    def one(make: Callable[[Array, np.random.Generator], Any]) -> Series:
        return lambda rng: ((arm, make(arm.point(arm.random(rng)), rng), q1, {}) for _ in itertools.count())

    def both(make: Callable[[Array, Array], Any]) -> Series:
        return lambda rng: ((arms, make(*(chain.point(chain.random(rng)) for chain in arms)), q2, {}) for _ in itertools.count())

    return {
        "point": one(lambda x, rng: Point(x)),
        "line": one(lambda x, rng: Line.from_point_direction(x, rng.normal(size=3))),
        "plane": one(lambda x, rng: Plane.from_point_normal(x, rng.normal(size=3))),
        "sphere": one(sphere),
        "point_pair": both(PointPair.from_points),
        "both_on_line": both(Line.from_points),
    }


def _held_tasks(loop: ClosedLoop, closed: Array, scheme: Sequence[int], limb_margin: float, scheme_fraction: float) -> dict[str, Series]:
    """The right hand's origin, as a point of an object that both hands hold, to a point."""

    def held(**options: Any) -> Series:
        def problems(rng: np.random.Generator) -> Iterator[Problem]:
            for q in closed_configurations(hold(loop, closed, **options), closed, rng):
                yield loop, Point(loop.right.point(q[: loop.right.n])), closed, options

        return problems

    tasks = {"rigid_grasp": held()}
    if "limb_factors" in loop.unit.names:
        tasks["rigid_grasp_limb_margin"] = held(limb_margin=limb_margin)
    tasks["rigid_grasp_scheme_margin"] = held(scheme_margin=(scheme, scheme_fraction))
    return tasks


def closed_configurations(held: Held, q: Array, rng: np.random.Generator) -> Iterator[Array]:
    """Configurations that hold the grasp within limits and margins, each the last such one of a random walk of WALK steps from the one
    before, the first from q, which holds it. The margins may be crossed on the way."""
    while True:
        visited = walk(held.loop, q, WALK, rng).q
        q = next((at for at in visited[::-1] if held.violation(at) <= 1.0), q)
        yield q


def _summary(solutions: Sequence[Solution]) -> dict[str, Any]:
    solved = [s for s in solutions if s.success]
    iterations = [s.iterations for s in solved]
    return {
        "solved": len(solved),
        "tried": len(solutions),
        "solved_first_start": sum(s.starts == 1 for s in solved),
        "iterations_median": float(np.median(iterations)) if solved else None,
        "iterations_max": max(iterations, default=None),
        "seconds_median": float(np.median([s.seconds for s in solved])) if solved else None,
    }
