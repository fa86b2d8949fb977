"""ClosedChain against reference values and against an independent forward kinematics from the NAO's published lengths."""

import json
from pathlib import Path

import casadi
import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.errors import GraspError
from cga_runtime.loading import load_robot
from cga_runtime.spaces.closed_chain import LENGTH

DATA = Path(__file__).parents[1] / "data"
ORACLE = json.loads((DATA / "nao.json").read_text())
FACTS = json.loads((DATA / "nao_facts.json").read_text())
POSES = ORACLE["fk"]
ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))
RAISED = np.eye(4)
RAISED[2, 3] = 0.013


def close(a, b, tolerance):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance)


def lines(version, side, q):
    """Axis directions and points (5, 3) and the hand's pose: each joint turns what follows about its line. Complex q allowed."""
    c, s = FACTS["constants"][version], -1 if side == "R" else 1
    shoulder = np.array([0, s * c["ShoulderOffsetY"], c["ShoulderOffsetZ"]])
    elbow = shoulder + [c["UpperArmLength"], s * c["ElbowOffsetY"], 0]
    wrist = elbow + [c["LowerArmLength"], 0, 0]
    hand = wrist + [c["HandOffsetX"], 0, -c["HandOffsetZ"]]
    axes, points = np.eye(3)[[1, 2, 0, 2, 0]], np.array([shoulder, shoulder, elbow, elbow, wrist])
    turn, shift, found = np.eye(3), np.zeros(3), []
    for axis, point, angle in zip(axes, points, q, strict=True):
        found.append((turn @ axis, turn @ point + shift))
        k = np.cross(np.eye(3), axis)  # k @ x = axis x x
        local = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k
        turn, shift = turn @ local, turn @ (point - local @ point) + shift
    pose = np.eye(4, dtype=turn.dtype)
    pose[:3, :3], pose[:3, 3] = turn, turn @ hand + shift
    return np.array([w for w, _ in found]), np.array([p for _, p in found]), pose


def twists(q, version="V50"):
    """(w, v) about the torso's origin, (6, 10)."""
    arms = [lines(version, side, part) for side, part in (("R", q[:5]), ("L", q[5:]))]
    return np.concatenate([np.concatenate([w, np.cross(p, w)], axis=1) for w, p, _ in arms]).T


def determinant(q, actuated):
    passive = [j for j in range(10) if j + 1 not in actuated]
    return np.linalg.det((twists(q) / np.repeat([1, LENGTH], 3)[:, None])[:, passive])


def as_scheme(key):
    return tuple(int(x) for x in key.strip("()").split(","))


@pytest.mark.parametrize("pose", POSES, ids=range(len(POSES)))
def test_reference_pose(pose):
    """Hands, screws, wrenches, centres, factors, determinants, gradients, mu and closure singular values of one pose."""
    q = np.array(pose["q"])
    right, left = pose["R"], pose["L"]
    close(LOOP.right.pose(q[:5]), right["hand"], 1e-15)
    close(LOOP.left.pose(q[5:]), left["hand"], 1e-15)
    screws = np.concatenate([right["screws"], left["screws"]], axis=1)
    close(LOOP.twists(q), screws, 1e-15)
    close(LOOP.screws(q), np.array([1, -1, 1, 1, 1, 1])[:, None] * screws[[2, 1, 0, 3, 4, 5]], 1e-15)
    close(LOOP.kernel("wrist_centres")(q), [right["S"], left["S"]], 1e-15)
    close(LOOP.kernel("limb_factors")(q), [[arm["f2"], arm["sinq4"]] for arm in (right, left)], 1e-15)
    for row, arm in zip(LOOP.kernel("constraint_wrenches")(q), (right, left), strict=True):
        fx, fy, fz, mx, my, mz = arm["zeta"]
        close(row, [fx, fy, mz, fz, -my, mx], 5e-15)  # the kernel holds |US| = 0.106066... with 15 decimals
        close(np.array(arm["zeta"][3:]), np.cross(arm["U"], arm["zeta"][:3]), 1e-15)  # a line through the shoulder
    for key, value in pose["det"].items():
        close(LOOP.determinant(q, as_scheme(key)), value, 1e-14)
    for key, gradient in pose["grad_det"].items():
        close(LOOP.determinant_gradient(q, as_scheme(key)), gradient, 3e-14)
    for key, value in pose["mu"].items():
        close(LOOP.conditioning(q, as_scheme(key)), value, 1e-14)
    # at a closed pose the closure error's Jacobian is that of the relative twist, halved
    jacobian = 2 * LOOP.kernel("closure_jacobian")(q, LOOP.grasp(q)) / np.repeat([1, LENGTH], 3)[:, None]
    close(np.linalg.svd(jacobian, compute_uv=False), pose["closure_singular_values_L0.1"], 1e-13)


