"""The exported library, loaded by CasADi and by ctypes: values, exact derivatives and sparsity against our own kernels, and a solve."""

import ctypes
import subprocess
from dataclasses import dataclass
from pathlib import Path

import casadi
import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.compile import find_compiler
from cga_runtime.exporting import export_folder
from cga_runtime.kernels import Kernel

pytestmark = pytest.mark.compiler

LAST_BITS = 1e-15
"""Relative to the largest entry: compilers may round a*b + c once or twice."""
DERIVATIVES = 4e-15
CHAIN = ("motor", "pose", "point", "jacobian_local_world_aligned")
TREE = ("inverse_dynamics", "gravity")
SMALL = Path(__file__).parents[1] / "data" / "four_links.urdf"


@dataclass(frozen=True)
class Exported:
    """A robot, the chain that was exported, and the library."""

    robot: cga.Robot
    arm: cga.Chain
    library: Path

    def external(self, kernel: str) -> casadi.Function:
        return casadi.external(f"{self.robot.name}_{kernel}", str(self.library))

    def kernel(self, name: str) -> Kernel:
        return self.arm.kernel(name) if name in self.arm.unit.names else self.robot.kernel(name)

    def inputs(self, name: str, rng: np.random.Generator) -> list[np.ndarray]:
        kernel = self.kernel(name)
        owner = self.arm if name in self.arm.unit.names else self.robot
        return [owner.random(rng) if key == "q" else rng.standard_normal(size) for key, size in kernel.inputs.items()]


def built(robot: cga.Robot, frame: str, kernels: tuple[str, ...], folder: Path) -> Exported:
    """Exported, and compiled as the README says without CMake."""
    export_folder(robot, folder, [frame], kernels=kernels)
    compiler, library = find_compiler(None), folder / f"libcga_{robot.name}.so"
    assert compiler is not None
    sources = [str(path) for path in sorted((folder / "src").glob("*.c"))]
    command = [*compiler.command, "-std=c99", "-O0", "-fPIC", "-shared", f"-I{folder / 'include'}", *sources, "-lm", "-o", str(library)]
    subprocess.run(command, check=True)
    return Exported(robot, robot.chain(frame), library)


@pytest.fixture(scope="module")
def panda(tmp_path_factory: pytest.TempPathFactory) -> Exported:
    robot = cga.load_robot("panda", lock={"panda_finger_joint1": 0.0})
    return built(robot, "panda_link8", CHAIN + TREE, tmp_path_factory.mktemp("panda"))


SMALL_KERNELS = {"fixed": ("motor", "pose", "gravity"), "floating": ("point", "jacobian_local", "gravity")}


