"""Screws and their brackets: the part of kinematics that knows only lines and their moments.

A screw is (w, v): angular velocity w, and velocity v of the point at the origin of the frame it is expressed in. As a bivector of
the algebra, B = w_x e23 - w_y e13 + w_z e12 + v_x e1i + v_y e2i + v_z e3i (note the minus sign), whose motor is exp(-q B/2).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

from cga_codegen.algebra.blade_types import TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.vectors import Axes, Scalar, Vector, cross, dot, minus, plus, times

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
