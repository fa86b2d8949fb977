"""The six primitives as a table: what a cooperative system asks of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.charts import REFERENCE, SEAM, direction_of
from cga_runtime.elements.element import Element
from cga_runtime.elements.joins import weight
from cga_runtime.elements.similarities import CONTROLLABLE, UNIT
from cga_runtime.elements.through_points import COINCIDENT as COINCIDENT
from cga_runtime.elements.through_points import FLAT as FLAT
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.versors import Similarity

Spanned = Point | PointPair | Line | Circle | Plane | Sphere
"""What points span."""


@dataclass(frozen=True)
class Primitive:
    """A kind of primitive: its element, and the number of points that span it."""

    name: str
    element: Any
    points: int

    @property
    def controllable(self) -> tuple[str, ...]:
        """Bivectors that move it."""
        return CONTROLLABLE[self.name]

    @property
    def rows(self) -> list[int]:
        """Places of the controllable blades among e12 e13 e23 e0i e1i e2i e3i."""
        return [BIVECTORS["similarity"].index(name) for name in self.controllable]

    @property
    def round(self) -> bool:
        """Whether it has a radius."""
        return hasattr(UNIT[self.name], "radius")

    @property
    def reference(self) -> Array | None:
        """Direction of the unit primitive, if it has one."""
        return np.array(REFERENCE[self.name]) if self.name in REFERENCE else None

    def through(self, points: Array) -> Spanned:
        """The element through points (..., k, 3). Raises DegenerateError."""
        x = [points[..., k, :] for k in range(self.points)]
        made: Spanned = self.element(x[0]) if self.points == 1 else self.element.from_points(*x)
        return made

    def chart_of_similarity(self, versor: Similarity) -> Array:
        """The default chart of the primitive V X_u ~V, (...)."""
        if self.reference is None:
            return np.ones(versor.coefficients.shape[:-1])
        ahead = np.einsum("i,...ij,j->...", self.reference, versor.rotation().matrix(), self.reference)
        return np.where(ahead < SEAM, -1.0, 1.0)

    def direction(self, points: Array) -> Array:
        """Unit direction (..., 3) of a kind that has one through points (..., k, 3) that are not degenerate."""
        return direction_of(self.through(points))

    def weight(self, points: Array) -> Array:
        """Signed weight of P1 ^ ... ^ Pk, (...)."""
        return weight(*(points[..., k, :] for k in range(self.points)))

    def chart(self, element: Element) -> Array:
        """The default chart of an element, (...)."""
        if self.reference is None:
            return np.ones(element.batch)
        return np.where(direction_of(element) @ self.reference < SEAM, -1.0, 1.0)


PRIMITIVES = {
    kind: Primitive(kind, Element.kinds[kind], points)
    for kind, points in (("point", 1), ("point_pair", 2), ("line", 2), ("circle", 3), ("plane", 3), ("sphere", 4))
}
"""By name."""
