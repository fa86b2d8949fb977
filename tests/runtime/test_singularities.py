"""Where the singularities are (closed forms of paper C 5.1, 5.2.1) and how far away (IPOPT against distances known in closed form)."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.singularities import BOX, limb_factor_identity, limb_loci
from cga_runtime.errors import DegenerateError, SchemeError, UnknownNameError, WrongSizeError
from cga_runtime.loading import load_robot

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())
SINGULAR = ORACLE["singular"]
ROBOTS = {name: load_robot(name) for name in ("nao", "nao_v32")}
LOOPS = {name: ClosedChain(robot.chain("RHand"), robot.chain("LHand")) for name, robot in ROBOTS.items()}
NAO = LOOPS["nao"]
STAR = {"nao": SINGULAR["q2_star_right_V33"], "nao_v32": SINGULAR["q2_star_V32"]}
POSE = np.array(ORACLE["fk"][0]["q"])
ARM = {"nao": math.hypot(0.105, 0.015), "nao_v32": 0.09}  # |US|


def apart(a, b):
    """|a - b| modulo half a turn."""
    return abs((a - b + math.pi / 2) % math.pi - math.pi / 2)


def test_limb_loci():
    """q2* = atan2(-r3, d3): 5.87 degrees outside the limits from V3.3 on, inside them for V3.2."""
    right, left = limb_loci(NAO)
    for locus, sign, arm in ((right, 1, "R"), (left, -1, "L")):
        assert abs(locus.q2_star - sign * SINGULAR["q2_star_right_V33"]) < 1e-12
        assert abs(locus.margin - SINGULAR["margin_to_limit_rad"]) < 1e-12
        assert (locus.inside, locus.arm, locus.joint) == (False, f"{arm}Hand", f"{arm}ShoulderRoll")
        assert abs(locus.f0 - 0.105) < 1e-12 and abs(locus.f1 - sign * 0.015) < 1e-12
    assert abs(SINGULAR["q2_star_right_V33"] + 1.4288992721907328) < 1e-15
    assert abs(SINGULAR["margin_to_limit_rad"] - 0.10244927219073285) < 1e-15
    for locus, sign in zip(limb_loci(LOOPS["nao_v32"]), (1, -1), strict=True):
        assert abs(locus.q2_star + sign * math.pi / 2) < 1e-12
        assert locus.inside and locus.margin == 0 and abs(locus.f0 - 0.09) < 1e-12 and abs(locus.f1) < 1e-12


@pytest.mark.parametrize("name", LOOPS)
def test_factors_vanish_at_the_loci_only(name):
    """f = f0 cos q2 + f1 sin q2 whatever the other joints do; zero at q2* and half a turn on, ranges in the limits as known."""
    loop = LOOPS[name]
    q = np.random.default_rng(50).uniform(-np.pi, np.pi, (500, 10))
    factors = loop.kernel("limb_factors")
    for k, locus in enumerate(limb_loci(loop)):
        j = 5 * k + 1
        np.testing.assert_allclose(factors(q)[:, k, 0], locus.f0 * np.cos(q[:, j]) + locus.f1 * np.sin(q[:, j]), atol=1e-16)
        for turn in (0, np.pi):
            at = q.copy()
            at[:, j] = locus.q2_star + turn
            assert np.abs(factors(at)[:, k, 0]).max() < 1e-16
            at[:, j] += 0.1
            assert np.abs(np.abs(factors(at)[:, k, 0]) - ARM[name] * math.sin(0.1)).max() < 1e-15
    inside = np.linspace(loop.lower, loop.upper, 20001)
    f, sine = factors(inside)[:, 0, 0], np.abs(factors(inside)[:, 0, 1])
    expected = (0.010847, 0.106066) if name == "nao" else (-0.00706, 0.0900)
    np.testing.assert_allclose((f.min(), f.max()), expected, atol=6e-6)
    np.testing.assert_allclose(sine.min(), 0.034900 if name == "nao" else math.sin(0.00872665), atol=1e-6)


def test_limb_determinant_of_the_reference_poses():
    """sqrt det(J_S^T J_S) = |f sin q4| |US| from the reference's screws and centres alone."""
    for pose in ORACLE["fk"]:
        for side in "RL":
            w, v = np.split(np.array(pose[side]["screws"]), 2)
            about = np.concatenate([w, v + np.cross(w.T, pose[side]["S"]).T])
            root = math.sqrt(np.linalg.det(about.T @ about))
            assert abs(root - abs(pose[side]["f2"] * pose[side]["sinq4"]) * ARM["nao"]) < 1e-14
    q = np.array([pose["q"] for pose in ORACLE["fk"]])
    assert np.abs(limb_factor_identity(NAO, q)).max() < 1e-15


