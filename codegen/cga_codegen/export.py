"""Assembles an exported robot: a C99 library of its kernels with header, CMake files, an example, and functions that CasADi loads."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

from cga_codegen import __version__
from cga_codegen.catalogue import CHAIN_KERNELS, TREE_KERNELS, Kernel
from cga_codegen.emit.manifest import digest, write_folder
from cga_codegen.emit.print_c import PREAMBLE, print_entries
from cga_codegen.emit.print_external import print_bodies, print_external, print_interface
from cga_codegen.export_texts import Exported, declarations, frames, positions, rows, sizes, steps, wrapped
from cga_codegen.externals import Subject, externals
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.model import ModelError, RobotModel
from cga_codegen.units import identifier

Say = Callable[[str], None]


OF_CHAINS = tuple(kernel.name for kernel in CHAIN_KERNELS)


class _Template(Template):
    """CMake's own mark is $."""

    delimiter = "@"


def word(name: str) -> str:
    """A name for C, CMake, files and CasADi (which wants a letter first, and no two underscores in a row)."""
    text = re.sub("_+", "_", identifier(name)).strip("_")
    return text if text[:1].isalpha() else f"robot{text}"


def export_robot(
    model: RobotModel,
    folder: Path,
    chains: Sequence[str],
    tree: Sequence[str],
    say: Say,
    derivatives: int = 2,
    kernels: Sequence[str] = OF_CHAINS,
) -> dict[str, Any]:
    """Writes the library of a robot: kernels of the chains to these frames, and these kernels of the whole. Returns its manifest.

    Functions are called <robot>_<kernel>; of several chains <robot>_<frame>_<kernel>. derivatives: highest order that is exported, 0 to 2.
    Kernels of the whole that do not exist (a joint without inertia) are left out, and said. Raises ModelError for a frame that does not
    exist or does not move and for names that would become the same, GeneratedFolderError for a folder that cannot be used.
    """
    robot = word(model.name)
    rows = [*_named(CHAIN_KERNELS, kernels, "chain")], [*_named(TREE_KERNELS, tree, "tree")]
    exported, left_out = _kernels(model, robot, list(dict.fromkeys(chains)), *rows, say, derivatives)
    if not exported:
        raise ModelError(f"{model.name}: nothing to export; name a frame that moves, or leave the dynamics in")
    names = [function.name.lower() for one in exported for function in one.functions]  # and so files, which some systems take for the same
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise ModelError(f"{model.name}: two functions would be called {twice[0]}; export their frames into separate folders")
    texts = {path: text if text.endswith("\n") else text + "\n" for path, text in _texts(robot, model, exported, left_out)}
    manifest = {
        "export": 1,
        "generator": f"cga-robotics {__version__}",
        "robot": robot,
        "files": {path: digest(text) for path, text in sorted(texts.items())},
        "functions": {one.functions[0].name: one.to_json() for one in exported},
        "left_out": left_out,
    }
    write_folder(folder, texts, json.dumps(manifest, indent=1, sort_keys=True) + "\n")
    return manifest


def _named(table: Sequence[Kernel], names: Sequence[str], subject: str) -> list[Kernel]:
    if unknown := sorted(set(names) - {kernel.name for kernel in table}):
        raise ModelError(f"no kernel of a {subject} is called {unknown[0]!r}; kernels: {', '.join(kernel.name for kernel in table)}")
    return [kernel for kernel in table if kernel.name in names]


def _kernels(
    model: RobotModel, robot: str, frames: Sequence[str], of_chains: Sequence[Kernel], of_tree: Sequence[Kernel], say: Say, order: int
) -> tuple[list[Exported], dict[str, str]]:
    """What is exported, and of the kernels of the whole those that are not, with the reason."""
    exported, left_out = [], {}
    for frame in frames:
        chain = model.chain(frame)
        if chain.n == 0:
            raise ModelError(f"{model.name}: no joint lies between the base and {frame!r}; name a frame that moves")
        part = f"{word(frame)}_" if len(frames) > 1 else ""
        exported += [_exported(kernel, chain, f"{robot}_", f"{part}{kernel.name}", say, order) for kernel in of_chains]
    for kernel in of_tree:
        try:
            exported.append(_exported(kernel, Tree.of(model), f"{robot}_", kernel.name, say, order))
        except ModelError as error:
            left_out[kernel.name] = str(error)
            say(f"left out: {error}")
    return exported, left_out


def _exported(kernel: Kernel, subject: Subject, prefix: str, name: str, say: Say, order: int) -> Exported:
    one = Exported(kernel, subject, name, tuple(externals(kernel, subject, prefix + name, order)))
    say(f"{one.symbol}: {', '.join(str(function.operations) for function in one.functions)} operations")
    return one


def _texts(robot: str, model: RobotModel, exported: Sequence[Exported], left_out: dict[str, str]) -> Iterator[tuple[str, str]]:
    """Path and text of every file but the manifest."""
    banner = f"cga_{robot}, made by `cga export` (cga-robotics {__version__}); do not edit: the next export overwrites it."
    dynamics = any(isinstance(one.subject, Tree) for one in exported)
    sources = [f"src/{one.file}.c" for one in exported]
    floating = exported[0].layout.first
    words = {
        "banner": banner,
        "robot": robot,
        "macro": robot.upper(),
        "version": __version__,
        "sources": "\n".join(f"  {path}" for path in sources),
        "and_dynamics": " and dynamics" if dynamics else "",
        "functions": "".join([*sizes(robot, exported), *declarations(exported)]),
        "steps": "".join(steps(exported)),
        "positions": "\n".join(f"- {line}" for line in (*positions(exported), *frames(exported))),
        "arrays": "\n".join(wrapped(f"{'q ' * line.startswith('of')}{line}.") for line in (*positions(exported), *frames(exported))),
        "table": "\n".join(rows(exported)),
        "left_out": "".join(f"\nNot exported: {name}; there is none (a body or a joint without inertia).\n" for name in left_out),
        "casadi_name": exported[0].functions[0].name,
        "of_base": " (of a floating base: by the eight numbers of its motor, not by its twist)" if floating else "",
    }
    for template, path in _TEMPLATES.items():
        text = (files("cga_codegen.emit") / "templates" / template).read_text(encoding="utf-8")
        yield path.format(robot=robot), _Template(text).substitute(words)
    zeros = max(pattern.size for one in exported for function in one.functions for _, pattern in function.inputs)
    yield "src/kernel.h", f"/* {banner}\n   What the kernels share. */\n\n{PREAMBLE}"
    yield "src/external.h", f"/* {banner} */\n\n{print_interface(zeros)}"
    for path, one in zip(sources, exported, strict=True):
        counts = "; ".join(f"{function.name}: {function.operations} operations" for function in one.functions)
        parts = [f'/* {banner}\n   {counts}. */\n\n#include "../include/cga_{robot}.h"\n#include "kernel.h"\n#include "external.h"\n']
        value, *derivatives = one.functions
        parts += [*print_bodies(value), print_entries(one.program, one.symbol, one.layout), print_external(value, one.layout)]
        for function in derivatives:
            parts += [*print_bodies(function), print_external(function, one.layout)]
        yield path, "\n".join(parts)


_TEMPLATES = {
    "CMakeLists.txt": "CMakeLists.txt",
    "header.h": "include/cga_{robot}.h",
    "main.c": "example/main.c",
    "example_CMakeLists.txt": "example/CMakeLists.txt",
    "README.md": "README.md",
}
