"""Jacobians of exp and log of versors, in numpy: of their components, and left and right as twists (paper B, eqs. 33-34, 71-83).

Four matrices, all in canonical component order:

- exp_jacobian (..., versor, bivector): derivative of the components of V = exp(B) by those of B;
- log_jacobian (..., bivector, versor): derivative of the components of log V by those of V, in every direction, tangent to the group or
  not: that of the formula of exp_log.log, which for rotors and motors does not depend on the size of V. It equals paper B's on tangents
  (eqs. 75-83; 72-74 corrected). log_jacobian(exp(B)) exp_jacobian(B) = 1 for |w| < pi;
- right_jacobian (..., bivector, bivector): V(B + dB) = V(B) exp(J_r dB) to first order; J_r dB = -2 ~V dV is the body twist;
- left_jacobian (..., bivector, bivector): V(B + dB) = exp(J_l dB) V(B) to first order; J_l dB = -2 dV ~V is the world twist.

The first two carry derivatives through the formulas of exp_log (see jets). The last two are closed forms in which lengths never cancel:
in the split chart the components of the translation do not meet those of the rotation in J_r, whatever the translation.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from cga_runtime.coordinates import Array, dot, parts
from cga_runtime.exp_log import BIVECTORS, exp, log
from cga_runtime.jets import JETS, Jet, jacobian, variables
from cga_runtime.screw_functions import product, spiralling
from cga_runtime.smooth import NUMPY, Field, Scalar, cos_sinc, sinc_rest, sinhc, versinc

FULL = ("e12", "e13", "e23", "e0i", "e1i", "e2i", "e3i")
TO_VECTORS = np.zeros((7, 7))
"""Bivector of a similarity -> (w1, w2, w3, log d, v1, v2, v3); its own inverse is its transpose."""
for _row, (_column, _sign) in enumerate(((2, 1.0), (1, -1.0), (0, 1.0), (3, -1.0), (4, 1.0), (5, 1.0), (6, 1.0))):
    TO_VECTORS[_row, _column] = _sign


def exp_jacobian(group: str, bivector: Array, chart: str) -> Array:
    """d(components of exp B)/d(components of B), (..., versor, bivector)."""
    return _through(lambda b: exp(JETS, group, b, chart), bivector)


def log_jacobian(group: str, versor: Array, chart: str) -> Array:
    """d(components of log V)/d(components of V), (..., bivector, versor)."""
    return _through(lambda v: log(JETS, group, v, chart), versor)


def right_jacobian(group: str, bivector: Array, chart: str) -> Array:
    """J_r with V(B + dB) = V(B) exp(J_r dB), (..., bivector, bivector)."""
    if chart == "lie":
        return left_jacobian(group, -bivector, chart)
    w, s, _ = _vectors(group, bivector)
    turn = _about(w)
    return _within(group, turn[0], np.zeros_like(w), np.zeros_like(turn[0]), _transposed(turn[1]) * np.exp(-s)[..., None, None], True)


def left_jacobian(group: str, bivector: Array, chart: str) -> Array:
    """J_l with V(B + dB) = exp(J_l dB) V(B), (..., bivector, bivector)."""
    w, s, v = _vectors(group, bivector)
    turn = _about(w)[0]
    if chart == "split":
        return _within(group, turn, -v, _cross_matrix(v) @ turn, np.eye(3) + np.zeros_like(turn), False)
    along, by_scale, by_turn = _position(w, s, v)
    t = (along @ v[..., None])[..., 0]
    return _within(group, turn, by_scale - t, by_turn + _cross_matrix(t) @ turn, along, False)


def _through(function: Callable[[tuple[Jet, ...]], tuple[Scalar, ...]], at: Array) -> Array:
    given = variables(parts(at))
    return jacobian(function(given), given[0])


def _vectors(group: str, bivector: Array) -> tuple[Array, Array, Array]:
    """w, log d and v, zero where the group has none."""
    full = np.zeros((*bivector.shape[:-1], 7))
    full[..., [FULL.index(name) for name in BIVECTORS[group]]] = bivector
    ordered = full @ TO_VECTORS.T
    return ordered[..., :3], ordered[..., 3], ordered[..., 4:]


def _within(group: str, turn: Array, scale: Array, mixed: Array, velocity: Array, body: bool) -> Array:
    """The matrix with rows (turn, 0, 0), (0, 1, 0), (mixed, scale, velocity) over (w, log d, v), on the bivectors of the group."""
    whole = np.zeros((*turn.shape[:-2], 7, 7))
    whole[..., :3, :3] = _transposed(turn) if body else turn
    whole[..., 3, 3] = 1.0
    whole[..., 4:, :3], whole[..., 4:, 3], whole[..., 4:, 4:] = mixed, scale, velocity
    kept = [FULL.index(name) for name in BIVECTORS[group]]
    return np.asarray((TO_VECTORS.T @ whole @ TO_VECTORS)[..., kept, :][..., kept])


def _about(w: Array) -> tuple[Array, Array]:
    """Left Jacobian of the rotation vector, and the rotation matrix, (..., 3, 3)."""
    square, n = dot(w, w), _cross_matrix(w)
    cos, sinc = cos_sinc(NUMPY, square)
    bent, rest = versinc(NUMPY, square, cos, sinc), sinc_rest(NUMPY, square, sinc)
    return _polynomial((1.0, bent, rest), n), _polynomial((1.0, sinc, bent), n)


def _position(w: Array, s: Array, v: Array) -> tuple[Array, Array, Array]:
    """Position t = L v of the lie chart: L (..., 3, 3), dt/ds (..., 3), dt/dw (..., 3, 3)."""
    scale, square = variables([s, dot(w, w)])
    a, b, c = (value if isinstance(value, Jet) else 1.0 * scale for value in _mean_exponential(JETS, scale, square))
    n = _cross_matrix(w)
    turned = (n @ v[..., None])[..., 0]
    twice = (n @ turned[..., None])[..., 0]
    by_scale = a.slope[0][..., None] * v + b.slope[0][..., None] * turned + c.slope[0][..., None] * twice
    by_square = b.slope[1][..., None] * turned + c.slope[1][..., None] * twice
    by_turn = -b.value[..., None, None] * _cross_matrix(v) - c.value[..., None, None] * (_cross_matrix(turned) + n @ _cross_matrix(v))
    by_turn = by_turn + 2.0 * by_square[..., :, None] * w[..., None, :]
    return _polynomial((a.value, b.value, c.value), n), by_scale, by_turn


def _mean_exponential(f: Field, scale: Scalar, square: Scalar) -> tuple[Scalar, Scalar, Scalar]:
    """The mean of exp(u (s + N)) over u in [0, 1] as a function of s + N, see screw_functions; square is |w|^2."""
    half, quarter = 0.5 * scale, 0.25 * square
    cos, sinc = cos_sinc(f, quarter)
    growth = f.exp(half)
    halfway = (growth, 0.5 * sinc * growth, 0.25 * versinc(f, quarter, cos, sinc) * growth)  # exp((s + N) / 2)
    return product(halfway, spiralling(f, half, f.cosh(half), sinhc(f, half), quarter, cos, sinc)[:3], square)


def _polynomial(coefficients: tuple[float | Array, ...], n: Array) -> Array:
    """a + b N + c N^2, (..., 3, 3)."""
    a, b, c = (np.asarray(x)[..., None, None] for x in coefficients)
    return np.asarray(a * np.eye(3) + b * n + c * (n @ n))


def _cross_matrix(v: Array) -> Array:
    """N with N x = v cross x, (..., 3, 3)."""
    x, y, z = parts(v)
    zero = np.zeros_like(x)
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=-1).reshape(*v.shape, 3)


def _transposed(matrix: Array) -> Array:
    return np.swapaxes(matrix, -1, -2)
