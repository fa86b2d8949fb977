"""Two arms that hold one rigid object: the closed chain of paper C, its closure and its determinants. Analyses stand on it.

Joints are numbered 1..n through both arms, the first (right) arm before the second; q is (..., n) in that order. Both chains have a
common root frame. Twists and wrenches are about that frame's origin.
"""

from __future__ import annotations

from collections.abc import Sequence
from operator import index
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import count
from cga_runtime.errors import GraspError, SchemeError, WrongSizeError
from cga_runtime.kernels import Kernel, finite, generated_folder, library, products
from cga_runtime.motors import REVERSE, Motor
from cga_runtime.robot import Chain, shared_joints

Array = NDArray[np.float64]

LENGTH = 0.1
"""Characteristic length (m) of determinants: moment rows are divided by it."""
CLOSED = 1e-8
"""Largest closure error (bivector coefficients of M_R X ~M_L) of a configuration that counts as closed."""


class ClosedLoop:
    """Two chains that grasp one object; users meet it as `cga.ClosedChain`, with its analyses as methods.

    Raises GraspError if they share joints, or have fewer than seven joints together.
    """

    def __init__(self, right: Chain, left: Chain) -> None:
        for chain in (right, left):
            if not isinstance(chain, Chain):
                raise GraspError(f"a closed chain needs two Chains, {type(chain).__name__} given")
        if right.order.root != left.order.root:
            roots = " and ".join(repr(chain.order.root or "the base") for chain in (right, left))
            raise GraspError(f"the two chains begin in different frames ({roots}): a closed chain needs a common root")
        shared = shared_joints(right, left)
        if shared:
            raise GraspError(f"the two arms share joints ({', '.join(sorted(shared))}): a closed chain needs separate arms")
        if right.n + left.n <= 6:
            raise GraspError(f"{right.n} + {left.n} joints hold an object rigidly: a closed chain needs more than six")
        self.right, self.left = right, left
        self.unit = right.robot.loop_unit(right, left)
        self.n = right.n + left.n
        self.joint_names = (*right.joint_names, *left.joint_names)
        self.lower, self.upper = np.concatenate([right.lower, left.lower]), np.concatenate([right.upper, left.upper])

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.right.frame} + {self.left.frame}: {self.n} joints>"

    def __eq__(self, other: object) -> bool:
        """Closed chains are equal where their kernels and limits are: what was built for one serves the other."""
        return isinstance(other, ClosedLoop) and self.unit is other.unit and bool((self._limits() == other._limits()).all())

    def __hash__(self) -> int:
        return hash(self.unit)

    def _limits(self) -> Array:
        return np.stack([self.lower, self.upper])

    @property
    def actuators(self) -> int:
        """Joints that an actuation scheme actuates: the generic mobility n - 6."""
        return self.n - 6

    def kernel(self, name: str) -> Kernel:
        """A kernel of the loop by name; UnknownNameError lists them."""
        return self.unit.kernel(name)

    def casadi(self, name: str) -> Any:
        """A kernel of the loop as a casadi.Function with exact derivatives."""
        return self.kernel(name).casadi

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform joint positions inside the limits, shape (size..., n): free grasps (each pose defines its own grasp)."""
        shape = () if size is None else tuple(size) if isinstance(size, Sequence) else (count(size, "size"),)
        return np.concatenate([self.right.random(rng, shape), self.left.random(rng, shape)], axis=-1)

    def check(self, q: ArrayLike) -> Array:
        """q as a finite array (..., n). Raises WrongSizeError, NotFiniteError."""
        array = finite(q, "q")
        if array.ndim == 0 or array.shape[-1] != self.n:
            raise WrongSizeError(f"q: shape {array.shape} given, (..., {self.n}) needed: {', '.join(self.joint_names)}")
        return array

    def check_one(self, q: ArrayLike) -> Array:
        """q as one finite configuration (n,), for questions that have no batch. Raises WrongSizeError, NotFiniteError."""
        array = self.check(q)
        if array.ndim != 1:
            raise WrongSizeError(f"one configuration of shape ({self.n},) needed, {array.shape} given")
        return array

    def screws(self, q: ArrayLike) -> Array:
        """World screws of all joints as bivectors e12 e13 e23 e1i e2i e3i, (..., 6, n)."""
        return self.kernel("screws")(q)

    def twists(self, q: ArrayLike) -> Array:
        """The same screws as (w, v) about the root frame's origin, (..., 6, n)."""
        rows = self.screws(q)
        return np.stack([rows[..., 2, :], -rows[..., 1, :], rows[..., 0, :], *(rows[..., i, :] for i in (3, 4, 5))], axis=-2)

    def grasp(self, q: ArrayLike) -> Array:
        """The grasp motor X = ~M_R M_L, (..., 8), that closes the loop at q (the left hand's pose in the right hand's frame)."""
        q = self.check(q)
        right, left = self.right.motor(q[..., : self.right.n]), self.left.motor(q[..., self.right.n :])
        product = products().motor_motor(np.moveaxis(right * REVERSE, -1, 0), np.moveaxis(left, -1, 0))
        return np.stack(product, axis=-1)

    def closure_error(self, q: ArrayLike, grasp: ArrayLike) -> Array:
        """Bivector coefficients (..., 6) of M_R X ~M_L; zero exactly when the arms hold the grasp X. DegenerateError if X is no motor."""
        error = self.kernel("closure_error")(q, grasp)
        Motor(np.asarray(grasp))  # what is no motor can have no error and hold nothing
        return error

    def require_closed(self, q: ArrayLike, grasp: ArrayLike) -> Array:
        """q, or GraspError where the arms do not hold the grasp within CLOSED."""
        error = float(np.abs(self.closure_error(q, grasp)).max(initial=0.0))
        if error > CLOSED:
            raise GraspError(f"the loop is not closed (error {error:.1e}, at most {CLOSED:.0e}); loop.grasp(q) is the grasp of q")
        return self.check(q)

    def scheme(self, actuated: Sequence[int]) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Checked actuated and passive joints of a scheme, 0-based and ascending. Raises SchemeError."""
        try:
            joints = tuple(index(j) for j in actuated)  # integers of any kind; 4.5 and "4" are not rounded or read
        except TypeError:
            raise SchemeError(f"scheme {actuated!r}: {self.actuators} joint numbers are needed") from None
        if len(set(joints)) != self.actuators or len(joints) != self.actuators or not all(1 <= j <= self.n for j in joints):
            raise SchemeError(f"scheme {joints}: {self.actuators} distinct joint numbers from 1 to {self.n} are needed")
        chosen = tuple(sorted(j - 1 for j in joints))
        return chosen, tuple(j for j in range(self.n) if j not in chosen)

    def determinant(self, q: ArrayLike, actuated: Sequence[int]) -> Array:
        """det[s_j, j passive] of the screws (w, v / LENGTH), columns ascending, shape (...): zero exactly at actuation singularities."""
        _, passive = self.scheme(actuated)
        value = _brackets().kernel("bracket")(self.screws(q)[..., :, list(passive)])[..., 0] / LENGTH**3
        return np.asarray(value)

    def determinant_gradient(self, q: ArrayLike, actuated: Sequence[int]) -> Array:
        """Analytic gradient of `determinant`, (..., n): sum over passive j > k of the same arm of det(s_j replaced by [s_k, s_j])."""
        _, passive = self.scheme(actuated)
        screws = self.screws(q)
        weights = np.zeros_like(screws)
        weights[..., :, list(passive)] = _brackets().kernel("bracket_cofactors")(screws[..., :, list(passive)])
        return self.kernel("screws_pullback")(q, weights) / LENGTH**3

    def symbolic_determinant(self, q: Any, actuated: Sequence[int]) -> Any:
        """`determinant` at a casadi SX q."""
        _, passive = self.scheme(actuated)
        return _brackets().kernel("bracket").symbolic(self.kernel("screws").symbolic(q)[:, list(passive)]) / LENGTH**3


def _brackets() -> Any:
    return library(generated_folder()).unit("algebra/screws")
