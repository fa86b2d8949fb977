"""Reaching by nonlinear programming: one arm or two to a primitive, or an object that two arms hold to a primitive (paper C's robot).

Every result is measured again with the kernels' numpy view and elementary geometry before it is called a success.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array
from cga_runtime.elements import Line, PointPair
from cga_runtime.errors import DegenerateError, GraspError, UnknownNameError, WrongSizeError
from cga_runtime.kernels import finite
from cga_runtime.robot import Chain
from cga_runtime.solve.reaching_problem import Form, Margins, Values, bounds, program
from cga_runtime.solve.reaching_targets import KINDS, Target, distance, duals
from cga_runtime.spaces.closed_chain import CLOSED, LENGTH, ClosedChain

LIMIT_TOLERANCE = 1e-8
"""How far a margin may be missed by a solution; joint limits are kept exactly."""


@dataclass(frozen=True)
class Solution:
    """Joint positions that reach a target, or the nearest miss.

    q: (n,), always inside the limits. success: residual <= tolerance, grasp closed, margins kept, all measured anew. residual: the largest
    distance (m) of a moved point from its target. iterations, seconds (wall time), starts: of all starts together; iterations_last: of the
    start that q came from.
    """

    q: Array
    success: bool
    status: str
    iterations: int
    iterations_last: int
    residual: float
    seconds: float
    starts: int


def reach(
    what: Chain | ClosedChain | Sequence[Chain],
    target: Target | PointPair,
    q0: ArrayLike | None = None,
    *,
    starts: int = 20,
    seed: int = 0,
    tolerance: float = 1e-6,
    grasp: ArrayLike | None = None,
    object_point: ArrayLike = (0.0, 0.0, 0.0),
    limb_margin: float | None = None,
    scheme_margin: tuple[Sequence[int], float] | None = None,
    conditioning_weight: float = 0.0,
) -> Solution:
    """Joint positions inside the limits, nearest to q0 (mid-range if none) locally, that bring `what` onto `target`.

    what, target: a Chain's end point onto a Point, Line, Circle, Plane or Sphere; two Chains (q in their order) onto a PointPair, the first
    chain to the first point, or both onto a Line; a ClosedChain, whose hands hold one object rigidly by `grasp` (default: the grasp of q0),
    with the object's point `object_point` (m, in the right hand's frame) onto a Point, Line, Circle, Plane or Sphere. Targets are given in
    the chains' root frame.

    The search begins at q0, moved into the limits where it lies outside, then at up to starts - 1 random positions drawn with `seed`. A target
    that is not reached is no error: success is False and status says so. A solution of a closed chain satisfies the closure equations; whether
    the held object can be moved there from q0 without letting go is another question.

    Only for a ClosedChain: limb_margin m keeps |f sin q4| / 0.1 m >= m in both arms, f the distance of the S centre from the first axis;
    scheme_margin (actuated joints, fraction) keeps D_a / D_a(q0) >= fraction, for which q0 must be closed; conditioning_weight w adds
    -w log det(S S^T), S the 6 x n screws, to the cost |q - q0|^2 / 2. Both margins keep the sides of the singularities on which q0 lies.

    Raises WrongSizeError, NotFiniteError, UnknownNameError (a target that does not go with `what`), SchemeError, DegenerateError (a margin
    relative to a singular q0, or arms without wrist centres), GraspError (arms that share joints; q0 not closed).
    """
    if starts < 1:
        raise WrongSizeError(f"starts: {starts} given, at least 1 needed")
    chains, loop = _subject(what)
    lower = loop.lower if loop is not None else np.concatenate([chain.lower for chain in chains])
    upper = loop.upper if loop is not None else np.concatenate([chain.upper for chain in chains])
    start = _middle(lower, upper) if q0 is None else _position(q0, what, chains)
    task = _Task(chains, loop, _targets(target, len(chains), loop), positive(tolerance, "tolerance"))
    only_loop = {"grasp": grasp, "limb_margin": limb_margin, "scheme_margin": scheme_margin, "conditioning_weight": conditioning_weight or None}
    if loop is None and any(value is not None for value in only_loop.values()):
        given = ", ".join(name for name, value in only_loop.items() if value is not None)
        raise GraspError(f"{given}: only for a ClosedChain, whose two arms hold one object")
    if loop is not None:
        task.hold(loop, start, grasp, object_point, limb_margin, scheme_margin, conditioning_weight)
    return task.solve(start, lower, upper, starts, seed)
