"""Paper A, eqs. (1)-(6), (14), (20), (24), (25), (27), (28): statements on elements, by numbers (similarity.md, sections 1 to 3 and 9).

A formula that is wrong as printed fails by a stated amount, a band over random elements of size 1; the corrected one holds to rounding.
"""

import mpmath
import numpy as np
import pytest
from paper_a import (
    DATA,
    DIRECTION,
    E0,
    INFINITY,
    KINDS,
    SIGNS,
    UNITS,
    at,
    dot,
    norm,
    normalised,
    numbers,
    parameters,
    read_off,
    similarity,
    span,
    weight,
)

from cga_codegen.algebra.blade_types import FULL, POINT, PSEUDOSCALAR, SIMILARITY_BIVECTOR
from cga_codegen.algebra.multivector import Multivector

ROUNDS = ("pointpair", "circle", "sphere")
EXTENDED = [kind for kind in KINDS if kind != "point"]


def largest(x):
    return np.abs(numbers(x) if isinstance(x, Multivector) else x).max()


def within(values, low, high):
    """Every amount in a band around what was measured."""
    assert low < np.min(values) and np.max(values) < high, (np.min(values), np.max(values))


def random_points(rng, kind, count=50):
    return rng.normal(size=(count, KINDS[kind][0], 3))


def inverse(x):
    return (~x).scaled(1 / x.scalar_product(~x))


def point(x):
    return span("point", x[..., None, :])


def infinity_part(x):
    return np.abs(x.coefficient(16))


# ---- the algebra and the table of elements, sections 1 and 2


def test_null_basis():
    """Section 2.1: e0^2 = ei^2 = 0, e0 . ei = -1 of e0 = (e5 - e4)/2, ei = e4 + e5; (1): P^2 = 0, P . ei = -1."""
    assert [(a * b).coefficient(0) for a, b in ((E0, E0), (INFINITY, INFINITY), (E0, INFINITY), (INFINITY, E0))] == [0, 0, -1, -1]
    assert ((E0 * INFINITY).coefficient(17), (INFINITY * E0).coefficient(17)) == (1, -1)
    p = point(np.random.default_rng(1).normal(size=(20, 3)))
    assert largest(np.array((p * p).coefficient(0))) < 4e-16 * 20 and np.all(p.scalar_product(INFINITY) == -1)


@pytest.mark.parametrize("kind", EXTENDED)
def test_squares(kind, rng):
    """<X ~X>_0 is negative for every real element: a norm needs |.|, (78), and (79) a sign. X^2 is negative for planes and spheres only."""
    x = span(kind, random_points(rng, kind))
    assert np.all(x.scalar_product(~x) < 0)
    assert np.all(np.sign(x.scalar_product(x)) == (-1 if kind in ("plane", "sphere") else 1))
    unit = UNITS[kind]
    assert unit.scalar_product(~unit) == -1


@pytest.mark.parametrize("kind", KINDS)
def test_weights_and_directions(kind, rng):
    """What X says in the table of similarity.md, section 2, by vector formulas."""
    points = random_points(rng, kind)
    x = span(kind, points)
    edges = points[:, 1:] - points[:, :1]
    if kind == "point":
        expected = np.ones((50, 1))
    elif kind == "sphere":
        expected = np.linalg.det(edges)[:, None]
        assert (expected < 0).sum() > 10 and (expected > 0).sum() > 10  # signed
    else:
        direction = edges[:, 0] if len(edges[0]) == 1 else np.cross(edges[:, 0], edges[:, 1])
        assert largest(at(x, DIRECTION[kind]) * SIGNS.get(kind, 1) - direction) < 2e-14
        expected = norm(direction)
    assert largest(weight(kind, x) - expected) < 2e-14


@pytest.mark.parametrize("kind", KINDS)
def test_stabilisers(kind):
    """Table 1: what leaves X_u alone, of a point up to its size; the controllable blades are the others, 3, 6, 4, 6, 3, 4 of them."""
    pushes = []
    for row in np.eye(7, dtype=int).tolist():
        push = Multivector(SIMILARITY_BIVECTOR, row).commutator(UNITS[kind])
        pushes.append([push.coefficient(mask) for mask in FULL.masks if not (kind == "point" and mask == 1)])
    moves = [name for name, push in zip(SIMILARITY_BIVECTOR.blade_names, pushes, strict=True) if any(push)]
    assert moves == DATA["controllable"][kind]
    assert np.linalg.matrix_rank(np.array(pushes)) == len(moves)
    assert len(moves) == {"point": 3, "pointpair": 6, "line": 4, "circle": 6, "plane": 3, "sphere": 4}[kind]


def test_inner_product_with_infinity(rng):
    """X . ei = ei . X for circles, -ei . X for point pairs and spheres: (83) and (84) agree for circles only."""
    for kind, sign in (("circle", 1), ("pointpair", -1), ("sphere", -1)):
        x = span(kind, random_points(rng, kind))
        assert largest((x | INFINITY) - (INFINITY | x).scaled(sign)) == 0


