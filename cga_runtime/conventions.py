"""Twists and wrenches in the orders and frames of other libraries: converters, adjoints, power (paper B, eqs. 27-30; Pinocchio's frames).

A twist is the pair of a linear velocity v (m/s) and an angular velocity w (rad/s), a wrench that of a force f (N) and a moment m (N m);
v is the velocity of the point of the body at the origin of the frame in which the twist is written, m is taken about that origin.
Leading batch dimensions everywhere, and they broadcast. Orders and frames are always named:

    twist orders    linear_first v w (Pinocchio), angular_first w v (Drake, RBDL, Featherstone), bivector e12 e13 e23 e1i e2i e3i
    wrench orders   force_first f m (Pinocchio, ROS), moment_first m f (Drake, RBDL, Featherstone), bivector e01 e02 e12 e03 e13 e23
    frames          LOCAL (axes and origin of the body's frame), WORLD (of the world), LOCAL_WORLD_ALIGNED (axes of the world, origin of
                    the body's frame)

A pose is a homogeneous matrix (..., 4, 4), or a Motor: that of the frame in the world.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, one_batch, parts, read, stack
from cga_runtime.errors import DegenerateError, UnknownNameError, WrongSizeError
from cga_runtime.motors import RIGID, Motor

Order = tuple[tuple[int, ...], tuple[int, ...]]
"""Which component of a table's first order comes where, and its sign."""

FRAMES = ("LOCAL", "WORLD", "LOCAL_WORLD_ALIGNED")
TWIST_ORDERS: dict[str, Order] = {
    "linear_first": ((0, 1, 2, 3, 4, 5), (1, 1, 1, 1, 1, 1)),
    "angular_first": ((3, 4, 5, 0, 1, 2), (1, 1, 1, 1, 1, 1)),
    "bivector": ((5, 4, 3, 0, 1, 2), (1, -1, 1, 1, 1, 1)),  # e12 e13 e23 e1i e2i e3i = w3 -w2 w1 v1 v2 v3
}
WRENCH_ORDERS: dict[str, Order] = {
    "force_first": ((0, 1, 2, 3, 4, 5), (1, 1, 1, 1, 1, 1)),
    "moment_first": ((3, 4, 5, 0, 1, 2), (1, 1, 1, 1, 1, 1)),
    "bivector": ((0, 1, 5, 2, 4, 3), (1, 1, 1, 1, -1, 1)),  # e01 e02 e12 e03 e13 e23 = f1 f2 m3 f3 -m2 m1
}


def reorder(components: Array, orders: Mapping[str, Order], source: str, target: str, axis: int = -1) -> Array:
    """Components along an axis, given in the order `source` of a table, in its order `target`. Raises UnknownNameError."""
    for name in (source, target):
        if name not in orders:
            raise UnknownNameError("order", name, orders)
    (given, given_signs), (wanted, wanted_signs) = orders[source], orders[target]
    places = [given.index(place) for place in wanted]
    signs = np.array([given_signs[place] * sign for place, sign in zip(places, wanted_signs, strict=True)], dtype=components.dtype)
    shape = [1] * components.ndim
    shape[axis] = len(places)
    return np.asarray(np.take(components, places, axis=axis) * signs.reshape(shape))


def convert_twist(twist: ArrayLike, source: str, target: str, axis: int = -1) -> Array:
    """A twist in another order, (..., 6). axis: where the six components stand (-2 for a Jacobian, -3 for a Hessian).

    Raises UnknownNameError, WrongSizeError, NotFiniteError.
    """
    return reorder(_six(twist, "twist", axis), TWIST_ORDERS, source, target, axis)


def convert_wrench(wrench: ArrayLike, source: str, target: str, axis: int = -1) -> Array:
    """A wrench in another order, (..., 6). axis, errors: as for `convert_twist`."""
    return reorder(_six(wrench, "wrench", axis), WRENCH_ORDERS, source, target, axis)


def power(twist: ArrayLike, wrench: ArrayLike, twist_order: str, wrench_order: str) -> Array:
    """v.f + w.m = -<V W>_0 (W), (...), of a twist and a wrench written in one frame."""
    vw, fm = convert_twist(twist, twist_order, "linear_first"), convert_wrench(wrench, wrench_order, "force_first")
    one_batch("twist and wrench", vw.shape[:-1], fm.shape[:-1])
    return dot(vw, fm)


# ---- change of frame


def adjoint(pose: ArrayLike | Motor, order: str) -> Array:
    """Ad, (..., 6, 6): Ad V is the twist V of the posed frame written in the world, M V ~M. order: that of its rows and columns.

    In linear_first it is Pinocchio's SE3.action, [[R, [p] R], [0, R]]. Raises UnknownNameError, WrongSizeError, NotFiniteError,
    DegenerateError (no rigid motion).
    """
    return _adjoint(_matrix(pose), order)


def coadjoint(pose: ArrayLike | Motor, order: str) -> Array:
    """Ad^-T, (..., 6, 6): carries a wrench of the posed frame to the world, so that power stays. order: that of its rows and columns.

    In force_first it is Pinocchio's dual action, [[R, 0], [[p] R, R]]. Raises as `adjoint` does.
    """
    return _coadjoint(_matrix(pose), order)


def twist_in_frame(twist: ArrayLike, pose: ArrayLike | Motor, source: str, target: str, *, order: str) -> Array:
    """The twist (..., 6) of a frame with the given pose, written in another of the FRAMES. Raises as `adjoint` does."""
    return jacobian_in_frame(read(twist, "twist", 6)[..., None], pose, source, target, order=order)[..., 0]


