"""Rotors, translators, dilators and similarities as versors of CGA (paper A, eqs. 18, 62-77); motors are in motors.py."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, parts, read, stack, times
from cga_runtime.errors import DegenerateError
from cga_runtime.exp_log import SIMILARITY_BLOCKS, similar, translated
from cga_runtime.kernels import products
from cga_runtime.motors import rotor_of_rotation
from cga_runtime.multivectors import reverse_signs
from cga_runtime.versor_group import RIGID, Versor


@dataclass(frozen=True, eq=False)
class Rotor(Versor, group="rotor"):
    """A rotation about the origin, components 1 e12 e13 e23 = cos(a/2), -sin(a/2) (n3, -n2, n1), (..., 4); R and -R are the same.

    Raises DegenerateError where R ~R is not 1, WrongSizeError, NotFiniteError.
    """

    coefficients: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", read(self.coefficients, "rotor", 4))
        _refuse("rotor", np.abs(dot(self.coefficients, self.coefficients) - 1.0), "Rotor.from_matrix makes a rotor from a matrix")

    @classmethod
    def from_matrix(cls, rotation: ArrayLike) -> Self:
        """The rotor of a rotation matrix (..., 3, 3), scalar part >= 0. Raises DegenerateError for what is no rotation."""
        return cls(rotor_of_rotation(read(rotation, "rotation", 3, 3), "rotation"))

    @classmethod
    def from_vector(cls, vector: ArrayLike) -> Self:
        """The rotor of a rotation vector (w1, w2, w3) (rad), (..., 3): by |w| about w, right-handed."""
        x, y, z = parts(read(vector, "rotation vector", 3))
        return cls.exp(stack(z, -y, x))

    def vector(self) -> Array:
        """The shortest rotation vector (w1, w2, w3) (rad), |w| <= pi, (..., 3)."""
        z, y, x = parts(self.log())
        return stack(x, -y, z)

    def matrix(self) -> Array:
        """Rotation matrix, (..., 3, 3)."""
        a, z, y, x = parts(self.coefficients * [1.0, -1.0, 1.0, -1.0])  # the quaternion a + x i + y j + z k
        rows = (
            stack(1 - 2 * (y * y + z * z), 2 * (x * y - a * z), 2 * (x * z + a * y)),
            stack(2 * (x * y + a * z), 1 - 2 * (x * x + z * z), 2 * (y * z - a * x)),
            stack(2 * (x * z - a * y), 2 * (y * z + a * x), 1 - 2 * (x * x + y * y)),
        )
        return np.stack(rows, axis=-2)


@dataclass(frozen=True, eq=False)
class Translator(Versor, group="translator"):
    """A translation x -> x + t, components 1 e1i e2i e3i = 1, -t/2, (..., 4). Raises DegenerateError, WrongSizeError, NotFiniteError."""

    coefficients: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", read(self.coefficients, "translator", 4))
        defect = np.abs(self.coefficients[..., 0] ** 2 - 1.0)
        _refuse("translator", defect, "Translator.from_vector makes a translator from a vector")

    @classmethod
    def from_vector(cls, translation: ArrayLike) -> Self:
        """The translator by t (m), (..., 3)."""
        return cls.exp(read(translation, "translation", 3))

    def vector(self) -> Array:
        """The translation t (m), (..., 3)."""
        return self.log()


@dataclass(frozen=True, eq=False)
class Dilator(Versor, group="dilator"):
    """A dilation x -> d x about the origin, components 1 e0i = cosh(h), sinh(h), h = log(d)/2, (..., 2); log = -log(d) e0i.

    Raises DegenerateError where D ~D is not 1, WrongSizeError, NotFiniteError.
    """

    coefficients: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", read(self.coefficients, "dilator", 2))
        c, s = np.abs(parts(self.coefficients))
        with np.errstate(over="ignore"):
            defect = np.abs((c - s) * (c + s) - 1.0) / np.maximum(c * c, 1.0)
        _refuse("dilator", defect, "Dilator.from_scale makes a dilator from a factor")

    @classmethod
    def from_scale(cls, scale: ArrayLike) -> Self:
        """The dilator by a factor d > 0, (...). Raises DegenerateError for d <= 0."""
        return cls(stack(*_cosh_sinh(_scale(scale))))

    def scale(self) -> Array:
        """The factor d, (...)."""
        c, s = parts(self.coefficients)
        return _squared_exponential(np.where(c < 0.0, -s, s))


@dataclass(frozen=True, eq=False)
class Similarity(Versor, group="similarity"):
    """A similarity x -> d R x + t, V = T R D, components 1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i, (..., 12).

    V and -V are the same. Raises DegenerateError where V ~V is not 1 (in units of |V|^2), WrongSizeError, NotFiniteError.
    """

    coefficients: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "coefficients", read(self.coefficients, "similarity", 12))
        v = self.coefficients
        with np.errstate(over="ignore", invalid="ignore"):
            size = norm(v[..., [0, 1, 2, 3]])
            square = stack(*products().similarity_similarity(parts(v), parts(v * reverse_signs(self.blades))))
            square[..., 0] -= 1.0
            unit = np.where(np.isin(np.arange(12), SIMILARITY_BLOCKS[2]), 1.0 + norm(v[..., list(SIMILARITY_BLOCKS[2])])[..., None], 1.0)
            defect = (np.abs(square) / unit).max(axis=-1) / np.maximum(size, 1.0) ** 2
        _refuse("similarity", defect, "Similarity.from_parts makes one from a translation, a rotation and a scale")

    @classmethod
    def from_parts(cls, translation: ArrayLike, rotation: Rotor | ArrayLike, scale: ArrayLike) -> Self:
        """x -> d R x + t from t (..., 3) (m), R as a Rotor or a rotation matrix (..., 3, 3), and d > 0 (...).

        Raises DegenerateError for d <= 0 and for what is no rotation, WrongSizeError, NotFiniteError.
        """
        t = read(translation, "translation", 3)
        rotor = rotation if isinstance(rotation, Rotor) else Rotor.from_matrix(rotation)
        d = _scale(scale)
        one_batch("similarity", t.shape[:-1], rotor.coefficients.shape[:-1], d.shape)
        r = parts(rotor.coefficients)
        shrunk = 1.0 / np.sqrt(d)
        return cls(stack(*similar(*_cosh_sinh(d), r, [shrunk * m for m in translated(parts(t), r)])))

    def translation(self) -> Array:
        """t (m), (..., 3)."""
        return self.log()[..., 4:]

    def rotation(self) -> Rotor:
        """The rotor R."""
        r = self.coefficients[..., list(SIMILARITY_BLOCKS[0])]
        return Rotor(times(1.0 / norm(r), r))

    def scale(self) -> Array:
        """The factor d, (...)."""
        rotor, even = (self.coefficients[..., list(block)] for block in SIMILARITY_BLOCKS[:2])
        return _squared_exponential(dot(rotor, even) / norm(rotor))

    def matrix(self) -> Array:
        """The homogeneous matrix [d R, t; 0, 1], (..., 4, 4)."""
        whole = np.zeros((*self.coefficients.shape[:-1], 4, 4))
        whole[..., :3, :3] = self.scale()[..., None, None] * self.rotation().matrix()
        whole[..., :3, 3], whole[..., 3, 3] = self.translation(), 1.0
        return whole


def _refuse(kind: str, defect: Array, remedy: str) -> None:
    """DegenerateError if V ~V is off by more than RIGID, or is not a number."""
    worst = defect.max(initial=0.0)
    if not worst <= RIGID:
        raise DegenerateError(f"{kind}: V ~V must be 1; it is off by {worst:.1e} (at most {RIGID:.0e}); {remedy}")


def _scale(scale: ArrayLike) -> Array:
    d = read(scale, "scale")
    if (d <= 0.0).any():
        raise DegenerateError(f"scale: {d.min():g} given, a number above 0 needed")
    return d


def _cosh_sinh(d: Array) -> tuple[Array, Array]:
    """cosh h and sinh h of h = log(d)/2, without a difference of near numbers."""
    s = np.sqrt(d)
    return 0.5 * (s + 1.0 / s), 0.5 * (d - 1.0) / s


def _squared_exponential(sinh: Array) -> Array:
    """e^(2 h) of sinh h."""
    size = np.abs(sinh)
    grown = (size + np.sqrt(1.0 + size * size)) ** 2
    return np.asarray(np.where(sinh < 0.0, 1.0 / grown, grown))
