"""Centres, directions and radii of the elements through given points, and which points make none (similarity.md, sections 3 and 8).

With edges a, b, d from the first point x1 and y = centre - x1: a circle has N = a x b, y = ((a.a) b - (b.b) a) x N / (2 N.N); a sphere
has [a; b; d] y = [a.a, b.b, d.d] / 2; r = |y|. The radius keeps 1e-16 to 5e-15 of its size wherever the points lie, the centre the rounding
of the coordinates. All of it goes row by row: a row that makes no element is named in `faults`, and its numbers mean nothing.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import Array, dot, norm, read, times
from cga_runtime.errors import DegenerateError, UnknownNameError

Rows = NDArray[np.bool_]
Faults = Mapping[str, Rows]
"""What may be wrong with points, and in which rows (...) it is."""

COINCIDENT = 1e-9
"""Points closer than this (m), or than 1e-12 of their distance from the origin, count as one point; a smaller radius as zero."""
FLAT = 1e-9
"""Smallest sine between two edges that span a plane, and smallest |det| of three edges, over their lengths, that span space."""
FARTHEST = 1e60
"""Largest distance of a point from the origin, and largest radius (m): up to there all powers that occur are finite."""

TOGETHER = f"two of its points coincide (within {COINCIDENT:.0e} m)"
COLLINEAR = "its three points lie on one line"
COPLANAR = "its four points lie in one plane"
FAR = f"one of its points lies more than {FARTHEST:.0e} m from the origin"
VAST = f"its centre or its radius is beyond {FARTHEST:.0e} m"
TINY = f"its radius is at most {COINCIDENT:.0e} m"


def pair_through(points: Array) -> tuple[Faults, Array]:
    """The edge (..., 3) from the first to the second point of (..., 2, 3)."""
    with np.errstate(over="ignore", invalid="ignore"):
        faults = {FAR: _far(points), TOGETHER: _coincide(points, (0, 1))}
        return faults, points[..., 1, :] - points[..., 0, :]


def plane_through(points: Array) -> tuple[Faults, Array]:
    """The unit normal (..., 3) of three points (..., 3, 3)."""
    with np.errstate(all="ignore"):
        a, b = points[..., 1, :] - points[..., 0, :], points[..., 2, :] - points[..., 0, :]
        normal = np.cross(a, b)
        size = norm(normal)
        together = _coincide(points, (1, 2), (0, 1), (0, 2))
        return {FAR: _far(points), TOGETHER: together, COLLINEAR: size <= FLAT * norm(a) * norm(b)}, normal / size[..., None]


def circle_through(points: Array) -> tuple[Faults, Array, Array, Array]:
    """Centre (..., 3), unit normal (..., 3) and radius (...) of three points (..., 3, 3)."""
    faults, direction = plane_through(points)
    with np.errstate(all="ignore"):
        a, b = points[..., 1, :] - points[..., 0, :], points[..., 2, :] - points[..., 0, :]
        normal = np.cross(a, b)
        y = times(0.5 / dot(normal, normal), np.cross(times(dot(a, a), b) - times(dot(b, b), a), normal))
        return _sized(faults, points, y), points[..., 0, :] + y, direction, norm(y)


def sphere_through(points: Array) -> tuple[Faults, Array, Array]:
    """Centre (..., 3) and radius (...) of four points (..., 4, 3)."""
    with np.errstate(all="ignore"):
        edges = points[..., 1:, :] - points[..., :1, :]
        lengths = norm(edges)
        faults = {FAR: _far(points), TOGETHER: _coincide(points, *itertools.combinations(range(4), 2))}
        spread = ~(faults[FAR] | faults[TOGETHER])
        directions = np.where(spread[..., None, None], edges / lengths[..., None], np.eye(3))
        faults[COPLANAR] = np.abs(np.linalg.det(directions)) <= FLAT
        solvable = np.where(faults[COPLANAR][..., None, None], np.eye(3), directions)
        y = np.asarray(np.linalg.solve(solvable, 0.5 * lengths[..., None])[..., 0], dtype=np.float64)
        return _sized(faults, points, y), points[..., 0, :] + y, norm(y)


def degenerate(points: ArrayLike, kind: str) -> Rows:
    """Where points (..., n, 3) make no element of a kind, (...): exactly where `from_points` raises DegenerateError.

    kind: point (n = 1), point_pair, line (2), circle, plane (3), sphere (4). Raises UnknownNameError, WrongSizeError, NotFiniteError.
    """
    if kind not in _THROUGH:
        raise UnknownNameError("kind of element", kind, _THROUGH)
    count, through = _THROUGH[kind]
    return _any(through(read(points, f"points of a {kind.replace('_', ' ')}", count, 3))[0])


def refuse(what: str, faults: Faults) -> None:
    """DegenerateError for the first fault that any row has."""
    for fault, rows in faults.items():
        if rows.any():
            where = f", at index {tuple(int(k) for k in np.argwhere(rows)[0])}" if rows.ndim else ""
            raise DegenerateError(f"{what}: {fault}{where}")


def _point_through(points: Array) -> tuple[Faults]:
    with np.errstate(over="ignore"):
        return ({FAR: _far(points)},)


def _far(points: Array) -> Rows:
    return np.asarray((norm(points) > FARTHEST).any(axis=-1))


def _coincide(points: Array, *pairs: tuple[int, int]) -> Rows:
    """Whether any two of the paired points are one point."""
    first, second = (list(ends) for ends in zip(*pairs, strict=True))
    a = points[..., first, :]
    return np.asarray((norm(points[..., second, :] - a) <= np.maximum(COINCIDENT, 1e-12 * norm(a))).any(axis=-1))


def _sized(faults: Faults, points: Array, y: Array) -> dict[str, Rows]:
    """The faults, with those of the size of the result where the points themselves are sound."""
    sound = ~_any(faults)
    radius = norm(y)
    vast = ~(np.maximum(radius, norm(points[..., 0, :] + y)) <= FARTHEST)
    return {**faults, VAST: sound & vast, TINY: sound & (radius <= COINCIDENT)}


def _any(faults: Faults) -> Rows:
    return np.asarray(np.any(np.stack(list(faults.values())), axis=0))


_THROUGH: dict[str, tuple[int, Callable[[Array], tuple[Any, ...]]]] = {
    "point": (1, _point_through),
    "point_pair": (2, pair_through),
    "line": (2, pair_through),
    "circle": (3, circle_through),
    "plane": (3, plane_through),
    "sphere": (4, sphere_through),
}
