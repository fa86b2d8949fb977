"""Typed multivectors over any scalar: the notation in which kernels are written.

Coefficients may be float, Fraction, sympy expressions, casadi.SX, numpy arrays (component-wise batches), or a mix. Products read the exact
tables of blade_types, so a component that a type does not have costs nothing, and a coefficient that is exactly the int 0 is skipped.
A table coefficient of +-1 becomes a sign, never a multiplication. No coefficient is ever compared or turned into a bool, except ints.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from cga_codegen.algebra.blade_types import BladeType, product_table, type_of, unary_table
from cga_codegen.algebra.signature import AlgebraError, grade


def _is_zero(x: Any) -> bool:
    return type(x) is int and x == 0


def _accumulate(total: Any, term: Any, coefficient: int) -> Any:
    """total + coefficient * term, with the multiplication only where |coefficient| is not 1."""
    if coefficient not in (1, -1):
        term = abs(coefficient) * term
    if _is_zero(total):
        return term if coefficient > 0 else -term
    return total + term if coefficient > 0 else total - term


@dataclass(frozen=True, eq=False)
class Multivector:
    """An element with the components of `type`, in its order (ascending masks). Raises AlgebraError when the lengths differ."""

    type: BladeType
    coefficients: Sequence[Any]

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", tuple(self.coefficients))
        if len(self.coefficients) != len(self.type):
            names = " ".join(self.type.blade_names)
            raise AlgebraError(f"{self.type.name} has {len(self.type)} components ({names}), {len(self.coefficients)} given")

    @classmethod
    def from_blades(cls, type: BladeType, **blades: Any) -> Multivector:
        """From named components, the others the int 0: from_blades(POINT, e0=1, e2=y). The scalar part is called `scalar`."""
        known = {"scalar" if name == "1" else name: 0 for name in type.blade_names}
        for name in blades.keys() - known.keys():
            raise AlgebraError(f"{type.name} has no {name}; it has {' '.join(known)}")
        return cls(type, tuple((known | blades).values()))

    def __repr__(self) -> str:
        parts = ", ".join(f"{name}={x!r}" for name, x in zip(self.type.blade_names, self.coefficients, strict=True))
        return f"<{self.type.name}: {parts}>"

    def _times(self, rule: str, other: Multivector, kept: tuple[int, ...] | None = None) -> Multivector:
        table = product_table(rule, self.type, other.type, kept)
        values = []
        for row in table.rows:
            total: Any = 0
            for i, j, coefficient in row:
                a, b = self.coefficients[i], other.coefficients[j]
                if not (_is_zero(a) or _is_zero(b)):
                    total = _accumulate(total, a * b, coefficient)
            values.append(total)
        return Multivector(table.type, tuple(values))

    def _mapped(self, rule: str) -> Multivector:
        result, rows = unary_table(rule, self.type)
        values = []
        for row in rows:
            total: Any = 0
            for i, coefficient in row:
                if not _is_zero(self.coefficients[i]):
                    total = _accumulate(total, self.coefficients[i], coefficient)
            values.append(total)
        return Multivector(result, tuple(values))

    def __mul__(self, other: Multivector) -> Multivector:
        """Geometric product."""
        return self._times("geometric", other) if isinstance(other, Multivector) else NotImplemented

    def __xor__(self, other: Multivector) -> Multivector:
        """Outer product."""
        return self._times("outer", other) if isinstance(other, Multivector) else NotImplemented

    def __or__(self, other: Multivector) -> Multivector:
        """Inner product of Hestenes: zero when a factor is scalar."""
        return self._times("inner", other) if isinstance(other, Multivector) else NotImplemented

    def left_contraction(self, other: Multivector) -> Multivector:
        """a _| b, grade b - a."""
        return self._times("left_contraction", other)

    def commutator(self, other: Multivector) -> Multivector:
        """(a b - b a)/2."""
        return self._times("commutator", other)

    def regressive(self, other: Multivector) -> Multivector:
        """a v b by right complements, metric-free (see products)."""
        return self._times("regressive", other)

    def scalar_product(self, other: Multivector) -> Any:
        """<a b>_0 as a bare coefficient; the int 0 when the types share no such term."""
        return self._times("scalar", other).coefficient(0)

    def sandwich(self, x: Multivector, result: BladeType | None = None) -> Multivector:
        """V x ~V as a double product (paper A, eq. 78), projected: on `result` if given, else on the grades of x.

        What is dropped vanishes when V is a versor; a `result` must also hold every blade that V can reach (a point for the origin e0).
        """
        grades = {grade(m) for m in x.type.masks}
        kept = result.masks if result else tuple(m for m in x.type.signature.blades if grade(m) in grades)
        return (self * x)._times("geometric", ~self, kept)

    def __invert__(self) -> Multivector:
        """Reverse."""
        return self._mapped("reverse")

    def grade_involution(self) -> Multivector:
        """Odd grades change sign."""
        return self._mapped("grade_involution")

    def dual(self) -> Multivector:
        """X* = X I (CGA: I = e0123i, X** = -X); the right complement for a degenerate metric."""
        return self._mapped("dual")

    def __add__(self, other: Multivector) -> Multivector:
        return self._summed(other, 1)

    def __sub__(self, other: Multivector) -> Multivector:
        return self._summed(other, -1)

    def _summed(self, other: Multivector, sign: int) -> Multivector:
        if not isinstance(other, Multivector):
            return NotImplemented
        if self.type.signature != other.type.signature:
            raise AlgebraError(f"{self.type.name} and {other.type.name} live in different signatures: no sum")
        values = []
        masks = tuple(sorted({*self.type.masks, *other.type.masks}))
        for mask in masks:
            a, b = self.coefficient(mask), other.coefficient(mask)
            values.append(a if _is_zero(b) else _accumulate(a, b, sign))
        return Multivector(type_of(masks, self.type.signature), tuple(values))

    def __neg__(self) -> Multivector:
        return Multivector(self.type, tuple(-x for x in self.coefficients))

    def scaled(self, factor: Any) -> Multivector:
        """Every component times a scalar of any kind."""
        return Multivector(self.type, tuple(x if _is_zero(x) else x * factor for x in self.coefficients))

    def project(self, type: BladeType) -> Multivector:
        """The components of another type; those that this one lacks are the int 0."""
        return Multivector(type, tuple(self.coefficient(m) for m in type.masks))

    def coefficient(self, mask: int) -> Any:
        """The component of a blade, the int 0 if the type has none."""
        return self.coefficients[self.type.masks.index(mask)] if mask in self.type.masks else 0

    def at(self, names: str | Iterable[str]) -> tuple[Any, ...]:
        """Components by blade names ("e01 e02 e03" or a list of names), 0 where absent."""
        wanted = names.split() if isinstance(names, str) else names
        return tuple(self.coefficient(self.type.signature.mask(name)) for name in wanted)
