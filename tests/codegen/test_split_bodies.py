"""Long kernels become several C functions in a row: the same numbers to the last bit as one function, over doubles and over vectors."""

import ctypes
import re
import subprocess

import casadi
import numpy as np
import pytest
from joint_by_joint import make

from cga_codegen.catalogue import CHAIN_KERNELS, TREE_KERNELS
from cga_codegen.emit import print_c
from cga_codegen.emit.lower import Port, lower
from cga_codegen.emit.print_c import print_body, print_entries, print_file
from cga_codegen.emit.print_python import print_function, print_module
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.bundled import load_bundled
from cga_codegen.units import _layout, made
from cga_runtime.compile import find_compiler

FLAGS = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-ffp-contract=off", "-fPIC", "-shared")
LANES = 4
SMALL = 20
NAMES = ("inverse_dynamics", "forward_dynamics", "mass_matrix", "frames", "pose", "hessian_local", "jacobian_local")


def split(monkeypatch, part):
    monkeypatch.setattr(print_c, "PART", part)


def kernel_of(name):
    """One of the made-up tree on a moving base, or of a chain of it."""
    subject = make("skew, mimicking, floating")
    by_name = {kernel.name: (kernel, subject.tree) for kernel in TREE_KERNELS}
    chain = subject.model.chain("right_tip")
    kernel, of = (by_name | {kernel.name: (kernel, chain) for kernel in CHAIN_KERNELS})[name]
    return made(kernel, of).program, _layout(of)


@pytest.fixture(scope="module")
def programs():
    """Lowered once: what is printed from them differs."""
    return {name: kernel_of(name) for name in NAMES}


