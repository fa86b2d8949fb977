"""Inverse kinematics of cooperative systems on random targets that can be reached: Pandas around a table, fingers of a hand, a humanoid's
arms (paper A, section 3.7).

Targets are the primitives at positions drawn uniformly inside the joint limits; none is left out for being nearly degenerate unless it is
below LEAST. Every result is judged here by another path than the solver's: elements through the end points at q.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import dot, norm
from cga_runtime.loading import load_robot
from cga_runtime.robot import Chain
from cga_runtime.solve.cooperative_errors import Errors
from cga_runtime.solve.gauss_newton import gauss_newton
from cga_runtime.solve.inverse_kinematics import AIM, METHODS, TOLERANCE, inverse_kinematics
from cga_runtime.solve.levenberg_marquardt import Box, search
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

Array = NDArray[np.float64]

LEAST = 1e-5
"""Degeneracy (a length in m, or without unit: see Cooperative.degeneracy) below which a target is left out."""
AGREE = 1e-5
"""Largest difference (m, rad) at which the elements confirm a result: feet of lines and planes are far from the hands."""
TABLE = 0.75
"""Distance (m) of the Pandas' bases from the middle of the table."""
FLANGE, DAMPED = "panda_link8", "levenberg_marquardt"


@dataclass(frozen=True)
class Row:
    """What one system reached. skipped: targets left out as nearly degenerate; flattest: the least degeneracy among the others.

    success: the share that the solver reports and the elements confirm. iterations, starts: means over targets, of all starts of a target
    together. seconds: for all targets. worst: the largest error of what is reported as reached, in m and rad.
    """

    name: str
    joints: int
    targets: int
    skipped: int
    flattest: float
    success: float
    iterations: float
    starts: float
    seconds: float
    worst: float


def pandas_around_a_table(count: int) -> list[Chain]:
    """Chains to the flanges of `count` Pandas on a circle, each facing its middle; the first stands at the origin and looks along x."""
    robot = load_robot("panda")
    chains = [robot.chain(FLANGE)]
    for angle in 2.0 * math.pi * np.arange(1, count) / count:
        c, s = math.cos(angle), math.sin(angle)
        pose = np.array([[c, -s, 0.0, TABLE * (1.0 - c)], [s, c, 0.0, -TABLE * s], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
        chains.append(robot.chain(FLANGE, placement=pose))
    return chains


def systems() -> Iterator[tuple[str, Cooperative]]:
    """Named systems; kernels are made as they are asked for."""
    for kind, about in PRIMITIVES.items():
        yield f"panda {kind}", Cooperative(pandas_around_a_table(about.points), kind)
    hand = load_robot("leap_hand")
    fingers = [hand.chain(tip) for tip in hand.tips]
    for kind in ("circle", "sphere"):
        yield f"leap_hand {kind}", Cooperative(fingers[: PRIMITIVES[kind].points], kind)
    humanoid = load_robot("g1")
    arms = [humanoid.chain(f"{side}_rubber_hand") for side in ("left", "right")]
    for kind in ("point_pair", "line"):
        yield f"g1 {kind}", Cooperative(arms, kind)
    yield "g1 circle", Cooperative([*arms, humanoid.chain("torso_link", offset=(0.15, 0.0, 0.3))], "circle")


def measure(name: str, system: Cooperative, count: int, seed: int, **options: Any) -> Row:
    """Solves `count` random targets; options go to inverse_kinematics."""
    rng = np.random.default_rng(seed)
    q = system.random(rng, count)
    shape = system.degeneracy(q)
    kept = np.flatnonzero(shape > LEAST)
    target = system.element(q[kept])
    inverse_kinematics(system, system.element(q[kept][:1]))  # kernels are compiled
    begun = perf_counter()
    found = inverse_kinematics(system, target, rng=rng, **options)
    seconds = perf_counter() - begun
    reached = np.flatnonzero(found.success)
    q = found.q[reached]
    error = difference(system.element(q), target, reached)
    inside = ((system.lower <= q) & (q <= system.upper)).all(axis=-1)
    confirmed = (error <= AGREE) & inside
    return Row(
        name,
        system.n,
        len(kept),
        count - len(kept),
        float(shape[kept].min()),
        float(confirmed.sum() / len(kept)),
        float(found.iterations.mean()),
        float(found.starts.mean()),
        seconds,
        float(error.max(initial=0.0)),
    )


@dataclass(frozen=True)
class Form:
    """One start each, by equations of one form: whether the target was reached, iterations, the wanted radius (m; 1 of flat ones), and the
    start's radius over the wanted one, all (targets,)."""

    name: str
    success: NDArray[np.bool_]
    iterations: NDArray[np.intp]
    radius: Array
    begun: Array


def forms(system: Cooperative, count: int, seed: int) -> list[Form]:
    """The three forms of cooperative_errors from the same random starts: damped steps inside the limits, as many as a search takes; and
    last the paper's steps, up to 100 with a line search and without limits. All are judged by the error of the similarity."""
    rng = np.random.default_rng(seed)
    q, start, rows = system.random(rng, count), system.random(rng, count), np.arange(count)
    target = system.element(q)
    errors, box = Errors(system, target, (1.0, 1.0)), Box(system.lower, system.upper)
    ways = {"incidence": errors.incidence, "similarity": errors.similarity, "logarithm": errors.logarithm}
    found = {name: search(way, rows, start, box, AIM * TOLERANCE, METHODS[DAMPED].max_iterations) for name, way in ways.items()}
    found["paper"], _ = gauss_newton(errors.logarithm, rows, start, AIM * TOLERANCE, METHODS["gauss_newton"].max_iterations)
    begun = Errors(system, system.element(start), (1.0, 1.0)).radius / errors.radius
    reached = {name: norm(errors.similarity(rows, ends.q)[0]) <= TOLERANCE for name, ends in found.items()}
    return [Form(name, reached[name], ends.iterations, errors.radius, begun) for name, ends in found.items()]


def difference(one: Any, other: Any, chosen: NDArray[np.intp]) -> Array:
    """Largest of the differences of centre, radius, offset (m) and direction (rad) between elements and the chosen of others; feet of
    lines and planes are compared as they are."""
    errors = [norm(one.center - other.center[chosen])]
    for name in ("radius", "offset"):
        if hasattr(one, name):
            errors.append(np.abs(getattr(one, name) - getattr(other, name)[chosen]))
    for name in ("direction", "normal"):
        if hasattr(one, name):
            a, b = getattr(one, name), getattr(other, name)[chosen]
            errors.append(np.arctan2(norm(np.cross(a, b)), dot(a, b)))
    return np.asarray(np.max(errors, axis=0))
