"""Paper B, eqs. (16)-(31), (60): forward kinematics, analytic and geometric Jacobians and rates, against Pinocchio and the oracle file.

Reproduced: all, with the tree's ancestors in (31) and with B = a ^ ei for prismatic joints, which the paper leaves out.
Derivatives are taken by complex step: the multivectors run over complex numbers.
"""

import math

import numpy as np
import pinocchio
import pytest

from cga_codegen.algebra.blade_types import LINE, MOTOR, POINT, SCALAR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.closed_form_dynamics import (
    conformal_point,
    geometric_jacobian,
    geometric_jacobian_rate,
    joint_bivector,
    joint_motor,
    link_motors,
    placement_motor,
)
from cga_codegen.kernels.versors import motor_jacobian
from cga_codegen.robots.model import Joint, ModelError, Placement, RobotModel

ONE = Multivector(SCALAR, [1])
H = 1e-30  # complex step
STATES = 10


def close(got, expected, tolerance):
    np.testing.assert_allclose(np.array(got, dtype=np.float64), expected, rtol=0, atol=tolerance)


def joint_frames(robot, q):
    """Pinocchio's homogeneous matrices of the joint frames."""
    data = robot.pin.createData()
    pinocchio.forwardKinematics(robot.pin, data, q)
    return [placed.homogeneous for placed in data.oMi[1:]]


def imaginary(elements):
    """Complex-step derivatives of multivectors."""
    return [Multivector(x.type, [complex(c).imag / H for c in x.coefficients]) for x in elements]


def test_forward_kinematics(robot):
    """(16), (18): M^k = prod M_F,i R_i(q_i) is Pinocchio's placement of joint k; M ~M = 1 (13)."""
    for q, _, _ in robot.states(STATES, 1):
        motors = link_motors(robot.model, *robot.half(q))
        for motor, expected in zip(motors, joint_frames(robot, q), strict=True):
            close(robot.pose_of(motor), expected, 8e-15)
            moved = motor.sandwich(conformal_point((0.3, -0.2, 0.5)), POINT)
            close(moved.at("e1 e2 e3"), (expected @ [0.3, -0.2, 0.5, 1])[:3], 4e-15)
            norm = motor * ~motor
            close([norm.coefficient(mask) - (mask == 0) for mask in norm.type.masks], 0.0, 4e-15)


def test_joint_motors(robot):
    """(17): R_i = exp(-q_i B_i / 2) by its series; revolute: cos - sin B; prismatic: 1 - (q/2) a ^ ei."""
    for joint, (q,) in zip(robot.model.joints, np.random.default_rng(2).uniform(-3, 3, (robot.n, 1)), strict=True):
        exponent, power, total = joint_bivector(joint).scaled(-q / 2), ONE, ONE
        for k in range(1, 40):
            power = (power * exponent).scaled(1 / k).project(MOTOR)
            total = total + power
        slides = joint.kind == "prismatic"
        own = joint_motor(joint, 1 if slides else math.cos(q / 2), q / 2 if slides else math.sin(q / 2))
        close((placement_motor(joint.placement) * total - own).coefficients, 0.0, 4e-15)


def analytic_jacobian(robot, q):
    """(24), (25) as printed, of a serial chain: column i is M_1 .. M_F,i (-B_i/2) R_i .. M_N."""
    ch, sh = robot.half(q)
    columns = []
    for i in range(robot.n):
        product = ONE
        for j, joint in enumerate(robot.model.joints):
            if j == i:
                turn = Multivector(SCALAR, [ch[j]]) - joint_bivector(joint).scaled(sh[j])
                product = product * placement_motor(joint.placement) * joint_bivector(joint).scaled(-0.5) * turn
            else:
                product = product * joint_motor(joint, ch[j], sh[j])
        columns.append(product.project(MOTOR))
    return columns


