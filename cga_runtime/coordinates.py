"""Checked coordinate arrays and the few vector operations that elements and motors stand on; leading batch dimensions everywhere."""

from __future__ import annotations

from operator import index

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.errors import DegenerateError, NotFiniteError, WrongSizeError
from cga_runtime.kernels import numeric

Array = NDArray[np.float64]

ZERO = 1e-12
"""A direction shorter than this is no direction."""


def read(values: ArrayLike, what: str, *shape: int) -> Array:
    """A read-only float64 copy of shape (..., *shape). Raises WrongSizeError, NotFiniteError."""
    wanted = f"(..., {', '.join(str(k) for k in shape)})" if shape else "(...)"
    array = np.array(numeric(values, what))
    if array.ndim < len(shape) or array.shape[array.ndim - len(shape) :] != shape:
        raise WrongSizeError(f"{what}: shape {array.shape} given, {wanted} needed")
    if not np.isfinite(array).all():
        raise NotFiniteError(f"{what} holds NaN or infinity: {np.array2string(array.ravel()[:8], precision=4)}")
    array.flags.writeable = False
    return array


def count(value: object, what: str, least: int = 0) -> int:
    """An integer (of Python or numpy) not below `least`. Raises WrongSizeError."""
    try:
        number = index(value)  # type: ignore[arg-type]  # that it may not be one is the point
    except TypeError:
        raise WrongSizeError(f"{what}: {value!r} given, an integer of at least {least} needed") from None
    if number < least:
        raise WrongSizeError(f"{what}: {number} given, at least {least} needed")
    return number


def one_batch(what: str, *shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The common batch shape. Raises WrongSizeError if there is none."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        raise WrongSizeError(f"{what}: batch dimensions {', '.join(str(shape) for shape in shapes)} do not broadcast") from None


def stack(*parts: ArrayLike) -> Array:
    """Scalars (...) side by side as the components of a vector (..., k)."""
    return np.stack(np.broadcast_arrays(*[np.asarray(part, dtype=np.float64) for part in parts]), axis=-1)


def parts(vector: Array) -> tuple[Array, ...]:
    """The components of a vector (..., k), each (...)."""
    return tuple(np.moveaxis(vector, -1, 0))


def dot(a: Array, b: Array) -> Array:
    """a.b, (...)."""
    return np.asarray((a * b).sum(axis=-1))


def norm(a: Array) -> Array:
    """|a|, (...)."""
    return np.asarray(np.linalg.norm(a, axis=-1))


def times(scalar: Array, vector: Array) -> Array:
    """A scalar (...) times a vector (..., k)."""
    return np.asarray(scalar[..., None] * vector)


def unit(vector: Array, what: str) -> Array:
    """vector / |vector|, without overflow. Raises DegenerateError for a zero vector."""
    largest = np.abs(vector).max(axis=-1, keepdims=True)
    if (largest <= ZERO).any():
        raise DegenerateError(f"{what}: its direction is zero")
    scaled = vector / largest
    return np.asarray(scaled / norm(scaled)[..., None])
