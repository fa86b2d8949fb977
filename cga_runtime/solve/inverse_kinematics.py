"""Inverse kinematics: joint positions of a chain for poses, points and primitives (paper B, sections IV and VI-C), and of a cooperative
system for the primitive that its chains span (paper A, section 3.7), many targets at once.

Every result is measured again from its joint positions, all targets together, before it is called a success.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import Array, count, one_batch, read
from cga_runtime.errors import ChainError, UnknownNameError, WrongSizeError
from cga_runtime.robot import Chain
from cga_runtime.solve.cooperative_errors import NOWHERE
from cga_runtime.solve.cooperative_targets import cooperative_goal
from cga_runtime.solve.ik_starts import Outcome, Starts, levenberg_marquardt, plain_gauss_newton
from cga_runtime.solve.ik_targets import IkTarget, goal
from cga_runtime.solve.levenberg_marquardt import Box
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.versors import Similarity

TOLERANCE = 1e-6
AIM = 0.99
"""The solvers stop at this fraction of the tolerance: measured again, a result may differ in its last digits."""
BLOCK, COOPERATIVE_BLOCK = 4096, 256
"""Targets solved together: memory stays bounded, however many are given. Systems of several chains have Jacobians of up to 16 times a
chain's size."""
LARGEST_WEIGHT = 1e12
_STATUS = np.dtype("U15")  # the longest is "iteration_limit"


@dataclass(frozen=True)
class Method:
    """How a method solves a block of targets, and what it does where the caller says nothing."""

    solve: Callable[..., Outcome]
    restarts: int
    max_iterations: int
    limits: bool
    as_printed: bool  # with the papers' own errors


METHODS = {
    "levenberg_marquardt": Method(levenberg_marquardt, restarts=200, max_iterations=15, limits=True, as_printed=False),
    "gauss_newton": Method(plain_gauss_newton, restarts=0, max_iterations=100, limits=False, as_printed=True),
}


@dataclass(frozen=True)
class Solutions:
    """Results with the leading dimensions of the targets.

    q: (..., n). success: whether residual <= tolerance. residual: |e|, weighted. iterations, starts: of all starts of a target together,
    and how many there were. status: "reached", or without success
    "least_squares": q is a local minimum of |e| inside the limits, the best one found; the target is out of reach, or was not found;
    "iteration_limit": q is the best attempt, not yet a minimum;
    "stalled": gauss_newton found no lower |e| along its step;
    "degenerate": at q the points of a cooperative system span no primitive, and residual is infinite.
    """

    q: Array
    success: NDArray[np.bool_]
    residual: Array
    iterations: NDArray[np.intp]
    starts: NDArray[np.intp]
    status: NDArray[np.str_]