@pytest.mark.parametrize(("name", "version"), [("nao", "V50"), ("nao_v32", "V32")])
def test_independent_kinematics(name, version):
    """300 poses in [-pi, pi]: screws, hands, and the distance and angle behind the limb factors."""
    robot = load_robot(name)
    loop = ClosedChain(robot.chain("RHand"), robot.chain("LHand"))
    for q in np.random.default_rng(1).uniform(-np.pi, np.pi, (300, 10)):
        close(loop.twists(q), twists(q, version), 2e-15)
        for k, (side, chain) in enumerate((("R", loop.right), ("L", loop.left))):
            part = q[5 * k : 5 * k + 5]
            w, p, hand = lines(version, side, part)
            close(chain.pose(part), hand, 2e-15)
            centre = loop.kernel("wrist_centres")(q)[k]
            close(centre, p[3], 2e-15)
            f, sine = loop.kernel("limb_factors")(q)[k]
            close(abs(f), np.linalg.norm(np.cross(centre - p[0], w[0])), 2e-15)
            close([sine, sine], [np.sin(part[3]), -np.linalg.det(w[2:])], 2e-15)


@pytest.mark.parametrize("actuated", [(1, 2, 3, 7), (1, 3, 7, 8), (1, 3, 9, 10), (5, 6, 7, 10), (2, 3, 7, 8)])
def test_gradient_by_complex_step(actuated):
    """Im D(q + i h e_k) / h of the independent determinant, exact to rounding; (2, 3, 7, 8) is zero everywhere, with its gradient."""
    rng = np.random.default_rng(2)
    for q in LOOP.random(rng, 40):
        step = 1e-30
        expected = [determinant(q + 1j * step * np.eye(10)[k], actuated).imag / step for k in range(10)]
        gradient = LOOP.determinant_gradient(q, actuated)
        close(gradient, expected, 2e-13)
        close(gradient[0] + gradient[5], 0, 1e-13)  # turning both arms about the common shoulder axis changes nothing
        close(gradient[[4, 9]], 0, 0)  # no screw depends on a last joint
        close(LOOP.determinant(q, actuated), determinant(q, actuated), 1e-13)


def test_gradient_at_a_singularity():
    """Where D = 0 an inverse would fail; cofactors do not. q1 = q6 makes 1237 singular, its gradient there is not zero."""
    q = np.array(POSES[0]["q"])
    q[5] = q[0]
    close(LOOP.determinant(q, (1, 2, 3, 7)), 0, 1e-15)
    expected = [determinant(q + 1e-30j * np.eye(10)[k], (1, 2, 3, 7)).imag / 1e-30 for k in range(10)]
    close(LOOP.determinant_gradient(q, (1, 2, 3, 7)), expected, 1e-13)
    assert abs(expected[0]) > 0.1


def test_symbolic_determinant():
    """The CasADi expression has the same value, and by automatic differentiation the same gradient."""
    q = casadi.SX.sym("q", 10)
    d = LOOP.symbolic_determinant(q, (8, 7, 3, 1))
    function = casadi.Function("d", [q], [d, casadi.gradient(d, q)])
    for at in LOOP.random(np.random.default_rng(3), 20):
        value, gradient = function(at)
        close(float(value), LOOP.determinant(at, (1, 3, 7, 8)), 1e-14)
        close(np.asarray(gradient).ravel(), LOOP.determinant_gradient(at, (1, 3, 7, 8)), 1e-13)


