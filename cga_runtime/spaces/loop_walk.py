"""Samples of closed configurations: a walk on the manifold of one fixed grasp.

Free grasps need no walk: any q of ClosedChain.random closes the loop for the grasp that it defines.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.spaces.closed_chain import ClosedLoop

Array = NDArray[np.float64]

NEWTON_STEPS = 20
NEWTON_TOLERANCE = 1e-12
"""Closure error at which Newton stops: well inside what counts as closed, so that errors do not add up along a walk."""


@dataclass(frozen=True)
class Walk:
    """Configurations (k, n) that hold one grasp, and how the walk went: steps tried, rejected, mean Newton steps of the accepted."""

    q: Array
    grasp: Array
    tried: int
    rejected: int
    newton_mean: float


def close_loop(loop: ClosedLoop, q: ArrayLike, grasp: ArrayLike, steps: int = NEWTON_STEPS) -> tuple[Array, int] | None:
    """The nearest closed configuration by damped least-squares Newton on the closure equations, and the steps it took; None if it fails.

    Damping 1e-12 + 1e-3 |e|^2, steps capped at 0.5 rad; joint limits are not considered.
    """
    at = loop.check_one(q).copy()
    loop.closure_error(at, grasp)  # refuses a grasp that is no motor; below the bare kernel is enough
    for k in range(steps + 1):
        error = loop.kernel("closure_error")(at, grasp)
        if np.abs(error).max() < NEWTON_TOLERANCE:
            return at, k
        jacobian = loop.kernel("closure_jacobian")(at, grasp)
        damping = 1e-12 + 1e-3 * float(error @ error)
        step = -jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping * np.eye(6), error)
        size = float(np.linalg.norm(step))
        at = at + step * min(1.0, 0.5 / size) if size > 0 else at
    return None


def walk(loop: ClosedLoop, q0: ArrayLike, steps: int, rng: np.random.Generator, step: float = 0.2) -> Walk:
    """A random walk of `steps` tangent steps (rad) inside the joint limits on the manifold of the grasp that q0 closes.

    Each step goes along a random null direction of the closure Jacobian and is then closed by Newton; steps that fail or leave the
    limits are rejected. It explores one connected component only.
    """
    at = loop.check_one(q0)
    grasp = loop.grasp(at)
    found, newton, rejected = [at], [], 0
    for _ in range(steps):
        _, _, vt = np.linalg.svd(loop.kernel("closure_jacobian")(at, grasp))
        direction = vt[6:].T @ rng.standard_normal(loop.n - 6)
        closed = close_loop(loop, at + step * direction / np.linalg.norm(direction), grasp)
        if closed is None or (closed[0] < loop.lower).any() or (closed[0] > loop.upper).any():
            rejected += 1
            continue
        at = closed[0]
        found.append(at)
        newton.append(closed[1])
    return Walk(np.array(found), grasp, steps, rejected, float(np.mean(newton)) if newton else 0.0)
