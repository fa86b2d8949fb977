"""Drawings of the hands' point pair and line: what the arms can do that leaves them where they are, and the pair's way to another pose."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cga_runtime.report.arms import Arms
from cga_runtime.report.context import Context
from cga_runtime.report.drawing import Drawing, Line, Mark, limb, torso
from cga_runtime.versors import Similarity

Array = NDArray[np.float64]

BEYOND, AXES, SLIDE = 0.09, 0.06, 0.05
"""How far the line is drawn beyond the hands, and the lengths of e1, e2, e3 and of arrows (m)."""
RUNGS, ROUND = 8, 73
"""Steps in which the pair on its way is shown, and points of a circle."""


def drawings(context: Context) -> dict[str, tuple[Drawing, str]]:
    """Each with its title."""
    arms = context.arms(context.data["cooperative"]["nullspace"]["q"])
    return {
        "hands-pair": (_pair(context, arms), "Both arms, the point pair of the hands, and arm poses that leave both hands in place"),
        "hands-line": (_line(context, arms), "Both arms, the line of the hands, and arm poses that leave both hands on it"),
        "hands-way": (_way(context), "Both arms at two poses, and the ways of the hands from one to the other in two charts"),
    }


def _pair(context: Context, arms: Arms) -> Drawing:
    data = context.data["cooperative"]["nullspace"]
    placed = Similarity(context.pair.similarity(data["q"]))
    center, r, axes = placed.translation(), float(placed.scale()), placed.rotation().matrix().T
    frame = [
        Line("axis", np.stack([center, center + AXES * axis]), f"{name} of the pair's own frame", tag=name)
        for name, axis in zip(("e1", "e2", "e3"), axes, strict=True)
    ]
    words = "sphere with the hands at the ends of a diameter: its radius r is the unit of length"
    sphere = [Line("extent", _circle(center, r, axes[1], axis), words) for axis in (axes[0], axes[2])]
    between = Line("span", np.stack([arms.right.hand, arms.left.hand]), "point pair of the hands")
    ghosts = _ghosts(context, data["swing"], "arm, S swung while the hand stays")
    marks = [Mark("centre", center, "centre of the point pair", "force", ""), *_marks(arms)]
    return Drawing([*torso(arms), *sphere, *ghosts, *_swings(arms), between, *frame, *_limbs(arms)], marks)


def _line(context: Context, arms: Arms) -> Drawing:
    direction = (arms.left.hand - arms.right.hand) / np.linalg.norm(arms.left.hand - arms.right.hand)
    ends = np.stack([arms.right.hand - BEYOND * direction, arms.left.hand + BEYOND * direction])
    arrows = [
        Line("translation", np.stack([hand, hand + way * direction]), f"the {side} hand may slide along the line")
        for side, hand in (("right", arms.right.hand), ("left", arms.left.hand))
        for way in (-SLIDE, SLIDE)
    ]
    ghosts = _ghosts(context, context.data["cooperative"]["nullspace"]["slide"], "arm, hand slid along the line")
    return Drawing([*torso(arms), *ghosts, Line("span", ends, "line of the hands"), *_limbs(arms), *arrows], _marks(arms))


def _way(context: Context) -> Drawing:
    data = context.data["cooperative"]["interpolation"]
    arms = context.arms(data["q"][0])
    split, lie = (np.asarray(data[chart]["hands"]) for chart in ("split", "lie"))
    rungs = [Line("extent", hands, "the point pair on its way, split chart") for hands in split[:: (len(split) - 1) // RUNGS]]
    tracks = [
        Line(kind, made, f"way of the {what}, {words}")
        for kind, hands, words in (("span", split, "split chart"), ("rotation", lie, "Lie chart"))
        for what, made in (("right hand", hands[:, 0]), ("centre", hands.mean(axis=1)), ("left hand", hands[:, 1]))
    ]
    return Drawing([*torso(arms), *_ghosts(context, data["q"][1:], "arm at the end"), *rungs, *_limbs(arms), *tracks], _marks(arms))


def _limbs(arms: Arms) -> list[Line]:
    return [limb(arms.right, "right"), limb(arms.left, "left")]


def _swings(arms: Arms) -> list[Line]:
    """The circles on which the S centres may move while the hands stay: about the lines from U to the hand."""
    lines = []
    for side, arm in (("right", arms.right), ("left", arms.left)):
        axis = (arm.hand - arm.u) / np.linalg.norm(arm.hand - arm.u)
        foot = arm.u + axis * (axis @ (arm.s - arm.u))
        out = arm.s - foot
        circle = _circle(foot, 1.0, out, np.cross(axis, out))
        lines.append(Line("rotation", circle, f"the {side} S centre may move on this circle while the hand stays"))
    return lines


def _circle(center: Array, r: float, one: Array, other: Array) -> Array:
    angle = np.linspace(0.0, 2.0 * np.pi, ROUND)[:, None]
    return np.asarray(center + r * (np.cos(angle) * one + np.sin(angle) * other))


def _ghosts(context: Context, poses: Array, words: str) -> list[Line]:
    ghosts = []
    for q in poses:
        arms = context.arms(q)
        ghosts += [limb(arms.right, "right", "ghost", words), limb(arms.left, "left", "ghost", words)]
    return ghosts


def _marks(arms: Arms) -> list[Mark]:
    marks = []
    for side, arm in (("right", arms.right), ("left", arms.left)):
        letter = side[0].upper()
        marks.append(Mark("S", arm.s, f"S: centre of the {side} spherical joint", side, f"S{letter}"))
        marks.append(Mark("hand", arm.hand, f"{side} hand", side, ""))
    return marks
