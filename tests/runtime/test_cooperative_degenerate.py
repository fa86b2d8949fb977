"""A million draws of points, most of them degenerate somehow: numbers that are finite, or an error with a name; and what is refused.

Points coincide, lie on one line, plane or circle, face the pole of a chart, are tiny, huge, or of several sizes at once. `guard` and
`degeneracy` have a value for all of them, and where the guard is above its thresholds everything else has one (similarity.md, section 8).
"""

from pathlib import Path

import numpy as np
import pytest
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements.charts import SEAM
from cga_runtime.elements.through_points import COINCIDENT, FLAT, degenerate
from cga_runtime.spaces.cooperative_kernels import primitive_unit
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

DRAWS = 170_000
TOTAL = ("primitive", "primitive_jacobian", "degeneracy", "degeneracy_gradient", "guard")
DIVIDING = ("similarity", "parts", "analytic_jacobian", "geometric_jacobian", "horizontal_jacobian")
RATES = ("geometric_jacobian_derivative", "horizontal_jacobian_derivative")
METHODS = (
    *("points", "point_jacobian", "primitive", "primitive_jacobian", "weight", "degeneracy", "degeneracy_gradient", "chart", "similarity"),
    *("log", "analytic_jacobian", "geometric_jacobian", "space_jacobian", "horizontal_jacobian", "bivector_jacobian", "nullspace"),
    *("manipulability", "manipulability_gradient"),
)


def arranged(kind, count, rng):
    """Points (count, k, 3), one in eleven of each arrangement; then one in four away from the origin, one in four scaled."""
    about = PRIMITIVES[kind]
    x = rng.normal(size=(count, about.points, 3))
    how = rng.integers(0, 11, count)
    spin = np.linalg.qr(rng.normal(size=(1000, 3, 3)))[0][rng.integers(0, 1000, count)]
    some, other = (rng.integers(0, about.points, count) for _ in range(2))
    rows = np.arange(count)

    def put(case, values):
        x[how == case] = np.broadcast_to(values, x.shape)[how == case]

    twin = x.copy()
    twin[rows, some] = twin[rows, other]
    put(1, twin)  # two coincide, or not
    twin[rows, some] += 10.0 ** rng.uniform(-16, -6, (count, 1)) * rng.normal(size=(count, 3))
    put(2, twin)  # nearly
    put(3, rng.integers(-1, 2, x.shape).astype(float))  # a small grid: coincident, collinear, coplanar, antiparallel, exactly
    put(4, (x * [1.0, 0.0, 0.0]) @ spin)  # on a line, but for rounding
    put(5, (x * [1.0, 1.0, 10.0 ** rng.uniform(-17, -5)]) @ spin)  # near a plane
    angle = rng.uniform(0, 2 * np.pi, x.shape[:2])
    put(6, np.stack([np.cos(angle), np.sin(angle), 0 * angle], -1) @ spin)  # on a circle
    put(7, np.linspace(1, 2, about.points)[:, None] * rng.choice([-1.0, 1.0], (count, 1, 1)) * [0.0, 1.0, 0.0] + 1e-7 * x)  # along e2
    put(8, np.concatenate([x[:, :, :2], 1e-8 * x[:, :, 2:]], -1))  # facing e3 or its opposite
    put(9, np.zeros(3))
    put(10, x * 10.0 ** rng.uniform(-12, 12, (count, about.points, 1)))  # of several sizes
    x[rng.random(count) < 0.25] += 10.0 ** rng.uniform(0, 8) * rng.normal(size=3)
    size = np.where(rng.random(count) < 0.25, 10.0 ** rng.choice([-12.0, -9.0, -5.0, 3.0, 7.0, 12.0], count), 1.0)
    return x * size[:, None, None]


def usable(kind, points):
    """Where the guard lets pass, and the default chart there."""
    guard = primitive_unit(kind).kernel("guard")(points)
    assert np.isfinite(guard).all()
    passed = (guard[:, 0] > FLAT) & (guard[:, 2:] > COINCIDENT**2).all(axis=1)
    return passed, np.where(guard[:, 1] < SEAM, -1.0, 1.0)[:, None]


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_a_million_draws_over_points(kind):
    rng = np.random.default_rng(11)
    points, unit = arranged(kind, DRAWS, rng), primitive_unit(kind)
    for name in TOTAL:
        assert np.isfinite(unit.kernel(name)(points)).all(), name
    passed, chart = usable(kind, points)
    share = passed.mean()
    assert 0.2 < share and (share < 0.8 or kind == "point") and (set(chart.ravel()) == {1.0, -1.0} or PRIMITIVES[kind].reference is None)
    points, chart = points[passed], chart[passed]
    for name in DIVIDING:
        assert np.isfinite(unit.kernel(name)(points, chart)).all(), name
    for name in RATES:
        assert np.isfinite(unit.kernel(name)(points, chart, rng.normal(size=points.shape))).all(), name
    parts = unit.kernel("parts")(points, chart)
    assert np.abs(np.linalg.norm(parts[:, :4], axis=1) - 1).max() < 1e-13 and (parts[:, 7] > 0).all()
    if PRIMITIVES[kind].reference is not None:
        carried = cga.Rotor(parts[:, :4] / np.linalg.norm(parts[:, :4], axis=1)[:, None]).matrix() @ PRIMITIVES[kind].reference
        edges = points[:, 1:] - points[:, :1]
        along = edges[:, 0] if PRIMITIVES[kind].points == 2 else np.cross(edges[:, 0], edges[:, 1])
        n = along / np.linalg.norm(along, axis=1)[:, None]
        sine = np.ones(len(n)) if PRIMITIVES[kind].points == 2 else unit.kernel("degeneracy")(points)[:, 0]
        assert (np.abs(carried - n).max(axis=1) < 4e-15 / sine).all()  # the angle of an edge is known to rounding


