"""Dynamics kernels of trees on plain floats: against Pinocchio (mimicking joints by projection of independent ones, floating bases by its
free flyer), against each other, and derivatives against the complex step. The robots: a made-up tree with sliding, oblique and turned
joints, a joint without a body, rotors, and gravity along no axis; in four forms."""

from dataclasses import replace

import casadi
import mpmath
import numpy as np
import pinocchio
import pytest
from joint_by_joint import H, Subject, floated, loaded, make

from cga_codegen.catalogue import TREE_KERNELS, MassError
from cga_codegen.kernels import articulated, differentiation, dynamics, dynamics_derivatives, tree_kinematics
from cga_codegen.kernels.tree import Mass, Tree
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import Frame, Inertia, ModelError, Placement, RobotModel
from cga_codegen.units import made

STATES = 4
ROUNDING = 2e-14
"""Relative to the largest entry of the answer."""


def close(found, expected, tolerance=ROUNDING):
    found, expected = np.array(found, dtype=np.float64).ravel(), np.array(expected, dtype=np.float64).ravel()
    assert found.shape == expected.shape
    assert np.abs(found - expected).max() <= tolerance * max(1.0, np.abs(expected).max())


def square(subject, entries):
    return np.array(entries).reshape(subject.n, subject.n)


def symmetric(matrix):
    """Pinocchio fills the upper triangle."""
    return np.triu(matrix) + np.triu(matrix, 1).T


def standing(inputs):
    return {key: value for key, value in inputs.items() if key != "base"}


# ---- against Pinocchio


def test_forces_are_pinocchio_s(subject):
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, v, a in subject.states(STATES, 1):
        x, given = subject.peer.position(q), subject.inputs(q)
        close(dynamics.inverse_dynamics(subject.tree, **given, v=v, a=a), g.T @ pinocchio.rnea(model, data, x, g @ v, g @ a))
        close(dynamics.bias(subject.tree, **given, v=v), g.T @ pinocchio.nonLinearEffects(model, data, x, g @ v))
        close(dynamics.gravity(subject.tree, **given), g.T @ pinocchio.computeGeneralizedGravity(model, data, x))


def test_mass_matrix_is_pinocchio_s(subject):
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, _, _ in subject.states(STATES, 2):
        found = square(subject, dynamics.mass_matrix(subject.tree, **standing(subject.inputs(q))))
        close(found, g.T @ symmetric(pinocchio.crba(model, data, subject.peer.position(q))) @ g)
        assert np.array_equal(found, found.T) and np.linalg.eigvalsh(found).min() > 0
        rotors = np.diag(subject.tree.armature())
        assert rotors.any()
        bare = Tree.of(replace(subject.model, joints=tuple(replace(j, armature=0.0) for j in subject.model.joints)))
        close(found - square(subject, dynamics.mass_matrix(bare, **standing(subject.inputs(q)))), g.T @ rotors @ g)


def test_forward_dynamics_is_pinocchio_s(subject):
    """By its aba, or by its matrices where joints mimic; and by both of our ways."""
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, v, tau in subject.states(STATES, 3):
        x, given = subject.peer.position(q), subject.inputs(q)
        if np.array_equal(g, np.eye(subject.n)):
            expected = pinocchio.aba(model, data, x, v, tau)
            close(articulated.forward_dynamics(subject.tree, **given, v=v, tau=tau), expected, 1e-12)
        else:
            mass = g.T @ symmetric(pinocchio.crba(model, data, x)) @ g
            expected = np.linalg.solve(mass, tau - g.T @ pinocchio.nonLinearEffects(model, data, x, g @ v))
        close(dynamics.forward_dynamics(subject.tree, **given, v=v, tau=tau), expected, 1e-12)


def test_coriolis_matrix_is_pinocchio_s(subject):
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, v, _ in subject.states(STATES, 4):
        expected = g.T @ pinocchio.computeCoriolisMatrix(model, data, subject.peer.position(q), g @ v) @ g
        close(dynamics_derivatives.coriolis(subject.tree, **standing(subject.inputs(q)), v=v), expected)


