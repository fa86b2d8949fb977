"""The user's cache folder: private, keyed by content, written through temporary names, so that nothing half-written is ever read."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import tempfile
import warnings
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from cga_runtime.errors import CacheError, KernelWarning


def cache_folder(part: str) -> Path:
    """The folder `part` of $XDG_CACHE_HOME/cga or of the platform's cache folder, mode 700.

    Raises CacheError if the cache belongs to another user or others may write to it: compiled code is never loaded from there.
    A cache that cannot be made or written is replaced by a private temporary one for this process, with one warning.
    """
    root = _root()
    folder = root / part
    try:
        folder.mkdir(exist_ok=True, mode=0o700)
    except OSError as error:
        raise CacheError(f"cannot make the folder {folder} ({error.strerror}); delete {root} or set XDG_CACHE_HOME") from error
    _check_private(folder)
    return folder


def _root() -> Path:
    folder = _location()
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    except OSError as error:
        return _temporary(f"cannot make the cache folder {folder} ({error.strerror})")
    _check_private(folder)
    if not os.access(folder, os.W_OK | os.X_OK):
        return _temporary(f"the cache folder {folder} is read-only")
    return folder


def _location() -> Path:
    root = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(root):
        return Path(root) / "cga"
    default = Path.home() / ".cache" / "cga"
    try:
        import platformdirs
    except ImportError:  # an extra; the XDG default serves where it is missing
        return default
    folder = Path(platformdirs.user_cache_dir("cga", appauthor=False))
    return folder if folder.is_absolute() else default  # older versions follow a relative XDG_CACHE_HOME, which the standard forbids


def _check_private(folder: Path) -> None:
    if os.name != "posix":
        return
    status = folder.stat()
    if status.st_uid != os.getuid():
        raise CacheError(f"{folder} belongs to another user (uid {status.st_uid}); set XDG_CACHE_HOME to a folder of your own")
    if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        raise CacheError(f"{folder} may be written by others; run `chmod 700 {folder}` or set XDG_CACHE_HOME")


@cache
def _temporary(reason: str) -> Path:
    warnings.warn(f"{reason}: kernels are kept in a temporary folder of this process", KernelWarning, stacklevel=2)
    holder = tempfile.TemporaryDirectory(prefix="cga-", ignore_cleanup_errors=True)
    _HOLDERS.append(holder)
    return Path(holder.name)


_HOLDERS: list[tempfile.TemporaryDirectory[str]] = []  # removed when the process ends


@contextlib.contextmanager
def locked(path: Path) -> Iterator[None]:
    """Holds a lock beside `path`, so that two processes do not make the same thing twice.

    Files are renamed into place, so without the filelock extra the worst case is doing the work twice, never a broken file.
    """
    try:
        from filelock import FileLock
    except ImportError:
        yield
        return
    with FileLock(f"{path}.lock"):
        yield


def write_atomic(path: Path, content: bytes, mode: int = 0o600) -> None:
    """Writes a file under a temporary name and renames it into place. Private unless `mode` says otherwise."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.chmod(temporary, mode)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def digest(content: bytes) -> str:
    """SHA-256 in hexadecimal."""
    return hashlib.sha256(content).hexdigest()
