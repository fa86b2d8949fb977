"""Exp and log as casadi functions: values and slopes are numpy's, second derivatives are right, at the identity and at pi too."""

import exp_log_closed as closed
import exp_log_series as series
import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.exp_log import BIVECTORS, BLADES
from cga_runtime.exp_log_symbolic import exp_function, log_function
from cga_runtime.versors import Versor

CASES = [(group, chart) for group in BLADES for chart in (("split", "lie") if group in ("motor", "similarity") else ("split",))]
ANGLES = (0.0, 1e-300, 1e-7, 3e-3, 0.1, 0.4, 1.02, 1.98, np.pi - 1e-9)
SIZES = (0.0, 1e-9, 2.2)


@pytest.fixture(scope="module")
def derivatives():
    """casadi.Functions x -> value, Jacobian, Hessians (one row for each pair of component and variable); made once."""
    import casadi

    made = {}
    for group, chart in CASES:
        for name, function in (("exp", exp_function(group, chart)), ("log", log_function(group, chart))):
            x = casadi.SX.sym("x", function.size1_in(0))
            jacobian = casadi.jacobian(function(x), x)
            made[group, chart, name] = casadi.Function(name, [x], [function(x), jacobian, casadi.jacobian(jacobian, x)])
    return made


def elements(group, chart, angle, rng):
    """Bivectors with this angle and several sizes, and their versors."""
    for size in SIZES:
        whole = rng.normal(size=7) * size
        axis = rng.normal(size=3)
        whole[:3] = angle * axis / np.linalg.norm(axis)
        b = whole[[("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i").index(name) for name in BIVECTORS[group]]]
        yield b, Versor.classes[group].exp(b, chart)


@pytest.mark.parametrize(("group", "chart"), CASES)
@pytest.mark.parametrize("angle", (*ANGLES, np.pi, 4.0))
def test_values_and_first_derivatives_are_those_of_numpy(group, chart, angle, rng, derivatives):
    for b, v in elements(group, chart, angle, rng):
        for name, at, value, jacobian in (
            ("exp", b, v.coefficients, v.exp_jacobian(b, chart)),
            ("log", v.coefficients, v.log(chart), v.log_jacobian(chart)),
        ):
            found, slope, _ = (np.array(x) for x in derivatives[group, chart, name](at))
            np.testing.assert_allclose(found.ravel(), value, atol=1e-15 * max(1e-300, np.abs(value).max()))
            np.testing.assert_allclose(slope, jacobian, atol=4e-15 * np.abs(jacobian).max())


@pytest.mark.parametrize(("group", "chart"), CASES)
@pytest.mark.parametrize("angle", ANGLES)
def test_second_derivatives_are_right(group, chart, angle, rng, derivatives):
    for b, v in elements(group, chart, angle, rng):
        for name, at, formula in (("exp", b, closed.exp), ("log", v.coefficients, closed.log)):
            second = np.array(derivatives[group, chart, name](at)[2])
            size = len(at)
            hessians = second.reshape(size, -1, size).transpose(1, 0, 2)  # [component, variable, variable]
            assert np.isfinite(second).all()
            for direction in rng.normal(size=(1, size)):
                _, expected = series.along(lambda x, formula=formula: formula(group, x, chart), at, direction)
                found = np.einsum("kij,i,j->k", hessians, direction, direction)
                np.testing.assert_allclose(found, expected, rtol=0, atol=1e-30 + 4e-14 * np.abs(hessians).max() * (direction @ direction))


@pytest.mark.parametrize("name", ["exp", "log"])
def test_every_derivative_at_the_identity_is_finite(name, derivatives):
    for group, chart in CASES:
        at = np.zeros(len(BIVECTORS[group])) if name == "exp" else np.eye(len(BLADES[group]))[0]
        assert all(np.isfinite(np.array(x)).all() for x in derivatives[group, chart, name](at))


def test_functions_are_made_once_and_name_their_ends():
    f = log_function("motor", "lie")
    assert f is log_function("motor", "lie") and (f.name_in(0), f.name_out(0)) == ("versor", "bivector")
    assert f.name() == "motor_log_lie"


def test_unknown_names_are_refused():
    with pytest.raises(
        cga.UnknownNameError, match="unknown group of versors 'motors'; known: rotor, translator, dilator, motor, similarity"
    ):
        exp_function("motors")
    with pytest.raises(cga.UnknownNameError, match="unknown chart 'screw'; known: split, lie"):
        log_function("motor", "screw")
