"""The texts of units: kernels lowered and printed together, as one C file and one Python file.

A unit is what is generated together: all kernels of one chain, of one loop of two chains, of one primitive or one cooperative system, the
screws' brackets, or one kernel of a whole tree of joints (each alone, since a humanoid's take seconds to compile).
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import casadi

from cga_codegen.catalogue import (
    CHAIN_KERNELS,
    COOPERATIVE_KERNELS,
    HYPERSPHERE_KERNELS,
    INPUTS,
    LOOP_KERNELS,
    SCREW_KERNELS,
    TEAM_KERNELS,
    TREE_KERNELS,
    Kernel,
    MassError,
    Size,
    Subject,
)
from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import Port, Program, lower
from cga_codegen.emit.manifest import KernelRecord, UnitRecord
from cga_codegen.emit.print_c import print_body, print_entries
from cga_codegen.emit.print_c import print_file as print_c_file
from cga_codegen.emit.print_python import print_function, print_module
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.kernels.cooperative import Team
from cga_codegen.kernels.hypersphere import HYPERSPHERE
from cga_codegen.kernels.primitives import Kind
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.model import Chain, Coordinates, ModelError, RobotModel


def identifier(name: str) -> str:
    """A C, comment and file-system safe form of a name; names that differ stay different (other characters become _x2f_ and the like,
    as do a digit in front and an underscore that could be taken for the beginning of such a mark)."""
    return re.sub(r"[^A-Za-z0-9_]|^[0-9]|_(?=x)|^$", lambda found: f"_x{ord(found.group() or chr(0)):x}_", name)


def _layout(subject: Subject) -> Layout:
    """What q of a subject holds."""
    if subject is None:
        return Layout()
    if isinstance(subject, Loop):
        arms = (subject.right.joints, subject.left.joints)
        joints = [joint for arm in arms for joint in arm]
        motions = tuple((k, 1.0, joint.kind == "prismatic") for k, joint in enumerate(joints))
        return Layout(tuple(j.name for j in joints), tuple(j.kind for j in joints), motions)
    if isinstance(subject, Kind):
        return Layout()
    if isinstance(subject, Team):
        return Layout(subject.names, subject.kinds, subject.motions)
    at: Coordinates = subject.coordinates
    return Layout(at.names, at.kinds, at.motions)


def _size(subject: Subject) -> Size:
    layout = _layout(subject)
    n = len(layout.names) + (5 if layout.first else 0)
    kind = subject if isinstance(subject, Kind) else subject.kind if isinstance(subject, Team) else None
    frames = len(subject.frames) if isinstance(subject, Tree) else 0
    return Size(n, len(layout.motions), frames, kind.count if kind else 0, len(kind.type) if kind else 0)


def _ports(function: Callable[..., list[Any]], subject: Subject) -> list[Port]:
    """A kernel's inputs: its function's parameters, the motor of the base only where there is a floating one."""
    names = [name for name in inspect.signature(function).parameters if name in INPUTS]
    return [Port(name, INPUTS[name](_size(subject))) for name in names if name != "base" or _layout(subject).first]


def _apply(function: Callable[..., list[Any]], subject: Subject, values: dict[str, Any]) -> list[Any]:
    head = () if subject is None else (subject,)
    return function(*head, **values)


@dataclass(frozen=True)
class Made:
    """A kernel lowered for a subject, the function that gave it, and the number of casadi instructions that arithmetic took before."""

    program: Program
    function: Callable[..., list[Any]]
    instructions: int


def _made(kernel: Kernel, function: Callable[..., list[Any]], subject: Subject) -> Made:
    inputs = [(port, casadi.SX.sym(port.name, port.size)) for port in _ports(function, subject)]
    try:
        values = _apply(function, subject, {port.name: symbol.elements() for port, symbol in inputs})
    except ZeroDivisionError:
        raise MassError(kernel.name) from None
    expression = casadi.densify(casadi.vertcat(*[casadi.SX(v) for v in values]))
    raw = casadi.Function("f", [symbol for _, symbol in inputs], [expression])
    moves = (casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST)
    instructions = sum(raw.instruction_id(k) not in moves for k in range(raw.n_instructions()))
    return Made(lower(kernel.name, inputs, Port("out", kernel.shape(_size(subject))), values), function, instructions)


def made(kernel: Kernel, subject: Subject) -> Made:
    """The kernel for a subject; of two ways to the same values the one with fewer operations (see `Kernel.worth`)."""
    first = _made(kernel, kernel.function, subject)
    if kernel.instead is None or not kernel.instead_for(subject):
        return first
    second = _made(kernel, kernel.instead, subject)
    return second if second.program.counts().total < kernel.worth * first.program.counts().total else first


def program_by_differentiation(kernel: Kernel, subject: Subject) -> Program:
    """What casadi's automatic differentiation by q gives for the derivative of `kernel`: the yardstick of the analytic kernels.

    For subjects whose base does not float (there velocities are not derivatives of q).
    """
    layout = _layout(subject)
    q = casadi.SX.sym("q", layout.nq)
    moved = [(ratio * q[place] if ratio != 1.0 else q[place], slides) for place, ratio, slides in layout.joints]
    values = {
        "c": [1 if slides else casadi.cos(x) for x, slides in moved],
        "s": [x if slides else casadi.sin(x) for x, slides in moved],
        "ch": [1 if slides else casadi.cos(x / 2) for x, slides in moved],
        "sh": [x / 2 if slides else casadi.sin(x / 2) for x, slides in moved],
    }
    ports = _ports(kernel.function, subject)
    others = [(port, casadi.SX.sym(port.name, port.size)) for port in ports if port.name not in values]
    given = {port.name: values[port.name] for port in ports if port.name in values}
    result = _apply(kernel.function, subject, given | {port.name: symbol.elements() for port, symbol in others})
    jacobian = casadi.jacobian(casadi.vertcat(*[casadi.SX(v) for v in result]), q)
    shape = (*kernel.shape(_size(subject)), layout.nq)
    entries = casadi.densify(casadi.reshape(jacobian.T, -1, 1))
    return lower(f"{kernel.name}_by_q", [(Port("q", (layout.nq,)), q), *others], Port("out", shape), entries.nz[:].elements())


def unit(
    path: str, title: str, subject: Subject, kernels: Iterable[Kernel], prefix: str | None = None
) -> tuple[dict[str, str], UnitRecord]:
    """Texts (path -> text) and record of one unit; `path` is relative to the generated folder, without ending.

    prefix: of the C symbols, followed by the kernel's name; default: from the path.
    """
    layout = _layout(subject)
    symbol_prefix = prefix or "cga_" + "_".join(identifier(part) for part in path.split("/")[1:])
    banner = f"{title}. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it."
    c_parts, python_parts, records = [], [], []
    chosen = [kernel for kernel in kernels if kernel.only(subject)]
    by_name = {kernel.name: kernel for kernel in (*TREE_KERNELS, *chosen)}
    for kernel in chosen:
        found = made(kernel, subject)
        lowered = found.program
        source = f"{found.function.__module__}.{found.function.__name__}"
        summary = f"{(found.function.__doc__ or '').strip().splitlines()[0]} From {source}."
        symbol = f"{symbol_prefix}_{kernel.name}"
        c_parts += [print_body(lowered, symbol, summary), print_entries(lowered, symbol, layout)]
        python_parts.append(print_function(lowered, summary))
        by_ad = None
        if kernel.derivative_of is not None and not layout.first:
            by_ad = program_by_differentiation(by_name[kernel.derivative_of], subject).counts().total
        ports = tuple((port.name, port.shape) for port in lowered.inputs)
        records.append(KernelRecord(kernel.name, source, symbol, ports, lowered.output.shape, lowered.counts(), found.instructions, by_ad))
    texts = {f"{path}.c": print_c_file(banner, c_parts), f"{path}.py": print_module(banner, python_parts)}
    return texts, UnitRecord(path, title, layout, tuple(records))


def chain_unit(chain: Chain) -> tuple[dict[str, str], UnitRecord]:
    """All kernels of one chain, under robots/<robot>/<chain>. Raises ModelError for a chain without joints."""
    if chain.n == 0:
        raise ModelError(f"{chain.robot}: no joint lies between the root and {chain.name!r}; name a frame that moves")
    robot, name = identifier(chain.robot), identifier(chain.name)  # names come from files: they go into text only in this form
    return unit(f"robots/{robot}/{name}", f"Kinematics of the chain {name} of {robot}", chain, CHAIN_KERNELS)


def tree_unit(model: RobotModel, name: str) -> tuple[dict[str, str], UnitRecord]:
    """One kernel of a whole robot, under robots/<robot>/tree_<kernel>. Raises ModelError for a kernel that does not exist."""
    kernels = {kernel.name: kernel for kernel in TREE_KERNELS}
    if name not in kernels:
        raise ModelError(f"no kernel of a tree is called {name!r}; kernels: {', '.join(kernels)}")
    robot = identifier(model.name)
    path, title = f"robots/{robot}/tree_{name}", f"The kernel {name} of {robot}"
    return unit(path, title, Tree.of(model), [kernels[name]], f"cga_{robot}_tree")


def loop_unit(loop: Loop) -> tuple[dict[str, str], UnitRecord]:
    """All kernels of two arms that hold one object, under robots/<robot>/<right>_with_<left>."""
    robot, name = identifier(loop.right.robot), identifier(loop.name)
    return unit(f"robots/{robot}/{name}", f"Closed chain {name} of {robot}", loop, LOOP_KERNELS)


def screws_unit() -> tuple[dict[str, str], UnitRecord]:
    """Brackets of six screws, for every robot."""
    return unit("algebra/screws", "Brackets of six screws", None, SCREW_KERNELS)


def cooperative_unit(kind: Kind) -> tuple[dict[str, str], UnitRecord]:
    """Similarity and Jacobians of a primitive from its points, for every robot."""
    title = f"The cooperative {kind.name.replace('_', ' ')} from its points"
    return unit(f"algebra/cooperative_{kind.name}", title, kind, COOPERATIVE_KERNELS)


def hypersphere_unit() -> tuple[dict[str, str], UnitRecord]:
    """Similarity and Jacobians of the hypersphere of five points, for every robot."""
    return unit("algebra/cooperative_hypersphere", "The cooperative hypersphere from its points", HYPERSPHERE, HYPERSPHERE_KERNELS)


def team_unit(team: Team) -> tuple[dict[str, str], UnitRecord]:
    """The cooperative primitive of given chains as kernels of their joint positions."""
    name = identifier(team.name)
    title = f"The cooperative {team.kind.name.replace('_', ' ')} of {name}"
    return unit(f"robots/{identifier(team.robot)}/{name}", title, team, TEAM_KERNELS)
