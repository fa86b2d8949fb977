"""mu and the criterion behind it: rank of the global wrench system, determinants, velocities, mirror images (paper C, 5.2.2)."""

import json
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.schemes import conditioning
from cga_runtime.errors import SchemeError
from cga_runtime.loading import load_robot

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())
ALL = list(combinations(range(1, 11), 4))
MIRROR = np.array([1, -1, -1, -1, -1])
ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))


def exchanged(scheme):
    """The scheme with right and left exchanged: joint j is the mirror image of joint j + 5."""
    return tuple(sorted((j + 4) % 10 + 1 for j in scheme))


def passive(scheme):
    return [j for j in range(10) if j + 1 not in scheme]


def wrench_rank(q, scheme):
    """rank(W), W = W^c + W^a (eq. 21): per arm all wrenches reciprocal to its passive joints' twists."""
    twists = LOOP.twists(q) * np.repeat([1.0, 10.0], 3)[:, None]
    spans = []
    for arm in (range(5), range(5, 10)):
        _, values, vt = np.linalg.svd(twists[:, [j for j in passive(scheme) if j in arm]].T)
        spans.append(vt[int((values > 1e-9).sum()) :].T)
    return int((np.linalg.svd(np.concatenate(spans, axis=1), compute_uv=False) > 1e-9).sum())


def passive_rank(q, scheme):
    twists = LOOP.twists(q) * np.repeat([1.0, 10.0], 3)[:, None]
    return int((np.linalg.svd(twists[:, passive(scheme)], compute_uv=False) > 1e-9).sum())


def test_rank_of_the_wrench_system():
    """rank(W) = rank of the passive twists (the criterion of 5.2.2), general, planar and mirror poses, deficient ranks included."""
    q = LOOP.random(np.random.default_rng(21), 9)
    q[3:6, 5] = q[3:6, 0]
    q[6:, 5:] = MIRROR * q[6:, :5]
    seen = set()
    for at in q:
        for scheme in ALL:
            rank = wrench_rank(at, scheme)
            assert rank == passive_rank(at, scheme)
            seen.add(rank)
    assert seen == {4, 5, 6}


def test_rank_of_the_wrench_system_at_a_limb_singularity():
    """Where an arm's passive twists are dependent by themselves, W may hold the object (rank 6) while a self-motion of the arm stays free.

    At q4 = 0 axes 3 and 5 are one line: with both passive rank(W) is one more than the passive rank, which is what D and mu follow.
    """
    q = LOOP.random(np.random.default_rng(22))
    q[3] = 0.0
    free = 0
    for scheme in ALL:
        dependent = 3 not in scheme and 5 not in scheme
        assert wrench_rank(q, scheme) == passive_rank(q, scheme) + (1 if dependent else 0)
        free += wrench_rank(q, scheme) == 6 and dependent
    assert free > 0 and passive_rank(q, (1, 2, 3, 7)) == 6 and passive_rank(q, (1, 2, 6, 8)) == 5


def test_mu_vanishes_with_the_determinant():
    """mu = 0 exactly where D = 0: general, planar and mirror poses, limb and constraint singularities; nothing in between."""
    rng = np.random.default_rng(23)
    q = LOOP.random(rng, 12)
    star = ORACLE["singular"]["q2_star_right_V33"]
    q[2, 5], q[3, 5], q[4, 3], q[5, 1] = q[2, 0], q[3, 0], 0.0, star
    q[6, 1], q[6, 3] = star, 0.0
    q[7, 1], q[7, 6] = star, -star
    q[8, 3], q[8, 8] = 0.0, 0.0
    q[9, 5:], q[10, 5:] = MIRROR * q[9, :5], MIRROR * q[10, :5]
    mu = conditioning(LOOP, q, ALL)
    d = np.abs(np.stack([LOOP.determinant(q, scheme) for scheme in ALL], axis=-1))
    assert not ((mu > 1e-12) & (mu < 1e-6)).any() and not ((d > 1e-12) & (d < 1e-6)).any()
    assert np.array_equal(mu < 1e-9, d < 1e-9)
    zero = (mu < 1e-9).sum(axis=1)
    assert (zero[:2] == 71).all() and (zero[[2, 3, 9, 10]] == 91).all()
    assert zero[7] == 210  # where the loop gains mobility, four actuators never suffice
    assert (mu >= 0).all() and (mu <= 1).all()


def test_mu_bounds_the_velocities():
    """|q'| <= |q'_a| / mu for every motion that keeps the loop closed, and one motion attains it."""
    rng = np.random.default_rng(24)
    for q in LOOP.random(rng, 20):
        w, v = np.split(LOOP.twists(q), 2)
        closure = np.concatenate([w, v]) * np.where(np.arange(10) < 5, 1, -1)
        motions = np.linalg.svd(closure)[2][6:].T  # no length enters a null space
        for scheme in ((1, 3, 7, 8), (1, 2, 3, 7), (4, 5, 6, 8)):
            mu = LOOP.conditioning(q, scheme)
            actuated = motions[[j - 1 for j in scheme]]
            rates = motions @ rng.standard_normal((4, 50))
            ratio = np.linalg.norm(rates[[j - 1 for j in scheme]], axis=0) / np.linalg.norm(rates, axis=0)
            assert (ratio >= mu * (1 - 1e-12)).all()
            worst = np.linalg.svd(actuated)[2][-1]
            np.testing.assert_allclose(np.linalg.norm(actuated @ worst), mu, rtol=1e-9)


def test_mu_of_mirror_images():
    """The orbit: a scheme at a pose, and its mirror image at the mirrored pose with arms exchanged, have one mu."""
    q = LOOP.random(np.random.default_rng(25), 20)
    swapped = np.concatenate([MIRROR * q[:, 5:], MIRROR * q[:, :5]], axis=1)
    np.testing.assert_allclose(conditioning(LOOP, q, ALL), conditioning(LOOP, swapped, [exchanged(s) for s in ALL]), atol=1e-13)


def test_bad_schemes():
    for schemes in ([(1, 2, 3, 7), (1, 2, 3)], [(1, 2, 3, 12)], [(1, 2, 3, 3)], [(1.5, 2, 3, 4)]):
        with pytest.raises(SchemeError, match="4 (distinct )?joint numbers"):
            conditioning(LOOP, np.zeros(10), schemes)


def test_collinear_first_axes_may_trade_places():
    """s1 = s6 up to sign, so exchanging q1' and q6' maps the closed motions to themselves: mu does not see which of the two is driven."""
    q = LOOP.random(np.random.default_rng(7), 200)
    for driven_1, driven_6 in (((1, 3, 7, 8), (3, 6, 7, 8)), ((1, 3, 9, 10), (3, 6, 9, 10)), ((1, 2, 4, 5), (2, 4, 5, 6))):
        assert np.abs(LOOP.conditioning(q, driven_1) - LOOP.conditioning(q, driven_6)).max() < 1e-14
