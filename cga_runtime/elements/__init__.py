"""Points, point pairs, lines, circles, planes and spheres: small immutable objects over CGA coordinates (paper A, sections 2 and 3).

Null basis e0 e1 e2 e3 ei with e0.ei = -1; P(x) = e0 + x + x^2/2 ei. Coefficients stand in canonical blade order (ascending bit mask,
e0 = 1, e1 = 2, e2 = 4, e3 = 8, ei = 16) and are those of the unit primitive, <X ~X> = -1 (a point has e0 coefficient 1). Orientation is
kept: with its points in another order a direction may turn round. Arrays are float64 and read-only, lengths in metres; every argument may
have leading batch dimensions, and the results have them too.

Centres, directions and radii come from the points, never back from the coefficients, where they would lose accuracy as a power of
distance / size (paper A, eqs. 23-27, replaced by formulas on the points; similarity.md, section 3).

What can be done with them stands in files of their own: joins.py (outer products of points, weights), reading.py (elements from
coefficients), meets.py (intersections), distances.py (nearest points), similarities.py and charts.py (the motion of one onto another),
through_points.py (which points make no element).
"""

from cga_runtime.elements.element import Element
from cga_runtime.elements.flats import Line, Plane
from cga_runtime.elements.points import Point, PointPair
from cga_runtime.elements.rounds import Circle, Sphere
from cga_runtime.motors import Motor

__all__ = ["Circle", "Element", "Line", "Motor", "Plane", "Point", "PointPair", "Sphere"]
