"""Reaching with arms that have no more joints than the target has equations, and what the status names when something is missed.

End points are checked by homogeneous matrices from the robot's description.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.elements import Line, Motor, Plane, Point, PointPair
from cga_runtime.solve.ipopt import FAR, PENALTY, Bounds, Program
from cga_runtime.solve.reaching import reach
from cga_runtime.solve.reaching_grasp import hold

DESCRIPTION = json.loads((Path(__file__).parents[2] / "generated/robots/nao/robot.json").read_text())
CLOSED = np.array([0.6, -0.35, 0.9, 0.9, 0.2, 0.6, 0.35, -0.9, -0.9, -0.2])
SHORT = {"RShoulder": (0.1, 0.02, 0.03), "RBicep": (0.1, 0.0, 0.0), "RElbow": (0.1, 0.02, 0.0)}
"""Frames behind one, two and three joints, and the point that is moved (m): on none of the axes before it."""


def end_point(frame, offset, q):
    """The point `offset` of a frame, by Rodrigues' formula along the joints before it."""
    end = next(f for f in DESCRIPTION["frames"] if f["name"] == frame)
    path, joint = [], end["joint"]
    while joint >= 0:
        path.insert(0, DESCRIPTION["joints"][joint])
        joint = path[0]["parent"]
    assert len(path) == len(q)
    x = np.array(end["placement"]["rotation"]) @ offset + end["placement"]["translation"]
    for j, angle in zip(path[::-1], q[::-1], strict=True):
        k = np.array(j["axis"])
        x = x * np.cos(angle) + np.cross(k, x) * np.sin(angle) + k * (k @ x) * (1 - np.cos(angle))
        x = np.array(j["placement"]["rotation"]) @ x + j["placement"]["translation"]
    return x


def within(q, limited):
    return bool(((limited.lower <= q) & (q <= limited.upper)).all())


def silent(capfd):
    said = capfd.readouterr()
    return (said.out, said.err) == ("", "")


@pytest.fixture(params=SHORT)
def short(request, nao):
    return nao.chain(request.param, offset=SHORT[request.param])


# ---- few joints


def test_few_joints_reach_what_they_can(short, rng, capfd):
    solved = {"point": 0, "line": 0, "plane": 0}
    for _ in range(100):
        x, n = end_point(short.frame, SHORT[short.frame], short.random(rng)), rng.normal(size=3)
        targets = {"point": Point(x), "line": Line.from_point_direction(x, n), "plane": Plane.from_point_normal(x, n)}
        for kind, target in targets.items():
            found = reach(short, target)
            assert within(found.q, short) and 0 < found.iterations_last <= found.iterations <= 201 * found.starts
            if found.success:
                d = end_point(short.frame, SHORT[short.frame], found.q) - x
                miss = {"point": d, "line": np.cross(d, n) / np.linalg.norm(n), "plane": d @ n / np.linalg.norm(n)}[kind]
                assert np.linalg.norm(miss) < 1e-6
                solved[kind] += 1
    assert min(solved.values()) >= 98, solved
    assert silent(capfd)


def test_corners_of_the_limits_are_reached(short, rng):
    for _ in range(10):
        q = np.where(rng.random(short.n) < 0.5, short.lower, short.upper)
        found = reach(short, Point(end_point(short.frame, SHORT[short.frame], q)))
        assert found.success


def test_the_example_of_two_joints(nao):
    arm = nao.chain("RBicep", offset=(0.1, 0, 0))
    found = reach(arm, Point(arm.point([0.3, -0.5])))
    assert found.success and found.starts == 1
    np.testing.assert_allclose(found.q, [0.3, -0.5], atol=1e-8)  # the only solution inside the limits


