"""Every Jacobian of cooperative systems against complex steps from q through points to versor, against casadi, and by its definition.

Arms of two kinds, and a hand whose fingers share nothing; shared joints are in test_cooperative.py. Kernels' Python text runs on complex
arrays; logarithm and relative similarity are written anew (oracles/complex_steps.py). Errors are parts of a matrix's largest entry.
"""

import casadi
import numpy as np
import pytest
from complex_steps import H, derivative, jacobian, log, norm, over_points, points, relative, weight

import cga_runtime as cga
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.multivectors import NAMES, Multivector
from cga_runtime.spaces.cooperative_kernels import RATES, primitive_unit
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

ROUNDOFF = 2e-14
B7, V12 = BIVECTORS["similarity"], cga.Similarity.blades
UNIT = {
    "point": {"e0": 1},
    "point_pair": {"e02": 1, "e2i": -0.5},
    "line": {"e02i": 1},
    "circle": {"e012": 1, "e12i": 0.5},
    "plane": {"e012i": 1},
    "sphere": {"e0123": 1, "e123i": -0.5},
}
"""The unit primitives (similarity.md, section 2)."""
SYSTEMS = ("panda point", "arms point_pair", "hand line", "hand circle", "hand plane", "hand sphere")
RANKS = {"point": 3, "point_pair": 6, "line": 4, "circle": 6, "plane": 3, "sphere": 4}


@pytest.fixture(scope="module")
def systems():
    panda, iiwa = cga.load_robot("panda").chain("panda_link8"), cga.load_robot("iiwa14").chain("lbr_link_ee")
    hand = cga.load_robot("leap_hand")
    chains = {
        "panda": [panda],
        "arms": [panda, iiwa],
        "hand": [hand.chain(f"{finger}_tip_head") for finger in ("index", "thumb", "middle", "ring")],
    }
    made = {}
    for name in SYSTEMS:
        robot, kind = name.split()
        made[name] = cga.Cooperative(chains[robot][: PRIMITIVES[kind].points], kind)
    return made


@pytest.fixture(params=SYSTEMS)
def system(request, systems):
    return systems[request.param]


@pytest.fixture
def q(system, rng):
    return system.random(rng, 6)


def close(found, expected, tolerance=ROUNDOFF):
    """(cases, ...): each within a part of its own largest entry, 1 at least."""
    assert found.shape == expected.shape
    found, expected = (np.reshape(x, (len(x), -1)) for x in (found, expected))
    off = np.abs(found - expected).max(axis=1) / np.maximum(1.0, np.abs(expected).max(axis=1))
    assert off.max() < tolerance, off


# ---- the steps themselves


def test_the_steps_themselves(system, q):
    """The text at real q is the compiled kernel; the reverse has the signs of the algebra."""
    close(points(system, q).reshape(6, -1, 3), system.points(q), 4e-15)
    close(over_points(system, "similarity", q), system.similarity(q, 1), 4e-15)
    v = cga.Similarity(system.similarity(q, 1))
    close(log(v.coefficients.astype(complex)).real, v.log())
    other = cga.Similarity.exp([0.4, -0.3, 0.8, 0.1, 0.2, -0.1, 0.3])
    close(relative(v.coefficients, other.coefficients), (~v * other).coefficients)


# ---- first derivatives


def test_point_and_primitive(system, q):
    close(system.point_jacobian(q), derivative(lambda x: points(system, x), q))
    close(system.primitive_jacobian(q), derivative(lambda x: over_points(system, "primitive", x), q))
    close(system.degeneracy_gradient(q)[:, None], derivative(lambda x: over_points(system, "degeneracy", x), q))


@pytest.mark.parametrize("chart", [1, -1])
def test_analytic_and_bivector(system, q, chart):
    """(29), (31)."""
    close(system.analytic_jacobian(q, chart), derivative(lambda x: over_points(system, "similarity", x, chart), q))
    close(system.bivector_jacobian(q, chart), derivative(lambda x: log(over_points(system, "similarity", x, chart)), q))


