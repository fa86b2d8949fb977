"""What a Jacobian with more columns than rows says: its null space, its manipulability and that one's gradient, its robust inverse."""

from __future__ import annotations

import numpy as np

from cga_runtime.coordinates import Array

RANK = 1e-12
"""Singular values below this fraction of the largest count as zero."""


def nullspace(jacobian: Array) -> Array:
    """1 - J^+ J of J (..., m, n), (..., n, n): symmetric and idempotent, of rank n minus that of J."""
    _, values, right = np.linalg.svd(jacobian, full_matrices=False)
    kept = np.where((values > RANK * values.max(axis=-1, keepdims=True, initial=0.0))[..., None], right, 0.0)
    return np.asarray(np.eye(jacobian.shape[-1]) - kept.swapaxes(-1, -2) @ kept)


def manipulability(jacobian: Array) -> Array:
    """sqrt(det(J J^T)) of J (..., m, n), (...): the product of the m singular values; zero where n < m."""
    if jacobian.shape[-1] < jacobian.shape[-2]:
        return np.zeros(jacobian.shape[:-2])
    return np.asarray(np.linalg.svd(jacobian, compute_uv=False).prod(axis=-1))


def manipulability_gradient(jacobian: Array, rates: Array) -> Array:
    """Gradient of `manipulability` from J (..., m, n) and its derivatives by k coordinates (..., k, m, n), (..., k).

    sum_i (product of the other singular values) u_i^T J' v_i: finite where singular values vanish, too.
    """
    m, n = jacobian.shape[-2:]
    if n < m:
        return np.zeros(rates.shape[:-2])
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    others = np.stack([np.delete(values, i, axis=-1).prod(axis=-1) for i in range(m)], axis=-1)
    return np.asarray(np.einsum("...i,...ji,...kjl,...il->...k", others, left, rates, right, optimize=True))


def damped_inverse(jacobian: Array, threshold: float, damping: float) -> Array:
    """J^T (J J^T + l^2)^-1, (..., n, m), damped where the smallest of the m singular values s falls below the threshold:
    l^2 = damping^2 (1 - (s/threshold)^2) there, else zero (Nakamura and Hanafusa)."""
    left, values, right = np.linalg.svd(jacobian, full_matrices=False)
    least = values[..., -1:] if jacobian.shape[-1] >= jacobian.shape[-2] else np.zeros((*values.shape[:-1], 1))
    square = np.where(least < threshold, damping**2 * (1.0 - (least / threshold) ** 2), 0.0)
    below = values * values + square
    gains = np.divide(values, below, out=np.zeros_like(values), where=below > 0.0)
    return np.asarray(np.einsum("...ij,...i,...ki->...jk", right, gains, left))
