"""The house keeps its order: who may import whom, file names, file lengths, and what lies at the top level.

Statements are read, never run. The last tests give each rule a sample that breaks it, so that no rule can pass by looking away.
"""

import ast
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# ---- the rules, as data


@dataclass(frozen=True)
class Room:
    """What the files of one room may import. The standard library is open to all."""

    own: tuple[str, ...]  # our own modules, each with all below it
    outside: tuple[str, ...] = ()  # other distributions
    lazily: tuple[str, ...] = ()  # others, only inside functions or for type checkers


GEN = "cga_codegen"
RUN = "cga_runtime"
ALGEBRA, ROBOTS, KERNELS, EMIT = (f"{GEN}.{room}" for room in ("algebra", "robots", "kernels", "emit"))
PEERS = ("mujoco", "pinocchio")

# The runtime is one line: each room may import itself and what stands before it.
LINE = (
    *("errors", "cache", "compile", "layout", "kernels", "coordinates", "multivectors", "smooth", "pairs", "screw_functions"),
    *("exp_log", "exp_log_symbolic", "jets", "exp_log_jacobians", "versor_group", "motors", "versors", "conventions", "quaternions"),
    *("configurations", "elements", "descriptions", "workshop", "whole_body", "robot", "loading", "exporting", "spaces"),
    *("solve", "analysis", "control", "kendo", "experiments", "report", "view", "commands"),
)
CALCULATES_WITHOUT_CASADI = set(LINE[: LINE.index("descriptions")]) - {"cache", "compile"}  # nothing of it before it is asked for


def up_to(last: str) -> tuple[str, ...]:
    """The runtime's rooms from the first to `last`."""
    return tuple(f"{RUN}.{room}" for room in LINE[: LINE.index(last) + 1])


ROOMS = {
    GEN: Room(own=()),  # imported before every room, so it may bring nothing with it
    ALGEBRA: Room((ALGEBRA,), ("sympy",)),
    ROBOTS: Room((ALGEBRA, ROBOTS), ("numpy",)),
    **{f"{ROBOTS}.{file}": Room((ALGEBRA, ROBOTS), ("numpy",), lazily=("pinocchio",)) for file in ("from_urdf", "from_pinocchio")},
    **{f"{ROBOTS}.{file}": Room((ALGEBRA, ROBOTS), ("numpy",), lazily=("mujoco",)) for file in ("from_mjcf", "from_mjmodel")},
    KERNELS: Room((ALGEBRA, f"{ROBOTS}.model", KERNELS), ("casadi", "numpy")),
    EMIT: Room((ALGEBRA, EMIT), ("casadi",)),
    f"{GEN}.catalogue": Room((ALGEBRA, ROBOTS, KERNELS), ("casadi", "numpy")),
    f"{GEN}.units": Room((ALGEBRA, ROBOTS, KERNELS, EMIT, f"{GEN}.catalogue"), ("casadi", "numpy")),
    **{f"{GEN}.{file}": Room((GEN,), ("casadi", "numpy")) for file in ("generate", "externals", "export_texts", "export")},
    f"{GEN}.cli": Room((GEN,), ("casadi", "numpy", "rich", "typer")),
    RUN: Room(up_to("view"), ("numpy",)),
    **{f"{RUN}.{room}": Room(up_to(room), ("numpy",), lazily=("casadi",)) for room in CALCULATES_WITHOUT_CASADI},
    f"{RUN}.cache": Room(up_to("cache"), ("numpy",), lazily=("casadi", "filelock", "platformdirs")),
    f"{RUN}.compile": Room(up_to("compile"), ("numpy",), lazily=("casadi", "ziglang")),
    **{f"{RUN}.{room}": Room(up_to(room), ("casadi", "numpy")) for room in LINE[LINE.index("whole_body") : LINE.index("report")]},
    **{f"{RUN}.{door}": Room((*up_to(door), GEN), ("numpy",), lazily=("casadi",)) for door in ("descriptions", "workshop", "exporting")},
    **{f"{RUN}.experiments.{peers}": Room(up_to("experiments"), ("casadi", "numpy"), lazily=PEERS) for peers in ("bench", "accuracy")},
    f"{RUN}.control.simulation": Room(up_to("control"), ("casadi", "numpy"), lazily=("mujoco",)),
    f"{RUN}.report": Room(up_to("report"), ("casadi", "jinja2", "markupsafe", "numpy", "plotly"), lazily=("mujoco",)),
    f"{RUN}.view": Room(up_to("view"), ("casadi", "numpy"), lazily=("mujoco", "viser")),
    **{f"{RUN}.{room}": Room((RUN,), ("casadi", "numpy", "rich", "typer")) for room in ("commands", "cli")},
    f"{RUN}.__main__": Room((RUN,)),  # starts where nothing else is installed
}

