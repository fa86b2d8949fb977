"""Every analytic derivative kernel against casadi's automatic differentiation of what it differentiates, and against the complex step
through the generated Python text; geometric Jacobians against the complex step of the pose. Robots: the NAO, and one whose joints are
prismatic, oblique and turned, with every option of a chain; that one against Pinocchio too."""

import casadi
import numpy as np
import pinocchio as pin
import pytest

import cga_runtime as cga
from cga_codegen.algebra.blade_types import MOTOR, POINT
from cga_codegen.algebra.multivector import Multivector
from cga_runtime.kernels import generated_folder, library
from cga_runtime.robot import FRAMES
from cga_runtime.spaces.closed_chain import LENGTH

TOLERANCE = 1e-12
STEP = 1e-30  # of the complex step: no difference is formed, so it may be as small as it likes
WORLD = np.array([[0.36, 0.48, -0.8, 0.5], [-0.8, 0.6, 0.0, -0.25], [0.48, 0.64, 0.6, 1.5], [0.0, 0.0, 0.0, 1.0]])
TIP = (0.03, -0.05, 0.11)

CHAINS = {  # robot, frame, options of Robot.chain
    "nao right": ("nao", "RHand", {}),
    "nao left, a point of the hand": ("nao", "LHand", {"offset": TIP}),
    "skew right": ("skew", "right_tip", {}),
    "skew left": ("skew", "left_tip", {}),
    "skew, from a turned shelf, prismatic first": ("skew", "left_tip", {"root": "shelf"}),
    "skew in the world": ("skew", "right_tip", {"placement": WORLD}),
    "skew, a point of the tip": ("skew", "left_tip", {"offset": TIP}),
    "skew, all options": ("skew", "right_tip", {"root": "shelf", "placement": WORLD, "offset": TIP}),
    "skew, one joint": ("skew", "trunk", {}),
    "skew, one prismatic joint": ("skew", "left_1", {"root": "trunk"}),
}
SKEWED = [name for name in CHAINS if name.startswith("skew")]


@pytest.fixture
def chain(request, nao, skew):
    robot, frame, options = CHAINS[request.param]
    return {"nao": nao, "skew": skew}[robot].chain(frame, **options)


@pytest.fixture(params=["nao", "skew"])
def pair(request, nao, skew):
    """A closed chain: the NAO's two arms, or the skew robot's from its shelf."""
    if request.param == "nao":
        return cga.ClosedChain(nao.chain("RHand"), nao.chain("LHand"))
    return cga.ClosedChain(skew.chain("right_tip", root="shelf"), skew.chain("left_tip", root="shelf"))


every_chain = pytest.mark.parametrize("chain", CHAINS, indirect=True)
every_frame = pytest.mark.parametrize("frame", [frame.lower() for frame in FRAMES])


def text(kernel, q, *others):
    """The kernel's Python text on any scalars (floats or complex numbers), in the kernel's shape."""
    q = np.asarray(q)
    pairs = {"c": [], "s": [], "ch": [], "sh": []}
    for kind, x in zip(kernel.unit.joint_kinds, q, strict=True):
        slides = kind == "prismatic"
        for name, value in (("c", 1 if slides else np.cos(x)), ("s", x if slides else np.sin(x))):
            pairs[name].append(value)
        for name, value in (("ch", 1 if slides else np.cos(x / 2)), ("sh", x / 2 if slides else np.sin(x / 2))):
            pairs[name].append(value)
    passed = dict(zip([name for name in kernel.inputs if name != "q"], [np.ravel(x) for x in others], strict=True))
    return np.array(kernel.unit.text[kernel.name](*((pairs | passed)[name] for name in kernel.body))).reshape(kernel.shape)


def along(kernel, q, direction, *others):
    """Directional derivative by the complex step."""
    return text(kernel, q + 1j * STEP * np.asarray(direction), *others).imag / STEP


def by_step(kernel, q, *others):
    """All partial derivatives by the complex step, the last axis counts joints."""
    return np.stack([along(kernel, q, e, *others) for e in np.eye(len(q))], axis=-1)


def by_ad(kernel, *values):
    """All partial derivatives by q: casadi's automatic differentiation of the kernel's text on symbols."""
    symbols = [casadi.SX.sym(name, *shape) for name, shape in kernel.inputs.items()]
    entries = casadi.vec(casadi.SX(kernel.symbolic(*symbols)).T)
    jacobian = casadi.Function("jacobian", symbols, [casadi.jacobian(entries, symbols[0])])
    return np.array(jacobian(*values)).reshape(*kernel.shape, len(values[0]))


def check(found, expected):
    """Equal to TOLERANCE times the size of what is expected (or times one where that is small: entries have size one, m or rad)."""
    assert found.shape == expected.shape
    assert np.abs(found - expected).max() <= TOLERANCE * max(1.0, np.abs(expected).max())


