"""Kernels in processes of their own: with and without a compiler, several at once, and after one that was killed while compiling."""

import json
import os
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from cga_runtime.compile import find_compiler

CHILD = """
import json, os, sys, time, warnings
for name in sys.argv[1].split(","):
    if name:
        sys.modules[name] = None  # as if it were not installed
gate = sys.argv[2]
import numpy as np
import cga_runtime as cga
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    robot = cga.load_robot("nao")
    if gate:
        open(f"{gate}.{os.getpid()}", "w").close()
        while not os.path.exists(gate):
            time.sleep(0.01)
    q = np.linspace(-0.5, 0.5, 10)
    arms = [robot.chain("RHand"), robot.chain("LHand"), robot.chain("RHand", offset=(0.01, 0.02, 0.03))]
    loop = cga.ClosedChain(*arms[:2])
    values = [arm.pose(q[:5]).tolist() for arm in arms] + [arm.jacobian(np.array([q[:5]] * 3)).tolist() for arm in arms]
    values += [loop.grasp(q).tolist(), loop.determinant(q, [1, 2, 6, 7]).tolist()]
    compiled = arms[0].kernel("pose")._entries is not None
print(json.dumps({"values": values, "compiled": compiled, "warnings": [[w.category.__name__, str(w.message)] for w in caught]}))
"""


@pytest.fixture
def start(tmp_path, monkeypatch):
    """Starts the child in a cache of this test; `without`: modules that are not there; `gate`: a file it waits for before it compiles."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    started = []

    def process(without="", gate="", **environment):
        command = [sys.executable, "-c", CHILD, without, str(gate)]
        channels = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "start_new_session": True}
        started.append(subprocess.Popen(command, env={**os.environ, **environment}, **channels))
        return started[-1]

    yield process
    for child in started:
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGKILL)
        child.communicate()


def result(child):
    out, err = child.communicate()
    assert child.returncode == 0, err
    return json.loads(out)


def values(found):
    return np.concatenate([np.ravel(value) for value in found["values"]])


def script(path: Path, lines: str) -> str:
    """A compiler that answers --version and for everything else runs the lines; REAL is one that works."""
    text = lines.replace("REAL", shlex.join(find_compiler(None).command))
    path.write_text(f'#!/bin/sh\nif [ "$*" = "--version" ]; then echo fake 1; exit 0; fi\n{text}\n')
    path.chmod(0o755)
    return shlex.quote(str(path))


def until(condition) -> None:
    """Waits for something that another process does."""
    for _ in range(6000):
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError("the other process did not get there in a minute")


@pytest.mark.compiler
def test_python_text_gives_the_same_values_with_one_warning(start):
    compiled, text = result(start()), result(start(CGA_NO_COMPILER="1"))
    assert compiled["compiled"] and not compiled["warnings"]
    assert not text["compiled"]
    assert text["warnings"] == [["KernelWarning", "CGA_NO_COMPILER is set: kernels run as Python text, about a hundred times slower"]]
    assert np.abs(values(text) - values(compiled)).max() < 1e-13 * np.abs(values(compiled)).max()


def test_a_machine_without_a_compiler(start, tmp_path):
    """Nothing but Python on the search path, and no ziglang."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "python").symlink_to(sys.executable)
    compiled, text = result(start()), result(start("ziglang", PATH=str(tmp_path / "bin")))
    advice = "no C compiler was found (set CC, install gcc or clang, or pip install 'cga-robotics[compiler]')"
    assert text["warnings"] == [["KernelWarning", f"{advice}: kernels run as Python text, about a hundred times slower"]]
    assert not text["compiled"] and np.abs(values(text) - values(compiled)).max() < 1e-13 * np.abs(values(compiled)).max()


@pytest.mark.compiler
def test_extras_that_are_not_installed(start):
    """numpy and casadi are enough: no lock, no platformdirs, no pinocchio, no sympy, no typer."""
    plain, bare = result(start()), result(start("filelock,platformdirs,pinocchio,sympy,typer,rich,mujoco"))
    assert bare["compiled"] and not bare["warnings"] and bare["values"] == plain["values"]


@pytest.mark.compiler
def test_a_compiler_that_fails_reaches_the_user(start, tmp_path):
    child = start(CC=script(tmp_path / "cc", "echo no space for code >&2; exit 1"))
    _, err = child.communicate()
    assert child.returncode == 1 and "CompilerError: `" in err and err.rstrip().endswith("no space for code")


@pytest.mark.compiler
def test_processes_at_once_compile_once(start, tmp_path):
    choice = script(tmp_path / "cc", f'echo "$$" >>{tmp_path}/log; REAL "$@"')
    gate = tmp_path / "gate"
    children = [start(gate=gate, CC=choice) for _ in range(4)]
    until(lambda: len(list(tmp_path.glob("gate.*"))) == 4)
    gate.touch()
    found = [result(child) for child in children]
    assert all(one["compiled"] and not one["warnings"] and one["values"] == found[0]["values"] for one in found)
    libraries = list((tmp_path / "cache" / "cga" / "libraries").glob("*.so"))
    assert len((tmp_path / "log").read_text().splitlines()) == len(libraries) == 5  # three chains, their loop, the brackets


@pytest.mark.compiler
def test_processes_at_once_without_locks(start, tmp_path):
    """Both compile the same file at the same time (each waits for the other to begin): both are right, and one result stays."""
    waiting = f'touch {tmp_path}/begun.$$; while [ "$(ls {tmp_path}/begun.* | wc -l)" -lt 2 ]; do sleep 0.01; done; REAL "$@"'
    choice = script(tmp_path / "cc", waiting)
    found = [result(child) for child in [start("filelock", CC=choice) for _ in range(2)]]
    assert found[0] == found[1] and found[0]["compiled"] and not found[0]["warnings"]
    folder = tmp_path / "cache" / "cga" / "libraries"
    assert len(list(folder.glob("*.so"))) == len(list(folder.glob("*.sha256"))) == 5 and not list(folder.glob(".*"))


@pytest.mark.compiler
def test_a_compile_that_was_killed_leaves_nothing_that_is_loaded(start, tmp_path):
    """Half a library is on the disk when the process is killed; the next one takes its lock, compiles anew, and is right."""
    half = f'while [ "$1" != -o ]; do shift; done; echo half >"$2"; touch {tmp_path}/half; exec sleep 600'
    choice = script(tmp_path / "cc", f'if [ -e {tmp_path}/stuck ]; then {half}; fi; REAL "$@"')
    (tmp_path / "stuck").touch()
    child = start(CC=choice)
    until((tmp_path / "half").exists)
    os.killpg(child.pid, signal.SIGKILL)
    child.communicate()
    folder = tmp_path / "cache" / "cga" / "libraries"
    assert [file.read_text() for file in folder.rglob("kernels.so")] == ["half\n"] and not list(folder.glob("*.so"))
    (tmp_path / "stuck").unlink()
    found = result(start(CC=choice))
    assert found["compiled"] and not found["warnings"]
    plain = values(result(start()))
    assert np.abs(values(found) - plain).max() < 1e-13 * np.abs(plain).max()


def test_two_processes_generate_the_same_text_at_once(start, tmp_path):
    gate = tmp_path / "gate"
    children = [start("filelock", gate=gate) for _ in range(3)]
    until(lambda: len(list(tmp_path.glob("gate.*"))) == 3)
    gate.touch()
    found = [result(child) for child in children]
    assert all(one == found[0] for one in found)
