"""Robots for the tests of kernels: a made-up tree with masses, the same with mimicking joints and on a moving base, and Pinocchio's model
of each, built joint by joint with every joint independent (q_peer = G q), so that what mimics is tested by a projection."""

import cmath
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio

from cga_codegen.algebra.blade_types import MOTOR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.tree import Tree
from cga_codegen.kernels.versors import translator
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import Frame, Inertia, Joint, Placement, RobotModel, Vector3

H = 1e-30
"""Of the complex step: no difference is formed."""
UP = np.inf


def body(rng) -> Inertia:
    """Of a cloud of six points: always one that a body can have."""
    masses, points = rng.uniform(0.1, 1, 6), rng.normal(scale=0.1, size=(6, 3))
    com = masses @ points / masses.sum()
    tensor = sum(m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in zip(masses, points - com, strict=True))
    return Inertia(float(masses.sum()), tuple(com.tolist()), tuple(tensor[np.triu_indices(3)].tolist()))


def loaded(model: RobotModel, gravity: Vector3 = (1.0, -2.0, -9.0)) -> RobotModel:
    """With masses (but for one joint amid the chain), rotors, and gravity that is not along an axis."""
    rng = np.random.default_rng(7)
    joints = [replace(j, inertia=None if j.name == "left_turn" else body(rng), armature=rng.uniform(0, 0.1)) for j in model.joints]
    return replace(model, joints=tuple(joints), gravity=gravity)


def following(model: RobotModel) -> RobotModel:
    """A follower before its leader, two of one leader on another branch, slides that follow turns and the other way; both signs."""
    laws = {"right_bend": ("right_roll", -0.7), "right_slide": ("left_slide", 1.5), "right_turn": ("left_slide", 0.8)}
    laws |= {"left_lift": ("left_turn", -0.4), "left_bend": ("lean", 2.0)}

    def joint(j: Joint) -> Joint:
        leader, ratio = laws.get(j.name, ("", 1.0))
        return replace(j, follows=leader, ratio=ratio, armature=0.0 if leader else j.armature)

    return replace(model, joints=tuple(joint(j) for j in model.joints))


def floated(model: RobotModel) -> RobotModel:
    """On a base that moves freely, from a frame that is turned and shifted in the world; the base has a mass."""
    placement = Placement.turn((0.36, 0.48, 0.8), 0.9) @ Placement(translation=(0.3, -0.2, 0.5))
    base = Joint("drift", "floating", -1, placement, (0.0, 0.0, 0.0), -UP, UP, UP, UP, body(np.random.default_rng(8)))
    joints = (base, *(replace(j, parent=j.parent + 1) for j in model.joints))
    frames = (Frame("world", -1, Placement()), *(replace(f, joint=f.joint + 1) for f in model.frames))
    return replace(model, joints=joints, frames=frames)


def motor_of(rotation: np.ndarray, t: Any) -> list[float]:
    """T(t) R of a rotation matrix, by Pinocchio's quaternion and the algebra's product."""
    x, y, z, w = pinocchio.Quaternion(rotation).coeffs()
    rotor = Multivector.from_blades(MOTOR, scalar=w, e12=-z, e13=y, e23=-x)
    return list((translator([float(k) for k in t]) * rotor).project(MOTOR).coefficients)


def base_rate(motor: Any, twist: Any) -> list[Any]:
    """dM = -1/2 M V of a twist (linear, angular) in the base's own axes (paper A, eq. 8)."""
    v, w = twist[:3], twist[3:]
    rate = Multivector(MOTOR, list(motor)) * Multivector(TWIST, [w[2], -w[1], w[0], *v])
    return list(rate.scaled(-0.5).project(MOTOR).coefficients)


