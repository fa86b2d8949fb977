"""Lowers a casadi SX function to value-numbered, straight-line assignments, and counts their operations.

Value numbering with signs: every value is a node with a sign, so `-a*b`, `a*-b` and `-(a*b)` are one node, `b-a` is the
negation of `a-b`, and no negation costs an operation unless an output needs it. Nodes that no output needs disappear.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import casadi

Op = Literal["input", "constant", "add", "sub", "mul", "div", "sqrt", "sin", "cos"]


class LoweringError(ValueError):
    """A function contains an operation that has no printed form; the message names it and the function."""


@dataclass(frozen=True)
class Node:
    """One value. `input`: (input number, element); `constant`: its number in `value`; else the operation on earlier nodes."""

    op: Op
    args: tuple[int, ...] = ()
    value: float = 0.0


@dataclass(frozen=True)
class Signed:
    """A node with a sign: the value, or its negation."""

    node: int
    negative: bool = False

    def __neg__(self) -> Signed:
        return Signed(self.node, not self.negative)


@dataclass(frozen=True)
class Counts:
    """Arithmetic operations of a program; additions include subtractions, `negations` are those that outputs need."""

    multiplications: int
    additions: int
    divisions: int
    roots: int
    negations: int

    @property
    def total(self) -> int:
        """All of them, negations left out (they fold into the store)."""
        return self.multiplications + self.additions + self.divisions + self.roots


@dataclass(frozen=True)
class Port:
    """A named input or output: its shape, elements in row-major order."""

    name: str
    shape: tuple[int, ...]

    @property
    def size(self) -> int:
        """Number of elements."""
        return math.prod(self.shape)


@dataclass(frozen=True)
class Program:
    """Straight-line code: `nodes` in the order of evaluation, and for the one output the signed node of each element."""

    name: str
    inputs: tuple[Port, ...]
    output: Port
    nodes: tuple[Node, ...]
    results: tuple[Signed, ...]

    @cached_property
    def number(self) -> dict[int, int]:
        """Operations numbered through from 0, by node: the names of the temporaries in printed code."""
        operations = (k for k, node in enumerate(self.nodes) if node.op not in ("input", "constant"))
        return {node: k for k, node in enumerate(operations)}

    def counts(self) -> Counts:
        """Operations of the program."""

        def of(*ops: str) -> int:
            return sum(node.op in ops for node in self.nodes)

        return Counts(of("mul"), of("add", "sub"), of("div"), of("sqrt"), sum(r.negative for r in self.results))


class _Numbering:
    """Builds nodes, giving equal values equal numbers; `name` is the function's, for messages."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.nodes: list[Node] = []
        self._number: dict[Node, int] = {}

    def node(self, op: Op, args: tuple[int, ...] = (), value: float = 0.0) -> Signed:
        key = Node(op, args, value)
        if key not in self._number:
            self._number[key] = len(self.nodes)
            self.nodes.append(key)
        return Signed(self._number[key])

    def constant(self, value: float) -> Signed:
        if not math.isfinite(value):
            raise LoweringError(f"{self.name}: the constant {value} (from a division by zero, or an overflow)")
        positive = self.node("constant", value=abs(value))
        return -positive if value < 0 else positive

    def known(self, a: Signed) -> float | None:
        """The number, if the value is a constant."""
        node = self.nodes[a.node]
        if node.op != "constant":
            return None
        return -node.value if a.negative else node.value

    def add(self, a: Signed, b: Signed) -> Signed:
        x, y = self.known(a), self.known(b)
        if x is not None and y is not None:
            return self.constant(x + y)
        if x == 0:
            return b
        if y == 0:
            return a
        if a.node == b.node:
            return self.constant(0.0) if a.negative != b.negative else self.mul(self.constant(2.0), a)
        if a.node > b.node:
            a, b = b, a
        if a.negative == b.negative:
            total = self.node("add", (a.node, b.node))
        else:
            total = self.node("sub", (a.node, b.node))
        return -total if a.negative else total

    def mul(self, a: Signed, b: Signed) -> Signed:
        x, y = self.known(a), self.known(b)
        if x is not None and y is not None:
            return self.constant(x * y)
        for known, other in ((x, b), (y, a)):
            if known is not None and known in (0.0, 1.0, -1.0):
                return self.constant(0.0) if known == 0 else other if known == 1 else -other
        product = self.node("mul", (min(a.node, b.node), max(a.node, b.node)))
        return -product if a.negative != b.negative else product

    def div(self, a: Signed, b: Signed) -> Signed:
        y = self.known(b)
        if y == 0:
            raise LoweringError(f"{self.name}: division by the constant zero")
        if y is not None and math.frexp(y)[0] in (0.5, -0.5) and abs(y) > 1e-300:  # a power of two: its reciprocal is exact
            return self.mul(a, self.constant(1.0 / y))
        if self.known(a) == 0:
            return self.constant(0.0)
        quotient = self.node("div", (a.node, b.node))
        return -quotient if a.negative != b.negative else quotient

    def odd(self, op: Op, a: Signed) -> Signed:
        value = self.node(op, (a.node,))
        return -value if a.negative else value

    def plain(self, a: Signed) -> int:
        """A node number without sign (for sqrt, whose argument keeps its sign)."""
        return self.sub_from_zero(a) if a.negative else a.node

    def sub_from_zero(self, a: Signed) -> int:
        return self.node("sub", (self.constant(0.0).node, a.node)).node


