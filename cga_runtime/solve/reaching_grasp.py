"""How two arms hold the object that `reach` moves: grasp, margins against singularities, and what they are measured against."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, read
from cga_runtime.elements import Motor
from cga_runtime.errors import DegenerateError, GraspError, SchemeError, WrongSizeError
from cga_runtime.spaces.closed_chain import CLOSED, LENGTH, ClosedLoop

SINGULAR = 1e-9
"""A limb factor f sin q4 / LENGTH, or a determinant D_a, below this at q0 counts as zero: margins cannot be relative to it."""
MARGIN_TOLERANCE = 1e-8
"""How far a solution may miss a margin."""


@dataclass(frozen=True)
class Check:
    """What a solution must satisfy: by how much it is violated, over its tolerance (at most 1 passes), and what to say if it does not."""

    violation: float
    missed: str


@dataclass(frozen=True)
class Held:
    """A closed chain, its grasp X (8,), the moved point (3,) in the right hand's frame, and the margins.

    limb_signs are those of f sin q4 at q0, determinant is D_a at q0, scheme the actuated joints (1-based).
    """

    loop: ClosedLoop
    grasp: Array
    object_point: Array
    limb_margin: float | None
    limb_signs: Array
    scheme: tuple[int, ...] | None
    scheme_fraction: float
    determinant: float
    conditioning_weight: float

    def points(self, q: Array) -> Array:
        """Where the object's point is (m), (1, 3)."""
        pose = self.loop.right.pose(q[: self.loop.right.n])
        return np.asarray(pose[:3, :3] @ self.object_point + pose[:3, 3])[None]

    def checks(self, q: Array) -> list[Check]:
        """Closure, and the margins that are asked for."""
        error = float(np.abs(self.loop.closure_error(q, self.grasp)).max())
        found = [Check(error / CLOSED, f"grasp not closed: closure error {error:.2g}, at most {CLOSED:.0e} allowed")]
        if self.limb_margin is not None:
            for arm, kept in zip(("right", "left"), self.limb_signs * limb_values(self.loop, q), strict=True):
                missed = f"limb margin of the {arm} arm not kept: {kept:.4g}, at least {self.limb_margin:g} wanted"
                found.append(Check(float(self.limb_margin - kept) / MARGIN_TOLERANCE, missed))
        if self.scheme is not None:
            ratio = float(self.loop.determinant(q, self.scheme)) / self.determinant
            missed = f"scheme margin not kept: D_a / D_a(q0) is {ratio:.4g}, at least {self.scheme_fraction:g} wanted"
            found.append(Check((self.scheme_fraction - ratio) / MARGIN_TOLERANCE, missed))
        return found

    def violation(self, q: Array) -> float:
        """Closure error and missed margins, each over its tolerance; at most 1 for a valid configuration."""
        return max(check.violation for check in self.checks(q))


def number(value: ArrayLike, what: str) -> float:
    """One finite number. Raises WrongSizeError, NotFiniteError."""
    array = read(value, what)
    if array.ndim:
        raise WrongSizeError(f"{what}: {value!r:.80} given, a single number is needed")
    return float(array)


def limb_values(loop: ClosedLoop, q: Array) -> Array:
    """f sin q4 / LENGTH of the right and the left arm, (2,)."""
    if "limb_factors" not in loop.unit.names:
        raise DegenerateError(f"limb_margin: the arms {loop.right.frame} and {loop.left.frame} have no wrist centre, hence no limb factors")
    return np.asarray(loop.kernel("limb_factors")(q).prod(axis=-1) / LENGTH)


def hold(
    loop: ClosedLoop,
    q0: Array,
    grasp: ArrayLike | Motor | None = None,
    object_point: ArrayLike | None = None,
    limb_margin: float | None = None,
    scheme_margin: tuple[Sequence[int], float] | None = None,
    conditioning_weight: float = 0.0,
) -> Held:
    """Checks the arguments of `reach` that belong to a closed chain and evaluates what they are relative to at q0."""
    motor = loop.grasp(q0) if grasp is None else (grasp if isinstance(grasp, Motor) else Motor(read(grasp, "grasp", 8))).coefficients
    point = read((0.0, 0.0, 0.0) if object_point is None else object_point, "object_point", 3)
    for array, what in ((motor, "grasp"), (point, "object_point")):
        if array.ndim != 1:
            raise DegenerateError(f"{what}: one at a time; its batch shape is {array.shape[:-1]}")
    signs = np.ones(2)
    if limb_margin is not None:
        limb_margin = number(limb_margin, "limb_margin")
        at_start = limb_values(loop, q0)
        if np.abs(at_start).min() <= SINGULAR:
            raise DegenerateError("limb_margin: q0 is a limb singularity; begin on one of its sides")
        signs = np.sign(at_start)
    scheme, fraction, determinant = None, 0.0, 1.0
    if scheme_margin is not None:
        scheme, fraction, determinant = _scheme_at(loop, q0, motor, scheme_margin)
    weight = number(conditioning_weight, "conditioning_weight")
    return Held(loop, motor, point, limb_margin, signs, scheme, fraction, determinant, weight)


def _scheme_at(
    loop: ClosedLoop, q0: Array, grasp: Array, scheme_margin: tuple[Sequence[int], float]
) -> tuple[tuple[int, ...], float, float]:
    """Actuated joints, fraction, and D_a(q0)."""
    try:
        actuated, fraction = scheme_margin
    except (TypeError, ValueError):
        raise SchemeError(f"scheme_margin: {scheme_margin!r} given; actuated joints and a fraction needed, as ((1, 3, 7, 8), .5)") from None
    scheme = tuple(j + 1 for j in loop.scheme(actuated)[0])
    least = number(fraction, "fraction of scheme_margin")
    try:
        loop.require_closed(q0, grasp)
    except GraspError as error:
        raise GraspError(f"scheme_margin is a fraction of D_a at q0, where {error}") from None
    determinant = float(loop.determinant(q0, scheme))
    if abs(determinant) <= SINGULAR:
        raise DegenerateError(f"scheme_margin: D_a of the scheme {scheme} is {determinant:.1e} at q0; a fraction of zero says nothing")
    return scheme, least, determinant
