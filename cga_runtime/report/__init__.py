"""The report: numbers of every analysis of a two-armed robot as report.json, and the same as one self-contained page."""

from importlib.util import find_spec

from cga_runtime.errors import MissingExtraError

for _package in ("jinja2", "markupsafe", "plotly"):
    if find_spec(_package) is None:
        raise MissingExtraError("the report", _package, "report")
