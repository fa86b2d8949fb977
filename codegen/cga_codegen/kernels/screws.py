"""Joint screws of a chain and their brackets: the part of kinematics that knows only lines and their moments.

A screw is (w, v): angular velocity w, and velocity v of the point at the origin of the frame it is expressed in. As a bivector of
the algebra, B = w_x e23 - w_y e13 + w_z e12 + v_x e1i + v_y e2i + v_z e3i (note the minus sign), whose motor is exp(-q B/2).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from cga_codegen.algebra.blade_types import TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.vectors import Scalar, Vector, combine, cross, dot, minus, plus, times
from cga_codegen.robots.model import Chain, Placement, Rows3

Axes = list[list[Scalar]]
Triple = tuple[int, int, int]
Triples = dict[Triple, Scalar]


@dataclass(frozen=True)
class Screw:
    """A twist (w, v); for a revolute joint the line of its axis, for a prismatic one (0, direction)."""

    w: list[Scalar]
    v: list[Scalar]

    def bivector(self) -> list[Scalar]:
        """Coefficients in canonical order e12 e13 e23 e1i e2i e3i."""
        return [self.w[2], -self.w[1], self.w[0], *self.v]

    def linear_first(self) -> list[Scalar]:
        """Coefficients (v, w): Pinocchio's order."""
        return [*self.v, *self.w]

    def multivector(self) -> Multivector:
        """As a typed element of the algebra."""
        return Multivector(TWIST, self.bivector())

    def bracket(self, other: Screw) -> Screw:
        """The Lie bracket [self, other] = (w1 x w2, w1 x v2 + v1 x w2): the rate of `other` when it is carried along by self.

        In the algebra it is the commutator other x self (paper C with the signs of the null basis; tested both ways).
        """
        return Screw(cross(self.w, other.w), plus(cross(self.w, other.v), cross(self.v, other.w)))


def add(a: Screw, b: Screw) -> Screw:
    """Sum of two twists."""
    return Screw(plus(a.w, b.w), plus(a.v, b.v))


def scale(x: Scalar, a: Screw) -> Screw:
    """A twist times a scalar."""
    return Screw(times(x, a.w), times(x, a.v))


@dataclass(frozen=True)
class Configuration:
    """A chain at (c, s): the joint axes as screws and points, and the pose of the end frame, all in the frame the walk began in.

    axes[j] is the direction of joint j, points[j] a point on it; rotation holds the columns of the end frame's rotation.
    """

    prismatic: tuple[bool, ...]
    axes: Axes
    points: Axes
    rotation: Axes
    position: list[Scalar]

    def screws(self) -> list[Screw]:
        """Screws of the joints about the origin of that frame."""
        zero = [0 * x for x in self.position]
        return [
            Screw(zero, a) if slides else Screw(a, cross(p, a))
            for slides, a, p in zip(self.prismatic, self.axes, self.points, strict=True)
        ]

    def screws_at_end(self) -> list[Screw]:
        """The same with v taken at the end frame's origin (axes unchanged): LOCAL_WORLD_ALIGNED."""
        zero = [0 * x for x in self.position]
        return [
            Screw(zero, a) if slides else Screw(a, cross(a, minus(self.position, p)))
            for slides, a, p in zip(self.prismatic, self.axes, self.points, strict=True)
        ]


def _to_axis(axis: Sequence[float]) -> Placement:
    """A constant rotation that carries +z to the joint axis: a cyclic permutation (free) when the axis is a coordinate axis."""
    x, y, z = axis
    cyclic: dict[tuple[float, ...], Rows3] = {
        (0.0, 0.0, 1.0): ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        (1.0, 0.0, 0.0): ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        (0.0, 1.0, 0.0): ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
        (0.0, 0.0, -1.0): ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)),
        (-1.0, 0.0, 0.0): ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
        (0.0, -1.0, 0.0): ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    }
    if (x, y, z) in cyclic:
        return Placement(cyclic[(x, y, z)])
    # any rotation with third column = axis: the shortest turn from z, or from -z (after half a turn about x), whichever is nearer
    k = 1.0 / (1.0 + z) if z > -0.5 else 1.0 / (1.0 - z)
    if z > -0.5:
        return Placement(((1.0 - x * x * k, -x * y * k, x), (-x * y * k, 1.0 - y * y * k, y), (-x, -y, z)))
    return Placement(((1.0 - x * x * k, x * y * k, x), (-x * y * k, -1.0 + y * y * k, y), (x, -y, z)))


def _z_axes(chain: Chain) -> tuple[list[Placement], Placement, tuple[bool, ...]]:
    """The chain with every joint about its own +z: placements before each joint, the tool, and which joints are prismatic."""
    turns = [_to_axis(joint.axis) for joint in chain.joints]
    before = Placement()
    placements = []
    for joint, turn in zip(chain.joints, turns, strict=True):
        placements.append(before @ joint.placement @ turn)
        before = turn.inverse()
    return placements, before @ chain.tool, tuple(j.kind == "prismatic" for j in chain.joints)


