"""Motors: rigid motions as versors M = T(t) R of CGA (paper A, eqs. 18, 62-67; paper B, eqs. 5-9). Products are the generated ones."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, norm, parts, read, stack, times, unit
from cga_runtime.errors import DegenerateError
from cga_runtime.exp_log import BLADES
from cga_runtime.kernels import products
from cga_runtime.multivectors import reverse_signs
from cga_runtime.versor_group import RIGID as RIGID
from cga_runtime.versor_group import Versor

REVERSE = reverse_signs(BLADES["motor"])
"""Signs of ~M in the components of M."""


@dataclass(frozen=True, eq=False)
class Motor(Versor, group="motor"):
    """A rigid motion x -> M x ~M, components 1 e12 e13 e23 e1i e2i e3i e123i, (..., 8); M and -M are the same motion.

    Raises DegenerateError where M ~M is not 1, WrongSizeError, NotFiniteError.
    """

    coefficients: Array

    def __post_init__(self) -> None:
        coefficients = read(self.coefficients, "motor", 8)
        object.__setattr__(self, "coefficients", coefficients)
        a, b12, b13, b23, e1i, e2i, e3i, e123i = parts(coefficients)
        # M ~M = scalar + 2 (a e123i - b12 e3i + b13 e2i - b23 e1i) e123i
        scalar = np.abs(a * a + b12 * b12 + b13 * b13 + b23 * b23 - 1.0).max(initial=0.0)
        mixed = np.abs(a * e123i - b12 * e3i + b13 * e2i - b23 * e1i)
        pseudoscalar = (mixed / (1.0 + norm(coefficients[..., 4:]))).max(initial=0.0)
        if max(scalar, pseudoscalar) > RIGID:
            raise DegenerateError(
                f"motor: M ~M must be 1; its scalar part is off by {scalar:.1e}, its e123i part by {2 * pseudoscalar:.1e} "
                f"(at most {RIGID:.0e}); Motor.from_pose makes a motor from a matrix"
            )

    @classmethod
    def from_pose(cls, pose: ArrayLike) -> Self:
        """The motor of a homogeneous matrix (..., 4, 4), with scalar part >= 0.

        Raises DegenerateError for a matrix that is not a rotation and a translation.
        """
        matrix = read(pose, "pose", 4, 4)
        rotation, translation = matrix[..., :3, :3], matrix[..., :3, 3]
        rotor = rotor_of_rotation(rotation, "pose")
        if (matrix[..., 3, :] != (0.0, 0.0, 0.0, 1.0)).any():
            raise DegenerateError("pose: its last row must be 0 0 0 1")
        translator = np.moveaxis(np.concatenate([np.ones_like(translation[..., :1]), -0.5 * translation], axis=-1), -1, 0)
        return cls(stack(*products().translator_rotor(translator, parts(rotor))))

    def pose(self) -> Array:
        """Homogeneous matrix, (..., 4, 4)."""
        a, b12, b13, b23, *_ = parts(self.coefficients)
        w, x, y, z = a, -b23, b13, -b12  # the quaternion w + x i + y j + z k
        position = products().motor_origin_position(parts(self.coefficients))
        rows = [
            stack(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), position[0]),
            stack(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), position[1]),
            stack(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), position[2]),
            stack(0 * w, 0 * w, 0 * w, 0 * w + 1),
        ]
        return np.stack(rows, axis=-2)


def rotor_of_rotation(rotation: Array, what: str) -> Array:
    """Rotor components 1 e12 e13 e23 (..., 4) of the 3x3 block of a `what`, scalar part >= 0. Raises DegenerateError for no rotation."""
    error = np.abs(np.swapaxes(rotation, -1, -2) @ rotation - np.eye(3)).max(initial=0.0)
    if error > RIGID:
        raise DegenerateError(f"{what}: its 3x3 block is not a rotation, R^T R is off by {error:.1e} (at most {RIGID:.0e})")
    if (np.linalg.det(rotation) < 0.0).any():
        raise DegenerateError(f"{what}: its 3x3 block is a reflection (determinant -1), not a rotation")
    xx, xy, xz, yx, yy, yz, zx, zy, zz = parts(rotation.reshape(*rotation.shape[:-2], 9))
    # four times the quaternion (w, x, y, z), times one of its components; the row of the largest component is accurate
    rows = [
        stack(1 + xx + yy + zz, zy - yz, xz - zx, yx - xy),
        stack(zy - yz, 1 + xx - yy - zz, xy + yx, xz + zx),
        stack(xz - zx, xy + yx, 1 - xx + yy - zz, yz + zy),
        stack(yx - xy, xz + zx, yz + zy, 1 - xx - yy + zz),
    ]
    table = np.stack(rows, axis=-2)
    largest = np.argmax(np.diagonal(table, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(table, largest[..., None, None], axis=-2)[..., 0, :]
    w, x, y, z = parts(unit(row, "rotation"))
    return times(np.where(w < 0.0, -1.0, 1.0), stack(w, -z, y, -x))
