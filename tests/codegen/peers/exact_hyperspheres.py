"""Hyperspheres in exact rationals: points, versors and unit elements of G(n + 1, 1), centres and radii by elimination."""

from fractions import Fraction
from functools import reduce
from operator import xor

from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import conformal
from cga_codegen.kernels.hypersphere import hypersphere


def vectors(n):
    return BladeType("vector", tuple(1 << k for k in range(n + 2)), conformal(n))


def versors(n):
    """1 e0i e1i ... eni."""
    algebra = conformal(n)
    return BladeType("versor", (0, *(1 << k | algebra.mask("ei") for k in range(n + 1))), algebra)


def embedded(n, x):
    half = sum(t * t for t in x) / 2
    return Multivector(vectors(n), [1, *x, half])


def span(n, points):
    return reduce(xor, [embedded(n, x) for x in points])


def unit_hypersphere(n, one=Fraction(1)):
    """e01..n + (-1)^n e1..ni / 2."""
    algebra = conformal(n)
    last = algebra.pseudoscalar
    blades = hypersphere(n).type
    values = {last ^ algebra.mask("ei"): one, last ^ 1: one / 2 * (-1) ** n}
    return Multivector(blades, [values.get(mask, 0) for mask in blades.masks])


def nonzero(x):
    return {x.type.signature.blade_name(mask): value for mask, value in zip(x.type.masks, x.coefficients, strict=True) if value != 0}


def rational(draw, size):
    return [Fraction(draw.randint(-40, 40), draw.randint(1, 9)) for _ in range(size)]


def on_hypersphere(draw, centre, radius):
    """A rational point of it, by stereographic projection."""
    t = rational(draw, len(centre) - 1)
    square = sum(x * x for x in t)
    direction = [*(2 * x / (square + 1) for x in t), (square - 1) / (square + 1)]
    return [c + radius * u for c, u in zip(centre, direction, strict=True)]


def determinant(rows):
    """Exact, by elimination."""
    rows, value = [list(row) for row in rows], Fraction(1)
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k]), None)
        if pivot is None:
            return Fraction(0)
        if pivot != k:
            rows[k], rows[pivot], value = rows[pivot], rows[k], -value
        value *= rows[k][k]
        for i in range(k + 1, len(rows)):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k], strict=True)]
    return value


def edges(points):
    return [[a - b for a, b in zip(x, points[0], strict=True)] for x in points[1:]]


def through(points):
    """Exact centre and squared radius."""
    rows = edges(points)
    right = [sum(x * x for x in row) / 2 for row in rows]
    whole, n = determinant(rows), len(rows)
    arm = [determinant([[right[i] if j == k else rows[i][j] for j in range(n)] for i in range(n)]) / whole for k in range(n)]
    return [a + b for a, b in zip(points[0], arm, strict=True)], sum(x * x for x in arm)
