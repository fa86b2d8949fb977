"""Similarities of elements: the oracle, V X1 ~V = X2 by full products in both gauges and charts, what can be controlled, ways between."""

from itertools import product

import element_draws as draws
import numpy as np
import pytest
from element_draws import COUNTS, ORACLE, ORACLE_NAMES, make

import cga_runtime as cga
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.charts import REFERENCE
from cga_runtime.elements.similarities import (
    CONTROLLABLE,
    GAUGES,
    interpolate,
    similarity_between,
    similarity_of,
    unit_primitive,
)
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.motors import Motor
from cga_runtime.multivectors import Multivector
from cga_runtime.versors import Dilator, Rotor, Similarity

ROUND = (PointPair, Circle, Sphere)
B7 = BIVECTORS["similarity"]


@pytest.mark.parametrize("kind", COUNTS)
def test_the_oracle_in_the_shortest_arc(kind):
    cases = ORACLE["primitives"][ORACLE_NAMES[kind]]
    x = make(kind, np.array([case["points"] for case in cases]))
    versors = similarity_of(x, chart=1)
    for ours, name in ((versors.coefficients, "V"), (versors.log(), "B")):
        reference = np.array([case[name] for case in cases])
        np.testing.assert_allclose(ours, reference, rtol=0, atol=1e-14 * max(1.0, np.abs(reference).max()))
    np.testing.assert_array_equal(draws.full(unit_primitive(kind.kind)), ORACLE["units"][ORACLE_NAMES[kind]])
    assert list(CONTROLLABLE[kind.kind]) == ORACLE["controllable"][ORACLE_NAMES[kind]]
    weights = np.array([case["weight"] for case in cases]) * (x.radius if kind in ROUND else 1.0)
    sandwich = draws.full(versors * unit_primitive(kind.kind) * ~versors)
    assert draws.off(sandwich * weights[:, None], np.array([case["X"] for case in cases])) < 1e-12


@pytest.mark.parametrize(("kind", "chart"), list(product(COUNTS, (1, -1, None))))
def test_the_similarity_of_an_element_carries_the_unit_primitive_to_it(kind, chart, rng):
    x = draws.random(kind, rng, 200)
    v = similarity_of(x, chart)
    radius = x.radius if kind in ROUND else 1.0
    terms = 1.0 + radius + (x.center**2).sum(-1) / radius  # of which the sandwich is the sum; some cancel
    error = np.abs(draws.full(v * unit_primitive(kind.kind) * ~v) - draws.full(x)).max(axis=-1)
    assert (error / terms).max() < 5e-15
    moved = unit_primitive(kind.kind).transformed(v)
    for name in ("center", "direction", "normal", "radius", "offset"):
        if hasattr(x, name):
            size = np.abs(x.center).max() if name != "radius" else x.radius.max()
            np.testing.assert_allclose(getattr(moved, name), getattr(x, name), rtol=0, atol=2e-15 * max(1.0, size))
    np.testing.assert_allclose(v.translation(), x.center, rtol=1e-14, atol=1e-14)
    np.testing.assert_allclose(v.scale(), x.radius if kind in ROUND else np.ones(200), rtol=1e-14)
    if kind.kind not in REFERENCE:
        np.testing.assert_allclose(np.abs(v.rotation().coefficients), np.eye(4)[:1] + np.zeros((200, 1)), atol=1e-15)


@pytest.mark.parametrize(("kind", "gauge", "chart"), list(product(COUNTS, GAUGES, (1, -1, None))))
def test_the_similarity_between_carries_one_to_the_other(kind, gauge, chart, rng):
    x1, x2 = draws.random(kind, rng, 100), draws.random(kind, rng, 3, 1)
    v = similarity_between(x1, x2, gauge, chart)
    assert type(v) is Similarity and v.coefficients.shape == (3, 100, 12)
    reference = np.broadcast_to(draws.full(x2), (3, 100, 32))
    assert draws.off(draws.full(v * x1 * ~v), reference) < 1e-9  # of elements of sizes up to 1e3, through each other's frames
    near = np.abs(draws.full(x1)).max(axis=-1) < 30
    assert draws.off(draws.full(v * x1 * ~v)[:, near], reference[:, near]) < 5e-12
    if gauge == "composed":
        product = similarity_of(x2, chart) * ~similarity_of(x1, chart)
        np.testing.assert_allclose(product.coefficients, v.coefficients, rtol=0, atol=1e-12 * np.abs(v.coefficients).max())


