"""What scripts/fuzz_urdf.py asks of one case: an accepted robot that is sound and the one Pinocchio or MuJoCo reads, or a good refusal."""

import json
import math
import os
import random
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

from robot_mutations import Case, case

TIPS = 8
"""Chains cut from one robot, at most."""
MOVING = ("revolute", "continuous", "prismatic")
MANY = 300
"""Joints of a robot that is compared, at most: Pinocchio's Data of a thousand takes gigabytes."""
HOLES = ("Pinocchio refuses it", "composed placement", "not a rotation")
"""Words of messages that no file should bring about: the reader's own checks come first."""
LONGEST = 2000
"""Characters in a message, at most."""


class Finding(Exception):
    """What should not be; the first argument says it."""


# ---- in a worker: one case


def load(form: str, given: str | Path, made: Case) -> Any:
    from cga_codegen.robots.from_mjcf import load_mjcf
    from cga_codegen.robots.from_urdf import load_urdf

    return load_mjcf(given) if form == "mjcf" else load_urdf(given, base=made.base, mimic=made.mimic)  # type: ignore[arg-type]


def check_refusal(error: Exception, source: str) -> str:
    """The name of a good refusal."""
    from cga_codegen.robots.model import ModelError

    said = str(error)
    if not isinstance(error, ModelError):
        raise Finding(f"{type(error).__name__} instead of a named error: {said[:300]}")
    if type(error) is ModelError and "base='floating' given" not in said:
        raise Finding(f"a bare ModelError: {said[:300]}")
    if source not in said or "\n" in said or not said.isprintable() or len(said) > LONGEST:
        raise Finding(f"not one short sentence that names the file ({len(said)} characters): {said[:300]!r}")
    if hole := next((words for words in HOLES if words in said), ""):
        raise Finding(f"the checks before have a hole ({hole}): {said[:300]}")
    return type(error).__name__


def check_model(model: Any, rng: random.Random) -> tuple[dict[str, float], list[float]]:
    """What any model must bear; the value of each joint (a name without entry floats: identity), and all frames there, row-major 4x4."""
    from cga_codegen.kernels.tree import Tree
    from cga_codegen.kernels.tree_kinematics import frames
    from cga_codegen.robots.model import RobotModel

    if RobotModel.from_json(json.loads(json.dumps(model.to_json(), allow_nan=False))) != model:
        raise Finding("the model is another one after to_json and from_json")
    tips = model.tips()
    for tip in rng.sample(tips, min(TIPS, len(tips))):
        model.chain(tip)
    moving = [joint for joint in model.joints if joint.kind != "floating"]
    values = {joint.name: rng.uniform(-3.0, 3.0) for joint in moving}
    at = {joint.name: joint.ratio * values[joint.follows] if joint.follows else values[joint.name] for joint in moving}
    cosines = [math.cos(x) for x in at.values()]
    sines = [x if joint.kind == "prismatic" else math.sin(x) for joint, x in zip(moving, at.values(), strict=True)]
    found = [float(x) for x in frames(Tree.of(model), cosines, sines, [1.0] + [0.0] * 7)]
    if not all(map(math.isfinite, found)) or len(found) != 16 * len(model.frames):
        raise Finding("forward kinematics is not finite")
    return values, found


