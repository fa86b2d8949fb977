"""Cooperative task spaces: several chains whose end points span one primitive, and its similarity as their common pose (paper A).

The end points of one to four chains make a point, point pair, line, circle, plane or sphere; V(q) = T R D carries the unit primitive of
that kind to it (paper A, section 3; similarity.md, sections 5 and 6). Chains may share joints and belong to different robots, placed in a
common world by `Robot.chain(..., placement=...)`. Bivectors are e12 e13 e23 e0i e1i e2i e3i in the primitive's own frame, lengths in units
of its radius (of flat primitives: m), with e0i = -d log r.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, one_batch, parts, read, stack
from cga_runtime.elements import Element
from cga_runtime.elements.charts import KEPT, RECOMMENDED, SEAM, read_chart
from cga_runtime.elements.similarities import similarity_of
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.robot import Chain
from cga_runtime.smooth import NUMPY
from cga_runtime.spaces.casadi_cooperative import function
from cga_runtime.spaces.cooperative_guard import evaluate, look, refuse_pole
from cga_runtime.spaces.cooperative_kernels import Composed, Fused, Source
from cga_runtime.spaces.jacobian_measures import manipulability, manipulability_gradient, nullspace
from cga_runtime.spaces.joints import JointSpace
from cga_runtime.spaces.primitive_kinds import PRIMITIVES, Primitive, Spanned
from cga_runtime.spaces.similarity_twists import Parts, log_rate_of_body, log_rate_of_space, logarithm, relative, space_twist
from cga_runtime.versors import Similarity


class Cooperative:
    """The cooperative task space of as many chains as the primitive has points. q is (..., n): see `joint_names`.

    primitive: point (1 chain), point_pair or line (2), circle or plane (3), sphere (4).

    The rotor of V turns the primitive's reference direction to its own by the shortest arc. No such choice is continuous everywhere: it
    fails where the two are opposite. `chart` says which way is taken: +1 the shortest arc, -1 half a turn about e1 and then the shortest
    arc; None, the default, is +1 up to about 6 degrees from the opposite direction and -1 beyond. A controller should keep the chart of its
    last step: `chart(q, previous)`. Primitive, horizontal Jacobian (up to a turn about the direction), nullspace and manipulability do not
    depend on it.

    Raises UnknownNameError (a primitive, what is no Chain), WrongSizeError (number of chains), ChainError (floating bases; chains of one
    robot that begin in different frames). Methods raise WrongSizeError, NotFiniteError, and DegenerateError where the points coincide, are
    collinear or coplanar (similarity.md, section 8): see `degeneracy`.
    """

    def __init__(self, chains: Sequence[Chain], primitive: str) -> None:
        if not isinstance(primitive, str) or primitive not in PRIMITIVES:
            raise UnknownNameError("primitive", primitive, PRIMITIVES)
        if not isinstance(chains, Chain | Iterable):
            raise UnknownNameError("chain", type(chains).__name__, ("a Chain, from Robot.chain",))
        given = [chains] if isinstance(chains, Chain) else list(chains)
        self.about: Primitive = PRIMITIVES[primitive]
        if len(given) != self.about.points:
            raise WrongSizeError(f"a {primitive} is spanned by {self.about.points} chains, {len(given)} given")
        self.joints = JointSpace.of(given)
        self.chains, self.kind = tuple(given), primitive
        self.n, self.joint_names = self.joints.n, self.joints.joint_names
        self.lower, self.upper = self.joints.lower, self.joints.upper
        self._source: Source = Composed(primitive, self.chains, self.joints)

    def __repr__(self) -> str:
        names = " + ".join(f"{chain.robot.name}/{chain.frame}" for chain in self.chains)
        return f"<Cooperative {self.kind} of {names}: {self.n} joints{', fused' if self.fused else ''}>"

    @property
    def fused(self) -> bool:
        """Whether its kernels were made for this very system."""
        return isinstance(self._source, Fused)

    def fuse(self) -> Cooperative:
        """The same system with kernels made for it: one pass from q to each result. Generated at first use, kept in the cache."""
        other = Cooperative(self.chains, self.kind)
        other._source = Fused(self.kind, self.chains, self.joints)
        return other

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits, shape (size..., n)."""
        return self.joints.random(rng, size)

    # ---- the primitive

    def points(self, q: ArrayLike) -> Array:
        """End points of the chains (m), (..., k, 3)."""
        return self._plain("points", q)

    def point_jacobian(self, q: ArrayLike) -> Array:
        """Derivative of the points, x y z of the first chain first, (..., 3 k, n)."""
        return self._plain("point_jacobian", q)

    def primitive(self, q: ArrayLike) -> Array:
        """X = P1 ^ ... ^ Pk, of line and plane ^ ei, coefficients of `blades`; not normalised (paper A, eq. 14). Total: zero or flat where
        the points are degenerate."""
        return self._plain("primitive", q)

    def primitive_jacobian(self, q: ArrayLike) -> Array:
        """dX/dq, (..., blades, n) (paper A, eqs. 15-17)."""
        return self._plain("primitive_jacobian", q)

    @property
    def blades(self) -> tuple[str, ...]:
        """Names of the components of `primitive`."""
        blades: tuple[str, ...] = self.about.element.blades
        return blades

    @property
    def controllable(self) -> tuple[str, ...]:
        """Bivectors that move the primitive: the rows of `horizontal_jacobian` that are not zero (paper A, table 1)."""
        return self.about.controllable

    def element(self, q: ArrayLike) -> Spanned:
        """The primitive as an element, with centre, direction and radius."""
        return self.about.through(self.points(q))

    def weight(self, q: ArrayLike) -> Array:
        """The signed size of X, (...): |x2 - x1|, twice the triangle's area, or the determinant of three edges; 1 of a point."""
        return self.about.weight(self.points(q))

    def degeneracy(self, q: ArrayLike) -> Array:
        """How far from degenerate, (...): |x2 - x1| (m), the sine between two edges, |det| of three over their lengths; 1 of a point.

        Zero where the points coincide, are collinear or coplanar, but for rounding; these do not raise.
        """
        return np.asarray(self._plain("degeneracy", q)[..., 0])

    def degeneracy_gradient(self, q: ArrayLike) -> Array:
        """Gradient of `degeneracy`, (..., n)."""
        return self._plain("degeneracy_gradient", q)

    # ---- its similarity

    def chart(self, q: ArrayLike, previous: ArrayLike | None = None) -> Array:
        """The recommended chart at q, +1 or -1, (...): +1 where a.n >= -0.5, n the primitive's direction and a its reference; with
        `previous` that one, as long as n stays 26 degrees away from where it fails. See elements/charts.py."""
        cosine = look(self.about, self._source, self.joints.check(q)).cosine
        if previous is None:
            return np.where(cosine >= RECOMMENDED, 1.0, -1.0)
        before = read_chart(previous).astype(np.float64)
        one_batch("q and chart", cosine.shape, before.shape)
        return np.where(before * cosine > KEPT, before, -before)

    def similarity(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """V with V X_u ~V = X over its weight, (..., 12): 1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i (paper A, eq. 28)."""
        return self._value("similarity", q, chart)

    def log(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """The split logarithm of V, (..., 7): rotation of the arc, e0i = -log r, and the centre (m)."""
        return stack(*logarithm(NUMPY, self._parts(q, chart)))

    def analytic_jacobian(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """dV/dq, (..., 12, n) (paper A, eq. 29)."""
        return self._value("analytic_jacobian", q, chart)

    def geometric_jacobian(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """J_G = -2 ~V dV/dq, (..., 7, n), in the primitive's own frame (paper A, eq. 30)."""
        return self._value("geometric_jacobian", q, chart)

    def space_jacobian(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """-2 dV/dq ~V, (..., 7, n): the same motions about the origin of the world."""
        at = self._parts(q, chart)
        rows = space_twist(_by_columns(at), _rows(self.geometric_jacobian(q, chart)))
        return np.stack(np.broadcast_arrays(*rows), axis=-2)

    def horizontal_jacobian(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """J_G without motions that leave the primitive where it is, (..., 7, n): only the `controllable` rows are not zero.

        It does not depend on the gauge of V but for a turn about the primitive's direction: the one for control, inverses, manipulability.
        """
        return self._value("horizontal_jacobian", q, chart)

    def bivector_jacobian(self, q: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """Derivative of `log`, (..., 7, n) (paper A, eq. 31)."""
        at = self._parts(q, chart)
        rows = log_rate_of_body(NUMPY, _by_columns(at), _rows(self.geometric_jacobian(q, chart)))
        return np.stack(np.broadcast_arrays(*rows), axis=-2)

    def geometric_jacobian_derivative(self, q: ArrayLike, v: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """Time derivative of `geometric_jacobian` along q' = v, (..., 7, n)."""
        return self._value("geometric_jacobian_derivative", q, chart, v)

    def horizontal_jacobian_derivative(self, q: ArrayLike, v: ArrayLike, chart: ArrayLike | None = None) -> Array:
        """Time derivative of `horizontal_jacobian` along q' = v, (..., 7, n)."""
        return self._value("horizontal_jacobian_derivative", q, chart, v)

    # ---- errors

    def error(self, q: ArrayLike, target: Element | Similarity | ArrayLike, chart: ArrayLike | None = None) -> Array:
        """log(~V V_d), (..., 7), split chart, the short way round: translations in units of the current radius (paper A, eq. 44).

        target: a primitive of the same kind, or V_d as a Similarity or its 12 components. chart: of V, and of a primitive's V_d; by default
        the one that suits the target.
        """
        q, goal, chart = self._goal(q, target, chart)
        return stack(*logarithm(NUMPY, relative(NUMPY, self._parts(q, chart), goal)))

    def error_jacobian(self, q: ArrayLike, target: Element | Similarity | ArrayLike, chart: ArrayLike | None = None) -> Array:
        """Derivative of `error` by q, (..., 7, n) (paper A, eq. 47): -J_G where the error is zero."""
        q, goal, chart = self._goal(q, target, chart)
        off = relative(NUMPY, self._parts(q, chart), goal)
        rows = log_rate_of_space(NUMPY, _by_columns(off), _rows(-self.geometric_jacobian(q, chart)))
        return np.stack(np.broadcast_arrays(*rows), axis=-2)

    # ---- what the Jacobian says

    def nullspace(self, q: ArrayLike) -> Array:
        """N = 1 - J^+ J of the horizontal Jacobian, (..., n, n): projects joint velocities on those that leave the primitive where it is
        (paper A, eq. 58, with the pseudo-inverse)."""
        return nullspace(self._moving(q))

    def manipulability(self, q: ArrayLike) -> Array:
        """sqrt(det(J J^T)) of the controllable rows of the horizontal Jacobian, (...): the volume of the ellipsoid (paper A, eq. 59)."""
        return manipulability(self._moving(q))

    def manipulability_gradient(self, q: ArrayLike) -> Array:
        """Gradient of `manipulability`, (..., n)."""
        at = self.joints.check(q)
        jacobian, every = self._moving(at), np.broadcast_to(at[..., None, :], (*at.shape[:-1], self.n, self.n))
        rates = self.horizontal_jacobian_derivative(every, np.eye(self.n))[..., self.about.rows, :]  # one joint moves at a time
        return manipulability_gradient(jacobian, rates)

    def casadi(self, name: str, chart: int | None = None) -> Any:
        """A method as a casadi.Function with exact derivatives: of q; *_derivative of q and v; error and error_jacobian of q and V_d (12).

        chart None: the default one, chosen at each q, of errors by the target. Raises UnknownNameError, WrongSizeError.
        """
        sense = None if chart is None else read_chart(chart)
        if sense is not None and sense.ndim:
            raise WrongSizeError(f"chart: shape {sense.shape} given, one number needed")
        return function(self.about, self._source, name, self.n, None if sense is None else float(sense))

    # ---- inside

    def _plain(self, name: str, q: ArrayLike) -> Array:
        """What does not depend on a chart, and has a value for degenerate points, too."""
        return evaluate(self.about, self._source, name, self.joints.check(q))

    def _moving(self, q: ArrayLike) -> Array:
        """Controllable rows of the horizontal Jacobian."""
        return self.horizontal_jacobian(q)[..., self.about.rows, :]

    def _goal(self, q: ArrayLike, target: Any, chart: ArrayLike | None) -> tuple[Array, Parts, Array]:
        """q, parts of V_d, and the chart, with common leading dimensions where they have any."""
        at = self.joints.check(q)
        if isinstance(target, self.about.element):
            sense = self.about.chart(target) if chart is None else read_chart(chart).astype(np.float64)
            goal = similarity_of(target, sense)
        elif isinstance(target, Element):
            accepted = (self.about.element.__name__, "Similarity", "12 components of one")
            raise UnknownNameError(f"target of a cooperative {self.kind}", type(target).__name__, accepted)
        else:
            goal = target if isinstance(target, Similarity) else Similarity(np.asarray(target))
            sense = self.about.chart_of_similarity(goal) if chart is None else read_chart(chart).astype(np.float64)
        one_batch("q and target", at.shape[:-1], goal.coefficients.shape[:-1])
        return at, (parts(goal.rotation().coefficients), parts(goal.translation()), goal.scale()), sense

    def _charted(self, q: ArrayLike, chart: ArrayLike | None) -> tuple[Array, Array]:
        """q and the chart at q, with the same leading dimensions."""
        at = self.joints.check(q)
        guard = look(self.about, self._source, at)
        if chart is None:
            return at, np.where(guard.cosine < SEAM, -1.0, 1.0)
        sense = read_chart(chart).astype(np.float64)
        batch = one_batch("q and chart", at.shape[:-1], sense.shape)
        refuse_pole(self.about, guard, sense)
        return np.broadcast_to(at, (*batch, self.n)), np.broadcast_to(sense, batch)

    def _value(self, name: str, q: ArrayLike, chart: ArrayLike | None, v: ArrayLike | None = None) -> Array:
        at, sense = self._charted(q, chart)
        if v is None:
            return evaluate(self.about, self._source, name, at, sense)
        rate = read(v, "v", self.n)
        batch = one_batch("q and v", at.shape[:-1], rate.shape[:-1])
        at, rate = np.broadcast_to(at, (*batch, self.n)), np.broadcast_to(rate, (*batch, self.n))
        return evaluate(self.about, self._source, name, at, np.broadcast_to(sense, batch), rate)

    def _parts(self, q: ArrayLike, chart: ArrayLike | None) -> Parts:
        rotor_centre_size = parts(self._value("parts", q, chart))
        return rotor_centre_size[:4], rotor_centre_size[4:7], rotor_centre_size[7]


def _by_columns(at: Parts) -> Parts:
    """Parts with one more axis, for the columns of a Jacobian."""
    rotor, t, d = at
    return [x[..., None] for x in rotor], [x[..., None] for x in t], d[..., None]


def _rows(jacobian: Array) -> list[Array]:
    return list(np.moveaxis(jacobian, -2, 0))