def inverse_kinematics(
    arm: Chain | Cooperative,
    target: IkTarget | Similarity,
    q0: ArrayLike | None = None,
    rng: np.random.Generator | None = None,
    *,
    method: str = "levenberg_marquardt",
    restarts: int | None = None,
    tolerance: float = TOLERANCE,
    max_iterations: int | None = None,
    limits: bool | None = None,
    weights: Sequence[float] = (1.0, 1.0),
) -> Solutions:
    """Joint positions (..., n) that bring the end frame of `arm`, or the primitive of a cooperative system, onto the target.

    target of a chain, in its root frame: poses (..., 4, 4) or a Motor, for the whole frame; a Point, PointPair (either point), Line,
    Circle, Plane or Sphere, for the frame's origin; one target an entry of the leading dimensions. The error e of a pose is (distance
    vector, rotation vector) seen from the target frame, of a primitive the distance vector. weights: of e's lengths (1/m) and angles
    (1/rad); success means |e| <= tolerance, so weighted. A weight of zero leaves the position, or the orientation, free.

    target of a Cooperative, in its world: an element of its own kind, or V_d as a Similarity or its components (..., 12), which means the
    primitive V_d X_u ~V_d (paper A, eqs. 39-44): the turn of V_d about the primitive's direction, and its motion along a line or plane, are
    not the system's to control. e holds centre and radius (m), of line and plane the distance of the points' mean from the target, and
    the angle between the directions (rad): orientation counts, but not the handedness of a sphere's points. It does not depend on a gauge.

    method "levenberg_marquardt": damped steps inside the joint limits, which every result keeps exactly; limits=False drops them. The
    search begins at q0 (..., n), clipped to the limits, which goes first and alone, or without q0 at random; it goes on from `restarts`
    (200) more positions, uniform inside the limits (joints without limits: +-pi), with at most max_iterations (15) steps from each.
    rng draws the starts; default np.random.default_rng(0), so that equal calls give equal results. Where none of them reaches the target,
    up to 200 downhill steps lead from the best one to a minimum of |e|: the answer to most poses for an arm of less than six joints.

    method "gauss_newton": the papers', for comparison. A line search, no limits, one start, at most 100 steps. A chain's error is the
    logarithm as paper B prints it, which turns the long way round where the signs of target and end frame motors say so; a cooperative
    system's is log(~V_c V_d) (paper A, eqs. 43-47, with the pseudo-inverse), followed as it is and judged by e as above.

    A target that is not reached is no error: success is False and status says so. Raises WrongSizeError, NotFiniteError, DegenerateError
    (poses that are not rigid, versors that are no similarities, targets beyond 1e50 m), ChainError (a floating base), UnknownNameError
    (method; type of arm, target or rng; limits or restarts with gauss_newton).
    """
    if not isinstance(arm, Chain | Cooperative):
        raise UnknownNameError("arm", type(arm).__name__, ("a Chain, from Robot.chain", "a Cooperative of such chains"))
    if isinstance(arm, Chain) and arm.layout.floating:
        raise ChainError(f"{arm!r}: its base floats, inverse kinematics needs a fixed one: Robot.chain(frame, root=...)")
    if method not in tuple(METHODS):
        raise UnknownNameError("method", method, METHODS)
    if rng is not None and not isinstance(rng, np.random.Generator):
        raise UnknownNameError("rng", type(rng).__name__, ("numpy.random.Generator",), "Make one with numpy.random.default_rng(seed)")
    chosen = METHODS[method]
    inside = chosen.limits if limits is None else bool(limits)
    if method == "gauss_newton" and (inside or restarts):
        raise UnknownNameError("option of gauss_newton", "limits" if inside else "restarts", ("tolerance", "max_iterations", "weights"))
    if isinstance(arm, Chain):
        wanted = goal(arm, target, _weights(weights), not chosen.as_printed)  # type: ignore[arg-type]  # refused there
    else:
        wanted = cooperative_goal(arm, target, _weights(weights), chosen.as_printed)
    size = math.prod(wanted.batch)
    starts = Starts(
        arm,
        Box(arm.lower, arm.upper) if inside else Box(np.full(arm.n, -math.inf), np.full(arm.n, math.inf)),
        None if q0 is None else _first(q0, arm, wanted.batch),
        chosen.restarts if restarts is None else count(restarts, "restarts"),
        chosen.max_iterations if max_iterations is None else count(max_iterations, "max_iterations"),
        AIM * _positive(tolerance),
        rng if rng is not None else np.random.default_rng(0),
    )
    q, residual = np.empty((size, arm.n)), np.empty(size)
    iterations, used, status = np.empty(size, dtype=np.intp), np.empty(size, dtype=np.intp), np.empty(size, dtype=_STATUS)
    block = BLOCK if isinstance(arm, Chain) else COOPERATIVE_BLOCK
    for k in range(0, size, block):
        rows = np.arange(k, min(k + block, size))
        found = chosen.solve(wanted, rows, starts)
        q[rows], iterations[rows], used[rows], status[rows] = found.q, found.iterations, found.starts, found.status
        e, _ = wanted.error(rows, found.q)
        residual[rows] = np.sqrt(np.einsum("mk,mk->m", e, e))
    nowhere = residual >= NOWHERE
    residual[nowhere], status[nowhere] = math.inf, "degenerate"
    success = residual <= tolerance
    status[success] = "reached"
    shape = wanted.batch
    return Solutions(
        q.reshape(*shape, arm.n),
        success.reshape(shape),
        residual.reshape(shape),
        iterations.reshape(shape),
        used.reshape(shape),
        status.reshape(shape),
    )


def _first(q0: ArrayLike, arm: Chain | Cooperative, batch: tuple[int, ...]) -> Array:
    """One first start for each target, (m, n)."""
    first = read(q0, "q0", arm.n)
    if one_batch("q0 and target", first.shape[:-1], batch) != batch:
        raise WrongSizeError(f"q0: shape {first.shape} given, ({arm.n},) or {(*batch, arm.n)} needed, one start for each target")
    return np.broadcast_to(first, (*batch, arm.n)).reshape(-1, arm.n)


def _weights(weights: Sequence[float]) -> tuple[float, float]:
    given = read(weights, "weights")
    if given.shape != (2,) or (given < 0.0).any() or (given > LARGEST_WEIGHT).any() or not given.any():
        raise WrongSizeError(
            f"weights: {weights} given, two numbers from 0 to {LARGEST_WEIGHT:.0e} needed, of lengths (1/m) and angles (1/rad), not both 0"
        )
    return float(given[0]), float(given[1])


def _positive(tolerance: float) -> float:
    given = read(tolerance, "tolerance")
    if given.shape != () or not given > 0.0:
        raise WrongSizeError(f"tolerance: {tolerance} given, a positive number is needed")
    return float(given)
