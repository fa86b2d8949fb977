"""Charts of a primitive's rotor: which way it turns the reference direction to the primitive's (similarity.md, section 5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, read
from cga_runtime.errors import WrongSizeError

SEAM = -0.995
"""Cosine between reference direction and direction below which the default chart is -1: the shortest arc, which is what paper A has, is
kept as far as it loses nothing."""
HELD = 0.9
"""A chart that is kept from step to step is left where the cosine to its own pole falls below minus this."""
POLE = -1.0 + 1e-15
"""Cosine at which a chart that is asked for has no rotor."""


def checked(chart: ArrayLike) -> Array:
    """Charts as an array of +1 and -1, (...). Raises WrongSizeError."""
    sense = read(chart, "chart")
    if not (np.abs(sense) == 1.0).all():
        raise WrongSizeError(f"chart: {np.array2string(sense.ravel()[:8])} given, +1 or -1 needed")
    return sense
