"""Exact certificates: witnesses, ranks and screws against Table 1 of paper C over fractions, with ranks by SymPy.

The reference shares nothing with the package: frames of the modified Denavit-Hartenberg table, which is the URDF's arm (erratum E1).
"""

import json
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sympy import QQ
from sympy.polys.matrices import DomainMatrix

from cga_runtime.analysis.certificates import NotRationalError, RationalArm, exact_rank, mirror_signs
from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.analysis.schemes import atlas
from cga_runtime.loading import load_robot

FACTS = json.loads((Path(__file__).parents[1] / "data" / "nao_facts.json").read_text(), parse_float=Fraction)
CONSTANTS = FACTS["constants"]
MIRROR = (1, -1, -1, -1, -1)
ROBOTS = {name: load_robot(name) for name in ("nao", "nao_v32")}
VERSIONS = [("nao", "V50"), ("nao_v32", "V32")]


def passive(scheme):
    return [j for j in range(10) if j + 1 not in scheme]


@cache
def exact_screws(version, tangents):
    """(w, v) of the ten axes at q_j = 2 atan(t_j), from Table 1 as printed: the z axis and the origin of each frame."""
    c = CONSTANTS[version]

    def rotation(cosine, sine, axis):
        m = np.array([[Fraction(int(i == j)) for j in range(4)] for i in range(4)])
        i, j = ((1, 2), (0, 1))[axis == "z"]
        m[i, i], m[i, j], m[j, i], m[j, j] = cosine, -sine, sine, cosine
        return m

    def shift(x, y, z):
        m = rotation(Fraction(1), Fraction(0), "z")
        m[:3, 3] = x, y, z
        return m

    screws = []
    for s, part in ((-1, tangents[:5]), (1, tangents[5:])):
        rows = [
            (c["ShoulderOffsetZ"], -1, 0, s * c["ShoulderOffsetY"]),
            (0, 1, 0, 0),
            (0, 1, s * c["ElbowOffsetY"], c["UpperArmLength"]),
            (0, -1, 0, 0),
            (0, 1, 0, c["LowerArmLength"]),
        ]
        m = shift(0, 0, 0)
        for j, ((b, quarter, d, r), t) in enumerate(zip(rows, part, strict=True)):
            cosine, sine = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
            if j == 1:
                cosine, sine = -sine, cosine  # theta2 = q2 + pi/2
            m = m @ shift(0, 0, b) @ rotation(0, quarter, "x") @ shift(d, 0, 0) @ rotation(cosine, sine, "z") @ shift(0, 0, r)
            w, p = m[:3, 2], m[:3, 3]
            screws.append((*w, p[1] * w[2] - p[2] * w[1], p[2] * w[0] - p[0] * w[2], p[0] * w[1] - p[1] * w[0]))
    return screws


def rank(rows):
    """SymPy's, over the rationals."""
    table = [[QQ(x.numerator, x.denominator) for x in row] for row in rows]
    return DomainMatrix(table, (len(table), len(table[0])), QQ).rank()


def scheme_rank(version, tangents, scheme):
    return rank([exact_screws(version, tangents)[j] for j in passive(scheme)])


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_screws_are_exactly_those_of_table_1(name, version):
    """Fraction by fraction, at random tangents; and the floating screws are their rounding."""
    loop = ClosedChain(ROBOTS[name].chain("RHand"), ROBOTS[name].chain("LHand"))
    arms = RationalArm.of(loop.right), RationalArm.of(loop.left)
    for draw in np.random.default_rng(30).integers(-9, 10, (20, 10)):
        tangents = tuple(Fraction(int(k), 7) for k in draw)
        screws = arms[0].screws(tangents[:5]) + arms[1].screws(tangents[5:])
        assert [tuple(screw) for screw in screws] == exact_screws(version, tangents)
        q = 2 * np.arctan([float(t) for t in tangents])
        np.testing.assert_allclose(np.array(screws, dtype=float).T, loop.twists(q), atol=2e-15)


