"""What the header, the README and the example of an exported robot say of its functions."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cga_codegen.catalogue import Kernel
from cga_codegen.emit.layout import BASE, Layout
from cga_codegen.emit.lower import Program
from cga_codegen.emit.print_external import External
from cga_codegen.externals import Subject, Symbols
from cga_codegen.kernels.tree import Tree
from cga_codegen.units import identifier

_UNITS = {"prismatic": "m", "floating": f"motor of the base: {BASE} numbers, 1 e12 e13 e23 e1i e2i e3i e123i"}
_SHOWN = ("pose", "jacobian_local_world_aligned", "inverse_dynamics")
"""What the example prints, of the first chain and of the whole."""


@dataclass(frozen=True)
class Exported:
    """A kernel of a subject: its file, and the functions for CasADi (value, first and second derivative)."""

    kernel: Kernel
    subject: Subject
    file: str
    functions: tuple[External, ...]

    @property
    def symbol(self) -> str:
        """Of the plain C function."""
        return f"cga_{self.functions[0].name}"

    @property
    def program(self) -> Program:
        """Of the value."""
        (output,) = self.functions[0].outputs
        assert output.program is not None, "values have entries"
        return output.program

    @property
    def inputs(self) -> dict[str, int]:
        """Numbers of each input of the plain C function."""
        return {name: pattern.rows for name, pattern in self.functions[0].inputs}

    @cached_property
    def layout(self) -> Layout:
        """What q holds."""
        return Symbols(self.subject).layout

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the result."""
        return self.program.output.shape

    @property
    def of(self) -> str:
        """What q belongs to."""
        return "the whole robot" if isinstance(self.subject, Tree) else f"the chain to {identifier(self.subject.name)}"

    @property
    def summary(self) -> str:
        """What it computes, in one sentence."""
        return (self.kernel.function.__doc__ or "").strip().splitlines()[0]

    def to_json(self) -> dict[str, Any]:
        """Plain data for the manifest; operations: of the value, of jac_<name> and of jac_jac_<name>, as far as there are any."""
        operations = [function.operations for function in self.functions]
        return {"symbol": self.symbol, "inputs": self.inputs, "shape": list(self.shape), "operations": operations}


def wrapped(text: str) -> str:
    """Text inside a C comment, no line too long."""
    return textwrap.fill(text, 118, initial_indent="   ", subsequent_indent="   ", break_long_words=False, break_on_hyphens=False)


def positions(exported: Sequence[Exported]) -> Iterator[str]:
    """One line for each subject: what q holds."""
    for one in {one.of: one for one in exported}.values():
        layout = one.layout
        names = [f"{identifier(name)} ({_UNITS.get(kind, 'rad')})" for name, kind in zip(layout.names, layout.kinds, strict=True)]
        rates = f"; v, a and tau, {one.subject.coordinates.nv} numbers, accordingly" if isinstance(one.subject, Tree) else ""
        twist = " (of the base: its twist in its own axes, v before w)" if layout.first else ""
        yield f"of {one.of}, {layout.nq} numbers: {', '.join(names)}{rates}{twist}"


def frames(exported: Sequence[Exported]) -> Iterator[str]:
    """The order of the frames of the whole robot, where they are exported."""
    for one in exported:
        if isinstance(one.subject, Tree) and one.kernel.name == "frames":
            yield "frames, in this order: " + ", ".join(identifier(frame.name) for frame in one.subject.frames)


def declarations(exported: Sequence[Exported]) -> Iterator[str]:
    """What the header says of each function."""
    for one in exported:
        names = ", ".join(one.inputs)
        sizes = ", ".join(f"{name}[{size}]" for name, size in one.inputs.items())
        shape = " x ".join(map(str, one.shape))
        casadi = ", ".join(f"{function.name} ({function.operations})" for function in one.functions)
        arguments = ", ".join(f"const double *{name}" for name in one.inputs)
        notes = f"Of {one.of}. {sizes} -> out[{one.program.output.size}], {shape}. For CasADi, with operations: {casadi}."
        yield (
            f"\n/* {one.symbol}({names}, out): {one.summary}\n{wrapped(notes)} */\n"
            f"#define {one.symbol.upper()}_SIZE {one.program.output.size}\n"
            f"CGA_EXPORT int {one.symbol}({arguments}, double *out);\n"
            f"CGA_EXPORT int {one.symbol}_batch(int64_t n, {arguments}, double *out);\n"
        )


def sizes(robot: str, exported: Sequence[Exported]) -> Iterator[str]:
    """Macros of the numbers in q and v: of each chain by the name of its frame, and of the whole robot."""
    for one in {one.of: one for one in exported}.values():
        part = "" if isinstance(one.subject, Tree) else f"_{identifier(one.subject.name)}"
        name = f"CGA_{robot}{part}".upper()
        yield f"#define {name}_NQ {one.layout.nq}\n#define {name}_NV {one.subject.coordinates.nv}\n"


def rows(exported: Sequence[Exported]) -> Iterator[str]:
    """The README's table."""
    for one in exported:
        counts = [str(function.operations) for function in one.functions]
        cells = [f"`{one.symbol}({', '.join(one.inputs)}, out)`", " x ".join(map(str, one.shape)), *counts, *["-"] * (3 - len(counts))]
        yield f"| {' | '.join(cells)} |"


def steps(exported: Sequence[Exported]) -> Iterator[str]:
    """The example's calls."""
    first: dict[str, Exported] = {}
    for one in exported:
        if one.kernel.name in _SHOWN:
            first.setdefault(one.kernel.name, one)
    for one in first.values() or exported[:1]:
        arrays = ", ".join(f"{name}[{size}]" for name, size in one.inputs.items())
        lines = [f"double {arrays}, out[{one.symbol.upper()}_SIZE];"]
        for name, size in one.inputs.items():
            begin, step = (one.layout.first, "0.1") if name == "q" else (0, "0.01")
            if begin:
                lines.append(f"for (int i = 0; i < {begin}; ++i)\n            {name}[i] = i == 0 ? 1.0 : 0.0;")
            lines.append(f"for (int i = {begin}; i < {size}; ++i)\n            {name}[i] = {step} * (i + {1 - begin});")
        lines.append(f"bad |= {one.symbol}({', '.join(one.inputs)}, out);")
        height, width = (one.shape[0], one.program.output.size // one.shape[0]) if len(one.shape) > 1 else (1, one.shape[0])
        lines.append(f'print("{one.functions[0].name}", {height}, {width}, out);')
        yield "    {\n" + "".join(f"        {line}\n" for line in lines) + "    }\n"
