"""Paper A for its tests: the oracle file, and similarity.md, sections 2 to 5, with typed multivectors over real or complex arrays.

An independent path beside the kernels: elements are products of the algebra, derivatives are taken by complex step, and the logarithm reads
what a versor does to the origin. Coefficients of a multivector are arrays (...); vectors are arrays (..., 3). Lengths in m, angles in rad.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np

from cga_codegen.algebra.blade_types import (
    CIRCLE,
    DILATOR,
    FULL,
    LINE,
    MOTOR,
    ORIGIN,
    PLANE,
    POINT,
    POINT_PAIR,
    ROTOR,
    SCALAR,
    SIMILARITY,
    SIMILARITY_BIVECTOR,
    SPHERE,
    TRANSLATOR,
    BladeType,
)
from cga_codegen.algebra.multivector import Multivector

DATA = json.loads((Path(__file__).parents[2] / "data" / "similarity.json").read_text())

KINDS = {
    "point": (1, POINT),
    "pointpair": (2, POINT_PAIR),
    "line": (2, LINE),
    "circle": (3, CIRCLE),
    "plane": (3, PLANE),
    "sphere": (4, SPHERE),
}
FLAT = ("line", "plane")
DIRECTION = {"pointpair": "e01 e02 e03", "line": "e01i e02i e03i", "circle": "e023 e013 e012", "plane": "e023i e013i e012i"}
SIGNS = {"circle": (1, -1, 1), "plane": (1, -1, 1)}
E0, INFINITY, ONE = Multivector(ORIGIN, [1]), Multivector.from_blades(POINT, ei=1), Multivector(SCALAR, [1])
H = 1e-30  # complex step


def of(type: BladeType, values: Any) -> Multivector:
    """Components (..., k) as a multivector with arrays (...) for coefficients."""
    return Multivector(type, np.moveaxis(np.asarray(values), -1, 0))


def numbers(x: Multivector, type: BladeType | None = None) -> np.ndarray:
    """The components (..., k) of a multivector, of another type if one is given."""
    return np.stack(np.broadcast_arrays(*x.project(type or x.type).coefficients), -1)


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.sum(a * b, axis=-1, keepdims=True)


def norm(a: np.ndarray) -> np.ndarray:
    return np.sqrt(dot(a, a))  # not numpy's, which takes the complex modulus


def rotor(w: np.ndarray) -> Multivector:
    """cos(a/2) - sin(a/2)/a biv(w), a = |w|: the turn by the rotation vector w (..., 3)."""
    a = norm(w)[..., 0]
    x, y, z = np.moveaxis(w * (np.sinc(a / (2 * np.pi)) / 2)[..., None], -1, 0)
    return Multivector(ROTOR, [np.cos(a / 2), -z, y, -x])


def translator(t: np.ndarray) -> Multivector:
    return Multivector(TRANSLATOR, [1, *np.moveaxis(-t / 2, -1, 0)])


def dilator(d: np.ndarray) -> Multivector:
    return Multivector(DILATOR, [np.cosh(np.log(d) / 2), np.sinh(np.log(d) / 2)])


def rotation_vector(b7: np.ndarray) -> np.ndarray:
    """w (..., 3) of the bivector w1 e23 - w2 e13 + w3 e12, the first components of b7."""
    return np.stack([b7[..., 2], -b7[..., 1], b7[..., 0]], -1)


def exp(b7: np.ndarray) -> Multivector:
    """exp_s of (76), every factor Exp(-B/2), with B_D = -log(d) e0i."""
    return (translator(b7[..., 4:]) * rotor(rotation_vector(b7)) * dilator(np.exp(-b7[..., 3]))).project(SIMILARITY)


def series(b7: np.ndarray) -> Multivector:
    """Exp(-B/2), the Lie exponential, by its power series, with B halved six times and the result squared six times."""
    exponent = of(SIMILARITY_BIVECTOR, -b7 / 128)
    power = total = ONE
    for k in range(1, 20):
        power = (power * exponent).scaled(1 / k).project(SIMILARITY)
        total = total + power
    for _ in range(6):
        total = (total * total).project(SIMILARITY)
    return total


def rotor_log(r: np.ndarray) -> np.ndarray:
    """B_R (..., 3) as e12 e13 e23 of a unit rotor (..., 4), the short way."""
    r = np.where(r[..., :1].real < 0, -r, r)
    a, n2 = r[..., :1], dot(r[..., 1:], r[..., 1:])
    tiny = np.abs(n2) < 1e-8
    n, q = np.sqrt(np.where(tiny, 1, n2)), n2 / np.where(tiny, a * a, 1)
    return -np.where(tiny, 2 / a * (1 - q / 3 + q * q / 5), 4 * np.arctan(n / (1 + a)) / n) * r[..., 1:]


def log(v: Multivector) -> np.ndarray:
    """log_s (..., 7) of (77) by what a versor of any size does to e0: V e0 ~V = |V|^2/d P(t); the rest is the rotor."""
    moved = numbers(v.sandwich(E0, POINT))
    size = np.sqrt(v.scalar_product(~v))[..., None]
    t, d = moved[..., 1:4] / moved[..., :1], size**2 / moved[..., :1]
    r = numbers(~translator(t) * v * ~dilator(d[..., 0]), ROTOR) / size
    return np.concatenate([rotor_log(r), -np.log(d), t], -1)


def log_of_components(v: Multivector) -> np.ndarray:
    """log_s (..., 7) by components (similarity.md, section 4): p = A + K = s R and m = A - K = R / s with s^2 = d, of any size and sign."""
    a, k, w = at(v, "1 e12 e13 e23"), at(v, "e0i e012i e013i e023i"), at(v, "e1i e2i e3i e123i")
    p, m = norm(a + k), norm(a - k)
    s, size = np.sqrt(p / m), np.sqrt(p * m)
    r = ((a + k) / s + (a - k) * s) / (2 * size)
    (a0, b12, b13, b23), (w1, w2, w3, w4) = np.moveaxis(r, -1, 0), np.moveaxis(w, -1, 0)
    rows = (a0 * w1 + b12 * w2 + b13 * w3 + b23 * w4, a0 * w2 - b12 * w1 + b23 * w3 - b13 * w4, a0 * w3 - b13 * w1 - b23 * w2 + b12 * w4)
    return np.concatenate([rotor_log(r), -np.log(p / m), -2 * s / size * np.stack(rows, -1)], -1)


def turn(a: np.ndarray, n: np.ndarray) -> Multivector:
    """The shortest turn of a unit vector to another, (1 + n a) / sqrt(2 (1 + a.n))."""
    x, y, z = np.moveaxis(np.cross(a, n), -1, 0)
    whole = Multivector(ROTOR, [1 + dot(a, n)[..., 0], -z, y, -x])
    return whole.scaled(1 / np.sqrt(2 * (1 + dot(a, n)[..., 0])))


def span(kind: str, points: np.ndarray) -> Multivector:
    """(2), (14): the outer product of points (..., k, 3), of flats with ei too."""
    total = ONE
    for x in np.moveaxis(points, -2, 0):
        total = total ^ Multivector(POINT, [1, *np.moveaxis(x, -1, 0), dot(x, x)[..., 0] / 2])
    return (total ^ INFINITY if kind in FLAT else total).project(KINDS[kind][1])


def parameters(kind: str, points: np.ndarray) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Centre or foot c, direction n, radius r (..., 1) from points (..., k, 3) (similarity.md, section 3); None where there is none."""
    x = points[..., 0, :]
    edges = points[..., 1:, :] - points[..., :1, :]
    if kind == "point":
        return x, None, None
    if kind == "sphere":
        y = np.linalg.solve(edges, dot(edges, edges) / 2)[..., 0]
        return x + y, None, norm(y)
    a, b = edges[..., 0, :], edges[..., -1, :]
    across = a if kind in ("pointpair", "line") else np.cross(a, b)
    n = across / norm(across)
    match kind:
        case "pointpair":
            return x + a / 2, n, norm(a) / 2
        case "line":
            return x - n * dot(n, x), n, None
        case "plane":
            return n * dot(n, x), n, None
    y = np.cross(dot(a, a) * b - dot(b, b) * a, across) / (2 * dot(across, across))
    return x + y, n, norm(y)


