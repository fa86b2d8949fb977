"""Lets tests import the robots and the peer in `peers`; the made-up tree as fixtures."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent / "peers"))

from joint_by_joint import SKEW, Subject, loaded, make  # noqa: E402

from cga_codegen.robots.from_urdf import load_urdf  # noqa: E402
from cga_codegen.robots.model import RobotModel  # noqa: E402


@pytest.fixture(scope="session")
def skew_model() -> RobotModel:
    """The made-up tree with masses, rotors, and an oblique gravity."""
    return loaded(load_urdf(SKEW))


@pytest.fixture(scope="session", params=["skew", "skew, mimicking", "skew, floating", "skew, mimicking, floating"])
def subject(request) -> Subject:
    """The made-up tree in four forms, each with its peer."""
    return make(request.param)
