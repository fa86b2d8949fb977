"""Products of geometric factors against the 6x6 determinant, sign included, and what each factor means."""

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.closed_forms import determinant_factors
from cga_runtime.errors import DegenerateError, SchemeError
from cga_runtime.loading import load_robot

SCHEMES = [(1, 2, 3, 7), (1, 3, 7, 8), (1, 2, 3, 4), (1, 2, 3, 5), (1, 2, 4, 5), (1, 3, 4, 5)]


def loop_of(robot):
    nao = load_robot(robot)
    return ClosedChain(nao.chain("RHand"), nao.chain("LHand"))


def product(factors):
    return np.prod(np.broadcast_arrays(*factors.values()), axis=0)


@pytest.mark.parametrize("robot", ["nao", "nao_v32"])
@pytest.mark.parametrize("scheme", SCHEMES)
def test_product_of_factors_is_the_determinant(robot, scheme):
    loop = loop_of(robot)
    q = np.random.default_rng(40).uniform(-np.pi, np.pi, (1000, loop.n))
    determinant = loop.determinant(q, scheme)
    assert np.abs(determinant).max() > 0.5
    assert np.abs(product(determinant_factors(loop, q, scheme)) - determinant).max() < 1e-14 * np.abs(determinant).max() * 10


def test_factors_of_example_2_are_the_printed_functions_of_q():
    loop = loop_of("nao")
    q = np.random.default_rng(41).uniform(-np.pi, np.pi, (1000, loop.n))
    factors = determinant_factors(loop, q, (1, 2, 3, 7))
    r3, d3 = 0.105, 0.015
    expected = {
        "-sin q9": -np.sin(q[:, 8]),
        "f right": r3 * np.cos(q[:, 1]) + d3 * np.sin(q[:, 1]),
        "f left": r3 * np.cos(q[:, 6]) - d3 * np.sin(q[:, 6]),
        "sin(q1 - q6)": np.sin(q[:, 0] - q[:, 5]),
    }
    for name, values in expected.items():
        assert np.abs(factors[name] - values).max() < 1e-15, name


def test_a_scheme_without_closed_form_is_refused_by_name():
    with pytest.raises(SchemeError, match=r"scheme \(1, 2, 6, 7\): no closed form is known; known: 1237, 1378"):
        determinant_factors(loop_of("nao"), np.zeros(10), (7, 6, 2, 1))


def test_arms_without_wrist_centres_are_refused():
    nao = load_robot("nao")
    short = ClosedChain(nao.chain("RHand"), nao.chain("LForeArm"))
    with pytest.raises(DegenerateError, match="limb factors need two arms of five revolute joints"):
        determinant_factors(short, np.zeros(9), (1, 2, 3))


def test_shoulders_that_are_not_collinear_are_refused():
    nao = load_robot("nao")
    raised = np.eye(4)
    raised[2, 3] = 0.013
    loop = ClosedChain(nao.chain("RHand"), nao.chain("LHand", placement=raised))
    with pytest.raises(DegenerateError, match="the closed forms need first axes that are one line"):
        determinant_factors(loop, np.zeros(10), (1, 2, 3, 7))