def test_the_gauges_differ_by_a_turn_that_the_element_does_not_see(rng):
    x1, x2 = draws.random(Circle, rng), draws.random(Circle, rng)
    direct, composed = (similarity_between(x1, x2, gauge) for gauge in GAUGES)
    between = ~direct * composed
    assert np.abs(between.log()).max() > 0.01
    assert draws.off(x1.transformed(between), x1) < 1e-13
    turn = direct.rotation().vector()
    assert abs(turn @ x1.normal) < 1e-14 and abs(turn @ x2.normal) < 1e-14  # no turn about the normals


@pytest.mark.parametrize("kind", [PointPair, Line, Circle, Plane])
def test_the_half_turn_of_the_direct_gauge_goes_about_the_axis_carried_along(kind, rng):
    x1, x2 = draws.random(kind, rng), draws.random(kind, rng)
    first = similarity_of(x1).rotation()
    n = x1.normal if kind in (Circle, Plane) else x1.direction
    half = Rotor.from_vector(np.pi * (first.matrix() @ (1.0, 0.0, 0.0)))
    np.testing.assert_allclose(half.matrix() @ n, -n, atol=1e-15)
    turned = similarity_between(x1, x2, chart=-1).rotation() * ~half  # what is left is the shortest arc from -n1
    assert abs(turned.vector() @ n) < 1e-14


@pytest.mark.parametrize("kind", [PointPair, Line, Circle, Plane])
@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-8, 1e-3])
def test_opposite_directions_are_no_exception(kind, angle, rng):
    x1 = draws.random(kind, rng)
    n = x1.normal if kind in (Circle, Plane) else x1.direction
    side = np.cross(n, rng.normal(size=3))
    side /= np.linalg.norm(side)
    x2 = x1.transformed(Rotor.from_vector((np.pi - angle) * side)).transformed(Dilator.from_scale(2.0))
    v = similarity_between(x1, x2)
    assert draws.off(x1.transformed(v), x2) < 1e-13 and draws.off(draws.full(v * x1 * ~v), x2) < 1e-12
    assert draws.off(interpolate(x1, x2, 1.0), x2) < 1e-12


@pytest.mark.parametrize("kind", COUNTS)
def test_controllable_bivectors_move_the_unit_primitive_and_the_others_do_not(kind):
    x = unit_primitive(kind.kind)
    moves = set()
    for blade in B7:
        b = Multivector([1.0], [blade])
        moved = draws.full((b * x) - (x * b)) / 2
        if kind is Point:  # up to scale
            moved = moved - moved[1] * draws.full(x)
        if np.abs(moved).max() > 0:
            moves.add(blade)
    assert moves == set(CONTROLLABLE[kind.kind])


STEPS = np.linspace(0.0, 1.0, 9)


@pytest.mark.parametrize("chart", ["split", "lie"])
@pytest.mark.parametrize("kind", COUNTS)
def test_the_way_starts_at_one_and_ends_at_the_other(kind, chart, rng):
    x1, x2 = draws.random(kind, rng, 20), draws.random(kind, rng, 20)
    assert draws.off(interpolate(x1, x2, 0.0, chart), x1) < 1e-12 and draws.off(interpolate(x1, x2, 1.0, chart), x2) < 1e-9
    way = interpolate(x1, x2, STEPS[:, None], chart)
    assert type(way) is kind and way.batch == (9, 20)
    assert interpolate(draws.row(x1, 0), draws.row(x2, 0), STEPS, chart).batch == (9,)
    # V1 exp(s log V_e) X_u by the products that the docstring names
    one, other = draws.row(x1, slice(5)), draws.row(x2, slice(5))
    v1 = similarity_of(one)
    relative = ~v1 * similarity_between(one, other) * v1
    v = v1 * Similarity.exp(0.3 * relative.log(chart), chart)
    assert draws.off(interpolate(one, other, 0.3, chart), draws.full(v * unit_primitive(kind.kind) * ~v) / _weight(kind, v)) < 1e-10


def _weight(kind, v):
    moved = draws.full(v * unit_primitive(kind.kind) * ~v)
    return moved[..., 1:2] if kind is Point else np.ones(())


