"""From twists of a similarity to rates of its logarithm, and errors between similarities, over any scalar (paper A, eqs. 30, 31, 44-47).

A similarity V = T(t) R D(d) is handled by its parts: rotor R (1 e12 e13 e23), t (m) and d. Twists are rows e12 e13 e23 e0i e1i e2i e3i:
the body's, V' = -1/2 V B, or that of space, V' = -1/2 B V. With the rotation vector w of R, in the split chart (similarity.md, section 6):

    body:   w' = Jr^-1(w) om,  e0i' = e0i,  t' = d R v
    space:  w' = Jl^-1(w) om,  e0i' = e0i,  t' = v + om x t - e0i t
    Jl^-1(w) = 1 - [w]/2 + k [w]^2,  Jr^-1(w) = 1 + [w]/2 + k [w]^2,  k = (1 - (a/2) cot(a/2))/a^2, a = |w|

Scalars are numpy arrays (...), those of twists with one more axis for their columns, or casadi symbols.
"""

from __future__ import annotations

from collections.abc import Sequence

from cga_runtime.exp_log import log, position
from cga_runtime.smooth import Field, Scalar, polynomial

Vector = Sequence[Scalar]
Parts = tuple[Vector, Vector, Scalar]
"""Rotor, translation, scale."""

NEAR = 0.1
"""Squared angle below which k is taken from its series: where the closed form has lost a digit."""
_SERIES = (1 / 12, 1 / 720, 1 / 30240, 1 / 1209600, 1 / 47900160, 691 / 1307674368000)


def turned(rotor: Vector, v: Vector) -> tuple[Scalar, ...]:
    """R v ~R of a vector."""
    a, x, y, z = rotor[0], -rotor[3], rotor[2], -rotor[1]
    twice = [2.0 * c for c in cross((x, y, z), v)]
    further = cross((x, y, z), twice)
    return tuple(v[k] + a * twice[k] + further[k] for k in range(3))


def turned_back(rotor: Vector, v: Vector) -> tuple[Scalar, ...]:
    """~R v R of a vector."""
    return turned((rotor[0], -rotor[1], -rotor[2], -rotor[3]), v)


def cross(a: Vector, b: Vector) -> tuple[Scalar, ...]:
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _dot(a: Vector, b: Vector) -> Scalar:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _product(a: Vector, b: Vector) -> tuple[Scalar, ...]:
    """Of two rotors, components 1 e12 e13 e23."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] - a[2] * b[3] + a[3] * b[2],
        a[0] * b[2] + a[2] * b[0] + a[1] * b[3] - a[3] * b[1],
        a[0] * b[3] + a[3] * b[0] - a[1] * b[2] + a[2] * b[1],
    )


def parts_of(f: Field, versor: Vector) -> Parts:
    """The parts of a unit similarity, components 1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i (similarity.md, section 4)."""
    even, odd = [versor[k] for k in (0, 1, 2, 3)], [versor[k] for k in (4, 7, 9, 10)]
    grown, shrunk = [x + y for x, y in zip(even, odd, strict=True)], [x - y for x, y in zip(even, odd, strict=True)]  # s R, R / s
    up, down = (f.sqrt(_dot(p[1:], p[1:]) + p[0] * p[0]) for p in (grown, shrunk))
    rotor = [(p / up + m / down) / 2.0 for p, m in zip(grown, shrunk, strict=True)]
    along = position(rotor, [versor[k] for k in (5, 6, 8, 11)])
    return rotor, tuple(-2.0 * f.sqrt(up / down) * x for x in along), up / down


def relative(f: Field, one: Parts, other: Parts) -> Parts:
    """The parts of ~V1 V2: where V2 stands, seen from V1, in units of its scale (paper A, eqs. 41-42)."""
    (rotor, t, d), (rotor2, t2, d2) = one, other
    back = (rotor[0], -rotor[1], -rotor[2], -rotor[3])
    step = turned_back(rotor, tuple(y - x for x, y in zip(t, t2, strict=True)))
    return _product(back, rotor2), tuple(x / d for x in step), d2 / d


def logarithm(f: Field, parts: Parts) -> tuple[Scalar, ...]:
    """The split logarithm, e12 e13 e23 e0i e1i e2i e3i, of the shortest rotation (paper A, eq. 77)."""
    rotor, t, d = parts
    half = f.asinh(0.5 * (d - 1.0) / f.sqrt(d))  # log(d)/2, without loss near d = 1
    return (*log(f, "rotor", rotor), -2.0 * half, *t)


def _rotation_vector(f: Field, rotor: Vector) -> tuple[Scalar, ...]:
    e12, e13, e23 = log(f, "rotor", rotor)
    return e23, -e13, e12


def _bending(f: Field, square: Scalar) -> Scalar:
    """k = (1 - (a/2) cot(a/2))/a^2 of a^2, for a < 2 pi."""
    near = square < NEAR
    small, far = f.where(near, square, 0.0), f.where(near, 1.0, square)
    half = 0.5 * f.sqrt(far)
    return f.where(near, polynomial(_SERIES, small), (1.0 - half * f.cos(half) / f.sin(half)) / far)


def _inverse(f: Field, w: Vector, om: Vector, sign: float) -> tuple[Scalar, ...]:
    """Jl^-1(w) om (sign -1) or Jr^-1(w) om (sign +1)."""
    k = _bending(f, _dot(w, w))
    once = cross(w, om)
    twice = cross(w, once)
    return tuple(om[i] + 0.5 * sign * once[i] + k * twice[i] for i in range(3))


def _split(rows: Vector) -> tuple[Vector, Scalar, Vector]:
    """om, e0i and v of a twist."""
    return (rows[2], -rows[1], rows[0]), rows[3], rows[4:7]


def _joined(w: Vector, e0i: Scalar, v: Vector) -> tuple[Scalar, ...]:
    return w[2], -w[1], w[0], e0i, *v


def log_rate_of_body(f: Field, parts: Parts, rows: Vector) -> tuple[Scalar, ...]:
    """Rate of the split logarithm from the body's twist: its rows are the bivector Jacobian (paper A, eq. 31)."""
    rotor, _, d = parts
    om, e0i, v = _split(rows)
    return _joined(_inverse(f, _rotation_vector(f, rotor), om, 1.0), e0i, tuple(d * x for x in turned(rotor, v)))


def log_rate_of_space(f: Field, parts: Parts, rows: Vector) -> tuple[Scalar, ...]:
    """Rate of the split logarithm from the twist of space."""
    rotor, t, _ = parts
    om, e0i, v = _split(rows)
    carried = cross(om, t)
    moved = tuple(v[i] + carried[i] - e0i * t[i] for i in range(3))
    return _joined(_inverse(f, _rotation_vector(f, rotor), om, -1.0), e0i, moved)


def space_twist(parts: Parts, rows: Vector) -> tuple[Scalar, ...]:
    """The twist of space, about the origin, of a twist of the body: -2 V' ~V from -2 ~V V'."""
    rotor, t, d = parts
    om, e0i, v = _split(rows)
    om = turned(rotor, om)
    carried, moved = cross(om, t), turned(rotor, v)
    return _joined(om, e0i, tuple(d * moved[i] - carried[i] + e0i * t[i] for i in range(3)))
