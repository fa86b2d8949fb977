"""Kernels as users call them: every shape and type of input, refusals word for word, names, and the casadi view."""

import casadi
import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime import ChainError, DegenerateError, NotFiniteError, UnknownNameError, WrongSizeError

Q = np.array([0.3, -0.4, 1.1, 0.7, -0.2])


@pytest.fixture(params=[pytest.param("compiled", marks=pytest.mark.compiler), "python text"])
def subject(request, arm, loop, monkeypatch):
    """An arm and a loop whose kernels run as C, and the same as Python text: both must behave alike."""
    if request.param == "python text":
        for unit in (arm.unit, loop.unit):
            for name in unit.names:
                monkeypatch.setitem(vars(unit.kernel(name)), "_entries", None)  # what a machine without a compiler finds there
    assert (arm.kernel("point")._entries is None) == (request.param == "python text")
    return arm, loop


# ---- shapes and types


@pytest.mark.parametrize("batch", [(), (1,), (7,), (2, 3), (2, 1, 3), (0,), (0, 4), (4, 0)])
def test_leading_dimensions_come_back(subject, batch, rng):
    arm, loop = subject
    q = rng.uniform(-1, 1, (*batch, 5))
    results = {name: arm.kernel(name)(q) for name in ("motor", "pose", "point", "screws", "jacobian_local", "hessian_world")}
    shapes = {"motor": (8,), "pose": (4, 4), "point": (3,), "screws": (6, 5), "jacobian_local": (6, 5), "hessian_world": (6, 5, 5)}
    for name, result in results.items():
        assert result.shape == (*batch, *shapes[name]) and result.dtype == np.float64
        for index in np.ndindex(*batch):
            assert np.abs(result[index] - arm.kernel(name)(q[index])).max() < 1e-15
    assert loop.closure_error(rng.uniform(-1, 1, (*batch, 10)), np.eye(8)[0]).shape == (*batch, 6)


@pytest.mark.parametrize("convert", [
    lambda q: q.astype(np.float32), lambda q: q.astype(np.longdouble), lambda q: q.tolist(), lambda q: tuple(map(tuple, q.tolist())),
    lambda q: np.asfortranarray(q), lambda q: np.repeat(q, 2, axis=0)[::2], lambda q: np.flip(np.flip(q, -1).copy(), -1),
    lambda q: np.broadcast_to(q, q.shape), lambda q: q.astype(object), lambda q: q.astype(">f8"), lambda q: np.ma.array(q),
    lambda q: np.lib.stride_tricks.sliding_window_view(q.ravel(), 5)[::5],
])  # fmt: skip
def test_any_array_of_numbers_is_taken(subject, convert):
    arm, _ = subject
    q = np.array([Q, -Q, 2 * Q], dtype=np.float32).astype(float)  # numbers that float32 can hold
    kept = q.copy()
    assert np.array_equal(arm.pose(convert(q)), arm.pose(q)) and np.array_equal(q, kept)
    assert np.array_equal(arm.pose(convert(q)[1]), arm.pose(q[1]))


def test_integers_and_truth_values_are_numbers(subject):
    arm, _ = subject
    expected = arm.point(np.array([1.0, 0.0, 1.0, 0.0, 0.0]))
    for q in ([1, 0, 1, 0, 0], np.array([1, 0, 1, 0, 0], dtype=np.int8), np.array([1, 0, 1, 0, 0], dtype=np.uint64)):
        assert np.array_equal(arm.point(q), expected)
    assert np.array_equal(arm.point(np.array([1, 0, 1, 0, 0], dtype=bool)), expected)


def test_results_are_new_arrays(subject):
    arm, _ = subject
    first = arm.point(Q)
    kept = first.copy()
    second = arm.point(-Q)
    second[:] = 7.0
    assert np.array_equal(first, kept) and first.flags.writeable and first.flags.c_contiguous


def test_inputs_broadcast_against_each_other(subject, rng):
    _, loop = subject
    q, grasp = rng.uniform(-1, 1, (4, 3, 10)), rng.standard_normal((3, 8))
    closure_error = loop.kernel("closure_error")
    error = closure_error(q, grasp)
    assert error.shape == (4, 3, 6)
    for i, k in np.ndindex(4, 3):
        assert np.abs(error[i, k] - closure_error(q[i, k], grasp[k])).max() < 1e-14
    assert closure_error(q[0, 0], grasp).shape == (3, 6)
    assert closure_error(q, grasp[0]).shape == (4, 3, 6)
    assert closure_error(q[:, :1], grasp).shape == (4, 3, 6)
    gradient = loop.kernel("screws_pullback")(q[:, 0], rng.standard_normal((6, 10)))
    assert gradient.shape == (4, 10)


