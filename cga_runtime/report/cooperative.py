"""Section "cooperative": the two hands as one point pair and as one line, free of any object (paper A, sections 3.2 to 3.7).

All joints move the two hand points, which span a point pair (6 numbers) and a line (4). Bivectors are seen from the pair's own frame: its
origin halfway between the hands, e2 from the right hand to the left, lengths in units of r, half the distance of the hands. Every motion of
the hands is one of the pair, so its horizontal Jacobian J has the singular values of the hands' Jacobian over sqrt(2) r, and
sqrt(det(J J^T)) = m_R m_L / (8 r^6), m being the same measure of each hand's own Jacobian. The line's are the four rows across it.
"""

from __future__ import annotations

from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.mobility import RANK_TOLERANCE
from cga_runtime.coordinates import norm
from cga_runtime.elements import Point
from cga_runtime.report.context import GENERIC_POSE, Context
from cga_runtime.report.cooperative_motions import self_motions
from cga_runtime.report.cooperative_ways import ways
from cga_runtime.report.figures import Figure, figure
from cga_runtime.solve.inverse_kinematics import inverse_kinematics
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.jacobian_measures import manipulability
from cga_runtime.versors import Similarity

Array = NDArray[np.float64]

NEAREST, RESTARTS = 10, 20
"""Poses, those with the nearest hands, from which it is tried to bring the hands together, and further starts of each try."""
SHOWN = 800
"""Poses (at most) that a figure shows."""


def section(context: Context) -> dict[str, Any]:
    """samples: number of random poses inside the limits that the statistics are of.

    hands_distance (m): minimum, p05, median, p95, maximum. hands_meet: tried, found, distance: from how many of the poses with the nearest
    hands inverse kinematics brings the left hand to the right one, where the pair is degenerate, and the least distance found (m).
    frame: forward, up: median angle (rad) of e1 to the torso's x and of e3 to its z; opposite: least angle (rad) of e2 to the direction
    where the shortest arc fails. product_error: largest relative deviation of sqrt(det(J J^T)) from m_R m_L / (8 r^6). stretched: median of
    |cos| between the weakest motion of the hands, which is one of a single hand, and that hand's line to its shoulder.

    point_pair, line: joints, task_dimension, nullspace_dimension (at the generic pose), controllable; of the library's horizontal Jacobian
    full_rank: poses whose smallest singular value is more than rank_tolerance times the largest, least_ratio: the smallest such ratio,
    manipulability: median, p05 (of the line in rad^2 m^2); of the hands' motion, for the line across it, weakest, strongest: median, p05
    (m of both hands for 1 rad of all joints, both as root sums of squares), condition: median, p95; rates: median over the poses of the
    fastest that joints of unit speed change each bivector (rad or r for 1 rad); shares: mean square of each in the weakest motion.

    nullspace: see self_motions. interpolation: see ways. inverse_kinematics: of each kind tried, solved, and of the solved targets
    solved_first_start, iterations_median, iterations_max, starts_max (None where none was); seconds_each: of all targets, by their number.
    """
    pair, line = context.pair, context.line
    poses = context.loop.random(np.random.default_rng(context.seed), context.sizes.samples)
    rotation, hands, moving = Similarity(pair.similarity(poses)).rotation().matrix(), pair.points(poses), pair.point_jacobian(poses)
    distance, half = pair.degeneracy(poses), context.loop.right.n
    alone = manipulability(moving[:, :3, :half]) * manipulability(moving[:, 3:, half:])
    at = np.array(GENERIC_POSE)
    return {
        "samples": len(poses),
        "hands_distance": quantiles(distance, minimum=0.0, p05=0.05, median=0.5, p95=0.95, maximum=1.0),
        "hands_meet": meeting(context, poses[np.argsort(distance)[:NEAREST]], pair),
        "frame": {
            "forward": _median_angle(rotation[:, 0, 0]),
            "up": _median_angle(rotation[:, 2, 2]),
            "opposite": float(np.arccos(-rotation[:, 1, 1].min())),
        },
        "product_error": float(np.abs(pair.manipulability(poses) / (alone / (8.0 * (0.5 * distance) ** 6)) - 1.0).max()),
        "stretched": stretched(context, hands, moving),
        **{system.kind: _measures(system, pair, poses, at) for system in (pair, line)},
        "nullspace": self_motions(context, at),
        "interpolation": ways(context),
        "inverse_kinematics": {system.kind: reached(context, system, index) for index, system in enumerate((pair, line))},
    }


