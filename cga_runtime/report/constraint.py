"""Section "constraint": the configuration where both constraint forces fall on one line (paper C, section 5.2.1)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.singularities import limb_loci
from cga_runtime.report.context import Context, closed_chain
from cga_runtime.report.figures import Figure, figure, heat_map, label, limits_box, on_map
from cga_runtime.report.limb import LOCUS, compared
from cga_runtime.robot import Robot

Array = NDArray[np.float64]

RANGE = 2.0
"""Half-width of the map over (q2, q7) (rad)."""


Z = "√(f²+f²) (mm)"


def section(context: Context) -> dict[str, Any]:
    """Mobility with both S centres on the common ShoulderPitch line (q2 = q2*, q7 = q7*), and whether the limits allow it.

    joint_mobility counts the self-motions of the arms; wrench_rank counts the wrench, besides the force along U S, that each arm gains by
    losing a direction.
    """
    loop, half = context.loop, context.loop.right.n
    q = context.parallel_pose.copy()
    q[1], q[half + 1] = context.q2_star
    found = loop.mobility(q)
    right, left = limb_loci(loop)
    return {
        "q": q,
        "object_dof": found.object_dof,
        "joint_mobility": found.joint_mobility,
        "motion": found.motion,
        "limb_ranks": list(found.limb_ranks),
        "force_rank": force_rank(loop, q),
        "wrench_rank": found.constraint_rank,
        "reachable": right.inside and left.inside,
        "distance_to_limits_rad": float(np.hypot(right.margin, left.margin)),
    }


def force_rank(loop: ClosedChain, q: Array) -> int:
    """Number of independent forces among the two along U S (1 at the constraint singularity, else 2)."""
    return int(np.linalg.matrix_rank(loop.kernel("constraint_wrenches")(q), tol=1e-9))


def figures(context: Context) -> dict[str, Figure]:
    """For each robot compared: a map of hypot(f_R, f_L) over (q2, q7), which is zero exactly at the constraint singularities."""
    grid = np.linspace(-RANGE, RANGE, context.sizes.grid)
    maps = [(robot, loop := closed_chain(robot), _map(loop, grid)) for robot in compared(context.robot)]
    top = max(float(z.max()) for _, _, z in maps)
    return {f"constraint-{k}": _figure(robot, loop, grid, z, top) for k, (robot, loop, z) in enumerate(maps)}


def _map(loop: ClosedChain, grid: Array) -> Array:
    """hypot(f_R, f_L) in mm."""
    q = np.zeros((len(grid), len(grid), loop.n))
    q[..., 1], q[..., loop.right.n + 1] = np.meshgrid(grid, grid)
    f = loop.kernel("limb_factors")(q)[..., 0]
    return np.asarray(1e3 * np.hypot(f[..., 0], f[..., 1]))


def _figure(robot: Robot, loop: ClosedChain, grid: Array, z: Array, top: float) -> Figure:
    j = loop.right.n + 1
    right, left = limb_loci(loop)
    trace, layout = heat_map(
        grid, grid, z, x_title="q2 right ShoulderRoll (rad)", y_title="q7 left ShoulderRoll (rad)", z_title=Z, z_max=top
    )
    box, words = limits_box((loop.lower[1], loop.lower[j]), (loop.upper[1], loop.upper[j]))
    star = {
        "type": "scatter",
        "x": [right.q2_star],
        "y": [left.q2_star],
        "mode": "markers",
        "marker": {"color": LOCUS, "size": 13, "symbol": "x", "line": {"color": "white", "width": 1.5}},
        "name": "constraint singularity",
        "showlegend": False,
        "hovertemplate": "q2* = %{x:.4f}, q7* = %{y:.4f}<extra>constraint singularity</extra>",
    }
    inside = right.inside and left.inside
    title = f"{label(robot.name)}: {'inside' if inside else 'outside'} the limits"
    marks = [words, on_map(right.q2_star, left.q2_star, "q2*, q7*", yshift=16)]
    return figure([trace, box, star], {**layout, "title": {"text": title}, "annotations": marks})
