"""The cooperative hypersphere of a hand with five fingers against the algebra G(5,1) and casadi's derivatives; where it fails and what is
said then; targets reached."""

import pickle

import casadi
import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import G51
from cga_runtime.elements import Sphere
from cga_runtime.errors import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.spaces.casadi_hypersphere import NAMES
from cga_runtime.spaces.hypersphere import BIVECTORS, BLADES, LIFT, VERSOR, Hypersphere, HypersphereSpace

TOLERANCE = 1e-12
LIFTS = {"one": None, "several": [0.03, -0.05, 0.0, 0.08, 0.02], "balanced": "balanced"}
BESIDE = np.array([[1, 0, 0, 0], [0, 1, 0, -0.0454], [0, 0, 1, 0], [0, 0, 0, 1.0]])
"""A second hand, whose ring finger stands where the first would have its little finger."""


def close(found, expected, tolerance=TOLERANCE):
    assert np.shape(found) == np.shape(expected)
    assert np.abs(found - expected).max() <= tolerance * max(1e-3, np.abs(expected).max())


@pytest.fixture(scope="module")
def fingers():
    """Index, thumb, middle and ring finger of the LEAP hand, and a fifth one: four joints each."""
    hand = cga.load_robot("leap_hand")
    tips = [hand.chain(f"{name}_tip_head") for name in ("index", "thumb", "middle", "ring")]
    return [*tips, hand.chain("ring_tip_head", placement=BESIDE)]


@pytest.fixture(scope="module", params=LIFTS)
def space(request, fingers):
    lifts = LIFTS[request.param]
    return HypersphereSpace.balanced(fingers) if lifts == "balanced" else HypersphereSpace(fingers, lifts)


def clear(space, rng, count=8):
    """Positions away from degenerate ones."""
    q = space.random(rng, 40 * count)
    return q[space.degeneracy(q) > 0.03][:count]


def of(blades, components):
    return Multivector(BladeType("of G(5,1)", G51.masks(" ".join(blades)), G51), components)


# ---- values


def test_names_are_those_of_the_algebra():
    for names in (BIVECTORS, VERSOR, BLADES):
        assert [G51.mask(name) for name in names] == sorted(G51.mask(name) for name in names)


def test_the_versor_carries_the_unit_hypersphere_to_the_primitive(space, rng):
    unit = of(BLADES, [1.0, 0, 0, 0, 0, 0.5])
    for q in clear(space, rng):
        lifted = np.column_stack([space.points(q), space.lifts(q)])
        whole = of(("e0", "e1", "e2", "e3", "e4", "ei"), [1.0, *lifted[0], 0.5 * lifted[0] @ lifted[0]])
        for x in lifted[1:]:
            whole = whole ^ of(("e0", "e1", "e2", "e3", "e4", "ei"), [1.0, *x, 0.5 * x @ x])
        close(space.primitive(q), np.array(whole.coefficients), 1e-10)
        versor, weight = of(VERSOR, space.similarity(q)), np.linalg.det(lifted[1:] - lifted[0])
        moved = (versor * unit * ~versor).project(unit.type).coefficients
        close(np.array(moved), space.primitive(q) / (weight * space.element(q).radius), 1e-9)  # the wedge of world coordinates lost them
        assert np.abs(np.linalg.norm(lifted - space.element(q).center, axis=1) / space.element(q).radius - 1).max() < 1e-13


def test_the_jacobian_is_that_of_the_versor(space, rng):
    """-2 ~V dV/dq within G(5,1), with dV/dq from casadi's differentiation of the whole way from q to V."""
    q = casadi.SX.sym("q", space.n)
    by_ad = casadi.Function("by_ad", [q], [casadi.jacobian(space.casadi("similarity")(q), q)])
    for x in clear(space, rng):
        analytic = np.array(by_ad(x))
        close(space.analytic_jacobian(x), analytic)
        reverse = ~of(VERSOR, space.similarity(x))
        body = np.transpose([(reverse * of(VERSOR, column)).scaled(-2).project(reverse.type).coefficients for column in analytic.T])
        assert np.abs(body[0]).max() < TOLERANCE * np.abs(body).max()
        close(space.geometric_jacobian(x), body[1:])
        assert np.linalg.matrix_rank(space.geometric_jacobian(x), rtol=1e-10) == 5


