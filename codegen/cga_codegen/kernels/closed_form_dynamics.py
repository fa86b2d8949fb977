"""The closed-form manipulator equation of paper B, eqs. (37)-(48), corrected and written as it reads, with typed multivectors.

An oracle over any scalar, tested equation by equation and never generated: kernels use the recursion, which needs fewer operations.
Inputs are ch = cos(q/2) and sh = sin(q/2) of every joint of the tree (prismatic joints: 1 and half the displacement), rates qd and qdd in
the model's joint order. Forces come in N m (N for prismatic joints), masses in kg m^2 (kg m, kg).

Corrections to the printed text: only ancestors act on a link (31, 42); (42) means inner products; bivectors square to negative numbers,
so (43) is -<b I(b)>_0; (44) and (46) take the Euclidean part of a Jacobian element, no logarithm, in the axes of the link motor M^j, not of
the joint rotor (17); (45) is a vector of torques, so its rate of b is multiplied by qd.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cga_codegen.algebra.blade_types import MOTOR, POINT, ROTOR, SCALAR, TWIST, BladeType, type_of
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA
from cga_codegen.kernels.vectors import Scalar, Vector, dot
from cga_codegen.kernels.versors import scaled_rotor, translator
from cga_codegen.robots.model import Inertia, Joint, ModelError, Placement, RobotModel

EUCLIDEAN_VECTOR = type_of(CGA.masks("e1 e2 e3"))
EUCLIDEAN_BIVECTOR = type_of(CGA.masks("e12 e13 e23"))
I3 = Multivector(type_of(CGA.masks("e123")), [1])
INFINITY = Multivector(type_of(CGA.masks("ei")), [1])


def _zeros(n: int) -> list[Scalar]:
    return [0] * n


def checked(model: RobotModel) -> RobotModel:
    """The model itself, or a ModelError: the paper's trees hang on a fixed base, and every joint has a coordinate of its own."""
    accepted = "the closed form of paper B knows revolute, continuous and prismatic joints on a fixed base, each independent"
    for joint in model.joints:
        if joint.kind not in ("revolute", "continuous", "prismatic"):
            raise ModelError(f"{model.name}: joint {joint.name!r} is {joint.kind}; {accepted}")
        if joint.follows:
            raise ModelError(f"{model.name}: joint {joint.name!r} mimics {joint.follows!r}; {accepted}")
    return model


def placement_motor(placement: Placement) -> Multivector:
    """M_F of (16): the motor T R of a fixed placement, unit norm."""
    rotor, left_out = scaled_rotor(placement)
    return (translator(placement.translation) * rotor.scaled(left_out)).project(MOTOR)


def joint_bivector(joint: Joint) -> Multivector:
    """B of (17) in the joint's own frame: the plane a I3 of a turn; for a slide, where the paper has nothing, a ^ ei."""
    axis = Multivector(EUCLIDEAN_VECTOR, joint.axis)
    return (axis ^ INFINITY if joint.kind == "prismatic" else axis * I3).project(TWIST)


def joint_motor(joint: Joint, ch: Scalar, sh: Scalar) -> Multivector:
    """M_i(q_i) = M_F,i R_i(q_i), R_i = exp(-q_i B_i / 2) = cos(q_i/2) - sin(q_i/2) B_i (16, 17): from the joint's link to its parent."""
    turn = Multivector(SCALAR, [ch]) - joint_bivector(joint).scaled(sh)
    return (placement_motor(joint.placement) * turn).project(MOTOR)


def link_motors(model: RobotModel, ch: Vector, sh: Vector) -> list[Multivector]:
    """M^j(q) (18): the product of the joint motors from the base to link j."""
    motors: list[Multivector] = []
    for joint, c, s in zip(checked(model).joints, ch, sh, strict=True):
        own = joint_motor(joint, c, s)
        motors.append(own if joint.parent < 0 else motors[joint.parent] * own)
    return motors


def geometric_jacobian(model: RobotModel, ch: Vector, sh: Vector) -> list[Multivector]:
    """B'_i = M^i B_i ~M^i (26, 27), the world screw of every joint; its own turn may be left in, for R_i and B_i commute."""
    return [motor.sandwich(joint_bivector(joint), TWIST) for joint, motor in zip(model.joints, link_motors(model, ch, sh), strict=True)]


def geometric_jacobian_rate(model: RobotModel, axes: Sequence[Multivector], qd: Vector) -> list[Multivector]:
    """dB'_i/dt = sum of (B'_i x B'_j) qd_j over the ANCESTORS j of i, itself left out (29-31; the printed sum runs over all joints)."""
    rates = []
    for i, axis in enumerate(axes):
        rate = Multivector(TWIST, _zeros(6))
        for j in model.path(i)[:-1]:
            rate = rate + axis.commutator(axes[j]).scaled(qd[j])
        rates.append(rate.project(TWIST))
    return rates


def conformal_point(x: Vector) -> Multivector:
    """X = e0 + x + x^2/2 ei (2)."""
    return Multivector(POINT, [1, *x, 0.5 * dot(x, x)])


def turned_inertia(inertia: Inertia, b: Multivector) -> Multivector:
    """The inertia tensor as a map of bivectors, w I3 -> (I w) I3, about the centre of mass in link axes."""
    xx, xy, xz, yy, yz, zz = inertia.tensor
    w = -(b.project(EUCLIDEAN_BIVECTOR) * I3)
    momentum = [dot(row, w.coefficients) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))]
    return Multivector(w.type, momentum) * I3


