"""Robots and chains: load a robot by name or file, cut chains from it, and evaluate their kernels.

Shapes: q is (..., nq), v (..., nv); results keep the leading dimensions. Units are SI and radians. Frames LOCAL, WORLD and
LOCAL_WORLD_ALIGNED mean what they mean in Pinocchio; rows are named by `order`.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime import workshop
from cga_runtime.conventions import FRAMES as FRAMES
from cga_runtime.conventions import TWIST_ORDERS, reorder
from cga_runtime.coordinates import count
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.kernels import Kernel, Library, Unit, finite
from cga_runtime.layout import BASE, Layout
from cga_runtime.motors import Motor
from cga_runtime.whole_body import WholeBody
from cga_runtime.workshop import ChainOrder

Array = NDArray[np.float64]

_FRAMED = ("jacobian", "jacobian_derivative", "hessian")


class Robot(WholeBody):
    """A robot's description, the kernels of the whole, and the chains cut from it. Made by `load_robot`.

    tips: the last frame on each joint that carries no other: the natural ends of chains.
    """

    def __init__(self, description: str, home: Library | None = None, record: dict[str, Any] | None = None) -> None:
        self._description, self._home, self._record = description, home, record
        data = json.loads(description)
        self.name: str = data["name"]
        self.source: str = data["source"]
        self.gravity_vector: Array = np.array(data["gravity"], dtype=np.float64)
        joints = [joint for joint in data["joints"] if not joint["follows"]]
        self.layout = Layout(tuple(j["name"] for j in joints), tuple(j["kind"] for j in joints), ())
        self.joint_names, self.joint_kinds = self.layout.names, self.layout.kinds
        self.frame_names: tuple[str, ...] = tuple(f["name"] for f in data["frames"])
        carrying = {joint["parent"] for joint in data["joints"]}
        last = {frame["joint"]: frame["name"] for frame in data["frames"]}
        self._standing = {frame["name"] for frame in data["frames"] if frame["joint"] < 0}  # fixed to the base
        self.tips: tuple[str, ...] = tuple(last.get(k, j["name"]) for k, j in enumerate(data["joints"]) if k not in carrying)
        self.lower, self.upper = (_bounds(joints, key, BASE, sign) for key, sign in (("lower", -math.inf), ("upper", math.inf)))
        self.velocity_limit, self.effort_limit = (_bounds(joints, key, 6, math.inf) for key in ("velocity", "effort"))

    @property
    def nq(self) -> int:
        """Numbers in q: one a joint, and 8 of a floating base."""
        return self.layout.nq

    @property
    def nv(self) -> int:
        """Numbers in v: degrees of freedom."""
        return self.layout.nv

    def __repr__(self) -> str:
        return f"<Robot {self.name}: {len(self.joint_names)} joints, {len(self.frame_names)} frames>"

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits (joints without limits: within +-pi), shape (size..., nq).

        A floating base: any rotation, uniformly, and a position within +-1 m.
        """
        return _uniform(self.layout, self.lower, self.upper, rng, size)

    def neutral(self) -> Array:
        """All joints at zero, a floating base at the origin: (nq,)."""
        q = np.zeros(self.nq)
        q[: int(self.layout.floating)] = 1.0
        return q

    def jacobian(self, q: ArrayLike, frame: str, reference: str = "LOCAL_WORLD_ALIGNED", order: str = "linear_first") -> Array:
        """Geometric Jacobian of a frame over all velocities, (..., 6, nv); columns of joints that do not move it are zero."""
        positions = finite(q, "q")
        if positions.shape[-1:] != (self.nq,):
            raise WrongSizeError(f"q: shape {positions.shape} given, (..., {self.nq}) needed")
        if frame in self._standing:
            return np.zeros((*positions.shape[:-1], 6, self.nv))
        chain = self.chain(frame)
        part = chain.jacobian(positions[..., chain.index], reference, order)
        whole = np.zeros((*part.shape[:-1], self.nv))
        whole[..., chain.columns] = part
        return whole

    def chain(
        self,
        frame: str,
        root: str | None = None,
        placement: ArrayLike | Motor | None = None,
        offset: Sequence[float] = (0.0, 0.0, 0.0),
        tool: ArrayLike | Motor | None = None,
    ) -> Chain:
        """The chain from the base (or the frame `root`) to `frame`.

        placement: pose of the robot's base (with `root`: of the root frame) in the world, a 4x4 matrix or a Motor; chains with another
        placement belong to another robot of the same kind. tool: pose of the end frame in `frame`, likewise. offset: a point fixed in the
        end frame (m), which becomes its origin. Kernels of chains that are not checked in are generated at first use and kept in the cache.
        Raises UnknownNameError, WrongSizeError, ChainError, DegenerateError (a placement or tool that is no rigid motion).
        """
        for name in (frame, root):
            if name is not None and name not in self.frame_names:
                raise UnknownNameError("frame", name, self.frame_names)
        shift = finite(offset, "offset")
        if shift.shape != (3,):
            raise WrongSizeError(f"offset: shape {shift.shape} given, (3,) needed")
        where, held = _pose(placement, "placement"), _pose(tool, "tool")
        order = ChainOrder(self._description, frame, root, where, (float(shift[0]), float(shift[1]), float(shift[2])), held)
        plain = root is None and where is None and held is None and not shift.any()
        if plain and self._home is not None and self._record is not None and frame in self._record["chains"]:
            unit = self._home.unit(self._record["chains"][frame])
        else:
            unit = workshop.chain_unit(order)
        return Chain(self, order, unit, plain)

    def loop_unit(self, right: Chain, left: Chain) -> Unit:
        """Kernels of two chains as a closed loop; checked-in ones where both chains are plain ends of this robot."""
        name = f"{right.frame}_with_{left.frame}"
        plain = right.plain and left.plain and right.order.description == left.order.description == self._description
        if plain and self._home is not None and self._record is not None and name in self._record["loops"]:
            return self._home.unit(self._record["loops"][name])
        return workshop.loop_unit(right.order, left.order)


