"""What q and v of a robot hold (mimicking joints, floating bases), joints that are locked, against Pinocchio's reduced models, snapped
placements, and models as JSON."""

import json
import math
from dataclasses import replace

import numpy as np
import pinocchio
import pytest
from joint_by_joint import Peer, Subject, floated, following

from cga_codegen.robots.bundled import bundled_robots, load_bundled
from cga_codegen.robots.model import Frame, Inertia, Joint, ModelError, Placement, RobotModel, coordinates
from cga_codegen.robots.placement import merged

UP = math.inf


def joint(name, kind="revolute", parent=-1, follows="", ratio=1.0):
    axis = (0.0, 0.0, 0.0 if kind == "floating" else 1.0)
    return Joint(name, kind, parent, Placement(), axis, -UP, UP, UP, UP, follows=follows, ratio=ratio)


# ---- coordinates


def test_joints_that_all_move_by_themselves():
    found = coordinates([joint("a"), joint("b", "prismatic"), joint("c", "continuous")])
    assert (found.names, found.kinds) == (("a", "b", "c"), ("revolute", "prismatic", "continuous"))
    assert found.motions == ((0, 1.0, False), (1, 1.0, True), (2, 1.0, False)) and found.columns == ((0, 1.0), (1, 1.0), (2, 1.0))
    assert (found.nq, found.nv, found.floating) == (3, 3, False)


def test_a_follower_before_its_leader_has_no_coordinate():
    found = coordinates([joint("a", follows="c", ratio=-2.0), joint("b"), joint("c", "continuous"), joint("d", follows="b", ratio=0.5)])
    assert (found.names, found.kinds, found.nq, found.nv) == (("b", "c"), ("revolute", "continuous"), 2, 2)  # the leader's kind
    assert found.motions == ((1, -2.0, False), (0, 1.0, False), (1, 1.0, False), (0, 0.5, False))


def test_leaders_outside_come_last():
    rail = joint("c", "prismatic", follows="rail", ratio=3.0)
    found = coordinates([joint("a", follows="far"), joint("b"), rail, joint("d", follows="far")])
    assert (found.names, found.kinds) == (("b", "far", "rail"), ("revolute", "revolute", "prismatic"))
    assert found.motions == ((1, 1.0, False), (0, 1.0, False), (2, 3.0, True), (1, 1.0, False))


def test_what_follows_may_move_otherwise():
    """A rack that a pinion drives, listed before and after it: the coordinate is the pinion's angle."""
    rack = joint("rack", "prismatic", follows="pinion", ratio=0.02)
    for joints in ([rack, joint("pinion", "continuous")], [joint("pinion", "continuous"), rack]):
        found = coordinates(joints)
        assert (found.names, found.kinds) == (("pinion",), ("continuous",)) and set(found.motions) == {(0, 0.02, True), (0, 1.0, False)}


def test_a_floating_base_comes_first():
    found = coordinates([joint("base", "floating"), joint("a", follows="b", ratio=0.5), joint("b")])
    assert (found.names, found.kinds) == (("base", "b"), ("floating", "revolute")) and found.floating
    assert (found.nq, found.nv) == (9, 7) and found.motions == ((0, 0.5, False), (0, 1.0, False))
    assert found.columns == (*((k, 1.0) for k in range(6)), (6, 0.5), (6, 1.0))
    alone = coordinates([joint("base", "floating")])
    assert (alone.nq, alone.nv, alone.motions, len(alone.columns)) == (8, 6, (), 6)
    nothing = coordinates([])
    assert (nothing.nq, nothing.nv, nothing.columns, nothing.floating) == (0, 0, (), False)