# ---- whole systems, whose joint positions are the points


@pytest.fixture(scope="module")
def chains():
    return gantries()


@pytest.fixture(scope="module")
def systems(chains):
    return {kind: cga.Cooperative(chains[: about.points], kind) for kind, about in PRIMITIVES.items()}


def everything(system, q):
    """All numbers that the public methods give at q, by name."""
    rate, target = np.ones(system.n), cga.Similarity.exp([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7])
    element = system.element(q)
    found = {name: getattr(system, name)(q) for name in METHODS}
    found |= {name: getattr(system, name)(q, rate) for name in RATES}
    found |= {name: getattr(system, name)(q, target, system.chart(q)) for name in ("error", "error_jacobian")}
    return found | {name: getattr(element, name) for name in ("center", "coefficients")}


@pytest.mark.parametrize("kind", PRIMITIVES)
def test_where_there_is_an_element_there_are_numbers(systems, kind):
    """`degenerate` tells of points where there is none (similarity.md, section 8)."""
    points = arranged(kind, 4000, np.random.default_rng(12))
    good = points[~degenerate(points, kind)].reshape(-1, systems[kind].n)
    for name, values in everything(systems[kind], good).items():
        assert len(values) == len(good) and np.isfinite(values).all(), name


@pytest.mark.parametrize("kind", [kind for kind in PRIMITIVES if kind != "point"])
def test_where_there_is_none_the_class_says_why(systems, kind):
    points = arranged(kind, 2000, np.random.default_rng(13))
    bad = points[degenerate(points, kind)].reshape(-1, systems[kind].n)
    assert len(bad) > 200
    system = systems[kind]
    for name in ("degeneracy", "degeneracy_gradient", "primitive", "primitive_jacobian"):
        assert np.isfinite(getattr(system, name)(bad)).all()
    silent = {}
    for q in bad[:150]:
        for name in ("similarity", "horizontal_jacobian", "chart", "log", "nullspace", "element"):
            try:
                getattr(system, name)(q)
                silent.setdefault(name, []).append(q.tolist())
            except cga.DegenerateError as error:
                assert any(word in str(error) for word in ("coincide", "lie on one line", "lie in one plane", "its radius is at most")), (
                    error
                )
    assert not silent, {name: (len(rows), rows[0]) for name, rows in silent.items()}


@pytest.mark.parametrize("kind", PRIMITIVES)
@pytest.mark.parametrize("size", [1e30, 1e60, 1e100, 1e160, 1e300, 1e-150, 1e-300, 5e-324])
def test_sizes_that_no_float_holds_the_square_of(systems, kind, size):
    """Each method by itself: finite numbers or an error of ours, never infinity."""
    system = systems[kind]
    with np.errstate(all="ignore"):
        for q in size * np.random.default_rng(14).normal(size=(3, system.n)):
            calls = {name: (lambda name=name, q=q: getattr(system, name)(q)) for name in METHODS}
            calls |= {name: (lambda name=name, q=q: getattr(system.element(q), name)) for name in ("center", "coefficients")}
            calls |= {name: (lambda name=name, q=q: getattr(system, name)(q, np.ones(system.n))) for name in RATES}
            for name, call in calls.items():
                try:
                    values = call()
                except cga.CgaError as error:
                    assert "inertia" not in str(error), f"{name}: {error}"
                else:
                    assert np.isfinite(values).all(), name


# ---- what is refused


def refused(error, text):
    return pytest.raises(error, match=text)


def test_chains_that_end_in_one_point(chains):
    """The same chain twice: its joints are shared and its points coincide at every q."""
    a, b, c, _ = chains
    for ends, kind, text in (
        ([a, a], "point_pair", "point.pair: two of its points coincide"),
        ([a, a], "line", "line: two of its points coincide"),
        ([a, a, b], "circle", "circle: two of its points coincide"),
        ([a, b, b], "plane", "plane: .*points (coincide|lie on one line)"),
        ([a, b, c, b], "sphere", "sphere: .*points (coincide|lie in one plane)"),
    ):
        system = cga.Cooperative(ends, kind)
        q = system.random(np.random.default_rng(1))
        for name in ("similarity", "geometric_jacobian", "manipulability", "element"):
            with refused(cga.DegenerateError, text):
                getattr(system, name)(q)
        with refused(cga.DegenerateError, text):
            system.error(q, cga.Similarity.exp(np.zeros(7)))
        assert system.degeneracy(q) < 1e-9 and np.isfinite(system.degeneracy_gradient(q)).all()