def test_few_joints_come_as_near_as_they_can(short, rng, capfd):
    sampled = short.point(short.random(rng, 50_000))
    for goal in ((0.25, -0.4, 0.3), (0.0, 0.0, 0.0), (-0.3, 0.1, 0.1)):
        found = reach(short, Point(goal), starts=4)
        assert not found.success and found.starts == 4 and within(found.q, short) and 0 < found.iterations <= 804
        assert found.status.startswith("unreachable or not found in 4 starts: closest result 0.")
        miss = np.linalg.norm(end_point(short.frame, SHORT[short.frame], found.q) - goal)
        assert found.residual == pytest.approx(miss, abs=1e-12)
        least = np.linalg.norm(sampled - goal, axis=-1).min()
        assert least - 0.005 < miss < 1.01 * least
    assert silent(capfd)


def test_two_arms_of_which_one_or_both_are_short(nao, rng, capfd):
    first, second, whole = nao.chain("RBicep", offset=(0.1, 0, 0)), nao.chain("LBicep", offset=(0.1, 0, 0)), nao.chain("LHand")
    for arms in ((first, second), (first, whole)):
        for kind in (PointPair, Line):
            for _ in range(10):
                q = [arm.random(rng) for arm in arms]
                a, b = (arm.point(part) for arm, part in zip(arms, q, strict=True))
                found = reach(arms, kind.from_points(a, b))
                assert found.success
                ends = first.point(found.q[:2]), arms[1].point(found.q[2:])
                if kind is PointPair:
                    np.testing.assert_allclose(ends, (a, b), atol=1e-6)
                else:
                    assert max(np.linalg.norm(np.cross(x - a, b - a)) for x in ends) < 1e-6 * np.linalg.norm(b - a)
    assert silent(capfd)


def test_a_closed_chain_with_fewer_joints_than_equations(nao, rng, capfd):
    loop = cga.ClosedChain(nao.chain("RElbow", offset=(0.1, 0.02, 0)), nao.chain("LForeArm", offset=(0.1, 0.02, 0)))
    assert loop.n == 7
    for _ in range(10):
        q = loop.random(rng)
        x = end_point("RElbow", (0.1, 0.02, 0), q[:3])
        found = reach(loop, Point(x), q + 0.1 * rng.normal(size=7), grasp=loop.grasp(q))
        assert found.success and within(found.q, loop)
        np.testing.assert_allclose(end_point("RElbow", (0.1, 0.02, 0), found.q[:3]), x, atol=1e-6)
        np.testing.assert_allclose(loop.grasp(found.q), loop.grasp(q), atol=1e-7)
    assert silent(capfd)


def test_too_many_equations_are_refused_or_made_elastic():
    # x = 0 and x = 1 and x = 0
    import casadi

    x = casadi.SX.sym("x")
    box = Bounds(np.array([-2.0]), np.array([2.0]), np.zeros(3), np.zeros(3))
    equations = casadi.vertcat(x, x - 1, x)
    refused = Program("refused", x, casadi.SX(0, 1), x**2 / 2, equations).solve(np.array([0.7]), np.zeros(0), box)
    assert refused.status == "Not_Enough_Degrees_Of_Freedom" and refused.iterations == 0
    solved = Program("solved", x, casadi.SX(0, 1), x**2 / 2, equations, elastic=3).solve(np.array([0.7]), np.zeros(0), box)
    assert solved.status == "Solve_Succeeded" and 0 < solved.iterations < 100
    # where the derivative of x^2 / 2 + rho (2 |x| + |1 - x|) + far (2 x^2 + (1 - x)^2) vanishes
    np.testing.assert_allclose(solved.x, [(2 * FAR - PENALTY) / (6 * FAR + 1)], atol=1e-9)
    # where there is a solution the penalty is exact, whatever f prefers
    box = Bounds(box.lower, box.upper, np.zeros(1), np.zeros(1))
    exact = Program("exact", x, casadi.SX(0, 1), x**2 / 2, x - 1, elastic=1).solve(np.array([-0.7]), np.zeros(0), box)
    np.testing.assert_allclose(exact.x, [1.0], atol=1e-9)


