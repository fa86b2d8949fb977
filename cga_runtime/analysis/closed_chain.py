"""The closed chain as users meet it: two arms that hold one object, with every analysis as a method."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from cga_runtime.analysis.mobility import Mobility, mobility
from cga_runtime.analysis.schemes import Array, atlas, conditioning
from cga_runtime.analysis.singularities import Nearest, SingularityFreeBox, nearest_singularity, singularity_free_box
from cga_runtime.spaces.closed_chain import ClosedLoop


class ClosedChain(ClosedLoop):
    """Two chains that grasp one rigid object (paper C). Raises GraspError if they share joints or have fewer than seven."""

    def mobility(self, q: ArrayLike) -> Mobility:
        """Twist and wrench systems, mobility and motion type at one configuration; see analysis.mobility."""
        return mobility(self, q)

    def conditioning(self, q: ArrayLike, actuated: Sequence[int]) -> Array:
        """mu in [0, 1], shape (...): zero exactly at an actuation singularity; 1/mu bounds |q'| / |q'_actuated|."""
        return conditioning(self, q, [actuated])[..., 0]

    def schemes(self, samples: int = 3000, seed: int = 0) -> list[dict[str, Any]]:
        """All actuation schemes: class, reason, orbit, exact witness, statistics of mu; see analysis.schemes."""
        return atlas(self, samples, seed)

    def nearest_singularity(
        self, q: ArrayLike, kind: str = "limb", actuated: Sequence[int] | None = None, **options: Any
    ) -> Nearest:
        """The nearest singularity of a kind ("limb", "constraint", "actuation"); see analysis.singularities."""
        return nearest_singularity(self, q, kind, actuated, **options)

    def singularity_free_box(self, q: ArrayLike, actuated: Sequence[int], **options: Any) -> SingularityFreeBox:
        """Half-width of the largest box around q without a zero of the determinant, not certified; see analysis.singularities."""
        return singularity_free_box(self, q, actuated, **options)
