"""Joint velocities for twists of a primitive: free points, whose primitive elementary geometry knows, and a humanoid's arms."""

import numpy as np
import pytest
from cooperative_oracle import COUNTS, DIRECTED, ROUND, free_points, plane_of_slides, standing

import cga_runtime as cga
from cga_runtime.elements.charts import REFERENCE, direction_of
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.solve.resolved_rates import DAMPING, THRESHOLD, resolved_rates, twist_towards

KINDS = tuple(COUNTS)


@pytest.fixture(scope="module")
def free():
    chains = free_points()
    return {kind: cga.Cooperative(chains[:count], kind) for kind, count in COUNTS.items()}


@pytest.fixture(params=KINDS)
def system(request, free):
    return free[request.param]


@pytest.fixture(scope="module")
def waist():
    """Two arms of a humanoid as far as the upper arm: nine joints, six of which the waist and one arm have."""
    robot = cga.load_robot("g1")
    return cga.Cooperative([robot.chain(f"{side}_shoulder_yaw_link") for side in ("left", "right")], "line")


def regular(system, rng, count, least=0.2):
    """Positions (count, n) whose smallest controllable singular value is at least that."""
    q = system.random(rng, 20 * count)
    values = np.linalg.svd(system.horizontal_jacobian(q)[:, system.about.rows], compute_uv=False)[:, -1]
    chosen = q[values > least][:count]
    assert len(chosen) == count
    return chosen


def moved(kind, x, v, h=1e-5):
    """Rates of centre, direction and log r of the primitive through points x that move with v, by central differences."""
    ends = [standing(kind, x + s * h * v) for s in (1, -1)]
    center, radius = (ends[0][0] - ends[1][0]) / (2 * h), np.log(ends[0][2] / ends[1][2]) / (2 * h) if kind in ROUND else 0.0
    return center, None if ends[0][1] is None else (ends[0][1] - ends[1][1]) / (2 * h), radius


def test_the_primitive_moves_with_the_twist(system, rng) -> None:
    """n' = om x n with the turns of the twist, r'/r = -e0i, and the centre with r R v; of flat ones what moves across them. Rows that are
    not controllable do not count."""
    q, twist = regular(system, rng, 12), rng.normal(size=(12, 7))
    v = resolved_rates(system, q, twist)
    only = np.zeros_like(twist)
    only[:, system.about.rows] = twist[:, system.about.rows]
    np.testing.assert_array_equal(v, resolved_rates(system, q, only))
    axes = cga.Similarity(system.similarity(q)).rotation().matrix()
    for k in range(12):
        x, rate = q[k].reshape(-1, 3), v[k].reshape(-1, 3)
        center, n, radius = standing(system.kind, x)
        dc, dn, dlog = moved(system.kind, x, rate)
        om = axes[k] @ [only[k, 2], -only[k, 1], only[k, 0]]
        along = axes[k] @ only[k, 4:]
        if system.kind in DIRECTED:
            np.testing.assert_allclose(dn, np.cross(om, n), rtol=0, atol=1e-7)
        if system.kind in ROUND:
            assert dlog == pytest.approx(-only[k, 3], abs=1e-6)
            np.testing.assert_allclose(dc, radius * along, rtol=0, atol=1e-6 * max(1.0, radius**2))
        elif system.kind == "point":
            np.testing.assert_allclose(rate[0], along, rtol=0, atol=1e-12)
        else:  # a point of the flat moves as the twist about the foot says, but for its motion along the flat
            foot = n * (n @ x[0]) if system.kind == "plane" else x[0] - n * (n @ x[0])
            for point, velocity in zip(x, rate, strict=True):
                expected = along + np.cross(om, point - foot)
                across = n[:, None] * n if system.kind == "plane" else np.eye(3) - n[:, None] * n
                np.testing.assert_allclose(across @ velocity, across @ expected, rtol=0, atol=1e-12)


def test_the_shortest_of_all_velocities(system, rng) -> None:
    q, twist = regular(system, rng, 10), rng.normal(size=(10, 7))
    v = resolved_rates(system, q, twist)
    jacobian = system.horizontal_jacobian(q)[:, system.about.rows]
    np.testing.assert_allclose((jacobian @ v[..., None])[..., 0], twist[:, system.about.rows], rtol=0, atol=1e-12)
    for k in range(10):
        best, *_ = np.linalg.lstsq(jacobian[k], twist[k, system.about.rows], rcond=None)
        np.testing.assert_allclose(v[k], best, rtol=0, atol=1e-11)


def test_secondary_motions_leave_the_primitive(system, rng) -> None:
    """Undamped and damped alike: what is added is the projection to the null space."""
    q, second = regular(system, rng, 12), rng.normal(size=(12, system.n))
    twist = rng.normal(size=(12, 7))
    jacobian = system.horizontal_jacobian(q)
    for options in ({}, {"threshold": 10.0, "damping": 1.0}):
        added = resolved_rates(system, q, twist, second, **options) - resolved_rates(system, q, twist, **options)
        assert np.abs(jacobian @ added[..., None]).max() < 1e-13 * np.abs(jacobian).max() * system.n
        np.testing.assert_allclose(added, (system.nullspace(q) @ second[..., None])[..., 0], rtol=0, atol=1e-13)
    if system.n > len(system.about.rows):
        assert (np.linalg.norm(added, axis=1) > 0.01).all()


