"""Paper C, sections 3 to 5.2.1: closure, screws, reciprocity, mobility, motion types, limb and constraint singularities.

Reproduced: eqs. 2-4, 8-19 and Table 2. Not as printed: q2 of 5.1 and (19) with atan (E1: it needs atan2 where d3 = 0, and has a second
branch half a turn on). Actuation schemes (eqs. 5-7, 20, 21) are in test_c_actuation.py, Table 1 in test_c_mdh.py.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.loading import load_robot
from cga_runtime.spaces.loop_walk import walk

DATA = Path(__file__).parents[1] / "data"
ORACLE = json.loads((DATA / "nao.json").read_text())
CONSTANTS = json.loads((DATA / "nao_facts.json").read_text())["constants"]
LOOPS = {}
for name, version in (("nao", "V50"), ("nao_v32", "V32")):
    robot = load_robot(name)
    LOOPS[version] = ClosedChain(robot.chain("RHand"), robot.chain("LHand"))
LOOP = LOOPS["V50"]
SHOULDERS = np.array([[0, -0.098, 0.1], [0, 0.098, 0.1]])  # U of the right and of the left arm
SWAP = np.roll(np.eye(6), 3, axis=0)  # [[0, 1], [1, 0]] of eq. 10
FORM = np.repeat([1.0, 10.0], 3)[:, None]  # lengths in 0.1 m


def line(point, direction, pitch=0.0):
    """S of eqs. 8, 9: (s, s x r + pitch s), r from a point on the axis to the origin."""
    s = np.asarray(direction) / np.linalg.norm(direction)
    return np.concatenate([s, np.cross(s, -np.asarray(point)) + pitch * s])


def free(direction):
    """S of infinite pitch, eq. 9."""
    return np.concatenate([np.zeros(3), np.asarray(direction) / np.linalg.norm(direction)])


def rank(*screws):
    return int((np.linalg.svd(FORM * np.column_stack(screws), compute_uv=False) > 1e-9).sum())


def null(rows):
    _, values, vt = np.linalg.svd(rows)
    return vt[int((values > 1e-9).sum()) :].T


def product(a, b):
    """Reciprocal product of eq. 10."""
    return (SWAP @ a) @ b


def frames(q):
    """0T5 and 0T10 of Table 1."""
    c, found = CONSTANTS["V50"], []
    for s, part in ((-1, q[:5]), (1, q[5:])):
        m, h = np.eye(4), np.pi / 2
        rows = [(c["ShoulderOffsetZ"], 0, -h, s * c["ShoulderOffsetY"]), (0, 0, h, 0), (0, s * c["ElbowOffsetY"], h, c["UpperArmLength"]),
                (0, 0, -h, 0), (0, 0, h, c["LowerArmLength"])]  # fmt: skip
        for j, ((b, d, alpha, r), angle) in enumerate(zip(rows, part, strict=True)):
            m = m @ eq1(0, b, alpha, d, angle + h * (j == 1), r)
        found.append(m)
    return found


def eq1(gamma, b, alpha, d, theta, r):
    def turn(axis, angle, shift):
        i, j = ((1, 2), (0, 1))[axis == "z"]
        m = np.eye(4)
        m[[i, i, j, j], [i, j, i, j]] = math.cos(angle), -math.sin(angle), math.sin(angle), math.cos(angle)
        m["xyz".index(axis), 3] = shift
        return m

    return turn("z", gamma, b) @ turn("x", alpha, d) @ turn("z", theta, r)


def motions(q):
    """Joint velocities that keep the loop closed, (10, 4)."""
    return null(LOOP.twists(q) * FORM * np.where(np.arange(10) < 5, 1, -1))


def test_eq_2_and_frame_11():
    """On a walk with one grasp 0T5 5T11 = 0T10 with a constant 5T11, which six parameters (gamma .. r) of Table 1's last row describe."""
    found = walk(LOOP, ORACLE["closed_loop"]["q0"], 60, np.random.default_rng(60))
    t5, t10 = frames(found.q[0])
    t11 = np.linalg.inv(t5) @ t10
    for q in found.q:
        t5, t10 = frames(q)
        np.testing.assert_allclose(t5 @ t11, t10, atol=1e-11)
    r = t11[:3, :3]
    alpha = math.acos(r[2, 2])
    gamma, theta = math.atan2(r[0, 2], -r[1, 2]), math.atan2(r[2, 0], r[2, 1])
    basis = np.column_stack([[0, 0, 1], [math.cos(gamma), math.sin(gamma), 0], r[:, 2]])
    b, d, offset = np.linalg.solve(basis, t11[:3, 3])
    np.testing.assert_allclose(eq1(gamma, b, alpha, d, theta, offset), t11, atol=1e-14)


