"""The atlas of actuation schemes: which choices of actuated joints control a closed chain, proved exactly, and how well (paper C, 5.2.2).

Scheme a is admissible at q exactly when the screws of its passive joints are independent. Classes: "admissible" (full rank at some
mirror-symmetric pose too, or the arms are not mirror images), "admissible_off_mirror" (full rank somewhere, but at no mirror-symmetric
pose tried), "never" (rank deficient everywhere).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations
from math import tan
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.analysis.certificates import NotRationalError, RationalArm, exact_rank, mirror_signs
from cga_runtime.coordinates import count
from cga_runtime.spaces.closed_chain import LENGTH, ClosedLoop

Array = NDArray[np.float64]

POINTS = 4
"""Exact rational configurations of each kind (generic, mirror-symmetric) at which ranks are taken."""
CHUNK = 256
"""Poses whose singular values are taken at once: keeps the work in the processor's cache."""

REASON_BASE = "joints {0} and {1} both passive: their axes are one line, so two screws are equal"
REASON_WRISTS = "both spherical joints all passive: their six axes meet the line of the two wrist centres"
REASON_MIRROR = "singular on every mirror-symmetric pose"
REASON_POINTS = f"rank deficient at {POINTS} exact rational points (no structural reason found)"
REASON_FLOAT = "the description is not exactly rational: decided by mu over the sampled poses"


def conditioning(loop: ClosedLoop, q: ArrayLike, schemes: Sequence[Sequence[int]]) -> Array:
    """mu of each scheme (1-based actuated joints) at q (..., n): shape (..., number of schemes), in [0, 1].

    mu_a = sigma_min(N[a, :]), N an orthonormal basis of the joint velocities that keep the loop closed, null [J_R, -J_L]. It needs no
    units, vanishes exactly where the scheme's determinant does, and 1/mu bounds |q'| / |q'_a|.
    """
    chosen = np.array([loop.scheme(scheme)[0] for scheme in schemes], dtype=np.intp)
    q = loop.check(q)
    flat = q.reshape(-1, loop.n)
    mu = np.empty((len(flat), len(chosen)))
    for start in range(0, len(flat), CHUNK):
        part = flat[start : start + CHUNK]
        twists = loop.twists(part)
        closure = np.concatenate([twists[:, :3], twists[:, 3:] / LENGTH], axis=1)
        closure[:, :, loop.right.n :] *= -1
        _, values, vt = np.linalg.svd(closure)
        basis = np.swapaxes(vt[:, 6:], 1, 2)
        mu[start : start + CHUNK] = np.linalg.svd(basis[:, chosen], compute_uv=False)[..., -1]
        # where the loop gains mobility, no scheme of this size controls it
        mu[start : start + CHUNK][values[:, 5] < 1e-12 * values[:, 0]] = 0.0
    return mu.reshape(*q.shape[:-1], len(chosen))


def atlas(
    loop: ClosedLoop, samples: int = 3000, seed: int = 0, progress: Callable[[int, int], None] | None = None
) -> list[dict[str, Any]]:
    """One row a scheme, ascending in its actuated joints (1-based).

    Keys: actuated; orbit (the smaller of the scheme and the one with the arms exchanged, its mirror image if the arms are); class; reason;
    certified (the rank, full or deficient, is proved by an exact point or by structure; that a scheme is singular on all mirror poses rests
    on POINTS exact ones); witness (half-angle tangents of an exact full-rank point, or None); mu_median, mu_p05, mu_below_001 over
    `samples` uniform poses with free grasps. Raises WrongSizeError for samples < 1 or seed < 0.
    """
    samples = count(samples, "samples", 1)
    schemes = [tuple(j + 1 for j in scheme) for scheme in combinations(range(loop.n), loop.actuators)]
    rng = np.random.default_rng(count(seed, "seed"))
    poses = loop.random(rng, samples)
    mu = np.empty((samples, len(schemes)))
    for start in range(0, samples, CHUNK):
        mu[start : start + CHUNK] = conditioning(loop, poses[start : start + CHUNK], schemes)
        if progress is not None:
            progress(min(start + CHUNK, samples), samples)
    classes = _classify(loop, schemes, mu, rng)
    rows = []
    for k, scheme in enumerate(schemes):
        row = {"actuated": list(scheme), "orbit": list(min(scheme, _exchanged(loop, scheme))), **classes[k]}
        row["mu_median"], row["mu_p05"] = float(np.median(mu[:, k])), float(np.quantile(mu[:, k], 0.05))
        row["mu_below_001"] = float((mu[:, k] < 0.01).mean())
        rows.append(row)
    return rows


