"""Of two ways to the same values the one with fewer operations is generated: which one that is depends on the robot."""

import math

import pytest

from cga_codegen.catalogue import TREE_KERNELS
from cga_codegen.kernels import articulated, differentiation, dynamics, dynamics_derivatives
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.model import Frame, Inertia, Joint, Placement, RobotModel
from cga_codegen.units import made, tree_unit

KERNELS = {kernel.name: kernel for kernel in TREE_KERNELS}


def snake(count):
    """Joints about axes that alternate by quarter turns, 0.2 m apart."""
    body = Inertia(1.0, (0.01, 0.02, 0.1), (0.1, 0.0, 0.0, 0.1, 0.0, 0.05))
    places = [Placement.turn((1.0, 0.0, 0.0), sign * math.pi / 2) @ Placement.shift((0.0, 0.0, 1.0), 0.2) for sign in (1, -1)]
    joints = [Joint(f"j{k}", "revolute", k - 1, places[k % 2], (0.0, 0.0, 1.0), -1.0, 1.0, 1.0, 1.0, body) for k in range(count)]
    return RobotModel("snake", tuple(joints), (Frame("tip", count - 1, Placement()),))


@pytest.mark.parametrize(("count", "expected"), [(6, dynamics), (18, articulated)])
def test_articulated_bodies_win_on_long_chains(count, expected):
    tree = Tree.of(snake(count))
    kernel = KERNELS["forward_dynamics"]
    found = made(kernel, tree)
    assert found.function is expected.forward_dynamics
    by_matrix, by_bodies = (made_cost(kernel, function, tree) for function in (kernel.function, kernel.instead))
    assert (by_bodies < kernel.worth * by_matrix) == (expected is articulated)
    assert found.program.counts().total == (by_bodies if expected is articulated else by_matrix)


def made_cost(kernel, function, tree):
    """Operations of one way alone."""
    alone = type(kernel)(kernel.name, function, kernel.shape)
    return made(alone, tree).program.counts().total


def test_a_humanoid_gets_articulated_bodies_although_they_cost_a_little_more():
    """They round less, see `worth` of the kernel."""
    kernel, tree = KERNELS["forward_dynamics"], Tree.of(load_bundled("g1"))
    by_matrix, by_bodies = (made_cost(kernel, function, tree) for function in (kernel.function, kernel.instead))
    assert by_matrix < by_bodies < kernel.worth * by_matrix and made(kernel, tree).function is articulated.forward_dynamics


def test_the_manifest_names_the_way_that_was_taken():
    _, record = tree_unit(snake(18), "forward_dynamics")
    assert record.kernels[0].source == "cga_codegen.kernels.articulated.forward_dynamics"


@pytest.mark.parametrize(("robot", "expected"), [("ur5", differentiation), ("g1", dynamics_derivatives)])
def test_parallel_axes_favour_differentiation_and_many_branches_the_closed_form(robot, expected):
    assert made(KERNELS["inverse_dynamics_by_v"], Tree.of(load_bundled(robot))).function is expected.inverse_dynamics_by_v
