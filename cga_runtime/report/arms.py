"""Where the axes and centres of two universal-spherical arms lie at a pose: what the drawings show and what the text names.

Points in the common root frame (m). U is the centre of an arm's universal joint, S that of its spherical joint.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.closed_chain import ClosedChain

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Arm:
    """One arm: centres U and S, the elbow (foot of U on axis 3), the wrist (foot of the hand on axis 5), the hand; unit axes (5, 3) and a
    point on each (5, 3).
    """

    u: Array
    elbow: Array
    s: Array
    wrist: Array
    hand: Array
    axes: Array
    anchors: Array


@dataclass(frozen=True)
class Arms:
    """Both arms; `right` and `left`."""

    right: Arm
    left: Arm


def arms_at(loop: ClosedChain, q: Array) -> Arms:
    """Both arms at q, shape (n,)."""
    twists, centres, half = loop.twists(q), loop.kernel("wrist_centres")(q), loop.right.n
    return Arms(
        _arm(twists[:, :half], centres[0], loop.right.point(q[:half])),
        _arm(twists[:, half:], centres[1], loop.left.point(q[half:])),
    )


def _arm(twists: Array, s: Array, hand: Array) -> Arm:
    w, v = twists[:3].T, twists[3:].T
    u = meeting_point((w[0], v[0]), (w[1], v[1]))
    elbow, wrist = (s + w[j] * (w[j] @ (point - s)) for j, point in ((2, u), (4, hand)))
    return Arm(u, elbow, s, wrist, hand, w, np.stack([u, u, elbow, s, wrist]))


def meeting_point(first: tuple[Array, Array], second: tuple[Array, Array]) -> Array:
    """The point nearest to two lines (w, v = p x w), each condition w x p = -v taken as an equation: exact where the lines meet."""
    rows = np.concatenate([_cross_matrix(w) for w, _ in (first, second)])
    point: Array = np.linalg.lstsq(rows, -np.concatenate([first[1], second[1]]), rcond=None)[0]
    return point


def line_through(a: Array, b: Array) -> tuple[Array, Array]:
    """The unit line (w, v) from a to b, as the twist of a rotation about it: v = a x w."""
    w = (b - a) / np.linalg.norm(b - a)
    return w, np.cross(a, w)


def _cross_matrix(w: Array) -> Array:
    x, y, z = w
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