# ---- what the status names


def missed(solution):
    assert not solution.success
    head, tail = "unreachable or not found in 3 starts: ", " (IPOPT: "
    assert solution.status.startswith(head)
    return [part.split(":")[0] for part in solution.status[len(head) : solution.status.index(tail)].split("; ")]


def test_the_status_names_an_open_grasp(loop):
    # the hands cannot be in one place with one orientation
    target = Point(loop.right.point(CLOSED[:5]) + 0.01)
    found = reach(loop, target, CLOSED, grasp=Motor([1, 0, 0, 0, 0, 0, 0, 0]), starts=3)
    assert found.residual < 1e-6 and missed(found) == ["grasp not closed"]
    error = np.abs(loop.closure_error(found.q, np.eye(8)[0])).max()
    assert f"closure error {error:.2g}, at most 1e-08 allowed" in found.status
    # nor can the grasp of a q0 outside the limits be held inside
    outside = CLOSED.copy()
    outside[3] = -1.2
    found = reach(loop, target, outside, starts=3)
    assert found.residual < 1e-6 and missed(found) == ["grasp not closed"]


def test_the_status_names_the_target_alone_where_all_else_is_kept(loop):
    target = Point(loop.right.point(CLOSED[:5]) + 1.0)
    found = reach(loop, target, CLOSED, starts=3)
    assert missed(found)[0].startswith("closest result 1.") and found.status.count(" m away") == 1


@pytest.mark.parametrize("shift", [0.0, 0.01])
@pytest.mark.parametrize("margins", [{"limb_margin": 5.0}, {"scheme_margin": ((1, 3, 7, 8), 50.0)}])
def test_the_status_names_what_is_missed_and_nothing_else(loop, margins, shift):
    goal = loop.right.point(CLOSED[:5]) + shift
    found = reach(loop, Point(goal), CLOSED, starts=3, **margins)
    q, expected = found.q, []
    if np.linalg.norm(loop.right.point(q[:5]) - goal) > 1e-6:
        expected.append("closest result")
    if np.abs(loop.closure_error(q, loop.grasp(CLOSED))).max() > 1e-8:
        expected.append("grasp not closed")
    if "limb_margin" in margins:
        # the closed forms of paper C with r3 = 0.105, d3 = 0.015; positive at CLOSED for the right arm, negative for the left
        right = (0.105 * np.cos(q[1]) + 0.015 * np.sin(q[1])) * np.sin(q[3]) / 0.1
        left = -(0.105 * np.cos(q[6]) - 0.015 * np.sin(q[6])) * np.sin(q[8]) / 0.1
        expected += ["limb margin of the right arm not kept", "limb margin of the left arm not kept"]
        assert all(f"{kept:.4g}, at least 5 wanted" in found.status for kept in (right, left))
    else:
        expected.append("scheme margin not kept")
        ratio = loop.determinant(q, (1, 3, 7, 8)) / loop.determinant(CLOSED, (1, 3, 7, 8))
        assert f"D_a / D_a(q0) is {ratio:.4g}, at least 50 wanted" in found.status
    named = ["closest result" if part.startswith("closest result") else part for part in missed(found)]
    assert named == expected


def test_each_arm_is_judged_by_itself(loop):
    held = hold(loop, CLOSED, limb_margin=0.3, scheme_margin=((1, 3, 7, 8), 0.5))
    assert all(check.violation <= 1.0 for check in held.checks(CLOSED)) and held.violation(CLOSED) <= 1.0
    bent = CLOSED.copy()
    bent[3] = 0.1  # the right elbow almost stretched: the grasp opens too
    over = [check.missed.split(":")[0] for check in held.checks(bent) if check.violation > 1.0]
    assert "grasp not closed" in over and "limb margin of the right arm not kept" in over
    assert "limb margin of the left arm not kept" not in over