def draws(rng, n, count=5):
    return rng.uniform(-np.pi, np.pi, (count, n))


DERIVATIVES = [("motor_jacobian", "motor"), *((f"hessian_{f.lower()}", f"jacobian_{f.lower()}") for f in FRAMES)]


@every_chain
@pytest.mark.parametrize(("name", "of"), DERIVATIVES)
def test_analytic_derivatives(chain, name, of, rng):
    analytic, differentiated = chain.kernel(name), chain.kernel(of)
    for q in draws(rng, chain.n):
        check(analytic(q), by_step(differentiated, q))
        check(analytic(q), by_ad(differentiated, q))


@every_chain
@every_frame
def test_jacobians_are_the_motion_of_the_pose(chain, frame, rng):
    """T' T^-1 is the twist in the root frame, T^-1 T' the one in the end frame; (p', w) the one at its origin along root axes."""
    for q in draws(rng, chain.n):
        pose, rates = text(chain.kernel("pose"), q), by_step(chain.kernel("pose"), q)
        inverse = np.linalg.inv(pose)
        columns = []
        for rate in np.moveaxis(rates, -1, 0):
            twist = inverse @ rate if frame == "local" else rate @ inverse
            linear = rate[:3, 3] if frame == "local_world_aligned" else twist[:3, 3]
            assert np.abs(twist[:3, :3] + twist[:3, :3].T).max() < TOLERANCE
            columns.append([*linear, twist[2, 1], twist[0, 2], twist[1, 0]])
        check(chain.kernel(f"jacobian_{frame}")(q), np.transpose(columns))


@every_chain
@every_frame
def test_time_derivatives_of_jacobians(chain, frame, rng):
    """Along q' = v: by the complex step in that direction, and as the Hessian contracted with v."""
    rate, jacobian = chain.kernel(f"jacobian_derivative_{frame}"), chain.kernel(f"jacobian_{frame}")
    for q in draws(rng, chain.n):
        v = rng.standard_normal(chain.n)
        check(rate(q, v), along(jacobian, q, v))
        check(rate(q, v), by_ad(jacobian, q) @ v)
        check(rate(q, v), chain.kernel(f"hessian_{frame}")(q) @ v)


@every_chain
def test_motor_pose_point_and_screws_say_the_same(chain, rng):
    """The motor carries points as the pose does (by the exact algebra), and 2 M' ~M is minus the screw."""
    for q in draws(rng, chain.n):
        motor, pose = Multivector(MOTOR, chain.motor(q)), chain.pose(q)
        check(np.array((motor * ~motor).project(MOTOR).coefficients), np.eye(8)[0])
        x = rng.standard_normal(3)
        carried = (motor * Multivector(POINT, [1.0, *x, x @ x / 2]) * ~motor).project(POINT).coefficients
        check(np.array(carried[1:4]), pose[:3, :3] @ x + pose[:3, 3])
        check(chain.point(q), pose[:3, 3])
        rates = by_step(chain.kernel("motor"), q)
        for k in range(chain.n):
            screw = (Multivector(MOTOR, -2 * rates[:, k]) * ~motor).project(MOTOR).coefficients
            check(np.array(screw), np.array([0, *chain.screws(q)[:, k], 0]))


# ---- closed chains


def test_closure_jacobian(pair, rng):
    error, jacobian = pair.kernel("closure_error"), pair.kernel("closure_jacobian")
    for q in draws(rng, pair.n):
        for grasp in (pair.grasp(q), pair.grasp(draws(rng, pair.n, 1)[0])):  # closed, and far from it
            check(jacobian(q, grasp), by_step(error, q, grasp))
            check(jacobian(q, grasp), by_ad(error, q, grasp))
        check(error(q, pair.grasp(q)), np.zeros(6))


def test_pullback_is_the_gradient_of_weighted_screws(pair, rng):
    screws = pair.kernel("screws")
    for q in draws(rng, pair.n):
        weights = rng.standard_normal((6, pair.n))
        check(pair.kernel("screws_pullback")(q, weights), np.einsum("ij,ijk->k", weights, by_step(screws, q)))
        check(pair.kernel("screws_pullback")(q, weights), np.einsum("ij,ijk->k", weights, by_ad(screws, q)))


def test_determinant_gradient(pair, rng):
    """By the complex step through screws and bracket, one after the other."""
    bracket, screws = library(generated_folder()).unit("algebra/screws").kernel("bracket"), pair.kernel("screws")
    for q in draws(rng, pair.n):
        actuated = 1 + rng.choice(pair.n, pair.actuators, replace=False)
        passive = [j for j in range(pair.n) if j + 1 not in actuated]

        def determinant(q, passive=passive):
            return bracket.unit.text["bracket"](text(screws, q)[:, passive].ravel())[0] / LENGTH**3

        expected = np.array([determinant(q + 1j * STEP * e).imag / STEP for e in np.eye(pair.n)])
        check(pair.determinant_gradient(q, actuated), expected)
        check(np.array(determinant(q)), np.linalg.det(pair.screws(q)[:, passive]) / LENGTH**3)