def test_derivatives_are_pinocchio_s(subject):
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, v, a in subject.states(STATES, 5):
        given = subject.inputs(q)
        pinocchio.computeRNEADerivatives(model, data, subject.peer.position(q), g @ v, g @ a)
        close(dynamics_derivatives.inverse_dynamics_by_q(subject.tree, **given, v=v, a=a), g.T @ data.dtau_dq @ g)
        close(dynamics_derivatives.inverse_dynamics_by_v(subject.tree, **standing(given), v=v), g.T @ data.dtau_dv @ g)


def test_kinematics_is_pinocchio_s(subject):
    g, model, data = subject.peer.gather, subject.peer.model, subject.peer.data
    for q, _, _ in subject.states(STATES, 6):
        x, given = subject.peer.position(q), subject.inputs(q)
        pinocchio.framesForwardKinematics(model, data, x)
        expected = [data.oMf[subject.peer.frames[frame.name]].homogeneous for frame in subject.model.frames]
        close(tree_kinematics.frames(subject.tree, **given), expected, 2e-15)
        close(tree_kinematics.center_of_mass(subject.tree, **given), pinocchio.centerOfMass(model, data, x), 2e-15)
        close(tree_kinematics.center_of_mass_jacobian(subject.tree, **given), pinocchio.jacobianCenterOfMass(model, data, x) @ g, 4e-15)


# ---- against each other, and the complex step


def test_forward_dynamics_undoes_inverse_dynamics(subject):
    ways = [dynamics.forward_dynamics]
    ways += [articulated.forward_dynamics] if not any(j.follows for j in subject.model.joints) else []
    for q, v, a in subject.states(STATES, 7):
        given = subject.inputs(q)
        tau = dynamics.inverse_dynamics(subject.tree, **given, v=v, a=a)
        for way in ways:
            close(way(subject.tree, **given, v=v, tau=tau), a, 1e-12)


def test_terms_add_up(subject):
    for q, v, a in subject.states(STATES, 8):
        given = subject.inputs(q)
        gravity = np.array(dynamics.gravity(subject.tree, **given))
        mass = square(subject, dynamics.mass_matrix(subject.tree, **standing(given)))
        coriolis = square(subject, dynamics_derivatives.coriolis(subject.tree, **standing(given), v=v))
        close(dynamics.bias(subject.tree, **given, v=v) - gravity, coriolis @ v)
        close(dynamics.inverse_dynamics(subject.tree, **given, v=v, a=a), mass @ a + coriolis @ v + gravity)
        twice = square(subject, dynamics_derivatives.coriolis(subject.tree, **standing(given), v=2 * v))
        close(twice, 2 * coriolis)


def test_the_rate_of_the_mass_matrix_minus_twice_coriolis_is_skew(subject):
    for q, v, _ in subject.states(STATES, 9):
        by_q = subject.by_q(lambda x: dynamics.mass_matrix(subject.tree, **standing(subject.inputs(x))), q)
        rate = square(subject, by_q @ v)
        coriolis = square(subject, dynamics_derivatives.coriolis(subject.tree, **standing(subject.inputs(q)), v=v))
        close(rate - coriolis - coriolis.T, np.zeros((subject.n, subject.n)), ROUNDING * np.abs(rate).max())


@pytest.mark.parametrize("name", ["skew", "skew, mimicking"])
def test_christoffel_s_symbols(name):
    """Where velocities are rates of q: C_ij = sum_k (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) v_k / 2, which fixes C among all choices."""
    subject = make(name)
    for q, v, _ in subject.states(2, 10):
        d = subject.by_q(lambda x: dynamics.mass_matrix(subject.tree, **subject.inputs(x)), q).reshape(subject.n, subject.n, subject.n)
        expected = (np.einsum("ijk,k->ij", d, v) + np.einsum("ikj,k->ij", d, v) - np.einsum("jki,k->ij", d, v)) / 2
        close(dynamics_derivatives.coriolis(subject.tree, **subject.inputs(q), v=v), expected)


def test_derivatives_by_the_complex_step(subject):
    for q, v, a in subject.states(2, 11):
        given = subject.inputs(q)
        by_q = subject.by_q(lambda x, v=v, a=a: dynamics.inverse_dynamics(subject.tree, **subject.inputs(x), v=v, a=a), q)
        close(dynamics_derivatives.inverse_dynamics_by_q(subject.tree, **given, v=v, a=a), by_q)
        steps = [dynamics.bias(subject.tree, **given, v=v + 1j * H * e) for e in np.eye(subject.n)]
        by_v = np.array(steps, dtype=complex).imag.T / H
        close(dynamics_derivatives.inverse_dynamics_by_v(subject.tree, **standing(given), v=v), by_v)
        at = subject.by_q(lambda x: tree_kinematics.center_of_mass(subject.tree, **subject.inputs(x)), q)
        close(tree_kinematics.center_of_mass_jacobian(subject.tree, **given), at)


