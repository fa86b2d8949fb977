"""Orders and frames of twists and wrenches, quaternions and dual quaternions: round trips, the algebra's own products, and refusals."""

from functools import partial
from itertools import product

import numpy as np
import pytest

from cga_codegen.algebra import blade_types
from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA
from cga_runtime import conventions, quaternions
from cga_runtime.conventions import FRAMES, TWIST_ORDERS, WRENCH_ORDERS, adjoint, coadjoint, convert_twist, convert_wrench
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.motors import Motor
from cga_runtime.quaternions import DUAL_QUATERNION_ORDERS, QUATERNION_ORDERS, convert_quaternion

close = partial(np.testing.assert_allclose, rtol=0)
TWIST = BladeType("twist", CGA.masks("e12 e13 e23 e1i e2i e3i"))
WRENCH = BladeType("wrench", CGA.masks("e01 e02 e12 e03 e13 e23"))
S = 0.5**0.5
SPECIAL = np.array(  # w x y z: identity, half turns, quarter turns, both signs, nearly a half turn
    [[1, 0, 0, 0], [-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1], [S, 0, S, 0], [-S, 0, 0, S], [1e-10, 0.6, -0.8, 0]]
)


def unit_quaternions(rng, count):
    """w x y z, the special ones first."""
    q = rng.normal(size=(count, 4))
    q[: len(SPECIAL)] = SPECIAL
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def motors(rng, count):
    return quaternions.motor_from_position_quaternion(rng.normal(size=(count, 3)), unit_quaternions(rng, count), "wxyz")


def hamilton(p, q):
    """The product of quaternions w x y z, in vectors."""
    scalar = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(-1, keepdims=True)
    return np.concatenate([scalar, p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])], axis=-1)


# ---- orders


@pytest.mark.parametrize(("convert", "orders"), [(convert_twist, TWIST_ORDERS), (convert_wrench, WRENCH_ORDERS)])
def test_every_pair_of_orders_comes_back_bit_for_bit(convert, orders, rng):
    x, columns = rng.normal(size=(4, 3, 6)), rng.normal(size=(2, 6, 5))
    for source, target, between in product(orders, repeat=3):
        there = convert(x, source, target)
        np.testing.assert_array_equal(convert(there, target, source), x)
        np.testing.assert_array_equal(convert(convert(x, source, between), between, target), there)
        np.testing.assert_array_equal(convert(columns, source, target, axis=-2)[..., 3], convert(columns[..., 3], source, target))
    assert there.flags.writeable


def test_orders_are_those_that_the_papers_and_libraries_write():
    v, w = (1, 2, 3), (4, 5, 6)
    assert convert_twist(v + w, "linear_first", "angular_first").tolist() == [4, 5, 6, 1, 2, 3]
    assert convert_twist(w + v, "angular_first", "bivector").tolist() == [6, -5, 4, 1, 2, 3]
    assert convert_wrench(v + w, "force_first", "moment_first").tolist() == [4, 5, 6, 1, 2, 3]
    assert convert_wrench(v + w, "force_first", "bivector").tolist() == [1, 2, 6, 3, -5, 4]
    assert convert_quaternion((0.1, 0.5, 0.7, 0.5), "wxyz", "xyzw").tolist() == [0.5, 0.7, 0.5, 0.1]
    assert convert_quaternion((0.1, 0.5, 0.7, 0.5), "wxyz", "rotor").tolist() == [0.1, -0.5, 0.7, -0.5]
    hessian = np.arange(6.0)[:, None, None] * np.ones((2, 1, 4, 4))
    assert convert_twist(hessian, "linear_first", "bivector", axis=-3)[1, :, 0, 3].tolist() == [5, -4, 3, 0, 1, 2]


@pytest.mark.parametrize(("source", "target"), list(product(QUATERNION_ORDERS, repeat=2)))
def test_quaternions_keep_their_sign_in_every_order(source, target, rng):
    q = convert_quaternion(unit_quaternions(rng, 30), "wxyz", source)
    there = convert_quaternion(q, source, target)
    np.testing.assert_array_equal(convert_quaternion(there, target, source), q)
    np.testing.assert_array_equal(convert_quaternion(-q, source, target), -there)
    rotation = quaternions.matrix_from_quaternion(q, source)
    close(quaternions.matrix_from_quaternion(-there, target), rotation, atol=0)
    back = quaternions.quaternion_from_matrix(rotation, target)
    assert (convert_quaternion(back, target, "wxyz")[:, 0] >= 0).all()
    close(np.abs((back * there).sum(-1)), 1.0, atol=1e-14)
    close(np.minimum(np.abs(back - there).max(-1), np.abs(back + there).max(-1)), 0.0, atol=1e-14)


