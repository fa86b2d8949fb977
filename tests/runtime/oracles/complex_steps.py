"""Complex steps through cooperative systems: kernels' Python text at complex joint positions, logarithm and products written anew.

A function that is analytic gives its derivative as the imaginary part over the step, without loss (similarity.md, sections 2 and 4).
"""

import numpy as np

from cga_runtime.kernels import products
from cga_runtime.spaces.cooperative_kernels import primitive_unit

H = 1e-30
"""The step."""


def text(unit, name, *inputs):
    """A kernel's Python text at complex arrays (..., size), (..., entries)."""
    entries = unit.text[name](*[list(np.moveaxis(x, -1, 0)) for x in inputs])
    return np.stack([np.broadcast_to(entry, inputs[0].shape[:-1]) for entry in entries], -1)


def of_chains(system, name, q):
    """A kernel of each chain at complex q (..., n)."""
    found = []
    for chain, index in zip(system.chains, system.joints.index, strict=True):
        own = list(np.moveaxis(q[..., index], -1, 0))
        inputs = [np.stack(np.broadcast_arrays(*chain.layout.body_input(key, own, np)), -1) for key in chain.unit.kernel(name).body]
        found.append(text(chain.unit, name, *inputs))
    return found


def points(system, q):
    """All coordinates of the points, (..., 3 k)."""
    return np.concatenate(of_chains(system, "point", q), axis=-1)


def over_points(system, name, q, chart=1):
    unit = primitive_unit(system.kind)
    x = points(system, q)
    return text(unit, name, *([x] if "chart" not in unit.kernel(name).inputs else [x, np.full((*x.shape[:-1], 1), chart)]))


def point_jacobian(system, q):
    rows = [whole.reshape(*q.shape[:-1], 6, -1)[..., :3, :] for whole in of_chains(system, "jacobian_local_world_aligned", q)]
    wide = np.zeros((*q.shape[:-1], 3 * len(rows), system.n), dtype=complex)
    for k, (row, index) in enumerate(zip(rows, system.joints.index, strict=True)):
        wide[..., 3 * k : 3 * k + 3, index] = row
    return wide


def jacobian(system, name, q, chart=1):
    """A Jacobian of the system at complex q."""
    by_points = over_points(system, name, q, chart)
    return by_points.reshape(*q.shape[:-1], -1, 3 * len(system.chains)) @ point_jacobian(system, q)


def stepped(q):
    return q[..., None, :] + 1j * H * np.eye(q.shape[-1])


def derivative(function, q):
    """(..., m, n) of a function (..., m) of q (..., n)."""
    return np.swapaxes(function(stepped(q)).imag / H, -1, -2)


def norm(x):
    return np.sqrt((x * x).sum(axis=-1))


def log(v):
    """log_s (..., 7) of complex versors (..., 12): p = s R, m = R / s (similarity.md, section 4)."""
    a, k, (w1, w2, w3, w4) = v[..., [0, 1, 2, 3]], v[..., [4, 7, 9, 10]], np.moveaxis(v[..., [5, 6, 8, 11]], -1, 0)
    up, down = norm(a + k), norm(a - k)
    s, size = np.sqrt(up / down), np.sqrt(up * down)
    r = ((a + k) / s[..., None] + (a - k) * s[..., None]) / (2 * size)[..., None]
    r0, r1, r2, r3 = np.moveaxis(r, -1, 0)
    rows = (r0 * w1 + r1 * w2 + r2 * w3 + r3 * w4, r0 * w2 - r1 * w1 + r3 * w3 - r2 * w4, r0 * w3 - r2 * w1 - r3 * w2 + r1 * w4)
    r = np.where(r0.real[..., None] < 0, -r, r)
    n = norm(r[..., 1:])
    near = n == 0
    factor = np.where(near, 2.0, 4 * np.arctan(n / (1 + r[..., 0])) / np.where(near, 1.0, n))
    parts = (*np.moveaxis(-factor[..., None] * r[..., 1:], -1, 0), -np.log(up / down), *(-2 * s / size * row for row in rows))
    return np.stack(np.broadcast_arrays(*parts), -1)


def relative(v, target):
    """~V V_d of complex versors, by the generated product."""
    back = v * [1, -1, -1, -1, -1, -1, -1, 1, -1, 1, 1, 1]
    return np.stack(
        np.broadcast_arrays(*products().similarity_similarity(list(np.moveaxis(back, -1, 0)), list(np.moveaxis(target, -1, 0)))), -1
    )


def weight(x):
    """Signed weight of the points (..., 3 k), (...) (similarity.md, section 2)."""
    first, *others = np.moveaxis(x.reshape(*x.shape[:-1], -1, 3), -2, 0)
    edges = [other - first for other in others]
    match len(edges):
        case 0:
            return np.ones(x.shape[:-1])
        case 1:
            return norm(edges[0])
    normal = np.cross(edges[0], edges[1])
    return norm(normal) if len(edges) == 2 else (normal * edges[2]).sum(axis=-1)
