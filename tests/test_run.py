"""The script ./run: which Python it takes, when it installs, what it leaves behind when something fails. No network, no second install."""

import fcntl
import hashlib
import os
import shutil
import subprocess
import sys
import threading
import tomllib
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script as a module whose checkout is an empty folder with a pyproject.toml."""
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    loader = SourceFileLoader("run_script", str(ROOT / "run"))
    spec = spec_from_loader("run_script", loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    (tmp_path / "pyproject.toml").write_text("first")
    place(module, tmp_path)
    return module


def place(module: ModuleType, root: Path) -> None:
    module.ROOT, module.VENV = str(root), str(root / ".venv")
    module.PYTHON, module.STAMP = str(root / ".venv/bin/python"), str(root / ".venv/cga-stamp")


def make_fake_venv(module: ModuleType, stamp: str | None) -> Path:
    """What an environment looks like from outside."""
    venv = Path(module.VENV)
    (venv / "bin").mkdir(parents=True)
    base = venv.with_name("base-python")
    base.touch()
    (venv / "bin/python").symlink_to(base)
    (venv / "pyvenv.cfg").write_text("home = /somewhere\nversion = 3.12.4\n")
    if stamp is not None:
        module.write_stamp(stamp or module.fingerprint_now())
    return venv


def fake_python(folder: Path, name: str, answer: str) -> str:
    """An executable that prints what the script's question to a Python would print, or fails if the answer is empty."""
    folder.mkdir(exist_ok=True)
    file = folder / name
    file.write_text(f"#!/bin/sh\necho '{answer}'\necho {file}\n" if answer else "#!/bin/sh\nexit 127\n")
    file.chmod(0o755)
    return str(file)


def test_help_lists_every_command_and_installs_nothing(tmp_path: Path, run: ModuleType) -> None:
    shutil.copy(ROOT / "run", tmp_path / "run")
    answer = subprocess.run([sys.executable, tmp_path / "run", "--help"], capture_output=True, text=True, cwd="/")
    assert (answer.returncode, answer.stderr) == (0, "")
    for command in run.commands():
        assert f"./run {command or ''}".rstrip() in answer.stdout
    assert sorted(os.listdir(tmp_path)) == ["pyproject.toml", "run"]


def test_an_unknown_command_is_refused_before_anything_is_installed(tmp_path: Path) -> None:
    shutil.copy(ROOT / "run", tmp_path / "run")
    answer = subprocess.run([sys.executable, tmp_path / "run", "tests"], capture_output=True, text=True)
    assert (answer.returncode, answer.stdout) == (2, "")
    assert answer.stderr == "./run: there is no command 'tests'; accepted are test, generate, bench, shell, or none; see ./run --help\n"
    assert os.listdir(tmp_path) == ["run"]


@pytest.mark.parametrize(
    ("arguments", "command"),
    [
        ([], ["cga", "report", "nao", "--out", "out/nao"]),
        (["test", "-k", "x"], ["python", "-m", "pytest", "-k", "x"]),
        (["generate", "--prove"], ["python", "-m", "cga_codegen.cli", "generate", "--prove"]),
        (["bench", "--json"], ["cga", "bench", "--out", "out/bench", "--json"]),
        (["shell", "ls", "--help"], ["ls", "--help"]),
    ],
)
def test_what_each_command_becomes(run: ModuleType, monkeypatch: pytest.MonkeyPatch, arguments: list[str], command: list[str]) -> None:
    class Entered(Exception):
        """Stands for the process that the script becomes."""

    def enter(command: list[str], folder: str) -> None:
        raise Entered([command[0].replace(run.VENV + "/bin/", ""), *command[1:]])

    monkeypatch.setattr(os, "environ", dict(os.environ))
    run.install, run.call, run.enter = (lambda: None), (lambda command, **streams: 0), enter
    with pytest.raises(Entered) as entered:
        run.main(arguments)
    assert entered.value.args == (command,)
    assert os.environ["PATH"].startswith(run.VENV + "/bin:") and os.environ["VIRTUAL_ENV"] == run.VENV


@pytest.mark.parametrize(("ruff", "mypy", "pytest_status", "status"), [(1, 0, 0, 1), (0, 2, 0, 1), (1, 1, 4, 4)])
def test_pytest_runs_even_if_a_checker_complains(run: ModuleType, ruff: int, mypy: int, pytest_status: int, status: int) -> None:
    statuses = {"ruff": ruff, "mypy": mypy, "pytest": pytest_status}
    called: list[str] = []
    run.call = lambda command, **streams: called.append(command[2]) or statuses[command[2]]
    with pytest.raises(run.Refusal, match=f"found mistakes .* pytest ended with status {pytest_status}") as refusal:
        run.test([])
    assert called == ["ruff", "mypy", "pytest"] and refusal.value.status == status


