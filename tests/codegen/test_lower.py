"""Lowering: an expression in, the printed assignments out; values against casadi's own evaluation; what cannot be printed is refused."""

import ast
import re

import casadi
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import LoweringError, Port, Program, lower
from cga_codegen.emit.print_c import print_body, print_entries, print_file
from cga_codegen.emit.print_python import print_function, print_module

X = casadi.SX.sym("x", 4)
A, B, C, D = X.elements()


def lowered(*expressions) -> Program:
    return lower("f", [(Port("x", (4,)), X)], Port("out", (len(expressions),)), expressions)


def printed(*expressions) -> str:
    """The body of the Python text, one statement a line."""
    return "\n".join(line.strip() for line in print_function(lowered(*expressions), "d").splitlines()[4:])


def sum_of_products(count):
    """((a b + a b) c + (a b + a b) c) ...: a tree of 2^count leaves, written as a chain."""
    value = A * B
    for k in range(count):
        value = value * X[k % 4] + value * X[k % 4]
    return value


# what goes in, and what must come out: the names of temporaries and the order of operands are part of the format
TEXTS = [
    ("a product and its negations", lambda: (-A * B, A * -B, -(A * B), -A * -B), "t0 = x[0]*x[1]\nreturn (-t0, -t0, -t0, t0,)"),
    ("a quotient and its negations", lambda: (-A / B, A / -B, -A / -B), "t0 = x[0]/x[1]\nreturn (-t0, -t0, t0,)"),
    ("a difference both ways", lambda: (A - B, B - A), "t0 = x[0]-x[1]\nreturn (t0, -t0,)"),
    ("a sum with both signs", lambda: (A + B, B + A, -A - B), "t0 = x[0]+x[1]\nreturn (t0, t0, -t0,)"),
    ("signs carried to the output", lambda: ((-A - B) * (C - D),), "t0 = x[0]+x[1]\nt1 = x[2]-x[3]\nt2 = t0*t1\nreturn (-t2,)"),
    ("neutral elements", lambda: (A * 1, 1 * A, A + 0, 0 + A, A - 0, A / 1), "return (x[0], x[0], x[0], x[0], x[0], x[0],)"),
    ("minus one", lambda: (A * -1, A / -1, 0 - A), "return (-x[0], -x[0], -x[0],)"),
    ("zero", lambda: (A * 0, 0 / A, A - A, 0 * (A + B)), "return (0.0, 0.0, 0.0, 0.0,)"),
    ("a zero that only numbering sees", lambda: ((A - B) + (B - A), (A * B) * C - C * (B * A)), "return (0.0, 0.0,)"),
    ("twice", lambda: (A + A, 2 * A), "t0 = x[0]*2.0\nreturn (t0, t0,)"),
    ("twice, seen by numbering only", lambda: ((A - B) - (B - A),), "t0 = x[0]-x[1]\nt1 = t0*2.0\nreturn (t1,)"),
    ("division by a power of two", lambda: (A / 4, A / -0.5), "t0 = x[0]*0.25\nt1 = x[0]*2.0\nreturn (t0, -t1,)"),
    ("division by another number", lambda: (A / 3, A / -3), "t0 = x[0]/3.0\nreturn (t0, -t0,)"),
    ("a reciprocal", lambda: (1 / A, -2 / A), "t0 = 1.0/x[0]\nt1 = 2.0/x[0]\nreturn (t0, -t1,)"),
    ("a power of two without a finite reciprocal", lambda: (A / 5e-324,), "t0 = x[0]/5e-324\nreturn (t0,)"),
    ("squares", lambda: (A**2, A * A, A**3), "t0 = x[0]*x[0]\nt1 = x[0]*t0\nreturn (t0, t0, t1,)"),
    ("common parts once", lambda: ((A + B) * C, D * (B + A)), "t0 = x[0]+x[1]\nt1 = t0*x[2]\nt2 = t0*x[3]\nreturn (t1, t2,)"),
    ("common parts up to sign", lambda: ((A - B) * C, (B - A) * D), "t0 = x[0]-x[1]\nt1 = t0*x[2]\nt2 = t0*x[3]\nreturn (t1, -t2,)"),
    ("dead code", lambda: (A + 0 * (B * C * D), B), "return (x[0], x[1],)"),
    ("constants", lambda: (casadi.SX(0.1), casadi.SX(-3), 0.1 - A), "t0 = 0.1-x[0]\nreturn (0.1, -3.0, t0,)"),
    ("constants fold", lambda: (((A - B) + (B - A) + 3) * 4 + 1,), "return (13.0,)"),
    ("a root keeps its sign", lambda: (casadi.sqrt(-A),), "t0 = 0.0-x[0]\nt1 = root(t0)\nreturn (t1,)"),
]


