"""Reaching by cooperative systems, onto targets of their own kind: Pandas around a table, judged by Pinocchio and elementary geometry.

Also free points, for which q is the points; joints that arms share; fused kernels; arms with few joints.
"""

import numpy as np
import pytest
from cooperative_draws import batched, corners, drawn, inside
from cooperative_oracle import COUNTS, DIRECTED, Flanges, error
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements import PointPair
from cga_runtime.elements.similarities import similarity_of
from cga_runtime.experiments.cooperative_ik import pandas_around_a_table
from cga_runtime.solve.reaching import reach
from cga_runtime.solve.reaching_containment import wish
from cga_runtime.solve.reaching_cooperative_problem import CooperativeForm, parameters, program

KINDS = tuple(COUNTS)
DIMENSIONS = {"point": 3, "point_pair": 6, "line": 4, "circle": 6, "plane": 3, "sphere": 4}


@pytest.fixture(scope="module")
def around():
    """One Panda, two that are opposite each other, three of four, and all."""
    chains = pandas_around_a_table(4)
    order = {1: [0], 2: [0, 2], 3: [0, 1, 2], 4: [0, 1, 2, 3]}
    return {kind: cga.Cooperative([chains[k] for k in order[count]], kind) for kind, count in COUNTS.items()}


@pytest.fixture(scope="module")
def sliding():
    """Systems whose q is their end points."""
    return {kind: cga.Cooperative(gantries()[:count], kind) for kind, count in COUNTS.items()}


# ---- what is reached


@pytest.mark.parametrize("kind", KINDS)
def test_targets_that_can_be_reached(kind, around, rng):
    system, first = around[kind], 0
    flanges = Flanges([np.eye(4) if c.order.placement is None else np.array(c.order.placement) for c in system.chains])
    for target, _ in zip(drawn(system, rng), range(8), strict=False):
        found = reach(system, target)
        assert found.success and found.status.startswith("reached") and inside(system, found.q)
        x = flanges.points(found.q)
        measured = max(error(kind, x, batched(target), 0))
        assert measured < 1e-7 and found.residual < 1e-7
        assert corners(x) >= {1: 1.0, 2: 1e-3, 3: 0.01, 4: 0.01}[len(x)] - 1e-7
        first += found.starts == 1
    assert first >= 7


@pytest.mark.parametrize("kind", KINDS)
def test_the_residual_is_the_distance_from_the_target(kind, sliding, rng):
    system = sliding[kind]
    for target, _ in zip(drawn(system, rng), range(4), strict=False):
        moved = target.transformed(cga.Similarity.exp(1e-3 * rng.normal(size=7)))
        found = reach(system, target)
        assert found.success
        off = wish(system.about, moved, np.zeros(3)).departure(system.element(found.q), moved, system.points(found.q).mean(axis=0))
        length, angle = error(kind, system.points(found.q), batched(moved), 0)
        # the oracle joins centre and radius in one length
        assert max(length / 2**0.5, angle) <= off * (1 + 1e-6) and off <= max(length, angle) * (1 + 1e-6) and off > 1e-5


@pytest.mark.parametrize("kind", KINDS)
def test_there_are_as_many_independent_equations_as_the_task_has_dimensions(kind, around, rng):
    """At solutions their gradients allow the motions that leave the primitive where it is, and no others."""
    system = around[kind]
    for q in [q for q in system.random(rng, 50) if corners(system.points(q)) > 0.1][:5]:
        goal = wish(system.about, system.element(q), np.zeros(3))
        form = CooperativeForm.of(system, goal, 0.01, 0.0)
        assert form.equations == DIMENSIONS[kind] == len(system.controllable) and not form.elastic
        given = np.append(parameters(goal, q, 0.01, 0.0), (1.0, 1.0))
        values, slopes = program(form).solver.get_function("nlp_jac_g")(q, given)
        np.testing.assert_allclose(np.array(values).ravel()[: form.equations], 0.0, atol=1e-11)
        rows = np.array(slopes)[: form.equations]
        assert np.linalg.matrix_rank(rows, 1e-3) == form.equations
        np.testing.assert_allclose(rows @ system.nullspace(q), 0.0, atol=1e-9)


@pytest.mark.parametrize("kind", KINDS)
def test_the_solution_is_locally_nearest_to_the_start(kind, sliding, rng):
    """Where no limit and no margin is active, the step is square to all motions that leave the primitive where it is."""
    system, checked = sliding[kind], 0
    for target, _ in zip(drawn(system, rng), range(25), strict=False):
        q0 = system.random(rng)
        found = reach(system, target, q0, starts=1)
        free = np.minimum(found.q - system.lower, system.upper - found.q).min() > 1e-3 and corners(system.points(found.q)) > 0.011
        if found.success and free:
            np.testing.assert_allclose(system.nullspace(found.q) @ (found.q - q0), 0.0, atol=2e-5)
            checked += 1
            if checked == 3:
                break
    assert checked == 3


