"""The still drawing of a pose: an SVG that needs no script and no WebGL, follows the page's colours, and prints."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from numpy.typing import NDArray

from cga_runtime.report.drawing import Drawing, Line, Mark

Array = NDArray[np.float64]

WIDTH, HEIGHT, MARGIN = 640.0, 460.0, 34.0
VIEWER = np.array([1.15, -1.0, 0.75])
"""From where one looks: in front of the robot, to its right, from above. The robot's left arm is on the right of the picture."""
CORNERS = np.array([[WIDTH - 82.0, 62.0], [WIDTH - 82.0, HEIGHT - 50.0], [70.0, 62.0], [70.0, HEIGHT - 50.0]])
ROOM = 60.0
"""Places for the compass, best first, and half the width it takes."""
HEAD = 12.0
"""Length of an arrow's head."""
SHAPES = {
    "U": '<circle cx="{0:.1f}" cy="{1:.1f}" r="6" class="mark {2}"><title>{3}</title></circle>',
    "S": '<path d="M{0:.1f} {1:.1f}m-8 0l8 -8l8 8l-8 8z" class="mark {2}"><title>{3}</title></path>',
    "centre": '<circle cx="{0:.1f}" cy="{1:.1f}" r="4" class="mark {2}"><title>{3}</title></circle>',
    "hand": '<path d="M{0:.1f} {1:.1f}m-6 -6h12v12h-12z" class="mark {2}"><title>{3}</title></path>',
}
NAMES = (("x", "x forward"), ("y", "y left"), ("z", "z up"))


class View:
    """Parallel projection of points (m) onto the picture, fitted to the points given."""

    def __init__(self, points: Array) -> None:
        towards = VIEWER / np.linalg.norm(VIEWER)
        across = np.cross([0.0, 0.0, 1.0], towards)
        across /= np.linalg.norm(across)
        self.axes = np.stack([across, np.cross(towards, across)])
        flat = points @ self.axes.T
        low, high = flat.min(axis=0), flat.max(axis=0)
        room = np.array([WIDTH, HEIGHT]) - 2 * MARGIN
        self.scale = float((room / (high - low)).min())
        self.middle = 0.5 * (low + high)

    def __call__(self, points: Array) -> Array:
        flat = (np.atleast_2d(points) @ self.axes.T - self.middle) * self.scale
        return np.asarray([WIDTH / 2, HEIGHT / 2] + flat * [1.0, -1.0])


def still(made: Drawing, title: str) -> Markup:
    """The drawing as an SVG element; `title` is read by screen readers."""
    view = View(np.concatenate([line.points for line in made.lines]))
    parts = [_line(line, view) for line in made.lines] + [_mark(mark, view) for mark in made.marks]
    head = Markup('<svg class="still" viewBox="0 0 {:g} {:g}" role="img" aria-label="{}">').format(WIDTH, HEIGHT, title)
    corner = free_corner(np.concatenate([_dense(view(line.points)) for line in made.lines]))
    return Markup("").join([head, *parts, _compass(view, corner), Markup("</svg>")])


def _path(points: Array) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def _line(line: Line, view: View) -> Markup:
    flat = view(line.points)
    path, title = _path(flat), Markup("<title>{}</title>").format(line.name)
    kind = f"{line.kind} {line.side}".strip()
    drawn = Markup('<path class="{1}" d="{0}">{2}</path>').format(path, kind, title)
    if line.kind in ("link", "object"):  # the ground colour around it lets it pass over what lies behind
        drawn = Markup('<path class="under" d="{}"/>').format(path) + drawn
    if line.kind == "translation":
        drawn += Markup('<path class="head" d="{}z"/>').format(_path(_head(*flat[-2:])))
    if not line.tag:
        return drawn
    before, end = flat[-2:]
    away = (end - before) / max(float(np.linalg.norm(end - before)), 1e-9)
    return drawn + _text(end + 11 * away + [0, 4], line.tag, line.kind)


def _head(before: Array, end: Array) -> Array:
    """The triangle of an arrow's head, with its tip a little beyond the end. Drawn, not referred to: what is hidden cannot be."""
    along = (end - before) / max(float(np.linalg.norm(end - before)), 1e-9)
    across = np.array([-along[1], along[0]])
    tip, foot = end + 0.4 * HEAD * along, end - 0.6 * HEAD * along
    return np.stack([tip, foot + 0.45 * HEAD * across, foot - 0.45 * HEAD * across])


def _mark(mark: Mark, view: View) -> Markup:
    x, y = view(mark.point)[0]
    body = Markup(SHAPES[mark.kind]).format(float(x), float(y), mark.side, mark.name)
    return body + (_text(np.array([x, y - 13]), mark.tag, "name") if mark.tag else Markup(""))


def _text(at: Array, words: str, kind: str) -> Markup:
    return Markup('<text x="{:.1f}" y="{:.1f}" class="{}">{}</text>').format(float(at[0]), float(at[1]), kind, words)


def _dense(flat: Array) -> Array:
    """Points along a polyline, eight to each piece."""
    ways = np.linspace(0.0, 1.0, 9)[:, None, None]
    return ((1.0 - ways) * flat[:-1] + ways * flat[1:]).reshape(-1, 2)


def free_corner(drawn: Array) -> Array:
    """The place for the compass, (2,): the first of CORNERS without a drawn point (m, 2) near it, else the one farthest from all."""
    gaps = [float(np.abs(drawn - corner).max(axis=1).min()) for corner in CORNERS]
    place = next((k for k, gap in enumerate(gaps) if gap > ROOM), int(np.argmax(gaps)))
    return np.asarray(CORNERS[place])


def _compass(view: View, corner: Array) -> Markup:
    """The three directions of the root frame."""
    parts = []
    for (_, words), direction in zip(NAMES, np.eye(3), strict=True):
        tip = (view.axes @ direction) * [1.0, -1.0]
        end = corner + 34 * tip
        parts.append(Markup('<path class="compass" d="{}"/>').format(_path(np.stack([corner, end]))))
        parts.append(_text(corner + 46 * tip + [0, 4], words, "compass"))
    return Markup("").join(parts)