@pytest.mark.parametrize(("name", "status"), [("no-such-command", 127), ("pyproject.toml", 126)])
def test_a_command_that_cannot_start(run: ModuleType, name: str, status: int) -> None:
    with pytest.raises(run.Refusal, match=name) as refusal:
        run.enter([os.path.join(run.ROOT, name)], os.getcwd())
    assert refusal.value.status == status


def test_statuses_and_signals_pass_through(run: ModuleType) -> None:
    assert [run.call(["sh", "-c", line]) for line in ("exit 0", "exit 5", "kill -9 $$")] == [0, 5, 137]


def test_the_range_is_the_one_of_pyproject(run: ModuleType) -> None:
    wanted = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["requires-python"]
    assert wanted == f">=3.{run.OLDEST[1]},<3.{run.NEWEST[1] + 1}"
    assert all(run.accepted(version) for version in ((3, 11), (3, 12, 4), (3, 13, 7)))
    assert not any(run.accepted(version) for version in ((2, 12), (3, 10, 9), (3, 14, 0)))


def test_the_running_python_comes_first(run: ModuleType) -> None:
    version, executable = run.choose_python("")
    assert version == sys.version_info[:3]
    assert os.path.realpath(executable) == os.path.realpath(sys.executable)


@pytest.mark.parametrize("running", ["3 9 18", "3 14 0", ""])
def test_another_python_is_looked_for_on_the_path(run: ModuleType, tmp_path: Path, running: str) -> None:
    here = fake_python(tmp_path / "here", "python3", running)
    run.sys = SimpleNamespace(version_info=(3, 9, 18), _base_executable=here)
    fake_python(tmp_path / "shims", "python3.13", "")  # a shim that does not start
    fake_python(tmp_path / "shims", "python3.11", "3 11 2")
    wanted = fake_python(tmp_path / "more", "python3.12", "3 12 4")
    path = os.pathsep.join(str(tmp_path / folder) for folder in ("absent", "shims", "more"))
    assert run.choose_python(path) == ((3, 12, 4), wanted)
    assert run.choose_python(str(tmp_path / "shims"))[0] == (3, 11, 2)


@pytest.mark.parametrize(
    ("version", "sentence"),
    [((3, 9, 18), "is 3.9, and no python3.11, 3.12 or 3.13 is on PATH"), ((3, 12, 4), "sudo apt-get install python3-venv")],
)
def test_no_python_will_do(run: ModuleType, tmp_path: Path, version: tuple[int, ...], sentence: str) -> None:
    run.sys = SimpleNamespace(version_info=version, _base_executable=fake_python(tmp_path / "here", "python3", ""))
    with pytest.raises(run.Refusal, match=sentence):
        run.choose_python(str(tmp_path))


def test_every_part_counts_in_the_fingerprint(run: ModuleType) -> None:
    parts = (b"pyproject", "/root", "/usr/bin/python3.11", "3.11.2")
    others = [(*parts[:k], "other", *parts[k + 1 :]) for k in range(4)]
    assert len({run.fingerprint(*some) for some in [parts, *others, parts]}) == 5


def test_the_states_of_an_environment(run: ModuleType, tmp_path: Path) -> None:
    assert run.state() == "unmade"
    venv = make_fake_venv(run, None)
    assert run.state() == "foreign"
    run.write_stamp(run.UNFINISHED)
    assert run.state() == "unmade"
    run.write_stamp(run.fingerprint_now())
    assert run.state() == "ready" and sorted(os.listdir(venv)) == ["bin", "cga-stamp", "pyvenv.cfg"]
    (tmp_path / "pyproject.toml").write_text("second")
    assert run.state() == "outdated"
    (venv / "pyvenv.cfg").write_text("version = 3.13.0\n")
    assert run.state() == "unmade"
    (venv / "pyvenv.cfg").unlink()
    assert run.state() == "unmade"


def test_a_moved_checkout_and_a_vanished_python_ask_for_a_new_environment(run: ModuleType, tmp_path: Path) -> None:
    make_fake_venv(run, "")
    shutil.copytree(tmp_path, tmp_path.with_name("moved"), symlinks=True)
    place(run, tmp_path.with_name("moved"))
    assert run.state() == "unmade"
    place(run, tmp_path)
    assert run.state() == "ready"
    (tmp_path / "base-python").unlink()
    assert run.state() == "unmade"


