"""Mobility of a closed chain by screw theory: twist systems, constraint wrenches, motion type (paper C, section 4).

Twists are (w, v), wrenches (f, m), about the root frame's origin; reciprocal when f.v + m.w = 0 (paper C, eq. 10). Ranks are of matrices
whose translational rows (v, m) are divided by LENGTH; singular values below RANK_TOLERANCE times the largest, or times 1, count as zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.errors import WrongSizeError
from cga_runtime.spaces.closed_chain import LENGTH, ClosedLoop

Array = NDArray[np.float64]

RANK_TOLERANCE = 1e-9
PITCH_TOLERANCE = 1e-9
"""A wrench whose pitch is below this (m) is a pure force along a line."""


@dataclass(frozen=True)
class Wrench:
    """One constraint wrench: unit force f and moment m about the origin; pitch (m); a point on its line (nearest to the origin).

    A pure moment has f = 0, unit m, infinite pitch and no point.
    """

    f: Array
    m: Array
    pitch: float
    point: Array | None

    @property
    def pure_force(self) -> bool:
        """Whether it is a force along a line (zero pitch)."""
        return abs(self.pitch) < PITCH_TOLERANCE

    def bivector(self) -> Array:
        """Coefficients e01 e02 e12 e03 e13 e23 of f_x e01 + f_y e02 + f_z e03 + m_x e23 - m_y e13 + m_z e12."""
        return np.array([self.f[0], self.f[1], self.m[2], self.f[2], -self.m[1], self.m[0]])


@dataclass(frozen=True)
class Mobility:
    """What moves, and how, at one configuration.

    joint_mobility: dimension of the joint velocities that keep the loop closed. object_dof: dimension of the object's twists.
    motion: dimensions of its pure translations (T) and of the rest (R), e.g. "1T3R". limb_ranks: rank of each arm's twist system.
    constraint_rank: rank of the wrenches of both arms together. wrenches: a basis for each arm. twist_system: orthonormal basis (6, dof) of
    the object's twists (w, v / LENGTH).
    """

    joint_mobility: int
    object_dof: int
    motion: str
    limb_ranks: tuple[int, int]
    constraint_rank: int
    wrenches: tuple[tuple[Wrench, ...], tuple[Wrench, ...]]
    twist_system: Array

    @property
    def constraint_wrenches(self) -> Array:
        """All constraint wrenches as wrench bivectors, (k, 6): the right arm's, then the left's."""
        rows = [wrench.bivector() for arm in self.wrenches for wrench in arm]
        return np.array(rows).reshape(-1, 6)


def mobility(loop: ClosedLoop, q: ArrayLike) -> Mobility:
    """The mobility of a closed chain at q, shape (n,), for the grasp that q closes (paper C, eqs. 11-16)."""
    q = loop.check(q)
    if q.ndim != 1:
        raise WrongSizeError(f"mobility is that of one configuration: q of shape ({loop.n},) needed, {q.shape} given")
    twists = loop.twists(q)
    twists = np.concatenate([twists[:3], twists[3:] / LENGTH])
    arms = twists[:, : loop.right.n], twists[:, loop.right.n :]
    ranks = (_rank(arms[0]), _rank(arms[1]))
    # (f, m) is reciprocal to (w, v) when m.w + f.v = 0: rows of the null space are (m, f * LENGTH), matching (w, v / LENGTH)
    reciprocal = [_null_space(arm.T) for arm in arms]
    together = np.concatenate(reciprocal, axis=1)
    constraint_rank = _rank(together) if together.size else 0
    system = _null_space(together.T) if together.size else np.eye(6)
    dof = system.shape[1]
    translations = dof - _rank(system[:3])
    return Mobility(
        joint_mobility=loop.n - _rank(np.concatenate([arms[0], -arms[1]], axis=1)),
        object_dof=dof,
        motion=f"{translations}T{dof - translations}R",
        limb_ranks=ranks,
        constraint_rank=constraint_rank,
        wrenches=(_wrenches(reciprocal[0]), _wrenches(reciprocal[1])),
        twist_system=system,
    )


def _rank(matrix: Array) -> int:
    values = np.linalg.svd(matrix, compute_uv=False)
    return int((values > RANK_TOLERANCE * max(values.max(initial=0.0), 1.0)).sum())


def _null_space(rows: Array) -> Array:
    """Orthonormal columns that span {x: rows x = 0}."""
    _, values, vt = np.linalg.svd(rows)
    rank = int((values > RANK_TOLERANCE * max(values.max(initial=0.0), 1.0)).sum())
    return np.asarray(vt[rank:].T)


def _wrenches(basis: Array) -> tuple[Wrench, ...]:
    """Wrenches of an arm from the columns (m, f LENGTH) of its reciprocal system."""
    found = []
    for column in basis.T:
        m, f = column[:3], column[3:] / LENGTH
        size = float(np.linalg.norm(f))
        if size < RANK_TOLERANCE:
            found.append(Wrench(np.zeros(3), m / np.linalg.norm(m), np.inf, None))
            continue
        sign = np.sign(f[np.abs(f).argmax()])  # a line has no sense; the largest component is made positive
        f, m = sign * f / size, sign * m / size
        found.append(Wrench(f, m, float(f @ m), np.cross(f, m)))
    return tuple(found)