@pytest.mark.parametrize("kind", KINDS)
def test_a_similarity_means_its_primitive(kind, sliding, rng):
    system = sliding[kind]
    target = next(drawn(system, rng))
    about = np.array([0.0, 1.0, 0.0] if COUNTS[kind] == 2 else [0.0, 0.0, 1.0])
    turn = cga.Similarity.from_parts(np.zeros(3), cga.Rotor.exp(0.8 * np.array([about[2], -about[1], about[0]])), 1.0)
    versor = similarity_of(target) * turn  # turned about the direction of the unit primitive, which stays where it is
    q0 = next(q for q in system.random(rng, 100) if corners(system.points(q)) > 0.3)
    one, other = reach(system, target, q0), reach(system, cga.Similarity(versor.coefficients), q0)
    assert one.success and other.success
    np.testing.assert_allclose(one.q, other.q, atol=1e-7)


@pytest.mark.parametrize("kind", DIRECTED)
def test_orientation_counts(kind, sliding, rng):
    """From a position on the target the same with its direction turned round is elsewhere, and degenerate positions lie between."""
    system = sliding[kind]
    q0 = next(q for q in system.random(rng, 100) if corners(system.points(q)) > 0.3)
    element = system.element(q0)
    turned = type(element).from_points(*system.points(q0)[::-1])
    same, other = reach(system, element, q0), reach(system, turned, q0)
    assert same.success and np.abs(same.q - q0).max() < 1e-7
    assert other.success and max(error(kind, system.points(other.q), batched(turned), 0)) < 1e-7
    assert np.abs(other.q - q0).max() > 0.1


def test_spheres_have_no_orientation(sliding, rng):
    system = sliding["sphere"]
    q0 = next(q for q in system.random(rng, 100) if corners(system.points(q)) > 0.3)
    for order in ([0, 1, 2, 3], [1, 0, 2, 3]):
        found = reach(system, system.element(q0), system.points(q0)[order].ravel())
        assert found.success and np.abs(found.q - system.points(q0)[order].ravel()).max() < 1e-7


# ---- systems of other shapes


@pytest.mark.parametrize("kind", ["point_pair", "line"])
def test_arms_that_share_a_joint(kind, skew, rng):
    """One that leans, before joints that slide or turn without end."""
    system = cga.Cooperative([skew.chain("right_tip"), skew.chain("left_tip")], kind)
    assert system.n < sum(chain.n for chain in system.chains) and not np.isfinite(system.lower).all()
    for target, _ in zip(drawn(system, rng), range(6), strict=False):
        found = reach(system, target)
        assert found.success and inside(system, found.q)
        assert max(error(kind, system.points(found.q), batched(target), 0)) < 1e-7


def test_fused_kernels_lead_to_the_same(sliding, rng):
    system = sliding["line"]
    target, q0 = next(drawn(system, rng)), system.random(rng)
    one, other = reach(system, target, q0), reach(system.fuse(), target, q0)
    assert one.success and other.success
    np.testing.assert_allclose(one.q, other.q, atol=1e-9)


def test_arms_with_as_many_joints_as_equations(nao, rng):
    """Their equations are elastic: isolated solutions, or none."""
    system = cga.Cooperative([nao.chain(f"{side}Bicep", offset=(0.1, 0, 0)) for side in "RL"], "point_pair")
    assert system.n == 4
    for _ in range(5):
        target = system.element(system.random(rng))
        found = reach(system, target)
        assert found.success and max(error("point_pair", system.points(found.q), batched(target), 0)) < 1e-6
    goal = PointPair.from_points((1, 0, 0), (1, 1, 0))
    far = reach(system, goal, starts=2)
    assert not far.success and "not found in 2 starts" in far.status and "Solve_Succeeded" in far.status and inside(system, far.q)
    length, angle = error("point_pair", system.points(far.q), batched(goal), 0)
    assert max(length / 2**0.5, angle) <= far.residual <= max(length, angle)


def test_programs_are_kept_and_results_repeat(sliding, rng):
    system, again = sliding["circle"], cga.Cooperative(gantries()[:3], "circle")
    targets = [next(drawn(system, rng)) for _ in range(2)]
    first = reach(system, targets[0], seed=4)
    before = program.cache_info().misses
    for one in (system, again):
        for target in targets:
            assert reach(one, target, seed=4).success
    assert program.cache_info().misses <= before + (system.chains[0].unit is not again.chains[0].unit)
    np.testing.assert_array_equal(reach(system, targets[0], seed=4).q, first.q)