# ---- refusals


SIZES = [
    (np.zeros(4), r"shape \(4,\) given"),
    (np.zeros(6), r"shape \(6,\) given"),
    (np.zeros((5, 4)), r"shape \(5, 4\) given"),
    (np.zeros((5, 1)), r"shape \(5, 1\) given"),
    (0.0, r"shape \(\) given"),
    ([], r"shape \(0,\) given"),
    (None, r"shape \(\) given"),
]


@pytest.mark.parametrize(("q", "given"), SIZES)
def test_wrong_sizes(subject, q, given):
    with pytest.raises(WrongSizeError, match=rf"^q of robots/nao/RHand: {given}, \(\.\.\., 5\) needed$"):
        subject[0].pose(q)


NOT_NUMBERS = [
    ("0.1", r"<U3 given"),
    (["0.1"] * 5, r"<U3 given"),
    ([b"1"] * 5, r"\|S1 given"),
    ([0.1, "0.2", 0, 0, 0], r"<U32 given"),
    (Q + 1j, r"complex128 given"),
    (np.array(["2020-01-01"] * 5, dtype="datetime64[D]"), r"datetime64\[D\] given"),
    ([[1.0, 2.0], [3.0]], r"setting an array element with a sequence.*"),
    ([{}] * 5, r"float\(\) argument must be.*"),
    ([10**400] * 5, r"int too large to convert to float"),
    (casadi.SX.sym("q", 5), r"(?s:.)*"),
    (casadi.MX.sym("q", 5), r"(?s:.)*"),
]


@pytest.mark.parametrize(("q", "reason"), NOT_NUMBERS)
def test_what_is_no_array_of_numbers(subject, q, reason):
    with pytest.raises(WrongSizeError, match=rf"^q: not an array of numbers \({reason}\)$"):
        subject[0].pose(q)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize(("batch", "at"), [((), (2,)), ((4,), (3, 0)), ((2, 3), (1, 2, 4))])
def test_what_is_not_finite(subject, bad, batch, at):
    arm, _ = subject
    q = np.broadcast_to(Q, (*batch, 5)).copy()
    q[at] = bad
    for name in arm.unit.names:
        values = [q] if len(arm.kernel(name).inputs) == 1 else [q, Q]
        with pytest.raises(NotFiniteError) as refusal:
            arm.kernel(name)(*values)
        assert str(refusal.value) == f"q holds NaN or infinity: {bad} at index {at} of shape {q.shape}"
    assert np.isfinite(arm.pose(np.broadcast_to(Q, (*batch, 5)))).all()  # a refusal leaves nothing behind


def test_the_input_that_is_not_finite_is_named(subject, rng):
    arm, loop = subject
    with pytest.raises(NotFiniteError, match=r"^v holds NaN or infinity: nan at index \(4,\) of shape \(5,\)$"):
        arm.jacobian_derivative(Q, [0, 0, 0, 0, np.nan])
    grasp = np.eye(8)[0]
    grasp[7] = np.inf
    with pytest.raises(NotFiniteError, match="^grasp holds NaN or infinity: inf at index"):
        loop.closure_error(np.zeros((3, 10)), grasp)
    with pytest.raises(NotFiniteError, match="^q holds"):
        arm.point([None] * 5)


def test_numbers_of_any_size_are_finite(subject):
    """Largest and smallest doubles are angles like others."""
    for q in (np.full(5, 1e300), np.full(5, -1.7e308), np.full(5, 5e-324)):
        assert np.isfinite(subject[0].pose(q)).all()


def test_wrong_numbers_of_arrays(subject):
    arm, loop = subject
    with pytest.raises(WrongSizeError, match="^pose takes q; 2 arrays given$"):
        arm.kernel("pose")(Q, Q)
    with pytest.raises(WrongSizeError, match="^pose takes q; 0 arrays given$"):
        arm.kernel("pose")()
    with pytest.raises(WrongSizeError, match="^closure_error takes q, grasp; 1 arrays given$"):
        loop.kernel("closure_error")(np.zeros(10))
    with pytest.raises(WrongSizeError, match=r"^grasp of robots/nao/RHand_with_LHand: shape \(7,\) given, \(\.\.\., 8\) needed$"):
        loop.closure_error(np.zeros(10), np.zeros(7))
    with pytest.raises(WrongSizeError, match=r"^weights of .*: shape \(10,\) given, \(\.\.\., 6, 10\) needed$"):
        loop.kernel("screws_pullback")(np.zeros(10), np.zeros(10))
    with pytest.raises(WrongSizeError, match=r"^closure_error: batch dimensions \[\(2,\), \(3,\)\] do not broadcast$"):
        loop.closure_error(np.zeros((2, 10)), np.zeros((3, 8)))


