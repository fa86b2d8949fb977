"""Charts of a cooperative similarity: where each fails, the default, keeping one from step to step, and targets on either side of the seam.

Four points moved by sliding joints make any direction: q is the points. The reference direction is e2 of pairs and lines, e3 of circles and
planes; in chart +1 the rotor fails opposite to it, in chart -1 along it (similarity.md, section 5).
"""

import numpy as np
import pytest
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements.charts import KEPT, RECOMMENDED, SEAM
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

ROUNDOFF = 1e-13
TURNED = ("point_pair", "line", "circle", "plane")
CORNERS, ALONG = np.array([[0.9, 0.1, 0.0], [-0.4, 0.8, 0.0], [-0.3, -0.7, 0.0]]), np.array([[0.0, 0.0, -0.7], [0.0, 0.0, 0.6]])
"""Three points with their right-hand normal along e3, two points one above the other."""


@pytest.fixture(scope="module")
def chains():
    return gantries()


@pytest.fixture(scope="module", params=TURNED)
def system(request, chains):
    return cga.Cooperative(chains[: PRIMITIVES[request.param].points], request.param)


def facing(system, n, shift=(0.3, -0.2, 0.5)):
    """q (..., 3 k) whose primitive has the unit direction n (..., 3)."""
    n = np.asarray(n, dtype=float)
    u = np.cross(n, np.eye(3)[np.abs(n).argmin(axis=-1)])
    u = u / np.linalg.norm(u, axis=-1, keepdims=True)
    frame = np.stack([u, np.cross(n, u), n], axis=-2)
    points = (CORNERS if len(system.chains) == 3 else ALONG) @ frame + np.asarray(shift)
    return points.reshape(*n.shape[:-1], -1)


def directions(system, angles, azimuth=0.7):
    """Unit vectors at angles (...) from the reference direction, (..., 3)."""
    a = system.about.reference
    b = np.array([1.0, 0.0, 0.0])
    side = np.cos(azimuth) * b + np.sin(azimuth) * np.cross(a, b)
    return np.cos(angles)[..., None] * a + np.sin(angles)[..., None] * side


def direction_of(system, q):
    element = system.element(q)
    return element.normal if hasattr(element, "normal") else element.direction


ANGLES = np.linspace(0.01, np.pi - 0.01, 41)


def test_the_points_face_where_they_should(system):
    n = directions(system, ANGLES)
    assert np.abs(direction_of(system, facing(system, n)) - n).max() < 1e-14


@pytest.mark.parametrize("chart", [1, -1])
def test_each_chart_carries_the_reference_to_the_direction(system, chart):
    """To rounding over the angle from where the chart fails."""
    n = directions(system, ANGLES)
    v = cga.Similarity(system.similarity(facing(system, n), chart))
    off = np.abs(v.rotation().matrix() @ system.about.reference - n).max(axis=-1)
    left = np.pi - ANGLES if chart == 1 else ANGLES
    assert (off < 1e-15 + 5e-16 / left).all()


def test_the_default_is_the_shortest_arc_up_to_the_seam(system):
    n = directions(system, ANGLES)
    q = facing(system, n)
    charts = np.where(n @ system.about.reference < SEAM, -1.0, 1.0)
    assert set(charts) == {1.0, -1.0}
    for name in ("similarity", "log", "geometric_jacobian", "bivector_jacobian"):
        np.testing.assert_array_equal(getattr(system, name)(q), getattr(system, name)(q, charts))
        for sense in (1.0, -1.0):
            rows = charts == sense
            np.testing.assert_array_equal(getattr(system, name)(q)[rows], getattr(system, name)(q[rows], sense))


def test_the_recommended_chart_changes_earlier(system):
    n = directions(system, ANGLES)
    np.testing.assert_array_equal(system.chart(facing(system, n)), np.where(n @ system.about.reference < RECOMMENDED, -1, 1))


def test_a_chart_is_kept_until_its_own_pole_is_near(system):
    """From where it is safe to 26 degrees from the pole, there and back: it changes once each way, and later on the way back."""
    q = facing(system, directions(system, ANGLES))
    chart, there, back = np.asarray(1), [], []
    for x in q:
        chart = system.chart(x, chart)
        there.append(int(chart))
    for x in q[::-1]:
        chart = system.chart(x, chart)
        back.append(int(chart))
    limit = np.arccos(KEPT)
    np.testing.assert_array_equal(there, np.where(ANGLES < limit, 1, -1))
    np.testing.assert_array_equal(back[::-1], np.where(ANGLES < np.pi - limit, 1, -1))
    np.testing.assert_array_equal(system.chart(q, np.ones(len(q))), there)
    np.testing.assert_array_equal(system.chart(q[:, None], [1, -1]), np.stack([there, back[::-1]], -1))


