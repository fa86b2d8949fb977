"""Reaching by nonlinear programming: one arm or two to a primitive, an object that two arms hold (paper C's robot), or a cooperative
primitive (paper A).

Every result is measured again, with the kernels' numpy view and elementary geometry, before it is called a success.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, count, read
from cga_runtime.elements import Line, Motor, Point, PointPair
from cga_runtime.elements.distances import distance
from cga_runtime.errors import ChainError, GraspError, UnknownNameError, WrongSizeError
from cga_runtime.robot import Chain, shared_joints
from cga_runtime.solve.reaching_cooperative import cooperative_search
from cga_runtime.solve.reaching_grasp import hold, number
from cga_runtime.solve.reaching_problem import Form, bounds, parameters, program
from cga_runtime.solve.reaching_search import STARTS as STARTS
from cga_runtime.solve.reaching_search import TOLERANCE, Search
from cga_runtime.solve.reaching_search import Solution as Solution
from cga_runtime.solve.reaching_targets import KINDS, Target, duals
from cga_runtime.spaces.closed_chain import ClosedLoop
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.versors import Similarity


def reach(
    what: Chain | ClosedLoop | Cooperative | Sequence[Chain],
    target: Target | PointPair | Similarity,
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
    degeneracy_margin: float | None = None,
    manipulability_weight: float = 0.0,
) -> Solution:
    """Joint positions inside the limits, locally nearest to q0 (default: mid-range), that bring `what` onto `target`.

    what and target: a Chain's end point onto a Point, Line, Circle, Plane or Sphere; two Chains (q: the first one's joints, then the
    second one's) onto a PointPair, first to first, or both onto a Line; a ClosedChain, whose hands hold one object rigidly, with the
    object's point `object_point` (m, in the right hand's frame; default its origin) onto a Point, Line, Circle, Plane or Sphere. The object
    is held by the motor `grasp`, by default the one that closes the loop at q0. Targets are given in the chains' root frame.

    A Cooperative onto a target of its own kind or a Similarity V_d, which means V_d X_u ~V_d; into a larger one, or around a smaller one:

        point        into Line, Circle, Plane, Sphere
        point_pair   into Line, Circle, Plane, Sphere
        line         into Plane                          around Point, PointPair
        circle       into Plane, Sphere                  around Point, PointPair
        plane                                            around Point, PointPair, Line, Circle
        sphere                                           around Point, PointPair, Circle

    Its residual is for its own kind the largest of the distance of the centres (of lines and planes: of the mean of the end points from the
    target), the difference of the radii, and the angle between the directions, orientation included, as an arc at 1 m; else the largest
    distance of a point of the one that is contained from the other, of lines within 1 m of the end points' mean.

    The search begins at q0, moved into the limits where it lies outside, and goes on from random positions drawn with `seed` until a
    result is within `tolerance` (m), from `starts` positions at most. A target that is not reached is no error: success is False and status
    says so. A solution of a closed chain closes the loop; whether the object can be moved there without letting go is another question.

    For a ClosedChain: limb_margin m keeps |f sin q4| / 0.1 m >= m in both arms, f the distance of the S centre from the first axis;
    scheme_margin (actuated joints, fraction) keeps D_a / D_a(q0) >= fraction, for which the loop must be closed at q0; both keep the side
    of the singularities on which q0 lies. conditioning_weight w adds -w log det(S S^T), S the 6 x n screws, to the cost |q - q0|^2 / 2.

    For a Cooperative: degeneracy_margin m keeps its `degeneracy` >= m, whichever of its chains is named first; by default 1 mm between two
    points, 0.01 of three and four, whose first two also stay 1 mm apart; with 0 nothing is kept. manipulability_weight w adds
    -w log `manipulability` to the cost; as that has no bound near degenerate primitives it needs a target of the system's own kind, not a
    plane, and of lines, circles and spheres a degeneracy_margin.

    Raises WrongSizeError, NotFiniteError, UnknownNameError (a target that does not go with `what`), SchemeError, DegenerateError (a grasp
    that is no motor, margins at a singular q0, arms without wrist centre, a manipulability_weight without bound), GraspError (shared joints
    of two Chains; loop not closed at q0; options that `what` has not), ChainError (a floating base).
    """
    starts, seed, tolerance = count(starts, "starts", 1), count(seed, "seed"), number(tolerance, "tolerance")
    if tolerance <= 0.0:
        raise WrongSizeError(f"tolerance: {tolerance} given, a positive length (m) is needed")
    held_only: dict[str, Any] = {"grasp": grasp, "object_point": object_point, "limb_margin": limb_margin, "scheme_margin": scheme_margin}
    weight = number(conditioning_weight, "conditioning_weight")
    if isinstance(what, Cooperative):
        _refuse("a ClosedChain, whose two arms hold one object", **held_only, conditioning_weight=weight or None)
        position = middle(what.lower, what.upper) if q0 is None else _position(q0, what.joint_names)
        search = cooperative_search(what, target, position, degeneracy_margin, manipulability_weight)
    else:
        weighted = number(manipulability_weight, "manipulability_weight") or None
        _refuse("a Cooperative", degeneracy_margin=degeneracy_margin, manipulability_weight=weighted)
        search = _search(what, target, q0, held_only, weight)
    return search.run(starts, seed, tolerance)


def _search(what: Any, target: Any, q0: ArrayLike | None, options: dict[str, Any], conditioning_weight: float) -> Search:
    """The search of chains and closed chains."""
    chains, loop = _subject(what)
    for chain in chains:
        if chain.layout.floating:
            raise ChainError(f"{chain!r}: its base floats, reaching needs a fixed one: Robot.chain(frame, root=...)")
    targets = _targets(target, len(chains), loop is not None)
    lower, upper = (np.concatenate([getattr(chain, side) for chain in chains]) for side in ("lower", "upper"))
    position = middle(lower, upper) if q0 is None else _position(q0, [name for chain in chains for name in chain.joint_names])
    held = None
    if loop is not None:
        held = hold(loop, position, **options, conditioning_weight=conditioning_weight)
    else:
        _refuse("a ClosedChain, whose two arms hold one object", **options, conditioning_weight=conditioning_weight or None)

    def residual(q: Array) -> float:
        points = _end_points(chains, q) if held is None else held.points(q)
        return max(float(distance(point, goal)) for goal, point in zip(targets, points, strict=True))

    planes = [duals(goal) for goal in targets]
    form = Form.of(chains, tuple(len(s) for s in planes), held)
    given = parameters(np.concatenate(planes), position, held)
    limits = bounds(form, held, lower, upper)

    def draw(rng: np.random.Generator) -> Array:
        return np.concatenate([chain.random(rng) for chain in chains])

    more = held.checks if held is not None else lambda q: []
    return Search(program(form), given, limits, np.clip(position, lower, upper), draw, residual, more)


def _subject(what: Any) -> tuple[tuple[Chain, ...], ClosedLoop | None]:
    """The arms in the order of their joints in q, and the closed chain that they form, if they do."""
    if isinstance(what, Chain):
        return (what,), None
    if isinstance(what, ClosedLoop):
        return (what.right, what.left), what
    if not (isinstance(what, Sequence) and len(what) == 2 and all(isinstance(chain, Chain) for chain in what)):
        raise UnknownNameError("subject", type(what).__name__, ("a Chain", "a sequence of two Chains", "a ClosedChain", "a Cooperative"))
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


def _refuse(owner: str, **options: Any) -> None:
    given = [name for name, value in options.items() if value is not None]
    if given:
        raise GraspError(f"{', '.join(given)}: only for {owner}")


def _position(q0: ArrayLike, names: Sequence[str]) -> Array:
    array = read(q0, "q0")
    if array.shape != (len(names),):
        raise WrongSizeError(f"q0: shape {array.shape} given, ({len(names)},) needed: {', '.join(names)}")
    return array


def middle(lower: Array, upper: Array) -> Array:
    """The middle of the limits; for joints without limits the position nearest to zero."""
    limited = np.isfinite(lower) & np.isfinite(upper)
    return np.where(limited, 0.5 * (np.where(limited, lower, 0.0) + np.where(limited, upper, 0.0)), np.clip(0.0, lower, upper))


def _end_points(chains: tuple[Chain, ...], q: Array) -> list[Array]:
    """The chains' end points (m)."""
    split = np.split(q, np.cumsum([chain.n for chain in chains])[:-1])
    return [chain.point(part) for chain, part in zip(chains, split, strict=True)]
