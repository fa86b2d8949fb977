"""For the moment: names that files in the making still import; they live in elements/charts.py."""

from cga_runtime.elements.charts import KEPT as KEPT
from cga_runtime.elements.charts import SEAM as SEAM
from cga_runtime.elements.charts import read_chart as checked

POLE = -1.0 + 1e-15
HELD = 0.9
__all__ = ["HELD", "KEPT", "POLE", "SEAM", "checked"]
