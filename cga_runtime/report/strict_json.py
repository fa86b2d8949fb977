"""JSON without NaN, infinity or numpy types, and in a form that may stand inside a script element."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from markupsafe import Markup


def plain(value: Any, digits: int | None = None) -> Any:
    """The same data as dicts, lists, numbers, strings, bools and None; floats rounded to `digits` significant ones if given.

    Raises TypeError for anything else, and ValueError for NaN or infinity: a number that is not there has to be said as None.
    """
    if isinstance(value, dict):
        return {str(key): plain(item, digits) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item, digits) for item in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist(), digits)
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        number = float(value)
        if not np.isfinite(number):
            raise ValueError(f"{number} cannot be written as JSON")
        return number if digits is None else float(f"{number:.{digits}g}")
    raise TypeError(f"{type(value).__name__} cannot be written as JSON")


def text(value: Any) -> str:
    """Indented JSON of plain data."""
    return json.dumps(plain(value), allow_nan=False, indent=1, ensure_ascii=False) + "\n"


def for_script(value: Any, digits: int | None = None) -> Markup:
    """Compact JSON that cannot end the script element it stands in."""
    compact = json.dumps(plain(value, digits), allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        compact = compact.replace(character, f"\\u{ord(character):04x}")
    return Markup(compact)  # noqa: S704  every character that HTML reads is written as an escape
