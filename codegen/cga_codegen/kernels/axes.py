"""Poses of symbols, and joints turned about their own z: what walks along chains and through trees stand on.

Every joint is first given a frame whose +z is its axis, which makes a turning joint two rotated columns and a sliding one a sum.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cga_codegen.kernels.vectors import Axes, Scalar, Vector, combine, minus, plus, times
from cga_codegen.robots.model import Placement, Rows3


@dataclass(frozen=True)
class Pose:
    """A frame seen from another: the columns of its rotation, and its origin."""

    columns: Axes
    origin: list[Scalar]

    def place(self, at: Placement) -> Pose:
        """The pose of a frame that is placed in this one."""
        exact = [[int(x) if x in (0.0, 1.0, -1.0) else x for x in row] for row in at.rotation]
        origin = plus(self.origin, combine(self.columns, [int(x) if x == 0.0 else x for x in at.translation]))
        return Pose([combine(self.columns, [row[k] for row in exact]) for k in range(3)], origin)

    def turn(self, c: Scalar, s: Scalar) -> Pose:
        """Turned about its own z by an angle of cosine c and sine s."""
        x, y, z = self.columns
        return Pose([plus(times(c, x), times(s, y)), minus(times(c, y), times(s, x)), z], self.origin)

    def slide(self, s: Scalar) -> Pose:
        """Moved along its own z."""
        return Pose(self.columns, plus(self.origin, times(s, self.columns[2])))

    def join(self, other: Pose) -> Pose:
        """The pose of a frame that has the pose `other` in this one."""
        return Pose([combine(self.columns, column) for column in other.columns], plus(self.origin, combine(self.columns, other.origin)))

    def inverse(self) -> Pose:
        """The pose of the frame that this one is seen from, seen from this one."""
        rows = [[column[k] for column in self.columns] for k in range(3)]
        return Pose(rows, [-x for x in combine(rows, self.origin)])


STANDING = Pose([[1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 0, 0])


def of_motor(motor: Vector) -> Pose:
    """The pose that a unit motor, components 1 e12 e13 e23 e1i e2i e3i e123i, gives to a frame: x -> M x ~M."""
    a, b12, b13, b23, t1, t2, t3, t123 = (motor[k] for k in range(8))
    w, x, y, z = a, -b23, b13, -b12  # the quaternion w + x i + y j + z k
    columns = [
        [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
        [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
        [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ]
    origin = [  # M = T R: the part T = M ~R = 1 - t ei/2
        -2 * (a * t1 + b12 * t2 + b13 * t3 + b23 * t123),
        -2 * (a * t2 - b12 * t1 + b23 * t3 - b13 * t123),
        -2 * (a * t3 - b13 * t1 - b23 * t2 + b12 * t123),
    ]
    return Pose(columns, origin)


def to_axis(axis: Sequence[float]) -> Placement:
    """A constant rotation that carries +z to the joint axis: a cyclic permutation (free) when the axis is a coordinate axis."""
    x, y, z = axis
    cyclic: dict[tuple[float, ...], Rows3] = {
        (0.0, 0.0, 1.0): ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        (1.0, 0.0, 0.0): ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        (0.0, 1.0, 0.0): ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
        (0.0, 0.0, -1.0): ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)),
        (-1.0, 0.0, 0.0): ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
        (0.0, -1.0, 0.0): ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    }
    if (x, y, z) in cyclic:
        return Placement(cyclic[(x, y, z)])
    # any rotation with third column = axis: the shortest turn from z, or from -z (after half a turn about x), whichever is nearer
    k = 1.0 / (1.0 + z) if z > -0.5 else 1.0 / (1.0 - z)
    if z > -0.5:
        return Placement(((1.0 - x * x * k, -x * y * k, x), (-x * y * k, 1.0 - y * y * k, y), (-x, -y, z)))
    return Placement(((1.0 - x * x * k, x * y * k, x), (-x * y * k, -1.0 + y * y * k, y), (x, -y, z)))
