"""How far cooperative end points are from spanning nothing, and the inequalities that keep them from it (paper A, section 5.3).

For two points it is their distance (m). For three and four it is `Cooperative.degeneracy`, the sine between two edges and |det| of three
over their lengths, at the worst corner: the least of all orders in which the chains could be named. Edges from one corner alone do not
notice when that corner and another come together, and IPOPT finds that out.

Where the direction n of a line, circle or plane is given, its condition also fixes the orientation; of four points it keeps the side of
their plane on which a start lies. Both change their sign without a kink where a primitive degenerates, as no measure without sign does:

    2 points    (x2 - x1).n >= m                        n not given   |x2 - x1|^2 >= m^2
    3 points    N.n / (|a||b|) >= m, each corner                      N.N / (|a||b|)^2 >= m^2
    4 points    side det[a, b, d] / (|a||b||d|) >= m, each corner

Sines and determinants do not notice when all points come together. Hence with a margin the first two of three or four also stay 1 mm
apart, but for circles and spheres that their target keeps from shrinking.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cga_runtime.coordinates import Array, norm
from cga_runtime.spaces.closed_chain import LENGTH

APART = 1e-3
"""Least distance (m) of the first two end points."""
FLOORS = {1: 0.0, 2: APART, 3: 0.01, 4: 0.01}
"""Margins where none is asked for, by the number of points: what lies below counts as degenerate."""
TINY = 1e-12
"""Squared length (m^2) that keeps quotients finite where points coincide."""


def corners(points: Any) -> list[tuple[Any, list[Any]]]:
    """Each point with its edges to the others."""
    return [(x, [other - x for j, other in enumerate(points) if j != i]) for i, x in enumerate(points)]


def degeneracy(points: Array) -> float:
    """The measure of end points (k, 3); 1 of a single point, 0 where two coincide."""
    if len(points) < 3:
        return float(norm(points[1] - points[0])) if len(points) == 2 else 1.0
    worst = np.inf
    for _, edges in corners(points):
        lengths = norm(np.array(edges))
        size = norm(np.cross(*edges)) if len(edges) == 2 else np.abs(np.linalg.det(np.array(edges)))
        worst = min(worst, float(size / lengths.prod()) if lengths.all() else 0.0)
    return worst


def volume(points: Array) -> float:
    """det[x2 - x1, x3 - x1, x4 - x1], whose sign is the side of a sphere's end points; 1 of fewer points."""
    return float(np.linalg.det(points[1:] - points[0])) if len(points) == 4 else 1.0


def kept(x: list[Any], direction: Any, side: Any, margin: Any, apart: float) -> list[Any]:
    """Expressions that must not be negative, of end points x (each (3, 1)). direction: None where it is not given; apart: 0 where three or
    four points may come together."""
    import casadi

    if len(x) == 1:
        return []
    if len(x) == 2:
        edge = x[1] - x[0]
        if direction is None:
            return [(casadi.sumsqr(edge) - margin**2) / LENGTH**2]
        return [(casadi.dot(edge, direction) - margin) / LENGTH]
    first = [other - x[0] for other in x[1:]]
    normal = casadi.cross(first[0], first[1])
    size = casadi.dot(normal, direction if len(x) == 3 and direction is not None else normal if len(x) == 3 else first[2])
    found = [(casadi.sumsqr(first[0]) - apart**2) / LENGTH**2] if apart else []
    for _, edges in corners(x):
        lengths = 1
        for edge in edges:
            lengths = lengths * (casadi.sumsqr(edge) + TINY)
        if len(x) == 3 and direction is None:
            found.append(size / lengths - margin**2)
        else:
            found.append((size if len(x) == 3 else side * size) / casadi.sqrt(lengths) - margin)
    return found
