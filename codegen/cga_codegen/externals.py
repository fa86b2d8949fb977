"""Kernels as functions for optimisers: the value, and first and second derivatives by every input, each lowered by itself.

A derivative is analytic where there is one (the table ANALYTIC), else casadi's automatic differentiation over the inputs of the body, with
the chain rule through them written here: of a turning joint dc = -s dq and ds = c dq, of a sliding one ds = dq; of half angles accordingly;
the motor of a floating base counts as eight numbers of q. Of several ways the one with the fewest operations is taken, and entries that
automatic differentiation finds to be zero everywhere are left out.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi

from cga_codegen.catalogue import CHAIN_KERNELS, INPUTS, TREE_KERNELS, Kernel, Size
from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import Node, Port, Program, lower
from cga_codegen.emit.print_external import OF_Q, External, Output, Pattern
from cga_codegen.kernels import coordinate_derivatives as by_coordinates
from cga_codegen.kernels import dynamics_partials
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.model import Chain
from cga_codegen.units import made

Function = Callable[..., list[Any]]
Subject = Chain | Tree

ORDERS = {
    **dict.fromkeys(("motor", "pose", "point", "center_of_mass"), 2),
    **dict.fromkeys(("hessian_local", "hessian_world", "hessian_local_world_aligned"), 0),
    **dict.fromkeys(("coriolis", "inverse_dynamics_by_q", "inverse_dynamics_by_v"), 0),
}
"""How often a kernel can be differentiated; the others: once. Kernels that are derivatives of the last order themselves: not at all."""

_FRAMES = ("local", "world", "local_world_aligned")
ANALYTIC: dict[tuple[str, ...], str | Function] = {
    ("motor", "q"): "motor_jacobian",
    ("pose", "q"): by_coordinates.pose_by_q,
    ("point", "q"): by_coordinates.point_by_q,
    ("motor_jacobian", "q"): by_coordinates.motor_by_q_by_q,
    ("motor", "q", "q"): by_coordinates.motor_by_q_by_q,
    ("pose", "q", "q"): by_coordinates.pose_by_q_by_q,
    ("point", "q", "q"): by_coordinates.point_by_q_by_q,
    **{(f"jacobian_{frame}", "q"): f"hessian_{frame}" for frame in _FRAMES},
    ("center_of_mass", "q"): "center_of_mass_jacobian",
    ("inverse_dynamics", "q"): "inverse_dynamics_by_q",
    ("inverse_dynamics", "v"): "inverse_dynamics_by_v",
    ("inverse_dynamics", "a"): "mass_matrix",
    ("gravity", "q"): dynamics_partials.gravity_by_q,
    ("bias", "q"): dynamics_partials.bias_by_q,
    ("bias", "v"): "inverse_dynamics_by_v",
    ("forward_dynamics", "q"): dynamics_partials.forward_dynamics_by_q,
}
"""Derivatives that have a kernel or a function of their own; by q: where the base does not float, since there velocities are rates of q."""


@dataclass(frozen=True)
class Symbols:
    """A subject's inputs as casadi symbols, and derivatives by q through those that are made from q."""

    subject: Subject

    @cached_property
    def layout(self) -> Layout:
        at = self.subject.coordinates
        return Layout(at.names, at.kinds, at.motions)

    @cached_property
    def size(self) -> Size:
        frames = len(self.subject.frames) if isinstance(self.subject, Tree) else 0
        return Size(self.subject.coordinates.nv, len(self.layout.motions), frames)

    @cached_property
    def ports(self) -> dict[str, tuple[Port, Any]]:
        """Every input that a kernel may take, with its symbol."""
        names = [name for name in INPUTS if name != "base" or self.layout.first]
        ports = [Port(name, INPUTS[name](self.size)) for name in names]
        return {port.name: (port, casadi.SX.sym(port.name, port.size)) for port in ports}

    def values(self, function: Function) -> Any:
        """What a kernel gives at the symbols: a column, row-major."""
        wanted = [name for name in inspect.signature(function).parameters if name in self.ports]
        values = function(self.subject, **{name: self.ports[name][1].elements() for name in wanted})
        return casadi.vertcat(*[casadi.SX(value) for value in values])

    def derivative(self, values: Any, by: str) -> Any:
        """d values / d input by automatic differentiation, one row a value."""
        if by != "q":
            return casadi.jacobian(values, self.ports[by][1])
        names = [name for name in OF_Q if name in self.ports]
        parts = {name: casadi.jacobian(values, self.ports[name][1]) for name in names}
        angles = {name: self.ports[name][1] for name in names}
        by_joint = []
        for k, (_, _, slides) in enumerate(self.layout.joints):
            if slides:
                by_joint.append(parts["s"][:, k] + 0.5 * parts["sh"][:, k])
            else:
                whole = parts["s"][:, k] * angles["c"][k] - parts["c"][:, k] * angles["s"][k]
                half = parts["sh"][:, k] * angles["ch"][k] - parts["ch"][:, k] * angles["sh"][k]
                by_joint.append(whole + 0.5 * half)
        gather = casadi.DM(len(by_joint), self.layout.nq - self.layout.first)
        for k, (place, ratio, _) in enumerate(self.layout.joints):
            gather[k, place - self.layout.first] = ratio
        columns = casadi.mtimes(casadi.horzcat(*by_joint), gather) if by_joint else casadi.SX(values.numel(), 0)
        return casadi.horzcat(parts["base"], columns) if self.layout.first else columns

    def program(self, name: str, values: Sequence[Any]) -> Program:
        """The values lowered, over the inputs that they depend on."""
        expression = casadi.SX(casadi.vertcat(*values))
        used = {symbol.name().rsplit("_", 1)[0] for symbol in casadi.symvar(expression)}
        inputs = [pair for key, pair in self.ports.items() if key in used]
        return lower(name, inputs, Port("out", (len(values),)), values)


