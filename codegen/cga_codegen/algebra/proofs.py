"""The laws of the algebra, proved exactly: over every blade with integers, over every versor with polynomials.

`prove` runs them all. A law that fails raises ProofError with the counterexample; nothing here is a sampled or floating-point check.
Versor laws use free polynomial variables (SymPy's rings over the rationals), so that an identity that holds here holds for all real
values. Formulas: paper A, section 2 and appendix A, with the corrected sign of the dilator's exponential. A new law is one generator.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import wraps
from itertools import product as tuples
from typing import Any, NamedTuple

from cga_codegen.algebra import blade_types as bt
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.products import Terms, collect, product, unary
from cga_codegen.algebra.signature import CGA, G3, G51, PGA, AlgebraError, Signature, grade, grade_sign

SIGNATURES = (G3, PGA, CGA, G51)  # where the laws of blades are proved
Case = tuple[Any, Any, str]  # left side, right side, and what was put in


class ProofError(AlgebraError):
    """A law that does not hold; the message names the law and the counterexample."""


class ProofResult(NamedTuple):
    """A law that held, and in how many cases it was checked."""

    name: str
    cases: int


LAWS: list[Callable[[], ProofResult]] = []
"""All proofs, in the order in which they are run."""


def check(name: str, cases: Iterable[Case]) -> ProofResult:
    """Compare both sides of every case exactly; ProofError at the first difference, or when there was no case at all."""
    count = 0
    for left, right, what in cases:
        if left != right:
            raise ProofError(f"{name} fails for {what}: {left} is not {right}")
        count += 1
    if count == 0:
        raise ProofError(f"{name}: no case was checked")
    return ProofResult(name, count)


def law(cases: Callable[[], Iterator[Case]]) -> Callable[[], ProofResult]:
    """Make a generator of cases a proof that carries its name, and put it on the list."""

    @wraps(cases)
    def proof() -> ProofResult:
        return check(cases.__name__.replace("_", " "), cases())

    LAWS.append(proof)
    return proof


def prove(report: Callable[[ProofResult], None] | None = None) -> tuple[ProofResult, ...]:
    """Run every proof (a few seconds); `report` gets each result as it comes. Raises ProofError at the first law that does not hold."""
    results = []
    for proof in LAWS:
        results.append(proof())
        if report is not None:
            report(results[-1])
    return tuple(results)


def _times(s: Signature, rule: str, left: Terms, right: Terms) -> Terms:
    return collect((m, a * b * c) for i, a in left for j, b in right for m, c in product(s, rule, i, j))


def _map(s: Signature, rule: str, terms: Terms) -> Terms:
    return collect((m, a * c) for i, a in terms for m, c in unary(s, rule, i))


def _pairs() -> Iterator[tuple[Signature, int, int, str]]:
    for s in SIGNATURES:
        for a, b in tuples(s.blades, repeat=2):
            yield s, a, b, f"{s.blade_name(a)}, {s.blade_name(b)} in {s.name}"


@law
def metric() -> Iterator[Case]:
    """(e_i e_j + e_j e_i)/2 = e_i . e_j, the entry of the Gram matrix."""
    for s, a, b, what in _pairs():
        if grade(a) == grade(b) == 1:
            entry = 2 * s.gram[a.bit_length() - 1][b.bit_length() - 1]
            yield collect(product(s, "geometric", a, b) + product(s, "geometric", b, a)), collect([(0, entry)]), what


@law
def associativity() -> Iterator[Case]:
    """(a b) c = a (b c) for all blade triples (CGA: 32,768): the geometric product everywhere, the outer and regressive ones of CGA."""
    for s, rule in (*((s, "geometric") for s in SIGNATURES), (CGA, "outer"), (CGA, "regressive")):
        table = [[product(s, rule, a, b) for b in s.blades] for a in s.blades]
        for a, b, c in tuples(s.blades, repeat=3):
            left = collect((m, x * y) for i, x in table[a][b] for m, y in table[i][c])
            right = collect((m, x * y) for i, x in table[b][c] for m, y in table[a][i])
            yield left, right, f"the {rule} product of {s.blade_name(a)}, {s.blade_name(b)}, {s.blade_name(c)} in {s.name}"


@law
def reversal() -> Iterator[Case]:
    """~(a b) = ~b ~a: an antiautomorphism."""
    for s, a, b, what in _pairs():
        reverse_a, reverse_b = unary(s, "reverse", a), unary(s, "reverse", b)
        yield _map(s, "reverse", product(s, "geometric", a, b)), _times(s, "geometric", reverse_b, reverse_a), what


@law
def grade_involution() -> Iterator[Case]:
    """The grade involution of a b is the product of the involutions: an automorphism."""
    for s, a, b, what in _pairs():
        involved_a, involved_b = unary(s, "grade_involution", a), unary(s, "grade_involution", b)
        yield _map(s, "grade_involution", product(s, "geometric", a, b)), _times(s, "geometric", involved_a, involved_b), what


@law
def vector_and_blade() -> Iterator[Case]:
    """a B = a _| B + a ^ B, a ^ B = (-1)^b B ^ a, and a . B = (-1)^(b-1) B . a for a vector a and a blade B of grade b > 0."""
    for s, a, b, what in _pairs():
        if grade(a) == 1:
            sign = -1 if grade(b) & 1 else 1
            yield product(s, "geometric", a, b), collect(product(s, "left_contraction", a, b) + product(s, "outer", a, b)), "sum, " + what
            yield product(s, "outer", a, b), _times(s, "outer", ((b, sign),), ((a, 1),)), "outer, " + what
            if b:
                yield product(s, "inner", a, b), _times(s, "inner", ((b, -sign),), ((a, 1),)), "inner, " + what


@law
def commutator() -> Iterator[Case]:
    """2 [a, b] = a b - b a, 2 {a, b} = a b + b a for all blades, and the Jacobi identity of the ten bivectors of CGA."""
    for s, a, b, what in _pairs():
        ab, ba = product(s, "geometric", a, b), product(s, "geometric", b, a)
        for rule, sign in (("commutator", -1), ("anticommutator", 1)):
            twice = tuple((m, 2 * c) for m, c in product(s, rule, a, b))
            yield twice, collect(ab + tuple((m, sign * c) for m, c in ba)), f"{rule}, {what}"
    for a, b, c in tuples(bt.POINT_PAIR.masks, repeat=3):
        cycle = ((a, b, c), (b, c, a), (c, a, b))
        jacobi = collect(t for x, y, z in cycle for t in _times(CGA, "commutator", ((x, 1),), product(CGA, "commutator", y, z)))
        yield jacobi, (), f"Jacobi, masks {a}, {b}, {c}"


@law
def duality() -> Iterator[Case]:
    """I^2 = (-1)^(n(n-1)/2) det(gram) (CGA: -1), X** = I^2 X, (a ^ b)* = a _| b*.

    Complements: a ^ right(a) = I = left(a) ^ a, and left undoes right.
    """
    yield product(CGA, "geometric", 31, 31), ((0, -1),), "I^2 of CGA"
    for s in SIGNATURES:
        top, square = ((s.pseudoscalar, 1),), s.pseudoscalar_square
        yield _times(s, "geometric", top, top), collect([(0, square)]), "I^2 of " + s.name
        for a in s.blades:
            what, one = f"{s.blade_name(a)} in {s.name}", ((a, 1),)
            yield _times(s, "outer", one, unary(s, "right_complement", a)), top, "right, " + what
            yield _times(s, "outer", unary(s, "left_complement", a), one), top, "left, " + what
            yield _map(s, "left_complement", unary(s, "right_complement", a)), one, "left of right, " + what
            if square:
                yield _map(s, "dual", unary(s, "dual", a)), ((a, square),), "X**, " + what
    for s, a, b, what in _pairs():
        if s.pseudoscalar_square:
            contracted = _times(s, "left_contraction", ((a, 1),), unary(s, "dual", b))
            yield _map(s, "dual", product(s, "outer", a, b)), contracted, "(a^b)*, " + what


@law
def de_morgan() -> Iterator[Case]:
    """C(a v b) = C(a) ^ C(b) for right complements, I v b = b. In CGA C(a ^ b) = C(a) v C(b), and (a* ^ b*)* = s(a) s(b) s(c) a v b.

    s(g) = (-1)^(g(g-1)/2), c = a + b - 5: the metric-free meet and that of duals (paper A, eq. 5) differ by a sign per grade.
    """
    for s, a, b, what in _pairs():
        meet, right_a, right_b = product(s, "regressive", a, b), unary(s, "right_complement", a), unary(s, "right_complement", b)
        yield _map(s, "right_complement", meet), _times(s, "outer", right_a, right_b), "meet, " + what
        if a == s.pseudoscalar:
            yield meet, ((b, 1),), "unit, " + what
        if s == CGA:
            yield _map(s, "right_complement", product(s, "outer", a, b)), _times(s, "regressive", right_a, right_b), "join, " + what
            sign = grade_sign(grade(a)) * grade_sign(grade(b)) * grade_sign((grade(a) + grade(b) - 5) % 4)
            dual = _map(s, "dual", _times(s, "outer", unary(s, "dual", a), unary(s, "dual", b)))
            yield dual, tuple((m, sign * k) for m, k in meet), "dual meet, " + what


@law
def table_counts() -> Iterator[Case]:
    """CGA: 1024 nonzero coefficients, all +-1, over 896 pairs. Similarity*similarity: 128/116 (paper A, 5.9 prints 112/100)."""
    table = [product(CGA, "geometric", a, b) for a, b in tuples(CGA.blades, repeat=2)]
    yield sum(map(len, table)), 1024, "coefficients"
    yield sum(map(bool, table)), 896, "pairs"
    yield {abs(c) for terms in table for _, c in terms}, {1}, "sizes"
    for kind, counts in ((bt.MOTOR, (48, 40)), (bt.SIMILARITY, (128, 116))):
        square = bt.product_table("geometric", kind, kind)
        yield (square.type, square.multiplications, square.additions), (kind, *counts), f"{kind.name}*{kind.name}"


def _symbols(names: str) -> tuple[Any, ...]:
    """Free variables of a polynomial ring over the rationals."""
    from sympy import QQ
    from sympy.polys.rings import ring

    return tuple(ring(names, QQ)[1:])


def _is(name: str, left: Multivector, right: Multivector) -> Iterator[Case]:
    """One case per blade that either side has."""
    for mask in sorted({*left.type.masks, *right.type.masks}):
        yield left.coefficient(mask), right.coefficient(mask), f"{name}, component {CGA.blade_name(mask)}"


def _point(x: tuple[Any, ...], weight: Any = 1) -> Multivector:
    """2 weight^2 P(x / weight): a point free of fractions."""
    return Multivector(bt.POINT, (2 * weight**2, *(2 * weight * c for c in x), sum(c**2 for c in x)))


def _rotated(rotor: tuple[Any, ...], x: tuple[Any, ...]) -> tuple[Any, ...]:
    """|R|^2 times the rotated x, by the textbook matrix of the quaternion (a, -b23, b13, -b12): no geometric algebra in it."""
    a, qz, qy, qx = rotor[0], -rotor[1], rotor[2], -rotor[3]
    rows = ((a * a + qx * qx - qy * qy - qz * qz, 2 * (qx * qy - a * qz), 2 * (qx * qz + a * qy)),
            (2 * (qx * qy + a * qz), a * a - qx * qx + qy * qy - qz * qz, 2 * (qy * qz - a * qx)),
            (2 * (qx * qz - a * qy), 2 * (qy * qz + a * qx), a * a - qx * qx - qy * qy + qz * qz))  # fmt: skip
    return tuple(row[0] * x[0] + row[1] * x[1] + row[2] * x[2] for row in rows)


def _twice_similarity(r: tuple[Any, ...], t: tuple[Any, ...], s: Any) -> Multivector:
    """2 s T R D for a rotor r of any size, translation t, dilation d = s^2: every valid similarity is a multiple of one of these."""
    twice_t, twice_sd = Multivector(bt.TRANSLATOR, (2, *(-c for c in t))), Multivector(bt.DILATOR, (s**2 + 1, s**2 - 1))
    v = twice_t * Multivector(bt.ROTOR, r) * twice_sd
    return Multivector(v.type, tuple(c / 2 for c in v.coefficients))


@law
def exponentials() -> Iterator[Case]:
    """exp(B) = Exp(-B/2): each versor solves V' = -B V/2, V(0) = 1, for B = t^ei, biv(w), and -log(d) e0i (minus, against eq. 69)."""
    import sympy as sp

    q, u1, u2, u3, *t = sp.symbols("q u1 u2 u3 t1 t2 t3", real=True)
    cos, sin = sp.cos(q / 2), sp.sin(q / 2)
    versors = (  # the rotor's axis u has unit length: u3^2 = 1 - u1^2 - u2^2; the dilator scales by e^q
        ((1, *(-q * c / 2 for c in t)), bt.TRANSLATOR, (0, *t)),
        ((cos, -sin * u3, sin * u2, -sin * u1), bt.ROTOR, (0, u3, -u2, u1)),
        ((sp.cosh(q / 2), sp.sinh(q / 2)), bt.DILATOR, (0, -1)),
    )
    for values, kind, generator in versors:
        v = Multivector(kind, tuple(map(sp.sympify, values)))
        slope = Multivector(kind, tuple(sp.diff(c, q) for c in v.coefficients))
        defect = slope + (Multivector(kind, generator) * v).scaled(sp.Rational(1, 2))
        for name, c in zip(defect.type.blade_names, defect.coefficients, strict=True):
            yield sp.expand(sp.expand(c).subs(u3**2, 1 - u1**2 - u2**2)), 0, f"the slope of the {kind.name}, component {name}"
        yield tuple(c.subs(q, 0) for c in v.coefficients), (1, *(0 for _ in generator[1:])), f"the {kind.name} at 0"