def test_eqs_3_4_velocities():
    """J11 q'_r = J10 q'_l moves frames 11 and 10 alike: central differences of Table 1's frames along null([J_R, -J_L])."""
    h = 1e-5
    for q in LOOP.random(np.random.default_rng(61), 10):
        t5, t10 = frames(q)
        t11 = np.linalg.inv(t5) @ t10
        for rates in motions(q).T:
            ahead, behind = frames(q + h * rates), frames(q - h * rates)
            right, left = ((ahead[0] - behind[0]) @ t11 / (2 * h), (ahead[1] - behind[1]) / (2 * h))
            np.testing.assert_allclose(right, left, atol=1e-9)
            w, v = np.split(LOOP.twists(q)[:, :5] @ rates[:5], 2)
            np.testing.assert_allclose(left[:3, 3], v + np.cross(w, t10[:3, 3]), atol=1e-9)


def test_eqs_8_9_screws():
    """A point p moves with v + s x p: on the axis only along it, by the pitch; the choice of the point on the axis does not matter."""
    rng = np.random.default_rng(62)
    for p, s in rng.standard_normal((50, 2, 3)):
        for pitch in (0.0, 0.7):
            screw = line(p, s, pitch)
            np.testing.assert_allclose(screw[3:] + np.cross(screw[:3], p), pitch * screw[:3], atol=1e-14)
            np.testing.assert_allclose(line(p + 2.5 * s, s, pitch), screw, atol=1e-13)
    for q in LOOP.random(rng, 20):  # the package's screws are the axes of revolute joints: pitch zero
        w, v = np.split(LOOP.twists(q), 2)
        assert np.abs((w * v).sum(axis=0)).max() < 1e-16


def test_eq_10_reciprocity_conditions():
    """1: zero and infinite pitch, perpendicular; 2: two of infinite pitch, always; 3: two of zero pitch, coplanar. With the converse."""
    rng = np.random.default_rng(63)
    for p, s, d, x in rng.standard_normal((50, 4, 3)):
        square, unit = np.cross(s, d), s / np.linalg.norm(s)
        assert abs(product(line(p, s), free(square))) < 1e-14
        assert abs(product(line(p, s), free(d)) - unit @ d / np.linalg.norm(d)) < 1e-14
        assert product(free(s), free(d)) == 0
        meeting, parallel, skew = line(p + 1.5 * s, d), line(x, s), line(x, d)
        assert abs(product(line(p, s), meeting)) < 1e-13 and abs(product(line(p, s), parallel)) < 1e-13
        moment = (p - x) @ np.cross(s, d) / np.linalg.norm(s) / np.linalg.norm(d)  # distance times sine of the angle
        assert abs(product(line(p, s), skew) - moment) < 1e-13 and abs(moment) > 1e-6
    for n in range(1, 6):
        screws = rng.standard_normal((6, n))
        assert null(screws.T @ SWAP).shape == (6, 6 - n)