def test_gradients_equal_casadis_differentiation(space, rng):
    q, at = casadi.SX.sym("q", space.n), clear(space, rng)
    for gradient, of_what in (("degeneracy_gradient", "degeneracy"), ("insphere_gradient", "insphere"), ("point_jacobian", "points")):
        value = casadi.vec(space.casadi(of_what)(q).T)
        by_ad = casadi.Function("by_ad", [q], [casadi.jacobian(value, q)])
        found = getattr(space, gradient)(at)
        assert np.abs(found).max() > 0
        expected = np.array([np.array(by_ad(x)) for x in at]).reshape(found.shape)
        assert np.abs(found - expected).max() < TOLERANCE * np.abs(expected).max()


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("space", ["several", "balanced"], indirect=True)
def test_casadi_equals_numpy(space, rng, name):
    at = clear(space, rng, 3)
    goal = space.element(at[-1])
    made, aims = space.casadi(name), name.startswith("error")
    for q in at[:2]:
        found = np.array(getattr(space, name)(q, *([goal] if aims else [])))
        again = np.array(made(q, *([np.append(goal.center, goal.radius)] if aims else []))).reshape(found.shape)
        assert np.abs(again - found).max() <= 1e-11 * np.abs(found).max()


def test_batches_and_copies(space, rng):
    q = clear(space, rng, 6).reshape(2, 3, -1)
    goal = space.element(q[0, 0])
    for name in (
        "lifts",
        "primitive",
        "slice",
        "log",
        "geometric_jacobian",
        "analytic_jacobian",
        "error",
        "error_jacobian",
        "manipulability",
    ):
        more = (goal,) if name.startswith("error") else ()
        whole = getattr(space, name)(q, *more)
        assert whole.shape[:2] == (2, 3) and np.array_equal(whole[1, 2], getattr(space, name)(q[1, 2], *more))
    assert space.error(q[0, 0], space.element(q)).shape == (2, 3, 5)
    copy = pickle.loads(pickle.dumps(space))
    assert np.array_equal(copy.log(q), space.log(q)) and repr(copy) == repr(space)


def test_errors_and_what_the_jacobian_says(space, rng):
    at = clear(space, rng, 4)
    here, there = at[:2], at[2:]
    goal = space.element(there)
    close(space.error(there, goal), np.zeros((2, 5)), 1e-13)
    close(space.error_jacobian(there, goal), -space.geometric_jacobian(there), 1e-10)
    start, end = (Multivector(of(VERSOR, [0] * 6).type, list(np.moveaxis(space.similarity(q), -1, 0))) for q in (here, there))
    between = (~start * end).project(start.type).coefficients  # cosh, sinh, -t/(2 sqrt d)
    close(space.error(here, goal)[:, 0], -2 * np.arctanh(between[1] / between[0]), 1e-10)
    close(space.error(here, goal)[:, 1:], -2 * (np.array(between[2:]) * np.exp(np.arctanh(between[1] / between[0]))).T, 1e-10)
    close(space.log(here), np.column_stack([-np.log(space.element(here).radius), space.element(here).center]))
    q = casadi.SX.sym("q", space.n)
    c = np.append(goal.center[0], goal.radius[0])
    by_ad = casadi.Function("by_ad", [q], [casadi.jacobian(space.casadi("error")(q, c), q)])
    close(space.error_jacobian(here[0], Hypersphere(goal.center[0], goal.radius[0])), np.array(by_ad(here[0])), 1e-11)
    jacobian, free = space.geometric_jacobian(here), space.nullspace(here)
    assert np.abs(jacobian @ free).max() < 1e-9 * np.abs(jacobian).max() and np.abs(free @ free - free).max() < 1e-12
    close(np.trace(free, axis1=1, axis2=2), np.full(2, space.n - 5.0))
    close(space.manipulability(here), np.sqrt(np.linalg.det(jacobian @ jacobian.swapaxes(1, 2))), 1e-9)


def test_lifts_and_slice_are_those_of_the_points(space, rng):
    q = clear(space, rng)
    sliced, lifts, found = space.slice(q), space.lifts(q), space.element(q)
    powers = ((space.points(q) - sliced[:, None, :3]) ** 2).sum(-1) - sliced[:, 3:]
    close(2 * lifts * found.center[:, 3:] - lifts**2, powers, 1e-9)
    assert found.powers(0.05).shape == (len(q), 1) and space.element(q[0]).powers(lifts[0]).shape == (5,)
    for other in (space.through(space.points(q)), Hypersphere.from_points(space.points(q), lifts)):
        close(space.error(q, other), np.zeros((len(q), 5)))
    if "balanced" not in repr(space):
        assert (lifts == lifts[0]).all() and np.array_equal(lifts[0], space._constant)
    else:
        assert np.abs(np.linalg.norm(lifts, axis=1) - LIFT).max() < 1e-15 and np.abs(lifts.sum(1)).max() < 1e-15


# ---- where it fails


