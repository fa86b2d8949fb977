"""The cooperative dual task space of two arms: their relative and their absolute motor (paper A, section 2.5, eqs. 10-12; Adorno 2010).

With M1 and M2 the motors of the two end frames,

    M_r = ~M2 M1                    (10)  the first end frame seen from the second,
    M_a = M2 exp(log(M_r) / 2)      (11)  half way from the second end frame to the first.

Half way has two meanings, and paper A's log and exp (eqs. 72-77) are the first of them (similarity.md, section 9, row (11)):

- "split": the midpoint of the two positions, and half of the rotation between them;
- "lie": half of the screw motion that leads from one frame to the other. Its position lies on the screw's helix, (c/2) tan(a/4) from the
  midpoint, where a is the angle between the frames and c their distance across the screw's axis.

Both are symmetric: with the arms exchanged M_a is the same pose. log takes the short way round. Where the relative rotation is a half
turn both ways are equally long: M_a has two values there, which a half turn about the relative axis carries into each other, and jumps
from one to the other as the arms pass. log chooses by its rule (see exp_log), and exchanged arms may get the other value. Values and
Jacobians are finite all the same; the Jacobian is that of the side on which log lies. Hands that face each other work near a half turn:
`Robot.chain(..., tool=pose)` turns the axes of one end frame, so that they do not.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.conventions import TWIST_ORDERS, jacobian_in_frame, reorder
from cga_runtime.coordinates import Array, parts, stack
from cga_runtime.elements import PointPair
from cga_runtime.errors import UnknownNameError
from cga_runtime.exp_log import CHARTS, exp, log
from cga_runtime.exp_log_jacobians import right_jacobian
from cga_runtime.kernels import products
from cga_runtime.motors import REVERSE, Motor
from cga_runtime.robot import Chain
from cga_runtime.smooth import NUMPY, Field, Scalar, casadi_field
from cga_runtime.spaces.joints import JointSpace

MOTORS = ("relative", *(f"absolute_{chart}" for chart in CHARTS))
JACOBIANS = ("relative_jacobian", *(f"absolute_jacobian_{chart}" for chart in CHARTS))


class DualTaskSpace:
    """Two chains as one mechanism; they may share joints, as the arms of a humanoid share its waist.

    q (..., n) holds the first chain's joints, then those of the second that are not shared: joint_names, with the limits lower and upper
    (n,). index: the places of the first and of the second chain's own joints in q. Both chains' root frames are taken as one world, in
    metres: robots that stand apart need a placement (`Robot.chain(..., placement=pose)`).

    Raises UnknownNameError (what is no Chain), ChainError (a floating base; chains of one robot that begin in different frames).
    """

    def __init__(self, first: Chain, second: Chain) -> None:
        self.joints = JointSpace.of((first, second))
        self.first, self.second = first, second
        self.n, self.joint_names, self.index = self.joints.n, self.joints.joint_names, self.joints.index
        self.lower, self.upper = self.joints.lower, self.joints.upper
        self._functions: dict[str, Any] = {}

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.first.frame} + {self.second.frame}: {self.n} joints>"

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.first, self.second)  # symbols do not travel

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits (joints without limits: within +-pi), shape (size..., n)."""
        return self.joints.random(rng, size)

    def relative(self, q: ArrayLike) -> Array:
        """M_r = ~M2 M1 (10), (..., 8): 1 e12 e13 e23 e1i e2i e3i e123i. Raises WrongSizeError, NotFiniteError, as all below do."""
        return stack(*_relative(*self._motors(q)))

    def absolute(self, q: ArrayLike, chart: str = "split") -> Array:
        """M_a = M2 exp(log(M_r) / 2) (11), (..., 8), in the world. chart: "split" or "lie", the meaning of half way (see above).

        Its sign is that of M2: log and half of it do not depend on the sign of M_r. Raises UnknownNameError (chart).
        """
        return stack(*_absolute(NUMPY, *self._motors(q), _chart(chart)))

    def relative_jacobian(self, q: ArrayLike) -> Array:
        """Analytic Jacobian dM_r/dq of `relative`, (..., 8, n)."""
        return _analytic(*self._relative_rates(q))

    def absolute_jacobian(self, q: ArrayLike, chart: str = "split") -> Array:
        """Analytic Jacobian dM_a/dq of `absolute`, (..., 8, n). Raises UnknownNameError (chart)."""
        return _analytic(*self._absolute_rates(q, _chart(chart)))

    def relative_twist_jacobian(self, q: ArrayLike, frame: str = "LOCAL", order: str = "linear_first") -> Array:
        """Geometric Jacobian of M_r, (..., 6, n): the twist (m/s, rad/s) of the first end frame as the second one sees it.

        frame: LOCAL is -2 ~M_r dM_r, in the first end frame; WORLD is -2 dM_r ~M_r, in the second; LOCAL_WORLD_ALIGNED has the axes of the
        second and the origin of the first, so that its linear rows are the rates of the relative position. order: linear_first,
        angular_first or bivector (e12 e13 e23 e1i e2i e3i). Raises UnknownNameError.
        """
        return _written(*self._relative_rates(q), frame, order)

    def absolute_twist_jacobian(self, q: ArrayLike, chart: str = "split", frame: str = "LOCAL", order: str = "linear_first") -> Array:
        """Geometric Jacobian of M_a, (..., 6, n): the twist (m/s, rad/s) of the frame half way. frame, order: as of `Chain.jacobian`.

        LOCAL is -2 ~M_a dM_a. With the half motor E = exp(B/2), B = log M_r, V2 and V_r the LOCAL twists of M2 and M_r, and J the right
        Jacobian of exp in the chart, it is ~E V2 E + J(B/2) J(B)^-1 V_r / 2; J(B) is regular since |w| <= pi. Raises UnknownNameError.
        """
        return _written(*self._absolute_rates(q, _chart(chart)), frame, order)

    def point_pair(self, q: ArrayLike) -> PointPair:
        """The cooperative point pair P1 ^ P2 (12), from the first end point to the second. Raises DegenerateError where they coincide."""
        q = self.joints.check(q)
        return PointPair.from_points(*(chain.point(q[..., place]) for chain, place in self._chains()))

    def casadi(self, name: str) -> Any:
        """A casadi.Function of q (n) with exact derivatives of first and second order, also where M_r is the identity.

        Motors (8): relative, absolute_split, absolute_lie. Their analytic Jacobians (8, n): relative_jacobian, absolute_jacobian_split,
        absolute_jacobian_lie. Raises UnknownNameError.
        """
        import casadi

        if name not in (*MOTORS, *JACOBIANS):
            raise UnknownNameError("function", name, (*MOTORS, *JACOBIANS))
        if name not in self._functions:
            q = casadi.SX.sym("q", self.n)
            first, second = (casadi.vertsplit(chain.kernel("motor").symbolic(q[place.tolist()])) for chain, place in self._chains())
            chart = name.rpartition("_")[2]
            motor = casadi.vertcat(*(_absolute(casadi_field(), first, second, chart) if chart in CHARTS else _relative(first, second)))
            result = casadi.jacobian(motor, q) if name in JACOBIANS else motor
            self._functions[name] = casadi.Function(name, [q], [result], ["q"], [name])
        return self._functions[name]

    def _chains(self) -> Any:
        return zip((self.first, self.second), self.index, strict=True)

    def _motors(self, q: ArrayLike) -> tuple[tuple[Array, ...], tuple[Array, ...]]:
        """Components of M1 and of M2, each (...)."""
        q = self.joints.check(q)
        first, second = (parts(chain.motor(q[..., place])) for chain, place in self._chains())
        return first, second

    def _body_twist(self, q: ArrayLike, k: int) -> Array:
        chain, place = (self.first, self.second)[k], self.index[k]
        return self.joints.spread(chain.jacobian(self.joints.check(q)[..., place], "LOCAL", "bivector"), k)

    def _relative_rates(self, q: ArrayLike) -> tuple[Array, Array]:
        """M_r, and -2 ~M_r dM_r = V1 - ~M_r V2 M_r with the LOCAL twists V1 and V2 of the arms."""
        relative = self.relative(q)
        return relative, self._body_twist(q, 0) - _seen_from(relative, self._body_twist(q, 1))

    def _absolute_rates(self, q: ArrayLike, chart: str) -> tuple[Array, Array]:
        """M_a and -2 ~M_a dM_a."""
        relative, twist = self._relative_rates(q)
        bivector = stack(*log(NUMPY, "motor", parts(relative), chart))
        change = np.linalg.solve(right_jacobian("motor", bivector, chart), twist)
        half = exp(NUMPY, "motor", parts(0.5 * bivector), chart)
        body = _seen_from(stack(*half), self._body_twist(q, 1)) + 0.5 * right_jacobian("motor", 0.5 * bivector, chart) @ change
        return stack(*_product(self._motors(q)[1], half)), body