def compare_with_pinocchio(given: str | Path, made: Case, model: Any, values: dict[str, float], found: list[float]) -> str:
    """Pinocchio's reading of the same bytes, as a word for the table; a Finding if it is another robot without a known reason."""
    import numpy as np
    import pinocchio

    if len(model.joints) > MANY:
        return "too many joints to compare"
    root = (pinocchio.JointModelFreeFlyer(),) if made.base == "floating" else ()
    build = pinocchio.buildModelFromUrdf if isinstance(given, Path) else pinocchio.buildModelFromXML
    try:
        peer = build(str(given), *root)
    except Exception:  # of whatever kind: only the peer's own reading stands above
        return "Pinocchio refuses"
    robot = elements(made)
    if not axes_fit(robot):
        return "an axis that Pinocchio cannot normalise"
    names = [str(name) for name in list(peer.names)[1:]]
    if names != [joint.name for joint in model.joints]:
        raise Finding(f"joints are {[j.name for j in model.joints][:9]}, Pinocchio has {names[:9]}")
    q = pinocchio.neutral(peer)
    if made.mimic == "follow":
        values = leaders(robot, values)
    for joint, at in zip(model.joints, list(peer.joints)[1:], strict=True):
        if joint.kind != "floating":
            value = values[joint.name]
            if abs(value) > 1e3:
                return "turns too far to compare"
            q[at.idx_q : at.idx_q + at.nq] = value if at.nq == 1 else (math.cos(value), math.sin(value))
    computed = peer.createData()
    pinocchio.framesForwardKinematics(peer, computed, q)
    mine = {frame.name: np.reshape(found[16 * k : 16 * k + 16], (4, 4)) for k, frame in enumerate(model.frames)}
    scale = 1.0 + max((abs(x) for m in mine.values() for x in m[:3, 3]), default=0.0)
    scale += sum(abs(x) for item in (*model.joints, *model.frames) for x in item.placement.translation)
    theirs = {}
    for k in reversed(range(len(peer.frames))):  # of frames that share a name the first keeps it
        theirs[str(peer.frames[k].name)] = computed.oMf[k].homogeneous
    if lost := [name for name in theirs if name not in mine]:
        raise Finding(f"frame {lost[0][:80]!r} of Pinocchio is missing")
    for name, pose in theirs.items():
        error = abs(mine[name] - pose)
        if error[:, :3].max() > 1e-11 or error[:, 3].max() > 1e-11 * scale:
            raise Finding(f"frame {name[:80]!r} lies {error.max():.1e} from Pinocchio's")
    for joint, body in zip(model.joints, list(peer.inertias)[1:], strict=True):
        own = spatial(joint.inertia)
        if not abs(own - body.matrix()).max() <= 1e-10 * abs(body.matrix()).max():
            if padded(robot):
                return "a number with blanks around it, which Pinocchio drops"
            raise Finding(f"joint {joint.name[:80]!r} carries {own.tolist()}, with Pinocchio {body}")
    return "agrees with Pinocchio"


def spatial(inertia: Any) -> Any:
    """The 6x6 inertia (linear first) about the joint's origin of an Inertia or None."""
    import numpy as np

    if inertia is None:
        return np.zeros((6, 6))
    x, y, z = inertia.com
    lever = inertia.mass * np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    about = inertia.matrix() + lever @ np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return np.block([[inertia.mass * np.eye(3), -lever], [lever, about]])


def elements(made: Case) -> ET.Element:
    """The file as XML, whichever way its letters are written, without the namespace of its root."""
    try:
        robot = ET.fromstring(made.data.strip())
    except (ET.ParseError, ValueError, LookupError):
        robot = ET.fromstring(made.text.lstrip("\ufeff \t\r\n"))
    space = robot.tag.rpartition("}")[0] + "}"
    for element in robot.iter():
        element.tag = element.tag.removeprefix(space)
    return robot


def axes_fit(robot: ET.Element) -> bool:
    """Whether Pinocchio can normalise all axes: the squares of longer or shorter ones overflow or vanish."""
    axes = [axis for joint in robot.findall("joint") if joint.get("type") in MOVING for axis in joint.findall("axis")]
    sizes = [max(abs(float(x)) for x in axis.get("xyz", "1").split()) for axis in axes]
    return all(1e-150 < size < 1e150 for size in sizes)


def padded(robot: ET.Element) -> bool:
    """Whether blanks stand around a mass or an inertia: urdfdom then takes zero, says so on the screen, and goes on."""
    inertials = (x for inertial in robot.findall("link/inertial") for x in (*inertial.findall("mass"), *inertial.findall("inertia")))
    return any(value != value.strip() for element in inertials for value in element.attrib.values())


