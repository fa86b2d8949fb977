"""The printed products: counts of paper A (corrected), and the JSON, Python and C texts against exact multivectors."""

import ast
import ctypes
import json
import os
import shutil
import subprocess
import sys
from fractions import Fraction

import casadi
import numpy as np
import pytest

from cga_codegen.algebra import blade_types as bt
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.emit.print_products import CATALOGUE, FUNCTIONS, SHIFT, Product, product_files

FILES = product_files()
TABLES = json.loads(FILES["algebra/products.json"])

# multiplications and additions of each printed product: paper A, section 5.9, corrected
COUNTS = {
    "rotor_rotor": (16, 12), "translator_rotor": (16, 8), "rotor_translator": (16, 8), "motor_translator": (20, 12),
    "motor_rotor": (32, 24), "motor_motor": (48, 40), "motor_dilator": (16, 4), "motor_similarity": (80, 68),
    "similarity_motor": (80, 68), "similarity_similarity": (128, 116),
    "outer_point_point": (20, 10), "outer_point_pair_point": (30, 20), "outer_circle_point": (20, 15),
    "sandwich_motor_origin": (48, 31), "sandwich_motor_point": (80, 59), "sandwich_motor_line": (72, 58),
    "sandwich_motor_plane": (48, 36), "sandwich_motor_point_pair": (160, 134), "sandwich_motor_circle": (160, 134),
    "sandwich_motor_sphere": (80, 59), "sandwich_similarity_point": (120, 99), "sandwich_similarity_line": (132, 114),
    "sandwich_similarity_plane": (84, 68), "sandwich_similarity_point_pair": (240, 214), "sandwich_similarity_circle": (240, 214),
    "sandwich_similarity_sphere": (120, 99), "sandwich_motor_similarity_bivector": (96, 77),
    "sandwich_similarity_similarity_bivector": (152, 133),
}  # fmt: skip


@pytest.fixture(scope="module")
def printed():
    """The functions of the Python text, by name."""
    space = {}
    exec(compile(FILES["algebra/products.py"], "products.py", "exec"), space)
    return space


def fractions(rng, count):
    return [Fraction(int(rng.integers(-9, 10)), int(rng.integers(1, 7))) for _ in range(count)]


def of_table(entry, a, b):
    """The product by typed multivectors: for a sandwich, two full products and then the projection."""
    x, y = Multivector(entry.a, tuple(a)), Multivector(entry.b, tuple(b))
    if entry.rule == "sandwich":
        return (x * y * ~x).project(entry.result).coefficients
    return (x * y if entry.rule == "geometric" else x ^ y).coefficients


def test_every_row_of_the_paper_is_printed_with_its_counts():
    assert {p.name: (p.multiplications, p.additions) for p in CATALOGUE} == COUNTS
    assert {p["name"]: (p["multiplications"], p["additions"]) for p in TABLES["products"]} == COUNTS
    costs = {f.name: f.cost for f in FUNCTIONS}
    assert all(costs[name] == f"{m} mul, {a} add" for name, (m, a) in COUNTS.items())
    assert TABLES["forms"] == {
        "triangular_triangular": "64 mul, 52 add",
        "similarity_to_triangular": "8 add",
        "triangular_to_similarity": "8 add, 8 halvings",
        "motor_origin_position": "12 mul, 9 add, 3 doublings",
        "motor_origin_point": "15 mul, 11 add, 3 doublings, 1 halving",
    }


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.name)
def test_the_operations_in_the_text_are_the_stated_ones(function):
    """Counted in the syntax tree of the Python text; times 2 is a doubling, over 2 a halving."""
    counts = dict.fromkeys(("mul", "add", "doubling", "halving"), 0)
    for tree in ast.parse(FILES["algebra/products.py"]).body:
        if isinstance(tree, ast.FunctionDef) and tree.name == function.name:
            for node in ast.walk(tree):
                if isinstance(node, ast.BinOp):
                    constant = isinstance(node.left, ast.Constant) or isinstance(node.right, ast.Constant)
                    kind = {ast.Mult: "doubling" if constant else "mul", ast.Div: "halving", ast.Add: "add", ast.Sub: "add"}
                    counts[kind[type(node.op)]] += 1
    stated = {word.removesuffix("s"): int(number) for number, word in map(str.split, function.cost.split(", "))}
    assert {k: n for k, n in counts.items() if n} == stated


@pytest.mark.parametrize("entry", CATALOGUE, ids=lambda p: p.name)
def test_python_text_and_json_equal_the_multivectors_exactly(entry, printed):
    rng = np.random.default_rng(11)
    (record,) = (r for r in TABLES["products"] if r["name"] == entry.name)
    for _ in range(3):
        a, b = fractions(rng, len(entry.a)), fractions(rng, len(entry.b))
        expected = of_table(entry, a, b)
        assert printed[entry.name](a, b) == expected
        left, right = a, b
        for step in record["steps"]:
            result = [Fraction(0)] * len(step["result"])
            for i, j, k, c in step["terms"]:
                result[k] += c * left[i] * right[j]
            left, right = result, a
        assert tuple(result) == expected
        assert TABLES["types"][record["result"]] == record["steps"][-1]["result"]


