"""Which kernels exist for which robot: tables of functions, and the text that they become.

A kernel is an ordinary function from symbols to a list of expressions; its parameters after the subject name its inputs. A unit is what is
generated together: one chain, one loop of two chains, or the screws' brackets; it becomes one C file and one Python file.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import casadi

from cga_codegen.emit.lower import Port, Program, lower
from cga_codegen.emit.manifest import KernelRecord, UnitRecord
from cga_codegen.emit.print_c import print_body, print_entries
from cga_codegen.emit.print_c import print_file as print_c_file
from cga_codegen.emit.print_python import print_function, print_module
from cga_codegen.kernels import closed_chain, kinematics, screws, versors
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.robots.model import Chain, ModelError

Subject = Chain | Loop | None
Shape = Callable[[int], tuple[int, ...]]


@dataclass(frozen=True)
class Kernel:
    """A row of the catalogue. `shape` of the output by the number of joints; `derivative_of` names the kernel whose AD derivative by q it
    must equal (the manifest then shows what automatic differentiation would cost)."""

    name: str
    function: Callable[..., list[Any]]
    shape: Shape
    derivative_of: str | None = None
    only: Callable[[Any], bool] = lambda subject: True


CHAIN_KERNELS = (
    Kernel("motor", versors.motor, lambda n: (8,)),
    Kernel("pose", kinematics.pose, lambda n: (4, 4)),
    Kernel("point", kinematics.point, lambda n: (3,)),
    Kernel("screws", kinematics.screws, lambda n: (6, n)),
    Kernel("motor_jacobian", versors.motor_jacobian, lambda n: (8, n), "motor"),
    Kernel("jacobian_local", kinematics.jacobian_local, lambda n: (6, n)),
    Kernel("jacobian_world", kinematics.jacobian_world, lambda n: (6, n)),
    Kernel("jacobian_local_world_aligned", kinematics.jacobian_local_world_aligned, lambda n: (6, n)),
    Kernel("jacobian_derivative_local", kinematics.jacobian_derivative_local, lambda n: (6, n)),
    Kernel("jacobian_derivative_world", kinematics.jacobian_derivative_world, lambda n: (6, n)),
    Kernel("jacobian_derivative_local_world_aligned", kinematics.jacobian_derivative_local_world_aligned, lambda n: (6, n)),
    Kernel("hessian_local", kinematics.hessian_local, lambda n: (6, n, n), "jacobian_local"),
    Kernel("hessian_world", kinematics.hessian_world, lambda n: (6, n, n), "jacobian_world"),
    Kernel("hessian_local_world_aligned", kinematics.hessian_local_world_aligned, lambda n: (6, n, n), "jacobian_local_world_aligned"),
)

LOOP_KERNELS = (
    Kernel("screws", closed_chain.loop_screws, lambda n: (6, n)),
    Kernel("closure_error", closed_chain.closure_error, lambda n: (6,)),
    Kernel("closure_jacobian", closed_chain.closure_jacobian, lambda n: (6, n), "closure_error"),
    Kernel("screws_pullback", closed_chain.screws_pullback, lambda n: (n,)),
    Kernel("wrist_centres", closed_chain.wrist_centres, lambda n: (2, 3), only=closed_chain.has_wrist_centre),
    Kernel("limb_factors", closed_chain.limb_factors, lambda n: (2, 2), only=closed_chain.has_wrist_centre),
    Kernel("constraint_wrenches", closed_chain.constraint_wrenches, lambda n: (2, 6), only=closed_chain.has_wrist_centre),
)

SCREW_KERNELS = (
    Kernel("bracket", screws.bracket, lambda n: (1,)),
    Kernel("bracket_cofactors", screws.bracket_cofactors, lambda n: (6, 6)),
)

# shape of each input by the number of joints
INPUTS: dict[str, Shape] = {
    **{name: lambda n: (n,) for name in ("c", "s", "ch", "sh", "v")},
    "grasp": lambda n: (8,),
    "weights": lambda n: (6, n),
    "screws": lambda n: (6, 6),
}


def identifier(name: str) -> str:
    """A C, comment and file-system safe form of a name; names that differ stay different (other characters become _x2f_ and the like,
    as do a digit in front and an underscore that could be taken for the beginning of such a mark)."""
    return re.sub(r"[^A-Za-z0-9_]|^[0-9]|_(?=x)|^$", lambda found: f"_x{ord(found.group() or chr(0)):x}_", name)


def _joints(subject: Subject) -> Sequence[Any]:
    if subject is None:
        return ()
    return subject.joints if isinstance(subject, Chain) else (*subject.right.joints, *subject.left.joints)


def _inputs(kernel: Kernel, subject: Subject) -> list[tuple[Port, Any]]:
    names = [name for name in inspect.signature(kernel.function).parameters if name in INPUTS]
    ports = [Port(name, INPUTS[name](len(_joints(subject)))) for name in names]
    return [(port, casadi.SX.sym(port.name, port.size)) for port in ports]


def program(kernel: Kernel, subject: Subject) -> tuple[Program, int]:
    """The kernel lowered for a subject, and the number of casadi instructions that arithmetic took before lowering."""
    inputs = _inputs(kernel, subject)
    head = () if subject is None else (subject,)
    values = kernel.function(*head, *(symbol.elements() for _, symbol in inputs))
    expression = casadi.densify(casadi.vertcat(*[casadi.SX(v) for v in values]))
    function = casadi.Function("f", [symbol for _, symbol in inputs], [expression])
    moves = (casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_CONST)
    instructions = sum(function.instruction_id(k) not in moves for k in range(function.n_instructions()))
    output = Port("out", kernel.shape(len(_joints(subject))))
    return lower(kernel.name, inputs, output, values), instructions


def program_by_differentiation(kernel: Kernel, subject: Subject) -> Program:
    """What casadi's automatic differentiation by q gives for the derivative of `kernel`: the yardstick of the analytic kernels."""
    n = len(_joints(subject))
    q = casadi.SX.sym("q", n)
    slides = [joint.kind == "prismatic" for joint in _joints(subject)]
    values = {
        "c": [1 if slide else casadi.cos(q[j]) for j, slide in enumerate(slides)],
        "s": [q[j] if slide else casadi.sin(q[j]) for j, slide in enumerate(slides)],
        "ch": [1 if slide else casadi.cos(q[j] / 2) for j, slide in enumerate(slides)],
        "sh": [q[j] / 2 if slide else casadi.sin(q[j] / 2) for j, slide in enumerate(slides)],
    }
    others = [(port, symbol) for port, symbol in _inputs(kernel, subject) if port.name not in values]
    given = {port.name: symbol.elements() for port, symbol in others}
    names = [name for name in inspect.signature(kernel.function).parameters if name in INPUTS]
    result = kernel.function(subject, *(values.get(name, given.get(name)) for name in names))
    jacobian = casadi.jacobian(casadi.vertcat(*[casadi.SX(v) for v in result]), q)
    shape = (*kernel.shape(n), n)
    entries = casadi.densify(casadi.reshape(jacobian.T, -1, 1))
    return lower(f"{kernel.name}_by_q", [(Port("q", (n,)), q), *others], Port("out", shape), entries.nz[:].elements())