# ---- names


def test_unknown_names(arm, nao):
    with pytest.raises(UnknownNameError, match="^unknown kernel 'jacobi'; known: hessian_local, .*motor_jacobian, point, pose, screws$"):
        arm.kernel("jacobi")
    with pytest.raises(UnknownNameError, match="^unknown kernel 'Pose'; known: "):
        arm.casadi("Pose")
    for call in (arm.jacobian, arm.hessian, lambda q, **more: arm.jacobian_derivative(q, q, **more)):
        with pytest.raises(UnknownNameError, match="^unknown frame of reference 'local'; known: LOCAL, WORLD, LOCAL_WORLD_ALIGNED$"):
            call(Q, frame="local")
        with pytest.raises(UnknownNameError, match="^unknown order 'w first'; known: linear_first, angular_first, bivector$"):
            call(Q, order="w first")
    with pytest.raises(UnknownNameError, match="^unknown frame 'Hand'; known: universe, .*RHand, r_gripper$"):
        nao.chain("Hand")
    with pytest.raises(UnknownNameError, match="^unknown frame 'Torso'; known: universe, torso"):
        nao.chain("RHand", root="Torso")
    with pytest.raises(UnknownNameError, match="^unknown robot 'nau'; known: .*, nao, nao_v32, .*. Or name a URDF or MJCF file$"):
        cga.load_robot("nau")


def test_chains_that_do_not_exist(nao):
    with pytest.raises(ChainError, match="^nao: root 'LHand' does not lie between the base and 'RHand'$"):
        nao.chain("RHand", root="LHand")
    with pytest.raises(ChainError, match="^nao: no joint lies between the root and 'torso'; name a frame that moves$"):
        nao.chain("torso")
    with pytest.raises(ChainError, match="^nao: no joint lies between the root and 'RHand'"):
        nao.chain("RHand", root="RHand")
    with pytest.raises(WrongSizeError, match=r"^placement: shape \(3, 3\) given, \(4, 4\) needed$"):
        nao.chain("RHand", placement=np.eye(3))
    with pytest.raises(NotFiniteError, match="^placement holds NaN"):
        nao.chain("RHand", placement=np.full((4, 4), np.nan))
    with pytest.raises(DegenerateError, match="^placement: not a rotation"):
        nao.chain("RHand", placement=np.diag([1.0, 2.0, 1.0, 1.0]))
    with pytest.raises(WrongSizeError, match=r"^offset: shape \(2,\) given, \(3,\) needed$"):
        nao.chain("RHand", offset=(0.0, 1.0))
    with pytest.raises(NotFiniteError, match="^offset holds NaN"):
        nao.chain("RHand", offset=(0.0, np.nan, 1.0))


# ---- rows and views


def test_orders_of_rows(arm):
    linear, angular, bivector = (arm.jacobian(Q, order=order) for order in ("linear_first", "angular_first", "bivector"))
    assert np.array_equal(angular, np.vstack([linear[3:], linear[:3]]))
    x, y, z = linear[3:]
    assert np.array_equal(bivector, np.vstack([z, -y, x, linear[:3]]))  # e12 e13 e23 e1i e2i e3i
    assert np.abs(arm.jacobian(Q, "WORLD", "bivector") - arm.screws(Q)).max() < 1e-15
    hessian = arm.hessian(np.array([Q, -Q]), order="angular_first")
    assert np.array_equal(hessian[:, :3], arm.hessian(np.array([Q, -Q]))[:, 3:])


def test_casadi_views(arm, loop):
    for subject in (arm, loop):
        for name in subject.unit.names:
            kernel, function = subject.kernel(name), subject.casadi(name)
            values = [np.random.default_rng(k).uniform(-1, 1, shape) for k, shape in enumerate(kernel.inputs.values())]
            assert function.name() == name and function.name_in() == list(kernel.inputs) and function.name_out() == [name]
            rows = (kernel.shape[0], -1) if len(kernel.shape) > 1 else (-1, 1)
            assert np.abs(np.array(function(*values)) - kernel(*values).reshape(rows)).max() < 1e-13


def test_symbolic_sizes_are_checked(arm, loop):
    assert arm.kernel("pose").symbolic(casadi.SX.sym("q", 5)).shape == (4, 4)
    with pytest.raises(WrongSizeError, match=r"^pose takes \{'q': 5\} numbers; \[6\] given$"):
        arm.kernel("pose").symbolic(casadi.SX.sym("q", 6))
    with pytest.raises(WrongSizeError, match=r"^closure_error takes \{'q': 10, 'grasp': 8\} numbers; \[10\] given$"):
        loop.kernel("closure_error").symbolic(casadi.SX.sym("q", 10))