# casadi operation -> what it means here; the whole of what kernels may contain
_RULES: dict[int, Callable[[_Numbering, list[Signed]], Signed]] = {
    casadi.OP_ADD: lambda n, a: n.add(a[0], a[1]),
    casadi.OP_SUB: lambda n, a: n.add(a[0], -a[1]),
    casadi.OP_MUL: lambda n, a: n.mul(a[0], a[1]),
    casadi.OP_DIV: lambda n, a: n.div(a[0], a[1]),
    casadi.OP_NEG: lambda n, a: -a[0],
    casadi.OP_SQ: lambda n, a: n.mul(a[0], a[0]),
    casadi.OP_TWICE: lambda n, a: n.mul(n.constant(2.0), a[0]),
    casadi.OP_INV: lambda n, a: n.div(n.constant(1.0), a[0]),
    casadi.OP_SQRT: lambda n, a: n.node("sqrt", (n.plain(a[0]),)),
    casadi.OP_SIN: lambda n, a: n.odd("sin", a[0]),
    casadi.OP_COS: lambda n, a: n.node("cos", (a[0].node,)),
    casadi.OP_ASSIGN: lambda n, a: a[0],
}


def lower(name: str, inputs: Iterable[tuple[Port, Any]], output: Port, expression: Any) -> Program:
    """The program that computes `expression` (an SX with output.size elements, row-major) from the named SX symbols.

    Raises LoweringError for an operation without a printed form.
    """
    ports = tuple(inputs)
    flat = casadi.densify(casadi.vertcat(*[casadi.SX(e) for e in expression]))
    if flat.numel() != output.size:
        raise LoweringError(f"{name}: {flat.numel()} values for an output of shape {output.shape}")
    function = casadi.Function("f", [symbol for _, symbol in ports], [flat])
    numbering = _Numbering(name)
    work: dict[int, Signed] = {}
    results: list[Signed] = [numbering.constant(0.0)] * output.size
    for k in range(function.n_instructions()):
        code, into, out_of = function.instruction_id(k), function.instruction_output(k), function.instruction_input(k)
        if code == casadi.OP_CONST:
            work[into[0]] = numbering.constant(function.instruction_constant(k))
        elif code == casadi.OP_INPUT:
            work[into[0]] = numbering.node("input", (out_of[0], out_of[1]))
        elif code == casadi.OP_OUTPUT:
            results[into[1]] = work[out_of[0]]
        elif code in _RULES:
            work[into[0]] = _RULES[code](numbering, [work[i] for i in out_of])
        else:
            called = next((key for key in dir(casadi) if key.startswith("OP_") and getattr(casadi, key) == code), code)
            raise LoweringError(f"{name}: casadi's {called} has no printed form; kernels may use + - * / sqrt")
    return _ordered(name, tuple(port for port, _ in ports), output, numbering.nodes, results)


def _ordered(name: str, inputs: tuple[Port, ...], output: Port, nodes: list[Node], results: list[Signed]) -> Program:
    """Keeps what the outputs need, in depth-first order from the first output on: an order that depends on the values alone."""
    number: dict[int, int] = {}
    kept: list[Node] = []
    for result in results:
        stack = [result.node]
        while stack:
            at = stack[-1]
            operands = nodes[at].args if nodes[at].op not in ("input", "constant") else ()
            waiting = [a for a in reversed(operands) if a not in number]
            if waiting:
                stack.extend(waiting)
                continue
            stack.pop()
            if at not in number:
                number[at] = len(kept)
                arguments = nodes[at].args if nodes[at].op == "input" else tuple(number[a] for a in operands)
                kept.append(Node(nodes[at].op, arguments, nodes[at].value))
    return Program(name, inputs, output, tuple(kept), tuple(Signed(number[r.node], r.negative) for r in results))
