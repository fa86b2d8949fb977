"""Singularities of two universal-spherical arms that hold one object: where they are, and how far away (paper C, section 5).

Limb singularities: f = 0 (the S-joint on axis 1) or sin q4 = 0, per arm. Constraint singularity: f = 0 in both arms, eq. (19) for arms
whose first axes are collinear. Actuation singularities of a scheme: its determinant vanishes. Distances are joint-space norms (rad);
those found by optimisation are upper bounds ("not certified").
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import atan2, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import count
from cga_runtime.errors import DegenerateError, SchemeError, UnknownNameError
from cga_runtime.solve.ipopt import Bounds, Program
from cga_runtime.spaces.closed_chain import LENGTH, ClosedLoop

Array = NDArray[np.float64]

KINDS = ("limb", "constraint", "actuation")
# limb factors by name: where they stand in the kernel's (arm, factor) result
FACTORS = {"f right": (0, 0), "sin q4 right": (0, 1), "f left": (1, 0), "sin q4 left": (1, 1)}
BOX = 0.5 * pi + 0.01
"""Half-width (rad) of the box of a search without limits: it holds a zero of each limb factor, and keeps IPOPT from other branches."""
ZERO = 1e-7
"""Largest value of a factor (f in units of LENGTH) that counts as zero when a solution is checked."""
PROGRAMS = 256
"""IPOPT programs kept: one for each loop and factor or scheme."""
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


def require_wrist_centres(loop: ClosedLoop) -> None:
    """DegenerateError unless both arms are universal-spherical."""
    if "limb_factors" not in loop.unit.names:
        raise DegenerateError(f"{loop!r}: limb factors need two arms of five revolute joints, axes 1, 2 meeting and axes 3, 4, 5 meeting")


def limb_loci(loop: ClosedLoop) -> tuple[LimbLocus, LimbLocus]:
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


def limb_factor_identity(loop: ClosedLoop, q: ArrayLike) -> Array:
    """sqrt det(J_S^T J_S) - |f sin q4| |US| for both arms, (..., 2): zero up to rounding. J_S is the twist Jacobian about S.

    The left side is the product of J_S's singular values: at a singularity the root of a rounded determinant would be off by 1e-10.
    """
    require_wrist_centres(loop)
    q = loop.check(q)
    twists, centres, factors = loop.twists(q), loop.kernel("wrist_centres")(q), loop.kernel("limb_factors")(q)
    errors = []
    for arm, columns in enumerate((slice(0, loop.right.n), slice(loop.right.n, loop.n))):
        w, v = twists[..., :3, columns], twists[..., 3:, columns]
        v = v + np.cross(w, centres[..., arm, :, None], axis=-2)
        volume = np.linalg.svd(np.concatenate([w, v], axis=-2), compute_uv=False).prod(axis=-1)
        # S moves with axis 2 at the speed |s2 x (S - U)| = |US|, because US is perpendicular to axis 2
        size = np.linalg.norm(v[..., 1], axis=-1)
        errors.append(volume - np.abs(factors[..., arm, 0] * factors[..., arm, 1]) * size)
    return np.stack(errors, axis=-1)


def nearest_singularity(
    loop: ClosedLoop,
    q: ArrayLike,
    kind: str = "limb",
    actuated: Sequence[int] | None = None,
    within_limits: bool = False,
    starts: int = 4,
    seed: int = 0,
) -> Nearest:
    """min |q' - q|^2 over a factor's zeros, each factor of the kind solved separately, the nearest taken.

    within_limits: search inside the joint limits, else in the box |q' - q| <= pi/2 + 0.01 per joint. The first start is q, others lie
    within 0.5 rad per joint around it. Raises UnknownNameError for another kind, SchemeError if "actuation" comes without a scheme or
    another with one, DegenerateError for arms without wrist centres, or (constraint) whose first axes are not one line.
    """
    if kind not in KINDS:
        raise UnknownNameError("kind of singularity", kind, KINDS)
    if (kind == "actuation") != (actuated is not None):
        raise SchemeError(f"kind {kind!r} {'needs' if actuated is None else 'takes no'} actuated joints")
    at = loop.check_one(q)
    lower, upper = (loop.lower, loop.upper) if within_limits else (at - BOX, at + BOX)
    scheme = None if actuated is None else tuple(j + 1 for j in loop.scheme(actuated)[0])
    rng, starts = np.random.default_rng(count(seed, "seed")), count(starts, "starts", 1)
    found = []
    for factor in _factors(loop, kind):
        zero = np.zeros(factor.count(",") + 1)
        bounds = Bounds(lower, upper, zero, zero)
        program = _nearest_program(loop, factor, scheme)
        guesses = [np.clip(at + shift, lower, upper) for shift in (np.zeros(loop.n), *_shifts(rng, starts, loop.n))]
        # q itself first: where it is singular already, and the gradient may be too, there is nothing to solve
        for solution in (guesses[0], *(program.solve(guess, at, bounds).x for guess in guesses)):
            # judged by the compiled kernels, not by the expressions that were solved
            value = float(np.abs(_values(loop, factor, scheme, solution)).max())
            if value <= ZERO:
                distance = float(np.linalg.norm(solution - at))
                found.append(Nearest(True, kind, factor, solution, distance, value, "found", within_limits))
    if not found:
        where = "inside the joint limits" if within_limits else f"within {BOX:.2f} rad per joint"
        return Nearest(False, kind, "", at, float("inf"), float("nan"), f"none found {where}", within_limits)
    return min(found, key=lambda n: n.distance)


def singularity_free_box(
    loop: ClosedLoop, q: ArrayLike, actuated: Sequence[int], starts: int = 5, samples: int = 2000, seed: int = 0
) -> SingularityFreeBox:
    """min t subject to |q' - q|_inf <= t and D(q') = 0, from several starts; then a sampling check. Never certified."""
    at = loop.check_one(q)
    scheme = tuple(j + 1 for j in loop.scheme(actuated)[0])
    program = _box_program(loop, scheme)
    zero = np.zeros(1 + 2 * loop.n)
    bounds = Bounds(
        np.append(at - pi, 0.0), np.append(at + pi, pi), zero, np.concatenate([[0.0], np.full(2 * loop.n, np.inf)])
    )
    rng, starts, samples = np.random.default_rng(count(seed, "seed")), count(starts, "starts", 1), count(samples, "samples", 1)

    def singular(x: Array) -> bool:
        return abs(float(loop.determinant(x, scheme))) <= ZERO

    def solve(start: Array) -> Array | None:
        """A zero of the determinant near q in the largest norm, or None."""
        x = program.solve(np.append(start, np.abs(start - at).max() + 0.1), at, bounds).x[:-1]
        return x if singular(x) else None

    def radius(x: Array) -> float:
        return float(np.abs(x - at).max())

    if singular(at):
        return SingularityFreeBox(0.0, at, True, 0, 0)
    solved = [solve(at), *(solve(at + shift) for shift in _shifts(rng, starts, loop.n))]
    good = [x for x in solved if x is not None]
    if not good:
        return SingularityFreeBox(float("nan"), at, False, 0, 0)
    best = min(good, key=radius)
    sign = np.sign(loop.determinant(at, scheme))
    changes = 0
    for _ in range(ROUNDS):
        inside = at + 0.999 * rng.uniform(-radius(best), radius(best), (samples, loop.n))
        other = inside[np.sign(loop.determinant(inside, scheme)) != sign]
        changes = len(other)
        if not changes:
            break
        # a zero lies between q and every such sample, nearer than the best so far; it is also a better start
        near, far = at, other[np.abs(other - at).max(axis=1).argmin()]
        for _ in range(50):
            middle = 0.5 * (near + far)
            near, far = (middle, far) if np.sign(loop.determinant(middle, scheme)) == sign else (near, middle)
        again = solve(far)
        best = min((far, again), key=radius) if again is not None else far
    return SingularityFreeBox(radius(best), best, True, samples, changes)


def _shifts(rng: np.random.Generator, starts: int, n: int) -> Array:
    """Where further starts lie from q: nearby ones miss the nearest zero less often than starts from the whole region (2 of 480, not 9)."""
    return rng.uniform(-0.5, 0.5, (starts - 1, n))


def _factors(loop: ClosedLoop, kind: str) -> tuple[str, ...]:
    if kind == "actuation":
        return ("determinant",)
    require_wrist_centres(loop)
    if kind == "limb":
        return tuple(FACTORS)
    first = loop.twists(np.zeros(loop.n))[:, [0, loop.right.n]]  # the first axes do not move
    if np.linalg.matrix_rank(first, tol=1e-9) > 1:
        raise DegenerateError(f"{loop!r}: the constraint singularity (paper C, eq. 19) is that of arms whose first axes are one line")
    return ("f right, f left",)


def _values(loop: ClosedLoop, factor: str, scheme: tuple[int, ...] | None, q: Array) -> Array:
    """What has to vanish, from the numpy view of the kernels."""
    if scheme is not None:
        return np.atleast_1d(loop.determinant(q, scheme))
    limb = loop.kernel("limb_factors")(q) / np.array([LENGTH, 1.0])
    return np.array([limb[FACTORS[name]] for name in factor.split(", ")])


@lru_cache(PROGRAMS)
def _nearest_program(loop: ClosedLoop, factor: str, scheme: tuple[int, ...] | None) -> Program:
    """min |q - p|^2 with the factors zero; p is the parameter."""
    import casadi

    q, p = casadi.SX.sym("q", loop.n), casadi.SX.sym("p", loop.n)
    if scheme is not None:
        zero = loop.symbolic_determinant(q, scheme)
    else:
        limb = loop.kernel("limb_factors").symbolic(q)
        scales = (LENGTH, 1.0)
        zero = casadi.vertcat(*[limb[arm, k] / scales[k] for arm, k in (FACTORS[name] for name in factor.split(", "))])
    return Program("nearest", q, p, casadi.sumsqr(q - p), zero)


@lru_cache(PROGRAMS)
def _box_program(loop: ClosedLoop, scheme: tuple[int, ...]) -> Program:
    """min t over (q, t) with D(q) = 0 and -t <= q - p <= t."""
    import casadi

    x, p = casadi.SX.sym("x", loop.n + 1), casadi.SX.sym("p", loop.n)
    q, t = x[: loop.n], x[loop.n]
    return Program("box", x, p, t, casadi.vertcat(loop.symbolic_determinant(q, scheme), t - (q - p), t + (q - p)))
