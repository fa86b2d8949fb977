"""The references of the exp and log tests agree with each other: closed forms with power series, Newton's method with both."""

import exp_log_closed as closed
import exp_log_series as series
import numpy as np
import pytest

from cga_runtime.exp_log import BIVECTORS

CASES = [(group, chart) for group in BIVECTORS for chart in ("split", "lie")]


@pytest.mark.parametrize(("group", "chart"), CASES)
@pytest.mark.parametrize("size", [0.0, 1e-12, 1e-3, 0.4, 1.5])
def test_closed_forms_are_the_power_series(group, chart, size, rng):
    b = size * rng.uniform(-1, 1, len(BIVECTORS[group]))
    by_series, by_closed_form = series.exp(group, b, chart), closed.exp(group, b, chart)
    assert max(abs(x - y) for x, y in zip(by_series, by_closed_form, strict=True)) < 1e-48


@pytest.mark.parametrize(("group", "chart"), CASES)
@pytest.mark.parametrize("size", [1e-4, 0.4, 1.5])
def test_newton_finds_the_closed_logarithm(group, chart, size, rng):
    b = size * rng.uniform(-1, 1, len(BIVECTORS[group]))
    rounded = [float(x) for x in series.exp(group, b, chart)]  # a little off the group
    by_newton, by_closed_form = series.log(group, rounded, b, chart), closed.log(group, rounded, chart)
    assert max(abs(x - y) for x, y in zip(by_newton, by_closed_form, strict=True)) < 1e-40
    assert max(abs(float(x) - y) for x, y in zip(by_newton, b, strict=True)) < 1e-14


def test_an_error_of_one_unit_in_the_last_place_is_seen():
    names = ("e12", "e1i")
    assert closed.error([1.0, 1e6], series.exact([1.0, 1e6]), names, {"e12": None, "e1i": None}) == 0.0
    assert closed.error([1.0, np.nextafter(1e6, 2e6)], series.exact([1.0, 1e6]), names, {"e12": None, "e1i": None}) == pytest.approx(
        1.2e-16, 0.1
    )
