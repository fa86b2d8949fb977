"""Paper B, eqs. (37)-(49) and (57): the closed-form dynamics as corrected, against Pinocchio, the oracle file, and 50 digits.

Reproduced: all, in the corrected form of closed_form_dynamics.py (the printed one: test_b_errata.py); prismatic joints, trees, other
directions of gravity and armatures besides, which the paper leaves out. The recursion is the second oracle and meets the same figures.
"""

from dataclasses import replace

import casadi
import mpmath
import numpy as np
import pinocchio
import pytest

from cga_codegen.algebra.blade_types import MOTOR, WRENCH
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels import closed_form_dynamics
from cga_codegen.kernels.closed_form_dynamics import (
    coriolis_forces,
    geometric_jacobian,
    geometric_jacobian_rate,
    gravity_forces,
    inverse_dynamics,
    link_motors,
    links_with_mass,
    mass_matrix,
)
from cga_codegen.kernels.newton_euler_multivector import momentum, newton_euler
from cga_codegen.kernels.versors import scaled_rotor, translator

# Rounding, and the norm of stored motors: a quarter turn's sqrt(1/2) has 16 digits, so that M ~M of the Panda's seven placements is
# 1 - 1.1e-15, which M feels four times over (3e-15 relative). See test_fifty_digits for what is left without it.
MASS = 1e-14  # kg m^2; entries up to 3.7
FORCE = 2e-13  # N m, N; entries up to 100 (the oracle's samples: half of it)
ACCELERATION = 1e-12  # rad/s^2 at the samples; of random states relative to the largest entry
STATES = 5
H = 1e-30  # complex step


def close(got, expected, tolerance):
    np.testing.assert_allclose(np.array(got, dtype=np.float64), np.array(expected, dtype=np.float64), rtol=0, atol=tolerance)


def symmetric(matrix):
    """Pinocchio fills the upper triangle."""
    return np.triu(matrix) + np.triu(matrix, 1).T


@pytest.mark.parametrize("rule", [inverse_dynamics, newton_euler], ids=["closed form", "recursion"])
def test_inverse_dynamics(robot, rule):
    """(37), (48): tau is Pinocchio's rnea, for trees and slides too."""
    for q, qd, qdd in robot.states(STATES, 11):
        expected = pinocchio.rnea(robot.pin, robot.pin.createData(), q, qd, qdd)
        close(rule(robot.model, *robot.half(q), qd, qdd), expected, FORCE)


def test_large_trees(large_tree):
    """The same for a hand and a humanoid, whose many branches share no ancestors: tau by both rules, M."""
    for q, qd, qdd in large_tree.states(2, 10):
        half, data = large_tree.half(q), large_tree.pin.createData()
        expected = pinocchio.rnea(large_tree.pin, data, q, qd, qdd)
        for rule in (inverse_dynamics, newton_euler):
            close(rule(large_tree.model, *half, qd, qdd), expected, FORCE)
        close(mass_matrix(large_tree.model, *half), symmetric(pinocchio.crba(large_tree.pin, data, q)), MASS)


def test_terms(robot):
    """(38), (39), (40), each by itself: crba, nonlinear effects without gravity, generalised gravity; (37) is their sum."""
    for q, qd, qdd in robot.states(STATES, 12):
        half, data = robot.half(q), robot.pin.createData()
        m, c, g = mass_matrix(robot.model, *half), coriolis_forces(robot.model, *half, qd), gravity_forces(robot.model, *half)
        close(m, np.array(m).T, 2e-15)
        expected = symmetric(pinocchio.crba(robot.pin, data, q))
        close(np.array(m) / np.abs(expected).max(), expected / np.abs(expected).max(), MASS / 2)  # slides carry 10 kg
        gravity = pinocchio.computeGeneralizedGravity(robot.pin, data, q).copy()
        close(g, gravity, FORCE)
        close(c, pinocchio.nonLinearEffects(robot.pin, data, q, qd) - gravity, FORCE)
        close(c, pinocchio.computeCoriolisMatrix(robot.pin, data, q, qd) @ qd, FORCE)
        close(np.array(m) @ qdd + c + g, inverse_dynamics(robot.model, *half, qd, qdd), FORCE)
        for slot, a in ((m, qdd), (c, None)):  # the recursion gives the same terms one at a time
            got = newton_euler(robot.model, *half, qd * (a is None), qdd * (a is not None), (0, 0, 0))
            close(got, np.array(slot) @ a if a is not None else slot, FORCE)


def test_forward_dynamics(robot):
    """(49): M^-1 (tau - tau_ext - C qd - g) is Pinocchio's aba."""
    for q, qd, tau in robot.states(STATES, 13):
        half = robot.half(q)
        rest = np.array(coriolis_forces(robot.model, *half, qd)) + gravity_forces(robot.model, *half)
        got = np.linalg.solve(np.array(mass_matrix(robot.model, *half)), tau - rest)
        expected = pinocchio.aba(robot.pin, robot.pin.createData(), q, qd, tau)
        close(got / np.abs(expected).max(), expected / np.abs(expected).max(), ACCELERATION)


