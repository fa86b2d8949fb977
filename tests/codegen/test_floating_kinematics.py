"""Kinematics of chains with a floating base and with mimicking joints: against Pinocchio, derivatives against the complex step along
velocities (a base moves along its own twists), and the motor's Jacobian also along the exponential at 50 digits."""

import mpmath
import numpy as np
import pinocchio
import pytest
from joint_by_joint import Subject, base_rate, floated, make, motor_of

from cga_codegen.algebra.blade_types import MOTOR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.catalogue import CHAIN_KERNELS
from cga_codegen.kernels import kinematics, versors
from cga_codegen.kernels.walk import gather, spread
from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.model import Placement
from cga_codegen.units import chain_unit, made

FRAMES = ("LOCAL", "WORLD", "LOCAL_WORLD_ALIGNED")
STATES = 4
WITHOUT_BASE = ("jacobian_local", "jacobian_derivative_local", "hessian_local")


class Cut:
    """A chain of a subject, and where its velocities stand among the robot's."""

    def __init__(self, subject: Subject, frame: str, **options) -> None:
        self.subject, self.frame, self.chain = subject, frame, subject.model.chain(frame, **options)
        at = self.chain.coordinates
        robot = subject.coordinates
        first = 6 if at.floating else 0
        shift = 5 if robot.floating else 0
        self.columns = [*range(first), *(robot.names.index(name) + shift for name in at.names[int(at.floating) :])]

    def inputs(self, q, name="pose", half=False):
        given = self.subject.inputs(q, self.chain.joints, half)
        if name in WITHOUT_BASE or not self.chain.coordinates.floating:
            given.pop("base", None)
        return given

    def at(self, name, q, *v):
        function = versors.motor if name == "motor" else versors.motor_jacobian if name == "motor_jacobian" else getattr(kinematics, name)
        return np.array(function(self.chain, **self.inputs(q, name, name.startswith("motor")), **({"v": v[0]} if v else {})))

    def by_q(self, name, q):
        """Last axis: the chain's velocities. Those of others change nothing."""
        whole = self.subject.by_q(lambda x: self.at(name, x), q)
        others = [k for k in range(self.subject.n) if k not in self.columns]
        assert not whole[..., others].any()
        return whole[..., self.columns]


@pytest.fixture(params=["right_tip", "left_tip"])
def cut(request, subject):
    return Cut(subject, request.param)


def close(found, expected, tolerance=1e-14):
    found, expected = np.ravel(found), np.ravel(expected)
    assert found.shape == expected.shape and np.abs(found - expected).max() <= tolerance * max(1.0, np.abs(expected).max())


def test_poses_and_motors_are_pinocchio_s(cut):
    peer = cut.subject.peer
    for q, _, _ in cut.subject.states(STATES, 21):
        pinocchio.framesForwardKinematics(peer.model, peer.data, peer.position(q))
        expected = peer.data.oMf[peer.frames[cut.frame]]
        close(cut.at("pose", q), expected.homogeneous, 2e-15)
        close(cut.at("point", q), expected.translation, 2e-15)
        motor, theirs = cut.at("motor", q), np.array(motor_of(expected.rotation, expected.translation))
        close(motor * np.sign(motor[:4] @ theirs[:4]), theirs, 4e-15)


def test_jacobians_and_their_rates_are_pinocchio_s(cut):
    peer, g = cut.subject.peer, cut.subject.peer.gather
    for q, v, _ in cut.subject.states(STATES, 22):
        pinocchio.computeJointJacobiansTimeVariation(peer.model, peer.data, peer.position(q), g @ v)
        pinocchio.updateFramePlacements(peer.model, peer.data)
        number = peer.frames[cut.frame]
        for frame in FRAMES:
            reference = getattr(pinocchio.ReferenceFrame, frame)
            jacobian = (pinocchio.getFrameJacobian(peer.model, peer.data, number, reference) @ g)[:, cut.columns]
            rate = (pinocchio.getFrameJacobianTimeVariation(peer.model, peer.data, number, reference) @ g)[:, cut.columns]
            close(cut.at(f"jacobian_{frame.lower()}", q), jacobian, 4e-15)
            close(cut.at(f"jacobian_derivative_{frame.lower()}", q, v[cut.columns]), rate)
        v1, v2, v3, w1, w2, w3 = cut.at("jacobian_world", q).reshape(6, -1)
        close(cut.at("screws", q), [w3, -w2, w1, v1, v2, v3], 0.0)


