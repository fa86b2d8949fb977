"""What rotors, translators, dilators, motors and similarities share: products, reverse, exp and log, and their Jacobians.

A versor V moves X to V X ~V (paper A, appendix A). The classes are Rotor, Translator, Dilator, Similarity (versors.py) and Motor
(motors.py); each has its exponential (a class method), its logarithm, and four Jacobians, in two charts (see exp_log and
exp_log_jacobians, which also say what each matrix is).

Accuracy: with |w| the angle and |v| the length of a translation, the rotation, scale and translation parts of log V are each right to
4e-16 of their own size for all versors (similarities, which pass more factors, by sums in pairs); the same holds for exp, where the size
of the scalar part is cosh(h) and that of e1i e2i e3i e123i is half of |v|, times e^-h (split) or sinh(h)/h (lie), h = log(d)/2. That is
for |w| <= pi; beyond it exp loses as much as the angle itself has lost, 1e-16 |w|. tests/runtime/test_exp_log_accuracy.py measures it.
"""

from __future__ import annotations

from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime import exp_log_jacobians
from cga_runtime.coordinates import Array, parts, read, stack
from cga_runtime.errors import DegenerateError, UnknownNameError
from cga_runtime.exp_log import BIVECTORS, BLADES, CHARTS, exp, log
from cga_runtime.kernels import products
from cga_runtime.multivectors import PSEUDOSCALAR, Multivector, reverse_signs, times
from cga_runtime.smooth import NUMPY

RIGID = 1e-9
"""Largest deviation of a versor from V ~V = 1, in units of its own size, and of a matrix from a rotation."""
FACTORS = {"rotor": "R", "translator": "T", "dilator": "D", "motor": "RT", "similarity": "RTD"}
"""What each group is made of; the product of two versors lies in the smallest group that has the factors of both."""


class Versor:
    """An element of one of the groups: `coefficients` (..., k) in the order of `blades`, read-only."""

    coefficients: Array
    group: ClassVar[str]
    blades: ClassVar[tuple[str, ...]]
    bivector_blades: ClassVar[tuple[str, ...]]
    classes: ClassVar[dict[str, type[Versor]]] = {}

    def __init_subclass__(cls, group: str) -> None:
        cls.group, cls.blades, cls.bivector_blades = group, BLADES[group], BIVECTORS[group]
        Versor.classes[group] = cls

    def __init__(self, coefficients: ArrayLike) -> None:
        raise TypeError("Versor is the base of Rotor, Translator, Dilator, Motor and Similarity: make one of these")

    @classmethod
    def exp(cls, bivector: ArrayLike, chart: str = "split") -> Self:
        """The versor of a bivector (..., k), the standard exponential of -B/2 in the chart "lie", split into factors in "split".

        Raises WrongSizeError, NotFiniteError, UnknownNameError; DegenerateError where the versor would be too large for a float.
        """
        b = cls._bivector(bivector, chart)
        with np.errstate(over="ignore", invalid="ignore"):
            coefficients = stack(*exp(NUMPY, cls.group, parts(b), chart))
        if not np.isfinite(coefficients).all():
            raise DegenerateError(f"{cls.group}: the exponential of a bivector of size {np.abs(b).max():.1e} is too large for a float")
        return cls(coefficients)

    def log(self, chart: str = "split") -> Array:
        """The bivector (..., k) of the shortest rotation with exp(B) = V or -V, the same for V and -V. Raises UnknownNameError."""
        with np.errstate(over="ignore", invalid="ignore"):  # of second parts of pairs, which are left out then
            return stack(*log(NUMPY, self.group, parts(self.coefficients), _chart(chart)))

    @classmethod
    def exp_jacobian(cls, bivector: ArrayLike, chart: str = "split") -> Array:
        """Derivative of the components of exp(B) by those of B, (..., versor, bivector)."""
        return exp_log_jacobians.exp_jacobian(cls.group, cls._bivector(bivector, chart), chart)

    def log_jacobian(self, chart: str = "split") -> Array:
        """Derivative of the components of log V by those of V, (..., bivector, versor)."""
        return exp_log_jacobians.log_jacobian(self.group, self.coefficients, _chart(chart))

    @classmethod
    def right_jacobian(cls, bivector: ArrayLike, chart: str = "split") -> Array:
        """J_r with exp(B + dB) = exp(B) exp(J_r dB) to first order: J_r dB is the body twist, (..., bivector, bivector)."""
        return exp_log_jacobians.right_jacobian(cls.group, cls._bivector(bivector, chart), chart)

    @classmethod
    def left_jacobian(cls, bivector: ArrayLike, chart: str = "split") -> Array:
        """J_l with exp(B + dB) = exp(J_l dB) exp(B) to first order: J_l dB is the world twist, (..., bivector, bivector)."""
        return exp_log_jacobians.left_jacobian(cls.group, cls._bivector(bivector, chart), chart)

    @classmethod
    def _bivector(cls, values: ArrayLike, chart: str) -> Array:
        _chart(chart)
        return read(values, f"bivector of a {cls.group}", len(cls.bivector_blades))

    def embedded(self, group: str) -> Array:
        """Coefficients as an element of a larger group, zero where this one has no component."""
        wider = np.zeros((*self.coefficients.shape[:-1], len(BLADES[group])))
        wider[..., [BLADES[group].index(name) for name in self.blades]] = self.coefficients
        return wider

    def __mul__(self, other: Any) -> Any:
        """Geometric product. With a versor: the motion `other`, then this one, in the smallest group of both; else a Multivector."""
        if not isinstance(other, Versor):
            return times(self, other, "geometric")
        needed = set(FACTORS[self.group] + FACTORS[other.group])
        group = next(name for name, factors in FACTORS.items() if needed <= set(factors))
        product = getattr(products(), f"{self.group}_{other.group}", None)
        if product is not None:
            return Versor.classes[group](stack(*product(parts(self.coefficients), parts(other.coefficients))))
        wide = "similarity" if "D" in needed else "motor"
        a, b = (parts(v.embedded(wide)) for v in (self, other))
        whole = stack(*getattr(products(), f"{wide}_{wide}")(a, b))
        return Versor.classes[group](whole[..., [BLADES[wide].index(name) for name in BLADES[group]]])

    def __invert__(self) -> Self:
        """Reverse: the inverse motion."""
        return type(self)(self.coefficients * reverse_signs(self.blades))

    def __xor__(self, other: Any) -> Multivector:
        """Outer product, with anything that has coefficients and blades."""
        return times(self, other, "outer")

    def __or__(self, other: Any) -> Multivector:
        """Inner product of Hestenes, with anything that has coefficients and blades."""
        return times(self, other, "inner")

    def dual(self) -> Multivector:
        """V* = V I, I = e0123i."""
        return times(self, PSEUDOSCALAR, "geometric")


def _chart(name: str) -> str:
    if name not in CHARTS:
        raise UnknownNameError("chart", name, CHARTS)
    return name