def _relative(first: Sequence[Scalar], second: Sequence[Scalar]) -> Sequence[Scalar]:
    return _product([sign * x for sign, x in zip(REVERSE, second, strict=True)], first)


def _absolute(f: Field, first: Sequence[Scalar], second: Sequence[Scalar], chart: str) -> Sequence[Scalar]:
    half = [0.5 * b for b in log(f, "motor", _relative(first, second), chart)]
    return _product(second, exp(f, "motor", half, chart))


def _product(a: Sequence[Scalar], b: Sequence[Scalar]) -> Sequence[Scalar]:
    product: Sequence[Scalar] = products().motor_motor(a, b)
    return product


def _analytic(motor: Array, body: Array) -> Array:
    """dM = -1/2 M V for the columns V of a body Jacobian, (..., 8, n)."""
    return np.asarray(-0.5 * np.stack(_product([x[..., None] for x in parts(motor)], _as_motors(body)), axis=-2))


def _seen_from(motor: Array, body: Array) -> Array:
    """~M V M for the columns V of a Jacobian in bivector order."""
    m = [x[..., None] for x in parts(motor)]
    turned = _product(_product([sign * x for sign, x in zip(REVERSE, m, strict=True)], _as_motors(body)), m)
    return np.stack(turned[1:7], axis=-2)


def _as_motors(body: Array) -> list[Array]:
    """The components of bivectors, those along axis -2, among the components of motors."""
    zero = np.zeros_like(body[..., 0, :])
    return [zero, *np.moveaxis(body, -2, 0), zero]


def _written(motor: Array, body: Array, frame: str, order: str) -> Array:
    turned = body if frame == "LOCAL" else jacobian_in_frame(body, Motor(motor), "LOCAL", frame, order="bivector")
    return reorder(turned, TWIST_ORDERS, "bivector", order, -2)


def _chart(name: str) -> str:
    if name not in CHARTS:
        raise UnknownNameError("chart", name, CHARTS)
    return name
