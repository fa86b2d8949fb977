"""Cooperative similarity Jacobians, timed: kernels fused for one system against the same put together from chains and primitive."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cga_runtime.experiments.bench import Array, Contest
from cga_runtime.loading import load_robot
from cga_runtime.spaces.cooperative import Cooperative


def around_a_table(count: int, radius: float = 0.8) -> list[Array]:
    """Poses (4, 4) of robots that stand on a circle (m) and look at its centre."""
    poses = []
    for k in range(count):
        turn = 2.0 * math.pi * k / count
        x, y = math.cos(turn), math.sin(turn)
        pose = np.array([[-x, y, 0.0, radius * x], [-y, -x, 0.0, radius * y], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
        poses.append(pose)
    return poses


def three_pandas() -> Cooperative:
    """The system of paper A, section 4.2.2: a circle through the hands of three Pandas."""
    panda = load_robot("panda")
    return Cooperative([panda.chain("panda_link8", placement=pose) for pose in around_a_table(3)], "circle")


def cooperative_contests(configurations: int = 256) -> list[Contest]:
    """Similarity and its geometric Jacobian for three Pandas, single calls and a batch."""
    composed = three_pandas()
    fused = composed.fuse()
    q = composed.random(np.random.default_rng(0), configurations)
    rows = [np.ascontiguousarray(row) for row in q]
    contests = []
    for operation, method in (("similarity", "similarity"), ("similarity_jacobian", "geometric_jacobian")):
        ours, peer = getattr(fused, method), getattr(composed, method)
        # charts are given, as in a control loop, where they are state
        contests.append(_contest("python_call", operation, ours, peer, rows, 1))
        contests.append(_contest("batch_f64", operation, ours, peer, [q], configurations))
    return contests


def _contest(group: str, operation: str, ours: Any, peer: Any, given: list[Array], per_call: int) -> Contest:
    return Contest(
        group,
        "3 x panda",
        operation,
        lambda k: ours(given[k], 1),
        lambda k: peer(given[k], 1),
        "cga, put together (Python)",
        len(given),
        per_call,
    )
