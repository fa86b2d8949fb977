"""How far our kernels are from Pinocchio's and MuJoCo's on random states of any robot: the numbers behind docs/accuracy.md.

Errors are relative by state: the largest difference over the largest entry of the peer's answer (or over a thousandth of its largest in
all states, where a state's own is smaller). Frames' poses have entries of size one, so that theirs is over at least 1. The condition of
the mass matrix is measured with them: by it forward dynamics amplify the rounding of whoever computes them.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cga_runtime.conventions import FRAMES
from cga_runtime.layout import BASE, TWIST
from cga_runtime.motors import Motor
from cga_runtime.robot import Robot

Array = NDArray[np.float64]

SINGULAR = 1e14
"""Condition of a mass matrix from which on forward dynamics do not exist: a joint carries no inertia."""
CHAINS = 3
"""Of how many tips the chains' Jacobians are compared."""


@dataclass
class Worst:
    """Largest relative errors so far, by quantity."""

    errors: dict[str, float] = field(default_factory=dict)

    def add(self, what: str, ours: Array, theirs: Array, least: float = 0.0) -> None:
        """Compares a batch, states first. NaN anywhere is an infinite error."""
        ours, theirs = np.reshape(ours, (len(ours), -1)), np.reshape(theirs, (len(theirs), -1))
        if theirs.shape[1] == 0:
            return
        size = np.abs(theirs).max(axis=1)
        scale = np.maximum(np.maximum(size, 1e-3 * size.max()), least)
        difference = np.abs(ours - theirs).max(axis=1)
        found = float((difference / np.where(scale > 0.0, scale, 1.0)).max()) if np.isfinite([ours, theirs]).all() else float("inf")
        self.errors[what] = max(self.errors.get(what, 0.0), found)


@dataclass(frozen=True)
class States:
    """Random states of a robot: q (count, nq), and v, a, tau (count, nv)."""

    q: Array
    v: Array
    a: Array
    tau: Array

    @classmethod
    def draw(cls, robot: Robot, count: int, seed: int) -> States:
        """Joints anywhere within +-pi (m or rad), a floating base anywhere; rates of size one."""
        rng = np.random.default_rng(seed)
        q = robot.random(rng, count)
        first = BASE if robot.layout.floating else 0
        q[:, first:] = rng.uniform(-np.pi, np.pi, (count, robot.nq - first))
        v, a = rng.standard_normal((2, count, robot.nv))
        return cls(q, v, a, 10.0 * rng.standard_normal((count, robot.nv)))


class Peer:
    """Pinocchio's model of the same URDF with every joint independent, and how our coordinates move its joints: q_peer = G q + shift."""

    def __init__(self, robot: Robot, urdf: Path) -> None:
        import pinocchio as pin

        root = (pin.JointModelFreeFlyer(),) if robot.layout.floating and not _floats(urdf) else ()
        self.model = pin.buildModelFromUrdf(str(urdf), *root)
        self.data = self.model.createData()
        self.floating = robot.layout.floating
        follow = mimics(urdf) if set(robot.joint_names) != set(self.model.names[1:]) else {}
        first = TWIST if self.floating else 0
        self.gather = np.zeros((self.model.nv, robot.nv))
        self.gather[:first, :first] = np.eye(first)
        self.shift = np.zeros(self.model.nv)
        for name, joint in list(zip(self.model.names, self.model.joints, strict=True))[2 if self.floating else 1 :]:
            leader, ratio, shift = follow.get(name, (name, 1.0, 0.0))
            self.gather[joint.idx_v, robot.layout.places([leader])[1]] = ratio
            self.shift[joint.idx_v] = shift

    def position(self, q: Array) -> Array:
        """Pinocchio's configuration."""
        import pinocchio as pin

        first = BASE if self.floating else 0
        moves = self.gather[:, TWIST if self.floating else 0 :] @ q[first:] + self.shift
        found: Array = pin.integrate(self.model, pin.neutral(self.model), moves)
        if self.floating:
            pose = Motor(q[:BASE]).pose()
            found[:7] = [*pose[:3, 3], *pin.Quaternion(pose[:3, :3]).coeffs()]
        return found


def _floats(urdf: Path) -> bool:
    return any(joint.get("type") == "floating" for joint in ET.parse(urdf).getroot().findall("joint"))


def mimics(urdf: Path) -> dict[str, tuple[str, float, float]]:
    """Of each mimicking joint of a URDF its leader, ratio and offset, as the file says (leaders must not mimic)."""
    found = {}
    for joint in ET.parse(urdf).getroot().findall("joint"):
        element = joint.find("mimic")
        if element is not None:
            ratio, shift = float(element.get("multiplier", "1")), float(element.get("offset", "0"))
            found[str(joint.get("name"))] = (str(element.get("joint")), ratio, shift)
    return found


