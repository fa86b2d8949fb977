"""Prints functions with the C interface that CasADi loads by `casadi.external`: f, f_n_in, f_sparsity_out, ..., and jac_f where given.

CasADi passes arrays of pointers; a missing input stands for zeros, a missing result is not wanted. Matrices are in compressed columns: a
dense one is column-major, where the plain C functions are row-major. jac_f takes the inputs of f and then each output of f (here without
entries: nothing is needed of them), and gives one matrix for each pair of an output and an input, rows numbered down the columns.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import Program
from cga_codegen.emit.print_c import PAIRS, print_body, trigonometry

OF_Q = ("base", *(name for pair in PAIRS for name in pair))
"""Inputs of bodies that the entry points make from q."""


@dataclass(frozen=True)
class Pattern:
    """Shape of a matrix, and its entries (row, column) in compressed-column order; None: it is dense."""

    rows: int
    cols: int = 1
    entries: tuple[tuple[int, int], ...] | None = None

    @property
    def size(self) -> int:
        """Number of entries."""
        return self.rows * self.cols if self.entries is None else len(self.entries)

    @property
    def transposed(self) -> bool:
        """Whether row-major and column-major differ."""
        return self.entries is None and min(self.rows, self.cols) > 1

    def code(self) -> list[int]:
        """CasADi's compressed form: rows, columns, then 1 (dense), or where each column begins and the row of each entry."""
        if self.entries is None:
            return [self.rows, self.cols, 1]
        begins = [sum(col < k for _, col in self.entries) for k in range(self.cols + 1)]
        return [self.rows, self.cols, *begins, *(row for row, _ in self.entries)]


@dataclass(frozen=True)
class Output:
    """A result: `program` gives its entries (dense: row-major; else in the pattern's order) through the body `symbol`; None: no entries."""

    name: str
    pattern: Pattern
    program: Program | None
    symbol: str = ""


@dataclass(frozen=True)
class External:
    """A function as CasADi sees it. Inputs by name; those without entries are never read."""

    name: str
    inputs: tuple[tuple[str, Pattern], ...]
    outputs: tuple[Output, ...]

    @property
    def operations(self) -> int:
        """Of all outputs together."""
        return sum(output.program.counts().total for output in self.outputs if output.program is not None)

    def signature(self) -> str:
        """The function in one line, as CasADi would print it."""

        def side(ports: Sequence[tuple[str, Pattern]]) -> str:
            return ", ".join(f"{name}[{p.rows}x{p.cols}{'' if p.entries is None else f', {p.size} entries'}]" for name, p in ports)

        return f"{self.name}({side(self.inputs)}) -> ({side([(o.name, o.pattern) for o in self.outputs])})"


def print_bodies(external: External) -> list[str]:
    """The bodies of an external's results."""
    made = [output for output in external.outputs if output.program is not None]
    return [print_body(output.program, output.symbol, f"{output.name} of {external.name}.") for output in made if output.program]


def print_external(external: External, layout: Layout) -> str:
    """The function and its tables; bodies must stand before it, and the text needs `external.h` (see INTERFACE)."""
    name = external.name
    return "".join([f"/* {external.signature()} */\n", _evaluation(external, layout), "\n", _tables(external), _interface(external, name)])


def _evaluation(external: External, layout: Layout) -> str:
    """`int f(arg, res, iw, w, mem)`."""
    programs = [output.program for output in external.outputs if output.program is not None]
    used = {port.name for program in programs for port in program.inputs}
    lines = [f"CGA_EXPORT int {external.name}(const double **arg, double **res, casadi_int *iw, double *w, int mem)\n{{\n"]
    for k, (name, pattern) in enumerate(external.inputs):
        if pattern.size and (name in used or (name == "q" and used & set(OF_Q))):
            lines.append(f"    const double *{name} = arg[{k}] ? arg[{k}] : cga_zeros;\n")
    for pair in (pair for pair in PAIRS if set(pair) & used):
        length = max(len(layout.motions), 1)
        lines.append(f"    double {pair[0]}[{length}], {pair[1]}[{length}];\n")
        lines += [f"    {line}\n" for line in trigonometry(pair, layout)]
        lines += [f"    (void){name};\n" for name in pair]
    for k, output in enumerate(external.outputs):
        if output.program is None:
            continue
        arguments = ", ".join("q" if port.name == "base" else port.name for port in output.program.inputs)
        rows, cols = output.pattern.rows, output.pattern.cols
        if output.pattern.transposed:
            lines.append(f"    if (res[{k}]) {{\n        {output.symbol}_body({arguments}, w);\n")
            lines.append(f"        cga_transpose({rows}, {cols}, w, res[{k}]);\n    }}\n")
        else:
            lines.append(f"    if (res[{k}])\n        {output.symbol}_body({arguments}, res[{k}]);\n")
    lines.append("    (void)arg; (void)res; (void)iw; (void)w; (void)mem;\n    return 0;\n}\n")
    return "".join(lines)


