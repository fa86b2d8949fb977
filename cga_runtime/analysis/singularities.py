"""Singularities of two universal-spherical arms that hold one object: where they are, and how far away (paper C, section 5).

Limb singularities: f = 0 (the S-joint on axis 1) or sin q4 = 0, per arm. Constraint singularity: f = 0 in both arms, eq. (19) for arms whose
first axes are collinear. Actuation singularities of a scheme: its determinant vanishes. Distances are joint-space norms (rad); those
found by optimisation are upper bounds ("not certified").
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import atan2, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.errors import DegenerateError, SchemeError, UnknownNameError, WrongSizeError
from cga_runtime.solve.ipopt import Ipopt
from cga_runtime.spaces.closed_chain import LENGTH, ClosedChain

Array = NDArray[np.float64]

KINDS = ("limb", "constraint", "actuation")
BOX = 0.5 * pi + 0.01
"""Half-width (rad) of the box of a search without limits: it holds a zero of each limb factor, and keeps IPOPT from other branches."""
ZERO = 1e-7
"""Largest value of a factor (f in units of LENGTH) that counts as zero when a solution is checked."""


ROUNDS = 8
"""Times that a box is shrunk after sampling found the other sign inside."""


@dataclass(frozen=True)
class LimbLocus:
    """Where one arm's factor f vanishes: f = f0 cos q2 + f1 sin q2 at q2 = q2_star (the branch nearest to the limits).

    inside: whether the limits contain it. margin: distance (rad) from the limits if outside, else 0.
    """

    arm: str
    joint: str
    f0: float
    f1: float
    q2_star: float
    inside: bool
    margin: float


@dataclass(frozen=True)
class Nearest:
    """The nearest singularity found: configuration, distance (rad), which factor vanishes, and its value there."""

    success: bool
    kind: str
    factor: str
    q: Array
    distance: float
    value: float
    status: str
    within_limits: bool

    def to_json(self) -> dict[str, Any]:
        """Plain data; distance and q are null where nothing was found."""
        found = self.success
        return {
            "success": found,
            "kind": self.kind,
            "factor": self.factor,
            "q": self.q.tolist() if found else None,
            "distance": self.distance if found else None,
            "value": self.value if found else None,
            "status": self.status,
            "within_limits": self.within_limits,
            "certified": False,
        }


@dataclass(frozen=True)
class SingularityFreeBox:
    """Half-width (rad) of the largest box |q - q0| <= radius in which no zero of a scheme's determinant was found.

    Always "not certified": an upper bound from local optimisation, shrunk while random points inside have the other sign. In the last check
    `sign_changes` of `samples` points had it (0 unless shrinking failed; the radius is then an overestimate).
    """

    radius: float
    q: Array
    success: bool
    samples: int
    sign_changes: int
    certified: bool = False


def require_wrist_centres(loop: ClosedChain) -> None:
    """DegenerateError unless both arms are universal-spherical."""
    if "limb_factors" not in loop.unit.names:
        raise DegenerateError(f"{loop!r}: limb factors need two arms of five revolute joints, axes 1, 2 meeting and axes 3, 4, 5 meeting")


def limb_loci(loop: ClosedChain) -> tuple[LimbLocus, LimbLocus]:
    """q2* of both arms in closed form: q2* = atan2(-f0, f1), or that +- pi (paper C 5.1 with atan2; q2 is the robot's joint angle)."""
    require_wrist_centres(loop)
    found = []
    for arm, chain, j in ((0, loop.right, 1), (1, loop.left, loop.right.n + 1)):
        at = np.zeros((2, loop.n))
        at[1, j] = 0.5 * pi
        f0, f1 = loop.kernel("limb_factors")(at)[:, arm, 0]
        branches = [atan2(-f0, f1) + k * pi for k in (-1, 0, 1)]
        low, high = loop.lower[j], loop.upper[j]
        margin, star = min((max(float(low) - q, q - float(high), 0.0), q) for q in branches)
        found.append(LimbLocus(chain.frame, loop.joint_names[j], float(f0), float(f1), star, margin == 0.0, margin))
    return found[0], found[1]


def limb_factor_identity(loop: ClosedChain, q: ArrayLike) -> Array:
    """sqrt det(J_S^T J_S) - |f sin q4| |US| for both arms, (..., 2): zero up to rounding. J_S is the twist Jacobian about S."""
    require_wrist_centres(loop)
    q = loop.check(q)
    twists, centres, factors = loop.twists(q), loop.kernel("wrist_centres")(q), loop.kernel("limb_factors")(q)
    wrenches = loop.kernel("constraint_wrenches")(q)
    errors = []
    for arm, columns in enumerate((slice(0, loop.right.n), slice(loop.right.n, loop.n))):
        w, v = twists[..., :3, columns], twists[..., 3:, columns]
        about = np.concatenate([w, v + np.cross(w, centres[..., arm, :, None], axis=-2)], axis=-2)
        # |US|: the force through U and S has moment U x f about the origin, so U - S is (U - S).f along f
        size = _arm_length(centres[..., arm, :], wrenches[..., arm, :], twists[..., columns])
        gram = np.swapaxes(about, -1, -2) @ about
        errors.append(np.sqrt(np.maximum(np.linalg.det(gram), 0.0)) - np.abs(factors[..., arm, 0] * factors[..., arm, 1]) * size)
    return np.stack(errors, axis=-1)


def _arm_length(centre: Array, wrench: Array, twists: Array) -> Array:
    """|US| from the distance of S to the first two axes: |s2 x (S - U)| = |US| because US is perpendicular to axis 2."""
    w, v = twists[..., :3, 1], twists[..., 3:, 1]
    return np.asarray(np.linalg.norm(v + np.cross(w, centre), axis=-1))


def nearest_singularity(
    loop: ClosedChain,
    q: ArrayLike,
    kind: str = "limb",
    actuated: Sequence[int] | None = None,
    within_limits: bool = False,
    starts: int = 4,
    seed: int = 0,
) -> Nearest:
    """min |q' - q|^2 over a factor's zeros, each factor of the kind solved separately, the nearest taken.

    within_limits: search inside the joint limits, else in the box |q' - q| <= pi/2 + 0.01 per joint. The first start is q, others are
    random in the region. Raises UnknownNameError for another kind, SchemeError if kind "actuation" comes without a scheme (or another with one).
    """
    if kind not in KINDS:
        raise UnknownNameError("kind of singularity", kind, KINDS)
    if (kind == "actuation") != (actuated is not None):
        raise SchemeError(f"kind {kind!r} {'needs' if actuated is None else 'takes no'} actuated joints")
    at = _one(loop, q)
    lower, upper = (loop.lower, loop.upper) if within_limits else (at - BOX, at + BOX)
    scheme = None if actuated is None else tuple(j + 1 for j in loop.scheme(actuated)[0])
    rng = np.random.default_rng(seed)
    found = []
    for factor in _factors(loop, kind):
        problem = _nearest_problem(loop, kind, factor, scheme)
        guesses = [np.clip(at, lower, upper), *rng.uniform(lower, upper, (starts - 1, loop.n))]
        solved = [problem.solve(guess, at, lower, upper) for guess in guesses]
        good = [s for s in solved if s.converged and float(np.abs(s.constraints).max()) <= ZERO]
        if good:
            best = min(good, key=lambda s: s.objective)
            distance = float(np.linalg.norm(best.x - at))
            found.append(Nearest(True, kind, factor, best.x, distance, float(np.abs(best.constraints).max()), "found", within_limits))
    if not found:
        where = "inside the joint limits" if within_limits else f"within {BOX:.2f} rad per joint"
        return Nearest(False, kind, "", at, float("inf"), float("nan"), f"none found {where}", within_limits)
    return min(found, key=lambda n: n.distance)


def singularity_free_box(
    loop: ClosedChain, q: ArrayLike, actuated: Sequence[int], starts: int = 5, samples: int = 2000, seed: int = 0
) -> SingularityFreeBox:
    """min t subject to |q' - q|_inf <= t and D(q') = 0, from several starts; then a sampling check. Never certified."""
    at = _one(loop, q)
    scheme = tuple(j + 1 for j in loop.scheme(actuated)[0])
    problem = _box_problem(loop, scheme)
    rng = np.random.default_rng(seed)
    guesses = [np.append(at, 0.1)] + [np.append(at + rng.uniform(-0.5, 0.5, loop.n), 0.5) for _ in range(starts - 1)]
    lower, upper = np.append(at - pi, 0.0), np.append(at + pi, pi)
    solved = [problem.solve(guess, at, lower, upper) for guess in guesses]
    good = [s for s in solved if s.converged and abs(float(s.constraints[0])) <= ZERO]
    if not good:
        return SingularityFreeBox(float("nan"), at, False, 0, 0)
    best = min(good, key=lambda s: s.objective)
    sign = np.sign(loop.determinant(at, actuated))
    changes = 0
    for _ in range(ROUNDS):
        radius = float(np.abs(best.x[:-1] - at).max())
        inside = at + 0.999 * rng.uniform(-radius, radius, (samples, loop.n))
        other = inside[np.sign(loop.determinant(inside, actuated)) != sign]
        changes = len(other)
        if not changes:
            break
        # a zero lies between q0 and every such sample: the nearest one is a better start
        start = other[np.abs(other - at).max(axis=1).argmin()]
        again = problem.solve(np.append(start, np.abs(start - at).max()), at, lower, upper)
        if not again.converged or abs(float(again.constraints[0])) > ZERO or again.objective >= best.objective:
            break
        best = again
    return SingularityFreeBox(float(np.abs(best.x[:-1] - at).max()), best.x[:-1], True, samples, changes)


def _one(loop: ClosedChain, q: ArrayLike) -> Array:
    at = loop.check(q)
    if at.ndim != 1:
        raise WrongSizeError(f"one configuration of shape ({loop.n},) needed, {at.shape} given")
    return at


def _factors(loop: ClosedChain, kind: str) -> tuple[str, ...]:
    if kind == "actuation":
        return ("determinant",)
    require_wrist_centres(loop)
    return ("f right, f left",) if kind == "constraint" else ("f right", "sin q4 right", "f left", "sin q4 left")


@cache
def _nearest_problem(loop: ClosedChain, kind: str, factor: str, scheme: tuple[int, ...] | None) -> Ipopt:
    """min |q - p|^2 with the factors of `factor` zero; p is the parameter."""
    import casadi

    q, p = casadi.SX.sym("q", loop.n), casadi.SX.sym("p", loop.n)
    if scheme is not None:
        zero = loop.symbolic_determinant(q, scheme)
    else:
        limb = loop.kernel("limb_factors").symbolic(q)
        named = {"f right": limb[0, 0] / LENGTH, "sin q4 right": limb[0, 1], "f left": limb[1, 0] / LENGTH, "sin q4 left": limb[1, 1]}
        zero = casadi.vertcat(*[named[name] for name in factor.split(", ")])
    return Ipopt(f"nearest {factor}", q, p, casadi.sumsqr(q - p), zero, np.zeros(zero.numel()), np.zeros(zero.numel()))


@cache
def _box_problem(loop: ClosedChain, scheme: tuple[int, ...]) -> Ipopt:
    """min t over (q, t) with D(q) = 0 and -t <= q - p <= t."""
    import casadi

    x, p = casadi.SX.sym("x", loop.n + 1), casadi.SX.sym("p", loop.n)
    q, t = x[: loop.n], x[loop.n]
    g = casadi.vertcat(loop.symbolic_determinant(q, scheme), t - (q - p), t + (q - p))
    low = np.zeros(1 + 2 * loop.n)
    high = np.concatenate([[0.0], np.full(2 * loop.n, np.inf)])
    return Ipopt(f"box {scheme}", x, p, t, g, low, high)
