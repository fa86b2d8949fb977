"""Basis vectors and their Gram matrix: the one place where a geometric algebra's metric is written down.

A blade is the wedge product of basis vectors in ascending order, stored as a bit mask (bit i = basis vector i). The basis need not be
orthogonal: conformal algebra is written in the null basis e0, e1, e2, e3, ei with e0.ei = -1 (paper A, section 2), so that the geometric
product of two blades is a sum of blades, not one signed blade.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

SUFFIXES = "123456789abcdefgh"
"""Suffixes of the basis vectors of `Signature.orthogonal`, in order."""


class AlgebraError(ValueError):
    """A signature, blade, type or operand that the algebra cannot represent; the message says what is accepted."""


@dataclass(frozen=True)
class Signature:
    """The geometric algebra of a basis and its Gram matrix gram[i][j] = basis[i] . basis[j] (integers, symmetric, any rank).

    `basis` holds names of the form "e" + one character, in canonical order. Raises AlgebraError for anything else.
    """

    name: str
    basis: tuple[str, ...]
    gram: tuple[tuple[int, ...], ...]

    def __post_init__(self) -> None:
        n = len(self.basis)
        if n == 0 or len(set(self.basis)) != n or any(len(e) != 2 or e[0] != "e" for e in self.basis):
            raise AlgebraError(f"{self.name}: basis {self.basis} given, distinct names 'e' + one character are needed")
        if len(self.gram) != n or any(len(row) != n for row in self.gram):
            raise AlgebraError(f"{self.name}: the Gram matrix must be {n} x {n}, one row per basis vector")
        for i, row in enumerate(self.gram):
            for j, entry in enumerate(row):
                if not isinstance(entry, int) or entry != self.gram[j][i]:
                    raise AlgebraError(f"{self.name}: Gram entry {self.basis[i]}.{self.basis[j]} = {entry} is not a symmetric integer")

    @classmethod
    def orthogonal(cls, p: int, q: int = 0, r: int = 0) -> Signature:
        """G(p, q, r): p basis vectors that square to +1, then q to -1, then r to 0, named e1, e2, ... in that order."""
        n = p + q + r
        if min(p, q, r) < 0 or not 1 <= n <= len(SUFFIXES):
            raise AlgebraError(f"G({p},{q},{r}): counts must be non-negative, with 1 to {len(SUFFIXES)} basis vectors in all")
        squares = [1] * p + [-1] * q + [0] * r
        gram = tuple(tuple(squares[i] if i == j else 0 for j in range(n)) for i in range(n))
        return cls(f"G({p},{q},{r})", tuple("e" + c for c in SUFFIXES[:n]), gram)

    @property
    def dimension(self) -> int:
        """Number of basis vectors n; the algebra has 2^n blades."""
        return len(self.basis)

    @property
    def blades(self) -> tuple[int, ...]:
        """All blade masks, ascending: the canonical component order."""
        return tuple(range(1 << self.dimension))

    @property
    def pseudoscalar(self) -> int:
        """Mask of I, the wedge of all basis vectors in order."""
        return (1 << self.dimension) - 1

    @cached_property
    def determinant(self) -> int:
        """Determinant of the Gram matrix (exact elimination over fractions)."""
        rows = [[Fraction(x) for x in row] for row in self.gram]
        value = Fraction(1)
        for k in range(len(rows)):
            pivot = next((i for i in range(k, len(rows)) if rows[i][k]), None)
            if pivot is None:
                return 0
            if pivot != k:
                rows[k], rows[pivot], value = rows[pivot], rows[k], -value
            value *= rows[k][k]
            for row in rows[k + 1 :]:
                factor = row[k] / rows[k][k]
                for j in range(k, len(rows)):
                    row[j] -= factor * rows[k][j]
        return int(value)

    @property
    def pseudoscalar_square(self) -> int:
        """I^2 = (-1)^(n(n-1)/2) det(gram); zero exactly when the metric is degenerate."""
        return grade_sign(self.dimension) * self.determinant

    def blade_name(self, mask: int) -> str:
        """Name of a blade: "e12i" for e1^e2^ei, "1" for the scalar."""
        if not 0 <= mask <= self.pseudoscalar:
            raise AlgebraError(f"{self.name}: blade mask {mask} given, 0 to {self.pseudoscalar} exist")
        return "e" + "".join(e[1] for i, e in enumerate(self.basis) if mask >> i & 1) if mask else "1"

    def mask(self, name: str) -> int:
        """Mask of a blade name in canonical order; "e21" is refused, because it is -e12 and not a basis blade."""
        if name == "1":
            return 0
        bits = [i for c in name[1:] for i, e in enumerate(self.basis) if e[1] == c]
        mask = sum(1 << i for i in bits)
        if bits != sorted(set(bits)) or not mask or self.blade_name(mask) != name:
            raise AlgebraError(f"{self.name}: no basis blade {name!r}; blades are '1' or 'e' and suffixes in the order of {self.basis}")
        return mask

    def masks(self, names: str) -> tuple[int, ...]:
        """Ascending masks of blade names separated by blanks."""
        return tuple(sorted(self.mask(name) for name in names.split()))


def grade(mask: int) -> int:
    """Number of basis vectors in a blade."""
    return mask.bit_count()


def grade_sign(g: int) -> int:
    """(-1)^(g(g-1)/2): the sign that reversion gives to grade g."""
    return -1 if g & 2 else 1


def conformal(n: int) -> Signature:
    """G(n + 1, 1) of R^n in the null basis e0 e1 ... en ei: e0^2 = ei^2 = 0 and e0.ei = -1 around n orthonormal vectors.

    Raises AlgebraError for an n without names for its vectors.
    """
    if not 1 <= n <= len(SUFFIXES):
        raise AlgebraError(f"conformal algebra of R^{n}: 1 to {len(SUFFIXES)} dimensions have names")
    gram = [[int(i == j and 0 < i <= n) for j in range(n + 2)] for i in range(n + 2)]
    gram[0][n + 1] = gram[n + 1][0] = -1
    return Signature("CGA" if n == 3 else f"G{n + 1}1", tuple("e" + c for c in "0" + SUFFIXES[:n] + "i"), tuple(map(tuple, gram)))


CGA = conformal(3)
"""G(4,1), e0 = (e5 - e4)/2, ei = e4 + e5; masks e0=1, e1=2, e2=4, e3=8, ei=16; I = e0123i, I^2 = -1."""
G51 = conformal(4)
"""G(5,1) in the null basis e0 e1 e2 e3 e4 ei."""
G3 = Signature.orthogonal(3)
"""G(3,0): e1, e2, e3."""
PGA = Signature("PGA", ("e0", "e1", "e2", "e3"), ((0, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)))
"""G(3,0,1): e0^2 = 0, degenerate, so I^2 = 0 and the dual is the complement (see products)."""