def shared_joints(first: Chain, second: Chain) -> set[str]:
    """Joints that two chains have in common: those of the same name, if the chains belong to one robot.

    That is so if description and placement are the same, however often the robot was loaded: two robots do not stand in one place.
    """
    one_robot = (first.order.description, first.order.placement) == (second.order.description, second.order.placement)
    return set(first.joint_names) & set(second.joint_names) if one_robot else set()


class Chain:
    """The joints from a root to an end frame, and their kernels. Made by `Robot.chain`.

    index, columns: where the chain's q and v stand in the robot's.
    """

    def __init__(self, robot: Robot, order: ChainOrder, unit: Unit, plain: bool) -> None:
        self.robot, self.order, self.unit, self.plain = robot, order, unit, plain
        self.frame = order.frame
        self.layout, self.joint_names, self.joint_kinds = unit.layout, unit.joint_names, unit.joint_kinds
        self.index, self.columns = robot.layout.places(self.joint_names)
        self.lower, self.upper = robot.lower[self.index], robot.upper[self.index]
        self.velocity_limit, self.effort_limit = robot.velocity_limit[self.columns], robot.effort_limit[self.columns]
        self._framed: dict[tuple[str, str], Kernel] = {}

    @property
    def n(self) -> int:
        """Numbers in v: of a fixed base, the number of joints with a coordinate of their own."""
        return self.layout.nv

    @property
    def nq(self) -> int:
        """Numbers in q: n, and two more with a floating base."""
        return self.layout.nq

    def __repr__(self) -> str:
        return f"<Chain {self.robot.name}/{self.frame}: {len(self.joint_names)} joints>"

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits, shape (size..., n)."""
        return _uniform(self.layout, self.lower, self.upper, rng, size)

    def kernel(self, name: str) -> Kernel:
        """A kernel by name; UnknownNameError lists them. `jacobian`, `jacobian_derivative` and `hessian` alone: LOCAL_WORLD_ALIGNED."""
        return self.unit.kernel(f"{name}_local_world_aligned" if name in _FRAMED else name)

    def casadi(self, name: str) -> Any:
        """The kernel as a casadi.Function with exact derivatives; every kernel name works. 3-D results come as (6, n*n)."""
        return self.kernel(name).casadi

    def motor(self, q: ArrayLike) -> Array:
        """Motor of the end frame, (..., 8): 1 e12 e13 e23 e1i e2i e3i e123i, x_root = M x ~M, M = T(p) R."""
        return self._motor(q)

    def pose(self, q: ArrayLike) -> Array:
        """Homogeneous matrix of the end frame in the root frame, (..., 4, 4)."""
        return self._pose(q)

    def point(self, q: ArrayLike) -> Array:
        """Origin of the end frame in the root frame (m), (..., 3)."""
        return self._point(q)

    def screws(self, q: ArrayLike) -> Array:
        """World screws of the joints as bivectors e12 e13 e23 e1i e2i e3i, (..., 6, n), one joint a column."""
        return self.kernel("screws")(q)

    def motor_jacobian(self, q: ArrayLike) -> Array:
        """Analytic Jacobian dM/dq_j = -1/2 S_j M, (..., 8, n)."""
        return self.kernel("motor_jacobian")(q)

    def jacobian(self, q: ArrayLike, frame: str = "LOCAL_WORLD_ALIGNED", order: str = "linear_first") -> Array:
        """Geometric Jacobian, (..., 6, n). frame: LOCAL, WORLD or LOCAL_WORLD_ALIGNED; order: linear_first, angular_first or bivector."""
        return _ordered(self._in_frame("jacobian", frame)(q), order, -2)

    def jacobian_derivative(self, q: ArrayLike, v: ArrayLike, frame: str = "LOCAL_WORLD_ALIGNED", order: str = "linear_first") -> Array:
        """Time derivative of `jacobian` along q' = v, (..., 6, n)."""
        return _ordered(self._in_frame("jacobian_derivative", frame)(q, v), order, -2)

    def hessian(self, q: ArrayLike, frame: str = "LOCAL_WORLD_ALIGNED", order: str = "linear_first") -> Array:
        """Analytic kinematic Hessian, (..., 6, n, n): [..., i, j, k] = d jacobian[..., i, j] / d q_k."""
        return _ordered(self._in_frame("hessian", frame)(q), order, -3)

    # the kernels called most often, looked up once

    @cached_property
    def _motor(self) -> Kernel:
        return self.kernel("motor")

    @cached_property
    def _pose(self) -> Kernel:
        return self.kernel("pose")

    @cached_property
    def _point(self) -> Kernel:
        return self.kernel("point")

    def _in_frame(self, kernel: str, frame: str) -> Kernel:
        if frame not in FRAMES:
            raise UnknownNameError("frame of reference", frame, FRAMES)
        found = self._framed.get((kernel, frame))
        if found is None:
            found = self._framed[kernel, frame] = self.kernel(f"{kernel}_{frame.lower()}")
        return found


