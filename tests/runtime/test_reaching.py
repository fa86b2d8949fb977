"""Reaching, checked by matrix kinematics from the robot's description: solutions for every kind of target, and the exact Hessian."""

import json
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.elements import Circle, Line, Motor, Plane, Point, PointPair, Sphere
from cga_runtime.solve.reaching import reach
from cga_runtime.solve.reaching_grasp import hold
from cga_runtime.solve.reaching_problem import Form, parameters, program
from cga_runtime.solve.reaching_targets import duals
from cga_runtime.solve.reaching_tasks import closed_configurations

DESCRIPTION = json.loads((Path(__file__).parents[2] / "generated/robots/nao/robot.json").read_text())
CLOSED = np.array([0.6, -0.35, 0.9, 0.9, 0.2, 0.6, 0.35, -0.9, -0.9, -0.2])


class Matrices:
    """One arm's kinematics by homogeneous matrices, for real and complex q."""

    def __init__(self, frame: str) -> None:
        end = next(f for f in DESCRIPTION["frames"] if f["name"] == frame)
        path, joint = [], end["joint"]
        while joint >= 0:
            path.insert(0, DESCRIPTION["joints"][joint])
            joint = path[0]["parent"]
        self.fixed = [self.matrix(j["placement"]) for j in path]
        self.axes = [np.array(j["axis"]) for j in path]
        self.tool = self.matrix(end["placement"])

    @staticmethod
    def matrix(placement):
        result = np.eye(4)
        result[:3, :3], result[:3, 3] = placement["rotation"], placement["translation"]
        return result

    def __call__(self, q):
        """Pose of the hand, and the joints' screws as columns (w, v) about the torso's origin."""
        pose, screws = np.eye(4), []
        for fixed, axis, angle in zip(self.fixed, self.axes, q, strict=True):
            pose = pose @ fixed
            w, p = pose[:3, :3] @ axis, pose[:3, 3]
            screws.append(np.concatenate([w, np.cross(p, w)]))
            k = np.cross(axis, np.eye(3)).T  # k @ x = axis x x
            turn = np.eye(4, dtype=np.result_type(angle))
            turn[:3, :3] += np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)
            pose = pose @ turn
        return pose @ self.tool, np.array(screws).T


RIGHT, LEFT = Matrices("RHand"), Matrices("LHand")


def hands(q):
    return RIGHT(q[:5])[0][:3, 3], LEFT(q[5:])[0][:3, 3]


def grasp_matrix(q):
    return np.linalg.inv(RIGHT(q[:5])[0]) @ LEFT(q[5:])[0]


def determinant(q, actuated):
    """D_a by the matrices: rows of moments over 0.1 m; its sign convention cancels in ratios."""
    screws = np.hstack([RIGHT(q[:5])[1], LEFT(q[5:])[1]]) / np.array([1, 1, 1, 0.1, 0.1, 0.1])[:, None]
    return np.linalg.det(screws[:, [j for j in range(10) if j + 1 not in actuated]])


def limb_factors(q):
    """f sin q4 / 0.1 m by the closed forms of paper C with r3 = 0.105, d3 = 0.015."""
    right = (0.105 * np.cos(q[1]) + 0.015 * np.sin(q[1])) * np.sin(q[3])
    left = (0.105 * np.cos(q[6]) - 0.015 * np.sin(q[6])) * np.sin(q[8])
    return np.array([right, left]) / 0.1


def within(q, lower, upper):
    return bool(((lower <= q) & (q <= upper)).all())


# ---- one arm and two arms


def to_point(x, goal):
    return np.linalg.norm(x - goal)


def to_line(x, point, direction):
    return np.linalg.norm(np.cross(x - point, direction)) / np.linalg.norm(direction)


def to_plane(x, point, normal):
    return abs((x - point) @ normal) / np.linalg.norm(normal)


def to_circle(x, a, b, c):
    """The larger of the distance from the plane of three points and the difference in distance from their circle's centre."""
    n = np.cross(b - a, c - a)
    centre = np.linalg.solve([b - a, c - a, n], [(b @ b - a @ a) / 2, (c @ c - a @ a) / 2, n @ a])
    return max(to_plane(x, a, n), abs(np.linalg.norm(x - centre) - np.linalg.norm(a - centre)))


# how a target is made from a reachable point x and two vectors, and how far a point is from it
MADE = {
    "point": (lambda x, u, v: Point(x), lambda y, x, u, v: to_point(y, x)),
    "line": (lambda x, u, v: Line.from_point_direction(x, u), lambda y, x, u, v: to_line(y, x, u)),
    "circle": (lambda x, u, v: Circle.from_points(x, x + u, x + v), lambda y, x, u, v: to_circle(y, x, x + u, x + v)),
    "plane": (lambda x, u, v: Plane.from_point_normal(x, u), lambda y, x, u, v: to_plane(y, x, u)),
    "sphere": (
        lambda x, u, v: Sphere.from_center_radius(x + u, np.linalg.norm(u)),
        lambda y, x, u, v: abs(np.linalg.norm(y - x - u) - np.linalg.norm(u)),
    ),
}


