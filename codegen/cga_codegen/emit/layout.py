"""What the joint positions q of a unit hold, and how (c, s) and (ch, sh) of its joints come from them."""

from __future__ import annotations

from dataclasses import dataclass

BASE = 8
"""Numbers of q that a floating base takes: its motor, which is passed to bodies as `base`. It comes first."""


@dataclass(frozen=True)
class Layout:
    """names, kinds: one a coordinate, a floating base first, all others one number of q each. motions: for each joint that does not float
    its number among these others, its ratio, and whether it slides: the joint moves by ratio q."""

    names: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    motions: tuple[tuple[int, float, bool], ...] = ()

    @property
    def first(self) -> int:
        """Where in q the coordinates of one number begin."""
        return BASE if "floating" in self.kinds else 0

    @property
    def nq(self) -> int:
        """Numbers in q."""
        return len(self.names) + (BASE - 1 if self.first else 0)

    @property
    def joints(self) -> list[tuple[int, float, bool]]:
        """For each joint that does not float: its place in q, its ratio, and whether it slides."""
        return [(self.first + k, ratio, slides) for k, ratio, slides in self.motions]

    def to_json(self) -> list[list[int | float | bool]]:
        """The motions as plain data: number, ratio, and whether it slides only where a joint does not move as its coordinate does."""
        ones = self.kinds[1:] if self.first else self.kinds
        return [[k, ratio, *([slides] if slides != (ones[k] == "prismatic") else [])] for k, ratio, slides in self.motions]
