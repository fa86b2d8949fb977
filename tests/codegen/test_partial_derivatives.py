"""Every analytic derivative that exported functions may take equals automatic differentiation of its kernel, at random configurations."""

from pathlib import Path

import casadi
import numpy as np
import pytest

from cga_codegen.catalogue import CHAIN_KERNELS, TREE_KERNELS
from cga_codegen.externals import ANALYTIC, ORDERS, Subject, Symbols, analytic
from cga_codegen.kernels.tree import Tree
from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import RobotModel

KERNELS = {kernel.name: kernel for kernel in (*CHAIN_KERNELS, *TREE_KERNELS)}
TOLERANCE = 1e-13
"""Relative to the largest entry. Measured: 2e-14 for forward dynamics, which is solved with the mass matrix; 3e-15 for the others."""


@pytest.fixture(scope="module", params=["a mimicking and a sliding joint", "a floating base", "six turning joints"])
def model(request: pytest.FixtureRequest) -> RobotModel:
    if request.param == "six turning joints":
        return load_bundled("tm5_700")
    file = Path(__file__).parents[1] / "data" / "four_links.urdf"
    return load_urdf(file, base="floating" if "floating" in request.param else "fixed")


def numbers(at: Symbols, rng: np.random.Generator) -> list[np.ndarray]:
    """Values of all inputs, c, s and half angles those of one q."""
    q = np.concatenate([rng.standard_normal(at.layout.first), rng.uniform(-2, 2, at.layout.nq - at.layout.first)])
    angles = {name: [] for name in ("c", "s", "ch", "sh")}
    for place, ratio, slides in at.layout.joints:
        x = ratio * q[place]
        for name, value in zip(angles, (1, x, 1, x / 2) if slides else (np.cos(x), np.sin(x), np.cos(x / 2), np.sin(x / 2)), strict=True):
            angles[name].append(value)
    given = {**angles, "base": q[: at.layout.first]}
    return [np.asarray(given.get(name, rng.standard_normal(port.size))) for name, (port, _) in at.ports.items()]


@pytest.mark.parametrize("by", ANALYTIC, ids=" by ".join)
def test_analytic_and_automatic_derivatives_agree(model: RobotModel, rng: np.random.Generator, by: tuple[str, ...]) -> None:
    kernel = KERNELS[by[0]]
    subject: Subject = Tree.of(model) if kernel in TREE_KERNELS else model.chain(model.tips()[0])
    at = Symbols(subject)
    functions = analytic(at, by)
    assert bool(functions) == (by[-1] != "q" or not at.layout.first)  # a floating base's velocities are not rates of q
    automatic = at.values(kernel.function)
    for name in by[1:]:
        automatic = casadi.vec(casadi.densify(at.derivative(automatic, name)).T)  # row-major: the coordinate last
    symbols = [symbol for _, symbol in at.ports.values()]
    both = casadi.Function("both", symbols, [automatic, *(at.values(function) for function in functions)])
    for _ in range(3):
        expected, *found = (np.array(value).ravel() for value in both.call(numbers(at, rng)))
        for value in found:
            assert value.shape == expected.shape and np.abs(value - expected).max() <= TOLERANCE * np.abs(expected).max()


def test_the_tables_name_kernels() -> None:
    assert set(ORDERS) <= set(KERNELS) and {by[0] for by in ANALYTIC} <= set(KERNELS)
    assert {way for way in ANALYTIC.values() if isinstance(way, str)} <= set(KERNELS)