def test_eqs_11_to_16_mobility():
    """Twist systems by sums, wrench systems by intersections; U- and S-joint, one force through U and S, W^c of rank 2, four DoF."""
    for q in LOOP.random(np.random.default_rng(64), 30):
        twists, centres = LOOP.twists(q), LOOP.kernel("wrist_centres")(q)
        forces = []
        for k, columns in enumerate((range(5), range(5, 10))):
            arm = [twists[:, j] for j in columns]
            for point, joints in ((SHOULDERS[k], arm[:2]), (centres[k], arm[2:])):
                for screw in joints:
                    np.testing.assert_allclose(screw[3:] + np.cross(screw[:3], point), 0, atol=1e-15)  # the axis runs through it
            assert rank(*arm) == 5  # (13), (14)
            # (11): the intersection of the joints' wrench systems W_j is what all of them annihilate
            spans = [null((SWAP @ screw)[None]) for screw in arm]
            outside = np.concatenate([null(span.T).T for span in spans])
            common = null(outside)
            assert common.shape == (6, 1) and all(span.shape == (6, 5) for span in spans)
            force = line(SHOULDERS[k], centres[k] - SHOULDERS[k])  # (15)
            assert rank(force, common[:, 0]) == 1
            assert max(abs(product(force, screw)) for screw in arm) < 1e-16
            forces.append(force)
        assert rank(*forces) == 2  # (16)
        both = null(np.array(forces) @ SWAP)  # (12): T is reciprocal to W
        assert both.shape == (6, 4)
        object_twists = twists[:, :5] @ motions(q)[:5]
        assert rank(object_twists) == 4 and rank(both, object_twists) == 4
        found = LOOP.mobility(q)
        assert (found.object_dof, found.constraint_rank) == (4, 2)
        assert found.joint_mobility == 6 * (10 - 1 - 10) + 10  # Chebychev-Gruebler-Kutzbach: ten bodies with the torso, ten joints


def test_motion_types_by_construction():
    """Parallel forces: two translations normal to them, two rotations about lines in their plane. Else one and three transversals."""
    x = np.array([1.0, 0, 0])
    one, two = line([0, -0.1, 0.1], x), line([0, 0.1, 0.1], x)
    twists = [free([0, 1, 0]), free([0, 0, 1]), line([0, 0, 0.1], x), line([0, 0.3, 0.1], [1, 1, 0])]
    assert max(abs(product(w, t)) for w in (one, two) for t in twists) < 1e-15
    assert rank(*twists) == 4 == null(np.array([one, two]) @ SWAP).shape[1]
    assert 4 - rank(*(np.concatenate([t[:3], np.zeros(3)]) for t in twists)) == 2  # 2T2R: two of the four have no rotation
    rng = np.random.default_rng(65)
    for p, s, o, d in rng.standard_normal((30, 4, 3)):
        for other in (o, p + 0.8 * s):  # skew lines, and lines that meet in p + 0.8 s
            one, two = line(p, s), line(other, d)
            points = [(p + a * s, other + b * d) for a, b in ((0.1, 0.4), (1.2, -0.7), (-0.6, 0.9))]
            twists = [free(np.cross(s, d)), *(line(a, b - a) for a, b in points)]
            assert max(abs(product(w, t)) for w in (one, two) for t in twists) < 1e-12
            if other is not o:  # of lines that meet, such transversals lie in one plane: one is replaced by a line through the point
                twists[3] = line(other, rng.standard_normal(3))
                assert max(abs(product(w, twists[3])) for w in (one, two)) < 1e-12
            assert rank(*twists) == 4
            assert 4 - rank(*(np.concatenate([t[:3], np.zeros(3)]) for t in twists)) == 1


@pytest.mark.parametrize("version", LOOPS)
def test_eqs_17_18_limb_singularities(version):
    """With the S centre as origin: the pieces of the proof that q4 = 0, pi and q2* are all there is, and the determinant itself."""
    loop, c = LOOPS[version], CONSTANTS[version]
    r3, d3 = c["UpperArmLength"], c["ElbowOffsetY"]
    for q in np.random.default_rng(66).uniform(-np.pi, np.pi, (200, 10)):
        for k, sign in ((0, 1), (1, -1)):
            w = loop.twists(q)[:3, 5 * k : 5 * k + 5].T
            r = loop.kernel("wrist_centres")(q)[k] - SHOULDERS[k]
            q2, q4 = q[5 * k + 1], q[5 * k + 3]
            f = r3 * math.cos(q2) + sign * d3 * math.sin(q2)
            assert max(abs(w[0] @ w[1]), abs(w[2] @ w[3]), abs(w[3] @ w[4])) < 1e-15
            arm1, arm2 = np.cross(w[0], r), np.cross(w[1], r)
            np.testing.assert_allclose([arm2 @ arm2, arm1 @ arm2, arm1 @ arm1], [r3**2 + d3**2, 0, f**2], atol=1e-16)
            assert abs(np.linalg.det(w[2:]) + math.sin(q4)) < 1e-15
            jacobian = np.zeros((6, 5))  # (18)
            jacobian[:3], jacobian[3:, 0], jacobian[3:, 1] = w.T, arm1, arm2
            volume = np.linalg.svd(jacobian, compute_uv=False).prod()
            assert abs(volume - abs(math.sin(q4) * f) * math.hypot(r3, d3)) < 1e-16


