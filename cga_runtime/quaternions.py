"""Quaternions and dual quaternions in the orders of other libraries, to and from rotors, rotation matrices and motors (paper B, eqs. 5-9).

With i = -e23, j = e13, k = -e12 and eps = -e123i, products of quaternions are products of rotors, and products of dual quaternions
r + eps d, d = t r / 2 (t the position as a quaternion without scalar part), are products of motors. Conversions keep the sign: q and -q
are the same rotation, M and -M the same motion. Leading batch dimensions everywhere, and they broadcast. Orders are always named:

    rotations   wxyz (MuJoCo, Drake, DQ Robotics), xyzw (Pinocchio, Eigen, ROS, scipy), rotor (1 e12 e13 e23)
    motions     real_dual_wxyz (DQ Robotics: r then d, scalars first), real_dual_xyzw (scalars last),
                motor (1 e12 e13 e23 e1i e2i e3i e123i)

What is not unit (squared norm off 1 by more than 1e-9) is refused with DegenerateError; normalize=True divides by the norm instead.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.conventions import Order, reorder
from cga_runtime.coordinates import Array, dot, norm, one_batch, parts, read, stack, times, unit
from cga_runtime.errors import DegenerateError
from cga_runtime.kernels import products
from cga_runtime.motors import RIGID, Motor

QUATERNION_ORDERS: dict[str, Order] = {
    "wxyz": ((0, 1, 2, 3), (1, 1, 1, 1)),
    "xyzw": ((1, 2, 3, 0), (1, 1, 1, 1)),
    "rotor": ((0, 3, 2, 1), (1, -1, 1, -1)),  # 1 e12 e13 e23 = w -z y -x
}
DUAL_QUATERNION_ORDERS: dict[str, Order] = {
    "real_dual_wxyz": ((0, 1, 2, 3, 4, 5, 6, 7), (1, 1, 1, 1, 1, 1, 1, 1)),
    "real_dual_xyzw": ((1, 2, 3, 0, 5, 6, 7, 4), (1, 1, 1, 1, 1, 1, 1, 1)),
    "motor": ((0, 3, 2, 1, 5, 6, 7, 4), (1, -1, 1, -1, -1, -1, -1, -1)),
}


def convert_quaternion(quaternion: ArrayLike, source: str, target: str, *, normalize: bool = False) -> Array:
    """A unit quaternion or rotor in another order, (..., 4), its sign kept.

    Raises UnknownNameError, WrongSizeError, NotFiniteError, DegenerateError (not unit; with normalize: zero).
    """
    given = read(quaternion, "quaternion", 4)
    if normalize:
        given = unit(given, "quaternion")
    error = np.abs(dot(given, given) - 1.0).max(initial=0.0)
    if error > RIGID:
        raise DegenerateError(
            f"quaternion: its squared norm is off 1 by {error:.1e} (at most {RIGID:.0e}); normalize=True divides by the norm"
        )
    return reorder(given, QUATERNION_ORDERS, source, target)


def matrix_from_quaternion(quaternion: ArrayLike, order: str, *, normalize: bool = False) -> Array:
    """The rotation matrix (..., 3, 3) of a unit quaternion or rotor. Raises as `convert_quaternion` does."""
    return motor_from_position_quaternion(np.zeros(3), quaternion, order, normalize=normalize).pose()[..., :3, :3]


def quaternion_from_matrix(rotation: ArrayLike, order: str) -> Array:
    """The quaternion or rotor (..., 4) of a rotation matrix, with scalar part >= 0. Raises DegenerateError for what is no rotation."""
    turn = read(rotation, "rotation matrix", 3, 3)
    pose = np.zeros((*turn.shape[:-2], 4, 4))
    pose[..., :3, :3], pose[..., 3, 3] = turn, 1.0
    return reorder(Motor.from_pose(pose).coefficients[..., :4], QUATERNION_ORDERS, "rotor", order)


def motor_from_position_quaternion(position: ArrayLike, quaternion: ArrayLike, order: str, *, normalize: bool = False) -> Motor:
    """The motor of a position (m), (..., 3), and a unit quaternion, (..., 4), whose sign it keeps. Raises as `convert_quaternion` does."""
    place = read(position, "position", 3)
    rotor = convert_quaternion(quaternion, order, "rotor", normalize=normalize)
    one_batch("position and quaternion", place.shape[:-1], rotor.shape[:-1])
    translator = stack(1.0, *parts(-0.5 * place))
    return Motor(stack(*products().translator_rotor(parts(translator), parts(rotor))))


def position_quaternion_from_motor(motor: ArrayLike | Motor, order: str) -> tuple[Array, Array]:
    """Position (m), (..., 3), and quaternion (..., 4), with the sign of the motor. Raises UnknownNameError, and what Motor raises."""
    coefficients = _coefficients(motor)
    position = stack(*products().motor_origin_position(parts(coefficients)))
    return position, reorder(coefficients[..., :4], QUATERNION_ORDERS, "rotor", order)


def motor_from_dual_quaternion(dual_quaternion: ArrayLike, order: str, *, normalize: bool = False) -> Motor:
    """The motor of a unit dual quaternion (..., 8), its sign kept.

    Raises UnknownNameError, WrongSizeError, NotFiniteError, DegenerateError (r.r not 1 or r.d not 0; with normalize: r zero).
    """
    given = reorder(read(dual_quaternion, "dual quaternion", 8), DUAL_QUATERNION_ORDERS, order, "real_dual_wxyz")
    real, dual = given[..., :4], given[..., 4:]
    if normalize:  # by the dual number |r| + eps r.d / |r|
        direction = unit(real, "dual quaternion")
        dual = times(1.0 / dot(direction, real), dual)
        real, dual = direction, dual - times(dot(direction, dual), direction)
    length = np.abs(dot(real, real) - 1.0).max(initial=0.0)
    mixed = np.abs(dot(real, dual) / (1.0 + norm(dual))).max(initial=0.0)
    if max(length, mixed) > RIGID:
        raise DegenerateError(
            f"dual quaternion: r.r is off 1 by {length:.1e}, r.d / (1 + |d|) off 0 by {mixed:.1e} (at most {RIGID:.0e}); "
            "normalize=True divides by the norm"
        )
    return Motor(reorder(np.concatenate([real, dual], axis=-1), DUAL_QUATERNION_ORDERS, "real_dual_wxyz", "motor"))


def dual_quaternion_from_motor(motor: ArrayLike | Motor, order: str) -> Array:
    """The unit dual quaternion (..., 8) of a motor, with its sign. Raises UnknownNameError, and what Motor raises."""
    return reorder(_coefficients(motor), DUAL_QUATERNION_ORDERS, "motor", order)


def _coefficients(motor: ArrayLike | Motor) -> Array:
    return motor.coefficients if isinstance(motor, Motor) else Motor(read(motor, "motor", 8)).coefficients