@pytest.mark.parametrize(("expressions", "text"), [row[1:] for row in TEXTS], ids=[row[0] for row in TEXTS])
def test_text_of_small_expressions(expressions, text):
    assert printed(*expressions()) == text


def test_a_shared_tree_stays_linear():
    counts = lowered(sum_of_products(200)).counts()
    assert counts.total == 1 + 2 * 200 and counts.additions == 0  # a chain of 200 doublings and products, not 2^200 leaves


def test_c_text_of_a_small_function():
    program = lowered((A - B) * 0.5, B - A, casadi.SX(-2))
    assert print_body(program, "s", "Half.") == (
        "/* Half.\n   1 mul, 1 add, 0 div, 0 sqrt. */\n"
        "static inline void s_body(const T *restrict x, T *restrict out)\n{\n"
        "    const T t0 = x[0] - x[1];\n    const T t1 = K(0.5) * t0;\n"
        "    out[0] = t1;\n    out[1] = -t0;\n    out[2] = -K(2.0);\n}\n"
    )
    assert "    (void)x;\n" in print_body(lowered(casadi.SX(1)), "s", "An input that nobody reads makes no warning.")


def test_entries_turn_angles_and_displacements_into_pairs():
    pairs = [(Port(name, (2,)), casadi.SX.sym(name, 2)) for name in ("c", "s")]
    program = lower("f", pairs, Port("out", (1,)), [pairs[0][1][0] * pairs[1][1][1]])
    motions = ((0, 1.0, False), (1, 1.0, False)), ((0, 1.0, False), (1, 1.0, True)), ((1, -0.5, False), (0, 2.0, True))
    layouts = [Layout(("i", "j"), ("revolute", "continuous" if k == 0 else "prismatic"), motion) for k, motion in enumerate(motions)]
    turning, mixed, following = (print_entries(program, "s", layout) for layout in layouts)
    assert "for (int j = 0; j < 2; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }" in turning
    assert "c[0] = cos(q[0]); s[0] = sin(q[0]);" in mixed and "c[1] = 1.0; s[1] = q[1];" in mixed
    assert "c[0] = cos((-0.5 * q[1])); s[0] = sin((-0.5 * q[1]));" in following and "s[1] = (2.0 * q[0]);" in following


# ---- values


CONSTANTS = (0.0, 1.0, -1.0, 2.0, 0.5, -0.25, 3.0, 0.1, -7.3, 1e-3)
STEPS = st.lists(st.tuples(st.sampled_from("+-*/n"), st.integers(0, 10**6), st.integers(0, 10**6)), min_size=1, max_size=25)


def graph(steps):
    """Expressions that refer to earlier ones by number, inputs and constants first: all values, and the reciprocals of denominators."""
    pool, reciprocals = [A, B, C, D, *map(casadi.SX, CONSTANTS)], []
    for op, i, j in steps:
        x, y = pool[i % len(pool)], pool[j % len(pool)]
        if op == "/":
            reciprocals.append(1 / y)
        pool.append(x / y if op == "/" else {"+": x + y, "-": x - y, "*": x * y, "n": -x}[op])
    return pool, reciprocals


def outputs(steps):
    """The last values of the graph."""
    return graph(steps)[0][-min(len(steps), 4) :]


def by_casadi(expressions, values):
    return np.array(casadi.Function("f", [X], [casadi.vertcat(*expressions)])(values)).ravel()


@settings(max_examples=400, deadline=None, derandomize=True)
@given(STEPS, st.lists(st.floats(-4, 4, allow_subnormal=False), min_size=4, max_size=4))
def test_values_are_casadis_to_the_last_bit(steps, values):
    """Numbering only moves signs, swaps operands of + and *, and divides by powers of two exactly: no rounding may change."""
    pool, reciprocals = graph(steps)
    inside = by_casadi([*pool, *reciprocals], values)
    # beyond overflow, underflow and divisions by zero x * 0 = 0 does not hold, nor does division by exact reciprocals
    assume(np.isfinite(inside).all() and np.all((inside == 0) | (np.abs(inside) > 1e-150)) and np.abs(inside).max() < 1e150)
    space = {}
    exec(print_function(lowered(*outputs(steps)), "d"), space)
    assert np.array_equal(np.array(space["f"](np.array(values)), dtype=float), by_casadi(outputs(steps), values))