NOT_PACKAGES = {"generated", "codegen", "scripts", "tests"}  # folders of the checkout: nobody imports them
SAYS_NOTHING = {"utils", "util", "helpers", "helper", "common", "misc", "types", "code", "operator"}  # the last three also hide modules
LONGEST = 300
TOP_LEVEL = {
    *("pyproject.toml", "codegen", "generated", "cga_runtime", "tests", "scripts", "run", "docs", ".ci"),
    *("README.md", "CHANGELOG.md", "LICENSE", "CITATION.cff", ".git", ".gitignore"),
}

# ---- reading


@dataclass(frozen=True)
class Import:
    """One imported name: `target` is dotted; `lazy` inside a function, or seen by type checkers only."""

    line: int
    target: str
    lazy: bool


def imports(node: ast.AST, lazy: bool = False) -> Iterator[Import]:
    """Every import below a node, those by importlib.import_module("name") and __import__("name") included."""
    match node:
        case ast.Import():
            yield from (Import(node.lineno, alias.name, lazy) for alias in node.names)
        case ast.ImportFrom():
            origin = "." * node.level + (node.module or "")
            yield from (Import(node.lineno, f"{origin}.{alias.name}", lazy) for alias in node.names)
        case ast.Call(args=[ast.Constant(value=str(name)), *_]) if ast.unparse(node.func).split(".")[-1] in ("import_module", "__import__"):
            yield Import(node.lineno, name, lazy)
    for field, value in ast.iter_fields(node):
        inside = isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        typing_only = isinstance(node, ast.If) and field == "body" and ast.unparse(node.test) in ("TYPE_CHECKING", "typing.TYPE_CHECKING")
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                yield from imports(child, lazy or inside or typing_only)


def module_name(path: str) -> str:
    """codegen/cga_codegen/emit/__init__.py -> cga_codegen.emit"""
    return path.removeprefix("codegen/").removesuffix(".py").removesuffix("/__init__").replace("/", ".")


def room_of(module: str) -> str | None:
    """The smallest room that a module lies in; a package's own __init__.py is a room by itself and holds nothing else."""
    found = [room for room in ROOMS if within(module, (room,)) and (room not in (GEN, RUN) or room == module)]
    return max(found, key=len, default=None)


def within(name: str, places: tuple[str, ...]) -> bool:
    """Whether a dotted name is one of the places or lies below one."""
    return any(name == place or name.startswith(place + ".") for place in places)


def broken_imports(path: str, source: str) -> list[str]:
    """One sentence for each import of a package's file that its room does not allow."""
    name = room_of(module_name(path))
    if name is None:
        return [f"{path} lies in no room; add its room to the table of this test, or move the file"]
    room, broken = ROOMS[name], []
    for item in imports(ast.parse(source)):
        place, top = f"{path}:{item.line}", item.target.split(".")[0]
        if item.target.startswith("."):
            broken.append(f"{place} imports {item.target}: imports are absolute")
        elif top in NOT_PACKAGES:
            broken.append(f"{place} imports {item.target}: {top} is not a package")
        elif top in (GEN, RUN):
            if not within(item.target, room.own) and item.target != f"{name.split('.')[0]}.__version__":
                allowed = ", ".join(sorted(place.partition(".")[2] or place for place in room.own)) or "none of ours"
                broken.append(f"{place} imports {item.target}: {name} may import {allowed}")
        elif top in room.lazily:
            if not item.lazy:
                broken.append(f"{place} imports {item.target} at import time: {name} may only inside functions")
        elif top not in sys.stdlib_module_names and top not in room.outside:
            broken.append(f"{place} imports {item.target}: {name} may import {', '.join(room.outside + room.lazily) or 'no other package'}")
    return broken


def imports_of_folders(path: str, source: str) -> list[str]:
    """Imports in tests and scripts of folders that are no packages."""
    found = imports(ast.parse(source))
    return [f"{path}:{item.line} imports {item.target}" for item in found if item.target.split(".")[0] in NOT_PACKAGES]


