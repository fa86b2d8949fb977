"""What a cooperative primitive must do with a target: coincide with it, lie in it, or pass through it (paper A, sections 3.6 and 5.7).

One lies in the other exactly where P ^ X = 0 for the points P of the smaller one. That has dependent rows; these conditions have none, and
say the same (similarity.md, section 2):

    coincide       each end point on the planes and spheres that make up the target, and the direction not opposite: 3, 6, 4, 6, 3, 4 rows
    lie in         each end point on the planes and spheres that make up the target
    pass through   points of the target, seen from the primitive's own frame, on the planes and spheres of the unit primitive

Departures are measured anew by elementary geometry on elements. Angles count as the length of their arc at 1 m.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from cga_runtime.coordinates import Array, norm
from cga_runtime.elements import Circle, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.charts import REFERENCE, direction_of
from cga_runtime.elements.distances import distance, project
from cga_runtime.elements.similarities import unit_primitive
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.solve.reaching_targets import Target, duals
from cga_runtime.spaces.primitive_kinds import PRIMITIVES, Primitive
from cga_runtime.versors import Similarity

NO_POINTS, NO_DUALS = np.zeros((0, 3)), np.zeros((0, 5))
APART = 0.5
"""Half the distance (m) of the two points that stand for a line that a plane must contain."""

Departure = Callable[[Any, Any, Array], float]
"""How far (m) a primitive is from what a target wants of it; the last argument is the mean of the end points (3,)."""


@dataclass(frozen=True)
class Wish:
    """A target in the terms of the program: for each end point the dual vectors (e0, e1, e2, e3, ei) that it must be incident with, points
    (p, 3) that the primitive must contain, and the direction that it must not be opposite to.

    same: the target is of the primitive's own kind. departure: how far a primitive is from what is wanted.
    """

    target: Any
    ends: tuple[Array, ...]
    through: Array
    direction: Array | None
    same: bool
    departure: Departure

    @property
    def places_ends(self) -> bool:
        """Whether each end point has but one place."""
        return self.same and isinstance(self.target, Point | PointPair)


def wish(about: Primitive, target: Any, near: Array) -> Wish:
    """The wish of a target for a kind of primitive; a Similarity V_d means V_d X_u ~V_d, as its turn about the primitive's direction cannot
    be reached or missed. near: the mean of the end points where the search begins, (3,).

    Raises UnknownNameError for types without meaning for the kind, WrongSizeError for a batch.
    """
    goal = unit_primitive(about.name).transformed(target) if isinstance(target, Similarity) else target
    relations = RELATIONS[about.name]
    if type(goal) not in relations:
        accepted = (*(kind.__name__ for kind in relations), "Similarity")
        raise UnknownNameError(f"target of a cooperative {about.name}", type(goal).__name__, accepted)
    if goal.batch:
        raise WrongSizeError(f"target: one {type(target).__name__} at a time; this one has the batch shape {goal.batch}")
    return relations[type(goal)](about, goal, near)


def unit_duals(kind: str) -> Array:
    """Dual vectors of the planes and spheres of the unit primitive X_u of a kind that may contain others, (k, 5)."""
    return duals(cast(Target, unit_primitive(kind)))


# ---- the three relations


def _same(about: Primitive, target: Any, near: Array) -> Wish:
    if isinstance(target, PointPair):
        return Wish(target, tuple(duals(Point(x)) for x in target.points), NO_POINTS, None, True, between)
    return Wish(
        target, (duals(target),) * about.points, NO_POINTS, direction_of(target) if about.name in REFERENCE else None, True, between
    )


def _inside(about: Primitive, target: Any, near: Array) -> Wish:
    return Wish(target, (duals(target),) * about.points, NO_POINTS, None, False, departure)


def _around(about: Primitive, target: Any, near: Array) -> Wish:
    def around(primitive: Any, target: Any, near: Array) -> float:
        return departure(target, primitive, near)

    whole = _spanned(about, target)
    if whole is not None:  # nothing of the primitive is left free: its end points are on what the target spans
        return Wish(target, (duals(whole),) * about.points, NO_POINTS, None, False, around)
    return Wish(target, (NO_DUALS,) * about.points, _sample(target, near), None, False, around)


def _spanned(about: Primitive, target: Any) -> Line | Plane | None:
    """The only primitive of the kind that contains the target, where there is only one."""
    if about.name == "line" and isinstance(target, PointPair):
        return Line.from_points(*target.points)
    if about.name == "plane" and isinstance(target, Circle):
        return Plane.from_point_normal(target.center, target.normal)
    return None


def _sample(target: Any, near: Array) -> Array:
    """Points (p, 3) of a target that lies in a primitive as soon as they do."""
    if isinstance(target, Point):
        return target.center[None]
    if isinstance(target, PointPair):
        return target.points
    if isinstance(target, Line):
        return project(near, target) + APART * np.array([[-1.0], [1.0]]) * target.direction
    angle = 2.0 * np.pi / 3.0 * np.arange(3)[:, None]
    u, v = duals(Line(target.center, target.normal))[:, 1:4]  # the normals of two planes through the axis
    return np.asarray(target.center + target.radius * (np.cos(angle) * u + np.sin(angle) * v))


Relation = Callable[[Primitive, Any, Array], Wish]
RELATIONS: dict[str, dict[type, Relation]] = {
    "point": {Point: _same, **dict.fromkeys((Line, Circle, Plane, Sphere), _inside)},
    "point_pair": {PointPair: _same, **dict.fromkeys((Line, Circle, Plane, Sphere), _inside)},
    "line": {Line: _same, Plane: _inside, **dict.fromkeys((Point, PointPair), _around)},
    "circle": {Circle: _same, **dict.fromkeys((Plane, Sphere), _inside), **dict.fromkeys((Point, PointPair), _around)},
    "plane": {Plane: _same, **dict.fromkeys((Point, PointPair, Line, Circle), _around)},
    "sphere": {Sphere: _same, **dict.fromkeys((Point, PointPair, Circle), _around)},
}
"""Kind of primitive, type of target -> what is wanted."""
assert set(RELATIONS) == set(PRIMITIVES)

# ---- measured anew


def between(one: Any, other: Any, near: Array) -> float:
    """How far two elements of one type are apart: the largest of the distance of their centres (of lines and planes: of `near` moved onto
    the one, from the other), the angle between their directions, orientation included, and the difference of their radii."""
    flat = isinstance(other, Line | Plane)
    apart = [float(distance(project(near, one), other) if flat else norm(one.center - other.center))]
    if other.kind in REFERENCE:
        a, b = direction_of(one), direction_of(other)
        apart.append(2.0 * float(np.arctan2(norm(a - b), norm(a + b))))
    if hasattr(other, "radius"):
        apart.append(abs(float(one.radius - other.radius)))
    return max(apart)


def departure(inner: Any, outer: Any, near: Array) -> float:
    """The largest distance of a point of `inner` from `outer`; of a line: of its points within 1 m of the one nearest to `near`."""
    if isinstance(inner, PointPair):
        return float(distance(inner.points, outer).max())
    if isinstance(inner, Line):  # in a plane
        return float(distance(project(near, inner), outer) + abs(inner.direction @ outer.normal))
    if not isinstance(inner, Circle):
        return float(distance(inner.center, outer))
    if isinstance(outer, Plane):
        return float(distance(inner.center, outer) + inner.radius * norm(np.cross(inner.normal, outer.normal)))
    step = inner.center - outer.center  # in a sphere: its nearest and farthest points from the sphere's centre
    height = step @ inner.normal
    aside = norm(step - height * inner.normal)
    return float(max(abs(np.hypot(height, aside + sign * inner.radius) - outer.radius) for sign in (-1.0, 1.0)))
