"""Paper C, eqs. 5-7 and section 5.2.2: passive velocities, actuation schemes, examples 1 and 2, and the errata E2 to E7.

Reproduced: eqs. 5-7, 20, 21, 210 schemes, example 1 is singular everywhere, example 2 is not. Not as printed: the actuation wrenches of
joints 6 and 7 (E2), rank(W^a) = 4 in mirror poses (E3), the list of example 2's singularities (E4), the number of inadmissible schemes (E5:
71, not 1), the words for 110 (E6), the wrench of joint 3 at limb singularities (E7).
"""

import json
import math
from itertools import combinations
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.loading import load_robot
from cga_runtime.spaces.closed_chain import LENGTH

ORACLE = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())
ROBOT = load_robot("nao")
LOOP = ClosedChain(ROBOT.chain("RHand"), ROBOT.chain("LHand"))
SHOULDERS = np.array([[0, -0.098, 0.1], [0, 0.098, 0.1]])
STAR = ORACLE["singular"]["q2_star_right_V33"]
ALL = list(combinations(range(1, 11), 4))
FORM = np.repeat([1.0, 10.0], 3)[:, None]
ROUNDING = 1e-16
"""Of the determinant of six screws with norms of at least one: eps times their product (Hadamard); the processor decides how much of it."""


class Pose:
    """Screws s[1..10], S centres and wrenches of one configuration, in the paper's numbering."""

    def __init__(self, q):
        self.q, self.twists = q, LOOP.twists(q)
        self.s = dict(enumerate(self.twists.T, start=1))
        self.a, self.b = LOOP.kernel("wrist_centres")(q)
        self.f = LOOP.kernel("limb_factors")(q)[:, 0]
        self.constraints = [force(u, centre - u) for u, centre in zip(SHOULDERS, (self.a, self.b), strict=True)]

    def w(self, j):
        return self.s[j][:3]

    def passive(self, actuated):
        return [j for j in range(1, 11) if j not in actuated]

    def raw(self, actuated):
        """Unscaled determinant of the passive screws."""
        return np.linalg.det(np.column_stack([self.s[j] for j in self.passive(actuated)]))


def force(point, direction):
    """A wrench (f, m), not normalised."""
    return np.concatenate([direction, np.cross(point, direction)])


def power(wrench, twist):
    return wrench[:3] @ twist[3:] + wrench[3:] @ twist[:3]


def rank(*screws, form=FORM):
    unit = [screw / np.linalg.norm(form[:, 0] * screw) for screw in screws]
    return int((np.linalg.svd(form * np.column_stack(unit), compute_uv=False) > 1e-9).sum())


def poses(seed, count, mirror=False):
    found = LOOP.random(np.random.default_rng(seed), count)
    if mirror:
        found[:, 5:] = [1, -1, -1, -1, -1] * found[:, :5]
    return [Pose(q) for q in found]


def works_on(wrench, pose, joints):
    return [j for j in joints if abs(power(wrench, pose.s[j])) > 1e-12]


def test_eqs_5_to_7_passive_velocities():
    """Joint 10 cut: five rows that annihilate its screw hold Ga (5x4) and Gp (5x5), the sixth Gc; (6) and (7) close the loop."""
    for pose in poses(70, 12):
        closure = pose.twists * np.where(np.arange(10) < 5, 1, -1)
        _, _, vt = np.linalg.svd(pose.s[10][None])
        rows = np.concatenate([vt[1:], vt[:1]]) @ closure  # orthonormal covectors, the last along s10
        assert np.abs(rows[:5, 9]).max() < 1e-15
        for actuated in (scheme for scheme in ALL if 10 not in scheme):
            active = [j - 1 for j in actuated]
            passive = [j for j in range(9) if j not in active]
            ga, gp = rows[:5][:, active], rows[:5][:, passive]
            gac, gpc, gc = rows[5, active], rows[5, passive], rows[5, 9]
            assert (ga.shape, gp.shape) == ((5, 4), (5, 5))
            product = np.linalg.det(gp) * gc
            assert abs(abs(product) - abs(pose.raw(actuated))) < 1e-15  # Gp degenerates with the scheme's determinant
            if LOOP.conditioning(pose.q, actuated) < 1e-3:
                continue
            rates = np.zeros(10)
            rates[active] = [0.3, -0.2, 0.5, 0.4]
            rates[passive] = -np.linalg.solve(gp, ga @ rates[active])  # (6)
            rates[9] = -(gac - gpc @ np.linalg.solve(gp, ga)) @ rates[active] / gc  # (7)
            assert np.abs(closure @ rates).max() < 1e-12 * np.abs(rates).max()