def leaders(robot: ET.Element, values: dict[str, float]) -> dict[str, float]:
    """The values of joints when those that mimic do so, straight from the file: q = multiplier q_leader + offset."""
    mimics = {joint.get("name", ""): found for joint in robot.findall("joint") if (found := joint.find("mimic")) is not None}

    def value(name: str) -> float:
        if name not in mimics or name not in values:
            return values[name]
        mimic = mimics[name]
        return float(mimic.get("multiplier", "1")) * value(mimic.get("joint", "")) + float(mimic.get("offset", "0"))

    return {name: value(name) for name in values}


def compare_with_mujoco(given: str | Path, made: Case, model: Any, values: dict[str, float], found: list[float]) -> str:
    """MuJoCo's compilation of the same bytes: the bodies that it names alone are where the frames of their names are."""
    import mujoco
    import numpy as np

    if any(joint.follows for joint in model.joints):
        return "constraints are not compared"
    try:
        build = mujoco.MjModel.from_xml_path if isinstance(given, Path) else mujoco.MjModel.from_xml_string
        peer = build(str(given))
    except Exception:  # of whatever kind: only the peer's own reading stands above
        return "MuJoCo refuses"
    if abs(peer.qpos0).max(initial=0.0) > 1e3:
        return "turns too far to compare"
    computed = mujoco.MjData(peer)
    for j in range(peer.njnt):
        address = peer.jnt_qposadr[j]
        if peer.jnt_type[j] == mujoco.mjtJoint.mjJNT_FREE:
            computed.qpos[address : address + 7] = 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0
        elif (name := peer.joint(j).name or f"joint{j}") not in values:
            return "a joint that is welded is not compared"
        else:
            computed.qpos[address] = values[name]
    mujoco.mj_kinematics(peer, computed)
    mine = {frame.name: np.reshape(found[16 * k : 16 * k + 16], (4, 4)) for k, frame in enumerate(model.frames)}
    scale = 1.0 + sum(abs(x) for item in (*model.joints, *model.frames) for x in item.placement.translation)
    for b in range(1, peer.nbody):
        name = peer.body(b).name or f"body{b}"
        pose = mine.get(f"{name}:body", mine.get(name))
        if pose is None:
            raise Finding(f"body {name[:80]!r} of MuJoCo is missing")
        error = max(abs(pose[:3, 3] - computed.xpos[b]).max() / scale, abs(pose[:3, :3] - computed.xmat[b].reshape(3, 3)).max())
        if not error < 1e-11:
            raise Finding(f"body {name[:80]!r} lies {error:.1e} from MuJoCo's")
    return "agrees with MuJoCo"


COMPARE = {"urdf": compare_with_pinocchio, "mjcf": compare_with_mujoco}


def judge(form: str, seed: int, index: int, folder: Path, accepted: Callable[[], None]) -> tuple[str, str]:
    """Outcome for the table, and what was found ("" if all is well)."""
    made = case(form, seed, index)
    given: str | Path = made.text
    if made.as_file or not made.text.lstrip("\ufeff \t\r\n").startswith("<"):
        given = folder / f"case.{form}"
        given.write_bytes(made.data)
    source = given.name if isinstance(given, Path) else f"{form.upper()} text"
    from cga_codegen.robots.errors import InertiaWarning

    printed = os.fstat(1).st_size
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", InertiaWarning)
            try:
                model = load(form, given, made)
            except Exception as error:
                return check_refusal(error, source), ""
            if os.fstat(1).st_size > printed:
                raise Finding("the reader printed something")
            values, found = check_model(model, random.Random(index))
    except Finding as error:
        return "finding", str(error)
    except BaseException as error:
        return "finding", f"an accepted model: {type(error).__name__}: {str(error)[:300]}"
    accepted()  # what dies from here on is the peer's
    try:
        return f"accepted, {COMPARE[form](given, made, model, values, found)}", ""
    except Exception as error:
        said = str(error) if isinstance(error, Finding) else f"the comparison: {type(error).__name__}: {error}"
        return "finding", said[:1000]