def test_analytic_jacobian(oracle):
    """(19)-(21), (24), (25), (60): equal to the complex step, column by column and along a motion, and to the generated kernel's rows."""
    for q, qd, _ in oracle.states(5, 3):
        columns = analytic_jacobian(oracle, q)
        for i, column in enumerate(columns):
            stepped = link_motors(oracle.model, *oracle.half(q + 1j * H * np.eye(oracle.n)[i]))[-1]
            close((imaginary([stepped])[0] - column).coefficients, 0.0, 4e-15)
        (rate,) = imaginary([link_motors(oracle.model, *oracle.half(q + 1j * H * qd))[-1]])
        embedded = np.array([column.coefficients for column in columns]).T  # (60), N = 7 columns of the eight blades of (11)
        assert embedded.shape == (8, 7)
        close(embedded @ qd, rate.coefficients, 1e-14)
        chain = oracle.model.chain(oracle.model.frames[0].name)
        tool = placement_motor(chain.tool)
        kernel = np.array(motor_jacobian(chain, *oracle.half(q)), dtype=float).reshape(8, 7)
        close(np.array([(column * tool).coefficients for column in columns]).T, kernel, 4e-15)


def test_relation_of_the_jacobians(oracle):
    """(28): J^G = -2 J^A ~M in the world; -2 ~M J^A is Pinocchio's LOCAL Jacobian of the last joint."""
    for q, _, _ in oracle.states(STATES, 4):
        motor = link_motors(oracle.model, *oracle.half(q))[-1]
        columns = analytic_jacobian(oracle, q)
        world = [(column * ~motor).scaled(-2) for column in columns]
        for column, expected in zip(world, geometric_jacobian(oracle.model, *oracle.half(q)), strict=True):
            close((column - expected).coefficients, 0.0, 4e-15)
        body = [(~motor * column).scaled(-2).project(TWIST) for column in columns]
        expected = pinocchio.computeJointJacobian(oracle.pin, oracle.pin.createData(), q, oracle.n)
        close(oracle.linear_first(body), expected, 4e-15)


def test_geometric_jacobian(robot):
    """(22), (26), (27): the screws of each link's ancestors are the columns of Pinocchio's WORLD Jacobian, the others are zero; (23) with
    them: J^M(xi) J^A, here the linear map X -> -2 X ~M."""
    for q, qd, _ in robot.states(STATES, 5):
        axes = geometric_jacobian(robot.model, *robot.half(q))
        data = robot.pin.createData()
        pinocchio.computeJointJacobians(robot.pin, data, q)
        for link in range(robot.n):
            row = [axes[k] if k in robot.model.path(link) else Multivector(TWIST, [0] * 6) for k in range(robot.n)]  # J^G_j of (26)
            expected = pinocchio.getJointJacobian(robot.pin, data, link + 1, pinocchio.ReferenceFrame.WORLD)
            close(robot.linear_first(row), expected, 4e-15)
            pinocchio.forwardKinematics(robot.pin, data, q, qd)
            twist = pinocchio.getVelocity(robot.pin, data, link + 1, pinocchio.ReferenceFrame.WORLD)
            close(robot.linear_first(row) @ qd, [*twist.linear, *twist.angular], 1e-14)


def test_screws_are_lines(robot):
    """(27) of a revolute joint is the dual L* = I L (5) of its axis line L = P1 ^ P2 ^ ei, the points one unit apart (remark under 14)."""
    infinity = Multivector.from_blades(POINT, ei=1)
    for q, _, _ in robot.states(5, 6):
        frames = joint_frames(robot, q)
        for joint, axis, frame in zip(robot.model.joints, geometric_jacobian(robot.model, *robot.half(q)), frames, strict=True):
            if joint.kind != "prismatic":
                start, end = frame[:3, 3], frame[:3, 3] + frame[:3, :3] @ joint.axis
                line = (conformal_point(start) ^ conformal_point(end) ^ infinity).project(LINE)
                close((line.dual() - axis).coefficients, 0.0, 4e-15)


