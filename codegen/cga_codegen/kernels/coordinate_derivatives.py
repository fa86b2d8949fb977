"""Derivatives of motor, pose and point of a chain by its joint coordinates q, first and second, analytically (for optimisers).

With the world screws S_j = (w_j, v_j), v taken at the end frame's origin: dR/dq_j = [w_j] R, dp/dq_j = v_j, dM/dq_j = -1/2 S_j M (paper A,
eqs. 7-8), and of two joints the outer one acts first: d2R = [w_a][w_b] R, d2p = w_a x v_b, d2M = 1/4 S_a S_b M for a <= b. Chains on a
fixed base; joints that mimic add, times their ratio, to the columns of their leader. Indices: element (row-major), j (, k).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from cga_codegen.algebra.blade_types import MOTOR
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.screws import Screw
from cga_codegen.kernels.vectors import Scalar, Vector, cross, plus, times
from cga_codegen.kernels.versors import full_angles, motor
from cga_codegen.kernels.walk import outward
from cga_codegen.robots.model import Chain

Rates = list[Scalar]  # of all elements, by one coordinate or two


def pose_by_q(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of the homogeneous matrix by q, (4, 4, n): [w_j] R and v_j."""
    at = outward(chain, c, s)
    return _first(chain, [_matrix([cross(screw.w, column) for column in at.rotation], screw.v) for screw in at.screws_at_end()])


def pose_by_q_by_q(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Second derivative of the homogeneous matrix by q, (4, 4, n, n): [w_a][w_b] R and w_a x v_b."""
    at = outward(chain, c, s)
    screws = at.screws_at_end()
    turned = [[cross(screw.w, column) for column in at.rotation] for screw in screws]

    def rates(a: int, b: int) -> Rates:
        return _matrix([cross(screws[a].w, column) for column in turned[b]], _carried(screws, a, b))

    return _second(chain, rates)


def point_by_q(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of the end frame's origin by q, (3, n): v_j."""
    return _first(chain, [screw.v for screw in outward(chain, c, s).screws_at_end()])


def point_by_q_by_q(chain: Chain, c: Vector, s: Vector) -> list[Scalar]:
    """Second derivative of the end frame's origin by q, (3, n, n): w_a x v_b."""
    screws = outward(chain, c, s).screws_at_end()
    return _second(chain, lambda a, b: _carried(screws, a, b))


def motor_by_q_by_q(chain: Chain, ch: Vector, sh: Vector) -> list[Scalar]:
    """Second derivative of the motor by q, (8, n, n): 1/4 S_a S_b M."""
    screws = [screw.multivector() for screw in outward(chain, *full_angles(chain, ch, sh)).screws()]
    half = Multivector(MOTOR, motor(chain, ch, sh)).scaled(-0.5)
    first = [(screw * half).project(MOTOR).scaled(-0.5) for screw in screws]
    return _second(chain, lambda a, b: list((screws[a] * first[b]).project(MOTOR).coefficients))


def _carried(screws: Sequence[Screw], a: int, b: int) -> Rates:
    """d2p/dq_a dq_b for a <= b: joint a carries the velocity that joint b gives."""
    return cross(screws[a].w, screws[b].v)


def _matrix(columns: Sequence[Sequence[Scalar]], position: Sequence[Scalar]) -> Rates:
    """Row-major rate of a homogeneous matrix from those of its columns."""
    rows = [[*(column[i] for column in columns), position[i]] for i in range(3)]
    return [*(entry for row in rows for entry in row), 0, 0, 0, 0]


def _first(chain: Chain, by_joint: Sequence[Rates]) -> list[Scalar]:
    """Rates by each joint -> entries by each coordinate, coordinate last."""
    columns: list[Rates] = [[] for _ in range(chain.n)]
    for (k, ratio), rates in zip(chain.coordinates.columns, by_joint, strict=True):
        columns[k] = _sum(columns[k], rates, ratio)
    return [column[i] for i in range(len(columns[0])) for column in columns]


def _second(chain: Chain, of_joints: Callable[[int, int], Rates]) -> list[Scalar]:
    """Rates by joints a <= b -> entries by two coordinates, coordinates last."""
    at = chain.coordinates.columns
    table: list[list[Rates]] = [[[] for _ in range(chain.n)] for _ in range(chain.n)]
    for a, (j, first) in enumerate(at):
        for b, (k, second) in enumerate(at):
            table[j][k] = _sum(table[j][k], of_joints(min(a, b), max(a, b)), first * second)
    return [table[j][k][i] for i in range(len(table[0][0])) for j in range(chain.n) for k in range(chain.n)]


def _sum(before: Rates, rates: Rates, ratio: float) -> Rates:
    part = list(rates) if ratio == 1.0 else times(ratio, rates)
    return plus(before, part) if before else part
