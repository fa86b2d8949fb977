"""Inverse kinematics of the Panda: how many of 10^4 random targets are reached, how fast, and how many inside the joint limits.

    ./run shell python scripts/panda_inverse_kinematics.py [SAMPLES]

Targets are poses of the flange at positions drawn uniformly inside the limits; starts are drawn alike. A result counts if Pinocchio's
kinematics agrees to 1e-6 m and 1e-6 rad. First the experiment of paper B, section VI-C (85.39 %, 11.2 iterations, limits ignored), then
the default method with fewer starts, then as it is, on seeds of its own. iterations: mean over the targets reached, of all their starts
together. us: time for a target.
"""

import sys
from time import perf_counter

import numpy as np
import pinocchio
from rich.console import Console
from rich.progress import track
from rich.table import Column, Table

import cga_runtime as cga
from cga_runtime.descriptions import bundled_file
from cga_runtime.solve.inverse_kinematics import inverse_kinematics

FLANGE = "panda_link8"
TOLERANCE = 1e-6
PLAIN = {"method": "gauss_newton"}
ROWS = [
    ("paper B, 20 steps", 1, PLAIN | {"max_iterations": 20}),
    ("paper B, 50 steps", 1, PLAIN | {"max_iterations": 50}),
    ("paper B, 100 steps", 1, PLAIN),
    ("paper B, 200 steps", 1, PLAIN | {"max_iterations": 200}),
    ("no limits, 1 start", 1, {"limits": False, "restarts": 0}),
    ("limits, 1 start", 1, {"restarts": 0}),
    ("limits, 10 starts", 1, {"restarts": 9}),
    ("limits, 30 starts", 1, {"restarts": 29}),
    *((f"default, seed {seed}", seed, {}) for seed in (101, 102, 103)),
]


class Flange:
    """Pinocchio's kinematics of the flange."""

    def __init__(self, arm: cga.Chain) -> None:
        self.model = pinocchio.buildModelFromUrdf(str(bundled_file("panda")))
        self.data, self.frame = self.model.createData(), self.model.getFrameId(FLANGE)
        self.places = [self.model.joints[self.model.getJointId(name)].idx_q for name in arm.joint_names]

    def pose(self, q: np.ndarray) -> pinocchio.SE3:
        full = pinocchio.neutral(self.model)
        full[self.places] = q
        pinocchio.framesForwardKinematics(self.model, self.data, full)
        return self.data.oMf[self.frame].copy()

    def agree(self, q: np.ndarray, wanted: np.ndarray) -> np.ndarray:
        """Whether the poses at two lists of positions are the same within the tolerance."""
        return np.array([self._same(self.pose(a), self.pose(b)) for a, b in zip(q, wanted, strict=True)])

    @staticmethod
    def _same(a: pinocchio.SE3, b: pinocchio.SE3) -> bool:
        turn = pinocchio.log3(a.rotation.T @ b.rotation)
        return max(np.linalg.norm(a.translation - b.translation), np.linalg.norm(turn)) <= TOLERANCE


def main(samples: int) -> None:
    """Measures and prints the table."""
    arm = cga.load_robot("panda").chain(FLANGE)
    flange = Flange(arm)
    inverse_kinematics(arm, arm.pose(arm.random(np.random.default_rng(0), 10)))  # compiles the kernels
    columns = ("method", "reached", "inside", "iterations", "starts", "us")
    table = Table(*(Column(name, no_wrap=True) for name in columns), title=f"Panda, {samples} targets")
    for name, seed, options in track(ROWS, "solving", console=Console(stderr=True), transient=True):
        rng = np.random.default_rng(seed)
        wanted = arm.random(rng, samples)
        targets = cga.Motor(arm.motor(wanted))
        begun = perf_counter()
        found = inverse_kinematics(arm, targets, rng=rng, tolerance=TOLERANCE, **options)
        spent = perf_counter() - begun
        reached = found.success & flange.agree(found.q, wanted)
        inside = reached & ((arm.lower <= found.q) & (found.q <= arm.upper)).all(axis=1)
        table.add_row(
            name,
            f"{reached.mean():.2%}",
            f"{inside.mean():.2%}",
            f"{found.iterations[reached].mean():.1f}",
            f"{found.starts.mean():.2f}",
            f"{1e6 * spent / samples:.0f}",
        )
    Console().print(table)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
