"""The dual task space of two arms against matrices and scipy's rotations, means and matrix logarithms, and against casadi's derivatives."""

import numpy as np
import pytest
from scipy.linalg import expm, logm
from scipy.spatial.transform import Rotation, Slerp
from two_arm_poses import MEANS, body_twists, lie, poses, relative, rotations, split, turned, velocities

import cga_runtime as cga
from cga_runtime.conventions import FRAMES, TWIST_ORDERS, reorder
from cga_runtime.elements import PointPair
from cga_runtime.spaces.dual_task import JACOBIANS, MOTORS, DualTaskSpace

CHARTS = ("split", "lie")
FACING = np.array([[-1, 0, 0, 0.9], [0, -1, 0, 0.1], [0, 0, 1, 0.2], [0, 0, 0, 1.0]])
"""A second robot that faces the first: equal joint positions make the relative rotation a half turn."""
ROUNDOFF = 2e-14
"""Of numbers of the order of one: |M|^2 of a chain of seven joints is off by 1e-15 already, and its square counts in poses."""


@pytest.fixture(scope="module")
def panda():
    return cga.load_robot("panda").chain("panda_link8")


@pytest.fixture(scope="module")
def pandas(panda):
    return DualTaskSpace(panda, panda.robot.chain("panda_link8", placement=FACING))


@pytest.fixture(scope="module")
def humanoid():
    """Upper arms of the G1, which share its waist."""
    robot = cga.load_robot("g1")
    return DualTaskSpace(robot.chain("left_shoulder_yaw_link"), robot.chain("right_shoulder_yaw_link"))


@pytest.fixture(scope="module", params=["pandas", "humanoid"])
def space(request):
    return request.getfixturevalue(request.param)


@pytest.fixture
def q(space, rng):
    """Configurations whose relative rotation is not close to a half turn, where scipy's logm loses digits and the mean jumps."""
    q = space.random(rng, 60)
    q = q[turned(space, q) < 2.9][:6]
    assert len(q) == 6 and turned(space, q).max() > 2.0
    return q


def close(a, b, tolerance):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance)


def pose(motor):
    return cga.Motor(motor).pose()


# ---- values


def test_the_relative_motor_is_the_first_pose_seen_from_the_second(space, q):
    close(pose(space.relative(q)), relative(*poses(space, q)), ROUNDOFF)


def test_split_is_the_midpoint_and_the_half_rotation(space, q):
    first, second = poses(space, q)
    found = pose(space.absolute(q))
    close(found[..., :3, 3], 0.5 * (first[..., :3, 3] + second[..., :3, 3]), ROUNDOFF)
    for k in range(len(q)):
        halfway = Slerp([0, 1], Rotation.from_matrix([second[k, :3, :3], first[k, :3, :3]]))(0.5)
        close(found[k, :3, :3], halfway.as_matrix(), ROUNDOFF)
    np.testing.assert_array_equal(space.absolute(q), space.absolute(q, "split"))


def test_lie_is_half_of_the_screw_motion(space, q):
    found = pose(space.absolute(q, "lie"))
    close(found, lie(*poses(space, q)), ROUNDOFF)
    close(found, [b @ expm(0.5 * logm(np.linalg.inv(b) @ a).real) for a, b in zip(*poses(space, q), strict=True)], 1e-13)
    step = np.linalg.inv(poses(space, q)[1]) @ found
    close(step @ step, relative(*poses(space, q)), ROUNDOFF)
    close(found[..., :3, :3], pose(space.absolute(q))[..., :3, :3], ROUNDOFF)


def test_the_screw_mean_is_not_the_midpoint(space, q):
    """It is the middle of an arc of the angle a: its height over the chord c is (c/2) tan(a/4); along the axis it is the midpoint."""
    first, second = poses(space, q)
    off = pose(space.absolute(q, "lie"))[..., :3, 3] - 0.5 * (first[..., :3, 3] + second[..., :3, 3])
    turn = (lambda a, b: (a * b.inv()).as_rotvec())(*rotations(first, second))
    angle = np.linalg.norm(turn, axis=-1)
    axis = turn / angle[:, None]
    chord = np.linalg.norm(np.cross(axis, first[..., :3, 3] - second[..., :3, 3]), axis=-1)
    close(np.linalg.norm(off, axis=-1), 0.5 * chord * np.tan(0.25 * angle), ROUNDOFF)
    close((off * axis).sum(axis=-1), 0.0, ROUNDOFF)
    assert 0.01 < np.linalg.norm(off, axis=-1).min() and 0.1 < np.linalg.norm(off, axis=-1).max() < 1.0


