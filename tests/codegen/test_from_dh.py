"""Denavit-Hartenberg tables against products of elementary matrices, and the NAO's table against its URDF's frames."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.errors import BadNumberError, DuplicateNameError, TreeError, UnsupportedJointError
from cga_codegen.robots.from_dh import ModifiedRow, StandardRow, load_dh, load_mdh, nao_mdh
from cga_codegen.robots.model import ModelError, Placement, RobotModel

ARM = ["ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw"]


def rot_x(a):
    return np.array([[1, 0, 0, 0], [0, math.cos(a), -math.sin(a), 0], [0, math.sin(a), math.cos(a), 0], [0, 0, 0, 1.0]])


def rot_z(a):
    return np.array([[math.cos(a), -math.sin(a), 0, 0], [math.sin(a), math.cos(a), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def trans(x, z):
    m = np.eye(4)
    m[0, 3], m[2, 3] = x, z
    return m


def pose(model: RobotModel, name, q):
    """Where the frame is: turns by quaternions (none of the matrices above), along `RobotModel.chain`."""
    chain = model.chain(name)
    m = np.eye(4)
    for joint in chain.joints:
        value = q[joint.name]
        local = np.eye(4)
        if joint.kind == "prismatic":
            local[:3, 3] = np.array(joint.axis) * value
        else:
            w, (x, y, z) = math.cos(value / 2), np.array(joint.axis) * math.sin(value / 2)
            local[:3, :3] = [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        m = m @ joint.placement.matrix() @ local
    return m @ chain.tool.matrix()


def random_rows(cls, rng, columns):
    """A tree of every kind, with signs: 1 - 2 - 3 - tool and 2 - 4 - 5."""
    shape = [
        ("j1", "", "revolute"),
        ("j2", "j1", "prismatic"),
        ("j3", "j2", "continuous"),
        ("tool", "j3", "fixed"),
        ("j4", "j2", "revolute"),
        ("j5", "j4", "prismatic"),
        ("j6", "tool", "revolute"),
    ]
    return [
        cls(name, antecedent, kind, int(rng.choice([1, -1])), **{c: float(rng.uniform(-2, 2)) for c in columns})
        for name, antecedent, kind in shape
    ]


def along(rows, name, step):
    by_name = {row.name: row for row in rows}
    m = np.eye(4)
    while name:
        m = step(by_name[name]) @ m
        name = by_name[name].antecedent
    return m


def values(row, angle, length, q):
    """theta and r (or d) with the joint variable in its place."""
    moved = row.sign * q.get(row.name, 0.0)
    turn, slide = (moved, 0.0) if row.kind in ("revolute", "continuous") else (0.0, moved if row.kind == "prismatic" else 0.0)
    return angle + turn, length + slide


def test_a_modified_table_is_its_product_of_matrices():
    rng = np.random.default_rng(21)
    for _ in range(30):
        rows = random_rows(ModifiedRow, rng, ("gamma", "b", "alpha", "d", "theta", "r"))
        base = Placement.from_matrix(rot_x(0.3) @ trans(0.2, -0.1))
        model = load_mdh(rows, "test", base)
        q = {joint.name: rng.uniform(-3, 3) for joint in model.joints}

        def step(row, q=q):
            theta, r = values(row, row.theta, row.r, q)
            return rot_z(row.gamma) @ trans(0, row.b) @ rot_x(row.alpha) @ trans(row.d, 0) @ rot_z(theta) @ trans(0, r)

        for row in rows:
            expected = base.matrix() @ along(rows, row.name, step)
            assert np.allclose(pose(model, row.name, q), expected, rtol=0, atol=2e-14)


def test_a_standard_table_is_its_product_of_matrices():
    rng = np.random.default_rng(22)
    for _ in range(30):
        rows = random_rows(StandardRow, rng, ("theta", "d", "a", "alpha"))
        model = load_dh(rows, "test")
        q = {joint.name: rng.uniform(-3, 3) for joint in model.joints}

        def step(row, q=q):
            theta, d = values(row, row.theta, row.d, q)
            return rot_z(theta) @ trans(0, d) @ trans(row.a, 0) @ rot_x(row.alpha)

        for row in rows:
            assert np.allclose(pose(model, row.name, q), along(rows, row.name, step), rtol=0, atol=2e-14)


def test_both_conventions_describe_one_arm():
    """A modified row takes alpha and a from the standard row before it."""
    rng = np.random.default_rng(23)
    names = ["", "j0", "j1", "j2", "j3"]
    standard = [StandardRow(names[k + 1], names[k], theta=0.1 * k, d=0.3, a=0.4 - 0.1 * k, alpha=1.5 - k) for k in range(4)]
    modified = [
        ModifiedRow(row.name, row.antecedent, theta=row.theta, r=row.d, alpha=before.alpha, d=before.a)
        for before, row in zip([StandardRow("base")] + standard[:-1], standard, strict=True)
    ]
    a, b = load_dh(standard, "standard"), load_mdh(modified, "modified")
    q = {row.name: rng.uniform(-3, 3) for row in standard}
    assert np.allclose(pose(a, "j3", q), pose(b, "j3", q) @ trans(standard[3].a, 0) @ rot_x(standard[3].alpha), rtol=0, atol=1e-14)


def test_right_angles_are_exact():
    for model in (nao_mdh("V50"), nao_mdh("V32")):
        for joint in model.joints:
            r = np.array(joint.placement.rotation)
            assert np.array_equal(r, np.round(r)) and np.array_equal(r.T @ r, np.eye(3))


@pytest.mark.parametrize(("version", "name"), [("V32", "nao_v32"), ("V33", "nao"), ("V40", "nao"), ("V50", "nao")])
def test_the_table_of_the_nao_has_the_frames_of_its_urdf(version, name):
    """All joint frames and the hands, limits included: two models from two sources."""
    table, urdf = nao_mdh(version), load_bundled(name)
    limits = {joint.name: (joint.lower, joint.upper, joint.velocity, joint.effort) for joint in urdf.joints}
    assert {joint.name: (joint.lower, joint.upper, joint.velocity, joint.effort) for joint in table.joints} == limits
    assert [joint.name for joint in table.joints] == [side + joint for side in "RL" for joint in ARM]
    rng = np.random.default_rng(24)
    for _ in range(50):
        q = {joint: rng.uniform(-math.pi, math.pi) for joint in limits}
        for frame in ["torso", "RHand", "LHand", *limits]:
            assert np.allclose(pose(table, frame, q), pose(urdf, frame, q), rtol=0, atol=1e-14)


def test_versions_of_the_nao():
    assert [f.name for f in nao_mdh("V50").frames if f.name.startswith("mdh")] == [f"mdh{k}" for k in range(1, 11)]
    assert nao_mdh("V33").joints == nao_mdh("V50").joints != nao_mdh("V32").joints
    with pytest.raises(ModelError, match="no NAO version is called 'V6'; versions: V32, V33, V40, V50"):
        nao_mdh("V6")


GOOD = ModifiedRow("a")


@pytest.mark.parametrize(
    ("rows", "error", "message"),
    [
        ([GOOD, GOOD], DuplicateNameError, "bot: row 'a': the name is empty, 'base' or given twice; each row needs a name of its own"),
        ([replace(GOOD, name="base")], DuplicateNameError, "bot: row 'base': the name is empty, 'base' or given twice"),
        ([replace(GOOD, name="")], DuplicateNameError, "bot: row '': the name is empty, 'base' or given twice"),
        ([replace(GOOD, antecedent="b")], TreeError, "bot: row 'a': no earlier row is called 'b'; rows follow their antecedent"),
        ([replace(GOOD, antecedent="a")], TreeError, "bot: row 'a': no earlier row is called 'a'"),
        ([replace(GOOD, kind="screw")], UnsupportedJointError, "bot: row 'a' is of kind 'screw'; revolute, continuous, prismatic"),
        ([replace(GOOD, sign=2)], BadNumberError, "bot: row 'a': sign is 2; 1 or -1 is needed"),
        ([replace(GOOD, alpha=math.nan)], BadNumberError, "bot: row 'a': alpha is nan; a finite number is needed"),
        ([replace(GOOD, r=np.float32(math.inf))], BadNumberError, "bot: row 'a': r is inf; a finite number is needed"),
        ([replace(GOOD, lower=1.0, upper=0.0)], BadNumberError, "bot: row 'a': limits are 1 and 0; lower <= upper is needed"),
        ([replace(GOOD, upper=math.nan)], BadNumberError, "bot: row 'a': limits are -inf and nan; lower <= upper is needed"),
        ([replace(GOOD, effort=-1.0)], BadNumberError, "bot: row 'a': velocity and effort limits are inf and -1; none may be negative"),
    ],
)
def test_wrong_rows_are_named(rows, error, message):
    with pytest.raises(error) as caught:
        load_mdh(rows, "bot")
    assert isinstance(caught.value, ModelError) and str(caught.value).startswith(message)