def columns(values, blades):
    """Matrices (..., blades, n) as multivectors with leading dimensions (..., n)."""
    return Multivector(np.swapaxes(values, -1, -2), blades)


def components(x, blades):
    return np.swapaxes(np.stack([x[name] for name in blades], -1), -1, -2)


@pytest.mark.parametrize("chart", [1, -1])
def test_geometric_and_space(system, q, chart):
    """(30): -2 ~V dV and -2 dV ~V lie in the seven blades, with nothing beside them."""
    v = Multivector(system.similarity(q, chart)[:, None], V12)
    rate = columns(derivative(lambda x: over_points(system, "similarity", x, chart), q), V12)
    for twist, found in (
        (~v * rate, system.geometric_jacobian(q, chart)),
        (rate * ~v, system.space_jacobian(q, chart)),
    ):
        close(found, -2 * components(twist, B7))
        beside = -2 * components(twist, [name for name in NAMES if name not in B7])
        close(beside, np.zeros_like(beside), 2e-15 * max(1.0, np.abs(rate.coefficients).max() * np.abs(v.coefficients).max()))


@pytest.mark.parametrize("chart", [1, -1])
def test_horizontal(system, q, chart):
    """d(X / (w r)) = V [J_h, X_u] ~V with [B, X] = -(B X - X B)/2, in all 32 blades (similarity.md, section 6)."""

    def normalised(x):
        radius = over_points(system, "parts", x, chart)[..., 7] if system.about.round else 1.0
        return over_points(system, "primitive", x) / (weight(points(system, x)) * radius)[..., None]

    v = Multivector(system.similarity(q, chart)[:, None], V12)
    twist = columns(system.horizontal_jacobian(q, chart), B7)
    unit = Multivector(list(UNIT[system.kind].values()), list(UNIT[system.kind]))
    moved = v * (unit * twist - twist * unit) * ~v
    rate = derivative(normalised, q)
    close(0.5 * components(moved, system.blades), rate)
    beside = components(moved, [name for name in NAMES if name not in system.blades])
    close(beside, np.zeros_like(beside))


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-3, 0.3, 0.33, 1.0, 3.0, np.pi - 1e-6])
def test_error(system, q, rng, angle):
    """(44), (47) at errors of any size; at the goal the Jacobian is -J_G."""
    for chart in (1, -1):
        axis = rng.normal(size=(6, 3))
        size = angle / np.pi
        twist = np.concatenate([angle * axis / norm(axis)[:, None], size * rng.normal(size=(6, 4))], axis=-1)
        target = (cga.Similarity(system.similarity(q, chart)) * cga.Similarity.exp(twist)).coefficients
        close(system.error(q, target, chart), twist if angle else np.zeros((6, 7)), ROUNDOFF)

        def error(x, chart=chart, target=target):
            return log(relative(over_points(system, "similarity", x, chart), target[:, None]))

        if angle:
            close(system.error_jacobian(q, target, chart), derivative(error, q))
        else:
            close(system.error_jacobian(q, target, chart), -system.geometric_jacobian(q, chart))


def test_casadi_derivatives(system, q, rng):
    """The same by casadi's differentiation of its own functions."""
    target = cga.Similarity.exp([0.4, -0.3, 0.8, 0.1, 0.2, -0.1, 0.3]).coefficients
    x, v, goal = casadi.SX.sym("x", system.n), rng.normal(size=system.n), casadi.DM(target)
    pairs = [("similarity", "analytic_jacobian"), ("log", "bivector_jacobian"), ("error", "error_jacobian")]
    for value, name in [*pairs, ("primitive", "primitive_jacobian"), ("degeneracy", "degeneracy_gradient")]:
        more = [goal] if value == "error" else []
        slope = casadi.Function(
            "slope", [x], [casadi.jacobian(system.casadi(value, 1 if more or value in ("similarity", "log") else None)(x, *more), x)]
        )
        given = [target, 1] if more else [1] if value in ("similarity", "log") else []
        found = np.array([np.array(slope(row)) for row in q])
        close(found, getattr(system, name)(q, *given).reshape(found.shape))
    for rate, name in RATES.items():
        whole = casadi.vec(system.casadi(name, 1)(x))
        slope = casadi.Function("slope", [x], [casadi.reshape(casadi.jtimes(whole, x, casadi.DM(v)), 7, system.n)])
        close(np.array([np.array(slope(row)) for row in q]), getattr(system, rate)(q, v, 1))


