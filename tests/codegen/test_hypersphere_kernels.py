"""The kernels of hyperspheres against exact rationals, the algebra G(5,1), complex steps, and the sphere's kernels."""

from fractions import Fraction

import numpy as np
import pytest
from exact_hyperspheres import determinant, edges, span, through, unit_hypersphere, versors

from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels import hypersphere, primitives, similarity
from cga_codegen.kernels.hypersphere import HYPERSPHERE
from cga_runtime.kernels import generated_folder, library

TOLERANCE = 1e-12
STEP = 1e-30
ONE_LIFTED = np.array([0.0, 0.0, 0.0, 0.0, 0.05])
LIFTS = {"one": ONE_LIFTED, "several": np.array([0.03, -0.05, 0.0, 0.08, 0.02])}
UNIT = library(generated_folder()).unit("algebra/cooperative_hypersphere")


def values(name, points, *lifts):
    """The generated text on floats or complex numbers."""
    kernel = UNIT.kernel(name)
    return np.array(UNIT.text[name](np.ravel(points), *lifts)).reshape(kernel.shape)


def by_steps(name, points, *lifts, of_lifts=False):
    """Complex-step derivatives by the points, or by the lifts: the last axis counts them."""
    columns = []
    for direction in np.eye(5 if of_lifts else 15) * 1j * STEP:
        given = (points, lifts[0] + direction) if of_lifts else (points + direction.reshape(5, 3), *lifts)
        columns.append(values(name, *given).imag / STEP)
    return np.stack(columns, axis=-1)


def close(found, expected, tolerance=TOLERANCE):
    assert found.shape == np.shape(expected)
    assert np.abs(found - expected).max() <= tolerance * np.abs(expected).max()


@pytest.fixture(params=LIFTS)
def lifts(request):
    return LIFTS[request.param]


def draws(rng, count=10):
    """Fingertips some centimetres apart, 30 cm from the origin."""
    return 0.3 + rng.uniform(-0.06, 0.06, (count, 5, 3))


def exact(points, lifts):
    return through([[Fraction(float(t)) for t in (*x, h)] for x, h in zip(points, lifts, strict=True)])


@pytest.mark.parametrize("distance", [0.0, 1.0, 100.0])
def test_parts_equal_exact_ones_also_far_from_the_origin(lifts, rng, distance):
    """The radius, and the centre up to roundoff of the world's coordinates: relative to the condition of the edges, 1e-15."""
    for points in rng.uniform(-0.06, 0.06, (20, 5, 3)) + distance:
        centre, square = exact(points, lifts)
        rows = np.concatenate([points, lifts[:, None]], axis=1)
        condition = np.linalg.cond(rows[1:] - rows[0])
        found = UNIT.kernel("parts")(points, lifts)
        radius = float(square) ** 0.5
        assert abs(found[4] - radius) < 1e-15 * condition * radius
        assert np.abs(found[:4] - np.array(centre, dtype=float)).max() < 1e-15 * condition * radius + 2e-16 * distance
        sliced = UNIT.kernel("slice")(points, lifts)
        assert np.array_equal(sliced[:3], found[:3])
        rho = float(square - centre[3] ** 2)
        assert abs(sliced[3] - rho) < 1e-15 * condition * max(abs(rho), radius * np.abs(lifts[0]).max())


def test_parts_lose_digits_where_they_are_read_off_the_multivector(rng):
    """Why kernels do not: from X the radius of five points 100 m away is off by 1e-6."""
    points = rng.uniform(-0.06, 0.06, (5, 3)) + 100.0
    x = values("primitive", points, ONE_LIFTED)
    element = Multivector(HYPERSPHERE.type, x)
    radius = np.sqrt(-(element * element).coefficient(0)) / abs(x[0])
    truth = float(exact(points, ONE_LIFTED)[1]) ** 0.5
    assert abs(radius / truth - 1) > 1e-9 and abs(UNIT.kernel("parts")(points, ONE_LIFTED)[4] / truth - 1) < 1e-12