# ---- (3)-(5): null spaces, projections, meets


@pytest.mark.parametrize("kind", ["line", "plane"])
def test_4_projections_on_flats(kind, rng):
    """(4): (P . X) X^-1 has the foot point in its Euclidean part over e0, but is no point: it has d^2/2 ei too much, d the distance,
    so its square is -d^2. Read e1 e2 e3 over e0 only."""
    points, p = random_points(rng, kind), rng.normal(size=(50, 3))
    projected = ((point(p) | span(kind, points)) * inverse(span(kind, points))).project(POINT)
    c, n, _ = parameters(kind, points)
    foot = c + n * dot(n, p - c) if kind == "line" else p - n * dot(n, p - c)
    assert largest(at(projected, "e1 e2 e3") / at(projected, "e0") - foot) < 1e-13
    distance = norm(p - foot)[:, 0] ** 2
    within(-projected.scalar_product(projected) / distance, 0.999999, 1.000001)
    assert np.median(distance) > 0.5
    null = point(foot)
    within(infinity_part(projected - null) / distance, 0.499999, 0.500001)


@pytest.mark.parametrize(("kind", "low"), [("pointpair", 0.3), ("circle", 0.7), ("sphere", 0.9)])
def test_4_projections_on_rounds(kind, low, rng):
    """(4): on a round the Euclidean part is not on it either: it lies within, between 0.02 and 1 radius from the centre."""
    points, p = random_points(rng, kind), rng.normal(size=(50, 3))
    projected = ((point(p) | span(kind, points)) * inverse(span(kind, points))).project(POINT)
    c, _, r = parameters(kind, points)
    away = norm(at(projected, "e1 e2 e3") / at(projected, "e0") - c) / r
    within(away, 0.01, 1.0)
    assert low < np.median(away) < 0.99


def test_5_meets(rng):
    """(5): X1* ^ X2* dual again holds the common points: two planes, a line and a plane, two spheres, a sphere and a plane. Its sign
    is that of the dual: with -X I instead of X I, the meet changes sign, for X** = -X."""
    directions = rng.normal(size=(20, 3, 3))
    x0 = rng.normal(size=(20, 1, 3))
    plane, other = (span("plane", np.concatenate([x0, x0 + directions[:, k : k + 1], x0 + directions[:, 2:]], axis=1)) for k in (0, 1))
    line = span("line", np.concatenate([x0, x0 + directions[:, 1:2]], axis=1))
    common = np.concatenate([x0, x0 + directions[:, 2:]], axis=1)  # of the two planes: a line
    extra = rng.normal(size=(20, 3, 3))
    spheres = [span("sphere", np.concatenate([common, extra[:, [0, k]]], axis=1)) for k in (1, 2)]
    pairs = {"plane, plane": (plane, other), "line, plane": (line, plane), "sphere, sphere": spheres, "sphere, plane": (spheres[0], plane)}
    back = Multivector(PSEUDOSCALAR, [-1])
    for name, (first, second) in pairs.items():
        meet = (first.dual() ^ second.dual()).dual()
        shared = common if name != "line, plane" else x0
        for x in np.moveaxis(shared, 1, 0):
            assert largest((point(x) ^ meet).scaled(1 / np.abs(numbers(meet)).max(axis=1))) < 2e-13, name
        assert np.abs(numbers(meet)).max(axis=1).min() > 0.01
        assert largest(((first * back) ^ (second * back)) * back + meet) == 0
        assert largest(first.dual().dual() + first) == 0


def test_5_needs_edge_cases(rng):
    """Text under (5): 'not necessary to check ... a line and a circle'. In one plane they may meet twice, once or never: (5) is 0 for all,
    because both duals hold the plane. The dual within that plane finds the two points."""
    points = random_points(rng, "circle", 20)
    c, n, r = parameters("circle", points)
    circle, plane = span("circle", points), span("plane", points)
    inside = points[:, 0] - c
    across = np.cross(n, inside)
    for offset, meets in ((0.4, True), (3.0, False)):
        start = c + offset * inside
        line = span("line", np.stack([start, start + across], axis=1))
        assert largest((line.dual() ^ circle.dual()).dual()) < 1e-12 * largest(line) * largest(circle)
        within_plane = ((line * inverse(plane)) ^ (circle * inverse(plane))) * plane
        square = within_plane.scalar_product(within_plane)
        assert np.all(square > 0) if meets else np.all(square < 0)
        if meets:
            half = np.sqrt(1 - offset**2) * r
            for sign in (1, -1):
                gap = point(start + sign * half * across / norm(across)) ^ within_plane
                assert largest(gap.scaled(1 / np.abs(numbers(within_plane)).max(axis=1))) < 2e-13


# ---- (20), (24), (27), (28): what is read off, and with which weight


