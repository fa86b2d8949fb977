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
ARROW_HEAD = Markup(
    '<defs><marker id="head" viewBox="0 0 8 8" refX="5" refY="4" markerWidth="5" markerHeight="5" orient="auto">'
    '<path d="M0 0L8 4L0 8z" class="head"/></marker></defs>'
)
SHAPES = {
    "U": '<circle cx="{0:.1f}" cy="{1:.1f}" r="6" class="mark {2}"><title>{3}</title></circle>',
    "S": '<path d="M{0:.1f} {1:.1f}m-8 0l8 -8l8 8l-8 8z" class="mark {2}"><title>{3}</title></path>',
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
    return Markup("").join([head, ARROW_HEAD, *parts, _compass(view), Markup("</svg>")])


def _path(points: Array) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def _line(line: Line, view: View) -> Markup:
    flat = view(line.points)
    path, title = _path(flat), Markup("<title>{}</title>").format(line.name)
    kind = f"{line.kind} {line.side}".strip()
    drawn = Markup('<path class="{1}" d="{0}">{2}</path>').format(path, kind, title)
    if line.kind in ("link", "object"):  # the ground colour around it lets it pass over what lies behind
        drawn = Markup('<path class="under" d="{}"/>').format(path) + drawn
    if not line.tag:
        return drawn
    before, end = flat[-2:]
    away = (end - before) / max(float(np.linalg.norm(end - before)), 1e-9)
    return drawn + _text(end + 11 * away + [0, 4], line.tag, line.kind)


def _mark(mark: Mark, view: View) -> Markup:
    x, y = view(mark.point)[0]
    body = Markup(SHAPES[mark.kind]).format(float(x), float(y), mark.side, mark.name)
    return body + (_text(np.array([x, y - 13]), mark.tag, "name") if mark.tag else Markup(""))


def _text(at: Array, words: str, kind: str) -> Markup:
    return Markup('<text x="{:.1f}" y="{:.1f}" class="{}">{}</text>').format(float(at[0]), float(at[1]), kind, words)


def _compass(view: View) -> Markup:
    """The three directions of the root frame, in a corner."""
    corner = np.array([WIDTH - 82.0, 62.0])
    parts = []
    for (_, words), direction in zip(NAMES, np.eye(3), strict=True):
        tip = (view.axes @ direction) * [1.0, -1.0]
        end = corner + 34 * tip
        parts.append(Markup('<path class="compass" d="{}"/>').format(_path(np.stack([corner, end]))))
        parts.append(_text(corner + 46 * tip + [0, 4], words, "compass"))
    return Markup("").join(parts)
