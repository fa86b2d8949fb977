"""Section "kernels": what the generated functions cost, counted and measured on this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.compile import find_compiler
from cga_runtime.kernels import Kernel, Unit
from cga_runtime.report.context import Context
from cga_runtime.report.figures import Figure, figure

Array = NDArray[np.float64]

BATCH = 1024
SLICE = 1e-3
"""Seconds that one round of a timing takes, at least."""

TICKS = [mantissa * 10**power for power in range(7) for mantissa in (1, 2, 5)]


def section(context: Context) -> dict[str, Any]:
    """One entry a kernel, named part/kernel. Nanoseconds are medians: "scalar" of one call from Python, "batch" per pose of a batch."""
    rng = np.random.default_rng(context.seed)
    found = {}
    for part, unit, poses in _units(context, rng):
        for name in unit.names:
            kernel = unit.kernel(name)
            inputs = _inputs(kernel, poses, rng)
            entry = {key: kernel.record[key] for key in ("operations", "multiplications", "additions", "divisions")}
            entry["operations_by_differentiation"] = kernel.record.get("operations_by_differentiation")
            entry["nanoseconds"] = {
                "scalar": 1e9 * _seconds(kernel, [x[0] for x in inputs], context.sizes.rounds),
                "batch": 1e9 * _seconds(kernel, inputs, context.sizes.rounds) / BATCH,
            }
            entry["compiler"] = compiler(unit)
            found[f"{part}/{name}"] = entry
    return found


def _units(context: Context, rng: np.random.Generator) -> Iterator[tuple[str, Unit, Array]]:
    loop = context.loop
    yield loop.right.frame, loop.right.unit, loop.right.random(rng, BATCH)
    yield f"{loop.right.frame}+{loop.left.frame}", loop.unit, loop.random(rng, BATCH)


def _inputs(kernel: Kernel, poses: Array, rng: np.random.Generator) -> list[Array]:
    """A batch of inputs; what is not a pose is random: the cost of straight-line code does not depend on values."""
    return [poses if name == "q" else rng.standard_normal((BATCH, *shape)) for name, shape in kernel.inputs.items()]


def _seconds(kernel: Kernel, inputs: Sequence[Array], rounds: int) -> float:
    """Median over rounds of the time of one call, each round as many calls as fill SLICE."""
    kernel(*inputs)  # compiles and warms up
    begin = perf_counter()
    kernel(*inputs)
    calls = max(1, round(SLICE / max(perf_counter() - begin, 1e-7)))
    times = []
    for _ in range(rounds):
        begin = perf_counter()
        for _ in range(calls):
            kernel(*inputs)
        times.append((perf_counter() - begin) / calls)
    return float(np.median(times))


def compiler(unit: Unit) -> str:
    """What runs a unit's kernels: the compiler's own version line, or "Python text"."""
    if unit.compiled is None:
        return "Python text"
    found = find_compiler(os.environ.get("CC") or None)
    return "compiled earlier" if found is None else found.version


def figures(context: Context) -> dict[str, Figure]:
    """Operations of the analytic kernels against those of automatic differentiation, where both are known; and time against operations."""
    data = context.data["kernels"]
    both = {name: entry for name, entry in data.items() if entry["operations_by_differentiation"] is not None}
    names = list(both)[::-1]
    bar = {"type": "bar", "orientation": "h", "y": names}
    bars = [
        {**bar, "x": [both[name][key] for name in names], "name": words, "marker": {"color": colour}}
        for key, words, colour in (
            ("operations_by_differentiation", "automatic differentiation", "var(--faint)"),
            ("operations", "generated from screws", "var(--right)"),
        )
    ]
    order = {"barmode": "group", "legend": {"traceorder": "reversed"}, "xaxis": {"title": {"text": "arithmetic operations"}}}
    cloud = {
        "type": "scatter",
        "mode": "markers",
        "x": [entry["operations"] for entry in data.values()],
        "y": [entry["nanoseconds"]["batch"] for entry in data.values()],
        "text": list(data),
        "hovertemplate": "%{text}<br>%{x} operations<br>%{y:.0f} ns per pose<extra></extra>",
        "marker": {"color": "var(--right)", "size": 9, "line": {"color": "var(--card)", "width": 1}},
    }
    titles = (("xaxis", "arithmetic operations"), ("yaxis", "ns per pose in a batch"))
    axes = {axis: {"title": {"text": words}, "type": "log", "tickvals": TICKS} for axis, words in titles}
    return {"kernels-operations": figure(bars, {**order, "margin": {"l": 200}}), "kernels-time": figure([cloud], axes)}
