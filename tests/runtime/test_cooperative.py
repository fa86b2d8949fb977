"""Cooperative systems of a humanoid whose arms share its waist, and of free points: values, batches, targets, fused kernels, casadi.

Values are checked by products of the algebra, by the elements and versors of the package, which start from points too, and by each other.
"""

from pathlib import Path

import numpy as np
import pytest
from complex_steps import derivative, log, over_points, points
from sliding_points import gantries

import cga_runtime as cga
from cga_runtime.elements.similarities import similarity_of
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.multivectors import NAMES
from cga_runtime.spaces.casadi_cooperative import NAMES as FUNCTIONS
from cga_runtime.spaces.cooperative_kernels import RATES
from cga_runtime.spaces.primitive_kinds import PRIMITIVES

FACING = np.array([[-1, 0, 0, 0.9], [0, -1, 0, 0.1], [0, 0, 1, 0.2], [0, 0, 0, 1.0]])
"""A second robot that faces the first."""
UNIT = {
    "point": {"e0": 1},
    "point_pair": {"e02": 1, "e2i": -0.5},
    "line": {"e02i": 1},
    "circle": {"e012": 1, "e12i": 0.5},
    "plane": {"e012i": 1},
    "sphere": {"e0123": 1, "e123i": -0.5},
}
"""The unit primitives (similarity.md, section 2)."""
ROUNDOFF = 1e-13
TAKES_CHART = ("similarity", "log", "analytic_jacobian", "geometric_jacobian", "space_jacobian", "horizontal_jacobian", "bivector_jacobian")
PLAIN = ("points", "point_jacobian", "primitive", "primitive_jacobian", "degeneracy", "degeneracy_gradient")
MEASURES = ("nullspace", "manipulability", "manipulability_gradient")


def close(a, b, tolerance=ROUNDOFF):
    """Within a part of the largest entry, 1 at least."""
    assert np.shape(a) == np.shape(b)
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance * max(1.0, np.abs(b).max(initial=0.0)), equal_nan=False)


@pytest.fixture(scope="module")
def chains():
    """Chains by name, made once."""
    g1 = cga.load_robot("g1")
    arms = [g1.chain(f"{side}_shoulder_yaw_link") for side in ("left", "right")]
    return {"gantries": gantries(), "g1": [*arms, g1.chain("torso_link", offset=(0.1, 0.0, 0.3))]}


SYSTEMS = ("g1 circle", "gantries point_pair")


@pytest.fixture(scope="module")
def systems(chains):
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


def call(system, name, q, chart, v):
    """A method by name, with the inputs that it takes."""
    more = {} if name in (*PLAIN, *MEASURES) else {"chart": chart}
    if name in RATES:
        return getattr(system, name)(q, v, **more)
    if name.startswith("error"):
        return getattr(system, name)(q, TARGET, **more)
    return getattr(system, name)(q, **more)


TARGET = cga.Similarity.exp([0.4, -0.3, 0.8, 0.1, 0.2, -0.1, 0.3]).coefficients

# ---- what a system is


def test_joints_of_two_robots_of_one_kind_are_numbered():
    panda = cga.load_robot("panda").chain("panda_link8")
    pair = cga.Cooperative([panda, panda.robot.chain("panda_link8", placement=FACING)], "point_pair")
    assert pair.joint_names == tuple(f"{k}:panda_joint{j}" for k in (1, 2) for j in range(1, 8)) and pair.n == 14
    assert cga.Cooperative([panda], "point").joint_names == cga.Cooperative(panda, "point").joint_names == panda.joint_names


def test_shared_joints_count_once(systems):
    circle = systems["g1 circle"]
    waist = ("waist_yaw_joint", "waist_roll_joint", "waist_pitch_joint")
    assert circle.n == 9 and circle.joint_names[:3] == waist and len(set(circle.joint_names)) == 9
    moving = np.abs(circle.point_jacobian(circle.random(np.random.default_rng(0), 20))).max(axis=0).reshape(3, 3, 9).max(axis=1) > 1e-9
    assert moving[:, 1:3].all() and not moving[2, 3:].any() and not moving[0, 6:].any() and not moving[1, 3:6].any()
    assert repr(circle) == "<Cooperative circle of " + " + ".join(f"g1/{chain.frame}" for chain in circle.chains) + ": 9 joints>"


def test_jacobians_over_shared_joints(systems, rng):
    """By complex steps of q; the other Jacobians of any system are in test_cooperative_jacobians.py."""
    system = systems["g1 circle"]
    q = system.random(rng, 6)
    close(system.point_jacobian(q), derivative(lambda x: points(system, x), q), 1e-14)
    close(system.analytic_jacobian(q, 1), derivative(lambda x: over_points(system, "similarity", x), q), 1e-14)
    close(system.bivector_jacobian(q, 1), derivative(lambda x: log(over_points(system, "similarity", x)), q), 1e-14)
    close(system.degeneracy_gradient(q), derivative(lambda x: over_points(system, "degeneracy", x), q)[:, 0], 1e-14)