@pytest.mark.parametrize("order", QUATERNION_ORDERS)
def test_position_and_quaternion_come_back_from_the_motor(order, rng):
    position, q = rng.normal(size=(30, 3)), convert_quaternion(unit_quaternions(rng, 30), "wxyz", order)
    motor = quaternions.motor_from_position_quaternion(position, q, order)
    place, turn = quaternions.position_quaternion_from_motor(motor, order)
    close(place, position, atol=1e-14)
    np.testing.assert_array_equal(turn, q)
    pose = motor.pose()
    close(pose[:, :3, 3], position, atol=1e-14)
    close(pose[:, :3, :3], quaternions.matrix_from_quaternion(q, order), atol=1e-14)
    same = Motor.from_pose(pose).coefficients * np.where(convert_quaternion(q, order, "wxyz")[:, :1] < 0, -1, 1)
    upright = np.abs(convert_quaternion(q, order, "wxyz")[:, 0]) > 1e-9  # a half turn has two motors with scalar part 0
    close(same[upright], motor.coefficients[upright], atol=1e-14)
    assert quaternions.motor_from_position_quaternion(position[:, None], q, order).coefficients.shape == (30, 30, 8)


# ---- against the algebra


def test_power_and_motion_are_those_of_the_algebra(rng):
    twists, wrenches, moved = rng.normal(size=(20, 6)), rng.normal(size=(20, 6)), motors(rng, 20)
    by_adjoint = (adjoint(moved, "bivector") @ twists[..., None])[..., 0]
    by_coadjoint = (coadjoint(moved, "bivector") @ wrenches[..., None])[..., 0]
    watts = conventions.power(twists, wrenches, "bivector", "bivector")
    for k in range(20):
        v, w = Multivector(TWIST, tuple(twists[k])), Multivector(WRENCH, tuple(wrenches[k]))
        m = Multivector(blade_types.MOTOR, tuple(moved.coefficients[k]))
        assert -(v * w).coefficient(0) == pytest.approx(watts[k], abs=1e-14)
        close((m * v * ~m).project(TWIST).coefficients, by_adjoint[k], atol=1e-14)
        # a wrench moves to M W ~M less the blades of ei, which do no work (the spec's proj)
        close((m * w * ~m).project(WRENCH).coefficients, by_coadjoint[k], atol=1e-14)


def test_dual_quaternions_multiply_as_motors_do(rng):
    first, second = motors(rng, 40), motors(rng, 40)
    a, b = (quaternions.dual_quaternion_from_motor(m, "real_dual_wxyz") for m in (first, second))
    expected = np.concatenate(
        [hamilton(a[:, :4], b[:, :4]), hamilton(a[:, :4], b[:, 4:]) + hamilton(a[:, 4:], b[:, :4])], axis=-1
    )  # (r + eps d) (s + eps e) = r s + eps (r e + d s)
    close(quaternions.dual_quaternion_from_motor(first * second, "real_dual_wxyz"), expected, atol=1e-14)
    position, q = rng.normal(size=(40, 3)), unit_quaternions(rng, 40)
    half = 0.5 * hamilton(np.concatenate([np.zeros((40, 1)), position], axis=1), q)
    motor = quaternions.motor_from_dual_quaternion(np.concatenate([q, half], axis=1), "real_dual_wxyz")
    close(motor.coefficients, quaternions.motor_from_position_quaternion(position, q, "wxyz").coefficients, atol=1e-14)


@pytest.mark.parametrize("order", DUAL_QUATERNION_ORDERS)
def test_dual_quaternions_come_back(order, rng):
    motor = motors(rng, 30)
    dual = quaternions.dual_quaternion_from_motor(motor.coefficients, order)
    np.testing.assert_array_equal(quaternions.motor_from_dual_quaternion(dual, order).coefficients, motor.coefficients)
    np.testing.assert_array_equal(quaternions.motor_from_dual_quaternion(-dual, order).coefficients, -motor.coefficients)
    scale = np.where(np.arange(30) % 2, 1e200, 3.0)[:, None]
    again = quaternions.motor_from_dual_quaternion(dual * scale, order, normalize=True)
    close(again.coefficients, motor.coefficients, atol=1e-14)
    # times a dual number s + eps e: the parallel part of d, which normalising takes away
    stretched = quaternions.dual_quaternion_from_motor(motor, "real_dual_wxyz") * 2.0
    stretched[:, 4:] += 0.7 * stretched[:, :4]
    given = conventions.reorder(stretched, DUAL_QUATERNION_ORDERS, "real_dual_wxyz", order)
    close(quaternions.motor_from_dual_quaternion(given, order, normalize=True).coefficients, motor.coefficients, atol=1e-14)


