"""Three-vectors of scalars for the kernels: plain lists, any scalar with + - * (floats, casadi.SX).

casadi.SX drops products with exact 0 and 1, so constants such as a signed permutation cost nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Scalar = Any
Vector = Sequence[Scalar]
Axes = list[list[Scalar]]


def cross(a: Vector, b: Vector) -> list[Scalar]:
    """a x b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a: Vector, b: Vector) -> Scalar:
    """a . b, for any length."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def plus(a: Vector, b: Vector) -> list[Scalar]:
    """a + b, for any length."""
    return [x + y for x, y in zip(a, b, strict=True)]


def minus(a: Vector, b: Vector) -> list[Scalar]:
    """a - b, for any length."""
    return [x - y for x, y in zip(a, b, strict=True)]


def times(x: Scalar, a: Vector) -> list[Scalar]:
    """x a, for any length."""
    return [x * y for y in a]


def combine(columns: Sequence[Vector], weights: Vector) -> list[Scalar]:
    """The linear combination sum_k weights[k] columns[k] of three-vectors (a matrix times a vector)."""
    return [dot([column[i] for column in columns], weights) for i in range(3)]
