"""The walk on the manifold of one fixed grasp: closure, limits, statistics, and which determinants change sign on it."""

import json
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.errors import NotFiniteError, WrongSizeError
from cga_runtime.loading import load_robot
from cga_runtime.spaces.loop_walk import NEWTON_TOLERANCE, close_loop, walk

SAMPLING = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())["sampling"]
ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))
STARTS = {name: np.array(SAMPLING[name]["q0"]) for name in ("symmetric grasp", "random grasp")}


def grasp_pose(q):
    """The left hand's pose in the right hand's frame, (..., 4, 4)."""
    return np.linalg.inv(LOOP.right.pose(q[..., :5])) @ LOOP.left.pose(q[..., 5:])


@pytest.mark.parametrize("name", STARTS)
def test_walk(name):
    """Every configuration holds the grasp to 1e-11 and lies inside the limits; counts and steps are what they are said to be."""
    found = walk(LOOP, STARTS[name], 400, np.random.default_rng(40))
    assert np.abs(LOOP.closure_error(found.q, found.grasp)).max() < NEWTON_TOLERANCE
    np.testing.assert_allclose(grasp_pose(found.q), np.broadcast_to(grasp_pose(STARTS[name]), (len(found.q), 4, 4)), rtol=0, atol=1e-11)
    assert (found.q >= LOOP.lower).all() and (found.q <= LOOP.upper).all()
    assert (found.tried, len(found.q)) == (400, 401 - found.rejected)
    np.testing.assert_array_equal(found.q[0], STARTS[name])
    np.testing.assert_array_equal(found.grasp, LOOP.grasp(STARTS[name]))
    lengths = np.linalg.norm(np.diff(found.q, axis=0), axis=1)
    assert np.median(lengths) == pytest.approx(0.2, rel=0.1) and lengths.max() < 0.5
    assert np.ptp(found.q, axis=0).min() > 0.3  # it moves every joint
    again = walk(LOOP, STARTS[name], 400, np.random.default_rng(40))
    np.testing.assert_array_equal(found.q, again.q)


def test_statistics_of_the_walk():
    """The reference accepted 85 % (symmetric) and 89 % (random), with 2.3 Newton steps to 1e-11; here four walks, closed to 1e-12."""
    for start in STARTS.values():
        walks = [walk(LOOP, start, 400, np.random.default_rng(seed)) for seed in range(4)]
        accepted = [1 - found.rejected / found.tried for found in walks]
        assert 0.8 < np.mean(accepted) < 0.99 and min(accepted) > 0.7
        assert 2.0 < np.mean([found.newton_mean for found in walks]) < 3.0


def test_the_tangent_space_has_dimension_four():
    """Short steps from one point spread in four directions; what leaves the tangent space is of second order."""
    q = STARTS["random grasp"]
    steps = np.concatenate([walk(LOOP, q, 1, np.random.default_rng(seed), step=1e-3).q[1:] for seed in range(40)]) - q
    values = np.linalg.svd(steps, compute_uv=False)
    assert values[3] > 1e-3 and values[4] < 2e-5
    _, _, vt = np.linalg.svd(LOOP.kernel("closure_jacobian")(q, LOOP.grasp(q)))
    assert np.abs(steps @ vt[:6].T).max() < 1e-5


def test_signs_on_the_symmetric_manifold():
    """1600 steps: D of 1378, 1238 and 139a keep their sign and stay away from zero (evidence, no proof); that of 1237 changes it often."""
    found = walk(LOOP, STARTS["symmetric grasp"], 1600, np.random.default_rng(41), step=0.2)
    assert len(found.q) > 1200
    for actuated in ((1, 3, 7, 8), (1, 2, 3, 8), (1, 3, 9, 10)):
        d = LOOP.determinant(found.q, actuated)
        assert len(set(np.sign(d))) == 1 and np.abs(d).min() > 0.3
    d = LOOP.determinant(found.q[1:], (1, 2, 3, 7))
    assert (np.sign(d[1:]) != np.sign(d[:-1])).sum() >= 10
    assert d.min() < -1 and d.max() > 0.5
    assert abs(LOOP.determinant(found.q[0], (1, 2, 3, 7))) < 1e-14  # the start is its own mirror image


def test_close_loop():
    """From 0.2 rad off: closed, near, and by a least-squares step: the correction has next to no part along the manifold."""
    rng = np.random.default_rng(42)
    for q in STARTS.values():
        grasp = LOOP.grasp(q)
        np.testing.assert_array_equal(close_loop(LOOP, q, grasp)[0], q)
        assert close_loop(LOOP, q, grasp)[1] == 0
        for _ in range(20):
            start = q + rng.uniform(-0.1, 0.1, 10)
            closed, steps = close_loop(LOOP, start, grasp)
            assert np.abs(LOOP.closure_error(closed, grasp)).max() < NEWTON_TOLERANCE and 1 <= steps <= 10
            correction = closed - start
            _, _, vt = np.linalg.svd(LOOP.kernel("closure_jacobian")(closed, grasp))
            assert np.linalg.norm(correction) < 0.7
            assert np.linalg.norm(vt[6:] @ correction) < 0.3 * np.linalg.norm(correction)
    assert close_loop(LOOP, STARTS["random grasp"] + 0.1, LOOP.grasp(STARTS["random grasp"]), steps=0) is None


def test_a_grasp_out_of_reach():
    """Hands two metres apart: no configuration closes it, and the search says so."""
    far = np.array([1, 0, 0, 0, 0, -1.0, 0, 0])  # the translator by 2 m along y: 1 - e2i
    assert close_loop(LOOP, STARTS["symmetric grasp"], far) is None


def test_bad_input():
    for call in (lambda q: walk(LOOP, q, 3, np.random.default_rng(0)), lambda q: close_loop(LOOP, q, np.zeros(8))):
        with pytest.raises(WrongSizeError, match=r"one configuration of shape \(10,\) needed, \(2, 10\) given"):
            call(np.zeros((2, 10)))
        with pytest.raises(WrongSizeError, match=r"\(9,\) given"):
            call(np.zeros(9))
        with pytest.raises(NotFiniteError):
            call(np.full(10, np.inf))
