"""The robot model: rotations are checked and never bent, placements form a group, chains are cut rightly, JSON loses nothing."""

import json
import math
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.model import Chain, Frame, Inertia, Joint, ModelError, Placement, RobotModel, as_rotation, as_vector


def rodrigues(axis, angle):
    """1 + sin K + (1 - cos) K^2 for a unit axis."""
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def motion(joint, q):
    m = np.eye(4)
    if joint.kind == "prismatic":
        m[:3, 3] = np.array(joint.axis) * q
    else:
        m[:3, :3] = rodrigues(joint.axis, q)
    return m


def chain_pose(chain: Chain, q):
    m = np.eye(4)
    for joint, value in zip(chain.joints, q, strict=True):
        m = m @ joint.placement.matrix() @ motion(joint, value)
    return m @ chain.tool.matrix()


def frame_pose(model: RobotModel, name, q):
    """Along the tree, without `RobotModel.chain`."""
    frame = model.frame(name)
    m, index = frame.placement.matrix(), frame.joint
    while index >= 0:
        m = model.joints[index].placement.matrix() @ motion(model.joints[index], q[index]) @ m
        index = model.joints[index].parent
    return m


def random_rotation(rng):
    axis = rng.normal(size=3)
    return rodrigues(axis / np.linalg.norm(axis), rng.uniform(-3, 3))


def random_placement(rng):
    return Placement(as_rotation(random_rotation(rng), "r"), as_vector(rng.normal(size=3), "p"))


@pytest.fixture
def tree():
    """Two branches behind a common joint, all three kinds, one link without inertia, limits that are infinite."""
    rng = np.random.default_rng(7)

    def joint(name, kind, parent, inertia):
        axis = rng.normal(size=3)
        unit = as_vector(axis / np.linalg.norm(axis), name)
        lower = -math.inf if kind == "continuous" else -1.0
        return Joint(name, kind, parent, random_placement(rng), unit, lower, -lower, 2.0, math.inf, inertia)

    body = Inertia(0.3, (0.01, -0.02, 1 / 3), (1e-3, 1e-5, -2e-5, 2e-3, 3e-6, 2.5e-3))
    joints = (
        joint("waist", "continuous", -1, body),
        joint("lift", "prismatic", 0, None),
        joint("wrist", "revolute", 1, body),
        joint("other", "revolute", 0, body),
    )
    frames = (
        Frame("stand", -1, random_placement(rng)),
        Frame("belt", 0, random_placement(rng)),
        Frame("hand", 2, random_placement(rng)),
        Frame("palm", 2, random_placement(rng)),
        Frame("rest", 3, random_placement(rng)),
    )
    return RobotModel("tree", joints, frames, "test")


def test_a_rotation_within_rounding_of_a_signed_permutation_becomes_it_as_a_whole():
    exact = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    near, rough = (exact @ rodrigues((0.6, 0.0, 0.8), angle) for angle in (5e-16, 5e-12))
    assert not np.array_equal(near, exact)
    assert np.array_equal(as_rotation(near, "r"), exact)
    assert np.array_equal(as_rotation(rough, "r"), rough)  # 1.57079632679 in a file is not pi/2 unless the user says so
    assert np.array_equal(as_rotation(rough, "r", 1e-11), exact)


def test_single_entries_are_never_snapped():
    r = rodrigues((0.0, 0.0, 1.0), 0.3) @ rodrigues((1.0, 0.0, 0.0), 1e-12)  # a general rotation with entries of 1e-12
    assert np.count_nonzero(np.abs(r) < 1e-11) == 4 and np.count_nonzero(r) == 8
    assert np.array_equal(as_rotation(r, "r"), r)
    far = rodrigues((0.0, 1.0, 0.0), 3.7e-6)  # a right angle written as 1.5708 is off by this: the file means what it says
    assert np.array_equal(as_rotation(far, "r"), far)


def test_no_negative_zero_survives():
    r = as_rotation(-np.diag([1.0, 1.0, -1.0]), "r")
    assert "-0.0" not in str(r) and "-0.0" not in str(as_vector((-0.0, 0.0, -1.0), "v"))


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        (np.diag([1.0, 1.0, -1.0]), r"elbow: not a rotation \(R\^T R - 1 is 0.0e\+00, det -1.000\)"),
        (1.001 * np.eye(3), r"elbow: not a rotation \(R\^T R - 1 is 2.0e-03, det \+1.003\)"),
        (np.full((3, 3), math.nan), r"elbow: a rotation is a finite 3x3 matrix, got shape \(3, 3\)"),
        (np.eye(2), r"elbow: a rotation is a finite 3x3 matrix, got shape \(2, 2\)"),
    ],
)
def test_what_is_no_rotation_is_refused(rows, message):
    with pytest.raises(ModelError, match=message):
        as_rotation(rows, "elbow")


