"""The manifest of a generated folder: which kernels it holds, their inputs and costs, and the digest of every file.

The runtime reads nothing else to find its way; a file whose digest differs from the manifest's was edited by hand or is stale.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cga_codegen.emit.layout import Layout
from cga_codegen.emit.lower import Counts

FORMAT = 2
"""Raised when the layout changes in a way that an older runtime cannot read."""


class GeneratedFolderError(ValueError):
    """A folder for generated text cannot be written; the message says why and what to do."""


@dataclass(frozen=True)
class KernelRecord:
    """One kernel: inputs of its body with shapes, shape of its output, cost after lowering, and before (casadi instructions)."""

    name: str
    source: str
    symbol: str
    inputs: tuple[tuple[str, tuple[int, ...]], ...]
    shape: tuple[int, ...]
    counts: Counts
    casadi_instructions: int
    operations_by_differentiation: int | None

    def to_json(self) -> dict[str, Any]:
        """Plain data for the manifest."""
        counts = self.counts
        data: dict[str, Any] = {
            "source": self.source,
            "symbol": self.symbol,
            "inputs": [[name, list(shape)] for name, shape in self.inputs],
            "shape": list(self.shape),
            "operations": counts.total,
            "multiplications": counts.multiplications,
            "additions": counts.additions,
            "divisions": counts.divisions,
            "roots": counts.roots,
            "casadi_instructions": self.casadi_instructions,
        }
        if self.operations_by_differentiation is not None:
            data["operations_by_differentiation"] = self.operations_by_differentiation
        return data


@dataclass(frozen=True)
class UnitRecord:
    """What is compiled together: `path`.c and `path`.py, with what q holds."""

    path: str
    title: str
    layout: Layout
    kernels: tuple[KernelRecord, ...]

    def to_json(self) -> dict[str, Any]:
        """Plain data for the manifest."""
        return {
            "title": self.title,
            "joint_names": list(self.layout.names),
            "joint_kinds": list(self.layout.kinds),
            "motions": self.layout.to_json(),
            "kernels": {kernel.name: kernel.to_json() for kernel in self.kernels},
        }


def digest(text: str) -> str:
    """SHA-256 of a text file's content as written (UTF-8, newlines as they are)."""
    return hashlib.sha256(text.encode()).hexdigest()


def manifest_text(version: str, files: Mapping[str, str], units: Sequence[UnitRecord], robots: Mapping[str, Any]) -> str:
    """The manifest as JSON text, keys sorted, one final newline."""
    data = {
        "format": FORMAT,
        "generator": f"cga-robotics {version}",
        "files": {path: digest(text) for path, text in sorted(files.items())},
        "units": {unit.path: unit.to_json() for unit in units},
        "robots": dict(robots),
    }
    return json.dumps(data, indent=1, sort_keys=True) + "\n"


def write_folder(folder: Path, files: Mapping[str, str], manifest: str) -> None:
    """Writes the files and, last, the manifest, each through a temporary name, so that no half-written file is ever seen.

    A run killed between two files leaves a manifest that does not match (a new folder: an empty one); the loader says so and names the
    command to run again. Files that an earlier manifest listed and this one does not are removed. Raises GeneratedFolderError if the
    folder is not writable or holds other people's files (not empty, and without a manifest of ours).
    """
    listing = folder / "manifest.json"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not listing.exists():
            if any(not entry.name.startswith(".manifest.json.") for entry in folder.iterdir()):  # such a name: a run that was killed
                raise GeneratedFolderError(f"{folder} is not empty and holds no manifest.json: name an empty folder, or one that cga made")
            _replace(listing, "{}\n")
        old = _listed(listing)
        for path, text in sorted(files.items()):
            _replace(folder / path, text)
        _replace(listing, manifest)
        for path in sorted(old - set(files)):
            (folder / path).unlink(missing_ok=True)
    except OSError as error:
        raise GeneratedFolderError(f"cannot write {error.filename or folder}: {error.strerror}") from error


def _listed(manifest: Path) -> set[str]:
    """Files of an existing manifest that lie inside its folder; none if it cannot be read (it is overwritten anyway).

    Raises GeneratedFolderError for a manifest.json of something else (web pages and packages have files of that name).
    """
    try:
        found = json.loads(manifest.read_text(encoding="utf-8"))
        if found and "generator" not in found:
            raise GeneratedFolderError(f"{manifest} is not a manifest of kernels: name an empty folder, or one that cga made")
        names = found["files"]
        return {name for name in names if ".." not in Path(name).parts and not Path(name).is_absolute()}
    except GeneratedFolderError:
        raise
    except (OSError, ValueError, KeyError, TypeError):
        return set()


def _replace(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
