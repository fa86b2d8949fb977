"""Independent poses of two arms: matrices and scipy's rotations, no motors. Shapes (..., 4, 4) and, of rates, (..., rows, n)."""

import numpy as np
from scipy.spatial.transform import Rotation

STENCIL = ((1, 3 / 4), (2, -3 / 20), (3, 1 / 60))
"""Central differences of sixth order."""
STEP = 0.01


def poses(space, q):
    """End poses by the chains' own matrices."""
    return [chain.pose(q[..., place]) for chain, place in zip((space.first, space.second), space.index, strict=True)]


def rotations(*matrices):
    return [Rotation.from_matrix(m[..., :3, :3]) for m in matrices]


def turned(space, q):
    """Angle between the two end frames."""
    first, second = rotations(*poses(space, q))
    return (second.inv() * first).magnitude()


def relative(first, second):
    return np.linalg.inv(second) @ first


def split(first, second):
    """Midpoint and half rotation."""
    shape = first.shape
    turns = [Rotation.from_matrix(m[..., :3, :3].reshape(-1, 3, 3)) for m in (first, second)]
    result = np.array(second)
    result[..., :3, 3] = 0.5 * (first[..., :3, 3] + second[..., :3, 3])
    result[..., :3, :3] = (
        (turns[1] * Rotation.from_rotvec(0.5 * (turns[1].inv() * turns[0]).as_rotvec())).as_matrix().reshape(*shape[:-2], 3, 3)
    )
    return result


def lie(first, second):
    """Half of the screw motion, from its axis: angle a and slide d about the unit vector n through the point c."""
    between = relative(first, second)
    shift = between[..., :3, 3]
    turn = Rotation.from_matrix(between[..., :3, :3].reshape(-1, 3, 3)).as_rotvec().reshape(shift.shape)
    angle = np.linalg.norm(turn, axis=-1, keepdims=True)
    n = turn / angle
    slide = (n * shift).sum(axis=-1, keepdims=True) * n
    c = 0.5 * (shift - slide + np.cross(n, shift) / np.tan(0.5 * angle))
    half = np.zeros_like(between)
    half[..., 3, 3] = 1.0
    half[..., :3, :3] = Rotation.from_rotvec(0.5 * turn.reshape(-1, 3)).as_matrix().reshape(between[..., :3, :3].shape)
    half[..., :3, 3] = 0.5 * slide + c - (half[..., :3, :3] @ c[..., None])[..., 0]
    return second @ half


MEANS = {"split": split, "lie": lie}


def body_twists(function, space, q):
    """(v, w) with T^-1 dT = [[w], v; 0, 0], by differences of an independent pose."""
    first, second = poses(space, q)
    slope = differences(lambda at: function(*poses(space, at)), q[..., None, :], np.eye(space.n))
    rate = np.linalg.inv(function(first, second))[..., None, :, :] @ slope
    rows = [rate[..., i, 3] for i in range(3)] + [rate[..., 2, 1], rate[..., 0, 2], rate[..., 1, 0]]
    return np.stack(rows, axis=-2)


def velocities(space, q):
    """World velocities of the end points, and angular velocities, over all joints: each (..., 3, n)."""
    found = []
    for chain, place in zip((space.first, space.second), space.index, strict=True):
        rows = np.zeros((*q.shape[:-1], 6, space.n))
        rows[..., place] = chain.jacobian(q[..., place])
        found += [rows[..., :3, :], rows[..., 3:, :]]
    return found


def differences(function, q, along):
    """Derivative of a function of q along a direction."""
    return sum(sign * weight / STEP * function(q + sign * k * STEP * along) for k, weight in STENCIL for sign in (1, -1))
