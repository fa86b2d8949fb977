"""Products of blades against two independent constructions: Pauli-string matrices, and sign rules in an orthogonal basis."""

import json
from fractions import Fraction
from functools import cache, reduce
from itertools import combinations
from itertools import product as tuples
from pathlib import Path

import numpy as np
import pytest

from cga_codegen.algebra.products import PRODUCTS, UNARY, product, unary, wedge_sign
from cga_codegen.algebra.signature import CGA, G3, G51, PGA, AlgebraError, Signature, grade

SIGNATURES = [G3, PGA, CGA, G51, Signature.orthogonal(1, 2, 1)]
DATA = json.loads((Path(__file__).parents[1] / "data" / "similarity.json").read_text())
NAMES = {"geometric": "gp", "outer": "op", "inner": "ip", "left_contraction": "lc"}

HALF = Fraction(1, 2)
# Each basis vector as a combination of orthogonal ones with squares +1, -1, +1, ...: index 2k squares to +1, 2k + 1 to -1.
NULL_PAIR = {"e0": {0: -HALF, 1: HALF}, "ei": {0: Fraction(1), 1: Fraction(1)}}  # e0 = (e5 - e4)/2, ei = e4 + e5


@cache
def orthogonal_vectors(signature):
    """Basis vectors as {index: coefficient} over orthogonal vectors of squares (-1)^index, each diagonal vector on an index of its own."""
    vectors, positive, negative = [], 2, 3
    for i, name in enumerate(signature.basis):
        square = signature.gram[i][i]
        if name in NULL_PAIR and signature in (CGA, G51):
            vectors.append(NULL_PAIR[name])
        elif square == 0:
            vectors.append({positive: Fraction(1), negative: Fraction(1)})  # degenerate: orthogonal to everything, null
            positive, negative = positive + 2, negative + 2
        else:
            index = positive if square > 0 else negative
            vectors.append({index: Fraction(1)})
            positive, negative = (positive + 2, negative) if square > 0 else (positive, negative + 2)
    return vectors


def test_the_orthogonal_vectors_have_the_gram_matrix():
    for s in SIGNATURES:
        v = orthogonal_vectors(s)
        gram = tuple(tuple(sum(a * b.get(k, 0) * (-1) ** k for k, a in x.items()) for b in v) for x in v)
        assert gram == s.gram


