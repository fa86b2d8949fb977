"""Robots, chains and loops travel: pickled, copied, and read again when their folder was written anew."""

import copy
import json
import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.kernels import Library, library
from cga_runtime.workshop import generate_folder

DATA = Path(__file__).resolve().parents[1] / "data"


@pytest.mark.parametrize("travel", [copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))], ids=["deepcopy", "pickle"])
def test_what_was_used_can_travel(arm, loop, travel):
    q = loop.random(np.random.default_rng(0))
    mu = loop.conditioning(q, (1, 3, 7, 8))  # compiles and opens the library
    other = travel(loop)
    assert other == loop and other.unit is loop.unit
    assert other.conditioning(q, (1, 3, 7, 8)) == mu
    assert np.array_equal(travel(arm).pose(q[:5]), arm.pose(q[:5]))
    assert travel(arm.kernel("pose")) is arm.kernel("pose")


def test_a_folder_written_anew_is_read_anew(tmp_path, monkeypatch):
    generate_folder(DATA / "skew.urdf", tmp_path / "kernels", [], [], lambda line: None)
    first = cga.bundled_robots(tmp_path / "kernels")
    joint = '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>'
    two = f'<robot name="two"><link name="a"/><link name="b"/>{joint}</robot>'
    (tmp_path / "two.urdf").write_text(two)
    generate_folder(tmp_path / "two.urdf", tmp_path / "kernels", [], [], lambda line: None)
    assert cga.bundled_robots(tmp_path / "kernels") == ["two"] != first
    monkeypatch.chdir(tmp_path)
    chain = cga.load_robot("two", folder="kernels").chain("b")
    monkeypatch.chdir("/")
    assert np.array_equal(chain.pose([0.0]), np.eye(4))  # the folder's files are read after the working folder changed


@pytest.mark.parametrize(("key", "value"), [("units", []), ("files", [1]), ("robots", None)])
def test_a_damaged_manifest_is_named(tmp_path, key, value):
    manifest = json.loads((library(cga.kernels.generated_folder()).folder / "manifest.json").read_text())
    (tmp_path / "manifest.json").write_text(json.dumps({**manifest, key: value}))
    with pytest.raises(cga.StaleKernelError, match="is not a manifest of generated kernels"):
        Library(tmp_path)


def test_a_kept_text_without_units_is_made_again(arm, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    q = [0.1, 0.2, 0.3, 0.4, 0.5]
    expected = arm.robot.chain("RHand", offset=(0.0, 0.1, 0.0)).point(q)
    (manifest,) = (tmp_path / "cga" / "generated").glob("*/manifest.json")
    manifest.write_text(json.dumps({**json.loads(manifest.read_text()), "files": {}, "units": {}}))
    assert np.array_equal(arm.robot.chain("RHand", offset=(0.0, 0.1, 0.0)).point(q), expected)


def test_default_frames_have_kernel_names(arm):
    q = np.full(5, 0.3)
    for name, shape in (("jacobian", (6, 5)), ("hessian", (6, 25))):
        assert arm.casadi(name)(q).shape == shape
    assert np.abs(arm.casadi("jacobian")(q).full() - arm.jacobian(q)).max() < 1e-15


@pytest.mark.parametrize(("hidden", "said"), [("typer", "pip install 'cga-robotics[cli]'"), ("rich", "pip install 'cga-robotics[cli]'")])
def test_the_command_without_its_packages(hidden, said):
    code = f"""
import importlib.util as util
find = util.find_spec
util.find_spec = lambda name, package=None: None if name == {hidden!r} else find(name, package)
from cga_runtime.__main__ import main
main()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=dict(os.environ))
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith("MissingExtraError: the command line needs ") and said in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("hidden", ["jinja2", "markupsafe", "plotly"])
def test_the_report_without_its_packages(hidden):
    code = f"""
import importlib.util as util
find = util.find_spec
util.find_spec = lambda name, package=None: None if name == {hidden!r} else find(name, package)
import sys
sys.argv = ["cga", "report", "nao"]
from cga_runtime.cli import main
main()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=dict(os.environ))
    assert done.returncode == 2
    assert done.stderr.endswith(f"MissingExtraError: the report needs {hidden}: pip install 'cga-robotics[report]'\n")
