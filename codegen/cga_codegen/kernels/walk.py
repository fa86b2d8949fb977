"""Walks along a chain, joint by joint, from either end: joint axes as screws and points, and the pose of the other end.

Nothing is expanded across joints.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cga_codegen.kernels.axes import STANDING, Pose, of_motor, to_axis
from cga_codegen.kernels.screws import Screw, add, scale
from cga_codegen.kernels.vectors import Axes, Scalar, Vector, cross, minus
from cga_codegen.robots.model import Chain, Coordinates, Joint, Placement


@dataclass(frozen=True)
class Configuration:
    """A chain at (c, s): the joint axes as screws and points, and the pose of the end frame, all in the frame the walk began in.

    axes[j] is the direction of joint j, points[j] a point on it. A floating base adds three axes that slide and three that turn, all
    through its origin: its own. They come first; `floating` is their number, 6 or 0.
    """

    floating: int
    prismatic: tuple[bool, ...]
    axes: Axes
    points: Axes
    rotation: Axes
    position: list[Scalar]

    def screws(self) -> list[Screw]:
        """Screws of the joints about the origin of that frame."""
        zero = [0 * x for x in self.position]
        return [
            Screw(zero, a) if slides else Screw(a, cross(p, a))
            for slides, a, p in zip(self.prismatic, self.axes, self.points, strict=True)
        ]

    def screws_at_end(self) -> list[Screw]:
        """The same with v taken at the end frame's origin (axes unchanged): LOCAL_WORLD_ALIGNED."""
        zero = [0 * x for x in self.position]
        return [
            Screw(zero, a) if slides else Screw(a, cross(a, minus(self.position, p)))
            for slides, a, p in zip(self.prismatic, self.axes, self.points, strict=True)
        ]

    def carries(self, k: int, j: int) -> bool:
        """Whether screw j moves, seen from the root, when screw k does: it lies behind it, or is of the same floating base."""
        return k < j or (k != j and max(k, j) < self.floating)


def gather(coordinates: Coordinates, screws: Sequence[Screw]) -> list[Screw]:
    """Screws of the joints -> screws of the velocities: joints that mimic add, times their ratio, to the column of their leader."""
    columns: list[Screw | None] = [None] * coordinates.nv
    for (k, ratio), screw in zip(coordinates.columns, screws, strict=True):
        part = screw if ratio == 1.0 else scale(ratio, screw)
        before = columns[k]
        columns[k] = part if before is None else add(before, part)
    return [column for column in columns if column is not None]


def spread(coordinates: Coordinates, v: Vector) -> list[Scalar]:
    """Velocities -> one rate for each screw."""
    return [v[k] if ratio == 1.0 else ratio * v[k] for k, ratio in coordinates.columns]


def z_axes(chain: Chain) -> tuple[list[Placement], Placement, tuple[Joint, ...]]:
    """The chain with every joint about its own +z: placements before each joint, the tool, and the joints (floating: as it is)."""
    turns = [Placement() if joint.kind == "floating" else to_axis(joint.axis) for joint in chain.joints]
    before = Placement()
    placements = []
    for joint, turn in zip(chain.joints, turns, strict=True):
        placements.append(before @ joint.placement @ turn)
        before = turn.inverse()
    return placements, before @ chain.tool, chain.joints


class _Walk:
    """The pose reached so far, and the axes met on the way."""

    def __init__(self) -> None:
        self.pose: Pose = STANDING
        self.axes: Axes = []
        self.points: Axes = []
        self.prismatic: list[bool] = []

    def meet(self, *, slides: bool, axis: list[Scalar]) -> None:
        self.axes.append(axis)
        self.points.append(self.pose.origin)
        self.prismatic.append(slides)

    def joint(self, joint: Joint, c: Scalar, s: Scalar) -> None:
        """A joint about the z axis of the pose reached."""
        slides = joint.kind == "prismatic"
        self.meet(slides=slides, axis=self.pose.columns[2])
        self.pose = self.pose.slide(s) if slides else self.pose.turn(c, s)

    def base(self, *, backwards: bool = False) -> None:
        """The six axes of a floating base whose pose is the one reached: along them, then about them."""
        six = [(slides, axis) for slides in (True, False) for axis in self.pose.columns]
        for slides, axis in reversed(six) if backwards else six:
            self.meet(slides=slides, axis=axis)


def outward(chain: Chain, c: Vector, s: Vector, base: Vector | None = None) -> Configuration:
    """The chain seen from its root. c, s: of the joints that do not float; base: motor of a floating base."""
    placements, tool, joints = z_axes(chain)
    walk, number = _Walk(), iter(range(len(joints)))
    for placement, joint in zip(placements, joints, strict=True):
        walk.pose = walk.pose.place(placement)
        if joint.kind == "floating":
            assert base is not None, "the catalogue passes the base of a chain that has one"
            walk.pose = walk.pose.join(of_motor(base))
            walk.base()
        else:
            k = next(number)
            walk.joint(joint, c[k], s[k])
    end = walk.pose.place(tool)
    return Configuration(6 * chain.coordinates.floating, tuple(walk.prismatic), walk.axes, walk.points, end.columns, end.origin)


def inward(chain: Chain, c: Vector, s: Vector) -> Configuration:
    """The chain seen from its end frame: the inverse chain, walked from the tool. Joints keep their order and their axes' sense.

    Its `screws()` are the body screws (LOCAL Jacobian), for fewer operations than turning the outward ones. With a floating base the walk
    ends at the base: where that stands does not matter.
    """
    placements, tool, joints = z_axes(chain)
    backwards = [tool.inverse(), *(p.inverse() for p in reversed(placements[1:]))]
    walk, k = _Walk(), sum(joint.kind != "floating" for joint in joints)
    floating = 0
    for placement, joint in zip(backwards, reversed(joints), strict=True):
        walk.pose = walk.pose.place(placement)
        if joint.kind == "floating":
            walk.base(backwards=True)  # all is reversed below
            floating = 6
        else:
            k -= 1  # walking backwards every joint turns the other way
            walk.joint(joint, c[k], -s[k])
    end = walk.pose.place(placements[0].inverse()) if placements else walk.pose.place(tool.inverse())
    return Configuration(floating, tuple(walk.prismatic[::-1]), walk.axes[::-1], walk.points[::-1], end.columns, end.origin)