# ---- counts


def recount(text):
    """Multiplications, additions, divisions and roots of a printed Python function, and the negations in what it returns."""
    nodes = list(ast.walk(ast.parse(text)))
    operators = [type(node.op) for node in nodes if isinstance(node, ast.BinOp)]
    negations = sum(isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub) for node in nodes)
    kinds = (ast.Mult, (ast.Add, ast.Sub), ast.Div, ast.Pow)
    return (*(sum(issubclass(op, kind) for op in operators) for kind in kinds), negations)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(STEPS)
def test_counts_are_those_of_the_printed_text(steps):
    try:
        program = lowered(*outputs(steps))
    except LoweringError as error:
        assert "zero" in str(error)  # a random denominator that is always zero
        return
    counts = program.counts()
    found = (counts.multiplications, counts.additions, counts.divisions, counts.roots, counts.negations)
    assert recount(print_function(program, "d")) == found
    assert counts.total == sum(found[:4])
    body = print_body(program, "s", "d").partition("{\n")[2]
    symbols = [len(re.findall(pattern, body)) for pattern in (r" \* ", r" [+-] ", r" / ")]
    assert symbols == list(found[:3])


# ---- refusals


def test_trigonometry_is_counted_but_never_printed():
    """Odd and even: sin(-x) is -sin(x), cos(-x) is cos(x). Only yardsticks (program_by_differentiation) hold such programs."""
    program = lowered(casadi.sin(A), casadi.sin(-A), casadi.cos(A), casadi.cos(-A))
    assert [node.op for node in program.nodes] == ["input", "sin", "cos"] and program.counts().negations == 1
    for op, program in (("sin", lowered(casadi.sin(A))), ("cos", lowered(casadi.cos(A)))):
        with pytest.raises(LoweringError, match=f"^f: {op} has no printed form; kernels take what is trigonometric as inputs$"):
            print_function(program, "d")
        with pytest.raises(LoweringError, match=f"^f: {op} has no form on a vector type"):
            print_body(program, "s", "d")
    assert "t0 = ROOT(x[0]);" in print_body(lowered(casadi.sqrt(A)), "s", "d")


REFUSED = [
    (lambda: casadi.SX.inf() * A, "^f: the constant inf"),
    (lambda: A + casadi.SX.nan(), "^f: the constant nan"),
    (lambda: A / 0, "^f: the constant inf .from a division by zero"),
    (lambda: C / ((A - B) + (B - A)), "^f: division by the constant zero$"),  # casadi does not see this zero
    (lambda: (A * 0 + 1e300) * (B * 0 + 1e300), "^f: the constant inf .*overflow"),
    (lambda: casadi.fabs(A), "^f: casadi's OP_FABS has no printed form; kernels may use"),
    (lambda: casadi.if_else(A > 0, B, C), "^f: casadi's OP_LT has no printed form"),
]


@pytest.mark.parametrize(("expression", "message"), REFUSED, ids=[message for _, message in REFUSED])
def test_what_has_no_text_is_refused_by_name(expression, message):
    with pytest.raises(LoweringError, match=message):
        lowered(expression())


def test_a_wrong_number_of_values_is_refused():
    with pytest.raises(LoweringError, match=r"^f: 2 values for an output of shape \(3,\)$"):
        lower("f", [(Port("x", (4,)), X)], Port("out", (3,)), [A, B])


BANNERS = [  # a banner, and whether a C comment and a Python docstring can hold it
    ("Kinematics of RHand; a_x2f_b, 5 %", True, True),
    ('x"""+print()+"""', True, False),
    ("x\\", False, False),
    ("x*/ int evil; /*", False, True),
    ("x*\\\n/", False, False),
    ("x*??/\n/", False, True),
]


@pytest.mark.parametrize(("banner", "in_c", "in_python"), BANNERS)
def test_a_banner_stays_inside_its_comment(banner, in_c, in_python):
    for printer, sound in ((print_file, in_c), (print_module, in_python)):
        if sound:
            assert printer(banner, []).startswith({print_file: f"/* {banner} */\n", print_module: f'"""{banner}"""\n'}[printer])
        else:
            with pytest.raises(LoweringError, match="can hold") as refusal:
                printer(banner, [])
            assert repr(banner) in str(refusal.value)
