"""What primitives lose far from the origin, near flat ones, and near a chart's pole, against exact rationals and 50 digits.

Radii and centres come from differences of the points; read off the coefficients of X they lose a power of distance over size. Kernels are
those over points, at float64 points whose exact values the oracle takes (similarity.md, sections 3, 5 and 8).
"""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp, mpf

import cga_runtime as cga
from cga_runtime.spaces.cooperative_kernels import primitive_unit
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

EPS = 2.0**-52
ROUND = ("point_pair", "circle", "sphere")
SIZE = 0.01
"""Spread of the points (m)."""


def exact(x):
    """Floats as rationals."""
    return [exact(y) for y in x] if np.ndim(x) else Fraction(float(x))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


def combined(weights, vectors):
    return [sum(w * v[k] for w, v in zip(weights, vectors, strict=True)) for k in range(3)]


def centre_and_square(points):
    """Rational centre and squared radius of the pair, circle or sphere through points."""
    first, *others = exact(points)
    edges = [minus(x, first) for x in others]
    half = [dot(e, e) / 2 for e in edges]
    if len(edges) == 1:
        arm = [x / 2 for x in edges[0]]
    elif len(edges) == 2:  # within their plane: the normal is the third row
        normal = cross(*edges)
        arm = combined([x / dot(normal, normal) for x in half], [cross(edges[1], normal), cross(normal, edges[0])])
    else:
        whole = dot(cross(edges[0], edges[1]), edges[2])
        rows = [cross(edges[1], edges[2]), cross(edges[2], edges[0]), cross(edges[0], edges[1])]
        arm = combined([x / whole for x in half], rows)
    return [x + y for x, y in zip(first, arm, strict=True)], dot(arm, arm)


def root(square):
    with mp.workdps(50):
        return mp.sqrt(mpf(square.numerator) / mpf(square.denominator))


def errors(kind, points):
    """Relative error of each radius, and of each centre in units of the largest coordinate of its points."""
    parts = primitive_unit(kind).kernel("parts")(points, np.ones((len(points), 1)))
    radius, centre = [], []
    for row, x in zip(parts, points, strict=True):
        c, square = centre_and_square(x)
        r = root(square)
        with mp.workdps(50):
            radius.append(float(abs(mpf(float(row[7])) / r - 1)))
        centre.append(float(max(abs(Fraction(float(a)) - b) for a, b in zip(row[4:7], c, strict=True))) / np.abs(x).max())
    return np.array(radius), np.array(centre)


def clouds(kind, distance, count=100, seed=5):
    """Points of spread SIZE about a random place at a distance; not flatter than a tenth."""
    rng = np.random.default_rng(seed)
    shift = rng.normal(size=(count, 1, 3))
    shift *= distance / np.linalg.norm(shift, axis=-1, keepdims=True)
    points = shift + SIZE * rng.normal(size=(count, PRIMITIVES[kind].points, 3))
    return points[primitive_unit(kind).kernel("guard")(points)[:, 0] > (0.0 if kind == "point_pair" else 0.1)]


def read_off(kind, points):
    """r = sqrt(|X ~X|) / w from the coefficients of X alone (similarity.md, section 3)."""
    x = cga.Multivector(primitive_unit(kind).kernel("primitive")(points), PRIMITIVES[kind].element.blades)
    blades = {"point_pair": ("e01", "e02", "e03"), "circle": ("e012", "e013", "e023"), "sphere": ("e0123",)}[kind]
    w = np.sqrt(sum(x[name] ** 2 for name in blades))
    return np.sqrt(np.abs((x * ~x)["1"])) / w


LOST = {
    ("point_pair", 100.0): 2e-4,
    ("circle", 10.0): 4e-8,
    ("circle", 100.0): 4e-5,
    ("sphere", 100.0): 5e-5,
}
"""Relative errors of r read off X (similarity.md, section 3)."""


@pytest.mark.parametrize("kind", ROUND)
@pytest.mark.parametrize("distance", [0.0, 10.0, 100.0])
def test_radius_and_centre_far_away(kind, distance):
    points = clouds(kind, distance)
    assert len(points) > 50
    radius, centre = errors(kind, points)
    assert radius.max() <= 2e-15  # similarity.md: 5e-15
    if distance:
        assert centre.max() <= 2 * EPS


@pytest.mark.parametrize(("kind", "distance"), LOST)
def test_the_coefficients_have_lost_it(kind, distance):
    """Why nothing is read off X: the loss of the table, within a factor of twenty, since it is the worst of other random points."""
    points = clouds(kind, distance)
    truth = np.array([float(root(centre_and_square(x)[1])) for x in points])
    worst = np.abs(read_off(kind, points) / truth - 1).max()
    assert LOST[kind, distance] / 20 < worst < 20 * LOST[kind, distance]


