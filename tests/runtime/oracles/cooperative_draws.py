"""What tests of cooperative reaching share: random elements that are not nearly degenerate, and how degenerate end points are."""

import numpy as np


def corners(x):
    """The least measure of all corners: a distance, sines, determinants of unit edges."""
    if len(x) < 3:
        return 1.0 if len(x) == 1 else np.linalg.norm(x[1] - x[0])
    edges = [np.delete(x, i, axis=0) - x[i] for i in range(len(x))]
    units = [e / np.linalg.norm(e, axis=1, keepdims=True) for e in edges]
    return min(np.linalg.norm(np.cross(*u)) if len(u) == 2 else abs(np.linalg.det(u)) for u in units)


def inside(system, q):
    return bool(((system.lower <= q) & (q <= system.upper)).all())


def batched(element):
    return type(element)(*(getattr(element, name)[None] for name in element.__dataclass_fields__))


def drawn(system, rng, least=0.02):
    """Elements at random positions that are not nearly degenerate."""
    while True:
        q = system.random(rng)
        if corners(system.points(q)) >= least:
            yield system.element(q)