def test_a_chain_has_the_coordinates_of_its_joints(skew_model):
    model = following(skew_model)
    right, left = model.chain("right_tip"), model.chain("left_tip")
    assert model.coordinates.names == ("lean", "left_slide", "left_turn", "right_roll")
    assert right.coordinates.names == ("lean", "right_roll", "left_slide") and right.n == 3  # right_turn and right_slide follow left_slide
    assert right.coordinates.motions == ((0, 1.0, False), (2, 0.8, False), (2, 1.5, True), (1, -0.7, False), (1, 1.0, False))
    assert left.coordinates.names == ("lean", "left_slide", "left_turn")
    assert left.coordinates.motions[-2:] == ((0, 2.0, False), (2, -0.4, True))
    beyond = model.chain("left_tip", root="left_2")
    assert beyond.coordinates.names == ("lean", "left_turn") and len(beyond.joints) == 2
    moving = floated(model)
    assert moving.chain("right_tip").coordinates.names[0] == "drift" and moving.chain("right_tip").n == 9
    assert not moving.chain("right_tip", root="trunk").coordinates.floating


def test_kinds_and_files_of_the_bundled_robots():
    for name in bundled_robots():
        at = load_bundled(name).coordinates
        peer = pinocchio.buildModelFromUrdf(str(bundled_robots()[name]))
        followers = sum(bool(j.follows) for j in load_bundled(name).joints)
        assert at.nv == len(at.names) == peer.nv - followers and len(at.motions) == peer.njoints - 1


# ---- refusals


REFUSED = [
    ([joint("a", parent=1), joint("b")], "r: joint 'a' comes before its parent"),
    ([joint("a", parent=-2)], "r: joint 'a' comes before its parent"),
    ([joint("a", parent=0)], "r: joint 'a' comes before its parent"),
    ([joint("a"), joint("b", "floating", 0)], "r: joint 'b' floats; only the base may"),
    ([joint("a"), joint("b", "floating")], "r: joint 'b' floats; only the base may"),
    ([joint("base", "floating"), joint("a")], "r: joint 'a' does not hang on the floating base"),
    ([joint("a", follows="b")], "r: joint 'a' mimics 'b'; the name of an independent joint is needed"),
    ([joint("a", follows="a")], "r: joint 'a' mimics 'a'; the name of an independent joint is needed"),
    ([joint("a"), joint("b", follows="a"), joint("c", follows="b")], "r: joint 'c' mimics 'b'; the name of an independent joint is needed"),
    ([joint("base", "floating"), joint("a", parent=0, follows="base")],
     "r: joint 'a' mimics 'base'; the name of an independent joint is needed"),
]  # fmt: skip


@pytest.mark.parametrize(("joints", "message"), REFUSED)
def test_trees_that_cannot_be(joints, message):
    with pytest.raises(ModelError) as refusal:
        RobotModel("r", tuple(joints), ())
    assert str(refusal.value) == message


def test_an_angle_may_follow_an_angle_without_limits():
    RobotModel("r", (joint("a", "continuous"), joint("b", "revolute", follows="a")), ())


# ---- locked joints


def check_reduced(model, values):
    """The locked model against Pinocchio's reduction of the whole one, joint by joint and frame by frame."""
    whole, ours = Peer(model), model.locked(values)
    kept = [j.name for j in ours.joints]
    held = [k for k in range(1, whole.model.njoints) if whole.model.names[k] not in kept]
    at = {j.name: values.get(j.follows or j.name, 0.0) * j.ratio for j in model.joints}
    q = pinocchio.neutral(whole.model)
    for k in held:
        q[whole.model.joints[k].idx_q] = at[whole.model.names[k]]
    reduced = pinocchio.buildReducedModel(whole.model, held, q)
    assert kept == list(reduced.names)[1:] and [j.parent + 1 for j in ours.joints] == list(reduced.parents)[1:]
    for k, j in enumerate(ours.joints, 1):
        assert np.allclose(j.placement.matrix(), reduced.jointPlacements[k].homogeneous, rtol=0, atol=1e-15)
        expected = reduced.inertias[k]
        found = j.inertia or Inertia(0.0, (0.0, 0.0, 0.0), (0.0,) * 6)
        assert found.mass == pytest.approx(expected.mass, rel=1e-15)
        assert np.allclose(found.com, expected.lever, rtol=0, atol=1e-15)
        assert np.allclose(found.matrix(), expected.inertia, rtol=0, atol=3e-15)
        if j.kind != "floating":
            assert j.armature == reduced.armature[reduced.joints[k].idx_v]
    for frame in ours.frames:
        # a reduced model adds frames for the joints that it holds; those that were given keep their order, not their number
        (theirs,) = (f for f in reduced.frames if f.name == f"@{frame.name}" and f.type == pinocchio.FrameType.OP_FRAME)
        assert frame.joint + 1 == theirs.parentJoint
        assert np.allclose(frame.placement.matrix(), theirs.placement.homogeneous, rtol=0, atol=2e-15)
    return ours