@dataclass
class Subject:
    """A robot (or a chain's coordinates), states of it, and what kernels take."""

    model: RobotModel

    def __post_init__(self) -> None:
        self.tree, self.coordinates = Tree.of(self.model), self.model.coordinates
        self.floating, self.n = self.coordinates.floating, self.coordinates.nv
        self.first = 8 if self.floating else 0
        self.peer = Peer(self.model)

    def states(self, count: int, seed: int) -> list[tuple[np.ndarray, ...]]:
        """count random (q, v, a)."""
        rng = np.random.default_rng(seed)
        found = []
        for _ in range(count):
            q = rng.uniform(-2, 2, self.coordinates.nq)
            if self.floating:
                q[:8] = motor_of(random_rotation(rng), rng.normal(size=3))
            found.append((q, *rng.normal(size=(2, self.n))))
        return found

    def inputs(self, q: Any, joints: Any = None, half: bool = False) -> dict[str, Any]:
        """c, s (half: ch, sh) of the joints that do not float, and base; joints: of a chain."""
        given = list(self.model.joints if joints is None else joints)
        at = {name: k for k, name in enumerate(self.coordinates.names[int(self.floating) :])}
        first, second = ("ch", "sh") if half else ("c", "s")
        found: dict[str, Any] = {first: [], second: []}
        for joint in given:
            if joint.kind != "floating":
                x = joint.ratio * q[self.first + at[joint.follows or joint.name]] * (0.5 if half else 1.0)
                slides = joint.kind == "prismatic"
                exact = np.iscomplexobj(q)
                c, s = (1, x) if slides else (cmath.cos(x), cmath.sin(x)) if exact else (np.cos(x), np.sin(x))
                found[first].append(c), found[second].append(s)
        if given and given[0].kind == "floating":
            found["base"] = list(q[:8])
        return found

    def moved(self, q: Any, direction: int, step: Any) -> Any:
        """q a first-order step along one velocity: complex steps give exact derivatives."""
        moved = q + 0 * step
        if self.floating and direction < 6:
            moved[:8] = moved[:8] + step * np.array(base_rate(q[:8], np.eye(6)[direction]))
        else:
            moved[direction + (2 if self.floating else 0)] += step
        return moved

    def by_q(self, function: Any, q: Any) -> np.ndarray:
        """All derivatives of function(q) along velocities, the last axis counts them."""
        return np.stack([np.array(function(self.moved(q, k, 1j * H)), dtype=complex).imag / H for k in range(self.n)], axis=-1)


def random_rotation(rng) -> np.ndarray:
    x = rng.normal(size=4)
    return pinocchio.Quaternion(*(x / np.linalg.norm(x))).matrix()


class Peer:
    """Pinocchio's model with every joint independent; positions and velocities of it from ours."""

    def __init__(self, model: RobotModel) -> None:
        self.of, self.model = model, pinocchio.Model()
        self.model.gravity.linear = np.array(model.gravity)
        columns = model.coordinates.columns
        for joint in model.joints:
            axis = np.array(joint.axis)
            kind = {
                "floating": pinocchio.JointModelFreeFlyer,
                "prismatic": lambda axis=axis: pinocchio.JointModelPrismaticUnaligned(axis),
            }.get(joint.kind, lambda axis=axis: pinocchio.JointModelRevoluteUnaligned(axis))()
            index = self.model.addJoint(joint.parent + 1, kind, pinocchio.SE3(joint.placement.matrix()), joint.name)
            self.model.addJointFrame(index)
            if joint.inertia is not None:
                given = pinocchio.Inertia(joint.inertia.mass, np.array(joint.inertia.com), joint.inertia.matrix())
                self.model.appendBodyToJoint(index, given, pinocchio.SE3.Identity())
        self.frames: dict[str, int] = {}
        for frame in model.frames:
            where = pinocchio.SE3(frame.placement.matrix())  # @: joints have frames of their names there
            given = pinocchio.Frame(f"@{frame.name}", frame.joint + 1, 0, where, pinocchio.FrameType.OP_FRAME)
            self.frames[frame.name] = self.model.addFrame(given)
        self.model.armature = np.array([x for joint in model.joints for x in [joint.armature] * (6 if joint.kind == "floating" else 1)])
        self.data = self.model.createData()
        self.gather = np.zeros((self.model.nv, model.coordinates.nv))
        for row, (column, ratio) in enumerate(columns):
            self.gather[row, column] = ratio

    def position(self, q: np.ndarray) -> np.ndarray:
        if not self.of.coordinates.floating:
            return self.gather @ q
        a, b12, b13, b23, t1, t2, t3, t123 = q[:8]
        turn = pinocchio.Quaternion(a, -b23, b13, -b12)
        # M = R - t ei R / 2, and t ei = -2 (M - R) ~R: the vector part
        x = a * t1 + b12 * t2 + b13 * t3 + b23 * t123
        y = a * t2 - b12 * t1 + b23 * t3 - b13 * t123
        z = a * t3 - b13 * t1 - b23 * t2 + b12 * t123
        return np.array([-2 * x, -2 * y, -2 * z, *turn.coeffs(), *(self.gather[6:, 6:] @ q[8:])])


SKEW = Path(__file__).parents[2] / "data" / "skew.urdf"


def make(name: str) -> Subject:
    model = loaded(load_urdf(SKEW))
    for change in name.split(", ")[1:]:
        model = {"mimicking": following, "floating": floated}[change](model)
    return Subject(model)