def unit_rotor(rng):
    """A rational rotor of length one: the square of a quaternion over its norm."""
    q = Multivector(bt.ROTOR, tuple(fractions(rng, 4)))
    size = (q * ~q).coefficient(0)
    return (q * q).scaled(1 / size)


def unit_motor(rng):
    return Multivector(bt.TRANSLATOR, (1, *fractions(rng, 3))) * unit_rotor(rng)


def test_triangular_form_equals_the_table_product(printed):
    """For all elements with the twelve components, valid or not: proved with 24 free variables, and shown on rationals."""
    from sympy import QQ
    from sympy.polys.rings import ring

    variables = ring([f"{name}{k}" for name in "ab" for k in range(12)], QQ)[1:]
    rng = np.random.default_rng(5)
    for a, b in ((variables[:12], variables[12:]), (fractions(rng, 12), fractions(rng, 12))):
        forth = printed["similarity_to_triangular"]
        product = printed["triangular_triangular"](forth(a), forth(b))
        assert printed["triangular_to_similarity"](product) == printed["similarity_similarity"](a, b)
        assert printed["triangular_to_similarity"](forth(a)) == tuple(a)


def test_triangular_parts_of_a_similarity_are_the_scaled_rotor_and_the_shift(printed):
    rng = np.random.default_rng(6)
    rotor, s = unit_rotor(rng), Fraction(3, 2)
    v = Multivector(bt.TRANSLATOR, (1, *fractions(rng, 3))) * rotor * Multivector(bt.DILATOR, ((s + 1 / s) / 2, (s - 1 / s) / 2))
    form = printed["similarity_to_triangular"](v.coefficients)
    assert form[:4] == rotor.scaled(s).coefficients
    assert form[4:8] == rotor.scaled(1 / s).coefficients
    assert form[8:] == v.project(SHIFT).coefficients


def test_motor_on_the_origin_equals_the_sandwich(printed):
    rng = np.random.default_rng(8)
    for _ in range(10):
        motor = unit_motor(rng)
        e0, *point = printed["sandwich_motor_origin"](motor.coefficients, (1,))
        assert e0 == 1
        assert printed["motor_origin_position"](motor.coefficients) == tuple(point[:3])
        assert printed["motor_origin_point"](motor.coefficients) == tuple(point)


def test_projected_sandwiches_lose_nothing_on_valid_versors():
    rng = np.random.default_rng(9)
    s = Fraction(4, 3)
    motor = unit_motor(rng)
    versors = {"motor": motor, "similarity": motor * Multivector(bt.DILATOR, ((s + 1 / s) / 2, (s - 1 / s) / 2))}
    for entry in CATALOGUE:
        if entry.rule == "sandwich":
            v, x = versors[entry.a.name], Multivector(entry.b, tuple(fractions(rng, len(entry.b))))
            full = v * x * ~v
            dropped = [full.coefficient(m) for m in full.type.masks if m not in entry.result.masks]
            assert dropped and not any(dropped), entry.name


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.name)
def test_python_text_takes_arrays_and_casadi_symbols(function, printed):
    rng = np.random.default_rng(2)
    run = printed[function.name]
    batch = [rng.integers(-9, 10, (size, 4)).astype(float) for _, size in function.inputs]
    found = np.array(run(*batch))
    rows = [run(*[x[:, k].tolist() for x in batch]) for k in range(4)]
    assert np.array_equal(found, np.array(rows).T)
    symbols = [casadi.SX.sym(name, size) for name, size in function.inputs]
    compiled = casadi.Function(function.name, symbols, [casadi.vertcat(*run(*symbols))])
    assert np.array_equal(np.array(compiled(*[x[:, 0] for x in batch])).ravel(), found[:, 0])


def compiler():
    """The command of a C compiler: $CC, the usual names, or the one that comes with the ziglang package."""
    names = [os.environ.get("CC", ""), "cc", "gcc", "clang"]
    found = next((path for name in names if name and (path := shutil.which(name))), None)
    return [found] if found else [sys.executable, "-m", "ziglang", "cc"]


