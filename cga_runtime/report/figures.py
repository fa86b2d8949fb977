"""Figures of the page: plotly's own checks on traces and layout, one theme, and colours that follow the page from light to dark.

Colours are written as CSS variables, "var(--right)"; the page replaces them by what its style sheet says when it draws.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.report.strict_json import plain

Array = NDArray[np.float64]
Figure = dict[str, Any]

DIGITS = 5
"""Significant digits of what is drawn; report.json has all of them."""
CLASS_STYLE = {
    "admissible": ("admissible", "var(--good)", "circle"),
    "admissible_off_mirror": ("admissible, singular on mirror poses", "var(--warn)", "diamond"),
    "never": ("never admissible", "var(--bad)", "x"),
}
"""Class of a scheme -> words, colour and symbol (colour never stands alone)."""
SCALE = "Viridis"
"""Even in lightness, and readable with any colour vision; dark is zero, that is singular."""

_AXIS = {
    "gridcolor": "var(--grid)",
    "zerolinecolor": "var(--grid)",
    "linecolor": "var(--faint)",
    "tickcolor": "var(--faint)",
    "automargin": True,
}
_SCENE_AXIS = {"gridcolor": "var(--grid)", "zerolinecolor": "var(--faint)", "showbackground": False, "color": "var(--soft)"}
THEME: Figure = {
    "layout": {
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"color": "var(--ink)"},
        "margin": {"l": 60, "r": 20, "t": 44, "b": 56},
        "title": {"x": 0.0, "xref": "paper", "xanchor": "left", "y": 0.97, "yanchor": "top"},
        "modebar": {"bgcolor": "rgba(0,0,0,0)", "color": "var(--faint)", "activecolor": "var(--accent)"},
        "hoverlabel": {"bgcolor": "var(--card)", "bordercolor": "var(--faint)", "font": {"color": "var(--ink)"}},
        "legend": {"orientation": "h", "yanchor": "bottom", "y": 1.02, "x": 0},
        "xaxis": _AXIS,
        "yaxis": _AXIS,
        "scene": {"xaxis": _SCENE_AXIS, "yaxis": _SCENE_AXIS, "zaxis": _SCENE_AXIS},
    }
}


def figure(traces: Sequence[Mapping[str, Any]], layout: Mapping[str, Any]) -> Figure:
    """Data and layout of a figure as plain JSON. Raises ValueError for properties that plotly does not have."""
    from plotly import graph_objects

    made = graph_objects.Figure(data=[dict(trace) for trace in traces], layout={**layout, "template": None}).to_dict()
    made["layout"].pop("template", None)  # the page adds THEME, once for all figures
    return {"data": plain(_as_given(made["data"], traces), DIGITS), "layout": plain(made["layout"], DIGITS)}


def _as_given(checked: Sequence[Mapping[str, Any]], traces: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Arrays as they came in: plotly packs them into base64, which no reader and no test can look into."""
    arrays = [{key: value for key, value in trace.items() if isinstance(value, (np.ndarray, list))} for trace in traces]
    return [{**made, **given} for made, given in zip(checked, arrays, strict=True)]


def label(text: str) -> str:
    """A name from a robot's file as plotly text: its few markup tags are taken literally."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def heat_map(
    x: Array, y: Array, z: Array, *, x_title: str, y_title: str, z_title: str, z_max: float | None = None
) -> tuple[Figure, Figure]:
    """Trace and layout of a map z[row y, column x] whose colours begin at zero, the singular value."""
    trace = {
        "type": "heatmap",
        "x": x,
        "y": y,
        "z": z,
        "zmin": 0.0,
        "zmax": float(z.max()) if z_max is None else z_max,
        "colorscale": SCALE,
        "zsmooth": "fast",
        "colorbar": {"title": {"text": z_title, "side": "right"}, "thickness": 14, "outlinewidth": 0},
        "hovertemplate": f"{x_title} %{{x:.3f}}<br>{y_title} %{{y:.3f}}<br>{z_title} %{{z:.3f}}<extra></extra>",
    }
    axes = {
        f"{name}axis": {"title": {"text": title}, "range": [float(values[0]), float(values[-1])], "constrain": "domain"}
        for name, title, values in (("x", x_title, x), ("y", y_title, y))
    }
    return trace, axes


def limits_box(low: Sequence[float], high: Sequence[float], name: str = "joint limits") -> tuple[Figure, Figure]:
    """A dashed rectangle between two corners of a map, and a label with its name at the upper left corner."""
    (x0, y0), (x1, y1) = low, high
    trace = {
        "type": "scatter",
        "x": [x0, x1, x1, x0, x0],
        "y": [y0, y0, y1, y1, y0],
        "mode": "lines",
        "line": {"color": "white", "width": 2, "dash": "dash"},
        "showlegend": False,
        "hoverinfo": "skip",
    }
    return trace, on_map(x0, y1, name, xanchor="left", yanchor="top")


def on_map(x: float, y: float, text: str, **options: Any) -> Figure:
    """White words on a map, on a dark ground so that they are read on every colour."""
    return {
        "x": x,
        "y": y,
        "text": text,
        "showarrow": False,
        "font": {"color": "white", "size": 12},
        "bgcolor": "rgba(0,0,0,0.55)",
        "borderpad": 2,
        **options,
    }