def at(x: Multivector, names: str) -> np.ndarray:
    """Named components (..., k)."""
    return np.stack(np.broadcast_arrays(*x.at(names)), -1)


def weight(kind: str, x: Multivector) -> np.ndarray:
    """w of similarity.md, section 2, (..., 1): signed for spheres."""
    if kind in ("point", "sphere"):
        return at(x, "e0" if kind == "point" else "e0123")
    return norm(at(x, DIRECTION[kind]))


def read_off(kind: str, points: np.ndarray) -> tuple[np.ndarray, np.ndarray | None, np.ndarray | None]:
    """Centre or foot, direction and radius from X itself (similarity.md, section 3), with the centre as X ei X (27)."""
    x = span(kind, points)
    w = weight(kind, x)
    n = at(x, DIRECTION[kind]) * SIGNS.get(kind, 1) / w if kind in DIRECTION else None
    if kind == "point":
        return at(x, "e1 e2 e3") / w, None, None
    if kind == "line":
        return np.cross(n, at(x, "e23i e13i e12i") * (1, -1, 1)) / w, n, None
    if kind == "plane":
        return at(x, "e123i") / w * n, n, None
    middle = numbers((x * INFINITY * x).project(POINT))
    return middle[..., 1:4] / middle[..., :1], n, np.sqrt(-x.scalar_product(~x))[..., None] / np.sqrt(w * w)


