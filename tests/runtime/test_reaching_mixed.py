"""Cooperative primitives in larger targets and around smaller ones, for all pairs of types (paper A, section 5.7).

Judged by the outer product P ^ X in the algebra, on points of the one that is contained, and by distances between coordinates.
"""

import re

import numpy as np
import pytest
from cooperative_draws import corners, inside
from cooperative_oracle import COUNTS, Flanges
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements import Circle, Element, Line, Plane, Point, PointPair, Sphere
from cga_runtime.elements.distances import incidence, project
from cga_runtime.experiments.cooperative_ik import pandas_around_a_table
from cga_runtime.solve.reaching import reach
from cga_runtime.solve.reaching_containment import RELATIONS, departure, wish
from cga_runtime.solve.reaching_cooperative_problem import CooperativeForm, from_start, parameters, program

INSIDE = {
    "point": (Line, Circle, Plane, Sphere),
    "point_pair": (Line, Circle, Plane, Sphere),
    "line": (Plane,),
    "circle": (Plane, Sphere),
    "plane": (),
    "sphere": (),
}
AROUND = {
    "point": (),
    "point_pair": (),
    "line": (Point, PointPair),
    "circle": (Point, PointPair),
    "plane": (Point, PointPair, Line, Circle),
    "sphere": (Point, PointPair, Circle),
}
# conditions on the positions of the primitive: the dimension of its family less that of the ones that satisfy them
DIMENSIONS = {
    **{("point", kind): count for kind, count in ((Line, 2), (Circle, 2), (Plane, 1), (Sphere, 1))},
    **{("point_pair", kind): count for kind, count in ((Line, 4), (Circle, 4), (Plane, 2), (Sphere, 2))},
    **{("line", kind): count for kind, count in ((Plane, 2), (Point, 2), (PointPair, 4))},
    **{("circle", kind): count for kind, count in ((Plane, 3), (Sphere, 3), (Point, 2), (PointPair, 4))},
    **{("plane", kind): count for kind, count in ((Point, 1), (PointPair, 2), (Line, 2), (Circle, 3))},
    **{("sphere", kind): count for kind, count in ((Point, 1), (PointPair, 2), (Circle, 3))},
}
PAIRS = [pytest.param(kind, target, id=f"{kind}-{target.__name__}") for kind, target in DIMENSIONS]
"""Kind of system, type of target."""


@pytest.fixture(scope="module")
def sliding():
    """Systems whose q is their end points."""
    return {kind: cga.Cooperative(gantries()[:count], kind) for kind, count in COUNTS.items()}


def square(n, rng):
    """Two unit vectors square to n and to each other."""
    u = np.cross(n, rng.normal(size=3))
    u /= np.linalg.norm(u)
    return u, np.cross(n, u) / np.linalg.norm(n)


def on(element, rng, count):
    """Random points of an element, near its centre."""
    x, s, t = element.center, rng.uniform(-1, 1, (count, 1)), rng.uniform(-1, 1, (count, 1))
    match element:
        case Point():
            return x[None]
        case PointPair():
            return element.points
        case Line():
            return x + s * element.direction
        case Plane():
            u, v = square(element.normal, rng)
            return x + s * u + t * v
        case Circle():
            u, v = square(element.normal, rng)
            return x + element.radius * (np.cos(np.pi * s) * u + np.sin(np.pi * s) * v)
        case Sphere():
            n = rng.normal(size=(count, 3))
            return x + element.radius * n / np.linalg.norm(n, axis=1, keepdims=True)


def through(points, extra, target, n):
    """An element of a type that contains the points; where it is not yet fixed, other points or the direction n say which."""
    if target is Line:
        return Line.from_points(*points) if len(points) == 2 else Line.from_point_direction(points[0], n)
    if target is Plane:
        normals = {1: lambda: n, 2: lambda: np.cross(n, points[1] - points[0]), 3: lambda: np.cross(*(points[1:] - points[0]))}
        return Plane.from_point_normal(points[0], normals[len(points)]())
    return target.from_points(*points, *extra[: {Circle: 3, Sphere: 4}[target] - len(points)])


def satisfied(kind, points, target, rng):
    """A target of a type that the primitive through the points satisfies."""
    if target in INSIDE[kind]:
        return through(points, rng.uniform(-1, 1, (4, 3)), target, rng.normal(size=3))
    element = Element.kinds[kind].from_points(*points)
    x = on(element, rng, 3)
    if target is Point:
        return Point(x[0])
    return (
        Circle(x[0], element.normal, 0.2) if (kind, target) == ("plane", Circle) else target.from_points(*x[: 3 if target is Circle else 2])
    )