def cycle(sources: dict[str, str]) -> list[str]:
    """Modules that import each other in a ring at import time, with those that need the ring, or []; `sources` maps paths to texts."""
    modules = {module_name(path): ast.parse(source) for path, source in sources.items()}
    after: dict[str, set[str]] = {}
    for module, tree in modules.items():
        targets = {item.target for item in imports(tree) if not item.lazy}
        named = {target if target in modules else target.rpartition(".")[0] for target in targets}
        after[module] = named & modules.keys() - {module}
    while after:
        free = {module for module, needed in after.items() if not needed & after.keys()}
        if not free:
            return sorted(after)
        after = {module: needed for module, needed in after.items() if module not in free}
    return []


def broken_file(path: str, source: str) -> list[str]:
    """Complaints about a Python file's name and length."""
    lines = len(source.splitlines())
    silent = [f"{path}: name it for the one thing it holds"] if Path(path).stem.lower() in SAYS_NOTHING else []
    return silent + ([f"{path} has {lines} lines, {LONGEST} at most"] if lines > LONGEST else [])


def strangers(names: set[str], ignored: list[str]) -> list[str]:
    """Names at the top level that are neither the project's nor listed in .gitignore."""
    return sorted(name for name in names - TOP_LEVEL if not any(fnmatch(name, pattern.rstrip("/")) for pattern in ignored))


def sources(*folders: str) -> dict[str, str]:
    """Path from the root -> text of every Python file in the folders."""
    found = sorted(file for folder in folders for file in (ROOT / folder).rglob("*.py"))
    return {file.relative_to(ROOT).as_posix(): file.read_text(encoding="utf-8") for file in found}


PACKAGES = sources("codegen", "cga_runtime")
OTHERS = sources("tests", "scripts")

# ---- the house as it stands


def test_every_import_follows_the_line() -> None:
    found = [sentence for path, source in PACKAGES.items() for sentence in broken_imports(path, source)]
    assert not found, "\n".join(found)


def test_no_modules_import_each_other_in_a_ring() -> None:
    assert cycle(PACKAGES) == []


def test_folders_are_not_imported() -> None:
    found = [sentence for path, source in OTHERS.items() for sentence in imports_of_folders(path, source)]
    assert not found, "\n".join(found)


def test_names_and_lengths() -> None:
    files = PACKAGES | OTHERS | {"run": (ROOT / "run").read_text(encoding="utf-8")}
    found = [sentence for path, source in files.items() for sentence in broken_file(path, source)]
    assert not found, "\n".join(found)


def test_top_level() -> None:
    ignored = [line for line in (ROOT / ".gitignore").read_text(encoding="utf-8").split("\n") if line and not line.startswith("#")]
    assert strangers({entry.name for entry in ROOT.iterdir()}, ignored) == []


def test_both_packages_are_read_and_marked_as_typed() -> None:
    assert {module_name(path).split(".")[0] for path in PACKAGES} == {GEN, RUN}
    assert (ROOT / "codegen" / GEN / "py.typed").is_file() and (ROOT / RUN / "py.typed").is_file()


def test_the_table_names_only_rooms_that_it_has() -> None:
    named = {place for room in ROOMS.values() for place in room.own}
    assert {place for place in named if room_of(place) is None} == set()


# ---- each rule can fail

