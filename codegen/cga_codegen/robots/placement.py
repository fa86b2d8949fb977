"""Rigid placements and inertias as plain tuples of floats: immutable, compared by value, to JSON and back without loss.

A placement maps coordinates of the child frame to the parent frame: x_parent = R x_child + p (metres).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

Vector3 = tuple[float, float, float]
Rows3 = tuple[Vector3, Vector3, Vector3]
Tensor = tuple[float, float, float, float, float, float]

ROTATION_TOLERANCE = 1e-9
"""Largest entry of R^T R - 1 that a file may have; beyond it the rotation is refused, not repaired."""
ROUNDING = 1e-15
"""A whole rotation this close to a signed permutation is that permutation after rounding (cos(pi/2) is 6e-17, not 0)."""


class ModelError(ValueError):
    """A robot description that cannot be represented; the message names the element and what is accepted."""


def as_vector(values: Iterable[float], what: str) -> Vector3:
    """Three finite floats, or a ModelError that names `what`."""
    numbers = tuple(float(x) + 0.0 for x in values)
    if len(numbers) != 3 or not np.all(np.isfinite(numbers)):
        raise ModelError(f"{what}: {numbers} given, three finite numbers are needed")
    return numbers


def as_rotation(rows: Any, what: str, snap: float = ROUNDING) -> Rows3:
    """A checked rotation: orthonormal to ROTATION_TOLERANCE with determinant +1, else a ModelError.

    A rotation within `snap` of a signed permutation matrix becomes that matrix as a whole. Snapping single entries would leave SO(3)
    (measured: 4e-8 off on one robot), so either all nine entries are replaced or none.
    """
    r: NDArray[np.float64] = np.array(rows, dtype=np.float64)
    if r.shape != (3, 3) or not np.all(np.isfinite(r)):
        raise ModelError(f"{what}: a rotation is a finite 3x3 matrix, got shape {r.shape}")
    defect = float(np.abs(r.T @ r - np.eye(3)).max())
    if defect > ROTATION_TOLERANCE or np.linalg.det(r) < 0:
        raise ModelError(f"{what}: not a rotation (R^T R - 1 is {defect:.1e}, det {np.linalg.det(r):+.3f})")
    snapped = np.round(r)
    if np.abs(r - snapped).max() <= snap and np.array_equal(snapped.T @ snapped, np.eye(3)):
        r = snapped
    r = r + 0.0  # -0.0 would print as "-0.0" and break byte-for-byte determinism
    return cast(Rows3, tuple(tuple(float(x) for x in row) for row in r))


@dataclass(frozen=True)
class Placement:
    """Rigid placement x_parent = rotation x_child + translation."""

    rotation: Rows3 = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    translation: Vector3 = (0.0, 0.0, 0.0)

    @classmethod
    def from_matrix(cls, matrix: Any, what: str = "placement") -> Placement:
        """From a 4x4 homogeneous matrix; refuses anything that is not a rigid motion."""
        try:
            m = np.array(matrix, dtype=np.float64)
        except (TypeError, ValueError):  # words, rows of several lengths
            m = np.empty(0)
        if m.shape != (4, 4) or not np.array_equal(m[3], [0.0, 0.0, 0.0, 1.0]):
            raise ModelError(f"{what}: a 4x4 matrix with last row 0 0 0 1 is needed")
        return cls(as_rotation(m[:3, :3], what), as_vector(m[:3, 3], what))

    @classmethod
    def turn(cls, axis: Sequence[float], angle: float) -> Placement:
        """The rotation by an angle (rad) about a unit axis (Rodrigues)."""
        a = np.array(axis, dtype=np.float64)
        x, y, z = a
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        rotation = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (np.outer(a, a) - np.eye(3))
        return cls(as_rotation(rotation, "turn"))

    @classmethod
    def shift(cls, axis: Sequence[float], length: float) -> Placement:
        """The translation by a length (m) along a unit axis."""
        return cls(translation=as_vector([length * x for x in axis], "shift"))

    def matrix(self) -> NDArray[np.float64]:
        """The 4x4 homogeneous matrix."""
        m = np.eye(4)
        m[:3, :3], m[:3, 3] = self.rotation, self.translation
        return m

    def __matmul__(self, other: Placement) -> Placement:
        r, p = np.array(self.rotation), np.array(self.translation)
        return Placement(
            as_rotation(r @ np.array(other.rotation), "composed placement"),
            as_vector(r @ np.array(other.translation) + p, "composed placement"),
        )

    def inverse(self) -> Placement:
        """The placement of the parent in the child."""
        rt = np.array(self.rotation).T
        return Placement(as_rotation(rt, "inverse placement"), as_vector(-rt @ np.array(self.translation), "inverse placement"))

    def snapped(self, tolerance: float) -> Placement:
        """The same, with a rotation within `tolerance` of a signed permutation replaced by it."""
        return Placement(as_rotation(self.rotation, "placement", tolerance), self.translation)


@dataclass(frozen=True)
class Inertia:
    """Mass (kg), centre of mass in the joint frame (m), inertia about the centre of mass (xx, xy, xz, yy, yz, zz; kg m^2)."""

    mass: float
    com: Vector3
    tensor: Tensor

    def matrix(self) -> NDArray[np.float64]:
        """The inertia about the centre of mass, 3x3 (kg m^2)."""
        xx, xy, xz, yy, yz, zz = self.tensor
        return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])

    @classmethod
    def from_matrix(cls, mass: float, com: Any, matrix: Any) -> Inertia:
        """From the symmetric 3x3 matrix about the centre of mass."""
        entries = [float(matrix[i, k]) + 0.0 for i, k in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))]
        return cls(float(mass), as_vector(com, "centre of mass"), cast(Tensor, tuple(entries)))

    def placed(self, at: Placement) -> Inertia:
        """The same body seen from the frame in which its frame has the placement `at`."""
        r = np.array(at.rotation)
        if np.array_equal(r, np.eye(3)):  # to the last digit
            com = np.array(self.com) + at.translation
            return Inertia(self.mass, as_vector(com, "centre of mass"), self.tensor)
        return Inertia.from_matrix(self.mass, r @ self.com + at.translation, r @ self.matrix() @ r.T)


def merged(parts: Sequence[Inertia]) -> Inertia:
    """Bodies held together rigidly: m = sum m_i, c = sum m_i c_i / m, I = sum I_i + m_i (|d|^2 1 - d d^T), d = c_i - c (parallel axes).

    A body alone keeps its numbers to the last digit.
    """
    if len(parts) == 1:
        return parts[0]
    mass = sum(part.mass for part in parts)
    com = sum((part.mass * np.array(part.com) for part in parts), np.zeros(3)) / mass if mass > 0.0 else np.array(parts[0].com)
    tensor = np.zeros((3, 3))
    for part in parts:
        d = np.array(part.com) - com
        tensor = tensor + part.matrix() + part.mass * (np.sum(d * d) * np.eye(3) - np.outer(d, d))
    return Inertia.from_matrix(mass, com, tensor)