@pytest.mark.parametrize(("name", "version"), VERSIONS)
def test_witnesses_by_independent_exact_arithmetic(name, version):
    """Each printed witness has rank 6; at a mirror pose, and wherever q1 = q6, only those of class "admissible" have it."""
    rows = atlas(ClosedChain(ROBOTS[name].chain("RHand"), ROBOTS[name].chain("LHand")), samples=64, seed=3)
    for row in rows:
        if row["witness"] is not None:
            tangents = tuple(map(Fraction, row["witness"]))
            assert scheme_rank(version, tangents, row["actuated"]) == 6
    assert sum(row["witness"] is not None for row in rows) == (139 if name == "nao" else 135)
    one = tuple(map(Fraction, rows[0]["witness"]))
    mirrored = one[:5] + tuple(sign * t for sign, t in zip(MIRROR, one, strict=False))
    planar = one[:5] + (one[0], *one[6:])  # the surface q1 = q6 is wider than the mirror poses
    for tangents in (mirrored, planar):
        for row in rows:
            assert (scheme_rank(version, tangents, row["actuated"]) == 6) == (row["class"] == "admissible")


fractions = st.builds(Fraction, st.integers(-4, 4), st.integers(1, 5))


@st.composite
def rational_matrices(draw):
    """Matrices up to 6 x 7 of a rank that is often deficient: products of two thin ones, some rows zero or repeated."""
    n, m, k = draw(st.integers(1, 6)), draw(st.integers(1, 7)), draw(st.integers(1, 6))
    left = draw(st.lists(st.lists(fractions, min_size=k, max_size=k), min_size=n, max_size=n))
    right = draw(st.lists(st.lists(fractions, min_size=m, max_size=m), min_size=k, max_size=k))
    return [[sum((x * right[i][j] for i, x in enumerate(row)), Fraction(0)) for j in range(m)] for row in left]


@settings(max_examples=300, deadline=None, derandomize=True)
@given(rational_matrices())
def test_exact_rank_is_sympys(rows):
    assert exact_rank(rows) == rank(rows)


def test_exact_rank_sees_what_floats_cannot():
    """Two rows that differ by 1e-40, and two equal ones, with denominators of forty digits."""
    third, tiny = Fraction(1, 3), Fraction(1, 10**40)
    assert exact_rank([[third, Fraction(1)], [third, 1 + tiny]]) == 2
    assert exact_rank([[third, Fraction(1)], [third * tiny, tiny]]) == 1
    assert exact_rank([[Fraction(0)] * 3] * 2) == 0
    assert exact_rank([[Fraction(0), Fraction(0), tiny], [Fraction(0), third, tiny]]) == 2  # pivots are not in the first columns


def test_mirror_signs():
    """q_left = diag(1, -1, -1, -1, -1) q_right, as the maker's facts say; and the mirrored screws prove it at a random pose."""
    assert FACTS["mirror"]["signs"] == [Fraction(sign) for sign in MIRROR]
    for robot in ROBOTS.values():
        right, left = RationalArm.of(robot.chain("RHand")), RationalArm.of(robot.chain("LHand"))
        assert mirror_signs(right, left) == MIRROR
        assert mirror_signs(left, right) == MIRROR
        tangents = [Fraction(k, 5) for k in (2, -3, 1, 4, -2)]
        images = left.screws([sign * t for sign, t in zip(MIRROR, tangents, strict=True)])
        for sign, (wx, wy, wz, vx, vy, vz), image in zip(MIRROR, right.screws(tangents), images, strict=True):
            assert image == [-sign * wx, sign * wy, -sign * wz, sign * vx, -sign * vy, sign * vz]


def test_arms_that_are_not_mirror_images():
    up = np.eye(4)
    up[2, 3] = 0.013
    robot = ROBOTS["nao"]
    right = RationalArm.of(robot.chain("RHand"))
    assert mirror_signs(right, RationalArm.of(robot.chain("LHand", placement=up))) is None
    assert mirror_signs(right, RationalArm.of(robot.chain("LForeArm"))) is None
    assert mirror_signs(right, right) is None
    assert mirror_signs(right, RationalArm.of(ROBOTS["nao_v32"].chain("LHand"))) is None


def test_rotations_that_are_not_rational():
    turned = np.eye(4)
    turned[:2, :2] = [[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]
    with pytest.raises(NotRationalError, match="nao/RHand: a rotation or axis is not exactly rational"):
        RationalArm.of(ROBOTS["nao"].chain("RHand", placement=turned))
    exact = np.eye(4)
    exact[:2, :2] = [[0.6, -0.8], [0.8, 0.6]]  # decimals that make an exact rotation are accepted
    arm = RationalArm.of(ROBOTS["nao"].chain("RHand", placement=exact))
    assert arm.screws([Fraction(0)] * 5)[0][:3] == [Fraction(-4, 5), Fraction(3, 5), 0]