def test_parallel_singularities_of_gp():
    """Schemes that are never admissible have a degenerate Gp everywhere; 1237 has one where q1 = q6."""
    for pose in poses(71, 10):
        q = pose.q.copy()
        q[5] = q[0]
        assert abs(Pose(q).raw((1, 2, 3, 7))) < ROUNDING < 1e-8 < abs(pose.raw((1, 2, 3, 7)))
        assert max(abs(pose.raw(scheme)) for scheme in ((1, 2, 6, 7), (2, 3, 7, 8), (4, 5, 9, 10))) < ROUNDING


def test_example_1_wrenches_and_erratum_e2():
    """The force through A along s2 works on q1 alone, along s1 on q2 alone. For the left arm the printed directions are exchanged."""
    for pose in poses(72, 30):
        right, left = range(1, 6), range(6, 11)
        assert works_on(force(pose.a, pose.w(2)), pose, right) == [1]
        assert works_on(force(pose.a, pose.w(1)), pose, right) == [2]
        assert works_on(force(pose.b, pose.w(6)), pose, left) == [7]  # printed as the wrench of joint 6
        assert works_on(force(pose.b, pose.w(7)), pose, left) == [6]  # printed as the wrench of joint 7


def test_example_1_is_singular_everywhere():
    """AB meets all passive axes and all wrenches: rank(W) = 5, rank(W^c) = 2, rank(W^a) = 4; in mirror poses 3 (erratum E3)."""
    for mirror, expected in ((False, 4), (True, 3)):
        for pose in poses(73, 20, mirror):
            actuation = [force(pose.a, pose.w(2)), force(pose.a, pose.w(1)), force(pose.b, pose.w(7)), force(pose.b, pose.w(6))]
            assert rank(*pose.constraints) == 2
            assert rank(*actuation) == expected
            assert rank(*actuation, *pose.constraints) == 5
            assert rank(*(pose.s[j] for j in (3, 4, 5, 8, 9, 10))) == 5
            line = force(pose.a, pose.b - pose.a)
            assert max(abs(power(line, pose.s[j])) for j in (3, 4, 5, 8, 9, 10)) < 1e-15
            assert max(abs(power(line, wrench)) for wrench in (*actuation, *pose.constraints)) < 1e-15


def pencil_line(pose):
    """zeta3^a: the meet of the planes of (s1, s2) through U and of (s4, s5) through A, as a force."""
    n12, n45 = np.cross(pose.w(1), pose.w(2)), np.cross(pose.w(4), pose.w(5))
    direction = np.cross(n12, n45)
    return np.concatenate([direction, (n45 @ pose.a) * n12 - (n12 @ SHOULDERS[0]) * n45])


def test_example_2_wrench_of_joint_3():
    """zeta3^a lies in both planes, so it works on joint 3 alone of the right arm; for parallel planes it is a pure moment."""
    for pose in poses(74, 30):
        wrench = pencil_line(pose)
        assert works_on(wrench, pose, range(1, 6)) == [3]
        assert abs(wrench[:3] @ wrench[3:]) < 1e-16  # a pure force
        actuation = [force(pose.a, pose.w(2)), force(pose.a, pose.w(1)), wrench, force(pose.b, pose.w(6))]
        assert rank(*actuation, *pose.constraints) == 6  # admissible
    q = np.array([0.2, 0.2, 0.0, np.pi / 2 - 0.2, 0.3, 0.1, 0.3, 0.4, -0.8, 0.2])  # q3 = 0, q2 + q4 = pi/2: the planes are parallel
    assert ((q > LOOP.lower) & (q < LOOP.upper)).all()
    at = Pose(q)
    normal = np.cross(at.w(1), at.w(2))
    moment = np.concatenate([np.zeros(3), normal])
    assert works_on(moment, at, range(1, 6)) == [3]
    np.testing.assert_allclose(np.cross(normal, np.cross(at.w(4), at.w(5))), 0, atol=1e-15)
    assert rank(moment, pencil_line(at)) == 1  # the limit of the pure force


