"""Outer products of points as they are, and their weights (paper A, eqs. 2 and 14; similarity.md, section 2).

The outer product of points is X = P1 ^ P2 ^ ... (^ ei for lines and planes). It is the unit primitive of `Element.coefficients` times the
weight w for flat elements and points, and times w r for round ones of radius r:

    point 1    point pair, line |x2 - x1|    circle, plane 2 area = |(x2 - x1) x (x3 - x1)|    sphere det[x2 - x1, x3 - x1, x4 - x1]

The weight of a sphere has a sign, the handedness of its four points; no similarity turns one hand into the other.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, stack
from cga_runtime.elements.element import Element
from cga_runtime.elements.points import Point
from cga_runtime.elements.through_points import degenerate
from cga_runtime.errors import DegenerateError, NotFiniteError, WrongSizeError
from cga_runtime.multivectors import Multivector, times

INFINITY = Multivector([1.0], ["ei"])
"""The point at infinity."""


def join(*factors: ArrayLike | Element | Multivector, flat: bool = False) -> Multivector:
    """The outer product of points (..., 3) (m), elements and multivectors in the order given, and of ei after them where `flat`.

    Not normalised, and zero where the factors depend on each other. Each point after the first enters as P - P1, which changes nothing in
    exact arithmetic and saves the digits that differences of large numbers lose: with points of spread s the coefficients keep 1e-16 of
    their size at any distance. Raises WrongSizeError for no factor and for more than five dimensions; NotFiniteError.
    """
    first: Point | None = None
    whole: Multivector | None = None
    for given in factors:
        factor = given if isinstance(given, Element | Multivector) else Point(given)
        part: Element | Multivector = factor
        if isinstance(factor, Point):
            first, part = (factor, factor) if first is None else (first, _step(first, factor))
        whole = Multivector(part.coefficients, part.blades) if whole is None else _outer(whole, part)
    if whole is None:
        raise WrongSizeError("join: no factor given, at least one needed")
    return _outer(whole, INFINITY) if flat else whole


def weight(*points: ArrayLike | Point) -> Array:
    """The weight w of one to four points (..., 3) (m), (...), in m^(n - 1): from edges, so that it keeps its digits at any distance.

    Zero where they coincide, are collinear, or coplanar; negative for the points of a left-handed sphere. Raises WrongSizeError.
    """
    x, *others = _points("weight", 1, 4, points)
    match [y - x for y in others]:
        case []:
            return np.ones(x.shape[:-1])
        case [a]:
            return norm(a)
        case [a, b]:
            return norm(np.cross(a, b))
        case [a, b, d]:
            return dot(a, np.cross(b, d))
    raise AssertionError  # _points counts them


def handedness(*points: ArrayLike | Point) -> Array:
    """+1 where four points (..., 3), in their order, are right-handed, det[x2 - x1, x3 - x1, x4 - x1] > 0, else -1, (...).

    Raises DegenerateError where they lie in one plane, which has no hand; WrongSizeError.
    """
    whole = np.stack(_points("handedness", 4, 4, points), axis=-2)
    if degenerate(whole, "sphere").any():
        raise DegenerateError("handedness: the four points make no sphere; degenerate(points, 'sphere') tells in which rows")
    return np.sign(weight(*np.moveaxis(whole, -2, 0)))


def _step(first: Point, second: Point) -> Multivector:
    """P2 - P1 = e + (e.(x1 + x2)/2) ei with e = x2 - x1."""
    edge = second.center - first.center
    rise = dot(edge, 0.5 * (first.center + second.center))
    return Multivector(stack(*np.moveaxis(edge, -1, 0), rise), ("e1", "e2", "e3", "ei"))


def _outer(a: Multivector, b: Element | Multivector) -> Multivector:
    with np.errstate(over="ignore", invalid="ignore"):
        try:
            product = times(a, b, "outer")
        except NotFiniteError:
            raise NotFiniteError("join: the outer product is too large for a float (points stay below 1e50 m)") from None
    if not product.blades:
        raise WrongSizeError(
            "join: the factors have more than five dimensions together, or one of them twice; their product is always zero"
        )
    return product


def _points(what: str, least: int, most: int, points: tuple[ArrayLike | Point, ...]) -> tuple[Array, ...]:
    """Coordinates of one batch shape."""
    if not least <= len(points) <= most:
        needed = f"{least}" if least == most else f"{least} to {most}"
        raise WrongSizeError(f"{what}: {len(points)} points given, {needed} needed")
    arrays = [x.center if isinstance(x, Point) else Point(x).center for x in points]
    batch = one_batch(what, *(x.shape[:-1] for x in arrays))
    return tuple(np.broadcast_to(x, (*batch, 3)) for x in arrays)