def test_erratum_e1_atan():
    """Printed q2 = atan(-r3 / d3) has no value for V3.2; atan2 has, and half a turn on (not printed) the arm is singular too."""
    r3, d3 = CONSTANTS["V32"]["UpperArmLength"], CONSTANTS["V32"]["ElbowOffsetY"]
    with pytest.raises(ZeroDivisionError):
        math.atan(-r3 / d3)
    q = np.full(10, 0.3)
    for version in LOOPS:
        c = CONSTANTS[version]
        star = math.atan2(-c["UpperArmLength"], c["ElbowOffsetY"])
        for q2 in (star, star + math.pi):
            q[1] = q2
            assert LOOPS[version].mobility(q).limb_ranks == (4, 5)
    q[1] = star + math.pi / 2  # what reading it as theta2 gives
    assert LOOPS["V32"].mobility(q).limb_ranks == (5, 5)


def test_table_2():
    """Linear dependence: collinear forces, parallel moments, more than three forces through a point, six that meet one line."""
    rng = np.random.default_rng(67)
    for p, s in rng.standard_normal((20, 2, 3)):
        d, e = rng.standard_normal((2, 6, 3))
        assert rank(line(p, s), line(p + 3 * s, -s)) == 1 and rank(line(p, s), line(p + d[0], s)) == 2
        assert rank(free(s), free(-s)) == 1 and rank(free(s), free(d[0])) == 2
        assert [rank(*(line(p, x) for x in d[:k])) for k in (3, 4, 6)] == [3, 3, 3]
        meeting = [line(p + a * s, x) for a, x in zip(rng.standard_normal(6), d, strict=True)]
        assert [rank(*meeting[:k]) for k in (5, 6)] == [5, 5]
        assert rank(*(line(x, y) for x, y in zip(d, e, strict=True))) == 6


@pytest.mark.parametrize("version", LOOPS)
def test_eq_19_constraint_singularity(version):
    """W^c has rank 1 exactly when both S centres lie on the shoulder line (up to pi); then both limbs are singular and W is a 3-system."""
    loop, c = LOOPS[version], CONSTANTS[version]
    star = math.atan2(-c["UpperArmLength"], c["ElbowOffsetY"])
    q = np.random.default_rng(68).uniform(-1, 1, 10)
    for (shift, other), (a, b) in zip(
        [(0, 0), (0, math.pi), (math.pi, 0), (1e-5, 0), (0, 1e-5), (0.4, -0.4)], [(0, 0)] * 3 + [(1, 0), (0, 1), (1, 1)], strict=True
    ):
        q[1], q[6] = star + shift, -star + other
        centres = loop.kernel("wrist_centres")(q)
        forces = [line(u, centre - u) for u, centre in zip(SHOULDERS, centres, strict=True)]
        off = [int(np.linalg.norm((centre - u)[[0, 2]]) > 1e-9) for u, centre in zip(SHOULDERS, centres, strict=True)]
        assert off == [a, b] and (rank(*forces) == 1) == (off == [0, 0])
        found = loop.mobility(q)
        assert found.limb_ranks == (4 + a, 4 + b)
        if off == [0, 0]:
            assert (found.constraint_rank, found.object_dof, len(found.constraint_wrenches)) == (3, 3, 4)