@pytest.mark.parametrize("name", LOOPS)
def test_limb_factor_identity(name):
    """Everywhere to rounding, at and within 1e-9 of the singularities as well; the gap is seen when S or a factor is wrong."""
    loop, rng = LOOPS[name], np.random.default_rng(51)
    q = loop.random(rng, (4, 250))
    assert limb_factor_identity(loop, q).shape == (4, 250, 2)
    assert np.abs(limb_factor_identity(loop, q)).max() < 1e-15
    q[0, :, 3], q[1, :, 1], q[2, :, 8], q[3, :, 6] = 0.0, STAR[name], 1e-9 * rng.standard_normal(250), -STAR[name] + 1e-9
    assert np.abs(limb_factor_identity(loop, q)).max() < 1e-15


@pytest.mark.parametrize("name", LOOPS)
def test_nearest_limb_singularity(name):
    """60 poses, one start each: the distance is min(|q2 - q2*|, |q4|) modulo pi over both arms, and one joint moves."""
    loop = LOOPS[name]
    for q in loop.random(np.random.default_rng(52), 60):
        expected = {
            "f right": apart(q[1], STAR[name]),
            "sin q4 right": apart(q[3], 0),
            "f left": apart(q[6], -STAR[name]),
            "sin q4 left": apart(q[8], 0),
        }
        found = loop.nearest_singularity(q, starts=1)
        assert found.success and found.kind == "limb" and found.status == "found" and not found.within_limits
        assert abs(found.distance - min(expected.values())) < 1e-7
        assert abs(expected[found.factor] - found.distance) < 1e-7
        assert (np.abs(found.q - q) > 1e-6).sum() <= 1
        assert found.value < 1e-7 and np.abs(found.q - q).max() <= BOX


@pytest.mark.parametrize("name", LOOPS)
def test_nearest_constraint_singularity(name):
    """Both f at once: the distance is that of (q2, q7) from (q2*, -q2*), each modulo pi."""
    loop = LOOPS[name]
    for q in loop.random(np.random.default_rng(53), 60):
        found = loop.nearest_singularity(q, kind="constraint", starts=1)
        expected = math.hypot(apart(q[1], STAR[name]), apart(q[6], -STAR[name]))
        assert found.success and found.factor == "f right, f left"
        assert abs(found.distance - expected) < 1e-7
        assert loop.mobility(found.q).joint_mobility == 5


def test_within_the_limits():
    """From V3.3 on neither kind is reachable; V3.2 reaches both, at the distance of the branch inside the limits."""
    for q in NAO.random(np.random.default_rng(54), 5):
        for kind in ("limb", "constraint"):
            found = NAO.nearest_singularity(q, kind=kind, within_limits=True, starts=2)
            assert not found.success and found.distance == math.inf and math.isnan(found.value)
            assert (found.status, found.factor) == ("none found inside the joint limits", "")
            assert found.to_json() == {
                "success": False, "kind": kind, "factor": "", "q": None, "distance": None, "value": None,
                "status": "none found inside the joint limits", "within_limits": True, "certified": False,
            }  # fmt: skip
    loop = LOOPS["nao_v32"]
    for q in loop.random(np.random.default_rng(55), 20):
        found = loop.nearest_singularity(q, within_limits=True, starts=2)
        assert abs(found.distance - min(abs(q[1] + math.pi / 2), abs(q[6] - math.pi / 2))) < 1e-7
        assert found.factor in ("f right", "f left")  # q4 = 0 stays outside
        both = loop.nearest_singularity(q, kind="constraint", within_limits=True, starts=1)
        assert abs(both.distance - math.hypot(q[1] + math.pi / 2, q[6] - math.pi / 2)) < 1e-7
        assert (both.q >= loop.lower).all() and (both.q <= loop.upper).all()
        json.loads(json.dumps(both.to_json(), allow_nan=False))


