"""Exponential and logarithm of rotors, translators, dilators, motors and similarities, written once over any scalar.

exp(B) is the standard exponential of -B/2 (paper A, eqs. 62-77; paper B, eqs. 61-70; corrected as below). Two charts for motors and
similarities:

- "split": V = exp(B_T) exp(B_R) exp(B_D), B = B_T + B_R + B_D, the papers' group exp and log (paper A, eqs. 72-77);
- "lie": V is the exponential of the whole -B/2, the screw motion; V(B) V(B) = V(2 B) and ~V(B) = V(-B).

With the rotation vector w (rad), the translation v (m) and the scale d, B_R = w1 e23 - w2 e13 + w3 e12, B_T = v ^ ei, and
B_D = -log(d) e0i (paper A, eq. 69 has the other sign and would scale by 1/d). log takes the shortest rotation, |w| <= pi, the same
for V and -V. Where the scalar part is exactly zero (angle pi, both ways equally long) the first of w1, w2, w3 that is not zero is
positive. log of rotors and motors does not depend on their size: log(M (s + p e123i)) = log(M) for s other than 0, near the group too.
log of dilators and similarities reads the scale off sinh and so takes V ~V = 1 for granted: e^h and e^-h cannot be told apart
otherwise without loss for large scales.

Where the papers are left: acos of the scalar part (A 63, B 65-67) loses half of the digits near the identity and all at it, it is
replaced by atan2; 2 acosh (A 68) loses the sign for d < 1 and half of the digits near 1, it is replaced by 2 asinh.

Components, first axis: canonical order, see BLADES and BIVECTORS.
"""

from __future__ import annotations

from collections.abc import Sequence

from cga_runtime.pairs import paired, rounded
from cga_runtime.screw_functions import ScrewFunction, axial, inverse, spiralling
from cga_runtime.smooth import SINHC, Field, Scalar, cos_sinc, cosh_sinh, polynomial, sinc_slope, sinhc, turn

BLADES: dict[str, tuple[str, ...]] = {
    "rotor": ("1", "e12", "e13", "e23"),
    "translator": ("1", "e1i", "e2i", "e3i"),
    "dilator": ("1", "e0i"),
    "motor": ("1", "e12", "e13", "e23", "e1i", "e2i", "e3i", "e123i"),
    "similarity": ("1", "e12", "e13", "e23", "e0i", "e1i", "e2i", "e012i", "e3i", "e013i", "e023i", "e123i"),
}
"""Components of the versors of each group."""
BIVECTORS: dict[str, tuple[str, ...]] = {
    "rotor": ("e12", "e13", "e23"),
    "translator": ("e1i", "e2i", "e3i"),
    "dilator": ("e0i",),
    "motor": ("e12", "e13", "e23", "e1i", "e2i", "e3i"),
    "similarity": ("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i"),
}
"""Components of their logarithms."""
CHARTS = ("split", "lie")
"""Names of the charts."""
SIMILARITY_BLOCKS = ((0, 1, 2, 3), (4, 7, 9, 10), (5, 6, 8, 11))
"""Where cosh(h) R, sinh(h) R and the components e1i e2i e3i e123i of a similarity stand."""


def exp(f: Field, group: str, bivector: Sequence[Scalar], chart: str = "split") -> tuple[Scalar, ...]:
    """Components of the versor exp(-B/2), or of the split product, from the components of B: every B has one."""
    match group:
        case "rotor":
            return _rotor(f, bivector)[0]
        case "translator":
            return (1.0 + 0.0 * bivector[0], *(-0.5 * b for b in bivector))
        case "dilator":
            return cosh_sinh(f, -0.5 * bivector[0])
        case "motor":
            plane, v = bivector[:3], bivector[3:]
            rotor, square, sinc = _rotor(f, plane)
            if chart == "split":
                return (*rotor, *translated(v, rotor))
            w, along = vector(plane), _dot(vector(plane), v)
            slope = along * sinc_slope(f, square, rotor[0], sinc)
            return (*rotor, *(-0.5 * sinc * v[k] - 0.125 * slope * w[k] for k in range(3)), 0.25 * sinc * along)
        case _:
            wide, lift = paired(f)
            half = -0.5 * bivector[3]
            plane, v = tuple(lift(b) for b in bivector[:3]), tuple(lift(b) for b in bivector[4:])
            rotor, square, sinc = _rotor(wide, plane)
            cosh, sinh = (lift(x) for x in cosh_sinh(f, half))
            if chart == "split":
                shrunk = lift(f.exp(-half))
                moved = tuple(shrunk * m for m in translated(v, rotor))
            else:
                g = spiralling(wide, lift(half), cosh, lift(sinhc(f, half)), square, rotor[0], sinc)
                moved = _spiralled(wide, vector(plane), g, v, square, rotor[0], sinc)
            return tuple(rounded(f, x) for x in similar(cosh, sinh, rotor, moved))


