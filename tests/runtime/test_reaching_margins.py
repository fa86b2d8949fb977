"""Cooperative primitives kept from degenerating: margins, the manipulability in the cost, statuses, and what is refused."""

import re

import numpy as np
import pytest
from cooperative_draws import batched, corners, drawn, inside
from cooperative_oracle import COUNTS, Flanges, error
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.experiments.cooperative_ik import pandas_around_a_table
from cga_runtime.solve.reaching import middle, reach


@pytest.fixture(scope="module")
def table():
    """Four Pandas."""
    return cga.Cooperative(pandas_around_a_table(4), "sphere")


@pytest.fixture(scope="module")
def sliding():
    """Systems whose q is their end points."""
    return {kind: cga.Cooperative(gantries()[:count], kind) for kind, count in COUNTS.items()}


def test_a_margin_keeps_four_hands_from_one_plane(table, rng):
    """Mid-range they are in one plane, and with the nearest positions on a sphere they stay close to it."""
    system = table
    flanges = Flanges([np.eye(4) if c.order.placement is None else np.array(c.order.placement) for c in system.chains])
    q0 = middle(system.lower, system.upper)
    assert system.degeneracy(q0) < 1e-12
    measures = []
    for target, _ in zip(drawn(system, rng, 0.2), range(5), strict=False):
        found = [reach(system, target, degeneracy_margin=margin) for margin in (0.0, None, 0.2)]
        assert all(f.success for f in found)
        measures.append([corners(flanges.points(f.q)) for f in found])
    measures = np.array(measures)
    assert measures[:, 0].min() < 1e-3 and np.median(measures[:, 0]) < 0.05
    assert (measures[:, 1] >= 0.01 - 1e-7).all() and (measures[:, 2] >= 0.2 - 1e-7).all()


@pytest.mark.parametrize("kind", ["line", "circle", "plane"])
def test_a_margin_keeps_end_points_apart(kind, sliding):
    """From the wrong side the nearest position on the target that is not opposite to it has end points together, or on one line."""
    system = sliding[kind]
    x = np.array([[0.1, 0.0, 0.0], [-0.1, 0.02, 0.0], [0.0, 0.5, 0.05]])[: len(system.chains)]
    ahead = {"line": Line.from_points((0, 0, 0), (1, 0, 0)), "circle": Circle((0, 0, 0), (0, 0, 1), 0.5), "plane": Plane((0, 0, 1), 0.0)}
    target = ahead[kind]
    n = target.direction if kind == "line" else target.normal
    assert system.about.direction(x) @ n < -0.9
    none = reach(system, target, x.ravel(), degeneracy_margin=0.0, starts=1)
    assert corners(system.points(none.q)) < 1e-6
    for margin in (0.05, 0.3):
        found = reach(system, target, x.ravel(), degeneracy_margin=margin, starts=1)
        assert found.success and max(error(kind, system.points(found.q), batched(target), 0)) < 1e-8
        assert corners(system.points(found.q)) == pytest.approx(margin, abs=1e-7)  # held by the margin
        order = [np.roll(np.arange(len(x)), k) for k in range(len(x))]
        measures = [cga.Cooperative([system.chains[k] for k in way], kind).degeneracy(system.points(found.q)[way].ravel()) for way in order]
        assert min(measures) >= margin - 1e-7


@pytest.mark.parametrize(
    ("kind", "target"), [("plane", Plane((0, 0, 1), 1.0)), ("circle", Sphere((0, 0, 0), 1.0)), ("plane", Point((0, 0, 1)))]
)
def test_end_points_do_not_all_come_together(kind, target, sliding):
    """Begun where they are one point, near to which is what the cost asks for: triangles of any shape have sines as wanted."""
    for margin in (None, 0.3):
        found = reach(sliding[kind], target, degeneracy_margin=margin)
        x = sliding[kind].points(found.q)
        assert found.success and corners(x) >= (margin or 0.01) - 1e-7 and np.linalg.norm(x[1] - x[0]) >= 1e-3 - 1e-7


@pytest.mark.parametrize("kind", ["circle", "sphere"])
def test_small_targets_may_have_end_points_close_together(kind, sliding, rng):
    """Nearer than what keeps primitives of free size from shrinking."""
    system = sliding[kind]
    q0 = next(q for q in system.random(rng, 100) if corners(system.points(q)) > 0.3)
    target = Circle((0.1, 0, 0), (0, 0, 1), 4e-4) if kind == "circle" else Sphere((0.1, 0, 0), 4e-4)
    for margin in (None, 0.1):
        assert reach(system, target, q0, degeneracy_margin=margin).success