@pytest.mark.parametrize("kind", EXTENDED)
def test_20_28_hold_up_to_the_size(kind, rng):
    """(20), (28): X = V X_u ~V is off by the factor w r (flats: w), here 0.003 to 100; after division it holds. A sphere
    through points of negative orientation has w < 0: no similarity brings X_u to it, V takes X_u to X / (w r)."""
    points = random_points(rng, kind)
    x = span(kind, points)
    moved = similarity(kind, *parameters(kind, points)).sandwich(UNITS[kind], KINDS[kind][1])
    size = np.abs(numbers(x)).max(axis=1)
    assert (np.abs(numbers(moved - x)).max(axis=1) / size).min() > 2e-3
    right = normalised(kind, x)
    error = np.abs(numbers(moved - right)).max(axis=1) / np.abs(numbers(right)).max(axis=1)
    assert error.max() < 1e-11  # of the widest sphere
    if kind == "sphere":
        flipped = weight(kind, x)[:, 0] < 0
        assert flipped.sum() > 10 and np.all((moved.scalar_product(~x) < 0) == ~flipped)  # same sense: <X ~X> is negative


def test_points_under_a_dilation(rng):
    """(6) with a dilation changes the weight of a point to 1/d: compare Y over its e0, not Y."""
    x, d = rng.normal(size=(20, 3)), np.exp(rng.normal(size=(20, 1)))
    moved = similarity("sphere", 0 * x, None, d).sandwich(point(x), POINT)
    assert largest(at(moved, "e0") * d - 1) < 3e-15 and largest(at(moved, "e1 e2 e3") / at(moved, "e0") - d * x) < 1e-14
    assert largest(numbers(moved - point(d * x))) > 1


@pytest.mark.parametrize("kind", ROUNDS)
def test_24_is_the_reciprocal(kind, rng):
    """(24): |(X . ei) X^-1| is 1/r, and its square is negative; read as r it is off by 1e-3 to 1e3 of it."""
    points = random_points(rng, kind)
    r = parameters(kind, points)[2][:, 0]
    x = span(kind, points)
    projected = ((x | INFINITY) * inverse(x)).project(POINT)
    square = projected.scalar_product(projected)
    assert np.all(square < 0) and np.abs(np.sqrt(-square) * r - 1).max() < 2e-12
    within(np.abs(np.sqrt(-square) / r - 1), 1e-3, 1e3)


@pytest.mark.parametrize(("kind", "sign"), [("pointpair", -1), ("circle", 1), ("sphere", 1)])
def test_27_has_a_weight(kind, sign, rng):
    """(27): X ei X is the centre times 2 w^2, of a pair times -2 w^2: divide by the e0 coefficient. As printed it is off by 0.04 to 1e4."""
    points = random_points(rng, kind)
    c, _, _ = parameters(kind, points)
    x = span(kind, points)
    reflected = (x * INFINITY * x).project(POINT)
    assert largest(at(reflected, "e0") / (2 * sign * weight(kind, x) ** 2) - 1) < 2e-11
    assert largest((at(reflected, "e1 e2 e3") / at(reflected, "e0") - c) / (1 + np.abs(c))) < 2e-11
    within(norm(at(reflected, "e1 e2 e3") - c), 0.04, 1e4)


@pytest.mark.parametrize(
    ("kind", "distance", "low", "high"),
    [("pointpair", 100, 1e-8, 1e-5), ("circle", 10, 1e-10, 1e-7), ("circle", 100, 1e-7, 1e-4), ("sphere", 100, 1e-6, 1e-4)],
)
def test_radii_read_off_lose_digits(kind, distance, low, high, rng):
    """similarity.md, section 3: points 0.01 m apart, 10 or 100 m from the origin. The radius of X in floats is wrong from the 9th or
    the 5th digit on, that of the point formulas in the last one, against X in 60 digits."""
    off_x, off_points = [], []
    for direction, points in zip(rng.normal(size=(8, 3)), random_points(rng, kind, 8), strict=True):
        points = distance * direction / np.linalg.norm(direction) + 0.01 * points
        with mpmath.workdps(60):
            embedded = [[mpmath.mpf(float(v)) for v in place] for place in points]
            wedge = Multivector(POINT, [1, *embedded[0], sum(v * v for v in embedded[0]) / 2])
            for place in embedded[1:]:
                wedge = wedge ^ Multivector(POINT, [1, *place, sum(v * v for v in place) / 2])
            heaviest = wedge.at(DIRECTION.get(kind, "e0123"))
            expected = mpmath.sqrt(-wedge.scalar_product(~wedge) / sum(v * v for v in heaviest))
            off_x.append(abs(float(read_off(kind, points)[2][0] / expected - 1)))
            off_points.append(abs(float(parameters(kind, points)[2][0] / expected - 1)))
    assert low < np.median(off_x) < high and max(off_points) < 1e-14, (off_x, off_points)