@pytest.fixture(scope="module", params=SMALL_KERNELS)
def small(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Exported:
    """A sliding joint, one that mimics, and a base that stands or floats."""
    return built(cga.load_robot(SMALL, base=request.param), "d", SMALL_KERNELS[request.param], tmp_path_factory.mktemp(request.param))


def close(value: np.ndarray, expected: np.ndarray, tolerance: float) -> bool:
    return bool(np.abs(value - expected).max() <= tolerance * np.abs(expected).max(initial=1e-300))


@pytest.mark.parametrize("name", CHAIN + TREE)
def test_plain_c_gives_what_the_runtime_gives(panda: Exported, rng: np.random.Generator, name: str) -> None:
    kernel, library = panda.kernel(name), ctypes.CDLL(str(panda.library))
    single, batch = (getattr(library, f"cga_panda_{name}{ending}") for ending in ("", "_batch"))
    sets = [np.stack(values) for values in zip(*(panda.inputs(name, rng) for _ in range(20)), strict=True)]
    expected, out, many = kernel(*sets), np.empty(kernel.shape), np.empty((20, *kernel.shape))
    assert batch(ctypes.c_int64(20), *(ctypes.c_void_p(x.ctypes.data) for x in sets), ctypes.c_void_p(many.ctypes.data)) == 0
    for k in range(20):
        rows = [np.ascontiguousarray(x[k]) for x in sets]
        assert single(*(ctypes.c_void_p(x.ctypes.data) for x in rows), ctypes.c_void_p(out.ctypes.data)) == 0
        assert close(out, expected[k], LAST_BITS) and np.array_equal(out, many[k])
    for bad in (np.nan, np.inf):
        rows[-1][2] = bad
        assert single(*(ctypes.c_void_p(x.ctypes.data) for x in rows), ctypes.c_void_p(out.ctypes.data)) == 1


@pytest.mark.parametrize("name", CHAIN + TREE)
def test_values_and_derivatives_in_casadi(panda: Exported, rng: np.random.Generator, name: str) -> None:
    compare(panda, name, rng)


def test_mimicking_sliding_and_floating_joints(small: Exported, rng: np.random.Generator) -> None:
    for name in SMALL_KERNELS["floating" if small.robot.layout.floating else "fixed"]:
        compare(small, name, rng)


def compare(exported: Exported, name: str, rng: np.random.Generator) -> None:
    """Value, and derivatives as far as they are exported, with casadi's own of our kernel as symbols: values, names, shapes, patterns."""
    ours, theirs = exported.external(name), exported.kernel(name).casadi
    points = [exported.inputs(name, rng) for _ in range(3)]
    orders = {"motor": 2, "pose": 2, "point": 2}.get(name, 1)
    for order in range(orders + 1):
        assert (ours.name_in(), ours.name_out(), ours.size_in(0)) == (theirs.name_in(), theirs.name_out(), theirs.size_in(0))
        nothing = [casadi.DM(*theirs.size_in(k)) for k in range(len(points[0]), theirs.n_in())]
        for k in range(ours.n_out()):
            pattern = ours.sparsity_out(k)
            assert ours.size_out(k) == theirs.size_out(k)
            assert pattern.is_subset(theirs.sparsity_out(k)), f"{name}: entries of {ours.name_out(k)} that casadi knows to be zero"
            for point in points:
                value, expected = (np.array(function.call([*point, *nothing])[k]) for function in (ours, theirs))
                assert value.size == 0 or close(value, expected, DERIVATIVES if order else LAST_BITS), (name, ours.name_out(k))
        if order < orders:
            ours, theirs = ours.jacobian(), theirs.jacobian()
    with pytest.raises(RuntimeError, match="Derivatives cannot be calculated"):
        ours.jacobian()


def test_inputs_that_are_not_given_and_results_that_are_not_wanted(panda: Exported, rng: np.random.Generator) -> None:
    """CasADi passes null pointers: zeros stand for the input, nothing is written for the result."""
    library = ctypes.CDLL(str(panda.library))
    q, v, a = panda.inputs("inverse_dynamics", rng)
    pointers = ctypes.c_void_p * 3

    def call(function: str, given: list[np.ndarray | None], sizes: list[int], wanted: set[int]) -> list[np.ndarray]:
        results = [np.full(size, 7.0) for size in sizes]
        arg = pointers(*(None if x is None else x.ctypes.data for x in given))
        res = pointers(*(x.ctypes.data if k in wanted else None for k, x in enumerate(results)))
        work = np.empty(100)
        assert getattr(library, function)(arg, res, None, ctypes.c_void_p(work.ctypes.data), 0) == 0
        return results

    kernel = panda.kernel("inverse_dynamics")
    zero = np.zeros(7)
    for given in ([q, None, None], [None, v, a], [None, None, None], [q, v, a]):
        (tau,) = call("panda_inverse_dynamics", given, [7], {0})
        expected = kernel(*(zero if x is None else x for x in given))
        assert np.abs(tau - expected).max() <= LAST_BITS * np.abs(kernel(q, v, a)).max()
    assert np.all(call("panda_inverse_dynamics", [q, v, a], [7], set())[0] == 7.0)
    sizes = [panda.external("inverse_dynamics").jacobian().nnz_out(k) for k in range(3)]
    whole = call("jac_panda_inverse_dynamics", [q, v, a], sizes, {0, 1, 2})
    for k in range(3):
        part = call("jac_panda_inverse_dynamics", [q, v, a], sizes, {k})
        assert np.array_equal(part[k], whole[k]) and all(np.all(part[other] == 7.0) for other in range(3) if other != k)


def test_the_interface_answers_as_casadi_asks(panda: Exported) -> None:
    library = ctypes.CDLL(str(panda.library))

    def ask(name: str, result: type, *values: int) -> object:
        function = getattr(library, f"panda_pose_{name}")
        function.restype = result
        return function(*(ctypes.c_longlong(value) for value in values))

    assert (ask("n_in", ctypes.c_longlong), ask("n_out", ctypes.c_longlong)) == (1, 1)
    assert (ask("name_in", ctypes.c_char_p, 0), ask("name_out", ctypes.c_char_p, 0)) == (b"q", b"pose")
    assert all(ask(name, ctypes.c_char_p, k) is None for name in ("name_in", "name_out") for k in (-1, 1))
    assert all(ask(name, ctypes.c_void_p, k) is None for name in ("sparsity_in", "sparsity_out") for k in (-1, 1))
    assert ask("default_in", ctypes.c_double, 0) == 0.0
    assert [ask(name, ctypes.c_int) for name in ("alloc_mem", "checkout")] == [0, 0] and ask("init_mem", ctypes.c_int, 0) == 0
    sizes = [ctypes.c_longlong(-1) for _ in range(4)]
    assert library.panda_pose_work(*map(ctypes.byref, sizes)) == 0 and [size.value for size in sizes] == [1, 1, 0, 16]
    assert library.panda_pose_work(None, None, None, None) == 0


def test_a_batch_by_map(panda: Exported, rng: np.random.Generator) -> None:
    q = panda.arm.random(rng, 16)
    for kind in ("serial", "thread"):
        poses = (
            np.array(panda.external("pose").map(16, kind, 2)(q.T)) if kind == "thread" else np.array(panda.external("pose").map(16)(q.T))
        )
        assert close(poses.T.reshape(16, 4, 4).swapaxes(1, 2), panda.arm.pose(q), LAST_BITS)


def reaching(
    point: casadi.Function, motor: casadi.Function, arm: cga.Chain, goal: np.ndarray, start: np.ndarray
) -> tuple[np.ndarray, dict]:
    """The configuration nearest to the middle of the limits whose end frame is where it is at `goal`.

    The turn that is left is sin(angle / 2) times its axis, from the rotor's components 1 e12 e13 e23: zero at no other orientation.
    """
    q, target, place = casadi.MX.sym("q", arm.n), arm.motor(goal), arm.point(goal)
    now = motor(q)
    scalar, turned = now[0], casadi.vertcat(-now[3], now[2], -now[1])
    wanted = casadi.DM([-target[3], target[2], -target[1]])
    left = target[0] * turned - scalar * wanted - casadi.cross(wanted, turned)
    problem = {"x": q, "f": casadi.sumsqr(q - 0.5 * (arm.lower + arm.upper)), "g": casadi.vertcat(point(q) - place, left)}
    solver = casadi.nlpsol("reaching", "ipopt", problem, {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": False})
    found = solver(x0=start, lbx=arm.lower, ubx=arm.upper, lbg=0, ubg=0)
    return np.array(found["x"]).ravel(), solver.stats()


def test_ipopt_reaches_poses_with_exact_second_derivatives(panda: Exported, rng: np.random.Generator) -> None:
    """The same iterations and the same end as with our kernels as casadi symbols, where the solver gives up too (as it may, from one
    start: it descends); and what was found is there, within the limits."""
    arm, reached = panda.arm, 0
    middle = 0.5 * (arm.lower + arm.upper)
    for _ in range(8):
        goal = middle + 0.5 * (arm.random(rng) - middle)
        start = goal + 0.5 * (arm.random(rng) - middle)
        q, stats = reaching(panda.external("point"), panda.external("motor"), arm, goal, start)
        same, other = reaching(arm.casadi("point"), arm.casadi("motor"), arm, goal, start)
        assert (stats["return_status"], stats["iter_count"]) == (other["return_status"], other["iter_count"])
        assert np.abs(q - same).max() < 1e-7 and np.all(q >= arm.lower - 1e-7) and np.all(q <= arm.upper + 1e-7)
        if stats["success"]:
            assert np.abs(arm.pose(q) - arm.pose(goal)).max() < 1e-7
            reached += 1
    assert reached >= 6


def test_ipopt_without_second_derivatives(panda: Exported) -> None:
    """Torques that hold the arm, made small: gravity has first derivatives only, and the solver says so or is told to do without."""
    q = casadi.MX.sym("q", panda.robot.nq)
    lower, upper = panda.robot.lower, panda.robot.upper
    problem = {"x": q, "f": casadi.sumsqr(panda.external("gravity")(q))}
    quiet = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": False}
    with pytest.raises(RuntimeError, match="Derivatives cannot be calculated for jac_panda_gravity"):
        casadi.nlpsol("rest", "ipopt", problem, quiet)
    solver = casadi.nlpsol("rest", "ipopt", problem, {**quiet, "ipopt.hessian_approximation": "limited-memory"})
    found = solver(x0=0.5 * (lower + upper), lbx=lower, ubx=upper)
    assert solver.stats()["success"] and float(found["f"]) < 1e-3
    assert abs(float(found["f"]) - np.sum(panda.robot.gravity(np.array(found["x"]).ravel()) ** 2)) < 1e-12
