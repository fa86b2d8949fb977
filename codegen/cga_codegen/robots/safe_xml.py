"""Opens the XML of a robot description without trusting it: size, kind of file, encoding and entities are checked before it is parsed."""

from __future__ import annotations

import os
import re
import stat
import xml.etree.ElementTree as ET
from pathlib import Path

from cga_codegen.robots.errors import BrokenFileError, UnreadableFileError, UnsafeFileError

MAX_BYTES = 20_000_000
ENCODINGS = ("utf-8", "utf-16", "us-ascii", "ascii", "iso-8859-1", "latin-1")


def read_xml(path_or_text: str | os.PathLike[str], what: str) -> tuple[ET.Element, str]:
    """The root element, and the name of the file for messages (without its folder, so that what is generated does not depend on it).

    path_or_text: a path, or the text itself (a string whose first character that is not blank is "<"). what: "URDF", for messages.
    Raises UnreadableFileError, UnsafeFileError or BrokenFileError.
    """
    if isinstance(path_or_text, str) and path_or_text.lstrip("\ufeff \t\r\n").startswith("<"):
        text, source = path_or_text, f"{what} text"
        if len(text) > MAX_BYTES:
            raise UnsafeFileError(f"{source}: {len(text)} characters given, at most {MAX_BYTES} are read")
    else:
        text, source = file_text(path_or_text, what)
    text = text.lstrip("\ufeff \t\r\n")  # blanks before <?xml are an error of form only
    _refuse_document_type(text, source, what)
    try:
        return ET.fromstring(text), source
    except (ET.ParseError, UnicodeError) as error:
        raise BrokenFileError(f"{source}: not well-formed XML ({error}); a {what} is needed") from None


def file_text(given: str | os.PathLike[str], what: str) -> tuple[str, str]:
    needed = f"a path to a {what} file is needed"
    if not isinstance(given, str | os.PathLike):
        raise UnreadableFileError(f"{given!r:.80} was given; {needed}")
    if not os.fspath(given):
        raise UnreadableFileError(f"an empty path was given; {needed}")
    path = Path(given)
    label = shown(str(path))
    try:
        status = path.stat()  # first: opening some devices moves them
        size, data = status.st_size, b""
        if stat.S_ISREG(status.st_mode) and size <= MAX_BYTES:
            data = _bytes(path)
            size = max(size, len(data))
    except (OSError, ValueError) as error:  # ValueError: a null byte in the path
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise UnreadableFileError(f"{os.fspath(path)[:200]!r} cannot be read ({reason}); {needed}") from None
    if stat.S_ISDIR(status.st_mode):
        raise UnreadableFileError(f"{label} is a folder; {needed}")
    if not stat.S_ISREG(status.st_mode):  # a pipe or a device would never end
        raise UnreadableFileError(f"{label} is not a regular file; {needed}")
    if size > MAX_BYTES:
        raise UnsafeFileError(f"{label}: {size} bytes given, at most {MAX_BYTES} are read")
    declared = re.match(rb"""<\?xml[^>]*encoding\s*=\s*["']([\w.-]+)""", data)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else declared[1].decode().lower() if declared else "utf-8"
    if encoding not in ENCODINGS:
        raise UnreadableFileError(f"{label}: encoding {encoding!r} given; utf-8, utf-16, us-ascii or iso-8859-1 is needed")
    try:
        return data.decode(encoding), shown(path.name)
    except UnicodeDecodeError as error:
        raise UnreadableFileError(f"{label}: not text in {encoding} (byte {error.start}); {needed}") from None


def _bytes(path: Path) -> bytes:
    """The file's bytes, at most one more than may be read. Never waits: by now a pipe may stand there, and some files of /proc wait too."""
    with open(path, "rb", opener=lambda name, flags: os.open(name, flags | getattr(os, "O_NONBLOCK", 0))) as file:
        data = file.read(MAX_BYTES + 1) if stat.S_ISREG(os.fstat(file.fileno()).st_mode) else None
    if data is None:
        raise OSError("it is no file that can be read at once")
    return data


def shown(words: str, most: int = 300) -> str:
    """Words of a user's as part of a message or of what is generated: characters that cannot be printed become "?", and it is not long."""
    return "".join(c if c.isprintable() else "?" for c in words[:most])


_BEFORE_ROOT = re.compile(r"\s+|<\?.*?\?>|<!--.*?-->", re.DOTALL)


def _refuse_document_type(text: str, source: str, what: str) -> None:
    """A document type may stand only before the root element: step over blanks, comments and instructions, then look."""
    position = 0
    while match := _BEFORE_ROOT.match(text, position):
        position = match.end()
    if text.startswith("<!", position):
        raise UnsafeFileError(f"{source}: a document type declaration (DOCTYPE, entities) is given; remove it, a {what} needs none")


def holds_mjcf(path: str | os.PathLike[str]) -> bool:
    """Whether the root element of a readable XML file is MuJoCo's; whatever else is wrong with it, its reader says."""
    try:
        with open(path, "rb") as file:
            head = file.read(65536).decode("latin-1").replace("\0", "")
    except (OSError, ValueError):
        return False
    position = 0
    head = head.lstrip("\ufeff\xef\xbb\xbf\xff\xfe \t\r\n")
    while match := _BEFORE_ROOT.match(head, position):
        position = match.end()
    return head.startswith("<mujoco", position)