@dataclass(frozen=True)
class Link:
    """A link with mass, at one configuration of the tree; the paper's row j of the matrices of multivectors.

    ancestors: the joints that move it, its own included. x: its centre of mass as a point. levers[k] = V_jk of (41), turns[k] = b_jk of
    (44), both for k in ancestors; every other entry of the row is zero.
    """

    inertia: Inertia
    ancestors: tuple[int, ...]
    motor: Multivector
    x: Multivector
    levers: dict[int, Multivector]
    turns: dict[int, Multivector]

    def in_link_axes(self, axis: Multivector) -> Multivector:
        """~R_j <B'>_rot R_j: the Euclidean part of a Jacobian element, in the axes of the link (44, 46)."""
        return (~self.motor.project(ROTOR)).sandwich(axis.project(EUCLIDEAN_BIVECTOR), EUCLIDEAN_BIVECTOR)


def links_with_mass(model: RobotModel, motors: Sequence[Multivector], axes: Sequence[Multivector]) -> list[Link]:
    """X_j = M^j C(c_j) ~M^j, V_jk = X_j . B'_k (41), b_jk (44) for every link that has an inertia."""
    links = []
    for j, joint in enumerate(model.joints):
        if joint.inertia is not None:
            link = Link(joint.inertia, model.path(j), motors[j], motors[j].sandwich(conformal_point(joint.inertia.com), POINT), {}, {})
            for k in link.ancestors:
                link.levers[k] = link.x | axes[k]
                link.turns[k] = link.in_link_axes(axes[k])
            links.append(link)
    return links


def _links(model: RobotModel, ch: Vector, sh: Vector) -> tuple[list[Link], list[Multivector]]:
    axes = geometric_jacobian(model, ch, sh)
    return links_with_mass(model, link_motors(model, ch, sh), axes), axes


def _weighted(elements: dict[int, Multivector], weights: Vector, type: BladeType) -> Multivector:
    total = Multivector(type, _zeros(len(type)))
    for k, element in elements.items():
        total = total + element.scaled(weights[k])
    return total


def mass_matrix(model: RobotModel, ch: Vector, sh: Vector) -> list[list[Scalar]]:
    """M_ab = sum_j m_j V_ja . V_jb - <b_ja I_j(b_jb)>_0 (38, 43), all rows, symmetric; on the diagonal also the joints' armatures."""
    matrix = [_zeros(len(model.joints)) for _ in model.joints]
    for a, joint in enumerate(model.joints):
        matrix[a][a] = joint.armature
    for link in _links(model, ch, sh)[0]:
        for b in link.ancestors:
            spin = turned_inertia(link.inertia, link.turns[b])
            for a in link.ancestors:
                lever = link.levers[a].scalar_product(link.levers[b])
                matrix[a][b] = matrix[a][b] + link.inertia.mass * lever - link.turns[a].scalar_product(spin)
    return matrix


def coriolis_forces(model: RobotModel, ch: Vector, sh: Vector, qd: Vector) -> list[Scalar]:
    """C(q, qd) qd (39): sum_j m_j V_ja . (sum_k dV_jk qd_k) - <b_ja (I_j(sum_k db_jk qd_k) + w_j ^ I_j(w_j))>_0 (42, 45-47)."""
    forces = _zeros(len(model.joints))
    links, axes = _links(model, ch, sh)
    rates = geometric_jacobian_rate(model, axes, qd)
    for link in links:
        velocity = _weighted(link.levers, qd, POINT)
        acceleration = {k: (velocity | axes[k]) + (link.x | rates[k]) for k in link.ancestors}  # dV_jk (42)
        pull = _weighted(acceleration, qd, POINT).scaled(link.inertia.mass)
        spin_rate = _weighted({k: link.in_link_axes(rates[k]) for k in link.ancestors}, qd, EUCLIDEAN_BIVECTOR)  # (46)
        spin = _weighted(link.turns, qd, EUCLIDEAN_BIVECTOR)
        gyroscopic = (spin * I3) ^ (turned_inertia(link.inertia, spin) * I3)  # (47) in link axes: I3 b is an angular velocity, as printed
        torque = turned_inertia(link.inertia, spin_rate) + gyroscopic
        for a in link.ancestors:
            forces[a] = forces[a] + link.levers[a].scalar_product(pull) - link.turns[a].scalar_product(torque)
    return forces


def gravity_forces(model: RobotModel, ch: Vector, sh: Vector, gravity: Vector | None = None) -> list[Scalar]:
    """g_a = sum_j m_j V_ja . G (40); G holds against free fall: 9.81 e3 for a gravity of (0, 0, -9.81), m/s^2 in the
    base frame (default: the model's)."""
    forces = _zeros(len(model.joints))
    against = -Multivector(EUCLIDEAN_VECTOR, model.gravity if gravity is None else gravity)
    for link in _links(model, ch, sh)[0]:
        for a in link.ancestors:
            forces[a] = forces[a] + link.inertia.mass * link.levers[a].scalar_product(against)
    return forces


def inverse_dynamics(
    model: RobotModel,
    ch: Vector,
    sh: Vector,
    qd: Vector,
    qdd: Vector,
    gravity: Vector | None = None,
    external: Vector | None = None,
) -> list[Scalar]:
    """tau = tau_ext + M qdd + C qd + g (37, 48); tau_ext as in (37): what the robot exerts on its surroundings (N m)."""
    inertial = [dot(row, qdd) for row in mass_matrix(model, ch, sh)]
    rows = zip(inertial, coriolis_forces(model, ch, sh, qd), gravity_forces(model, ch, sh, gravity), strict=True)
    tau = [sum(row[1:], row[0]) for row in rows]
    return tau if external is None else [t + e for t, e in zip(tau, external, strict=True)]
