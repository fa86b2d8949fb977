"""Compiles generated C at first use and keeps the library in the cache, named by source, flags, compiler and CPU."""

from __future__ import annotations

import ctypes
import importlib.util
import logging
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
import warnings
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from cga_runtime.cache import cache_folder, digest, locked, write_atomic
from cga_runtime.errors import CacheError, CompilerError, KernelWarning

FLAGS = ("-std=c99", "-O2", "-march=native", "-ffp-contract=fast", "-fPIC", "-shared")
"""No -ffast-math: it gains at most 8 % and gives up NaN and signed zeros."""
TIME_LIMIT = 300.0
LOG = logging.getLogger("cga_runtime")
_ADVICE = "set CC to another compiler, or CGA_NO_COMPILER=1 to run the Python text"


@dataclass(frozen=True)
class Compiler:
    """A command that compiles C, and its version line (part of the cache key)."""

    command: tuple[str, ...]
    version: str


@cache
def find_compiler(choice: str | None) -> Compiler | None:
    """$CC if set (`choice`), else the first of clang, gcc, cc and `python -m ziglang cc` that answers; None if there is none.

    Raises CompilerError if $CC is set and does not answer.
    """
    if choice is not None:
        try:
            command = tuple(shlex.split(choice))
        except ValueError:  # an open quotation mark
            command = ()
        version = _version(command) if command and shutil.which(command[0]) else None
        if version is None:
            raise CompilerError(f"CC={choice!r} does not answer `--version`; unset CC, or name a working C compiler")
        return Compiler(command, version)
    candidates: list[tuple[str, ...]] = [(path,) for name in ("clang", "gcc", "cc") if (path := shutil.which(name))]
    if importlib.util.find_spec("ziglang") is not None:
        candidates.append((sys.executable, "-m", "ziglang", "cc"))
    for command in candidates:
        version = _version(command)
        if version is not None:
            return Compiler(command, version)
    return None


def _version(command: tuple[str, ...]) -> str | None:
    try:
        done = subprocess.run(
            [*command, "--version"], capture_output=True, text=True, errors="replace", timeout=60, stdin=subprocess.DEVNULL
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return done.stdout.splitlines()[0] if done.returncode == 0 and done.stdout else None


@cache
def cpu() -> str:
    """What -march=native depends on: architecture and feature flags."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
        lines = sorted({line for line in text.splitlines() if line.startswith(("flags", "Features", "model name"))})
    except OSError:
        lines = []
    return "\n".join([platform.machine(), platform.processor(), *lines])


def compile_library(name: str, source: str) -> ctypes.CDLL | None:
    """The loaded library of a C source, from the cache or compiled now; None where there is no compiler (warned once).

    A cached library whose digest does not match is thrown away and made again. Raises CompilerError if a compiler is there and fails,
    and CacheError if the cache cannot be trusted. CGA_NO_COMPILER=1 does without a compiler.
    """
    if os.environ.get("CGA_NO_COMPILER", "0") not in ("", "0"):
        _warn_once("CGA_NO_COMPILER is set")
        return None
    compiler = find_compiler(os.environ.get("CC") or None)
    if compiler is None:
        _warn_once("no C compiler was found (set CC, install gcc or clang, or pip install 'cga-robotics[compiler]')")
        return None
    key = digest("\0".join([source, *FLAGS, *compiler.command, compiler.version, cpu()]).encode())[:32]
    library = cache_folder("libraries") / f"{name}-{key}.so"
    try:
        with locked(library):
            if not _intact(library):
                _build(compiler, source, library)
                return _load(compiler, library)
            try:
                return ctypes.CDLL(str(library))
            except OSError:  # whole, but made for another system (a new libc, say): made again, once
                _build(compiler, source, library)
                return _load(compiler, library)
    except OSError as error:
        raise CacheError(f"cannot write {error.filename or library}: {error.strerror}; set XDG_CACHE_HOME to another folder") from error


def _load(compiler: Compiler, library: Path) -> ctypes.CDLL:
    try:
        return ctypes.CDLL(str(library))
    except OSError as error:
        raise CompilerError(f"`{shlex.join(compiler.command)}` made a library that does not load ({error}); {_ADVICE}") from error


@cache
def _warn_once(reason: str) -> None:
    warnings.warn(f"{reason}: kernels run as Python text, about a hundred times slower", KernelWarning, stacklevel=3)


def _seal(library: Path) -> Path:
    return library.with_suffix(".sha256")


def _intact(library: Path) -> bool:
    """Whether library and seal are there, ours, and match: loading a damaged library could kill the process."""
    try:
        if os.name == "posix" and library.stat().st_uid != os.getuid():
            return False
        return _seal(library).read_text(encoding="ascii") == digest(library.read_bytes())
    except (OSError, ValueError):
        return False


def _build(compiler: Compiler, source: str, library: Path) -> None:
    LOG.info("compiling %s: %d kB of C", library.name.rsplit("-", 1)[0], len(source) // 1000)
    with tempfile.TemporaryDirectory(dir=library.parent, prefix=".build-") as build:
        c_file, output = Path(build) / "kernels.c", Path(build) / "kernels.so"
        c_file.write_text(source, encoding="utf-8")
        command = [*compiler.command, *FLAGS, str(c_file), "-o", str(output), "-lm"]
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, errors="replace", timeout=TIME_LIMIT, stdin=subprocess.DEVNULL
            )
        except subprocess.TimeoutExpired:
            raise CompilerError(f"`{shlex.join(command)}` did not finish in {TIME_LIMIT:.0f} s") from None
        except OSError as error:
            raise CompilerError(f"`{shlex.join(command)}` did not start: {error.strerror}") from error
        if done.returncode != 0 or not output.is_file():
            tail = (done.stderr or done.stdout).strip()[-800:]
            outcome = f"failed ({done.returncode})" if done.returncode != 0 else "wrote no library"
            raise CompilerError(f"`{shlex.join(command)}` {outcome}; {_ADVICE}:\n{tail}")
        binary = output.read_bytes()
        # the library first: a run killed in between leaves it unsealed, and the next run makes it again
        write_atomic(library, binary)
        write_atomic(_seal(library), digest(binary).encode())