@pytest.mark.parametrize("values", [
    {"lean": 0.7}, {"right_slide": 0.3, "right_bend": -1.1}, {"left_turn": 2.0, "left_lift": -0.2, "right_turn": 1.0},
    {"lean": -0.4, "left_slide": 0.1, "right_roll": 0.0, "left_bend": 3.0},
])  # fmt: skip
@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_locked_is_pinocchio_s_reduced_model(skew_model, values, base):
    check_reduced(skew_model if base == "fixed" else floated(skew_model), values)


def test_locked_bundled_robots():
    panda, g1 = load_bundled("panda"), load_bundled("g1")
    check_reduced(panda, {"panda_joint2": -0.4, "panda_joint7": 0.9})
    arm = check_reduced(panda, {"panda_finger_joint1": 0.03})  # the second follows
    assert [j.name for j in arm.joints] == [f"panda_joint{k}" for k in range(1, 8)]
    legs = {j.name: 0.1 * k for k, j in enumerate(g1.joints[:12])}
    check_reduced(g1, legs)


def test_followers_are_locked_with_their_leader(skew_model):
    model = following(skew_model)
    ours = check_reduced(model, {"left_slide": 0.2})
    assert [j.name for j in ours.joints] == ["lean", "left_turn", "left_bend", "left_lift", "right_bend", "right_roll"]
    assert ours.coordinates.names == ("lean", "left_turn", "right_roll")


def test_patterns_and_values(skew_model):
    ours = skew_model.locked({"left_*": 0.25, "right_[bt]*": -1.0})
    left = dict.fromkeys(("left_slide", "left_turn", "left_bend", "left_lift"), 0.25)
    assert ours == skew_model.locked({**left, "right_turn": -1, "right_bend": -1})
    assert [j.name for j in ours.joints] == ["lean", "right_slide", "right_roll"]
    assert skew_model.locked({"left_*": 0.0, "left_turn": 1.0}) == skew_model.locked(
        {"left_slide": 0.0, "left_turn": 1.0, "left_bend": 0.0, "left_lift": 0.0}
    )  # what comes later holds
    model = following(skew_model)
    assert model.locked({"right_*": 0.1}).coordinates.names == ("lean", "left_slide", "left_turn")  # a pattern passes over followers
    moving = floated(skew_model).locked({"*": 0.1})
    assert [j.name for j in moving.joints] == ["drift"]  # and over the floating base
    odd = RobotModel("odd", (joint("j[1]"), joint("j1", parent=0), joint("k", parent=1)), ())
    assert [j.name for j in odd.locked({"j[1]": 0.5}).joints] == ["j1", "k"]  # a name is no pattern


def test_what_a_locked_joint_on_a_fixed_base_carries_is_gone(skew_model):
    ours = skew_model.locked({"lean": 0.3})
    assert sum(j.inertia.mass for j in ours.joints if j.inertia) == pytest.approx(
        sum(j.inertia.mass for j in skew_model.joints[1:] if j.inertia), rel=1e-15
    )
    assert ours.gravity == skew_model.gravity and ours.source == skew_model.source


