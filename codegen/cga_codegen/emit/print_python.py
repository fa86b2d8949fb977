"""Prints programs as straight-line Python that runs alike on floats, numpy arrays and casadi.SX.

    def point(c, s):
        t0 = c[0]*c[1]
        return (t0, ...)

Inputs are indexed sequences of scalars (or of arrays: one array for each element makes a batch); the result is a flat tuple, row-major.
Square roots are a function `root` of the module.
"""

from __future__ import annotations

from collections.abc import Iterable

from cga_codegen.emit.lower import LoweringError, Node, Program, Signed

_PATTERNS = {"add": "{}+{}", "sub": "{}-{}", "mul": "{}*{}", "div": "{}/{}", "sqrt": "root({})"}

_ROOT = """\
import math


def root(x):
    return math.sqrt(x) if isinstance(x, float) else x**0.5  # arrays and symbols; a float's power may round another way than C's sqrt


"""


def print_function(program: Program, docstring: str) -> str:
    """The text of one function, with its operation count."""
    counts = program.counts()
    head = f"def {program.name}({', '.join(port.name for port in program.inputs)}):\n"
    lines = [head, f'    """{docstring}\n\n    Result: shape {program.output.shape}. ']
    lines.append(f'{counts.multiplications} mul, {counts.additions} add, {counts.divisions} div, {counts.roots} sqrt."""\n')
    for k, node in enumerate(program.nodes):
        if node.op not in ("input", "constant"):
            if node.op not in _PATTERNS:
                raise LoweringError(f"{program.name}: {node.op} has no printed form; kernels take what is trigonometric as inputs")
            lines.append(f"    t{program.number[k]} = {_PATTERNS[node.op].format(*(_operand(program, a) for a in node.args))}\n")
    results = "".join(f"{_result(program, r)}, " for r in program.results).strip()  # (x,) is a tuple, (,) is none: no joints, no results
    lines.append(f"    return ({results})\n")
    return "".join(lines)


def print_module(banner: str, functions: Iterable[str]) -> str:
    """A module of functions under a banner docstring. Raises LoweringError for a banner that would not stay inside it."""
    if '"' in banner or "\\" in banner:
        raise LoweringError(f"no docstring can hold {banner!r}")
    text = "\n\n".join(functions)
    return f'"""{banner}"""\n\n{_ROOT if " = root(" in text else chr(10)}{text}'


def _operand(program: Program, index: int) -> str:
    node: Node = program.nodes[index]
    if node.op == "input":
        return f"{program.inputs[node.args[0]].name}[{node.args[1]}]"
    return repr(node.value) if node.op == "constant" else f"t{program.number[index]}"


def _result(program: Program, result: Signed) -> str:
    return ("-" if result.negative else "") + _operand(program, result.node)
