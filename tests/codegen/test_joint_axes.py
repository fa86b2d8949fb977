"""A joint about any axis: the walk along the chain and the motor turn and slide as Rodrigues' formula says."""

from itertools import product

import numpy as np
import pytest

from cga_codegen.algebra.blade_types import MOTOR, POINT
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.versors import motor
from cga_codegen.kernels.walk import inward, outward
from cga_codegen.robots.model import Chain, Joint, Placement

GRID = [np.array(axis) / np.linalg.norm(axis) for axis in product((-1.0, 0.0, 1.0), repeat=3) if any(axis)]
NEAR = [sign * np.array([1e-9 * x, 1e-9 * y, 1.0]) for sign in (-1, 1) for x, y in ((1, 0), (0, 1), (1, -1))]  # unit to the last digit
TURNED = Placement(((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6)), (0.5, -0.25, 1.5))


def random_axes(count):
    axes = np.random.default_rng(4).standard_normal((count, 3))
    return list(axes / np.linalg.norm(axes, axis=1, keepdims=True))


def expected(axis, kind, q):
    """The pose of one joint between two placements."""
    x, y, z = axis
    k, local = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.eye(4)
    if kind == "prismatic":
        local[:3, 3] = q * axis
    else:
        local[:3, :3] += np.sin(q) * k + (1 - np.cos(q)) * k @ k
    return TURNED.matrix() @ local @ TURNED.matrix()


@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
@pytest.mark.parametrize("axes", [GRID, NEAR, random_axes(200)], ids=["signs", "nearly z", "random"])
def test_every_axis(axes, kind):
    q = 0.7
    for axis in axes:
        joint = Joint("j", kind, -1, TURNED, tuple(float(x) for x in axis), -1.0, 1.0, 1.0, 1.0)
        chain = Chain("r", "tip", (joint,), TURNED)
        pair = ([1.0], [q]) if kind == "prismatic" else ([np.cos(q)], [np.sin(q)])
        half = ([1.0], [q / 2]) if kind == "prismatic" else ([np.cos(q / 2)], [np.sin(q / 2)])
        pose, turn = expected(axis, kind, q), np.array(TURNED.rotation)
        there, back = outward(chain, *pair), inward(chain, *pair)
        assert np.abs(np.transpose(there.rotation) - pose[:3, :3]).max() < 1e-14
        assert np.abs(there.position - pose[:3, 3]).max() < 1e-14
        assert np.abs(there.axes[0] - turn @ axis).max() < 1e-14
        assert np.abs(back.axes[0] - turn.T @ axis).max() < 1e-14
        m = Multivector(MOTOR, motor(chain, *half))
        for point in np.vstack([np.zeros(3), np.eye(3)]):
            carried = (m * Multivector(POINT, [1.0, *point, point @ point / 2]) * ~m).project(POINT).coefficients
            assert np.abs(np.array(carried[1:4]) - pose[:3, :3] @ point - pose[:3, 3]).max() < 1e-14
