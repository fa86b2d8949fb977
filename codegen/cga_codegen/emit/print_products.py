"""Prints the catalogue of products as data: tables (JSON), C99 and Python text, straight from the algebra's exact tables.

Counting (paper A, section 5.9, corrected): a multiplication is a nonzero table term, additions are terms minus outputs; signs are free.
A sandwich V X ~V is a double product: all of V X, then (V X) ~V on the result type only, where ~V is a change of signs in the table.
The result type is the type of X (a point for the origin e0). What is left out vanishes for every valid V (`proofs.dropped_blades`).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from cga_codegen.algebra import blade_types as bt
from cga_codegen.algebra.blade_types import BladeType, Table, product_table
from cga_codegen.algebra.products import product
from cga_codegen.algebra.signature import CGA, grade, grade_sign

WIDTH = 120
"""Longest line of the printed text."""

SHIFT = BladeType("shift", CGA.masks("e1i e2i e3i e123i"))
"""The part W of a similarity (1 e12 e13 e23 | e0i e012i e013i e023i | W) = (A | K | W): an odd quaternion times ei."""


@dataclass(frozen=True)
class Product:
    """One row of the catalogue: a rule for a binary product of a and b, or "sandwich" for a b ~a with its result type."""

    rule: str
    a: BladeType
    b: BladeType
    result: BladeType | None = None

    @property
    def name(self) -> str:
        """Function name without prefix: motor_motor, outer_point_point, sandwich_motor_line."""
        return "_".join(([] if self.rule == "geometric" else [self.rule]) + [self.a.name, self.b.name])

    @property
    def tables(self) -> tuple[Table, ...]:
        """One table, or the two of a sandwich; the signs of ~a are folded into the second."""
        if self.rule != "sandwich":
            return (product_table(self.rule, self.a, self.b),)
        assert self.result is not None, "a sandwich has a declared result"
        first = product_table("geometric", self.a, self.b)
        second = product_table("geometric", first.type, self.a, self.result.masks)
        signs = [grade_sign(grade(m)) for m in self.a.masks]
        return first, Table(second.type, tuple(tuple((i, j, c * signs[j]) for i, j, c in row) for row in second.rows))

    @property
    def multiplications(self) -> int:
        """Table terms of all steps."""
        return sum(t.multiplications for t in self.tables)

    @property
    def additions(self) -> int:
        """Terms minus outputs of all steps."""
        return sum(t.additions for t in self.tables)


_BINARY = (
    ("geometric", bt.ROTOR, bt.ROTOR), ("geometric", bt.TRANSLATOR, bt.ROTOR), ("geometric", bt.ROTOR, bt.TRANSLATOR),
    ("geometric", bt.MOTOR, bt.TRANSLATOR), ("geometric", bt.MOTOR, bt.ROTOR), ("geometric", bt.MOTOR, bt.MOTOR),
    ("geometric", bt.MOTOR, bt.DILATOR), ("geometric", bt.MOTOR, bt.SIMILARITY), ("geometric", bt.SIMILARITY, bt.MOTOR),
    ("geometric", bt.SIMILARITY, bt.SIMILARITY),
    ("outer", bt.POINT, bt.POINT), ("outer", bt.POINT_PAIR, bt.POINT), ("outer", bt.CIRCLE, bt.POINT),
)  # fmt: skip
_MOVED = (bt.POINT, bt.LINE, bt.PLANE, bt.POINT_PAIR, bt.CIRCLE, bt.SPHERE, bt.SIMILARITY_BIVECTOR)

CATALOGUE: tuple[Product, ...] = (
    *(Product(*row) for row in _BINARY),
    Product("sandwich", bt.MOTOR, bt.ORIGIN, bt.POINT),
    *(Product("sandwich", versor, x, x) for versor in (bt.MOTOR, bt.SIMILARITY) for x in _MOVED),
)
"""The products that are printed. A new one is one row."""


@dataclass(frozen=True)
class Straight:
    """A straight-line function: inputs (name, size), lines (target, expression), one output expression per component."""

    name: str
    summary: str
    cost: str
    inputs: tuple[tuple[str, int], ...]
    lines: tuple[tuple[str, str], ...]
    outputs: tuple[str, ...]


def _sum(terms: Iterable[tuple[int, str]], margin: int = 8) -> str:
    """c1 x1 + c2 x2 + ..., wrapped in brackets where it is long; a coefficient of +-1 is only a sign."""
    text, line = "", ""
    for k, (coefficient, factor) in enumerate(terms):
        sign = ("-" if coefficient < 0 else "") if k == 0 else (" - " if coefficient < 0 else " + ")
        part = sign + (factor if abs(coefficient) == 1 else f"{abs(coefficient)} * {factor}")
        if len(line) + len(part) > WIDTH - 2 * margin:
            text, line = text + line + "\n" + " " * margin, part.lstrip()
        else:
            line += part
    return f"({text}{line})" if text else line


def _table_lines(table: Table, a: str, b: str, target: str) -> tuple[tuple[str, str], ...]:
    return tuple((f"{target}{k}", _sum((c, f"{a}{i} * {b}{j}") for i, j, c in row)) for k, row in enumerate(table.rows))


def _numbered(name: str, count: int, start: int = 0) -> tuple[str, ...]:
    return tuple(f"{name}{k}" for k in range(start, start + count))


def _from_product(entry: Product) -> Straight:
    *before, last = entry.tables
    lines = _table_lines(before[0], "a", "b", "m") + _table_lines(last, "m", "a", "r") if before else _table_lines(last, "a", "b", "r")
    operation = {"geometric": "a b", "outer": "a ^ b", "sandwich": "a b ~a"}[entry.rule]
    summary = f"{operation}: {entry.a.name} and {entry.b.name} to {last.type.name} ({' '.join(last.type.blade_names)})"
    cost = f"{entry.multiplications} mul, {entry.additions} add"
    return Straight(entry.name, summary, cost, (("a", len(entry.a)), ("b", len(entry.b))), lines, _numbered("r", len(last.type)))


def _triangular_product() -> Straight:
    """p = p1 p2, m = m1 m2, W = W1 m2 + p1 W2: four products of quaternion size."""
    rotor, left, right = (product_table("geometric", *pair) for pair in ((bt.ROTOR, bt.ROTOR), (SHIFT, bt.ROTOR), (bt.ROTOR, SHIFT)))

    def at(table: Table, k: int, a: int, b: int) -> list[tuple[int, str]]:
        return [(c, f"a{a + i} * b{b + j}") for i, j, c in table.rows[k]]

    rows = [at(rotor, k, 0, 0) for k in range(4)] + [at(rotor, k, 4, 4) for k in range(4)]
    rows += [at(left, k, 8, 4) + at(right, k, 0, 8) for k in range(4)]
    multiplications = sum(map(len, rows))
    cost = f"{multiplications} mul, {multiplications - len(rows)} add"
    summary = "a b of similarities in triangular form (p | m | W): p = p1 p2, m = m1 m2, W = W1 m2 + p1 W2"
    lines = tuple((f"r{k}", _sum(row)) for k, row in enumerate(rows))
    return Straight("triangular_triangular", summary, cost, (("a", 12), ("b", 12)), lines, _numbered("r", 12))


def _conversions() -> tuple[Straight, Straight]:
    """Between the twelve components of a similarity (A | K | W, interleaved by mask order) and (p | m | W), p = A + K, m = A - K."""
    groups = (bt.ROTOR.masks, CGA.masks("e0i e012i e013i e023i"), SHIFT.masks)
    scalar, even, shift = (tuple(bt.SIMILARITY.index(m) for m in masks) for masks in groups)
    pairs = tuple(zip(scalar, even, strict=True))
    forth = tuple((f"r{k}", f"a{i} {sign} a{j}") for k, (sign, i, j) in enumerate((s, i, j) for s in "+-" for i, j in pairs))
    back = {i: (f"r{i}", f"(a{k} + a{k + 4}) / 2") for k, i in enumerate(scalar)}
    back |= {j: (f"r{j}", f"(a{k} - a{k + 4}) / 2") for k, j in enumerate(even)}
    placed = {i: f"a{8 + k}" for k, i in enumerate(shift)}
    return (
        Straight("similarity_to_triangular", "similarity to (p | m | W): p = A + K = s R, m = A - K = R/s, d = s^2", "8 add",
                 (("a", 12),), forth, (*_numbered("r", 8), *(f"a{i}" for i in shift))),
        Straight("triangular_to_similarity", "(p | m | W) to similarity: A = (p + m)/2, K = (p - m)/2", "8 add, 8 halvings",
                 (("a", 12),), tuple(back[k] for k in sorted(back)), tuple(placed.get(k, f"r{k}") for k in range(12))),
    )  # fmt: skip


def _motor_on_origin() -> tuple[Straight, Straight]:
    """t = -2 W ~R, read off the e1i, e2i, e3i components of the table of (W ei) R with the signs of ~R."""
    table = product_table("geometric", SHIFT, bt.ROTOR, SHIFT.masks[:3])
    w, r = (tuple(bt.MOTOR.index(m) for m in masks) for masks in (SHIFT.masks, bt.ROTOR.masks))
    signs = tuple(-grade_sign(grade(m)) for m in bt.ROTOR.masks)
    lines = tuple((f"r{k}", f"2 * ({_sum((c * signs[j], f'a{w[i]} * a{r[j]}') for i, j, c in row)})") for k, row in enumerate(table.rows))
    square = (*lines, ("r3", "(r0 * r0 + r1 * r1 + r2 * r2) / 2"))
    cost = f"{table.multiplications} mul, {table.additions} add, 3 doublings"
    more = f"{table.multiplications + 3} mul, {table.additions + 2} add, 3 doublings, 1 halving"
    position = "position of the origin carried by a unit motor: t = -2 W ~R, W = (e1i e2i e3i e123i) and R = (1 e12 e13 e23)"
    point = "the same as a point e0 + t + t^2/2 ei, without its e0 = 1 (e1 e2 e3 ei)"
    return (
        Straight("motor_origin_position", position, cost, (("a", 8),), lines, _numbered("r", 3)),
        Straight("motor_origin_point", point, more, (("a", 8),), square, _numbered("r", 4)),
    )


FUNCTIONS: tuple[Straight, ...] = (*map(_from_product, CATALOGUE), _triangular_product(), *_conversions(), *_motor_on_origin())
"""Everything that is printed: the catalogue, then the cheaper forms."""

_BANNER = (
    "Products of conformal geometric algebra, straight from the exact tables.",
    "Made by cga_codegen/emit/print_products.py; do not edit: cga generate",
    "Components in ascending bit masks: e0 = 1, e1 = 2, e2 = 4, e3 = 8, ei = 16; e0.ei = -1.",
)


def _python_function(f: Straight) -> str:
    names = [name for name, _ in f.inputs]
    unpack = [f"    {', '.join(_numbered(n, size))} = {', '.join(f'{n}[{k}]' for k in range(size))}\n" for n, size in f.inputs if size > 1]
    unpack += [f"    {n}0 = {n}[0]\n" for n, size in f.inputs if size == 1]
    body = "".join(f"    {target} = {expression}\n" for target, expression in f.lines)
    head = f'def {f.name}({", ".join(names)}):\n    """{f.summary}.\n\n    {f.cost}.\n    """\n'
    return head + "".join(unpack) + body + f"    return {', '.join(f.outputs)}\n"


def _c_function(f: Straight) -> str:
    arguments = ", ".join(f"const T *{name}" for name, _ in f.inputs)
    body = "".join(f"    const T {n}{k} = {n}[{k}];\n" for n, size in f.inputs for k in range(size))
    body += "".join(f"    const T {target} = {expression};\n" for target, expression in f.lines)
    body += "".join(f"    out[{k}] = {output};\n" for k, output in enumerate(f.outputs))
    return f"/* {f.summary}.\n   {f.cost}. */\nstatic inline void cga_{f.name}({arguments}, T *out)\n{{\n{body}}}\n"


def _python_text(functions: Sequence[Straight]) -> str:
    note = "Arguments are sequences of components (component axis first): floats, numpy arrays, Fractions, casadi.SX; results are tuples."
    head = '"""' + _BANNER[0] + "\n\n" + "\n".join((*_BANNER[1:], note)) + '\n"""\n'
    return head + "".join("\n\n" + _python_function(f) for f in functions)


def _c_text(functions: Sequence[Straight]) -> str:
    note = ("T is the number type (default double; a vector type works too). `out` may be one of the inputs.",)
    head = "/*\n" + "".join(f" * {line}\n" for line in (*_BANNER, *note)) + " */\n#ifndef CGA_PRODUCTS_H\n#define CGA_PRODUCTS_H\n"
    opening = "#ifndef T\n#define T double\n#define CGA_PRODUCTS_DEFAULT_T\n#endif\n"
    closing = "#ifdef CGA_PRODUCTS_DEFAULT_T\n#undef T\n#undef CGA_PRODUCTS_DEFAULT_T\n#endif\n\n#endif\n"
    return head + "\n" + opening + "\n" + "\n".join(map(_c_function, functions)) + "\n" + closing


def _compact(value: object) -> str:
    return json.dumps(value, separators=(",", ":"))


def _json_product(p: Product) -> str:
    """One product; each of its steps on a line of its own, terms as [i, j, k, c]."""
    record: dict[str, object] = {"name": p.name, "rule": p.rule, "a": p.a.name, "b": p.b.name, "result": p.tables[-1].type.name}
    record |= {"multiplications": p.multiplications, "additions": p.additions}
    steps = []
    for table in p.tables:
        terms = [[i, j, k, c] for k, row in enumerate(table.rows) for i, j, c in row]
        steps.append(_compact({"result": table.type.blade_names, "terms": terms}))
    return _compact(record)[:-1] + ',"steps":[\n ' + ",\n ".join(steps) + "]}"


def _json_text() -> str:
    meaning = (
        "A term [i, j, k, c] adds c a_i b_j to component k; a sandwich's second step takes that result and a, signs of ~a included.",
        "'geometric' lists [mask a, mask b, mask, c] of the geometric product of all blade pairs; other products keep some of its grades.",
    )
    head = {"banner": _BANNER + meaning, "basis": CGA.basis, "gram": CGA.gram}
    rows = [f'"{key}":{_compact(value)}' for key, value in head.items()]
    rows.append('"types":{\n' + ",\n".join(f'"{t.name}":{_compact(t.blade_names)}' for t in bt.DECLARED) + "\n}")
    rows.append('"products":[\n' + ",\n".join(map(_json_product, CATALOGUE)) + "\n]")
    rows.append(f'"forms":{_compact({f.name: f.cost for f in FUNCTIONS[len(CATALOGUE) :]})}')
    by_left = [_compact([[a, b, m, c] for b in CGA.blades for m, c in product(CGA, "geometric", a, b)])[1:-1] for a in CGA.blades]
    rows.append('"geometric":[\n' + ",\n".join(by_left) + "\n]")
    return "{\n" + ",\n".join(rows) + "\n}\n"


def product_files() -> dict[str, str]:
    """Texts of algebra/products.json, algebra/cga_products.h and algebra/products.py, by path below generated/; always the same bytes."""
    return {
        "algebra/products.json": _json_text(),
        "algebra/cga_products.h": _c_text(FUNCTIONS),
        "algebra/products.py": _python_text(FUNCTIONS),
    }
