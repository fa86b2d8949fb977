"""Laws of exp and log, over every group, both charts, and angles from zero over pi to beyond; other libraries; bad input."""

import warnings

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import cga_runtime as cga
from cga_runtime.motors import Motor
from cga_runtime.versor_group import Versor
from cga_runtime.versors import Dilator, Rotor, Similarity, Translator

GROUPS = (Rotor, Translator, Dilator, Motor, Similarity)
CHARTS = ("split", "lie")
ANGLES = (0.0, 1e-300, 1e-160, 1e-16, 1e-12, 1e-8, 1e-4, 0.3, 0.98, 1.02, 2.0, 3.0, np.pi - 1e-8, np.pi - 1e-13)
both = pytest.mark.parametrize("chart", CHARTS)
everywhere = pytest.mark.parametrize("kind", GROUPS)


def bivectors(kind, angle, rng, count=20, size=1.0):
    """Random bivectors with this angle, (count, k)."""
    whole = rng.normal(size=(count, 7))
    whole[:, :3] *= angle / np.linalg.norm(whole[:, :3], axis=1, keepdims=True)
    whole[:, 3:] *= size
    names = ("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i")
    return whole[:, [names.index(name) for name in kind.bivector_blades]]


@everywhere
@both
@pytest.mark.parametrize("angle", ANGLES)
def test_log_undoes_exp(kind, chart, angle, rng):
    for size in (1e-12, 1.0, 3.0):
        b = bivectors(kind, angle, rng, size=size)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            v = kind.exp(b, chart)
            back = v.log(chart)
            other = type(v)(-v.coefficients).log(chart)
        np.testing.assert_allclose(back, b, rtol=0, atol=3e-15 * max(angle, 1e-12, size))
        np.testing.assert_array_equal(other, back)  # V and -V are the same motion


@everywhere
@both
def test_identity_is_exact(kind, chart):
    zero = np.zeros(len(kind.bivector_blades))
    one = kind.exp(zero, chart)
    assert one.coefficients.tolist() == [float(name == "1") for name in kind.blades]
    assert np.array_equal(one.log(chart), zero) and np.array_equal((~one).coefficients, one.coefficients)


@everywhere
@both
@pytest.mark.parametrize("angle", (1e-12, 0.4, 2.0))
def test_batches_are_single_elements_side_by_side(kind, chart, angle, rng):
    b = bivectors(kind, angle, rng, 6).reshape(2, 3, -1)
    v = kind.exp(b, chart)
    assert v.coefficients.shape == (2, 3, len(kind.blades))
    for i, k in np.ndindex(2, 3):
        np.testing.assert_array_equal(v.coefficients[i, k], kind.exp(b[i, k], chart).coefficients)
        np.testing.assert_array_equal(v.log(chart)[i, k], kind(v.coefficients[i, k]).log(chart))
    empty = kind.exp(b[:0], chart)
    assert empty.log(chart).shape == (0, 3, len(kind.bivector_blades))


@everywhere
@pytest.mark.parametrize("angle", (1e-12, 0.4, 1.4))
def test_the_lie_chart_is_a_one_parameter_group(kind, angle, rng):
    b = bivectors(kind, angle, rng)
    v = kind.exp(b, "lie")
    np.testing.assert_allclose((v * v).coefficients, kind.exp(2.0 * b, "lie").coefficients, atol=2e-13)
    np.testing.assert_allclose((~v).coefficients, kind.exp(-b, "lie").coefficients, atol=1e-15 * np.abs(v.coefficients).max())
    np.testing.assert_allclose((kind.exp(0.3 * b, "lie") * kind.exp(0.7 * b, "lie")).coefficients, v.coefficients, atol=2e-14)
    w = kind.exp(bivectors(kind, 0.9, rng), "lie")
    np.testing.assert_allclose((~(v * w)).coefficients, (~w * ~v).coefficients, atol=3e-14)
    np.testing.assert_allclose((w * v * ~w).coefficients[..., 0], v.coefficients[..., 0], atol=1e-13)  # conjugate turns are alike


@pytest.mark.parametrize("kind", (Motor, Similarity))
@pytest.mark.parametrize("angle", (0.0, 1e-12, 0.4, 3.0))
def test_the_split_chart_is_the_product_of_its_factors(kind, angle, rng):
    b = bivectors(kind, angle, rng)
    product = Translator.exp(b[:, -3:]) * Rotor.exp(b[:, :3])
    if kind is Similarity:
        product = product * Dilator.exp(b[:, 3:4])
    assert type(product) is kind
    np.testing.assert_allclose(product.coefficients, kind.exp(b).coefficients, atol=2e-15 * np.abs(product.coefficients).max())
    # and it is not the screw exponential: the papers' exp has no square law
    if angle > 0.1:
        assert np.abs((kind.exp(b) * kind.exp(b)).coefficients - kind.exp(2 * b).coefficients).max() > 0.1


@both
def test_a_similarity_without_scale_is_a_motor(chart, rng):
    for angle in ANGLES:
        b = bivectors(Motor, angle, rng)
        wide = np.insert(b, 3, 0.0, axis=-1)
        similarity, motor = Similarity.exp(wide, chart), Motor.exp(b, chart)
        np.testing.assert_allclose(similarity.coefficients, motor.embedded("similarity"), atol=1e-15)
        np.testing.assert_allclose(similarity.log(chart), np.insert(motor.log(chart), 3, 0.0, axis=-1), atol=2e-15)