@pytest.mark.parametrize("chart", CHARTS)
def test_exchanged_arms_have_the_same_absolute_pose(space, q, chart):
    exchanged = DualTaskSpace(space.second, space.first)
    swapped = np.empty_like(q)
    for place, own in zip(exchanged.index, reversed(space.index), strict=True):
        swapped[..., place] = q[..., own]
    found, other = pose(space.absolute(q, chart)), pose(exchanged.absolute(swapped, chart))
    close(other, found, ROUNDOFF)
    columns = [exchanged.joint_names.index(other_name(name)) for name in space.joint_names]
    twists = [s.absolute_twist_jacobian(x, chart, "WORLD") for s, x in ((space, q), (exchanged, swapped))]
    close(twists[1][..., columns], twists[0], ROUNDOFF)
    close(pose(exchanged.relative(swapped)) @ pose(space.relative(q)), np.broadcast_to(np.eye(4), (6, 4, 4)), ROUNDOFF)


def other_name(name):
    """A joint's name after the exchange: the numbers of two robots change places."""
    return {"1:": "2:", "2:": "1:"}.get(name[:2], name[:2]) + name[2:]


# ---- derivatives


def test_casadi_functions_agree(space, q):
    for name in (*MOTORS, *JACOBIANS):
        function = space.casadi(name)
        assert function.name() == name and function is space.casadi(name) and function.name_in() == ["q"] and function.name_out() == [name]
        word, _, chart = name.partition("_jacobian" if name in JACOBIANS else "_")
        method = getattr(space, f"{word}_jacobian" if name in JACOBIANS else word)
        found = method(q, chart.strip("_")) if chart else method(q)
        close(found, [np.asarray(function(x)).reshape(found.shape[1:]) for x in q], ROUNDOFF)
    assert np.abs(space.absolute_jacobian(q) - space.absolute_jacobian(q, "lie")).max() > 0.01


@pytest.mark.parametrize("name", ["relative", *CHARTS])
def test_twists_are_those_of_independent_poses(space, q, name):
    found = space.relative_twist_jacobian(q[:2]) if name == "relative" else space.absolute_twist_jacobian(q[:2], name)
    close(found, body_twists(relative if name == "relative" else MEANS[name], space, q[:2]), 1e-10)


def test_the_relative_twist_is_the_difference_of_velocities(space, q):
    """p = R2^T (p1 - p2): p' = R2^T (v1 - v2 - w2 x (p1 - p2)), and the angular velocity R2^T (w1 - w2)."""
    first, second = poses(space, q)
    v1, w1, v2, w2 = velocities(space, q)
    between = (first - second)[..., :3, 3, None]
    rates = np.concatenate([v1 - v2 - np.cross(w2, between, axis=-2), w1 - w2], axis=-1)
    rows = np.swapaxes(second[..., :3, :3], -1, -2) @ rates
    expected = np.concatenate(np.split(rows, 2, axis=-1), axis=-2)
    close(space.relative_twist_jacobian(q, "LOCAL_WORLD_ALIGNED"), expected, ROUNDOFF)


def test_the_midpoint_moves_with_the_mean_velocity(space, q):
    v1, _, v2, _ = velocities(space, q)
    close(space.absolute_twist_jacobian(q, frame="LOCAL_WORLD_ALIGNED")[..., :3, :], 0.5 * (v1 + v2), ROUNDOFF)