def test_the_rotation_tolerance_is_a_border():
    as_rotation(np.eye(3) * (1 + 4e-10), "r")
    with pytest.raises(ModelError, match="not a rotation"):
        as_rotation(np.eye(3) * (1 + 6e-10), "r")


@pytest.mark.parametrize("values", [(1.0, 2.0), (1.0, 2.0, math.inf), (0.0, math.nan, 0.0)])
def test_what_is_no_vector_is_refused(values):
    with pytest.raises(ModelError, match="tip: .* given, three finite numbers are needed"):
        as_vector(values, "tip")


def test_placements_compose_and_invert_as_matrices():
    rng = np.random.default_rng(1)
    for _ in range(50):
        a, b = random_placement(rng), random_placement(rng)
        assert np.allclose((a @ b).matrix(), a.matrix() @ b.matrix(), rtol=0, atol=1e-15)
        assert np.allclose(a.inverse().matrix(), np.linalg.inv(a.matrix()), rtol=0, atol=1e-14)
        assert Placement.from_matrix(a.matrix()) == a


def test_a_matrix_that_is_no_rigid_motion_is_refused():
    projective = np.eye(4)
    projective[3, 0] = 1e-3
    for matrix in (projective, np.eye(3)):
        with pytest.raises(ModelError, match="camera: a 4x4 matrix with last row 0 0 0 1 is needed"):
            Placement.from_matrix(matrix, "camera")


def test_a_chain_ends_where_the_tree_says(tree):
    rng = np.random.default_rng(2)
    for _ in range(20):
        q, world, offset = rng.uniform(-2, 2, 4), random_placement(rng), rng.normal(size=3)
        for name, path in (("hand", [0, 1, 2]), ("rest", [0, 3]), ("belt", [0]), ("stand", [])):
            chain = tree.chain(name, placement=world, offset=tuple(offset))
            tip = np.eye(4)
            tip[:3, 3] = offset
            expected = world.matrix() @ frame_pose(tree, name, q) @ tip
            assert [joint.name for joint in chain.joints] == [tree.joints[k].name for k in path]
            assert [joint.parent for joint in chain.joints] == list(range(-1, len(path) - 1))
            assert np.allclose(chain_pose(chain, q[path]), expected, rtol=0, atol=1e-13)


def test_a_root_frame_is_where_the_chain_starts(tree):
    rng = np.random.default_rng(3)
    for _ in range(20):
        q, world = rng.uniform(-2, 2, 4), random_placement(rng)
        for root, name, path in (("belt", "hand", [1, 2]), ("belt", "rest", [3]), ("stand", "hand", [0, 1, 2]), ("hand", "palm", [])):
            chain = tree.chain(name, root=root, placement=world)
            expected = world.matrix() @ np.linalg.inv(frame_pose(tree, root, q)) @ frame_pose(tree, name, q)
            assert chain.n == len(path)
            assert np.allclose(chain_pose(chain, q[path]), expected, rtol=0, atol=1e-13)


def test_a_chain_runs_outwards_only(tree):
    with pytest.raises(ModelError, match="tree: root 'rest' does not lie between the base and 'hand'"):
        tree.chain("hand", root="rest")
    with pytest.raises(ModelError, match="tree has no frame 'fist'; frames: stand, belt, hand, palm, rest"):
        tree.chain("fist")


def test_json_gives_the_same_model_back(tree):
    for model in (tree, load_bundled("nao"), load_bundled("nao_v32")):
        text = json.dumps(model.to_json(), sort_keys=True)
        again = RobotModel.from_json(json.loads(text))
        assert again == model and hash(again) == hash(model)
        assert json.dumps(again.to_json(), sort_keys=True) == text


def test_a_placement_survives_json_to_the_last_bit():
    rng = np.random.default_rng(4)
    for _ in range(50):
        model = RobotModel("one", (), (Frame("tip", -1, random_placement(rng)),))
        again = RobotModel.from_json(json.loads(json.dumps(model.to_json())))
        assert np.array_equal(again.frame("tip").placement.matrix(), model.frame("tip").placement.matrix())


def test_json_with_a_bent_rotation_is_refused(tree):
    data = json.loads(json.dumps(tree.to_json()))
    data["joints"][1]["placement"]["rotation"][0][0] += 1e-3
    with pytest.raises(ModelError, match="lift: not a rotation"):
        RobotModel.from_json(data)


def test_a_model_is_immutable_and_compares_by_value(tree):
    with pytest.raises(FrozenInstanceError):
        tree.joints[0].lower = 0.0
    assert replace(tree, name="tree") == tree and replace(tree, name="bush") != tree
