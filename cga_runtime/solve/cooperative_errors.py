"""Errors between the primitive that several chains span and a wanted one, with exact Jacobians and without an exception: three forms that
vanish together (paper A, eqs. 39-47; similarity.md, sections 6 to 8).

similarity: centre c and radius r (m), of line and plane the distance of the points' mean from the wanted one, and the logarithm of the
direction on the unit sphere at the wanted direction, t (n - cos t n_d) / sin t with the angle t (rad). It has no gauge. Its derivatives
come from the horizontal Jacobian: c' = r R v, r' = -r e0i, n' = R (om x a).

incidence: the distances of the system's own points from the wanted primitive (m), of a point pair from its points in order. At every q they
are smooth, where c and r go through infinity as the points of a circle become collinear, those of a sphere coplanar. Of line, circle and
plane they do not see which way it is turned, and would let points come together; so the direction's logarithm joins them, times LEVER of
how far apart the points are (m).

logarithm: log(~V_c V_d) as paper A has it (44), seven numbers, lengths in units of the current radius.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cga_runtime.coordinates import Array, dot, norm, parts, stack, times
from cga_runtime.elements import Point, PointPair
from cga_runtime.elements.charts import REFERENCE, SEAM, direction_of
from cga_runtime.elements.similarities import similarity_of
from cga_runtime.elements.through_points import COINCIDENT, FLAT
from cga_runtime.smooth import NUMPY
from cga_runtime.solve.ik_targets import MEASURES, Measure
from cga_runtime.solve.levenberg_marquardt import Rows
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.cooperative_guard import Guard
from cga_runtime.spaces.cooperative_kernels import primitive_unit
from cga_runtime.spaces.primitive_kinds import Primitive, Spanned
from cga_runtime.spaces.similarity_twists import log_rate_of_space, logarithm, relative
from cga_runtime.versors import Rotor

NOWHERE = 1e70
"""The error of points that span no primitive: more than any other, weighted."""
CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
"""Looked at in the place of points that span no primitive: kernels have a value there."""
LEVER = 0.5
"""Of the points' distance from their mean, root of the mean square. From 0.3 to 1 success from one start differs by less than 0.03."""
STILL = 1e-12
"""A joint does not move the points where its column is shorter than this fraction of the longest."""
OPPOSITE = 1e-9
"""How far (rad) a direction that is opposite to the wanted one is taken to be from it, so that there is a way to it."""


@dataclass(frozen=True)
class Standing:
    """Where the primitives through m batches of points stand: V = T(c) R D(r) in charts +1 or -1. Where not `sound` they are degenerate, or
    opposite to where the chart begins, and their values those of CORNERS."""

    about: Primitive
    points: Array
    chart: Array
    sound: NDArray[np.bool_]

    @classmethod
    def of(cls, about: Primitive, points: Array, chart: Array | None = None) -> Standing:
        """Of points (m, k, 3), in given charts (m,) or the default ones."""
        guard = Guard.of(primitive_unit(about.name).kernel("guard")(points))
        sense = np.where(guard.cosine < SEAM, -1.0, 1.0) if chart is None else chart
        sound = (guard.measure > FLAT) & (guard.pairs > COINCIDENT**2).all(axis=1) & ~guard.at_pole(sense)
        shown = np.where(sound[:, None, None], points, CORNERS[: about.points])
        return cls(about, shown, np.where(sound, sense, 1.0)[:, None], sound)

    def kernel(self, name: str) -> Array:
        """A kernel of the primitive at the points."""
        return primitive_unit(self.about.name).kernel(name)(self.points, self.chart)

    @cached_property
    def parts(self) -> tuple[Array, Array, Array]:
        """Rotor (m, 4), centre (m, 3), radius (m,), which is 1 of flat ones."""
        values = self.kernel("parts")
        return values[:, :4], values[:, 4:7], values[:, 7]

    @cached_property
    def axes(self) -> Array:
        """Rotation matrices, (m, 3, 3)."""
        return Rotor(self.parts[0]).matrix()


