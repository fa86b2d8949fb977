"""Section "reaching": how often, and how fast, IPOPT brings one arm, two arms, or a held object to a target."""

from __future__ import annotations

from typing import Any

from cga_runtime.report.context import Context
from cga_runtime.report.figures import Figure, figure
from cga_runtime.solve.reaching_tasks import run_tasks


def section(context: Context) -> dict[str, Any]:
    """One entry a task: solved, tried, iterations and seconds of the solved problems (None where none was solved)."""
    return dict(run_tasks(context.loop, context.sizes.tries, context.seed))


def figures(context: Context) -> dict[str, Figure]:
    """Median time of each task, with its share of solved problems."""
    tasks = [(name.replace("_", " "), entry) for name, entry in context.data["reaching"].items() if entry["solved"]]
    bars = {
        "type": "bar",
        "orientation": "h",
        "y": [name for name, _ in tasks],
        "x": [1e3 * entry["seconds_median"] for _, entry in tasks],
        "text": [f"{entry['solved']} of {entry['tried']} solved" for _, entry in tasks],
        "textposition": "auto",
        "insidetextanchor": "end",
        "hovertemplate": "%{y}<br>%{x:.1f} ms<br>%{text}<extra></extra>",
        "marker": {"color": "var(--right)"},
        "textfont": {"size": 12},
        "cliponaxis": False,
    }
    layout = {"xaxis": {"title": {"text": "time of a solved problem, median (ms)"}}, "yaxis": {"autorange": "reversed"}, "bargap": 0.35}
    return {"reaching-times": figure([bars], {**layout, "margin": {"t": 10}})}
