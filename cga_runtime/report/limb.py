"""Section "limb": where one arm loses a degree of freedom, and whether the joint limits allow it (paper C, section 5.1)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.singularities import limb_factor_identity, limb_loci
from cga_runtime.loading import load_robot
from cga_runtime.report.arms import arms_at
from cga_runtime.report.context import Context, closed_chain
from cga_runtime.report.figures import Figure, figure, heat_map, label, limits_box, on_map
from cga_runtime.robot import Robot

Array = NDArray[np.float64]

RANGE_Q2, RANGE_Q4 = (-2.2, 1.0), (-0.5, 2.0)
"""What the maps show (rad): the limits of both NAO versions with a margin."""
SWEEP = 2001
LOCUS = "#ff5a36"
"""Colour of singular loci: stands out from every colour of the maps."""


def section(context: Context) -> dict[str, Any]:
    """q2*, its distance to the limits, and the check of sqrt det(J_S^T J_S) = |f sin q4| |US| on random poses (both arms)."""
    loop = context.loop
    right, left = limb_loci(loop)
    poses = loop.random(np.random.default_rng(context.seed), context.sizes.samples)
    arms = context.arms(poses[0])
    return {
        "q2_star_right": right.q2_star,
        "q2_star_left": left.q2_star,
        "q2_star_inside_limits": right.inside or left.inside,
        "margin_rad": min(right.margin, left.margin),
        "factor_identity_error": float(np.abs(limb_factor_identity(loop, poses)).max()),
        "factor_identity_poses": len(poses),
        "length_us": float(np.linalg.norm(arms.right.s - arms.right.u)),
        "f_in_limits": factor_range(loop, 1, 0),
        "sin_q4_in_limits": factor_range(loop, 3, 1),
        "reachable": right.inside or left.inside or _contains_zero(factor_range(loop, 3, 1)),
    }


def factor_range(loop: ClosedChain, joint: int, factor: int) -> list[float]:
    """Least and greatest value of the right arm's factor f (0, in m) or sin q4 (1) while its joint sweeps its limits."""
    q = np.zeros((SWEEP, loop.n))
    q[:, joint] = np.linspace(loop.lower[joint], loop.upper[joint], SWEEP)
    values = loop.kernel("limb_factors")(q)[:, 0, factor]
    return [float(values.min()), float(values.max())]


def _contains_zero(interval: list[float]) -> bool:
    return interval[0] <= 0.0 <= interval[1]


def compared(robot: Robot) -> list[Robot]:
    """The robot and the bundled NAO versions that are not the same robot."""
    return [robot, *(load_robot(name) for name in ("nao", "nao_v32") if name != robot.name)]


def figures(context: Context) -> dict[str, Figure]:
    """One map of |f sin q4| |US| over (q2, q4) of the right arm for each robot compared."""
    q2, q4 = (np.linspace(*span, context.sizes.grid) for span in (RANGE_Q2, RANGE_Q4))
    maps = [(robot, loop := closed_chain(robot), _map(loop, q2, q4)) for robot in compared(context.robot)]
    top = max(float(z.max()) for _, _, z in maps)
    return {f"limb-{k}": _figure(robot, loop, q2, q4, z, top) for k, (robot, loop, z) in enumerate(maps)}


def _map(loop: ClosedChain, q2: Array, q4: Array) -> Array:
    """|f sin q4| |US| in cm^2, (len(q4), len(q2))."""
    q = np.zeros((len(q4), len(q2), loop.n))
    q[..., 1], q[..., 3] = np.meshgrid(q2, q4)
    arm = arms_at(loop, q[0, 0]).right
    factors = loop.kernel("limb_factors")(q)[..., 0, :]
    return np.asarray(1e4 * np.abs(factors.prod(axis=-1)) * np.linalg.norm(arm.s - arm.u))


def _figure(robot: Robot, loop: ClosedChain, q2: Array, q4: Array, z: Array, top: float) -> Figure:
    star = limb_loci(loop)[0]
    trace, layout = heat_map(q2, q4, z, x_title="q2 ShoulderRoll (rad)", y_title="q4 ElbowRoll (rad)", z_title="√det JᵀJ (cm²)", z_max=top)
    box, words = limits_box((loop.lower[1], loop.lower[3]), (loop.upper[1], loop.upper[3]))
    lines = [
        ([star.q2_star] * 2, [q4[0], q4[-1]], f"q2* = {star.q2_star:.4f}".replace("-", "−")),
        ([q2[0], q2[-1]], [0.0, 0.0], "q4 = 0"),
    ]
    drawn = {"type": "scatter", "mode": "lines", "line": {"color": LOCUS, "width": 3}, "hoverinfo": "name"}
    loci = [{**drawn, "x": x, "y": y, "name": name} for x, y, name in lines]
    marks = [
        words,
        on_map(star.q2_star, q4[-1], lines[0][2], yanchor="top", xanchor="left", xshift=3),
        on_map(q2[-1], 0.0, "q4 = 0", xanchor="right"),
    ]
    outside = "inside the limits" if star.inside else f"{star.margin:.4f} rad outside"
    return figure(
        [trace, box, *loci], {**layout, "title": {"text": f"{label(robot.name)}: q2* {outside}"}, "annotations": marks, "showlegend": False}
    )