def motor_of(pose):
    """1 e12 e13 e23 e1i e2i e3i e123i of T(p) R from the quaternion of R (w > 0): R = w - z e12 + y e13 - x e23."""
    r, p = pose[:3, :3], pose[:3, 3]
    w = 0.5 * np.sqrt(1 + np.trace(r))
    x, y, z = (r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]) / (4 * w)
    # R = w - I3 b, T = 1 - p ei/2, and p (w - I3 b) = w p + p x b - I3 (p.b)
    b = np.array([x, y, z])
    return np.concatenate([[w, -z, y, -x], -0.5 * (w * p + np.cross(p, b)), [0.5 * p @ b]])


def test_grasp_is_the_relative_pose():
    for q in LOOP.random(np.random.default_rng(4), 200):
        right, left = lines("V50", "R", q[:5])[2], lines("V50", "L", q[5:])[2]
        relative = np.linalg.inv(right) @ left
        grasp = LOOP.grasp(q)
        if np.trace(relative[:3, :3]) > -0.9:
            expected = motor_of(relative)
            close(grasp * np.sign(grasp @ expected), expected, 1e-14)
        close(LOOP.closure_error(q, grasp), 0, 1e-15)
        close(LOOP.closure_error(q, -grasp), 0, 1e-15)  # both signs are one motion


def test_closure_error_measures_the_gap():
    """M_R X ~M_L is the motion that is left: turning the last left joint by a opens the loop by sin(a/2) about its axis."""
    q = np.array(POSES[2]["q"])
    grasp = LOOP.grasp(q)
    moved = q.copy()
    moved[9] += 0.3
    error = LOOP.closure_error(moved, grasp)
    close(error, np.sin(0.15) * LOOP.screws(q)[:, 9], 1e-15)
    with pytest.raises(GraspError, match=r"not closed \(error 9\.\de-02, at most 1e-08\); loop\.grasp\(q\) is the grasp of q"):
        LOOP.require_closed(moved, grasp)
    close(LOOP.require_closed(q, grasp), q, 0)
    with pytest.raises(GraspError):
        LOOP.require_closed(np.stack([q, moved]), grasp)  # one open configuration of a batch


def test_closure_jacobian_off_the_manifold():
    """Against central differences of an open loop (error of order h^2 = 1e-10), with wide gaps."""
    rng = np.random.default_rng(5)
    for q, grasp in zip(LOOP.random(rng, 20), LOOP.grasp(LOOP.random(rng, 20)), strict=True):
        h = 1e-5
        expected = [(LOOP.closure_error(q + h * e, grasp) - LOOP.closure_error(q - h * e, grasp)) / (2 * h) for e in np.eye(10)]
        close(LOOP.kernel("closure_jacobian")(q, grasp), np.array(expected).T, 1e-10)


def test_reference_closed_loop():
    """The reference's grasp is that of the wrist frames 5: X5 = T5R^-1 T5L. Ours is of the hands: X = H^-1 X5 H, H the tool."""
    reference = ORACLE["closed_loop"]
    q0, x5 = np.array(reference["q0"]), np.array(reference["grasp_T5R_inv_T5L"])
    tool = np.eye(4)
    tool[:3, 3] = 0.05775, 0, -0.01231
    hands = motor_of(np.linalg.inv(tool) @ x5 @ tool)
    close(LOOP.grasp(q0) * np.sign(LOOP.grasp(q0)[0]), hands, 1e-14)
    # a point fixed in the hand moves the end frame to the wrist: then the two grasps are one
    back = ClosedChain(ROBOT.chain("RHand", offset=(-0.05775, 0, 0.01231)), ROBOT.chain("LHand", offset=(-0.05775, 0, 0.01231)))
    wrist = back.grasp(q0)
    close(wrist * np.sign(wrist[0]), motor_of(x5), 1e-14)
    assert np.abs(motor_of(x5) - hands).max() > 0.01  # the tool matters
    configurations = np.array(reference["configs"])
    assert np.ptp(configurations, axis=0).min() > 0.3  # they differ in every joint
    for loop, grasp in ((LOOP, hands), (back, motor_of(x5))):
        assert np.abs(loop.closure_error(configurations, grasp)).max() < 1e-11
        loop.require_closed(configurations, grasp)


