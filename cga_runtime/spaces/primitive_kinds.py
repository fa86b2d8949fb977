"""The six primitives as a table: what a cooperative system asks of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array, norm, parts, stack
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.errors import DegenerateError
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.spaces.charts import SEAM
from cga_runtime.versors import Rotor, Similarity

COINCIDENT, FLAT = 1e-9, 1e-9


@dataclass(frozen=True)
class Primitive:
    """A kind of primitive: its element, number of points, controllable bivectors, reference direction."""

    name: str
    element: Any
    points: int
    controllable: tuple[str, ...]
    reference: Array | None
    round: bool = False

    @property
    def rows(self) -> list[int]:
        """Places of the controllable blades among e12 e13 e23 e0i e1i e2i e3i."""
        return [BIVECTORS["similarity"].index(name) for name in self.controllable]

    def chart(self, element: Any) -> Array:
        """The default chart of an element."""
        if self.reference is None:
            return np.ones(element.center.shape[:-1])
        towards = element.normal if hasattr(element, "normal") else element.direction
        return np.where(towards @ self.reference < SEAM, -1.0, 1.0)

    def similarity(self, element: Any, chart: Array) -> Similarity:
        """V with V X_u ~V = X, of an element, in a chart."""
        if self.reference is None:
            rotor = np.array([1.0, 0.0, 0.0, 0.0])
        else:
            n = element.normal if hasattr(element, "normal") else element.direction
            middle = n + np.asarray(chart)[..., None] * self.reference
            x, y, z = parts(middle / norm(middle)[..., None])
            sense = np.asarray(chart)
            arc = sense[..., None] * (stack(y, x, 0.0, -z) if self.reference[1] else stack(z, 0.0, x, y))
            a, b, c, d = parts(arc)
            rotor = np.where(sense[..., None] > 0, arc, stack(d, c, -b, -a))
        size = element.radius if self.round else np.ones(element.center.shape[:-1])
        return Similarity.from_parts(element.center, Rotor(np.broadcast_to(rotor, (*np.shape(size), 4))), size)

    def through(self, points: Array) -> Any:
        """The element through points (..., k, 3)."""
        x = [points[..., k, :] for k in range(self.points)]
        return self.element(x[0]) if self.points == 1 else self.element.from_points(*x)

    def direction(self, points: Array) -> Array:
        """Unit direction of the primitive through points (..., k, 3) that are not degenerate."""
        edges = points[..., 1:, :] - points[..., :1, :]
        normal = edges[..., 0, :] if self.points == 2 else np.cross(edges[..., 0, :], edges[..., 1, :])
        return np.asarray(normal / norm(normal)[..., None])

    def weight(self, points: Array) -> Array:
        """Signed weight of P1 ^ ... ^ Pk (similarity.md, section 2)."""
        edges = points[..., 1:, :] - points[..., :1, :]
        if self.points == 1:
            return np.ones(points.shape[:-2])
        if self.points == 2:
            return norm(edges[..., 0, :])
        normal = np.cross(edges[..., 0, :], edges[..., 1, :])
        return norm(normal) if self.points == 3 else np.asarray((normal * edges[..., 2, :]).sum(axis=-1))

    def refuse(self, points: Array) -> None:
        """DegenerateError where the points are degenerate."""
        edges = points[..., 1:, :] - points[..., :1, :]
        lengths = norm(edges)
        if (lengths <= np.maximum(COINCIDENT, 1e-12 * norm(points[..., :1, :]))).any():
            raise DegenerateError(f"{self.name}: two of its points coincide (within {COINCIDENT:.0e} m)")
        if self.points > 2 and (np.abs(self.weight(points)) <= FLAT * lengths.prod(axis=-1)).any():
            where = "on one line" if self.points == 3 else "in one plane"
            raise DegenerateError(f"{self.name}: its points lie {where}")


_MOVES = ("e1i", "e2i", "e3i")
_E2, _E3 = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
PRIMITIVES = {
    primitive.name: primitive
    for primitive in (
        Primitive("point", Point, 1, _MOVES, None),
        Primitive("point_pair", PointPair, 2, ("e12", "e23", "e0i", *_MOVES), _E2, True),
        Primitive("line", Line, 2, ("e12", "e23", "e1i", "e3i"), _E2),
        Primitive("circle", Circle, 3, ("e13", "e23", "e0i", *_MOVES), _E3, True),
        Primitive("plane", Plane, 3, ("e13", "e23", "e3i"), _E3),
        Primitive("sphere", Sphere, 4, ("e0i", *_MOVES), None, True),
    )
}
"""By name."""
