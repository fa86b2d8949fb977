"""Which kernels exist for which robot: tables of functions, and the text that they become.

A kernel is an ordinary function from symbols to a list of expressions; its parameters after the subject name its inputs. A unit is what is
generated together: all kernels of one chain, of one loop of two chains, the screws' brackets, or one kernel of a whole tree of joints (each
alone, since a humanoid's take seconds to compile); it becomes one C file and one Python file.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import casadi

from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import Port, Program, lower
from cga_codegen.emit.manifest import KernelRecord, UnitRecord
from cga_codegen.emit.print_c import print_body, print_entries
from cga_codegen.emit.print_c import print_file as print_c_file
from cga_codegen.emit.print_python import print_function, print_module
from cga_codegen.kernels import (
    articulated,
    closed_chain,
    differentiation,
    dynamics,
    dynamics_derivatives,
    kinematics,
    screws,
    tree_kinematics,
    versors,
)
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.model import Chain, Coordinates, ModelError, RobotModel

Subject = Chain | Loop | Tree | None


class MassError(ModelError):
    """A kernel that a robot has not, because it would divide by a mass or an inertia that is zero whatever the configuration."""

    def __init__(self, kernel: str) -> None:
        self.kernel = kernel
        lacks = "nothing that moves has mass" if kernel.startswith("center_of_mass") else "the inertia that a joint carries is zero"
        super().__init__(f"{kernel} does not exist: {lacks}")


@dataclass(frozen=True)
class Size:
    """What shapes depend on: velocities, joints that do not float, frames."""

    n: int = 0
    joints: int = 0
    frames: int = 0


Shape = Callable[[Size], tuple[int, ...]]


@dataclass(frozen=True)
class Kernel:
    """A row of the catalogue. `shape` of the output; `derivative_of` names the kernel whose AD derivative by q it must equal (the manifest
    then shows what automatic differentiation would cost)."""

    name: str
    function: Callable[..., list[Any]]
    shape: Shape
    derivative_of: str | None = None
    only: Callable[[Any], bool] = lambda subject: True
    instead: Callable[..., list[Any]] | None = None  # another way to the same values, taken where it costs no more
    worth: float = 1.0  # ... than this many times as much
    instead_for: Callable[[Any], bool] = lambda tree: bool(tree.bodies)  # without bodies there is nothing to differentiate by


def _square(z: Size) -> tuple[int, ...]:
    return z.n, z.n


CHAIN_KERNELS = (
    Kernel("motor", versors.motor, lambda z: (8,)),
    Kernel("pose", kinematics.pose, lambda z: (4, 4)),
    Kernel("point", kinematics.point, lambda z: (3,)),
    Kernel("screws", kinematics.screws, lambda z: (6, z.n)),
    Kernel("motor_jacobian", versors.motor_jacobian, lambda z: (8, z.n), "motor"),
    Kernel("jacobian_local", kinematics.jacobian_local, lambda z: (6, z.n)),
    Kernel("jacobian_world", kinematics.jacobian_world, lambda z: (6, z.n)),
    Kernel("jacobian_local_world_aligned", kinematics.jacobian_local_world_aligned, lambda z: (6, z.n)),
    Kernel("jacobian_derivative_local", kinematics.jacobian_derivative_local, lambda z: (6, z.n)),
    Kernel("jacobian_derivative_world", kinematics.jacobian_derivative_world, lambda z: (6, z.n)),
    Kernel("jacobian_derivative_local_world_aligned", kinematics.jacobian_derivative_local_world_aligned, lambda z: (6, z.n)),
    Kernel("hessian_local", kinematics.hessian_local, lambda z: (6, z.n, z.n), "jacobian_local"),
    Kernel("hessian_world", kinematics.hessian_world, lambda z: (6, z.n, z.n), "jacobian_world"),
    Kernel("hessian_local_world_aligned", kinematics.hessian_local_world_aligned, lambda z: (6, z.n, z.n), "jacobian_local_world_aligned"),
)

LOOP_KERNELS = (
    Kernel("screws", closed_chain.loop_screws, lambda z: (6, z.n)),
    Kernel("closure_error", closed_chain.closure_error, lambda z: (6,)),
    Kernel("closure_jacobian", closed_chain.closure_jacobian, lambda z: (6, z.n), "closure_error"),
    Kernel("screws_pullback", closed_chain.screws_pullback, lambda z: (z.n,)),
    Kernel("wrist_centres", closed_chain.wrist_centres, lambda z: (2, 3), only=closed_chain.has_wrist_centre),
    Kernel("limb_factors", closed_chain.limb_factors, lambda z: (2, 2), only=closed_chain.has_wrist_centre),
    Kernel("constraint_wrenches", closed_chain.constraint_wrenches, lambda z: (2, 6), only=closed_chain.has_wrist_centre),
)

SCREW_KERNELS = (
    Kernel("bracket", screws.bracket, lambda z: (1,)),
    Kernel("bracket_cofactors", screws.bracket_cofactors, lambda z: (6, 6)),
)

TREE_KERNELS = (
    Kernel("frames", tree_kinematics.frames, lambda z: (z.frames, 4, 4)),
    Kernel("center_of_mass", tree_kinematics.center_of_mass, lambda z: (3,)),
    Kernel("center_of_mass_jacobian", tree_kinematics.center_of_mass_jacobian, lambda z: (3, z.n), "center_of_mass"),
    Kernel("inverse_dynamics", dynamics.inverse_dynamics, lambda z: (z.n,)),
    Kernel("bias", dynamics.bias, lambda z: (z.n,)),
    Kernel("gravity", dynamics.gravity, lambda z: (z.n,)),
    Kernel("mass_matrix", dynamics.mass_matrix, _square),
    Kernel(
        "forward_dynamics",
        dynamics.forward_dynamics,
        lambda z: (z.n,),
        instead=articulated.forward_dynamics,
        worth=1.25,  # it rounds less: at worst of 1000 states of the G1 3e-16 of the exact value, by the mass matrix 5e-12
        instead_for=lambda tree: not any(body.joint.follows for body in tree.bodies),
    ),
    Kernel(
        "coriolis",
        dynamics_derivatives.coriolis,
        _square,
        instead=differentiation.coriolis,
        # velocities of a floating base are not derivatives of coordinates
        instead_for=lambda tree: not tree.floating and bool(tree.bodies),
    ),
    Kernel("inverse_dynamics_by_q", dynamics_derivatives.inverse_dynamics_by_q, _square, instead=differentiation.inverse_dynamics_by_q),
    Kernel("inverse_dynamics_by_v", dynamics_derivatives.inverse_dynamics_by_v, _square, instead=differentiation.inverse_dynamics_by_v),
)

# shape of each input
INPUTS: dict[str, Shape] = {
    **{name: lambda z: (z.joints,) for name in ("c", "s", "ch", "sh")},
    **{name: lambda z: (z.n,) for name in ("v", "a", "tau")},
    "base": lambda z: (8,),
    "grasp": lambda z: (8,),
    "weights": lambda z: (6, z.n),
    "screws": lambda z: (6, 6),
}


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
    at: Coordinates = subject.coordinates
    return Layout(at.names, at.kinds, at.motions)


def _size(subject: Subject) -> Size:
    layout = _layout(subject)
    n = len(layout.names) + (5 if layout.first else 0)
    return Size(n, len(layout.motions), len(subject.frames) if isinstance(subject, Tree) else 0)


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