def problems(system, target, rng, count):
    """Positions that are not nearly degenerate, each with a target that it satisfies."""
    fine = [q for q in system.random(rng, 40 + 10 * count) if corners(system.points(q)) >= 0.1][:count]
    assert len(fine) == count
    return [(q, satisfied(system.kind, system.points(q), target, rng)) for q in fine]


def products(system, q, goal, samples):
    """P ^ X of the unit primitive X that contains the other, for points P of that other one: zero where the target is reached."""
    about, x = system.about, system.points(q)
    if type(goal) in AROUND[system.kind]:
        return incidence(samples, about.through(x)).coefficients.ravel()
    return incidence(x, goal).coefficients.ravel()  # where the end points are, the primitive is


def test_the_table_says_what_is_accepted():
    for kind, relations in RELATIONS.items():
        assert set(relations) == {Element.kinds[kind], *INSIDE[kind], *AROUND[kind]}
        assert {target for of, target in DIMENSIONS if of == kind} == {*INSIDE[kind], *AROUND[kind]}


@pytest.mark.parametrize(("kind", "target"), PAIRS)
def test_targets_that_can_be_reached(kind, target, sliding, rng):
    system, first = sliding[kind], 0
    for _, goal in problems(system, target, rng, 5):
        found = reach(system, goal, next(q for q in system.random(rng, 100) if corners(system.points(q)) > 0.1))
        assert found.success and found.status.startswith("reached") and inside(system, found.q) and found.residual <= 1e-6
        x = system.points(found.q)
        assert corners(x) >= {1: 1.0, 2: 1e-3, 3: 0.01, 4: 0.01}[len(x)] - 1e-7
        element = system.element(found.q)
        inner, outer = (goal, element) if target in AROUND[kind] else (element, goal)
        samples = on(inner, rng, 10) + (project(x.mean(axis=0), inner) - inner.center if isinstance(inner, Line) else 0.0)
        size = max([1.0, *(float(e.radius) for e in (inner, outer) if hasattr(e, "radius"))])
        assert np.abs(incidence(samples, outer).coefficients).max() < 1e-6 * size
        first += found.starts == 1
    assert first >= 4


@pytest.mark.parametrize(("kind", "target"), PAIRS)
def test_equations_are_independent_and_those_of_the_outer_product(kind, target, sliding, rng):
    system = sliding[kind]
    for q, goal in problems(system, target, rng, 2):
        asked = wish(system.about, goal, np.zeros(3))
        form = CooperativeForm.of(system, asked, 0.0, 0.0)
        assert form.equations == DIMENSIONS[kind, target]
        numbers = np.append(parameters(asked, q, 0.0, 0.0), from_start(system, q))
        values, slopes = program(form).solver.get_function("nlp_jac_g")(q, numbers)
        np.testing.assert_allclose(np.array(values).ravel(), 0.0, atol=1e-11)
        rows = np.array(slopes)
        assert np.linalg.matrix_rank(rows, 1e-4 * np.abs(rows).max()) == len(rows) == form.equations
        samples, step = on(goal, rng, 4), 1e-5
        changes = [products(system, q + step * e, goal, samples) - products(system, q - step * e, goal, samples) for e in np.eye(system.n)]
        outer = np.array(changes).T / (2 * step)
        both = np.vstack([rows / np.linalg.norm(rows, axis=1, keepdims=True), outer / np.abs(outer).max()])
        assert np.linalg.matrix_rank(outer, 1e-5 * np.abs(outer).max()) == np.linalg.matrix_rank(both, 1e-5) == form.equations


@pytest.mark.parametrize(("kind", "target"), PAIRS)
def test_the_solution_is_locally_nearest_to_the_start(kind, target, sliding, rng):
    """Where no limit and no margin is active, the step is in the span of the equations' gradients."""
    system, checked = sliding[kind], 0
    for q0, (_, goal) in zip(system.random(rng, 30), problems(system, target, rng, 30), strict=True):
        asked = wish(system.about, goal, system.points(q0).mean(axis=0))
        found = reach(system, goal, q0, starts=1)
        if not found.success or np.abs(found.q).max() > 1.999 or corners(system.points(found.q)) < 0.011:
            continue
        numbers = np.append(parameters(asked, q0, 0.0, 0.0), from_start(system, q0))
        rows = np.array(program(CooperativeForm.of(system, asked, 0.0, 0.0)).solver.get_function("nlp_jac_g")(found.q, numbers)[1])
        step = found.q - q0
        np.testing.assert_allclose(step - np.linalg.pinv(rows) @ rows @ step, 0.0, atol=2e-6)
        checked += 1
        if checked == 3:
            break
    assert checked == 3


