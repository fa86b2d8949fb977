"""What an inverse kinematics solver drives to zero: the error of a pose or the distance from a primitive, with exact Jacobians.

The error of a pose is e = log(~M_target M(q)) (paper B, eqs. 32-36) in its decoupled form M = T R, log M = (t, phi): the translation t of
the end frame and its rotation vector phi, both seen from the target frame, so that |e|^2 = distance^2 + angle^2. Its rates are
t' = R v and phi' = J_r(phi)^-1 w with the end frame's own velocities (v, w). The screw logarithm, whose translation part also has phi in
it, needs a tenth fewer iterations and more arithmetic for each, and its length is no distance.

A point meets a primitive where its distance from it is zero: components of x - foot(x), in metres, that have gradients of length 1.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime import exp_log
from cga_runtime.coordinates import Array, dot, norm, stack
from cga_runtime.elements import Circle, Line, Motor, Plane, Point, PointPair, Sphere
from cga_runtime.errors import DegenerateError, UnknownNameError, WrongSizeError
from cga_runtime.kernels import products
from cga_runtime.motors import REVERSE
from cga_runtime.robot import Chain
from cga_runtime.smooth import NUMPY
from cga_runtime.solve.levenberg_marquardt import Evaluate, Rows

IkTarget = ArrayLike | Motor | Point | PointPair | Line | Circle | Plane | Sphere

SMALL = 1e-24
"""Added to the square of a length that is divided by: the quotients stay finite at zero and exact elsewhere."""
FARTHEST = 1e50
"""Largest coordinate of a target (m)."""


@dataclass(frozen=True)
class Goal:
    """A batch of targets with their weighted residuals.

    error: what results are judged by; its smallest length is a least-squares solution. evaluate: what a search drives to zero, the error
    itself or other equations of the same length.
    """

    batch: tuple[int, ...]
    evaluate: Evaluate
    error: Evaluate


def goal(arm: Chain, target: IkTarget, weights: tuple[float, float], shortest: bool = True) -> Goal:
    """The goal of poses (..., 4, 4), a Motor, or a primitive on which the end frame's origin shall lie.

    weights: of lengths (1/m) and of angles (1/rad). shortest: whether the error of a pose turns the short way round; otherwise it turns by
    the angle in [0, 2 pi] that the two motors' signs imply. Raises what Motor.from_pose raises, UnknownNameError for another type,
    DegenerateError for coordinates beyond 1e50 m, WrongSizeError for a primitive without weight.
    """
    measure = MEASURES.get(type(target))
    if measure is not None:
        if weights[0] == 0.0:
            raise WrongSizeError(f"weights: {weights} given, but lengths are all that a {type(target).__name__} measures")
        return _primitive_goal(arm, target, measure, weights[0])
    if not isinstance(target, Motor):
        try:
            array = np.asarray(target)
        except ValueError:  # rows of different lengths
            array = np.empty(0, dtype=object)
        if array.dtype == object:
            known = ("poses (..., 4, 4)", "Motor", *(kind.__name__ for kind in MEASURES))
            raise UnknownNameError("kind of target", type(target).__name__, known)
        target = Motor.from_pose(array)
    return _pose_goal(arm, target, weights, shortest)


def _pose_goal(arm: Chain, target: Motor, weights: tuple[float, float], shortest: bool) -> Goal:
    motors = within_reason(target.coefficients)
    reverse = np.ascontiguousarray((motors.reshape(-1, 8) * REVERSE).T)
    scale = np.repeat(weights, 3)

    def evaluate(rows: Rows, q: Array) -> tuple[Array, Array]:
        error = products().motor_motor(tuple(reverse[:, rows]), tuple(np.ascontiguousarray(arm.motor(q).T)))
        log, rates = split_log(error, shortest)
        rates *= np.reshape(weights, (2, 1, 1))
        twists = arm.jacobian(q, frame="LOCAL")
        jacobian = rates @ twists.reshape(len(q), 2, 3, arm.n)
        return log * scale, jacobian.reshape(twists.shape)

    return Goal(motors.shape[:-1], evaluate, evaluate)


def split_log(motor: tuple[Array, ...], shortest: bool) -> tuple[Array, Array]:
    """Decoupled logarithm (t, phi), (m, 6), of unit motors (8 components (m,)), and the matrices (m, 2, 3, 3) that take the body's
    velocities v, w to its rates t', phi'. Not `shortest`: phi as printed (paper B, eqs. 65-67), up to 2 pi long where the scalar part is
    negative."""
    *plane, tx, ty, tz = exp_log.log(NUMPY, "motor", motor)
    phi, u = np.array(exp_log.vector(plane)), -np.array(exp_log.vector(motor[1:4]))
    r, sine = motor[0], np.sqrt((u * u).sum(axis=0) + 0.25 * SMALL)
    angle = np.sqrt((phi * phi).sum(axis=0) + SMALL)
    cosine = np.abs(r)
    if not shortest:
        phi *= np.where(r < 0.0, 1.0 - 2.0 * math.pi / angle, 1.0)
        angle, cosine = np.where(r < 0.0, 2.0 * math.pi - angle, angle), r
    # t' = R v and phi' = (s + [phi] / 2 + (1 - s) / |phi|^2 phi phi^T) w with s = (|phi| / 2) cot(|phi| / 2); the last factor tends to 1/12
    s = 0.5 * angle * cosine / sine
    near = angle < 1e-4
    outer = np.where(near, 1.0 / 12.0, (1.0 - s) / np.where(near, 1.0, angle * angle))
    linear, angular = (2.0 * r * r - 1.0, 2.0 * r, np.full_like(r, 2.0), u), (s, np.full_like(r, 0.5), outer, phi)
    diagonal, skew, outer, axis = (np.array(pair) for pair in zip(linear, angular, strict=True))
    rates = np.ascontiguousarray(_matrices(diagonal, skew, outer, axis.transpose(1, 0, 2)).transpose(3, 2, 0, 1))
    return np.array([tx, ty, tz, *phi]).T, rates


def _matrices(diagonal: Array, skew: Array, outer: Array, u: Array) -> Array:
    """diagonal 1 + skew [u] + outer u u^T, with [u] x = u cross x, (3, 3, ...) for coefficients (...) and u (3, ...)."""
    out: Array = (outer * u)[:, None] * u
    turned = skew * u
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        out[i, i] += diagonal
        out[i, j] -= turned[k]
        out[j, i] += turned[k]
    return out


Measure = Callable[..., tuple[Array, Array]]
"""Components (m, k) of x - foot(x) and their gradients (m, k, 3), at points x (m, 3) of primitives whose fields are (m, ...)."""


def _primitive_goal(arm: Chain, target: Any, measure: Measure, weight: float) -> Goal:
    batch = target.points.shape[:-2] if isinstance(target, PointPair) else target.center.shape[:-1]
    columns = [getattr(target, field.name) for field in fields(target)]
    flat = [within_reason(column).reshape(-1, *column.shape[len(batch) :]) for column in columns]

    def evaluate(rows: Rows, q: Array) -> tuple[Array, Array]:
        residual, gradient = measure(arm.point(q), *(column[rows] for column in flat))
        return weight * residual, (weight * gradient) @ arm.jacobian(q)[:, :3]

    return Goal(batch, evaluate, evaluate)


def within_reason(numbers: Array) -> Array:
    """The numbers, whose squares and fourth powers must not overflow."""
    largest = np.abs(numbers).max(initial=0.0)
    if largest > FARTHEST:
        raise DegenerateError(f"target: a coordinate of {largest:.1e} m given, at most {FARTHEST:.0e} m is accepted")
    return numbers


def _to_point(x: Array, center: Array) -> tuple[Array, Array]:
    return x - center, np.broadcast_to(np.eye(3), (len(x), 3, 3))


def _to_point_pair(x: Array, points: Array) -> tuple[Array, Array]:
    """The nearer of the two."""
    steps = x[:, None] - points
    second = dot(steps[:, 1], steps[:, 1]) < dot(steps[:, 0], steps[:, 0])
    return _to_point(x, np.where(second[:, None], points[:, 1], points[:, 0]))


def _to_line(x: Array, center: Array, direction: Array) -> tuple[Array, Array]:
    across = np.eye(3) - direction[:, :, None] * direction[:, None, :]
    return (across @ (x - center)[..., None])[..., 0], across


def _to_plane(x: Array, normal: Array, offset: Array) -> tuple[Array, Array]:
    return (dot(normal, x) - offset)[:, None], normal[:, None]


def _to_sphere(x: Array, center: Array, radius: Array) -> tuple[Array, Array]:
    arm, away = _away(x - center)
    return (arm - radius)[:, None], away[:, None]


def _to_circle(x: Array, center: Array, normal: Array, radius: Array) -> tuple[Array, Array]:
    height = dot(normal, x - center)
    arm, away = _away(x - center - height[:, None] * normal)
    return stack(height, arm - radius), np.stack([normal, away], axis=1)


def _away(step: Array) -> tuple[Array, Array]:
    """Length and direction; at zero, where there is none, a direction of length zero."""
    length = norm(step)
    return length, step / np.sqrt(length * length + SMALL)[:, None]


MEASURES: dict[type, Measure] = {
    Point: _to_point,
    PointPair: _to_point_pair,
    Line: _to_line,
    Circle: _to_circle,
    Plane: _to_plane,
    Sphere: _to_sphere,
}
