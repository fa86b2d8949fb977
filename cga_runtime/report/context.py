"""What every section of the report is given: the robot, its closed chain, how much to compute, and what earlier sections found."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.certificates import NotRationalError, RationalArm, mirror_signs
from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.singularities import limb_loci
from cga_runtime.errors import CgaError
from cga_runtime.report.arms import Arms, arms_at
from cga_runtime.robot import Robot
from cga_runtime.spaces.cooperative import Cooperative

Array = NDArray[np.float64]

ARMS = ("RHand", "LHand")
NEEDED = ("limb_factors", "wrist_centres", "constraint_wrenches")
"""Kernels that only exist for arms of a universal and a spherical joint."""
GENERIC_POSE = (0.55, -0.45, 0.9, 0.95, 0.2, 0.25, 0.35, -0.8, -1.2, 0.3)
"""The asymmetric pose (rad) at which generic statements are drawn: no two joint axes of different arms meet, except the shoulders'."""

PARALLEL_ARM = (0.35, 0.0, 1.4, 0.6, 0.2)
"""Right arm (rad) of the parallel pose, save its second joint, which follows from the geometry: hands in front, 12 cm apart for the NAO."""


class ReportRobotError(CgaError, ValueError):
    """The report is about two arms of a universal and a spherical joint each; this robot does not have them."""


@dataclass(frozen=True)
class Sizes:
    """How much is computed. samples: poses of the scheme atlas; tries: reaching problems a task; poses: starts of the nearest-singularity
    searches; grid: points along a side of each map; rounds: repetitions of each timing."""

    samples: int = 3000
    tries: int = 100
    poses: int = 20
    grid: int = 81
    rounds: int = 7


@dataclass
class Context:
    """One report in the making; `data` grows section by section, in the order of build.SECTIONS."""

    robot: Robot
    sizes: Sizes
    seed: int = 0
    say: Callable[[str], None] = lambda text: None
    data: dict[str, Any] = field(default_factory=dict)

    @cached_property
    def loop(self) -> ClosedChain:
        """The two hands on one object. Raises ReportRobotError for robots of another kind."""
        return closed_chain(self.robot)

    @cached_property
    def pair(self) -> Cooperative:
        """The point pair of the hands, from the right one to the left."""
        return Cooperative([self.loop.right, self.loop.left], "point_pair")

    @cached_property
    def line(self) -> Cooperative:
        """The line of the hands, from the right one to the left."""
        return Cooperative([self.loop.right, self.loop.left], "line")

    @cached_property
    def limits(self) -> Array:
        """Joint limits, (2, n): lower, upper (rad)."""
        return np.stack([self.loop.lower, self.loop.upper])

    @cached_property
    def q2_star(self) -> tuple[float, float]:
        """ShoulderRoll positions (rad) of the right and left arm at which the S centre lies on the ShoulderPitch axis (paper C, 5.1)."""
        right, left = limb_loci(self.loop)
        return right.q2_star, left.q2_star

    @cached_property
    def parallel_pose(self) -> Array:
        """A mirror-symmetric pose with both upper arms (lines U S) normal to the common ShoulderPitch axis, hence parallel."""
        right = np.array(PARALLEL_ARM)
        # a quarter turn from the position on the axis; of the two, the one nearer to the middle of the limits
        right[1] = min((self.q2_star[0] + turn for turn in (np.pi / 2, -np.pi / 2)), key=lambda x: abs(x - self.limits[:, 1].mean()))
        return np.concatenate([right, self.mirror * right])

    @cached_property
    def mirror(self) -> Array:
        """Signs s with q_left = s q_right for mirrored hands; those of the NAO where the arms are not exact mirror images."""
        try:
            signs = mirror_signs(RationalArm.of(self.loop.right), RationalArm.of(self.loop.left))
        except NotRationalError:
            signs = None
        return np.array(signs or (1.0, -1.0, -1.0, -1.0, -1.0))

    def arms(self, q: Array) -> Arms:
        """Where axes and centres of both arms lie at q."""
        return arms_at(self.loop, q)


def closed_chain(robot: Robot) -> ClosedChain:
    """The robot's closed chain RHand + LHand. Raises ReportRobotError saying what is missing."""
    missing = [frame for frame in ARMS if frame not in robot.frame_names]
    if missing:
        raise ReportRobotError(f"{robot.name} has no frame {' and no frame '.join(missing)}: {_ACCEPTED}")
    loop = ClosedChain(*(robot.chain(frame) for frame in ARMS))
    lacking = [name for name in NEEDED if name not in loop.unit.names]
    if lacking or (loop.right.n, loop.left.n) != (5, 5):
        raise ReportRobotError(f"the arms of {robot.name} have {loop.right.n} and {loop.left.n} joints or no wrist centre: {_ACCEPTED}")
    return loop


_ACCEPTED = (
    "the report needs two arms that end in the frames RHand and LHand, each of a universal joint (two axes that meet) and a spherical joint"
    " (three axes that meet), as the NAO has; try `cga report nao`"
)