def test_external_forces(robot):
    """tau_ext of (37) is what the robot does to its surroundings: -J^T W for wrenches W on its links; the recursion takes W itself."""
    rng = np.random.default_rng(14)
    for q, qd, qdd in robot.states(3, 14):
        half, wrenches = robot.half(q), rng.normal(size=(robot.n, 6))  # f, m in the joint frames
        outside = [Multivector(WRENCH, [f1, f2, m3, f3, -m2, m1]) for f1, f2, f3, m1, m2, m3 in wrenches]
        forces = pinocchio.StdVec_Force()
        for wrench in np.vstack([np.zeros(6), wrenches]):
            forces.append(pinocchio.Force(wrench))
        expected = pinocchio.rnea(robot.pin, robot.pin.createData(), q, qd, qdd, forces)
        close(newton_euler(robot.model, *half, qd, qdd, external=outside), expected, FORCE)
        axes, motors = geometric_jacobian(robot.model, *half), link_motors(robot.model, *half)
        pushed = np.zeros(robot.n)
        for j, wrench in enumerate(outside):
            for k in robot.model.path(j):
                pushed[k] += motors[j].sandwich(wrench, WRENCH).scalar_product(axes[k])  # minus the power <-B W>_0 of a unit rate
        close(inverse_dynamics(robot.model, *half, qd, qdd, external=pushed), expected, FORCE)


def test_levers(robot):
    """(41), (42): V_jk is dX_j/dq_k with its Euclidean part Pinocchio's velocity of the centre of mass; dV_jk its rate (complex step)."""
    names = "e1 e2 e3"
    for q, qd, _ in robot.states(3, 15):
        half = robot.half(q)
        motors, axes = link_motors(robot.model, *half), geometric_jacobian(robot.model, *half)
        rates = geometric_jacobian_rate(robot.model, axes, qd)
        moving = robot.half(q + 1j * H * qd)
        stepped = links_with_mass(robot.model, link_motors(robot.model, *moving), geometric_jacobian(robot.model, *moving))
        data = robot.pin.createData()
        pinocchio.jacobianCenterOfMass(robot.pin, data, q)
        total, mass = np.zeros((3, robot.n)), 0.0
        for link, other in zip(links_with_mass(robot.model, motors, axes), stepped, strict=True):
            mass += link.inertia.mass
            velocity = sum((lever.scaled(qd[k]) for k, lever in link.levers.items()), -link.x.scaled(0))
            for k in link.ancestors:
                total[:, k] += link.inertia.mass * np.array(link.levers[k].at(names))
                rate = (velocity | axes[k]) + (link.x | rates[k])
                expected = [value.imag / H for value in other.levers[k].at("e1 e2 e3 ei")]
                close(rate.at("e1 e2 e3 ei"), expected, 1e-14)
                close(rate.at("e0"), [0.0], 1e-15)
        close(total / mass, data.Jcom, 4e-15)


def test_rotation_generators(robot):
    """(44), (46): sum_k b_jk qd_k and sum_k db_jk qd_k are angular velocity and acceleration (qdd = 0) of the link in its own axes."""
    for q, qd, _ in robot.states(3, 16):
        half, data = robot.half(q), robot.pin.createData()
        axes = geometric_jacobian(robot.model, *half)
        rates = geometric_jacobian_rate(robot.model, axes, qd)
        pinocchio.forwardKinematics(robot.pin, data, q, qd, np.zeros(robot.n))
        links = iter(links_with_mass(robot.model, link_motors(robot.model, *half), axes))
        for j, joint in enumerate(robot.model.joints):
            if joint.inertia is not None:
                link = next(links)
                for elements, expected in (
                    (link.turns, data.v[j + 1]),
                    ({k: link.in_link_axes(rates[k]) for k in link.ancestors}, data.a[j + 1]),
                ):
                    got = sum(qd[k] * np.array(b.at("e23 e13 e12")) for k, b in elements.items())
                    close(got * [1, -1, 1], expected.angular, 1e-13)


def test_momentum(robot):
    """The inertia of the recursion: momentum and kinetic energy -<V I[V]>_0 / 2 of every body are Pinocchio's."""
    rng = np.random.default_rng(17)
    for j, joint in enumerate(robot.model.joints):
        if joint.inertia is not None:
            v, w = rng.normal(size=(2, 3))
            twist = pinocchio.Motion(v, w)
            expected = robot.pin.inertias[j + 1] * twist
            element = Multivector.from_blades(
                geometric_jacobian(robot.model, *robot.half(np.zeros(robot.n)))[0].type,
                e12=w[2], e13=-w[1], e23=w[0], e1i=v[0], e2i=v[1], e3i=v[2],
            )  # fmt: skip
            got = momentum(joint.inertia, element)
            close(got.at("e01 e02 e03 e23 e13 e12"), [*expected.linear, *(expected.angular * [1, -1, 1])], 4e-15)
            close(-got.scalar_product(element) / 2, robot.pin.inertias[j + 1].vtiv(twist) / 2, 1e-14)


