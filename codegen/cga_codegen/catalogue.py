"""Which kernels exist for what: tables of functions. How they become text is in units.py.

A kernel is an ordinary function from symbols to a list of expressions; its parameters after the subject name its inputs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from cga_codegen.kernels import (
    articulated,
    closed_chain,
    cooperative,
    differentiation,
    dynamics,
    dynamics_derivatives,
    hypersphere,
    kinematics,
    primitives,
    screws,
    similarity,
    tree_kinematics,
    versors,
)
from cga_codegen.kernels.closed_chain import Loop
from cga_codegen.kernels.cooperative import Team
from cga_codegen.kernels.primitives import Kind
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.model import Chain, ModelError

Subject = Chain | Loop | Team | Tree | Kind | None


class MassError(ModelError):
    """A kernel that a robot has not, because it would divide by a mass or an inertia that is zero whatever the configuration."""

    def __init__(self, kernel: str) -> None:
        self.kernel = kernel
        lacks = "nothing that moves has mass" if kernel.startswith("center_of_mass") else "the inertia that a joint carries is zero"
        super().__init__(f"{kernel} does not exist: {lacks}")


@dataclass(frozen=True)
class Size:
    """What shapes depend on: velocities, joints that do not float, frames; points and blades of a primitive."""

    n: int = 0
    joints: int = 0
    frames: int = 0
    points: int = 0
    blades: int = 0


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

COOPERATIVE_KERNELS = (
    Kernel("primitive", primitives.primitive, lambda z: (z.blades,)),
    Kernel("primitive_jacobian", primitives.primitive_jacobian, lambda z: (z.blades, 3 * z.points)),
    Kernel("similarity", similarity.similarity, lambda z: (12,)),
    Kernel("parts", similarity.parts, lambda z: (8,)),
    Kernel("analytic_jacobian", similarity.analytic_jacobian, lambda z: (12, 3 * z.points)),
    Kernel("geometric_jacobian", similarity.geometric_jacobian, lambda z: (7, 3 * z.points)),
    Kernel("horizontal_jacobian", similarity.horizontal_jacobian, lambda z: (7, 3 * z.points)),
    Kernel("geometric_jacobian_derivative", similarity.geometric_jacobian_derivative, lambda z: (7, 3 * z.points)),
    Kernel("horizontal_jacobian_derivative", similarity.horizontal_jacobian_derivative, lambda z: (7, 3 * z.points)),
    Kernel("degeneracy", primitives.degeneracy, lambda z: (1,)),
    Kernel("guard", primitives.guard, lambda z: (4 + z.points * (z.points - 1) // 2,)),
    Kernel("degeneracy_gradient", primitives.degeneracy_gradient, lambda z: (3 * z.points,)),
)

HYPERSPHERE_KERNELS = (
    Kernel("primitive", hypersphere.primitive, lambda z: (z.blades,)),
    Kernel("parts", hypersphere.parts, lambda z: (z.points,)),
    Kernel("slice", hypersphere.slice, lambda z: (4,)),
    Kernel("similarity", hypersphere.similarity, lambda z: (z.points + 1,)),
    Kernel("geometric_jacobian", hypersphere.geometric_jacobian, lambda z: (z.points, 3 * z.points)),
    Kernel("geometric_jacobian_by_lifts", hypersphere.geometric_jacobian_by_lifts, lambda z: (z.points, z.points * (z.points - 4))),
    Kernel("degeneracy", hypersphere.degeneracy, lambda z: (1,)),
    Kernel("degeneracy_gradient", hypersphere.degeneracy_gradient, lambda z: (3 * z.points,)),
    Kernel("degeneracy_gradient_by_lifts", hypersphere.degeneracy_gradient_by_lifts, lambda z: (z.points * (z.points - 4),)),
    Kernel("insphere", hypersphere.insphere, lambda z: (1,)),
    Kernel("insphere_gradient", hypersphere.insphere_gradient, lambda z: (3 * z.points,)),
    Kernel("dependency", hypersphere.dependency, lambda z: (z.points,)),
    Kernel("dependency_jacobian", hypersphere.dependency_jacobian, lambda z: (z.points, 3 * z.points)),
)

TEAM_KERNELS = (
    Kernel("points", cooperative.points, lambda z: (z.points, 3)),
    Kernel("point_jacobian", cooperative.point_jacobian, lambda z: (3 * z.points, z.n), "points"),
    Kernel("primitive", cooperative.primitive, lambda z: (z.blades,)),
    Kernel("primitive_jacobian", cooperative.primitive_jacobian, lambda z: (z.blades, z.n), "primitive"),
    Kernel("similarity", cooperative.similarity_versor, lambda z: (12,)),
    Kernel("parts", cooperative.parts, lambda z: (8,)),
    Kernel("analytic_jacobian", cooperative.analytic_jacobian, lambda z: (12, z.n), "similarity"),
    Kernel("geometric_jacobian", cooperative.geometric_jacobian, lambda z: (7, z.n)),
    Kernel("horizontal_jacobian", cooperative.horizontal_jacobian, lambda z: (7, z.n)),
    Kernel("geometric_jacobian_derivative", cooperative.geometric_jacobian_derivative, lambda z: (7, z.n)),
    Kernel("horizontal_jacobian_derivative", cooperative.horizontal_jacobian_derivative, lambda z: (7, z.n)),
    Kernel("degeneracy", cooperative.degeneracy, lambda z: (1,)),
    Kernel("guard", cooperative.guard, lambda z: (4 + z.points * (z.points - 1) // 2,)),
    Kernel("degeneracy_gradient", cooperative.degeneracy_gradient, lambda z: (z.n,), "degeneracy"),
)

# shape of each input
INPUTS: dict[str, Shape] = {
    **{name: lambda z: (z.joints,) for name in ("c", "s", "ch", "sh")},
    **{name: lambda z: (z.n,) for name in ("v", "a", "tau")},
    "base": lambda z: (8,),
    "grasp": lambda z: (8,),
    "weights": lambda z: (6, z.n),
    "screws": lambda z: (6, 6),
    **{name: lambda z: (z.points, 3) for name in ("points", "velocities")},
    "chart": lambda z: (1,),
    "lifts": lambda z: (z.points * (z.points - 4),),
}
