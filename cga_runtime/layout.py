"""What joint positions q hold, and how the inputs of a kernel's body come from them: cosines, sines, and the motor of a floating base."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.errors import DegenerateError

Array = NDArray[np.float64]

BASE, TWIST = 8, 6
"""Numbers that a floating base takes at the beginning of q (its motor) and of v (its twist in its own axes, linear first)."""
RIGID = 1e-9
"""Largest deviation of the motor of a floating base from M ~M = 1."""

_OF_ANGLE: dict[str, Callable[[Any, Any], Any]] = {
    "c": lambda m, q: m.cos(q),
    "s": lambda m, q: m.sin(q),
    "ch": lambda m, q: m.cos(0.5 * q),
    "sh": lambda m, q: m.sin(0.5 * q),
}
_OF_DISPLACEMENT: dict[str, Callable[[Any], Any]] = {
    "c": lambda q: 0 * q + 1,
    "s": lambda q: q,
    "ch": lambda q: 0 * q + 1,
    "sh": lambda q: 0.5 * q,
}
OF_Q = frozenset({*_OF_ANGLE, "base"})
"""Inputs of bodies that come from q."""


@dataclass(frozen=True)
class Layout:
    """names, kinds: one a coordinate, a floating base first (8 numbers of q, 6 of v), all others one number each. motions: for each joint
    that does not float the number of its coordinate among these others, the ratio by which it moves with it, and whether it slides."""

    names: tuple[str, ...]
    kinds: tuple[str, ...]
    motions: tuple[tuple[int, float, bool], ...]

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> Layout:
        """That of a unit in a manifest."""
        kinds = tuple(record["joint_kinds"])
        ones = kinds[1:] if "floating" in kinds else kinds
        motions = [(int(k), float(ratio), bool(rest[0]) if rest else ones[k] == "prismatic") for k, ratio, *rest in record["motions"]]
        return cls(tuple(record["joint_names"]), kinds, tuple(motions))

    @property
    def floating(self) -> bool:
        """Whether the base moves."""
        return "floating" in self.kinds

    @property
    def nq(self) -> int:
        """Numbers in q."""
        return len(self.names) + (BASE - 1 if self.floating else 0)

    @property
    def nv(self) -> int:
        """Numbers in v."""
        return len(self.names) + (TWIST - 1 if self.floating else 0)

    def places(self, names: Sequence[str]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Where coordinates of these names stand in q and in v."""
        in_q: list[int] = []
        in_v: list[int] = []
        for name in names:
            k = self.names.index(name)
            base = self.floating and k == 0
            shift_q, shift_v = (BASE - 1, TWIST - 1) if self.floating else (0, 0)
            in_q += range(BASE) if base else [k + shift_q]
            in_v += range(TWIST) if base else [k + shift_v]
        return np.array(in_q, dtype=np.intp), np.array(in_v, dtype=np.intp)

    def body_input(self, name: str, q: Any, module: Any) -> list[Any]:
        """One of OF_Q from the elements of q; `module` has cos and sin (numpy or casadi)."""
        if name == "base":
            return [q[k] for k in range(BASE)]
        first = BASE if self.floating else 0

        def joint(k: int, ratio: float, slides: bool) -> Any:
            x = q[first + k] if ratio == 1.0 else ratio * q[first + k]
            return _OF_DISPLACEMENT[name](x) if slides else _OF_ANGLE[name](module, x)

        return [joint(*motion) for motion in self.motions]

    def check_base(self, q: Array) -> None:
        """Raises DegenerateError where the motor of a floating base is not one."""
        a, b12, b13, b23, t1, t2, t3, t123 = np.moveaxis(q[..., :BASE], -1, 0)
        with np.errstate(over="ignore", invalid="ignore"):
            unit = np.abs(a * a + b12 * b12 + b13 * b13 + b23 * b23 - 1.0)
            mixed = np.abs(a * t123 - b12 * t3 + b13 * t2 - b23 * t1) / (1.0 + np.abs(q[..., 4:BASE]).max(axis=-1, initial=0.0))
        off = float(np.fmax(unit.max(initial=0.0), mixed.max(initial=0.0)))
        if off > RIGID and np.isfinite(q).all():  # what is not finite is named elsewhere
            raise DegenerateError(
                f"q: its first 8 numbers are no motor of {self.names[0]!r}, M ~M is off by {off:.1e} (at most {RIGID:.0e}); "
                "Motor.from_pose makes one from a matrix"
            )