BROKEN = [
    ("codegen/cga_codegen/__init__.py", "import cga_codegen.algebra", "may import none of ours"),
    ("codegen/cga_codegen/algebra/products.py", "import numpy as np", "may import sympy"),
    ("codegen/cga_codegen/algebra/products.py", "def f():\n    import casadi", ":2 imports casadi"),
    ("codegen/cga_codegen/algebra/products.py", "from cga_runtime import kernels", "cga_runtime.kernels"),
    ("codegen/cga_codegen/robots/model.py", "from cga_codegen.emit.lower import lower", "cga_codegen.emit.lower"),
    ("codegen/cga_codegen/robots/from_dh.py", "def f():\n    import pinocchio", "imports pinocchio"),
    ("codegen/cga_codegen/robots/from_urdf.py", "import pinocchio", "only inside functions"),
    ("codegen/cga_codegen/robots/from_mjcf.py", "try:\n    import mujoco\nexcept ImportError:\n    pass", "only inside functions"),
    ("codegen/cga_codegen/kernels/dynamics.py", "from cga_codegen.robots import from_urdf", "cga_codegen.robots.from_urdf"),
    ("codegen/cga_codegen/kernels/dynamics.py", "from cga_codegen.emit import lower", "cga_codegen.emit.lower"),
    ("codegen/cga_codegen/emit/lower.py", "import cga_codegen.kernels.screws", "cga_codegen.kernels.screws"),
    ("codegen/cga_codegen/emit/lower.py", "from .print_c import f", "absolute"),
    ("codegen/cga_codegen/catalogue.py", "import cga_codegen.cli", "cga_codegen.cli"),
    ("codegen/cga_codegen/cli.py", "import cga_runtime", "cga_runtime"),
    ("codegen/cga_codegen/odds.py", "", "no room"),
    ("cga_runtime/odds/ends.py", "", "no room"),
    ("cga_runtime/kernels.py", "import casadi", "only inside functions"),
    ("cga_runtime/elements.py", "class A:\n    import casadi", "only inside functions"),
    ("cga_runtime/errors.py", "import importlib\nimportlib.import_module('casadi')", "only inside functions"),
    ("cga_runtime/cache.py", "import filelock", "only inside functions"),
    ("cga_runtime/kernels.py", "def f():\n    from cga_runtime import robot", "cga_runtime.robot"),
    ("cga_runtime/robot.py", "def f():\n    import cga_codegen", "imports cga_codegen"),
    ("cga_runtime/robot.py", "if TYPE_CHECKING:\n    from cga_codegen.robots.model import RobotModel", "cga_codegen.robots.model"),
    ("cga_runtime/robot.py", "import cga_runtime", "imports cga_runtime"),
    ("cga_runtime/robot.py", "import generated.algebra", "not a package"),
    ("cga_runtime/spaces/cooperative.py", "def f():\n    import cga_runtime.analysis.mobility", "cga_runtime.analysis"),
    ("cga_runtime/solve/riccati.py", "import scipy.linalg", "imports scipy"),
    ("cga_runtime/control/simulation.py", "import mujoco", "only inside functions"),
    ("cga_runtime/experiments/bench.py", "import pinocchio", "only inside functions"),
    ("cga_runtime/experiments/reaching.py", "def f():\n    import pinocchio", "imports pinocchio"),
    ("cga_runtime/motors.py", "import casadi", "only inside functions"),
    ("cga_runtime/report/page.py", "import rich", "imports rich"),
    ("cga_runtime/__init__.py", "from cga_runtime.cli import main", "cga_runtime.cli"),
]
SOUND = [
    ("codegen/cga_codegen/algebra/proofs.py", "import math\nimport sympy\nfrom cga_codegen import __version__"),
    ("codegen/cga_codegen/robots/from_urdf.py", "def f():\n    import pinocchio"),
    ("codegen/cga_codegen/kernels/dynamics.py", "import casadi\nfrom cga_codegen.robots import model"),
    ("cga_runtime/kernels.py", "async def f():\n    import casadi"),
    ("cga_runtime/kernels.py", "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    import casadi"),
    ("cga_runtime/workshop.py", "from cga_codegen.catalogue import KERNELS"),
    ("cga_runtime/report/page.py", "import jinja2\nfrom cga_runtime.experiments import reaching"),
    ("cga_runtime/cli.py", "import rich\nimport typer\nimport cga_runtime as cga\nfrom cga_runtime.report import page"),
]


@pytest.mark.parametrize(("path", "source", "fragment"), BROKEN)
def test_a_broken_import_is_found(path: str, source: str, fragment: str) -> None:
    (sentence,) = broken_imports(path, source)
    assert fragment in sentence and sentence.startswith(path)


@pytest.mark.parametrize(("path", "source"), SOUND)
def test_a_sound_import_passes(path: str, source: str) -> None:
    assert broken_imports(path, source) == []


def test_the_other_rules_can_fail() -> None:
    ring = {"cga_runtime/a.py": "from cga_runtime import b", "cga_runtime/b.py": "from cga_runtime.a import f"}
    assert cycle(ring) == ["cga_runtime.a", "cga_runtime.b"]
    assert cycle(ring | {"cga_runtime/b.py": "def g():\n    from cga_runtime.a import f"}) == []
    assert imports_of_folders("scripts/figure.py", "import scripts.other") == ["scripts/figure.py:1 imports scripts.other"]
    assert [len(broken_file(path, "x\n" * count)) for path, count in (("a/Utils.py", 301), ("a/code.py", 1), ("a/ik.py", 300))] == [2, 1, 0]
    assert strangers({"run", "out", "notes.txt", "a.so"}, ["out/", "*.so"]) == ["notes.txt"]