def quantiles(values: Array, **shares: float) -> dict[str, float]:
    """Named quantiles."""
    return dict(zip(shares, np.quantile(values, list(shares.values())).tolist(), strict=True))


def _median_angle(cosines: Array) -> float:
    return float(np.median(np.arccos(np.clip(cosines, -1.0, 1.0))))


def hand_motion(system: Cooperative, pair: Cooperative, q: Array) -> Array:
    """The system's rows of the pair's horizontal Jacobian as motion of the hands, (..., rows, n): m of both for 1 rad of all joints."""
    rows = pair.horizontal_jacobian(q)[..., system.about.rows, :]
    return np.asarray(pair.degeneracy(q)[..., None, None] / np.sqrt(2.0) * rows)


def _measures(system: Cooperative, pair: Cooperative, poses: Array, at: Array) -> dict[str, Any]:
    own = np.linalg.svd(system.horizontal_jacobian(poses)[:, system.about.rows], compute_uv=False)
    left, values, _ = np.linalg.svd(hand_motion(system, pair, poses), full_matrices=False)
    lengths = np.linalg.norm(pair.horizontal_jacobian(poses)[:, system.about.rows], axis=-1)
    ratio = own[:, -1] / own[:, 0]
    return {
        "joints": system.n,
        "task_dimension": len(system.controllable),
        "nullspace_dimension": round(float(np.trace(system.nullspace(at)))),
        "controllable": list(system.controllable),
        "full_rank": int((ratio > RANK_TOLERANCE).sum()),
        "rank_tolerance": RANK_TOLERANCE,
        "least_ratio": float(ratio.min()),
        "manipulability": quantiles(system.manipulability(poses), median=0.5, p05=0.05),
        "weakest": quantiles(values[:, -1], median=0.5, p05=0.05),
        "strongest": quantiles(values[:, 0], median=0.5, p05=0.05),
        "condition": quantiles(values[:, 0] / values[:, -1], median=0.5, p95=0.95),
        "rates": dict(zip(system.controllable, np.median(lengths, axis=0).tolist(), strict=True)),
        "shares": dict(zip(system.controllable, (left[:, :, -1] ** 2).mean(axis=0).tolist(), strict=True)),
    }


def stretched(context: Context, hands: Array, moving: Array) -> float:
    """Median of |cos| between the weakest motion of the hands, taken of the hand that moves more, and that hand's line to its shoulder."""
    weakest = np.linalg.svd(moving, full_matrices=False)[0][:, :, -1].reshape(-1, 2, 3)
    arms = context.arms(np.array(GENERIC_POSE))  # shoulders stay where they are
    towards = hands - np.stack([arms.right.u, arms.left.u])
    cosine = (weakest * towards).sum(axis=-1) / (norm(weakest) * norm(towards)).clip(min=1e-12)
    return float(np.median(np.abs(np.where(norm(weakest[:, 0]) > norm(weakest[:, 1]), cosine[:, 0], cosine[:, 1]))))


def meeting(context: Context, poses: Array, pair: Cooperative) -> dict[str, Any]:
    """How often the left hand comes to where the right one is, from poses given, and the least distance (m) that this leaves."""
    left = context.loop.left
    rng = np.random.default_rng([context.seed, 2])
    found = inverse_kinematics(left, Point(pair.points(poses)[:, 0]), poses[:, context.loop.right.n :], rng, restarts=RESTARTS)
    return {"tried": len(poses), "found": int(found.success.sum()), "distance": float(found.residual.min())}