def test_the_similarity_carries_the_unit_hypersphere_to_the_primitive(lifts, rng):
    for points in draws(rng):
        versor = Multivector(versors(4), values("similarity", points, lifts))
        element, r = values("primitive", points, lifts), values("parts", points, lifts)[4]
        moved = (versor * unit_hypersphere(4, 1.0) * ~versor).project(HYPERSPHERE.type).coefficients
        close(np.array(moved), element / (element[0] * r), 1e-9)  # the wedge of world coordinates has lost them
        span_of = span(4, [[*x, h] for x, h in zip(points, lifts, strict=True)])
        close(element, np.array(span_of.coefficients), 1e-9)


def test_the_geometric_jacobian_is_that_of_the_versor(lifts, rng):
    """-2 ~V dV by complex steps: within 1 e0i e1i ... e4i nothing but the five bivectors is left."""
    type = versors(4)
    assert tuple(type.blade_names[1:]) == HYPERSPHERE.controllable
    for points in draws(rng):
        for name, of_lifts in (("geometric_jacobian", False), ("geometric_jacobian_by_lifts", True)):
            versor = Multivector(type, values("similarity", points, lifts))
            found = UNIT.kernel(name)(points, lifts)
            expected = []
            for column in by_steps("similarity", points, lifts, of_lifts=of_lifts).T:
                body = (~versor * Multivector(type, column)).scaled(-2).project(type).coefficients
                assert abs(body[0]) < TOLERANCE * np.abs(body).max()
                expected.append(body[1:])
            close(found, np.transpose(expected))
            by_parts = by_steps("parts", points, lifts, of_lifts=of_lifts) / values("parts", points, lifts)[4]
            close(found, np.concatenate([-by_parts[4:], by_parts[:4]]))  # -d log r, dC / r


def test_the_rank_of_the_geometric_jacobian_is_five_unless_a_point_stands_at_the_centre(lifts, rng):
    """J_G is the invertible matrix of shares times the rows u_i of each point: a point in the centre of the slice has none. With one lift
    that is the fifth only, whose power has its least value -rho^2 there."""
    points = draws(rng, 200)
    ranks = np.linalg.matrix_rank(UNIT.kernel("geometric_jacobian")(points, lifts), rtol=1e-10)
    assert (ranks == 5).all()
    for one in points[:10]:
        one[4] = values("slice", one, ONE_LIFTED)[:3]
        c4, rho_square = values("parts", one, ONE_LIFTED)[3], values("slice", one, ONE_LIFTED)[3]
        assert abs(c4 - (0.05**2 - rho_square) / 0.1) < 1e-12 * (1 + abs(c4))
        assert np.linalg.matrix_rank(UNIT.kernel("geometric_jacobian")(one, ONE_LIFTED), rtol=1e-10) == 4


def test_degeneracy_and_its_gradients(lifts, rng):
    for points in draws(rng):
        rows = np.concatenate([points, lifts[:, None]], axis=1)
        rows = rows[1:] - rows[0]
        close(values("degeneracy", points, lifts), [abs(np.linalg.det(rows)) / np.linalg.norm(rows, axis=1).prod()])
        close(values("degeneracy_gradient", points, lifts), by_steps("degeneracy", points, lifts)[0])
        close(values("degeneracy_gradient_by_lifts", points, lifts), by_steps("degeneracy", points, lifts, of_lifts=True)[0])


def test_degeneracy_is_total(rng):
    points = draws(rng, 1)[0]
    flat = points.copy()
    flat[3] = 0.2 * flat[0] + 0.5 * flat[1] + 0.3 * flat[2]  # four in one plane: the fifth's lift does not help
    for bad, lifts in ((points, np.zeros(5)), (points, np.full(5, 0.3)), (flat, ONE_LIFTED), (np.zeros((5, 3)), np.zeros(5))):
        assert abs(UNIT.kernel("degeneracy")(bad, lifts)[0]) < 1e-15
        for name in ("degeneracy_gradient", "degeneracy_gradient_by_lifts"):
            assert np.isfinite(UNIT.kernel(name)(bad, lifts)).all()
    assert UNIT.kernel("degeneracy")(flat, LIFTS["several"])[0] > 1e-4


