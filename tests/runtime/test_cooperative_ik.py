"""Inverse kinematics of cooperative systems: Pandas around a table, judged by Pinocchio and elementary geometry, and a humanoid's arms."""

import numpy as np
import pytest
from cooperative_oracle import COUNTS, Flanges, error

import cga_runtime as cga
from cga_runtime.experiments.cooperative_ik import difference, forms, pandas_around_a_table
from cga_runtime.solve import inverse_kinematics as module
from cga_runtime.solve.inverse_kinematics import inverse_kinematics

KINDS = tuple(COUNTS)


@pytest.fixture(scope="module")
def around():
    """Four Pandas; the first, two that are opposite each other, three of four, or all."""
    chains = pandas_around_a_table(4)
    order = {1: [0], 2: [0, 2], 3: [0, 1, 2], 4: [0, 1, 2, 3]}
    return {kind: cga.Cooperative([chains[k] for k in order[count]], kind) for kind, count in COUNTS.items()}


@pytest.fixture(params=KINDS)
def system(request, around):
    return around[request.param]


@pytest.fixture(scope="module")
def g1():
    """Both arms of a humanoid as far as the upper arm, with the waist that they share."""
    robot = cga.load_robot("g1")
    arms = [robot.chain(f"{side}_shoulder_yaw_link") for side in ("left", "right")]
    return {"point_pair": cga.Cooperative(arms, "point_pair"), "line": cga.Cooperative(arms, "line")}


def inside(system, q):
    return bool(((system.lower <= q) & (q <= system.upper)).all())


def errors_of(kind, points, target):
    """(length, angle) of each."""
    return np.array([error(kind, x, target, k) for k, x in enumerate(points)])


# ---- what is reached


def test_targets_that_can_be_reached(system, rng) -> None:
    target = system.element(system.random(rng, 100))
    found = inverse_kinematics(system, target)
    assert found.success.all() and (found.status == "reached").all() and (found.residual <= 1e-6).all() and inside(system, found.q)
    flanges = Flanges([np.eye(4) if chain.order.placement is None else np.array(chain.order.placement) for chain in system.chains])
    measured = errors_of(system.kind, [flanges.points(q) for q in found.q], target)
    assert np.hypot(*measured.T).max() <= 1.01e-6
    assert (found.starts == 1).mean() > {"point": 0.8, "point_pair": 0.65}.get(system.kind, 0.85)


def test_joints_that_arms_share(g1, rng) -> None:
    for kind, system in g1.items():
        assert system.n == 9 and system.joint_names[0] == "waist_yaw_joint"
        target = system.element(system.random(rng, 100))
        found = inverse_kinematics(system, target)
        assert found.success.all() and inside(system, found.q)
        assert np.hypot(*errors_of(kind, system.points(found.q), target).T).max() <= 1.01e-6


def test_large_spheres(around) -> None:
    """Where the hands are nearly coplanar the search is as good as elsewhere, and the other forms are not: see cooperative_targets."""
    one, *others = forms(around["sphere"], 120, 7)
    large = one.radius > 5.0
    assert large.sum() > 8 and one.name == "incidence"
    assert one.success.mean() > 0.97 and one.success[large].mean() > 0.93 and one.iterations.mean() < 6.0
    assert [form.name for form in others] == ["similarity", "logarithm", "paper"]
    for form in others:
        assert form.success[large].mean() < 0.65 and form.iterations.mean() > 1.5 * one.iterations.mean()


def test_arms_that_all_stand_alike(around, rng) -> None:
    """Four hands in one plane and on one circle make no sphere, but a start."""
    system = around["sphere"]
    q0 = np.tile([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785], 4)
    assert system.degeneracy(q0) < 1e-12
    found = inverse_kinematics(system, system.element(system.random(rng, 60)), q0)
    assert found.success.all() and (found.starts == 1).mean() > 0.9


