"""Reads MJCF with the standard library and keeps what kinematics and dynamics need, before MuJoCo sees any of it.

Included files and models to attach are opened here, only inside one folder, each once; MuJoCo then parses the text written here and opens
no file. Left out: what no joint, inertia, frame or force limit depends on (assets, cameras, lights, contacts, sensors, keyframes, custom
data, plugins, deformables, sizes). What is kept stays as written, so that a misspelt attribute is still refused by MuJoCo's schema.
Copies that the file asks for (replicate, attach) are counted before they are made.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

from cga_codegen.robots.errors import (
    BadNumberError,
    BrokenFileError,
    TreeError,
    UnreadableFileError,
    UnsafeFileError,
    UnsupportedJointError,
)
from cga_codegen.robots.safe_xml import MAX_BYTES, read_xml, shown

MAX_DEPTH = 250
"""Elements within elements; MuJoCo's own parser stops at 500, Python's writer of XML at the recursion limit (1000)."""
MAX_PARTS = 20_000
"""Elements that matter, with all copies made."""
MAX_FILES = 100

_LEFT_OUT = {
    *("hfield", "material", "mesh", "skin", "texture"),
    *("camera", "light", "statistic", "visual"),
    *("contact", "custom", "deformable", "extension", "keyframe", "lengthrange", "pair", "plugin", "sensor", "size"),
}
_LISTS = {"actuator", "equality", "tendon"}
_SOFT = {"composite", "flexcomp"}
_EQUALITIES = {"connect", "joint", "tendon", "weld"}
_ATTRIBUTES = {"actdim", "content_type", "delay", "file", "interp", "material", "nsample", "user"}
"""Left out of every element: files, colours, and buffers of any size that an actuator may ask for."""
_COMPILER = {
    *("assetdir", "meshdir", "texturedir", "strippath", "passthrough", "convexhull", "exactmeshinertia", "fitaabb"),
    *("discardvisual", "fusestatic", "usethread", "saveinertial", "savecompiled", "savecanonical"),
}
"""Options of the compiler about files and speed; fusestatic would take away the frames of bodies that do not move."""
_OURS = '<compiler usethread="false"><lengthrange mode="none"/></compiler>'
"""MuJoCo simulates ten seconds to find the lengths of a muscle, unless told not to."""


@dataclass(frozen=True)
class MjcfFile:
    """A checked file: `xml` is what MuJoCo may parse, `models` the files that it attaches (name in `xml` -> text)."""

    name: str
    source: str
    xml: str
    models: dict[str, bytes]


def read_mjcf(path_or_text: str | os.PathLike[str], folder: str | os.PathLike[str] | None = None) -> MjcfFile:
    """Read and check an MJCF given as a path, or as its text (a string whose first character that is not blank is "<").

    folder: where files to include or attach may lie, default: the file's own folder (a text has none). With it, "../" may be used in the
    file as long as it stays inside. Raises a named child of ModelError (see `cga_codegen.robots.errors`).
    """
    root, source = read_xml(path_or_text, "MJCF")
    stem, base = "robot", None
    if not (isinstance(path_or_text, str) and path_or_text.lstrip("\ufeff \t\r\n").startswith("<")):
        stem, base = Path(path_or_text).stem, Path(path_or_text).parent.resolve()
    allowed = base if folder is None else Path(folder).resolve()
    if folder is not None and not Path(folder).is_dir():
        raise UnreadableFileError(f"{source}: folder={os.fspath(folder)!r} is no folder; the one with the files that it includes is needed")
    reader = _Reader(source, base or allowed, allowed, folder is not None)
    text, _ = reader.document(root, reader.base, ())
    return MjcfFile(root.get("model") or stem, source, text, reader.models)


class _Reader:
    """One pass over the main file and all that it includes or attaches; `where` names the main file in every message."""

    def __init__(self, where: str, base: Path | None, allowed: Path | None, upwards: bool) -> None:
        self.where, self.base, self.allowed, self.upwards = where, base, allowed, upwards
        self.included: set[Path] = set()
        self.attached: dict[Path, tuple[str, str, int]] = {}  # file -> its name in the text for MuJoCo, its model's name, its parts
        self.models: dict[str, bytes] = {}
        self.files, self.bytes, self.elements = 0, 0, 0

    def document(self, root: ET.Element, here: Path | None, chain: tuple[Path, ...]) -> tuple[str, int]:
        """The text for MuJoCo and the number of parts in it. chain: the files that asked for this one as a model to attach."""
        if root.tag != "mujoco":
            hint = "read it as a URDF" if root.tag == "robot" else "an MJCF has <mujoco>"
            raise BrokenFileError(f"{self.where}: the root element is <{shown(root.tag, 80)}>; {hint}")
        self.included = set()
        clean = ET.Element("mujoco", {"model": root.get("model", "")} if root.get("model") else {})
        for child in root:
            clean.extend(self.clean(child, here, 2))
        for equality in clean.iter("equality"):
            for constraint in equality:
                if constraint.tag not in _EQUALITIES:
                    tag = shown(constraint.tag, 80)
                    raise UnsupportedJointError(f"{self.where}: an equality <{tag}> of soft bodies is given; joint is read")
        models: dict[str, int] = {}
        for model in clean.iter("model"):
            name, size = self.model(model, here, chain)
            models[name] = max(size, models.get(name, 0))
        listed = [part for section in clean if section.tag in _LISTS for part in section]
        mentions = [{value for element in part.iter() for value in element.attrib.values()} for part in listed]
        count = sum(models.values()) + _Count(self.where, models, mentions).parts(clean, ())
        clean.append(ET.fromstring(_OURS))
        return ET.tostring(clean, encoding="unicode"), count

    def clean(self, element: ET.Element, here: Path | None, depth: int) -> list[ET.Element]:
        """The element without what is left out, includes replaced by what they hold."""
        if depth > MAX_DEPTH:
            raise UnsafeFileError(f"{self.where}: more than {MAX_DEPTH} elements lie within each other; at most {MAX_DEPTH} are read")
        tag = element.tag
        if tag in _LEFT_OUT:
            return []
        if tag in _SOFT:
            raise UnsupportedJointError(f"{self.where}: <{tag}> makes a soft body, which cannot be represented; rigid bodies are read")
        if tag == "include":
            path = self.path(element, here)
            if path in self.included:
                raise BrokenFileError(f"{self.where}: {path.name!r} is included twice; a file may be included once")
            self.included.add(path)
            root = self.read(path)
            return [kept for child in root for kept in self.clean(child, path.parent, depth)]
        self.elements += 1
        if self.elements > MAX_PARTS:
            raise UnsafeFileError(f"{self.where}: more than {MAX_PARTS} elements are given; at most {MAX_PARTS} are read")
        dropped = _ATTRIBUTES | _COMPILER if tag == "compiler" else _ATTRIBUTES - {"file"} if tag == "model" else _ATTRIBUTES
        kept = ET.Element(tag, {key: value for key, value in element.items() if key not in dropped})
        for child in element:
            kept.extend(self.clean(child, here, depth + 1))
        return [kept]

    def model(self, element: ET.Element, here: Path | None, chain: tuple[Path, ...]) -> tuple[str, int]:
        """Read a model to attach; gives the name by which `attach` calls it and its number of parts."""
        path = self.path(element, here)
        if path in chain:
            raise TreeError(f"{self.where}: model file {path.name!r} attaches itself in the end; a robot has an end")
        if path not in self.attached:
            root = self.read(path)
            outer = self.included
            text, count = self.document(root, path.parent, (*chain, path))
            self.included = outer
            self.attached[path] = f"model{len(self.attached)}.xml", root.get("model") or "MuJoCo Model", count
            self.models[self.attached[path][0]] = text.encode()
        key, title, count = self.attached[path]
        element.set("file", key)
        return element.get("name") or title, count

    def path(self, element: ET.Element, here: Path | None) -> Path:
        """The file that an element names: relative to the main file, else to the one it stands in (MuJoCo's order); inside the folder."""
        given = element.get("file")
        label = f"{self.where}: <{element.tag}> names file {(given or '')[:200]!r}"
        if not given:
            raise BrokenFileError(f"{self.where}: <{shown(element.tag, 80)}> names no file; give file=...")
        if self.allowed is None or self.base is None or here is None:
            raise UnsafeFileError(f"{label}, but a text has no folder; say which with folder=...")
        if Path(given).is_absolute() or given.startswith("\\") or given[1:2] == ":":
            raise UnsafeFileError(f"{label}; a path relative to the file that names it is needed")
        if ".." in given.replace("\\", "/").split("/") and not self.upwards:
            raise UnsafeFileError(f"{label}, which leads out of its folder; say with folder=... from which folder files may come")
        try:
            found = [(base / given).resolve() for base in (self.base, here)]
            path = next((path for path in found if path.exists()), found[0])
        except (OSError, RuntimeError) as error:  # RuntimeError: links in a ring
            raise UnreadableFileError(f"{label}, which cannot be found ({error})") from None
        if not path.is_relative_to(self.allowed):
            raise UnsafeFileError(f"{label}, which lies outside of folder {self.allowed.name!r}; files inside it are read")
        if not path.exists():
            raise UnreadableFileError(f"{label}, which does not exist; a file in the folder of the main one is needed")
        return path

    def read(self, path: Path) -> ET.Element:
        """The root element of a file within the folder; all files together stay within the bounds of one."""
        self.files += 1
        self.bytes += path.stat().st_size if path.is_file() else 0
        if self.files > MAX_FILES or self.bytes > MAX_BYTES:
            raise UnsafeFileError(f"{self.where}: more than {MAX_FILES} files or {MAX_BYTES} bytes are included; at most these are read")
        return read_xml(path, "MJCF")[0]


class _Count:
    """Counts the elements of one file with all copies. models: parts of the models that it may attach, by name; mentions: the names that
    each equality, tendon and actuator mentions: MuJoCo copies those of whatever it copies."""

    def __init__(self, where: str, models: dict[str, int], mentions: list[set[str]]) -> None:
        self.where, self.models, self.mentions = where, models, mentions
        self.known: dict[str, tuple[int, ET.Element]] = {}  # bodies and frames that stand before the element at hand

    def parts(self, element: ET.Element, around: tuple[str, ...]) -> int:
        """Of this element and all in it; around: the names of the bodies and frames that it is in."""
        name = element.get("name", "") if element.tag in ("body", "frame") else ""
        inside = (*around, name) if name else around
        total = 1 + sum(self.parts(child, inside) for child in element)
        if element.tag == "attach":
            total += self.attached(element, around)
        if element.tag == "replicate":
            given = element.get("count", "1")
            try:
                copies = float(given)
            except ValueError:
                copies = math.nan
            if not 1 <= copies <= MAX_PARTS:
                raise BadNumberError(f"{self.where}: replicate count is {given[:80]!r}; a whole number from 1 to {MAX_PARTS} is needed")
            total = math.ceil((total + self.mentioned(element)) * copies)
        if total > MAX_PARTS:
            raise UnsafeFileError(f"{self.where}: more than {MAX_PARTS} elements with all copies made; at most {MAX_PARTS} are read")
        if name:
            self.known[name] = total, element
        return total

    def attached(self, element: ET.Element, around: tuple[str, ...]) -> int:
        """Of what an <attach> copies."""
        target = element.get("body") or element.get("frame") or ""
        if element.get("model") is not None:
            return self.models.get(element.get("model", ""), 0)
        if target in around:
            raise TreeError(f"{self.where}: {target!r} is attached inside itself; a robot has an end")
        if target not in self.known:
            raise BrokenFileError(f"{self.where}: {target!r} is to be attached; a body or frame written before that place is needed")
        total, body = self.known[target]
        return total + self.mentioned(body)

    def mentioned(self, element: ET.Element) -> int:
        """How many equalities, tendons and actuators mention something in the element."""
        if not self.mentions:
            return 0
        names = {part.get("name", "") for part in element.iter()}
        return sum(not names.isdisjoint(mention) for mention in self.mentions)