def slope_error(q, found, actuated):
    """How far the step is from the optimality conditions: along the gradient of D, save where a limit holds a joint back."""
    gradient, step = NAO.determinant_gradient(found.q, actuated), found.q - q
    free = (found.q > NAO.lower + 1e-6) & (found.q < NAO.upper - 1e-6)
    factor = (gradient[free] @ step[free]) / (gradient[free] @ gradient[free])
    rest = step - factor * gradient
    # a joint at its upper limit wants to go further up, one at its lower limit further down
    held = np.where(found.q >= NAO.upper - 1e-6, np.maximum(rest, 0), np.minimum(rest, 0))
    return np.abs(np.where(free, rest, held)).max()


@pytest.mark.parametrize(("actuated", "median"), [((1, 3, 7, 8), 0.38), ((1, 2, 3, 7), 0.35)])
def test_nearest_actuation_singularity(actuated, median):
    """Inside the limits: always found, locally optimal, median as in the reference to 30 %; 1237 has q1 = q6, |q1 - q6| / sqrt 2 away."""
    distances, beyond = [], 0
    for q in NAO.random(np.random.default_rng(5), 100):
        found = NAO.nearest_singularity(q, kind="actuation", actuated=actuated, within_limits=True, starts=2)
        assert found.success and found.factor == "determinant"
        assert (found.q >= NAO.lower).all() and (found.q <= NAO.upper).all()
        assert abs(NAO.determinant(found.q, actuated)) == found.value < 1e-7
        assert abs(found.distance - np.linalg.norm(found.q - q)) == 0
        assert slope_error(q, found, actuated) < 1e-4
        assert NAO.conditioning(found.q, actuated) < 1e-6
        beyond += actuated == (1, 2, 3, 7) and found.distance > abs(q[0] - q[5]) / math.sqrt(2) + 1e-7
        distances.append(found.distance)
    assert beyond <= 2  # a local optimum, from two starts: distances are upper bounds
    assert abs(np.median(distances) / median - 1) < 0.3


@pytest.mark.parametrize("actuated", [(1, 3, 7, 8), (1, 2, 3, 7)])
def test_singularity_free_box(actuated):
    """D vanishes on the box's edge and, by samples of our own, hardly ever inside: the radius is an upper bound, never certified."""
    rng, radii, wrong = np.random.default_rng(56), [], []
    for q in NAO.random(np.random.default_rng(57), 30):
        box = NAO.singularity_free_box(q, actuated)
        assert box.success and box.certified is False and (box.samples, box.sign_changes) == (2000, 0)
        assert abs(NAO.determinant(box.q, actuated)) < 1e-7 and abs(np.abs(box.q - q).max() - box.radius) == 0
        inside = q + 0.99 * box.radius * rng.uniform(-1, 1, (500, 10))
        wrong.append((np.sign(NAO.determinant(inside, actuated)) != np.sign(NAO.determinant(q, actuated))).sum())
        if actuated == (1, 2, 3, 7):
            assert box.radius <= abs(q[0] - q[5]) / 2 + 1e-7
        # in the largest norm every joint that matters goes to the edge
        gradient = NAO.determinant_gradient(box.q, actuated)
        short = np.abs(box.q - q) < box.radius - 1e-5
        assert np.abs(gradient[short]).max(initial=0.0) < 1e-3 * np.abs(gradient).max()
        radii.append(box.radius)
    # a pocket of 2e-4 of a box's volume, near one corner, escapes 2000 samples
    assert np.count_nonzero(wrong) <= 2 and sum(wrong) <= 10
    # the reference's medians of 20 poses are 0.199 and 0.236 rad; those of 20 of ours lie between 0.13 and 0.23
    assert 0.12 < np.median(radii) < 0.26


def test_at_a_singularity_already():
    q = POSE.copy()
    q[5] = q[0]
    assert NAO.nearest_singularity(q, kind="actuation", actuated=(1, 2, 3, 7)).distance < 1e-6
    everywhere = POSE  # of 1267
    for at, actuated in ((q, (1, 2, 3, 7)), (everywhere, (1, 2, 6, 7))):
        box = NAO.singularity_free_box(at, actuated)
        assert (box.radius, box.success, box.sign_changes) == (0, True, 0)
        np.testing.assert_array_equal(NAO.nearest_singularity(at, kind="actuation", actuated=actuated).q, at)