@pytest.mark.parametrize("kind", MADE)
def test_one_arm_reaches(kind, arm, rng):
    make, distance = MADE[kind]
    for _ in range(25):
        given = RIGHT(arm.random(rng))[0][:3, 3], *(0.1 * rng.normal(size=(2, 3)))
        found = reach(arm, make(*given))
        assert found.success and found.status == "reached (IPOPT: Solve_Succeeded)"
        assert within(found.q, arm.lower, arm.upper)
        measured = distance(RIGHT(found.q)[0][:3, 3], *given)
        assert measured < 1e-8
        assert found.residual == pytest.approx(measured, abs=2e-9)


def test_two_arms_reach_a_pair_in_order_and_a_line(loop, rng):
    chains = (loop.right, loop.left)
    for _ in range(25):
        a, b = hands(loop.random(rng))
        found = reach(chains, PointPair.from_points(a, b))
        assert found.success and within(found.q, loop.lower, loop.upper)
        np.testing.assert_allclose(hands(found.q), (a, b), atol=1e-8)
        found = reach(chains, Line.from_points(a, b))
        assert found.success and within(found.q, loop.lower, loop.upper)
        assert max(to_line(x, a, b - a) for x in hands(found.q)) < 1e-8
    swapped = reach(chains[::-1], PointPair.from_points(b, a))
    assert swapped.success
    np.testing.assert_allclose(hands(np.roll(swapped.q, 5)), (a, b), atol=1e-8)


def test_the_solution_is_locally_nearest_to_the_start(arm, rng):
    # with one plane and no active limit q - q0 must be along the gradient of n.x(q)
    checked = 0
    for _ in range(20):
        q0, x, n = arm.random(rng), arm.point(arm.random(rng)), rng.normal(size=3)
        found = reach(arm, Plane.from_point_normal(x, n), q0, starts=1)
        if found.success and np.minimum(found.q - arm.lower, arm.upper - found.q).min() > 1e-3:
            gradient = n @ np.array([np.cross(s[:3], RIGHT(found.q)[0][:3, 3]) + s[3:] for s in RIGHT(found.q)[1].T]).T
            step = found.q - q0
            along = step @ gradient / (gradient @ gradient) * gradient
            np.testing.assert_allclose(step, along, atol=1e-6)
            checked += 1
    assert checked >= 5


# ---- a held object


def others(loop, rng, count):
    """Other configurations that hold the object as CLOSED does."""
    return [q for q, _ in zip(closed_configurations(hold(loop, CLOSED), CLOSED, rng), range(count), strict=False)]


def test_a_held_object_reaches_and_stays_held(loop, rng):
    held = grasp_matrix(CLOSED)
    offset = np.array([0.03, 0.05, -0.02])
    for q in others(loop, rng, 15):
        np.testing.assert_allclose(grasp_matrix(q), held, atol=1e-9)
        goal, u, v = (RIGHT(q[:5])[0] @ np.r_[offset, 1.0])[:3], *(0.1 * rng.normal(size=(2, 3)))
        for make, distance in MADE.values():
            found = reach(loop, make(goal, u, v), CLOSED, object_point=offset)
            assert found.success and within(found.q, loop.lower, loop.upper)
            np.testing.assert_allclose(grasp_matrix(found.q), held, atol=1e-8)
            assert distance((RIGHT(found.q[:5])[0] @ np.r_[offset, 1.0])[:3], goal, u, v) < 1e-8


def test_a_grasp_may_be_given_as_motor_or_components(loop, rng):
    target = Point(hands(others(loop, rng, 1)[0])[0])
    motor = Motor.from_pose(grasp_matrix(CLOSED))
    solutions = [reach(loop, target, CLOSED, grasp=grasp) for grasp in (None, motor, motor.coefficients, -motor.coefficients)]
    for found in solutions:
        assert found.success
        np.testing.assert_allclose(found.q, solutions[0].q, atol=1e-7)
    # begun at an open position, the loop closes
    found = reach(loop, target, CLOSED + 0.1, grasp=motor)
    assert found.success
    np.testing.assert_allclose(grasp_matrix(found.q), grasp_matrix(CLOSED), atol=1e-8)


