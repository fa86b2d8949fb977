"""Paper B, eqs. (7)-(15), (32)-(36), (51)-(53), (61)-(71), (75)-(83): motors, their exp and log, the log's Jacobian, inverse kinematics.

Reproduced: all of these, with exp(B) read as the exponential of -B/2, translation and rotation apart: B = B_T + B_R, exp(B) = T R.
(63) and (72)-(74) need corrections, see test_b_errata.py; their corrected forms are used here.
"""

import cmath
import math

import numpy as np
import pytest
from scipy.linalg import expm

from cga_codegen.algebra.blade_types import MOTOR, POINT, ROTOR, SCALAR, TRANSLATOR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.closed_form_dynamics import conformal_point, geometric_jacobian, link_motors
from cga_codegen.kernels.versors import rotor_about, translator

TWIST_ROWS, MOTOR_ROWS = "e23 e13 e12 e1i e2i e3i", "1 e23 e13 e12 e1i e2i e3i e123i"
ONE = Multivector(SCALAR, [1])
H = 1e-30  # complex step


def close(got, expected, tolerance):
    np.testing.assert_allclose(np.array(got, dtype=np.float64), expected, rtol=0, atol=tolerance)


def vanishes(x, tolerance):
    close(x.coefficients, 0.0, tolerance)


def series(b):
    """The exponential of -b/2 as its series, from which (9) and (10) follow when read with this sign."""
    power = total = ONE
    for k in range(1, 40):
        power = (power * b).scaled(-0.5 / k)
        total = total + power
    return total


def exp(b):
    """(14): exp(b) = T R from b1 .. b6 of (62), by (9) and (10)."""
    w = [b[0], -b[1], b[2]]
    angle = math.hypot(*w)
    axis = [x / angle for x in w] if angle else [0.0, 0.0, 1.0]
    return (translator(list(b[3:])) * rotor_about(axis, math.cos(angle / 2), math.sin(angle / 2))).project(MOTOR)


def log(motor):
    """(65)-(70): b1 .. b6 from m1 .. m8, as printed. Numbers may be complex."""
    m1, m2, m3, m4, m5, m6, m7, m8 = motor.at(MOTOR_ROWS)
    k = 2 * cmath.acos(m1) / cmath.sin(cmath.acos(m1))
    return np.array([
        -m2 * k, -m3 * k, -m4 * k,
        -2 * (m1 * m5 + m4 * m6 + m3 * m7 + m2 * m8),
        -2 * (-m4 * m5 + m1 * m6 + m2 * m7 - m3 * m8),
        -2 * (-m3 * m5 - m2 * m6 + m1 * m7 + m4 * m8),
    ])  # fmt: skip


def log_jacobian(motor):
    """(71) from (75)-(83) as printed and (72)-(74) with the denominator they lack, (1 - m1^2)^(3/2)."""
    m1, m2, m3, m4, m5, m6, m7, m8 = motor.at(MOTOR_ROWS)
    j, k = np.zeros((6, 8)), -2 * math.acos(m1) / math.sin(math.acos(m1))
    slope = -1 / (1 - m1 * m1) + m1 * math.acos(m1) / (1 - m1 * m1) ** 1.5
    j[0, 0], j[1, 0], j[2, 0] = -2 * m2 * slope, -2 * m3 * slope, -2 * m4 * slope
    j[0, 1] = j[1, 2] = j[2, 3] = k  # (75)
    j[3, 0], j[4, 3], j[5, 2] = -2 * m5, 2 * m5, 2 * m5  # (76)
    j[3, 1], j[4, 2], j[5, 3] = -2 * m8, 2 * m8, -2 * m8  # (77)
    j[3, 2], j[4, 1], j[5, 0] = -2 * m7, -2 * m7, -2 * m7  # (78)
    j[3, 3], j[4, 0], j[5, 1] = -2 * m6, -2 * m6, 2 * m6  # (79)
    j[3, 4] = j[4, 5] = j[5, 6] = -2 * m1  # (80)
    j[3, 5], j[4, 4], j[5, 7] = -2 * m4, 2 * m4, -2 * m4  # (81)
    j[3, 6], j[4, 7], j[5, 4] = -2 * m3, 2 * m3, 2 * m3  # (82)
    j[3, 7], j[4, 6], j[5, 5] = -2 * m2, -2 * m2, 2 * m2  # (83)
    return j


@pytest.fixture
def bivectors(rng):
    """Forty b1 .. b6 with angles below pi."""
    turns = rng.normal(size=(40, 3))
    turns *= (rng.uniform(0.01, 3.1, 40) / np.linalg.norm(turns, axis=1))[:, None]
    return np.hstack([turns, rng.normal(size=(40, 3))])


