"""A whole robot's kinematics and dynamics as users call them: shapes and batches, numpy in C and as Python text, casadi functions,
refusals. The robot is a small one on a fixed and on a moving base, with a mimicking joint that slides where its leader turns."""

import itertools

import casadi
import numpy as np
import pinocchio as pin
import pytest

import cga_runtime as cga
from cga_runtime import DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError
from cga_runtime.whole_body import TREE_KERNELS

BODY = """<inertial><origin xyz="0.02 -0.01 0.05" rpy="0.1 0.2 0.3"/><mass value="{}"/>
<inertia ixx="0.02" ixy="0" ixz="0.001" iyy="0.03" iyz="0" izz="0.025"/></inertial>"""
TEXT = """<robot name="small">
<link name="trunk">{b4}</link><link name="upper">{b2}</link><link name="lower">{b1}</link><link name="rack">{b1}</link>
<joint name="hip" type="revolute"><parent link="trunk"/><child link="upper"/><origin xyz="0.1 0 0.2" rpy="0 0.3 0"/><axis xyz="2 -3 6"/>
<limit lower="-1" upper="2" velocity="3" effort="4"/></joint>
<joint name="knee" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/></joint>
<joint name="rail" type="prismatic"><parent link="trunk"/><child link="rack"/><origin xyz="0 0.2 0"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/>{mimic}</joint></robot>"""
MIMIC = '<mimic joint="hip" multiplier="-0.4" offset="0.1"/>'
ARGUMENTS = {"inverse_dynamics": "va", "bias": "v", "forward_dynamics": "va"}
ARGUMENTS |= {"coriolis": "v", "inverse_dynamics_by_q": "va", "inverse_dynamics_by_v": "v"}
BATCHES = [(), (3,), (2, 3), (0,), (0, 2)]


def urdf(mimic=MIMIC, masses=("4", "2", "1")):
    b4, b2, b1 = (BODY.format(mass) if mass else "" for mass in masses)
    return TEXT.format(b4=b4, b2=b2, b1=b1, mimic=mimic)


@pytest.fixture(scope="module")
def robots(tmp_path_factory):
    """On a fixed and on a floating base."""
    file = tmp_path_factory.mktemp("small") / "small.urdf"
    file.write_text(urdf())
    return {base: cga.load_robot(file, base=base) for base in ("fixed", "floating")}


@pytest.fixture(params=["fixed", "floating"])
def small(request, robots):
    return robots[request.param]


@pytest.fixture(params=[pytest.param("compiled", marks=pytest.mark.compiler), "python text"])
def robot(request, small, monkeypatch):
    """The robot whose kernels run as C, and as Python text."""
    if request.param == "python text":
        for name in TREE_KERNELS:
            monkeypatch.setitem(vars(small.kernel(name)), "_entries", None)
    return small


def state(robot, batch, seed=1):
    """q, v, a of a batch."""
    rng = np.random.default_rng(seed)
    return robot.random(rng, batch), *rng.standard_normal((2, *batch, robot.nv))


def given(name, q, v, a):
    return [q, *({"v": v, "a": a}[key] for key in ARGUMENTS.get(name, ""))]


def shapes(robot):
    n = robot.nv
    square = {name: (n, n) for name in ("mass_matrix", "coriolis", "inverse_dynamics_by_q", "inverse_dynamics_by_v")}
    rows = {name: (n,) for name in ("inverse_dynamics", "bias", "gravity", "forward_dynamics")}
    return {"frames": (len(robot.frame_names), 4, 4), "center_of_mass": (3,), "center_of_mass_jacobian": (3, n), **rows, **square}


# ---- values


class Peer:
    """Pinocchio's model with the rack independent, and the projection onto our coordinates."""

    def __init__(self, robot):
        root = (pin.JointModelFreeFlyer(),) if robot.layout.floating else ()
        self.model = pin.buildModelFromXML(urdf(mimic=""), *root)
        self.data, first = self.model.createData(), 6 if robot.layout.floating else 0
        self.g, self.first = np.eye(first + 3, first + 2), first
        self.g[first + 2] = 0.0
        self.g[first + 2, first] = -0.4

    def position(self, q):
        hip, knee = q[-2:]
        pose = cga.Motor(q[:8]).pose() if self.first else np.eye(4)
        base = [*pose[:3, 3], *pin.Quaternion(pose[:3, :3]).coeffs()] if self.first else []
        return np.array([*base, hip, np.cos(knee), np.sin(knee), 0.1 - 0.4 * hip])


