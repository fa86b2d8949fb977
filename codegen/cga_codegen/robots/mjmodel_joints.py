"""What a mujoco.MjModel says of its joints besides their place: the joints that follow others, force limits, armatures, names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from cga_codegen.robots.errors import BadNumberError, TreeError, UnsupportedJointError

Follows = Mapping[int, tuple[int, float, float]]
"""Joint -> the one it follows, ratio and shift: q = ratio q_followed + shift."""

ADVICE = "with ignore_constraints=True it is left out"

ROOT = "root_joint"
"""Name of the joint of a floating base that has none, as in Pinocchio."""


class MjJoints:
    """Reads the joints of one model (`mujoco` is the package); `label` names the model in every message."""

    def __init__(self, mujoco: Any, model: Any, label: str) -> None:
        self.mujoco, self.model, self.label = mujoco, model, label
        kinds = mujoco.mjtJoint
        self.hinge, self.slide, self.ball, self.free = map(int, (kinds.mjJNT_HINGE, kinds.mjJNT_SLIDE, kinds.mjJNT_BALL, kinds.mjJNT_FREE))
        self.names = self.unique("JOINT", model.njnt, "joint")
        if self.kind(0) == self.free and not self.given("JOINT", 0) and ROOT not in self.names:
            self.names[0] = ROOT

    def given(self, kind: str, index: int) -> str:
        """The name in the model, "" if there is none."""
        return self.mujoco.mj_id2name(self.model, getattr(self.mujoco.mjtObj, f"mjOBJ_{kind}"), index) or ""

    def unique(self, kind: str, count: int, word: str) -> list[str]:
        """The names, those without one called by `word` and their index."""
        names = [self.given(kind, index) for index in range(count)]
        for index, name in enumerate(names):
            made = word + str(index)
            while not name and made in names:
                made += "_"
            names[index] = name or made
        return names

    def kind(self, j: int) -> int:
        """MuJoCo's type of the joint; -1 if there is no such joint."""
        return int(self.model.jnt_type[j]) if j < self.model.njnt else -1

    def reference(self, j: int) -> float:
        """The value of the joint at which its body stands as the file draws it (`ref`)."""
        return float(self.model.qpos0[self.model.jnt_qposadr[j]])

    # ---- constraints

    def constraints(self, ignore: bool) -> tuple[Follows, dict[str, float]]:
        """The joints that follow others, and the values at which joints are held (by name).

        MuJoCo's polynomial: y - y_ref = a0 + a1 (x - x_ref) + a2 (x - x_ref)^2 + ..., without a second joint y = y_ref + a0.
        """
        m, kinds = self.model, self.mujoco.mjtEq
        follows: dict[int, tuple[int, float, float]] = {}
        held: dict[int, float] = {}
        off = int(m.opt.disableflags) & int(self.mujoco.mjtDisableBit.mjDSBL_EQUALITY)
        for e in np.flatnonzero(m.eq_active0).tolist() if m.neq and not off else ():
            kind = kinds(int(m.eq_type[e]))
            label = f"{self.label}: equality {self.given('EQUALITY', e) or e!r}"
            if kind != kinds.mjEQ_JOINT:
                if not ignore:
                    word = kind.name.removeprefix("mjEQ_").lower()
                    raise TreeError(f"{label} is of kind {word}, which closes a loop; linear joint constraints are read, {ADVICE}")
                continue
            joint, leader = int(m.eq_obj1id[e]), int(m.eq_obj2id[e])
            constant, ratio, *curved = (float(x) for x in m.eq_data[e, :5])
            second = joint in follows or joint in held
            if second or (leader >= 0 and any(curved)):
                if not ignore:
                    why = f"is the second of joint {self.names[joint]!r}" if second else "is not linear"
                    raise UnsupportedJointError(f"{label} {why}; one linear joint constraint a joint is read, {ADVICE}")
            elif leader < 0 or ratio == 0.0:
                held[joint] = self.reference(joint) + constant
            else:
                follows[joint] = leader, ratio, self.reference(joint) + constant - ratio * self.reference(leader)
        return {joint: self.leader(joint, follows) for joint in follows}, {self.names[joint]: value for joint, value in held.items()}

    def leader(self, joint: int, follows: Follows) -> tuple[int, float, float]:
        """Joints that follow followers follow their leader's leader: q = r1 (r2 q + s2) + s1."""
        found, ratio, shift = follows[joint]
        seen = {joint}
        while found in follows and found not in seen:
            seen.add(found)
            found, more, offset = follows[found]
            ratio, shift = ratio * more, ratio * offset + shift
        if found in seen:
            name = self.names[joint]
            raise UnsupportedJointError(f"{self.label}: joint {name!r} follows itself in the end; one joint must move by itself")
        return found, ratio, shift

    # ---- actuators

    def actuators(self, j: int) -> list[int]:
        """Those that act on the joint itself."""
        m, ways = self.model, self.mujoco.mjtTrn
        direct = np.isin(m.actuator_trntype, [int(ways.mjTRN_JOINT), int(ways.mjTRN_JOINTINPARENT)])
        return [int(a) for a in np.flatnonzero(direct) if m.actuator_trnid[a, 0] == j]

    def armature(self, j: int) -> float:
        """Of the joint and, times gear^2, of the actuators on it (which older versions of MuJoCo do not have)."""
        m = self.model
        return float(m.dof_armature[m.jnt_dofadr[j]]) + sum(self.rotor(a) * float(m.actuator_gear[a, 0]) ** 2 for a in self.actuators(j))

    def refuse_other_armatures(self) -> None:
        """Those of a free joint, and of tendons and the actuators on them: they are in no joint's own coordinate."""
        m = self.model
        free = self.kind(0) == self.free
        if free and (np.any(m.dof_armature[:6]) or any(self.rotor(a) for a in self.actuators(0))):
            advice = f"give it armature=0, or write <freejoint/>; {ADVICE}"
            raise UnsupportedJointError(f"{self.label}: joint {self.names[0]!r} is free and has an armature; {advice}")
        on_joints = {a for j in range(m.njnt) for a in self.actuators(j)}
        rotors = [a for a in range(len(m.actuator_trntype)) if a not in on_joints and self.rotor(a)]
        if rotors or (hasattr(m, "tendon_armature") and np.any(m.tendon_armature)):
            raise UnsupportedJointError(f"{self.label}: a tendon has an armature, which couples joints; those of joints are read, {ADVICE}")

    def rotor(self, a: int) -> float:
        """The armature of an actuator."""
        return float(self.model.actuator_armature[a]) if hasattr(self.model, "actuator_armature") else 0.0

    def effort(self, j: int) -> float:
        """The largest force on the joint (N m or N): what its actuators can do together, within its own bound on them."""
        m = self.model
        acting = self.actuators(j)
        largest = sum(abs(float(m.actuator_gear[a, 0])) * self.force(a) for a in acting if m.actuator_gear[a, 0]) if acting else math.inf
        if m.jnt_actfrclimited[j]:
            largest = float(np.minimum(largest, np.abs(m.jnt_actfrcrange[j]).max()))  # unlike min() it keeps nan
        if math.isnan(largest):
            raise BadNumberError(f"{self.label}: joint {self.names[j]!r}: a force limit of its actuators is nan; numbers are needed")
        return largest

    def force(self, a: int) -> float:
        """The largest force of an actuator: its forcerange, and for a plain motor the gain times its ctrlrange."""
        m, mujoco = self.model, self.mujoco
        limit = float(np.abs(m.actuator_forcerange[a]).max()) if m.actuator_forcelimited[a] else math.inf
        made = (int(m.actuator_gaintype[a]), int(m.actuator_biastype[a]), int(m.actuator_dyntype[a]))
        plain = (int(mujoco.mjtGain.mjGAIN_FIXED), int(mujoco.mjtBias.mjBIAS_NONE), int(mujoco.mjtDyn.mjDYN_NONE))
        control = int(m.actuator_ctrladr[a]) if hasattr(m, "actuator_ctrladr") else a
        clamped = not int(m.opt.disableflags) & int(mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL)
        if made == plain and clamped and control >= 0 and m.actuator_ctrllimited[control]:
            limit = float(np.minimum(limit, abs(m.actuator_gainprm[a, 0]) * np.abs(m.actuator_ctrlrange[control]).max()))
        return limit