def test_motor_jacobian_by_the_complex_step(cut):
    for q, _, _ in cut.subject.states(STATES, 23):
        close(cut.at("motor_jacobian", q), cut.by_q("motor", q), 4e-15)


def test_the_pose_moves_as_the_jacobians_say(cut):
    """T' T^-1, T^-1 T' and (p', w) of every velocity are the columns in the three frames."""
    for q, _, _ in cut.subject.states(STATES, 24):
        pose, rates = cut.at("pose", q).reshape(4, 4), cut.by_q("pose", q).reshape(4, 4, -1)
        for frame in FRAMES:
            columns = []
            for rate in np.moveaxis(rates, -1, 0):
                twist = np.linalg.inv(pose) @ rate if frame == "LOCAL" else rate @ np.linalg.inv(pose)
                linear = rate[:3, 3] if frame == "LOCAL_WORLD_ALIGNED" else twist[:3, 3]
                columns.append([*linear, twist[2, 1], twist[0, 2], twist[1, 0]])
            close(cut.at(f"jacobian_{frame.lower()}", q), np.array(columns).T, 4e-15)


@pytest.mark.parametrize("frame", FRAMES)
def test_hessians_by_the_complex_step(cut, frame):
    """Along velocities: for a floating base entry k is the derivative along its own twist k, which is not symmetric."""
    name = frame.lower()
    for q, v, _ in cut.subject.states(STATES, 25):
        n = cut.chain.n
        hessian = cut.at(f"hessian_{name}", q).reshape(6, n, n)
        close(hessian, cut.by_q(f"jacobian_{name}", q), 4e-15)
        rate = np.einsum("ijk,k->ij", hessian, v[cut.columns])
        close(cut.at(f"jacobian_derivative_{name}", q, v[cut.columns]), rate)
        if frame == "LOCAL_WORLD_ALIGNED":
            first = 6 if cut.chain.coordinates.floating else 0
            linear = hessian[:3, first:, first:]
            close(linear, np.swapaxes(linear, 1, 2))


def exponential(twist, step):
    """exp of -step V/2 by its series, in the algebra; with a step of 1e-12 five terms leave 1e-72."""
    v, w = twist[:3], twist[3:]
    b = Multivector(TWIST, [w[2], -w[1], w[0], *v]).scaled(-step / 2)
    term = whole = Multivector(MOTOR, [mpmath.mpf(1), 0, 0, 0, 0, 0, 0, 0])
    for k in range(1, 6):
        term = (term * b).project(MOTOR).scaled(mpmath.mpf(1) / k)
        whole = Multivector(MOTOR, [x + y for x, y in zip(whole.coefficients, term.coefficients, strict=True)])
    return whole


def test_motor_jacobian_along_the_exponential_at_fifty_digits():
    """The base moved to M exp(+-h V): central differences of the chain's motor, for all six twists."""
    cut = Cut(make("skew, mimicking, floating"), "right_tip")
    (q, _, _), h = cut.subject.states(1, 26)[0], mpmath.mpf(10) ** -12
    with mpmath.workdps(50):
        given = {key: [mpmath.mpf(float(x)) for x in values] for key, values in cut.inputs(q, "motor", half=True).items()}
        base = Multivector(MOTOR, given.pop("base"))
        columns = []
        for twist in np.eye(6):
            moved = [(base * exponential([mpmath.mpf(x) for x in twist], sign * h)).project(MOTOR).coefficients for sign in (1, -1)]
            ahead, behind = (versors.motor(cut.chain, **given, base=list(m)) for m in moved)
            columns.append([float((x - y) / (2 * h)) for x, y in zip(ahead, behind, strict=True)])
            by_rate = [float((x - y) / (2 * h)) for x, y in zip(*moved, strict=True)]
            close(base_rate(q[:8], twist), by_rate, 1e-15)
    close(cut.at("motor_jacobian", q).reshape(8, -1)[:, :6], np.array(columns).T, 4e-15)


