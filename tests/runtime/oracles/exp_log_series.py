"""The exponential of CGA versors in 60 digits by the power series of the geometric product, and the logarithm by Newton's method.

Independent of the runtime: the products are the exact tables of the algebra, the numbers are mpmath's; nothing is known of sine or cosine.
"""

import numpy as np
from mpmath import mp, mpf

from cga_codegen.algebra import blade_types
from cga_codegen.algebra.multivector import Multivector
from cga_runtime.exp_log import BIVECTORS, BLADES, SIMILARITY_BLOCKS

DIGITS = 60
TYPES = {
    "rotor": blade_types.ROTOR,
    "translator": blade_types.TRANSLATOR,
    "dilator": blade_types.DILATOR,
    "motor": blade_types.MOTOR,
    "similarity": blade_types.SIMILARITY,
}
STEP = mpf(10) ** -25


def exact(values):
    """Floats as 60-digit numbers; what is one already stays."""
    return [v if isinstance(v, mpf) else mpf(float(v)) for v in values]


def of(group, values):
    """The versor with these components, in 60-digit numbers."""
    return Multivector(TYPES[group], tuple(exact(values)))


def _series(group, bivector):
    """exp(-B/2) by its power series, after halving B until it is small, and squaring back."""
    kind = TYPES[group]
    halvings = max(0, int(mp.ceil(mp.log(1 + sum(abs(b) for b in bivector), 2))) + 4)
    small = {name: -b / 2 ** (halvings + 1) for name, b in zip(BIVECTORS[group], bivector, strict=True)}
    x = Multivector(kind, tuple(small.get(name, mpf(0)) for name in BLADES[group]))
    total = term = Multivector(kind, tuple(mpf(name == "1") for name in BLADES[group]))
    for k in range(1, 60):
        term = (term * x).project(kind)
        term = Multivector(kind, tuple(c / k for c in term.coefficients))
        total = Multivector(kind, tuple(a + b for a, b in zip(total.coefficients, term.coefficients, strict=True)))
        if max(abs(c) for c in term.coefficients) < mpf(10) ** -(DIGITS + 15):
            break
    for _ in range(halvings):
        total = (total * total).project(kind)
    return total.coefficients


def exp(group, bivector, chart="split"):
    """Components of exp(B) of the chart, B given as floats or 60-digit numbers."""
    with mp.workdps(DIGITS + 25):
        b = dict(zip(BIVECTORS[group], exact(bivector), strict=True))
        if chart == "lie" or group not in ("motor", "similarity"):
            return _series(group, list(b.values()))
        product = None
        for part in (("e1i", "e2i", "e3i"), ("e12", "e13", "e23"), ("e0i",)):
            factor = _series(group, [x if name in part else mpf(0) for name, x in b.items()])
            factor = Multivector(TYPES[group], factor)
            product = factor if product is None else (product * factor).project(TYPES[group])
        return product.coefficients


def along(function, at, direction):
    """First and second derivative of a 60-digit function along a direction, by central differences, right to 30 digits; as floats."""
    with mp.workdps(DIGITS + 25):
        middle, step = exact(at), exact(direction)
        values = [function([x + k * STEP * d for x, d in zip(middle, step, strict=True)]) for k in (-1, 0, 1)]
        first = [float((c - a) / (2 * STEP)) for a, _, c in zip(*values, strict=True)]
        return np.array(first), np.array([float((a - 2 * b + c) / STEP**2) for a, b, c in zip(*values, strict=True)])


def columns(function, at):
    """First derivatives of a 60-digit function: a matrix of floats, a column for each argument."""
    return np.stack([along(function, at, direction)[0] for direction in np.eye(len(at))], axis=-1)


def on_group(group, versor):
    """The versor of the group nearest in the sense of exp_log: rotors and motors divided by the root of V ~V = s + p e123i; of similarities
    the rotor and sinh h are kept, and of the rest what makes V ~V = 1; of dilators sinh h; translators are divided by their scalar part."""
    v = of(group, versor)
    names = BLADES[group]
    if group == "similarity":
        a, k, m = ([v.coefficients[i] for i in block] for block in SIMILARITY_BLOCKS)
        size = mp.sqrt(sum(x * x for x in a))
        r = [x / size for x in a]
        sinh = sum(x * y for x, y in zip(r, k, strict=True))
        pseudo = (of("motor", [*r, 0.0, 0.0, 0.0, 0.0]) * of("motor", [0.0] * 7 + [1.0])).coefficients[-4:]
        along = sum(x * y for x, y in zip(pseudo, m, strict=True))
        m = [x - along * p for x, p in zip(m, pseudo, strict=True)]
        cosh = mp.sqrt(1 + sinh * sinh)
        made = dict(zip(sum(SIMILARITY_BLOCKS, ()), [*(cosh * x for x in r), *(sinh * x for x in r), *m], strict=True))
        return tuple(made[i] for i in range(12))
    if group == "dilator":
        return mp.sqrt(1 + v.coefficients[1] ** 2), v.coefficients[1]
    if group == "translator":
        return tuple(x / v.coefficients[0] for x in v.coefficients)
    square = v * ~v
    s, root = square.coefficient(0), mp.sqrt(square.coefficient(0))
    p = square.coefficient(0b11110) if group == "motor" else mpf(0)
    inverse = of(group, [{"1": 1 / root, "e123i": -p / (2 * s * root)}.get(name, mpf(0)) for name in names])
    return (v * inverse).project(TYPES[group]).coefficients


def log(group, versor, start, chart="split"):
    """The B near `start` with exp(B) = V or -V in 50 digits, V on the group: Newton's method, with slopes from central differences.

    The slopes need not be exact: each step gains their 9 digits or more, and the residual is that of 60-digit numbers.
    """
    with mp.workdps(DIGITS + 25):
        target = on_group(group, versor)
        b = exact(start)
        slopes = columns(lambda x: exp(group, x, chart), b)
        size = max(abs(t) for t in target)
        for _ in range(8):
            reached = exp(group, b, chart)
            sign = 1 if sum(x * y for x, y in zip(reached[:4], target[:4], strict=True)) > 0 else -1
            residual = [sign * t - r for t, r in zip(target, reached, strict=True)]
            largest = max(abs(r) for r in residual)
            if largest < size * mpf(10) ** -45:
                return b
            step = np.linalg.lstsq(slopes, np.array([float(r / largest) for r in residual]), rcond=None)[0]
            b = [x + largest * mpf(float(d)) for x, d in zip(b, step, strict=True)]
        raise AssertionError(f"no logarithm found near {start}: residual {float(largest)} of {float(size)}")
