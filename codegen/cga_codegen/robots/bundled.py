"""The robots that come with the package: mesh-free URDF files whose header comments name the sources of every number."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import Path

from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import ModelError, RobotModel


def bundled_robots() -> dict[str, Path]:
    """Names of the bundled robots, sorted, with their files."""
    folder = Path(str(files("cga_codegen.robots") / "bundled"))
    return {path.stem: path for path in sorted(folder.glob("*.urdf"))}


@cache
def load_bundled(name: str) -> RobotModel:
    """The bundled robot of that name; a ModelError lists the names there are."""
    robots = bundled_robots()
    if name not in robots:
        raise ModelError(f"no bundled robot is called {name!r}; bundled robots: {', '.join(robots)}")
    return load_urdf(robots[name], name)
