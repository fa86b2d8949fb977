"""Where pygafro 1.3.5, a library of paper A's first author, and this package agree (similarity.md, section 11).

What pygafro answered is a record; the same things are computed here (see oracles/pygafro_record.py). test_a_pygafro_differences.py is about
where they differ, docs/pygafro.md the table of both.
"""

import numpy as np
import pytest
from pygafro_record import (
    FOUND,
    GROUPS,
    KINDS,
    LOGS,
    MOVES,
    RECORD,
    SAMPLES,
    SIGNS,
    angles_apart,
    apart,
    closed,
    exact_logs,
    full,
    joined,
    key,
    moved,
    numbers,
    of,
    spanned,
    through,
    within,
)

import cga_runtime as cga
from cga_runtime.multivectors import NAMES, Multivector

HAND = [[0.5**0.5, 0.5**0.5, 0, 0], [-(0.5**0.5), 0.5**0.5, 0, 0], [0, 0, 1, 0.1034], [0, 0, 0, 1]]
"""From link 8 of the Panda to the tip of its hand, where pygafro's ends: -45 degrees about z, 103.4 mm."""
ARMS = [("FrankaEmikaRobot", "panda", "panda_link8", HAND), ("KukaIIWA14", "iiwa14", "lbr_link_ee", np.eye(4))]


def test_the_record_is_of_the_release_that_is_spoken_of():
    assert (RECORD["origin"]["package"], RECORD["origin"]["version"]) == ("pygafro", "1.3.5")
    assert all(text.startswith("AttributeError") for text in RECORD["refused"].values())  # absent names; no call failed


def test_products_are_the_same():
    """Geometric, outer and inner (Hestenes) product, reverse and signed squared norm, of whole numbers: not one bit differs."""
    a, b = (Multivector(x, NAMES) for x in np.moveaxis(numbers(SAMPLES["multivectors"]), 1, 0))
    ours = {"geometric": a * b, "outer": a ^ b, "inner": a | b, "reverse": ~a}
    for rule, product in ours.items():
        np.testing.assert_array_equal(full(product), FOUND["products"][rule], rule)
    np.testing.assert_array_equal((a * ~a)["1"], FOUND["products"]["squaredNorm"])
    for kind, element in {**KINDS, "Motor": cga.Motor, "SimilarityTransformation": cga.Similarity}.items():
        assert tuple(NAMES[mask] for mask in FOUND["blades"][kind]) == element.blades


@pytest.mark.parametrize("kind", KINDS)
def test_primitives_are_the_same(kind):
    """Outer products of points, their negative squared norms, inverses; read back by element_of they are the element of the points."""
    points, found = SAMPLES["points"][key(kind)], FOUND["primitives"][kind]
    x = joined(kind, points)
    assert x.blades == KINDS[kind].blades
    size = np.abs(cga.Point(points).coefficients).max(axis=-1).prod(axis=-1)  # of the terms of the outer product
    assert (apart(x, of(kind, found["vector"])) < 1e-15 * size).all()
    square = (x * ~x)["1"]
    assert (square < 0).all() and np.abs(square / numbers(found["squaredNorm"]) - 1).max() < 1e-14
    assert np.abs((x * of(kind, found["inverse"]))["1"] - 1).max() < 1e-14
    assert apart(cga.element_of(of(kind, found["vector"]))[0], through(kind, points)).max() < 1e-14


def test_centres_radii_and_points_are_the_same_near_the_origin():
    for kind in ("Circle", "Sphere"):
        element, found = through(kind, SAMPLES["points"][key(kind)]), FOUND["primitives"][kind]
        assert np.abs(numbers(found["getRadius"]) / element.radius - 1).max() < 1e-15
        center = cga.Point(element.center).coefficients
        assert (np.abs(numbers(found["getCenter"]) - center).max(axis=-1) < 2e-15 * np.abs(center).max(axis=-1)).all()
    pair = np.stack([numbers(FOUND["primitives"]["PointPair"][f"getPoint{k}"])[:, 1:4] for k in (1, 2)], axis=1)
    assert np.abs(pair - SAMPLES["points"]["point_pair"]).max() < 1e-15


