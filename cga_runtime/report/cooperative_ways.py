"""The ways of the hands' point pair from one pose to another in two charts of the logarithm (paper A, section 3.3, Figure 4)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import norm, times
from cga_runtime.elements import PointPair
from cga_runtime.elements.similarities import interpolate
from cga_runtime.report.context import Context
from cga_runtime.solve.inverse_kinematics import inverse_kinematics

Array = NDArray[np.float64]

ENDS = ((-0.1, -0.05, 1.2, 0.5, -1.0, 1.0, 0.8, -1.45, -0.9, -0.2), (1.3, 0.2, -0.8, 0.2, -1.4, 0.25, -0.15, 0.1, -0.45, -1.2))
"""Two poses (rad) between which the NAO's hands turn by a right angle, and which it can reach on both ways."""
CHARTS = {
    "split": "the centre moves straight and the direction on the shortest arc",
    "lie": "one motion of constant twist: hands and centre on spirals about one axis",
}
POINTS = 41
"""Points on a way, both ends included."""
RESTARTS = 20


def ways(context: Context) -> dict[str, Any]:
    """From the first to the second of ENDS: q (2, n); turn: angle (rad) between both directions; growth: ratio of the distances of
    the hands; apart: the largest distance (m) between the hands of both charts at one time.

    split, lie: hands (points, 2, 3); centre, right, left: lengths (m) of their paths; steps, followed: points on the way, and how many of
    them inverse kinematics reaches inside the limits, started on the straight way of the joints.
    """
    q = np.array(ENDS)
    start, end = (PointPair.from_points(*context.pair.points(at)) for at in q)
    instants = np.linspace(0.0, 1.0, POINTS)
    found: dict[str, Any] = {}
    for chart in CHARTS:
        way = interpolate(start, end, instants, chart)
        half = times(way.radius, way.direction)
        hands = np.stack([way.center - half, way.center + half], axis=1)
        blend = q[0] + instants[:, None] * (q[1] - q[0])
        reached = inverse_kinematics(context.pair, way, blend, np.random.default_rng(context.seed), restarts=RESTARTS)
        found[chart] = {
            "hands": hands,
            **{name: _length(x) for name, x in (("centre", way.center), ("right", hands[:, 0]), ("left", hands[:, 1]))},
            "steps": POINTS,
            "followed": int(reached.success.sum()),
        }
    return {
        "q": q,
        "turn": float(np.arctan2(norm(np.cross(start.direction, end.direction)), start.direction @ end.direction)),
        "growth": float(end.radius / start.radius),
        "apart": float(norm(found["split"]["hands"] - found["lie"]["hands"]).max()),
        **found,
    }


def _length(path: Array) -> float:
    return float(norm(np.diff(path, axis=0)).sum())
