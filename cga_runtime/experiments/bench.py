"""Times kernels against Pinocchio through Python: the same results, in one process, in interleaved rounds; values are compared first."""

from __future__ import annotations

import json
import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter_ns
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.cache import write_atomic
from cga_runtime.descriptions import bundled_file
from cga_runtime.errors import CgaError, MissingExtraError
from cga_runtime.loading import load_robot

Array = NDArray[np.float64]

ROUNDS = 15
VALUE_TOLERANCE = 1e-12


@dataclass(frozen=True)
class Contest:
    """The same result from us and from a peer; each call uses configuration k."""

    group: str
    robot: str
    operation: str
    ours: Callable[[int], Any]
    peer: Callable[[int], Any]
    peer_name: str
    configurations: int
    per_call: int = 1


def nao_contests(configurations: int = 256) -> list[Contest]:
    """Forward kinematics and frame Jacobian of the NAO's right arm, single calls through Python, and a batch."""
    try:
        import pinocchio as pin
    except ImportError as error:
        raise MissingExtraError("the benchmark", "pinocchio (pip name: pin)", "urdf") from error
    arm = load_robot("nao").chain("RHand")
    model = pin.buildModelFromUrdf(str(bundled_file("nao")))
    # the peer gets the arm alone: only these joints move, like the chain
    keep = set(arm.joint_names)
    model = pin.buildReducedModel(model, [model.getJointId(n) for n in model.names[1:] if n not in keep], pin.neutral(model))
    data, frame = model.createData(), model.getFrameId("RHand")
    q = arm.random(np.random.default_rng(0), configurations)
    rows = [np.ascontiguousarray(row) for row in q]

    def peer_pose(k: int) -> Any:
        pin.framesForwardKinematics(model, data, rows[k])
        return data.oMf[frame].homogeneous

    def peer_jacobian(k: int) -> Any:
        return pin.computeFrameJacobian(model, data, rows[k], frame, pin.LOCAL_WORLD_ALIGNED)

    def peer_poses(_: int) -> Any:
        return np.stack([peer_pose(k) for k in range(configurations)])

    def peer_jacobians(_: int) -> Any:
        return np.stack([peer_jacobian(k) for k in range(configurations)])

    name = f"pinocchio {pin.__version__} (Python)"
    return [
        Contest("python_call", "nao", "forward_kinematics", lambda k: arm.pose(rows[k]), peer_pose, name, configurations),
        Contest("python_call", "nao", "frame_jacobian", lambda k: arm.jacobian(rows[k]), peer_jacobian, name, configurations),
        Contest("batch_f64", "nao", "forward_kinematics", lambda k: arm.pose(q), peer_poses, name, 1, configurations),
        Contest("batch_f64", "nao", "frame_jacobian", lambda k: arm.jacobian(q), peer_jacobians, name, 1, configurations),
    ]


def measure(contest: Contest, rounds: int = ROUNDS) -> dict[str, Any]:
    """One row: medians of interleaved rounds, nanoseconds per configuration. CgaError if the values differ: a wrong kernel is not timed."""
    error = max(float(np.abs(contest.ours(k) - contest.peer(k)).max()) for k in range(contest.configurations))
    if not error <= VALUE_TOLERANCE:
        raise CgaError(f"{contest.robot} {contest.operation}: differs from {contest.peer_name} by {error:.1e}; not timed")
    times: dict[str, list[float]] = {"ours": [], "peer": []}
    for _ in range(rounds):
        for side, call in (("ours", contest.ours), ("peer", contest.peer)):
            begin = perf_counter_ns()
            for k in range(contest.configurations):
                call(k)
            times[side].append((perf_counter_ns() - begin) / (contest.configurations * contest.per_call))
    ours, peer = float(np.median(times["ours"])), float(np.median(times["peer"]))
    return {
        "group": contest.group,
        "robot": contest.robot,
        "operation": contest.operation,
        "ours": "cga (Python)",
        "peer": contest.peer_name,
        "ours_ns": ours,
        "peer_ns": peer,
        "ratio": peer / ours,
        "value_error": error,
    }


def run(rounds: int = ROUNDS) -> list[dict[str, Any]]:
    """All rows."""
    from cga_runtime.experiments.cooperative_contests import cooperative_contests

    return [measure(contest, rounds) for contest in (*nao_contests(), *cooperative_contests())]


def write(rows: Sequence[dict[str, Any]], folder: Path) -> None:
    """bench.json and table.md in `folder`."""
    columns = ("group", "robot", "operation", "ours_ns", "peer", "peer_ns", "ratio", "value_error")
    machine = f"Python {platform.python_version()}, {platform.machine()}, {platform.system()}"
    lines = [f"{machine}; medians, ns per configuration, one process.", ""]
    lines += ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(f"{row[c]:.4g}" if isinstance(row[c], float) else str(row[c]) for c in columns) + " |" for row in rows]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_atomic(folder / "bench.json", (json.dumps(list(rows), indent=1) + "\n").encode(), mode=0o644)
        write_atomic(folder / "table.md", ("\n".join(lines) + "\n").encode(), mode=0o644)
    except OSError as error:
        raise CgaError(f"cannot write {error.filename or folder}: {error.strerror}") from error
