"""Products of multivectors over arrays are those of the exact tables, for every pair of blades, and for versors and primitives."""

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector as Exact
from cga_runtime.multivectors import NAMES, Multivector
from cga_runtime.versors import Rotor, Similarity

PRODUCTS = {"*": lambda a, b: a * b, "^": lambda a, b: a ^ b, "|": lambda a, b: a | b}


def full(x):
    """All 32 coefficients."""
    return np.stack([x[name] for name in NAMES], axis=-1)


def exact(x):
    """All 32 coefficients of an exact multivector."""
    return np.array([float(x.coefficient(mask)) for mask in range(32)])


@pytest.mark.parametrize("product", PRODUCTS)
def test_products_are_those_of_the_exact_tables(product, rng):
    assert blade_types.FULL.blade_names == NAMES
    for _ in range(3):
        a, b = rng.integers(-9, 9, (2, 32)).astype(float)
        ours = PRODUCTS[product](Multivector(a, NAMES), Multivector(b, NAMES))
        theirs = PRODUCTS[product](Exact(blade_types.FULL, tuple(a)), Exact(blade_types.FULL, tuple(b)))
        np.testing.assert_array_equal(full(ours), exact(theirs))


def test_every_pair_of_blades():
    for i, first in enumerate(NAMES):
        whole = Multivector([1.0], [first]) * Multivector(np.eye(32), NAMES)
        for j in range(32):
            theirs = Exact(blade_types.FULL, np.eye(32)[i]) * Exact(blade_types.FULL, np.eye(32)[j])
            np.testing.assert_array_equal(full(whole)[j], exact(theirs))


def test_reverse_dual_grades_and_sums(rng):
    a, b = (Multivector(rng.normal(size=(4, 32)), NAMES) for _ in range(2))
    for k in range(4):
        x = Exact(blade_types.FULL, tuple(a.coefficients[k]))
        np.testing.assert_array_equal(full(~a)[k], exact(~x))
        np.testing.assert_array_equal(full(a.dual())[k], exact(x.dual()))
    np.testing.assert_array_equal(full(a.dual().dual()), -full(a))
    np.testing.assert_array_equal(sum(full(a.grade(k)) for k in range(6)), full(a))
    np.testing.assert_array_equal(full(a + b), full(a) + full(b))
    np.testing.assert_array_equal(full(a.grade(1) - b.grade(2)), full(a.grade(1)) - full(b.grade(2)))
    assert a.grade(1).blades == ("e0", "e1", "e2", "e3", "ei")


def test_versors_and_primitives_are_factors(rng):
    motor, similarity = cga.Motor.exp(rng.normal(size=(3, 6))), Similarity.exp(rng.normal(size=7))
    points = rng.normal(size=(3, 3))
    moved = motor * cga.Point(points) * ~motor
    expected = (motor.pose() @ np.append(points, np.ones((3, 1)), axis=1)[..., None])[:, :3, 0]
    np.testing.assert_allclose(np.stack([moved[name] for name in ("e0", "e1", "e2", "e3")], axis=-1)[:, 1:], expected, atol=1e-13)
    rotor = Rotor.exp(rng.normal(size=3))
    assert (rotor ^ motor).blades == cga.Motor.blades and isinstance(rotor ^ motor, Multivector)
    v = Exact(blade_types.SIMILARITY, tuple(similarity.coefficients))
    np.testing.assert_array_equal(full(similarity.dual()), exact(v.dual()))
    np.testing.assert_allclose(full(similarity | similarity), exact(v | v), atol=1e-14)
    np.testing.assert_allclose(full(similarity ^ rotor), exact(v ^ Exact(blade_types.ROTOR, tuple(rotor.coefficients))), atol=1e-14)


def test_bad_input_is_named():
    with pytest.raises(cga.UnknownNameError, match="unknown blade 'e21'; known: 1, e0, e1, e01"):
        Multivector([1.0], ["e21"])
    with pytest.raises(cga.WrongSizeError, match="blades e2 e1 given, distinct blades in canonical order are needed"):
        Multivector([1.0, 2.0], ["e2", "e1"])
    with pytest.raises(cga.WrongSizeError, match=r"multivector: shape \(3,\) given, \(..., 2\) needed"):
        Multivector([1.0, 2.0, 3.0], ["e1", "e2"])
    with pytest.raises(cga.NotFiniteError, match="NaN"):
        Multivector([np.nan], ["e1"])
    with pytest.raises(cga.WrongSizeError, match="geometric product: batch dimensions"):
        Multivector(np.ones((2, 1)), ["e1"]) * Multivector(np.ones((3, 1)), ["e1"])
    with pytest.raises(TypeError):
        Multivector([1.0], ["e1"]) * 2.0
    with pytest.raises(TypeError):
        Rotor((1.0, 0.0, 0.0, 0.0)) ^ "e1"
