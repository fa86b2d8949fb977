"""Prints programs as C99: one body of plain assignments over a type T, and the entry points around it.

The body is free of branches, casts and calls (but for the square root) and reads and writes whole elements only, so that T may be a vector
type. What is trigonometric happens in the entry points: they turn joint angles q into (c, s) or (ch, sh) and then call the body.
"""

from __future__ import annotations

from collections.abc import Iterable

from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import LoweringError, Node, Program

PART = 2000
"""Operations of one C function: gcc compiles longer ones slowly (29 joints, 21,000 operations: 36 s in one function, 9 s in such parts)."""

_PATTERNS = {"add": "{} + {}", "sub": "{} - {}", "mul": "{} * {}", "div": "{} / {}", "sqrt": "ROOT({})"}

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

#if defined(__GNUC__)
#define CGA_NOINLINE __attribute__((noinline))
#else
#define CGA_NOINLINE
#endif

/* T is the number type of the bodies, K(x) a constant of that type, ROOT(x) a square root. */
#ifndef T
#define T double
#define K(x) (x)
#define ROOT(x) sqrt(x)
#endif
"""

# joint coordinate pair -> the two C expressions for a revolute and for a prismatic joint
PAIRS = {("c", "s"): ("cos({q})", "sin({q})", "1.0", "{q}"), ("ch", "sh"): ("cos(0.5 * {q})", "sin(0.5 * {q})", "1.0", "0.5 * {q}")}


def print_body(program: Program, symbol: str, docstring: str) -> str:
    """The body: `static inline void <symbol>_body(const T *c, ..., T *out)`.

    More than PART operations become several functions in a row, which hand values on in an array: compilers need more than linear time
    for one long function.
    """
    counts = program.counts()
    arguments = ", ".join(f"const T *restrict {port.name}" for port in program.inputs)
    head = f"/* {docstring}\n   {counts.multiplications} mul, {counts.additions} add, {counts.divisions} div, {counts.roots} sqrt. */\n"
    numbered = sorted(program.number, key=program.number.__getitem__)
    parts = [set(numbered[k : k + PART]) for k in range(0, len(numbered), PART)] or [set()]
    unused = [p.name for i, p in enumerate(program.inputs) if not any(n.op == "input" and n.args[0] == i for n in program.nodes)]
    ignored = "".join(f"    (void){name};\n" for name in unused)
    if len(parts) == 1:
        opening = f"static inline void {symbol}_body({arguments}, T *restrict out)\n{{\n"
        return head + opening + _lines(program, parts[0], {}) + ignored + "}\n"
    kept = _kept(program, parts)
    texts = []
    names = ", ".join(port.name for port in program.inputs)
    unread = "".join(f"    (void){name};\n" for name in (*(port.name for port in program.inputs), "w", "out"))
    for number, part in enumerate(parts):
        opening = f"static CGA_NOINLINE void {symbol}_part{number}({arguments}, T *restrict w, T *restrict out)\n{{\n"
        texts.append(opening + _lines(program, part, kept, last=number == len(parts) - 1) + unread + "}\n\n")
    calls = "".join(f"    {symbol}_part{number}({names}, w, out);\n" for number in range(len(parts)))
    body = f"static inline void {symbol}_body({arguments}, T *restrict out)\n{{\n    T w[{max(len(kept), 1)}];\n{calls}{ignored}}}\n"
    return head + "".join(texts) + body


def _kept(program: Program, parts: list[set[int]]) -> dict[int, int]:
    """Place in the array `w` of each value that a later part reads."""
    part_of = {node: k for k, part in enumerate(parts) for node in part}
    kept: dict[int, int] = {}
    for index, node in enumerate(program.nodes):
        if index in part_of:
            for a in node.args:
                if a in part_of and part_of[a] != part_of[index]:
                    kept.setdefault(a, len(kept))
    return kept


def _lines(program: Program, part: set[int], kept: dict[int, int], last: bool = True) -> str:
    """The assignments of one part, the values it hands on, and the outputs it knows; the last part also writes those that are no values."""
    lines = []

    def operand(index: int) -> str:
        return f"w[{kept[index]}]" if index in kept and index not in part else _operand(program, index)

    for k in sorted(part, key=program.number.__getitem__):
        node = program.nodes[k]
        if node.op not in _PATTERNS:
            raise LoweringError(f"{program.name}: {node.op} has no form on a vector type; kernels take what is trigonometric as inputs")
        lines.append(f"    const T t{program.number[k]} = {_PATTERNS[node.op].format(*(operand(a) for a in node.args))};\n")
    lines += [f"    w[{place}] = t{program.number[k]};\n" for k, place in kept.items() if k in part]
    for i, result in enumerate(program.results):
        if result.node in part or (last and result.node not in program.number):
            lines.append(f"    out[{i}] = {'-' if result.negative else ''}{operand(result.node)};\n")
    return "".join(lines)


def print_entries(program: Program, symbol: str, layout: Layout) -> str:
    """The exported functions `<symbol>(q, ..., out)` and `<symbol>_batch(n, q, ..., out)` for double arrays.

    Both return 0, or 1 if an input holds NaN or infinity (the result is then not to be used). Inputs c, s, ch, sh and base of the body
    come from q as `layout` says; others are passed on. Batches are row-major: element k of an input begins at k times its size.
    """
    names = [port.name for port in program.inputs]
    pairs = [pair for pair in PAIRS if set(pair) & set(names)]
    angles = {"base", *(name for pair in PAIRS for name in pair)}
    n = len(layout.motions)
    sizes = ([("q", layout.nq)] if angles & set(names) else []) + [(p.name, p.size) for p in program.inputs if p.name not in angles]
    arguments = ", ".join(f"const double *restrict {name} /* {size} */" for name, size in sizes)
    lines = [f"CGA_EXPORT int {symbol}({arguments}, double *restrict out /* {program.output.size} */)\n{{\n"]
    for pair in pairs:
        lines.append(f"    double {pair[0]}[{max(n, 1)}], {pair[1]}[{max(n, 1)}];\n")
        lines += [f"    {line}\n" for line in trigonometry(pair, layout)]
        lines += [f"    (void){name};\n" for name in pair if name not in names]
    lines.append(f"    {symbol}_body({', '.join('q' if name == 'base' else name for name in names)}, out);\n")
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


def trigonometry(pair: tuple[str, str], layout: Layout) -> list[str]:
    cosine, sine, one, displacement = PAIRS[pair]
    joints = layout.joints
    if joints == [(j, 1.0, False) for j in range(layout.nq)]:
        a, b = cosine.format(q="q[j]"), sine.format(q="q[j]")
        return [f"for (int j = 0; j < {len(joints)}; ++j) {{ {pair[0]}[j] = {a}; {pair[1]}[j] = {b}; }}"]
    lines = []
    for j, (place, ratio, slides) in enumerate(joints):
        a, b = (one, displacement) if slides else (cosine, sine)
        q = f"q[{place}]" if ratio == 1.0 else f"({ratio!r} * q[{place}])"
        lines.append(f"{pair[0]}[{j}] = {a.format(q=q)}; {pair[1]}[{j}] = {b.format(q=q)};")
    return lines


def _operand(program: Program, index: int) -> str:
    node: Node = program.nodes[index]
    if node.op == "input":
        return f"{program.inputs[node.args[0]].name}[{node.args[1]}]"
    return f"K({node.value!r})" if node.op == "constant" else f"t{program.number[index]}"