def test_values_are_pinocchio_s(robot):
    peer, (q, v, a) = Peer(robot), state(robot, (4,))
    found = {name: robot.kernel(name)(*given(name, q, v, a)) for name in TREE_KERNELS}
    g, model, data = peer.g, peer.model, peer.data
    for k in range(4):
        x, dx, ddx = peer.position(q[k]), g @ v[k], g @ a[k]
        upper = np.triu(pin.crba(model, data, x))
        mass, bias = g.T @ (upper + np.triu(upper, 1).T) @ g, g.T @ pin.nonLinearEffects(model, data, x, dx)
        pin.computeRNEADerivatives(model, data, x, dx, ddx)
        expected = {
            "inverse_dynamics": g.T @ pin.rnea(model, data, x, dx, ddx), "bias": bias, "mass_matrix": mass,
            "gravity": g.T @ pin.computeGeneralizedGravity(model, data, x), "forward_dynamics": np.linalg.solve(mass, a[k] - bias),
            "coriolis": g.T @ pin.computeCoriolisMatrix(model, data, x, dx) @ g, "center_of_mass": pin.centerOfMass(model, data, x),
            "center_of_mass_jacobian": pin.jacobianCenterOfMass(model, data, x) @ g,
            "inverse_dynamics_by_q": g.T @ data.dtau_dq @ g, "inverse_dynamics_by_v": g.T @ data.dtau_dv @ g,
        }  # fmt: skip
        pin.framesForwardKinematics(model, data, x)
        expected["frames"] = np.array([data.oMf[model.getFrameId(name)].homogeneous for name in robot.frame_names])
        for name in TREE_KERNELS:
            scale = max(1.0, np.abs(expected[name]).max())
            assert np.abs(found[name][k] - expected[name]).max() < (1e-12 if name == "forward_dynamics" else 1e-14) * scale, name


@pytest.mark.compiler
def test_compiled_and_text_agree(small, monkeypatch):
    q, v, a = state(small, (5,))
    compiled = {name: small.kernel(name)(*given(name, q, v, a)) for name in TREE_KERNELS}
    for name in TREE_KERNELS:
        assert small.kernel(name)._entries is not None
        monkeypatch.setitem(vars(small.kernel(name)), "_entries", None)
        text = small.kernel(name)(*given(name, q, v, a))
        assert np.abs(text - compiled[name]).max() < 1e-13 * max(1.0, np.abs(text).max())


def test_casadi_functions_are_the_same(small):
    q, v, a = state(small, ())
    for name, shape in shapes(small).items():
        function, values = small.casadi(name), given(name, q, v, a)
        rows = (shape[0], -1) if len(shape) > 1 else (-1, 1)
        expected = small.kernel(name)(*values).reshape(rows)
        assert function.name() == name and function.n_in() == len(values)
        assert np.abs(np.array(function(*values)) - expected).max() < 1e-13 * max(1.0, np.abs(expected).max())


def test_casadi_derivatives_are_the_kernels(robots):
    """On a fixed base velocities are rates of q, so that casadi's derivative by q is the kernel's own."""
    robot = robots["fixed"]
    q, v, a = (casadi.SX.sym(name, robot.nv) for name in "qva")
    tau = robot.kernel("inverse_dynamics").symbolic(q, v, a)
    both = casadi.Function("both", [q, v, a], [casadi.jacobian(tau, q), casadi.jacobian(tau, v), casadi.jacobian(tau, a)])
    values = state(robot, ())
    for ours, theirs in zip(robot.inverse_dynamics_derivatives(*values), both(*values), strict=True):
        assert np.abs(ours - np.array(theirs)).max() < 1e-13


# ---- shapes


