"""The report's section on the hands as point pair and line, against positions of the hands and S centres alone."""

import numpy as np
import pytest

from cga_runtime.report import cooperative, cooperative_drawing, cooperative_motions, cooperative_ways, strict_json
from cga_runtime.report.context import GENERIC_POSE, Context, Sizes
from cga_runtime.report.still import CORNERS, ROOM, free_corner

SIZES = Sizes(samples=300, tries=12, poses=2, grid=9, rounds=1)
E2 = np.array([0.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def context(nao):
    made = Context(nao, SIZES)
    made.data["cooperative"] = cooperative.section(made)
    return made


@pytest.fixture(scope="module")
def data(context):
    return strict_json.plain(context.data["cooperative"])


def hands(context, q):
    """Both hands, (..., 2, 3), from the poses of the chains."""
    half = context.loop.right.n
    right, left = context.loop.right.pose(q[..., :half]), context.loop.left.pose(q[..., half:])
    return np.stack([right[..., :3, 3], left[..., :3, 3]], axis=-2)


def moving(context, q, h=1e-4):
    """Derivative of both hands, (..., 2, 3, n), by differences of fourth order."""
    steps = h * np.eye(q.shape[-1])
    one, two = (hands(context, q[..., None, :] + k * steps) - hands(context, q[..., None, :] - k * steps) for k in (1, 2))
    return np.moveaxis((8.0 * one - two) / (12.0 * h), -3, -1)


def poses(context):
    return context.loop.random(np.random.default_rng(context.seed), SIZES.samples)


def frames(context, q):
    """Direction of the pair, and the rotation that takes e2 to it by the shortest arc (Rodrigues), columns e1 e2 e3."""
    at = hands(context, q)
    n = at[:, 1] - at[:, 0]
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    x, y, z = np.cross(E2, n).T
    o = np.zeros_like(x)
    w = np.stack([np.stack([o, -z, y], -1), np.stack([z, o, -x], -1), np.stack([-y, x, o], -1)], axis=1)
    return n, np.eye(3) + w + w @ w / (1.0 + n @ E2)[:, None, None]


def values_of(jacobian):
    """Singular values of derivatives of the hands."""
    return np.linalg.svd(jacobian.reshape(len(jacobian), 6, 10), compute_uv=False)


# ---- statistics


def test_dimensions_ranks_and_hand_motions_are_those_of_the_hands(context, data):
    q = poses(context)
    n, _ = frames(context, q)
    free = moving(context, q)
    across = free - n[:, None, :, None] * np.einsum("ki,kaij->kaj", n, free)[:, :, None, :]
    for kind, jacobian, rank in (("point_pair", free, 6), ("line", across, 4)):
        found = data[kind]
        values = values_of(jacobian)
        assert ((values > 1e-7 * values[:, :1]).sum(axis=1) == rank).all()
        assert (found["joints"], found["task_dimension"], found["nullspace_dimension"], found["full_rank"]) == (10, rank, 10 - rank, 300)
        weakest, strongest = values[:, rank - 1], values[:, 0]
        assert found["weakest"]["median"] == pytest.approx(np.median(weakest), rel=1e-6)
        assert found["weakest"]["p05"] == pytest.approx(np.quantile(weakest, 0.05), rel=1e-6)
        assert found["strongest"]["median"] == pytest.approx(np.median(strongest), rel=1e-9)
        assert found["condition"]["p95"] == pytest.approx(np.quantile(strongest / weakest, 0.95), rel=1e-6)
    assert data["point_pair"]["least_ratio"] == pytest.approx((values_of(free)[:, 5] / values_of(free)[:, 0]).min(), rel=1e-6)


def test_manipulabilities_are_those_of_the_hands_over_powers_of_r(context, data):
    q = poses(context)
    at, free = hands(context, q), moving(context, q)
    distance = np.linalg.norm(at[:, 1] - at[:, 0], axis=1)
    arms = [np.sqrt(np.linalg.det(free[:, k] @ free[:, k].swapaxes(1, 2))) for k in (0, 1)]
    measure = arms[0] * arms[1] / (8.0 * (0.5 * distance) ** 6)
    assert data["point_pair"]["manipulability"]["median"] == pytest.approx(np.median(measure), rel=1e-6)
    assert data["point_pair"]["manipulability"]["p05"] == pytest.approx(np.quantile(measure, 0.05), rel=1e-6)
    n, _ = frames(context, q)
    across = values_of(free - n[:, None, :, None] * np.einsum("ki,kaij->kaj", n, free)[:, :, None, :])[:, :4].prod(axis=1) / distance**2
    assert data["line"]["manipulability"]["median"] == pytest.approx(np.median(across), rel=1e-6)
    assert data["line"]["manipulability"]["p05"] == pytest.approx(np.quantile(across, 0.05), rel=1e-6)
    assert data["product_error"] < 1e-11
    spans = data["hands_distance"]
    assert [spans["minimum"], spans["median"], spans["maximum"]] == pytest.approx([distance.min(), np.median(distance), distance.max()])
    assert 0.0 <= data["hands_meet"]["distance"] < spans["minimum"] and data["hands_meet"]["tried"] == cooperative.NEAREST


def test_rates_shares_and_frame_are_read_off_the_moving_hands(context, data):
    q = poses(context)
    at, free = hands(context, q), moving(context, q)
    r = 0.5 * np.linalg.norm(at[:, 1] - at[:, 0], axis=1)
    n, axes = frames(context, q)
    turned, shifted = (np.einsum("kji,kjl->kil", axes, x / r[:, None, None]) for x in (0.5 * (free[:, 1] - free[:, 0]), free.mean(axis=1)))
    rows = {
        "e12": -turned[:, 0],
        "e23": turned[:, 2],
        "e0i": -turned[:, 1],
        "e1i": shifted[:, 0],
        "e2i": shifted[:, 1],
        "e3i": shifted[:, 2],
    }
    for kind, names in (("point_pair", list(rows)), ("line", ["e12", "e23", "e1i", "e3i"])):
        weakest = np.linalg.svd(np.stack([rows[name] for name in names], axis=1))[0][:, :, -1] ** 2
        assert list(data[kind]["shares"]) == data[kind]["controllable"] == names
        assert list(data[kind]["shares"].values()) == pytest.approx(weakest.mean(axis=0).tolist(), abs=1e-6)
        lengths = [np.median(np.linalg.norm(rows[name], axis=1)) for name in names]
        assert list(data[kind]["rates"].values()) == pytest.approx(lengths, rel=1e-8)
    frame = data["frame"]
    assert frame["forward"] == pytest.approx(np.median(np.arccos(axes[:, 0, 0]))) and frame["opposite"] == pytest.approx(
        np.arccos(-n[:, 1].min())
    )
    assert frame["up"] == pytest.approx(np.median(np.arccos(axes[:, 2, 2])))


def test_the_weakest_motion_is_one_of_a_single_hand_along_its_arm(context, data):
    q = poses(context)
    weakest = np.linalg.svd(moving(context, q).reshape(len(q), 6, 10))[0][:, :, -1].reshape(-1, 2, 3)
    size = np.linalg.norm(weakest, axis=2)
    assert size.min(axis=1).max() < 1e-6 and size.max(axis=1).min() > 1.0 - 1e-9
    arms, side, every = context.arms(q[0]), size.argmax(axis=1), np.arange(len(q))
    towards = (hands(context, q) - np.stack([arms.right.u, arms.left.u]))[every, side]
    cosine = np.abs((weakest[every, side] * towards).sum(axis=1)) / np.linalg.norm(towards, axis=1)
    assert data["stretched"] == pytest.approx(np.median(cosine), abs=1e-6) and data["stretched"] > 0.98


# ---- self-motions


def test_six_motions_leave_the_line_and_four_of_them_the_pair(context, data):
    found, q = data["nullspace"], np.array(GENERIC_POSE)
    basis = np.array([motion["joints"] for motion in found["motions"]])
    assert np.allclose(basis @ basis.T, np.eye(6), atol=1e-14) and found["basis_error"] < 1e-13
    at, velocity = hands(context, q), moving(context, q) @ basis.T  # (2, 3, 6)
    n = (at[1] - at[0]) / np.linalg.norm(at[1] - at[0])
    along = np.einsum("i,aik->ka", n, velocity)
    assert np.allclose([motion["along"] for motion in found["motions"]], along, atol=1e-11)
    assert np.abs(velocity - np.einsum("ka,i->aik", along, n)).max() < 1e-11 and np.abs(velocity[:, :, 2:]).max() < 1e-11
    assert found["across_largest"] < 1e-15 and found["hand_largest"] < 1e-15
    assert [(motion["kind"], motion["side"]) for motion in found["motions"]] == [
        (kind, side) for kind in cooperative_motions.SELF_MOTIONS for side in ("right", "left")
    ]
    assert along[0, 0] > 0.1 and along[1, 1] > 0.1 and np.abs(along[[0, 1], [1, 0]]).max() < 1e-11


def test_swings_turn_s_about_the_line_to_the_hand_and_spins_leave_it(context, data):
    q, h = np.array(GENERIC_POSE), 1e-5
    for motion in data["nullspace"]["motions"][2:]:
        joints = np.array(motion["joints"])
        ends = [getattr(context.arms(q + way * h * joints), motion["side"]) for way in (1, -1)]
        arm, velocity = getattr(context.arms(q), motion["side"]), (ends[0].s - ends[1].s) / (2 * h)
        assert np.linalg.norm(velocity) == pytest.approx(motion["centre"], abs=1e-9)
        if motion["kind"] == "spin":
            assert motion["centre"] < 1e-14
        else:
            across = np.cross(arm.hand - arm.u, arm.s - arm.u)
            assert (
                abs(velocity @ across) == pytest.approx(np.linalg.norm(velocity) * np.linalg.norm(across), rel=1e-8) and velocity[2] > 0.01
            )


def test_drawn_poses_keep_hands_or_line_inside_the_limits(context, data):
    found, start = data["nullspace"], hands(context, np.array(GENERIC_POSE))
    swing, slide = np.array(found["swing"]), np.array(found["slide"])
    for q in (*swing, *slide):
        assert (context.limits[0] <= q).all() and (q <= context.limits[1]).all()
    moved = np.abs(hands(context, swing) - start).max()
    assert moved < 1e-14 and found["swing_error"] < 1e-14
    n = (start[1] - start[0]) / np.linalg.norm(start[1] - start[0])
    assert np.abs(np.cross(hands(context, slide) - start[0], n)).max() < 1e-14 and found["slide_error"] < 1e-14
    shifts = (hands(context, slide) - start) @ n
    assert shifts[0, 0] < -0.03 and shifts[0, 1] > 0.03 and shifts[1, 0] > 0.03 and shifts[1, 1] < -0.03
    centre = context.arms(np.array(GENERIC_POSE)).left.s
    assert min(np.linalg.norm(context.arms(q).left.s - centre) for q in swing) > 0.02


def test_follow_stops_at_the_limits(context):
    q = np.array(GENERIC_POSE)
    motion = np.array(context.data["cooperative"]["nullspace"]["motions"][2]["joints"])
    far = cooperative_motions.follow(context, context.pair, q, motion, 40.0)
    room = np.minimum(far - context.limits[0], context.limits[1] - far).min(axis=1)
    assert (room >= 0.0).all() and np.abs(hands(context, far) - hands(context, q)).max() < 1e-10


# ---- ways and targets


def test_ways_are_straight_or_a_spiral(context, data):
    found = data["interpolation"]
    ends = hands(context, np.array(found["q"]))
    ratio = np.linalg.norm(ends[1, 1] - ends[1, 0]) / np.linalg.norm(ends[0, 1] - ends[0, 0])
    assert found["growth"] == pytest.approx(ratio) and found["turn"] == pytest.approx(np.pi / 2, abs=0.1)
    ways = {chart: np.array(found[chart]["hands"]) for chart in cooperative_ways.CHARTS}
    steps = cooperative_ways.POINTS - 1
    for way in ways.values():
        assert np.allclose(way[[0, -1]], ends, atol=1e-14)
        assert np.allclose(
            np.linalg.norm(way[:, 1] - way[:, 0], axis=1) / np.linalg.norm(ends[0, 1] - ends[0, 0]), ratio ** (np.arange(steps + 1) / steps)
        )
    centre, across = ways["split"].mean(axis=1), ways["split"][:, 1] - ways["split"][:, 0]
    assert np.allclose(np.diff(centre, axis=0), (centre[-1] - centre[0]) / steps, atol=1e-14)
    assert np.abs(across @ np.cross(across[0], across[-1])).max() < 1e-15
    for part in (ways["lie"][:, 0], ways["lie"][:, 1], ways["lie"].mean(axis=1)):  # one similarity again and again
        jumps = np.linalg.norm(np.diff(part, axis=0), axis=1)
        assert np.allclose(jumps[1:] / jumps[:-1], ratio ** (1 / steps), atol=1e-10)
    bent = np.linalg.norm(np.diff(ways["split"][:, 0], axis=0), axis=1)
    assert np.ptp(bent[1:] / bent[:-1]) > 1e-3  # which the split way is not
    assert found["apart"] == pytest.approx(np.linalg.norm(ways["split"] - ways["lie"], axis=2).max()) and found["apart"] > 0.02
    assert all(found[chart]["followed"] == found[chart]["steps"] == steps + 1 for chart in ways)


def test_targets_are_solved_from_starts_that_do_not_know_them(context, data, monkeypatch):
    for entry in data["inverse_kinematics"].values():
        assert entry["solved"] == entry["tried"] == SIZES.tries and entry["solved_first_start"] <= entry["solved"]
        assert entry["iterations_median"] >= 2 and entry["iterations_max"] >= entry["iterations_median"] and entry["seconds_each"] > 0.0

    given, solve = [], cooperative.inverse_kinematics
    monkeypatch.setattr(cooperative, "inverse_kinematics", lambda *given_now: given.append(given_now) or solve(*given_now))
    cooperative.reached(context, context.pair, 0)
    ((_, target, first, starts),) = given
    centres = hands(context, context.pair.random(np.random.default_rng([0, 0, 1]), SIZES.tries)).mean(axis=1)
    assert starts.bit_generator.seed_seq.entropy == [0, 0, 1] and np.allclose(first, context.limits.mean(axis=0))
    assert np.linalg.norm(target.translation() - centres, axis=1).min() > 1e-3


# ---- drawings


def test_drawings_are_where_hands_and_centres_are(context):
    made = {key: drawing for key, (drawing, _) in cooperative_drawing.drawings(context).items()}
    arms = context.arms(np.array(GENERIC_POSE))
    circles = [line.points for line in made["hands-pair"].lines if line.kind == "rotation"]
    for circle, arm in zip(circles, (arms.right, arms.left), strict=True):
        assert np.allclose(circle[0], arm.s, atol=1e-15)
        for fixed in (arm.u, arm.hand):
            assert np.allclose(np.linalg.norm(circle - fixed, axis=1), np.linalg.norm(arm.s - fixed), atol=1e-14)
    middle, r = 0.5 * (arms.right.hand + arms.left.hand), 0.5 * np.linalg.norm(arms.left.hand - arms.right.hand)
    sphere = [line.points for line in made["hands-pair"].lines if line.kind == "extent"]
    assert len(sphere) == 2 and all(np.allclose(np.linalg.norm(x - middle, axis=1), r, atol=1e-14) for x in sphere)
    (line,) = (line.points for line in made["hands-line"].lines if line.kind == "span")
    arrows = [line.points for line in made["hands-line"].lines if line.kind == "translation"]
    ends = [x.points[-1] for x in made["hands-line"].lines if x.kind == "ghost"]
    for point in (*np.concatenate(arrows), arms.right.hand, arms.left.hand, *ends):
        assert np.linalg.norm(np.cross(point - line[0], line[1] - line[0])) < 1e-15
    assert len(arrows) == 4 and len(ends) == 4
    kinds = [line.kind for line in made["hands-way"].lines]
    assert (kinds.count("extent"), kinds.count("span"), kinds.count("rotation")) == (cooperative_drawing.RUNGS + 1, 3, 3)


def test_the_compass_stands_in_a_free_corner():
    assert np.allclose(free_corner(np.array([[0.0, 200.0]])), CORNERS[0])
    assert np.allclose(free_corner(CORNERS[:2] + 0.5 * ROOM), CORNERS[2])
    crowded = CORNERS + np.array([[9.0], [8.0], [30.0], [7.0]])
    assert np.allclose(free_corner(crowded), CORNERS[2])