def pauli_string(index):
    """Anticommuting matrices gamma_0 .. gamma_11 (64 x 64 of +-1, +-i) with gamma_k^2 = (-1)^k."""
    x, y, z, one = np.array([[0, 1], [1, 0]]), np.array([[0, -1j], [1j, 0]]), np.diag([1, -1]), np.eye(2)
    factors = [z] * (index // 2) + [x if index % 2 == 0 else 1j * y] + [one] * (5 - index // 2)
    return reduce(np.kron, factors).astype(complex)


@cache
def blade_matrices(signature):
    """Matrix of every blade: the antisymmetrised product of its vectors, by the definition of the outer product."""
    vectors = [sum(complex(c) * pauli_string(k) for k, c in v.items()) for v in orthogonal_vectors(signature)]
    matrices = {0: np.eye(64, dtype=complex)}
    for mask in signature.blades[1:]:
        top = mask.bit_length() - 1
        rest = mask ^ 1 << top
        sign = (-1) ** grade(rest)  # x ^ B = (x B + (-1)^b B x)/2 for a vector x, and B ^ x = (-1)^b x ^ B
        matrices[mask] = sign * (vectors[top] @ matrices[rest] + sign * matrices[rest] @ vectors[top]) / 2
    return matrices


@pytest.mark.parametrize("signature", SIGNATURES, ids=lambda s: s.name)
def test_geometric_product_is_the_product_of_matrices(signature):
    # The images of one vector tell the matrices apart (rank below); all entries are half integers, so that floats are exact.
    probe = np.random.default_rng(7).integers(-8, 9, 64) + 0j
    matrices = blade_matrices(signature)
    images = {m: matrix @ probe for m, matrix in matrices.items()}
    assert np.linalg.matrix_rank(np.array(list(images.values()))) == len(signature.blades)
    for a, b in tuples(signature.blades, repeat=2):
        expected = matrices[a] @ images[b]
        found = sum((c * images[m] for m, c in product(signature, "geometric", a, b)), start=np.zeros(64))
        assert np.array_equal(expected, found), (signature.blade_name(a), signature.blade_name(b))


def orthogonal_product(left, right):
    """Product of {mask: coefficient} over orthogonal vectors: shared ones leave, a sign for sorting and one per shared negative one."""
    total = {}
    for (a, x), (b, y) in tuples(left.items(), right.items()):
        swaps = sum((a >> j + 1).bit_count() for j in range(12) if b >> j & 1)
        negative = sum(1 for j in range(1, 12, 2) if (a & b) >> j & 1)
        total[a ^ b] = total.get(a ^ b, 0) + x * y * (-1) ** (swaps + negative)
    return {m: c for m, c in total.items() if c}


def part(element, g):
    return {m: c for m, c in element.items() if m.bit_count() == g}


@cache
def embedded(signature, mask):
    """A blade over the orthogonal vectors."""
    element = {0: Fraction(1)}
    for i, vector in enumerate(orthogonal_vectors(signature)):
        if mask >> i & 1:
            element = part(orthogonal_product(element, {1 << k: c for k, c in vector.items()}), (mask & (2 << i) - 1).bit_count())
    return element


def embedded_sum(signature, terms):
    total = {}
    for mask, coefficient in terms:
        for m, c in embedded(signature, mask).items():
            total[m] = total.get(m, 0) + coefficient * c
    return {m: c for m, c in total.items() if c}


def expected(rule, ab, ba, a, b):
    """The product's definition, from the two geometric products and the grades."""
    if rule in ("commutator", "anticommutator"):
        sign = -1 if rule == "commutator" else 1
        half = {m: (ab.get(m, 0) + sign * ba.get(m, 0)) / 2 for m in {*ab, *ba}}
        return {m: c for m, c in half.items() if c}
    if rule == "geometric":
        return ab
    kept = {"outer": a + b, "inner": abs(a - b), "left_contraction": b - a, "right_contraction": a - b, "scalar": 0}[rule]
    return {} if rule == "inner" and a * b == 0 else part(ab, kept)


@pytest.mark.parametrize("signature", [G3, PGA, CGA, Signature.orthogonal(1, 2, 1)], ids=lambda s: s.name)
@pytest.mark.parametrize("rule", sorted(PRODUCTS.keys() - {"regressive"}))
def test_products_follow_their_definition_in_an_orthogonal_basis(signature, rule):
    for a, b in tuples(signature.blades, repeat=2):
        ab = orthogonal_product(embedded(signature, a), embedded(signature, b))
        ba = orthogonal_product(embedded(signature, b), embedded(signature, a))
        found = embedded_sum(signature, product(signature, rule, a, b))
        assert found == expected(rule, ab, ba, grade(a), grade(b)), (signature.blade_name(a), signature.blade_name(b))


def test_geometric_product_of_g51_in_an_orthogonal_basis():
    for a, b in tuples(G51.blades, repeat=2):
        ab = orthogonal_product(embedded(G51, a), embedded(G51, b))
        assert embedded_sum(G51, product(G51, "geometric", a, b)) == ab, (G51.blade_name(a), G51.blade_name(b))


@pytest.mark.parametrize("signature", SIGNATURES, ids=lambda s: s.name)
def test_regressive_product_is_the_grassmann_cayley_meet(signature):
    """A v B = sum over splits A = A1 ^ A2 with |A1| = n - |B| of det[A1 B] A2: no metric in it."""
    top = signature.pseudoscalar
    for a, b in tuples(signature.blades, repeat=2):
        total = {}
        bits = [i for i in range(signature.dimension) if a >> i & 1]
        for chosen in combinations(bits, signature.dimension - grade(b)) if signature.dimension >= grade(b) else ():
            first = sum(1 << i for i in chosen)
            if first & b == 0 and first | b == top:
                total[a ^ first] = wedge_sign(first, a ^ first) * wedge_sign(first, b)
        assert dict(product(signature, "regressive", a, b)) == total, (signature.blade_name(a), signature.blade_name(b))


def test_planes_of_pga_meet_in_the_right_line_and_point():
    """In PGA a plane n.x = d is n - d e0; planes x = 1, y = 2, z = 3 meet where P = e123 - 1 e023 + 2 e013 - 3 e012 up to scale."""

    def outer(x, y):
        total = {}
        for (a, p), (b, q) in tuples(x.items(), y.items()):
            for m, c in product(PGA, "outer", a, b):
                total[m] = total.get(m, 0) + c * p * q
        return total

    planes = [{PGA.mask(f"e{i}"): 1, PGA.mask("e0"): -i} for i in (1, 2, 3)]
    point = reduce(outer, planes)
    assert point == {PGA.mask("e123"): 1, PGA.mask("e023"): -1, PGA.mask("e013"): 2, PGA.mask("e012"): -3}
    # The join of that point and the origin e123 is the line through both: it is a factor of no plane that misses one of them.
    join = {}
    for m, c in point.items():
        for k, s in product(PGA, "regressive", m, PGA.mask("e123")):
            join[k] = join.get(k, 0) + c * s
    direction = [join.get(PGA.mask(name), 0) for name in ("e23", "e13", "e12")]
    assert {m: c for m, c in join.items() if c and m & 1} == {}  # through the origin: no moment
    assert [direction[0], -direction[1], direction[2]] in ([1, 2, 3], [-1, -2, -3])


def test_wedge_sign_counts_inversions():
    for a, b in tuples(range(32), repeat=2):
        sequence = [i for i in range(5) if a >> i & 1] + [i for i in range(5) if b >> i & 1]
        inversions = sum(x > y for x, y in combinations(sequence, 2))
        assert wedge_sign(a, b) == (0 if len(set(sequence)) < len(sequence) else (-1) ** inversions)


def test_printed_rules_of_the_null_basis():
    e0, ei, e = CGA.mask("e0"), CGA.mask("ei"), CGA.mask("e0i")
    assert product(CGA, "geometric", e0, ei) == ((0, -1), (e, 1))
    assert product(CGA, "geometric", ei, e0) == ((0, -1), (e, -1))
    assert product(CGA, "geometric", e0, e0) == product(CGA, "geometric", ei, ei) == ()
    assert product(CGA, "geometric", e, e) == ((0, 1),)
    assert product(CGA, "geometric", e, ei) == ((ei, 1),) and product(CGA, "geometric", ei, e) == ((ei, -1),)
    assert product(CGA, "geometric", e, e0) == ((e0, -1),) and product(CGA, "geometric", e0, e) == ((e0, 1),)
    for name in ("e12", "e13", "e23"):
        assert product(CGA, "geometric", e, CGA.mask(name)) == product(CGA, "geometric", CGA.mask(name), e)
    assert unary(CGA, "dual", CGA.mask("e012i")) == ((CGA.mask("e3"), 1),)  # a plane's dual is its right-handed normal


@pytest.mark.parametrize("case", range(len(DATA["products"])))
@pytest.mark.parametrize("rule", sorted(NAMES))
def test_products_of_full_multivectors_match_the_reference(case, rule):
    reference = DATA["products"][case]
    found = np.zeros(32)
    for a, b in tuples(range(32), repeat=2):
        for m, c in product(CGA, rule, a, b):
            found[m] += c * reference["a"][a] * reference["b"][b]
    wanted = np.array(reference[NAMES[rule]])
    assert np.abs(found - wanted).max() <= 1e-14 * max(1.0, np.abs(wanted).max())


@pytest.mark.parametrize(("rule", "key"), [("reverse", "rev_a"), ("dual", "dual_a")])
def test_reverse_and_dual_match_the_reference(rule, key):
    assert DATA["blades"] == [CGA.blade_name(m) for m in CGA.blades]
    for reference in DATA["products"]:
        found = [0.0] * 32
        for a in range(32):
            for m, c in unary(CGA, rule, a):
                found[m] += c * reference["a"][a]
        assert found == reference[key]


@pytest.mark.parametrize("rule", sorted(UNARY.keys() - {"dual", "left_complement", "right_complement"}))
def test_sign_maps_count_exchanged_and_negated_factors(rule):
    for mask in CGA.blades:
        g = grade(mask)
        reversal = (-1) ** len(list(combinations(range(g), 2)))  # one exchange per pair of factors
        signs = {"reverse": reversal, "grade_involution": (-1) ** g, "conjugate": reversal * (-1) ** g}
        assert unary(CGA, rule, mask) == ((mask, signs[rule]),)


def test_dual_of_a_degenerate_algebra_is_the_right_complement():
    for mask in PGA.blades:
        ((other, sign),) = unary(PGA, "dual", mask)
        assert product(PGA, "outer", mask, other) == ((PGA.pseudoscalar, sign),)


def test_unknown_names_and_masks_are_refused():
    with pytest.raises(AlgebraError, match="no product 'cross'; products are geometric, outer, inner"):
        product(CGA, "cross", 1, 2)
    with pytest.raises(AlgebraError, match="no map 'flip'; maps are reverse, grade_involution"):
        unary(CGA, "flip", 1)
    with pytest.raises(AlgebraError, match="blade masks 32, 0 given, 0 to 31 exist"):
        product(CGA, "geometric", 32, 0)
    with pytest.raises(AlgebraError, match="blade mask -1 given"):
        unary(CGA, "dual", -1)