def test_erratum_e7_at_limb_singularities():
    """zeta3^a becomes reciprocal to s3 too: no actuation wrench of joint 3 but a constraint. At q2* the six wrenches have rank 4, where the
    passive twists, which stay defined, have rank 5; at q4 = 0 both have rank 6 (1237 is not singular there)."""
    for pose in poses(75, 10):
        for joint, value, wrenches, twists in ((3, 0.0, 6, 6), (1, STAR, 4, 5)):
            q = pose.q.copy()
            q[joint] = value
            at = Pose(q)
            wrench = pencil_line(at)
            assert np.linalg.norm(wrench[:3]) > 1e-3 and works_on(wrench, at, range(1, 6)) == []
            actuation = [force(at.a, at.w(2)), force(at.a, at.w(1)), wrench, force(at.b, at.w(6))]
            assert rank(*actuation, *at.constraints) == wrenches
            assert rank(*(at.s[j] for j in (4, 5, 6, 8, 9, 10))) == twists
            assert rank(wrench, at.constraints[0]) == 2  # a second constraint beside the force through U and A


def test_closed_form_of_example_2():
    """det[s4, s5, s6, s8, s9, s10] = -sin q9 (n45 . (B - A)) fR fL sin(q1 - q6), with its sign."""
    for pose in (Pose(q) for q in np.random.default_rng(76).uniform(-np.pi, np.pi, (300, 10))):
        n45 = np.cross(pose.w(4), pose.w(5))
        expected = -math.sin(pose.q[8]) * (n45 @ (pose.b - pose.a)) * pose.f[0] * pose.f[1] * math.sin(pose.q[0] - pose.q[5])
        assert abs(pose.raw((1, 2, 3, 7)) - expected) < 1e-16
        assert abs(LOOP.determinant(pose.q, (1, 2, 3, 7)) - expected / LENGTH**3) < 1e-13
        distance = abs(power(force(pose.a, pose.b - pose.a), pose.s[6]))
        assert abs(distance - abs(pose.f[0] * pose.f[1] * math.sin(pose.q[0] - pose.q[5]))) < 1e-15  # AB against the shoulder line


def test_erratum_e4_singularities_of_example_2():
    """Printed: B (or A) on zeta3^a, or zeta2^a and zeta7^a collinear. Found: each factor's zero is singular where neither holds."""
    for pose in poses(77, 15):
        q = pose.q.copy()

        def plane(x, q=q):
            at = Pose(np.where(np.arange(10) == 7, x, q))
            return np.cross(at.w(4), at.w(5)) @ (at.b - at.a)

        grid = np.linspace(-np.pi, np.pi, 25)
        values = [plane(x) for x in grid]
        crossing = next(((a, b) for a, b, u, v in zip(grid, grid[1:], values, values[1:], strict=False) if u * v < 0), None)
        cases = [np.where(np.arange(10) == 5, q[0], q), np.where(np.arange(10) == 8, 0.0, q), np.where(np.arange(10) == 6, -STAR, q)]
        if crossing:
            cases.append(np.where(np.arange(10) == 7, brentq(plane, *crossing, xtol=1e-15), q))
        for at in map(Pose, cases):
            wrench = pencil_line(at)
            on_line = [np.linalg.norm(np.cross(x, wrench[:3]) - wrench[3:]) / np.linalg.norm(wrench[:3]) for x in (at.a, at.b)]
            collinear = np.linalg.norm(np.cross(at.b - at.a, at.w(1))) + np.linalg.norm(np.cross(at.w(1), at.w(6)))
            assert min(on_line) > 1e-4 and collinear > 1e-4  # none of the printed conditions holds
            assert abs(at.raw((1, 2, 3, 7))) < 1e-17 and LOOP.conditioning(at.q, (1, 2, 3, 7)) < 1e-9
    for pose in poses(78, 10, mirror=True):
        assert abs(LOOP.determinant(pose.q, (1, 2, 3, 7))) < 1e-12  # thus singular in every mirror-symmetric grasp


