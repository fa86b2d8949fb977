"""Positions and velocities of whole robots, to and from those of Pinocchio and MuJoCo: joint by joint, in the other model's joint order.

Each joint takes its numbers from q and v, joints in the order of `robot.joint_names` (lengths in m and m/s, angles in rad and rad/s):

    joint       our q    our v                            Pinocchio q    Pinocchio v  MuJoCo qpos    MuJoCo qvel
    floating    motor 8  v w, in the body's frame         xyz and xyzw   as ours      xyz and wxyz   v in the world's axes, w in the body's
    continuous  angle    rate                             cos and sin    as ours      angle          as ours
    revolute    angle    rate                             as ours        as ours      as ours        as ours
    prismatic   length   rate                             as ours        as ours      as ours        as ours

v of a floating joint is the velocity of its body's origin. Generalised forces convert as velocities do, with the q they belong to: the maps
permute and rotate, so they are their own inverse transposes. Accelerations do not, where a joint floats: MuJoCo's linear one in the world's
axes is R (a + w x v). A mimic joint has no coordinate in q, nor in a Pinocchio model built with mimic=True: leave it out of `names`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, overload

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, one_batch, read, stack, unit
from cga_runtime.errors import DegenerateError, UnknownNameError, WrongSizeError
from cga_runtime.motors import RIGID, Motor
from cga_runtime.quaternions import motor_from_position_quaternion, position_quaternion_from_motor


class HasJoints(Protocol):
    """What is asked of a robot: the names of its joints, and for each "floating", "revolute", "continuous" or "prismatic"."""

    @property
    def joint_names(self) -> tuple[str, ...]: ...
    @property
    def joint_kinds(self) -> tuple[str, ...]: ...


@dataclass(frozen=True)
class Coordinates:
    """How a joint's position stands in a library's vector: how many numbers, and the maps from our block to theirs and back."""

    size: int
    give: Callable[[Array], Array]
    take: Callable[[Array, bool], Array]  # the flag: normalise first


def _same(block: Array, normalize: bool = False) -> Array:
    return block


def _floating(order: str) -> Coordinates:
    """Position, then quaternion in the order named."""

    def give(motor: Array) -> Array:
        return np.concatenate(position_quaternion_from_motor(motor, order), axis=-1)

    def take(block: Array, normalize: bool) -> Array:
        return motor_from_position_quaternion(block[..., :3], block[..., 3:], order, normalize=normalize).coefficients

    return Coordinates(7, give, take)


def _circle(angle: Array) -> Array:
    return stack(np.cos(angle[..., 0]), np.sin(angle[..., 0]))


def _angle(circle: Array, normalize: bool) -> Array:
    """In (-pi, pi]."""
    if normalize:
        circle = unit(circle, "continuous joint")
    error = np.abs(dot(circle, circle) - 1.0).max(initial=0.0)
    if error > RIGID:
        raise DegenerateError(
            f"continuous joint: the squared norm of (cos, sin) is off 1 by {error:.1e} (at most {RIGID:.0e}); "
            "normalize=True divides by the norm"
        )
    return stack(np.arctan2(circle[..., 1], circle[..., 0]))


_ONE = Coordinates(1, _same, _same)
OURS = {"floating": Coordinates(8, _same, _same), "revolute": _ONE, "continuous": _ONE, "prismatic": _ONE}
PINOCCHIO = OURS | {"floating": _floating("xyzw"), "continuous": Coordinates(2, _circle, _angle)}
MUJOCO = OURS | {"floating": _floating("wxyz")}
RATES = {kind: 6 if kind == "floating" else 1 for kind in OURS}
"""Numbers in v, everywhere."""


@overload
def to_pinocchio(robot: HasJoints, q: ArrayLike, v: None = None, names: Sequence[str] | None = None) -> Array: ...
@overload
def to_pinocchio(robot: HasJoints, q: ArrayLike, v: ArrayLike, names: Sequence[str] | None = None) -> tuple[Array, Array]: ...
def to_pinocchio(
    robot: HasJoints, q: ArrayLike, v: ArrayLike | None = None, names: Sequence[str] | None = None
) -> Array | tuple[Array, Array]:
    """Pinocchio's q (..., nq) of our q; with v (..., nv) the pair of both.

    names: the joints of the other model in its order, such as list(model.names)[1:]; by default ours. A floating joint may be left out, it
    is then first. Raises UnknownNameError (a name that only one side has), WrongSizeError, NotFiniteError, DegenerateError.
    """
    return _converted(robot, q, v, names, OURS, PINOCCHIO)


@overload
def from_pinocchio(
    robot: HasJoints, q: ArrayLike, v: None = None, names: Sequence[str] | None = None, *, normalize: bool = False
) -> Array: ...
@overload
def from_pinocchio(
    robot: HasJoints, q: ArrayLike, v: ArrayLike, names: Sequence[str] | None = None, *, normalize: bool = False
) -> tuple[Array, Array]: ...
def from_pinocchio(
    robot: HasJoints, q: ArrayLike, v: ArrayLike | None = None, names: Sequence[str] | None = None, *, normalize: bool = False
) -> Array | tuple[Array, Array]:
    """Our q of Pinocchio's; with v the pair of both. Continuous joints come back in (-pi, pi]. names, errors: see `to_pinocchio`.

    A quaternion or (cos, sin) that is not unit is refused; normalize=True divides it by its norm.
    """
    return _converted(robot, q, v, names, PINOCCHIO, OURS, normalize)


@overload
def to_mujoco(robot: HasJoints, q: ArrayLike, v: None = None, names: Sequence[str] | None = None) -> Array: ...
@overload
def to_mujoco(robot: HasJoints, q: ArrayLike, v: ArrayLike, names: Sequence[str] | None = None) -> tuple[Array, Array]: ...
def to_mujoco(
    robot: HasJoints, q: ArrayLike, v: ArrayLike | None = None, names: Sequence[str] | None = None
) -> Array | tuple[Array, Array]:
    """MuJoCo's qpos of our q; with v the pair of qpos and qvel. names, errors: see `to_pinocchio`."""
    return _converted(robot, q, v, names, OURS, MUJOCO)


