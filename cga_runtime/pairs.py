"""Pairs: values written as sums of two floats, for sums of products in which no half unit in the last place may be lost (Dekker 1971).

Every operation is made of + - * / of the scalars, without a comparison, so pairs stand over numpy arrays and casadi symbols alike; the
derivative of the second part is that of a rounding error, zero. Casadi simplifies (a + b) - a, a - (a - b), (a / b) b and sqrt(a)^2 on
sight; factors that are powers of two, which round nothing, keep those differences apart.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import frexp
from typing import Any

from cga_runtime.smooth import Field, Scalar

SPLIT = 2.0**27
"""A float times this plus one, less the float times this, is its upper half. Of floats beyond 1e299 the second part is not a number."""
LARGEST = 1e308


@dataclass(frozen=True, eq=False)
class Pair:
    """high + low, where low is a few units in the last place of what high was made of."""

    high: Scalar
    low: Scalar
    __array_ufunc__ = None  # numpy leaves products with arrays to the methods below

    def __add__(self, other: Any) -> Pair:
        b = pair(other)
        total, rest = _sum(self.high, b.high)
        return Pair(total, rest + (self.low + b.low))

    __radd__ = __add__

    def __neg__(self) -> Pair:
        return Pair(-self.high, -self.low)

    def __sub__(self, other: Any) -> Pair:
        return self + (-pair(other))

    def __rsub__(self, other: Any) -> Pair:
        return pair(other) + (-self)

    def __mul__(self, other: Any) -> Pair:
        if isinstance(other, float) and abs(frexp(other)[0]) == 0.5:  # a power of two rounds nothing
            return Pair(other * self.high, other * self.low)
        b = pair(other)
        product, rest = _product(self.high, b.high)
        return Pair(product, rest + (self.high * b.low + self.low * b.high))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Pair:
        b = pair(other)
        quotient = self.high / b.high
        product, rest = _product(4.0 * quotient, b.high)
        return Pair(quotient, 0.25 * ((4.0 * self.high - product) - rest + 4.0 * (self.low - quotient * b.low)) / b.high)

    def __rtruediv__(self, other: Any) -> Pair:
        return pair(other) / self

    def __lt__(self, other: Any) -> Any:
        return self.high < pair(other).high

    def __gt__(self, other: Any) -> Any:
        return self.high > pair(other).high


def pair(x: Any) -> Pair:
    """A scalar as a pair."""
    return x if isinstance(x, Pair) else Pair(x, 0.0)


def _sum(a: Scalar, b: Scalar) -> tuple[Scalar, Scalar]:
    """a + b, rounded, and what the rounding left out (Knuth)."""
    total = a + b
    second = 4.0 * total - 4.0 * a
    first = 8.0 * total - 2.0 * second
    return total, 0.125 * ((8.0 * a - first) + (8.0 * b - 2.0 * second))


def _product(a: Scalar, b: Scalar) -> tuple[Scalar, Scalar]:
    """a b, rounded, and what the rounding left out (Veltkamp, Dekker)."""
    value = a * b
    p, q = _upper(a), _upper(b)
    r, s = a - p, b - q
    return value, ((p * q - value) + p * s + r * q) + r * s


def _upper(a: Scalar) -> Scalar:
    """The upper half of the digits."""
    shifted = SPLIT * a
    return 0.25 * (4.0 * (shifted + a) - 4.0 * shifted)


def root(f: Field, x: Pair) -> Pair:
    """The square root."""
    y = f.sqrt(x.high)
    square, rest = _product(4.0 * y, y)
    return Pair(y, 0.125 * ((4.0 * x.high - square) - rest + 4.0 * x.low) / y)


def rounded(f: Field, x: Any) -> Scalar:
    """The scalar nearest to a pair, any other scalar itself; without the second part where it has outgrown the floats (see SPLIT)."""
    if not isinstance(x, Pair):
        return x
    return x.high + f.where(x.low < LARGEST, f.where(x.low > -LARGEST, x.low, 0.0), 0.0)


def paired(f: Field) -> tuple[Field, Callable[[Any], Any]]:
    """The functions of pairs that exp and log need (the library's round the high part once), and what makes pairs of scalars.

    Where the field does without pairs both leave the scalars as they are.
    """
    if not f.pairs:
        return f, lambda x: x

    def where(condition: Any, a: Any, b: Any) -> Pair:
        first, second = pair(a), pair(b)
        return Pair(f.where(condition, first.high, second.high), f.where(condition, first.low, second.low))

    def atan2(y: Any, x: Any) -> Pair:
        a, b = pair(y), pair(x)
        slope = (b.high * a.low - a.high * b.low) / (a.high * a.high + b.high * b.high)
        return Pair(f.atan2(a.high, b.high), slope)

    functions = replace(
        f,
        sqrt=lambda x: root(f, pair(x)),
        sin=lambda x: Pair(f.sin(x.high), x.low * f.cos(x.high)),
        cos=lambda x: Pair(f.cos(x.high), -x.low * f.sin(x.high)),
        atan2=atan2,
        asinh=lambda x: Pair(f.asinh(x.high), x.low / f.sqrt(1.0 + x.high * x.high)),
        where=where,
    )
    return functions, pair
