"""The user's cache: private or refused, replaced by a temporary folder where it cannot be made; generated text in it is checked."""

import os
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import platformdirs
import pytest

from cga_runtime import CacheError, ChainError, KernelWarning, cache, workshop
from cga_runtime.cache import cache_folder
from cga_runtime.compile import compile_library

SOURCE = "int answer(void)\n{\n    return 42;\n}\n"
OFFSET = (0.01, 0.02, 0.03)


@pytest.fixture
def root(tmp_path, monkeypatch) -> Path:
    """Where this test's cache will be; nothing is there yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "cga"


# ---- whose it is


def test_the_cache_is_private(root):
    previous = os.umask(0)  # the mode is asked for, not left to the user's umask
    try:
        assert cache_folder("libraries") == root / "libraries"
    finally:
        os.umask(previous)
    assert root.stat().st_mode & 0o777 == 0o700 and (root / "libraries").stat().st_mode & 0o777 == 0o700


@pytest.mark.parametrize("mode", [0o770, 0o720, 0o702, 0o777])
@pytest.mark.compiler
def test_a_cache_that_others_may_write_is_refused(root, mode, nao):
    root.mkdir(parents=True)
    root.chmod(mode)
    for use in (lambda: compile_library("test", SOURCE), lambda: nao.chain("RHand", offset=OFFSET)):
        with pytest.raises(CacheError) as refusal:
            use()
        assert str(refusal.value) == f"{root} may be written by others; run `chmod 700 {root}` or set XDG_CACHE_HOME"
    root.chmod(0o755)  # to be read by others does no harm
    assert compile_library("test", SOURCE).answer() == 42


@pytest.mark.parametrize("mode", [0o770, 0o703])
@pytest.mark.compiler
def test_a_part_that_others_may_write_is_refused(root, mode):
    part = cache_folder("libraries")
    part.chmod(mode)
    with pytest.raises(CacheError) as refusal:
        compile_library("test", SOURCE)
    assert str(refusal.value) == f"{part} may be written by others; run `chmod 700 {part}` or set XDG_CACHE_HOME"


@pytest.mark.compiler
def test_a_cache_of_another_user_is_refused(root, monkeypatch):
    root.mkdir(parents=True, mode=0o700)
    owner = root.stat().st_uid
    monkeypatch.setattr(os, "getuid", lambda: owner + 1)
    with pytest.raises(CacheError) as refusal:
        compile_library("test", SOURCE)
    assert str(refusal.value) == f"{root} belongs to another user (uid {owner}); set XDG_CACHE_HOME to a folder of your own"


# ---- where it is


def test_a_relative_xdg_cache_home_is_ignored(tmp_path, monkeypatch):
    """The standard says so; a cache that depends on the current folder would be somebody else's tomorrow."""
    monkeypatch.setenv("XDG_CACHE_HOME", "relative")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    for module in (platformdirs, None, types.SimpleNamespace(user_cache_dir=lambda *_, **__: "relative/cga")):
        monkeypatch.setitem(sys.modules, "platformdirs", module)
        folder = cache_folder("libraries")
        assert folder.is_absolute() and folder.is_relative_to(tmp_path) and not folder.is_relative_to(tmp_path / "relative")


# ---- where none can be


def blocked_by_a_file(root):
    root.parent.write_text("")


def blocked_itself(root):
    root.parent.mkdir()
    root.write_text("")


@pytest.mark.parametrize("block", [blocked_by_a_file, blocked_itself])
@pytest.mark.compiler
def test_a_cache_that_cannot_be_made(root, block, nao):
    """Files stand in the way, because root may write anywhere: a temporary folder serves this process, and one warning says so."""
    block(root)
    with pytest.warns(KernelWarning, match=rf"^cannot make the cache folder {root} \(.*\): kernels are kept in a temporary folder"):
        first = cache_folder("libraries")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert cache_folder("libraries") == first
        assert compile_library("test", SOURCE).answer() == 42 and list(first.glob("test-*.so"))
        assert np.isfinite(nao.chain("RHand", offset=OFFSET).point(np.zeros(5))).all()
    assert first.parent.stat().st_mode & 0o777 == 0o700 and not first.is_relative_to(root.parent)


def test_a_read_only_cache(root, monkeypatch):
    """What os.access says to everyone but root."""
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != root)
    with pytest.warns(KernelWarning, match=rf"^the cache folder {root} is read-only: kernels are kept in a temporary folder"):
        assert not cache_folder("libraries").is_relative_to(root)


def test_temporary_folders_go_when_the_process_ends(root):
    blocked_itself(root)
    with pytest.warns(KernelWarning):
        folder = cache_folder("libraries")
    (holder,) = (holder for holder in cache._HOLDERS if Path(holder.name) == folder.parent)
    holder.cleanup()  # what its finalizer does
    assert not folder.exists()
    cache._HOLDERS.remove(holder)


@pytest.mark.parametrize("part", ["libraries", "generated"])
@pytest.mark.compiler
def test_a_file_in_place_of_a_part(root, part, nao):
    root.mkdir(parents=True, mode=0o700)
    (root / part).write_text("")
    with pytest.raises(CacheError) as refusal:
        nao.chain("RHand", offset=OFFSET) if part == "generated" else compile_library("test", SOURCE)
    assert str(refusal.value) == f"cannot make the folder {root / part} (File exists); delete {root} or set XDG_CACHE_HOME"


# ---- generated text in it


def generated(root: Path) -> list[Path]:
    return sorted(path for path in (root / "generated").iterdir() if path.is_dir())


DAMAGES = {
    "edited": lambda folder: (folder / "robots/nao/RHand.py").write_text("raise SystemExit('code from a damaged cache was run')"),
    "lost": lambda folder: (folder / "robots/nao/RHand.c").unlink(),
    "no manifest": lambda folder: (folder / "manifest.json").unlink(),
    "a broken manifest": lambda folder: (folder / "manifest.json").write_text('{"format": 1'),
    "an empty manifest": lambda folder: (folder / "manifest.json").write_text("{}"),
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_damaged_text_is_generated_again(root, nao, damage):
    expected = nao.chain("RHand", offset=OFFSET).point(np.zeros(5))
    (folder,) = generated(root)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    damage(folder)
    chain = nao.chain("RHand", offset=OFFSET)
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before
    assert np.array_equal(chain.point(np.zeros(5)), expected)
    assert np.abs(np.array(chain.casadi("point")(np.zeros(5))).ravel() - expected).max() < 1e-15


def test_every_option_has_its_own_text(root, nao):
    chains = [nao.chain("RHand", offset=OFFSET), nao.chain("LHand", offset=OFFSET), nao.chain("RHand", root="RShoulder")]
    chains.append(nao.chain("RHand", placement=np.eye(4)))
    assert len(generated(root)) == 4
    assert len({chain.point(np.zeros(chain.n)).tobytes() for chain in chains}) == 4
    nao.chain("RHand", offset=OFFSET)
    assert len(generated(root)) == 4


def test_another_generator_generates_anew(root, nao, monkeypatch):
    nao.chain("RHand", offset=OFFSET)
    monkeypatch.setattr(workshop, "_generator_digest", lambda: "another")
    nao.chain("RHand", offset=OFFSET)
    assert len(generated(root)) == 2


def test_text_that_cannot_be_written_is_a_sentence(root, nao, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(CacheError, match="^cannot write .*: No space left on device$"):
        nao.chain("RHand", offset=OFFSET)


def test_nothing_is_generated_for_a_chain_that_does_not_exist(root, nao):
    with pytest.raises(ChainError):
        nao.chain("torso")
    assert generated(root) == []
