"""Determinants of actuation schemes of two universal-spherical arms as products of geometric factors (paper C 5.2.2, completed).

Each factor that can vanish names a family of actuation singularities: these say why a scheme is singular where the 6x6 determinant only
says that it is. Signs included: the product of the factors equals `ClosedChain.determinant`, for arms like the NAO's (first axes
collinear; axis 1 perpendicular to 2, 3 to 4, 4 to 5).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.analysis.singularities import require_wrist_centres
from cga_runtime.errors import DegenerateError, SchemeError
from cga_runtime.spaces.closed_chain import LENGTH, ClosedLoop

Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Arms:
    """What the factors are made of, for two arms of five joints: screws (w, v), wrist centres A and B, limb factors."""

    w: Array  # (..., 10, 3)
    v: Array
    a: Array
    b: Array
    f_right: Array
    f_left: Array
    sin_q9: Array
    centre_left: Array


def determinant_factors(loop: ClosedLoop, q: ArrayLike, actuated: Sequence[int]) -> dict[str, Array]:
    """Named factors, each (...), whose product is `loop.determinant(q, actuated)`.

    Known for {1,2,3,7} (five factors), for schemes of four right joints (two screws' reciprocal product and two limb factors), and for
    {1,3,7,8} (one bracket of two planar pencils). Raises SchemeError for others, DegenerateError for arms without
    wrist centres or a common first axis.
    """
    require_wrist_centres(loop)
    _require_common_axis(loop)
    chosen = tuple(j + 1 for j in loop.scheme(actuated)[0])
    rule = _RULES.get(chosen)
    if rule is None:
        known = ", ".join("".join(str(j) for j in scheme) for scheme in _RULES)
        raise SchemeError(f"scheme {chosen}: no closed form is known; known: {known}")
    factors = rule(_arms(loop, q))
    return {"1 / LENGTH^3": np.asarray(LENGTH**-3.0), **factors}


def _require_common_axis(loop: ClosedLoop) -> None:
    """DegenerateError unless the two first axes, which no joint moves, are one line."""
    screws = loop.twists(np.zeros(loop.n))
    first, second = screws[:, 0], screws[:, loop.right.n]
    if min(np.abs(first - second).max(), np.abs(first + second).max()) > 1e-12:
        raise DegenerateError(f"{loop!r}: the closed forms need first axes that are one line")


def _arms(loop: ClosedLoop, q: ArrayLike) -> _Arms:
    twists = np.swapaxes(loop.twists(q), -1, -2)
    centres, limb = loop.kernel("wrist_centres")(q), loop.kernel("limb_factors")(q)
    w, v = twists[..., :3], twists[..., 3:]
    # U of the left arm: where axes 6 and 7 meet, c6 + t w6 with c = w x v the foot of a line
    foot, other = np.cross(w[..., 5, :], v[..., 5, :]), np.cross(w[..., 6, :], v[..., 6, :])
    t = _dot(other - foot, w[..., 5, :])
    centre_left = foot + t[..., None] * w[..., 5, :]
    return _Arms(w, v, centres[..., 0, :], centres[..., 1, :], limb[..., 0, 0], limb[..., 1, 0], limb[..., 1, 1], centre_left)


def _example_2(at: _Arms) -> dict[str, Array]:
    """det[s4, s5, s6, s8, s9, s10] = -sin q9 (n45 . (B - A)) f_R f_L sin(q1 - q6), n45 = s4 x s5."""
    normal = np.cross(at.w[..., 3, :], at.w[..., 4, :])
    # axes 2 and 7 are carried by q1 and q6 about the common shoulder axis: the signed angle between them is q6 - q1
    turn = _dot(np.cross(at.w[..., 6, :], at.w[..., 1, :]), at.w[..., 0, :])
    return {
        "-sin q9": -at.sin_q9,
        "n45 . (B - A)": _dot(normal, at.b - at.a),
        "f right": at.f_right,
        "f left": at.f_left,
        "sin(q1 - q6)": turn,
    }


def _right_but(j: int) -> Callable[[_Arms], dict[str, Array]]:
    def rule(at: _Arms) -> dict[str, Array]:
        """det[s_j, s6 .. s10] = sin q9 f_L (zeta_L o s_j), zeta_L the force (B - U_L) through the left arm's centres."""
        force = at.b - at.centre_left
        moment = np.cross(at.centre_left, force)
        power = _dot(force, at.v[..., j, :]) + _dot(moment, at.w[..., j, :])
        return {"sin q9": at.sin_q9, "f left": at.f_left, f"zeta left o s{j + 1}": power}

    return rule


def _two_pencils(at: _Arms) -> dict[str, Array]:
    """det[s2, s4, s5, s6, s9, s10] = (s2 o l)(s6 o AB) - (s2 o AB)(s6 o l), l the meet of the planes of (s4, s5) and (s9, s10)."""
    n1, n2 = np.cross(at.w[..., 3, :], at.w[..., 4, :]), np.cross(at.w[..., 8, :], at.w[..., 9, :])
    d1, d2 = _dot(n1, at.a)[..., None], _dot(n2, at.b)[..., None]
    meet = np.cross(n1, n2), d2 * n1 - d1 * n2
    centres = at.b - at.a, np.cross(at.a, at.b - at.a)

    def power(line: tuple[Array, Array], j: int) -> Array:
        return _dot(line[0], at.v[..., j, :]) + _dot(line[1], at.w[..., j, :])

    return {"(s2 o l)(s6 o AB) - (s2 o AB)(s6 o l)": power(meet, 1) * power(centres, 5) - power(centres, 1) * power(meet, 5)}


def _dot(a: Array, b: Array) -> Array:
    return np.asarray((a * b).sum(axis=-1))


_RULES: dict[tuple[int, ...], Callable[[_Arms], dict[str, Array]]] = {
    (1, 2, 3, 7): _example_2,
    (1, 3, 7, 8): _two_pencils,
    **{tuple(k for k in range(1, 6) if k != j + 1): _right_but(j) for j in range(5)},
}
