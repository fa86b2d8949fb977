"""The door `export_folder` and the command `cga export`: what they write and print, and what they refuse."""

import json
import re
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

import cga_runtime as cga
from cga_runtime.commands.export import export
from cga_runtime.commands.terminal import locks
from cga_runtime.errors import CgaError, FolderError, RobotFileError, UnknownNameError, WrongSizeError
from cga_runtime.exporting import export_folder

SMALL = str(Path(__file__).parents[1] / "data" / "four_links.urdf")


@pytest.fixture(scope="module")
def robot() -> cga.Robot:
    return cga.load_robot(SMALL)


def command(*arguments: str):
    app = typer.Typer()
    app.command()(export)
    return CliRunner().invoke(app, list(arguments))


def test_what_is_chosen_is_written(robot: cga.Robot, tmp_path: Path) -> None:
    said: list[str] = []
    manifest = export_folder(robot, tmp_path / "out", ["c", "d"], kernels=["point", "gravity"], derivatives=0, say=said.append)
    assert list(manifest["functions"]) == ["small_c_point", "small_d_point", "small_gravity"]
    assert [path.name for path in sorted((tmp_path / "out" / "src").glob("*.c"))] == ["c_point.c", "d_point.c", "gravity.c"]
    assert all(len(function["operations"]) == 1 for function in manifest["functions"].values())
    assert [line.split(":")[0] for line in said] == ["cga_small_c_point", "cga_small_d_point", "cga_small_gravity"]


def test_frames_are_the_tips_unless_they_are_named(robot: cga.Robot, tmp_path: Path) -> None:
    assert robot.tips == ("d",)
    header = export_folder(robot, tmp_path / "out", kernels=["point"]) and (tmp_path / "out" / "include" / "cga_small.h").read_text()
    assert (
        "Of the chain to d. q[3] -> out[3], 3." in header and "q of the chain to d, 3 numbers: turn (rad), slide (m), roll (rad)." in header
    )


def test_dynamics_can_be_left_out(robot: cga.Robot, tmp_path: Path) -> None:
    assert list(export_folder(robot, tmp_path / "out", dynamics=False, derivatives=0, kernels=["pose"])["functions"]) == ["small_pose"]
    with pytest.raises(UnknownNameError, match="unknown kernel 'gravity'; known: motor, "):
        export_folder(robot, tmp_path / "out", dynamics=False, kernels=["gravity"])


REFUSED = [
    ({"frames": ["hand"]}, UnknownNameError, "unknown frame 'hand'; known: "),
    ({"kernels": ["posture"]}, UnknownNameError, "unknown kernel 'posture'; known: motor, "),
    ({"derivatives": 3}, WrongSizeError, "derivatives: 3 given, 0, 1 or 2 needed"),
    ({"frames": ["base"], "kernels": ["point"]}, RobotFileError, "no joint lies between the base and 'base'"),
    ({"kernels": []}, RobotFileError, "small: nothing to export"),
]


@pytest.mark.parametrize(("options", "error", "sentence"), REFUSED)
def test_what_is_refused(robot: cga.Robot, tmp_path: Path, options, error, sentence) -> None:
    with pytest.raises(error, match=re.escape(sentence)):
        export_folder(robot, tmp_path / "out", **options)
    assert not (tmp_path / "out").exists()


def test_a_folder_of_others(robot: cga.Robot, tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("precious")
    with pytest.raises(FolderError, match="is not empty and holds no manifest.json"):
        export_folder(robot, tmp_path, kernels=["point"])


def test_locks() -> None:
    assert locks(["left_*=0.5", "a=b=-1"]) == {"left_*": 0.5, "a=b": -1.0}
    for text in ("joint", "joint=", "=1", "joint=far"):
        with pytest.raises(WrongSizeError, match=re.escape(f"--lock: {text!r} given, JOINT=VALUE (rad or m) needed")):
            locks([text])


def test_the_command_prints_operations(tmp_path: Path) -> None:
    out, options = (
        str(tmp_path / "out"),
        ("--kernel", "pose", "--kernel", "gravity", "--frame", "c", "--lock", "slide=0.1", "--base", "floating"),
    )
    done = command(SMALL, "-o", out, *options, "--json", "--derivatives", "1")
    assert done.exit_code == 0, done.output
    printed = json.loads(done.stdout)
    assert (printed["folder"], printed["library"], printed["left_out"]) == (out, "cga_small", {})
    assert {name: len(counts) for name, counts in printed["functions"].items()} == {"small_pose": 2, "small_gravity": 2}
    header = (tmp_path / "out" / "include" / "cga_small.h").read_text()
    assert "#define CGA_SMALL_C_NQ 10\n#define CGA_SMALL_C_NV 8\n#define CGA_SMALL_NQ 10\n#define CGA_SMALL_NV 8\n" in header


def test_the_command_prints_a_table(tmp_path: Path) -> None:
    done = command(SMALL, "-o", str(tmp_path / "out"), "--no-dynamics", "--kernel", "point", "--derivatives", "2")
    counts = json.loads((tmp_path / "out" / "manifest.json").read_text())["functions"]["small_point"]["operations"]
    assert done.exit_code == 0 and re.search(rf"small_point\W+{counts[0]}\W+{counts[1]}\W+{counts[2]}\W", done.stdout)


def test_the_command_refuses_with_named_errors(tmp_path: Path) -> None:
    for arguments in (("no_robot",), (SMALL, "--lock", "slide"), (SMALL, "--base", "flying"), (SMALL, "--frame", "hand")):
        done = command(*arguments, "-o", str(tmp_path / "out"))
        assert isinstance(done.exception, CgaError), arguments