def _walk(placements: list[Placement], tool: Placement, prismatic: tuple[bool, ...], c: Vector, s: Vector) -> Configuration:
    """Rotation columns and position, joint by joint; nothing is expanded across joints."""
    columns: Axes = [[1 if i == k else 0 for i in range(3)] for k in range(3)]
    position: list[Scalar] = [0, 0, 0]
    axes: Axes = []
    points: Axes = []

    def place(at: Placement) -> None:
        nonlocal columns, position
        exact = [[int(x) if x in (0.0, 1.0, -1.0) else x for x in row] for row in at.rotation]
        position = plus(position, combine(columns, [int(x) if x == 0.0 else x for x in at.translation]))
        columns = [combine(columns, [row[k] for row in exact]) for k in range(3)]

    for j, placement in enumerate(placements):
        place(placement)
        axes.append(columns[2])
        points.append(position)
        if prismatic[j]:
            position = plus(position, times(s[j], columns[2]))
        else:
            x, y, z = columns
            columns = [plus(times(c[j], x), times(s[j], y)), minus(times(c[j], y), times(s[j], x)), z]
    place(tool)
    return Configuration(prismatic, axes, points, columns, position)


def outward(chain: Chain, c: Vector, s: Vector) -> Configuration:
    """The chain seen from its root."""
    return _walk(*_z_axes(chain), c, s)


def inward(chain: Chain, c: Vector, s: Vector) -> Configuration:
    """The chain seen from its end frame: the inverse chain, walked from the tool. Joints keep their order and their axes' sense.

    Its `screws()` are the body screws (LOCAL Jacobian), for fewer operations than turning the outward ones.
    """
    placements, tool, prismatic = _z_axes(chain)
    backwards = [tool.inverse(), *(p.inverse() for p in reversed(placements[1:]))]
    n = chain.n
    # walking backwards every joint turns the other way
    seen = _walk(backwards, placements[0].inverse(), prismatic[::-1], [c[n - 1 - j] for j in range(n)], [-s[n - 1 - j] for j in range(n)])
    return Configuration(prismatic, seen.axes[::-1], seen.points[::-1], seen.rotation, seen.position)


def _split_in_threes() -> list[tuple[Triple, Triple, int]]:
    """The 20 ways to give three of six columns to the upper rows, with the sign of Laplace's expansion."""
    splits = []
    for chosen in combinations(range(6), 3):
        first, second, third = (i for i in range(6) if i not in chosen)
        splits.append((chosen, (first, second, third), 1 if (sum(chosen) - 3) % 2 == 0 else -1))
    return splits


def _halves(screws: Vector) -> tuple[Axes, Axes]:
    """Columns of the upper and of the lower three rows of a row-major 6x6 matrix."""
    return [[screws[6 * i + j] for i in range(3)] for j in range(6)], [[screws[6 * i + j] for i in range(3, 6)] for j in range(6)]


def bracket(screws: Vector) -> list[Scalar]:
    """Determinant of six screws (6x6, row-major, one screw a column), by Laplace expansion over shared 3x3 minors.

    In bivector rows e12 e13 e23 e1i e2i e3i it has the same sign as in (w, v). Zero exactly when the screws are dependent (paper C 5.2).
    """
    upper, lower = _halves(screws)

    def triples(half: Axes) -> Triples:
        pairs = {(i, j): cross(half[i], half[j]) for i, j in combinations(range(6), 2)}
        return {(i, j, k): dot(pairs[i, j], half[k]) for i, j, k in combinations(range(6), 3)}

    above, below = triples(upper), triples(lower)
    total: Scalar = 0
    for chosen, rest, sign in _split_in_threes():
        term = above[chosen] * below[rest]
        total = total + term if sign > 0 else total - term
    return [total]


def bracket_cofactors(screws: Vector) -> list[Scalar]:
    """Derivative of `bracket` by each entry (6x6, row-major): its cofactors, finite also where the bracket vanishes."""
    upper, lower = _halves(screws)
    pairs = [{(i, j): cross(half[i], half[j]) for i, j in combinations(range(6), 2)} for half in (upper, lower)]
    triples = [
        {(i, j, k): dot(pair[i, j], half[k]) for i, j, k in combinations(range(6), 3)}
        for pair, half in zip(pairs, (upper, lower), strict=True)
    ]
    gradient: list[list[list[Scalar]]] = [[[0, 0, 0] for _ in range(6)] for _ in range(2)]
    for chosen, rest, sign in _split_in_threes():
        for half, own, other in ((0, chosen, triples[1][rest]), (1, rest, triples[0][chosen])):
            weight = other if sign > 0 else -other
            i, j, k = own
            # d (a x b).c = (b x c).da + (c x a).db + (a x b).dc, with c x a = -(a x c)
            for column, (first, second), flip in ((i, (j, k), 1), (j, (i, k), -1), (k, (i, j), 1)):
                term = times(weight, pairs[half][first, second])
                gradient[half][column] = plus(gradient[half][column], term) if flip > 0 else minus(gradient[half][column], term)
    return [gradient[i // 3][j][i % 3] for i in range(6) for j in range(6)]