# ---- frames


@pytest.mark.parametrize(("source", "target"), list(product(FRAMES, repeat=2)))
def test_frames_keep_power_and_come_back(source, target, rng):
    pose, twist, wrench, jacobian = motors(rng, 20), rng.normal(size=(20, 6)), rng.normal(size=(20, 6)), rng.normal(size=(20, 6, 5))
    for twist_order, wrench_order in product(TWIST_ORDERS, WRENCH_ORDERS):
        v = conventions.twist_in_frame(twist, pose, source, target, order=twist_order)
        f = conventions.wrench_in_frame(wrench, pose, source, target, order=wrench_order)
        before, after = (conventions.power(*pair, twist_order, wrench_order) for pair in ((twist, wrench), (v, f)))
        close(after, before, atol=1e-13)
        close(conventions.twist_in_frame(v, pose, target, source, order=twist_order), twist, atol=1e-14)
        close(conventions.wrench_in_frame(f, pose, target, source, order=wrench_order), wrench, atol=1e-14)
        columns = conventions.jacobian_in_frame(jacobian, pose, source, target, order=twist_order)
        one = conventions.twist_in_frame(jacobian[..., 2], pose, source, target, order=twist_order)
        close(columns[..., 2], one, atol=1e-14)
    if source == target and source != "LOCAL":
        np.testing.assert_array_equal(v, twist)


def test_aligned_axes_do_not_mix_in_the_position():
    far = np.eye(4)
    far[:3, 3] = 1e9, -3e8, 7e7
    far[:3, :3] = quaternions.matrix_from_quaternion((0.5, -0.5, 0.1, 0.7), "wxyz", normalize=True)
    twist = np.arange(1.0, 7.0)
    aligned = conventions.twist_in_frame(twist, far, "LOCAL", "LOCAL_WORLD_ALIGNED", order="linear_first")
    close(aligned, np.concatenate([far[:3, :3] @ twist[:3], far[:3, :3] @ twist[3:]]), atol=1e-14)


def test_adjoints_are_inverse_transposes_and_take_the_pose_as_given():
    pose = np.array([[0, -1, 0, 2], [1, 0, 0, 3], [0, 0, 1, 4], [0, 0, 0, 1]])
    ad, coad = adjoint(pose, "linear_first"), coadjoint(pose, "force_first")
    assert ad[:3, 3:].tolist() == [[-4, 0, 3], [0, -4, -2], [2, 3, 0]]  # [p] R by hand
    np.testing.assert_array_equal(coad @ ad.T, np.eye(6))
    np.testing.assert_array_equal(adjoint(pose, "angular_first")[3:, :3], ad[:3, 3:])
    close(adjoint(Motor.from_pose(pose), "linear_first"), ad, atol=1e-14)


def test_hat_and_vee(rng):
    for order in TWIST_ORDERS:
        twist = rng.normal(size=(3, 2, 6))
        np.testing.assert_array_equal(conventions.vee(conventions.hat(twist, order), order), twist)
    assert conventions.hat((1, 2, 3, 4, 5, 6), "linear_first").tolist() == [[0, -6, 5, 1], [6, 0, -4, 2], [-5, 4, 0, 3], [0, 0, 0, 0]]


# ---- refusals

