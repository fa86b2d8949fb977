"""Kinematics and dynamics of a whole robot: what `Robot` offers beside its chains. Shapes: q (..., nq), v, a and tau (..., nv).

With a floating base q begins with its motor (8 numbers) and v with its twist in its own axes (linear, angular: 6 numbers, as in Pinocchio).
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime import workshop
from cga_runtime.errors import UnknownNameError
from cga_runtime.kernels import Kernel, Library
from cga_runtime.layout import Layout

Array = NDArray[np.float64]

TREE_KERNELS = (
    *("frames", "center_of_mass", "center_of_mass_jacobian", "inverse_dynamics", "bias", "gravity", "mass_matrix", "forward_dynamics"),
    *("coriolis", "inverse_dynamics_by_q", "inverse_dynamics_by_v"),
)


class WholeBody:
    """Kernels of a robot's tree of joints, each generated and compiled when it is first used."""

    _description: str
    _home: Library | None
    _record: dict[str, Any] | None
    layout: Layout

    def kernel(self, name: str) -> Kernel:
        """A kernel of the whole robot by name; UnknownNameError lists them."""
        if name not in self._kernels:
            if name not in TREE_KERNELS:
                raise UnknownNameError("kernel", name, TREE_KERNELS)
            if self._home is not None and self._record is not None and name in self._record["tree"]:
                unit = self._home.unit(self._record["tree"][name])
            else:
                unit = workshop.tree_unit(self._description, name)
            self._kernels[name] = unit.kernel(name)
        return self._kernels[name]

    @cached_property
    def _kernels(self) -> dict[str, Kernel]:
        return {}

    def casadi(self, name: str) -> Any:
        """The kernel as a casadi.Function with exact derivatives; every kernel name works. `frames` comes as (number of frames, 16)."""
        return self.kernel(name).casadi

    def frames(self, q: ArrayLike) -> Array:
        """Homogeneous matrices of all frames, (..., frames, 4, 4), in the order of `frame_names`, in the base (floating: in the world)."""
        return self.kernel("frames")(q)

    def center_of_mass(self, q: ArrayLike) -> Array:
        """Centre of mass (m) of all that moves, (..., 3), in the base frame (floating: in the world)."""
        return self.kernel("center_of_mass")(q)

    def center_of_mass_jacobian(self, q: ArrayLike) -> Array:
        """Its Jacobian, (..., 3, nv)."""
        return self.kernel("center_of_mass_jacobian")(q)

    def mass_matrix(self, q: ArrayLike) -> Array:
        """M(q), (..., nv, nv), symmetric in both halves, rotors (armature) included."""
        return self.kernel("mass_matrix")(q)

    def gravity(self, q: ArrayLike) -> Array:
        """g(q) (N m, N), (..., nv): what holds the robot still against gravity."""
        return self.kernel("gravity")(q)

    def bias(self, q: ArrayLike, v: ArrayLike) -> Array:
        """C(q, v) v + g(q), (..., nv): Pinocchio's nonLinearEffects, MuJoCo's qfrc_bias."""
        return self.kernel("bias")(q, v)

    def coriolis(self, q: ArrayLike, v: ArrayLike) -> Array:
        """C(q, v), (..., nv, nv), by Christoffel's symbols: dM/dt - 2 C is skew."""
        return self.kernel("coriolis")(q, v)

    def inverse_dynamics(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Array:
        """tau = M(q) a + C(q, v) v + g(q), (..., nv) (paper B, eqs. 37-49, as recursive Newton-Euler)."""
        return self.kernel("inverse_dynamics")(q, v, a)

    def inverse_dynamics_derivatives(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> tuple[Array, Array, Array]:
        """d tau/dq, d tau/dv and d tau/da = M, each (..., nv, nv); by q of a floating base: by motions in its own axes, as in Pinocchio."""
        return self.kernel("inverse_dynamics_by_q")(q, v, a), self.kernel("inverse_dynamics_by_v")(q, v), self.mass_matrix(q)

    def forward_dynamics(self, q: ArrayLike, v: ArrayLike, tau: ArrayLike) -> Array:
        """a = M^-1 (tau - C v - g), (..., nv). Raises DegenerateError where a joint carries no inertia."""
        return self.kernel("forward_dynamics")(q, v, tau)