def test_unit_circle_to_circle_is_the_same_similarity():
    """Circle.Unit to C, and C1 to C2: our chart +1 in the direct gauge, sign included. V X1 ~V = X2 in full products."""
    circle = through("Circle", SAMPLES["points"]["circle"])
    v = cga.similarity_of(circle, chart=1)
    assert np.abs(v.coefficients - numbers(MOVES["points"])).max() < 1e-15
    assert apart(of("Circle", MOVES["unit"]), cga.unit_primitive("circle")) < 1e-15
    for pairs, found in ((SAMPLES["pairs"]["circle"], "circle_similarity"), (SAMPLES["congruent"], "congruent_similarity")):
        first, second = (through("Circle", x) for x in np.moveaxis(numbers(pairs), 1, 0))
        v = cga.similarity_between(first, second, "direct", chart=1)
        assert np.abs(v.coefficients - numbers(MOVES[found])).max() < 2e-15
        for same in (v, of("SimilarityTransformation", MOVES[found])):
            assert apart(moved(same, first), second).max() < 5e-15


def test_motors_between_circles_carry_centre_and_normal():
    """Circle.getMotor is our similarity to the second circle with the radius of the first: it takes C1 to C2 where the radii are equal."""
    for pairs, name in ((SAMPLES["pairs"]["circle"], "circle_motor"), (SAMPLES["congruent"], "congruent_motor")):
        first, second = (through("Circle", x) for x in np.moveaxis(numbers(pairs), 1, 0))
        shrunk = cga.Circle(second.center, second.normal, first.radius)
        motor = of("Motor", MOVES[name])
        assert apart(motor, cga.similarity_between(first, shrunk, chart=1)).max() < 2e-15
        error = apart(moved(motor, first), second)
        within(error, *((0.02, 2.0) if name == "circle_motor" else (-1.0, 5e-15)))


@pytest.mark.parametrize("kind", ["Line", "Plane"])
def test_motors_between_lines_and_planes_are_1_plus_x2_over_x1(kind):
    """normalised by the root of V ~V = s + p e123i. Ours, T R, also takes X1 to X2, and is another motor."""
    first, second = (through(kind, x) for x in np.moveaxis(numbers(SAMPLES["pairs"][key(kind)]), 1, 0))
    inverse = ~Multivector(-first.coefficients, first.blades)  # X1 ~X1 = -1
    v = Multivector([1.0], ["1"]) + second * inverse
    square = v * ~v
    s, p = square["1"][:, None], square["e123i"][:, None]
    root = Multivector(np.concatenate([s**-0.5, -0.5 * p * s**-1.5], axis=-1), ["1", "e123i"])
    motor = of("Motor", MOVES[f"{key(kind)}_motor"])
    assert apart(v * root, motor).max() < 5e-15
    ours = cga.similarity_between(first, second, "direct", chart=1)
    for v in (motor, ours):
        assert apart(moved(v, first), second).max() < 1e-14
    assert apart(motor, ours).max() > 0.1


@pytest.mark.parametrize("group", GROUPS)
def test_exponentials_are_the_same(group):
    """Split, each factor Exp(-B/2), order T R D, B_D = -log(d) e0i: ours and the record, and 50 digits."""
    kind, _, count = GROUPS[group]
    b = numbers(SAMPLES["bivectors" if group == "similarity" else "rigid_bivectors"])[:, :count]
    truth = np.array([[float(x) for x in closed.exp(group, row)] for row in b])
    for values in (kind.exp(b).coefficients, numbers(LOGS[f"{group}_exp"])):
        assert np.abs(values - truth).max() < 1e-15


