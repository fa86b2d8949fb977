"""Kinematics of one chain: pose, point, Jacobians in three frames, their time derivatives and Hessians, and the world screws.

Inputs are c = cos q and s = sin q of the joints (prismatic joints: 1 and the displacement), velocities v, and the motor of a floating
base. Inside runs the rotation-and-position recursion, which needs the fewest operations. Every derivative is analytic: brackets of
screws, dS_j/dq_k = [S_k, S_j] for k < j, else 0. Frames are named and mean what they mean in Pinocchio; rows are linear first. Columns
are velocities: of a floating base its twist in its own axes (linear first), then one for each independent joint.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from cga_codegen.kernels.screws import Screw, add, scale
from cga_codegen.kernels.vectors import Scalar, Vector, cross, plus
from cga_codegen.kernels.walk import Configuration, gather, inward, outward, spread
from cga_codegen.robots.model import Chain

Rows = list[list[Scalar]]


def _columns_to_rows(columns: Sequence[Sequence[Scalar]]) -> list[Scalar]:
    """Row-major entries of the matrix with these columns."""
    return [column[i] for i in range(len(columns[0])) for column in columns]


def _matrix(chain: Chain, screws: Sequence[Screw]) -> list[Scalar]:
    """Row-major entries of the matrix whose columns are the screws of the velocities."""
    return _columns_to_rows([screw.linear_first() for screw in gather(chain.coordinates, screws)])


def pose(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """The homogeneous matrix of the end frame in the root frame, x_root = R x + p."""
    at = outward(chain, c, s, base)
    return [*_columns_to_rows([*at.rotation, at.position]), 0, 0, 0, 1]


def point(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Position (m) of the end frame's origin in the root frame."""
    return outward(chain, c, s, base).position


def screws(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """World screws of the joints as bivectors, one a column, rows e12 e13 e23 e1i e2i e3i (about the root frame's origin)."""
    return _columns_to_rows([screw.bivector() for screw in gather(chain.coordinates, outward(chain, c, s, base).screws())])


def jacobian_world(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Geometric Jacobian, frame WORLD: twist of the end link about the root frame's origin, (v, w)."""
    return _matrix(chain, outward(chain, c, s, base).screws())


def jacobian_local(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Geometric Jacobian, frame LOCAL: twist of the end frame in its own axes, (v, w). From the chain seen from the end frame."""
    return _matrix(chain, inward(chain, c, s).screws())


def jacobian_local_world_aligned(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Geometric Jacobian, frame LOCAL_WORLD_ALIGNED: velocity of the end frame's origin and angular velocity, in root axes, (v, w)."""
    return _matrix(chain, outward(chain, c, s, base).screws_at_end())


_ZERO = Screw([0, 0, 0], [0, 0, 0])


def _before(at: Configuration, screws: Sequence[Screw], rates: Vector) -> list[Screw]:
    """For each screw the twist that carries it: the sum of S_k v_k over the screws before it (of a floating base: all six)."""
    sums = [_ZERO]
    for screw, rate in zip(screws, rates, strict=True):
        sums.append(add(sums[-1], scale(rate, screw)))
    return [sums[max(j, at.floating)] for j in range(len(screws))]


def jacobian_derivative_world(chain: Chain, c: Vector, s: Vector, v: Vector, base: Vector | None = None) -> list[Scalar]:
    """Time derivative of the WORLD Jacobian at joint velocity v: dS_j/dt = [sum_{k<j} S_k v_k, S_j]."""
    at = outward(chain, c, s, base)
    lines = at.screws()
    twists = _before(at, lines, spread(chain.coordinates, v))
    return _matrix(chain, [twist.bracket(line) for twist, line in zip(twists, lines, strict=True)])


def jacobian_derivative_local(chain: Chain, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Time derivative of the LOCAL Jacobian: dB_j/dt = [B_j, sum_{k>j} B_k v_k] with the body screws B.

    The six screws of a floating base stand still in its own axes: for them the sum begins behind the base.
    """
    at = inward(chain, c, s)
    lines, rates = at.screws(), spread(chain.coordinates, v)
    sums = [_ZERO]
    for line, rate in zip(lines[:0:-1], rates[:0:-1], strict=True):
        sums.append(add(sums[-1], scale(rate, line)))
    after = [sums[len(lines) - 1 - max(j, at.floating - 1)] for j in range(len(lines))]
    return _matrix(chain, [line.bracket(twist) for line, twist in zip(lines, after, strict=True)])


def jacobian_derivative_local_world_aligned(chain: Chain, c: Vector, s: Vector, v: Vector, base: Vector | None = None) -> list[Scalar]:
    """Time derivative of the LOCAL_WORLD_ALIGNED Jacobian (root axes, point of the end frame).

    With dS_j/dt about the fixed point where the end frame's origin now is, plus the motion of that point: (w x v_end added to v).
    """
    at = outward(chain, c, s, base)
    lines, rates = at.screws_at_end(), spread(chain.coordinates, v)
    twists = _before(at, lines, rates)
    end = _ZERO
    for line, rate in zip(lines, rates, strict=True):
        end = add(end, scale(rate, line))
    columns = []
    for twist, line in zip(twists, lines, strict=True):
        rate = twist.bracket(line)
        columns.append(Screw(rate.w, plus(rate.v, cross(line.w, end.v))))
    return _matrix(chain, columns)


def _hessian(chain: Chain, count: int, derivative: Callable[[int, int], Screw]) -> list[Scalar]:
    """Entries [i, j, k] = d J[i, j] / d q_k, row-major, from dS_j/dq_k of the screws."""
    coordinates = chain.coordinates
    n = coordinates.nv
    by_screw = [gather(coordinates, [derivative(j, k) for j in range(count)]) for k in range(count)]  # [k][column]
    table = [[column.linear_first() for column in gather(coordinates, [by_screw[k][j] for k in range(count)])] for j in range(n)]
    return [table[j][k][i] for i in range(6) for j in range(n) for k in range(n)]


def hessian_world(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Kinematic Hessian of the WORLD Jacobian: [:, j, k] = dS_j/dq_k = [S_k, S_j] for k < j, else 0."""
    at = outward(chain, c, s, base)
    lines = at.screws()
    return _hessian(chain, len(lines), lambda j, k: lines[k].bracket(lines[j]) if at.carries(k, j) else _ZERO)


def hessian_local(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Kinematic Hessian of the LOCAL Jacobian: [:, j, k] = dB_j/dq_k = [B_j, B_k] for k > j, else 0."""
    at = inward(chain, c, s)
    lines = at.screws()
    return _hessian(chain, len(lines), lambda j, k: lines[j].bracket(lines[k]) if k > j and k >= at.floating else _ZERO)


def hessian_local_world_aligned(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Kinematic Hessian of the LOCAL_WORLD_ALIGNED Jacobian.

    [:, j, k]: where k carries j, angular part w_k x w_j and linear part w_k x v_j; else 0 and w_j x v_k. The linear part of joints is
    symmetric in j and k (it is d^2 p / dq_j dq_k).
    """
    at = outward(chain, c, s, base)
    lines = at.screws_at_end()

    def derivative(j: int, k: int) -> Screw:
        if at.carries(k, j):
            return Screw(cross(lines[k].w, lines[j].w), cross(lines[k].w, lines[j].v))
        return Screw([0, 0, 0], cross(lines[j].w, lines[k].v))

    return _hessian(chain, len(lines), derivative)
