"""What a cooperative system looks at before it trusts its kernels: degenerate points, poles of charts, numbers too large for a float."""

from __future__ import annotations

import numpy as np

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


def look(about: Primitive, source: Source, at: Array) -> tuple[Array, Array]:
    """Cosine and squared sine between direction and reference direction, each (...). Raises DegenerateError where `from_points` of the
    element does: the kernel's measures tell which rows to look at closely, with a margin."""
    guard = evaluate(about, source, "guard", at)
    measure, cosine, sine, reach, pairs = guard[..., 0], guard[..., 1], guard[..., 2], guard[..., 3], guard[..., 4:]
    least = 8.0 * np.maximum(COINCIDENT**2, RELATIVE**2 * reach)  # a radius is at least half the distance of two points
    if (measure <= 2.0 * FLAT).any() or (pairs <= least[..., None]).any() or (reach > FARTHEST**2).any():
        points = source.value("points", at)
        if degenerate(points, about.name).any():
            about.through(points)
        if (reach > FARTHEST**2).any():
            raise DegenerateError(f"{about.name}: one of its points lies more than {FARTHEST:.0e} m from the origin")
    return cosine, sine


def refuse_pole(about: Primitive, cosine: Array, sine: Array, chart: Array) -> None:
    """DegenerateError where a chart has no rotor: the direction is opposite to where its arc begins."""
    if ((chart * cosine < 0.0) & (sine <= POLE * POLE)).any():
        raise DegenerateError(
            f"{about.name}: its direction is opposite to where the chart begins, it is at its pole; take the other chart there, or None"
        )
