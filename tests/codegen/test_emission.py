"""Every generated kernel, run in every form that its text takes: C under all warnings, C as it is compiled for users, Python on floats,
Python on numpy batches, casadi, and C over a vector type. Also for a robot with prismatic joints and oblique axes."""

import ast
import ctypes
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.catalogue import CHAIN_KERNELS
from cga_codegen.generate import checked_in_robots, loop_name
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.units import chain_unit, loop_unit, screws_unit
from cga_runtime.compile import find_compiler
from cga_runtime.kernels import Kernel, Library, Unit, generated_folder

TOLERANCE = 1e-13
STRICT = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off", "-fPIC", "-shared")
LANES = 8  # doubles of a vector of 64 bytes
SKEW = Path(__file__).parents[1] / "data" / "skew.urdf"
MANIFEST = json.loads((generated_folder() / "manifest.json").read_text(encoding="utf-8"))

KERNELS = [(path, name) for path, unit in MANIFEST["units"].items() for name in unit["kernels"]]
KERNELS += [("skew chain", kernel.name) for kernel in CHAIN_KERNELS]
KERNELS += [("skew loop", name) for name in ("screws", "closure_error", "closure_jacobian", "screws_pullback")]
PATHS = list(dict.fromkeys(path for path, _ in KERNELS))
EVERY_KERNEL = pytest.mark.parametrize(("path", "name"), KERNELS, ids=[" ".join(key) for key in KERNELS])


@pytest.fixture(scope="module")
def units(skew: cga.Robot) -> dict[str, Unit]:
    home = Library(generated_folder())
    found = {path: home.unit(path) for path in MANIFEST["units"]}
    arms = [skew.chain(frame, root="shelf") for frame in ("right_tip", "left_tip")]
    return found | {"skew chain": skew.chain("right_tip").unit, "skew loop": skew.loop_unit(*arms)}


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    """Compiles a C text with all warnings as errors, once for each name."""
    folder, libraries = tmp_path_factory.mktemp("strict"), {}

    def library(name: str, text: str) -> ctypes.CDLL:
        if name not in libraries:
            source = folder / f"{len(libraries)}.c"
            source.write_text(text)
            command = [*find_compiler(None).command, *STRICT, str(source), "-o", str(source.with_suffix(".so")), "-lm"]
            done = subprocess.run(command, capture_output=True, text=True)
            assert done.returncode == 0 and not done.stderr, done.stderr
            libraries[name] = ctypes.CDLL(str(source.with_suffix(".so")))
        return libraries[name]

    return library


def c_text(unit: Unit) -> str:
    return unit.library.read(f"{unit.path}.c")


def draw(kernel: Kernel, rng, *batch):
    """Values of the public inputs: angles all around, velocities, grasps, weights and screws of size one."""
    shapes = {name: (*batch, *shape) for name, shape in kernel.inputs.items()}
    return [rng.uniform(-math.pi, math.pi, shape) if name == "q" else rng.standard_normal(shape) for name, shape in shapes.items()]


def body_inputs(kernel: Kernel, values, m):
    """What the body takes, from flat public values, written anew (the runtime's own is under test): `m` has cos and sin."""
    named, layout = dict(zip(kernel.inputs, values, strict=True)), kernel.unit.layout
    turning = {"c": lambda q: m.cos(q), "s": lambda q: m.sin(q), "ch": lambda q: m.cos(q / 2), "sh": lambda q: m.sin(q / 2)}
    sliding = {"c": lambda q: 1 + 0 * q, "s": lambda q: q, "ch": lambda q: 1 + 0 * q, "sh": lambda q: q / 2}

    def of(name):
        return [(sliding if kind == "prismatic" else turning)[name](q) for kind, q in named_joints(layout, named["q"])]

    return [of(name) if name in turning else named[name] for name in kernel.body]


def named_joints(layout, q):
    """Kind and position of each joint, mimicking ones by their ratio."""
    return [("prismatic" if slides else "revolute", ratio * q[k] if ratio != 1.0 else q[k]) for k, ratio, slides in layout.motions]


def call(function, *arrays):
    """A C function on arrays of doubles (and, first, a count if it is given as an int)."""
    given = [ctypes.c_int64(a) if isinstance(a, int) else a.ctypes.data_as(ctypes.c_void_p) for a in arrays]
    return function(*given)