E4 = np.eye(4)
DQ = np.array([1.0, 0, 0, 0, 0.5, 0, 0, 0])
REFUSED = [
    (lambda: convert_twist(np.ones(5), "bivector", "bivector"), WrongSizeError, r"twist: shape \(5,\) given, 6 components along axis -1"),
    (lambda: convert_twist(np.ones(6), "bivector", "bivector", axis=-2), WrongSizeError, r"twist: shape \(6,\) given, 6 .* axis -2"),
    (lambda: convert_twist(np.ones(6), "pluecker", "bivector"), UnknownNameError, "order 'pluecker'; known: linear_first, angular_"),
    (lambda: convert_twist(np.ones(6), "force_first", "bivector"), UnknownNameError, "unknown order 'force_first'"),
    (lambda: convert_wrench(np.ones(6), "force_first", "linear_first"), UnknownNameError, "known: force_first, moment_first, bivector"),
    (lambda: convert_wrench([0, 0, np.nan, 0, 0, 0], "bivector", "bivector"), NotFiniteError, "wrench holds NaN or infinity"),
    (lambda: conventions.power(np.ones((2, 6)), np.ones((3, 6)), "bivector", "bivector"), WrongSizeError, "twist and wrench: batch"),
    (lambda: adjoint(2 * E4, "bivector"), DegenerateError, "pose: its 3x3 block is not a rotation"),
    (lambda: coadjoint(np.eye(3), "bivector"), WrongSizeError, r"pose: shape \(3, 3\) given"),
    (lambda: adjoint(E4, "force_first"), UnknownNameError, "unknown order 'force_first'"),
    (
        lambda: conventions.twist_in_frame(np.ones(6), E4, "local", "WORLD", order="bivector"),
        UnknownNameError,
        "unknown frame of reference 'local'; known: LOCAL, WORLD, LOCAL_WORLD_ALIGNED",
    ),
    (lambda: conventions.jacobian_in_frame(np.ones(6), E4, "LOCAL", "WORLD", order="bivector"), WrongSizeError, "Jacobian: shape"),
    (
        lambda: conventions.wrench_in_frame(np.ones((2, 6)), np.stack([E4] * 3), "LOCAL", "WORLD", order="bivector"),
        WrongSizeError,
        r"pose and wrench: batch dimensions \(3,\), \(2,\)",
    ),
    (lambda: conventions.vee(E4, "bivector"), DegenerateError, "A is not skew, A \\+ A\\^T is off by 2.0e\\+00"),
    (lambda: conventions.vee(np.diag([0, 0, 0, 1]), "bivector"), DegenerateError, "last row must be 0 0 0 0"),
    (lambda: convert_quaternion((1, 0, 0), "wxyz", "xyzw"), WrongSizeError, r"quaternion: shape \(3,\) given"),
    (lambda: convert_quaternion((1, 0, 0, 0), "xyz", "xyzw"), UnknownNameError, "unknown order 'xyz'; known: wxyz, xyzw, rotor"),
    (lambda: convert_quaternion((1.001, 0, 0, 0), "wxyz", "xyzw"), DegenerateError, "squared norm is off 1 by 2.0e-03 .*normalize=True"),
    (lambda: convert_quaternion((1 + 1e-9, 0, 0, 0), "wxyz", "xyzw"), DegenerateError, "squared norm is off 1 by 2.0e-09"),
    (lambda: convert_quaternion(np.zeros(4), "wxyz", "xyzw", normalize=True), DegenerateError, "quaternion: its direction is zero"),
    (lambda: quaternions.quaternion_from_matrix(np.diag([1, 1, -1]), "wxyz"), DegenerateError, "a reflection"),
    (lambda: quaternions.quaternion_from_matrix(np.eye(4), "wxyz"), WrongSizeError, r"rotation matrix: shape \(4, 4\) given"),
    (lambda: quaternions.quaternion_from_matrix(np.eye(3), "zyx"), UnknownNameError, "unknown order 'zyx'"),
    (
        lambda: quaternions.motor_from_position_quaternion(np.ones((2, 3)), np.tile((1, 0, 0, 0), (3, 1)), "wxyz"),
        WrongSizeError,
        "position and quaternion: batch",
    ),
    (lambda: quaternions.motor_from_position_quaternion((0, 0, np.inf), (1, 0, 0, 0), "wxyz"), NotFiniteError, "position holds NaN"),
    (lambda: quaternions.position_quaternion_from_motor(np.ones(8), "wxyz"), DegenerateError, "M ~M must be 1"),
    (lambda: quaternions.motor_from_dual_quaternion(DQ, "real_dual_wxyz"), DegenerateError, r"r\.r is off 1 by 0.0e\+00, r\.d .* 3.3e-01"),
    (lambda: quaternions.motor_from_dual_quaternion(2 * DQ, "motor"), DegenerateError, r"dual quaternion: r\.r is off 1 by 3.0e\+00"),
    (lambda: quaternions.motor_from_dual_quaternion(DQ, "wxyz"), UnknownNameError, "known: real_dual_wxyz, real_dual_xyzw, motor"),
    (lambda: quaternions.dual_quaternion_from_motor("none", "motor"), WrongSizeError, "motor: not an array of numbers"),
]


@pytest.mark.parametrize(("make", "error", "message"), REFUSED)
def test_refusals_say_what_is_wrong(make, error, message):
    with pytest.raises(error, match=message):
        make()


def test_what_is_nearly_unit_passes_as_it_is_and_normalising_is_asked_for():
    nearly = np.array([1 + 4e-10, 0, 0, 0])
    assert convert_quaternion(nearly, "wxyz", "wxyz").tolist() == nearly.tolist()
    assert convert_quaternion((0, 3, 0, 4), "wxyz", "xyzw", normalize=True).tolist() == [0.6, 0, 0.8, 0]
