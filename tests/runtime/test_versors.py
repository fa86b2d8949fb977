"""Rotors, translators, dilators and similarities as classes: products, parts, matrices, reverse, and refusals."""

from dataclasses import FrozenInstanceError
from itertools import product

import exp_log_series as series
import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.algebra.multivector import Multivector
from cga_runtime.motors import Motor
from cga_runtime.versors import Dilator, Rotor, Similarity, Translator

GROUPS = (Rotor, Translator, Dilator, Motor, Similarity)
SMALLEST = {
    (Rotor, Rotor): Rotor,
    (Translator, Translator): Translator,
    (Dilator, Dilator): Dilator,
    (Rotor, Translator): Motor,
    (Rotor, Motor): Motor,
    (Translator, Motor): Motor,
    (Motor, Motor): Motor,
}
"""The group of a product, in either order; of all others a similarity."""


def random(kind, rng, count=7):
    return kind.exp(rng.normal(size=(count, len(kind.bivector_blades))))


def action(versor):
    """Homogeneous matrix (..., 4, 4) of x -> V x ~V, by the sandwich of the algebra on the origin and the ends of the axes."""
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
    images = np.empty((len(versor.coefficients), 4, 3))
    for k, coefficients in enumerate(versor.coefficients):
        v = Multivector(series.TYPES[versor.group], tuple(coefficients))
        for j, x in enumerate(points):
            image = np.array(v.sandwich(Multivector(series.blade_types.POINT, (1.0, *x, 0.5 * x @ x))).coefficients)
            images[k, j] = image[1:4] / image[0]
    whole = np.zeros((len(images), 4, 4))
    whole[:, :3, :3] = (images[:, 1:] - images[:, :1]).transpose(0, 2, 1)
    whole[:, :3, 3], whole[:, 3, 3] = images[:, 0], 1.0
    return whole


@pytest.mark.parametrize(("first", "second"), list(product(GROUPS, GROUPS)))
def test_products_move_as_one_after_the_other(first, second, rng):
    a, b = random(first, rng), random(second, rng)
    both = a * b
    assert type(both) is SMALLEST.get((first, second), SMALLEST.get((second, first), Similarity))
    np.testing.assert_allclose(action(both), action(a) @ action(b), atol=2e-13)
    for k in range(len(a.coefficients)):  # and the components are those of the algebra
        x, y = (Multivector(series.TYPES[v.group], tuple(v.coefficients[k])) for v in (a, b))
        whole = (x * y).project(series.TYPES[both.group]).coefficients
        np.testing.assert_allclose(both.coefficients[k], np.array(whole, dtype=float), atol=1e-13)


@pytest.mark.parametrize("kind", GROUPS)
def test_the_reverse_undoes_and_coefficients_stay(kind, rng):
    v = random(kind, rng)
    one = np.zeros(len(kind.blades))
    one[0] = 1.0
    np.testing.assert_allclose((v * ~v).coefficients, one + 0 * v.coefficients, atol=1e-13)
    for k in range(len(v.coefficients)):
        reverse = ~Multivector(series.TYPES[kind.group], tuple(v.coefficients[k]))
        np.testing.assert_array_equal((~v).coefficients[k], reverse.coefficients)
    with pytest.raises((FrozenInstanceError, ValueError)):
        v.coefficients[0, 0] = 2.0
    with pytest.raises(FrozenInstanceError):
        v.coefficients = one


def test_rotors_translators_and_dilators_act_as_named(rng):
    rotor, translator = random(Rotor, rng), random(Translator, rng)
    np.testing.assert_allclose(action(rotor)[:, :3, :3], rotor.matrix(), atol=1e-14)
    np.testing.assert_allclose(action(translator)[:, :3, 3], translator.vector(), atol=1e-14)
    d = rng.uniform(0.1, 5.0, 7)
    np.testing.assert_allclose(action(Dilator.from_scale(d))[:, 0, 0], d, rtol=1e-14)
    x = np.array([0.3, -1.0, 2.0])
    np.testing.assert_allclose(Translator.from_vector(x).vector(), x)
    quarter = Rotor.from_vector((0.0, 0.0, np.pi / 2))
    np.testing.assert_allclose(quarter.matrix() @ (1, 0, 0), (0, 1, 0), atol=3e-16)
    np.testing.assert_allclose(Motor.from_pose(random(Motor, rng).pose()).pose()[..., 3, :], np.tile((0.0, 0.0, 0.0, 1.0), (7, 1)))


