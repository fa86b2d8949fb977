"""Drawings of both arms with what they hold or span, each shown twice: as a plotly 3-D figure, and as a still drawing (still.py)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.report.arms import Arm, Arms
from cga_runtime.report.figures import Figure, figure, label

Array = NDArray[np.float64]

AXIS, BEYOND, ARROW = 0.028, 0.08, 0.09
"""Half-length of a joint axis, how far a force line goes beyond U and S, and length of an arrow (m)."""


@dataclass(frozen=True)
class Line:
    """A line or polyline (k, 3) of one kind, a key of STYLE. tag: label at its last point."""

    kind: str
    points: Array
    name: str
    side: str = ""
    tag: str = ""


@dataclass(frozen=True)
class Mark:
    """A point of one kind: U, S, hand, centre. side: right, left, or another colour of the style sheet. tag: its label."""

    kind: str
    point: Array
    name: str
    side: str
    tag: str


@dataclass
class Drawing:
    """Lines and marks, back to front where it matters."""

    lines: list[Line] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)


def draw(arms: Arms, pose: dict[str, Any], joint_names: Sequence[str]) -> Drawing:
    """The drawing of a pose; `pose` is an entry ("generic" or "parallel") of the section "mobility"."""
    right, left = arms.right, arms.left
    made = Drawing(torso(arms))
    made.lines.append(Line("object", np.stack([right.hand, left.hand]), "grasped object"))
    centre = 0.5 * (right.hand + left.hand)
    for twist in pose["twists"]:
        if twist["kind"] == "translation":
            ends = np.stack([centre, centre + ARROW * np.asarray(twist["v"])])
            made.lines.append(Line("translation", ends, "the object may translate along this direction", tag="T"))
        elif "shoulder" not in twist["name"]:  # that one is drawn already
            start, end = np.asarray(twist["points"])
            ends = np.stack([start, end]) + np.outer([-0.04, 0.04], twist["w"])
            made.lines.append(Line("rotation", ends, f"the object may turn about the {twist['name']}", tag="R"))
    names = iter(joint_names)
    for side, arm, number in (("right", right, 1), ("left", left, 2)):
        made.lines.append(limb(arm, side))
        for w, anchor in zip(arm.axes, arm.anchors, strict=True):
            made.lines.append(Line("axis", anchor + np.outer([-AXIS, AXIS], w), f"axis of {next(names)}", side))
        along = (arm.s - arm.u) / np.linalg.norm(arm.s - arm.u)
        ends = np.stack([arm.u - BEYOND * along, arm.s + BEYOND * along])
        made.lines.append(Line("force", ends, f"constraint force of the {side} arm: zero pitch, through U and S", side, f"ζ{number}"))
        letter = side[0].upper()
        made.marks.append(Mark("U", arm.u, f"U: centre of the {side} universal joint", side, f"U{letter}"))
        made.marks.append(Mark("S", arm.s, f"S: centre of the {side} spherical joint", side, f"S{letter}"))
        made.marks.append(Mark("hand", arm.hand, f"{side} hand", side, ""))
    return made


def torso(arms: Arms) -> list[Line]:
    """What does not move."""
    right, left = arms.right.u, arms.left.u
    return [
        Line("torso", np.stack([np.zeros(3), 0.5 * (right + left)]), "torso: from the root frame to the shoulder line"),
        Line("torso", np.stack([right, left]), "shoulder line: both ShoulderPitch axes"),
    ]


def limb(arm: Arm, side: str, kind: str = "link", words: str = "arm") -> Line:
    """An arm from shoulder to hand."""
    return Line(kind, np.stack([arm.u, arm.elbow, arm.s, arm.wrist, arm.hand]), f"{side} {words}", side)


# ---- the plotly figure

STYLE: dict[str, tuple[str, int, str]] = {
    "torso": ("var(--faint)", 5, "solid"),
    "link": ("", 10, "solid"),
    "axis": ("var(--ink)", 3, "solid"),
    "object": ("var(--object)", 14, "solid"),
    "force": ("var(--force)", 5, "solid"),
    "rotation": ("var(--good)", 4, "longdash"),
    "translation": ("var(--good)", 6, "solid"),
    "ghost": ("", 4, "solid"),
    "extent": ("var(--force)", 2, "dot"),
    "span": ("var(--force)", 6, "solid"),
}
"""Kind -> colour ("" is that of the side), width, dash."""
FAINT = 0.55
"""Opacity of a ghost."""
SYMBOL = {"U": "circle", "S": "diamond", "hand": "square", "centre": "circle-open"}


def three_d(made: Drawing) -> Figure:
    """The drawing as a plotly scene (WebGL), equal scales, torso frame x forward, y left, z up."""
    traces: list[dict[str, Any]] = []
    for line in made.lines:
        colour, width, dash = STYLE[line.kind]
        x, y, z = line.points.T
        traces.append(
            {
                "type": "scatter3d",
                "mode": "lines+text" if line.tag else "lines",
                "x": x,
                "y": y,
                "z": z,
                "text": [""] * (len(x) - 1) + [f" {line.tag}"],
                "textfont": {"color": colour or f"var(--{line.side})", "size": 14},
                "line": {"color": colour or f"var(--{line.side})", "width": width, "dash": dash},
                "opacity": FAINT if line.kind == "ghost" else 1.0,
                "hovertext": label(line.name),
                "hoverinfo": "text",
            }
        )
        if line.kind == "translation":
            traces.append(_head(line, colour))
    for mark in made.marks:
        traces.append(
            {
                "type": "scatter3d",
                "mode": "markers+text",
                "x": [mark.point[0]],
                "y": [mark.point[1]],
                "z": [mark.point[2]],
                "text": [mark.tag],
                "textposition": "top center",
                "textfont": {"size": 13},
                "marker": {
                    "color": f"var(--{mark.side})",
                    "size": 6,
                    "symbol": SYMBOL[mark.kind],
                    "line": {"color": "var(--card)", "width": 1},
                },
                "hovertext": mark.name,
                "hoverinfo": "text",
            }
        )
    axes = {
        f"{name}axis": {"title": {"text": f"{name} {words} (m)", "font": {"size": 14}}, "nticks": 5, "tickfont": {"size": 12}}
        for name, words in (("x", "forward"), ("y", "left"), ("z", "up"))
    }
    eye = {"x": 0.8, "y": -0.7, "z": 0.52}
    scene = {**axes, "aspectmode": "data", "camera": {"eye": eye, "projection": {"type": "orthographic"}}}
    return figure(traces, {"scene": scene, "margin": {"l": 0, "r": 0, "t": 0, "b": 0}, "showlegend": False, "uirevision": "keep"})


def _head(line: Line, colour: str) -> dict[str, Any]:
    """The head of an arrow."""
    start, end = line.points
    x, y, z = end
    u, v, w = 0.3 * (end - start)
    scale = [[0.0, colour], [1.0, colour]]
    cone: dict[str, Any] = {
        "type": "cone",
        "x": [x],
        "y": [y],
        "z": [z],
        "u": [u],
        "v": [v],
        "w": [w],
        "colorscale": scale,
        "showscale": False,
    }
    return {**cone, "sizemode": "raw", "anchor": "tail", "hoverinfo": "skip"}