def test_a_start_outside_and_joints_without_limits():
    loop = ClosedChain(ROBOTS["nao"].chain("RHand"), ROBOTS["nao"].chain("LHand"))
    loop.lower, loop.upper = np.full(10, -np.inf), np.full(10, np.inf)
    q = POSE
    found = loop.nearest_singularity(q, within_limits=True)
    assert abs(found.distance - min(apart(q[1], STAR["nao"]), apart(q[3], 0), apart(q[6], -STAR["nao"]), apart(q[8], 0))) < 1e-7
    outside = NAO.upper + 0.5
    found = NAO.nearest_singularity(outside, kind="actuation", actuated=(1, 2, 3, 7), within_limits=True)
    assert found.success and (found.q <= NAO.upper).all()


def test_the_same_seed_gives_the_same_answer():
    q = NAO.random(np.random.default_rng(58))
    calls = [NAO.nearest_singularity(q, kind="actuation", actuated=(8, 7, 3, 1), within_limits=True, seed=4).to_json() for _ in range(2)]
    assert calls[0] == calls[1]


def test_bad_questions():
    q = np.zeros(10)
    with pytest.raises(UnknownNameError, match="unknown kind of singularity 'wrist'; known: limb, constraint, actuation"):
        NAO.nearest_singularity(q, kind="wrist")
    with pytest.raises(SchemeError, match="^kind 'actuation' needs actuated joints$"):
        NAO.nearest_singularity(q, kind="actuation")
    with pytest.raises(SchemeError, match="^kind 'limb' takes no actuated joints$"):
        NAO.nearest_singularity(q, kind="limb", actuated=(1, 2, 3, 4))
    with pytest.raises(SchemeError, match="4 distinct joint numbers"):
        NAO.nearest_singularity(q, kind="actuation", actuated=(1, 2, 3))
    with pytest.raises(SchemeError, match="4 distinct joint numbers"):
        NAO.singularity_free_box(q, (1, 2, 3, 11))
    for call in (lambda x: NAO.nearest_singularity(x), lambda x: NAO.singularity_free_box(x, (1, 3, 7, 8))):
        with pytest.raises(WrongSizeError, match=r"one configuration of shape \(10,\) needed, \(3, 10\) given"):
            call(np.zeros((3, 10)))


def test_shoulders_that_are_not_collinear():
    """A raised arm: with f = 0 in both arms the two forces are parallel, W^c keeps rank 2, and the question is refused."""
    up = np.eye(4)
    up[2, 3] = 0.013
    loop = ClosedChain(ROBOTS["nao"].chain("RHand"), ROBOTS["nao"].chain("LHand", placement=up))
    q = POSE.copy()
    q[1], q[6] = STAR["nao"], -STAR["nao"]
    assert np.linalg.matrix_rank(loop.kernel("constraint_wrenches")(q), tol=1e-9) == 2
    assert loop.mobility(q).limb_ranks == (4, 4) and loop.mobility(q).object_dof == 2
    with pytest.raises(DegenerateError, match="that of arms whose first axes are one line"):
        loop.nearest_singularity(q, kind="constraint")
    assert loop.nearest_singularity(q, kind="limb").distance == 0


def test_arms_without_wrist_centres():
    """Three and four joints: no limb factors, said in words; actuation singularities are found all the same."""
    loop = ClosedChain(ROBOTS["nao"].chain("RElbow"), ROBOTS["nao"].chain("LForeArm"))
    q = np.array([0.1, -0.3, 0.2, 0.4, 0.5, -0.6, -0.7])
    words = r"<ClosedChain RElbow \+ LForeArm: 7 joints>: limb factors need two arms of five revolute joints"
    for call in (lambda: limb_loci(loop), lambda: limb_factor_identity(loop, q), lambda: loop.nearest_singularity(q)):
        with pytest.raises(DegenerateError, match=words):
            call()
    found = loop.nearest_singularity(q, kind="actuation", actuated=[1])
    assert found.success and abs(loop.determinant(found.q, [1])) < 1e-7