@pytest.mark.parametrize("group", ["similarity", "rotor"])
def test_logarithms_are_the_same_for_rotations_from_3e_4_on(group):
    truth, angle = exact_logs(group)
    large = angle > 2.85e-4
    assert angles_apart(numbers(LOGS[f"{group}_log"]), truth)[large].max() < 5e-16
    if group == "similarity":
        assert np.abs(numbers(LOGS["similarity_log"])[:, 3:] - truth[:, 3:]).max() < 1e-14  # scale and translation at all angles


def test_derivatives_of_exp_and_log_of_motors_are_the_same():
    """As matrices of exp, on tangents of the group of log, whose matrix is not unique."""
    at = SAMPLES["jacobians_at"]
    b, motors = numbers(SAMPLES["rigid_bivectors"])[at], numbers(SAMPLES["motors"])[at]
    exp, log = cga.Motor.exp_jacobian(b), cga.Motor(motors).log_jacobian()
    assert np.abs(numbers(LOGS["motor_exp_jacobian"]) - exp).max() < 5e-16
    assert np.abs((log @ exp) - np.eye(6)).max() < 1e-15
    error = np.abs((numbers(LOGS["motor_log_jacobian"]) - log) @ exp).max(axis=(1, 2))
    assert error[1:].max() < 1e-15  # the first is among the differences


# ---- robots


@pytest.mark.parametrize(("name", "robot", "frame", "tip"), ARMS)
def test_arms_are_the_same(name, robot, frame, tip):
    """End motors; getEEGeometricJacobian is -2 dM ~M, our frame WORLD, getEEFrameJacobian -2 ~M dM, our frame LOCAL (paper A, eq. 8).

    q of the iiwa's y axes has the other sign: see the differences.
    """
    chain, found, signs, tip = cga.load_robot(robot).chain(frame), FOUND["arms"][name], SIGNS[name], cga.Motor.from_pose(tip)
    q = numbers(SAMPLES["q"][name]) * signs
    motors, recorded = cga.Motor(chain.motor(q)) * tip, of("Motor", found["getEEMotor"])
    assert np.minimum(apart(motors, recorded), np.abs(full(motors) + full(recorded)).max(axis=-1)).max() < 1e-15
    columns = {side: np.swapaxes(chain.jacobian(q, frame=side, order="bivector") * signs, -1, -2) for side in ("WORLD", "LOCAL")}
    world, local = (Multivector(rows, cga.Motor.bivector_blades) for rows in columns.values())
    local = ~tip * local * tip
    space, body = (Multivector(numbers(found[f"getEE{x}Jacobian"]), cga.Motor.bivector_blades) for x in ("Geometric", "Frame"))
    assert max(apart(space, world).max(), apart(body, local).max()) < 2e-15
    m, dm = of("Motor", numbers(found["getEEMotor"])[:, None]), of("Motor", found["getEEAnalyticJacobian"])
    assert max(np.abs(full(dm * ~m) * -2 - full(space)).max(), np.abs(full(~m * dm) * -2 - full(body)).max()) < 2e-15
    assert min(apart(space, local).max(), apart(body, world).max()) > 1.0


def test_circle_of_three_fingers_and_its_jacobian_are_the_same():
    """X and dX by outer products of P_i and dP_i = dM_i e0 ~M_i + M_i e0 ~dM_i (paper A, eqs. 14-17), M_i and dM_i as recorded."""
    for row in FOUND["hands"]["Hand_4_4_4"]:
        x, rates = spanned("Circle", row)
        assert apart(x, of("Circle", row["getFingerCircle"])).max() < 1e-16
        found = of("Circle", row["getFingerCircleJacobian"])
        assert (apart(rates, found) < 2e-15 * np.abs(full(rates)).max(axis=-1)).all()


def test_mean_motor_of_two_fingers_is_the_split_mean():
    """exp_s((log_s M1 + log_s M2) / 2), up to what its logarithm is off, 2e-10."""
    for row in FOUND["hands"]["Hand_4_4"]:
        motors = numbers(row["getFingerMotors"])
        mean = cga.Motor.exp(cga.Motor(motors).log().mean(axis=0)).coefficients
        assert np.abs(mean - numbers(row["getMeanMotor"])).max() < 2e-10
