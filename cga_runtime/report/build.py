"""Builds the report of one robot: every section in order, then report.json and index.html, both or neither half-written."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from time import perf_counter
from types import ModuleType
from typing import Any

from cga_runtime import __version__
from cga_runtime.cache import write_atomic
from cga_runtime.errors import FolderError
from cga_runtime.loading import load_robot
from cga_runtime.report import constraint, cooperative, kernels, limb, mobility, nearest, reaching, schemes, strict_json
from cga_runtime.report.context import Context, Sizes

SECTIONS: tuple[tuple[str, ModuleType, int], ...] = (
    ("mobility", mobility, 1),
    ("limb", limb, 1),
    ("constraint", constraint, 1),
    ("schemes", schemes, 6),
    ("reaching", reaching, 40),
    ("cooperative", cooperative, 3),
    ("nearest", nearest, 20),
    ("kernels", kernels, 6),
)
"""Key in report.json, module with section(context) and, unless it has none, figures(context), and about how much of the time it takes."""
PAGE = 5


class ReportFolderError(FolderError):
    """The folder for the report cannot be made or written."""


def build_report(
    robot_name: str,
    out: str | Path,
    progress: Callable[[int, int], None] | None = None,
    sizes: Sizes | None = None,
    seed: int = 0,
) -> dict[str, Any]:
    """Computes the report of a robot (bundled name or URDF file), writes out/report.json and out/index.html, returns the data.

    progress(done, total) is called after each part. All numbers but times depend on robot, sizes and seed alone. A section that fails
    raises; nothing is written then. Raises ReportFolderError, ReportRobotError (not two universal-spherical arms), MissingExtraError.
    """
    from cga_runtime.report.page import render

    begin = perf_counter()
    folder = _folder(Path(out))
    context = Context(load_robot(robot_name), sizes or Sizes(), seed)
    context.data |= {"robot": context.robot.name, "versions": versions(), "seconds": 0.0, "seconds_by_section": {}}
    _ = context.loop  # refuses robots of another kind before anything is computed
    figures: dict[str, Any] = {}
    total, done = sum(share for _, _, share in SECTIONS) + PAGE, 0
    for name, module, share in SECTIONS:
        start = perf_counter()
        context.data[name] = module.section(context)
        if hasattr(module, "figures"):
            figures |= module.figures(context)
        context.data["seconds_by_section"][name] = perf_counter() - start
        done += share
        if progress is not None:
            progress(done, total)
    context.data["seconds"] = perf_counter() - begin
    page, data = render(context, figures), strict_json.text(context.data)
    try:
        for name, content in (("report.json", data), ("index.html", page)):
            write_atomic(folder / name, content.encode(), mode=0o644)  # a report is for showing around
    except OSError as error:
        raise ReportFolderError(f"cannot write the report into {folder} ({error.strerror}); name another folder with --out") from error
    if progress is not None:
        progress(total, total)
    plain: dict[str, Any] = strict_json.plain(context.data)
    return plain


def _folder(out: Path) -> Path:
    """The folder, made if it is not there. ReportFolderError before hours of work are lost, not after."""
    try:
        out.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise ReportFolderError(f"{out} is a file; the report needs a folder: name another with --out") from None
    except OSError as error:
        raise ReportFolderError(f"cannot make the folder {out} ({error.strerror}); name another with --out") from error
    if not os.access(out, os.W_OK | os.X_OK):
        raise ReportFolderError(f"the folder {out} cannot be written; name another with --out")
    return out


def versions() -> dict[str, str]:
    """Versions of what the numbers depend on, and the machine that the times were taken on."""
    found = {}
    for package in ("numpy", "casadi", "plotly", "jinja2"):
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    found |= {"python": platform.python_version(), "machine": f"{platform.system()} {platform.machine()}"}
    return {"cga-robotics": __version__, **found}
