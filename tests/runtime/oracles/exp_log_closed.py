"""The exponential and the logarithm of versors in 50 digits by sine, cosine and complex numbers: fast enough for many samples.

Checked against the power series of exp_log_series by test_exp_log_oracles.py.
"""

from itertools import pairwise

from exp_log_series import exact, of, on_group
from mpmath import mp, mpc, mpf

from cga_codegen.algebra.multivector import Multivector
from cga_runtime.exp_log import BIVECTORS, BLADES, SIMILARITY_BLOCKS


def exp(group, bivector, chart="split"):
    """Components of exp(B) of the chart."""
    with mp.workdps(_digits(bivector[:3])):
        w, s, v = _vectors(group, bivector)
        angle = _norm(w)
        half = mp.sin(angle / 2) / angle if angle else mpf(1) / 2
        rotor = [mp.cos(angle / 2), -half * w[2], half * w[1], -half * w[0]]
        t = _spread(_mean_exponential, w, s, v) if chart == "lie" else v
        translator = of("translator", [mpf(1), *(-x / 2 for x in t)])
        dilator = of("dilator", [mp.cosh(s / 2), mp.sinh(s / 2)])
        return ((translator * of("rotor", rotor)) * dilator).project(_kind(group)).coefficients


def log(group, versor, chart="split"):
    """Components of the logarithm, of V on the group (see on_group), shortest rotation."""
    blocks = SIMILARITY_BLOCKS if group == "similarity" else ((0, 1, 2, 3), (), (4, 5, 6, 7))
    with mp.workdps(_digits(versor[1:4])):
        v = on_group(group, versor)
        if group == "translator":
            return [-2 * x for x in v[1:]]
        if group == "dilator":
            return [-2 * mp.asinh(v[1])]
        v = [-x for x in v] if v[0] < 0 else v
        a, *b = (v[k] for k in blocks[0])
        cosh, n = mp.sqrt(a * a + sum(x * x for x in b)), _norm(b)
        factor = 2 * mp.atan2(n, a) / n if n else 2 / a
        w = [-factor * b[2], factor * b[1], -factor * b[0]]
        plane = [w[2], -w[1], w[0]]
        if group == "rotor":
            return plane
        s = 2 * mp.asinh(sum(v[i] * v[k] for i, k in zip(*blocks[:2], strict=True)) / cosh) if group == "similarity" else mpf(0)
        moved = Multivector(_kind("motor"), (*(mpf(0),) * 4, *(v[k] for k in blocks[2])))
        back = moved * of("rotor", [a / cosh, *(-x / cosh for x in b)])
        t = [-2 * mp.exp(s / 2) * x for x in back.project(_kind("motor")).coefficients[4:7]]
        t = _spread(lambda z: 1 / _mean_exponential(z), w, s, t) if chart == "lie" else t
        return [*plane, *([-s] if group == "similarity" else []), *t]


def error(values, reference, names, scales):
    """Largest relative error of the blocks of components; `scales` maps the name of a block to what its error is divided by,
    None for the size of the reference."""
    worst = 0.0
    for block, scale in scales.items():
        at = [k for k, name in enumerate(names) if name in block.split()]
        difference = _norm([x - reference[k] for k, x in zip(at, exact([values[k] for k in at]), strict=True)])
        size = _norm([reference[k] for k in at]) if scale is None else scale
        worst = max(worst, float(difference / size) if size else float(difference))
    return worst


def _digits(plane):
    """90 (second differences take 50), and twice the zeros of the angle: differences of numbers near one are divided by its square."""
    size = max((abs(float(x)) for x in plane), default=0.0)
    return 90 + (2 * int(-mp.log10(size)) if 0 < size < 1 else 0)


def _kind(group):
    return of(group, [mpf(0)] * len(BLADES[group])).type


def _norm(x):
    return mp.sqrt(sum(c * c for c in x))


def _vectors(group, bivector):
    b = dict(zip(BIVECTORS[group], exact(bivector), strict=True))
    zero = mpf(0)
    w = [b.get("e23", zero), -b.get("e13", zero), b.get("e12", zero)]
    return w, -b.get("e0i", zero), [b.get(name, zero) for name in ("e1i", "e2i", "e3i")]


def _mean_exponential(z):
    return (mp.exp(z) - 1) / z if z else mpc(1)


def _spread(function, w, s, v):
    """function(s + N) v, N v = w cross v: function(s) along w, function(s + i |w|) across it."""
    angle = _norm(w)
    if not angle:
        return [function(mpc(s)).real * x for x in v]
    n = [x / angle for x in w]
    along = sum(x * y for x, y in zip(n, v, strict=True))
    across = [x - along * y for x, y in zip(v, n, strict=True)]
    turned = [n[i] * across[j] - n[j] * across[i] for i, j in pairwise((1, 2, 0, 1))]
    f, g = function(mpc(s)).real, function(mpc(s, angle))
    return [f * along * n[k] + g.real * across[k] + g.imag * turned[k] for k in range(3)]
