"""Mobility of the NAO's loop at general, parallel and singular poses (paper C, sections 4 and 5), and of two SCARA arms.

The reference is linear algebra on the definitions: the object moves with the twists that both arms can make, T = T^r n T^l (eq. 12).
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.analysis.closed_chain import ClosedChain
from cga_runtime.errors import NotFiniteError, WrongSizeError
from cga_runtime.loading import load_robot

SINGULAR = json.loads((Path(__file__).parents[1] / "data" / "nao.json").read_text())["singular"]
LOOPS = {}
for name in ("nao", "nao_v32"):
    robot = load_robot(name)
    LOOPS[name] = ClosedChain(robot.chain("RHand"), robot.chain("LHand"))
STAR = {"nao": SINGULAR["q2_star_right_V33"], "nao_v32": SINGULAR["q2_star_V32"]}
SHIFT = math.atan2(0.015, 0.105)  # angle of the S centre off the upper arm's direction, V3.3 and later
ROWS = np.repeat([1.0, 10.0], 3)[:, None]  # v in units of 0.1 m
GENERIC = np.array([0.5, -0.6, 0.7, 0.8, -0.3, -0.2, 0.4, -0.9, -1.1, 0.25])


def rank(matrix):
    return int((np.linalg.svd(matrix, compute_uv=False) > 1e-9).sum())


def arms(loop, q):
    twists = loop.twists(q) * ROWS
    return twists[:, : loop.right.n], twists[:, loop.right.n :]


def object_twists(loop, q):
    """A basis of what both arms can do, from the joint velocities that keep the loop closed (not from wrenches)."""
    right, left = arms(loop, q)
    _, values, vt = np.linalg.svd(np.concatenate([right, -left], axis=1))
    moving = vt[int((values > 1e-9).sum()) :].T
    return moving, right @ moving[: loop.right.n]


def with_joints(q, **values):
    """A copy of q with joints set by their number: with_joints(q, j4=0)."""
    q = q.copy()
    for name, value in values.items():
        q[int(name[1:]) - 1] = value
    return q


def check(loop, q, *, ranks, constraint_rank, object_dof, joint_mobility, motion=None):
    """Expected numbers, in `mobility` and by the definitions; and what ties the parts of the result together."""
    found = loop.mobility(q)
    assert found.limb_ranks == ranks == tuple(rank(arm) for arm in arms(loop, q))
    moving, twists = object_twists(loop, q)
    assert found.joint_mobility == joint_mobility == moving.shape[1]
    assert found.object_dof == object_dof == rank(twists)
    assert found.constraint_rank == constraint_rank == 6 - object_dof
    assert tuple(map(len, found.wrenches)) == tuple(6 - r for r in ranks)
    assert found.constraint_wrenches.shape == (12 - sum(ranks), 6)
    system = found.twist_system
    np.testing.assert_allclose(system.T @ system, np.eye(object_dof), atol=1e-14)
    assert rank(np.concatenate([system, twists], axis=1)) == object_dof  # the same space
    translations = object_dof - rank(system[:3])
    assert found.motion == f"{translations}T{object_dof - translations}R"
    for chain, columns in zip(found.wrenches, arms(loop, q), strict=True):
        for wrench in chain:
            powers = wrench.f @ columns[3:] / 10 + wrench.m @ columns[:3]
            # the null space is good to rounding times the largest twist about the origin, 10 for arms of a metre: 45 ulp in all
            np.testing.assert_allclose(powers, 0, atol=1e-14)
    if motion is not None:
        assert found.motion == motion
    return found


@pytest.mark.parametrize("name", LOOPS)
def test_arms_have_rank_five(name):
    """1000 draws in the limits; V3.2's limits contain singular poses, but no draw hits one."""
    loop = LOOPS[name]
    twists = loop.twists(loop.random(np.random.default_rng(10), 1000)) * ROWS
    for arm in (twists[..., :5], twists[..., 5:]):
        assert np.linalg.svd(arm, compute_uv=False)[:, 4].min() > 1e-6
    closure = np.concatenate([twists[..., :5], -twists[..., 5:]], axis=-1)
    assert np.linalg.svd(closure, compute_uv=False)[:, 5].min() > 1e-3  # rank 6: joint mobility 10 - 6 = 4


