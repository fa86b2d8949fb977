"""Renders the page: one HTML file with its style, its script, plotly.js and all data inside, that loads nothing from elsewhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from markupsafe import Markup, escape

from cga_runtime.report import cooperative_drawing
from cga_runtime.report.context import Context
from cga_runtime.report.cooperative import BIVECTORS
from cga_runtime.report.cooperative_motions import SELF_MOTIONS
from cga_runtime.report.cooperative_ways import CHARTS
from cga_runtime.report.drawing import draw, three_d
from cga_runtime.report.figures import CLASS_STYLE, THEME, Figure
from cga_runtime.report.kernels import BATCH
from cga_runtime.report.ledger import ledger
from cga_runtime.report.still import still
from cga_runtime.report.strict_json import for_script

HERE = Path(__file__).parent
COLUMNS = (
    ("actuated", ""),
    ("joints", ""),
    ("orbit", ""),
    ("class", ""),
    ("reason", ""),
    ("certified", ""),
    ("μ median", "n"),
    ("μ 5 %", "n"),
    ("μ < 0.01", "n"),
)


def render(context: Context, figures: Mapping[str, Figure]) -> str:
    """The page of a finished context, `figures` by the names that the template asks for."""
    import jinja2
    from plotly.offline import get_plotlyjs

    drawings, scenes = {}, {}
    for key in ("generic", "parallel"):
        pose = context.data["mobility"][key]
        made = draw(context.arms(pose["q"]), pose, context.loop.joint_names)
        drawings[key] = still(made, f"Both arms at the {key} pose with their constraint forces: {pose['motion']}")
        scenes[f"pose-{key}"] = three_d(made)
    for key, (made, title) in cooperative_drawing.drawings(context).items():
        drawings[key], scenes[f"pose-{key}"] = still(made, title), three_d(made)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(HERE), autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {made.__name__: made for made in (number, degrees, power, vector, grounds, subscripts)}
    return environment.get_template("template.html").render(
        data=context.data,
        facts={
            "source": context.robot.source,
            "joints": context.loop.n,
            "joint_names": context.loop.joint_names,
            "compiler": next(iter(context.data["kernels"].values()))["compiler"],
            "batch": BATCH,
            "all_certified": all(row["certified"] for row in context.data["schemes"]["table"]),
        },
        drawings=drawings,
        maps={part: sorted(name for name in figures if name.startswith(f"{part}-")) for part in ("limb", "constraint", "nearest")},
        classes=CLASS_STYLE,
        columns=COLUMNS,
        bivectors=BIVECTORS,
        self_motions=SELF_MOTIONS,
        charts=CHARTS,
        ledger=ledger(context.data),
        titles={name: figure["layout"].get("title", {}).get("text", name) for name, figure in figures.items()},
        figures=for_script({**figures, **scenes}),
        theme=for_script(THEME),
        css=Markup((HERE / "page.css").read_text(encoding="utf-8")),
        script=Markup((HERE / "page.js").read_text(encoding="utf-8")),
        plotly=Markup(get_plotlyjs().replace("</script", "<\\/script")),
    )


def number(value: float | None, digits: int) -> str:
    """Fixed-point, a true minus sign; a dash where there is none."""
    return "–" if value is None else f"{value:.{digits}f}".replace("-", "−")


def degrees(value: float) -> str:
    """An angle given in rad."""
    return f"{57.29577951308232 * value:.2f}°"


def power(value: float, digits: int = 1) -> Markup:
    """A number as a power of ten, to so many digits."""
    if value == 0.0:
        return Markup("0")
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return Markup("{}·10<sup>{}</sup>").format(mantissa, str(int(exponent)).replace("-", "−"))


def vector(values: Sequence[float]) -> str:
    """Components to two digits."""
    return f"({', '.join(number(float(x), 2).replace('−0.00', '0.00') for x in values)})"


def subscripts(name: str) -> Markup:
    """U_R as U with a subscript."""
    first, *rest = name.split("_")
    return Markup("").join([escape(first), *(Markup("<sub>{}</sub>{}").format(part[0], part[1:]) for part in rest)])


def grounds(row: Mapping[str, Any]) -> str:
    """What the class of a scheme rests on."""
    if not row["certified"]:
        return "no"
    return {"admissible": "exact pose", "admissible_off_mirror": "exact pose, mirror sampled", "never": "structure"}[row["class"]]