@law
def similarity_packing() -> Iterator[Case]:
    """V = T R D has the printed components; V ~V = |R|^2; D ei ~D = d ei, D e0 ~D = e0/d; p = A + K = s R, m = A - K = R/s."""
    a, b12, b13, b23, t1, t2, t3, s = _symbols("a b12 b13 b23 t1 t2 t3 s")
    r, v = (a, b12, b13, b23), _twice_similarity((a, b12, b13, b23), (t1, t2, t3), s)
    k = tuple((s**2 - 1) * c for c in r)
    w1, w2, w3 = -a * t1 + b12 * t2 + b13 * t3, -a * t2 - b12 * t1 + b23 * t3, -a * t3 - b13 * t1 - b23 * t2
    w4 = -b12 * t3 + b13 * t2 - b23 * t1
    yield from _is("packing", v, Multivector(bt.SIMILARITY, (*((s**2 + 1) * c for c in r), k[0], w1, w2, k[1], w3, k[2], k[3], w4)))
    yield from _is("norm", v * ~v, Multivector(bt.SCALAR, (4 * s**2 * (a**2 + b12**2 + b13**2 + b23**2),)))
    dilator = Multivector(bt.DILATOR, (s**2 + 1, s**2 - 1))  # 2 s D, so that the sandwich is 4 d times the printed one
    for blade, image in (("ei", 4 * s**4), ("e0", 4)):
        x = Multivector.from_blades(bt.POINT, **{blade: 1})
        yield from _is(f"D {blade} ~D", dilator * x * ~dilator, x.scaled(image))
    for x, y, c in zip(v.at("1 e12 e13 e23"), v.at("e0i e012i e013i e023i"), r, strict=True):
        yield (x + y, x - y), (2 * s**2 * c, 2 * c), f"p and m of {c}"