def normalised(kind: str, x: Multivector) -> Multivector:
    """X / (w r), for flats and points X / w: what V X_u ~V is (20), (28)."""
    if kind == "point":
        return x.scaled(1 / weight(kind, x)[..., 0])
    return x.scaled(np.sign(weight(kind, x)[..., 0].real) / np.sqrt(-x.scalar_product(~x)))


UNITS = {kind: of(FULL, DATA["units"][kind]).project(type) for kind, (_, type) in KINDS.items()}


def cases(kind: str, key: str) -> np.ndarray:
    """One entry of all cases of a primitive, stacked: (cases, ...)."""
    return np.array([case[key] for case in DATA["primitives"][kind]])


def motors(q: np.ndarray) -> list[Multivector]:
    """V(q) = base * prod fixed_j exp(-q_j B_j / 2) * tool of the first chains, three coordinates of q (..., 3 k) each (7)."""
    found = []
    for chain, angles in zip(DATA["chains"], np.split(q, q.shape[-1] // 3, axis=-1), strict=False):
        v = Multivector(MOTOR, chain["base"])
        for fixed, axis, kind, angle in zip(chain["fixed"], chain["axis"], chain["kind"], np.moveaxis(angles, -1, 0), strict=True):
            step = angle[..., None] * np.array(axis)
            v = (v * Multivector(MOTOR, fixed) * (translator(step) if kind == "prismatic" else rotor(step))).project(MOTOR)
        found.append((v * Multivector(MOTOR, chain["tool"])).project(MOTOR))
    return found


def end_points(q: np.ndarray) -> np.ndarray:
    """Where the chains end, (..., k, 3)."""
    return np.stack([numbers(v.sandwich(E0, POINT))[..., 1:4] for v in motors(q)], -2)


def similarity(kind: str, c: np.ndarray, n: np.ndarray | None, r: np.ndarray | None) -> Multivector:
    """V_S(X_u, X) = T(c) R(a -> n) D(r) (28; similarity.md, section 5)."""
    turned = ONE if n is None else turn(np.array(DATA["refdir"][kind]), n)
    return (translator(c) * turned * (ONE if r is None else dilator(r[..., 0]))).project(SIMILARITY)


def stepped(q: np.ndarray) -> np.ndarray:
    """q (..., m) with a complex step along each coordinate: (..., m, m), the coordinates last."""
    return q[..., None, :] + 1j * H * np.eye(q.shape[-1])


def columns(x: np.ndarray) -> np.ndarray:
    """The derivative (..., k, m) in what was computed from `stepped`, (..., m, k)."""
    return np.swapaxes(x.imag / H, -1, -2)
