"""What the tests of paper B share: its robots as models and, joint by joint, as Pinocchio's; random states; the oracle's samples."""

import cmath
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio
import pytest

from cga_codegen.algebra.blade_types import MOTOR
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.robots.bundled import load_bundled
from cga_codegen.robots.from_urdf import load_urdf
from cga_codegen.robots.model import Frame, Inertia, Joint, Placement, RobotModel, as_rotation

DATA = Path(__file__).parents[1] / "data"
sys.path.insert(0, str(Path(__file__).parent / "oracles"))  # what the tests of paper A share
TWIST_ROWS = "e23 e13 e12 e1i e2i e3i"
"""Rows of a Jacobian in the paper and in the oracle file: w1 -w2 w3 v1 v2 v3."""
MOTOR_ROWS = "1 e23 e13 e12 e1i e2i e3i e123i"
"""Order of (61) and of the oracle file."""


def in_paper_rows(columns: Sequence[Multivector]) -> np.ndarray:
    """Twists as columns of a matrix with the paper's rows."""
    return np.array([column.at(TWIST_ROWS) for column in columns]).T


def linear_first(columns: Sequence[Multivector]) -> np.ndarray:
    """The same with Pinocchio's rows v1 v2 v3 w1 w2 w3."""
    return (in_paper_rows(columns) * np.array([1, -1, 1, 1, 1, 1])[:, None])[[3, 4, 5, 0, 1, 2]]


def motor_of(values: Sequence[Any]) -> Multivector:
    """A motor from numbers in the paper's order (61)."""
    named = dict(zip(MOTOR_ROWS.split(), values, strict=True))
    return Multivector.from_blades(MOTOR, scalar=named.pop("1"), **named)


