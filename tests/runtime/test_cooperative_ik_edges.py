"""Inverse kinematics of free points, q being the points: orientation, limits, what is out of reach, what is refused; and the experiment."""

import numpy as np
import pytest
from cooperative_oracle import COUNTS, DIRECTED, free_points, row
from scipy.optimize import least_squares

import cga_runtime as cga
from cga_runtime.elements.charts import direction_of
from cga_runtime.errors import ChainError, DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.experiments.cooperative_ik import measure
from cga_runtime.solve.cooperative_errors import Errors
from cga_runtime.solve.inverse_kinematics import inverse_kinematics


@pytest.fixture(scope="module")
def free():
    """Free points: q is the points, within 2 m along each axis."""
    chains = free_points()
    return {kind: cga.Cooperative(chains[:count], kind) for kind, count in COUNTS.items()}


def inside(system, q):
    return bool(((system.lower <= q) & (q <= system.upper)).all())


def test_orientation_counts(free, rng) -> None:
    """From points that are turned the other way round; a point pair's in the other order."""
    for kind in DIRECTED:
        system, count = free[kind], COUNTS[kind]
        start = rng.uniform(-1.0, 1.0, (40, count, 3))
        target = system.about.through(start[:, ::-1])
        found = inverse_kinematics(system, target, start.reshape(40, -1))
        assert found.success.all()
        made = system.element(found.q)
        assert ((direction_of(made) * direction_of(target)).sum(axis=1) > 1.0 - 1e-10).all()
        apart = np.linalg.norm(np.diff(system.points(found.q), axis=1), axis=2)
        assert np.median(apart.min(axis=1)) > 0.1 and apart.min() > 1e-3  # the points do not come together to be turned


def test_handedness_does_not(free, rng) -> None:
    system = free["sphere"]
    x = rng.uniform(-1.0, 1.0, (30, 4, 3))
    found = inverse_kinematics(system, system.about.through(x), x[:, [1, 0, 2, 3]].reshape(30, -1))
    assert (found.iterations == 0).all() and found.success.all()


def test_without_limits(free, rng) -> None:
    system = free["circle"]
    target = system.element(rng.uniform(2.5, 4.0, (10, 9)))
    loose, held = inverse_kinematics(system, target, limits=False), inverse_kinematics(system, target, restarts=0)
    assert loose.success.all() and not inside(system, loose.q) and inside(system, held.q) and not held.success.all()


def lowest(errors, start, box):
    """Least error that SciPy finds from a start."""
    one, inner = np.zeros(1, dtype=int), np.clip(start, box[0] + 1e-9, box[1] - 1e-9)  # SciPy wants starts inside

    def value(q):
        return errors.similarity(one, q[None])[0][0]

    def slope(q):
        return errors.similarity(one, q[None])[1][0]

    return np.linalg.norm(least_squares(value, inner, slope, box, xtol=1e-12, ftol=1e-14, max_nfev=60).fun)


def test_targets_out_of_reach(free, rng) -> None:
    """Results are minima of the error inside the limits: SciPy finds nothing lower from there. The Panda's last joint does not move its
    flange, and does not count."""
    panda = cga.Cooperative([cga.load_robot("panda").chain("panda_link8")], "point")
    ends = rng.uniform(-1.0, 1.0, (3, 2, 3)) + [[-3.0, 0.0, 0.0], [4.0, 0.0, 0.0]]
    for system, target in ((panda, cga.Point(rng.uniform(1.5, 2.5, (3, 3)))), (free["point_pair"], cga.PointPair(ends))):
        found = inverse_kinematics(system, target)
        assert (found.status == "least_squares").all() and not found.success.any()
        assert (found.starts == 201).all() and inside(system, found.q)
        for k in range(3):
            errors = Errors(system, row(target, k), (1.0, 1.0))
            assert found.residual[k] <= lowest(errors, found.q[k], (system.lower, system.upper)) + 1e-7
            others = errors.similarity(np.zeros(2000, dtype=int), system.random(rng, 2000))[0]
            assert found.residual[k] < np.linalg.norm(others, axis=1).min()


