"""What can be wrong with a robot description, by name; every message is one sentence: what was given, and what is accepted."""

from __future__ import annotations

from cga_codegen.robots.placement import ModelError


class UnreadableFileError(ModelError):
    """There is no such file, it is a folder or a device, or its bytes are not text."""


class UnsafeFileError(ModelError):
    """The file could exhaust the machine: a document type declaration (entities), too many bytes, too many links."""


class BrokenFileError(ModelError):
    """Not well-formed XML, another format, or an element that lacks what the format asks for."""


class DuplicateNameError(ModelError):
    """Two joints or two links of one name."""


class TreeError(ModelError):
    """The links do not form one tree: unknown links, several roots, loops, links out of reach."""


class BadNumberError(ModelError):
    """Text where a number belongs, a number that is not finite, or one that no robot can have (zero axis, negative mass)."""


class UnsupportedJointError(ModelError):
    """A joint that cannot be represented: floating away from the base, planar, spherical, mimicking what does not move."""


class InertiaWarning(UserWarning):
    """An inertia that no rigid body has; it is used as given, and simulations may behave oddly."""
