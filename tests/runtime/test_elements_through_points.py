"""Which points make no element: named one by one, told row by row, and never an infinity, a NaN or a warning in any case."""

import warnings

import element_draws as draws
import numpy as np
import pytest
from element_draws import COUNTS, awkward_points, make
from hypothesis import given, settings
from hypothesis import strategies as st

import cga_runtime as cga
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.joins import join, weight
from cga_runtime.elements.similarities import interpolate, similarity_between, similarity_of
from cga_runtime.elements.through_points import FARTHEST, degenerate


@pytest.mark.parametrize("case", draws.ORACLE["degenerate"], ids=lambda case: case["what"])
def test_the_degenerate_cases_of_the_oracle_are_refused(case):
    kind = next(kind for kind, name in draws.ORACLE_NAMES.items() if name == case["kind"])
    assert case["expect"] == "reject" and degenerate(case["points"], kind.kind)
    with pytest.raises(cga.DegenerateError, match="coincide|lie on one line|lie in one plane"):
        make(kind, np.array(case["points"]))


@pytest.fixture(scope="module")
def draw():
    """Drawn once, for it takes as long as one kind's test."""
    return awkward_points(np.random.default_rng(20), 200_000)


@pytest.mark.parametrize("kind", COUNTS)
def test_every_draw_is_finite_or_named(kind, draw):
    points = draw[:, : COUNTS[kind]]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        wrong = degenerate(points, kind.kind)
        assert 0.05 < wrong.mean() < 0.85
        x = make(kind, points[~wrong])  # raises if a single row of these were not sound
        values = [x.coefficients, x.center, weight(*np.moveaxis(points[~wrong], 1, 0))]
        near = np.abs(points[~wrong]).max(axis=(1, 2)) < 1e50
        values.append(join(*np.moveaxis(points[~wrong][near], 1, 0)).coefficients)
        first, second = draws.row(x, slice(10_000)), draws.row(x, slice(10_000, 20_000))
        values += [similarity_of(x).coefficients for x in (first, second)]
        values += [similarity_between(first, second, gauge).coefficients for gauge in ("direct", "composed")]
        if kind in (Point, Line, Plane):  # a small round element on its way to a distant one may become too small where it is
            values += [interpolate(first, second, 0.3, chart).coefficients for chart in ("split", "lie")]
        assert all(np.isfinite(array).all() for array in values)
        for one in points[wrong][:100]:
            with pytest.raises(cga.DegenerateError):
                make(kind, one)