def log(f: Field, group: str, versor: Sequence[Scalar], chart: str = "split") -> tuple[Scalar, ...]:
    """Components of the logarithm of a versor of the group: exp(log V) is V or -V, the same motion."""
    match group:
        case "rotor":
            rotor = _shortest(f, versor[:4], versor)
            factor = turn(f, rotor[0], _dot(rotor[1:], rotor[1:]))[0]
            return tuple(-factor * b for b in rotor[1:])
        case "translator":
            return tuple(-2.0 * m / versor[0] for m in versor[1:])
        case "dilator":
            return (-2.0 * f.asinh(f.where(versor[0] < 0.0, -versor[1], versor[1])),)
        case "motor":
            versor = _shortest(f, versor[:4], versor)
            rotor, moved = versor[:4], versor[4:]
            bending = _dot(rotor[1:], rotor[1:])
            square = rotor[0] * rotor[0] + bending
            factor, slope = turn(f, rotor[0], bending)
            plane = tuple(-factor * b for b in rotor[1:])
            if chart == "split":
                return (*plane, *(-2.0 * t / square for t in position(rotor, moved)))
            # M = C - S B over the numbers x + y e123i: the same function of them as for a rotor, to first order in y
            axis = vector(rotor[1:])
            onto = 2.0 * moved[3] / square + slope * _dot(axis, moved[:3])
            return (*plane, *(-factor * moved[k] - onto * axis[k] for k in range(3)))
        case _:
            wide, lift = paired(f)
            versor = _shortest(f, versor[:4], versor)
            rotor, even, moved = (tuple(lift(versor[k]) for k in block) for block in SIMILARITY_BLOCKS)
            bending = _dot(rotor[1:], rotor[1:])
            cosh = wide.sqrt(rotor[0] * rotor[0] + bending)
            sinh = _dot(rotor, even) / cosh
            half = wide.asinh(sinh)
            factor = turn(wide, rotor[0], bending)[0]
            plane = tuple(-factor * b for b in rotor[1:])
            if chart == "split":
                shrinks = sinh < 0.0
                grown = wide.where(shrinks, -sinh, sinh)
                grown = grown + wide.sqrt(1.0 + grown * grown)
                growth = wide.where(shrinks, 1.0 / grown, grown)  # e^half, more accurate than exp of it
                v = tuple(-2.0 * growth / cosh * t for t in position(rotor, moved))
            else:
                grown = wide.sqrt(1.0 + sinh * sinh)
                v = _velocity(wide, tuple(r / cosh for r in rotor), factor * cosh, half, sinh, grown, moved)
            return tuple(rounded(f, x) for x in (*plane, -2.0 * half, *v))