def test_one_bad_row_of_a_batch(systems):
    """It is named by `degeneracy`."""
    system = systems["circle"]
    q = system.random(np.random.default_rng(2), 5)
    q[3, 6:] = 2 * q[3, 3:6] - q[3, :3]
    with refused(cga.DegenerateError, "circle: its .*points lie on one line"):
        system.similarity(q)
    np.testing.assert_array_equal(system.degeneracy(q) < 1e-9, np.arange(5) == 3)


def test_systems_that_cannot_be_made(chains, skew):
    a, b, *_ = chains
    with refused(cga.UnknownNameError, "unknown primitive 'torus'; known: point, point_pair, line, circle, plane, sphere"):
        cga.Cooperative([a, b], "torus")
    for count, kind in ((2, "point"), (1, "line"), (2, "circle"), (4, "plane"), (3, "sphere"), (0, "point_pair")):
        with refused(cga.WrongSizeError, f"a {kind} is spanned by {PRIMITIVES[kind].points} chains, {count} given"):
            cga.Cooperative((chains * 2)[:count], kind)
    with refused(cga.UnknownNameError, "unknown chain 'Robot'; known: a Chain, from Robot.chain"):
        cga.Cooperative([a, a.robot], "line")
    for wrong in (None, 3, "line"):
        with refused(cga.CgaError, "chain"):
            cga.Cooperative(wrong, "line")
    with refused(cga.UnknownNameError, "unknown primitive"):
        cga.Cooperative([a, b], ["line"])
    floating = cga.load_robot(Path(__file__).parents[1] / "data" / "four_links.urdf", base="floating")
    with refused(cga.ChainError, "its base floats"):
        cga.Cooperative([floating.chain("a"), a], "line")
    with refused(cga.ChainError, "different frames"):
        cga.Cooperative([skew.chain("right_tip"), skew.chain("left_tip", root="trunk")], "line")
    with refused(cga.UnknownNameError, "unknown function of a cooperative system 'guard'; known: points, "):
        cga.Cooperative([a, b], "line").casadi("guard")


def test_inputs_that_are_refused(systems):
    system = systems["point_pair"]
    q = system.random(np.random.default_rng(4), 3)
    for wrong, error, text in (
        (np.zeros(5), cga.WrongSizeError, r"q: shape \(5,\) given, \(..., 6\) needed: a_x, a_y"),
        (0.0, cga.WrongSizeError, r"q: shape \(\) given"),
        ([1, 2, 3, 4, 5, np.nan], cga.NotFiniteError, "q holds NaN or infinity: nan at index"),
        ([1, 2, 3, 4, 5, -np.inf], cga.NotFiniteError, "q holds NaN or infinity: -inf"),
        (["a"] * 6, cga.WrongSizeError, "q: not an array of numbers"),
        (1j * np.ones(6), cga.WrongSizeError, "q: not an array of numbers"),
    ):
        for name in (*METHODS, "element"):
            with refused(error, text):
                getattr(system, name)(wrong)
    for wrong, error, text in (
        (np.zeros(5), cga.WrongSizeError, "v: shape"),
        (np.full(6, np.nan), cga.NotFiniteError, "v holds NaN"),
        (np.zeros((2, 6)), cga.WrongSizeError, r"q and v: batch dimensions \(3,\), \(2,\) do not broadcast"),
    ):
        for name in RATES:
            with refused(error, text):
                getattr(system, name)(q, wrong)


def test_targets_that_are_refused(systems):
    system = systems["point_pair"]
    q = system.random(np.random.default_rng(4), 3)
    sphere, pair = cga.Sphere.from_center_radius([0, 0, 0], 1), cga.PointPair.from_points(np.zeros((2, 3)), np.ones((2, 3)))
    for wrong, error, text in (
        (sphere, cga.UnknownNameError, "unknown target of a cooperative point_pair 'Sphere'; known: PointPair, Similarity, 12 components"),
        (np.zeros(12), cga.DegenerateError, "similarity: V ~V must be 1"),
        (np.ones(12), cga.DegenerateError, "similarity: V ~V must be 1"),
        (np.full(12, np.nan), cga.NotFiniteError, "similarity holds NaN"),
        (np.zeros(8), cga.WrongSizeError, r"similarity: shape \(8,\) given, \(..., 12\) needed"),
        (None, cga.CgaError, "similarity"),
        ("home", cga.WrongSizeError, "similarity: not an array of numbers"),
        (cga.Motor([1, 0, 0, 0, 0, 0, 0, 0]), cga.CgaError, "Motor"),
        (pair, cga.WrongSizeError, "do not broadcast"),
        (np.tile(np.eye(12)[0], (2, 1)), cga.WrongSizeError, r"q and target: batch dimensions \(3,\), \(2,\) do not broadcast"),
    ):
        for name in ("error", "error_jacobian"):
            with refused(error, text):
                getattr(system, name)(q, wrong)
