"""What points, point pairs, lines, circles, planes and spheres share: products, reverse, dual, motion, and the reading of their fields."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, norm, one_batch, read, times
from cga_runtime.elements.through_points import COINCIDENT, FARTHEST
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError
from cga_runtime.motors import Motor
from cga_runtime.multivectors import PSEUDOSCALAR, Multivector, reverse_signs
from cga_runtime.multivectors import times as product
from cga_runtime.versor_group import Versor
from cga_runtime.versors import Dilator, Rotor, Similarity, Translator

SCALARS = ("radius", "offset")
"""Fields that are numbers (...); the others are vectors (..., 3)."""


class Element(ABC):
    """A geometric primitive as a unit blade X: `coefficients` (..., k) in the order of `blades`.

    `kind` is its name, one of point, point_pair, line, circle, plane, sphere. Products take anything that has coefficients and blades.
    """

    kind: ClassVar[str]
    blades: ClassVar[tuple[str, ...]]
    kinds: ClassVar[dict[str, type[Element]]] = {}
    __array_ufunc__ = None  # numpy leaves products with arrays to the methods below

    def __init_subclass__(cls, kind: str) -> None:
        cls.kind = kind
        Element.kinds[kind] = cls

    if TYPE_CHECKING:

        @property
        def center(self) -> Array: ...  # a field or a property of every kind

    @property
    @abstractmethod
    def coefficients(self) -> Array:
        """Coefficients of the unit primitive, (..., k)."""

    @property
    @abstractmethod
    def batch(self) -> tuple[int, ...]:
        """Leading dimensions."""

    def __mul__(self, other: Any) -> Multivector:
        """Geometric product."""
        return self._product(other, "geometric")

    def __xor__(self, other: Any) -> Multivector:
        """Outer product."""
        return self._product(other, "outer")

    def __or__(self, other: Any) -> Multivector:
        """Inner product of Hestenes: zero when a factor is scalar."""
        return self._product(other, "inner")

    def __invert__(self) -> Multivector:
        """Reverse."""
        return Multivector(self.coefficients * reverse_signs(self.blades), self.blades)

    def dual(self) -> Multivector:
        """X* = X I, I = e0123i; X** = -X."""
        return self._product(PSEUDOSCALAR, "geometric")

    def transformed(self, versor: Versor) -> Self:
        """The element V X ~V of any versor x -> d R x + t, from its centre, direction, radius or points (paper A, eq. 6).

        The batch dimensions of both broadcast. Raises WrongSizeError; UnknownNameError for what is no versor; DegenerateError where the
        element would shrink to a point or leave for more than 1e60 m.
        """
        scale, rotation, translation = motion(versor)
        one_batch(f"motion of a {self.name}", self.batch, scale.shape, rotation.shape[:-2], translation.shape[:-1])
        with np.errstate(over="ignore", invalid="ignore"):
            try:
                return self._moved(scale, rotation, translation)
            except NotFiniteError:
                raise DegenerateError(f"{self.name}: moved by a versor that is too large for a float") from None

    @property
    def name(self) -> str:
        """The kind in plain words."""
        return self.kind.replace("_", " ")

    @abstractmethod
    def _moved(self, d: Array, rotation: Array, t: Array) -> Self:
        """The element after x -> d R x + t."""

    def _product(self, other: Any, rule: str) -> Multivector:
        with np.errstate(over="ignore", invalid="ignore"):  # the product is checked as a whole
            return product(self, other, rule)


def motion(versor: Versor) -> tuple[Array, Array, Array]:
    """d (...), R (..., 3, 3) and t (..., 3) of a versor x -> d R x + t. Raises UnknownNameError for what is no versor."""
    one, identity, zero = np.ones(()), np.eye(3), np.zeros(3)
    match versor:
        case Rotor():
            return one, versor.matrix(), zero
        case Translator():
            return one, identity, versor.vector()
        case Dilator():
            return versor.scale(), identity, zero
        case Motor():
            pose = versor.pose()
            return one, pose[..., :3, :3], pose[..., :3, 3]
        case Similarity():
            return versor.scale(), versor.rotation().matrix(), versor.translation()
    raise UnknownNameError("versor", type(versor).__name__, [kind.__name__ for kind in Versor.classes.values()])


def rotated(rotation: Array, x: Array) -> Array:
    """R x, (..., 3)."""
    return np.asarray((rotation @ x[..., None])[..., 0])


def carried(d: Array, rotation: Array, t: Array, x: Array) -> Array:
    """d R x + t, (..., 3)."""
    return times(d, rotated(rotation, x)) + t


def set_fields(element: Element, batch: tuple[int, ...], **fields: Array) -> None:
    """Fields of a frozen element, brought to one batch shape, read-only."""
    for field, value in fields.items():
        shape = batch if field in SCALARS else (*batch, 3)
        frozen = np.broadcast_to(value, shape).copy()
        frozen.flags.writeable = False
        object.__setattr__(element, field, frozen)


def vectors(*values: ArrayLike) -> tuple[Array, ...]:
    """Points or directions of one batch shape, each (..., 3)."""
    arrays = [read(x, "point or direction", 3) for x in values]
    batch = one_batch("points", *(x.shape[:-1] for x in arrays))
    return tuple(np.broadcast_to(x, (*batch, 3)) for x in arrays)


def within_reach(x: Array, what: str) -> Array:
    """Points (..., 3) of which all powers that occur stay finite. Raises DegenerateError."""
    with np.errstate(over="ignore"):
        if (norm(x) > FARTHEST).any():
            raise DegenerateError(f"{what} lies more than {FARTHEST:.0e} m from the origin")
    return x


def positive_radius(radius: ArrayLike, what: str) -> Array:
    """A positive radius that is not too large. Raises DegenerateError."""
    r = read(radius, f"radius of a {what}")
    if (r <= COINCIDENT).any():
        raise DegenerateError(f"{what}: radius {r.min():.3g} given, a positive one is needed (more than {COINCIDENT:.0e} m)")
    if (r > FARTHEST).any():
        raise DegenerateError(f"{what}: radius {r.max():.1e} given, at most {FARTHEST:.0e} m is accepted")
    return r