def test_points_are_those_of_the_chains(system, q):
    for k, (chain, index) in enumerate(zip(system.chains, system.joints.index, strict=True)):
        np.testing.assert_array_equal(system.points(q)[:, k], chain.point(q[:, index]))
        whole = system.joints.spread(chain.jacobian(q[:, index])[..., :3, :], k)
        np.testing.assert_array_equal(system.point_jacobian(q)[:, 3 * k : 3 * k + 3], whole)


def test_the_primitive_is_the_outer_product_of_the_points(system, q):
    whole = cga.Multivector(np.ones((len(q), 1)), ["1"])
    for x in np.moveaxis(system.points(q), -2, 0):
        whole = whole ^ cga.Point(x)
    if system.kind in ("line", "plane"):
        whole = whole ^ cga.Multivector([1.0], ["ei"])
    close(system.primitive(q), np.stack([whole[name] for name in system.blades], -1), 1e-15)
    assert set(system.blades) >= {name for name in whole.blades if np.abs(whole[name]).max() > 1e-14}


def size(system, q):
    """What the primitive is divided by to be V X_u ~V, (..., 1)."""
    radius = system.element(q).radius if system.about.round else 1.0
    return (system.weight(q) * radius)[..., None]


@pytest.mark.parametrize("chart", [1, -1])
def test_the_similarity_carries_the_unit_primitive(system, q, chart):
    """(28) as corrected: V X_u ~V = X / (w r), in both charts."""
    v = cga.Similarity(system.similarity(q, chart))
    unit = cga.Multivector(list(UNIT[system.kind].values()), list(UNIT[system.kind]))
    moved = v * unit * ~v
    scaled = system.primitive(q) / size(system, q)
    close(np.stack([moved[name] for name in system.blades], -1), scaled)
    others = [moved[name] for name in NAMES if name not in system.blades]
    assert np.abs(others).max() < ROUNDOFF * max(1, np.abs(scaled).max())
    if system.kind != "point":
        close(system.element(q).coefficients, scaled)


@pytest.mark.parametrize("chart", [1, -1])
def test_log_is_the_logarithm_of_the_similarity(system, q, chart):
    v = cga.Similarity(system.similarity(q, chart))
    close(system.similarity(q, chart), similarity_of(system.element(q), chart).coefficients)
    close(system.log(q, chart), v.log())
    close(cga.Similarity.exp(system.log(q, chart)).matrix(), v.matrix())


@pytest.mark.parametrize("chart", [1, -1])
def test_error_is_the_logarithm_of_the_relative_similarity(system, q, chart, rng):
    """(44): log(~V V_d), of a target as element, similarity or 12 numbers; zero at the goal."""
    goal, v = system.element(system.random(rng, 6)), cga.Similarity(system.similarity(q, chart))
    target = similarity_of(goal, chart)
    expected = ((~v) * target).log()
    close(system.error(q, goal, chart), expected)
    close(system.error(q, target, chart), expected)
    close(system.error(q, target.coefficients, chart), expected)
    close(system.error(q, -target.coefficients, chart), expected)
    close(system.error(q, system.element(q), chart), np.zeros((6, 7)), 1e-14)
    close(system.error(q, v, chart), np.zeros((6, 7)), 1e-14)


# ---- arrays of any shape


@pytest.mark.parametrize("shape", [(), (5,), (2, 3), (0,), (2, 0)])
def test_every_method_keeps_leading_dimensions(systems, rng, shape):
    for name in ("g1 circle", "gantries point_pair"):
        system = systems[name]
        q, v = system.random(rng, shape), rng.normal(size=(*shape, system.n))
        for method in (*PLAIN, *TAKES_CHART, *RATES, *MEASURES, "error", "error_jacobian", "weight", "chart"):
            if method in ("weight", "chart"):
                values = getattr(system, method)(q)
            else:
                values = call(system, method, q, None, v)
            singles = [
                getattr(system, method)(x) if method in ("weight", "chart") else call(system, method, x, None, y)
                for x, y in zip(q.reshape(-1, system.n), v.reshape(-1, system.n), strict=True)
            ]
            assert values.shape[: len(shape)] == shape and values.dtype == np.float64
            if singles:
                assert values.shape[len(shape) :] == singles[0].shape
                close(values.reshape(len(singles), *singles[0].shape), np.array(singles), 1e-14)