@pytest.mark.parametrize("kind", ROUND)
def test_jacobians_do_not_know_the_distance(kind):
    """Of round ones they depend on the edges alone, which are exact differences: the same as at the origin."""
    points = clouds(kind, 100.0)
    near = points - points[:, :1]
    for name in ("horizontal_jacobian", "geometric_jacobian"):
        for chart in (1.0, -1.0):
            there, here = (primitive_unit(kind).kernel(name)(x, np.full((len(points), 1), chart)) for x in (points, near))
            np.testing.assert_array_equal(there, here)


# ---- near flat: the circle through (-1, 0, 0), (0.3, -h, 0), (1, 0, 0)

HEIGHTS = 10.0 ** -np.arange(1, 9)


def bent(shift=(0.0, 0.0, 0.0)):
    return np.array([[[-1, 0, 0], [0.3, -h, 0], [1, 0, 0]] for h in HEIGHTS]) + np.array(shift)


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.0), (100.0, 0.0, 0.0), (57.7, -57.7, 57.7)])
def test_radius_of_an_almost_straight_circle(shift):
    """To an ulp for every height, wherever it stands; 0.455/h."""
    points = bent(shift)
    radius, _ = errors("circle", points)
    assert radius.max() <= 2 * EPS
    r = primitive_unit("circle").kernel("parts")(points, np.ones((len(points), 1)))[:, 7]
    assert np.abs(r * HEIGHTS - 0.455)[2:].max() < 1e-3
    if any(shift):
        assert (np.abs(read_off("circle", points) / r - 1)[5:] > 1e-12).all()


def test_jacobian_of_an_almost_straight_circle():
    """Singular values of J_h by motions of the points: the largest grows as 1.76/h, the smallest of six shrinks as 0.9 h."""
    jacobian = primitive_unit("circle").kernel("horizontal_jacobian")(bent(), np.ones((len(HEIGHTS), 1)))
    values = np.linalg.svd(jacobian[:6], compute_uv=False)  # 1e-6: beyond, the smallest drowns in the rounding of the largest
    assert np.abs(values[1:, 0] * HEIGHTS[1:6] - 1.76).max() < 0.01
    assert np.abs(values[1:4, 5] / HEIGHTS[1:4] - 0.9).max() < 0.05
    sine = primitive_unit("circle").kernel("degeneracy")(bent())[:, 0]
    assert np.abs(sine / HEIGHTS - 1 / 1.3)[2:].max() < 1e-3


# ---- near the pole of a chart


def exact_rotor(edge, chart):
    """Rotor of a pair with that edge in 50 digits, 1 e12 e13 e23: h a with h = (a + n)/|a + n|; in chart -1 after half a turn."""
    with mp.workdps(50):
        n = [mpf(float(x)) for x in edge]
        size = mp.sqrt(dot(n, n))
        h = [x / size for x in n]
        h[1] += chart
        length = mp.sqrt(dot(h, h))
        arc = [chart * h[1] / length, chart * h[0] / length, mpf(0), -chart * h[2] / length]
        return arc if chart == 1 else [arc[3], arc[2], -arc[1], -arc[0]]


def off_exact(rotors, edges, chart):
    """Largest error of the components of each rotor."""
    pairs = [zip(row, exact_rotor(edge, chart), strict=True) for row, edge in zip(rotors, edges, strict=True)]
    return np.array([float(max(abs(mpf(float(x)) - y) for x, y in pair)) for pair in pairs])


def edges_near(pole, deltas):
    """Edges of pairs at angles from +e2 or -e2."""
    azimuth = np.random.default_rng(3).uniform(0, 2 * np.pi, len(deltas))
    side = np.stack([np.cos(azimuth), 0 * azimuth, np.sin(azimuth)], -1)
    return 0.7 * (np.cos(deltas)[:, None] * np.array([0.0, pole, 0.0]) + np.sin(deltas)[:, None] * side)


@pytest.mark.parametrize("chart", [1, -1])
def test_rotor_near_the_pole(chart):
    """It loses rounding over the angle delta from the pole; in the other chart nothing is lost."""
    deltas = 10.0 ** -np.arange(0, 7.5, 0.25)
    edges = edges_near(-chart, deltas)
    points = np.stack([np.zeros_like(edges), edges], axis=1)
    for sense, allowed in ((chart, EPS / deltas), (-chart, 2 * EPS)):
        rotors = primitive_unit("point_pair").kernel("parts")(points, np.full((len(points), 1), float(sense)))[:, :4]
        assert (off_exact(rotors, edges, sense) < allowed).all()


def test_the_printed_rotor_loses_more():
    """Rounding over the square of delta for (1 + n a) / sqrt(2 (1 + a.n)), paper A, eq. (26)."""
    deltas = 10.0 ** -np.arange(4, 7, 0.1)
    edges = edges_near(-1, deltas)
    n = edges / np.linalg.norm(edges, axis=-1, keepdims=True)
    cos = 1 + n[:, 1]
    printed = np.stack([cos, n[:, 0], 0 * cos, -n[:, 2]], -1) / np.sqrt(2 * cos)[:, None]
    lost = off_exact(printed, edges, 1) * deltas**2 / EPS
    assert lost.max() < 1 and np.median(lost) > 0.02