def translated(t: Sequence[Scalar], rotor: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """Components e1i e2i e3i e123i of T(t) R."""
    a, b12, b13, b23 = (-0.5 * r for r in rotor)
    x, y, z = t
    return a * x - b12 * y - b13 * z, a * y + b12 * x - b23 * z, a * z + b13 * x + b23 * y, b12 * z - b13 * y + b23 * x


def position(rotor: Sequence[Scalar], moved: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """Components e1i e2i e3i of M ~R from components 1 e12 e13 e23 and e1i e2i e3i e123i: -|R|^2 / 2 times the translation."""
    a, b12, b13, b23 = rotor
    x, y, z, w = moved
    return a * x + b12 * y + b13 * z + b23 * w, a * y - b12 * x + b23 * z - b13 * w, a * z - b13 * x - b23 * y + b12 * w


def similar(cosh: Scalar, sinh: Scalar, rotor: Sequence[Scalar], moved: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """The components of a similarity in canonical order from cosh h, sinh h, R, and e1i e2i e3i e123i."""
    a, b12, b13, b23 = (cosh * r for r in rotor)
    e0i, e012i, e013i, e023i = (sinh * r for r in rotor)
    e1i, e2i, e3i, e123i = moved
    return a, b12, b13, b23, e0i, e1i, e2i, e012i, e3i, e013i, e023i, e123i


def vector(plane: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """(w1, w2, w3) of w1 e23 - w2 e13 + w3 e12, given in canonical order."""
    return plane[2], -plane[1], plane[0]


def _rotor(f: Field, plane: Sequence[Scalar]) -> tuple[tuple[Scalar, ...], Scalar, Scalar]:
    """The rotor exp(-B_R/2), and |w|^2/4 and sin(|w|/2) / (|w|/2)."""
    square = 0.25 * _dot(plane, plane)
    cos, sinc = cos_sinc(f, square)
    return (cos, *(-0.5 * sinc * b for b in plane)), square, sinc


def _spiralled(
    f: Field, w: Sequence[Scalar], g: ScrewFunction, v: Sequence[Scalar], square: Scalar, cos: Scalar, sinc: Scalar
) -> tuple[Scalar, ...]:
    """Components e1i e2i e3i e123i of the exponential of -(B_R + B_D + v ^ ei)/2, which is linear in v.

    Along w it is -1/2 f(s) R v; across w, where R and v do not commute, -1/2 f(s + N) v (f: see screw_functions).
    """
    along, turned = _dot(v, w), _cross(v, w)
    onto = along * axial(f, g, square, cos, sinc)
    return (*(-0.5 * (g.across * v[k] + onto * w[k] - g.odd * turned[k]) for k in range(3)), 0.25 * g.along * sinc * along)


def _velocity(
    f: Field, rotor: Sequence[Scalar], factor: Scalar, half: Scalar, sinh: Scalar, cosh: Scalar, moved: Sequence[Scalar]
) -> tuple[Scalar, ...]:
    """v from what _spiralled makes of it, and from the unit rotor and its logarithm over its bivector part."""
    axis = vector(rotor[1:])
    w = tuple(-factor * x for x in axis)
    square, along, turned = 0.25 * _dot(w, w), _dot(w, moved[:3]), _cross(w, moved[:3])
    cos, sinc = rotor[0], 2.0 / factor
    near = half * half < 1.0
    small = f.where(near, half, 0.0)
    hyper = f.where(near, polynomial(SINHC, small * small), sinh / f.where(near, 1.0, half))
    g = inverse(spiralling(f, half, cosh, hyper, square, cos, sinc), 4.0 * square)
    onto = along * axial(f, g, square, cos, sinc)
    ahead = g.along * moved[3]
    return tuple(-2.0 * (g.across * moved[k] + onto * w[k] + g.odd * turned[k] + ahead * axis[k]) for k in range(3))


def _shortest(f: Field, rotor: Sequence[Scalar], versor: Sequence[Scalar]) -> tuple[Scalar, ...]:
    """V or -V, whichever turns by at most pi; at pi the one whose first of w1, w2, w3 that is not zero is positive."""
    sign: Scalar = 1.0
    for component in (-rotor[1], rotor[2], -rotor[3]):  # w3, w2, w1, but for a positive factor
        sign = f.where(component > 0.0, 1.0, f.where(component < 0.0, -1.0, sign))
    sign = f.where(rotor[0] > 0.0, 1.0, f.where(rotor[0] < 0.0, -1.0, sign))
    return tuple(sign * v for v in versor)


def _dot(a: Sequence[Scalar], b: Sequence[Scalar]) -> Scalar:
    return sum(x * y for x, y in zip(a[1:], b[1:], strict=True)) + a[0] * b[0]


def _cross(a: Sequence[Scalar], b: Sequence[Scalar]) -> tuple[Scalar, ...]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