def test_a_chain_that_begins_beyond_the_base_is_the_same_on_both(skew_model):
    fixed, moving = Cut(Subject(skew_model), "right_tip", root="trunk"), Cut(Subject(floated(skew_model)), "right_tip", root="trunk")
    q, v, _ = moving.subject.states(1, 27)[0]
    for name in ("pose", "motor", "jacobian_local", "hessian_world"):
        close(moving.at(name, q), fixed.at(name, q[8:]), 0.0)
    v = v[moving.columns]
    close(moving.at("jacobian_derivative_local", q, v), fixed.at("jacobian_derivative_local", q[8:], v), 0.0)


def test_placement_tool_and_offset_of_a_floating_chain(skew_model):
    subject = Subject(floated(skew_model))
    at, tool = Placement.turn((0.0, 0.6, 0.8), 1.1), Placement.turn((1.0, 0.0, 0.0), -0.3) @ Placement(translation=(0.1, 0.0, 0.2))
    plain, placed = Cut(subject, "left_tip"), Cut(subject, "left_tip", placement=at, tool=tool, offset=(0.0, 0.1, 0.0))
    shift = np.eye(4)
    shift[:3, 3] = 0.0, 0.1, 0.0
    for q, _, _ in subject.states(2, 28):
        expected = at.matrix() @ plain.at("pose", q).reshape(4, 4) @ tool.matrix() @ shift
        close(placed.at("pose", q), expected, 2e-15)
        close(placed.at("motor_jacobian", q), placed.by_q("motor", q), 4e-15)


def test_the_floating_base_itself(skew_model):
    """A chain of no joint but the base: its Jacobian in its own axes is the identity, and its Hessian there vanishes."""
    cut = Cut(Subject(floated(skew_model)), "base")
    q = cut.subject.states(1, 29)[0][0]
    assert cut.chain.n == 6
    close(cut.at("jacobian_local", q), np.eye(6), 0.0)
    assert not cut.at("hessian_local", q).any()
    close(cut.at("motor_jacobian", q), cut.by_q("motor", q), 4e-15)


def test_rates_of_screws_and_columns_of_velocities(subject):
    """gather is the transpose of spread: sum_k S_k (spread v)_k = sum_j (gather S)_j v_j."""
    chain = subject.model.chain("right_tip")
    q, v, _ = subject.states(1, 30)[0]
    at = kinematics.outward(chain, **Cut(subject, "right_tip").inputs(q))
    v = v[: chain.n]
    by_screw = sum(x * np.array(s.linear_first()) for x, s in zip(spread(chain.coordinates, v), at.screws(), strict=True))
    close(by_screw, sum(x * np.array(s.linear_first()) for x, s in zip(v, gather(chain.coordinates, at.screws()), strict=True)))


def test_records_name_what_the_chain_takes(skew_model):
    """A floating base is an input of its own, its kernels have no derivative by coordinates to compare with; mimicking joints have."""
    _, floating = chain_unit(floated(skew_model).chain("left_1"))
    _, fixed = chain_unit(load_bundled("panda").chain("panda_rightfinger"))
    by_name = {kernel.name: kernel for kernel in floating.kernels}
    for kernel in CHAIN_KERNELS:
        inputs = dict(by_name[kernel.name].inputs)
        assert ("base" in inputs) == (kernel.name not in WITHOUT_BASE) and inputs.get("base", (8,)) == (8,)
        assert by_name[kernel.name].operations_by_differentiation is None
    assert {k.name for k in fixed.kernels if k.operations_by_differentiation} == {k.name for k in CHAIN_KERNELS if k.derivative_of}
    assert (floating.layout.nq, floating.layout.first, floating.layout.names) == (10, 8, ("drift", "lean", "left_slide"))
    assert fixed.layout.names[-1] == "panda_finger_joint1" and len(fixed.layout.motions) == 8
    assert made(CHAIN_KERNELS[0], load_bundled("panda").chain("panda_rightfinger")).program.output.size == 8