@both
@pytest.mark.parametrize("kind", (Rotor, Motor, Similarity))
def test_beyond_pi_log_takes_the_shorter_way(kind, chart, rng):
    for angle in (np.pi + 1e-8, 4.0, 6.0, 2 * np.pi - 1e-9):
        b = bivectors(kind, angle, rng)
        v = kind.exp(b, chart)
        short = v.log(chart)
        np.testing.assert_allclose(np.linalg.norm(short[:, :3], axis=1), 2 * np.pi - angle, atol=2e-15 * np.pi)
        np.testing.assert_allclose(short[:, :3], b[:, :3] * (1 - 2 * np.pi / angle), atol=3e-15)
        again = kind.exp(short, chart).coefficients
        np.testing.assert_allclose(again, -v.coefficients, atol=1e-14 * np.abs(again).max())


@both
@pytest.mark.parametrize("kind", (Rotor, Motor, Similarity))
def test_at_pi_the_first_component_that_is_not_zero_is_positive(kind, chart):
    for axis in np.array([(0, 0, 1), (0, 1, 0), (1, 0, 0), (0, -0.6, 0.8), (-0.8, 0, 0.6), (0.48, 0.6, -0.64)]):
        for sign in (1.0, -1.0):
            x, y, z = sign * axis
            rotor = np.zeros(len(kind.blades))
            rotor[:4] = sign * 0.0, -z, y, -x
            w = kind(rotor).log(chart)[[2, 1, 0]] * (1, -1, 1)
            np.testing.assert_allclose(w, np.pi * axis * np.sign(axis[np.nonzero(axis)[0][0]]), atol=1e-15)


def test_rotors_are_those_of_scipy(rng):
    w = np.concatenate([rng.normal(size=(50, 3)) * 10.0 ** rng.uniform(-12, 0.2, (50, 1)), np.zeros((1, 3))])
    rotor, theirs = Rotor.from_vector(w), Rotation.from_rotvec(w)
    np.testing.assert_allclose(rotor.matrix(), theirs.as_matrix(), atol=4e-16)
    np.testing.assert_allclose(rotor.vector(), theirs.as_rotvec(), rtol=0, atol=1e-15)
    np.testing.assert_allclose(Rotor.from_matrix(theirs.as_matrix()).matrix(), theirs.as_matrix(), atol=1e-15)


def test_motors_in_the_lie_chart_are_those_of_pinocchio(rng):
    import pinocchio

    for angle in (0.0, 1e-12, 1e-6, 1e-3, 0.5, 2.0, 3.1):
        for b in bivectors(Motor, angle, rng, 5):
            twist = np.array([*b[3:], b[2], -b[1], b[0]])  # v, w
            pose = pinocchio.exp6(pinocchio.Motion(twist))
            np.testing.assert_allclose(Motor.exp(b, "lie").pose(), pose.homogeneous, atol=3e-15)
            # their log of a matrix is less accurate near pi, and near zero
            np.testing.assert_allclose(Motor.from_pose(pose.homogeneous).log("lie"), b, atol=1e-13)
            np.testing.assert_allclose(pinocchio.log6(pose).vector[:3], Motor.exp(b, "lie").log("lie")[3:], atol=1e-7)


@everywhere
def test_bad_input_is_named(kind):
    k = len(kind.bivector_blades)
    with pytest.raises(cga.WrongSizeError, match=rf"bivector of a {kind.group}: shape \({k + 1},\) given, \(..., {k}\) needed"):
        kind.exp(np.zeros(k + 1))
    with pytest.raises(cga.NotFiniteError, match="NaN"):
        kind.exp(np.full(k, np.nan))
    with pytest.raises(cga.WrongSizeError, match=f"{kind.group}: shape"):
        kind(np.zeros(len(kind.blades) + 1))
    with pytest.raises(cga.NotFiniteError, match=f"{kind.group} holds NaN"):
        kind(np.full(len(kind.blades), np.nan))
    for wrong in (np.zeros(len(kind.blades)), 1.001 * kind.exp(np.zeros(k)).coefficients):
        with pytest.raises(cga.DegenerateError, match=f"{kind.group}: . ~. must be 1"):
            kind(wrong)
    b, v = np.zeros(k), kind.exp(np.zeros(k))
    for call in (lambda: kind.exp(b, "screw"), lambda: v.log("screw"), lambda: kind.right_jacobian(b, "x"), lambda: v.log_jacobian("")):
        with pytest.raises(cga.UnknownNameError, match="unknown chart '.*'; known: split, lie"):
            call()


def test_what_no_float_can_hold_is_refused():
    for kind, b in (
        (Rotor, (1e200, 0, 0)),
        (Dilator, (-2000.0,)),
        (Similarity, (0, 0, 0, 2000.0, 1, 1, 1)),
        (Motor, (1e200, 0, 0, 0, 0, 0)),
    ):
        for chart in CHARTS:
            with pytest.raises(cga.DegenerateError, match=f"{kind.group}: the exponential of a bivector of size .* is too large"):
                kind.exp(b, chart)


def test_there_is_one_class_for_each_group():
    assert Versor.classes == {kind.group: kind for kind in GROUPS}
