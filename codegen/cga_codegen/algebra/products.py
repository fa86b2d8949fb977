"""Every product of two blades, as one loop with one rule per product.

The geometric product of wedge blades over any Gram matrix comes from e_i B = e_i _| B + e_i ^ B, applied vector by vector
(for A = e_i ^ C: A B = e_i (C B) - (e_i _| C) B). Every other product keeps some grades of it. A new product is one row of PRODUCTS.
All coefficients are exact integers; results are cached.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache

from cga_codegen.algebra.signature import AlgebraError, Signature, grade, grade_sign

Terms = tuple[tuple[int, int], ...]
"""A sum of blades: (mask, coefficient) with ascending masks and no zero coefficient."""


@dataclass(frozen=True)
class Rule:
    """Which grades c of the geometric product of grades a and b a product keeps.

    With `complemented`, the product acts on right complements and is carried back: A v B = C^-1(C(A) . C(B)).
    """

    meaning: str
    keep: Callable[[int, int, int], bool]
    complemented: bool = False


PRODUCTS: dict[str, Rule] = {
    "geometric": Rule("a b", lambda a, b, c: True),
    "outer": Rule("a ^ b: grade a + b", lambda a, b, c: c == a + b),
    "inner": Rule("a . b (Hestenes): grade |a - b|, zero when a factor is scalar", lambda a, b, c: c == abs(a - b) and a > 0 and b > 0),
    "left_contraction": Rule("a _| b: grade b - a", lambda a, b, c: c == b - a),
    "right_contraction": Rule("a |_ b: grade a - b", lambda a, b, c: c == a - b),
    "scalar": Rule("<a b>_0", lambda a, b, c: c == 0),
    # Reversion gives <b a>_c = s(a) s(b) s(c) <a b>_c, so (ab -+ ba)/2 keeps whole grades of a b: no fraction appears.
    "commutator": Rule("(a b - b a)/2", lambda a, b, c: grade_sign(a) * grade_sign(b) * grade_sign(c) < 0),
    "anticommutator": Rule("(a b + b a)/2", lambda a, b, c: grade_sign(a) * grade_sign(b) * grade_sign(c) > 0),
    # Metric-free, hence right for degenerate signatures too: I v B = B, and A v B is the meet of A and B.
    "regressive": Rule("a v b: outer product of right complements, carried back", lambda a, b, c: c == a + b, complemented=True),
}
"""The binary products by name."""


def collect(pairs: Iterable[tuple[int, int]]) -> Terms:
    """Like blades added up, zeros dropped, masks ascending."""
    total: dict[int, int] = {}
    for mask, coefficient in pairs:
        total[mask] = total.get(mask, 0) + coefficient
    return tuple(sorted((mask, c) for mask, c in total.items() if c))


def _contract_vector(signature: Signature, i: int, blade: int) -> Terms:
    """e_i _| B: remove each factor e_j in turn, with the sign of its position and the metric e_i . e_j."""
    row = signature.gram[i]
    factors = [j for j in range(signature.dimension) if blade >> j & 1]
    return tuple((blade ^ 1 << j, -row[j] if k & 1 else row[j]) for k, j in enumerate(factors) if row[j])


def wedge_sign(a: int, b: int) -> int:
    """The s of a ^ b = s (a|b): 0 when a factor is shared, else the sign of the sorting permutation."""
    if a & b:
        return 0
    swaps = sum(grade(a >> j + 1) for j in range(b.bit_length()) if b >> j & 1)
    return -1 if swaps & 1 else 1


@cache
def _geometric(signature: Signature, a: int, b: int) -> Terms:
    if a == 0:
        return ((b, 1),)
    i = (a & -a).bit_length() - 1
    rest = a ^ 1 << i
    pairs: list[tuple[int, int]] = []
    for mask, c in _geometric(signature, rest, b):
        pairs += [(m, c * k) for m, k in _contract_vector(signature, i, mask)]
        pairs.append((mask | 1 << i, c * wedge_sign(1 << i, mask)))
    for mask, c in _contract_vector(signature, i, rest):
        pairs += [(m, -c * k) for m, k in _geometric(signature, mask, b)]
    return collect(pairs)


def _complement_sign(signature: Signature, blade: int) -> int:
    """The s of the right complement C(A) = s (I without A's factors), fixed by A ^ C(A) = I."""
    return wedge_sign(blade, signature.pseudoscalar ^ blade)


@cache
def product(signature: Signature, rule: str, a: int, b: int) -> Terms:
    """The product of two basis blades, exactly: (mask, coefficient) pairs with ascending masks.

    `rule` is a name of PRODUCTS. For e0 ei of CGA: product(CGA, "geometric", 1, 16) = ((0, -1), (17, 1)), i.e. -1 + e0i.
    Raises AlgebraError for an unknown rule or mask.
    """
    if rule not in PRODUCTS:
        raise AlgebraError(f"no product {rule!r}; products are {', '.join(PRODUCTS)}")
    top = signature.pseudoscalar
    if not (0 <= a <= top and 0 <= b <= top):
        raise AlgebraError(f"{signature.name}: blade masks {a}, {b} given, 0 to {top} exist")
    chosen, sign = PRODUCTS[rule], 1
    if chosen.complemented:
        sign = _complement_sign(signature, a) * _complement_sign(signature, b)
        a, b = top ^ a, top ^ b
    kept = tuple((m, sign * c) for m, c in _geometric(signature, a, b) if chosen.keep(grade(a), grade(b), grade(m)))
    if chosen.complemented:
        # C^-1 of a blade M is +-(I without M), with the sign of the complement of that result.
        kept = tuple(sorted((top ^ m, c * _complement_sign(signature, top ^ m)) for m, c in kept))
    return kept


def _dual(signature: Signature, a: int) -> Terms:
    if signature.determinant == 0:
        return _right_complement(signature, a)
    return _geometric(signature, a, signature.pseudoscalar)


def _right_complement(signature: Signature, a: int) -> Terms:
    return ((signature.pseudoscalar ^ a, _complement_sign(signature, a)),)


def _left_complement(signature: Signature, a: int) -> Terms:
    other = signature.pseudoscalar ^ a
    return ((other, wedge_sign(other, a)),)


UNARY: dict[str, Callable[[Signature, int], Terms]] = {
    "reverse": lambda signature, a: ((a, grade_sign(grade(a))),),
    "grade_involution": lambda signature, a: ((a, -1 if grade(a) & 1 else 1),),
    "conjugate": lambda signature, a: ((a, grade_sign(grade(a)) * (-1 if grade(a) & 1 else 1)),),
    # X I where I has an inverse (CGA: X** = -X); X I is not invertible for a degenerate metric, where the right complement stands in.
    "dual": _dual,
    "right_complement": _right_complement,
    "left_complement": _left_complement,
}
"""The linear maps of one blade by name: complements satisfy A ^ right(A) = I = left(A) ^ A, and left undoes right."""


@cache
def unary(signature: Signature, rule: str, a: int) -> Terms:
    """A linear map of one basis blade, exactly; `rule` is a name of UNARY. Raises AlgebraError for an unknown rule or mask."""
    if rule not in UNARY:
        raise AlgebraError(f"no map {rule!r}; maps are {', '.join(UNARY)}")
    signature.blade_name(a)
    return UNARY[rule](signature, a)