def relative(found, expected):
    """Largest difference over the largest expected component, row by row of a batch."""
    found, expected = np.reshape(found, (len(expected), -1)), np.reshape(expected, (len(expected), -1))
    assert np.isfinite(found).all() and np.isfinite(expected).all()
    size = np.abs(expected).max(axis=1)
    return (np.abs(found - expected).max(axis=1) / np.where(size > 0.0, size, 1.0)).max()  # where zero is expected, zero it must be


@EVERY_KERNEL
@pytest.mark.compiler
def test_all_forms_agree(path, name, units, build, rng):
    kernel = units[path].kernel(name)
    count, size = 25, math.prod(kernel.shape)
    values = draw(kernel, rng, count)
    rows = [[np.ascontiguousarray(v[k]) for v in values] for k in range(count)]
    function = kernel.unit.text[name]
    floats = np.array([function(*body_inputs(kernel, [row.ravel().tolist() for row in rows[k]], math)) for k in range(count)])
    assert floats.shape == (count, size)

    columns = [v.reshape(count, -1).T for v in values]
    numpy_batch = np.stack(np.broadcast_arrays(*function(*body_inputs(kernel, columns, np)), np.zeros(count))[:-1], axis=-1)
    assert relative(numpy_batch, floats) < TOLERANCE

    symbol, strict = kernel.record["symbol"], build(path, c_text(kernel.unit))
    single, batch = np.empty((count, size)), np.empty((count, size))
    for k in range(count):
        assert call(strict[symbol], *rows[k], single[k]) == 0
    assert call(strict[f"{symbol}_batch"], count, *values, batch) == 0
    assert np.array_equal(single, batch)
    assert relative(single, floats) < TOLERANCE

    users = kernel(*values)
    assert users.shape == (count, *kernel.shape)
    assert np.array_equal(users, np.array([kernel(*row) for row in rows]))
    assert relative(users, floats) < TOLERANCE

    dense = np.array([np.array(kernel.casadi(*row)).ravel() for row in rows])  # SX matrices: row-major after numpy's ravel
    assert relative(dense, floats) < TOLERANCE


@EVERY_KERNEL
@pytest.mark.compiler
def test_c_reports_what_is_not_finite(path, name, units, build, rng):
    """Every element of every input, one after the other; and in a batch the one bad row among many."""
    kernel = units[path].kernel(name)
    symbol, strict = kernel.record["symbol"], build(path, c_text(kernel.unit))
    out = np.empty((3, math.prod(kernel.shape)))
    values = draw(kernel, rng, 3)
    for value in values:
        for k in range(value[1].size):
            flat = value.reshape(3, -1)
            kept, flat[1, k] = flat[1, k], (math.nan, math.inf, -math.inf)[k % 3]
            assert call(strict[symbol], *(v[1] for v in values), out) == 1
            assert call(strict[f"{symbol}_batch"], 3, *values, out) == 1
            flat[1, k] = kept
    assert call(strict[f"{symbol}_batch"], 3, *values, out) == 0
    assert call(strict[f"{symbol}_batch"], 0, *values, out) == 0


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.compiler
def test_bodies_compile_over_a_vector_type(path, units, build, rng):
    """The promise to batches in vector registers: with T a vector of eight doubles, each lane gives what a double gives."""
    unit = units[path]
    bodies = re.findall(r"static (?:inline|CGA_NOINLINE) void \w+_(?:body|part\d+)\(.*?\n}\n", c_text(unit), re.DOTALL)
    bodies = ["#define CGA_NOINLINE\n", *bodies]  # long ones come in parts
    doors = ""
    found = [match.groups() for body in bodies if (match := re.match(r"static inline void (\w+)_body\((.*)\)", body))]
    assert len(found) == len(unit.names)
    for symbol, arguments in found:
        names = [argument.split()[-1] for argument in arguments.split(",")]
        doors += f"void {symbol}_lanes({arguments});\nvoid {symbol}_lanes({arguments})\n{{\n    {symbol}_body({', '.join(names)});\n}}\n"
    # aligned(8): numpy promises no more; may_alias: the elements are doubles to everyone else
    vector = "typedef double V __attribute__((__vector_size__(64), __aligned__(8), __may_alias__));\n"
    roots = '#include <math.h>\n#pragma GCC diagnostic ignored "-Wpsabi"\n#define ROOT(x) root(x)\n'
    roots += f"static inline V root(V x)\n{{\n    for (int i = 0; i < {LANES}; ++i)\n        x[i] = sqrt(x[i]);\n    return x;\n}}\n"
    lanes = build(f"{path} lanes", vector + "#define T V\n#define K(x) ((V){0} + (x))\n" + roots + "".join(bodies) + doors)
    doubles = build(
        f"{path} doubles", "#include <math.h>\n#define T double\n#define K(x) (x)\n#define ROOT(x) sqrt(x)\n" + "".join(bodies) + doors
    )
    for name in unit.names:
        kernel = unit.kernel(name)
        inputs = [rng.standard_normal((math.prod(shape), LANES)) for _, shape in kernel.record["inputs"]]
        out = np.empty((math.prod(kernel.shape), LANES))
        call(lanes[f"{kernel.record['symbol']}_lanes"], *inputs, out)
        for lane in range(LANES):
            one = np.empty(math.prod(kernel.shape))
            given = [np.ascontiguousarray(x[:, lane]) for x in inputs]
            call(doubles[f"{kernel.record['symbol']}_lanes"], *given, one)
            assert np.array_equal(out[:, lane], one)
            # the same operations in the same order on the same doubles: Python rounds alike
            assert np.array_equal(one, unit.text[name](*(x.tolist() for x in given)))