def test_similarities_from_their_parts_and_back(rng):
    t, rotor = rng.normal(size=(2, 5, 3)), random(Rotor, rng, 5)
    for d in (np.full((2, 5), 1.0), 10 ** rng.uniform(-6, 6, (2, 5)), 1.0 + np.full((2, 5), 1e-12)):
        v = Similarity.from_parts(t, rotor, d)
        np.testing.assert_allclose(v.scale(), d, rtol=1e-15)
        np.testing.assert_allclose(v.translation(), t, rtol=0, atol=2e-15 * np.abs(t).max())
        np.testing.assert_allclose(v.rotation().matrix(), rotor.matrix() + np.zeros((2, 1, 1, 1)), atol=5e-16)
        np.testing.assert_array_equal(Similarity.from_parts(t, rotor.matrix(), d).coefficients.shape, (2, 5, 12))
        np.testing.assert_allclose(v.log()[..., 3], -np.log(d), rtol=1e-15, atol=0)
    near = Similarity.from_parts(t[0], rotor, np.full(5, 2.0))
    np.testing.assert_allclose(near.matrix(), action(near), atol=1e-13)
    np.testing.assert_allclose(Similarity(-near.coefficients).matrix(), near.matrix(), atol=1e-15)
    factors = Translator.from_vector(t[0]) * near.rotation() * Dilator.from_scale(np.full(5, 2.0))
    np.testing.assert_allclose(factors.coefficients, near.coefficients, atol=1e-15)


@pytest.mark.parametrize("scale", [0.0, -1.0, [1.0, -2.0]])
def test_scales_that_are_not_positive_are_refused(scale):
    with pytest.raises(cga.DegenerateError, match="scale: .* given, a number above 0 needed"):
        Dilator.from_scale(scale)
    with pytest.raises(cga.DegenerateError, match="scale: .* given, a number above 0 needed"):
        Similarity.from_parts(np.zeros(3), np.eye(3), scale)


def test_what_is_no_versor_is_refused():
    off = np.zeros(12)
    off[[0, 4]] = 1.0, 0.5  # cosh without its sinh
    slanted = np.zeros(12)
    slanted[[0, 9]] = 2**0.5, 1.0  # 1 and e013i: the two rotors differ
    study = np.zeros(12)
    study[[0, 11]] = 1.0, 0.5  # a scalar with e123i
    for wrong in (off, slanted, study):
        with pytest.raises(cga.DegenerateError, match="similarity: V ~V must be 1; it is off by .* Similarity.from_parts makes one"):
            Similarity(wrong)
    with pytest.raises(cga.DegenerateError, match="rotor: V ~V must be 1; it is off by 2.1e-01"):
        Rotor((1.1, 0, 0, 0))
    with pytest.raises(cga.DegenerateError, match="translator: V ~V must be 1"):
        Translator((2.0, 0, 0, 1.0))
    with pytest.raises(cga.DegenerateError, match="dilator: V ~V must be 1"):
        Dilator((1.0, 2.0))
    with pytest.raises(cga.DegenerateError, match="rotation: its 3x3 block is a reflection"):
        Rotor.from_matrix(-np.eye(3))
    with pytest.raises(cga.DegenerateError, match="rotation: its 3x3 block is not a rotation"):
        Similarity.from_parts(np.zeros(3), 2 * np.eye(3), 1.0)
    with pytest.raises(cga.WrongSizeError, match="similarity: batch dimensions"):
        Similarity.from_parts(np.zeros((2, 3)), np.eye(3), np.ones(3))
    with pytest.raises(cga.NotFiniteError, match="scale holds NaN"):
        Similarity.from_parts(np.zeros(3), np.eye(3), np.nan)
    with pytest.raises(TypeError):
        Rotor((1.0, 0, 0, 0)) * 2.0
