"""Kinematics of one chain: pose, point, Jacobians in three frames, their time derivatives and Hessians, and the world screws.

Inputs are c = cos q and s = sin q of the joints (prismatic joints: 1 and the displacement), and joint velocities v. Inside runs the
rotation-and-position recursion, which needs the fewest operations. Every derivative is analytic: brackets of screws,
dS_j/dq_k = [S_k, S_j] for k < j, else 0. Frames are named and mean what they mean in Pinocchio; rows are linear first.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from cga_codegen.kernels.screws import Screw, add, inward, outward, scale
from cga_codegen.kernels.vectors import Scalar, Vector, cross, plus
from cga_codegen.robots.model import Chain

Rows = list[list[Scalar]]


def _columns_to_rows(columns: Sequence[Sequence[Scalar]]) -> list[Scalar]:
    """Row-major entries of the matrix with these columns."""
    return [column[i] for i in range(len(columns[0])) for column in columns]


def pose(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """The homogeneous matrix of the end frame in the root frame, x_root = R x + p."""
    at = outward(chain, c, s)
    return [*_columns_to_rows([*at.rotation, at.position]), 0, 0, 0, 1]


def point(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Position (m) of the end frame's origin in the root frame."""
    return outward(chain, c, s).position


def screws(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """World screws of the joints as bivectors, one a column, rows e12 e13 e23 e1i e2i e3i (about the root frame's origin)."""
    return _columns_to_rows([screw.bivector() for screw in outward(chain, c, s).screws()])


def jacobian_world(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Geometric Jacobian, frame WORLD: twist of the end link about the root frame's origin, (v, w)."""
    return _columns_to_rows([screw.linear_first() for screw in outward(chain, c, s).screws()])


def jacobian_local(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Geometric Jacobian, frame LOCAL: twist of the end frame in its own axes, (v, w). From the chain seen from the end frame."""
    return _columns_to_rows([screw.linear_first() for screw in inward(chain, c, s).screws()])


def jacobian_local_world_aligned(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Geometric Jacobian, frame LOCAL_WORLD_ALIGNED: velocity of the end frame's origin and angular velocity, in root axes, (v, w)."""
    return _columns_to_rows([screw.linear_first() for screw in outward(chain, c, s).screws_at_end()])


def _before(screws: Sequence[Screw], v: Vector) -> list[Screw]:
    """For each joint the twist of the link it sits on: sum of S_k v_k over k < j."""
    zero = Screw([0, 0, 0], [0, 0, 0])
    twists = [zero]
    for screw, rate in zip(screws[:-1], v, strict=False):
        twists.append(add(twists[-1], scale(rate, screw)))
    return twists


def jacobian_derivative_world(chain: Chain, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Time derivative of the WORLD Jacobian at joint velocity v: dS_j/dt = [sum_{k<j} S_k v_k, S_j]."""
    lines = outward(chain, c, s).screws()
    rates = [twist.bracket(line) for twist, line in zip(_before(lines, v), lines, strict=True)]
    return _columns_to_rows([rate.linear_first() for rate in rates])


def jacobian_derivative_local(chain: Chain, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Time derivative of the LOCAL Jacobian: dB_j/dt = [B_j, sum_{k>j} B_k v_k] with the body screws B."""
    lines = inward(chain, c, s).screws()
    after = _before(lines[::-1], [v[chain.n - 1 - j] for j in range(chain.n)])[::-1]
    return _columns_to_rows([line.bracket(twist).linear_first() for line, twist in zip(lines, after, strict=True)])


def jacobian_derivative_local_world_aligned(chain: Chain, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Time derivative of the LOCAL_WORLD_ALIGNED Jacobian (root axes, point of the end frame).

    With dS_j/dt about the fixed point where the end frame's origin now is, plus the motion of that point: (w x v_end added to v).
    """
    lines = outward(chain, c, s).screws_at_end()
    twists = _before(lines, v)
    end = add(twists[-1], scale(v[chain.n - 1], lines[-1])) if lines else Screw([0, 0, 0], [0, 0, 0])
    columns = []
    for twist, line in zip(twists, lines, strict=True):
        rate = twist.bracket(line)
        columns.append([*plus(rate.v, cross(line.w, end.v)), *rate.w])
    return _columns_to_rows(columns)


def _hessian(screws: Sequence[Screw], derivative: Callable[[int, int], Screw]) -> list[Scalar]:
    """Entries [i, j, k] = d J[i, j] / d q_k, row-major."""
    n = len(screws)
    table = [[derivative(j, k).linear_first() for k in range(n)] for j in range(n)]
    return [table[j][k][i] for i in range(6) for j in range(n) for k in range(n)]


_ZERO = Screw([0, 0, 0], [0, 0, 0])


def hessian_world(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Kinematic Hessian of the WORLD Jacobian: [:, j, k] = dS_j/dq_k = [S_k, S_j] for k < j, else 0."""
    lines = outward(chain, c, s).screws()
    return _hessian(lines, lambda j, k: lines[k].bracket(lines[j]) if k < j else _ZERO)


def hessian_local(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Kinematic Hessian of the LOCAL Jacobian: [:, j, k] = dB_j/dq_k = [B_j, B_k] for k > j, else 0."""
    lines = inward(chain, c, s).screws()
    return _hessian(lines, lambda j, k: lines[j].bracket(lines[k]) if k > j else _ZERO)


def hessian_local_world_aligned(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Kinematic Hessian of the LOCAL_WORLD_ALIGNED Jacobian.

    [:, j, k]: angular part w_k x w_j for k < j, else 0; linear part w_min x v_max, symmetric in j and k (it is d^2 p / dq_j dq_k).
    """
    lines = outward(chain, c, s).screws_at_end()

    def derivative(j: int, k: int) -> Screw:
        first, second = min(j, k), max(j, k)
        return Screw(cross(lines[k].w, lines[j].w) if k < j else [0, 0, 0], cross(lines[first].w, lines[second].v))

    return _hessian(lines, derivative)