@pytest.fixture
def pip(run: ModuleType) -> SimpleNamespace:
    """Stands in for pip and venv: `commands` are pip's calls, `stamps` the stamps they found, `made` counts new environments."""
    record = SimpleNamespace(commands=[], stamps=[], made=0, status=0)

    def make_venv(lock: int) -> None:
        record.made += 1
        shutil.rmtree(run.VENV, ignore_errors=True)
        make_fake_venv(run, run.UNFINISHED)

    def call(command: list[str], locks: tuple[int, ...]) -> int:
        record.commands.append(command[1:])
        record.stamps.append(Path(run.STAMP).read_text().strip())
        if record.status == "interrupt":
            raise KeyboardInterrupt
        return int(record.status)

    def enter(command: list[str], folder: str) -> None:
        raise AssertionError("a command was run")

    run.make_venv, run.call, run.enter = make_venv, call, enter
    return record


def test_installs_once_and_again_only_for_a_new_pyproject(run: ModuleType, pip: SimpleNamespace, tmp_path: Path) -> None:
    run.install()
    run.install()
    assert pip.commands == [["-m", "pip", "install", "-e", ".[all,dev]"]] and pip.made == 1
    (tmp_path / "pyproject.toml").write_text("second")
    run.install()
    run.install()
    assert len(pip.commands) == 2 and pip.made == 1
    assert pip.stamps == [run.UNFINISHED] * 2


@pytest.mark.parametrize(("trouble", "status"), [(3, 3), ("interrupt", 130)])
def test_a_broken_install_leaves_no_stamp(run: ModuleType, pip: SimpleNamespace, trouble: int | str, status: int) -> None:
    pip.status = trouble
    assert run.main(["shell", "true"]) == status
    assert run.state() == "unmade"
    pip.status = 0
    run.install()
    assert run.state() == "ready" and pip.made == 2


def test_a_foreign_environment_is_left_alone(run: ModuleType, pip: SimpleNamespace, capsys: pytest.CaptureFixture[str]) -> None:
    venv = make_fake_venv(run, None)
    assert run.main([]) == 1
    assert "did not make; move it away or delete it" in capsys.readouterr().err
    assert (pip.commands, pip.made, sorted(os.listdir(venv))) == ([], 0, ["bin", "pyvenv.cfg"])


def test_waits_for_another_install_and_uses_its_result(run: ModuleType, pip: SimpleNamespace) -> None:
    waiting, sentences = threading.Event(), []
    run.say = lambda sentence: (sentences.append(sentence), waiting.set())
    other = os.open(run.ROOT, os.O_RDONLY)
    fcntl.flock(other, fcntl.LOCK_EX)
    thread = threading.Thread(target=run.install)
    thread.start()
    assert waiting.wait(30)
    thread.join(0.2)
    assert thread.is_alive()
    make_fake_venv(run, "")
    os.close(other)
    thread.join(30)
    assert not thread.is_alive()
    assert (sentences, pip.commands, pip.made) == (["waiting for another ./run that is installing"], [], 0)


@pytest.fixture
def index(tmp_path: Path) -> Iterator[tuple[str, Path]]:
    """A package index on this machine: its address, and the folder of its page on pip."""
    folder = tmp_path / "simple/pip"
    folder.mkdir(parents=True)
    handler = type("Quiet", (SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(handler, directory=str(tmp_path)))
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}/simple/", folder
    server.shutdown()
    server.server_close()
    thread.join()


def test_takes_the_newest_pip_that_runs_here_and_checks_it(run: ModuleType, tmp_path: Path, index: tuple[str, Path]) -> None:
    address, folder = index
    (tmp_path / "files").mkdir()
    (tmp_path / "files/pip-24.10-py3-none-any.whl").write_bytes(b"a wheel")
    digest = hashlib.sha256(b"a wheel").hexdigest()
    links = [
        ("../../files/pip-24.9-py3-none-any.whl", 'data-requires-python="&gt;=3.8"'),
        ("../../files/pip-24.10-py3-none-any.whl", 'data-requires-python="&gt;=3.8"'),
        ("../../files/pip-24.11-py3-none-any.whl", 'data-yanked=""'),
        ("../../files/pip-99.0-py3-none-any.whl", 'data-requires-python="&gt;=3.12"'),
        ("../../files/pip-99.1.tar.gz", ""),
    ]
    (folder / "index.html").write_text("\n".join(f'<a href="{href}#sha256={digest}" {more}>pip</a>' for href, more in links))
    file = Path(run.wheel_of_index(address, str(tmp_path)))
    assert file == tmp_path / "pip-24.10-py3-none-any.whl" and file.read_bytes() == b"a wheel"
    (tmp_path / "files/pip-24.10-py3-none-any.whl").write_bytes(b"not that wheel")
    with pytest.raises(OSError, match="damaged"):
        run.wheel_of_index(address, str(tmp_path))
    (folder / "index.html").write_text("<p>nothing</p>")
    with pytest.raises(OSError, match="no pip wheel"):
        run.wheel_of_index(address, str(tmp_path))
