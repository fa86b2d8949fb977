"""The report: numbers of every analysis of a two-armed robot as report.json, and the same as one self-contained page."""
