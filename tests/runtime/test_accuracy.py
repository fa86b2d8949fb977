"""Every kernel of every bundled robot against Pinocchio and MuJoCo on 1000 random states: 1e-12 relative, a humanoid's accelerations 1e-10.

The wider table, over other people's robots, is docs/accuracy.md, made by scripts/accuracy.py.
"""

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.descriptions import bundled_files
from cga_runtime.experiments.accuracy import Worst, against_mujoco, against_pinocchio

STATES = 1000
FILES = bundled_files()
TOLERANCE, OF_HUMANOIDS = 1e-12, 1e-10
QUANTITIES = {
    *("frames", "center of mass", "its Jacobian", "inverse dynamics", "bias", "gravity", "mass matrix", "Coriolis matrix"),
    *("d tau/dq", "d tau/dv", "pose", "Jacobian", "its derivative", "forward dynamics", "condition"),
}
# a humanoid's derivatives take half a minute to compile: its Python text, which holds the same operations, stands for them here
SLOW_TO_COMPILE = {"g1"}
SINGULAR = {("nao", "floating"), ("nao_v32", "floating")}  # the torso has no mass of its own in these files


def within(errors, name):
    """Quantities whose error is too large; the condition is no error."""
    condition = errors.pop("condition", None)
    assert condition is None or 1.0 <= condition < 1e7
    humanoid = OF_HUMANOIDS if name == "g1" else TOLERANCE
    return {key: error for key, error in errors.items() if not error <= (humanoid if key == "forward dynamics" else TOLERANCE)}


@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.parametrize("name", FILES)
@pytest.mark.filterwarnings("ignore::cga_runtime.errors.KernelWarning")
def test_pinocchio(name, base, monkeypatch):
    if base == "floating" or name in SLOW_TO_COMPILE:
        monkeypatch.setenv("CGA_NO_COMPILER", "1")
    errors = against_pinocchio(cga.load_robot(name, base=base), FILES[name], STATES, chains=2)
    absent = {"forward dynamics", "condition"} if (name, base) in SINGULAR else set()
    assert errors.keys() == QUANTITIES - absent
    assert within(errors, name) == {}


@pytest.mark.parametrize("name", FILES)
def test_mujoco(name):
    errors = against_mujoco(cga.load_robot(name, mimic="independent"), FILES[name], STATES)
    assert errors.keys() == {"frames", "mass matrix", "bias", "inverse dynamics", "forward dynamics"}
    assert within(errors, name) == {}


def test_the_comparison_can_fail():
    """A frame moved by a micrometre, gravity by a millionth, NaN on either side."""
    robot = cga.load_robot("tm5_700", gravity=(0.0, 0.0, -9.81 * (1.0 + 1e-6)))
    errors = against_pinocchio(robot, FILES["tm5_700"], 20, chains=1)
    assert 1e-7 < errors["gravity"] < 1e-5 and 1e-8 < errors["inverse dynamics"] and errors["mass matrix"] < TOLERANCE
    worst = Worst()
    worst.add("frames", np.array([[1.0, 1e-6]]), np.array([[1.0, 0.0]]), 1.0)
    worst.add("ours", np.array([[np.nan]]), np.array([[1.0]]))
    worst.add("theirs", np.array([[1.0]]), np.array([[np.nan]]))
    assert worst.errors == {"frames": 1e-6, "ours": np.inf, "theirs": np.inf}