def test_translators_and_rotors(bivectors):
    """(9), (10) with exp(B) the exponential of -B/2: T = 1 - t ^ ei / 2, R = cos(th/2) - sin(th/2) B; (7), (8) on points."""
    for b in bivectors:
        w, t = np.array([b[0], -b[1], b[2]]), b[3:]
        turn = Multivector.from_blades(TWIST, e23=b[0], e13=b[1], e12=b[2])
        shift = Multivector.from_blades(TWIST, e1i=t[0], e2i=t[1], e3i=t[2])
        vanishes(series(turn) - rotor_about(w / np.linalg.norm(w), *(f(np.linalg.norm(w) / 2) for f in (math.cos, math.sin))), 2e-15)
        vanishes(series(shift) - translator(t), 0)
        x, rotation = np.array([0.3, -0.7, 0.2]), expm(np.cross(np.eye(3), w))
        motor = exp(b)
        vanishes(motor.sandwich(conformal_point(x), POINT) - conformal_point(rotation @ x + t), 1e-14)
        vanishes(series(shift) * series(turn) - motor, 2e-15)  # (7)
        vanishes(motor * ~motor - ONE, 2e-15)  # (13)


def test_motors_are_a_group(bivectors):
    """(11), (12): products of motors are motors, blade by blade; brackets of bivectors are bivectors."""
    assert (Multivector(MOTOR, range(8)) * Multivector(MOTOR, range(8))).type == MOTOR
    assert Multivector(TWIST, range(6)).commutator(Multivector(TWIST, range(6))).type == TWIST
    assert {*TWIST.masks} < {*MOTOR.masks}
    for a, b in zip(bivectors[:-1], bivectors[1:], strict=True):
        product = exp(a) * exp(b)
        vanishes(product * ~product - ONE, 4e-15)


def test_split(bivectors):
    """(61)-(64): R = -(e0 . (M ei)), T = M ~R; R is M's part on 1, e23, e13, e12."""
    origin, infinity = Multivector.from_blades(POINT, e0=1), Multivector.from_blades(POINT, ei=1)
    for b in bivectors:
        motor = exp(b)
        product = motor * infinity
        rotor = -origin.left_contraction(product)
        vanishes(rotor - motor.project(ROTOR), 0)
        vanishes(motor * ~rotor - translator(b[3:]), 4e-15)
        assert (motor * ~rotor).project(TRANSLATOR).type == TRANSLATOR


def test_round_trip(bivectors):
    """(14), (52), (65)-(70): log(exp(B)) = B and exp(log(M)) = M."""
    for b in bivectors:
        close(log(exp(b)).real, b, 4e-15)
        vanishes(exp(log(exp(b)).real) - exp(b), 4e-15)


def test_both_signs(bivectors):
    """M and -M move alike but their logs differ, by 2 pi along the axis: an error motor needs the sign of its scalar part first."""
    for b in bivectors:
        other = -exp(b)  # angles below pi have a positive scalar part
        far = log(other).real
        close(far[:3], b[:3] * (1 - 2 * math.pi / np.linalg.norm(b[:3])), 1e-13)  # acos near -1 loses digits
        close(far[3:], b[3:], 4e-15)
        close(log(other.scaled(np.sign(other.coefficient(0)))).real, b, 4e-15)


def test_log_without_acos(bivectors):
    """(65)-(67) divide 0 by 0 at the identity; with n = |m2, m3, m4| the factor 2 atan2(n, m1)/n is theirs elsewhere, and 2 there."""
    for b in bivectors:
        m1, *m = exp(b).at("1 e23 e13 e12")
        n = np.linalg.norm(m)
        close(-2 * math.atan2(n, m1) / n * np.array(m), log(exp(b)).real[:3], 1e-14)
    with pytest.raises(ZeroDivisionError):
        log(Multivector(MOTOR, [1.0, 0, 0, 0, 0.1, 0, 0, 0]))
    n = math.sqrt(3e-20 + 1e-24)
    close(2 * math.atan2(n, 1.0) / n, 2.0, 1e-15)


def test_interpolation(bivectors):
    """(15): M(t) = exp(sum w_j log M_j) is a motor, meets M_j at w = e_j, and runs through a straight path with two weights."""
    first, second = bivectors[:2]
    for w in np.linspace(0, 1, 5):
        motor = exp((1 - w) * log(exp(first)).real + w * log(exp(second)).real)
        vanishes(motor * ~motor - ONE, 2e-15)
        close(motor.sandwich(conformal_point(np.zeros(3)), POINT).at("e1 e2 e3"), (1 - w) * first[3:] + w * second[3:], 4e-15)
    for b in (first, second):
        vanishes(exp(log(exp(b)).real) - exp(b), 2e-15)