@pytest.mark.parametrize("batch", BATCHES)
def test_leading_dimensions_come_back(robot, batch):
    q, v, a = state(robot, batch)
    for name, shape in shapes(robot).items():
        result = robot.kernel(name)(*given(name, q, v, a))
        assert result.shape == (*batch, *shape) and result.dtype == np.float64
        for index in itertools.islice(np.ndindex(*batch), 2):
            one = robot.kernel(name)(*given(name, q[index], v[index], a[index]))
            assert np.abs(result[index] - one).max() <= 1e-13 * max(1.0, np.abs(one).max())


def test_the_methods_are_the_kernels(robot):
    q, v, a = state(robot, (2,))
    for name in TREE_KERNELS:
        if not name.startswith("inverse_dynamics_by"):
            assert np.array_equal(getattr(robot, name)(*given(name, q, v, a)), robot.kernel(name)(*given(name, q, v, a)))
    by_q, by_v, by_a = robot.inverse_dynamics_derivatives(q, v, a)
    assert np.array_equal(by_q, robot.kernel("inverse_dynamics_by_q")(q, v, a))
    assert np.array_equal(by_v, robot.kernel("inverse_dynamics_by_v")(q, v)) and np.array_equal(by_a, robot.mass_matrix(q))
    assert np.array_equal(by_a, np.swapaxes(by_a, -1, -2))
    assert np.abs(robot.inverse_dynamics(q, v, robot.forward_dynamics(q, v, a)) - a).max() < 1e-13


def test_inputs_broadcast(robot):
    q, v, a = state(robot, (3,))
    found = robot.inverse_dynamics(q[:, None], v, a[0])
    assert found.shape == (3, 3, robot.nv)
    assert np.abs(found[1, 2] - robot.inverse_dynamics(q[1], v[2], a[0])).max() < 1e-13
    assert robot.inverse_dynamics(q[0], [0] * robot.nv, [0] * robot.nv) == pytest.approx(robot.gravity(q[0]), abs=1e-13)


def test_the_jacobian_of_a_frame_over_all_velocities(small, monkeypatch):
    monkeypatch.setattr("cga_runtime.kernels.compile_library", lambda name, source: None)  # chains have many kernels: one is called
    peer, (q, _, _) = Peer(small), state(small, (2, 2))
    for frame, own in (("lower", 2), ("rack", 1)):
        for reference in ("LOCAL", "WORLD", "LOCAL_WORLD_ALIGNED"):
            found = small.jacobian(q, frame, reference)
            assert found.shape == (2, 2, 6, small.nv) and np.count_nonzero(np.abs(found).max(axis=(0, 1, 2))) == peer.first + own
            for index in np.ndindex(2, 2):
                pin.computeJointJacobians(peer.model, peer.data, peer.position(q[index]))
                pin.updateFramePlacements(peer.model, peer.data)
                number = peer.model.getFrameId(frame)
                expected = pin.getFrameJacobian(peer.model, peer.data, number, getattr(pin.ReferenceFrame, reference)) @ peer.g
                assert np.abs(found[index] - expected).max() < 1e-14
        angular = small.jacobian(q, frame, "WORLD", "angular_first")
        assert np.array_equal(angular[..., :3, :], small.jacobian(q, frame, "WORLD")[..., 3:, :])


# ---- refusals


def test_wrong_sizes_and_names(robot):
    q, v, a = state(robot, ())
    nq, nv, where = robot.nq, robot.nv, "robots/small/tree_inverse_dynamics"
    for values, message in (
        ((q[1:], v, a), f"q of {where}: shape ({nq - 1},) given, (..., {nq}) needed"),
        ((q, v[1:], a), f"v of {where}: shape ({nv - 1},) given, (..., {nv}) needed"),
        ((q, v, 0.0), f"a of {where}: shape () given, (..., {nv}) needed"),
        ((q, np.zeros((2, nv)), np.zeros((3, nv))), "inverse_dynamics: batch dimensions [(), (2,), (3,)] do not broadcast"),
    ):
        with pytest.raises(WrongSizeError) as refusal:
            robot.inverse_dynamics(*values)
        assert str(refusal.value) == message
    with pytest.raises(WrongSizeError, match=rf"^q: shape \({nq - 1},\) given, \(\.\.\., {nq}\) needed$"):
        robot.jacobian(q[1:], "lower")
    for call in (robot.kernel, robot.casadi):
        with pytest.raises(UnknownNameError, match="^unknown kernel 'crba'; known: frames, center_of_mass, .*inverse_dynamics_by_v$"):
            call("crba")
    with pytest.raises(UnknownNameError, match="^unknown frame 'foot'; known: universe, "):
        robot.jacobian(q, "foot")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_finite_is_named(robot, bad):
    q, v, a = state(robot, (3,))
    for k, name in enumerate("qva"):
        for place in {0, robot.nv - 1}:
            values = [x.copy() for x in (q, v, a)]
            values[k][1, place] = bad
            with pytest.raises(NotFiniteError) as refusal:
                robot.inverse_dynamics(*values)
            assert str(refusal.value) == f"{name} holds NaN or infinity: {bad} at index (1, {place}) of shape {values[k].shape}"