def test_damping(system, rng) -> None:
    """(J J^T + l^2)^-1 by its definition; none above the threshold; with both numbers t never more than |b| / t."""
    q, twist = system.random(rng, 200), rng.normal(size=(200, 7))
    jacobian, wanted = system.horizontal_jacobian(q)[:, system.about.rows], twist[:, system.about.rows]
    least = np.linalg.svd(jacobian, compute_uv=False)[:, -1]
    for threshold, damping in ((0.3, 0.5), (0.3, 0.3), (THRESHOLD, DAMPING)):
        v = resolved_rates(system, q, twist, threshold=threshold, damping=damping)
        square = np.where(least < threshold, damping**2 * (1.0 - (least / threshold) ** 2), 0.0)
        below = jacobian @ jacobian.swapaxes(1, 2) + square[:, None, None] * np.eye(len(system.about.rows))
        expected = (jacobian.swapaxes(1, 2) @ np.linalg.solve(below, wanted[..., None]))[..., 0]
        clear = least > 1e-2
        np.testing.assert_allclose(v[clear], expected[clear], rtol=1e-8, atol=1e-10)
        assert (np.linalg.norm(v, axis=1) <= np.linalg.norm(wanted, axis=1) / min(threshold, damping) * (1.0 + 1e-12)).all()
    for options in ({"threshold": 0.0}, {"damping": 0.0}):
        off = resolved_rates(system, q, twist, **options)
        np.testing.assert_allclose((jacobian @ off[..., None])[..., 0][least > 1e-3], wanted[least > 1e-3], rtol=0, atol=1e-9)


def test_singular_positions(waist) -> None:
    """Arms that hang hardly lift a line, and two slides never leave their plane: nothing is raised, and nothing grows."""
    jacobian = waist.horizontal_jacobian(np.zeros(9))[waist.about.rows]
    assert 0.0 < np.linalg.svd(jacobian, compute_uv=False)[-1] < 0.01
    v = resolved_rates(waist, np.zeros(9), np.ones(7))
    assert np.linalg.norm(v) <= 2.0 / THRESHOLD < np.linalg.norm(resolved_rates(waist, np.zeros(9), np.ones(7), threshold=0.0))
    slides = cga.Cooperative([plane_of_slides()], "point")
    twist = np.array([9.0, 9.0, 9.0, 9.0, 1.0, 2.0, 3.0])
    np.testing.assert_allclose(resolved_rates(slides, np.zeros(2), twist, damping=0.0), [1.0, 2.0], rtol=1e-14)
    np.testing.assert_allclose(resolved_rates(slides, np.zeros(2), twist, damping=0.5), np.array([1.0, 2.0]) / 1.25, rtol=1e-14)


def test_twists_towards_a_target(system, rng) -> None:
    """The twist of a second: by its definition, and by what it does to centre, direction and radius."""
    q, goal = system.random(rng, 20), system.element(system.random(rng, 20))
    twist = twist_towards(system, q, goal)
    others = [k for k in range(7) if k not in system.about.rows]
    assert (twist[:, others] == 0.0).all()
    now, axes = system.element(q), cga.Similarity(system.similarity(q)).rotation().matrix()
    om = np.stack([twist[:, 2], -twist[:, 1], twist[:, 0]], axis=1)
    if system.kind in REFERENCE:
        turn = cga.Rotor.from_vector((axes @ om[..., None])[..., 0]).matrix()
        np.testing.assert_allclose((turn @ direction_of(now)[..., None])[..., 0], direction_of(goal), rtol=0, atol=1e-12)
        assert np.abs((om * system.about.reference).sum(axis=1)).max() < 1e-13  # no turn about the direction
    if system.kind in ROUND:
        np.testing.assert_allclose(np.exp(-twist[:, 3]) * now.radius, goal.radius, rtol=1e-12)
    if system.kind in (*ROUND, "point"):
        radius = now.radius if system.kind in ROUND else np.ones(20)
        step = radius[:, None] * (axes @ twist[:, 4:, None])[..., 0]
        np.testing.assert_allclose(now.center + step, goal.center, rtol=0, atol=1e-11 * np.abs(goal.center).max())
    versors = cga.Similarity(system.similarity(q[:5]))
    assert np.abs(twist_towards(system, q[:5], versors)).max() < 1e-10


