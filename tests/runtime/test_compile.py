"""Compiling at first use: which compiler is chosen, what its failures say, and that only whole, sealed libraries are ever loaded."""

import ctypes
import hashlib
import os
import shlex
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from cga_runtime import CacheError, CompilerError, KernelWarning, compile
from cga_runtime.compile import compile_library, find_compiler

SOURCE = "int answer(void)\n{\n    return 42;\n}\n"


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    """An empty cache of this test; the folder in which libraries will be."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "cga" / "libraries"


@pytest.fixture
def compiler(tmp_path, monkeypatch):
    """Sets CC to a script: its answer to --version is `fake 1`, for everything else it runs the given lines."""
    real = shlex.join(find_compiler(None).command)

    def choose(lines: str, name: str = "cc") -> str:
        script = tmp_path / name
        script.write_text(f'#!/bin/sh\nif [ "$*" = "--version" ]; then echo fake 1; exit 0; fi\n{lines.replace("REAL", real)}\n')
        script.chmod(0o755)
        monkeypatch.setenv("CC", shlex.quote(str(script)))
        return str(script)

    return choose


@pytest.fixture
def new_search() -> Iterator[Callable[[], None]]:
    """Forgets which compilers were found, as a new process would; and once more when the test is over."""
    find_compiler.cache_clear()
    yield find_compiler.cache_clear
    find_compiler.cache_clear()


def answer(source: str = SOURCE) -> int:
    return compile_library("test", source).answer()


def libraries(cache: Path) -> list[Path]:
    return sorted(cache.glob("*.so"))


@pytest.mark.compiler
def test_a_library_is_made_once_and_sealed(cache, compiler, tmp_path):
    compiler(f'echo called >>{tmp_path}/log; REAL "$@"')
    assert answer() == 42
    (library,) = libraries(cache)
    assert library.name.startswith("test-") and library.with_suffix(".sha256").is_file()
    assert answer() == 42 and (tmp_path / "log").read_text() == "called\n"
    assert answer(SOURCE.replace("42", "43")) == 43 and len(libraries(cache)) == 2
    for folder in (cache, cache.parent):
        assert folder.stat().st_mode & 0o777 == 0o700
    assert all(file.stat().st_mode & 0o077 == 0 for file in cache.iterdir() if file.suffix in (".so", ".sha256"))
    assert not list(cache.glob(".*"))


@pytest.mark.compiler
def test_compiler_arguments_are_passed_on_and_part_of_the_name(cache, monkeypatch):
    real = shlex.join(find_compiler(None).command)
    for value in (5, 7):
        monkeypatch.setenv("CC", f"{real} -DANSWER={value} '-DWITH_SPACE=a b'")
        assert answer("int answer(void) { return ANSWER; }\n") == value
    assert len(libraries(cache)) == 2


@pytest.mark.compiler
def test_another_version_of_the_compiler_compiles_anew(cache, compiler, new_search):
    script = compiler('REAL "$@"')
    assert answer() == 42
    Path(script).write_text(Path(script).read_text().replace("fake 1", "fake 2"))
    new_search()
    assert answer() == 42 and len(libraries(cache)) == 2


# ---- compilers that do not work


@pytest.mark.parametrize("choice", ["/nowhere/cc", "no-such-compiler --fast", "false", 'gcc "', " ", "/"])
def test_a_choice_that_does_not_answer(cache, choice):
    with pytest.raises(CompilerError) as refusal:
        find_compiler(choice)
    assert str(refusal.value) == f"CC={choice!r} does not answer `--version`; unset CC, or name a working C compiler"


@pytest.mark.compiler
def test_cc_is_the_choice(cache, monkeypatch):
    monkeypatch.setenv("CC", "/nowhere/cc")
    with pytest.raises(CompilerError, match="^CC='/nowhere/cc' does not answer"):
        answer()
    monkeypatch.setenv("CC", "")
    assert answer() == 42


FAILURES = [
    ("echo 'kernels.c:1: error: I give up' >&2; exit 3", r"failed \(3\); {advice}:\nkernels.c:1: error: I give up$"),
    ("echo 'said on the wrong channel'; exit 1", r"failed \(1\); {advice}:\nsaid on the wrong channel$"),
    ("seq 1 5000 >&2; echo the end >&2; exit 1", r"failed \(1\); {advice}:\n[0-9\n]{{780,800}}the end$"),
    ("printf 'erreur: caract\\351re\\n' >&2; exit 1", "failed .*erreur: caract\ufffdre$"),
    ("exit 0", r"wrote no library; {advice}:\n$"),
    ("kill -9 $$", r"failed \(-9\); {advice}:\n$"),
]


@pytest.mark.parametrize(("lines", "message"), FAILURES, ids=["error", "error on stdout", "long", "not UTF-8", "no output", "killed"])
@pytest.mark.compiler
def test_a_compiler_that_fails(cache, compiler, lines, message):
    script = compiler(lines)
    advice = "set CC to another compiler, or CGA_NO_COMPILER=1 to run the Python text"
    with pytest.raises(CompilerError, match=rf"(?s)^`{script} -std=c99 .*kernels.so -lm` {message.format(advice=advice)}"):
        answer()
    assert not libraries(cache) and not list(cache.glob(".build-*"))


@pytest.mark.compiler
def test_a_real_error_message_reaches_the_user(cache):
    with pytest.raises(CompilerError, match=r"kernels\.c:3.*undeclared"):
        compile_library("test", "int answer(void)\n{\n    return unknown_name;\n}\n")


@pytest.mark.compiler
def test_a_library_that_does_not_load(cache, compiler):
    script = compiler('while [ "$1" != -o ]; do shift; done; echo garbage >"$2"')
    with pytest.raises(CompilerError, match=rf"^`{script}` made a library that does not load \(.*\); set CC to another compiler"):
        answer()


@pytest.mark.compiler
def test_a_compiler_that_hangs(cache, compiler, monkeypatch):
    script = compiler("exec sleep 600")
    monkeypatch.setattr(compile, "TIME_LIMIT", 0.2)
    with pytest.raises(CompilerError, match=rf"^`{script} .*` did not finish in 0 s$"):
        answer()


@pytest.mark.compiler
def test_a_compiler_that_vanishes(cache, compiler):
    script = compiler('REAL "$@"')
    assert find_compiler(os.environ["CC"]).version == "fake 1"
    os.remove(script)
    with pytest.raises(CompilerError, match=rf"^`{script} .*` did not start: No such file or directory$"):
        answer()


# ---- damaged caches


def truncated(library: Path) -> None:
    library.write_bytes(library.read_bytes()[:1000])


def garbage(library: Path) -> None:
    library.write_bytes(b"\x7fELF" + bytes(4000))


DAMAGES = {
    "truncated": truncated,
    "emptied": lambda library: library.write_bytes(b""),
    "garbage": garbage,
    "another library": lambda library: library.write_bytes(library.read_bytes().replace(b"answer", b"ANSWER")),
    "no library": lambda library: library.unlink(),
    "no seal": lambda library: library.with_suffix(".sha256").unlink(),
    "half a seal": lambda library: library.with_suffix(".sha256").write_text("0123"),
    "a seal that is no text": lambda library: library.with_suffix(".sha256").write_bytes(b"\xff\x00"),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
@pytest.mark.compiler
def test_a_damaged_library_is_made_again(cache, compiler, tmp_path, damage):
    compiler(f'echo called >>{tmp_path}/log; REAL "$@"')
    assert answer() == 42
    (library,) = libraries(cache)
    sound = library.read_bytes()
    replaced = library.with_suffix(".new")  # a new file, so that the library this process has open stays as it is
    replaced.write_bytes(sound)
    os.replace(replaced, library)
    damage(library)
    assert answer() == 42
    assert (tmp_path / "log").read_text() == "called\n" * 2
    assert ctypes.CDLL(str(library)).answer() == 42 and compile._intact(library)


@pytest.mark.parametrize("content", [b"", b"garbage"])
@pytest.mark.compiler
def test_a_sealed_library_of_another_system_is_made_again(cache, content):
    """Library and seal agree, but it does not load here: after a change of the C library, say, which the name does not show."""
    assert answer() == 42
    (library,) = libraries(cache)
    for file, text in ((library, content), (library.with_suffix(".sha256"), hashlib.sha256(content).hexdigest().encode())):
        file.unlink()  # the library this process has open stays as it is
        file.write_bytes(text)
    assert answer() == 42 and compile._intact(library)


@pytest.mark.compiler
def test_a_library_of_another_user_is_made_again(cache, monkeypatch):
    assert answer() == 42
    (library,) = libraries(cache)
    assert compile._intact(library)
    owner = library.stat().st_uid
    monkeypatch.setattr(os, "getuid", lambda: owner + 1)
    assert not compile._intact(library)


@pytest.mark.compiler
def test_a_run_killed_between_library_and_seal(cache, monkeypatch):
    class Killed(BaseException):
        pass

    def killed(path, content):
        if path.suffix == ".sha256":
            raise Killed
        whole(path, content)

    whole = compile.write_atomic
    monkeypatch.setattr(compile, "write_atomic", killed)
    with pytest.raises(Killed):
        answer()
    (library,) = libraries(cache)
    assert not compile._intact(library)
    monkeypatch.setattr(compile, "write_atomic", whole)
    assert answer() == 42 and compile._intact(library)


# ---- doing without


@pytest.mark.compiler
def test_without_a_compiler_there_is_one_warning(cache, monkeypatch):
    compile._warn_once.cache_clear()
    monkeypatch.setenv("CGA_NO_COMPILER", "1")
    with pytest.warns(KernelWarning, match="^CGA_NO_COMPILER is set: kernels run as Python text, about a hundred times slower$"):
        assert compile_library("test", SOURCE) is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert compile_library("test", SOURCE) is None
    assert not cache.exists()
    for off in ("", "0"):
        monkeypatch.setenv("CGA_NO_COMPILER", off)
        assert answer() == 42


def test_compilers_are_searched_in_order(tmp_path, monkeypatch, new_search):
    """clang, gcc, cc, then ziglang from pip; those that do not answer are passed over."""
    order = ["clang", "gcc", "cc"]
    for name in order:
        (tmp_path / name).write_text(f"#!/bin/sh\necho {name} 1.0\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "ziglang").mkdir()
    (tmp_path / "ziglang" / "__init__.py").write_text("")
    (tmp_path / "ziglang" / "__main__.py").write_text("import sys\nprint('zig', *sys.argv[1:])\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.delitem(sys.modules, "ziglang", raising=False)
    for name in order:
        new_search()
        assert find_compiler(None).version == f"{name} 1.0"
        (tmp_path / name).write_text("#!/bin/sh\nexit 1\n")
    new_search()
    found = find_compiler(None)
    assert found.command == (sys.executable, "-m", "ziglang", "cc") and found.version == "zig cc --version"
    monkeypatch.setitem(sys.modules, "ziglang", None)
    new_search()
    assert find_compiler(None) is None


@pytest.mark.compiler
def test_a_full_disk_is_a_sentence(cache, monkeypatch):
    def full(path, content):
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(compile, "write_atomic", full)
    with pytest.raises(CacheError, match=r"^cannot write .*\.so: No space left on device; set XDG_CACHE_HOME to another folder$"):
        answer()
