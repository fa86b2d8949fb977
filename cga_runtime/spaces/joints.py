"""The joints of several chains as one q: joints that chains share, such as the waist of a humanoid, stand in it once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime.coordinates import Array, count
from cga_runtime.errors import ChainError, UnknownNameError, WrongSizeError
from cga_runtime.kernels import finite
from cga_runtime.robot import Chain


@dataclass(frozen=True, eq=False)
class JointSpace:
    """The distinct joints of k chains, those of the first chain first, then those of each next one that are new. Made by `JointSpace.of`.

    n: numbers in q. index: for each chain the places of its joints in q; the chain's own q is q[..., index[k]]. lower, upper,
    velocity_limit (n,): the chains' own, of a shared joint the narrowest. joint_names: the joints' own where they all differ, else with the
    number of their robot in order of first appearance, "1:panda_joint1", "2:panda_joint1".
    """

    n: int
    joint_names: tuple[str, ...]
    lower: Array
    upper: Array
    velocity_limit: Array
    index: tuple[NDArray[np.intp], ...]

    @classmethod
    def of(cls, chains: Sequence[Chain]) -> Self:
        """The joints of one or more chains. Chains belong to one robot if its description and placement are the same.

        Raises WrongSizeError (no chain), UnknownNameError (what is no Chain), ChainError (a floating base; chains of one robot that begin
        in different frames, so that their end points have no common frame).
        """
        if not chains:
            raise WrongSizeError("no chains given, at least one needed")
        roots: dict[tuple[Any, ...], str | None] = {}
        places: dict[tuple[int, str], int] = {}
        index = []
        for chain in chains:
            if not isinstance(chain, Chain):
                raise UnknownNameError("chain", type(chain).__name__, ("a Chain, from Robot.chain",))
            if chain.layout.floating:
                raise ChainError(f"{chain!r}: its base floats, a joint space needs fixed ones: Robot.chain(frame, root=...)")
            robot = (chain.order.description, chain.order.placement)
            root = roots.setdefault(robot, chain.order.root)
            if root != chain.order.root:
                begins = " and ".join(repr(name or "the base") for name in (root, chain.order.root))
                raise ChainError(f"chains of {chain.robot.name} begin in different frames ({begins}): they need a common root")
            number = list(roots).index(robot) + 1
            index.append(np.array([places.setdefault((number, name), len(places)) for name in chain.joint_names], dtype=np.intp))
        names = [name for _, name in places]
        if len(set(names)) < len(names):
            names = [f"{number}:{name}" for number, name in places]
        lower, upper, velocity = np.full(len(names), -math.inf), np.full(len(names), math.inf), np.full(len(names), math.inf)
        for chain, place in zip(chains, index, strict=True):
            lower[place] = np.maximum(lower[place], chain.lower)
            upper[place] = np.minimum(upper[place], chain.upper)
            velocity[place] = np.minimum(velocity[place], chain.velocity_limit)
        return cls(len(names), tuple(names), lower, upper, velocity, tuple(index))

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits (joints without limits: within +-pi), shape (size..., n)."""
        shape = () if size is None else tuple(size) if isinstance(size, Sequence) else (count(size, "size"),)
        low, high = np.where(np.isfinite(self.lower), self.lower, -math.pi), np.where(np.isfinite(self.upper), self.upper, math.pi)
        return np.asarray(rng.uniform(low, high, (*shape, self.n)))

    def check(self, q: ArrayLike) -> Array:
        """q as a finite array (..., n). Raises WrongSizeError, NotFiniteError."""
        array = finite(q, "q")
        if array.shape[-1:] != (self.n,):
            raise WrongSizeError(f"q: shape {array.shape} given, (..., {self.n}) needed: {', '.join(self.joint_names)}")
        return array

    def spread(self, jacobian: Array, k: int) -> Array:
        """A Jacobian (..., m, n_k) of the k-th chain over all joints, (..., m, n): zero for those of other chains."""
        whole = np.zeros((*jacobian.shape[:-1], self.n))
        whole[..., self.index[k]] = jacobian
        return whole
