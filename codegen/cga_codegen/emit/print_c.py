"""Prints programs as C99: one body of plain assignments over a type T, and the entry points around it.

The body is free of branches, calls and casts and reads and writes whole elements only, so that T may be a vector type. What is
trigonometric happens in the entry points: they turn joint angles q into (c, s) or (ch, sh) and then call the body.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from cga_codegen.emit.lower import LoweringError, Node, Program, Signed

_PATTERNS = {"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}"}

PREAMBLE = """\
#include <math.h>
#include <stdint.h>

#ifdef _WIN32
#define CGA_EXPORT __declspec(dllexport)
#else
#define CGA_EXPORT
#endif

/* 0 * x is zero for every finite x, and NaN for NaN and infinity. */
static inline int cga_not_finite(const double *x, int n)
{
    double zero = 0.0;
    for (int i = 0; i < n; ++i)
        zero += 0.0 * x[i];
    return zero != 0.0;
}

/* T is the number type of the bodies, K(x) a constant of that type. */
#ifndef T
#define T double
#define K(x) (x)
#endif
"""

# joint coordinate pair -> the two C expressions for a revolute and for a prismatic joint
_PAIRS = {("c", "s"): ("cos({q})", "sin({q})", "1.0", "{q}"), ("ch", "sh"): ("cos(0.5 * {q})", "sin(0.5 * {q})", "1.0", "0.5 * {q}")}


def print_body(program: Program, symbol: str, docstring: str) -> str:
    """The body: `static inline void <symbol>_body(const T *c, ..., T *out)`."""
    counts = program.counts()
    arguments = ", ".join(f"const T *restrict {port.name}" for port in program.inputs)
    lines = [f"/* {docstring}\n   {counts.multiplications} mul, {counts.additions} add, {counts.divisions} div, {counts.roots} sqrt. */\n"]
    lines.append(f"static inline void {symbol}_body({arguments}, T *restrict out)\n{{\n")
    for k, node in enumerate(program.nodes):
        if node.op not in ("input", "constant"):
            if node.op not in _PATTERNS:
                raise LoweringError(f"{program.name}: {node.op} has no form on a vector type; kernels take what is trigonometric as inputs")
            lines.append(f"    const T t{program.number[k]} = {_PATTERNS[node.op].format(*(_operand(program, a) for a in node.args))};\n")
    lines += [f"    out[{i}] = {_result(program, r)};\n" for i, r in enumerate(program.results)]
    unused = [p.name for i, p in enumerate(program.inputs) if not any(n.op == "input" and n.args[0] == i for n in program.nodes)]
    lines += [f"    (void){name};\n" for name in unused]
    return "".join(lines) + "}\n"


def print_entries(program: Program, symbol: str, kinds: Sequence[str]) -> str:
    """The exported functions `<symbol>(q, ..., out)` and `<symbol>_batch(n, q, ..., out)` for double arrays.

    Both return 0, or 1 if an input holds NaN or infinity (the result is then not to be used).
    kinds: for each joint "revolute", "continuous" or "prismatic". Inputs c, s, ch, sh of the body come from q; others are passed on.
    Batches are row-major: element k of an input begins at k times its size.
    """
    names = [port.name for port in program.inputs]
    pairs = [pair for pair in _PAIRS if set(pair) & set(names)]
    n = len(kinds)
    sizes = ([("q", n)] if pairs else []) + [(p.name, p.size) for p in program.inputs if not any(p.name in pair for pair in _PAIRS)]
    arguments = ", ".join(f"const double *restrict {name} /* {size} */" for name, size in sizes)
    lines = [f"CGA_EXPORT int {symbol}({arguments}, double *restrict out /* {program.output.size} */)\n{{\n"]
    for pair in pairs:
        lines.append(f"    double {pair[0]}[{n}], {pair[1]}[{n}];\n")
        lines += [f"    {line}\n" for line in _trigonometry(pair, kinds)]
        lines += [f"    (void){name};\n" for name in pair if name not in names]
    lines.append(f"    {symbol}_body({', '.join(names)}, out);\n")
    lines.append(f"    return {' || '.join(f'cga_not_finite({name}, {size})' for name, size in sizes)};\n}}\n\n")
    call = ", ".join(f"{name} + k * {size}" for name, size in sizes)
    lines.append(f"CGA_EXPORT int {symbol}_batch(int64_t n, {arguments}, double *restrict out)\n{{\n    int bad = 0;\n")
    lines.append(f"    for (int64_t k = 0; k < n; ++k)\n        bad |= {symbol}({call}, out + k * {program.output.size});\n")
    lines.append("    return bad;\n}\n")
    return "".join(lines)


def print_file(banner: str, parts: Iterable[str]) -> str:
    """One translation unit. Raises LoweringError for a banner that would not stay inside its comment."""
    if any(mark in banner for mark in ("*/", "\\", "??")):  # the last two: line splices and trigraphs can hide the first
        raise LoweringError(f"no C comment can hold {banner!r}")
    return f"/* {banner} */\n\n{PREAMBLE}\n" + "\n".join(parts)


def _trigonometry(pair: tuple[str, str], kinds: Sequence[str]) -> list[str]:
    cosine, sine, one, displacement = _PAIRS[pair]
    if not any(kind == "prismatic" for kind in kinds):
        a, b = cosine.format(q="q[j]"), sine.format(q="q[j]")
        return [f"for (int j = 0; j < {len(kinds)}; ++j) {{ {pair[0]}[j] = {a}; {pair[1]}[j] = {b}; }}"]
    lines = []
    for j, kind in enumerate(kinds):
        a, b = (one, displacement) if kind == "prismatic" else (cosine, sine)
        lines.append(f"{pair[0]}[{j}] = {a.format(q=f'q[{j}]')}; {pair[1]}[{j}] = {b.format(q=f'q[{j}]')};")
    return lines


def _operand(program: Program, index: int) -> str:
    node: Node = program.nodes[index]
    if node.op == "input":
        return f"{program.inputs[node.args[0]].name}[{node.args[1]}]"
    return f"K({node.value!r})" if node.op == "constant" else f"t{program.number[index]}"


def _result(program: Program, result: Signed) -> str:
    return ("-" if result.negative else "") + _operand(program, result.node)