def test_oracle_samples(oracle):
    """Every sample: M, C qd, g, tau by both rules, and qdd from tau."""
    assert len(oracle.samples) == 4
    for sample in oracle.samples:
        half, qd, qdd = oracle.half(sample["q"]), np.array(sample["qd"]), np.array(sample["qdd"])
        m, c, g = mass_matrix(oracle.model, *half), coriolis_forces(oracle.model, *half, qd), gravity_forces(oracle.model, *half)
        close(m, sample["M"], MASS)
        close(c, sample["Cqd"], FORCE / 2)
        close(c, np.array(sample["C"]) @ qd, FORCE / 2)
        close(g, sample["g"], FORCE / 2)
        for rule in (inverse_dynamics, newton_euler):
            close(rule(oracle.model, *half, qd, qdd), sample["tau"], FORCE / 2)
        got = np.linalg.solve(np.array(m), np.array(sample["tau"]) - c - g)
        close(got, sample["qdd_from_tau"], ACCELERATION)
        close(got, qdd, ACCELERATION)


def test_fifty_digits(oracle, monkeypatch):
    """The same functions over mpmath, with placements of exact norm: the two rules are one, and Pinocchio's figures are theirs, rounded."""

    def exact_placement(placement):
        rotor, _ = scaled_rotor(placement)
        return (
            translator(placement.translation) * rotor.scaled(1 / mpmath.sqrt(sum(mpmath.mpf(x) ** 2 for x in rotor.coefficients)))
        ).project(MOTOR)

    monkeypatch.setattr(closed_form_dynamics, "placement_motor", exact_placement)
    with mpmath.workdps(50):
        bodies = [replace(j.inertia, com=tuple(map(mpmath.mpf, j.inertia.com))) for j in oracle.model.joints]
        joints = tuple(replace(joint, inertia=body) for joint, body in zip(oracle.model.joints, bodies, strict=True))
        model = replace(oracle.model, joints=joints)  # else x^2/2 of (2) would be rounded
        for sample in oracle.samples[1:3]:
            half = oracle.half([mpmath.mpf(x) for x in sample["q"]], mpmath.cos, mpmath.sin)
            qd, qdd = ([mpmath.mpf(x) for x in sample[key]] for key in ("qd", "qdd"))
            tau = inverse_dynamics(model, *half, qd, qdd)
            recursion = newton_euler(model, *half, qd, qdd)
            assert max(abs(a - b) for a, b in zip(tau, recursion, strict=True)) < 1e-46
            close(mass_matrix(model, *half), sample["M"], 5e-15)
            close(tau, sample["tau"], 4e-14)


def test_symbols(panda):
    """Both rules over casadi.SX, evaluated, are the floats'."""
    q, qd, qdd = panda.states(1, 20)[0]
    half = panda.half(q)
    ch, sh, v, a = (casadi.SX.sym(name, 7) for name in ("ch", "sh", "v", "a"))
    for rule in (inverse_dynamics, newton_euler):
        tau = casadi.vertcat(*rule(panda.model, *(casadi.vertsplit(x) for x in (ch, sh, v, a))))
        got = casadi.Function("tau", [ch, sh, v, a], [tau])(*half, qd, qdd)
        close(np.array(got).ravel(), rule(panda.model, *half, qd, qdd), FORCE / 2)


def test_any_direction_of_gravity(robot):
    """G of (40) is minus the acceleration of free fall, wherever that points; without one given, the model's own."""
    (q, qd, qdd), field = robot.states(1, 18)[0], (2.0, -3.0, 5.0)
    half, turned = robot.half(q), replace(robot.model, gravity=field)
    robot_pin = robot.pin.copy()
    robot_pin.gravity.linear = np.array(field)
    expected = pinocchio.rnea(robot_pin, robot_pin.createData(), q, qd, qdd)
    for rule in (inverse_dynamics, newton_euler):
        close(rule(robot.model, *half, qd, qdd, field), expected, FORCE)
        close(rule(turned, *half, qd, qdd), expected, FORCE)


def test_torque_control(panda):
    """(57): with u the error obeys M (qdd - qdd_d) = K_p (q_d - q) + K_d (qd_d - qd), up to tau at the measured q, qd."""
    kp, kd = np.diag([100.0, 100, 100, 100, 40, 40, 10]), np.diag([20.0, 20, 20, 20, 5, 5, 1])
    for q, qd, qdd_d in panda.states(STATES, 19):
        half, (dq, dqd) = panda.half(q), np.random.default_rng(19).normal(scale=0.1, size=(2, 7))
        u = inverse_dynamics(panda.model, *half, qd, qdd_d) + kp @ dq + kd @ dqd
        qdd = pinocchio.aba(panda.pin, panda.pin.createData(), q, qd, u)
        close(np.array(mass_matrix(panda.model, *half)) @ (qdd - qdd_d), kp @ dq + kd @ dqd, 5e-13)
