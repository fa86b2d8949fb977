"""A cooperative system's methods as casadi functions, put together from the expressions of its kernels."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from cga_runtime.elements.charts import SEAM
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.smooth import casadi_field
from cga_runtime.spaces.cooperative_kernels import BY_POINTS, OF_POINTS, RATES, Source
from cga_runtime.spaces.primitive_kinds import Primitive
from cga_runtime.spaces.similarity_twists import (
    Parts,
    log_rate_of_body,
    log_rate_of_space,
    logarithm,
    parts_of,
    relative,
    space_twist,
    turned,
)

Expression = Any


class _System:
    """Expressions of one system over symbols q, v, V_d in one chart."""

    def __init__(self, about: Primitive, source: Source, n: int, chart: float | None, towards_target: bool) -> None:
        import casadi

        self.about, self.source = about, source
        self.field = replace(casadi_field(), pairs=False)
        self.q, self.v, self.target = casadi.SX.sym("q", n), casadi.SX.sym("v", n), casadi.SX.sym("target", 12)
        self.chart: Any = 1.0 if about.reference is None else chart
        if self.chart is None:
            height = self._target_height() if towards_target else source.symbolic("guard", self.q)[1]
            self.chart = casadi.if_else(height < SEAM, -1.0, 1.0)

    def _target_height(self) -> Expression:
        """Cosine between the direction of the target and the reference direction."""
        rotor, _, _ = parts_of(self.field, self.target.elements())
        reference = [float(x) for x in self.about.reference]  # type: ignore[union-attr]  # only asked of those that have one
        return sum(x * y for x, y in zip(reference, turned(rotor, reference), strict=True))

    def kernel(self, name: str) -> Expression:
        return self.source.symbolic(name, self.q, self.chart, self.v)

    def parts(self) -> Parts:
        entries = self.kernel("parts").elements()
        return entries[:4], entries[4:7], entries[7]

    def log(self) -> Expression:
        return _column(logarithm(self.field, self.parts()))

    def bivector_jacobian(self) -> Expression:
        return _stacked(log_rate_of_body(self.field, self.parts(), _rows(self.kernel("geometric_jacobian"))))

    def space_jacobian(self) -> Expression:
        return _stacked(space_twist(self.parts(), _rows(self.kernel("geometric_jacobian"))))

    def _off(self) -> Parts:
        return relative(self.field, self.parts(), parts_of(self.field, self.target.elements()))

    def error(self) -> Expression:
        return _column(logarithm(self.field, self._off()))

    def error_jacobian(self) -> Expression:
        return _stacked(log_rate_of_space(self.field, self._off(), _rows(-self.kernel("geometric_jacobian"))))

    def _moving(self) -> Expression:
        return self.kernel("horizontal_jacobian")[self.about.rows, :]

    def nullspace(self) -> Expression:
        import casadi

        rows = self._moving()
        if rows.shape[1] < rows.shape[0]:
            raise WrongSizeError(f"nullspace: {rows.shape[1]} joints move a primitive of dimension {rows.shape[0]}; numpy's serves there")
        across, _ = casadi.qr(rows.T)  # J J^T would lose digits twice
        return casadi.SX.eye(across.shape[0]) - across @ across.T

    def manipulability(self) -> Expression:
        import casadi

        rows = self._moving()
        if rows.shape[1] < rows.shape[0]:
            return casadi.SX.zeros(1)
        _, triangle = casadi.qr(rows.T)
        whole: Expression = 1
        for k in range(triangle.shape[0]):
            whole = whole * triangle[k, k]
        return whole

    def manipulability_gradient(self) -> Expression:
        import casadi

        return casadi.gradient(self.manipulability(), self.q)


def _column(values: Any) -> Expression:
    import casadi

    return casadi.vertcat(*values)


def _stacked(rows: Any) -> Expression:
    import casadi

    return casadi.vertcat(*rows)


def _rows(matrix: Any) -> list[Expression]:
    return [matrix[k, :] for k in range(matrix.shape[0])]


PUT_TOGETHER: dict[str, Callable[[_System], Expression]] = {
    "log": _System.log,
    "bivector_jacobian": _System.bivector_jacobian,
    "space_jacobian": _System.space_jacobian,
    "error": _System.error,
    "error_jacobian": _System.error_jacobian,
    "nullspace": _System.nullspace,
    "manipulability": _System.manipulability,
    "manipulability_gradient": _System.manipulability_gradient,
}
"""What is no kernel but stands on kernels."""
NAMES = ("points", "point_jacobian", *(name for name in OF_POINTS if name != "guard"), *BY_POINTS, *RATES, *PUT_TOGETHER)
"""What there is as a casadi function."""


def function(about: Primitive, source: Source, name: str, n: int, chart: float | None) -> Any:
    """The method `name` as a casadi.Function of q, and v or target where it needs them. Raises UnknownNameError, WrongSizeError."""
    import casadi

    if name not in NAMES:
        raise UnknownNameError("function of a cooperative system", name, NAMES)
    system = _System(about, source, n, chart, name.startswith("error"))
    expression = PUT_TOGETHER[name](system) if name in PUT_TOGETHER else system.kernel(name)
    inputs = [("q", system.q)]
    if name in RATES:
        inputs.append(("v", system.v))
    if name.startswith("error"):
        inputs.append(("target", system.target))
    return casadi.Function(name, [symbol for _, symbol in inputs], [casadi.densify(expression)], [key for key, _ in inputs], [name])