@dataclass(frozen=True)
class Errors:
    """Of a system and a batch of wanted primitives, an element of its kind. weights: of lengths (1/m) and angles (1/rad). Each error is an
    Evaluate: residuals (m, e) and their Jacobians (m, e, n) at positions q (m, n), for the targets `rows`."""

    system: Cooperative
    wanted: Spanned
    weights: tuple[float, float]

    @cached_property
    def columns(self) -> list[Array]:
        """Fields of the wanted primitives, each (targets, ...)."""
        given = [getattr(self.wanted, field.name) for field in fields(self.wanted)]
        return [column.reshape(-1, *column.shape[len(self.wanted.batch) :]) for column in given]

    @cached_property
    def center(self) -> Array:
        return self.wanted.center.reshape(-1, 3)

    @cached_property
    def radius(self) -> Array:
        """Ones for flat ones."""
        radius: Array = getattr(self.wanted, "radius", np.ones(self.wanted.batch))
        return radius.reshape(-1)

    @cached_property
    def direction(self) -> Array | None:
        """None for those that have none."""
        return direction_of(self.wanted).reshape(-1, 3) if self.wanted.kind in REFERENCE else None

    @cached_property
    def _reference(self) -> Array:
        return np.zeros(3) if self.system.about.reference is None else self.system.about.reference

    @property
    def _flat(self) -> bool:
        return self.system.kind in ("line", "plane")

    # ---- the error by which results are judged

    def similarity(self, rows: Rows, q: Array) -> tuple[Array, Array]:
        """(lengths, angles), weighted."""
        points, moving = self.system.points(q), self._moving(q)
        at = Standing.of(self.system.about, points)
        body = at.kernel("horizontal_jacobian") @ moving
        residual, jacobian = self._lengths(rows, at, body, moving)
        lengths, angles = self.weights
        residual, jacobian = lengths * residual, lengths * jacobian
        if self.direction is not None:
            turn, turning = self._turn(self.direction[rows], at)
            residual = np.concatenate([residual, angles * turn], axis=1)
            jacobian = np.concatenate([jacobian, angles * (turning @ self._turning(at, body))], axis=1)
        return _nowhere(at.sound, residual), jacobian * at.sound[:, None, None]

    def _moving(self, q: Array) -> Array:
        """Jacobian of the points, where joints that do not move them, as a wrist's last, have columns of zeros and not of rounding."""
        moving = self.system.point_jacobian(q)
        size = np.linalg.norm(moving, axis=1, keepdims=True)
        return np.where(size > STILL * size.max(axis=2, keepdims=True), moving, 0.0)

    def _lengths(self, rows: Rows, at: Standing, body: Array, moving: Array) -> tuple[Array, Array]:
        about = self.system.about
        if self._flat:
            residual, gradient = self._measure(at.points.mean(axis=1), *(column[rows] for column in self.columns))
            return residual, gradient @ moving.reshape(len(rows), about.points, 3, -1).mean(axis=1)
        _, center, radius = at.parts
        residual = center - self.center[rows]
        jacobian = radius[:, None, None] * (at.axes @ body[:, 4:7])
        if not about.round:
            return residual, jacobian
        more = radius - self.radius[rows]
        return stack(*parts(residual), more), np.concatenate([jacobian, -times(radius, body[:, 3])[:, None]], axis=1)

    def _turn(self, wanted: Array, at: Standing) -> tuple[Array, Array]:
        """The direction's logarithm at the wanted one, and its derivative (m, 3, 3) by the direction."""
        n = at.axes @ self._reference
        opposite = (dot(n, wanted) < 0.0) & (norm(np.cross(n, wanted)) < OPPOSITE)
        n = n + np.where(opposite[:, None], OPPOSITE * at.axes[:, :, 0], 0.0)  # e1 is square to both reference directions
        cosine = dot(n, wanted)
        across = n - times(cosine, wanted)
        sine = norm(across)
        angle = np.arctan2(sine, cosine)
        near = angle < 1e-3
        divisor = np.where(near, 1.0, sine)
        ratio = np.where(near, 1.0 + angle * angle / 6.0, angle / divisor)
        slope = np.where(near, -1.0 / 3.0, -(sine - angle * cosine) / divisor**3)  # of the ratio, by the cosine
        outer = across[:, :, None] * wanted[:, None, :]
        square = np.eye(3) - wanted[:, :, None] * wanted[:, None, :]
        return times(ratio, across), ratio[:, None, None] * square + slope[:, None, None] * outer

    def _turning(self, at: Standing, body: Array) -> Array:
        """Derivative of the direction, R (om x a), (m, 3, n)."""
        om = np.stack([body[:, 2], -body[:, 1], body[:, 0]], axis=1)
        return at.axes @ np.cross(om, self._reference, axisa=1, axisb=0, axisc=1)

    # ---- what the search follows

    def incidence(self, rows: Rows, q: Array) -> tuple[Array, Array]:
        """Distances from the wanted primitive, scaled by a positive number for each q so that their length is that of `similarity`. The
        Jacobian leaves out how lever and scale change, which does not matter where the residual vanishes."""
        k, n = self.system.about.points, self.system.n
        points, moving = self.system.points(q), self.system.point_jacobian(q)
        at = Standing.of(self.system.about, points)
        residual, gradient = self._distances(rows, points)
        jacobian = (gradient @ moving.reshape(-1, k, 3, n)).reshape(len(rows), -1, n)
        size = self.weights[0] * self._length(rows, at)
        if self.direction is not None:
            turn, turning = self._turn(self.direction[rows], at)
            size = np.hypot(size, self.weights[1] * norm(turn))
            if self.system.kind != "point_pair":
                spread = points - points.mean(axis=1, keepdims=True)
                lever = LEVER * np.sqrt((spread * spread).sum(axis=(1, 2)) / k) * at.sound
                residual = np.concatenate([residual, times(lever, turn)], axis=1)
                rate = turning @ self._turning(at, at.kernel("horizontal_jacobian") @ moving)
                jacobian = np.concatenate([jacobian, lever[:, None, None] * rate], axis=1)
        return _scaled(residual, jacobian, np.where(at.sound, size, NOWHERE))

    @property
    def _measure(self) -> Measure:
        return MEASURES[Point if isinstance(self.wanted, PointPair) else type(self.wanted)]

    def _distances(self, rows: Rows, points: Array) -> tuple[Array, Array]:
        """Components (m, k e) of the points' distances, and their gradients (m, k, e, 3), each by its own point."""
        m, k, _ = points.shape
        if isinstance(self.wanted, PointPair):
            columns = [self.columns[0][rows].reshape(m * k, 3)]
        else:
            columns = [np.repeat(column[rows], k, axis=0) for column in self.columns]
        residual, gradient = self._measure(points.reshape(m * k, 3), *columns)
        return residual.reshape(m, -1), gradient.reshape(m, k, *gradient.shape[1:])

    def _length(self, rows: Rows, at: Standing) -> Array:
        """The length of `_lengths`."""
        if self._flat:
            return norm(self._measure(at.points.mean(axis=1), *(column[rows] for column in self.columns))[0])
        _, center, radius = at.parts
        return np.hypot(norm(center - self.center[rows]), radius - self.radius[rows])

    # ---- as printed

    def logarithm(self, rows: Rows, q: Array) -> tuple[Array, Array]:
        """log(~V_c V_d) and its derivative (paper A, eqs. 44, 47), scaled by one number for each target, so that its length is about the
        weighted error's near zero."""
        at = Standing.of(self.system.about, self.system.points(q), self._charts[rows])
        body = at.kernel("geometric_jacobian") @ self.system.point_jacobian(q)
        rotor, center, radius = at.parts
        goal, scale = self._goal[rows], np.maximum(self.weights[0] * self.radius, self.weights[1])[rows]
        off = relative(NUMPY, (parts(rotor), parts(center), radius), (parts(goal), parts(self.center[rows]), self.radius[rows]))
        residual = stack(*logarithm(NUMPY, off))
        by_columns = ([x[:, None] for x in off[0]], [x[:, None] for x in off[1]], off[2][:, None])
        jacobian = np.stack(np.broadcast_arrays(*log_rate_of_space(NUMPY, by_columns, list(np.moveaxis(-body, -2, 0)))), axis=-2)
        return _nowhere(at.sound, times(scale, residual)), (scale * at.sound)[:, None, None] * jacobian

    @cached_property
    def _charts(self) -> Array:
        return self.system.about.chart(self.wanted).reshape(-1)

    @cached_property
    def _goal(self) -> Array:
        """Rotors of V_d, (targets, 4)."""
        return similarity_of(self.wanted, self.system.about.chart(self.wanted)).rotation().coefficients.reshape(-1, 4)


def _nowhere(sound: NDArray[np.bool_], residual: Array) -> Array:
    """Residuals (m, e), of length NOWHERE where not sound."""
    found = np.where(sound[:, None], residual, 0.0)
    found[~sound, 0] = NOWHERE
    return found


def _scaled(residual: Array, jacobian: Array, length: Array) -> tuple[Array, Array]:
    """Both times a number for each of the m, so that residuals have the given lengths."""
    given = norm(residual)
    some = given > 1e-30
    factor = np.where(some, length / np.where(some, given, 1.0), 0.0)
    residual = times(factor, residual)
    residual[:, 0] += np.where(some, 0.0, length)
    return residual, factor[:, None, None] * jacobian