def externals(kernel: Kernel, subject: Subject, name: str, order: int) -> list[External]:
    """The function `name`, and its derivatives jac_<name> and jac_jac_<name> as far as `order` and ORDERS let them exist."""
    at, found = Symbols(subject), made(kernel, subject)
    passed = [port for port in found.program.inputs if port.name not in OF_Q]
    inputs = [(port.name, Pattern(port.size)) for port in passed]
    if len(passed) < len(found.program.inputs):
        inputs = [("q", Pattern(at.layout.nq)), *inputs]
    rows = found.program.output.shape[0]
    pattern = Pattern(rows, found.program.output.size // rows)
    row_major = at.values(found.function).elements()
    values = [row_major[row * pattern.cols + col] for col in range(pattern.cols) for row in range(rows)]
    functions = [External(name, tuple(inputs), (Output(kernel.name, pattern, found.program, f"cga_{name}"),))]
    order = min(order, ORDERS.get(kernel.name, 1))
    if order > 0:
        blocks = [_block(at, (kernel.name, by), pattern, values) for by, _ in inputs]
        functions.append(_derivative(functions[0], [block.output(f"cga_{name}") for block in blocks]))
        if order > 1:
            (block,) = blocks  # ORDERS: functions of q alone
            twice = _block(at, (kernel.name, "q", "q"), pattern, block.column())
            nothing = Output(f"jac_jac_{kernel.name}_q_out_{kernel.name}", Pattern(block.rows * block.cols, rows * pattern.cols, ()), None)
            functions.append(_derivative(functions[1], [twice.output(f"cga_{name}"), nothing]))
    return functions


def _derivative(function: External, outputs: Sequence[Output]) -> External:
    """jac_<function>, which besides the inputs is given the outputs (and needs nothing of them)."""
    given = [(f"out_{output.name}", Pattern(output.pattern.rows, output.pattern.cols, ())) for output in function.outputs]
    return External(f"jac_{function.name}", (*function.inputs, *given), tuple(outputs))


@dataclass(frozen=True)
class _Derivative:
    """The matrix d values / d input, one row a value: where it has entries, and the program that gives them (None: it has none)."""

    by: tuple[str, ...]
    rows: int
    cols: int
    entries: dict[tuple[int, int], Any]
    program: Program | None

    def output(self, symbol: str) -> Output:
        """As a result of jac_<name> or jac_jac_<name>."""
        name = "jac_" * (len(self.by) - 1) + "_".join(self.by)
        pattern = Pattern(self.rows, self.cols, tuple(self.entries))
        return Output(name, pattern, self.program, "_by_".join([symbol, *self.by[1:]]))

    def column(self) -> list[Any]:
        """All entries as values to differentiate again, column by column."""
        return [self.entries.get((row, col), casadi.SX(0)) for col in range(self.cols) for row in range(self.rows)]


def _block(at: Symbols, by: tuple[str, ...], pattern: Pattern, values: Sequence[Any]) -> _Derivative:
    """The derivative `by` (a kernel's name, then inputs) of the values, by the way with the fewest operations."""
    automatic = at.derivative(casadi.SX(casadi.vertcat(*values)), by[-1])
    rows, cols = automatic.shape
    places = list(zip(automatic.sparsity().row(), automatic.sparsity().get_col(), strict=True))
    entries = {place: automatic[place] for place in places}
    if by[1:] == ("q", "q"):  # symmetric, so that half of it will do
        size = pattern.rows * pattern.cols
        mirror = {(row, k): (k * size + row % size, row // size) for row, k in places if row // size > k}
        entries = {place: entries.get(mirror.get(place, place), casadi.SX(0)) for place in places}
    ways = [entries]
    ways += [_placed(at.values(function).elements(), places, pattern, cols, len(by) - 1) for function in analytic(at, by)]
    made_ways = [_lowered(at, by, rows, cols, entries) for entries in ways]
    return min(made_ways, key=lambda one: one.program.counts().total if one.program else 0)


def analytic(at: Symbols, by: tuple[str, ...]) -> list[Function]:
    """The functions that give this derivative."""
    way = ANALYTIC.get(by)
    if way is None or (by[-1] == "q" and at.layout.first):
        return []
    if callable(way):
        return [way]
    (kernel,) = (kernel for kernel in (*CHAIN_KERNELS, *TREE_KERNELS) if kernel.name == way)
    return [kernel.function, *([kernel.instead] if kernel.instead is not None and kernel.instead_for(at.subject) else [])]


def _placed(values: Sequence[Any], places: Sequence[tuple[int, int]], pattern: Pattern, n: int, order: int) -> dict[tuple[int, int], Any]:
    """Values with indices (element row-major, coordinate, ...) at places (element column-major below the coordinate before, coordinate)."""
    entries = {}
    for row, k in places:
        j, element = divmod(row, pattern.rows * pattern.cols)
        col, line = divmod(element, pattern.rows)
        number = line * pattern.cols + col
        entries[row, k] = values[(number * n + j) * n + k if order > 1 else number * n + k]
    return entries


def _lowered(at: Symbols, by: tuple[str, ...], rows: int, cols: int, entries: dict[tuple[int, int], Any]) -> _Derivative:
    """With entries left out that lowering finds to be zero."""
    while entries:
        program = at.program("_by_".join(by), list(entries.values()))
        zero = [program.nodes[result.node] == Node("constant", value=0.0) for result in program.results]
        if not any(zero):
            return _Derivative(by, rows, cols, entries, program)
        entries = {place: value for (place, value), none in zip(entries.items(), zero, strict=True) if not none}
    return _Derivative(by, rows, cols, {}, None)