def test_a_margin_that_cannot_be_kept_is_named(sliding):
    pair = PointPair.from_points((0, 0, 0), (0.1, 0, 0))
    found = reach(sliding["point_pair"], pair, degeneracy_margin=0.2, starts=2)
    assert not found.success and "degeneracy margin not kept: 0.1, at least 0.2 wanted" in found.status and found.residual < 1e-9
    tiny = PointPair.from_points((0, 0, 0), (1e-4, 0, 0))
    assert reach(sliding["point_pair"], tiny).success  # without a margin the target alone decides
    found = reach(sliding["circle"], Circle((0, 0, 0), (0, 0, 1), 0.5), degeneracy_margin=0.9, starts=2)
    assert not found.success and "degeneracy margin not kept" in found.status


@pytest.mark.parametrize("kind", ["line", "circle", "sphere"])
def test_a_weight_improves_the_manipulability(kind, table, rng):
    system, gains = cga.Cooperative(table.chains[: COUNTS[kind]], kind), []
    for target, _ in zip(drawn(system, rng, 0.3), range(4), strict=False):
        found = [reach(system, target, degeneracy_margin=0.2, manipulability_weight=weight) for weight in (0.0, 2.0)]
        assert all(f.success and corners(system.points(f.q)) >= 0.2 - 1e-7 for f in found)
        gains.append(system.manipulability(found[1].q) / system.manipulability(found[0].q))
    assert np.median(gains) > 1.3


# ---- statuses and refusals


def test_what_cannot_be_reached_is_a_status(sliding):
    found = reach(sliding["circle"], Circle((5, 0, 0), (0, 0, 1), 0.1), starts=3)
    assert not found.success and found.starts == 3 and inside(sliding["circle"], found.q)
    assert re.match(r"unreachable or not found in 3 starts: closest result \S+ m away", found.status) and found.residual > 1.0
    chain = gantries()[0]
    one = cga.Cooperative([chain, chain], "line")  # both ends are one point
    for target in (Line.from_points((0, 0, 0), (1, 0, 0)), Point((0, 0, 0))):
        found = reach(one, target, starts=2)
        assert not found.success and found.residual == np.inf and "degeneracy margin not kept: 0, at least 0.001 wanted" in found.status


REFUSED = [
    ("circle", Line.from_points((0, 0, 0), (1, 0, 0)), {}, cga.UnknownNameError,
     "unknown target of a cooperative circle 'Line'; known: Circle, Plane, Sphere, Point, PointPair, Similarity"),
    ("circle", (0.1, 0.2, 0.3), {}, cga.UnknownNameError, "unknown target of a cooperative circle 'tuple'"),
    ("sphere", Sphere(np.zeros((4, 3)), np.ones(4)), {}, cga.WrongSizeError, "one Sphere at a time; this one has the batch shape (4,)"),
    ("sphere", cga.Similarity(np.eye(12)[[0, 0]]), {}, cga.WrongSizeError, "one Similarity at a time; this one has the batch shape (2,)"),
    ("point", Point((0, 0, 0)), {"q0": (0, 0)}, cga.WrongSizeError, "q0: shape (2,) given, (3,) needed: a_x, a_y, a_z"),
    ("point", Point((0, 0, 0)), {"degeneracy_margin": -0.1}, cga.WrongSizeError, "degeneracy_margin: -0.1 given, zero or more needed"),
    ("point", Point((0, 0, 0)), {"degeneracy_margin": (1, 2)}, cga.WrongSizeError, "degeneracy_margin: (1, 2) given, a single number"),
    ("point", Point((0, 0, 0)), {"degeneracy_margin": np.nan}, cga.NotFiniteError, "degeneracy_margin holds NaN"),
    ("point", Point((0, 0, 0)), {"manipulability_weight": "1"}, cga.WrongSizeError, "manipulability_weight: not an array of numbers"),
    ("point", Point((0, 0, 0)), {"grasp": np.eye(8)[0], "limb_margin": 0.1}, cga.GraspError, "grasp, limb_margin: only for a ClosedChain"),
    ("point", Point((0, 0, 0)), {"conditioning_weight": 1.0}, cga.GraspError, "conditioning_weight: only for a ClosedChain"),
    ("circle", Circle((0, 0, 0), (0, 0, 1), 1.0), {"manipulability_weight": 1.0}, cga.DegenerateError, "of a circle grows without bound"),
    ("circle", Plane((0, 0, 1), 0.0), {"manipulability_weight": 1.0, "degeneracy_margin": 0.1}, cga.DegenerateError, "of the system's"),
    ("plane", Plane((0, 0, 1), 0.0), {"manipulability_weight": 1.0, "degeneracy_margin": 0.1}, cga.DegenerateError, "not a plane"),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "target", "options", "kind_of_error", "message"), REFUSED)
def test_refusals_say_what_is_wrong(kind, target, options, kind_of_error, message, sliding):
    with pytest.raises(kind_of_error, match=re.escape(message)):
        reach(sliding[kind], target, **options)


def test_options_of_cooperative_systems_are_for_them_alone(arm):
    for options in ({"degeneracy_margin": 0.1}, {"manipulability_weight": 1.0}):
        with pytest.raises(cga.GraspError, match=f"{next(iter(options))}: only for a Cooperative"):
            reach(arm, Point((0.1, 0, 0)), **options)