@pytest.mark.parametrize("name", LOOPS)
def test_general_poses(name):
    """Mobility 4, object 4 DoF, W^c of rank 2, and 1T3R; the constraint of each arm is the force through U and S, by the kernels too."""
    loop = LOOPS[name]
    for q in loop.random(np.random.default_rng(11), 100):
        found = check(loop, q, ranks=(5, 5), constraint_rank=2, object_dof=4, joint_mobility=4, motion="1T3R")
        kernel = loop.kernel("constraint_wrenches")(q)
        np.testing.assert_allclose(np.abs((kernel * found.constraint_wrenches).sum(axis=1)), (kernel**2).sum(axis=1), rtol=1e-12)
        for k, ((wrench,), centre) in enumerate(zip(found.wrenches, loop.kernel("wrist_centres")(q), strict=True)):
            shoulder = np.array([0, -0.098 if k == 0 else 0.098, 0.1])
            assert abs(wrench.pitch) < 2e-12 and wrench.pure_force
            sign = np.sign(kernel[k] @ found.constraint_wrenches[k])
            np.testing.assert_allclose(found.constraint_wrenches[k] * sign, kernel[k], atol=2e-12)
            along = (centre - shoulder) / np.linalg.norm(centre - shoulder)
            np.testing.assert_allclose(wrench.f * sign, along, atol=2e-12)
            np.testing.assert_allclose(np.cross(shoulder - wrench.point, along), 0, atol=2e-12)  # U lies on its line
            assert abs(wrench.point @ wrench.f) < 1e-15  # the point nearest to the origin
            assert abs(np.linalg.norm(wrench.f) - 1) < 1e-15


@pytest.mark.parametrize("name", LOOPS)
def test_kernel_wrenches_do_no_work(name):
    """f.v + m.w of the kernels' wrenches with every joint of their arm: rounding only, also at singular poses."""
    loop = LOOPS[name]
    q = loop.random(np.random.default_rng(12), 500)
    q[:100, 1], q[100:200, 3], q[200:300, 6] = STAR[name], 0.0, -STAR[name]
    twists, rows = loop.twists(q), loop.kernel("constraint_wrenches")(q)
    f, m = rows[..., [0, 1, 3]], np.stack([rows[..., 5], -rows[..., 4], rows[..., 2]], axis=-1)
    assert np.abs(np.linalg.norm(f, axis=-1) - 1).max() < 5e-15 and np.abs((f * m).sum(axis=-1)).max() < 1e-16
    for k, columns in enumerate((slice(0, 5), slice(5, 10))):
        power = np.einsum("...i,...ij->...j", f[:, k], twists[..., 3:, columns]) + np.einsum(
            "...i,...ij->...j", m[:, k], twists[..., :3, columns]
        )
        assert np.abs(power).max() < 1e-16
        other = np.einsum("...i,...i->...", f[:, k], twists[..., 3:, 6 - 5 * k])
        assert np.abs(other).max() > 1e-3  # it does work on joint 2 of the other arm