def summary(table: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Counts of an atlas: schemes and orbits of each class, and the best medians and quantiles."""

    def count(*classes: str) -> tuple[int, int]:
        rows = [row for row in table if row["class"] in classes]
        return len(rows), len({tuple(row["orbit"]) for row in rows})

    admissible, never, off = count("admissible", "admissible_off_mirror"), count("never"), count("admissible_off_mirror")
    return {
        "total": len(table),
        "orbits": len({tuple(row["orbit"]) for row in table}),
        "admissible": admissible[0],
        "admissible_orbits": admissible[1],
        "never": never[0],
        "never_orbits": never[1],
        "singular_on_mirror": off[0],
        "singular_on_mirror_orbits": off[1],
        "best_median": _best(table, "mu_median"),
        "best_p05": _best(table, "mu_p05"),
    }


def _best(table: Sequence[dict[str, Any]], key: str) -> list[int]:
    """The orbit whose schemes are best on average (mirror images differ by the sample only).

    With collinear first axes mu does not change when these two joints trade places, so orbits tie, in all poses, up to rounding: of such
    the one that divides its actuators most evenly between the arms is named, then the first.
    """
    orbits: dict[tuple[int, ...], list[float]] = {}
    for row in table:
        orbits.setdefault(tuple(row["orbit"]), []).append(row[key])
    means = {orbit: sum(values) / len(values) for orbit, values in orbits.items()}
    top = max(means.values())
    half = max(j for row in table for j in row["actuated"]) // 2

    tied = [orbit for orbit in means if means[orbit] >= (1.0 - 1e-9) * top]
    ranked = sorted((abs(sum(1 if j <= half else -1 for j in orbit)), orbit) for orbit in tied)
    return list(ranked[0][1])


def _exchanged(loop: ClosedLoop, scheme: Sequence[int]) -> tuple[int, ...]:
    """The same scheme with the arms exchanged (arms of equal length only; else the scheme itself)."""
    half = loop.right.n
    if half != loop.left.n:
        return tuple(scheme)
    return tuple(sorted(j + half if j <= half else j - half for j in scheme))


def _classify(loop: ClosedLoop, schemes: Sequence[tuple[int, ...]], mu: Array, rng: np.random.Generator) -> list[dict[str, Any]]:
    try:
        right, left = RationalArm.of(loop.right), RationalArm.of(loop.left)
    except NotRationalError:
        best = mu.max(axis=0)
        return [
            {"class": "admissible" if top > 1e-9 else "never", "reason": REASON_FLOAT, "certified": False, "witness": None} for top in best
        ]
    signs = mirror_signs(right, left)
    generic = [_tangents(loop.random(rng)) for _ in range(POINTS)]
    mirrored = [] if signs is None else [t[: loop.right.n] + [s * x for s, x in zip(signs, t, strict=False)] for t in generic]
    screws = {
        kind: [right.screws(t[: loop.right.n]) + left.screws(t[loop.right.n :]) for t in points]
        for kind, points in (("generic", generic), ("mirrored", mirrored))
    }
    one_line = all(_parallel(lines[0], lines[loop.right.n]) for lines in screws["generic"])
    classes = []
    for scheme in schemes:
        _, passive = loop.scheme(scheme)
        witness = next((k for k in range(POINTS) if _full(screws["generic"][k], passive)), None)
        on_mirror = witness is not None and (signs is None or any(_full(lines, passive) for lines in screws["mirrored"]))
        kind = "never" if witness is None else "admissible" if on_mirror else "admissible_off_mirror"
        reason = "" if on_mirror else REASON_MIRROR if witness is not None else _reason(loop, passive, one_line)
        tangents = None if witness is None else [str(x) for x in generic[witness]]
        classes.append({"class": kind, "reason": reason, "certified": reason != REASON_POINTS, "witness": tangents})
    return classes


def _full(screws: Sequence[list[Fraction]], passive: Sequence[int]) -> bool:
    return exact_rank([screws[j] for j in passive]) == 6


def _reason(loop: ClosedLoop, passive: Sequence[int], one_line: bool) -> str:
    base = (0, loop.right.n)
    if one_line and set(base) <= set(passive):
        return REASON_BASE.format(base[0] + 1, base[1] + 1)
    wrists = {2, 3, 4, 7, 8, 9}
    if "wrist_centres" in loop.unit.names and wrists == set(passive):
        return REASON_WRISTS
    return REASON_POINTS


def _parallel(a: Sequence[Fraction], b: Sequence[Fraction]) -> bool:
    """Whether two screws are multiples of each other, exactly."""
    return exact_rank([list(a), list(b)]) < 2


def _tangents(q: Array) -> list[Fraction]:
    """Rational half-angle tangents near q: small denominators keep exact arithmetic short."""
    return [Fraction(round(64 * tan(0.5 * x)), 64) for x in q]