def test_the_split_way_is_straight_and_geometric(rng):
    for kind in ROUND:
        x1, x2 = draws.random(kind, rng), draws.random(kind, rng)
        s = np.array([-0.5, 0.0, 0.25, 0.5, 1.0, 1.5])
        way = interpolate(x1, x2, s)
        size = max(1.0, np.abs(x1.center).max(), np.abs(x2.center).max())
        np.testing.assert_allclose(way.center, x1.center + s[:, None] * (x2.center - x1.center), atol=1e-13 * size)
        np.testing.assert_allclose(way.radius, x1.radius ** (1 - s) * x2.radius**s, rtol=1e-13)
        if kind is not Sphere:
            n = way.direction if kind is PointPair else way.normal
            angle = np.arccos(n[1] @ n[4])
            np.testing.assert_allclose(n @ n[1], np.cos(s * angle), atol=1e-13)
            assert np.abs(n @ np.cross(n[1], n[4])).max() < 1e-14  # in one plane


def test_the_lie_way_is_one_motion_repeated(rng):
    for kind in COUNTS:
        x1, x2 = draws.random(kind, rng), draws.random(kind, rng)
        step = Similarity.exp(similarity_between(x1, x2).log("lie") / 4, "lie")
        x = x1
        for s in (0.25, 0.5, 0.75, 1.0, 1.25):
            x = x.transformed(step)
            assert draws.off(interpolate(x1, x2, s, "lie"), x) < 1e-11
    turned = Circle(np.zeros(3), (0, 0, 1), 1.0), Circle((1.0, 0, 0), (1, 0, 0), 1.0)
    bow = interpolate(*turned, STEPS, "lie").center  # off the straight way
    assert np.abs(bow[:, 2]).max() > 0.1 and np.abs(interpolate(*turned, STEPS).center[:, 1:]).max() < 1e-15


def test_points_and_spheres_go_straight_in_the_split_chart_and_points_in_both():
    a, b = Point((0, 0, 1)), Point((2, 4, 1))
    for chart in ("split", "lie"):
        np.testing.assert_allclose(interpolate(a, b, [0.5, 2.0], chart).center, [(1, 2, 1), (4, 8, 1)], atol=1e-15)


def test_similarities_move_with_their_elements(rng):
    """V12 of two moved elements is M V12 ~M up to a turn about the direction: both carry one to the other."""
    motor = Motor.exp(rng.normal(size=6))
    for kind in COUNTS:
        x1, x2 = draws.random(kind, rng), draws.random(kind, rng)
        moved = x1.transformed(motor).transformed(motor * similarity_between(x1, x2) * ~motor)
        assert draws.off(moved, x2.transformed(motor)) < 1e-11


def test_wrong_pairs_and_names_are_refused(rng):
    circle, sphere = draws.random(Circle, rng), draws.random(Sphere, rng)
    message = "a circle and a sphere given; a similarity takes an element to one of its own kind only"
    for call in (lambda: similarity_between(circle, sphere), lambda: interpolate(circle, sphere, 0.5)):
        with pytest.raises(cga.WrongSizeError, match=message):
            call()
    with pytest.raises(cga.UnknownNameError, match="unknown gauge 'short'; known: direct, composed"):
        similarity_between(circle, circle, "short")
    with pytest.raises(cga.UnknownNameError, match="unknown chart 'straight'; known: split, lie"):
        interpolate(circle, circle, 0.5, "straight")
    with pytest.raises(cga.UnknownNameError, match="unknown kind of element 'cone'; known: point, point_pair, line, circle, plane, sphere"):
        unit_primitive("cone")
    for call in (lambda: similarity_of(np.zeros(3)), lambda: similarity_between(np.zeros(3), circle)):
        with pytest.raises(cga.UnknownNameError, match="unknown kind of element 'ndarray'"):
            call()
    with pytest.raises(cga.WrongSizeError, match="two circles: batch dimensions"):
        similarity_between(draws.random(Circle, rng, 2), draws.random(Circle, rng, 3))
    with pytest.raises(cga.WrongSizeError, match="interpolate: batch dimensions"):
        interpolate(draws.random(Circle, rng, 2), circle, [0.0, 0.5, 1.0])
    with pytest.raises(cga.NotFiniteError, match="s holds NaN"):
        interpolate(circle, circle, np.nan)
    small, large = Sphere.from_center_radius((0, 0, 0), 1e-3), Sphere.from_center_radius((1, 0, 0), 1.0)
    with pytest.raises(cga.DegenerateError, match="sphere: radius"):
        interpolate(small, large, -3.0)
    with pytest.raises(cga.CgaError):
        interpolate(small, large, 1e6)
    assert interpolate(small, large, 3.0).radius == pytest.approx(1e6)
