"""Draws docs/figures/cooperative_<kind>.svg: each primitive's interpolation in both charts, and the motions that its nullspace leaves.

Left (paper A, Figure 4): X(s) = V_1 exp(s log(~V_1 V_12 V_1)) X_u from blue to orange; in the split chart the centre goes straight, in the
Lie chart along the screw of the similarity. Right (paper A, Figure 22): Pandas around a table; at each end point the ellipse of velocities
that joint speeds of size one inside the nullspace of the horizontal Jacobian give it. They lie along the primitive, to rounding, which is
asserted. Needs matplotlib (extra dev): ./run shell python scripts/cooperative_figures.py
"""

from pathlib import Path

import matplotlib
import numpy as np

import cga_runtime as cga
from cga_runtime.elements.similarities import interpolate
from cga_runtime.experiments.cooperative_contests import around_a_table
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

matplotlib.use("svg")
matplotlib.rcParams |= {"svg.hashsalt": "cooperative", "font.size": 8, "svg.fonttype": "path"}
from matplotlib import pyplot as plt  # noqa: E402  after the backend is chosen

FIGURES = Path(__file__).resolve().parents[1] / "docs" / "figures"
STEPS = 9
BEGIN, END = np.array([0.12, 0.35, 0.75]), np.array([0.9, 0.45, 0.1])
LEFT, RIGHT = "#1f5fbf", "#7a7a7a"
CIRCLE = np.linspace(0.0, 2.0 * np.pi, 73)
EXTENT = 0.55
"""Half the side (m) of the piece of a line or plane that is drawn."""


def ends(kind):
    """Two primitives that differ in place, direction and size."""
    match kind:
        case "point":
            return cga.Point([0.0, 0.0, 0.0]), cga.Point([0.9, 0.6, 0.5])
        case "point_pair":
            return cga.PointPair.from_points([-0.2, 0, 0], [0.2, 0.1, 0]), cga.PointPair.from_points([1.0, 0.9, 0.2], [1.2, 0.2, 0.9])
        case "line":
            return cga.Line.from_points([0, -0.4, 0], [0.1, 0.4, 0.1]), cga.Line.from_points([1.0, 0.3, 0.1], [0.8, 0.3, 0.9])
        case "circle":
            return cga.Circle([0.0, 0.0, 0.0], [0.0, 0.1, 1.0], 0.25), cga.Circle([1.0, 0.6, 0.5], [1.0, 0.5, 0.2], 0.5)
        case "plane":
            return cga.Plane.from_point_normal([0, 0, 0.1], [0.0, 0.1, 1.0]), cga.Plane.from_point_normal([0.9, 0.3, 0.3], [1.0, 0.2, 0.6])
        case _:
            return cga.Sphere.from_center_radius([0, 0, 0], 0.15), cga.Sphere.from_center_radius([0.9, 0.6, 0.4], 0.4)


def across(n):
    """Two unit vectors square to n."""
    first = np.cross(n, np.eye(3)[np.argmin(np.abs(n))])
    first /= np.linalg.norm(first)
    return first, np.cross(n, first)


def outline(kind, x):
    """Polylines (k, 3) that show an element."""
    match kind:
        case "point":
            return [x.center[None]]
        case "point_pair":
            return [x.points]
        case "line":
            return [x.center + np.outer([-EXTENT, EXTENT], x.direction)]
        case "circle":
            u, v = across(x.normal)
            return [x.center + x.radius * (np.outer(np.cos(CIRCLE), u) + np.outer(np.sin(CIRCLE), v))]
        case "plane":
            u, v = across(x.normal)
            return [x.center + 0.6 * EXTENT * (np.outer(a, u) + np.outer(b, v)) for a, b in [([1, 1, -1, -1, 1], [1, -1, -1, 1, 1])]]
        case _:
            turns = [np.roll(np.stack([np.cos(CIRCLE), np.sin(CIRCLE), 0 * CIRCLE], axis=1), k, axis=1) for k in range(3)]
            return [x.center + x.radius * turn for turn in turns]


def draw_interpolation(kind, axes, chart, dashes):
    """The steps of one chart, and the way of the centre (of flat primitives: the foot of the origin)."""
    one, two = ends(kind)
    steps = np.linspace(0.0, 1.0, STEPS)
    way = interpolate(one, two, np.linspace(0.0, 1.0, 65), chart)
    axes.plot(*way.center.T, color="black", lw=0.8, ls=dashes, label=f"centre, {chart}")
    for s in steps:
        element = interpolate(one, two, s, chart)
        for line in outline(kind, element):
            colour, dots = (1 - s) * BEGIN + s * END, 2.5 if len(line) <= 2 else 0.0
            axes.plot(*line.T, color=colour, lw=1.1 if chart == "split" else 0.7, ls=dashes, marker="o", ms=dots)


