"""Sine and cosine quotients that are smooth and total at zero, over numpy arrays, casadi symbols or jets: what exp and log stand on.

A function of an angle that is even is written as a function of the squared angle, so that no square root of zero is differentiated.
Near zero a series is used, farther out the closed form with an argument that is safe where it is not used: no division by zero, no
warning, and derivatives of every order by casadi are those of the function itself, at zero too. The series reach far enough for the
closed forms to have lost nothing where they take over, and hold spare terms for their second derivatives (similarity.md, section 4).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import factorial
from typing import Any

import numpy as np

Scalar = Any
"""A numpy array or float, a casadi.SX, or a Jet."""


@dataclass(frozen=True)
class Field:
    """The functions of one kind of scalar; + - * / < > come with the scalars."""

    sqrt: Callable[[Scalar], Scalar]
    exp: Callable[[Scalar], Scalar]
    sin: Callable[[Scalar], Scalar]
    cos: Callable[[Scalar], Scalar]
    sinh: Callable[[Scalar], Scalar]
    cosh: Callable[[Scalar], Scalar]
    asinh: Callable[[Scalar], Scalar]
    atan2: Callable[[Scalar, Scalar], Scalar]
    where: Callable[[Any, Scalar, Scalar], Scalar]
    pairs: bool = True
    """Whether critical sums are kept in pairs; jets leave them out, their values serve for slopes only."""


NUMPY = Field(np.sqrt, np.exp, np.sin, np.cos, np.sinh, np.cosh, np.arcsinh, np.arctan2, np.where)


def casadi_field() -> Field:
    """The functions of casadi symbols."""
    import casadi as ca

    return Field(ca.sqrt, ca.exp, ca.sin, ca.cos, ca.sinh, ca.cosh, ca.asinh, ca.atan2, ca.if_else)


def _alternating(first: int, count: int) -> tuple[float, ...]:
    """1/first!, -1/(first + 2)!, 1/(first + 4)!, ..."""
    return tuple((-1.0) ** k / factorial(first + 2 * k) for k in range(count))


COS, SINC, SINC_REST = _alternating(0, 11), _alternating(1, 11), _alternating(3, 11)
"""Series in the squared angle of cos y, sin y / y, and (1 - sin y / y) / y^2, for y^2 < 1."""
SINC_SLOPE = tuple(c - s for c, s in zip(COS[1:], SINC[1:], strict=True))
"""Series of (cos y - sin y / y) / y^2."""
SINHC = tuple(abs(c) for c in SINC)
"""Series in x^2 of sinh x / x, for |x| < 1; truncated below 1e-20, its second derivative below 1e-17."""
ATANC = tuple((-1.0) ** k / (2 * k + 1) for k in range(18))
"""Series in x^2 of atan x / x, for x^2 < 1/16; truncated below 1e-22, its second derivative below 1e-17."""
ATANC_SLOPE = tuple((-1.0) ** k * 2 * k / (2 * k + 1) for k in range(1, 18))
"""Series of (1 / (1 + x^2) - atan x / x) / x^2, likewise."""


def polynomial(coefficients: Sequence[float], x: Scalar) -> Scalar:
    """c0 + c1 x + c2 x^2 + ...; of a pair (see pairs) the terms beyond c1 need the first part only."""
    rough = first(x)
    value = coefficients[-1] + 0.0 * rough
    for c in reversed(coefficients[2:-1]):
        value = value * rough + c
    for c in coefficients[1::-1]:
        value = x * value + c
    return value


def first(x: Scalar) -> Scalar:
    """The first part of a pair, any other scalar itself."""
    return getattr(x, "high", x)


def cos_sinc(f: Field, square: Scalar) -> tuple[Scalar, Scalar]:
    """cos y and sin y / y of y^2 >= 0."""
    near = square < 1.0
    small, y = f.where(near, square, 0.0), f.sqrt(f.where(near, 1.0, square))
    return f.where(near, polynomial(COS, small), f.cos(y)), f.where(near, polynomial(SINC, small), f.sin(y) / y)


def versinc(f: Field, square: Scalar, cos: Scalar, sinc: Scalar) -> Scalar:
    """(1 - cos y) / y^2 from y^2, cos y and sin y / y."""
    front = cos > 0.0
    return f.where(front, sinc * sinc / (1.0 + f.where(front, cos, 0.0)), (1.0 - cos) / f.where(front, 1.0, square))


def sinc_rest(f: Field, square: Scalar, sinc: Scalar) -> Scalar:
    """(1 - sin y / y) / y^2 from y^2 and sin y / y."""
    near = square < 1.0
    return f.where(near, polynomial(SINC_REST, f.where(near, square, 0.0)), (1.0 - sinc) / f.where(near, 1.0, square))


def sinc_slope(f: Field, square: Scalar, cos: Scalar, sinc: Scalar) -> Scalar:
    """(cos y - sin y / y) / y^2 from y^2, cos y and sin y / y: the derivative of sin y / y, over y."""
    near = square < 1.0
    return f.where(near, polynomial(SINC_SLOPE, f.where(near, square, 0.0)), (cos - sinc) / f.where(near, 1.0, square))


def sinhc(f: Field, x: Scalar) -> Scalar:
    """sinh x / x."""
    near = x * x < 1.0
    small, far = f.where(near, x, 0.0), f.where(near, 1.0, x)
    return f.where(near, polynomial(SINHC, small * small), f.sinh(far) / far)


def cosh_sinh(f: Field, x: Scalar) -> tuple[Scalar, Scalar]:
    """cosh x and sinh x, each rounded about once: the library's own are off by up to two units in the last place."""
    sign = f.where(x < 0.0, -1.0, 1.0)
    growth = f.exp(sign * x)
    near = x * x < 1.0
    small = f.where(near, x, 0.0)
    square = small * small
    series = small + small * (square * polynomial(SINHC[1:], square))
    return 0.5 * (growth + 1.0 / growth), f.where(near, series, 0.5 * sign * (growth - 1.0 / growth))


def turn(f: Field, a: Scalar, square: Scalar) -> tuple[Scalar, Scalar]:
    """K = 2 atan2(n, a) / n of a >= 0 and n^2, not both zero, and (2 a / (a^2 + n^2) - K) / n^2, which is dK/dn over n.

    K leads from a rotor's bivector part to minus its logarithm. It is homogeneous of degree -1: a rotor need not have length one.
    """
    near = 16.0 * square < a * a
    front, p = f.where(near, a, 1.0), f.where(near, square, 0.0)
    x = p / (front * front)
    behind, far = f.where(near, 0.0, a), f.where(near, 1.0, square)
    n = f.sqrt(far)
    k = f.where(near, 2.0 * polynomial(ATANC, x) / front, 2.0 * f.atan2(n, behind) / n)
    slope = (2.0 * behind / (behind * behind + far) - k) / far
    return k, f.where(near, 2.0 * polynomial(ATANC_SLOPE, x) / (front * front * front), slope)