@law
def similarity_action() -> Iterator[Case]:
    """V P(x) ~V = P(d R x + t) |R|^2/d in all 32 components, so that points stay null and no other blade appears (motor: d = 1)."""
    *r, t1, t2, t3, s, x1, x2, x3 = _symbols("a b12 b13 b23 t1 t2 t3 s x1 x2 x3")
    v, x, size = _twice_similarity(tuple(r), (t1, t2, t3), s), (x1, x2, x3), sum(c**2 for c in r)
    moved = tuple(s**2 * y + size * t for y, t in zip(_rotated(tuple(r), x), (t1, t2, t3), strict=True))
    image = v * _point(x) * ~v
    yield from _is("image", image.scaled(size), _point(moved, size).scaled(4))
    yield from _is("null", image * image, Multivector(bt.SCALAR, (0,)))


@law
def dropped_blades() -> Iterator[Case]:
    """V X ~V stays in X's type for every valid V = T R D and free X, so that a product may project on it.

    Eight free motor components M: M ~M = |R|^2 + 2 S e123i, and M P ~M leaves the points by 2 S P_e0 e0123i; valid motors have S = 0.
    """
    symbols = _symbols("a b12 b13 b23 m1 m2 m3 m4 y0 y1 y2 y3 y4 y5 y6 y7 y8 y9")
    (a, b12, b13, b23, m1, m2, m3, m4), x, v = symbols[:8], symbols[8:], _twice_similarity(symbols[:4], symbols[4:7], symbols[7])
    for kind in (bt.POINT, bt.POINT_PAIR, bt.LINE, bt.CIRCLE, bt.PLANE, bt.SPHERE, bt.SIMILARITY_BIVECTOR):
        image = v * Multivector(kind, x[: len(kind)]) * ~v
        yield from _is(kind.name, image, image.project(kind))
    m, study = Multivector(bt.MOTOR, symbols[:8]), a * m4 - b12 * m3 + b13 * m2 - b23 * m1
    image = m * Multivector(bt.POINT, x[:5]) * ~m
    yield from _is("M ~M", m * ~m, Multivector.from_blades(bt.MOTOR, scalar=sum(c**2 for c in symbols[:4]), e123i=2 * study))
    yield from _is("M P ~M", image - image.project(bt.POINT), Multivector(bt.PSEUDOSCALAR, (2 * study * x[0],)))
