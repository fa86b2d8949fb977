"""Signatures: Gram matrices, determinants, blade names and the refusals."""

import pytest

from cga_codegen.algebra.signature import CGA, G3, G51, PGA, AlgebraError, Signature, grade_sign


def test_cga_has_the_null_basis_and_the_canonical_blade_order():
    assert CGA.basis == ("e0", "e1", "e2", "e3", "ei")
    assert CGA.gram == ((0, 0, 0, 0, -1), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0), (0, 0, 0, 1, 0), (-1, 0, 0, 0, 0))
    order = (
        "1 e0 e1 e01 e2 e02 e12 e012 e3 e03 e13 e013 e23 e023 e123 e0123 "
        "ei e0i e1i e01i e2i e02i e12i e012i e3i e03i e13i e013i e23i e023i e123i e0123i"
    )
    assert [CGA.blade_name(m) for m in CGA.blades] == order.split()
    assert [CGA.mask(name) for name in order.split()] == list(range(32))


@pytest.mark.parametrize("signature", [G3, PGA, CGA, G51, Signature.orthogonal(2, 1, 1)], ids=lambda s: s.name)
def test_names_and_masks_are_inverse(signature):
    names = [signature.blade_name(m) for m in signature.blades]
    assert len(set(names)) == 2**signature.dimension
    assert [signature.mask(name) for name in names] == list(signature.blades)


@pytest.mark.parametrize(
    ("signature", "determinant", "square"),
    [
        (G3, 1, -1),  # the volume element of space acts as i
        (PGA, 0, 0),
        (CGA, -1, -1),
        (G51, -1, 1),
        (Signature.orthogonal(0, 1), -1, -1),  # complex numbers
        (Signature.orthogonal(2), 1, -1),
        (Signature.orthogonal(0, 2), 1, -1),  # quaternions: (ij)^2 = -1
        (Signature.orthogonal(1, 1), -1, 1),
        (Signature.orthogonal(1, 3), -1, -1),  # space-time
        (Signature.orthogonal(4, 1), -1, -1),  # CGA again, orthogonal basis
        (Signature.orthogonal(2, 0, 1), 0, 0),
        (Signature("pivot", ("ea", "eb"), ((0, 3), (3, 5))), -9, 9),  # needs a row exchange
        (Signature("fraction", ("ea", "eb", "ec"), ((2, 1, 0), (1, 2, 1), (0, 1, 2))), 4, -4),
    ],
    ids=lambda x: x.name if isinstance(x, Signature) else str(x),
)
def test_determinant_and_square_of_the_pseudoscalar(signature, determinant, square):
    assert signature.determinant == determinant
    assert signature.pseudoscalar_square == square


def test_grade_signs_of_reversion():
    assert [grade_sign(g) for g in range(8)] == [(-1) ** (g * (g - 1) // 2) for g in range(8)]


def test_masks_are_sorted_whatever_the_order_of_the_names():
    assert CGA.masks("e3i 1 e12") == (0, 6, 24)


@pytest.mark.parametrize("name", ["e21", "e4", "e", "", "e11", "12", "e1 2", "e0123ii"])
def test_a_name_that_is_no_basis_blade_is_refused(name):
    with pytest.raises(AlgebraError, match=r"CGA: no basis blade .*in the order of \('e0', 'e1', 'e2', 'e3', 'ei'\)"):
        CGA.mask(name)


@pytest.mark.parametrize("mask", [-1, 32])
def test_a_mask_out_of_range_is_refused(mask):
    with pytest.raises(AlgebraError, match=f"CGA: blade mask {mask} given, 0 to 31 exist"):
        CGA.blade_name(mask)


@pytest.mark.parametrize(
    ("basis", "gram", "message"),
    [
        ((), (), "distinct names"),
        (("e1", "e1"), ((1, 0), (0, 1)), "distinct names"),
        (("x", "e1"), ((1, 0), (0, 1)), "distinct names"),
        (("e1", "e2"), ((1, 0),), "must be 2 x 2"),
        (("e1", "e2"), ((1, 0), (0,)), "must be 2 x 2"),
        (("e1", "e2"), ((1, 1), (0, 1)), "e1.e2 = 1 is not a symmetric integer"),
        (("e1",), ((0.5,),), "e1.e1 = 0.5 is not a symmetric integer"),
    ],
)
def test_a_bad_signature_is_refused(basis, gram, message):
    with pytest.raises(AlgebraError, match=message):
        Signature("bad", basis, gram)


@pytest.mark.parametrize("counts", [(0, 0, 0), (-1, 2, 0), (10, 8, 0)])
def test_impossible_counts_are_refused(counts):
    with pytest.raises(AlgebraError, match="1 to 17 basis vectors"):
        Signature.orthogonal(*counts)
