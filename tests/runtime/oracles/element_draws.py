"""Points, elements and products that tests of elements share: random draws, degenerate ones among them, dense products, and rows."""

import json
from dataclasses import fields
from pathlib import Path

import numpy as np

from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.multivectors import NAMES, Multivector

COUNTS = {Point: 1, PointPair: 2, Line: 2, Circle: 3, Plane: 3, Sphere: 4}
ORACLE = json.loads((Path(__file__).parents[2] / "data" / "similarity.json").read_text(encoding="utf-8"))
ORACLE_NAMES = {kind: "pointpair" if kind is PointPair else kind.kind for kind in COUNTS}


def make(kind, points):
    """The element of a kind through points (..., n, 3)."""
    first = [points[..., k, :] for k in range(COUNTS[kind])]
    return Point(first[0]) if kind is Point else kind.from_points(*first)


def random(kind, rng, *shape):
    """Through random points within a few metres."""
    return make(kind, rng.normal(size=(*shape, 4, 3)))


def row(element, index):
    """Rows of a batch."""
    return type(element)(*(getattr(element, field.name)[index] for field in fields(element)))


def full(x):
    """All 32 coefficients."""
    m = Multivector(x.coefficients, x.blades)
    return np.stack(np.broadcast_arrays(*(m[name] for name in NAMES)), axis=-1)


def off(x, reference):
    """Largest difference of two multivectors, relative to the largest coefficient of each row of the second."""
    a, b = (full(m) if hasattr(m, "blades") else np.asarray(m, dtype=float) for m in (x, reference))
    return float((np.abs(a - b).max(axis=-1) / np.abs(b).max(axis=-1)).max())


def awkward_points(rng, count):
    """(count, 4, 3): spreads and distances of 1e-12 to 1e12 m, and of every ten one with coincident points, with neighbours that do, one
    collinear, coplanar, concyclic, beyond 1e100 m, below 1e-100 m, with small integers, up to 1e72 m, and one nearly flat."""
    spread, distance = 10.0 ** rng.uniform(-12, 12, (2, count, 1, 1))
    points = spread * rng.normal(size=(count, 4, 3)) + distance * rng.normal(size=(count, 1, 3)) * (rng.random((count, 1, 1)) < 0.5)
    case = rng.integers(0, 10, count)
    points[case == 0, 1] = points[case == 0, 0]
    points[case == 1, 2] = points[case == 1, 1]
    collinear, circle = case == 2, case == 4
    along = rng.normal(size=(count, 4, 1)) * rng.normal(size=(count, 1, 3))
    points[collinear] = (points[:, :1] + spread * along)[collinear]
    points[case == 3, :, 2] = points[case == 3, :1, 2]
    angle = rng.uniform(0, 2 * np.pi, (count, 4))
    points[circle] = (points[:, :1] + spread * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1))[circle]
    for k, low, high in ((5, 100, 290), (6, -290, -100), (8, 0, 60)):
        points[case == k] *= 10.0 ** rng.uniform(low, high, (count, 1, 1))[case == k]
    points[case == 7] = rng.integers(-3, 3, (count, 4, 3))[case == 7]
    bent = points[:, :1] + spread * along + 1e-9 * spread * rng.normal(size=(count, 4, 3)) * 10.0 ** rng.uniform(-2, 2, (count, 1, 1))
    points[case == 9] = bent[case == 9]
    return points