@pytest.mark.parametrize("kind", ["relative", "absolute"])
def test_frames_and_orders(space, q, kind):
    q, places = q[0], ["e12", "e13", "e23", "e1i", "e2i", "e3i"]
    motor, slopes = getattr(space, kind)(q), getattr(space, f"{kind}_jacobian")(q)
    twist = getattr(space, f"{kind}_twist_jacobian")

    def doubled(a, b):
        return -2.0 * np.array([(a * b)[name] for name in places])

    m = cga.Motor(motor)
    reverse = cga.Multivector((~m).coefficients, m.blades)
    for j in range(space.n):
        dm = cga.Multivector(slopes[:, j], m.blades)
        close(twist(q, order="bivector")[:, j], doubled(reverse, dm), ROUNDOFF)
        close(twist(q, frame="WORLD", order="bivector")[:, j], doubled(dm, reverse), ROUNDOFF)
    for frame in FRAMES:
        rows = twist(q, frame=frame)
        for order in TWIST_ORDERS:
            close(twist(q, frame=frame, order=order), reorder(rows, TWIST_ORDERS, "linear_first", order, -2), 0)


# ---- arms that share joints


def test_a_shared_waist_moves_both_and_nothing_between_them(humanoid, rng):
    q = humanoid.random(rng, 20)
    assert humanoid.n == 9 and humanoid.joint_names[:3] == ("waist_yaw_joint", "waist_roll_joint", "waist_pitch_joint")
    close(humanoid.relative_twist_jacobian(q)[..., :3], 0.0, ROUNDOFF)
    close(humanoid.relative_jacobian(q)[..., :3], 0.0, ROUNDOFF)
    waist = humanoid.first.screws(q[..., humanoid.index[0]])[..., :3]
    for chart in CHARTS:
        close(humanoid.absolute_twist_jacobian(q, chart, "WORLD", "bivector")[..., :3], waist, ROUNDOFF)


def test_arms_of_two_makes(panda, rng):
    """An iiwa14 and a Panda, by casadi alone."""
    iiwa = cga.load_robot("iiwa14").chain("lbr_link_ee")
    space = DualTaskSpace(iiwa, panda)
    assert space.n == 14 and space.joint_names == (*iiwa.joint_names, *panda.joint_names)
    q = next(x for x in space.random(rng, 30) if np.abs(np.asarray(space.casadi("relative")(x))[0, 0]) > 0.2)
    first, second = (np.asarray(chain.casadi("pose")(x)) for chain, x in ((iiwa, q[:7]), (panda, q[7:])))
    motors = {name: pose(np.asarray(space.casadi(name)(q))[:, 0]) for name in MOTORS}
    close(motors["relative"], relative(first, second), ROUNDOFF)
    close(motors["absolute_split"], split(first, second), ROUNDOFF)
    close(motors["absolute_lie"], lie(first, second), ROUNDOFF)


# ---- the point pair, shapes


def test_the_point_pair_leads_from_the_first_end_point_to_the_second(space, q):
    pair = space.point_pair(q)
    first, second = poses(space, q)
    assert isinstance(pair, PointPair)
    close(pair.points, np.stack([first[..., :3, 3], second[..., :3, 3]], axis=-2), ROUNDOFF)
    close(pair.center, pose(space.absolute(q))[..., :3, 3], ROUNDOFF)
    first_point, second_point = (cga.Point(m[..., :3, 3]) for m in (first, second))
    outer = cga.Multivector(first_point.coefficients, first_point.blades) ^ cga.Multivector(second_point.coefficients, second_point.blades)
    expected = np.stack([outer[name] for name in pair.blades], axis=-1)
    close(2.0 * pair.radius[..., None] ** 2 * pair.coefficients, expected, ROUNDOFF)


def test_leading_dimensions(space, rng):
    for shape in ((), (3,), (2, 3), (0,), (2, 0)):
        q = space.random(rng, shape)
        assert q.shape == (*shape, space.n)
        assert space.relative(q).shape == space.absolute(q, "lie").shape == (*shape, 8)
        assert space.relative_jacobian(q).shape == space.absolute_jacobian(q, "lie").shape == (*shape, 8, space.n)
        for frame in FRAMES:
            assert space.relative_twist_jacobian(q, frame).shape == (*shape, 6, space.n)
            assert space.absolute_twist_jacobian(q, "split", frame).shape == (*shape, 6, space.n)
        assert space.point_pair(q).points.shape == (*shape, 2, 3)
    q = space.random(rng, (2, 3))
    for method in (space.absolute, space.absolute_jacobian, space.absolute_twist_jacobian, space.relative_jacobian):
        close(method(q)[1, 2], method(q[1, 2]), ROUNDOFF)
