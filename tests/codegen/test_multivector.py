"""Typed multivectors: laws on exact random elements, result types, and scalars of every kind."""

from fractions import Fraction
from itertools import product as tuples

import casadi
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

from cga_codegen.algebra import blade_types as bt
from cga_codegen.algebra.blade_types import BladeType, product_table, product_type, type_of, unary_table
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA, G3, G51, PGA, AlgebraError, Signature

LAWS = settings(max_examples=25, derandomize=True, deadline=None)
FULL = {s.name: BladeType(f"all of {s.name}", s.blades, s) for s in (G3, PGA, CGA, G51)}
numbers = st.one_of(st.just(0), st.fractions(-4, 4, max_denominator=6))


def elements(kind):
    """Random exact elements of a type; zeros (the int 0 among them) are frequent."""
    return st.lists(numbers, min_size=len(kind), max_size=len(kind)).map(lambda values: Multivector(kind, tuple(values)))


def triples(*names):
    return st.sampled_from(names or sorted(FULL)).flatmap(lambda n: st.tuples(*[elements(FULL[n])] * 3))


def same(left, right):
    """Equal in every blade, whatever the types."""
    masks = {*left.type.masks, *right.type.masks}
    return all(left.coefficient(m) == right.coefficient(m) for m in masks)


@LAWS
@given(triples())
def test_geometric_product_is_associative_and_distributive(abc):
    a, b, c = abc
    assert same((a * b) * c, a * (b * c))
    assert same(a * (b + c), a * b + a * c)
    assert same((a - b) * c, a * c - b * c)
    assert same(-a * b, -(a * b))


@LAWS
@given(triples())
def test_outer_and_regressive_products_are_associative(abc):
    a, b, c = abc
    assert same((a ^ b) ^ c, a ^ (b ^ c))
    assert same(a.regressive(b).regressive(c), a.regressive(b.regressive(c)))


@LAWS
@given(triples())
def test_contraction_is_adjoint_to_the_outer_product(abc):
    a, b, c = abc
    assert same((a ^ b).left_contraction(c), a.left_contraction(b.left_contraction(c)))
    assert (a ^ b).scalar_product(c) == a.scalar_product(b.left_contraction(c))
    assert (a * b).coefficient(0) == a.scalar_product(b) == b.scalar_product(a)


@LAWS
@given(triples())
def test_reversal_involution_and_commutator(abc):
    a, b, c = abc
    assert same(~(a * b), ~b * ~a)
    assert same((a * b).grade_involution(), a.grade_involution() * b.grade_involution())
    assert same(a.commutator(b).scaled(2), a * b - b * a)
    assert same(a.commutator(b * c), a.commutator(b) * c + b * a.commutator(c))  # a derivation


@LAWS
@given(triples("CGA"))
def test_dual_of_cga(abc):
    a, b, _ = abc
    assert same(a.dual().dual(), -a)
    assert same(a.dual(), a * Multivector(bt.PSEUDOSCALAR, (1,)))
    assert same((a ^ b).dual(), a.left_contraction(b.dual()))


TYPES = [t for t in bt.DECLARED if t is not bt.FULL]


@pytest.mark.parametrize("rule", ["geometric", "outer", "inner", "left_contraction", "commutator", "regressive"])
def test_typed_products_equal_products_of_full_multivectors(rule):
    rng = np.random.default_rng(3)
    methods = {"geometric": "__mul__", "outer": "__xor__", "inner": "__or__"}
    for a, b in tuples(TYPES, repeat=2):
        x, y = (Multivector(t, tuple(map(int, rng.integers(1, 9, len(t))))) for t in (a, b))
        typed = getattr(x, methods.get(rule, rule))(y)
        full = getattr(x.project(bt.FULL), methods.get(rule, rule))(y.project(bt.FULL))
        assert typed.type == product_type(rule, a, b)
        assert same(typed, full), (rule, a.name, b.name)


