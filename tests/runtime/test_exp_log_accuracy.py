"""Exp and log of every group and chart against 50 digits: from 1e-300 rad to pi, 1e-12 to 1e6 m, scales 1e-6 to 1e6."""

import exp_log_closed as closed
import numpy as np
import pytest

from cga_runtime.exp_log import BIVECTORS, BLADES, exp, log
from cga_runtime.smooth import NUMPY

BOUND = {"rotor": 4e-16, "translator": 4e-16, "dilator": 4e-16, "motor": 4e-16, "similarity": 4e-16}
"""Of the errors of rotation, scale and translation, each by its own size (versor_group says which)."""
CASES = [(group, chart) for group in BLADES for chart in (("split", "lie") if group in ("motor", "similarity") else ("split",))]
ROTATION, SCALE, MOVED = "e12 e13 e23", "e0i e012i e013i e023i", "e1i e2i e3i e123i"
PARTS = {"rotor": slice(0, 3), "translator": slice(4, 7), "dilator": slice(3, 4), "motor": [0, 1, 2, 4, 5, 6], "similarity": slice(0, 7)}


def samples(group, count, rng):
    """Bivectors (count, k) spread over the orders of magnitude of angle, length and scale."""
    tiny, small, near_pi = (10 ** rng.uniform(*exponents, count) for exponents in ((-300, -16), (-16, 0), (-15, -1)))
    angle = np.pi * np.stack([tiny, small, 1 - near_pi, rng.uniform(0, 1, count)])[rng.integers(0, 4, count), np.arange(count)]
    axis, v = rng.normal(size=(2, count, 3))
    scale = np.where(rng.random(count) < 0.5, rng.uniform(-14, 14, count), 10 ** rng.uniform(-16, 1, count) * rng.choice([-1, 1], count))
    w = (angle / np.linalg.norm(axis, axis=1))[:, None] * axis
    whole = np.concatenate([w, scale[:, None], 10 ** rng.uniform(-12, 6, (count, 1)) * v], axis=1)
    return whole[:, PARTS[group]]


def sizes(group, bivector, chart):
    """By what the error of each part of exp(B) is divided: None is its own size."""
    b = dict(zip(BIVECTORS[group], bivector, strict=True))
    h, v = -0.5 * b.get("e0i", 0.0), [b.get(name, 0.0) for name in ("e1i", "e2i", "e3i")]
    stretch = np.exp(-h) if chart == "split" else (np.sinh(h) / h if h else 1.0)
    return {"1": np.cosh(h), ROTATION: None, SCALE: None, MOVED: 0.5 * np.linalg.norm(v) * stretch}


@pytest.mark.parametrize(("group", "chart"), CASES)
def test_exp_and_log_are_right_to_the_last_digits(group, chart, rng):
    bivectors = samples(group, 120, rng)
    with np.errstate(all="raise", under="ignore"):
        versors = np.stack(exp(NUMPY, group, bivectors.T, chart), axis=-1)
    worst = [0.0, 0.0]
    for b, v in zip(bivectors, versors, strict=True):
        reference = closed.exp(group, b, chart)
        worst[0] = max(worst[0], closed.error(v, reference, BLADES[group], sizes(group, b, chart)))
        rounded = np.array([float(x) for x in reference])
        with np.errstate(all="raise", under="ignore"):
            found = log(NUMPY, group, rounded, chart)
        parts = {ROTATION: None, SCALE: None, MOVED: None}
        worst[1] = max(worst[1], closed.error(found, closed.log(group, rounded, chart), BIVECTORS[group], parts))
    assert max(worst) < BOUND[group]


@pytest.mark.parametrize(("group", "chart"), CASES)
def test_log_undoes_exp_to_the_last_digits(group, chart, rng):
    # the rounding of the versor comes on top: near pi the angle is as sure as the scalar part, in units of one
    bivectors = samples(group, 400, rng)
    back = np.stack(log(NUMPY, group, exp(NUMPY, group, bivectors.T, chart), chart), axis=-1)
    for block in (ROTATION, SCALE, MOVED):
        at = [k for k, name in enumerate(BIVECTORS[group]) if name in block.split()]
        # the translation of the split chart is carried by e^-h
        error = np.linalg.norm((back - bivectors)[:, at], axis=-1) / np.maximum(np.linalg.norm(bivectors[:, at], axis=-1), 1e-300)
        flipped = np.linalg.norm((back + bivectors)[:, at], axis=-1) < 1e-14  # beyond pi by rounding: the other way round
        near = np.linalg.norm(bivectors[:, :3], axis=-1) > np.pi - 1e-15
        assert np.where(flipped & near, 0.0, error).max(initial=0.0) < 2.0 * BOUND[group]


@pytest.mark.parametrize("angle", [1e-160, 1e-300, 5e-324])
@pytest.mark.parametrize("chart", ["split", "lie"])
def test_the_smallest_angles_are_kept_exactly(angle, chart):
    b = np.array([0.0, angle, 0.0, 3.0, -2.0, 7.0])
    motor = np.array(exp(NUMPY, "motor", b, chart))
    assert motor[0] == 1.0 and motor[2] == -0.5 * angle
    np.testing.assert_array_equal(log(NUMPY, "motor", [1.0, 0.0, -angle, 0.0, -1.5, 1.0, -3.5, 0.0], chart)[1], 2.0 * angle)
    np.testing.assert_allclose(motor[4:7], (-1.5, 1.0, -3.5), rtol=1e-16)


@pytest.mark.parametrize("turns", [1.5, 7.0, 1e3])
def test_beyond_pi_the_error_is_that_of_the_angle(turns, rng):
    for chart in ("split", "lie"):
        b = np.array([*turns * np.pi * np.array([0.6, 0.0, -0.8]), *rng.normal(size=3)])
        size = np.linalg.norm(b[3:])
        made, reference = exp(NUMPY, "motor", b, chart), closed.exp("motor", b, chart)
        scales = {f"1 {ROTATION}": 1.0 + turns * np.pi, MOVED: (1.0 + turns * np.pi) * size}
        assert closed.error(made, reference, BLADES["motor"], scales) < 4e-16


@pytest.mark.parametrize("chart", ["split", "lie"])
def test_log_does_not_depend_on_the_size_of_a_motor(chart, rng):
    b = samples("motor", 40, rng)
    versors = np.stack(exp(NUMPY, "motor", b.T, chart))
    grown = 1.7 * versors
    # times 1 + 0.1 e123i: what rounding does to M ~M
    grown[4:] += 0.17 * versors[[3, 2, 1, 0]] * np.array([-1.0, 1.0, -1.0, 1.0])[:, None]
    np.testing.assert_allclose(
        np.array(log(NUMPY, "motor", grown, chart)), np.array(log(NUMPY, "motor", versors, chart)), rtol=1e-12, atol=1e-13
    )
