"""The wheel alone: built, unpacked elsewhere, and used without the checkout, as after `pip install`."""

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

SECOND_ROBOT = """<robot name="slider">
  <link name="base"/><link name="arm"/><link name="carriage"/><link name="tip"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.3" rpy="0.1 0.2 0.3"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="carriage"/><origin xyz="0.2 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="spin" type="continuous"><parent link="carriage"/><child link="tip"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/></joint>
</robot>
"""


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The unpacked wheel."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = folder.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder / "site")
    return folder / "site"


def run(site, cwd, code, *arguments):
    """Python with the unpacked wheel before everything else, outside the checkout."""
    environment = {**os.environ, "PYTHONPATH": str(site)}
    done = subprocess.run([sys.executable, "-c", code, *arguments], cwd=cwd, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_wheel_holds_both_packages_and_the_kernels(site):
    names = {path.name for path in site.iterdir()}
    assert {"cga_codegen", "cga_runtime"} <= names
    assert names - {"cga_codegen", "cga_runtime"} == {name for name in names if name.endswith(".dist-info")}
    manifest = json.loads((site / "cga_runtime" / "_generated" / "manifest.json").read_text())
    assert manifest == json.loads((ROOT / "generated" / "manifest.json").read_text())
    for package in ("cga_codegen", "cga_runtime"):
        assert (site / package / "py.typed").exists()
    assert (site / "cga_codegen" / "robots" / "bundled" / "nao.urdf").exists()


def test_wheel_reports_without_the_checkout(site, tmp_path):
    code = """
import sys, cga_runtime, cga_codegen
from cga_runtime.kernels import generated_folder
from cga_runtime.report.build import build_report
from cga_runtime.report.context import Sizes
assert cga_runtime.__file__.startswith(sys.argv[1]) and cga_codegen.__file__.startswith(sys.argv[1])
assert str(generated_folder()).startswith(sys.argv[1])
build_report("nao", "report", sizes=Sizes(samples=64, tries=2, poses=2, grid=9, rounds=1))
"""
    run(site, tmp_path, code, str(site))
    report = json.loads((tmp_path / "report" / "report.json").read_text())
    assert report["mobility"]["joint_mobility"] == 4 and report["schemes"]["admissible"] == 139
    assert (tmp_path / "report" / "index.html").stat().st_size > 100_000


def test_wheel_generates_a_second_robot(site, tmp_path):
    (tmp_path / "slider.urdf").write_text(SECOND_ROBOT)
    code = "from cga_runtime.cli import main; main()"
    listing = json.loads(run(site, tmp_path, code, "generate", "slider.urdf", "-o", "kernels", "--json"))
    assert "pose" in listing["units"]["robots/slider/tip"]
    use = """
import json, sys, numpy as np, pinocchio as pin, cga_runtime as cga
assert cga.__file__.startswith(sys.argv[1])
arm = cga.load_robot("slider", folder="kernels").chain("tip")
model = pin.buildModelFromUrdf("slider.urdf")
data = model.createData()
worst = 0.0
for q in np.random.default_rng(0).uniform(-1, 1, (100, 3)):
    full = np.array([q[0], q[1], np.cos(q[2]), np.sin(q[2])])
    pin.framesForwardKinematics(model, data, full)
    worst = max(worst, np.abs(arm.pose(q) - data.oMf[model.getFrameId("tip")].homogeneous).max())
print(json.dumps(worst))
"""
    assert json.loads(run(site, tmp_path, use, str(site))) < 1e-14