DEPARTURES = [
    (Point((0.3, 0.1, 0.2)), Plane((0, 0, 1), 0.0)),
    (PointPair.from_points((0.3, 0.1, 0.2), (-0.1, 0.5, -0.4)), Circle((0.1, 0, 0), (0, 1, 1), 0.3)),
    (Circle((0.1, 0.2, 0.3), (1, 1, 0.2), 0.4), Plane((0.1, 0, 1), 0.2)),
    (Circle((0.1, 0.2, 0.3), (1, 1, 0.2), 0.4), Sphere((0.2, 0.2, 0.1), 0.5)),
    (Circle((0.1, 0.2, 0.3), (1, 1, 0.2), 0.1), Sphere((0.2, 0.2, 0.1), 2.0)),
    (Line.from_points((1, 0, 0.2), (0, 1, 0.3)), Plane((0, 0, 1), 0.1)),
]


@pytest.mark.parametrize(("inner", "outer"), DEPARTURES)
def test_the_departure_is_the_largest_distance(inner, outer, rng):
    """Of many points: coordinates alone."""
    near = np.array([0.4, 0.1, -0.2])
    x = on(inner, rng, 20_000)
    if isinstance(inner, Line):
        foot = inner.center + ((near - inner.center) @ inner.direction) * inner.direction
        x = foot + rng.uniform(-1, 1, (20_000, 1)) * inner.direction
    step = x - outer.center
    height = step @ outer.normal if hasattr(outer, "normal") else np.zeros(len(x))
    beside = np.linalg.norm(step - height[:, None] * getattr(outer, "normal", np.zeros(3)), axis=1)
    distances = np.abs(height) if isinstance(outer, Plane) else np.hypot(height, beside - outer.radius)
    assert distances.max() <= departure(inner, outer, near) + 1e-12 and departure(inner, outer, near) < distances.max() + 1e-3


def test_pandas_around_a_table(rng):
    """What paper A leaves as an outlook: a circle through a point, or on a sphere; a plane with a line in it; a sphere around a circle."""
    chains = pandas_around_a_table(4)
    x = np.array([0.75, 0.0, 0.5])
    asked = [
        ("line", Point(x)),
        ("point_pair", Circle(x, (0, 0, 1), 0.2)),
        ("circle", Point(x + (0, 0.2, 0))),
        ("circle", Sphere(x, 0.3)),
        ("plane", Line.from_point_direction(x, (1, 2, 0.5))),
        ("sphere", Circle(x, (0.2, 0, 1), 0.25)),
    ]
    for kind, goal in asked:
        system = cga.Cooperative(chains[: COUNTS[kind]], kind)
        flanges = Flanges([np.eye(4) if c.order.placement is None else np.array(c.order.placement) for c in system.chains])
        for margin in (None, 0.2):
            found = reach(system, goal, degeneracy_margin=margin)
            assert found.success and inside(system, found.q)
            ends = flanges.points(found.q)
            assert corners(ends) >= (margin or 0.0) - 1e-7
            element = system.about.through(ends)
            inner, outer = (goal, element) if type(goal) in AROUND[kind] else (element, goal)
            x0 = on(inner, rng, 10) + (project(ends.mean(axis=0), inner) - inner.center if isinstance(inner, Line) else 0.0)
            assert np.abs(incidence(x0, outer).coefficients).max() < 1e-7


NONSENSE = [
    *(("point", PointPair), ("point_pair", Point), ("line", Circle), ("line", Sphere)),
    *(("circle", Line), ("plane", Sphere), ("sphere", Line), ("sphere", Plane)),
]


@pytest.mark.parametrize(("kind", "target"), NONSENSE)
def test_what_makes_no_sense_is_refused(kind, target, sliding):
    """Neither can lie in the other, or which of two points is meant is open."""
    made = {
        Point: Point((0, 0, 0)),
        PointPair: PointPair.from_points((0, 0, 0), (1, 0, 0)),
        Line: Line.from_points((0, 0, 0), (1, 0, 0)),
        Circle: Circle((0, 0, 0), (0, 0, 1), 1.0),
        Plane: Plane((0, 0, 1), 0.0),
        Sphere: Sphere((0, 0, 0), 1.0),
    }
    accepted = ", ".join(kind.__name__ for kind in RELATIONS[kind])
    message = f"unknown target of a cooperative {kind} '{target.__name__}'; known: {accepted}, Similarity"
    with pytest.raises(cga.UnknownNameError, match=re.escape(message)):
        reach(sliding[kind], made[target])