def test_automatic_differentiation_gives_the_same(subject):
    n, joints = subject.n, len(subject.coordinates.motions)
    symbols = {"c": casadi.SX.sym("c", joints), "s": casadi.SX.sym("s", joints), "v": casadi.SX.sym("v", n), "a": casadi.SX.sym("a", n)}
    if subject.floating:
        symbols["base"] = casadi.SX.sym("base", 8)
    for name in ("coriolis", "inverse_dynamics_by_q", "inverse_dynamics_by_v"):
        if name == "coriolis" and subject.floating:
            continue
        takes = {"c", "s", "v", *({"a", "base"} if name == "inverse_dynamics_by_q" else ())} & symbols.keys()
        given = {key: symbols[key] for key in sorted(takes)}
        entries = getattr(differentiation, name)(subject.tree, **{key: x.elements() for key, x in given.items()})
        function = casadi.Function("f", list(given.values()), [casadi.vertcat(*entries)])
        for q, v, a in subject.states(2, 12):
            values = {**subject.inputs(q), "v": v, "a": a}
            expected = getattr(dynamics_derivatives, name)(subject.tree, **{key: values[key] for key in given})
            close(np.array(function(*(values[key] for key in given))), expected)


@pytest.mark.parametrize("change", [lambda model: model, floated], ids=["fixed", "floating"])
def test_of_two_ways_the_cheaper_is_made(change):
    subject = Subject(change(loaded(load_urdf(PLAIN))))
    for kernel in (k for k in TREE_KERNELS if k.instead is not None):
        ways = [kernel.function, *([kernel.instead] if kernel.instead_for(subject.tree) else [])]
        found = made(kernel, subject.tree)
        costs = [made(replace(kernel, function=way, instead=None), subject.tree).program.counts().total for way in ways]
        taken = 1 if len(costs) == 2 and costs[1] < kernel.worth * costs[0] else 0
        assert found.function == ways[taken] and found.program.counts().total == costs[taken]


# ---- borders


def test_fifty_digits():
    """Right angles and dyadic numbers only: the doubles of the model are exact, and what two ways to one value differ by is rounding."""
    inertia = Inertia(2.0, (0.5, -0.25, 0.125), (1.0, 0.125, 0.0, 2.0, -0.25, 1.5))
    model = load_urdf(PLAIN)
    rotors = (0.5, 0.0, 1.46875)  # which make the constants that are divided by 4.0
    joints = tuple(replace(j, inertia=inertia, armature=rotor) for j, rotor in zip(model.joints, rotors, strict=True))
    tree = Tree.of(replace(model, joints=joints, gravity=(1.0, -2.0, -9.75)))
    rng = np.random.default_rng(14)
    with mpmath.workdps(50):
        for q, v, a in rng.normal(size=(3, 3, 3)):
            x, v, a = ([mpmath.mpf(y) for y in row] for row in (q, v, a))
            c, s = [mpmath.cos(x[0]), mpmath.mpf(1), mpmath.cos(x[2])], [mpmath.sin(x[0]), x[1], mpmath.sin(x[2])]
            tau = dynamics.inverse_dynamics(tree, c, s, v, a)
            mass, coriolis = dynamics.mass_matrix(tree, c, s), dynamics_derivatives.coriolis(tree, c, s, v)
            gravity = dynamics.gravity(tree, c, s)
            summed = [sum(mass[3 * i + k] * a[k] + coriolis[3 * i + k] * v[k] for k in range(3)) + gravity[i] for i in range(3)]
            found = [dynamics.forward_dynamics(tree, c, s, v, tau), articulated.forward_dynamics(tree, c, s, v, tau)]
            for ours, expected in ((summed, tau), (found[0], a), (found[1], a)):
                assert max(abs(x - y) for x, y in zip(ours, expected, strict=True)) < mpmath.mpf(10) ** -45
            floats = [[float(y) for y in row] for row in (c, s, v, a)]
            close(dynamics.inverse_dynamics(tree, *floats), [float(y) for y in tau], 1e-15)


