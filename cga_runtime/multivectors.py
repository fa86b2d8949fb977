"""Multivectors of CGA over arrays: the products * ^ |, reverse and dual of anything that has coefficients and blades.

Null basis e0 e1 e2 e3 ei with e0.ei = -1 (paper A, section 2). For numbers at hand, not for inner loops: generated kernels are faster.
Motors, rotors, points, lines ... may be factors; a product holds the blades that it can have, in canonical order (ascending bit mask).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, one_batch, read
from cga_runtime.errors import UnknownNameError, WrongSizeError

VECTORS = "0123i"
NAMES = tuple("e" + "".join(v for k, v in enumerate(VECTORS) if mask >> k & 1) if mask else "1" for mask in range(32))
"""The blades in canonical order: the mask of a blade is its index."""
METRIC = {(0, 4): -1, (4, 0): -1, (1, 1): 1, (2, 2): 1, (3, 3): 1}
KEPT: dict[str, Callable[[int, int, int], bool]] = {
    "geometric": lambda a, b, c: True,
    "outer": lambda a, b, c: c == a + b,
    "inner": lambda a, b, c: c == abs(a - b) and a > 0 and b > 0,
}
"""Which grades c of the geometric product of grades a and b a product keeps; the inner product is that of Hestenes."""


class Element(Protocol):
    """Anything with coefficients (..., k) of k blades."""

    @property
    def coefficients(self) -> Array: ...

    @property
    def blades(self) -> tuple[str, ...]: ...


class Multivector:
    """Coefficients (..., k) of the named blades, ascending masks. Raises UnknownNameError, WrongSizeError, NotFiniteError."""

    __array_ufunc__ = None  # numpy leaves products with arrays to the methods below

    def __init__(self, coefficients: ArrayLike, blades: Iterable[str]) -> None:
        self.blades = tuple(blades)
        masks = [_mask(name) for name in self.blades]
        if masks != sorted(set(masks)):
            raise WrongSizeError(f"multivector: blades {' '.join(self.blades)} given, distinct blades in canonical order are needed")
        self.coefficients = read(coefficients, "multivector", len(masks))

    def __repr__(self) -> str:
        return f"Multivector({self.coefficients!r}, {self.blades!r})"

    def __getitem__(self, blade: str) -> Array:
        """The coefficient of a blade, (...); zero where it has none."""
        _mask(blade)
        return self.coefficients[..., self.blades.index(blade)] if blade in self.blades else np.zeros(self.coefficients.shape[:-1])

    def __mul__(self, other: Any) -> Multivector:
        """Geometric product."""
        return times(self, other, "geometric")

    def __xor__(self, other: Any) -> Multivector:
        """Outer product."""
        return times(self, other, "outer")

    def __or__(self, other: Any) -> Multivector:
        """Inner product of Hestenes: zero when a factor is scalar."""
        return times(self, other, "inner")

    def __add__(self, other: Element) -> Multivector:
        return _sum(self, other, 1.0)

    def __sub__(self, other: Element) -> Multivector:
        return _sum(self, other, -1.0)

    def __invert__(self) -> Multivector:
        """Reverse."""
        return Multivector(self.coefficients * reverse_signs(self.blades), self.blades)

    def dual(self) -> Multivector:
        """X* = X I, I = e0123i; X** = -X."""
        return times(self, PSEUDOSCALAR, "geometric")

    def grade(self, k: int) -> Multivector:
        """The part of grade k."""
        kept = [index for index, name in enumerate(self.blades) if _mask(name).bit_count() == k]
        return Multivector(self.coefficients[..., kept], [self.blades[index] for index in kept])


def times(a: Element, b: Any, rule: str) -> Multivector:
    """A product of two elements, by its rule in KEPT; NotImplemented for what is no element. Raises WrongSizeError."""
    if not (hasattr(b, "coefficients") and hasattr(b, "blades")):
        return NotImplemented  # type: ignore[no-any-return]  # as operators do
    blades, table = _table(rule, a.blades, b.blades)
    one_batch(f"{rule} product", a.coefficients.shape[:-1], b.coefficients.shape[:-1])
    return Multivector(np.einsum("...i,...j,ijk->...k", a.coefficients, b.coefficients, table), blades)


def reverse_signs(blades: Iterable[str]) -> Array:
    """Signs of ~X in the components of X."""
    return np.array([1.0 if _mask(name).bit_count() % 4 < 2 else -1.0 for name in blades])


def _sum(a: Element, b: Element, sign: float) -> Multivector:
    names = tuple(sorted({*a.blades, *b.blades}, key=_mask))
    total = np.zeros((*one_batch("sum", a.coefficients.shape[:-1], b.coefficients.shape[:-1]), len(names)))
    total[..., [names.index(name) for name in a.blades]] += a.coefficients
    total[..., [names.index(name) for name in b.blades]] += sign * b.coefficients
    return Multivector(total, names)


def _mask(name: str) -> int:
    if name not in NAMES:
        raise UnknownNameError("blade", name, NAMES)
    return NAMES.index(name)


@cache
def _table(rule: str, a: tuple[str, ...], b: tuple[str, ...]) -> tuple[tuple[str, ...], Array]:
    """The blades of a product and its table (i, j, k): component k is the sum of table[i, j, k] a[i] b[j]."""
    whole = np.zeros((len(a), len(b), 32))
    for i, first in enumerate(map(_mask, a)):
        for j, second in enumerate(map(_mask, b)):
            for mask, factor in _geometric(first, second).items():
                if KEPT[rule](first.bit_count(), second.bit_count(), mask.bit_count()):
                    whole[i, j, mask] = factor
    kept = [mask for mask in range(32) if whole[..., mask].any()]
    return tuple(NAMES[mask] for mask in kept), whole[..., kept]


def _geometric(a: int, b: int) -> dict[int, int]:
    """Product of two blades: for A = x ^ C with a vector x it is x (C B) - (x _| C) B."""
    if not a:
        return {b: 1}
    k = (a & -a).bit_length() - 1
    rest = a & (a - 1)
    total: dict[int, int] = {}
    for mask, factor in _geometric(rest, b).items():
        for found, sign in (*_contracted(k, mask), *_joined(k, mask)):
            total[found] = total.get(found, 0) + sign * factor
    for mask, factor in _contracted(k, rest):
        for found, sign in _geometric(mask, b).items():
            total[found] = total.get(found, 0) - sign * factor
    return {mask: factor for mask, factor in total.items() if factor}


def _joined(k: int, blade: int) -> list[tuple[int, int]]:
    """The vector number k, wedge a blade."""
    return [] if blade >> k & 1 else [(blade | 1 << k, (-1) ** (blade & (1 << k) - 1).bit_count())]


def _contracted(k: int, blade: int) -> list[tuple[int, int]]:
    """The vector number k contracted on a blade."""
    inside = [j for j in range(5) if blade >> j & 1]
    return [(blade ^ 1 << j, (-1) ** place * METRIC[k, j]) for place, j in enumerate(inside) if (k, j) in METRIC]


PSEUDOSCALAR = Multivector([1.0], ["e0123i"])
