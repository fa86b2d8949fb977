"""A series of reaching problems of each kind for two arms, with what their solution took: the numbers behind the report's table.

Targets come from random configurations inside the limits, so that every problem has a solution; the search begins at one fixed position.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.elements import Line, Plane, Point, PointPair, Sphere
from cga_runtime.robot import Chain
from cga_runtime.solve.reaching import STARTS, Solution, middle, reach
from cga_runtime.solve.reaching_grasp import Held, hold
from cga_runtime.spaces.closed_chain import CLOSED, ClosedChain

Problem = tuple[Any, Any, dict[str, Any]]
"""What is moved, the target, and further options of `reach`."""

SCHEME = (1, 3, 7, 8)
"""Actuated joints of the scheme task: of two arms with five joints like the NAO's, the scheme with the best median conditioning."""
LIMB_MARGIN = 0.35
SCHEME_FRACTION = 0.5
SPHERE_RADII = (0.03, 0.15)
STEP = 0.2
"""Length of a step on the grasp manifold (rad); WALK steps lead from one target to the next."""
WALK = 20


def run_tasks(
    loop: ClosedChain,
    tries: int = 100,
    seed: int = 0,
    progress: Callable[[str], None] = lambda line: None,
    *,
    q0: Array | None = None,
    starts: int = STARTS,
    scheme: Sequence[int] = SCHEME,
    limb_margin: float = LIMB_MARGIN,
    scheme_fraction: float = SCHEME_FRACTION,
) -> dict[str, dict[str, Any]]:
    """Solves `tries` problems of each task from q0 (default: mid-range); a line to `progress` after each task.

    Tasks: point, line, plane, sphere (right arm); point_pair, both_on_line (both arms); rigid_grasp, rigid_grasp_limb_margin,
    rigid_grasp_scheme_margin (a point of the object that the hands hold at q0; targets come from configurations that keep the margin).
    The limb task is left out for arms without wrist centre. Values: tried, solved, solved_first_start, and of the solved problems
    iterations_median, iterations_max (of all starts), seconds_median; None where none was solved.
    """
    start = middle(loop.lower, loop.upper) if q0 is None else loop.check(q0)
    results: dict[str, dict[str, Any]] = {}
    for index, (name, make) in enumerate(_tasks(loop, start, tuple(scheme), limb_margin, scheme_fraction).items()):
        rng = np.random.default_rng([seed, index])
        solutions = []
        for (what, target, options), _ in zip(make(rng), range(tries), strict=False):
            first = start[: what.n] if isinstance(what, Chain) else start
            solutions.append(reach(what, target, first, starts=starts, seed=seed, **options))
        results[name] = _summary(solutions)
        progress(f"{name}: {results[name]['solved']} of {tries} solved, {results[name]['solved_first_start']} from the first start")
    return results


def _tasks(
    loop: ClosedChain, start: Array, scheme: tuple[int, ...], limb_margin: float, scheme_fraction: float
) -> dict[str, Callable[[np.random.Generator], Iterator[Problem]]]:
    """For each task an endless series of problems."""
    arm, arms = loop.right, (loop.right, loop.left)

    def points(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            yield arm, Point(arm.point(arm.random(rng))), {}

    def lines(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            yield arm, Line.from_point_direction(arm.point(arm.random(rng)), rng.normal(size=3)), {}

    def planes(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            yield arm, Plane.from_point_normal(arm.point(arm.random(rng)), rng.normal(size=3)), {}

    def spheres(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            x, n, r = arm.point(arm.random(rng)), rng.normal(size=3), rng.uniform(*SPHERE_RADII)
            yield arm, Sphere.from_center_radius(x + r * n / np.linalg.norm(n), r), {}

    def pairs(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            yield arms, PointPair.from_points(*(chain.point(chain.random(rng)) for chain in arms)), {}

    def both_on_line(rng: np.random.Generator) -> Iterator[Problem]:
        while True:
            yield arms, Line.from_points(*(chain.point(chain.random(rng)) for chain in arms)), {}

    def held(options: dict[str, Any]) -> Callable[[np.random.Generator], Iterator[Problem]]:
        def problems(rng: np.random.Generator) -> Iterator[Problem]:
            for q in _walk(hold(loop, start, **{**_HOLD, **options}), start, rng):
                yield loop, Point(loop.right.point(q[: loop.right.n])), options

        return problems

    tasks = {"point": points, "line": lines, "plane": planes, "sphere": spheres, "point_pair": pairs, "both_on_line": both_on_line}
    tasks["rigid_grasp"] = held({})
    if "limb_factors" in loop.unit.names:
        tasks["rigid_grasp_limb_margin"] = held({"limb_margin": limb_margin})
    tasks["rigid_grasp_scheme_margin"] = held({"scheme_margin": (scheme, scheme_fraction)})
    return tasks


_HOLD: dict[str, Any] = {"grasp": None, "object_point": None, "limb_margin": None, "scheme_margin": None, "conditioning_weight": 0.0}


def _walk(held: Held, q: Array, rng: np.random.Generator) -> Iterator[Array]:
    """A random walk over the configurations that hold the grasp within limits and margins: tangent steps, brought back by Newton's method.

    A step that leaves them is not taken, so that a walk cannot get stuck outside; every WALK steps the position is a sample.
    """
    loop = held.loop
    while True:
        for _ in range(WALK):
            _, _, rows = np.linalg.svd(loop.kernel("closure_jacobian")(q, held.grasp))
            free = rows[6:].T
            xi = free @ rng.normal(size=free.shape[1])
            new = q + STEP * xi / np.linalg.norm(xi)
            for _ in range(6):
                error = loop.closure_error(new, held.grasp)
                if np.abs(error).max() <= 1e-3 * CLOSED:
                    break
                new = new - np.linalg.pinv(loop.kernel("closure_jacobian")(new, held.grasp)) @ error
            if ((loop.lower <= new) & (new <= loop.upper)).all() and held.violation(new) <= 1.0:
                q = new
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