def test_margins_are_kept_and_change_the_solution(loop, rng):
    scheme, solved = (1, 3, 7, 8), {"limb": 0, "scheme": 0}
    for q in others(loop, rng, 12):
        target = Point(hands(q)[0])
        free = reach(loop, target, CLOSED)
        assert free.success
        # more than the free solution keeps; where the arms are nearly symmetric it already keeps almost the most there is
        margin = 1.005 * np.abs(limb_factors(free.q)).min()
        found = reach(loop, target, CLOSED, limb_margin=margin, starts=3)
        if found.success:
            assert (limb_factors(found.q) * np.sign(limb_factors(CLOSED))).min() >= margin - 2e-8
            solved["limb"] += 1
        fraction = determinant(free.q, scheme) / determinant(CLOSED, scheme) + 0.05
        found = reach(loop, target, CLOSED, scheme_margin=(scheme[::-1], fraction), starts=3)
        if found.success:
            assert determinant(found.q, scheme) / determinant(CLOSED, scheme) >= fraction - 2e-8
            solved["scheme"] += 1
    assert min(solved.values()) >= 8


def test_a_conditioning_weight_improves_the_conditioning(loop, rng):
    def volume(q):
        screws = np.hstack([RIGHT(q[:5])[1], LEFT(q[5:])[1]])
        return np.linalg.det(screws @ screws.T)

    gains = []
    for q in others(loop, rng, 8):
        solutions = [reach(loop, Point(hands(q)[0]), CLOSED, conditioning_weight=weight) for weight in (0.0, 0.5, 5.0)]
        assert all(found.success for found in solutions)
        small, medium, large = (volume(found.q) for found in solutions)
        # equal to rounding where limits leave the one free direction no room
        assert small < medium * (1 + 1e-9) and medium < large * (1 + 1e-9)
        gains.append(large / small)
    assert sum(gain > 1.1 for gain in gains) >= 3


# ---- derivatives


def closure(q, grasp):
    """10 times the bivector part of the motor of T_R X T_L^-1, from matrices, scalar part positive."""
    e = RIGHT(q[:5])[0] @ grasp @ np.linalg.inv(LEFT(q[5:])[0])
    w = np.sqrt(1 + np.trace(e[:3, :3])) / 2
    x, y, z = (e[2, 1] - e[1, 2]) / (4 * w), (e[0, 2] - e[2, 0]) / (4 * w), (e[1, 0] - e[0, 1]) / (4 * w)
    t = e[:3, 3]
    ideal = -0.5 * (w * t + np.cross(t, (x, y, z)))
    return 10 * np.array([-z, y, -x, *ideal])


def test_the_hessian_of_the_lagrangian_is_exact(loop, rng):
    scheme, weight = (1, 3, 7, 8), 0.05
    held = hold(loop, CLOSED, object_point=(0.02, 0.01, 0.03), limb_margin=0.3, scheme_margin=(scheme, 0.5), conditioning_weight=weight)
    grasp = grasp_matrix(CLOSED)
    sphere = Sphere.from_center_radius((0.15, 0.02, 0.1), 0.07)
    form = Form.of((loop.right, loop.left), (1,), held)
    given = parameters(duals(sphere), CLOSED, held)
    solver = program(form).solver
    signs, start = np.sign(limb_factors(CLOSED)), determinant(CLOSED, scheme)

    def lagrangian(q, multipliers):
        screws = np.hstack([RIGHT(q[:5])[1], LEFT(q[5:])[1]])
        cost = ((q - CLOSED) ** 2).sum() / 2 - weight * np.log(np.linalg.det(screws @ screws.T))
        x = (RIGHT(q[:5])[0] @ np.array([0.02, 0.01, 0.03, 1.0]))[:3] - sphere.center
        incidence = [(sphere.radius**2 - (x * x).sum()) / (2 * sphere.radius) / 0.1]
        constraints = np.concatenate([incidence, closure(q, grasp), signs * limb_factors(q), [determinant(q, scheme) / start]])
        return cost, constraints, cost + multipliers @ constraints

    def gradient(q, multipliers):
        """By complex steps: exact to rounding."""
        return np.array([lagrangian(q + 1e-30j * row, multipliers)[2].imag / 1e-30 for row in np.eye(10)])

    for _ in range(3):
        q, multipliers = CLOSED + rng.uniform(-0.15, 0.15, 10), rng.normal(size=10)
        cost, constraints, _ = lagrangian(q, multipliers)
        assert float(solver.get_function("nlp_f")(q, given)) == pytest.approx(cost, abs=1e-12)
        np.testing.assert_allclose(np.array(solver.get_function("nlp_g")(q, given)).ravel(), constraints, atol=1e-12)
        upper = np.array(solver.get_function("nlp_hess_l")(q, given, 1.0, multipliers))
        exact = upper + np.triu(upper, 1).T
        step = 1e-5
        central = [(gradient(q + step * row, multipliers) - gradient(q - step * row, multipliers)) / (2 * step) for row in np.eye(10)]
        np.testing.assert_allclose(exact, np.array(central), atol=1e-8 * np.abs(exact).max())
