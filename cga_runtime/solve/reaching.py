"""Reaching by nonlinear programming: one arm or two to a primitive, or an object that two arms hold to a primitive (paper C's robot).

Every result is measured again, with the kernels' numpy view and elementary geometry, before it is called a success.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, count, read
from cga_runtime.elements import Line, Motor, Point, PointPair
from cga_runtime.errors import ChainError, GraspError, UnknownNameError, WrongSizeError
from cga_runtime.robot import Chain, shared_joints
from cga_runtime.solve.reaching_grasp import Check, hold, number
from cga_runtime.solve.reaching_problem import Form, bounds, parameters, program
from cga_runtime.solve.reaching_targets import KINDS, Target, distance, duals
from cga_runtime.spaces.closed_chain import ClosedLoop

STARTS = 20
TOLERANCE = 1e-6


@dataclass(frozen=True)
class Solution:
    """Joint positions that reach a target, or the best attempt.

    q: (n,), always inside the limits. success: target reached within the tolerance, grasp closed, margins kept, all measured anew.
    status: "reached", or each of target, closure and margins that q misses, and IPOPT's word for its run; where it was given elastic
    equations (see reaching_problem.py) it also succeeds at a point that misses them. residual: largest distance (m) of a moved point
    from its target. iterations, starts, seconds (wall time): of all starts together;
    iterations_last: of the start that gave q.
    """

    q: Array
    success: bool
    status: str
    iterations: int
    residual: float
    seconds: float
    starts: int
    iterations_last: int


def reach(
    what: Chain | ClosedLoop | Sequence[Chain],
    target: Target | PointPair,
    q0: ArrayLike | None = None,
    *,
    starts: int = STARTS,
    seed: int = 0,
    tolerance: float = TOLERANCE,
    grasp: ArrayLike | Motor | None = None,
    object_point: ArrayLike | None = None,
    limb_margin: float | None = None,
    scheme_margin: tuple[Sequence[int], float] | None = None,
    conditioning_weight: float = 0.0,
) -> Solution:
    """Joint positions inside the limits, locally nearest to q0 (default: mid-range), that bring `what` onto `target`.

    what and target: a Chain's end point onto a Point, Line, Circle, Plane or Sphere; two Chains (q: the first one's joints, then the
    second one's) onto a PointPair, first to first, or both onto a Line; a ClosedChain, whose hands hold one object rigidly, with the
    object's point `object_point` (m, in the right hand's frame; default its origin) onto a Point, Line, Circle, Plane or Sphere. The object
    is held by the motor `grasp`, by default the one that closes the loop at q0. Targets are given in the chains' root frame.

    The search begins at q0, moved into the limits where it lies outside, and goes on from random positions drawn with `seed` until a
    result is within `tolerance` (m), from `starts` positions at most. A target that is not reached is no error: success is False and status
    says so. A solution of a closed chain closes the loop; whether the object can be moved there without letting go is another question.

    For a ClosedChain: limb_margin m keeps |f sin q4| / 0.1 m >= m in both arms, f the distance of the S centre from the first axis;
    scheme_margin (actuated joints, fraction) keeps D_a / D_a(q0) >= fraction, for which the loop must be closed at q0; both keep the side
    of the singularities on which q0 lies. conditioning_weight w adds -w log det(S S^T), S the 6 x n screws, to the cost |q - q0|^2 / 2.

    Raises WrongSizeError, NotFiniteError, UnknownNameError (a target that does not go with `what`), SchemeError, DegenerateError (a grasp
    that is no motor, margins at a singular q0, arms without wrist centre), GraspError (shared joints; loop not closed at q0),
    ChainError (a floating base).
    """
    chains, loop = _subject(what)
    for chain in chains:
        if chain.layout.floating:
            raise ChainError(f"{chain!r}: its base floats, reaching needs a fixed one: Robot.chain(frame, root=...)")
    targets = _targets(target, len(chains), loop is not None)
    starts, seed, tolerance = count(starts, "starts", 1), count(seed, "seed"), number(tolerance, "tolerance")
    if tolerance <= 0.0:
        raise WrongSizeError(f"tolerance: {tolerance} given, a positive length (m) is needed")
    lower, upper = (np.concatenate([getattr(chain, side) for chain in chains]) for side in ("lower", "upper"))
    position = middle(lower, upper) if q0 is None else _position(q0, chains)
    held = None
    if loop is not None:
        held = hold(loop, position, grasp, object_point, limb_margin, scheme_margin, conditioning_weight)
    else:
        _refuse(grasp=grasp, object_point=object_point, limb_margin=limb_margin, scheme_margin=scheme_margin)
        _refuse(conditioning_weight=number(conditioning_weight, "conditioning_weight") or None)

    def residual(q: Array) -> float:
        points = _end_points(chains, q) if held is None else held.points(q)
        return max(float(distance(goal, point)) for goal, point in zip(targets, points, strict=True))

    def checks(q: Array) -> list[Check]:
        miss = residual(q)
        target_check = Check(miss / tolerance, f"closest result {miss:.2g} m away")
        return [target_check, *([] if held is None else held.checks(q))]

    def violation(q: Array) -> float:
        return max(check.violation for check in checks(q))

    planes = [duals(goal) for goal in targets]
    form = Form.of(chains, tuple(len(s) for s in planes), held)
    begin = _starts(chains, np.clip(position, lower, upper), starts, seed)
    given = parameters(np.concatenate(planes), position, held)
    best = program(form).solve_from(begin, given, bounds(form, held, lower, upper), violation)
    q, miss = best.attempt.x, residual(best.attempt.x)
    success = best.violation <= 1.0
    if success:
        status = f"reached (IPOPT: {best.attempt.status})"
    else:
        missed = "; ".join(check.missed for check in checks(q) if not check.violation <= 1.0)
        status = f"unreachable or not found in {best.starts} starts: {missed} (IPOPT: {best.attempt.status})"
    return Solution(q, success, status, best.iterations, miss, best.seconds, best.starts, best.attempt.iterations)


def _subject(what: Any) -> tuple[tuple[Chain, ...], ClosedLoop | None]:
    """The arms in the order of their joints in q, and the closed chain that they form, if they do."""
    if isinstance(what, Chain):
        return (what,), None
    if isinstance(what, ClosedLoop):
        return (what.right, what.left), what
    if not (isinstance(what, Sequence) and len(what) == 2 and all(isinstance(chain, Chain) for chain in what)):
        raise UnknownNameError("subject", type(what).__name__, ("a Chain", "a sequence of two Chains", "a ClosedChain"))
    first, second = what
    shared = shared_joints(first, second)
    if shared:
        raise GraspError(f"the two chains share joints ({', '.join(sorted(shared))}): they cannot reach independently")
    return (first, second), None


def _targets(target: Any, arms: int, closed: bool) -> tuple[Target, ...]:
    """One primitive for each moved point."""
    if closed or arms == 1:
        subject, accepted = "a ClosedChain" if closed else "a Chain", KINDS
    else:
        subject, accepted = "two Chains", (PointPair, Line)
    if type(target) not in accepted:
        raise UnknownNameError(f"target of {subject}", type(target).__name__, (kind.__name__ for kind in accepted))
    # `points` only on point pairs, `center` on all others
    batch = target.points.shape[:-2] if isinstance(target, PointPair) else target.center.shape[:-1]
    if batch:
        raise WrongSizeError(f"target: one {type(target).__name__} at a time; this one has the batch shape {batch}")
    if isinstance(target, PointPair):
        return Point(target.points[0]), Point(target.points[1])
    return (target,) if closed else (target,) * arms


def _refuse(**options: Any) -> None:
    given = [name for name, value in options.items() if value is not None]
    if given:
        raise GraspError(f"{', '.join(given)}: only for a ClosedChain, whose two arms hold one object")


def _position(q0: ArrayLike, chains: tuple[Chain, ...]) -> Array:
    names = [name for chain in chains for name in chain.joint_names]
    array = read(q0, "q0")
    if array.shape != (len(names),):
        raise WrongSizeError(f"q0: shape {array.shape} given, ({len(names)},) needed: {', '.join(names)}")
    return array


def middle(lower: Array, upper: Array) -> Array:
    """The middle of the limits; for joints without limits the position nearest to zero."""
    limited = np.isfinite(lower) & np.isfinite(upper)
    return np.where(limited, 0.5 * (np.where(limited, lower, 0.0) + np.where(limited, upper, 0.0)), np.clip(0.0, lower, upper))


def _starts(chains: tuple[Chain, ...], first: Array, count: int, seed: int) -> Iterator[Array]:
    """The given start, then random ones inside the limits, every other one only half as far away: margins are kept more easily near by."""
    yield first
    rng = np.random.default_rng(seed)
    for k in range(count - 1):
        drawn = np.concatenate([chain.random(rng) for chain in chains])
        yield 0.5 * (first + drawn) if k % 2 == 0 else drawn


def _end_points(chains: tuple[Chain, ...], q: Array) -> list[Array]:
    """The chains' end points (m)."""
    split = np.split(q, np.cumsum([chain.n for chain in chains])[:-1])
    return [chain.point(part) for chain, part in zip(chains, split, strict=True)]