def test_motion_types():
    """Parallel forces: 2T2R. Else 1T3R, whether the lines meet (q1 = q6: both in one plane) or are skew."""
    loop = LOOPS["nao"]
    parallel = with_joints(GENERIC, j1=0.4, j6=0.4, j2=0.1, j7=0.1 - 2 * SHIFT)
    meeting, skew = with_joints(parallel, j7=0.3), with_joints(parallel, j6=0.1)
    for q, lines, motion in ((parallel, "parallel", "2T2R"), (meeting, "meeting", "1T3R"), (skew, "skew", "1T3R")):
        found = check(loop, q, ranks=(5, 5), constraint_rank=2, object_dof=4, joint_mobility=4, motion=motion)
        (one,), (two,) = found.wrenches
        angle = np.linalg.norm(np.cross(one.f, two.f))
        mutual = abs(one.f @ two.m + two.f @ one.m)  # zero exactly when the lines are coplanar
        assert (angle < 1e-9, mutual < 1e-9) == {"parallel": (True, True), "meeting": (False, True), "skew": (False, False)}[lines]
    assert np.all((parallel > loop.lower) & (parallel < loop.upper))  # all inside the limits
    mirrored = np.array([0.2, -0.7, 0.5, 0.6, 0.1, 0.2, 0.7, -0.5, -0.6, -0.1])
    assert loop.mobility(mirrored).motion == "1T3R"  # mirror images meet in the plane y = 0
    flat = with_joints(mirrored, j2=SHIFT, j7=-SHIFT)  # the S centres straight ahead of the shoulders
    assert loop.mobility(flat).motion == "2T2R"
    assert loop.mobility(with_joints(flat, j7=-SHIFT + 1e-6)).motion == "1T3R"


@pytest.mark.parametrize("name", LOOPS)
@pytest.mark.parametrize("locus", ["elbow", "elbow turned", "pitch"])
def test_one_limb_singular(name, locus):
    """q4 = 0, q4 = pi or q2 = q2*: rank 4, the object keeps 3 DoF, the joints keep mobility 4."""
    loop = LOOPS[name]
    right = {"elbow": {"j4": 0.0}, "elbow turned": {"j4": math.pi}, "pitch": {"j2": STAR[name]}}[locus]
    left = {f"j{int(joint[1:]) + 5}": -value for joint, value in right.items()}
    check(loop, with_joints(GENERIC, **right), ranks=(4, 5), constraint_rank=3, object_dof=3, joint_mobility=4)
    check(loop, with_joints(GENERIC, **left), ranks=(5, 4), constraint_rank=3, object_dof=3, joint_mobility=4)
    check(loop, with_joints(GENERIC, **right, **left), ranks=(4, 4), constraint_rank=3 if locus == "pitch" else 4,
          object_dof=3 if locus == "pitch" else 2, joint_mobility=5 if locus == "pitch" else 4)  # fmt: skip
    ((joint, value),) = right.items()
    near = with_joints(GENERIC, **{joint: value + 1e-6})  # near is not at
    check(loop, near, ranks=(5, 5), constraint_rank=2, object_dof=4, joint_mobility=4)


@pytest.mark.parametrize(("name", "expected", "dof"), [("nao", 4, 3), ("nao_v32", 3, 2)])
def test_both_limb_singularities_in_one_arm(name, expected, dof):
    """Rank 4 with an elbow offset, 3 without (V3.2): then axis 3 runs through U, so axes 1, 3 and 5 are one line."""
    assert expected == SINGULAR["rank_both_limb_sing"]["V33" if name == "nao" else "V32"]
    loop = LOOPS[name]
    q = with_joints(GENERIC, j2=STAR[name], j4=0.0)
    check(loop, q, ranks=(expected, 5), constraint_rank=6 - dof, object_dof=dof, joint_mobility=4)
    twists = arms(loop, q)[0]
    assert rank(twists[:, [0, 2, 4]]) == (2 if name == "nao" else 1)