def test_cofactors_are_the_derivative_of_the_bracket(rng):
    unit = library(generated_folder()).unit("algebra/screws")
    bracket, cofactors = unit.kernel("bracket"), unit.kernel("bracket_cofactors")
    for rank in (6, 6, 5, 4):
        screws = rng.standard_normal((6, rank)) @ rng.standard_normal((rank, 6))
        steps = [unit.text["bracket"](screws.ravel() + 1j * STEP * e)[0].imag / STEP for e in np.eye(36)]
        symbol = casadi.SX.sym("S", 6, 6)
        gradient = casadi.Function("gradient", [symbol], [casadi.gradient(bracket.symbolic(symbol), symbol)])
        size = np.linalg.norm(screws) ** 5
        assert np.abs(cofactors(screws).ravel() - steps).max() < TOLERANCE * size
        assert np.abs(cofactors(screws) - np.array(gradient(screws))).max() < TOLERANCE * size
        assert abs(bracket(screws)[0] - np.linalg.det(screws)) < TOLERANCE * size
        if rank == 6:
            assert np.abs(cofactors(screws) - np.linalg.det(screws) * np.linalg.inv(screws).T).max() < TOLERANCE * size
        if rank == 5:  # the derivative stays finite where the bracket vanishes
            assert np.abs(cofactors(screws)).max() > 1e-3
        if rank == 4:
            assert np.abs(cofactors(screws)).max() < TOLERANCE * size


# ---- Pinocchio


class Peer:
    """Pinocchio's answers for a chain of the skew robot: joints outside the chain at rest, results carried into the chain's root frame."""

    def __init__(self, file, chain, root=None, placement=None, offset=(0, 0, 0)):
        self.model, self.chain = pin.buildModelFromUrdf(file), chain
        tip = self.model.frames[self.model.getFrameId(chain.frame)]
        shifted = tip.placement * pin.SE3(np.eye(3), np.array(offset, dtype=float))
        self.frame = self.model.addFrame(pin.Frame("shifted", tip.parentJoint, 0, shifted, pin.FrameType.OP_FRAME))
        self.root = self.model.getFrameId(root) if root else None
        self.world = pin.SE3(placement[:3, :3], placement[:3, 3]) if placement is not None else pin.SE3.Identity()
        self.columns = [self.model.joints[self.model.getJointId(name)].idx_v for name in chain.joint_names]
        self.data = self.model.createData()

    def at(self, q, v):
        """Pose, and by frame the Jacobian and its time derivative."""
        moves, rates = np.zeros((2, self.model.nv))
        moves[self.columns], rates[self.columns] = q, v
        position = pin.integrate(self.model, pin.neutral(self.model), moves)  # a continuous joint has two coordinates there
        pin.forwardKinematics(self.model, self.data, position, rates)
        pin.updateFramePlacements(self.model, self.data)
        pin.computeJointJacobiansTimeVariation(self.model, self.data, position, rates)
        carry = self.world if self.root is None else self.world * self.data.oMf[self.root].inverse()
        turn = np.kron(np.eye(2), carry.rotation)
        by_frame = {"LOCAL": np.eye(6), "WORLD": carry.toActionMatrix(), "LOCAL_WORLD_ALIGNED": turn}
        answers = {}
        for name, matrix in by_frame.items():
            frame = getattr(pin.ReferenceFrame, name)
            jacobian = pin.getFrameJacobian(self.model, self.data, self.frame, frame)
            rate = pin.getFrameJacobianTimeVariation(self.model, self.data, self.frame, frame)
            answers[name] = (matrix @ jacobian)[:, self.columns], (matrix @ rate)[:, self.columns]
        return (carry * self.data.oMf[self.frame]).homogeneous, answers


@pytest.mark.parametrize("chain", SKEWED, indirect=True)
def test_skew_chains_equal_pinocchio(chain, request, rng):
    options = CHAINS[request.node.callspec.params["chain"]][2]
    peer = Peer(str(request.path.parents[1] / "data" / "skew.urdf"), chain, **options)
    for q in draws(rng, chain.n, 20):
        v = rng.standard_normal(chain.n)
        pose, answers = peer.at(q, v)
        check(chain.pose(q), pose)
        for frame, (jacobian, rate) in answers.items():
            check(chain.jacobian(q, frame), jacobian)
            check(chain.jacobian_derivative(q, v, frame), rate)
