"""Motors of a chain: the versor of the end frame and its analytic Jacobian, from half angles.

A motor is M = T(p) R with x' = M x ~M, stored as 1 e12 e13 e23 e1i e2i e3i e123i; joint j contributes exp(-q_j B_j / 2), B_j its unit
screw (paper B, eqs. 5-9; sign conventions of the null basis e0.ei = -1). Inputs are ch = cos(q/2) and sh = sin(q/2) (prismatic joints: 1
and half the displacement), so that the motor follows q smoothly over its double cover: M(q + 2 pi) = -M(q).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cga_codegen.algebra.blade_types import MOTOR, ROTOR, TRANSLATOR
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.vectors import Scalar, Vector, plus, times
from cga_codegen.kernels.walk import Configuration, outward
from cga_codegen.robots.model import Chain, Placement


def rotor_about(axis: Sequence[Scalar], cosine: Scalar, sine: Scalar) -> Multivector:
    """cos(a/2) - sin(a/2) biv(axis): the turn by a about the unit axis, right-hand rule."""
    x, y, z = (int(a) if a in (0.0, 1.0, -1.0) else a for a in axis)
    return Multivector(ROTOR, [cosine, -z * sine if z else 0, y * sine if y else 0, -x * sine if x else 0])


def translator(t: Sequence[Scalar]) -> Multivector:
    """1 - t ei / 2."""
    return Multivector(TRANSLATOR, [1, *(0 if isinstance(x, float | int) and x == 0 else -0.5 * x for x in t)])


def scaled_rotor(placement: Placement) -> tuple[Multivector, float]:
    """The rotor of a fixed rotation with its largest component made 1, and the factor that this left out.

    Quarter turns so become 1 - e12 times sqrt(1/2): the products cost nothing, and the factors of a chain are multiplied in once.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = placement.rotation
    # four equivalent quaternions (w, x, y, z) times 4 of one of their components; the one with the largest divisor is accurate
    candidates = (
        (1 + xx + yy + zz, zy - yz, xz - zx, yx - xy),
        (zy - yz, 1 + xx - yy - zz, xy + yx, xz + zx),
        (xz - zx, xy + yx, 1 - xx + yy - zz, yz + zy),
        (yx - xy, xz + zx, yz + zy, 1 - xx - yy + zz),
    )
    k = max(range(4), key=lambda i: candidates[i][i])
    w, x, y, z = (value / candidates[k][k] for value in candidates[k])
    if w < 0 or (w == 0 and max((x, y, z), key=abs) < 0):
        w, x, y, z = -w, -x, -y, -z
    left_out = 1.0 / math.sqrt(w * w + x * x + y * y + z * z)
    values = [int(v) if v in (0.0, 1.0, -1.0) else v for v in (w, -z, y, -x)]
    return Multivector(ROTOR, values), left_out


def _chain_motor(chain: Chain, ch: Vector, sh: Vector, base: Vector | None = None) -> Multivector:
    """Placement, joint, placement, joint ... tool, as sparse products; constant factors are multiplied into the first joint."""
    turns = [scaled_rotor(placement) for placement in (*(joint.placement for joint in chain.joints), chain.tool)]
    factor = math.prod(left_out for _, left_out in turns)
    motor = Multivector(ROTOR, [1, 0, 0, 0])
    number = iter(range(len(chain.joints)))
    for joint, (turn, _) in zip(chain.joints, turns[:-1], strict=True):
        motor = motor * translator(joint.placement.translation) * turn
        if joint.kind == "floating":
            assert base is not None, "the catalogue passes the base of a chain that has one"
            motor = (motor * Multivector(MOTOR, [base[k] for k in range(8)])).project(MOTOR)
            continue
        j = next(number)
        k, factor = (factor, 1.0) if factor != 1.0 else (1, 1.0)
        if joint.kind == "prismatic":
            motor = motor * Multivector(TRANSLATOR, [k, *(-a * sh[j] * k if a else 0 for a in joint.axis)])
        else:
            motor = motor * rotor_about(joint.axis, ch[j] * k, sh[j] * k)
    motor = motor * translator(chain.tool.translation) * turns[-1][0]
    return (motor.scaled(factor) if factor != 1.0 else motor).project(MOTOR)


def motor(chain: Chain, ch: Vector, sh: Vector, base: Vector | None = None) -> list[Scalar]:
    """Motor of the end frame in the root frame, components 1 e12 e13 e23 e1i e2i e3i e123i, unit norm."""
    return list(_chain_motor(chain, ch, sh, base).coefficients)


def full_angles(chain: Chain, ch: Vector, sh: Vector) -> tuple[list[Scalar], list[Scalar]]:
    """(c, s) from (ch, sh): the double-angle formulas (prismatic joints: 1 and the displacement)."""
    slides = [joint.kind == "prismatic" for joint in chain.joints if joint.kind != "floating"]
    c = [1 if slide else 1 - 2 * (y * y) for slide, y in zip(slides, sh, strict=True)]
    s = [2 * y if slide else 2 * (x * y) for slide, x, y in zip(slides, ch, sh, strict=True)]
    return c, s


def motor_jacobian(chain: Chain, ch: Vector, sh: Vector, base: Vector | None = None) -> list[Scalar]:
    """Analytic Jacobian of the motor: column j is -1/2 S_j M with the world screw S_j, rows as the motor's.

    (Paper A, eqs. 7-8; the derivative of exp(-q_j B_j/2) inside the product.) The column of a coordinate that several joints follow is the
    sum of theirs; the six of a floating base belong to its twist.
    """
    m = _chain_motor(chain, ch, sh, base)
    configuration: Configuration = outward(chain, *full_angles(chain, ch, sh), base)
    half = m.scaled(-0.5)
    columns: list[list[Scalar]] = [[] for _ in range(chain.coordinates.nv)]
    for (k, ratio), screw in zip(chain.coordinates.columns, configuration.screws(), strict=True):
        part = list((screw.multivector() * half).project(MOTOR).coefficients)
        part = part if ratio == 1.0 else times(ratio, part)
        columns[k] = plus(columns[k], part) if columns[k] else part
    return [column[i] for i in range(8) for column in columns]