def test_similarities_as_targets(system, rng) -> None:
    """Turned about the primitive's direction too, which is not the system's to follow."""
    versor = cga.Similarity(system.similarity(system.random(rng, 20)))
    spin = {"point_pair": [0, 0.7, 0, 0], "line": [0, 0.7, 0, 0], "circle": [0.7, 0, 0, 0], "plane": [0.7, 0, 0, 0]}
    turned = versor * cga.Similarity.exp([*spin.get(system.kind, [0.5, 0.7, -0.3, 0])[:3], 0, 0, 0, 0])
    element = system.element(inverse_kinematics(system, versor).q)
    for target in (turned, turned.coefficients):
        found = inverse_kinematics(system, target)
        assert found.success.all()
        assert difference(system.element(found.q), element, np.arange(20)).max() < 1e-5


def test_the_paper_s_method(around, rng) -> None:
    """Without limits, from one start: (43)-(47) reach nearly all point pairs and lines."""
    for kind in ("point_pair", "line"):
        system = around[kind]
        target = system.element(system.random(rng, 25))
        found = inverse_kinematics(system, target, method="gauss_newton")
        assert found.success.mean() > 0.9 and (found.starts == 1).all() and not inside(system, found.q)
        measured = np.hypot(*errors_of(kind, system.points(found.q), target).T)
        assert ((measured <= 1.01e-6) == found.success).all()
        assert set(found.status.tolist()) <= {"reached", "stalled", "iteration_limit"}


# ---- options


def test_shapes(around, rng) -> None:
    system = around["line"]
    for shape in ((), (2, 3), (3, 0)):
        found = inverse_kinematics(system, system.element(system.random(rng, shape)))
        assert found.q.shape == (*shape, 14) and found.success.all()
        for field in (found.success, found.residual, found.iterations, found.starts, found.status):
            assert field.shape == shape
    versors = system.similarity(system.random(rng, (2, 3)))
    assert inverse_kinematics(system, versors, system.random(rng, 3)).q.shape == (2, 3, 14)


def test_many_targets_are_solved_in_blocks(around, rng, monkeypatch) -> None:
    monkeypatch.setattr(module, "COOPERATIVE_BLOCK", 7)
    system, q = around["plane"], around["plane"].random(rng, 20)
    found = inverse_kinematics(system, system.element(q), q)
    assert found.success.all() and (found.iterations == 0).all() and (found.q == q).all()


def test_equal_calls_give_equal_results(around, rng) -> None:
    system = around["circle"]
    target = system.element(system.random(rng, 20))
    one, other = inverse_kinematics(system, target), inverse_kinematics(system, target, rng=np.random.default_rng(0))
    assert (one.q == other.q).all() and not (one.q == inverse_kinematics(system, target, rng=np.random.default_rng(1)).q).all()


def test_the_first_start_is_kept_near(around, rng) -> None:
    system = around["sphere"]
    q = system.random(rng, 40)
    near = np.clip(q + 0.01 * rng.normal(size=q.shape), system.lower, system.upper)
    found = inverse_kinematics(system, system.element(q), near)
    assert found.success.all() and (found.starts == 1).mean() > 0.95 and np.median(np.abs(found.q - near).max(axis=1)) < 0.05


def test_weights(around, rng) -> None:
    """A weight of zero leaves direction, or place and size, free."""
    system = around["circle"]
    one, other = (system.element(system.random(rng, 30)) for _ in range(2))
    mixed = cga.Circle(one.center, other.normal, one.radius)
    place = inverse_kinematics(system, mixed, weights=(1.0, 0.0))
    made = system.element(place.q)
    assert place.success.all() and max(np.abs(made.center - one.center).max(), np.abs(made.radius - one.radius).max()) <= 1e-6
    assert (np.linalg.norm(np.cross(made.normal, other.normal), axis=1) > 1e-3).all()
    turn = inverse_kinematics(system, cga.Circle(one.center + 9.0, other.normal, one.radius), weights=(0.0, 1.0))
    assert turn.success.all() and np.abs(system.element(turn.q).normal - other.normal).max() <= 1e-6
    fine = inverse_kinematics(system, one, weights=(1000.0, 1.0), tolerance=1e-3)
    assert fine.success.all() and np.abs(system.element(fine.q).center - one.center).max() <= 1e-6