def test_closed_forms_of_five_passive_joints():
    """det[s_j, s6 .. s10] = sin q9 fL (zetaL o s_j), zetaL the force (B - U) through the left arm's centres."""
    for pose in (Pose(q) for q in np.random.default_rng(79).uniform(-np.pi, np.pi, (100, 10))):
        left = force(SHOULDERS[1], pose.b - SHOULDERS[1])
        for j in range(1, 6):
            actuated = tuple(k for k in range(1, 6) if k != j)
            expected = math.sin(pose.q[8]) * pose.f[1] * power(left, pose.s[j])
            assert abs(pose.raw(actuated) - expected) < 1e-16
        assert abs(pose.raw((2, 3, 4, 5))) < 1e-18  # s1 is the line s6, which the force meets (erratum E5)


def test_closed_form_of_the_best_scheme():
    """1378: two planar pencils, l the meet of their planes: det[s2, s4, s5, s6, s9, s10] = -[(s2 o AB)(s6 o l) - (s2 o l)(s6 o AB)]."""
    for pose in (Pose(q) for q in np.random.default_rng(80).uniform(-np.pi, np.pi, (300, 10))):
        centres = force(pose.a, pose.b - pose.a)
        n1, n2 = np.cross(pose.w(4), pose.w(5)), np.cross(pose.w(9), pose.w(10))
        meet = np.concatenate([np.cross(n1, n2), (n2 @ pose.b) * n1 - (n1 @ pose.a) * n2])
        expected = power(centres, pose.s[2]) * power(meet, pose.s[6]) - power(meet, pose.s[2]) * power(centres, pose.s[6])
        assert abs(pose.raw((1, 3, 7, 8)) + expected) < 1e-16


def test_why_twenty_schemes_fail_where_q1_is_q6():
    """On q1 = q6 both shoulder and both S centres lie in one plane with the shoulder line. For each of the twenty, a line through two of
    these points meets all six passive axes (1237: the line AB); elsewhere none does."""
    twenty = [tuple(scheme) for scheme in ORACLE["singular_on_q1_eq_q6"]]
    for pose in poses(82, 10):
        planar = Pose(np.where(np.arange(10) == 5, pose.q[0], pose.q))
        for at, expected in ((planar, True), (pose, False)):
            points = (at.a, at.b, *SHOULDERS)
            lines = [force(x, y - x) for x, y in combinations(points, 2)]
            for scheme in twenty:
                met = any(max(abs(power(line, at.s[j])) for j in at.passive(scheme)) < 1e-15 for line in lines)
                assert met == expected


def test_errata_e5_and_e6_counts():
    """210 schemes make 110 pairs of mirror images; only 10 are symmetric. 71 are singular everywhere, not just example 1."""
    images = {scheme: tuple(sorted((j + 4) % 10 + 1 for j in scheme)) for scheme in ALL}
    assert len(ALL) == math.comb(10, 4) == 210
    assert len({min(pair) for pair in images.items()}) == 110
    assert sum(scheme == image for scheme, image in images.items()) == 10  # what "excluding non-symmetrical schemes" would leave
    assert (210 + 10) // 2 == 110  # Burnside
    samples = poses(81, 12)
    for pose in samples:
        np.testing.assert_array_equal(pose.s[1], pose.s[6])  # one line
    never = [scheme for scheme in ALL if max(rank(*(p.s[j] for j in p.passive(scheme))) for p in samples) < 6]
    assert len(never) == 71 and set(never) == {s for s in ALL if not {1, 6} & set(s)} | {(1, 2, 6, 7)}