def test_a_body_that_floats_alone():
    """No joint but the base: Euler's equations in its own axes."""
    alone = Subject(floated(loaded(load_urdf(PLAIN))).locked({"*": 0.0}))
    assert (alone.n, len(alone.tree.bodies)) == (6, 1)
    for q, v, a in alone.states(2, 13):
        given = alone.inputs(q)
        expected = pinocchio.rnea(alone.peer.model, alone.peer.data, alone.peer.position(q), v, a)
        close(dynamics.inverse_dynamics(alone.tree, **given, v=v, a=a), expected)
        for way in (dynamics, articulated):
            close(way.forward_dynamics(alone.tree, **given, v=v, tau=expected), a, 1e-13)
    for kernel in TREE_KERNELS:  # by casadi too, whose vectors of no joints are empty
        assert made(kernel, alone.tree).program.counts().total >= (0 if kernel.name == "mass_matrix" else 1)


def test_a_robot_that_does_not_move():
    """No joint at all: nothing to compute, and nothing to stumble over."""
    tree = Tree.of(RobotModel("stand", (), (Frame("base", -1, Placement()),)))
    for kernel in TREE_KERNELS:
        if not kernel.name.startswith("center_of_mass"):
            assert made(kernel, tree).program.output.size == (16 if kernel.name == "frames" else 0)


def test_joints_without_inertia(skew_model):
    names = [kernel.name for kernel in TREE_KERNELS]
    bare = replace(skew_model, joints=tuple(replace(j, inertia=None, armature=0.0) for j in skew_model.joints))
    inertias = {j.name: j.inertia for j in skew_model.joints} | {"right_roll": None}
    last = replace(skew_model, joints=tuple(replace(j, armature=0.0, inertia=inertias[j.name]) for j in skew_model.joints))
    for model, gone in ((bare, {"center_of_mass", "center_of_mass_jacobian", "forward_dynamics"}), (last, {"forward_dynamics"})):
        for kernel in TREE_KERNELS:
            if kernel.name in gone:
                lacks = "the inertia that a joint carries is zero" if "mass" not in kernel.name else "nothing that moves has mass"
                with pytest.raises(MassError) as refusal:
                    made(kernel, Tree.of(model))
                assert str(refusal.value) == f"{kernel.name} does not exist: {lacks}"
                assert isinstance(refusal.value, ModelError)
            elif kernel.name in ("frames", "inverse_dynamics", "mass_matrix"):
                assert made(kernel, Tree.of(model)).program.output.size > 0
    assert gone < set(names)
    rotor = replace(last, joints=tuple(replace(j, armature=0.01) for j in last.joints))
    assert made(TREE_KERNELS[names.index("forward_dynamics")], Tree.of(rotor)).program.output.size == 9  # a rotor is an inertia


def test_masses_about_the_origin():
    """Mass.of moves an inertia from the centre of mass to the origin as Pinocchio's spatial inertia."""
    inertia = Inertia(2.0, (0.5, -0.25, 0.125), (1.0, 0.125, 0.0, 2.0, -0.25, 1.5))
    spatial = pinocchio.Inertia(2.0, np.array(inertia.com), inertia.matrix()).matrix()
    found = Mass.of(inertia)
    close(found.inertia, spatial[3:, 3:], 1e-16)
    x, y, z = found.moment
    close([[0, z, -y], [-z, 0, x], [y, -x, 0]], spatial[:3, 3:], 1e-16)
    at = Placement.turn((0.6, 0.0, 0.8), 0.7) @ Placement(translation=(0.1, 0.2, 0.3))
    moved = pinocchio.SE3(at.matrix()) * pinocchio.Inertia(2.0, np.array(inertia.com), inertia.matrix())
    close([inertia.placed(at).mass, *inertia.placed(at).com], [moved.mass, *moved.lever], 1e-15)
    close(inertia.placed(at).matrix(), moved.inertia, 1e-15)


PLAIN = """<robot name="plain"><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="turn" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0.5 0 0.25"/><axis xyz="0 0 1"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0.5 0"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
<joint name="bend" type="continuous"><parent link="c"/><child link="d"/><origin xyz="0.25 0 0"/><axis xyz="0 1 0"/></joint></robot>"""
