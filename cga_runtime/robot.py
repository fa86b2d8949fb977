"""Robots and chains: load a robot by name or file, cut chains from it, and evaluate their kernels.

Shapes: q is (..., n), results keep the leading dimensions. Units are SI and radians. Frames LOCAL, WORLD and LOCAL_WORLD_ALIGNED mean
what they mean in Pinocchio; rows are named by `order`.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cga_runtime import workshop
from cga_runtime.coordinates import count
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.kernels import Kernel, Library, Unit, finite, generated_folder, library
from cga_runtime.workshop import ChainOrder

Array = NDArray[np.float64]

_FRAMED = ("jacobian", "jacobian_derivative", "hessian")
FRAMES = ("LOCAL", "WORLD", "LOCAL_WORLD_ALIGNED")
# rows of a 6-row result, given in linear-first order (v, w): which row comes where, and its sign
ORDERS: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    "linear_first": ((0, 1, 2, 3, 4, 5), (1, 1, 1, 1, 1, 1)),
    "angular_first": ((3, 4, 5, 0, 1, 2), (1, 1, 1, 1, 1, 1)),
    "bivector": ((5, 4, 3, 0, 1, 2), (1, -1, 1, 1, 1, 1)),  # e12 e13 e23 e1i e2i e3i; e13 carries the minus sign
}


def bundled_robots(folder: str | Path | None = None) -> list[str]:
    """Names of the robots whose kernels come with the package (or lie in a generated folder)."""
    return sorted(library(Path(folder) if folder is not None else generated_folder()).manifest["robots"])


def load_robot(source: str | Path, folder: str | Path | None = None) -> Robot:
    """A robot by bundled name, by path to a URDF, or by name from a generated `folder` (made by `cga generate FILE -o DIR`).

    Raises UnknownNameError (listing the names), RobotFileError for a file that cannot be used, StaleKernelError for damaged kernels.
    """
    home = library(Path(folder) if folder is not None else generated_folder())
    known = home.manifest["robots"]
    if str(source) in known:
        record = known[str(source)]
        return Robot(home.read(record["description"]), home, record)
    if isinstance(source, str | os.PathLike) and _names_a_file(Path(source)):
        return Robot(workshop.read_robot(Path(source)), None, None)
    raise UnknownNameError("robot", str(source), known, "Or name a URDF file")


def _names_a_file(path: Path) -> bool:
    try:
        return path.suffix.lower() in (".urdf", ".xml") or path.exists()
    except (OSError, ValueError):  # too long for a file name, or a zero character in it
        return False


class Robot:
    """A robot's description, and the chains cut from it."""

    def __init__(self, description: str, home: Library | None, record: dict[str, Any] | None) -> None:
        self._description, self._home, self._record = description, home, record
        data = json.loads(description)
        self.name: str = data["name"]
        self.source: str = data["source"]
        self.joint_names: tuple[str, ...] = tuple(j["name"] for j in data["joints"])
        self.frame_names: tuple[str, ...] = tuple(f["name"] for f in data["frames"])
        limits = {key: [j[key] for j in data["joints"]] for key in ("lower", "upper", "velocity", "effort")}
        self.lower, self.upper = _bounds(limits["lower"], -math.inf), _bounds(limits["upper"], math.inf)
        self.velocity_limit, self.effort_limit = _bounds(limits["velocity"], math.inf), _bounds(limits["effort"], math.inf)

    @property
    def nq(self) -> int:
        """Number of joint positions."""
        return len(self.joint_names)

    def __repr__(self) -> str:
        return f"<Robot {self.name}: {self.nq} joints, {len(self.frame_names)} frames>"

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits (joints without limits: within +-pi), shape (size..., nq)."""
        return _uniform(self.lower, self.upper, rng, size)

    def chain(
        self, frame: str, root: str | None = None, placement: ArrayLike | None = None, offset: Sequence[float] = (0.0, 0.0, 0.0)
    ) -> Chain:
        """The chain from the base (or the frame `root`) to `frame`.

        placement: 4x4 pose of the robot's base (with `root`: of the root frame) in the world; chains with another placement belong to
        another robot of the same kind. offset: a point fixed in the frame (m), which becomes the end frame's origin. Kernels of chains that
        are not checked in are generated at first use and kept in the cache. Raises UnknownNameError, WrongSizeError, ChainError,
        DegenerateError (a placement that is no rigid motion).
        """
        for name in (frame, root):
            if name is not None and name not in self.frame_names:
                raise UnknownNameError("frame", name, self.frame_names)
        where = None if placement is None else finite(placement, "placement")
        if where is not None and where.shape != (4, 4):
            raise WrongSizeError(f"placement: shape {where.shape} given, (4, 4) needed")
        shift = finite(offset, "offset")
        if shift.shape != (3,):
            raise WrongSizeError(f"offset: shape {shift.shape} given, (3,) needed")
        rows = None if where is None else tuple(tuple(float(x) for x in row) for row in where)
        order = ChainOrder(self._description, frame, root, rows, (float(shift[0]), float(shift[1]), float(shift[2])))
        plain = root is None and where is None and not shift.any()
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
    """The joints from a root to an end frame, and their kernels. Made by `Robot.chain`."""

    def __init__(self, robot: Robot, order: ChainOrder, unit: Unit, plain: bool) -> None:
        self.robot, self.order, self.unit, self.plain = robot, order, unit, plain
        self.frame = order.frame
        self.joint_names = unit.joint_names
        index = [robot.joint_names.index(name) for name in self.joint_names]
        self.index = np.array(index, dtype=np.intp)
        self.lower, self.upper = robot.lower[self.index], robot.upper[self.index]
        self.velocity_limit = robot.velocity_limit[self.index]
        self._framed: dict[tuple[str, str], Kernel] = {}

    @property
    def n(self) -> int:
        """Number of joints."""
        return len(self.joint_names)

    def __repr__(self) -> str:
        return f"<Chain {self.robot.name}/{self.frame}: {self.n} joints>"

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits, shape (size..., n)."""
        return _uniform(self.lower, self.upper, rng, size)

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
    if order not in ORDERS:
        raise UnknownNameError("order", order, ORDERS)
    if order == "linear_first":
        return rows
    places, signs = ORDERS[order]
    shape = [1] * rows.ndim
    shape[axis] = 6
    taken: Array = np.take(rows, places, axis=axis) * np.reshape(signs, shape)
    return taken


def _bounds(values: Sequence[float | None], missing: float) -> Array:
    """JSON has no infinity: an absent bound is null."""
    return np.array([missing if value is None else float(value) for value in values])


def _uniform(lower: Array, upper: Array, rng: np.random.Generator, size: int | tuple[int, ...] | None) -> Array:
    shape = () if size is None else tuple(size) if isinstance(size, Sequence) else (count(size, "size"),)
    low, high = np.where(np.isfinite(lower), lower, -math.pi), np.where(np.isfinite(upper), upper, math.pi)
    return np.asarray(rng.uniform(low, high, (*shape, len(lower))))


