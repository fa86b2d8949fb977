"""Robots of every source: bundled names, files, models of Pinocchio and MuJoCo, Denavit-Hartenberg tables, generated folders; the options
that change them, what each robot says of itself, and every refusal in its words."""

import copy
import json
import math
import pickle
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin
import pytest

import cga_runtime as cga
from cga_codegen.robots.bundled import bundled_robots, load_bundled
from cga_codegen.robots.from_dh import nao_mdh
from cga_codegen.robots.model import Placement
from cga_runtime import Motor, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.errors import CgaError, RobotFileError
from cga_runtime.workshop import generate_folder

DATA = Path(__file__).resolve().parents[1] / "data"
SKEW, MJCF = DATA / "skew.urdf", DATA / "mjcf" / "quadruped.xml"
UR5 = {
    "name": "table",
    "convention": "standard",
    "rows": [
        {"name": f"j{k}", "antecedent": f"j{k - 1}" if k else "", "d": d, "a": a, "alpha": alpha, "lower": -3.0, "upper": 3.0}
        for k, (d, a, alpha) in enumerate(zip(
            (0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823), (0.0, -0.425, -0.39225, 0.0, 0.0, 0.0),
            (math.pi / 2, 0.0, 0.0, math.pi / 2, -math.pi / 2, 0.0), strict=True,
        ))
    ],
}  # fmt: skip


def at(robot, q, frame):
    """Pose of a frame, by the Python text: nothing is compiled, and others find the kernel as it was."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(vars(robot.kernel("frames")), "_entries", None)
        return robot.frames(q)[..., robot.frame_names.index(frame), :, :]


# ---- sources


@pytest.mark.parametrize("name", sorted(bundled_robots()))
def test_bundled_robots(name):
    robot, model = cga.load_robot(name), load_bundled(name)
    ones = [joint for joint in model.joints if not joint.follows]
    assert name in cga.bundled_robots() and (robot.name, robot.source) == (name, f"{name}.urdf")
    assert robot.joint_names == tuple(j.name for j in ones) and robot.joint_kinds == tuple(j.kind for j in ones)
    assert (robot.nq, robot.nv) == (len(ones), len(ones)) and robot.frame_names == tuple(f.name for f in model.frames)
    for key, ours in (("lower", robot.lower), ("upper", robot.upper), ("velocity", robot.velocity_limit), ("effort", robot.effort_limit)):
        assert np.array_equal(ours, [getattr(j, key) for j in ones])
    assert robot.tips == model.tips() and np.array_equal(robot.gravity_vector, [0.0, 0.0, -9.81])
    q = robot.random(np.random.default_rng(1), (3, 2))
    assert q.shape == (3, 2, robot.nq) and (q >= robot.lower).all() and (q <= robot.upper).all()
    assert np.array_equal(robot.neutral(), np.zeros(robot.nq)) and robot.random(np.random.default_rng(1)).shape == (robot.nq,)


def test_a_path_in_every_form():
    for path in (SKEW, str(SKEW)):
        robot = cga.load_robot(path)
        assert (robot.name, robot.source, robot.nq) == ("skew", "skew.urdf", 9)
        assert repr(robot) == "<Robot skew: 9 joints, 24 frames>"
    assert robot.lower[1] == -0.5 and np.isinf(robot.lower[robot.joint_names.index("right_turn")])
    q = robot.random(np.random.default_rng(2), 200)
    assert np.abs(q[:, robot.joint_names.index("right_turn")]).max() <= math.pi


def test_a_model_of_pinocchio():
    model = pin.buildModelFromUrdf(str(bundled_robots()["ur5"]))
    robot, data = cga.load_robot(model), model.createData()
    q = robot.random(np.random.default_rng(3))
    pin.framesForwardKinematics(model, data, q)
    assert np.abs(at(robot, q, "tool0") - data.oMf[model.getFrameId("tool0")].homogeneous).max() < 1e-14
    assert robot.source.startswith("pinocchio.Model") and robot.joint_names == tuple(model.names)[1:]


def test_an_mjcf_and_a_model_of_mujoco():
    model = mujoco.MjModel.from_xml_path(str(MJCF))
    for source in (MJCF, model):
        robot = cga.load_robot(source)
        assert robot.layout.floating and (robot.nq, robot.nv) == (model.nq + 1, model.nv)
        q, data = robot.random(np.random.default_rng(4)), mujoco.MjData(model)
        pose = Motor(q[:8]).pose()
        x, y, z, w = pin.Quaternion(pose[:3, :3]).coeffs()
        data.qpos[:] = [*pose[:3, 3], w, x, y, z, *q[8:]]
        mujoco.mj_kinematics(model, data)
        for k in range(1, model.nbody):
            found = at(robot, q, model.body(k).name)
            assert np.abs(found[:3, 3] - data.xpos[k]).max() < 1e-14 and np.abs(found[:3, :3].ravel() - data.xmat[k]).max() < 1e-14


def test_a_table_of_denavit_and_hartenberg(tmp_path):
    """The maker's table of the UR5, whose URDF has quarter turns to eleven decimals."""
    (tmp_path / "ur5.json").write_text(json.dumps(UR5))
    urdf, q = cga.load_robot("ur5"), np.random.default_rng(5).uniform(-3, 3, (5, 6))
    expected = np.linalg.inv(at(urdf, q, "base")) @ at(urdf, q, "tool0")
    for robot in (cga.load_robot(UR5), cga.load_robot(tmp_path / "ur5.json"), cga.load_robot(str(tmp_path / "ur5.json"))):
        assert np.abs(at(robot, q, "j5") - expected).max() < 2e-11
        assert (robot.name, robot.joint_names[0]) == ("table", "j0") and np.array_equal(robot.lower, [-3.0] * 6)
    assert robot.source == "ur5.json"
    based = cga.load_robot({**UR5, "base": [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]})
    assert np.abs(at(based, q, "j5")[:, 0, 3] - at(robot, q, "j5")[:, 0, 3] - 0.5).max() < 1e-15