def build(folder, text):
    source = folder / "kernel.c"
    source.write_text(text)
    command = [*find_compiler(None).command, *FLAGS, str(source), "-o", str(source.with_suffix(".so")), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return ctypes.CDLL(str(source.with_suffix(".so")))


def parts(text, symbol="one"):
    """Body of each part function."""
    return re.findall(rf"void {symbol}_part\d+\([^{{]*\{{\n(.*?)\n\}}\n", text, re.DOTALL)


def door(program, symbol="one"):
    """The body as a function that a library exports."""
    arguments = ", ".join(f"const T *restrict {port.name}" for port in program.inputs)
    names = ", ".join(port.name for port in program.inputs)
    return f"void door({arguments}, T *restrict out);\nvoid door({arguments}, T *restrict out) {{ {symbol}_body({names}, out); }}\n"


def call(function, *arrays):
    function(*(a.ctypes.data_as(ctypes.c_void_p) for a in arrays))


@pytest.mark.compiler
@pytest.mark.parametrize(("name", "part"), [("pose", 1), ("hessian_local", 7), ("inverse_dynamics", SMALL), ("inverse_dynamics", 10**9)])
def test_split_bodies_are_the_same_to_the_last_bit(name, part, programs, monkeypatch, tmp_path):
    """The Python text does the same operations in the same order: C without contraction rounds alike, however it is cut."""
    program, _ = programs[name]
    split(monkeypatch, part)
    text = print_body(program, "one", "A body.")
    count = len(program.number)
    assert len(parts(text)) == (0 if count <= part else -(-count // part))
    library = build(tmp_path, print_file("A test", [text, door(program)]))
    scope: dict = {}
    exec(print_module("A test", [print_function(program, "A body.")]), scope)
    rng = np.random.default_rng(31)
    for _ in range(3):
        given = [rng.standard_normal(port.size) for port in program.inputs]
        out = np.full(program.output.size, np.nan)
        call(library.door, *given, out)
        assert np.array_equal(out, scope[program.name](*(x.tolist() for x in given)))


@pytest.mark.compiler
@pytest.mark.parametrize("name", ["inverse_dynamics", "mass_matrix", "jacobian_local"])
def test_split_bodies_over_a_vector_type(name, programs, monkeypatch, tmp_path):
    program, _ = programs[name]
    split(monkeypatch, SMALL)
    text = print_body(program, "one", "A body.")
    assert len(parts(text)) > 1 or len(program.number) <= SMALL
    vector = f"typedef double V __attribute__((__vector_size__({8 * LANES}), __aligned__(8), __may_alias__));\n"
    macros = vector + "#define T V\n#define K(x) ((V){0} + (x))\n"
    lanes = build(tmp_path, macros + print_file("A test", [text, door(program)]))
    (tmp_path / "one").mkdir()
    one = build(tmp_path / "one", print_file("A test", [text, door(program)]))
    rng = np.random.default_rng(32)
    given = [rng.standard_normal((port.size, LANES)) for port in program.inputs]
    out = np.empty((program.output.size, LANES))
    call(lanes.door, *given, out)
    for lane in range(LANES):
        single = np.empty(program.output.size)
        call(one.door, *(np.ascontiguousarray(x[:, lane]) for x in given), single)
        assert np.array_equal(out[:, lane], single)


@pytest.mark.compiler
@pytest.mark.parametrize("name", ["inverse_dynamics", "hessian_local"])
def test_entries_of_split_bodies(name, programs, monkeypatch, tmp_path):
    """From q, one by one and in batches, with the base's motor passed on; NaN is reported."""
    program, layout = programs[name]
    values = {}
    for part in (10**9, SMALL):
        split(monkeypatch, part)
        folder = tmp_path / str(part)
        folder.mkdir()
        library = build(folder, print_file("A test", [print_body(program, "one", "A body."), print_entries(program, "one", layout)]))
        rng = np.random.default_rng(33)
        given = [rng.standard_normal((5, layout.nq)), *(rng.standard_normal((5, p.size)) for p in program.inputs if p.name in ("v", "a"))]
        out = np.empty((5, program.output.size))
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (*given, out)]
        assert library.one_batch(ctypes.c_int64(5), *pointers) == 0
        single = np.full((4, program.output.size), np.nan)
        assert library.one(*(a[3].ctypes.data_as(ctypes.c_void_p) for a in (*given, single))) == 0
        assert np.array_equal(single[3], out[3])
        values[part] = out.copy()
        given[0][2, 0] = np.nan
        assert library.one_batch(ctypes.c_int64(5), *pointers) == 1
    assert np.array_equal(values[SMALL], values[10**9])


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("part", [3, SMALL])
def test_the_text_of_parts(name, part, programs, monkeypatch):
    """No part is longer than allowed, each value handed on is written once and only read later, each output is written once."""
    program, _ = programs[name]
    split(monkeypatch, part)
    bodies = parts(print_body(program, "one", "A body."))
    if len(program.number) <= part:
        assert not bodies
        return
    operations = [re.findall(r"const T (t\d+) = ", body) for body in bodies]
    assert all(len(found) == part for found in operations[:-1]) and 1 <= len(operations[-1]) <= part
    assert sum(map(len, operations)) == len(program.number) == program.counts().total
    written: set[str] = set()
    outputs: list[str] = []
    for body, own in zip(bodies, operations, strict=True):
        lines = body.splitlines()
        here = {line.split()[0] for line in lines if re.match(r"    w\[\d+\] = ", line)}
        assert not here & written
        read = {found for line in lines for found in re.findall(r"w\[\d+\]", line.split(" = ", 1)[-1]) if " = " in line}
        assert read <= written  # from earlier parts, never from this one
        assert {found for line in lines for found in re.findall(r"\bt\d+\b", line)} <= set(own)
        written |= here
        outputs += re.findall(r"    (out\[\d+\]) = ", body)
    assert sorted(outputs) == sorted(f"out[{k}]" for k in range(program.output.size))
    (size,) = re.findall(r"T w\[(\d+)\];", print_body(program, "one", "A body."))
    assert written == {f"w[{k}]" for k in range(int(size))}


def test_values_handed_on_are_those_that_later_parts_read(programs):
    program, _ = programs["inverse_dynamics"]
    order = sorted(program.number, key=program.number.__getitem__)
    cut = [set(order[k : k + SMALL]) for k in range(0, len(order), SMALL)]
    kept = print_c._kept(program, cut)
    home = {node: k for k, part in enumerate(cut) for node in part}
    needed = {a for node in order for a in program.nodes[node].args if a in home and home[a] < home[node]}
    assert set(kept) == needed and sorted(kept.values()) == list(range(len(needed)))


def test_kernels_of_a_humanoid_are_split():
    """The largest of the G1's: its derivative of inverse dynamics by q."""
    kernel = next(k for k in TREE_KERNELS if k.name == "inverse_dynamics_by_q")
    tree = Tree.of(load_bundled("g1"))
    found = made(kernel, tree).program
    text = print_body(found, "one", "A body.")
    bodies = parts(text)
    count = found.counts().total
    assert len(bodies) == -(-count // print_c.PART) > 1
    assert max(len(re.findall("const T ", body)) for body in bodies) == print_c.PART
    assert print_entries(found, "one", _layout(tree)).count("one_body(") == 1


def test_a_kernel_without_operations(monkeypatch):
    """Outputs that are inputs and constants: one body, even at the smallest part."""
    x = casadi.SX.sym("x", 2)
    program = lower("one", [(Port("x", (2,)), x)], Port("out", (3,)), [x[1], 0.5, -x[0]])
    split(monkeypatch, 1)
    text = print_body(program, "one", "A body.")
    assert text.count("one_body(") == 1 and "out[0] = x[1];" in text and "out[1] = K(0.5);" in text and "out[2] = -x[0];" in text