@pytest.mark.parametrize("sense", [1, -1])
def test_a_chart_has_no_rotor_at_its_pole(system, sense):
    pole = facing(system, -sense * system.about.reference)
    for name in ("similarity", "log", "geometric_jacobian", "horizontal_jacobian", "space_jacobian"):
        assert np.isfinite(getattr(system, name)(pole)).all()
        assert np.isfinite(getattr(system, name)(pole, -sense)).all()
        with pytest.raises(cga.DegenerateError, match="chart .* at its pole|opposite to where chart"):
            getattr(system, name)(pole, sense)
    assert system.chart(pole) == -sense
    assert system.chart(pole, sense) == -sense


def test_the_pole_turns_by_half_a_turn_about_e1(system):
    v = cga.Similarity(system.similarity(facing(system, -system.about.reference)))
    assert np.abs(v.rotation().matrix() - np.diag([1.0, -1.0, -1.0])).max() < 1e-15


def test_what_does_not_depend_on_the_chart(system, rng):
    """Horizontal Jacobians differ by a turn about the direction; their nullspace and manipulability are the same."""
    q = system.random(rng, 20)
    first, second = (system.horizontal_jacobian(q, chart) for chart in (1, -1))
    assert np.abs(first - second).max() > 0.1
    one, other = (cga.Similarity(system.similarity(q, chart)) for chart in (1, -1))
    for k in range(20):
        turn = (~cga.Similarity(other.coefficients[k])) * cga.Similarity(one.coefficients[k])
        for column in range(system.n):
            moved = turn * cga.Multivector(first[k, :, column], "e12 e13 e23 e0i e1i e2i e3i".split()) * ~turn
            found = [moved[name] for name in ("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i")]
            assert np.abs(found - second[k, :, column]).max() < ROUNDOFF * max(1, np.abs(first[k]).max())
    rows = system.about.rows
    values = [np.linalg.svd(j[:, rows], compute_uv=False) for j in (first, second)]
    assert np.abs(values[0] - values[1]).max() < ROUNDOFF * values[0].max()


# ---- targets


@pytest.mark.parametrize("angle", [0.4, 2.0, np.pi - 0.2, np.pi - 0.05, np.pi - 1e-6, np.pi])
def test_the_error_is_zero_at_the_goal(system, angle):
    """Whatever the form of the target: the primitive, its similarity as the system gives it, its numbers."""
    q = facing(system, directions(system, np.array(angle)))
    for target in (system.element(q), system.similarity(q), cga.Similarity(system.similarity(q))):
        assert np.abs(system.error(q, target)).max() < 1e-14
        jacobian = system.error_jacobian(q, target)
        assert np.abs(jacobian + system.geometric_jacobian(q)).max() < 1e-13 * max(1, np.abs(jacobian).max())
    found = np.array(system.casadi("error")(q, system.similarity(q)))
    assert np.abs(found).max() < 1e-14


def test_numbers_and_casadi_take_the_same_chart_for_a_target(system):
    """On both sides of the seam, of q and of the goal."""
    near, far, goal = (facing(system, directions(system, np.array(x))) for x in (2.6, np.pi - 0.03, 1.1))
    for q in (near, far):
        for target in (system.similarity(goal), system.similarity(far)):
            assert np.abs(np.array(system.casadi("error")(q, target)).ravel() - system.error(q, target)).max() < ROUNDOFF


def test_a_goal_straight_behind_is_named(system):
    """No chart has a rotor for both; either a system or a goal alone may face any way."""
    a = system.about.reference
    ahead, aside, behind = facing(system, a), facing(system, directions(system, np.array(1.0))), facing(system, -a)
    for q, goal in ((ahead, behind), (behind, ahead)):
        with pytest.raises(cga.DegenerateError, match="chart .*pole|opposite"):
            system.error(q, system.element(goal))
    for q, goal in ((behind, behind), (aside, behind), (ahead, ahead), (aside, ahead)):
        for target in (system.element(goal), system.similarity(goal)):
            assert np.isfinite(system.error(q, target)).all() and np.isfinite(system.error_jacobian(q, target)).all()


# ---- refusals


def test_charts_are_checked(system, rng):
    q = system.random(rng, 3)
    for chart, error, text in (
        (0, cga.UnknownNameError, "unknown chart 0.0; known: 1, -1"),
        (2, cga.UnknownNameError, "unknown chart 2.0"),
        ([1, 0.5, -1], cga.UnknownNameError, "unknown chart 0.5"),
        (np.nan, cga.NotFiniteError, "chart holds NaN or infinity"),
        ("split", cga.WrongSizeError, "chart: not an array of numbers"),
    ):
        for name in ("similarity", "horizontal_jacobian", "log"):
            with pytest.raises(error, match=text):
                getattr(system, name)(q, chart)
        with pytest.raises(error, match=text):
            system.chart(q, chart)
        with pytest.raises(error, match=text):
            system.casadi("similarity", chart)
        with pytest.raises(error, match=text):
            system.error(q, system.similarity(q), chart)
    for wrong in (lambda: system.similarity(q, [1, -1]), lambda: system.chart(q, [1, -1]), lambda: system.casadi("log", [1, -1])):
        with pytest.raises(cga.WrongSizeError, match="chart"):
            wrong()
