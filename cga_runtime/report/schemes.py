"""Section "schemes": the atlas of all actuation schemes, exact classes and conditioning (paper C, section 5.2.2)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.analysis.schemes import atlas, conditioning, summary
from cga_runtime.report.context import GENERIC_POSE, Context
from cga_runtime.report.figures import CLASS_STYLE, Figure, figure, heat_map, label

Array = NDArray[np.float64]

EXAMPLE = (1, 2, 3, 7)
"""The paper's own admissible example: singular wherever q1 = q6."""

MU = 0.5
"""Where the colours of the maps of mu end, the same for both schemes."""


def section(context: Context) -> dict[str, Any]:
    """Counts of the atlas and its table, one row a scheme."""
    table = atlas(context.loop, context.sizes.samples, context.seed)
    return {**summary(table), "samples": context.sizes.samples, "table": table}


def scheme_name(actuated: Sequence[int]) -> str:
    """Joint numbers of a scheme, e.g. "1 3 9 10"."""
    return " ".join(str(j) for j in actuated)


def orbits(table: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """The row of each orbit's representative with the statistics of mu averaged over the orbit (mirror images differ by the sample only),
    best median first.
    """
    members: dict[tuple[int, ...], list[dict[str, Any]]] = {}
    for row in table:
        members.setdefault(tuple(row["orbit"]), []).append(row)
    rows = []
    for orbit, found in members.items():
        means = {key: float(np.mean([row[key] for row in found])) for key in ("mu_median", "mu_p05", "mu_below_001")}
        rows.append({**next(row for row in found if tuple(row["actuated"]) == orbit), **means})
    return sorted(rows, key=lambda row: -float(row["mu_median"]))


def figures(context: Context) -> dict[str, Figure]:
    """Quality of each orbit (scatter and ranking), which joints to actuate, and mu of the best scheme and of the example over (q1, q6)."""
    data = context.data["schemes"]
    best = tuple(data["best_median"])
    return {
        "schemes-scatter": _scatter(orbits(data["table"])),
        "schemes-ranking": _ranking([row for row in orbits(data["table"]) if row["class"] != "never"]),
        "schemes-pairs": _pairs(context, data["table"]),
        "schemes-slice-best": _slice(context, best),
        "schemes-slice-example": _slice(context, EXAMPLE),
    }


def _hover(row: dict[str, Any]) -> str:
    lines = [f"<b>{scheme_name(row['actuated'])}</b> and mirror image", CLASS_STYLE[row["class"]][0], row["reason"]]
    lines.append(f"median {row['mu_median']:.3f}, 5 % quantile {row['mu_p05']:.3f}, below 0.01 in {100 * row['mu_below_001']:.1f} %")
    return "<br>".join(line for line in lines if line)


def _scatter(rows: Sequence[dict[str, Any]]) -> Figure:
    traces = []
    for kind, (words, colour, symbol) in CLASS_STYLE.items():
        chosen = [row for row in rows if row["class"] == kind]
        traces.append(
            {
                "type": "scatter",
                "mode": "markers",
                "name": f"{words} ({len(chosen)})",
                "x": [row["mu_median"] for row in chosen],
                "y": [row["mu_p05"] for row in chosen],
                "text": [_hover(row) for row in chosen],
                "hovertemplate": "%{text}<extra></extra>",
                "marker": {"color": colour, "symbol": symbol, "size": 9, "opacity": 0.85, "line": {"color": "var(--card)", "width": 1}},
            }
        )
    spans = [max(float(row[key]) for row in rows) for key in ("mu_median", "mu_p05")]
    axes = {
        f"{name}axis": {"title": {"text": f"μ, {words}"}, "range": [-0.03 * span, 1.2 * span]}
        for name, words, span in (("x", "median over poses", spans[0]), ("y", "5 % quantile", spans[1]))
    }
    best = {id(row): row for key in ("mu_median", "mu_p05") for row in sorted(rows, key=lambda r: -float(r[key]))[:3]}
    groups: list[list[dict[str, Any]]] = []
    for row in best.values():  # orbits that fall on one spot share a label
        near = (g for g in groups if all(abs(row[k] - g[0][k]) < 0.02 * s for k, s in zip(("mu_median", "mu_p05"), spans, strict=True)))
        if (group := next(near, None)) is None:
            groups.append([row])
        else:
            group.append(row)
    marks = [
        {
            "x": group[0]["mu_median"],
            "y": group[0]["mu_p05"],
            "text": "<br>".join(scheme_name(row["actuated"]) for row in group),
            "showarrow": False,
            "xshift": 9,
            "xanchor": "left",
            "align": "left",
            "font": {"size": 11},
        }
        for group in groups
    ]
    return figure(traces, {**axes, "annotations": marks})


def _ranking(rows: Sequence[dict[str, Any]]) -> Figure:
    names = [scheme_name(row["actuated"]) for row in rows]
    spans: dict[str, list[Any]] = {"x": [], "y": []}
    for name, row in zip(names, rows, strict=True):
        spans["x"] += [name, name, None]
        spans["y"] += [row["mu_p05"], row["mu_median"], None]
    line = {"color": "var(--faint)", "width": 2}
    traces = [{"type": "scatter", "mode": "lines", **spans, "line": line, "showlegend": False, "hoverinfo": "skip"}]
    for kind, (words, colour, symbol) in CLASS_STYLE.items():
        chosen = [row for row in rows if row["class"] == kind]
        if not chosen:
            continue
        x, text = [scheme_name(row["actuated"]) for row in chosen], [_hover(row) for row in chosen]
        for key, part, style in (("mu_median", "median", symbol), ("mu_p05", "5 % quantile", f"{symbol}-open")):
            marker = {"color": colour, "symbol": style, "size": 8 if key == "mu_median" else 6}
            y = [row[key] for row in chosen]
            common = {"type": "scatter", "mode": "markers", "hovertemplate": "%{text}<extra></extra>", "name": f"{words}: {part}"}
            traces.append({**common, "x": x, "y": y, "text": text, "marker": marker})
    axis: dict[str, Any] = {"title": {"text": "actuated joints (one scheme of each orbit), best median first"}, "type": "category"}
    axis |= {"categoryorder": "array", "categoryarray": names, "tickmode": "linear", "tickangle": -90, "tickfont": {"size": 9}}
    return figure(traces, {"xaxis": axis, "yaxis": {"title": {"text": "μ"}, "rangemode": "tozero"}, "height": 420})


def _pairs(context: Context, table: Sequence[dict[str, Any]]) -> Figure:
    """Best median mu among the schemes that actuate both joints (diagonal: that actuate the joint)."""
    n = context.loop.n
    z = np.zeros((n, n))
    for i in range(1, n + 1):
        for j in range(1, n + 1):
            z[i - 1, j - 1] = max(row["mu_median"] for row in table if i in row["actuated"] and j in row["actuated"])
    numbers = np.arange(1.0, n + 1.0)
    trace, layout = heat_map(numbers, numbers, z, x_title="joint", y_title="joint", z_title="best median μ")
    names = [f"{j} {label(name)}" for j, name in enumerate(context.loop.joint_names, 1)]
    trace |= {"customdata": [[[a, b] for a in names] for b in names]}
    trace["hovertemplate"] = "%{customdata[0]}<br>%{customdata[1]}<br>best median μ %{z:.3f}<extra></extra>"
    trace["zsmooth"] = False
    ticks = {"tickmode": "linear", "dtick": 1, "showgrid": False}
    layout["xaxis"] |= {**ticks, "range": [0.5, n + 0.5]}
    layout["yaxis"] |= {**ticks, "range": [n + 0.5, 0.5], "scaleanchor": "x"}
    return figure([trace], {**layout, "title": {"text": "Which joints to actuate together"}})


def _slice(context: Context, scheme: tuple[int, ...]) -> Figure:
    """mu of a scheme over (q1, q6), the other joints at a mirror-symmetric pose."""
    loop, half = context.loop, context.loop.right.n
    right = np.array(GENERIC_POSE[:half])
    pitch = [np.linspace(loop.lower[j], loop.upper[j], context.sizes.grid) for j in (0, half)]
    q = np.empty((len(pitch[1]), len(pitch[0]), loop.n))
    q[...] = np.concatenate([right, context.mirror * right])
    q[..., 0], q[..., half] = np.meshgrid(*pitch)
    mu = conditioning(loop, q, [scheme])[..., 0]
    trace, layout = heat_map(
        pitch[0], pitch[1], mu, x_title="q1 right ShoulderPitch (rad)", y_title="q6 left ShoulderPitch (rad)", z_title="μ", z_max=MU
    )
    return figure([trace], {**layout, "title": {"text": f"Actuated {scheme_name(scheme)}"}})
