"""A whole robot as a tree of bodies, each in a frame whose +z is its joint's axis: what the dynamics kernels walk through.

Twists (w, v) and wrenches (m, f) are bivectors of the algebra, V = w I3 + v ei and W = m I3 + e0 f (paper B, sections III-IV); a motor M
carries them by M V ~M. For a joint about z that sandwich is two rotated components and a cross product, which is how it is written here.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cga_codegen.kernels.axes import STANDING, of_motor, to_axis
from cga_codegen.kernels.vectors import Scalar, Vector, combine, dot, plus, times
from cga_codegen.robots.model import Coordinates, Frame, Inertia, Joint, Placement, RobotModel


def exact(x: float) -> Scalar:
    """A constant of the file as a scalar that products with 0, 1 and -1 drop."""
    return int(x) if x in (0.0, 1.0, -1.0) else float(x)


@dataclass(frozen=True)
class Mass:
    """Mass, first moment h = m c, and inertia about the origin (rows), in some frame; constants or symbols."""

    mass: Scalar
    moment: list[Scalar]
    inertia: list[list[Scalar]]

    @classmethod
    def of(cls, inertia: Inertia | None) -> Mass:
        """That of a body in its own frame; zero for None."""
        if inertia is None:
            return cls(0, [0, 0, 0], [[0, 0, 0] for _ in range(3)])
        c = np.array(inertia.com)
        about = inertia.matrix() + inertia.mass * (c @ c * np.eye(3) - np.outer(c, c))
        return cls(exact(inertia.mass), [exact(x) for x in inertia.mass * c], [[exact(x) for x in row] for row in about])


@dataclass(frozen=True)
class Body:
    """A joint and what it carries. placement: of the joint's z frame in the parent's z frame; number: of the joint among those that do
    not float (-1 for the floating base)."""

    joint: Joint
    parent: int
    placement: Placement
    inertia: Inertia | None
    number: int

    @property
    def slides(self) -> bool:
        """Whether the joint is prismatic."""
        return self.joint.kind == "prismatic"

    @property
    def floats(self) -> bool:
        """Whether this is the floating base."""
        return self.joint.kind == "floating"

    def into(self, x: Vector, c: Vector, s: Vector) -> list[Scalar]:
        """A direction of the parent's frame, in this one."""
        rows = self.placement.rotation
        y = [dot([exact(rows[i][k]) for i in range(3)], x) for k in range(3)]
        if self.slides:
            return y
        ck, sk = c[self.number], s[self.number]
        return [ck * y[0] + sk * y[1], ck * y[1] - sk * y[0], y[2]]

    def out(self, x: Vector, c: Vector, s: Vector) -> list[Scalar]:
        """A direction of this frame, in the parent's."""
        y = list(x)
        if not self.slides:
            ck, sk = c[self.number], s[self.number]
            y = [ck * x[0] - sk * x[1], sk * x[0] + ck * x[1], x[2]]
        return [dot([exact(a) for a in row], y) for row in self.placement.rotation]

    def origin(self, s: Vector) -> list[Scalar]:
        """This frame's origin in the parent's frame."""
        fixed = [exact(x) if x == 0.0 else x for x in self.placement.translation]
        if not self.slides:
            return fixed
        return plus(fixed, times(s[self.number], [exact(row[2]) for row in self.placement.rotation]))

    def turned(self, rows: list[list[Scalar]], c: Vector, s: Vector) -> list[list[Scalar]]:
        """A symmetric tensor of this frame, in the axes of the parent's: R I R^T."""
        (xx, xy, xz), (_, yy, yz), (_, _, zz) = rows
        if not self.slides:
            ck, sk = c[self.number], s[self.number]
            t = ck * (xx - yy) - 2 * (sk * xy)  # with c^2 + s^2 = 1
            xx, xy, yy = yy + ck * t, xy + sk * t, xx - ck * t
            xz, yz = ck * xz - sk * yz, sk * xz + ck * yz
        rotation = [[exact(a) for a in row] for row in self.placement.rotation]
        columns = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        half = [combine(columns, rotation[i]) for i in range(3)]  # row i of R I
        found: list[list[Scalar]] = [[0, 0, 0] for _ in range(3)]
        for i in range(3):
            for k in range(i, 3):
                found[i][k] = found[k][i] = dot(half[i], rotation[k])
        return found


