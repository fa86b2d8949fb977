"""Section "nearest": how far random poses are from the nearest singularity of each kind, in joint space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cga_runtime.report.context import Context
from cga_runtime.report.figures import Figure, figure
from cga_runtime.report.schemes import scheme_name

KINDS = ("limb", "constraint", "actuation")


def section(context: Context) -> dict[str, Any]:
    """For each kind: distances (rad) of random poses without limits and inside them. Local optimisation: upper bounds, not certified."""
    loop, poses = context.loop, context.loop.random(np.random.default_rng(context.seed + 1), context.sizes.poses)
    best = context.data["schemes"]["best_median"]
    result: dict[str, Any] = {}
    for kind in KINDS:
        scheme = best if kind == "actuation" else None
        runs = {
            region: [loop.nearest_singularity(q, kind, scheme, within_limits=inside) for q in poses]
            for region, inside in (("unlimited", False), ("within_limits", True))
        }
        parts = {region: _statistics([n.distance for n in found if n.success], len(found)) for region, found in runs.items()}
        result[kind] = {"scheme": scheme, **parts}
    return result


def _statistics(distances: Sequence[float], tried: int) -> dict[str, Any]:
    """Found of tried, and statistics (rad) of the distances found; None where nothing was found."""
    names = ("minimum", "p05", "median", "p95", "maximum")
    values = np.quantile(distances, (0.0, 0.05, 0.5, 0.95, 1.0)).tolist() if distances else [None] * len(names)
    return {"tried": tried, "found": len(distances), **dict(zip(names, values, strict=True)), "distances": sorted(distances)}


def figures(context: Context) -> dict[str, Figure]:
    """Share of poses whose distance is at most x, one figure for each region of the search."""
    data = context.data["nearest"]
    titles = {"unlimited": "Joint limits ignored", "within_limits": "Inside the joint limits"}
    top = max((max(part["distances"], default=0.0) for kind in KINDS for part in (data[kind][region] for region in titles)), default=1.0)
    return {f"nearest-{region.replace('_', '-')}": _shares(data, region, title, top) for region, title in titles.items()}


STYLE = {"limb": ("var(--right)", "solid"), "constraint": ("var(--force)", "dash"), "actuation": ("var(--left)", "dot")}


def _shares(data: dict[str, Any], region: str, title: str, top: float) -> Figure:
    traces: list[dict[str, Any]] = []
    for kind in KINDS:
        part, (colour, dash) = data[kind][region], STYLE[kind]
        name = kind if kind != "actuation" else f"actuation of {scheme_name(data[kind]['scheme'])}"
        x = [0.0, *part["distances"], 1.05 * top]
        y = [0.0, *(100 * (k + 1) / part["tried"] for k in range(part["found"])), 100 * part["found"] / part["tried"]]
        if not part["found"]:
            x, y, name = [None], [None], f"{name}: none found"  # named in the legend all the same
        line = {"color": colour, "width": 3, "dash": dash, "shape": "hv"}
        hover = "%{y:.0f} % of the poses within %{x:.2f} rad<extra></extra>"
        traces.append({"type": "scatter", "mode": "lines", "x": x, "y": y, "name": name, "line": line, "hovertemplate": hover})
    layout = {
        "title": {"text": title},
        "xaxis": {"title": {"text": "distance found (rad)"}, "range": [0.0, 1.05 * top]},
        "yaxis": {"title": {"text": "share of the poses (%)"}, "range": [0.0, 104.0]},
        "showlegend": True,
        "legend": {"orientation": "v", "x": 0.98, "xanchor": "right", "y": 0.05, "yanchor": "bottom"},
    }
    return figure(traces, layout)