def wrench_in_frame(wrench: ArrayLike, pose: ArrayLike | Motor, source: str, target: str, *, order: str) -> Array:
    """The wrench (..., 6) on a frame with the given pose, written in another of the FRAMES. Raises as `adjoint` does."""
    column = read(wrench, "wrench", 6)[..., None]
    return _product(_coadjoint(_passage(pose, source, target), order), column, "wrench")[..., 0]


def jacobian_in_frame(jacobian: ArrayLike, pose: ArrayLike | Motor, source: str, target: str, *, order: str) -> Array:
    """The Jacobian (..., 6, n) of a frame with the given pose, written in another of the FRAMES. Raises as `adjoint` does."""
    columns = _six(jacobian, "Jacobian", -2)
    return _product(_adjoint(_passage(pose, source, target), order), columns, "twist or Jacobian")


# ---- twists as matrices


def hat(twist: ArrayLike, order: str) -> Array:
    """The matrix [[ [w], v ], [0, 0]] of a twist, (..., 4, 4): with the pose T, dT/dt = T hat(LOCAL twist) = hat(WORLD twist) T."""
    v1, v2, v3, w1, w2, w3 = parts(convert_twist(twist, order, "linear_first"))
    o = np.zeros_like(w1)
    return np.stack([stack(o, -w3, w2, v1), stack(w3, o, -w1, v2), stack(-w2, w1, o, v3), stack(o, o, o, o)], axis=-2)


def vee(matrix: ArrayLike, order: str) -> Array:
    """The twist (..., 6) of its matrix, the inverse of `hat`.

    Raises DegenerateError where the 3x3 block is not skew or the last row not zero, UnknownNameError, WrongSizeError, NotFiniteError.
    """
    given = read(matrix, "twist matrix", 4, 4)
    block = given[..., :3, :3]
    size = np.maximum(1.0, np.abs(block).max(axis=(-1, -2), keepdims=True))
    error = (np.abs(block + np.swapaxes(block, -1, -2)) / size).max(initial=0.0)
    if error > RIGID:
        raise DegenerateError(f"twist matrix: its 3x3 block A is not skew, A + A^T is off by {error:.1e} of its size (at most {RIGID:.0e})")
    if given[..., 3, :].any():
        raise DegenerateError("twist matrix: its last row must be 0 0 0 0")
    skew = 0.5 * (block - np.swapaxes(block, -1, -2))
    twist = stack(*parts(given[..., :3, 3]), skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0])
    return reorder(twist, TWIST_ORDERS, "linear_first", order)


# ---- what these stand on


def _six(values: ArrayLike, what: str, axis: int) -> Array:
    array = read(values, what)
    if not -array.ndim <= axis < array.ndim or array.shape[axis] != 6:
        raise WrongSizeError(f"{what}: shape {array.shape} given, 6 components along axis {axis} needed")
    return array


def _matrix(pose: ArrayLike | Motor) -> Array:
    if isinstance(pose, Motor):
        return pose.pose()
    Motor.from_pose(pose)  # refuses what is no rigid motion; the entries are then taken as given
    return read(pose, "pose", 4, 4)


def _passage(pose: ArrayLike | Motor, source: str, target: str) -> Array:
    """The pose of the frame `source` in the frame `target`, (..., 4, 4)."""
    matrix = _matrix(pose)
    turn, place = matrix[..., :3, :3], matrix[..., :3, 3]
    straight, origin = np.eye(3), np.zeros(3)
    in_world = dict(zip(FRAMES, [(turn, place), (straight, origin), (straight, place)], strict=True))
    for name in (source, target):
        if name not in in_world:
            raise UnknownNameError("frame of reference", name, FRAMES)
    (source_turn, source_place), (target_turn, target_place) = in_world[source], in_world[target]
    back = np.swapaxes(target_turn, -1, -2)
    result = np.zeros_like(matrix)
    result[..., 3, 3] = 1.0
    result[..., :3, :3] = back @ source_turn
    result[..., :3, 3] = (back @ (source_place - target_place)[..., None])[..., 0]  # exactly zero where both have one origin
    return result


def _adjoint(matrix: Array, order: str) -> Array:
    return _in_order(matrix, (slice(0, 3), slice(3, 6)), TWIST_ORDERS, "linear_first", order)


def _coadjoint(matrix: Array, order: str) -> Array:
    return _in_order(matrix, (slice(3, 6), slice(0, 3)), WRENCH_ORDERS, "force_first", order)


def _in_order(matrix: Array, corner: tuple[slice, slice], orders: Mapping[str, Order], first: str, order: str) -> Array:
    """R on the diagonal and [p] R in one corner, with rows and columns in the order asked for."""
    turn, place = matrix[..., :3, :3], matrix[..., :3, 3]
    result = np.zeros((*matrix.shape[:-2], 6, 6))
    result[..., :3, :3] = result[..., 3:, 3:] = turn
    result[..., corner[0], corner[1]] = np.cross(place[..., None, :], np.swapaxes(turn, -1, -2)).swapaxes(-1, -2)  # p x each column
    return reorder(reorder(result, orders, first, order, -2), orders, first, order, -1)


def _product(matrix: Array, columns: Array, what: str) -> Array:
    one_batch(f"pose and {what}", matrix.shape[:-2], columns.shape[:-2])
    return np.asarray(matrix @ columns)