def test_opposite_directions(free) -> None:
    """Half a turn about e1 of the primitive's frame, where no arc is the shortest."""
    line = free["line"]
    q = np.array([0.0, 0.0, 0.0, 0.3, 0.4, 0.5])
    twist = twist_towards(line, q, cga.Line.from_points(q[3:], q[:3]))
    np.testing.assert_allclose(twist[[0, 1]], 0.0, atol=1e-6)
    assert abs(twist[2]) == pytest.approx(np.pi, rel=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_a_control_loop(free, rng, kind) -> None:
    """Errors fall as exp(-t); a secondary motion towards the middle of the limits goes on beside."""
    system = free[kind]
    goal = system.about.through(0.3 * np.array([[1.0, 0, 0], [0, 1.1, 0], [0, 0, 0.9], [-0.8, -0.7, -0.6]])[: COUNTS[kind]])
    q = np.array([[1.2, 0.1, 0], [0, 1.0, 0.2], [0.1, 0.1, 1.1], [-1.0, -0.8, -0.9]])[: COUNTS[kind]].ravel()
    start, steps, dt, gain = twist_towards(system, q, goal), 200, 0.01, 2.0
    free_before = np.linalg.norm(q)
    for _ in range(steps):
        q = q + dt * resolved_rates(system, q, gain * twist_towards(system, q, goal), secondary=-q)
    size = {"scale": np.linalg.norm(start), "end": np.linalg.norm(twist_towards(system, q, goal))}
    assert size["end"] < 3.0 * np.exp(-gain * steps * dt) * size["scale"]
    assert np.linalg.norm(q) < free_before


def test_joints_that_arms_share(waist, rng) -> None:
    q, twist = regular(waist, rng, 20, 0.05), rng.normal(size=(20, 7))
    v = resolved_rates(waist, q, twist, threshold=0.0)
    h = 1e-6
    ends = [waist.element(np.asarray(q + s * h * v)) for s in (1, -1)]
    rate = (ends[0].direction - ends[1].direction) / (2 * h)
    om = np.stack([twist[:, 2], 0 * twist[:, 0], twist[:, 0]], axis=1)
    axes = cga.Similarity(waist.similarity(q)).rotation().matrix()
    np.testing.assert_allclose(rate, np.cross((axes @ om[..., None])[..., 0], waist.element(q).direction), rtol=0, atol=1e-6)


def test_shapes(free, rng) -> None:
    circle = free["circle"]
    q, twist, goal = circle.random(rng, (2, 3)), rng.normal(size=(3, 7)), circle.element(circle.random(rng, 3))
    assert resolved_rates(circle, q, twist).shape == (2, 3, 9)
    assert resolved_rates(circle, q[0, 0], twist[0]).shape == (9,)
    assert resolved_rates(circle, q[0, 0], twist, np.zeros(9)).shape == (3, 9)
    assert resolved_rates(circle, q[0, 0], twist[0], rng.normal(size=(4, 9))).shape == (4, 9)
    assert twist_towards(circle, q, goal).shape == (2, 3, 7) and twist_towards(circle, q[0, 0], goal).shape == (3, 7)
    assert resolved_rates(circle, np.empty((0, 9)), np.ones(7)).shape == (0, 9)
    np.testing.assert_allclose(resolved_rates(circle, q, twist)[1, 2], resolved_rates(circle, q[1, 2], twist[2]), rtol=0, atol=1e-13)


def test_charts(free, rng) -> None:
    """In either chart, as long as both calls have the same one, the joint velocities are the same."""
    for kind in DIRECTED:
        system = free[kind]
        q, goal = regular(system, rng, 8), system.element(system.random(rng, 8))
        one, other = (resolved_rates(system, q, twist_towards(system, q, goal, chart), chart=chart) for chart in (1, -1))
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-10 * np.abs(one).max())


def test_what_is_refused(free) -> None:
    circle, q, twist = free["circle"], np.arange(9.0) ** 2 / 50, np.ones(7)
    flat = np.array([0.0, 0, 0, 0.5, 0, 0, 1.0, 0, 0])
    with pytest.raises(DegenerateError, match="circle: its three points lie on one line"):
        resolved_rates(circle, flat, twist)
    with pytest.raises(DegenerateError, match="circle: its three points lie on one line"):
        twist_towards(circle, flat, cga.Circle([0.0, 0.0, 0.0], [0.0, 0.0, 1.0], 1.0))
    cases = [
        ({"twist": np.ones(6)}, WrongSizeError, r"twist: shape \(6,\) given, \(..., 7\) needed"),
        ({"twist": np.full(7, np.nan)}, NotFiniteError, "twist holds NaN"),
        ({"twist": twist, "secondary": np.ones(7)}, WrongSizeError, r"secondary: shape \(7,\) given, \(..., 9\) needed"),
        ({"twist": twist, "threshold": -1.0}, WrongSizeError, "threshold: -1.0 given, a number of at least 0 is needed"),
        ({"twist": twist, "damping": [0.1, 0.2]}, WrongSizeError, "damping: .* a number of at least 0 is needed"),
        ({"twist": twist, "chart": 2}, UnknownNameError, "unknown chart"),
    ]
    for options, kind, words in cases:
        with pytest.raises(kind, match=words):
            resolved_rates(circle, q, **options)
    with pytest.raises(WrongSizeError, match="q and twist: batch dimensions"):
        resolved_rates(circle, np.tile(q, (2, 1)), np.ones((3, 7)))
    with pytest.raises(UnknownNameError, match="unknown kind of target of a cooperative circle 'Sphere'; known: Circle, Similarity"):
        twist_towards(circle, q, cga.Sphere([0.0, 0.0, 0.0], 1.0))
