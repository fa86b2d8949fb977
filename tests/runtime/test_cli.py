"""The command `cga`: exit statuses, one strict JSON object on standard output and nothing else, and a sentence for every mistake."""

import json
import os
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen.robots.bundled import bundled_robots
from cga_runtime import cli
from cga_runtime.experiments import bench
from cga_runtime.report import build

URDF = Path(__file__).parents[1] / "data" / "skew.urdf"


@pytest.fixture
def command(monkeypatch, capfd):
    """Runs `cga ARGUMENTS` in this process: exit status, standard output, standard error."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["cga", *map(str, arguments)])
        with warnings.catch_warnings(), pytest.raises(SystemExit) as end:  # main() says how warnings are shown
            cli.main()
        return end.value.code, *capfd.readouterr()

    return run


def refuse(constant):
    raise AssertionError(f"{constant} is not JSON")


@pytest.fixture
def ask(command):
    """Runs a command with --json: exit status and the object, which must be all that standard output holds."""

    def run(*arguments):
        status, out, err = command(*arguments, "--json")
        assert out.count("\n") == 1 and out.endswith("\n"), (out, err)
        found = json.loads(out, parse_constant=refuse)
        assert isinstance(found, dict)
        return status, found

    return run


# ---- what commands answer


def test_robots(ask, command):
    status, found = ask("robots")
    assert status == 0 and [row["name"] for row in found["robots"]] == cga.bundled_robots()
    nao = next(row for row in found["robots"] if row["name"] == "nao")
    assert nao["joints"] == 10 and "RHand" in nao["frames"] and nao["source"] == "nao.urdf"
    status, out, err = command("robots")
    assert status == 0 and "nao_v32" in out and not err


def test_generate(ask, command, tmp_path):
    nao = bundled_robots()["nao"]
    status, found = ask("generate", nao, "-o", tmp_path / "out", "--frame", "RElbow", "--loop", "RHand, LElbow")
    assert status == 0 and found["folder"] == str(tmp_path / "out")
    names = [f"robots/nao/{name}" for name in ("LElbow", "RElbow", "RHand", "RHand_with_LElbow")]
    written = json.loads((tmp_path / "out" / "manifest.json").read_text())["units"]
    chains = {path for path in found["units"] if "/tree_" not in path}
    assert sorted(path for path in chains if not path.startswith("algebra/")) == names and "algebra/cooperative_circle" in chains
    assert sorted(found["units"].keys() - chains)[:2] == ["robots/nao/tree_bias", "robots/nao/tree_center_of_mass"]
    assert found["units"]["robots/nao/RElbow"]["pose"] == written["robots/nao/RElbow"]["kernels"]["pose"]["operations"] > 20
    chain = cga.load_robot("nao", folder=tmp_path / "out").chain("RElbow")
    assert np.array_equal(chain.pose(np.ones(3)), cga.load_robot(nao).chain("RElbow").pose(np.ones(3)))
    status, out, err = command("generate", URDF, "-o", tmp_path / "tips")
    assert status == 0 and "robots/skew/left_tip" in out and "  hessian_local_world_aligned " in out
    assert "Kinematics of the chain left_tip of skew: 14 kernels, " in err


def test_proofs_are_listed(ask):
    status, found = ask("generate", "--prove")
    assert status == 0 and found["proved"]["associativity"] >= 3 * 32_768 and len(found["proved"]) >= 13


def test_generate_without_a_file_writes_what_the_package_carries(ask, tmp_path):
    status, found = ask("generate", "-o", tmp_path)
    assert status == 0 and "robots/nao/RHand_with_LHand" in found["units"]
    carried = cga.kernels.generated_folder()
    assert (tmp_path / "manifest.json").read_bytes() == (carried / "manifest.json").read_bytes()


def test_mobility(ask, command):
    status, found = ask("mobility", "nao", "--q", "0.3,-0.4,1.1,0.7,-0.2,0.5,0.4,-0.9,-0.6,0.1")
    assert status == 0
    assert (found["joint_mobility"], found["object_dof"], found["motion"]) == (4, 4, "1T3R")
    assert found["limb_ranks"] == [5, 5] and found["constraint_rank"] == 2 and np.shape(found["constraint_wrenches"]) == (2, 6)
    status, out, err = command("mobility")
    assert status == 0 and "joint mobility" in out and "1T3R" in out and not err


def test_singularities(ask, command):
    status, found = ask("singularities", "--q", "0.3,-0.4,1.1,0.7,-0.2,0.5,0.4,-0.9,-0.6,0.1")
    assert status == 0 and found["success"] is True and found["kind"] == "limb"
    assert abs(found["distance"] - 0.6) < 1e-6  # the left elbow stretched: q4 = 0
    status, found = ask("singularities", "--kind", "actuation", "--scheme", "1,3,7,8")
    assert status == 0 and abs(found["value"]) < 1e-8
    status, found = ask("singularities", "--kind", "constraint", "--within-limits")
    assert status == 1 and found["success"] is False and found["q"] is None and "joint limits" in found["status"]
    status, out, _ = command("singularities", "--kind", "constraint", "--within-limits")
    assert status == 1 and "none found" in out


def test_schemes(ask, command):
    status, found = ask("schemes", "--samples", 20, "--seed", 3)
    assert status == 0 and found["total"] == len(found["table"]) == 210
    assert found == ask("schemes", "--samples", 20, "--seed", 3)[1]
    status, out, _ = command("schemes", "--samples", 20)
    assert status == 0 and "[1, 2, 3, 4]" in out


def test_reach(ask, command, arm):
    inside = arm.point(0.5 * (arm.lower + arm.upper))
    status, found = ask("reach", ",".join(map(str, inside)))
    assert status == 0 and found["success"] is True and found["joint_names"] == list(arm.joint_names)
    assert np.abs(arm.point(found["q"]) - inside).max() < 1e-6
    status, found = ask("reach", "9,9,9", "--frame", "LHand")
    assert status == 1 and found["success"] is False and found["residual"] > 10
    status, found = ask("reach", "-0.08,-0.16,-0.09", "--q", "-0.1,-0.1,-0.1,0.1,0")  # numbers that begin with a minus are no options
    assert status == 0 and np.abs(arm.point(found["q"]) - [-0.08, -0.16, -0.09]).max() < 1e-6
    assert command("reach", "9,9,9")[0] == 1


def test_report_and_bench_say_where_they_wrote(ask, command, monkeypatch, tmp_path):
    """What they compute has its own tests; here it is replaced."""
    calls = []
    monkeypatch.setattr(build, "build_report", lambda *given, **_: calls.append(given) or {"seconds": 1.5})
    status, found = ask("report", "nao_v32", "--out", tmp_path)
    assert status == 0 and calls == [("nao_v32", tmp_path)]
    assert found == {"report": f"{tmp_path}/report.json", "page": f"{tmp_path}/index.html", "seconds": 1.5}


# ---- mistakes


MISTAKES = [
    ("mobility nau", "UnknownNameError: unknown robot 'nau'; known: g1, iiwa14, leap_hand, nao, nao_v32, panda"),
    ("mobility /nowhere/robot.urdf", "RobotFileError: '/nowhere/robot.urdf' cannot be read (No such file or directory); a path to a URDF"),
    ("mobility FOLDER", "RobotFileError: FOLDER is a folder; a path to a URDF file is needed"),
    ("mobility FOLDER/broken.urdf", "RobotFileError: broken.urdf: not well-formed XML"),
    ("mobility --q 1,2", "WrongSizeError: q: shape (2,) given, (..., 10) needed: RShoulderPitch, "),
    ("mobility --q a,b", "WrongSizeError: --q: 'a,b' given, numbers separated by commas needed"),
    ("mobility --q 0,0,0,nan,0,0,0,0,0,0", "NotFiniteError: q holds NaN or infinity: nan at index (3,) of shape (10,)"),
    ("mobility --frames RHand", "WrongSizeError: --frames: 'RHand' given, two frame names separated by a comma needed"),
    ("mobility --frames RHand,Hand", "UnknownNameError: unknown frame 'Hand'; known: universe, torso, "),
    ("mobility --frames RHand,RElbow", "GraspError: the two arms share joints (RElbowYaw, RShoulderPitch, RShoulderRoll)"),
    ("mobility --frames RHand,torso", "ChainError: nao: no joint lies between the root and 'torso'; name a frame that moves"),
    ("singularities --kind none", "UnknownNameError: unknown kind of singularity 'none'; known: limb, constraint, actuation"),
    ("singularities --kind actuation", "SchemeError: kind 'actuation' needs actuated joints"),
    ("singularities --kind actuation --scheme 1,2,3", "SchemeError: scheme (1, 2, 3): 4 distinct joint numbers from 1 to 10 are needed"),
    ("singularities --kind actuation --scheme 1,2,3,11", "SchemeError: scheme (1, 2, 3, 11): 4 distinct"),
    ("singularities --kind actuation --scheme 1.5,2,3,4", "WrongSizeError: --scheme: '1.5,2,3,4' given, joint numbers separated by"),
    ("singularities --kind actuation --scheme nan,2,3,4", "WrongSizeError: --scheme: 'nan,2,3,4' given, joint numbers separated by"),
    ("singularities --kind actuation --scheme inf,2,3,4", "WrongSizeError: --scheme: 'inf,2,3,4' given, joint numbers separated by"),
    ("schemes --frames LHand", "WrongSizeError: --frames: 'LHand' given"),
    ("reach 1,2", "WrongSizeError: point: shape (2,) given, (..., 3) needed"),
    ("reach x,y,z", "WrongSizeError: point: 'x,y,z' given, numbers separated by commas needed"),
    ("reach inf,0,0", "NotFiniteError: point holds NaN or infinity"),
    ("reach 0,0,0 --frame Hand", "UnknownNameError: unknown frame 'Hand'"),
    ("reach 0,0,0 --robot nau", "UnknownNameError: unknown robot 'nau'"),
    ("reach 0,0,0 --q 1", "WrongSizeError: q0: shape (1,) given, (5,) needed"),
    ("generate", "WrongSizeError: generate: say where to write with -o DIR"),
    ("generate URDF", "WrongSizeError: generate: say where to write with -o DIR"),
    ("generate -o FOLDER/file", "FolderError: cannot write FOLDER/file: File exists"),
    ("generate -o FOLDER", "FolderError: FOLDER is not empty and holds no manifest.json: name an empty folder, or one that cga made"),
    ("generate URDF -o FOLDER/file", "FolderError: cannot write FOLDER/file: File exists"),
    ("generate FOLDER/broken.urdf -o FOLDER/new", "RobotFileError: broken.urdf: not well-formed XML"),
    ("generate URDF -o FOLDER/new --frame hand", "RobotFileError: skew has no frame 'hand'; frames: universe, base, "),
    ("generate URDF -o FOLDER/new --frame base", "RobotFileError: skew: no joint lies between the root and 'base'"),
    ("generate URDF -o FOLDER/new --loop right_tip", "WrongSizeError: --loop takes two frame names separated by a comma"),
    ("generate URDF -o FOLDER/new --loop right_tip,left_tip", "RobotFileError: skew: the chains to right_tip and left_tip share"),
    ("report nau --out FOLDER/new", "UnknownNameError: unknown robot 'nau'"),
    ("report --out FOLDER/file", "ReportFolderError: FOLDER/file is a file; the report needs a folder"),
]


@pytest.mark.parametrize(("line", "sentence"), MISTAKES, ids=[line for line, _ in MISTAKES])
def test_a_mistake_is_one_sentence_and_status_2(command, tmp_path, line, sentence):
    (tmp_path / "file").write_text("")
    (tmp_path / "broken.urdf").write_text("<robot")
    arguments = [word.replace("FOLDER", str(tmp_path)).replace("URDF", str(URDF)) for word in line.split()]
    status, out, err = command(*arguments, *([] if line == "generate" else ["--json"]))
    assert status == 2 and out == ""
    last = err.strip().splitlines()[-1]
    assert last.startswith(sentence.replace("FOLDER", str(tmp_path))) and "Traceback" not in err
    assert not (tmp_path / "new" / "manifest.json").exists()


USAGE = [
    ("nonsense", "No such command 'nonsense'"),
    ("robots --jsn", "No such option: --jsn"),
    ("schemes --samples 0", "Invalid value for '--samples'"),
    ("schemes --samples many", "Invalid value for '--samples'"),
    ("reach", "Missing argument"),
    ("mobility nao nao", "Got unexpected extra argument"),
]


@pytest.mark.parametrize(("line", "fragment"), USAGE)
def test_wrong_usage_is_status_2(command, line, fragment):
    status, out, err = command(*line.split())
    assert status == 2 and out == "" and fragment in err and "Traceback" not in err


def test_help_and_version(command):
    status, out, err = command("--version")
    assert (status, out, err) == (0, f"cga-robotics {cga.__version__}\n", "")
    status, out, err = command("--help")
    names = [found.name or found.callback.__name__ for found in cli.app.registered_commands]
    assert status == 0 and not err and all(f" {name} " in out for name in names) and len(names) >= 8
    assert all(command(name, "--help")[0] == 0 for name in names)
    assert command()[0] == 2  # and the list of commands


def test_bench_prints_its_rows(command, monkeypatch, tmp_path):
    row = {"group": "single", "robot": "nao", "operation": "motor", "ours": "cga", "peer": "peer"}
    rows = [row | {"ours_ns": 1.0, "peer_ns": 2.0, "ratio": 2.0, "value_error": 1e-16}]
    monkeypatch.setattr(bench, "run", lambda: rows)
    status, out, _ = command("bench", "--out", tmp_path / "new", "--json")
    assert status == 0 and json.loads(out, parse_constant=refuse) == rows and out.count("\n") == 1
    (tmp_path / "file").write_text("")
    status, out, err = command("bench", "--out", tmp_path / "file", "--json")
    assert status == 2 and not out and err.strip() == f"CgaError: cannot write {tmp_path}/file: File exists"


# ---- as users start it


@pytest.mark.parametrize(("line", "status"), [("robots", 0), ("singularities --kind constraint --within-limits", 1), ("mobility nau", 2)])
@pytest.mark.compiler
def test_the_process_ends_with_the_status(line, status):
    done = subprocess.run([sys.executable, "-m", "cga_runtime.cli", *line.split(), "--json"], capture_output=True, text=True)
    assert done.returncode == status
    if status < 2:
        assert isinstance(json.loads(done.stdout, parse_constant=refuse), dict) and not done.stderr
    else:
        assert not done.stdout and done.stderr.startswith("UnknownNameError: unknown robot 'nau'")


def test_warnings_go_to_standard_error_once():
    environment = {**os.environ, "CGA_NO_COMPILER": "1"}
    line = [sys.executable, "-m", "cga_runtime.cli", "mobility", "--json"]
    done = subprocess.run(line, capture_output=True, text=True, env=environment)
    assert done.returncode == 0 and json.loads(done.stdout)["joint_mobility"] == 4
    assert done.stderr == "warning: CGA_NO_COMPILER is set: kernels run as Python text, about a hundred times slower\n"


def test_a_package_that_is_not_installed_is_named(command, monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    for line in (["mobility", URDF], ["generate", URDF, "-o", tmp_path / "new"], ["generate", "-o", tmp_path / "new"]):
        status, out, err = command(*line)
        assert status == 2 and not out
        assert err == "MissingExtraError: reading a URDF needs pinocchio (pip name: pin): pip install 'cga-robotics[urdf]'\n"