@pytest.mark.parametrize(
    ("rule", "a", "b", "result"),
    [
        ("geometric", bt.ROTOR, bt.ROTOR, "rotor"),
        ("geometric", bt.TRANSLATOR, bt.TRANSLATOR, "translator"),
        ("geometric", bt.TRANSLATOR, bt.ROTOR, "motor"),
        ("geometric", bt.MOTOR, bt.MOTOR, "motor"),
        ("geometric", bt.MOTOR, bt.DILATOR, "similarity"),
        ("geometric", bt.SIMILARITY, bt.SIMILARITY, "similarity"),
        ("geometric", bt.DILATOR, bt.DILATOR, "dilator"),
        ("outer", bt.POINT, bt.POINT, "point_pair"),
        ("outer", bt.POINT_PAIR, bt.POINT, "circle"),
        ("outer", bt.CIRCLE, bt.POINT, "sphere"),
        ("commutator", bt.TWIST, bt.TWIST, "twist"),
        ("commutator", bt.SIMILARITY_BIVECTOR, bt.SIMILARITY_BIVECTOR, "twist"),
        ("commutator", bt.TWIST, bt.POINT, "e1 e2 e3 ei"),
        ("inner", bt.SCALAR, bt.POINT, "zero"),
        ("regressive", bt.PLANE, bt.PLANE, "line"),
    ],
)
def test_result_types(rule, a, b, result):
    assert product_type(rule, a, b).name == result


def test_declared_types_are_distinct_and_hold_the_blades_of_the_paper():
    assert len({t.masks for t in bt.DECLARED}) == len({t.name for t in bt.DECLARED}) == len(bt.DECLARED)
    sizes = {t.name: len(t) for t in bt.DECLARED}
    assert sizes == {
        "scalar": 1, "rotor": 4, "translator": 4, "motor": 8, "dilator": 2, "similarity": 12, "point": 5, "point_pair": 10, "line": 6,
        "circle": 10, "plane": 4, "sphere": 5, "twist": 6, "wrench": 6, "similarity_bivector": 7, "pseudoscalar": 1, "origin": 1,
        "multivector": 32,
    }  # fmt: skip
    assert bt.SIMILARITY.blade_names == tuple("1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i".split())
    assert bt.TWIST.blade_names == tuple("e12 e13 e23 e1i e2i e3i".split())
    assert bt.WRENCH.blade_names == tuple("e01 e02 e12 e03 e13 e23".split())
    assert bt.MOTOR.index(CGA.mask("e123i")) == 7
    assert type_of((0, 17)) is bt.DILATOR and type_of((0, 3)) == BladeType("any name", (0, 3)) and type_of((0, 3)).name == "1 e01"


def test_a_product_of_casadi_symbols_has_the_counted_operations():
    a, b = casadi.SX.sym("a", 8), casadi.SX.sym("b", 8)
    x, y = (Multivector(bt.MOTOR, tuple(v[i] for i in range(8))) for v in (a, b))
    function = casadi.Function("f", [a, b], [casadi.vertcat(*(x * y).coefficients)])
    codes = [function.instruction_id(k) for k in range(function.n_instructions())]
    assert codes.count(casadi.OP_MUL) == 48
    assert codes.count(casadi.OP_ADD) + codes.count(casadi.OP_SUB) == 40
    values = np.random.default_rng(1).normal(size=(2, 8))
    numeric = Multivector(bt.MOTOR, tuple(values[0])) * Multivector(bt.MOTOR, tuple(values[1]))
    assert np.allclose(np.array(function(*values)).ravel(), numeric.coefficients, rtol=0, atol=1e-14)


def test_int_zeros_are_skipped_and_never_multiplied():
    class Counted:
        """A scalar that counts the multiplications made with it and cannot be turned into a bool."""

        made = 0

        def __mul__(self, other):
            Counted.made += 1
            return self

        __rmul__ = __mul__

        def __neg__(self):
            return self

        def __add__(self, other):
            return self

        __radd__ = __sub__ = __rsub__ = __add__

        def __bool__(self):
            raise AssertionError("a coefficient was used as a condition")

        __eq__ = None

    c = Counted()
    result = Multivector(bt.MOTOR, (c, 0, 0, 0, c, 0, 0, 0)) * Multivector(bt.MOTOR, (c, 0, 0, c, 0, 0, 0, 0))
    assert Counted.made == 4
    assert [type(x) is int for x in result.coefficients] == [False, True, True, False, False, True, True, False]
    dense = Multivector(bt.MOTOR, (c,) * 8)
    Counted.made = 0
    _ = dense * dense
    assert Counted.made == 48
    _ = (~dense).dual() + -dense - dense.grade_involution()
    assert Counted.made == 48


def test_arrays_are_batches():
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(2, 8, 3, 4))
    batch = Multivector(bt.MOTOR, tuple(a)) * Multivector(bt.MOTOR, tuple(b))
    one = Multivector(bt.MOTOR, tuple(a[:, 1, 2])) * Multivector(bt.MOTOR, tuple(b[:, 1, 2]))
    assert [c[1, 2] for c in batch.coefficients] == list(one.coefficients)


def test_symbols_stay_exact():
    x, y = sympy.symbols("x y")
    p = Multivector.from_blades(bt.POINT, e0=1, e1=x, e2=y, ei=(x**2 + y**2) / 2)
    assert sympy.expand((p * p).coefficient(0)) == 0


