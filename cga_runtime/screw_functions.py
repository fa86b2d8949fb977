"""Functions of s + N, where N v = w cross v and s is the logarithm of a scale: what spiral motions do to their velocities.

Any analytic function g of s + N is g(s) + b N + c N^2, because N^3 = -|w|^2 N; g(s) is what it does along w, and across w it is
g(s + i |w|) = across + i |w| b, across = g(s) - |w|^2 c. One function is enough for the exponential and the logarithm of the whole
bivector of a similarity (similarity.md, section 4): f(z) = sinh(z/2) / (z/2), the mean of exp over [-z/2, z/2].
"""

from __future__ import annotations

from math import factorial
from typing import NamedTuple

from cga_runtime.smooth import Field, Scalar, first, versinc

TERMS = 11
"""Of the series of f for |z/2| < 1."""
Triple = tuple[Scalar, Scalar, Scalar]


class ScrewFunction(NamedTuple):
    """A function g of s + N."""

    along: Scalar
    """g(s)"""
    odd: Scalar
    """the factor of N"""
    twice: Scalar
    """the factor of N^2"""
    across: Scalar
    """the real part of g(s + i |w|)"""


def product(a: Triple, b: Triple, square: Scalar) -> Triple:
    """The factors of 1, N, N^2 of a product, from those of two functions; `square` is |w|^2."""
    cubic = a[1] * b[2] + a[2] * b[1]
    return a[0] * b[0], a[0] * b[1] + a[1] * b[0] - square * cubic, a[0] * b[2] + a[1] * b[1] + a[2] * b[0] - square * a[2] * b[2]


def inverse(g: ScrewFunction, square: Scalar) -> ScrewFunction:
    """1 / g; nothing is divided by |w|."""
    size = g.across * g.across + square * g.odd * g.odd
    twice = (g.odd * g.odd - g.across * g.twice) / (g.along * size)
    return ScrewFunction(1.0 / g.along, -g.odd / size, twice, g.across / size)


def spiralling(f: Field, half: Scalar, cosh: Scalar, sinhc: Scalar, square: Scalar, cos: Scalar, sinc: Scalar) -> ScrewFunction:
    """f(s + N); `half` is s / 2, `cosh` and `sinhc` those of it, `square` is |w|^2 / 4, `cos` and `sinc` are those of |w| / 2."""
    size = half * half + square
    near = size < 1.0
    x, h = f.where(near, half, 0.0), f.where(near, square, 0.0)
    argument = (x * x, x, 0.25)  # ((s + N) / 2)^2
    rough = (first(argument[0]), first(x), 0.25)  # all but the last step of pairs
    series: Triple = (1.0 / factorial(2 * TERMS - 1), 0.0, 0.0)
    for k in range(2 * TERMS - 3, 0, -2):
        a, b, c = product(rough, series, 4.0 * first(h)) if k > 1 else product(argument, series, 4.0 * h)
        series = (a + 1.0 / factorial(k), b, c)
    size = f.where(near, 1.0, size)
    odd = 0.5 * half * (cosh * sinc - sinhc * cos) / size
    twice = 0.25 * (half * half * sinhc * versinc(f, square, cos, sinc) + (sinhc - cosh * sinc)) / size
    across = (half * half * sinhc * cos + square * cosh * sinc) / size
    near_across = series[0] - 4.0 * h * series[2]
    return ScrewFunction(sinhc, f.where(near, series[1], odd), f.where(near, series[2], twice), f.where(near, near_across, across))


def axial(f: Field, g: ScrewFunction, square: Scalar, cos: Scalar, sinc: Scalar) -> Scalar:
    """(g(s) cos(|w|/2) - across) / |w|^2, which makes of across on the vector along w what the rotor by half the angle makes of g(s)."""
    near = square < 1.0
    small = g.twice - 0.25 * g.along * versinc(f, square, cos, sinc)
    return f.where(near, small, 0.25 * (g.along * cos - g.across) / f.where(near, 1.0, square))
