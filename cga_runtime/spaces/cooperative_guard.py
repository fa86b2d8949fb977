"""What a cooperative system looks at before it trusts its kernels: degenerate points, poles of charts, numbers too large for a float."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import Array
from cga_runtime.elements.charts import POLE
from cga_runtime.elements.through_points import COINCIDENT, FLAT, degenerate
from cga_runtime.errors import DegenerateError
from cga_runtime.spaces.cooperative_kernels import Source
from cga_runtime.spaces.primitive_kinds import Primitive

RELATIVE = 1e-12
"""Points closer than this fraction of their distance from the origin are one point (elements/through_points.py)."""
FARTHEST = 1e25
"""Distance from the origin (m) up to which no kernel leaves the floats."""


@dataclass(frozen=True)
class Guard:
    """What the kernel `guard` says of points: degeneracy; cosine and squared sine between direction and reference direction; sum of the
    squares of the points; squared distances of all pairs (..., pairs)."""

    measure: Array
    cosine: Array
    sine: Array
    reach: Array
    pairs: Array

    @classmethod
    def of(cls, values: Array) -> Guard:
        """From the kernel's values."""
        return cls(values[..., 0], values[..., 1], values[..., 2], values[..., 3], values[..., 4:])

    def at_pole(self, chart: Array) -> NDArray[np.bool_]:
        """Whether a chart has no rotor: the direction is opposite to where its arc begins, (...)."""
        return np.asarray((chart * self.cosine < 0.0) & (self.sine <= POLE * POLE))


def evaluate(about: Primitive, source: Source, name: str, at: Array, chart: Array | None = None, v: Array | None = None) -> Array:
    """A kernel's value. Raises DegenerateError where it is not finite: points, or velocities, are too large."""
    try:
        value = source.value(name, at, chart, v)
    except DegenerateError:
        value = np.array(np.nan)
    if not np.isfinite(value).all():
        raise DegenerateError(
            f"{about.name}: {name.replace('_', ' ')} is beyond what a float can hold; points are accepted up to {FARTHEST:.0e} m"
        )
    return value


def look(about: Primitive, source: Source, at: Array) -> Guard:
    """What the guard says at q. Raises DegenerateError where `from_points` of the element does: the kernel's measures tell which rows to
    look at closely, with a margin."""
    guard = Guard.of(evaluate(about, source, "guard", at))
    least = 8.0 * np.maximum(COINCIDENT**2, RELATIVE**2 * guard.reach)  # a radius is at least half the distance of two points
    far = (guard.reach > FARTHEST**2).any()
    if far or (guard.measure <= 2.0 * FLAT).any() or (guard.pairs <= least[..., None]).any():
        points = source.value("points", at)
        if degenerate(points, about.name).any():
            about.through(points)
        if far:
            raise DegenerateError(f"{about.name}: one of its points lies more than {FARTHEST:.0e} m from the origin")
    return guard


def refuse_pole(about: Primitive, guard: Guard, chart: Array) -> None:
    """DegenerateError where a chart has no rotor."""
    if guard.at_pole(chart).any():
        raise DegenerateError(
            f"{about.name}: its direction is opposite to where the chart begins, it is at its pole; take the other chart there, or None"
        )