def reached(context: Context, system: Cooperative, index: int) -> dict[str, Any]:
    """Primitives of random poses inside the limits as targets, from the middle of the limits, then from random starts."""
    targets, starts = (np.random.default_rng([context.seed, index, use]) for use in (0, 1))  # starts that know nothing of the targets
    wanted = Similarity(system.similarity(system.random(targets, context.sizes.tries)))
    begin = perf_counter()
    found = inverse_kinematics(system, wanted, 0.5 * (system.lower + system.upper), starts)
    each = (perf_counter() - begin) / context.sizes.tries
    of, some = found.success, bool(found.success.any())
    return {
        "tried": context.sizes.tries,
        "solved": int(of.sum()),
        "solved_first_start": int((of & (found.starts == 1)).sum()),
        "iterations_median": float(np.median(found.iterations[of])) if some else None,
        "iterations_max": int(found.iterations[of].max()) if some else None,
        "starts_max": int(found.starts[of].max()) if some else None,
        "seconds_each": each,
    }


# ---- what the page shows

BIVECTORS: dict[str, str] = {
    "e12": "turns the pair about e3: one hand forward, the other back",
    "e23": "turns the pair about e1: one hand up, the other down",
    "e13": "turns the pair about e2, its own direction: moves neither hand",
    "e0i": "hands together (+) or apart (−): −d log r",
    "e1i": "both hands forward, along e1",
    "e2i": "both hands to the left, along their line",
    "e3i": "both hands up, along e3",
}
"""What a rate of each bivector does, for a robot whose torso looks along x."""


def figures(context: Context) -> dict[str, Figure]:
    """The pair's manipulability against the distance of the hands, and how far the weakest motion of the hands goes."""
    pair, line = context.pair, context.line
    poses = context.loop.random(np.random.default_rng(context.seed), context.sizes.samples)
    return {
        "cooperative-manipulability": _cloud(pair, poses[:SHOWN]),
        "cooperative-weakest": _weakest({"point pair": hand_motion(pair, pair, poses), "line": hand_motion(line, pair, poses)}),
    }


def _cloud(pair: Cooperative, poses: Array) -> Figure:
    distance, measure = pair.degeneracy(poses), pair.manipulability(poses)
    ends = np.array([distance.min(), distance.max()])
    middle = np.exp(np.log(measure).mean() + 6.0 * np.log(distance).mean())  # the line of slope -6 through the middle of the cloud
    traces = [
        {
            "type": "scatter",
            "mode": "markers",
            "name": "poses",
            "x": distance,
            "y": measure,
            "marker": {"color": "var(--right)", "size": 5, "opacity": 0.45},
            "hovertemplate": "hands %{x:.3f} m apart<br>manipulability %{y:.2e}<extra></extra>",
        },
        {
            "type": "scatter",
            "mode": "lines",
            "name": "distance to the power −6",
            "x": ends,
            "y": middle / ends**6,
            "line": {"color": "var(--left)", "width": 3},
            "hoverinfo": "name",
        },
    ]
    axes = {
        "xaxis": {"title": {"text": "distance of the hands (m)"}, "type": "log", "tickvals": [0.05, 0.1, 0.2, 0.3, 0.4, 0.6]},
        "yaxis": {"title": {"text": "manipulability of the point pair"}, "type": "log", "exponentformat": "power", "dtick": 2},
    }
    return figure(traces, {**axes, "title": {"text": ""}})


STYLE = {"point pair": ("var(--force)", "solid"), "line": ("var(--good)", "dash")}


def _weakest(motions: dict[str, Array]) -> Figure:
    traces = []
    shares = np.linspace(0.0, 1.0, 201)
    for name, motion in motions.items():
        weakest = 1e3 * np.quantile(np.linalg.svd(motion, compute_uv=False)[:, -1], shares)
        colour, dash = STYLE[name]
        traces.append(
            {
                "type": "scatter",
                "mode": "lines",
                "name": name,
                "x": weakest,
                "y": 100.0 * shares,
                "line": {"color": colour, "width": 3, "dash": dash},
                "hovertemplate": "%{y:.0f} % of the poses: %{x:.0f} mm or less<extra></extra>",
            }
        )
    axes = {
        "xaxis": {"title": {"text": "weakest motion (mm for 1 rad)"}, "rangemode": "tozero"},
        "yaxis": {"title": {"text": "share of the poses (%)"}, "range": [0.0, 104.0]},
    }
    return figure(traces, {**axes, "title": {"text": ""}})