def _ordered(rows: Array, order: str, axis: int) -> Array:
    return rows if order == "linear_first" else reorder(rows, TWIST_ORDERS, "linear_first", order, axis)


def _pose(pose: ArrayLike | Motor | None, what: str) -> tuple[tuple[float, ...], ...] | None:
    if pose is None:
        return None
    matrix = pose.pose() if isinstance(pose, Motor) else finite(pose, what)
    if matrix.shape != (4, 4):
        raise WrongSizeError(f"{what}: shape {matrix.shape} given, (4, 4) needed")
    return tuple(tuple(float(x) for x in row) for row in matrix)


def _bounds(joints: Sequence[dict[str, Any]], key: str, of_base: int, missing: float) -> Array:
    """JSON has no infinity: an absent bound is null. A floating base has none."""
    values: list[float] = []
    for joint in joints:
        values += [missing] * of_base if joint["kind"] == "floating" else [missing if joint[key] is None else float(joint[key])]
    return np.array(values)


def _uniform(layout: Layout, lower: Array, upper: Array, rng: np.random.Generator, size: int | tuple[int, ...] | None) -> Array:
    shape = () if size is None else tuple(size) if isinstance(size, Sequence) else (count(size, "size"),)
    low, high = np.where(np.isfinite(lower), lower, -math.pi), np.where(np.isfinite(upper), upper, math.pi)
    q = np.asarray(rng.uniform(low, high, (*shape, len(lower))))
    if layout.floating:
        q[..., :BASE] = _random_motors(rng, shape)
    return q


def _random_motors(rng: np.random.Generator, shape: tuple[int, ...]) -> Array:
    from cga_runtime.quaternions import motor_from_position_quaternion

    quaternion = rng.standard_normal((*shape, 4))
    quaternion /= np.linalg.norm(quaternion, axis=-1, keepdims=True)
    return motor_from_position_quaternion(rng.uniform(-1.0, 1.0, (*shape, 3)), quaternion, order="wxyz").coefficients