@pytest.mark.parametrize("spoil", [
    lambda m: m * (1 + 1e-8), lambda m: np.array([*m[:7], m[7] + 1e-6]), lambda m: 0 * m, lambda m: 1e200 * m, lambda m: 1e-200 * m,
])  # fmt: skip
def test_bases_that_are_no_motors(robots, spoil):
    robot = robots["floating"]
    q, v, a = state(robot, (3,))
    q[1, :8] = spoil(q[1, :8])
    message = r"^q: its first 8 numbers are no motor of 'root_joint', M ~M is off by .* \(at most 1e-09\); Motor.from_pose makes one"
    for call in (lambda: robot.inverse_dynamics(q, v, a), lambda: robot.frames(q), lambda: robot.gravity(q[1])):
        with pytest.raises(DegenerateError, match=message):
            call()


def test_both_signs_of_a_motor_are_one_base(robots):
    robot = robots["floating"]
    q, v, a = state(robot, ())
    other = np.concatenate([-q[:8], q[8:]])
    assert np.abs(robot.inverse_dynamics(other, v, a) - robot.inverse_dynamics(q, v, a)).max() < 1e-13


def test_a_last_link_without_mass(tmp_path):
    """By structure the kernel does not exist; where masses only happen to cancel it has no value there."""
    (tmp_path / "light.urdf").write_text(urdf(mimic="", masses=("4", "2", "")))
    robot = cga.load_robot(tmp_path / "light.urdf")
    q, v, a = state(robot, ())
    with pytest.raises(DegenerateError, match="^forward_dynamics does not exist: the inertia that a joint carries is zero$"):
        robot.forward_dynamics(q, v, a)
    mass = robot.mass_matrix(q)
    assert not mass[1:].any() and np.abs(robot.inverse_dynamics(q, v, a) - robot.bias(q, v) - mass @ a).max() < 1e-14
    (tmp_path / "none.urdf").write_text(urdf(mimic="", masses=("", "", "")))
    with pytest.raises(DegenerateError, match="^center_of_mass does not exist: nothing that moves has mass$"):
        cga.load_robot(tmp_path / "none.urdf").center_of_mass(q)


def test_a_robot_without_joints(tmp_path, monkeypatch):
    """Nothing moves, all shapes are there; on a floating base it is a stone that falls."""
    inertial = '<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    (tmp_path / "stone.urdf").write_text(f'<robot name="stone"><link name="stone">{inertial}</link></robot>')
    stands, falls = (cga.load_robot(tmp_path / "stone.urdf", base=base) for base in ("fixed", "floating"))
    nothing = np.zeros((4, 0))
    for _ in range(2):  # compiled, and as Python text
        assert stands.frames(nothing).shape == (4, len(stands.frame_names), 4, 4)
        assert stands.mass_matrix(nothing).shape == (4, 0, 0) and stands.forward_dynamics(nothing, nothing, nothing).shape == (4, 0)
        q, still = falls.neutral(), np.zeros(6)
        assert falls.forward_dynamics(q, still, still).tolist() == [0.0, 0.0, -9.81, 0.0, 0.0, 0.0]
        monkeypatch.setattr(type(stands.kernel("frames").unit), "compiled", None)
        stands, falls = (cga.load_robot(tmp_path / "stone.urdf", base=base) for base in ("fixed", "floating"))
    assert stands.casadi("mass_matrix").size_out(0) == (0, 0) and falls.casadi("mass_matrix").size_out(0) == (6, 6)