@overload
def from_mujoco(
    robot: HasJoints, q: ArrayLike, v: None = None, names: Sequence[str] | None = None, *, normalize: bool = False
) -> Array: ...
@overload
def from_mujoco(
    robot: HasJoints, q: ArrayLike, v: ArrayLike, names: Sequence[str] | None = None, *, normalize: bool = False
) -> tuple[Array, Array]: ...
def from_mujoco(
    robot: HasJoints, q: ArrayLike, v: ArrayLike | None = None, names: Sequence[str] | None = None, *, normalize: bool = False
) -> Array | tuple[Array, Array]:
    """Our q of MuJoCo's qpos; with qvel as v the pair of both. names, errors: see `to_pinocchio`; normalize: see `from_pinocchio`."""
    return _converted(robot, q, v, names, MUJOCO, OURS, normalize)


Table = Mapping[str, Coordinates]


def _converted(
    robot: HasJoints,
    q: ArrayLike,
    v: ArrayLike | None,
    names: Sequence[str] | None,
    source: Table,
    target: Table,
    normalize: bool = False,
) -> Array | tuple[Array, Array]:
    kinds = _kinds(robot)
    theirs = _other_names(kinds, names)
    given, wanted = (list(kinds) if table is OURS else theirs for table in (source, target))
    blocks = _blocks(q, "q", {name: source[kinds[name]].size for name in given})
    ours = {name: source[kinds[name]].take(block, normalize) for name, block in blocks.items()}
    position = _joined([target[kinds[name]].give(ours[name]) for name in wanted])
    if v is None:
        return position
    rates = _blocks(v, "v", {name: RATES[kinds[name]] for name in given})
    for name, kind in kinds.items():
        if kind == "floating" and (source is MUJOCO or target is MUJOCO):
            rates[name] = _turned(rates[name], ours[name], back=source is MUJOCO)
    return position, _joined([rates[name] for name in wanted])


def _turned(rates: Array, motor: Array, back: bool) -> Array:
    """The linear part from the body's axes to the world's, or back."""
    turn = Motor(motor).pose()[..., :3, :3]
    one_batch("q and v", turn.shape[:-2], rates.shape[:-1])
    linear = ((np.swapaxes(turn, -1, -2) if back else turn) @ rates[..., :3, None])[..., 0]
    angular = np.broadcast_to(rates[..., 3:], linear.shape)
    return np.concatenate([linear, angular], axis=-1)


def _kinds(robot: HasJoints) -> dict[str, str]:
    names, kinds = robot.joint_names, robot.joint_kinds
    if not len(set(names)) == len(names) == len(kinds):
        raise WrongSizeError(
            f"robot: {len(set(names))} distinct of {len(names)} joint names and {len(kinds)} joint kinds given, as many of each needed"
        )
    for kind in kinds:
        if kind not in OURS:
            raise UnknownNameError("joint kind", kind, OURS)
    return dict(zip(names, kinds, strict=True))


def _other_names(kinds: Mapping[str, str], names: Sequence[str] | None) -> list[str]:
    """The joints in the other model's order: each of ours once."""
    if names is None:
        return list(kinds)
    given = list(names)
    for name in given:
        if name not in kinds:
            raise UnknownNameError("joint", name, kinds, "names lists the joints of the other model that have a coordinate in both")
        if given.count(name) > 1:
            raise WrongSizeError(f"names: joint {name!r} given {given.count(name)} times, each of {', '.join(kinds)} needed once")
    for name, kind in kinds.items():
        if name not in given and kind != "floating":
            raise UnknownNameError("joint of the other model", name, given, "Every joint of the robot needs its place in names")
    return [name for name in kinds if name not in given] + given


def _blocks(vector: ArrayLike, what: str, sizes: Mapping[str, int]) -> dict[str, Array]:
    """The parts (..., size) of a vector, by joint."""
    array = read(vector, what, sum(sizes.values()))
    ends = np.cumsum(list(sizes.values()), dtype=int)
    return {name: array[..., end - size : end] for (name, size), end in zip(sizes.items(), ends, strict=True)}


def _joined(blocks: Sequence[Array]) -> Array:
    """Parts side by side; their batch shapes may differ where one of them was turned by a batch of poses."""
    batches = {block.shape[:-1] for block in blocks}
    if len(batches) > 1:
        batch = np.broadcast_shapes(*batches)
        blocks = [np.broadcast_to(block, (*batch, block.shape[-1])) for block in blocks]
    return np.concatenate(blocks, axis=-1) if blocks else np.zeros(0)
