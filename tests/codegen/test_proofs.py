"""The proofs hold, and each of them fails when the thing it is about is made wrong."""

import pytest

from cga_codegen.algebra import blade_types as bt
from cga_codegen.algebra import proofs
from cga_codegen.algebra.signature import CGA, AlgebraError


def test_every_law_holds_in_all_its_cases():
    told = []
    results = proofs.prove(told.append)
    assert list(results) == told and len(results) == len(proofs.LAWS)
    cases = dict(results)
    assert cases["associativity"] == 8**3 + 16**3 + 3 * 32**3 + 64**3
    assert cases["reversal"] == cases["grade involution"] == 8**2 + 16**2 + 32**2 + 64**2
    assert cases["metric"] == 9 + 16 + 25 + 36
    assert cases["commutator"] == 2 * cases["reversal"] + 10**3
    assert set(cases) == {
        "metric", "associativity", "reversal", "grade involution", "vector and blade", "commutator", "duality", "de morgan",
        "table counts", "exponentials", "similarity packing", "similarity action", "dropped blades",
    }  # fmt: skip
    assert proofs.prove() == results


E1, E2, E0, EI, E12 = (CGA.mask(name) for name in ("e1", "e2", "e0", "ei", "e12"))


@pytest.mark.parametrize(
    ("law", "rule", "a", "b"),
    [
        (proofs.metric, "geometric", E0, EI),
        (proofs.associativity, "geometric", E1, E12),
        (proofs.associativity, "outer", E1, E2),
        (proofs.associativity, "regressive", 31 ^ E1, 31 ^ E2),
        (proofs.reversal, "geometric", E1, E12),
        (proofs.vector_and_blade, "geometric", E0, EI),
        (proofs.vector_and_blade, "outer", E1, E2),
        (proofs.vector_and_blade, "inner", E1, E12),
        (proofs.vector_and_blade, "left_contraction", E1, E12),
        (proofs.commutator, "commutator", E12, CGA.mask("e13")),
        (proofs.commutator, "anticommutator", E0, EI),
        (proofs.duality, "geometric", 31, 31),
        (proofs.duality, "left_contraction", E1, 31),
        (proofs.duality, "outer", E1, E2),
        (proofs.de_morgan, "regressive", 31, E1),
        (proofs.de_morgan, "outer", E1, E2),
        (proofs.table_counts, "geometric", E1, E12),
    ],
)
def test_one_wrong_coefficient_is_found(monkeypatch, law, rule, a, b):
    """Doubling a single entry of a table breaks the law, and the error names the law."""
    right = proofs.product

    def wrong(signature, name, left, other):
        terms = right(signature, name, left, other)
        return tuple((m, 2 * c) for m, c in terms) if (signature, name, left, other) == (CGA, rule, a, b) else terms

    assert right(CGA, rule, a, b) != ()
    monkeypatch.setattr(proofs, "product", wrong)
    with pytest.raises(proofs.ProofError, match=rf"^{law.__name__.replace('_', ' ')} fails for .* is not "):
        law()


def test_a_term_of_the_wrong_parity_is_found(monkeypatch):
    """The grade involution is blind to the size of a coefficient, not to a blade of the other parity."""
    right = proofs.product

    def wrong(signature, name, left, other):
        terms = right(signature, name, left, other)
        return ((0, 1), *terms) if (signature, left, other) == (CGA, E1, E12) else terms

    monkeypatch.setattr(proofs, "product", wrong)
    with pytest.raises(proofs.ProofError, match="^grade involution fails for "):
        proofs.grade_involution()


@pytest.mark.parametrize(
    ("law", "rule"),
    [
        (proofs.reversal, "reverse"),
        (proofs.grade_involution, "grade_involution"),
        (proofs.duality, "dual"),
        (proofs.duality, "right_complement"),
        (proofs.duality, "left_complement"),
        (proofs.de_morgan, "right_complement"),
    ],
)
def test_one_wrong_sign_of_a_map_is_found(monkeypatch, law, rule):
    right = proofs.unary

    def wrong(signature, name, blade):
        terms = right(signature, name, blade)
        return tuple((m, -c) for m, c in terms) if (signature, name, blade) == (CGA, rule, E12) else terms

    monkeypatch.setattr(proofs, "unary", wrong)
    with pytest.raises(proofs.ProofError):
        law()


def test_wrong_conventions_of_versors_are_found(monkeypatch):
    """The printed sign of the dilator's exponent, a left-handed rotation, and a type that lacks a blade all break their law."""
    rotated = proofs._rotated
    monkeypatch.setattr(proofs, "_rotated", lambda r, x: rotated((r[0], -r[1], -r[2], -r[3]), x))
    with pytest.raises(proofs.ProofError, match="similarity action fails for image, component e1"):
        proofs.similarity_action()
    monkeypatch.undo()

    packed = proofs._twice_similarity
    monkeypatch.setattr(proofs, "_twice_similarity", lambda r, t, s: ~packed(r, t, s))
    with pytest.raises(proofs.ProofError, match="similarity packing fails for packing, component e12"):
        proofs.similarity_packing()
    monkeypatch.undo()

    monkeypatch.setattr(bt, "PLANE", bt.BladeType("plane", CGA.masks("e012i e013i e023i")))
    with pytest.raises(proofs.ProofError, match="dropped blades fails for plane, component e123i"):
        proofs.dropped_blades()


def test_the_printed_sign_of_the_dilator_is_refuted():
    """With B = +log(d) e0i (eq. 69 as printed) the derivative law fails: d/dq is not -B/2 times the versor."""
    import sympy

    q = sympy.symbols("q")
    dilator = bt.DILATOR
    v = proofs.Multivector(dilator, (sympy.cosh(q / 2), sympy.sinh(q / 2)))
    slope = proofs.Multivector(dilator, tuple(sympy.diff(c, q) for c in v.coefficients))
    for sign, holds in ((-1, True), (1, False)):
        defect = slope + (proofs.Multivector(dilator, (0, sign)) * v).scaled(sympy.Rational(1, 2))
        assert all(sympy.simplify(c) == 0 for c in defect.coefficients) is holds


def test_check_reports_the_counterexample_and_refuses_to_check_nothing():
    assert proofs.check("law", [(1, 1, "x"), ((), (), "y")]) == proofs.ProofResult("law", 2)
    with pytest.raises(proofs.ProofError, match=r"^law fails for e1, e2 in CGA: 3 is not 4$"):
        proofs.check("law", [(1, 1, "x"), (3, 4, "e1, e2 in CGA")])
    with pytest.raises(proofs.ProofError, match=r"^law: no case was checked$"):
        proofs.check("law", [])
    assert issubclass(proofs.ProofError, AlgebraError)


def test_versor_laws_hold_for_a_similarity_in_numbers():
    """One similarity worked out by hand: quarter turn about e3, scale 4, shift (1, 0, 0); (1, 0, 0) goes to (1, 4, 0)."""
    v = proofs._twice_similarity((1, -1, 0, 0), (1, 0, 0), 2)  # the rotor has |R|^2 = 2
    image = (v * proofs._point((1, 0, 0)) * ~v).project(bt.POINT)
    e0, *x, ei = image.coefficients
    assert [c / e0 for c in x] == [1, 4, 0] and ei / e0 == 17 / 2
