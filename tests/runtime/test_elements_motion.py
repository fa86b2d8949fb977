"""Elements as factors of products, and elements moved by versors: the parameters move as the sandwich product moves the blade."""

import element_draws as draws
import numpy as np
import pytest
from element_draws import COUNTS

import cga_runtime as cga
from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector as Exact
from cga_runtime.elements import Circle, Element, Point, PointPair, Sphere
from cga_runtime.motors import Motor
from cga_runtime.multivectors import Multivector
from cga_runtime.versors import Dilator, Rotor, Similarity, Translator

GROUPS = (Rotor, Translator, Dilator, Motor, Similarity)
PRODUCTS = {"*": lambda a, b: a * b, "^": lambda a, b: a ^ b, "|": lambda a, b: a | b}


def exact(x):
    return Exact(blade_types.FULL, tuple(draws.full(x)))


@pytest.mark.parametrize("product", PRODUCTS)
def test_products_of_elements_are_those_of_the_algebra(product, rng):
    elements = [draws.random(kind, rng) for kind in COUNTS]
    for a in elements:
        for b in [*elements, Similarity.exp(rng.normal(size=7)), Multivector(rng.normal(size=2), ("e1", "e123i"))]:
            ours, theirs = PRODUCTS[product](a, b), PRODUCTS[product](exact(a), exact(b))
            reference = np.array([float(theirs.coefficient(mask)) for mask in range(32)])
            np.testing.assert_allclose(draws.full(ours), reference, rtol=0, atol=1e-13 * max(1.0, np.abs(reference).max()))
    for a in elements:
        np.testing.assert_array_equal(draws.full(~a), [float((~exact(a)).coefficient(mask)) for mask in range(32)])
        np.testing.assert_array_equal(draws.full(a.dual()), [float(exact(a).dual().coefficient(mask)) for mask in range(32)])


@pytest.mark.parametrize("group", GROUPS)
@pytest.mark.parametrize("kind", COUNTS)
def test_moved_elements_are_sandwich_products(kind, group, rng):
    versor = group.exp(rng.normal(size=(1, 25, len(group.bivector_blades))))
    x = draws.random(kind, rng, 2, 1)
    moved = x.transformed(versor)
    assert type(moved) is kind and moved.batch == (2, 25) and moved.coefficients.shape == (2, 25, len(kind.blades))
    sandwich = draws.full(versor * x * ~versor)
    if kind is Point:  # a dilation changes the weight of a point
        sandwich = sandwich / sandwich[..., 1:2]
    assert draws.off(moved, sandwich) < 2e-14
    np.testing.assert_array_equal(x.transformed(group(-versor.coefficients)).center, moved.center)


def test_parameters_move_without_loss(rng):
    far = Circle(np.array([100.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]), np.array(0.01))
    there = far.transformed(Translator.from_vector((0.0, 64.0, -32.0)))
    assert there.center.tolist() == [100.0, 64.0, -32.0] and there.radius == 0.01 and there.normal.tolist() == [0.0, 0.0, 1.0]
    doubled = far.transformed(Dilator.from_scale(2.0))
    np.testing.assert_allclose([*doubled.center, doubled.radius], (200.0, 0.0, 0.0, 0.02), rtol=1e-15)
    pair = PointPair.from_points((1, 2, 3), (1, 2, 4)).transformed(Translator.from_vector((0.5, 0.0, 0.0)))
    assert pair.points.tolist() == [[1.5, 2.0, 3.0], [1.5, 2.0, 4.0]]


def test_kinds_names_and_batches(rng):
    assert {name: kind.__name__ for name, kind in Element.kinds.items()} == {
        "point": "Point",
        "point_pair": "PointPair",
        "line": "Line",
        "circle": "Circle",
        "plane": "Plane",
        "sphere": "Sphere",
    }
    for kind in COUNTS:
        x = draws.random(kind, rng, 3, 2)
        assert x.batch == (3, 2) and x.kind == kind.kind and x.name == kind.kind.replace("_", " ") and x.center.shape == (3, 2, 3)


def test_refusals(rng):
    circle = draws.random(Circle, rng, 3)
    with pytest.raises(cga.UnknownNameError, match="unknown versor 'Point'; known: .*Motor"):
        circle.transformed(Point((0, 0, 0)))
    with pytest.raises(cga.WrongSizeError, match="motion of a circle: batch dimensions"):
        circle.transformed(Rotor.exp(np.zeros((2, 3))))
    with pytest.raises(cga.DegenerateError, match="circle: radius .* given, a positive one is needed"):
        circle.transformed(Dilator.from_scale(1e-12))
    with pytest.raises(cga.DegenerateError, match="sphere: its centre lies more than 1e.60 m from the origin"):
        Sphere.from_center_radius((1, 0, 0), 1e-5).transformed(Dilator.from_scale(1e62))
    with pytest.raises(cga.DegenerateError, match="sphere: moved by a versor that is too large for a float"):
        Sphere.from_center_radius((1e30, 0, 0), 1).transformed(Dilator.from_scale(1e290))
    for wrong in (2.0, "e1", np.ones(3)):
        with pytest.raises(TypeError):
            circle * wrong
        with pytest.raises(TypeError):
            wrong * circle