def against_pinocchio(robot: Robot, urdf: Path, count: int = 1000, seed: int = 0, chains: int = CHAINS) -> dict[str, float]:
    """Relative errors of every whole-body kernel and of the chains to some tips, by quantity."""
    peer, states, worst = Peer(robot, urdf), States.draw(robot, count, seed), Worst()
    theirs = _pinocchio_answers(peer, states, robot)
    q, v, a, tau = states.q, states.v, states.a, states.tau
    worst.add("frames", robot.frames(q), theirs["frames"], 1.0)
    if not robot.nv:
        return worst.errors
    if sum(inertia.mass for inertia in list(peer.model.inertias)[1:]) > 0.0:
        worst.add("center of mass", robot.center_of_mass(q), theirs["com"], 1.0)
        worst.add("its Jacobian", robot.center_of_mass_jacobian(q), theirs["com_jacobian"])
    force = 1e-3 * float(np.abs(theirs["id"]).max())  # where gravity or Coriolis forces vanish, rounding is of those that do not
    worst.add("inverse dynamics", robot.inverse_dynamics(q, v, a), theirs["id"])
    worst.add("bias", robot.bias(q, v), theirs["bias"], force)
    worst.add("gravity", robot.gravity(q), theirs["gravity"], force)
    worst.add("mass matrix", robot.mass_matrix(q), theirs["mass"])
    inertial = 1e-3 * float(np.abs(theirs["mass"]).max())  # rates have size one: where Coriolis terms vanish, rounding is of this kind
    worst.add("Coriolis matrix", robot.coriolis(q, v), theirs["coriolis"], inertial)
    by_q, by_v, _ = robot.inverse_dynamics_derivatives(q, v, a)
    worst.add("d tau/dq", by_q, theirs["by_q"], force)
    worst.add("d tau/dv", by_v, theirs["by_v"], inertial)
    condition = float(np.linalg.cond(theirs["mass"]).max())
    if np.isfinite(theirs["fd"]).all() and condition < SINGULAR:
        worst.errors["condition"] = condition
        worst.add("forward dynamics", robot.forward_dynamics(q, v, tau), theirs["fd"])
    _chains(robot, peer, states, worst, chains)
    return worst.errors


def _pinocchio_answers(peer: Peer, states: States, robot: Robot) -> dict[str, Array]:
    import pinocchio as pin

    model, data, g = peer.model, peer.data, peer.gather
    frames = _frame_numbers(model, robot.frame_names)
    rows: dict[str, list[Array]] = {}
    for q, v, a, tau in zip(states.q, states.v, states.a, states.tau, strict=True):
        x, dx, ddx = peer.position(q), g @ v, g @ a
        pin.framesForwardKinematics(model, data, x)
        answer = {"frames": np.array([data.oMf[k].homogeneous for k in frames])}
        answer["com"], answer["com_jacobian"] = pin.centerOfMass(model, data, x), pin.jacobianCenterOfMass(model, data, x) @ g
        answer["id"], answer["bias"] = g.T @ pin.rnea(model, data, x, dx, ddx), g.T @ pin.nonLinearEffects(model, data, x, dx)
        answer["gravity"] = g.T @ pin.computeGeneralizedGravity(model, data, x)
        upper = np.triu(pin.crba(model, data, x))
        answer["mass"] = g.T @ (upper + np.triu(upper, 1).T) @ g
        answer["coriolis"] = g.T @ pin.computeCoriolisMatrix(model, data, x, dx) @ g
        pin.computeRNEADerivatives(model, data, x, dx, ddx)
        answer["by_q"], answer["by_v"] = g.T @ data.dtau_dq @ g, g.T @ data.dtau_dv @ g
        if model.nv == robot.nv:
            answer["fd"] = pin.aba(model, data, x, dx, g @ tau)  # g is a permutation
            answer["fd"] = g.T @ answer["fd"]
        else:
            answer["fd"] = _solved(answer["mass"], tau - answer["bias"])
        for key, value in answer.items():
            rows.setdefault(key, []).append(np.array(value))
    return {key: np.array(values) for key, values in rows.items()}


def _solved(matrix: Array, right: Array) -> Array:
    """NaN where a joint carries no inertia."""
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)