def test_the_modified_table_of_the_nao():
    """Table 1 of paper C as plain data is `nao_mdh`, whose numbers the papers' tests hold against the URDF."""
    data = json.loads((bundled_robots()["nao"].parent / "nao_mdh.json").read_text())
    value = {"0": 0.0, "pi/2": math.pi / 2, **data["constants"]["V33"]}
    value |= {f"-{key}": -number for key, number in value.items()}
    names, rows = {0: ""}, []
    for row in (dict(zip(data["columns"], row, strict=True)) for row in data["rows"]):
        numbers = {key: value[row[key]] for key in ("gamma", "b", "d", "alpha", "theta", "r")}
        rows.append({"name": row["joint"], "antecedent": names[row["a"]], **numbers})
        names[row["j"]] = row["joint"]
    robot, model = cga.load_robot({"name": "nao", "convention": "modified", "rows": rows}), nao_mdh()
    q = np.random.default_rng(6).uniform(-2, 2, 10)
    for arm, frame in (("RWristYaw", "mdh5"), ("LWristYaw", "mdh10")):
        chain, pose = model.chain(frame), Placement()
        for joint in chain.joints:
            pose = pose @ joint.placement @ joint.motion(q[robot.joint_names.index(joint.name)])
        assert np.abs(at(robot, q, arm) - (pose @ chain.tool).matrix()).max() < 1e-15


def test_a_generated_folder(tmp_path):
    said = []
    generate_folder(SKEW, tmp_path / "kernels", ["trunk"], [], said.append)
    assert cga.bundled_robots(tmp_path / "kernels") == ["skew"]
    robot = cga.load_robot("skew", tmp_path / "kernels")
    assert {robot.kernel("frames").unit.library.folder, robot.chain("trunk").unit.library.folder} == {tmp_path / "kernels"}
    missing = [name for name in ("center_of_mass", "center_of_mass_jacobian", "forward_dynamics") if name not in robot._record["tree"]]
    assert missing == ["center_of_mass", "center_of_mass_jacobian", "forward_dynamics"]  # the file has no masses: said, and left out
    assert "skew: left out: center_of_mass does not exist: nothing that moves has mass" in said
    changed = cga.load_robot("skew", tmp_path / "kernels", lock={"left_*": 0.1}, gravity=(0, 0, 1))
    assert changed.nq == 5 and np.array_equal(changed.gravity_vector, [0, 0, 1])
    with pytest.raises(UnknownNameError, match="^unknown robot 'nao'; known: skew. Or name a URDF or MJCF file$"):
        cga.load_robot("nao", tmp_path / "kernels")
    with pytest.raises(RobotFileError, match="^skew: base='floating' and mimic='follow' given; only the reading of a URDF has a choice$"):
        cga.load_robot("skew", tmp_path / "kernels", base="floating")


# ---- options


@pytest.mark.parametrize("name", ["nao", "ur5"])  # with kernels checked in, and without
def test_options_of_bundled_robots(name):
    plain, floating = cga.load_robot(name), cga.load_robot(name, base="floating")
    assert floating.joint_names == ("root_joint", *plain.joint_names) and (floating.nq, floating.nv) == (plain.nq + 8, plain.nv + 6)
    first = plain.joint_names[0]
    locked = cga.load_robot(name, lock={first: 0.5}, gravity=np.array([1, 2, 3]))
    assert locked.joint_names == plain.joint_names[1:] and np.array_equal(locked.gravity_vector, [1.0, 2.0, 3.0])
    q = plain.random(np.random.default_rng(7))
    q[0] = 0.5
    frame = plain.frame_names[-1]
    assert np.abs(at(locked, q[1:], frame) - at(plain, q, frame)).max() < 1e-14
    base = floating.random(np.random.default_rng(8))
    base[8:] = q
    assert np.abs(at(floating, base, frame) - Motor(base[:8]).pose() @ at(plain, q, frame)).max() < 1e-14


