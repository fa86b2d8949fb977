"""The script that feeds mutated robot files to the readers lives, finds nothing in a few of them, and would see a bad reader."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "fuzz_urdf.py"
BAD_READER = """
import sys
sys.path.insert(0, {scripts!r})
import fuzz_urdf, robot_judgement
from cga_codegen.robots import from_urdf, model

def read(given, **_):
    raise {error}

def work(*arguments):
    from_urdf.load_urdf = read
    robot_judgement.load = fuzz_urdf.load = lambda form, given, made: None if not made.data else read(given)
    original(*arguments)

original, fuzz_urdf.work, fuzz_urdf.HANG = fuzz_urdf.work, work, 0.5
if __name__ == "__main__":
    sys.argv[1:] = ["--count", "2", "--jobs", "1", "--out", {out!r}]
    sys.exit(fuzz_urdf.main())
"""


def run(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, *arguments], cwd=ROOT, capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize(("form", "count"), [("urdf", 150), ("mjcf", 50)])
def test_a_few_mutated_files(form, count, tmp_path):
    done = run(str(SCRIPT), "--format", form, "--seed", "0", "--count", str(count), "--jobs", "1", "--out", str(tmp_path / "fuzz"))
    assert (done.returncode, done.stderr.count("Traceback")) == (0, 0), done.stderr
    assert done.stdout.endswith(f"{count} cases, 0 findings\n")
    assert "accepted, agrees with" in done.stdout and "BrokenFileError" in done.stdout
    assert not (tmp_path / "fuzz").exists()


@pytest.mark.parametrize(
    ("error", "found"),
    [
        ("KeyError('x')", "KeyError instead of a named error: 'x'"),
        ("model.ModelError('no')", "a bare ModelError: no"),
        ("from_urdf.BrokenFileError('no')", "not one short sentence that names the file"),
        ("__import__('os').abort()", "the process died (exit code -6)"),
        ("max(iter(int, 1))", "0.5 s of computing and no answer"),
    ],
)
def test_a_bad_reader_is_seen(error, found, tmp_path):
    (tmp_path / "bad.py").write_text(BAD_READER.format(scripts=str(SCRIPT.parent), error=error, out=str(tmp_path / "fuzz")))
    done = run(str(tmp_path / "bad.py"))
    assert done.returncode == 1, done.stderr
    assert done.stdout.endswith("2 cases, 2 findings\n")
    saved = json.loads((tmp_path / "fuzz" / "1-1.json").read_text())
    assert found in saved["found"] and (tmp_path / "fuzz" / "1-1.urdf").stat().st_size > 0