def _frame_numbers(model: Any, names: Sequence[str]) -> list[int]:
    """Pinocchio's frames of our names; where a joint and a link share one, the first."""
    first: dict[str, int] = {}
    for k, frame in enumerate(model.frames):
        name = frame.name
        if name in first and (model.frames[first[name]].parentJoint, model.frames[first[name]].placement) != (
            frame.parentJoint,
            frame.placement,
        ):
            name += ":link" if str(frame.type) == "BODY" else ":joint"
        first.setdefault(name, k)
    return [first[name] for name in names]


def _chains(robot: Robot, peer: Peer, states: States, worst: Worst, chains: int) -> None:
    import pinocchio as pin

    model, data, g = peer.model, peer.data, peer.gather
    for tip in robot.tips[:chains]:
        chain, (number,) = robot.chain(tip), _frame_numbers(model, [tip])
        q, v = states.q[:, chain.index], states.v[:, chain.columns]
        poses: list[Array] = []
        by_frame: dict[str, tuple[list[Array], list[Array]]] = {frame: ([], []) for frame in FRAMES}
        for state, rate in zip(states.q, states.v, strict=True):
            x = peer.position(state)
            pin.computeJointJacobiansTimeVariation(model, data, x, g @ rate)
            pin.updateFramePlacements(model, data)
            poses.append(data.oMf[number].homogeneous.copy())
            for frame, (jacobians, rates) in by_frame.items():
                reference = getattr(pin.ReferenceFrame, frame)
                jacobians.append((pin.getFrameJacobian(model, data, number, reference) @ g)[:, chain.columns])
                rates.append((pin.getFrameJacobianTimeVariation(model, data, number, reference) @ g)[:, chain.columns])
        worst.add("pose", chain.pose(q), np.array(poses), 1.0)
        worst.add("pose", Motor(chain.motor(q)).pose(), np.array(poses), 1.0)
        for frame, (jacobians, rates) in by_frame.items():
            worst.add("Jacobian", chain.jacobian(q, frame), np.array(jacobians))
            worst.add("its derivative", chain.jacobian_derivative(q, v, frame), np.array(rates), 1e-3)


def against_mujoco(robot: Robot, urdf: Path, count: int = 1000, seed: int = 0) -> dict[str, float]:
    """Relative errors against MuJoCo's reading of the same URDF, for a robot loaded with mimic="independent": bodies' poses, mass matrix,
    bias, inverse and forward dynamics."""
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(urdf))
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
    data, states, worst = mujoco.MjData(model), States.draw(robot, count, seed), Worst()
    names = [model.joint(k).name for k in range(model.njnt)]
    order = np.array([robot.joint_names.index(name) for name in names])
    bodies = [k for k in range(1, model.nbody) if model.body(k).name in robot.frame_names]
    rows: dict[str, list[Array]] = {}
    dense = np.zeros((model.nv, model.nv))
    back = np.argsort(order)
    for q, v, a, tau in zip(states.q, states.v, states.a, states.tau, strict=True):
        data.qpos[:], data.qvel[:], data.qacc[:] = q[order], v[order], a[order]
        data.qfrc_applied[:] = 0.0
        mujoco.mj_inverse(model, data)
        passive = data.qfrc_passive.copy()  # damping and springs: not part of what is compared
        rows.setdefault("inverse dynamics", []).append((data.qfrc_inverse + passive)[back])
        rows.setdefault("bias", []).append(data.qfrc_bias[back])
        mujoco.mj_fullM(model, data, dense)
        rows.setdefault("mass matrix", []).append(dense[np.ix_(back, back)])
        poses = np.tile(np.eye(4), (len(bodies), 1, 1))
        poses[:, :3, :3], poses[:, :3, 3] = data.xmat[bodies].reshape(-1, 3, 3), data.xpos[bodies]
        rows.setdefault("frames", []).append(poses)
        data.qfrc_applied[:] = tau[order] - passive
        mujoco.mj_forward(model, data)
        rows.setdefault("forward dynamics", []).append(data.qacc[back])
    theirs = {key: np.array(values) for key, values in rows.items()}
    numbers = [robot.frame_names.index(model.body(k).name) for k in bodies]
    worst.add("frames", robot.frames(states.q)[:, numbers], theirs["frames"], 1.0)
    worst.add("mass matrix", robot.mass_matrix(states.q), theirs["mass matrix"])
    worst.add("bias", robot.bias(states.q, states.v), theirs["bias"])
    worst.add("inverse dynamics", robot.inverse_dynamics(states.q, states.v, states.a), theirs["inverse dynamics"])
    worst.add("forward dynamics", robot.forward_dynamics(states.q, states.v, states.tau), theirs["forward dynamics"])
    return worst.errors