def test_far_targets_give_numbers(free) -> None:
    far = {
        "point": cga.Point([1e50, 0.0, 0.0]),
        "line": cga.Line([1e50, 0.0, 0.0], [0.0, 1.0, 0.0]),
        "circle": cga.Circle([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1e50),
    }
    for kind, target in far.items():
        found = inverse_kinematics(free[kind], target, restarts=3)
        assert not found.success and found.residual > 1e49 and np.isfinite(found.q).all() and inside(free[kind], found.q)


# ---- the experiment


def test_what_the_experiment_counts(free) -> None:
    row = measure("free", free["sphere"], 50, 3)
    assert (row.name, row.joints, row.targets + row.skipped, row.success) == ("free", 12, 50, 1.0)
    assert row.flattest > 1e-5 and 0.0 < row.worst < 2e-6 and row.starts >= 1.0
    few = measure("free", free["circle"], 40, 3, restarts=0, max_iterations=0, limits=False, tolerance=1e-12)
    assert few.success < 1.0 and few.starts == 1.0


# ---- what is refused

BAD_TARGETS = [
    (np.eye(4), WrongSizeError, "similarity: shape (4, 4) given, (..., 12) needed"),
    (1.0, WrongSizeError, "(..., 12) needed"),
    ("circle", WrongSizeError, "not an array of numbers"),
    (np.zeros(12), DegenerateError, "similarity: V ~V must be 1"),
    (np.full(12, np.nan), NotFiniteError, "similarity holds NaN"),
    (
        None,
        UnknownNameError,
        "unknown kind of target of a cooperative circle 'NoneType'; known: Circle, Similarity, its components (..., 12)",
    ),
    ([[1.0], [1.0, 2.0]], UnknownNameError, "unknown kind of target of a cooperative circle 'list'"),
    (cga.Point([0.0, 0.0, 0.0]), UnknownNameError, "unknown kind of target of a cooperative circle 'Point'; known: Circle, Similarity"),
    (cga.Motor.from_pose(np.eye(4)), UnknownNameError, "unknown kind of target of a cooperative circle 'Motor'; known: Circle, Similarity"),
    (cga.Circle([1e51, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0), DegenerateError, "a coordinate of 1.0e+51 m given, at most 1e+50 m"),
]


@pytest.mark.parametrize(("target", "error", "words"), BAD_TARGETS)
def test_targets(free, target, error, words) -> None:
    with pytest.raises(error) as caught:
        inverse_kinematics(free["circle"], target)
    assert words in str(caught.value)


def test_options(free) -> None:
    circle, target = free["circle"], cga.Circle([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0)
    with pytest.raises(UnknownNameError, match="unknown arm 'list'; known: a Chain, from Robot.chain, a Cooperative of such chains"):
        inverse_kinematics([circle], target)
    with pytest.raises(WrongSizeError, match=r"q0: shape \(7,\) given, \(..., 9\) needed"):
        inverse_kinematics(circle, target, np.zeros(7))
    with pytest.raises(WrongSizeError, match="lengths are all that a sphere measures"):
        inverse_kinematics(free["sphere"], cga.Sphere([0.0, 0.0, 0.0], 1.0), weights=(0.0, 1.0))
    with pytest.raises(UnknownNameError, match="unknown option of gauss_newton 'limits'"):
        inverse_kinematics(circle, target, method="gauss_newton", limits=True)
    with pytest.raises(UnknownNameError, match="unknown kind of target 'Similarity'"):
        inverse_kinematics(circle.chains[0], cga.Similarity.exp(np.zeros(7)))
    with pytest.raises(ChainError, match="its base floats"):
        inverse_kinematics(cga.load_robot("nao", base="floating").chain("RHand"), np.eye(4))
