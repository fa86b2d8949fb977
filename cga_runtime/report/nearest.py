"""Section "nearest": how far random poses are from the nearest singularity of each kind, in joint space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cga_runtime.report.context import Context
from cga_runtime.report.figures import Figure, figure
from cga_runtime.report.schemes import scheme_name

KINDS = ("limb", "constraint", "actuation")
BINS = 24


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
    """Histograms of the distances, one figure for each region of the search."""
    data = context.data["nearest"]
    titles = {"unlimited": "joint limits ignored", "within_limits": "inside the joint limits"}
    top = max((max(part["distances"], default=0.0) for kind in KINDS for part in (data[kind][region] for region in titles)), default=1.0)
    return {f"nearest-{region.replace('_', '-')}": _histogram(data, region, title, top) for region, title in titles.items()}


def _histogram(data: dict[str, Any], region: str, title: str, top: float) -> Figure:
    colours = {"limb": "var(--right)", "constraint": "var(--force)", "actuation": "var(--left)"}
    traces, words = [], []
    for kind in KINDS:
        part = data[kind][region]
        name = kind if kind != "actuation" else f"actuation of {scheme_name(data[kind]['scheme'])}"
        if part["found"]:
            bins = {"start": 0.0, "end": 1.001 * top, "size": 1.001 * top / BINS}
            marker = {"color": colours[kind], "line": {"color": "var(--card)", "width": 1}}
            traces.append({"type": "histogram", "x": part["distances"], "name": name, "xbins": bins, "autobinx": False, "marker": marker, "opacity": 0.75})
        else:
            words.append(f"{name}: none found ({part['tried']} poses)")
    note = {"xref": "paper", "yref": "paper", "x": 1, "y": 0.98, "xanchor": "right", "yanchor": "top", "showarrow": False, "align": "right"}
    layout = {
        "barmode": "overlay",
        "title": {"text": title, "font": {"size": 14}},
        "xaxis": {"title": {"text": "distance to the nearest singularity found (rad)"}, "range": [0.0, 1.02 * top]},
        "yaxis": {"title": {"text": "poses"}},
        "showlegend": True,
        "annotations": [{**note, "text": "<br>".join(words)}] if words else [],
    }
    return figure(traces, layout)
