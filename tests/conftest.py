"""What all tests share: a private cache for compiled kernels, a seeded generator, and the NAO."""

import shutil
import tempfile
from pathlib import Path

import numpy as np
import pytest

import cga_runtime as cga
from cga_runtime.compile import find_compiler


def pytest_configure(config: pytest.Config) -> None:
    """The user's own cache is neither read nor written: every session compiles what it tests, once. Set here and not in a fixture,
    because a test file may open a kernel while it is collected."""
    folder = tempfile.mkdtemp(prefix="cga-tests-")
    config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
    patch = pytest.MonkeyPatch()
    config.add_cleanup(patch.undo)
    patch.setenv("XDG_CACHE_HOME", folder)
    for name in ("CC", "CGA_NO_COMPILER"):  # a developer's settings would choose what is tested
        patch.delenv(name, raising=False)
    config.addinivalue_line("markers", "compiler: compiles C; not run, and said so, where there is no compiler")
    if find_compiler(None) is None:
        config.addinivalue_line("filterwarnings", "ignore::cga_runtime.errors.KernelWarning")


def pytest_report_header() -> str:
    compiler = find_compiler(None)
    return "C compiler: " + (compiler.version if compiler else "none; kernels run as Python text, tests of compiled C are left out")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Without a compiler what needs one cannot be tested; everything else still is."""
    left_out = [item for item in items if item.get_closest_marker("compiler")] if find_compiler(None) is None else []
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if item not in set(left_out)]


@pytest.fixture
def rng() -> np.random.Generator:
    """Seeded anew for every test, so that a test draws the same alone and among all others."""
    return np.random.default_rng(20)


@pytest.fixture(scope="session")
def nao() -> cga.Robot:
    """The bundled NAO."""
    return cga.load_robot("nao")


@pytest.fixture(scope="session")
def arm(nao: cga.Robot) -> cga.Chain:
    """Its right arm: five revolute joints."""
    return nao.chain("RHand")


@pytest.fixture(scope="session")
def loop(nao: cga.Robot) -> cga.ClosedChain:
    """Both arms around one object: ten joints."""
    return cga.ClosedChain(nao.chain("RHand"), nao.chain("LHand"))


@pytest.fixture(scope="session")
def skew() -> cga.Robot:
    """A made-up tree of what the NAO lacks: oblique axes, turned placements, prismatic and continuous joints (tests/data/skew.urdf)."""
    return cga.load_robot(Path(__file__).parent / "data" / "skew.urdf")