def test_log_jacobian(bivectors):
    """(71), (75)-(83) as printed, (72)-(74) corrected: complex step of (65)-(70) in each of the eight m, off the manifold too."""
    rng = np.random.default_rng(21)
    for b in bivectors:
        values = np.array(exp(b).at(MOTOR_ROWS)) + rng.uniform(-0.02, 0.02, 8)
        values[0] = np.clip(values[0], -0.95, 0.95)
        at = dict(zip(MOTOR_ROWS.replace("1 ", "scalar ", 1).split(), values, strict=True))
        got = log_jacobian(Multivector.from_blades(MOTOR, **at))
        for k, name in enumerate(at):
            stepped = log(Multivector.from_blades(MOTOR, **(at | {name: at[name] + 1j * H})))
            close(got[:, k], stepped.imag / H, 1e-14)


def error(robot, q, target):
    """(32), (53): log(~M_target M(q)), the sign of the motor as it comes."""
    return log(~target * link_motors(robot.model, *robot.half(q))[-1])


def error_jacobian(robot, q, target):
    """(33)-(35): J_log(~M_t M) E[~M_t J^A], with J^A = -B' M / 2 from (28)."""
    motor = link_motors(robot.model, *robot.half(q))[-1]
    columns = [(~target * axis * motor).scaled(-0.5) for axis in geometric_jacobian(robot.model, *robot.half(q))]
    embedded = np.array([column.at(MOTOR_ROWS) for column in columns]).T  # (35), (60): 8 x N
    return log_jacobian(~target * motor) @ embedded


def test_error_jacobian(oracle):
    """(33), (34), (35): complex step of (32), joint by joint."""
    for q, dq, _ in oracle.states(10, 22):
        target = link_motors(oracle.model, *oracle.half(q + 0.3 * dq))[-1]
        got = error_jacobian(oracle, q, target)
        assert got.shape == (6, 7)
        for i in range(7):
            close(got[:, i], error(oracle, q + 1j * H * np.eye(7)[i], target).imag / H, 1e-14)


def test_gauss_newton(oracle):
    """(32), (36) with alpha = 1, a pseudo-inverse for seven joints and six equations: quadratic from 0.05 rad away, down to rounding.

    Not near singular postures (smallest singular value of (33) above 0.04), where a full step leaves the region of convergence.
    """
    run = 0
    for q, dq, _ in oracle.states(20, 23):
        target = link_motors(oracle.model, *oracle.half(q + 0.05 * dq / np.linalg.norm(dq)))[-1]
        if np.linalg.svd(error_jacobian(oracle, q, target))[1][-1] < 0.04:
            continue
        run += 1
        distances = []
        while not distances or distances[-1] > 1e-7:  # nearer, (65) is 0/0: acos(1) / sin(acos(1))
            assert len(distances) < 4
            q = q - np.linalg.pinv(error_jacobian(oracle, q, target)) @ error(oracle, q, target).real
            left = link_motors(oracle.model, *oracle.half(q))[-1] - target
            distances.append(np.linalg.norm(np.array(left.coefficients)))
        assert distances[0] < 2e-3
        for before, after in zip(distances[:-1], distances[1:], strict=True):
            assert after < 200 * before**2 + 1e-12
    assert run >= 10


def test_point_mass(bivectors):
    """(51)-(53): the double integrator on b and its rate reaches log(M_target) exactly, where the cost (53) is zero."""
    dt, n = 0.1, 10
    eye = np.eye(6)
    a = np.block([[eye, dt * eye], [0 * eye, eye]])
    c = np.vstack([0.5 * dt * dt * eye, dt * eye])
    for start, goal in zip(bivectors[:-1:2], bivectors[1::2], strict=True):
        reach = np.hstack([np.linalg.matrix_power(a, n - 1 - k) @ c for k in range(n)])
        x = np.concatenate([start, np.zeros(6)])
        u = np.linalg.pinv(reach) @ (np.concatenate([log(exp(goal)).real, np.zeros(6)]) - np.linalg.matrix_power(a, n) @ x)
        for k in range(n):
            x = a @ x + c @ u[6 * k : 6 * k + 6]
        vanishes(exp(x[:6]) - exp(goal), 4e-15)
        assert np.linalg.norm(log(~exp(goal) * exp(start)).real) > 0.1  # (53) at the start