def test_v_chart_and_target_have_leading_dimensions_of_their_own(systems, rng):
    system = systems["g1 circle"]
    q, v = system.random(rng, (4, 1)), rng.normal(size=(3, system.n))
    rates = system.geometric_jacobian_derivative(q, v)
    assert rates.shape == (4, 3, 7, system.n)
    close(rates[2, 1], system.geometric_jacobian_derivative(q[2, 0], v[1]))
    both = system.similarity(q, [1, -1])
    assert both.shape == (4, 2, 12)
    close(both[3, 1], system.similarity(q[3, 0], -1))
    goals = system.element(system.random(rng, 3))
    for chart in (None, 1, [1, -1, 1]):
        for name in ("error", "error_jacobian"):
            values = getattr(system, name)(q, goals, chart)
            assert values.shape[:2] == (4, 3)
            one = system.element(np.zeros(system.n)).__class__(goals.center[2], goals.normal[2], goals.radius[2])
            close(values[1, 2], getattr(system, name)(q[1, 0], one, chart if chart is None else np.ravel(chart)[-1]))


# ---- fused kernels and casadi


@pytest.fixture(scope="module")
def mimic():
    """A line whose chains share three joints; one of them turns two bodies, one slides."""
    small = cga.load_robot(Path(__file__).parents[1] / "data" / "four_links.urdf")
    system = cga.Cooperative([small.chain("d"), small.chain("c", offset=(0.3, -0.2, 0.1))], "line")
    assert system.joint_names == ("turn", "slide", "roll")
    return system


def condition(system, q):
    """Largest over smallest singular value of the controllable rows, the largest of all q."""
    values = np.linalg.svd(system.horizontal_jacobian(q)[..., system.about.rows, :], compute_uv=False)
    return (values[..., 0] / values[..., -1]).max()


def test_fused_is_the_same(mimic, rng):
    fused = mimic.fuse()
    assert fused.fused and not mimic.fused and fused.joint_names == mimic.joint_names
    q, v = mimic.random(rng, (2, 4)), rng.normal(size=(2, 4, mimic.n))
    for name in (*PLAIN, *TAKES_CHART, *RATES, "error", "error_jacobian", *MEASURES):
        for chart in (None, 1, -1):
            close(call(fused, name, q, chart, v), call(mimic, name, q, chart, v))
    for name in ("log", "error", "horizontal_jacobian_derivative"):
        one, other = fused.casadi(name), mimic.casadi(name)
        given = [*([v[0, 0]] if name in RATES else []), *([TARGET] if name == "error" else [])]
        close(np.array(one(q[0, 0], *given)), np.array(other(q[0, 0], *given)))


def test_fewer_joints_than_rows(mimic, rng):
    """Nothing is left in the nullspace and no volume is spanned; casadi says the same, or that it cannot."""
    q = mimic.random(rng)
    assert mimic.n < len(mimic.controllable)
    close(mimic.nullspace(q), np.zeros((3, 3)))
    assert mimic.manipulability(q) == 0.0 and not mimic.manipulability_gradient(q).any()
    for name in MEASURES:
        try:
            found = np.array(mimic.casadi(name)(q))
        except cga.CgaError:
            continue
        close(found.reshape(np.shape(getattr(mimic, name)(q))), getattr(mimic, name)(q))


@pytest.mark.parametrize(("name", "chart"), [("g1 circle", None), ("g1 circle", -1), ("gantries point_pair", None)])
def test_casadi_functions_are_the_same(systems, rng, name, chart):
    """In the chart of the default and in the other; matrices of casadi have two dimensions, vectors are columns."""
    system = systems[name]
    q, v = system.random(rng, 6), rng.normal(size=(6, system.n))
    for name in FUNCTIONS:
        if name == "parts":
            continue  # no method of that name: rotor, centre and radius are those of the similarity
        function = system.casadi(name, chart)
        given = [q, *([v] if name in RATES else []), *([np.tile(TARGET, (6, 1))] if name.startswith("error") else [])]
        assert function.name_in() == ["q", *(["v"] if name in RATES else []), *(["target"] if name.startswith("error") else [])]
        found = np.array([np.array(function(*row)) for row in zip(*given, strict=True)])
        value = np.asarray(call(system, name, q, chart, v))
        # a projection is as well known as its vectors, and they turn by rounding times the condition
        close(found.reshape(value.shape), value, max(ROUNDOFF, 2e-16 * condition(system, q)) if name in MEASURES else ROUNDOFF)


def test_controllable_rows_are_those_of_table_1(system, q):
    jacobian = system.horizontal_jacobian(q)
    still = [k for k, name in enumerate(BIVECTORS["similarity"]) if name not in system.controllable]
    assert not jacobian[:, still].any()
    assert np.linalg.matrix_rank(jacobian[0]) == min(len(system.controllable), system.n)
