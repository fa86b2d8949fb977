"""Paper B, eqs. (2)-(6), (54)-(56), (58), (59): primitives as outer products, their intersections, reaching errors and their Jacobians.

Reproduced: (2)-(6), (54)-(56) as printed; (58), (59) as corrected here (the printed ones: test_b_errata.py).
"""

import numpy as np
import pytest

from cga_codegen.algebra.blade_types import CIRCLE, LINE, ORIGIN, PLANE, POINT, POINT_PAIR, SPHERE, product_type
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.closed_form_dynamics import INFINITY, conformal_point, geometric_jacobian, link_motors

E0 = Multivector(ORIGIN, [1])
H = 1e-30  # complex step


def close(got, expected, tolerance):
    np.testing.assert_allclose(np.array(got, dtype=np.float64), expected, rtol=0, atol=tolerance)


def span(points, flat=False):
    """Table II: the outer product of points, of flats with ei too."""
    total = conformal_point(points[0])
    for x in points[1:]:
        total = total ^ conformal_point(x)
    return total ^ INFINITY if flat else total


# name: points, flat, type, blades of its outer product with a point
PRIMITIVES = {
    "point": (1, False, POINT, 10),
    "point pair": (2, False, POINT_PAIR, 10),
    "line": (2, True, LINE, 4),
    "circle": (3, False, CIRCLE, 5),
    "plane": (3, True, PLANE, 1),
    "sphere": (4, False, SPHERE, 1),
}


def on_primitive(name, points, rng):
    """A point of the primitive through the points, by vector geometry."""
    if name in ("point", "point pair"):
        return points[0]
    if name in ("line", "plane"):
        return points[0] + rng.normal(size=len(points) - 1) @ (points[1:] - points[0])
    # circle, sphere: the centre is equally far from all points, within their span
    d = points[1:] - points[0]
    centre = points[0] + d.T @ np.linalg.solve(2 * d @ d.T, np.sum(d * d, axis=1))
    direction = rng.normal(size=len(d)) @ d
    return centre + np.linalg.norm(points[0] - centre) * direction / np.linalg.norm(direction)


@pytest.mark.parametrize("name", PRIMITIVES)
def test_null_spaces(name, rng):
    """(2)-(5): points of a primitive, and they alone, wedge to zero with it (4) and dot to zero with its dual (3)."""
    count, flat, type_, _ = PRIMITIVES[name]
    for points in rng.normal(size=(20, count, 3)):
        primitive = span(points, flat)
        assert {*primitive.type.masks} <= {*type_.masks}
        dual = primitive.dual()
        inside = conformal_point(on_primitive(name, points, rng))
        outside = conformal_point(rng.normal(size=3))
        size = np.abs(primitive.coefficients).max() * np.abs(inside.coefficients).max()
        for x, low, high in ((inside, 0, 1e-13), (outside, 1e-4, np.inf)):
            for product in (primitive ^ x, x | dual):
                assert low <= np.abs(np.array(product.coefficients, float)).max() / size <= high


def test_meet(rng):
    """(6): (X1* ^ X2*)* of a line and a sphere holds both points where they cut, and only them; of two planes, the line in both."""
    for centre, direction in rng.normal(size=(20, 2, 3)):
        direction /= np.linalg.norm(direction)
        start, radius = centre + 0.4 * np.cross(direction, [0, 0, 1]), 1.3
        frame = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        sphere = span(centre + radius * np.array([*frame, -frame[0]]))
        line = span(np.array([start, start + direction]), flat=True)
        meet = (line.dual() ^ sphere.dual()).dual()
        offset = start - centre
        along = -offset @ direction + np.array([-1, 1]) * np.sqrt((offset @ direction) ** 2 - offset @ offset + radius**2)
        for t in along:
            close((meet ^ conformal_point(start + t * direction)).coefficients, 0.0, 5e-13)
        middle = conformal_point(start + along.mean() * direction)
        assert np.abs((meet ^ middle).coefficients).max() > 0.1
    for points in rng.normal(size=(20, 4, 3)):
        meet = (span(points[:3], True).dual() ^ span(points[1:], True).dual()).dual()
        for t in (-1.0, 0.0, 2.0):
            close((meet ^ conformal_point(points[1] + t * (points[2] - points[1]))).coefficients, 0.0, 5e-13)
        assert np.abs((meet ^ conformal_point(points[0])).coefficients).max() > 1e-3


@pytest.mark.parametrize("name", PRIMITIVES)
def test_reaching(name, panda, rng):
    """(54)-(56): E = X_d ^ M e0 ~M vanishes where the tip lies on X_d; (55) is E's complex step; (56) keeps the known blades."""
    count, flat, type_, blades = PRIMITIVES[name]
    for q, _, _ in panda.states(3, 31):
        motor = link_motors(panda.model, *panda.half(q))[-1]
        columns = [(axis * motor).scaled(-0.5) for axis in geometric_jacobian(panda.model, *panda.half(q))]  # J^A by (28)
        points = rng.normal(size=(count, 3))
        target = span(points, flat).project(type_)
        error = target ^ motor.sandwich(E0, POINT)
        assert error.type == product_type("outer", type_, POINT) and len(error.type) == blades
        for i, column in enumerate(columns):
            got = target ^ (column * E0 * ~motor + motor * E0 * ~column)
            stepped = link_motors(panda.model, *panda.half(q + 1j * H * np.eye(7)[i]))[-1]
            # ~ reverses and does not conjugate, so the step passes through both factors
            expected = target ^ stepped.sandwich(E0, POINT)
            embedded = [complex(x).imag / H for x in expected.coefficients]  # (56)
            close(got.project(error.type).coefficients, embedded, 4e-14)
            kept = {*error.type.masks}
            close([got.coefficient(mask) for mask in got.type.masks if mask not in kept] or [0.0], 0.0, 1e-15)
        tip = panda.pose_of(motor)[:3, 3]
        shifted = points + tip - on_primitive(name, points, np.random.default_rng(0))
        reached = span(shifted, flat) ^ motor.sandwich(E0, POINT)
        close(np.array(reached.coefficients, float) / np.abs(span(shifted, flat).coefficients).max(), 0.0, 1e-13)


def test_pointing(panda, rng):
    """(54) with X a line: the tool's z axis meets the target point exactly when line ^ point = 0; four blades."""
    z_axis = span(np.array([[0, 0, 0], [0, 0, 1.0]]), flat=True)
    for q, _, _ in panda.states(10, 32):
        motor = link_motors(panda.model, *panda.half(q))[-1]
        pose = panda.pose_of(motor)
        line = motor.sandwich(z_axis, LINE)
        ahead = pose[:3, 3] + rng.uniform(-1, 1) * pose[:3, 2]
        close((line ^ conformal_point(ahead)).coefficients, 0.0, 1e-14)
        aside = rng.normal(size=3)
        distance = np.linalg.norm(np.cross(aside - pose[:3, 3], pose[:3, 2]))
        error = line ^ conformal_point(aside)
        assert len(error.type) == 4
        plane = error.at("e012i e013i e023i")
        close(np.linalg.norm(plane), distance, 1e-14)  # the error's size is the distance: that plane's area
