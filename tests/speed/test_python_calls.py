"""Benchmarks (pytest-benchmark) of single calls through Python, ours and Pinocchio's side by side; run by `./run bench`.

As plain tests they check the values of what is timed; speed itself is never asserted here.
"""

import numpy as np
import pytest

from cga_runtime.experiments.bench import VALUE_TOLERANCE, Contest, measure, nao_contests

CONTESTS = {f"{c.group}-{c.operation}": c for c in nao_contests(configurations=64)}


@pytest.mark.parametrize("name", CONTESTS)
@pytest.mark.parametrize("side", ["cga", "pinocchio"])
def test_call(benchmark, name, side):
    contest = CONTESTS[name]
    ours, peer = contest.ours(0), contest.peer(0)
    assert np.abs(ours - peer).max() < VALUE_TOLERANCE
    benchmark.group = f"{contest.robot} {name}, {contest.per_call} configuration(s) a call"
    benchmark(contest.ours if side == "cga" else contest.peer, 0)


def test_a_wrong_kernel_is_not_timed():
    wrong = Contest("single", "nao", "forward_kinematics", lambda k: np.eye(4), lambda k: 2.0 * np.eye(4), "peer", 1)
    with pytest.raises(Exception, match="differs from peer by 1.0e[+]00; not timed"):
        measure(wrong, rounds=1)