def _work(external: External) -> int:
    """Numbers of the work array: the row-major result before it is transposed."""
    return max((output.pattern.size for output in external.outputs if output.pattern.transposed), default=0)


def _tables(external: External) -> str:
    """Names and patterns, as constants."""
    name = external.name
    sides = {"in": list(external.inputs), "out": [(output.name, output.pattern) for output in external.outputs]}
    codes = list(dict.fromkeys(tuple(pattern.code()) for ports in sides.values() for _, pattern in ports))
    lines = []
    for k, code in enumerate(codes):
        rows = [", ".join(map(str, code[at : at + 24])) for at in range(0, len(code), 24)]
        lines.append(f"static const casadi_int {name}_pattern{k}[{len(code)}] = {{\n    " + ",\n    ".join(rows) + "};\n")
    for side, ports in sides.items():
        names = ", ".join(f'"{port}"' for port, _ in ports)
        patterns = ", ".join(f"{name}_pattern{codes.index(tuple(pattern.code()))}" for _, pattern in ports)
        lines.append(f"static const char *const {name}_names_{side}[{len(ports)}] = {{{names}}};\n")
        lines.append(f"static const casadi_int *const {name}_patterns_{side}[{len(ports)}] = {{{patterns}}};\n")
    return "".join(lines)


def _interface(external: External, name: str) -> str:
    return f"CGA_CASADI_INTERFACE({name}, {len(external.inputs)}, {len(external.outputs)}, {_work(external)})\n"


def print_interface(zeros: int) -> str:
    """`external.h`: what all these functions share; `zeros` is the length of the longest input."""
    return f"""\
/* What the functions that CasADi loads share. */

#ifndef casadi_int
#define casadi_int long long int
#endif

/* Stands for an input that was not given. */
static const double cga_zeros[{max(zeros, 1)}] = {{0.0}};

/* Row-major to column-major. */
static inline void cga_transpose(int rows, int cols, const double *restrict from, double *restrict to)
{{
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < cols; ++j)
            to[i + rows * j] = from[cols * i + j];
}}

{INTERFACE}"""


_MEMBERS = (
    "int {f}_alloc_mem(void) {{ return 0; }}",
    "int {f}_init_mem(int mem) {{ (void)mem; return 0; }}",
    "void {f}_free_mem(int mem) {{ (void)mem; }}",
    "int {f}_checkout(void) {{ return 0; }}",
    "void {f}_release(int mem) {{ (void)mem; }}",
    "void {f}_incref(void) {{ }}",
    "void {f}_decref(void) {{ }}",
    "casadi_int {f}_n_in(void) {{ return ins; }}",
    "casadi_int {f}_n_out(void) {{ return outs; }}",
    "double {f}_default_in(casadi_int i) {{ (void)i; return 0.0; }}",
    "const char *{f}_name_in(casadi_int i) {{ return i >= 0 && i < ins ? {f}_names_in[i] : 0; }}",
    "const char *{f}_name_out(casadi_int i) {{ return i >= 0 && i < outs ? {f}_names_out[i] : 0; }}",
    "const casadi_int *{f}_sparsity_in(casadi_int i) {{ return i >= 0 && i < ins ? {f}_patterns_in[i] : 0; }}",
    "const casadi_int *{f}_sparsity_out(casadi_int i) {{ return i >= 0 && i < outs ? {f}_patterns_out[i] : 0; }}",
    "int {f}_work(casadi_int *arg, casadi_int *res, casadi_int *iw, casadi_int *w) {{ "
    "if (arg) *arg = ins; if (res) *res = outs; if (iw) *iw = 0; if (w) *w = work; return 0; }}",
)
"""What CasADi asks of a function, by the names that it looks for. There is no memory to keep, and threads may share."""

_HEAD = "#define CGA_CASADI_INTERFACE(f, ins, outs, work)"
INTERFACE = " \\\n".join([_HEAD, *("    CGA_EXPORT " + member.format(f="f##") for member in _MEMBERS)]) + "\n"
