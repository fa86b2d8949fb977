"""Where the kernels of a cooperative system come from: put together from those of its chains and of its primitive, or fused for the system.

Both give the same values under the same names (see `Source`), as numbers and as casadi expressions.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np

from cga_runtime.coordinates import Array
from cga_runtime.kernels import Unit, generated_folder, library
from cga_runtime.robot import Chain
from cga_runtime.spaces.joints import JointSpace
from cga_runtime.workshop import TeamOrder, team_unit

OF_POINTS = ("primitive", "similarity", "parts", "degeneracy", "guard")
"""Kernels whose values depend on the points alone."""
BY_POINTS = ("primitive_jacobian", "analytic_jacobian", "geometric_jacobian", "horizontal_jacobian", "degeneracy_gradient")
"""Derivatives by the points, which the Jacobian of the points turns into derivatives by q."""
RATES = {f"{frame}_jacobian_derivative": f"{frame}_jacobian" for frame in ("geometric", "horizontal")}
"""Time derivatives of such Jacobians."""
NAMES = ("points", "point_jacobian", *OF_POINTS, *BY_POINTS, *RATES)
"""What a source gives."""


class Source(Protocol):
    """The kernels of a system by name. chart: +1 or -1, (...); v: velocities, for RATES."""

    def value(self, name: str, q: Array, chart: Array | None = None, v: Array | None = None) -> Array:
        """Numbers, with the leading dimensions of q."""

    def symbolic(self, name: str, q: Any, chart: Any = 1.0, v: Any = None) -> Any:
        """An expression of casadi symbols."""


def primitive_unit(kind: str) -> Unit:
    """Kernels of a primitive over its points; they came with the package."""
    return library(generated_folder()).unit(f"algebra/cooperative_{kind}")


class Composed:
    """Kernels of the chains, then those of the primitive, then the product of both Jacobians."""

    def __init__(self, kind: str, chains: Sequence[Chain], joints: JointSpace) -> None:
        self.chains, self.joints, self.unit = tuple(chains), joints, primitive_unit(kind)

    def points(self, q: Array) -> Array:
        """(..., k, 3)."""
        return np.stack([chain.point(q[..., index]) for chain, index in zip(self.chains, self.joints.index, strict=True)], axis=-2)

    def point_jacobian(self, q: Array) -> Array:
        """(..., 3 k, n)."""
        return self._rows([chain.jacobian(q[..., index]) for chain, index in zip(self.chains, self.joints.index, strict=True)])

    def point_jacobian_derivative(self, q: Array, v: Array) -> Array:
        """(..., 3 k, n) along q' = v."""
        pairs = zip(self.chains, self.joints.index, strict=True)
        return self._rows([chain.jacobian_derivative(q[..., index], v[..., index]) for chain, index in pairs])

    def _rows(self, jacobians: Sequence[Array]) -> Array:
        return np.concatenate([self.joints.spread(jacobian[..., :3, :], k) for k, jacobian in enumerate(jacobians)], axis=-2)

    def value(self, name: str, q: Array, chart: Array | None = None, v: Array | None = None) -> Array:
        points = self.points(q)
        if name == "points":
            return points
        if name == "point_jacobian":
            return self.point_jacobian(q)
        if name in OF_POINTS:
            return self.of_points(name, points, chart)
        if name in BY_POINTS:
            by_points = self.of_points(name, points, chart)
            jacobian = self.point_jacobian(q)
            if by_points.ndim == points.ndim - 1:  # a gradient
                return np.asarray((by_points[..., None, :] @ jacobian)[..., 0, :])
            return np.asarray(by_points @ jacobian)
        assert v is not None and name in RATES
        jacobian = self.point_jacobian(q)
        velocities = (jacobian @ v[..., None])[..., 0].reshape(points.shape)
        moving = self.of_points(name, points, chart, velocities)
        return np.asarray(moving @ jacobian + self.of_points(RATES[name], points, chart) @ self.point_jacobian_derivative(q, v))

    def of_points(self, name: str, points: Array, chart: Array | None, *more: Array) -> Array:
        """A kernel of the primitive at points (..., k, 3)."""
        kernel = self.unit.kernel(name)
        sense = np.ones(points.shape[:-2]) if chart is None else np.broadcast_to(chart, points.shape[:-2])
        given = [points, *([sense[..., None]] if "chart" in kernel.inputs else []), *more]
        return kernel(*given)

    def symbolic(self, name: str, q: Any, chart: Any = 1.0, v: Any = None) -> Any:
        import casadi

        own = [q[[int(k) for k in index]] for index in self.joints.index]
        points = casadi.vertcat(*[chain.kernel("point").symbolic(x).T for chain, x in zip(self.chains, own, strict=True)])
        if name == "points":
            return points
        if name in OF_POINTS:
            return self._at_points(name, points, chart)
        jacobian = self._spread([chain.kernel("jacobian").symbolic(x) for chain, x in zip(self.chains, own, strict=True)])
        if name == "point_jacobian":
            return jacobian
        if name in BY_POINTS:
            by_points = self._at_points(name, points, chart)
            return (by_points.T @ jacobian).T if by_points.shape[1] == 1 else by_points @ jacobian
        velocities = casadi.reshape(jacobian @ v, 3, -1).T
        rates = [v[[int(k) for k in index]] for index in self.joints.index]
        triples = zip(self.chains, own, rates, strict=True)
        moving = self._spread([chain.kernel("jacobian_derivative").symbolic(x, rate) for chain, x, rate in triples])
        return self._at_points(name, points, chart, velocities) @ jacobian + self._at_points(RATES[name], points, chart) @ moving

    def _at_points(self, name: str, points: Any, chart: Any, *more: Any) -> Any:
        kernel = self.unit.kernel(name)
        return kernel.symbolic(points, *([chart] if "chart" in kernel.inputs else []), *more)

    def _spread(self, jacobians: Sequence[Any]) -> Any:
        """Linear rows of the chains' Jacobians over all joints."""
        import casadi

        rows = []
        for jacobian, index in zip(jacobians, self.joints.index, strict=True):
            whole = casadi.SX.zeros(3, self.joints.n)
            whole[:, [int(k) for k in index]] = jacobian[:3, :]
            rows.append(whole)
        return casadi.vertcat(*rows)


class Fused:
    """Kernels made for one system: one pass from q to the result. Generated at first use and kept in the cache."""

    def __init__(self, kind: str, chains: Sequence[Chain], joints: JointSpace) -> None:
        kinds = ["revolute"] * joints.n
        for chain, index in zip(chains, joints.index, strict=True):
            for place, of_joint in zip(index, chain.joint_kinds, strict=True):
                kinds[place] = of_joint
        places = tuple(tuple(int(k) for k in index) for index in joints.index)
        self.unit = team_unit(TeamOrder(kind, tuple(chain.order for chain in chains), places, joints.joint_names, tuple(kinds)))

    def value(self, name: str, q: Array, chart: Array | None = None, v: Array | None = None) -> Array:
        kernel = self.unit.kernel(name)
        sense = np.ones(q.shape[:-1]) if chart is None else np.broadcast_to(chart, q.shape[:-1])
        given = {"q": q, "v": v, "chart": sense[..., None]}
        return kernel(*[given[key] for key in kernel.inputs])  # type: ignore[arg-type]

    def symbolic(self, name: str, q: Any, chart: Any = 1.0, v: Any = None) -> Any:
        kernel = self.unit.kernel(name)
        given = {"q": q, "v": v, "chart": chart}
        return kernel.symbolic(*[given[key] for key in kernel.inputs])