def pose_of(motor: Multivector) -> np.ndarray:
    """The homogeneous matrix of a motor, by quaternion formulas: nothing of the algebra is used."""
    w, e23, e13, e12, *rest = motor.at(MOTOR_ROWS)
    x, y, z = -e23, e13, -e12  # cos - sin a I3 with a I3 = a1 e23 - a2 e13 + a3 e12
    pose = np.eye(4)
    pose[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    u, (s,), v = -2 * np.array(rest[:3]), rest[3:], np.array([x, y, z])  # u = w t + t x v and 2 s = t . v for M = (1 - t ei / 2) R
    pose[:3, 3] = w * u + np.cross(v, u) + 2 * s * v
    return pose


@dataclass(frozen=True)
class PaperRobot:
    """A robot of the tests: our model, and Pinocchio's, built from the same numbers joint by joint (every joint one q, one v)."""

    model: RobotModel
    pin: pinocchio.Model
    samples: tuple[dict[str, Any], ...] = ()

    in_paper_rows, linear_first = staticmethod(in_paper_rows), staticmethod(linear_first)
    motor_of, pose_of = staticmethod(motor_of), staticmethod(pose_of)

    @property
    def n(self) -> int:
        return len(self.model.joints)

    def half(self, q: Sequence[Any], cos: Any = cmath.cos, sin: Any = cmath.sin) -> tuple[list[Any], list[Any]]:
        """ch, sh of every joint; real for real q."""
        real = cos is cmath.cos and not np.iscomplexobj(q)
        slides = [joint.kind == "prismatic" for joint in self.model.joints]
        ch = [1 if slide else cos(x / 2) for slide, x in zip(slides, q, strict=True)]
        sh = [x / 2 if slide else sin(x / 2) for slide, x in zip(slides, q, strict=True)]
        return ([x.real for x in ch], [x.real for x in sh]) if real else (ch, sh)

    def states(self, count: int, seed: int) -> np.ndarray:
        """count random (q, qd, qdd), each a row of three vectors."""
        rng = np.random.default_rng(seed)
        q = rng.uniform(-3, 3, (count, self.n))
        q[:, [joint.kind == "prismatic" for joint in self.model.joints]] /= 6
        return np.stack([q, rng.normal(size=(count, self.n)), rng.normal(size=(count, self.n))], 1)


def pinocchio_of(model: RobotModel) -> pinocchio.Model:
    """The same joints, axes and inertias, added one by one."""
    made = pinocchio.Model()
    made.gravity.linear = np.array(model.gravity)
    for joint in model.joints:
        slides = joint.kind == "prismatic"
        kind = (pinocchio.JointModelPrismaticUnaligned if slides else pinocchio.JointModelRevoluteUnaligned)(np.array(joint.axis))
        index = made.addJoint(joint.parent + 1, kind, pinocchio.SE3(joint.placement.matrix()), joint.name)
        if joint.inertia is not None:
            xx, xy, xz, yy, yz, zz = joint.inertia.tensor
            tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            made.appendBodyToJoint(
                index, pinocchio.Inertia(joint.inertia.mass, np.array(joint.inertia.com), tensor), pinocchio.SE3.Identity()
            )
    made.armature = np.array([joint.armature for joint in model.joints])
    return made


def random_inertia(rng: np.random.Generator) -> Inertia:
    """Of a cloud of six points: always one that a body can have."""
    masses, points = rng.uniform(0.1, 1, 6), rng.normal(scale=0.1, size=(6, 3))
    com = masses @ points / masses.sum()
    d = points - com
    tensor = sum(m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in zip(masses, d, strict=True))
    return Inertia(float(masses.sum()), tuple(com.tolist()), tuple(tensor[np.triu_indices(3)].tolist()))


def oracle_model(name: str, robot: dict[str, Any]) -> RobotModel:
    """From the numbers of the oracle file alone; its end frame does not turn behind the last joint (measured in the first sample)."""
    joints = []
    for k, given in enumerate(robot["joints"]):
        pose = pose_of(motor_of(given["motor_MF"]))
        tensor = tuple(np.array(given["inertia_com"])[np.triu_indices(3)].tolist())
        inertia = Inertia(given["mass"], tuple(given["com"]), tensor)
        placement = Placement(as_rotation(pose[:3, :3], name), tuple(pose[:3, 3].tolist()))
        limits = (robot["lower"][k], robot["upper"][k], np.inf, np.inf)
        joints.append(Joint(f"{name}_{k + 1}", "revolute", k - 1, placement, tuple(given["axis"]), *limits, inertia))
    length = {"panda": 0.107, "iiwa14": 0.035}[name]  # m, from the last joint to panda_link8, to lbr_link_ee
    end = Frame(robot["ee_frame"], len(joints) - 1, Placement(translation=(0.0, 0.0, length)))
    return RobotModel(name, tuple(joints), (end,))


@cache
def _robot(name: str) -> PaperRobot:
    if name == "panda":
        return PaperRobot(model := load_bundled("panda").locked({"panda_finger_joint*": 0.0}), pinocchio_of(model))
    if name in ("iiwa14", "leap_hand", "g1"):
        return PaperRobot(model := load_bundled(name), pinocchio_of(model))
    if name == "skew":  # the file of this made-up tree has no masses
        rng, skew = np.random.default_rng(7), load_urdf(DATA / "skew.urdf")
        inertias = [None if joint.name == "left_turn" else random_inertia(rng) for joint in skew.joints]
        rotors = rng.uniform(0, 0.1, len(inertias)).tolist()
        joints = tuple(replace(j, inertia=body, armature=rotor) for j, body, rotor in zip(skew.joints, inertias, rotors, strict=True))
        return PaperRobot(model := replace(skew, joints=joints, gravity=(1.0, -2.0, -9.0)), pinocchio_of(model))
    source = json.loads((DATA / "dynamics.json").read_text())[name.removesuffix("_oracle")]
    return PaperRobot(model := oracle_model(name.removesuffix("_oracle"), source), pinocchio_of(model), tuple(source["samples"]))


@pytest.fixture(params=["panda", "iiwa14", "skew"])
def robot(request: pytest.FixtureRequest) -> PaperRobot:
    """The bundled Panda (fingers locked) and iiwa14, and the made-up tree with prismatic joints, masses and armatures."""
    return _robot(request.param)


@pytest.fixture(params=["leap_hand", "g1"])
def large_tree(request: pytest.FixtureRequest) -> PaperRobot:
    """The bundled hand (16 joints) and humanoid (29 joints, pelvis fixed)."""
    return _robot(request.param)


@pytest.fixture(params=["panda", "iiwa14"])
def arms(request: pytest.FixtureRequest) -> tuple[PaperRobot, PaperRobot]:
    """An arm as bundled, and as in the oracle file."""
    return _robot(request.param), _robot(f"{request.param}_oracle")


@pytest.fixture(params=["panda_oracle", "iiwa14_oracle"])
def oracle(request: pytest.FixtureRequest) -> PaperRobot:
    """The arms of the oracle file, from its own numbers, with its samples."""
    return _robot(request.param)


@pytest.fixture
def panda() -> PaperRobot:
    """The oracle file's Panda."""
    return _robot("panda_oracle")