@pytest.mark.parametrize("kind", COUNTS)
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_any_floats_make_an_element_or_an_error(kind, data):
    numbers = st.lists(st.floats(width=64), min_size=3 * COUNTS[kind], max_size=3 * COUNTS[kind])
    points = np.array(data.draw(numbers)).reshape(COUNTS[kind], 3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            wrong = degenerate(points, kind.kind)
        except cga.NotFiniteError:
            assert not np.isfinite(points).all()
            return
        if wrong:
            with pytest.raises(cga.DegenerateError):
                make(kind, points)
        else:
            x = make(kind, points)
            assert np.isfinite(x.coefficients).all() and np.isfinite(similarity_of(x).coefficients).all()


def test_rows_are_told_apart():
    sound, flat, twice = ((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (1, 0, 0), (2, 0, 0)), ((0, 0, 0), (0, 0, 0), (0, 1, 0))
    assert degenerate([[sound, flat], [twice, sound]], "circle").tolist() == [[False, True], [True, False]]
    with pytest.raises(cga.DegenerateError, match=r"^circle: its three points lie on one line, at index \(1,\)$"):
        Circle.from_points(*np.moveaxis(np.array([sound, flat, flat], dtype=float), 1, 0))
    with pytest.raises(cga.DegenerateError, match="at least|coincide"):
        make(Circle, np.array(twice, dtype=float))


BESIDE = [
    (PointPair, lambda e: ((0, 0, 0), (e, 0, 0)), 1e-9),
    (Line, lambda e: ((1e5, 0, 0), (1e5, e, 0)), 1e-7),
    (Circle, lambda e: ((0, 0, 0), (1, 0, 0), (2, 2 * e, 0)), 1e-9),
    (Plane, lambda e: ((0, 0, 0), (1e3, 0, 0), (3, 3 * e, 0)), 1e-9),
    (Sphere, lambda e: ((0, 0, 0), (2, 0, 0), (0, 3, 0), (1, 1, 2**0.5 * e)), 1e-9),
    (Circle, lambda e: ((0, 0, 0), (2 * e, 0, 0), (e, e, 0)), 1e-9),  # radius e
]


@pytest.mark.parametrize(("kind", "points", "threshold"), BESIDE)
def test_thresholds_lie_where_they_are_said_to(kind, points, threshold):
    below, above = (np.array(points(threshold * factor), dtype=float) for factor in (0.99, 1.01))
    assert degenerate(below, kind.kind) and not degenerate(above, kind.kind)
    assert np.isfinite(make(kind, above).coefficients).all()
    with pytest.raises(cga.DegenerateError):
        make(kind, below)


def test_small_triangles_have_planes(rng):
    points = 1e-8 * rng.normal(size=(3, 3))
    n = np.cross(*(1e8 * (points[1:] - points[0])))
    np.testing.assert_allclose(Plane.from_points(*points).normal, n / np.linalg.norm(n), atol=1e-14)
    np.testing.assert_allclose(Circle.from_points(*points).normal, n / np.linalg.norm(n), atol=1e-14)


FAR = 2 * FARTHEST
BEYOND = r"more than 1e\+60 m from the origin"
REFUSED = [
    (lambda: Point((FAR, 0, 0)), f"point: it lies {BEYOND}"),
    (lambda: Point((1e200, 1e300, 0)), f"point: it lies {BEYOND}"),
    (lambda: PointPair.from_points((0, 0, 0), (FAR, 0, 0)), f"point pair: one of its points lies {BEYOND}"),
    (lambda: Line.from_points((0, 0, 0), (1e200, 0, 0)), f"line: one of its points lies {BEYOND}"),
    (lambda: Line.from_point_direction((0, FAR, 0), (1, 0, 0)), f"line: its point lies {BEYOND}"),
    (lambda: Circle.from_points((0, 0, 0), (1e59, 0, 0), (2e59, 1e52, 0)), r"circle: its centre or its radius is beyond 1e\+60 m"),
    (lambda: Circle((0, 0, FAR), (0, 0, 1), 1), f"circle: its centre lies {BEYOND}"),
    (lambda: Circle((0, 0, 0), (0, 0, 1), 1e300), r"circle: radius 1.0e\+300 given, at most 1e\+60 m is accepted"),
    (lambda: Plane.from_points((FAR, 0, 0), (0, 1, 0), (0, 0, 1)), f"plane: one of its points lies {BEYOND}"),
    (lambda: Plane.from_point_normal((FAR, 0, 0), (0, 1, 0)), f"plane: its point lies {BEYOND}"),
    (lambda: Plane.from_normal_offset((0, 1e-10, 0), 1e300), f"plane: its foot lies {BEYOND}"),
    (lambda: Plane.from_normal_offset((0, 1, 0), -FAR), f"plane: its foot lies {BEYOND}"),
    (lambda: Sphere.from_center_radius((0, FAR, 0), 1), f"sphere: its centre lies {BEYOND}"),
    (lambda: Sphere.from_points((0, 0, 0), (1e58, 0, 0), (0, 1e58, 0), (2e58, 1e58, 1e50)), "sphere: its centre or its radius is beyond"),
    (lambda: Sphere.from_center_radius(np.zeros(3), FAR), r"sphere: radius 2.0e\+60 given, at most"),
]


@pytest.mark.parametrize(("make_it", "message"), REFUSED)
def test_what_is_too_large_is_named(make_it, message):
    with warnings.catch_warnings(), pytest.raises(cga.DegenerateError, match=message):
        warnings.simplefilter("error")
        make_it()


def test_normals_and_directions_have_any_length():
    plane = Plane.from_normal_offset((0, 3e300, 4e300), 5e300)
    np.testing.assert_allclose([*plane.normal, plane.offset], (0, 0.6, 0.8, 1.0), rtol=1e-15)
    np.testing.assert_allclose(Line.from_point_direction((0, 0, 0), (0, 3e300, 4e300)).direction, (0, 0.6, 0.8), rtol=1e-15)


def test_wrong_questions_are_named():
    with pytest.raises(cga.UnknownNameError, match="unknown kind of element 'cone'; known: point, point_pair, line, circle, plane, sphere"):
        degenerate(np.zeros((1, 3)), "cone")
    with pytest.raises(cga.WrongSizeError, match=r"points of a point pair: shape \(3, 3\) given, \(..., 2, 3\) needed"):
        degenerate(np.zeros((3, 3)), "point_pair")
    with pytest.raises(cga.NotFiniteError, match="points of a circle holds NaN"):
        degenerate(np.full((3, 3), np.nan), "circle")
