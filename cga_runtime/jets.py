"""Jets: numpy values with their derivatives in a few directions, so that a formula written once gives its exact Jacobian too.

Forward-mode differentiation: no step size, no difference of nearby numbers. Where a formula chooses between branches, the derivative is
that of the branch taken.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.smooth import Field

Bools = Any


@dataclass(frozen=True, eq=False)
class Jet:
    """A value (...) and its derivatives (k, ...)."""

    value: Array
    slope: Array
    __array_ufunc__ = None  # numpy leaves products with arrays to the methods below

    def __add__(self, other: Any) -> Jet:
        b = _jet(other, self)
        return Jet(self.value + b.value, self.slope + b.slope)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.slope)

    def __sub__(self, other: Any) -> Jet:
        return self + (-_jet(other, self))

    def __rsub__(self, other: Any) -> Jet:
        return _jet(other, self) + (-self)

    def __mul__(self, other: Any) -> Jet:
        b = _jet(other, self)
        return Jet(self.value * b.value, self.value * b.slope + b.value * self.slope)

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Jet:
        b = _jet(other, self)
        quotient = self.value / b.value
        return Jet(quotient, (self.slope - quotient * b.slope) / b.value)

    def __rtruediv__(self, other: Any) -> Jet:
        return _jet(other, self) / self

    def __lt__(self, other: Any) -> Bools:
        return self.value < _jet(other, self).value

    def __gt__(self, other: Any) -> Bools:
        return self.value > _jet(other, self).value


def variables(values: Sequence[Array]) -> tuple[Jet, ...]:
    """Independent variables (...): the derivatives of the k-th are the k-th unit vector."""
    directions = np.eye(len(values)).reshape(len(values), len(values), *[1] * values[0].ndim)
    return tuple(Jet(v, e + np.zeros(v.shape)) for v, e in zip(values, directions, strict=True))


def jacobian(results: Sequence[Any], of: Jet) -> Array:
    """Derivatives of results (m of them) by the variables that `of` is one of (k of them), (..., m, k)."""
    rows = [np.moveaxis(np.broadcast_to(_jet(r, of).slope, of.slope.shape), 0, -1) for r in results]
    return np.stack(rows, axis=-2)


def _jet(x: Any, like: Jet) -> Jet:
    return x if isinstance(x, Jet) else Jet(np.asarray(x, dtype=np.float64), np.zeros_like(like.slope))


def _chain(function: Callable[[Array], Array], derivative: Callable[[Array, Array], Array]) -> Callable[[Any], Jet]:
    """A function of one jet from the function and its derivative at (argument, value)."""

    def apply(x: Jet) -> Jet:
        value = function(x.value)
        return Jet(value, derivative(x.value, value) * x.slope)

    return apply


def _atan2(y: Jet, x: Any) -> Jet:
    other = _jet(x, y)
    square = y.value * y.value + other.value * other.value
    return Jet(np.arctan2(y.value, other.value), (other.value * y.slope - y.value * other.slope) / square)


def _where(condition: Bools, a: Any, b: Any) -> Any:
    like = a if isinstance(a, Jet) else b
    if not isinstance(like, Jet):
        return np.where(condition, a, b)
    first, second = _jet(a, like), _jet(b, like)
    return Jet(np.where(condition, first.value, second.value), np.where(condition, first.slope, second.slope))


JETS = Field(
    sqrt=_chain(np.sqrt, lambda x, y: 0.5 / y),
    exp=_chain(np.exp, lambda x, y: y),
    sin=_chain(np.sin, lambda x, y: np.cos(x)),
    cos=_chain(np.cos, lambda x, y: -np.sin(x)),
    sinh=_chain(np.sinh, lambda x, y: np.cosh(x)),
    cosh=_chain(np.cosh, lambda x, y: np.sinh(x)),
    asinh=_chain(np.arcsinh, lambda x, y: 1.0 / np.sqrt(1.0 + x * x)),
    atan2=_atan2,
    where=_where,
    pairs=False,
)
