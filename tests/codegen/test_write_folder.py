"""How generated folders are written: whole files only, mendable after a kill, never over what belongs to somebody else."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from cga_codegen import cli
from cga_codegen.emit import manifest as writer
from cga_codegen.emit.manifest import GeneratedFolderError
from cga_codegen.generate import Selection, generate
from cga_codegen.robots.from_urdf import load_urdf
from cga_runtime import StaleKernelError
from cga_runtime.kernels import Library

LINK = '<link name="{0}"/><joint name="to {0}" type="continuous"><parent link="base"/><child link="{0}"/></joint>'


def robot(*names: str):
    """A robot with one joint to each named link."""
    return load_urdf(f'<robot name="small"><link name="base"/>{"".join(LINK.format(name) for name in names)}</robot>')


def write(folder: Path, *names: str) -> None:
    """Generates the chains to all those links."""
    generate([(robot(*names), Selection(names, (), ()))], folder, lambda line: None)


def files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def pose(folder: Path, frame: str) -> np.ndarray:
    """As a new process would find it: the manifest, the description and the kernels are read anew."""
    home = Library(folder)
    home.read("robots/small/robot.json")
    return home.unit(f"robots/small/{frame}").kernel("pose")([0.0])


class Killed(BaseException):
    """What a killed process leaves: nothing after it runs, not even `except Exception`."""


@pytest.mark.parametrize("after", [0, 1, 4, 10])
@pytest.mark.parametrize("first", [True, False], ids=["a new folder", "a folder written before"])
def test_a_run_killed_between_two_files(tmp_path, monkeypatch, first, after):
    """The next load names the command, the next run mends the folder."""
    folder = tmp_path / "out"
    if not first:
        write(folder, "a")
    whole, written = writer._replace, []

    def replace_until_killed(path, text):
        if len(written) == after:
            raise Killed
        whole(path, text)
        written.append(path)

    monkeypatch.setattr(writer, "_replace", replace_until_killed)
    with pytest.raises(Killed):
        write(folder, "a", "b")
    monkeypatch.undo()
    if first or (folder / "robots/small/robot.json") in written:
        with pytest.raises(StaleKernelError, match=rf"; run `cga generate FILE -o {folder}`$"):
            pose(folder, "a")
    else:  # all that was written is as it was before
        assert np.array_equal(pose(folder, "a"), np.eye(4))
    write(folder, "a", "b")
    assert np.array_equal(pose(folder, "b"), np.eye(4))


def test_a_file_appears_whole_or_not_at_all(tmp_path, monkeypatch):
    write(tmp_path / "out", "a")
    before = files(tmp_path / "out")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(GeneratedFolderError, match="^cannot write .*: No space left on device$"):
        write(tmp_path / "out", "b")
    monkeypatch.undo()
    assert files(tmp_path / "out") == before  # and no temporary file is left


def test_files_of_an_earlier_run_go_and_others_stay(tmp_path):
    write(tmp_path / "out", "a", "b")
    (tmp_path / "out" / "notes.txt").write_text("mine")
    write(tmp_path / "out", "b")
    found = files(tmp_path / "out")
    assert "robots/small/b.c" in found and "robots/small/a.c" not in found and found["notes.txt"] == b"mine"


@pytest.mark.parametrize("escape", ["../outside.txt", "/{}/outside.txt"])
def test_a_manifest_cannot_have_other_files_removed(tmp_path, escape):
    victim, folder = tmp_path / "outside.txt", tmp_path / "out"
    victim.write_text("precious")
    folder.mkdir()
    (folder / "manifest.json").write_text(json.dumps({"generator": "cga-robotics", "files": {escape.format(tmp_path): "0"}}))
    write(folder, "a")
    assert victim.read_text() == "precious"


@pytest.mark.parametrize("stranger", ["thesis.tex", ".hidden"])
def test_other_peoples_folders_are_refused(tmp_path, stranger):
    (tmp_path / stranger).write_text("precious")
    with pytest.raises(GeneratedFolderError, match="is not empty and holds no manifest.json: name an empty folder, or one that cga made$"):
        write(tmp_path, "a")
    assert files(tmp_path) == {stranger: b"precious"}


def test_a_manifest_of_something_else_is_not_overwritten(tmp_path):
    """Web pages and browser extensions have a manifest.json too."""
    (tmp_path / "manifest.json").write_text('{"name": "my page", "icons": []}')
    with pytest.raises(GeneratedFolderError, match=r"manifest.json is not a manifest of kernels: name an empty folder"):
        write(tmp_path, "a")
    assert files(tmp_path) == {"manifest.json": b'{"name": "my page", "icons": []}'}


def test_folders_that_cannot_be_written(tmp_path):
    """Root may write everywhere, so files stand where folders are needed; the command says the same sentence and exits with 2."""
    (tmp_path / "file").write_text("")
    with pytest.raises(GeneratedFolderError, match=r"^cannot write .*/file: File exists$"):
        write(tmp_path / "file", "a")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "manifest.json").write_text("{}")
    (tmp_path / "out" / "robots").write_text("")
    with pytest.raises(GeneratedFolderError, match=r"^cannot write .*/robots/small: Not a directory$"):
        write(tmp_path / "out", "a")


def test_the_command_says_why_in_one_sentence(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert cli.main(["generate", "-o", str(tmp_path / "file")]) == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"GeneratedFolderError: cannot write {tmp_path}/file: File exists"
