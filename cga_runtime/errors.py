"""The errors that users meet: one family, each saying what was given, what is accepted, and where possible the next command to type."""

from __future__ import annotations

from collections.abc import Iterable


class CgaError(Exception):
    """Base of every error that this package raises on purpose; the command line turns it into exit status 2."""


class WrongSizeError(CgaError, ValueError):
    """An array has the wrong length or shape."""


class NotFiniteError(CgaError, ValueError):
    """An array contains NaN or infinity."""


class UnknownNameError(CgaError, LookupError):
    """A robot, frame, joint, kernel or option of that name does not exist; the message lists those that do."""

    def __init__(self, kind: str, name: object, known: Iterable[object], hint: str = "") -> None:
        listing = ", ".join(str(k) for k in known) or "none"
        super().__init__(f"unknown {kind} {name!r}; known: {listing}{'. ' + hint if hint else ''}")


class SchemeError(CgaError, ValueError):
    """An actuation scheme is not a set of distinct joints of the right number."""


class GraspError(CgaError, ValueError):
    """Two arms do not hold one object: the loop is not closed, or the two chains cannot form a loop."""


class DegenerateError(CgaError, ValueError):
    """A geometric primitive, or the question asked of it, is degenerate (coincident points, zero direction, no wrist centre ...)."""


class RobotFileError(CgaError, ValueError):
    """A robot description is unreadable, unsafe, or holds something that cannot be represented."""


class ChainError(CgaError, ValueError):
    """A chain cannot be cut as asked: its root does not lie before its end, or it has no joints."""


class FolderError(CgaError, OSError):
    """A folder for results cannot be written, or holds something else."""


class StaleKernelError(CgaError, RuntimeError):
    """Generated text does not match its manifest, or the manifest cannot be read; the message names the file and the command."""


class CompilerError(CgaError, RuntimeError):
    """A C compiler was found and failed; the message holds its command and the end of what it printed."""


class CacheError(CgaError, RuntimeError):
    """The cache folder cannot be trusted (it belongs to someone else, or others may write to it), or not be written."""


class MissingExtraError(CgaError, ImportError):
    """A part needs an optional package; the message gives the pip command."""

    def __init__(self, part: str, package: str, extra: str) -> None:
        super().__init__(f"{part} needs {package}: pip install 'cga-robotics[{extra}]'")


class KernelWarning(UserWarning):
    """Kernels run, but not in the best way (no compiler, unusable cache); said once."""
