"""Section "mobility": what the grasped object can do at a generic and at a parallel pose, and the drawings of both (paper C, section 4)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.mobility import Mobility
from cga_runtime.report.arms import Arms, line_through
from cga_runtime.report.context import GENERIC_POSE, Context

Array = NDArray[np.float64]

CHECKED = 200
"""Random poses (at most) at which the generic numbers are checked."""
SPAN = 1e-6
"""Smallest singular value, moments divided by the length |US|, of twists that count as independent."""


def section(context: Context) -> dict[str, Any]:
    """Mobility at both poses, and at random ones: `poses_agreeing` of `poses_checked` have the numbers of the generic pose."""
    loop = context.loop
    generic, parallel = _pose(context, np.array(GENERIC_POSE)), _pose(context, context.parallel_pose)
    rng = np.random.default_rng(context.seed)
    poses = loop.random(rng, min(CHECKED, context.sizes.samples))
    wanted = [generic[key] for key in _NUMBERS]
    agreeing = sum([_numbers(loop.mobility(q))[key] for key in _NUMBERS] == wanted for q in poses)
    return {
        **{key: generic[key] for key in _NUMBERS if key != "motion"},
        "motion_generic": generic["motion"],
        "motion_parallel": parallel["motion"],
        "poses_checked": len(poses),
        "poses_agreeing": agreeing,
        "generic": generic,
        "parallel": parallel,
    }


_NUMBERS = ("joint_mobility", "object_dof", "motion", "limb_ranks", "constraint_rank")


def _numbers(found: Mobility) -> dict[str, Any]:
    return {key: list(value) if isinstance(value := getattr(found, key), tuple) else value for key in _NUMBERS}


def _pose(context: Context, q: Array) -> dict[str, Any]:
    found, arms = context.loop.mobility(q), context.arms(q)
    forces = [wrench for arm in found.wrenches for wrench in arm]
    twists = object_twists(arms, np.array([wrench.f for wrench in forces]))
    powers = [abs(float(wrench.f @ twist["v"] + wrench.m @ twist["w"])) for wrench in forces for twist in twists]
    f, g = forces[0].f, forces[-1].f
    return {
        "q": q,
        "inside_limits": bool(((context.limits[0] <= q) & (q <= context.limits[1])).all()),
        **_numbers(found),
        "wrenches": [{"force": w.f, "moment": w.m, "pitch": w.pitch if np.isfinite(w.pitch) else None, "point": w.point} for w in forces],
        "angle_between_forces": float(np.arctan2(np.linalg.norm(np.cross(f, g)), abs(float(f @ g)))),
        "twists": twists,
        "reciprocity_error": max(powers),
    }


def object_twists(arms: Arms, forces: Array) -> list[dict[str, Any]]:
    """A basis of the object's twists made of pure translations and pure rotations, from the geometry alone.

    A force along a line does no work on a translation normal to it, nor on a rotation about a line that it meets. So the object may
    translate along every direction normal to both forces, and turn about the edges of the tetrahedron U_R S_R S_L U_L that meet both:
    the shoulder line, the line of the S centres, and the two lines across. Each twist: kind, name, w and v about the origin, and the
    two points that the axis of a rotation goes through.
    """
    right, left = arms.right, arms.left
    twists: list[dict[str, Any]] = [
        {"kind": "translation", "name": "normal to both forces", "w": np.zeros(3), "v": _signed(n), "points": None}
        for n in normals(forces, left.u - right.u)
    ]
    edges = {
        "shoulder line U_R U_L": (right.u, left.u),
        "line S_R S_L of the S centres": (right.s, left.s),
        "line S_R U_L": (right.s, left.u),
        "line S_L U_R": (left.s, right.u),
    }
    length = float(np.linalg.norm(right.s - right.u))
    for name, (a, b) in edges.items():
        w, v = line_through(a, b)
        trial = np.array([np.concatenate([t["w"], t["v"] / length]) for t in [*twists, {"w": w, "v": v}]])
        if np.linalg.svd(trial, compute_uv=False)[-1] > SPAN:
            twists.append({"kind": "rotation", "name": name, "w": w, "v": v, "points": [a, b]})
    return twists


def normals(forces: Array, shoulders: Array) -> Array:
    """Orthonormal directions normal to all forces, (k, 3); of two, the first lies in the plane of the forces and the shoulder line."""
    _, values, rows = np.linalg.svd(forces)
    free: Array = rows[int((values > SPAN).sum()) :]
    within = free @ shoulders
    size = float(np.linalg.norm(within))
    if len(free) != 2 or size < SPAN:
        return free
    turned = np.array([within, [-within[1], within[0]]]) / size
    return turned @ free


def _signed(direction: Array) -> Array:
    """A line's direction with its largest component positive."""
    signed: Array = direction * np.sign(direction[np.abs(direction).argmax()])
    return signed
