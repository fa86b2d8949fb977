"""Damped steps inside joint limits, for many starts at once: Levenberg-Marquardt for the inverse kinematics of paper B, section VI-C.

Joints at a limit that the step against the gradient J^T e would push outside are held, and the others' step is clipped to the limits, so
that every iterate lies inside them exactly.

search: steps -(J^T J + mu)^-1 J^T e with mu = DAMPING |e|^2, always taken. Far away they are short and cross shallow minima, near a
solution they are Gauss-Newton's. From random starts on the panda a solution takes half the iterations of a search that takes only steps
that lower |e|.

descend: Newton steps -(|H| + mu)^-1 J^T e with the whole second derivative H of |e|^2 / 2, taken where they lower |e|, to minima that are
not zero, where the terms that J^T J leaves out decide.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import Array

Rows = NDArray[np.intp]
"""Numbers of the targets to which starts belong, (m,)."""
Evaluate = Callable[[Rows, Array], tuple[Array, Array]]
"""Residuals (m, k) and their Jacobians (m, k, n) at positions q (m, n) for the targets `rows`."""

DAMPING = 0.03
"""mu / |e|^2 of `search`. On the panda 0.01 to 0.1 are within 6 percent of the best, 0.001 needs 1.6 times the iterations, 1 three."""
FLOOR = 1e-10
"""Least mu over the mean of the squared columns of J: keeps singular systems solvable, and steps at a solution quadratic."""
EASIER, HARDER = 0.2, 4.0
"""Factors of mu in `descend` after a step that was taken, and after one that was not."""
STEP = 1e-5
"""Step (rad, m) of the differences of gradients: truncation and rounding are both near 1e-10."""
STATIONARY = 1e-7
"""A point is stationary where the cosine between e and the J column of every joint that may move is at most this."""


@dataclass(frozen=True)
class Box:
    """Joint limits, each (n,)."""

    lower: Array
    upper: Array

    def blocked(self, q: Array, gradient: Array) -> NDArray[np.bool_]:
        """Joints at a limit that the step against the gradient would push outside, (m, n)."""
        blocked: NDArray[np.bool_] = ((q <= self.lower) & (gradient > 0.0)) | ((q >= self.upper) & (gradient < 0.0))
        return blocked

    def clip(self, q: Array) -> Array:
        """The nearest positions inside."""
        return np.clip(q, self.lower, self.upper)


@dataclass(frozen=True)
class Found:
    """Where m starts ended: q (m, n), cost |e|^2 (m,), iterations (m,)."""

    q: Array
    cost: Array
    iterations: NDArray[np.intp]


def search(evaluate: Evaluate, rows: Rows, q: Array, box: Box, tolerance: float, iterations: int) -> Found:
    """At most `iterations` steps from each of the starts q (m, n), several of which may belong to one target: rows (m,) are the targets'
    numbers. The starts of a target stop together, as soon as one of them has |e| <= tolerance. Found: the least |e| on each way."""
    best, cost, taken = q.copy(), np.full(len(q), np.inf), np.zeros(len(q), dtype=np.intp)
    live = np.arange(len(q))
    solved = np.zeros(rows.max(initial=-1) + 1, dtype=bool)
    for step in range(iterations + 1):
        e, jacobian = evaluate(rows[live], q)
        square = np.einsum("mk,mk->m", e, e)
        lower = square < cost[live]
        best[live[lower]], cost[live[lower]] = q[lower], square[lower]
        solved[rows[live[square <= tolerance * tolerance]]] = True
        keep = ~solved[rows[live]]
        if not keep.all():
            live, q, e, jacobian, square = live[keep], q[keep], e[keep], jacobian[keep], square[keep]
        if not len(live) or step == iterations:
            break
        q = box.clip(q + _step(q, e, jacobian, DAMPING * square, box))
        taken[live] += 1
    return Found(best, cost, taken)


def _step(q: Array, e: Array, jacobian: Array, mu: Array, box: Box) -> Array:
    """-(J^T J + mu)^-1 J^T e in the joints that are not blocked, zero in the others."""
    square, gradient, n = jacobian.swapaxes(1, 2) @ jacobian, _gradient(e, jacobian), q.shape[1]
    blocked = box.blocked(q, gradient)
    least = FLOOR * np.einsum("mii->m", square) / n + np.finfo(float).tiny
    square *= ~(blocked[:, :, None] | blocked[:, None, :])
    square[:, range(n), range(n)] += np.where(blocked, 1.0, (mu + least)[:, None])
    return np.asarray(np.linalg.solve(square, np.where(blocked, 0.0, -gradient)[..., None])[..., 0], dtype=np.float64)


def _gradient(e: Array, jacobian: Array) -> Array:
    """J^T e, the gradient of |e|^2 / 2."""
    gradient: Array = np.einsum("mki,mk->mi", jacobian, e)
    return gradient


def descend(evaluate: Evaluate, rows: Rows, q: Array, box: Box, tolerance: float, iterations: int) -> tuple[Found, NDArray[np.bool_]]:
    """At most `iterations` steps downhill from each of the starts q (m, n), until |e| <= tolerance or the point is stationary: where they
    end, and which of them are stationary."""
    at, taken = q.copy(), np.zeros(len(q), dtype=np.intp)
    e, jacobian = evaluate(rows, at)
    cost = np.einsum("mk,mk->m", e, e)
    mu = DAMPING * cost
    stationary = _stationary(at, e, jacobian, box)
    for _ in range(iterations):
        live = np.flatnonzero(~stationary & (cost > tolerance * tolerance))
        if not len(live):
            break
        hessian = _hessian(evaluate, rows[live], at[live])
        trial = box.clip(at[live] + _newton_step(at[live], hessian, _gradient(e[live], jacobian[live]), mu[live], box))
        e_trial, jacobian_trial = evaluate(rows[live], trial)
        cost_trial = np.einsum("mk,mk->m", e_trial, e_trial)
        lower = cost_trial < cost[live]
        mu[live] = np.where(lower, EASIER, HARDER) * mu[live]
        taken[live] += 1
        better = live[lower]
        at[better], e[better], jacobian[better], cost[better] = trial[lower], e_trial[lower], jacobian_trial[lower], cost_trial[lower]
        stationary[better] = _stationary(at[better], e[better], jacobian[better], box)
    return Found(at, cost, taken), stationary


def _hessian(evaluate: Evaluate, rows: Rows, q: Array) -> Array:
    """Second derivatives of |e|^2 / 2, (m, n, n), by central differences of its exact gradient."""
    m, n = q.shape
    shifts = STEP * np.concatenate([np.eye(n), -np.eye(n)])
    e, jacobian = evaluate(np.repeat(rows, 2 * n), (q[:, None] + shifts).reshape(-1, n))
    gradients = _gradient(e, jacobian).reshape(m, 2, n, n)
    half = (gradients[:, 0] - gradients[:, 1]) / (4.0 * STEP)
    symmetric: Array = half + half.swapaxes(1, 2)
    return symmetric


def _newton_step(q: Array, hessian: Array, gradient: Array, mu: Array, box: Box) -> Array:
    """-(|H| + mu)^-1 gradient in the joints that are not blocked, |H| with the eigenvalues' absolute values: always downhill."""
    blocked = box.blocked(q, gradient)
    values, vectors = np.linalg.eigh(np.where(blocked[:, :, None] | blocked[:, None, :], 0.0, hessian))
    components = np.einsum("mij,mi->mj", vectors, np.where(blocked, 0.0, -gradient))
    step: Array = np.einsum("mij,mj->mi", vectors, components / (np.abs(values) + mu[:, None] + np.finfo(float).tiny))
    return np.where(blocked, 0.0, step)


def _stationary(q: Array, e: Array, jacobian: Array, box: Box) -> NDArray[np.bool_]:
    gradient = _gradient(e, jacobian)
    scale = np.sqrt(np.einsum("mki,mki->mi", jacobian, jacobian) * np.einsum("mk,mk->m", e, e)[:, None])
    small: NDArray[np.bool_] = (box.blocked(q, gradient) | (np.abs(gradient) <= STATIONARY * scale)).all(axis=1)
    return small
