"""Recursive Newton-Euler inverse dynamics with typed multivectors, a second oracle beside the closed form of paper B, eq. (48).

Twists V = w I3 + v ^ ei and wrenches W = m I3 + e0 ^ f are those of the link frame; power is -<V W>_0. Every sandwich of a wrench is
projected on the six blades of a wrench: what is dropped does no work on any twist, and no motor brings it back.
"""

from __future__ import annotations

from collections.abc import Sequence

from cga_codegen.algebra.blade_types import ORIGIN, TWIST, WRENCH
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.closed_form_dynamics import (
    EUCLIDEAN_VECTOR,
    INFINITY,
    checked,
    joint_bivector,
    joint_motor,
    turned_inertia,
)
from cga_codegen.kernels.vectors import Scalar, Vector
from cga_codegen.kernels.versors import translator
from cga_codegen.robots.model import Inertia, RobotModel


def momentum(inertia: Inertia, twist: Multivector) -> Multivector:
    """I[V] in the link frame: T_c ((I w) I3 + e0 ^ (m v)) ~T_c with w and v of ~T_c V T_c, T_c = 1 - c ^ ei / 2 to the centre of mass."""
    to_com = translator(inertia.com)
    there = (~to_com).sandwich(twist, TWIST)
    v = Multivector(EUCLIDEAN_VECTOR, there.at("e1i e2i e3i"))
    linear = Multivector(ORIGIN, [1]) ^ v.scaled(inertia.mass)
    return to_com.sandwich((turned_inertia(inertia, there) + linear).project(WRENCH), WRENCH)


def newton_euler(
    model: RobotModel,
    ch: Vector,
    sh: Vector,
    qd: Vector,
    qdd: Vector,
    gravity: Vector | None = None,
    external: Sequence[Multivector | None] | None = None,
) -> list[Scalar]:
    """Joint forces tau (N m, N). ch, sh: cos(q/2), sin(q/2) (prismatic: 1, q/2); gravity: free fall in the base frame, m/s^2 (default: the
    model's). external[j]: wrench on link j from outside, in the frame of link j.
    """
    joints = checked(model).joints
    motors = [joint_motor(joint, c, s) for joint, c, s in zip(joints, ch, sh, strict=True)]
    axes = [joint_bivector(joint) for joint in joints]
    resting = Multivector(TWIST, [0] * 6)
    against = (-Multivector(EUCLIDEAN_VECTOR, model.gravity if gravity is None else gravity) ^ INFINITY).project(TWIST)
    twists: list[Multivector] = []
    rates: list[Multivector] = []
    wrenches: list[Multivector] = []
    for i, joint in enumerate(joints):
        before, rate = (twists[joint.parent], rates[joint.parent]) if joint.parent >= 0 else (resting, against)
        carried, own = (~motors[i]).sandwich(before, TWIST), axes[i].scaled(qd[i])
        twists.append(carried + own)
        rate = (~motors[i]).sandwich(rate, TWIST) + axes[i].scaled(qdd[i]) + own.commutator(carried)
        rates.append(rate.project(TWIST))
        wrench = Multivector(WRENCH, [0] * 6)
        if joint.inertia is not None:
            wrench = momentum(joint.inertia, rates[i]) + momentum(joint.inertia, twists[i]).commutator(twists[i])
        if external is not None and (outside := external[i]) is not None:
            wrench = wrench - outside
        wrenches.append(wrench.project(WRENCH))
    tau: list[Scalar] = [0] * len(joints)
    for i in reversed(range(len(joints))):
        tau[i] = joints[i].armature * qdd[i] - axes[i].scalar_product(wrenches[i])
        if (parent := joints[i].parent) >= 0:
            wrenches[parent] = wrenches[parent] + motors[i].sandwich(wrenches[i], WRENCH)
    return tau