def test_a_table_coefficient_that_is_not_one_is_multiplied():
    skew = Signature("skew", ("e1", "e2"), ((2, 3), (3, -5)))
    kind = BladeType("vector", (1, 2), skew)
    a, b = Multivector(kind, (Fraction(1, 2), 7)), Multivector(kind, (5, Fraction(1, 3)))
    product = a * b
    assert product.coefficient(0) == 2 * Fraction(5, 2) + 3 * (Fraction(1, 6) + 35) - 5 * Fraction(7, 3)
    assert product.coefficient(3) == Fraction(1, 6) - 35


def test_sandwich_keeps_the_grades_of_the_moved_element():
    half = Fraction(1, 2)
    translator = Multivector(bt.TRANSLATOR, (1, -half, -1, -3 * half))  # by (1, 2, 3)
    origin = Multivector(bt.ORIGIN, (1,))
    moved = translator.sandwich(origin)
    assert moved.type == bt.POINT and moved.coefficients == (1, 1, 2, 3, 7)
    turn = Multivector(bt.ROTOR, (Fraction(3, 5), Fraction(-4, 5), 0, 0))  # cos(a/2) = 3/5 about +e3
    x = Multivector.from_blades(bt.POINT, e0=1, e1=1, ei=half)
    assert turn.sandwich(x).coefficients == (1, Fraction(-7, 25), Fraction(24, 25), 0, half)  # right-hand rule
    assert translator.sandwich(x, BladeType("weight", (1,))).coefficients == (1,)


def test_named_components():
    m = Multivector.from_blades(bt.MOTOR, scalar=3, e12=4, e123i=5)
    assert m.coefficients == (3, 4, 0, 0, 0, 0, 0, 5)
    assert m.at("e123i 1 e0") == m.at(["e123i", "1", "e0"]) == (5, 3, 0)
    assert m.project(bt.ROTOR).coefficients == (3, 4, 0, 0)
    assert m.project(bt.DILATOR).coefficients == (3, 0)
    assert m.scaled(2).coefficients == (6, 8, 0, 0, 0, 0, 0, 10)
    assert repr(Multivector(bt.DILATOR, (1, Fraction(1, 2)))) == "<dilator: 1=1, e0i=Fraction(1, 2)>"


def test_sums_take_the_union_of_types():
    rotor, shift = Multivector(bt.ROTOR, (1, 2, 3, 4)), Multivector.from_blades(bt.TRANSLATOR, scalar=10, e2i=5)
    assert (rotor + shift).type.masks == tuple(sorted({*bt.ROTOR.masks, *bt.TRANSLATOR.masks}))
    assert (rotor + shift).at("1 e12 e2i e3i") == (11, 2, 5, 0)
    assert (rotor - shift).at("1 e12 e2i e3i") == (-9, 2, -5, 0)
    assert (shift - rotor).at("1 e12") == (9, -2)


def test_refusals_say_what_is_accepted():
    with pytest.raises(AlgebraError, match=r"rotor has 4 components \(1 e12 e13 e23\), 3 given"):
        Multivector(bt.ROTOR, (1, 2, 3))
    with pytest.raises(AlgebraError, match="rotor has no e1i; it has scalar e12 e13 e23"):
        Multivector.from_blades(bt.ROTOR, e1i=1)
    with pytest.raises(AlgebraError, match="distinct ascending masks of CGA are needed"):
        BladeType("unsorted", (6, 1))
    with pytest.raises(AlgebraError, match="distinct ascending masks of PGA are needed"):
        BladeType("too high", (16,), PGA)
    with pytest.raises(AlgebraError, match="rotor has no e1i; it has 1 e12 e13 e23"):
        bt.ROTOR.index(CGA.mask("e1i"))
    other = Multivector(BladeType("number", (0,), PGA), (1,))
    one = Multivector(bt.SCALAR, (1,))
    with pytest.raises(AlgebraError, match="scalar lives in CGA, number in PGA: no product across signatures"):
        one * other
    with pytest.raises(AlgebraError, match="scalar and number live in different signatures: no sum"):
        one + other
    for broken in (lambda: one * 2, lambda: one ^ 2, lambda: one | 2, lambda: one + 2, lambda: one - 2):
        with pytest.raises(TypeError):
            broken()


def test_tables_are_cached_objects():
    assert product_table("geometric", bt.MOTOR, bt.MOTOR) is product_table("geometric", bt.MOTOR, bt.MOTOR)
    assert unary_table("dual", bt.POINT)[0] == bt.SPHERE