def test_what_cannot_be_locked(skew_model):
    model, moving = following(skew_model), floated(skew_model)
    names = ", ".join(j.name for j in model.joints)
    for robot, values, message in (
        (model, {"elbow": 0.0}, f"skew has no joint 'elbow' to lock; joints: {names}"),
        (model, {"r?ght": 0.0}, f"skew has no joint 'r?ght' to lock; joints: {names}"),
        (model, {"right_bend": 0.0}, "skew: joint 'right_bend' cannot be locked, it mimics 'right_roll': lock that one"),
        (moving, {"drift": 0.0}, "skew: joint 'drift' cannot be locked, it is the floating base: load it fixed"),
        (model, {"lean": math.nan}, "skew: joint 'lean' cannot be locked at nan; a finite number is needed"),
        (model, {"lean": math.inf}, "skew: joint 'lean' cannot be locked at inf; a finite number is needed"),
        (model, {"*": 0.0}, "skew: every joint would be locked; leave at least one to move"),
    ):
        with pytest.raises(ModelError) as refusal:
            robot.locked(values)
        assert str(refusal.value) == message


def test_bodies_held_together():
    rng = np.random.default_rng(3)
    points, masses = rng.normal(size=(7, 3)), rng.uniform(0.1, 1, 7)

    def of(rows):
        com = masses[rows] @ points[rows] / masses[rows].sum()
        away = zip(masses[rows], points[rows] - com, strict=True)
        return Inertia.from_matrix(masses[rows].sum(), com, sum(m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in away))

    whole, parts = of(slice(0, 7)), merged([of(slice(0, 3)), of(slice(3, 4)), of(slice(4, 7))])
    assert np.allclose([parts.mass, *parts.com, *parts.tensor], [whole.mass, *whole.com, *whole.tensor], rtol=0, atol=5e-15)
    assert merged([whole]) is whole
    massless = merged([Inertia(0.0, (1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 1.0, 0.0, 1.0))] * 2)
    assert (massless.mass, massless.com, massless.tensor) == (0.0, (1.0, 2.0, 3.0), (2.0, 0.0, 0.0, 2.0, 0.0, 2.0))


# ---- snapping, tools, JSON


def test_snapped_turns_near_right_angles_only():
    rough, other = Placement.turn((0.0, 0.0, 1.0), 1.5708), Placement.turn((0.0, 0.0, 1.0), 1.57)
    model = RobotModel("r", (replace(joint("a"), placement=rough), replace(joint("b", parent=0), placement=other)), (Frame("f", 1, rough),))
    found = model.snapped(1e-5)
    exact = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    assert found.joints[0].placement.rotation == exact == found.frames[0].placement.rotation
    assert found.joints[1].placement == other and model.snapped(1e-7) == model


def test_a_tool_and_a_point_of_it(skew_model):
    rng, subject = np.random.default_rng(5), Subject(skew_model)
    tool = Placement.turn((0.6, 0.0, 0.8), 0.4) @ Placement(translation=(0.1, 0.2, -0.3))
    plain = skew_model.chain("right_tip")
    held = skew_model.chain("right_tip", tool=tool, offset=(0.05, 0.0, 0.1), name="grip")
    assert (held.name, held.joints, subject.n) == ("grip", plain.joints, 9)
    shift = np.eye(4)
    shift[:3, 3] = 0.05, 0.0, 0.1
    assert np.allclose(held.tool.matrix(), plain.tool.matrix() @ tool.matrix() @ shift, rtol=0, atol=1e-15)
    on_base = skew_model.chain("base", tool=tool, placement=Placement(translation=tuple(rng.normal(size=3).tolist())))
    assert np.allclose(on_base.tool.matrix()[:3, :3], tool.matrix()[:3, :3], rtol=0, atol=0)


def test_json_keeps_all(skew_model):
    for model in (floated(following(skew_model)), load_bundled("robotiq_3f"), load_bundled("panda")):
        text = json.dumps(model.to_json(), sort_keys=True, allow_nan=False)
        again = RobotModel.from_json(json.loads(text))
        assert again == model and hash(again) == hash(model) and again.coordinates == model.coordinates
        assert json.dumps(again.to_json(), sort_keys=True) == text
    assert again.joints[-1].follows == "panda_finger_joint1"
