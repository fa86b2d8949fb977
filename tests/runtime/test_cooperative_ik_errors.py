"""The errors that cooperative inverse kinematics follows and is judged by, on free points: q is the points, wherever they are."""

import numpy as np
import pytest
from cooperative_oracle import COUNTS, DIRECTED, ROUND, error, free_points, row, standing

import cga_runtime as cga
from cga_runtime.elements.charts import direction_of
from cga_runtime.solve.cooperative_errors import LEVER, NOWHERE, Errors
from cga_runtime.solve.cooperative_targets import as_element, cooperative_goal

KINDS = tuple(COUNTS)
EQUAL = (1.0, 1.0)
FORMS = ("similarity", "incidence", "logarithm")


@pytest.fixture(scope="module")
def gantries():
    return free_points()


@pytest.fixture(params=KINDS)
def system(request, gantries):
    return cga.Cooperative(gantries[: COUNTS[request.param]], request.param)


def slope(function, q, step=1e-6):
    """Central differences, (m, e, n)."""
    shifts = step * np.eye(q.shape[-1])
    return np.stack([(function(q + s) - function(q - s)) / (2 * step) for s in shifts], axis=-1)


def test_the_error_is_that_of_elementary_geometry(system, rng) -> None:
    q, target = system.random(rng, 30), system.element(system.random(rng, 30))
    rows = np.arange(30)
    for weights in (EQUAL, (2.0, 3.0), (1.0, 0.0), (0.0, 1.0)):
        e, _ = Errors(system, target, weights).similarity(rows, q)
        for k in range(30):
            length, angle = error(system.kind, q[k].reshape(-1, 3), target, k)
            assert np.linalg.norm(e[k]) == pytest.approx(np.hypot(weights[0] * length, weights[1] * angle), rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("form", ["similarity", "logarithm"])
def test_jacobians(system, rng, form) -> None:
    """Against central differences, which are good to 1e-9 of the second derivatives' size; points that are nearly flat have large ones."""
    q, target, rows = system.random(rng, 20), system.element(system.random(rng, 20)), np.arange(20)
    follow = getattr(Errors(system, target, (2.0, 3.0)), form)
    _, jacobian = follow(rows, q)
    found = slope(lambda q: follow(rows, q)[0], q)
    scale = np.maximum(np.abs(jacobian).max(axis=(1, 2)), 1.0) ** 2
    assert (np.abs(jacobian - found).max(axis=(1, 2)) <= 1e-7 * scale).all()


def test_the_jacobian_of_the_incidence(system, rng) -> None:
    """Scale and lever are left out: with both divided out it is that of the distances and of the direction."""
    q, target, rows = system.random(rng, 20), system.element(system.random(rng, 20)), np.arange(20)
    errors, count = (
        Errors(system, target, EQUAL),
        {"line": 6, "circle": 6, "plane": 3, "sphere": 4}.get(system.kind, 3 * len(system.chains)),
    )

    def parts(q):
        x = q.reshape(20, -1, 3)
        distances, _ = errors._distances(rows, x)
        e, _ = errors.similarity(rows, q)
        return distances, e[:, -3:]

    e, jacobian = errors.incidence(rows, q)
    distances, turn = parts(q)
    scale = np.linalg.norm(e[:, :count], axis=1) / np.linalg.norm(distances, axis=1)
    assert (scale > 0.0).all()
    np.testing.assert_allclose(e[:, :count], scale[:, None] * distances, rtol=0, atol=1e-12 * np.abs(e).max())
    found = slope(lambda q: parts(q)[0], q)
    np.testing.assert_allclose(jacobian[:, :count] / scale[:, None, None], found, rtol=0, atol=1e-7)
    if system.kind in ("line", "circle", "plane"):
        x = q.reshape(20, -1, 3)
        lever = LEVER * np.sqrt(((x - x.mean(axis=1, keepdims=True)) ** 2).sum(axis=2).mean(axis=1))
        np.testing.assert_allclose(e[:, count:], (scale * lever)[:, None] * turn, rtol=0, atol=1e-12 * np.abs(e).max())
        turning = jacobian[:, count:] / (scale * lever)[:, None, None]
        bound = 1e-7 * np.maximum(1.0, np.abs(turning).max(axis=(1, 2))) ** 2
        assert (np.abs(turning - slope(lambda q: parts(q)[1], q)).max(axis=(1, 2)) <= bound).all()
    else:
        assert e.shape[1] == count


def test_all_forms_vanish_together_and_have_one_length(system, rng) -> None:
    q, rows = system.random(rng, 25), np.arange(25)
    target = system.element(q)
    errors = Errors(system, target, (2.0, 3.0))
    for form in FORMS:
        e, _ = getattr(errors, form)(rows, q)
        assert (np.linalg.norm(e, axis=1) <= 1e-12 * np.maximum(1.0, errors.radius**2)).all()
    away = q + 0.3 * rng.normal(size=q.shape)
    e, _ = errors.similarity(rows, away)
    for follow in (errors.incidence, cooperative_goal(system, target, (2.0, 3.0)).evaluate):
        np.testing.assert_allclose(np.linalg.norm(follow(rows, away)[0], axis=1), np.linalg.norm(e, axis=1), rtol=1e-12)


def test_points_along_the_primitive_change_nothing(gantries, rng) -> None:
    """Other points of the same sphere are as good, in any order; other points of a line in the same order."""
    sphere = cga.Cooperative(gantries, "sphere")
    x = rng.normal(size=(4, 3))
    q = 0.2 + 0.8 * x / np.linalg.norm(x, axis=1)[:, None]
    errors = Errors(sphere, cga.Sphere([0.2, 0.2, 0.2], 0.8), EQUAL)
    for order in ([0, 1, 2, 3], [1, 0, 2, 3]):
        for form in FORMS:
            assert np.abs(getattr(errors, form)(np.zeros(1, dtype=int), q[order].reshape(1, -1))[0]).max() < 1e-13
    line = cga.Cooperative(gantries[:2], "line")
    errors = Errors(line, cga.Line([0.0, 0.0, 0.5], [1.0, 0.0, 0.0]), EQUAL)
    there, back = np.array([[0.3, 0.0, 0.5, 0.7, 0.0, 0.5]]), np.array([[0.7, 0.0, 0.5, 0.3, 0.0, 0.5]])
    assert np.abs(errors.similarity(np.zeros(1, dtype=int), there)[0]).max() < 1e-15
    for form in ("similarity", "incidence"):
        assert np.linalg.norm(getattr(errors, form)(np.zeros(1, dtype=int), back)[0]) == pytest.approx(np.pi, abs=2e-9)  # OPPOSITE is 1e-9


def test_opposite_directions(gantries, rng) -> None:
    """Turned right round, the angle is pi, and the derivative leads away from there."""
    for kind in ("line", "circle", "plane"):
        system = cga.Cooperative(gantries[: COUNTS[kind]], kind)
        q = system.random(rng, 20)
        x = q.reshape(20, -1, 3)[:, ::-1]
        target = system.about.through(x)
        e, jacobian = Errors(system, target, (0.0, 1.0)).similarity(np.arange(20), q)
        np.testing.assert_allclose(np.linalg.norm(e, axis=1), np.pi, rtol=1e-8)
        assert np.isfinite(jacobian).all()
        step = -1e-4 * np.einsum("mki,mk->mi", jacobian, e)
        step *= 1e-3 / np.linalg.norm(step, axis=1, keepdims=True)
        after, _ = Errors(system, target, (0.0, 1.0)).similarity(np.arange(20), q + step)
        assert (np.linalg.norm(after, axis=1) < np.pi - 1e-6).all()


DEGENERATE = {
    "point_pair": [[[0.1, 0.2, 0.3]] * 2],
    "line": [[[0.1, 0.2, 0.3]] * 2],
    "circle": [[[0.0, 0, 0], [1, 1, 1], [0.5, 0.5, 0.5]], [[0.0, 0, 0], [1, 0, 0], [1, 0, 0]], [[0.3, 0, 0]] * 3],
    "plane": [[[0.0, 0, 0], [1, 1, 1], [0.5, 0.5, 0.5]], [[0.0, 0, 0], [1, 0, 0], [1, 0, 0]], [[0.3, 0, 0]] * 3],
    "sphere": [[[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0.0, 0, 0], [0, 0, 0], [0, 1, 0], [1, 1, 1]], [[0.3, 0, 0]] * 4],
}


@pytest.mark.parametrize("kind", DEGENERATE)
def test_degenerate_points_raise_nothing(gantries, rng, kind) -> None:
    """Their error is beyond any other; what the search follows leads away from there."""
    system = cga.Cooperative(gantries[: COUNTS[kind]], kind)
    q = np.array(DEGENERATE[kind], dtype=float).reshape(len(DEGENERATE[kind]), -1)
    errors, rows = Errors(system, system.element(system.random(rng, len(q))), EQUAL), np.arange(len(q))
    for form in FORMS:
        e, jacobian = getattr(errors, form)(rows, q)
        np.testing.assert_allclose(np.linalg.norm(e, axis=1), NOWHERE, rtol=1e-12)
        assert np.isfinite(jacobian).all()
    found = cga.inverse_kinematics(system, errors.wanted, q, restarts=0, max_iterations=0)
    assert (found.status == "degenerate").all() and np.isposinf(found.residual).all() and not found.success.any()
    assert cga.inverse_kinematics(system, errors.wanted, q).success.all()


@pytest.mark.parametrize("s", [1.5, 3.0, 10.0])
def test_a_newton_step_towards_a_larger_sphere(gantries, s) -> None:
    """What makes the four-arm sphere different (see cooperative_targets): heights of four points, from a sphere of radius r to one of s r
    with the same pole. The curvature k goes to k (2 - s), to k (1 - log s) with all points moved by r (s log s - s + 1), or to k/s."""
    sphere, r = cga.Cooperative(gantries, "sphere"), 1000.0
    flat = np.array([[1.0, 0.0], [-0.5, 0.8], [-0.5, -0.9], [0.1, 0.0]])
    square = (flat * flat).sum(axis=1)
    q = np.column_stack([flat, -square / (r + np.sqrt(r * r - square))]).ravel()
    errors, heights = Errors(sphere, cga.Sphere([0.0, 0.0, -s * r], s * r), EQUAL), [2, 5, 8, 11]
    expected = {"similarity": (2 - s, 0.0), "logarithm": (1 - np.log(s), r * (s * np.log(s) - s + 1)), "incidence": (1 / s, 0.0)}
    for form, (curvature, shift) in expected.items():
        e, jacobian = getattr(errors, form)(np.zeros(1, dtype=int), q[None])
        after = q[heights] - np.linalg.lstsq(jacobian[0][:, heights], e[0], rcond=None)[0]
        paraboloid = np.column_stack([np.ones(4), flat, -0.5 * square])
        moved, _, _, bent = np.linalg.solve(paraboloid, after)
        assert bent * r == pytest.approx(curvature, rel=1e-5)
        assert moved == pytest.approx(shift, rel=1e-6, abs=1e-8 * r)


def test_targets_as_elements_and_as_similarities(system, rng) -> None:
    """V X_u ~V, whatever the turn of V about the direction."""
    q = system.random(rng, 10)
    element, versor = system.element(q), cga.Similarity(system.similarity(q))
    for target in (versor, versor.coefficients, versor.coefficients.tolist()):
        made = as_element(system, target)
        np.testing.assert_allclose(made.center, element.center, rtol=0, atol=1e-11 * np.maximum(1.0, np.abs(element.center).max()))
        if system.kind in ROUND:
            np.testing.assert_allclose(made.radius, element.radius, rtol=1e-11)
        if system.kind in DIRECTED:
            np.testing.assert_allclose(direction_of(made), direction_of(element), rtol=0, atol=1e-13)
    assert as_element(system, element) is element
    for k in range(10):
        center, n, _ = standing(system.kind, q[k].reshape(-1, 3))
        if system.kind in (*ROUND, "point"):
            np.testing.assert_allclose(row(element, k).center, center, rtol=1e-9, atol=1e-9)
        if n is not None:
            np.testing.assert_allclose(direction_of(row(element, k)), n, rtol=0, atol=1e-9)
