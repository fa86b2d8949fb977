"""Self-motions of the hands' point pair and line: joint motions that leave them where they are, as a basis, and as far as the joints go.

An arm of a universal joint U and a spherical joint S has two that leave its hand in place: S swings on a circle about the line from U to
the hand, and the hand spins about the line from S to it. One more leaves the hand on the line: it slides along it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import norm
from cga_runtime.elements import PointPair
from cga_runtime.report.context import Context
from cga_runtime.spaces.cooperative import Cooperative

Array = NDArray[np.float64]

SIDES = ("right", "left")
SELF_MOTIONS = {
    "slide": "hand slides along the line",
    "swing": "S swings about the line from U to the hand",
    "spin": "forearm spins about the line from S to the hand",
}
"""Kind and what it is."""
SWING, SLIDE = 1.4, 0.5
"""How far a swing and a slide are followed to either side (rad, length of the path in joint space), if the limits let them."""
STEPS, CORRECTIONS = 10, 3
"""Steps on the way, and Newton steps back onto the primitive after each."""


def self_motions(context: Context, q: Array) -> dict[str, Any]:
    """Bases of both nullspaces at q, (n,): all six `motions` leave the line where it is, the last four the pair, too.

    Of each: kind (slide, swing, spin), side, joints (unit vector, n), and the speeds (m for 1 rad) along: of the right and the left hand
    along the line, across: the largest of a hand across it, hand: the largest of a hand, centre: of the arm's S centre. across_largest: of
    all six; hand_largest: of the last four. basis_error: largest difference of the projectors N = 1 - J^+ J from the sums of the basis
    vectors' dyads. swing, slide: joint positions (2, n) to both sides, of all swings together and of the hands towards each other;
    swing_error, slide_error: how far (m) a hand has come from its place, or from the line, there.
    """
    pair, line = context.pair, context.line
    moving, start = pair.point_jacobian(q).reshape(2, 3, -1), pair.points(q)
    direction = PointPair.from_points(*start).direction
    on_line, in_place = line.nullspace(q), pair.nullspace(q)
    centres = _centres(context, q)
    found = [_of_arm(k, moving[k], direction, centre, on_line, in_place) for k, centre in enumerate(centres)]
    motions: list[dict[str, Any]] = []
    for kind in SELF_MOTIONS:
        for k, side in enumerate(SIDES):
            joints = found[k][kind]
            velocity = moving @ joints
            motions.append(
                {
                    "kind": kind,
                    "side": side,
                    "joints": joints,
                    "along": velocity @ direction,
                    "across": float(norm(velocity - np.outer(velocity @ direction, direction)).max()),
                    "hand": float(norm(velocity).max()),
                    "centre": float(norm(centres[k] @ joints)),
                }
            )
    basis = np.array([motion["joints"] for motion in motions])
    swing = follow(context, pair, q, found[0]["swing"] + found[1]["swing"], SWING)
    slide = follow(context, line, q, found[0]["slide"] - found[1]["slide"], SLIDE)
    return {
        "q": q,
        "motions": motions,
        "across_largest": max(motion["across"] for motion in motions),
        "hand_largest": max(motion["hand"] for motion in motions[2:]),
        "basis_error": float(max(np.abs(basis.T @ basis - on_line).max(), np.abs(basis[2:].T @ basis[2:] - in_place).max())),
        "swing": swing,
        "slide": slide,
        "swing_error": float(norm(pair.points(swing) - start).max()),
        "slide_error": float(norm(np.cross(pair.points(slide) - start[0], direction)).max()),
    }


def _of_arm(k: int, moving: Array, direction: Array, centre: Array, on_line: Array, in_place: Array) -> dict[str, Array]:
    """Slide, swing and spin of one arm: unit vectors, the slide towards the left, the swing upwards.

    moving, centre: Jacobians (3, n) of its hand and of its S centre. on_line, in_place: projectors of both nullspaces.
    """
    half = moving.shape[-1] // 2
    own = np.zeros(2 * half)
    own[k * half : (k + 1) * half] = 1.0
    slide = on_line @ (direction @ moving)
    swing = np.linalg.svd(centre @ in_place)[2][0]
    spin = np.linalg.eigh(own[:, None] * (in_place - np.outer(swing, swing)) * own)[1][:, -1]
    return {
        "slide": slide / norm(slide),
        "swing": swing * np.copysign(1.0, centre[2] @ swing),
        "spin": spin * np.copysign(1.0, spin[np.abs(spin).argmax()]),
    }


def _centres(context: Context, q: Array) -> Array:
    """Jacobians (2, 3, n) of the S centres, which the first two joints of each arm move."""
    arms, half = context.arms(q), context.loop.right.n
    jacobians = np.zeros((2, 3, 2 * half))
    for k, arm in enumerate((arms.right, arms.left)):
        for j in (0, 1):
            jacobians[k, :, k * half + j] = np.cross(arm.axes[j], arm.s - arm.u)
    return jacobians


def follow(context: Context, system: Cooperative, q: Array, motion: Array, length: float) -> Array:
    """Where paths of self-motions from q lead, first against and along `motion`, turning no more than they must, (2, n); each stops at the
    joint limits.

    Each step goes along the nullspace and then back onto the primitive at q, by Newton steps on the controllable rows of the error.
    """
    (lower, upper), rows, goal, chart = context.limits, system.about.rows, system.similarity(q), system.chart(q)
    ends, motions, going = np.stack([q, q]), np.stack([-motion, motion]), np.array([True, True])
    for _ in range(STEPS):
        motions = np.einsum("kij,kj->ki", system.nullspace(ends), motions)
        motions /= norm(motions)[:, None]
        trial = ends + length / STEPS * motions
        for _ in range(CORRECTIONS):
            back = np.linalg.pinv(system.horizontal_jacobian(trial, chart)[:, rows])
            trial = trial + np.einsum("kij,kj->ki", back, system.error(trial, goal, chart)[:, rows])
        going &= ((lower <= trial) & (trial <= upper)).all(axis=-1)
        ends = np.where(going[:, None], trial, ends)
    return ends