def test_rates_of_the_jacobian(robot):
    """(29)-(31), ancestors only: complex step along the motion, and Pinocchio's derivative of its WORLD Jacobian."""
    for q, qd, _ in robot.states(STATES, 7):
        rates = geometric_jacobian_rate(robot.model, geometric_jacobian(robot.model, *robot.half(q)), qd)
        stepped = imaginary(geometric_jacobian(robot.model, *robot.half(q + 1j * H * qd)))
        for rate, expected in zip(rates, stepped, strict=True):
            close((rate - expected).coefficients, 0.0, 1e-14)
        data = robot.pin.createData()
        pinocchio.computeJointJacobiansTimeVariation(robot.pin, data, q, qd)
        for link in range(robot.n):
            row = [rates[k] if k in robot.model.path(link) else Multivector(TWIST, [0] * 6) for k in range(robot.n)]  # (29)
            expected = pinocchio.getJointJacobianTimeVariation(robot.pin, data, link + 1, pinocchio.ReferenceFrame.WORLD)
            close(robot.linear_first(row), expected, 1e-14)


def test_oracle_samples(oracle):
    """End pose, end motor (up to its sign), Jacobian in the world and in the end frame, and its rate: every sample of the file."""
    tool = placement_motor(oracle.model.frames[0].placement)
    assert len(oracle.samples) == 4
    for sample in oracle.samples:
        half = oracle.half(sample["q"])
        motor = link_motors(oracle.model, *half)[-1] * tool
        close(oracle.pose_of(motor)[:3], np.column_stack([sample["ee_rotation"], sample["ee_translation"]]), 5e-15)
        sign = np.sign(np.dot(motor.coefficients, oracle.motor_of(sample["ee_motor"]).coefficients))
        close((motor.scaled(sign) - oracle.motor_of(sample["ee_motor"])).coefficients, 0.0, 2e-15)
        axes = geometric_jacobian(oracle.model, *half)
        close(oracle.in_paper_rows(axes), sample["J_geo_spatial"], 5e-15)
        body = [(~motor).sandwich(axis, TWIST) for axis in axes]
        close(oracle.in_paper_rows(body), sample["J_geo_body"], 1e-14)  # norm of the motor: seven rounded sqrt(1/2) in the placements
        close(oracle.in_paper_rows(geometric_jacobian_rate(oracle.model, axes, sample["qd"])), sample["Jdot_geo_spatial"], 1e-14)


def test_bundled_arms_are_the_oracles(arms):
    """Two ways to the same arm, a URDF with its fingers locked and the oracle file: placements, axes, masses, end frames, to rounding."""
    bundled, other = (arm.model for arm in arms)
    assert len(bundled.joints) == len(other.joints) == 7
    for a, b in zip(bundled.joints, other.joints, strict=True):
        assert a.axis == b.axis
        close(a.placement.matrix(), b.placement.matrix(), 1e-15)
        close([a.inertia.mass, *a.inertia.com, *a.inertia.tensor], [b.inertia.mass, *b.inertia.com, *b.inertia.tensor], 1e-16)
    close(bundled.frame(other.frames[0].name).placement.matrix(), other.frames[0].placement.matrix(), 0)


@pytest.mark.parametrize(("change", "message"), [({"kind": "floating"}, "'one' is floating"), ({"follows": "two"}, "'one' mimics 'two'")])
def test_refusals(change, message):
    """A floating base and a mimicking joint are none of the paper's: named, with what is accepted."""
    free = (-math.inf, math.inf, math.inf, math.inf)
    two = Joint("two", "revolute", 0, Placement(), (0.0, 0.0, 1.0), *free)
    one = Joint(**{"name": "one", "kind": "revolute", **change}, parent=-1, placement=Placement(), axis=(0.0, 0.0, 1.0),
                lower=-1.0, upper=1.0, velocity=1.0, effort=1.0)  # fmt: skip
    model = RobotModel("odd", (one, two), ())
    with pytest.raises(ModelError, match=f"odd: joint {message}; .* revolute, continuous and prismatic joints on a fixed base, each indep"):
        link_motors(model, [1, 1], [0, 0])