def test_equal_lifts_are_degenerate_for_every_q(fingers):
    for level in (0.0, 0.3):
        with pytest.raises(DegenerateError) as refusal:
            HypersphereSpace(fingers, [level] * 5)
        text = str(refusal.value)
        assert text.startswith(
            f"hypersphere: all lifts are {level:g} m; the five end points then lie in the hyperplane x4 = {level:g} of R^4"
        )
        assert text.endswith("give one chain another lift, or take HypersphereSpace.balanced")


def test_degenerate_fingertips_are_refused(space, rng):
    """Constant lifts: the weight changes its sign on the way from one q to another. Balanced ones: five tips in one plane."""
    good = clear(space, rng)
    message = r"the five lifted points lie in one hyperplane of R\^4: always so with equal lifts"
    weights = space.primitive(good)[:, 0]
    if (weights > 0).all():
        flat = space.points(good[:2]) * [1, 1, 0]
        with pytest.raises(DegenerateError, match=message):
            space.through(flat)
        return
    start, end = good[weights > 0][0], good[weights < 0][0]
    for _ in range(60):
        middle = 0.5 * (start + end)
        start, end = (middle, end) if space.primitive(middle)[0] > 0 else (start, middle)
    q = np.stack([good[0], start])
    assert space.degeneracy(q)[1] < 1e-12
    calls = (space.log, space.similarity, space.geometric_jacobian, space.slice, space.element, space.manipulability, space.nullspace)
    for call in (*calls, lambda x: space.error(x, space.element(good[1]))):
        with pytest.raises(DegenerateError, match=message):
            call(q)
    for total in (space.degeneracy, space.degeneracy_gradient, space.primitive, space.insphere, space.insphere_gradient):
        assert np.isfinite(total(q)).all()


def test_what_is_given_is_checked(fingers, space, rng):
    q = clear(space, rng, 2)
    with pytest.raises(WrongSizeError, match=r"a hypersphere of G\(5,1\) is spanned by 5 chains, 4 given"):
        HypersphereSpace(fingers[:4])
    for lifts in (0.0, [0, 0, 0, 1], np.ones((2, 5))):
        with pytest.raises(WrongSizeError, match="lifts: shape"):
            HypersphereSpace(fingers, lifts)
    with pytest.raises(NotFiniteError, match="lifts holds NaN"):
        HypersphereSpace(fingers, [0, 0, 0, 0, np.nan])
    with pytest.raises(DegenerateError, match="length 0 given, a number of metres above 1e-09 is needed"):
        HypersphereSpace.balanced(fingers, 0)
    with pytest.raises(UnknownNameError, match="unknown target of a hypersphere space 'Sphere'; known: Hypersphere"):
        space.error(q[0], Sphere([0, 0, 0], 1.0))
    with pytest.raises(UnknownNameError, match="unknown function of a hypersphere space 'pose'; known: primitive, slice"):
        space.casadi("pose")
    with pytest.raises(WrongSizeError, match="q and target: batch dimensions"):
        space.error(q, Hypersphere(np.zeros((3, 4)), np.ones(3)))
    with pytest.raises(WrongSizeError, match=r"q: shape \(3,\) given, \(\.\.\., 20\) needed"):
        space.log(np.zeros(3))
    with pytest.raises(DegenerateError, match="radius 0 given, a positive one is needed"):
        Hypersphere(np.zeros(4), 0.0)


# ---- targets reached


def test_damped_gauss_newton_reaches_what_can_be_reached(space, rng):
    """20 random targets, each from 8 random starts at once, inside the joint limits: a joint that would leave them is held for the step."""
    targets, starts = 20, 8
    goal = space.element(np.repeat(clear(space, rng, targets), starts, axis=0))
    q = space.random(rng, targets * starts)
    for _ in range(100):
        q = np.where(space.degeneracy(q)[:, None] < 1e-6, space.random(rng, len(q)), q)
        off, moving = space.error(q, goal), space.error_jacobian(q, goal)
        for _ in range(3):
            square = moving @ moving.swapaxes(1, 2)
            damping = (0.05 * np.minimum(np.linalg.norm(off, axis=1), 1)) ** 2 * np.trace(square, axis1=1, axis2=2) / 5 + 1e-14
            step = -(moving.swapaxes(1, 2) @ np.linalg.solve(square + damping[:, None, None] * np.eye(5), off[..., None]))[..., 0]
            step *= np.minimum(1.0, 0.3 / np.maximum(np.abs(step).max(axis=1, keepdims=True), 1e-12))
            held = (q >= space.upper) & (step > 0) | (q <= space.lower) & (step < 0)
            moving = moving * ~held[:, None]
        q = np.clip(q + step, space.lower, space.upper)
    reached = (np.linalg.norm(space.error(q, goal), axis=1) < 1e-9).reshape(targets, starts)
    assert reached.any(axis=1).all(), reached.sum(axis=1)
