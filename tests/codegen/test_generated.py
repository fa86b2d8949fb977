"""The checked-in folder is what the generator writes today, to the byte; the loader refuses what was edited, lost or is not ours."""

import difflib
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_codegen import cli
from cga_codegen.emit import manifest as writer
from cga_runtime import StaleKernelError
from cga_runtime.kernels import FORMAT, Library, generated_folder, products

CHECKED_IN = generated_folder()


def files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def first_difference(expected: bytes, found: bytes, path: str) -> str:
    """The first lines of a unified diff."""
    lines = [text.decode(errors="replace").splitlines(keepends=True) for text in (expected, found)]
    return "".join(list(difflib.unified_diff(*lines, f"generated/{path}", f"a fresh {path}"))[:30])


@pytest.fixture(scope="module")
def fresh(tmp_path_factory) -> Path:
    """A folder generated now."""
    folder = tmp_path_factory.mktemp("fresh")
    assert cli.main(["generate", "-o", str(folder)]) == 0
    return folder


@pytest.fixture
def copy(tmp_path) -> Path:
    """A copy of the checked-in folder to damage."""
    return Path(shutil.copytree(CHECKED_IN, tmp_path / "copy"))


def test_the_checked_in_folder_is_fresh(fresh):
    ours, theirs = files(CHECKED_IN), files(fresh)
    advice = "run `./run generate`, look at the difference, and check it in"
    assert ours.keys() == theirs.keys(), f"files differ: {sorted(ours.keys() ^ theirs.keys())}; {advice}"
    for path, text in ours.items():
        assert text == theirs[path], f"{advice}:\n{first_difference(text, theirs[path], path)}"


def test_a_difference_is_shown():
    shown = first_difference(b"a\nb\nc\n", b"a\nB\nc\n", "x.c")
    assert shown == "--- generated/x.c\n+++ a fresh x.c\n@@ -1,3 +1,3 @@\n a\n-b\n+B\n c\n"


def test_writing_again_changes_nothing_and_leaves_nothing_behind(fresh, tmp_path):
    folder = Path(shutil.copytree(fresh, tmp_path / "again"))
    assert cli.main(["generate", "-o", str(folder)]) == 0
    assert files(folder) == files(fresh)


def test_the_folder_holds_text_that_any_system_reads_alike(fresh):
    for path, content in files(fresh).items():
        assert b"\r" not in content and content.endswith(b"\n") and content.isascii(), path
        assert (fresh / path).stat().st_mode & 0o777 == 0o644


# ---- what the loader refuses


def evaluate(folder: Path) -> np.ndarray:
    """Opens everything of a chain: manifest, description, C text or Python text."""
    return cga.load_robot("nao", folder=folder).chain("RHand").pose(np.zeros(5))


def test_a_copy_works(copy, arm):
    assert np.array_equal(evaluate(copy), arm.pose(np.zeros(5)))


DAMAGES = [
    ("robots/nao/RHand.c", lambda text: text.replace("out[0] = t", "out[0] = -t", 1)),
    ("robots/nao/RHand.c", lambda text: text + "\n"),
    ("robots/nao/robot.json", lambda text: text.replace("1", "2", 1)),
    ("robots/nao/RHand.c", lambda text: text[: len(text) // 2]),
]


@pytest.mark.parametrize(("path", "damage"), DAMAGES)
def test_a_file_edited_by_hand_is_refused(copy, path, damage):
    file = copy / path
    file.write_text(damage(file.read_text()))
    with pytest.raises(StaleKernelError) as refusal:
        evaluate(copy)
    reason = "was edited by hand or is stale: it does not match manifest.json"
    assert str(refusal.value) == f"{file} {reason}; run `cga generate FILE -o {copy}`"


def test_an_edited_python_text_is_refused_where_it_is_used(copy):
    file = copy / "robots/nao/RHand.py"
    file.write_text(file.read_text() + "\nprint('never run')\n")
    chain = cga.load_robot("nao", folder=copy).chain("RHand")
    with pytest.raises(StaleKernelError, match="RHand.py was edited by hand"):
        chain.casadi("motor")


def test_a_missing_file_is_named(copy):
    file = copy / "robots/nao/RHand.c"
    file.unlink()
    with pytest.raises(StaleKernelError) as refusal:
        evaluate(copy)
    assert str(refusal.value) == f"cannot read {file}: No such file or directory; run `cga generate FILE -o {copy}`"


def test_the_remedy_of_the_checked_in_folder_is_to_run_generate():
    carried = Library(CHECKED_IN)
    with pytest.raises(StaleKernelError, match=r"absent\.c: No such file or directory; run `\./run generate`$"):
        carried.read("absent.c")


MANIFESTS = [
    ("", "is not a manifest of generated kernels (Expecting value"),
    ('{"format": 2,', "is not a manifest of generated kernels (Expecting property name"),
    ("[]", "is not a manifest of generated kernels (unfinished, or a file of something else)"),
    ("7", "is not a manifest of generated kernels (unfinished, or a file of something else)"),
    ("{}", "is not a manifest of generated kernels (unfinished, or a file of something else)"),
    ('{"format": 2}', "is not a manifest of generated kernels (unfinished, or a file of something else)"),
    ("\udcff", "is not a manifest of generated kernels ('utf-8' codec can't decode"),
]


@pytest.mark.parametrize(("text", "message"), MANIFESTS)
def test_a_broken_manifest_is_refused(copy, text, message):
    (copy / "manifest.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(StaleKernelError) as refusal:
        evaluate(copy)
    assert str(refusal.value).startswith(f"{copy}/manifest.json {message}")
    assert str(refusal.value).endswith(f"; run `cga generate FILE -o {copy}`")


def test_another_format_is_refused(copy):
    listing = copy / "manifest.json"
    listing.write_text(json.dumps(json.loads(listing.read_text()) | {"format": FORMAT + 1}))
    with pytest.raises(StaleKernelError, match=rf"its format is {FORMAT + 1}, this version reads {FORMAT}"):
        evaluate(copy)
    assert writer.FORMAT == FORMAT  # of the writer and of the reader


def test_no_folder_and_no_manifest(tmp_path):
    with pytest.raises(StaleKernelError, match="cannot read .*absent/manifest.json: No such file or directory; run `cga generate FILE -o"):
        cga.load_robot("nao", folder=tmp_path / "absent")


def test_a_file_beside_the_listed_ones_is_not_read(copy):
    (copy / "robots/nao/extra.py").write_text("x = 1\n")
    with pytest.raises(StaleKernelError, match=r"extra\.py was edited by hand or is stale"):
        Library(copy).read("robots/nao/extra.py")


def test_the_products_are_read_through_the_digests():
    assert np.array_equal(products().motor_motor(np.eye(8)[0], np.arange(8.0)), np.arange(8.0))
