"""Blade types: which components an element has, defined once, as masks; and the exact type and table of every product of two types.

The component order of a type is ascending bit mask (e0=1, e1=2, e2=4, e3=8, ei=16). Types as in paper A, section 2 and appendix A.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache

from cga_codegen.algebra.products import product, unary
from cga_codegen.algebra.signature import CGA, AlgebraError, Signature


@dataclass(frozen=True)
class BladeType:
    """A named set of basis blades, ascending masks. Two types with the same masks and signature are equal, whatever their names."""

    name: str = field(compare=False)
    masks: tuple[int, ...]
    signature: Signature = CGA

    def __post_init__(self) -> None:
        if list(self.masks) != sorted(set(self.masks)) or any(m not in self.signature.blades for m in self.masks):
            raise AlgebraError(f"type {self.name}: masks {self.masks} given, distinct ascending masks of {self.signature.name} are needed")

    def __len__(self) -> int:
        return len(self.masks)

    @property
    def blade_names(self) -> tuple[str, ...]:
        """Names of the components, in order."""
        return tuple(self.signature.blade_name(m) for m in self.masks)

    def index(self, mask: int) -> int:
        """Position of a blade among the components; AlgebraError when the type has none."""
        if mask not in self.masks:
            raise AlgebraError(f"{self.name} has no {self.signature.blade_name(mask)}; it has {' '.join(self.blade_names)}")
        return self.masks.index(mask)


def _declare(name: str, blades: str) -> BladeType:
    return BladeType(name, CGA.masks(blades))


def _grade(name: str, g: int) -> BladeType:
    return BladeType(name, tuple(m for m in CGA.blades if m.bit_count() == g))


SCALAR = _declare("scalar", "1")
ROTOR = _declare("rotor", "1 e12 e13 e23")
TRANSLATOR = _declare("translator", "1 e1i e2i e3i")
MOTOR = _declare("motor", "1 e12 e13 e23 e1i e2i e3i e123i")
DILATOR = _declare("dilator", "1 e0i")
SIMILARITY = _declare("similarity", "1 e12 e13 e23 e0i e1i e2i e3i e012i e013i e023i e123i")
POINT = _grade("point", 1)
POINT_PAIR = _grade("point_pair", 2)
LINE = _declare("line", "e01i e02i e03i e12i e13i e23i")
CIRCLE = _grade("circle", 3)
PLANE = _declare("plane", "e012i e013i e023i e123i")
SPHERE = _grade("sphere", 4)
TWIST = _declare("twist", "e12 e13 e23 e1i e2i e3i")
WRENCH = _declare("wrench", "e01 e02 e03 e12 e13 e23")
SIMILARITY_BIVECTOR = _declare("similarity_bivector", "e12 e13 e23 e0i e1i e2i e3i")
PSEUDOSCALAR = _declare("pseudoscalar", "e0123i")
ORIGIN = _declare("origin", "e0")
FULL = BladeType("multivector", CGA.blades)

DECLARED: tuple[BladeType, ...] = (
    SCALAR, ROTOR, TRANSLATOR, MOTOR, DILATOR, SIMILARITY, POINT, POINT_PAIR, LINE, CIRCLE, PLANE, SPHERE,
    TWIST, WRENCH, SIMILARITY_BIVECTOR, PSEUDOSCALAR, ORIGIN, FULL,
)  # fmt: skip
"""The types with a name; all are distinct sets of CGA blades."""

_NAMES = {(t.signature, t.masks): t for t in DECLARED}


def type_of(masks: tuple[int, ...], signature: Signature = CGA) -> BladeType:
    """The declared type with exactly these ascending masks, or one named by its blades ("e0 e12"; "zero" when there are none)."""
    return _NAMES.get((signature, masks)) or BladeType(" ".join(signature.blade_name(m) for m in masks) or "zero", masks, signature)


@dataclass(frozen=True)
class Table:
    """The sparse table of a product: result type, and for each result component its terms (index in a, index in b, coefficient)."""

    type: BladeType
    rows: tuple[tuple[tuple[int, int, int], ...], ...]

    @property
    def multiplications(self) -> int:
        """One per nonzero table term."""
        return sum(map(len, self.rows))

    @property
    def additions(self) -> int:
        """Terms minus outputs."""
        return self.multiplications - len(self.rows)


@cache
def product_table(rule: str, a: BladeType, b: BladeType, kept: tuple[int, ...] | None = None) -> Table:
    """The exact table of a product of two types; `kept` restricts the result to some masks (a declared projection).

    Raises AlgebraError for types of different signatures and for an unknown rule.
    """
    if a.signature != b.signature:
        raise AlgebraError(f"{a.name} lives in {a.signature.name}, {b.name} in {b.signature.name}: no product across signatures")
    rows: dict[int, list[tuple[int, int, int]]] = {}
    for i, ma in enumerate(a.masks):
        for j, mb in enumerate(b.masks):
            for mask, coefficient in product(a.signature, rule, ma, mb):
                if kept is None or mask in kept:
                    rows.setdefault(mask, []).append((i, j, coefficient))
    masks = tuple(sorted(rows))
    return Table(type_of(masks, a.signature), tuple(tuple(rows[m]) for m in masks))


@cache
def unary_table(rule: str, a: BladeType) -> tuple[BladeType, tuple[tuple[tuple[int, int], ...], ...]]:
    """The exact table of a linear map of one type: result type, and for each result component its terms (index in a, coefficient)."""
    rows: dict[int, list[tuple[int, int]]] = {}
    for i, ma in enumerate(a.masks):
        for mask, coefficient in unary(a.signature, rule, ma):
            rows.setdefault(mask, []).append((i, coefficient))
    masks = tuple(sorted(rows))
    return type_of(masks, a.signature), tuple(tuple(rows[m]) for m in masks)


def product_type(rule: str, a: BladeType, b: BladeType) -> BladeType:
    """Type of a product: exactly the blades that some pair of components produces; a declared type where it equals one."""
    return product_table(rule, a, b).type