# ---- time derivatives, what Jacobians say


@pytest.mark.parametrize("chart", [1, -1])
def test_time_derivatives(system, q, rng, chart):
    v = rng.normal(size=q.shape)
    for rate, name in RATES.items():
        close(getattr(system, rate)(q, v, chart), jacobian(system, name, q + 1j * H * v, chart).imag / H)
        close(getattr(system, name)(q, chart), jacobian(system, name, q.astype(complex), chart).real)


def test_manipulability(system, q):
    """(59): the volume that the rows span, row after row without its part along those before, and its gradient by complex steps."""

    def volume(x):
        rows, done, product = jacobian(system, "horizontal_jacobian", x)[..., system.about.rows, :], [], 1.0
        for row in np.moveaxis(rows, -2, 0):
            for unit in done:
                row = row - (unit * row).sum(axis=-1, keepdims=True) * unit
            product = product * norm(row)
            done.append(row / norm(row)[..., None])
        return product[..., None]

    values = np.linalg.svd(system.horizontal_jacobian(q)[:, system.about.rows], compute_uv=False)
    loss = max(ROUNDOFF, 1e-15 * (values[:, 0] / values[:, -1]).max())
    close(system.manipulability(q)[:, None], volume(q.astype(complex)).real, loss)
    close(system.manipulability_gradient(q)[:, None], derivative(volume, q), loss)


def has_rank(jacobian, rank):
    """Of matrices (..., m, n), with six digits between."""
    values = np.linalg.svd(jacobian, compute_uv=False)
    return (values[..., rank - 1] > 1e-6 * values[..., 0]).all() and (values[..., rank:] < 1e-13 * values[..., :1]).all()


def test_ranks(system):
    """3, 6, 4, 6, 3, 4 of point, pair, line, circle, plane, sphere, of all three Jacobians (similarity.md, section 6), whoever moves."""
    rng, rank = np.random.default_rng(8), RANKS[system.kind]
    q = system.random(rng, 30)
    for name in ("geometric_jacobian", "bivector_jacobian", "horizontal_jacobian"):
        assert has_rank(getattr(system, name)(q, 1), rank)
    for name in ("geometric_jacobian", "horizontal_jacobian"):
        free = primitive_unit(system.kind).kernel(name)(rng.normal(size=(50, len(system.chains), 3)), [1.0])
        assert has_rank(free, rank) and has_rank(free @ rng.normal(size=(50, free.shape[-1], 20)), rank)


def test_nullspace(system, q, rng):
    """(58) with the pseudo-inverse: a projection on motions that leave the primitive where it is, but for terms of second order."""
    n = system.nullspace(q)
    close(n @ n, n, 1e-14)
    close(np.swapaxes(n, -1, -2), n, 1e-15)
    close(system.horizontal_jacobian(q) @ n, np.zeros((6, 7, system.n)))
    assert np.abs(np.trace(n, axis1=1, axis2=2) - system.n + RANKS[system.kind]).max() < 1e-12
    v = (n @ rng.normal(size=(6, system.n, 1)))[..., 0]
    still = system.element(q).coefficients
    off, halved = (np.abs(system.element(q + h * v).coefficients - still).max(axis=-1) for h in (2e-4, 1e-4))
    assert np.abs(off / halved - 4.0).max() < 0.2
    assert (off < 0.05 * np.abs(system.element(q + 2e-4 * rng.normal(size=q.shape)).coefficients - still).max(axis=-1)).all()