@pytest.mark.parametrize("name", LOOPS)
def test_constraint_singularity(name):
    """Both S centres on the common ShoulderPitch line (eq. 19): the two forces are one line, four wrenches make a 3-system."""
    loop, expected = LOOPS[name], SINGULAR["constraint"]
    q = with_joints(GENERIC, j2=STAR[name], j7=-STAR[name])
    found = check(loop, q, ranks=tuple(expected["rank_J"]), constraint_rank=expected["dim_W"], object_dof=expected["object_dof"],
                  joint_mobility=expected["joint_mobility"])  # fmt: skip
    assert len(found.constraint_wrenches) == 4
    forces = loop.kernel("constraint_wrenches")(q)
    assert rank(forces) == expected["rank_Wc"] == 1
    np.testing.assert_allclose(np.abs(forces[:, 1]), 1, atol=1e-15)  # along y
    # 5 = 3 motions of the object + a self-motion of each arm, which turns about its own U-S line
    moving, twists = object_twists(loop, q)
    assert moving.shape[1] - rank(twists) == 2
    for arm in arms(loop, q):
        assert 5 - rank(arm) == 1
    with_pi = check(loop, with_joints(q, j7=-STAR[name] + math.pi), ranks=(4, 4), constraint_rank=3, object_dof=3, joint_mobility=5)
    assert with_pi.limb_ranks == found.limb_ranks  # (19) holds up to half a turn
    # unreachable in the limits from V3.3 on, reachable with V3.2
    inside = bool(np.all((q >= loop.lower) & (q <= loop.upper)))
    assert inside == (SINGULAR["V32_inside_limits"] if name == "nao_v32" else False)


SCARA = """<robot name="two_scaras"><link name="base"/>{links}{joints}</robot>"""


def two_scaras(folder):
    """Two arms of three parallel revolute joints and a vertical slide."""
    links, joints = [], []
    for side, y in (("r", -0.3), ("l", 0.3)):
        parent = "base"
        for k, (kind, x) in enumerate((("revolute", 0.0), ("revolute", 0.25), ("revolute", 0.2), ("prismatic", 0.1))):
            child = f"{side}{k}"
            links.append(f'<link name="{child}"/>')
            joints.append(
                f'<joint name="j{child}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
                f'<origin xyz="{x} {y if k == 0 else 0} 0.1"/><axis xyz="0 0 1"/>'
                '<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>'
            )
            parent = child
    file = folder / "two_scaras.urdf"
    file.write_text(SCARA.format(links="".join(links), joints="".join(joints)))
    robot = load_robot(file)
    return ClosedChain(robot.chain("r3"), robot.chain("l3"))


def test_two_scara_arms(tmp_path):
    """Both twist systems are the Schoenflies motions about z: 3T1R, constrained by pure moments only (f = 0, no pitch, no line)."""
    loop = two_scaras(tmp_path)
    q = np.array([0.3, 0.8, -0.5, 0.1, -0.4, -0.9, 0.2, -0.1])
    found = check(loop, q, ranks=(4, 4), constraint_rank=2, object_dof=4, joint_mobility=4, motion="3T1R")
    for wrench in (wrench for arm in found.wrenches for wrench in arm):
        assert wrench.pitch == math.inf and wrench.point is None and not wrench.pure_force
        np.testing.assert_allclose(wrench.f, 0, atol=0)
        np.testing.assert_allclose([np.linalg.norm(wrench.m), wrench.m[2]], [1, 0], atol=1e-14)
        np.testing.assert_allclose(wrench.bivector()[[0, 1, 3]], 0, atol=0)
    stretched = loop.mobility(np.where([0, 1, 1, 0, 0, 0, 0, 0], 0.0, q))
    assert stretched.limb_ranks == (3, 4) and stretched.motion == "2T1R"  # a straight arm loses one translation
    np.testing.assert_allclose(loop.conditioning(q, (1, 4)), 0)  # mobility 4: two actuators never control it


def test_bad_input():
    loop = LOOPS["nao"]
    with pytest.raises(WrongSizeError, match=r"mobility is that of one configuration: q of shape \(10,\) needed, \(2, 10\) given"):
        loop.mobility(np.zeros((2, 10)))
    with pytest.raises(WrongSizeError, match=r"\(5,\) given"):
        loop.mobility(np.zeros(5))
    with pytest.raises(NotFiniteError):
        loop.mobility(np.full(10, np.nan))