def compiled(folder, number, ctype):
    """The C header with one exported entry per function, compiled without a warning."""
    (folder / "cga_products.h").write_text(FILES["algebra/cga_products.h"])
    lines = [f"#define T {number}" if number != "double" else "", '#include "cga_products.h"', '#include "cga_products.h"']
    for f in FUNCTIONS:
        arguments = ", ".join(f"const {number} *{name}" for name, _ in f.inputs)
        names = ", ".join(name for name, _ in f.inputs)
        lines.append(f"void run_{f.name}({arguments}, {number} *out);")
        lines.append(f"void run_{f.name}({arguments}, {number} *out) {{ cga_{f.name}({names}, out); }}")
    (folder / "entry.c").write_text("\n".join(lines) + "\n")
    flags = "-std=c99 -O1 -Wall -Wextra -Wpedantic -Werror -shared -fPIC".split()
    done = subprocess.run([*compiler(), *flags, "-o", "entry.so", "entry.c"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return ctypes.CDLL(str(folder / "entry.so")), ctype


@pytest.fixture(scope="module", params=[("double", ctypes.c_double), ("float", ctypes.c_float)], ids=["double", "float"])
def library(request, tmp_path_factory):
    return compiled(tmp_path_factory.mktemp(request.param[0]), *request.param)


@pytest.mark.parametrize("function", FUNCTIONS, ids=lambda f: f.name)
@pytest.mark.compiler
def test_compiled_c_equals_the_python_text(function, library, printed):
    """On small integers, where floating point is exact; also with the output laid over the first input."""
    shared, number = library
    rng = np.random.default_rng(4)
    inputs = [rng.integers(-4, 5, size).astype(float).tolist() for _, size in function.inputs]
    expected = list(printed[function.name](*inputs))
    entry = getattr(shared, f"run_{function.name}")
    room = max(len(expected), *(len(x) for x in inputs))
    buffers = [(number * room)(*x) for x in inputs]
    out = (number * room)()
    entry(*buffers, out)
    assert out[: len(expected)] == expected
    entry(*buffers, buffers[0])
    assert buffers[0][: len(expected)] == expected


@pytest.mark.compiler
def test_c_text_takes_a_vector_type(tmp_path, printed):
    """Four products at once in the lanes of a compiler vector."""
    (tmp_path / "cga_products.h").write_text(FILES["algebra/cga_products.h"])
    (tmp_path / "lanes.c").write_text(
        "typedef double lanes __attribute__((vector_size(32), aligned(8)));\n#define T lanes\n"
        '#include "cga_products.h"\nvoid run(const lanes *a, lanes *out) { cga_motor_origin_point(a, out); }\n'
    )
    done = subprocess.run([*compiler(), *"-O1 -shared -fPIC -o lanes.so lanes.c".split()], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    motors = np.random.default_rng(4).integers(-4, 5, (8, 4)).astype(float)
    out = np.zeros((4, 4))
    double_p = ctypes.POINTER(ctypes.c_double)
    ctypes.CDLL(str(tmp_path / "lanes.so")).run(motors.ctypes.data_as(double_p), out.ctypes.data_as(double_p))
    assert np.array_equal(out, np.array(printed["motor_origin_point"](motors)))


def test_c_and_python_state_the_same_lines():
    """Line by line, so that what is shown of the Python text holds for the C text without a compiler."""
    python, c = {}, {}
    for tree in ast.parse(FILES["algebra/products.py"]).body:
        if isinstance(tree, ast.FunctionDef):
            python[tree.name] = [ast.unparse(s) for s in tree.body if isinstance(s, ast.Assign) and isinstance(s.targets[0], ast.Name)]
    for text in FILES["algebra/cga_products.h"].split("static inline void cga_")[1:]:
        statements = [s.strip().removeprefix("const T ") for s in text[text.index("{") + 1 : text.index("}")].split(";")]
        c[text[: text.index("(")]] = [ast.unparse(ast.parse(s)) for s in statements if s and "[" not in s]
    assert list(python) == list(c) == [f.name for f in FUNCTIONS]
    for name, lines in python.items():
        assert [s for s in lines if "[" not in s] == c[name]


def test_json_lists_the_whole_geometric_product():
    rng = np.random.default_rng(12)
    a, b = fractions(rng, 32), fractions(rng, 32)
    result = [Fraction(0)] * 32
    for i, j, k, c in TABLES["geometric"]:
        result[k] += c * a[i] * b[j]
    assert tuple(result) == (Multivector(bt.FULL, tuple(a)) * Multivector(bt.FULL, tuple(b))).coefficients
    assert len(TABLES["geometric"]) == 1024
    assert TABLES["basis"] == ["e0", "e1", "e2", "e3", "ei"] and TABLES["gram"][0] == [0, 0, 0, 0, -1]


def test_texts_are_the_same_bytes_in_another_process_and_carry_the_banner():
    code = "import sys; from cga_codegen.emit.print_products import product_files; sys.stdout.write(repr(product_files()))"
    environment = {**os.environ, "PYTHONHASHSEED": "123", "PYTHONPATH": os.pathsep.join(sys.path)}
    again = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True)
    assert ast.literal_eval(again.stdout) == FILES
    assert sorted(FILES) == ["algebra/cga_products.h", "algebra/products.json", "algebra/products.py"]
    for text in FILES.values():
        assert "do not edit: cga generate" in text and text.endswith("\n") and text.isascii()
    assert all(len(line) <= 140 for name, text in FILES.items() if not name.endswith("json") for line in text.splitlines())


def test_a_name_says_the_rule():
    assert Product("outer", bt.POINT, bt.POINT).name == "outer_point_point"
    assert Product("geometric", bt.MOTOR, bt.MOTOR).name == "motor_motor"
    assert Product("sandwich", bt.MOTOR, bt.LINE, bt.LINE).name == "sandwich_motor_line"