@EVERY_KERNEL
def test_counts_are_those_of_both_texts(path, name, units):
    """The manifest's operation counts, counted again in the Python text and in the C text."""
    kernel = units[path].kernel(name)
    *counts, roots = (kernel.record[key] for key in ("multiplications", "additions", "divisions", "roots"))
    assert kernel.record["operations"] == sum(counts) + roots
    counts = tuple(counts)
    module = ast.parse(kernel.unit.library.read(f"{kernel.unit.path}.py"))
    (function,) = (node for node in module.body if isinstance(node, ast.FunctionDef) and node.name == name)
    operators = [node.op for node in ast.walk(function) if isinstance(node, ast.BinOp)]
    assert {type(op) for op in operators} <= {ast.Mult, ast.Add, ast.Sub, ast.Div}
    assert counts == tuple(sum(isinstance(op, kind) for op in operators) for kind in (ast.Mult, ast.Add | ast.Sub, ast.Div))
    body = "\n".join(re.findall(rf"void {kernel.record['symbol']}_(?:body|part\d+)\([^{{]*{{\n(.*?)\n}}\n", c_text(kernel.unit), re.DOTALL))
    assert counts == tuple(len(re.findall(operator, body)) for operator in (r" \* ", r" [+-] ", " / "))
    called = [node.func.id for node in ast.walk(function) if isinstance(node, ast.Call)]
    assert called == ["root"] * roots and len(re.findall(r"ROOT\(", body)) == roots
    said = "{} mul, {} add, {} div, {} sqrt.".format(*counts, roots)
    assert said in ast.get_docstring(function) and said in c_text(kernel.unit)


# ---- the same text every time


def skew_texts():
    model = load_urdf(SKEW)
    pair = ("right_tip", "left_tip")
    arms = [model.chain(frame, root="shelf") for frame in pair]
    made = [chain_unit(model.chain("right_tip")), loop_unit(Loop(loop_name(*pair), *arms)), screws_unit()]
    made += [chain_unit(robot.chain(frame)) for robot, selection in checked_in_robots() for frame in selection.chains[:1]]
    return {path: text for texts, _ in made for path, text in texts.items()}, [record.to_json() for _, record in made]


def test_two_lowerings_are_the_same_text():
    assert skew_texts() == skew_texts()


@pytest.mark.parametrize("seed", ["0", "1", "4242"])
def test_text_does_not_depend_on_the_order_of_sets(seed, tmp_path):
    """Another seed of Python's hashes, another process: the checked-in folder, byte for byte."""
    environment = {**os.environ, "PYTHONHASHSEED": seed}
    command = [sys.executable, "-m", "cga_codegen.cli", "generate", "-o", str(tmp_path)]
    subprocess.run(command, env=environment, check=True, capture_output=True)
    files = {path: (tmp_path / path).read_text(encoding="utf-8") for path in (*MANIFEST["files"], "manifest.json")}
    assert files == {path: (generated_folder() / path).read_text(encoding="utf-8") for path in files}