def test_the_in_sphere_determinant(rng):
    for points in draws(rng):
        x = [[Fraction(float(t)) for t in p] for p in points]
        weight = float(determinant([[*a, sum(t * t for t in a) / 2] for a in edges(x)]))
        close(UNIT.kernel("insphere")(points), [weight], 1e-12)
        close(values("insphere_gradient", points), by_steps("insphere", points)[0])
    directions = rng.standard_normal((5, 3))
    cospherical = 0.3 + 0.05 * directions / np.linalg.norm(directions, axis=1)[:, None]
    scale = np.linalg.norm(cospherical[1:] - cospherical[0], axis=1).prod() * 0.05
    assert abs(UNIT.kernel("insphere")(cospherical)[0]) < 1e-14 * scale


def test_the_affine_dependency_and_its_jacobian(rng):
    for points in draws(rng):
        m = UNIT.kernel("dependency")(points)
        assert abs(m.sum()) < 1e-15 and np.abs(m @ (points - points[0])).max() < 1e-16 and abs(m @ m - 1) < 1e-15
        close(UNIT.kernel("dependency_jacobian")(points), by_steps("dependency", points))
    assert not UNIT.kernel("dependency")(np.zeros((5, 3))).any()


# ---- other dimensions


def test_without_lifts_four_points_give_the_kernels_of_the_sphere(rng):
    about, sphere = hypersphere.hypersphere(3), primitives.KINDS["sphere"]
    places = [0, 4, 5, 6, 8]  # 1 e0i e1i e2i e3i of the similarity
    for points in draws(rng)[:, :4].reshape(10, 12):
        chart = [1.0]
        versor = np.array(similarity.similarity(sphere, list(points), chart), dtype=float)
        close(np.array(hypersphere.similarity(about, list(points), [])), versor[places])
        close(
            np.array(hypersphere.parts(about, list(points), [])), np.array(similarity.parts(sphere, list(points), chart), dtype=float)[4:]
        )
        rows = np.array(similarity.geometric_jacobian(sphere, list(points), chart), dtype=float).reshape(7, 12)
        close(np.array(hypersphere.geometric_jacobian(about, list(points), [])).reshape(4, 12), rows[3:])
        close(np.array(hypersphere.degeneracy(about, list(points), [])), primitives.degeneracy(sphere, list(points)))
        close(np.array(hypersphere.primitive(about, list(points), [])), primitives.primitive(sphere, list(points)), 1e-9)


def test_six_points_in_five_dimensions(rng):
    """Six chains: two more coordinates, e.g. the sphere of four and the powers of two."""
    about = hypersphere.hypersphere(5)
    points = rng.uniform(-1.0, 1.0, (6, 3))
    lifts = np.zeros((6, 2))
    lifts[4, 0], lifts[5, 1] = 0.5, 0.7
    centre, square = through([[Fraction(float(t)) for t in (*x, *h)] for x, h in zip(points, lifts, strict=True)])
    found = np.array(hypersphere.parts(about, list(points.ravel()), list(lifts.ravel())))
    close(found, np.array([*centre, float(square) ** 0.5], dtype=float))
    small, radius = through([[Fraction(float(t)) for t in x] for x in points[:4]])
    powers = [float(sum((Fraction(float(a)) - b) ** 2 for a, b in zip(x, small, strict=True)) - radius) for x in points[4:]]
    close(found[3:5], [(powers[0] + 0.25) / 1.0, (powers[1] + 0.49) / 1.4])
    sliced = hypersphere.slice(about, list(points.ravel()), list(lifts.ravel()))
    close(np.array(sliced), np.array([*small, radius], dtype=float))
    versor = Multivector(versors(5), hypersphere.similarity(about, list(points.ravel()), list(lifts.ravel())))
    element = np.array(hypersphere.primitive(about, list(points.ravel()), list(lifts.ravel())))
    moved = (versor * unit_hypersphere(5, 1.0) * ~versor).project(about.type).coefficients
    close(np.array(moved), element / (element[0] * found[5]))
    jacobian = np.array(hypersphere.geometric_jacobian(about, list(points.ravel()), list(lifts.ravel()))).reshape(6, 18)
    step = 1e-5
    for k in range(18):  # central differences suffice where the formula is checked to 1e-12 for five
        moves = [hypersphere.parts(about, list(points.ravel() + s * step * np.eye(18)[k]), list(lifts.ravel())) for s in (1, -1)]
        rate = (np.array(moves[0]) - np.array(moves[1])) / (2 * step * found[5])
        assert np.abs(jacobian[:, k] - [-rate[5], *rate[:5]]).max() < 1e-7 * np.abs(jacobian).max()