def test_mimicking_joints_by_choice():
    follow, independent = cga.load_robot("panda"), cga.load_robot("panda", mimic="independent")
    assert independent.joint_names == (*follow.joint_names, "panda_finger_joint2")
    q = follow.random(np.random.default_rng(9))
    assert np.abs(at(follow, q, "panda_rightfinger") - at(independent, [*q, q[-1]], "panda_rightfinger")).max() < 1e-15
    arm = cga.load_robot("panda", lock={"panda_finger_joint1": 0.04})
    assert arm.nq == 7 and np.abs(at(arm, q[:7], "panda_rightfinger") - at(follow, [*q[:7], 0.04], "panda_rightfinger")).max() < 1e-15


def test_snapped_angles(tmp_path):
    text = '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/>'
    (tmp_path / "r.urdf").write_text(f'{text}<origin rpy="1.5708 0 0"/><axis xyz="0 0 1"/></joint></robot>')
    as_given, snapped = cga.load_robot(tmp_path / "r.urdf"), cga.load_robot(tmp_path / "r.urdf", snap=1e-5)
    assert np.array_equal(at(snapped, [0.0], "b")[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert 1e-6 < np.abs(at(as_given, [0.0], "b") - at(snapped, [0.0], "b")).max() < 1e-5


# ---- a floating base's q


def test_neutral_and_random_bases():
    robot = cga.load_robot(SKEW, base="floating")
    assert np.array_equal(robot.neutral(), [1.0, *([0.0] * 16)]) and np.array_equal(at(robot, robot.neutral(), "base"), np.eye(4))
    q = robot.random(np.random.default_rng(10), 500)
    poses = Motor(q[:, :8]).pose()  # unit, or it is refused
    assert np.abs(poses[:, :3, 3]).max() <= 1.0 and np.abs(poses[:, :3, 3]).max() > 0.9
    assert np.abs(poses[:, :3, :3].mean(axis=0)).max() < 0.15  # rotations all around
    assert np.isinf(robot.lower[:8]).all() and np.isinf(robot.velocity_limit[:6]).all() and robot.lower.shape == (17,)
    assert robot.velocity_limit.shape == robot.effort_limit.shape == (15,)
    rows = [robot.random(np.random.default_rng(10)), robot.random(np.random.default_rng(10), 1)[0]]
    assert np.array_equal(*rows)


# ---- travelling


def pickled(robot):
    return pickle.loads(pickle.dumps(robot))


@pytest.mark.parametrize("travel", [copy.copy, copy.deepcopy, pickled])
def test_robots_travel(travel):
    robot = cga.load_robot(SKEW, base="floating", lock={"left_*": 0.0})
    q = robot.random(np.random.default_rng(11))
    before = at(robot, q, "right_tip")
    other = travel(robot)
    assert (other.name, other.joint_names, other.tips) == (robot.name, robot.joint_names, robot.tips)
    assert np.array_equal(at(other, q, "right_tip"), before) and other.kernel("frames").unit is robot.kernel("frames").unit


# ---- refusals


TABLE = {"name": "t", "convention": "standard", "rows": [{"name": "j"}]}
KNOWN = f"known: {', '.join(sorted(bundled_robots()))}. Or name a URDF or MJCF file"
ACCEPTED = "a bundled name, a path, a pinocchio.Model, a mujoco.MjModel or a table (dict) is needed"
SOURCES = [
    (3, RobotFileError, f"a builtins.int was given; {ACCEPTED}"),
    (None, RobotFileError, f"a builtins.NoneType was given; {ACCEPTED}"),
    (b"nao", RobotFileError, f"a builtins.bytes was given; {ACCEPTED}"),
    (pin.Data(), RobotFileError, f"a pinocchio.pinocchio_pywrap_default.Data was given; {ACCEPTED}"),
    ("noa", UnknownNameError, f"unknown robot 'noa'; {KNOWN}"),
    ("x" * 5000, UnknownNameError, f"unknown robot {'x' * 5000!r}; {KNOWN}"),
    ("noa.urdf", RobotFileError, "'noa.urdf' cannot be read (No such file or directory); a path to a URDF file is needed"),
    ("noa.json", RobotFileError, "'noa.json' cannot be read (No such file or directory); a path to a DH table file is needed"),
    ({}, RobotFileError, "DH table: a mapping with the keys name, convention and rows (and perhaps base) is needed"),
    ({**TABLE, "convention": "craig"}, RobotFileError, "DH table: convention 'craig' given; 'modified' or 'standard' is needed"),
    ({**TABLE, "convention": []}, RobotFileError, "DH table: convention [] given; 'modified' or 'standard' is needed"),
    ({**TABLE, "name": 3}, RobotFileError, "DH table: name 3 given; a word is needed"),
    ({**TABLE, "base": "here"}, RobotFileError, "DH table: base: a 4x4 matrix with last row 0 0 0 1 is needed"),
    ({**TABLE, "rows": [{"name": "j", "d": 10**400}]}, RobotFileError,
     "DH table: row 1: d is an integer of 1329 bits; at most 53 are read"),
    ({**TABLE, "rows": [{"name": "j", "d": "0"}]}, RobotFileError, "DH table: row 1: d is '0'; a number is needed"),
    ({**TABLE, "rows": [{"name": "j", "d": math.nan}]}, RobotFileError, "t: row 'j': d is nan; a finite number is needed"),
    ({**TABLE, "rows": [{"name": "j", "antecedent": "i"}]}, RobotFileError,
     "t: row 'j': no earlier row is called 'i'; rows follow their antecedent, '' is the base"),
]  # fmt: skip


@pytest.mark.parametrize(("source", "kind", "message"), SOURCES, ids=range(len(SOURCES)))
def test_sources_that_are_refused(source, kind, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(kind) as refusal:
        cga.load_robot(source)
    assert str(refusal.value) == message and isinstance(refusal.value, CgaError)


OPTIONS = [
    ({"base": "flying"}, UnknownNameError, "unknown base 'flying'; known: fixed, floating"),
    ({"mimic": "folow"}, UnknownNameError, "unknown mimic 'folow'; known: follow, independent"),
    ({"lock": ["lean"]}, WrongSizeError, "lock: a list was given, a mapping of joint names to values is needed"),
    ({"lock": {"lean": "0"}}, WrongSizeError, "lock of 'lean': not an array of numbers (<U1 given)"),
    ({"lock": {"lean": [0.0]}}, WrongSizeError, "lock of 'lean': shape (1,) given, () needed"),
    ({"lock": {"lean": math.nan}}, NotFiniteError, "lock of 'lean' holds NaN or infinity: nan at index () of shape ()"),
    ({"lock": {"*": 0.0}}, RobotFileError, "skew: every joint would be locked; leave at least one to move"),
    ({"lock": {"root_joint": 0.0}, "base": "floating"}, RobotFileError,
     "skew: joint 'root_joint' cannot be locked, it is the floating base: load it fixed"),
    ({"gravity": 9.81}, WrongSizeError, "gravity: shape () given, (3,) needed"),
    ({"gravity": (0, 0)}, WrongSizeError, "gravity: shape (2,) given, (3,) needed"),
    ({"gravity": (0, 0, math.inf)}, NotFiniteError, "gravity holds NaN or infinity: inf at index (2,) of shape (3,)"),
    ({"snap": -1.0}, WrongSizeError, "snap: -1 given, zero or a positive number is needed"),
    ({"snap": math.nan}, NotFiniteError, "snap holds NaN or infinity: nan at index () of shape ()"),
]  # fmt: skip


@pytest.mark.parametrize(("options", "kind", "message"), OPTIONS, ids=[str(options) for options, _, _ in OPTIONS])
def test_options_that_are_refused(options, kind, message):
    with pytest.raises(kind) as refusal:
        cga.load_robot(SKEW, **options)
    assert str(refusal.value) == message and isinstance(refusal.value, CgaError)


def test_files_that_are_no_tables(tmp_path):
    for text, said in (("{", "not JSON"), ("[1]", "a mapping with the keys"), ("1" * 5000, "not JSON"), ("[" * 100000, "not JSON")):
        (tmp_path / "t.json").write_text(text)
        with pytest.raises(RobotFileError, match=said):
            cga.load_robot(tmp_path / "t.json")


def test_only_a_urdf_leaves_the_base_open(tmp_path):
    (tmp_path / "ur5.json").write_text(json.dumps(UR5))
    arm = pin.buildSampleModelManipulator()
    for source, said in ((MJCF, str(MJCF)), (tmp_path / "ur5.json", str(tmp_path / "ur5.json")), (UR5, "a dict"), (arm, "a Model")):
        for options in ({"base": "floating", "mimic": "follow"}, {"base": "fixed", "mimic": "independent"}):
            with pytest.raises(RobotFileError) as refusal:
                cga.load_robot(source, **options)
            given = f"base={options['base']!r} and mimic={options['mimic']!r} given"
            assert str(refusal.value) == f"{said}: {given}; only the reading of a URDF has a choice"
