"""Logarithm, error and rates of a hypersphere's similarity over any scalar, and a hypersphere space's methods as casadi functions.

V = T(C) D(r) has components 1 e0i e1i e2i e3i e4i = (a, b, v), its twists rows e0i e1i e2i e3i e4i = (-d log r, dC/r).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from cga_runtime.coordinates import Array
from cga_runtime.errors import UnknownNameError
from cga_runtime.spaces.cooperative_kernels import Composed

Expression = Any
Scalar = Any
Scalars = Sequence[Scalar]


def logarithm(log: Callable[[Scalar], Scalar], parts: Scalars) -> list[Scalar]:
    """(-log r, C) of parts C, r."""
    *centre, radius = parts
    return [-log(radius), *centre]


def error(log: Callable[[Scalar], Scalar], parts: Scalars, target: Scalars) -> list[Scalar]:
    """(-log(r_d/r), (C_d - C)/r): the logarithm of ~V V_d by factors."""
    *centre, radius = parts
    *goal, size = target
    return [-log(size / radius), *((x - y) / radius for x, y in zip(goal, centre, strict=True))]


def error_rates(off: Scalars, rows: Scalars) -> list[Scalar]:
    """Rates of the error `off` from the rows of J_G."""
    growth, *moves = rows
    return [-growth, *(x * growth - move for x, move in zip(off[1:], moves, strict=True))]


def versor_rates(versor: Scalars, rows: Scalars) -> list[Scalar]:
    """dV = -1/2 V B for a row of twists B."""
    (a, b, *along), (growth, *moves) = versor, rows
    return [-0.5 * b * growth, -0.5 * a * growth, *(0.5 * (x * growth - (a + b) * move) for x, move in zip(along, moves, strict=True))]


class Symbols:
    """Expressions of a space over symbols q and target (C, r). constant: its lifts, or None for `length` times the affine dependency."""

    def __init__(self, source: Composed, constant: Array | None, length: float) -> None:
        import casadi

        self.source, self.length = source, length
        self.q, self.target = casadi.SX.sym("q", source.joints.n), casadi.SX.sym("target", 5)
        self.points = source.symbolic("points", self.q)
        self.balanced = constant is None
        self.lifts = length * self._only("dependency") if constant is None else casadi.SX(constant.tolist())

    def _only(self, name: str) -> Expression:
        """A kernel of the points alone."""
        return self.source.unit.kernel(name).symbolic(self.points)

    def kernel(self, name: str) -> Expression:
        """A kernel of points and lifts."""
        return self.source.unit.kernel(name).symbolic(self.points, self.lifts)

    def point_jacobian(self) -> Expression:
        return self.source.symbolic("point_jacobian", self.q)

    def insphere(self) -> Expression:
        return self._only("insphere")

    def insphere_gradient(self) -> Expression:
        return self.point_jacobian().T @ self._only("insphere_gradient")

    def geometric_jacobian(self) -> Expression:
        rows = self.kernel("geometric_jacobian")
        if self.balanced:
            rows = rows + self.length * self.kernel("geometric_jacobian_by_lifts") @ self._only("dependency_jacobian")
        return rows @ self.point_jacobian()

    def degeneracy_gradient(self) -> Expression:
        column = self.kernel("degeneracy_gradient")
        if self.balanced:
            column = column + self.length * self._only("dependency_jacobian").T @ self.kernel("degeneracy_gradient_by_lifts")
        return self.point_jacobian().T @ column

    def log(self) -> Expression:
        import casadi

        return casadi.vertcat(*logarithm(casadi.log, self.kernel("parts").elements()))

    def analytic_jacobian(self) -> Expression:
        import casadi

        return casadi.vertcat(*versor_rates(self.kernel("similarity").elements(), casadi.vertsplit(self.geometric_jacobian())))

    def error(self) -> Expression:
        import casadi

        return casadi.vertcat(*error(casadi.log, self.kernel("parts").elements(), self.target.elements()))

    def error_jacobian(self) -> Expression:
        import casadi

        return casadi.vertcat(*error_rates(self.error().elements(), casadi.vertsplit(self.geometric_jacobian())))

    def nullspace(self) -> Expression:
        import casadi

        across, _ = casadi.qr(self.geometric_jacobian().T)  # by J J^T digits would be lost twice
        return casadi.SX.eye(across.shape[0]) - across @ across.T

    def manipulability(self) -> Expression:
        import casadi

        _, triangle = casadi.qr(self.geometric_jacobian().T)
        whole: Expression = 1
        for k in range(triangle.shape[0]):
            whole = whole * triangle[k, k]
        return whole


KERNELS = ("primitive", "slice", "similarity", "degeneracy")
FUNCTIONS: dict[str, Callable[[Symbols], Expression]] = {
    "points": lambda system: system.points,
    "lifts": lambda system: system.lifts,
    "point_jacobian": Symbols.point_jacobian,
    "insphere": Symbols.insphere,
    "insphere_gradient": Symbols.insphere_gradient,
    "degeneracy_gradient": Symbols.degeneracy_gradient,
    "log": Symbols.log,
    "geometric_jacobian": Symbols.geometric_jacobian,
    "analytic_jacobian": Symbols.analytic_jacobian,
    "error": Symbols.error,
    "error_jacobian": Symbols.error_jacobian,
    "nullspace": Symbols.nullspace,
    "manipulability": Symbols.manipulability,
}
"""What stands on kernels."""
NAMES = (*KERNELS, *FUNCTIONS)
"""What there is as a casadi function."""


def function(system: Symbols, name: str) -> Any:
    """The method `name` as a casadi.Function of q, and of the target where it needs one. Raises UnknownNameError."""
    import casadi

    if name not in NAMES:
        raise UnknownNameError("function of a hypersphere space", name, NAMES)
    expression = system.kernel(name) if name in KERNELS else FUNCTIONS[name](system)
    inputs = {"q": system.q} | ({"target": system.target} if name.startswith("error") else {})
    return casadi.Function(name, list(inputs.values()), [casadi.densify(expression)], list(inputs), [name])