def test_batches():
    """Leading dimensions go through every function, and each entry is the single result."""
    q = LOOP.random(np.random.default_rng(6), (2, 3))
    grasp = LOOP.grasp(q)
    calls = {
        (2, 3, 6, 10): (LOOP.screws, LOOP.twists),
        (2, 3, 8): (LOOP.grasp,),
        (2, 3): (lambda x: LOOP.determinant(x, (1, 3, 7, 8)), lambda x: LOOP.conditioning(x, (1, 3, 7, 8))),
        (2, 3, 10): (lambda x: LOOP.determinant_gradient(x, (1, 3, 7, 8)), LOOP.check),
        (2, 3, 6): (lambda x: LOOP.closure_error(x, grasp[1, 2]),),
    }
    for shape, functions in calls.items():
        for function in functions:
            together = function(q)
            assert together.shape == shape
            close(together[1, 2], function(q[1, 2]), 0)
    assert LOOP.random(np.random.default_rng(0)).shape == (10,) and LOOP.random(np.random.default_rng(0), 4).shape == (4, 10)
    many = LOOP.random(np.random.default_rng(0), 500)
    assert (many >= LOOP.lower).all() and (many <= LOOP.upper).all()
    assert LOOP.closure_error(q, grasp).shape == (2, 3, 6) and np.abs(LOOP.closure_error(q, grasp)).max() < 1e-15


def test_chains_with_options():
    """Root and placement: the torso is the base; a raised left arm has its screws raised, and the grasp changes by the same motion."""
    torso = ClosedChain(ROBOT.chain("RHand", root="torso"), ROBOT.chain("LHand", root="torso"))
    raised = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand", placement=RAISED))
    for q in LOOP.random(np.random.default_rng(7), 20):
        close(torso.twists(q), twists(q), 2e-15)
        w, v = np.split(twists(q), 2)
        v[:, 5:] += np.cross(RAISED[:3, 3], w[:, 5:].T).T
        close(raised.twists(q), np.concatenate([w, v]), 2e-15)
        expected = np.linalg.inv(lines("V50", "R", q[:5])[2]) @ RAISED @ lines("V50", "L", q[5:])[2]
        grasp = raised.grasp(q)
        if np.trace(expected[:3, :3]) > -0.9:
            close(grasp * np.sign(grasp @ motor_of(expected)), motor_of(expected), 1e-14)
        close(raised.closure_error(q, grasp), 0, 1e-15)


def test_arms_of_other_lengths():
    """Three and four joints: seven together, one actuated; no wrist centres. Only the common shoulder axis moves the loop."""
    loop = ClosedChain(ROBOT.chain("RElbow"), ROBOT.chain("LForeArm"))
    assert (loop.n, loop.actuators, loop.joint_names[3]) == (7, 1, "LShoulderPitch")
    assert "wrist_centres" not in loop.unit.names
    q = np.random.default_rng(8).uniform(loop.lower, loop.upper)
    full = np.concatenate([q[:3], [0, 0], q[3:], [0]])
    close(loop.twists(q), twists(full)[:, [0, 1, 2, 5, 6, 7, 8]], 2e-15)
    close(loop.conditioning(q, [1]), np.sqrt(0.5), 1e-13)
    close(loop.conditioning(q, [2]), 0, 1e-13)
    columns = twists(full)[:, [0, 1, 2, 6, 7, 8]] / np.repeat([1, LENGTH], 3)[:, None]
    close(loop.determinant(q, [4]), np.linalg.det(columns), 1e-13)