@dataclass(frozen=True)
class Tree:
    """A robot's bodies in an order in which parents come first, its frames, and gravity in the base frame."""

    bodies: tuple[Body, ...]
    frames: tuple[Frame, ...]
    coordinates: Coordinates
    gravity: tuple[float, float, float]

    @classmethod
    def of(cls, model: RobotModel) -> Tree:
        """The tree of a model; frames keep their order, placed in the z frames of their joints."""
        back: dict[int, Placement] = {-1: Placement()}
        bodies: list[Body] = []
        number = 0
        for k, joint in enumerate(model.joints):
            turn = Placement() if joint.kind == "floating" else to_axis(joint.axis)
            placement = back[joint.parent] @ joint.placement @ turn
            back[k] = turn.inverse()
            inertia = None if joint.inertia is None else joint.inertia.placed(back[k])
            bodies.append(Body(joint, joint.parent, placement, inertia, -1 if joint.kind == "floating" else number))
            number += joint.kind != "floating"
        frames = tuple(Frame(f.name, f.joint, back[f.joint] @ f.placement) for f in model.frames)
        return cls(tuple(bodies), frames, model.coordinates, model.gravity)

    @property
    def floating(self) -> bool:
        """Whether the base moves."""
        return self.coordinates.floating

    @cached_property
    def screws(self) -> tuple[tuple[int, int], ...]:
        """For each screw its body, and which of the six of a floating base it is (-1: a joint's)."""
        return tuple((k, i) for k, body in enumerate(self.bodies) for i in (range(6) if body.floats else (-1,)))

    @cached_property
    def above(self) -> tuple[tuple[int, ...], ...]:
        """For each body itself and its ancestors, outermost first."""
        paths: list[tuple[int, ...]] = []
        for k, body in enumerate(self.bodies):
            paths.append((*(paths[body.parent] if body.parent >= 0 else ()), k))
        return tuple(paths)

    def rates(self, v: Vector) -> list[Scalar]:
        """Velocities -> the rate of each screw (joints that mimic: the ratio times their leader's)."""
        return [v[k] if ratio == 1.0 else ratio * v[k] for k, ratio in self.coordinates.columns]

    def gathered(self, by_screw: Vector) -> list[Scalar]:
        """One number for each screw -> one for each velocity, the transpose of `rates`."""
        sums: list[Scalar] = [0] * self.coordinates.nv
        for (k, ratio), x in zip(self.coordinates.columns, by_screw, strict=True):
            sums[k] = sums[k] + (x if ratio == 1.0 else ratio * x)
        return sums

    def gathered_matrix(self, by_screw: list[list[Scalar]]) -> list[Scalar]:
        """A matrix over the screws -> over the velocities, row-major."""
        rows = [self.gathered(row) for row in by_screw]
        columns = [self.gathered([row[k] for row in rows]) for k in range(self.coordinates.nv)]
        return [columns[k][i] for i in range(self.coordinates.nv) for k in range(self.coordinates.nv)]

    def armature(self) -> list[float]:
        """Inertia of each screw's rotor (kg m^2 or kg)."""
        return [self.bodies[k].joint.armature for k, _ in self.screws]


def minus_gravity(tree: Tree, base: Vector | None) -> list[Scalar]:
    """What gravity is to dynamics: the base accelerating against it, in the base frame (floating: in the moving base's own axes)."""
    up = [exact(-x) for x in tree.gravity]
    if base is None or not tree.floating:
        return up
    stands = STANDING.place(tree.bodies[0].placement).join(of_motor(base))
    return [dot(column, up) for column in stands.columns]
