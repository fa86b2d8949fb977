"""Exact rational certificates: the screws of an arm at rational half-angle tangents, and the rank of a matrix without rounding.

With t = tan(q/2) rational, cos q = (1 - t^2)/(1 + t^2) and sin q = 2t/(1 + t^2) are rational, and so is every screw of a robot whose
description has decimal numbers and right-angled (or rational) rotations. A full rank at one such point proves full rank almost
everywhere; the recursion below is also independent of the generated kernels.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import lcm

from cga_runtime.robot import Chain
from cga_runtime.workshop import chain_geometry

Rational = list[Fraction]


class NotRationalError(ValueError):
    """The robot's rotations or axes are not exactly rational: ranks cannot be certified, only estimated."""


@dataclass(frozen=True)
class RationalArm:
    """Joints of a chain with exact placements: (prismatic, rotation rows, translation, axis)."""

    joints: tuple[tuple[bool, tuple[tuple[Fraction, ...], ...], tuple[Fraction, ...], tuple[Fraction, ...]], ...]

    @classmethod
    def of(cls, chain: Chain) -> RationalArm:
        """Reads the description's decimals as they are written. Raises NotRationalError if a rotation or axis is not exact."""
        joints = []
        for slides, rotation, translation, axis in chain_geometry(chain.order):
            rows = tuple(tuple(Fraction(repr(x)) for x in row) for row in rotation)
            direction = tuple(Fraction(repr(x)) for x in axis)
            exact = all(sum(rows[k][i] * rows[k][j] for k in range(3)) == (i == j) for i in range(3) for j in range(3))
            if not exact or sum(x * x for x in direction) != 1:
                raise NotRationalError(f"{chain.robot.name}/{chain.frame}: a rotation or axis is not exactly rational")
            joints.append((slides, rows, tuple(Fraction(repr(x)) for x in translation), direction))
        return cls(tuple(joints))

    def screws(self, tangents: Sequence[Fraction]) -> list[Rational]:
        """World screws (w, v) of the joints at q_j = 2 atan(tangents[j]) (prismatic: displacement tangents[j]), exact."""
        rotation = [[Fraction(i == j) for j in range(3)] for i in range(3)]
        position = [Fraction(0)] * 3
        screws = []
        for (slides, placed, translation, axis), t in zip(self.joints, tangents, strict=True):
            position = [p + x for p, x in zip(position, _apply(rotation, translation), strict=True)]
            rotation = _product(rotation, placed)
            w = _apply(rotation, axis)
            screws.append([Fraction(0)] * 3 + w if slides else w + _cross(position, w))
            if slides:
                position = [p + t * x for p, x in zip(position, w, strict=True)]
            else:
                rotation = _product(rotation, _turn(axis, t))
        return screws


def exact_rank(columns: Sequence[Rational]) -> int:
    """Rank of the matrix with these columns, by fraction-free (Bareiss) elimination over the integers."""
    rows = []
    for column in columns:
        scale = lcm(*(x.denominator for x in column))
        rows.append([int(x * scale) for x in column])
    rank, previous = 0, 1
    for k in range(len(rows[0])):
        pivot = next((i for i in range(rank, len(rows)) if rows[i][k]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for i in range(rank + 1, len(rows)):
            rows[i] = [(rows[rank][k] * x - rows[i][k] * y) // previous for x, y in zip(rows[i], rows[rank], strict=True)]
        previous = rows[rank][k]
        rank += 1
        if rank == len(rows):
            break
    return rank


def mirror_signs(right: RationalArm, left: RationalArm) -> tuple[int, ...] | None:
    """Signs s with q_left = s q_right for hand poses mirrored in the plane y = 0; None if the arms are not mirror images.

    A mirror turns a line's direction (x, y, z), as an axis of rotation, into (-x, y, -z), and its points' y into -y.
    """
    if len(right.joints) != len(left.joints) or any(a[0] or b[0] for a, b in zip(right.joints, left.joints, strict=True)):
        return None
    zero = [Fraction(0)] * len(right.joints)
    signs = []
    for ours, theirs in zip(right.screws(zero), left.screws(zero), strict=True):
        w, v = ours[:3], ours[3:]
        mirrored = [-w[0], w[1], -w[2], v[0], -v[1], v[2]]
        if mirrored == theirs:
            signs.append(1)
        elif [-x for x in mirrored] == theirs:
            signs.append(-1)
        else:
            return None
    return tuple(signs)


def _apply(matrix: Sequence[Sequence[Fraction]], x: Sequence[Fraction]) -> Rational:
    return [sum((a * b for a, b in zip(row, x, strict=True)), Fraction(0)) for row in matrix]


def _product(a: Sequence[Sequence[Fraction]], b: Sequence[Sequence[Fraction]]) -> list[Rational]:
    return [[sum((row[k] * b[k][j] for k in range(3)), Fraction(0)) for j in range(3)] for row in a]


def _cross(a: Sequence[Fraction], b: Sequence[Fraction]) -> Rational:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _turn(axis: Sequence[Fraction], t: Fraction) -> list[Rational]:
    """Rotation by 2 atan(t) about a unit axis: c 1 + s [a]x + (1 - c) a a^T."""
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    x, y, z = axis
    skew = [[Fraction(0), -z, y], [z, Fraction(0), -x], [-y, x, Fraction(0)]]
    return [[c * (i == j) + s * skew[i][j] + (1 - c) * axis[i] * axis[j] for j in range(3)] for i in range(3)]
