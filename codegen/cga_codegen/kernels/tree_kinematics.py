"""Kinematics of a whole robot: the poses of all its frames, its centre of mass and that point's Jacobian."""

from __future__ import annotations

from cga_codegen.kernels.axes import STANDING, Pose, of_motor
from cga_codegen.kernels.tree import Tree
from cga_codegen.kernels.vectors import Scalar, Vector, combine, cross, plus, times


def poses(tree: Tree, c: Vector, s: Vector, base: Vector | None = None) -> list[Pose]:
    """The z frame of each body, seen from the robot's base (with a floating base: from the world)."""
    found: list[Pose] = []
    for body in tree.bodies:
        pose = (found[body.parent] if body.parent >= 0 else STANDING).place(body.placement)
        if body.floats:
            assert base is not None, "the catalogue passes the base of a robot that has one"
            pose = pose.join(of_motor(base))
        else:
            pose = pose.slide(s[body.number]) if body.slides else pose.turn(c[body.number], s[body.number])
        found.append(pose)
    return found


def frames(tree: Tree, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Homogeneous matrices of all frames of the robot, in the order of its frame names."""
    at = poses(tree, c, s, base)
    entries: list[Scalar] = []
    for frame in tree.frames:
        pose = (at[frame.joint] if frame.joint >= 0 else STANDING).place(frame.placement)
        for i in range(3):
            entries += [*(column[i] for column in pose.columns), pose.origin[i]]
        entries += [0, 0, 0, 1]
    return entries


def _moments(tree: Tree, at: list[Pose]) -> tuple[list[float], list[list[Scalar]]]:
    """Of each body and all it carries: mass, and first moment about the origin that the poses are seen from."""
    masses = [body.inertia.mass if body.inertia else 0.0 for body in tree.bodies]
    moments: list[list[Scalar]] = []
    for body, pose, mass in zip(tree.bodies, at, masses, strict=True):
        com = body.inertia.com if body.inertia else (0.0, 0.0, 0.0)
        moments.append(plus(times(mass, pose.origin), combine(pose.columns, [mass * x for x in com])) if mass else [0, 0, 0])
    for k in range(len(tree.bodies) - 1, -1, -1):
        parent = tree.bodies[k].parent
        if parent >= 0:
            masses[parent] += masses[k]
            moments[parent] = plus(moments[parent], moments[k])
    return masses, moments


def _total(tree: Tree, masses: list[float]) -> float:
    return sum(mass for body, mass in zip(tree.bodies, masses, strict=True) if body.parent < 0)


def center_of_mass(tree: Tree, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Centre of mass (m) of all that moves, in the base frame (with a floating base: in the world, and the base's own mass counts)."""
    masses, moments = _moments(tree, poses(tree, c, s, base))
    whole: list[Scalar] = [0, 0, 0]
    for body, moment in zip(tree.bodies, moments, strict=True):
        if body.parent < 0:
            whole = plus(whole, moment)
    return times(1.0 / _total(tree, masses), whole)


def center_of_mass_jacobian(tree: Tree, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """Jacobian (3 x n) of the centre of mass: what a joint carries moves with it, column (w x h + m v) / total mass."""
    at = poses(tree, c, s, base)
    masses, moments = _moments(tree, at)
    total = _total(tree, masses)
    columns: list[list[Scalar]] = []
    for k, axis in tree.screws:
        direction = at[k].columns[2 if axis < 0 else axis % 3]
        if tree.bodies[k].slides or 0 <= axis < 3:
            columns.append(times(masses[k] / total, direction))
        else:
            lever = [h - masses[k] * p for h, p in zip(moments[k], at[k].origin, strict=True)]
            columns.append(times(1.0 / total, cross(direction, lever)))
    rows = [tree.gathered([column[i] for column in columns]) for i in range(3)]
    return [x for row in rows for x in row]