def unit(path: str, title: str, subject: Subject, kernels: Iterable[Kernel]) -> tuple[dict[str, str], UnitRecord]:
    """Texts (path -> text) and record of one unit; `path` is relative to the generated folder, without ending."""
    joints = _joints(subject)
    symbol_prefix = "cga_" + "_".join(identifier(part) for part in path.split("/")[1:])
    banner = f"{title}. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it."
    c_parts, python_parts, records = [], [], []
    chosen = [kernel for kernel in kernels if kernel.only(subject)]
    by_name = {kernel.name: kernel for kernel in chosen}
    for kernel in chosen:
        lowered, instructions = program(kernel, subject)
        source = f"{kernel.function.__module__}.{kernel.function.__name__}"
        summary = f"{(kernel.function.__doc__ or '').strip().splitlines()[0]} From {source}."
        symbol = f"{symbol_prefix}_{kernel.name}"
        c_parts += [print_body(lowered, symbol, summary), print_entries(lowered, symbol, [joint.kind for joint in joints])]
        python_parts.append(print_function(lowered, summary))
        by_ad = None
        if kernel.derivative_of is not None:
            by_ad = program_by_differentiation(by_name[kernel.derivative_of], subject).counts().total
        ports = tuple((port.name, port.shape) for port in lowered.inputs)
        records.append(KernelRecord(kernel.name, source, symbol, ports, lowered.output.shape, lowered.counts(), instructions, by_ad))
    texts = {f"{path}.c": print_c_file(banner, c_parts), f"{path}.py": print_module(banner, python_parts)}
    return texts, UnitRecord(path, title, tuple(j.name for j in joints), tuple(j.kind for j in joints), tuple(records))


def chain_unit(chain: Chain) -> tuple[dict[str, str], UnitRecord]:
    """All kernels of one chain, under robots/<robot>/<chain>. Raises ModelError for a chain without joints."""
    if chain.n == 0:
        raise ModelError(f"{chain.robot}: no joint lies between the root and {chain.name!r}; name a frame that moves")
    robot, name = identifier(chain.robot), identifier(chain.name)  # names come from files: they go into text only in this form
    return unit(f"robots/{robot}/{name}", f"Kinematics of the chain {name} of {robot}", chain, CHAIN_KERNELS)


def loop_unit(loop: Loop) -> tuple[dict[str, str], UnitRecord]:
    """All kernels of two arms that hold one object, under robots/<robot>/<right>_with_<left>."""
    robot, name = identifier(loop.right.robot), identifier(loop.name)
    return unit(f"robots/{robot}/{name}", f"Closed chain {name} of {robot}", loop, LOOP_KERNELS)


def screws_unit() -> tuple[dict[str, str], UnitRecord]:
    """Brackets of six screws, for every robot."""
    return unit("algebra/screws", "Brackets of six screws", None, SCREW_KERNELS)
