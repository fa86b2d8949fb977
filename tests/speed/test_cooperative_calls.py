"""Benchmarks (pytest-benchmark) of cooperative similarities: kernels fused for a system beside the same put together; see `./run bench`.

As plain tests they check the values of what is timed; speed itself is never asserted here.
"""

import numpy as np
import pytest

from cga_runtime.experiments.bench import VALUE_TOLERANCE
from cga_runtime.experiments.cooperative_contests import cooperative_contests


@pytest.fixture(scope="module")
def contests():
    return {f"{c.group}-{c.operation}": c for c in cooperative_contests(configurations=64)}


@pytest.mark.parametrize("name", [f"{group}-similarity{what}" for group in ("python_call", "batch_f64") for what in ("", "_jacobian")])
@pytest.mark.parametrize("side", ["fused", "put_together"])
def test_call(benchmark, contests, name, side):
    contest = contests[name]
    ours, peer = contest.ours(0), contest.peer(0)
    assert np.abs(ours - peer).max() < VALUE_TOLERANCE * np.abs(peer).max() and np.ptp(ours) > 0.1
    benchmark.group = f"{contest.robot} {name}, {contest.per_call} configuration(s) a call"
    benchmark(contest.ours if side == "fused" else contest.peer, 0)