def spread(kind):
    """Where the Pandas' hands are held (m): points that span a primitive which can be seen well."""
    turns = 2.0 * np.pi * np.arange(PRIMITIVES[kind].points) / PRIMITIVES[kind].points
    heights = {"sphere": [0.3, 0.62, 0.3, 0.62], "point_pair": [0.4, 0.65], "line": [0.4, 0.65]}.get(kind, [0.4, 0.5, 0.62, 0.5])
    return np.stack([0.28 * np.cos(turns), 0.28 * np.sin(turns), heights[: len(turns)]], axis=1)


def draw_nullspace(kind, axes):
    """The primitive of Pandas around a table, and what the nullspace leaves to each end point."""
    count, panda = PRIMITIVES[kind].points, cga.load_robot("panda")
    bases = around_a_table(count, 0.75)
    system = cga.Cooperative([panda.chain("panda_link8", placement=pose) for pose in bases], kind)
    bend = np.array([0.1, 0.2, -0.1, -2.0, 0.2, 2.1, 0.8])
    hands = zip(system.chains, spread(kind), strict=True)
    q = np.concatenate([cga.inverse_kinematics(chain, cga.Point(x), q0=bend).q for chain, x in hands])
    points, element = system.points(q), system.element(q)
    moves = (system.point_jacobian(q) @ system.nullspace(q)).reshape(count, 3, -1)
    for line in outline(kind, element):
        axes.plot(*line.T, color=LEFT, lw=1.4)
    for base, x, jacobian in zip(bases, points, moves, strict=True):
        vectors, sizes, _ = np.linalg.svd(jacobian, full_matrices=False)
        assert sizes[allowed(kind)] < 1e-13, "nullspace motions leave the primitive"
        semiaxes = [0.3 * size * vector for size, vector in zip(sizes, vectors.T, strict=True) if size > 1e-9]
        for semiaxis in semiaxes:
            axes.plot(*np.stack([x - semiaxis, x + semiaxis]).T, color=END, lw=2.0)
        if len(semiaxes) == 2:
            axes.plot(*(x + np.outer(np.cos(CIRCLE), semiaxes[0]) + np.outer(np.sin(CIRCLE), semiaxes[1])).T, color=END, lw=0.8)
        axes.plot(*x[None].T, "o", color="black", ms=3)
        shoulder = base[:3, 3] + [0.0, 0.0, 0.333]
        axes.plot(*np.stack([base[:3, 3], shoulder, x]).T, color=RIGHT, lw=1.0, alpha=0.6)
    return system, round(np.trace(system.nullspace(q)))


def allowed(kind):
    """How many directions along the primitive a point has."""
    return {"point": 0, "point_pair": 0, "line": 1, "circle": 1, "plane": 2, "sphere": 2}[kind]


def dress(axes, title):
    """Equal scales and few words."""
    axes.set_title(title, fontsize=9)
    axes.set_aspect("equal")
    axes.locator_params(nbins=4)
    axes.tick_params(labelsize=6, pad=-2)
    axes.view_init(24, -58)
    axes.set_box_aspect(axes.get_box_aspect(), zoom=1.15)


def main():
    """All six."""
    FIGURES.mkdir(exist_ok=True)
    for kind in PRIMITIVES:
        figure = plt.figure(figsize=(8.4, 3.8))
        left, right = (figure.add_subplot(1, 2, k, projection="3d") for k in (1, 2))
        draw_interpolation(kind, left, "split", "-")
        draw_interpolation(kind, left, "lie", ":")
        left.legend(loc="upper left", fontsize=7, frameon=False)
        dress(left, f"{kind.replace('_', ' ')}: interpolation")
        system, dimension = draw_nullspace(kind, right)
        right.set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8), zlim=(0.0, 0.8))
        if not allowed(kind):
            right.text2D(0.5, 0.02, "these motions leave the hands where they are", transform=right.transAxes, ha="center", fontsize=7)
        dress(right, f"nullspace of {len(system.chains)} x Panda: {dimension} of {system.n} dimensions")
        figure.tight_layout()
        figure.savefig(FIGURES / f"cooperative_{kind}.svg", metadata={"Date": None})
        plt.close(figure)
        print(f"docs/figures/cooperative_{kind}.svg")


if __name__ == "__main__":
    main()
