"""The cooperative hypersphere of five chains in G(5,1), and its similarity as their common pose (paper A, section 5.6).

Five points span a hypersphere of R^4, but end points lie in R^3: as points of R^4 they are in the hyperplane x4 = 0 for every q, and their
outer product is that hyperplane times the in-sphere determinant (`insphere`, a scalar task of its own: zero where the five lie on one
sphere). So each end point gets a fourth coordinate, its lift h_i (m). The hypersphere, centre (c, c4) and radius r, then says

    |x_i - c|^2 - rho^2 = 2 h_i c4 - h_i^2,  rho^2 = r^2 - c4^2:

the signed powers of the end points with respect to its slice, the sphere (c, rho) of R^3. Two choices of lifts:

- constant ones, by default 0 0 0 0 l: the slice is the sphere of the first four chains, and 2 l c4 - l^2 is the power of the fifth. They
  treat the chains unequally, and are degenerate where those four are coplanar; any constant lifts are on some such surface.
- `HypersphereSpace.balanced`: l times the unit affine dependency m(q) of the five points (sum m_i = 0, sum m_i x_i = 0). All chains count
  alike, and only five coplanar points are degenerate. The slice is the sphere of least squares of |x_i - c|^2 + h_i^2 - rho^2, and where l
  is small 2 l c4 is the signed length of what remains.

Five numbers of five chains; a hypersphere has no direction, and V = T(C) D(r) has no gauge. Lifts are lengths: the hypersphere follows
rigid motions of all points together, but not a change of their scale. Choose l near the size of the figure. Bivectors are e0i e1i e2i e3i
e4i in the hypersphere's own frame, lengths in units of r, with e0i = -d log r.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, norm, one_batch, parts, read, stack
from cga_runtime.errors import DegenerateError, UnknownNameError, WrongSizeError
from cga_runtime.robot import Chain
from cga_runtime.spaces.casadi_hypersphere import Symbols, error, error_rates, function, logarithm, versor_rates
from cga_runtime.spaces.cooperative_kernels import Composed, primitive_unit
from cga_runtime.spaces.jacobian_measures import manipulability, nullspace
from cga_runtime.spaces.joints import JointSpace
from cga_runtime.spaces.primitive_kinds import COINCIDENT, FLAT

KIND, CHAINS = "hypersphere", 5
LIFT = 0.05
"""Default lift of the last chain (m), about the radius of what a hand holds."""
BIVECTORS = ("e0i", "e1i", "e2i", "e3i", "e4i")
"""Rows of Jacobians, components of logarithms."""
VERSOR = ("1", *BIVECTORS)
"""Components of V."""
BLADES = ("e01234", "e0123i", "e0124i", "e0134i", "e0234i", "e1234i")
"""Components of the primitive."""


@dataclass(frozen=True, eq=False)
class Hypersphere:
    """Centre (..., 4) and radius (...), m. Raises DegenerateError for a radius that is not positive."""

    center: Array
    radius: Array

    def __post_init__(self) -> None:
        c, r = read(self.center, "centre of a hypersphere", 4), read(self.radius, "radius of a hypersphere")
        batch = one_batch("hypersphere", c.shape[:-1], r.shape)
        if (r <= COINCIDENT).any():
            raise DegenerateError(f"hypersphere: radius {r.min():.3g} given, a positive one is needed (more than {COINCIDENT:.0e} m)")
        object.__setattr__(self, "center", np.broadcast_to(c, (*batch, 4)))
        object.__setattr__(self, "radius", np.broadcast_to(r, batch))

    @classmethod
    def from_points(cls, points: ArrayLike, lifts: ArrayLike) -> Self:
        """Through five points (..., 5, 3) with their lifts (..., 5). Raises DegenerateError where no or more than one hypersphere is."""
        x, h = read(points, "points of a hypersphere", CHAINS, 3), read(lifts, "lifts", CHAINS)
        batch = one_batch("points and lifts", x.shape[:-2], h.shape[:-1])
        x, h = np.broadcast_to(x, (*batch, CHAINS, 3)), np.broadcast_to(h, (*batch, CHAINS))
        check(x, h)
        found = primitive_unit(KIND).kernel("parts")(x, h)
        return cls(found[..., :4], found[..., 4])

    @classmethod
    def from_slice(cls, center: ArrayLike, radius: ArrayLike, height: ArrayLike) -> Self:
        """With a sphere of R^3 as its slice, (..., 3) and (...), and c4 = height (...): (p + l^2)/(2 l) for power p and lift l."""
        c, rho, c4 = read(center, "centre of the slice", 3), read(radius, "radius of the slice"), read(height, "height")
        one_batch("centre, radius and height", c.shape[:-1], rho.shape, c4.shape)
        return cls(stack(*parts(c), c4), np.hypot(rho, c4))

    def powers(self, lifts: ArrayLike) -> Array:
        """|x_i - c|^2 - rho^2 (m^2) of points of these lifts (..., k) that lie on it, (..., k)."""
        h = read(lifts, "lifts")
        return np.asarray(h * (2.0 * self.center[..., 3:] - h))


class HypersphereSpace:
    """The cooperative task space of five chains. q is (..., n): see `joint_names`. lifts: five numbers (m), by default 0 0 0 0 0.05.

    Raises WrongSizeError (number of chains, of lifts), NotFiniteError, UnknownNameError (what is no Chain), ChainError (floating bases;
    chains of one robot that begin in different frames), DegenerateError (equal lifts). Methods raise WrongSizeError, NotFiniteError, and
    DegenerateError where the lifted points lie in one hyperplane or coincide: see `degeneracy`. The Jacobian has rank 5 unless the joints
    themselves are singular, or an end point stands in the centre of the slice, where its power cannot fall further.
    """

    def __init__(self, chains: Sequence[Chain], lifts: ArrayLike | None = None) -> None:
        given = [chains] if isinstance(chains, Chain) else list(chains)
        if len(given) != CHAINS:
            raise WrongSizeError(f"a hypersphere of G(5,1) is spanned by {CHAINS} chains, {len(given)} given")
        self.joints = JointSpace.of(given)
        self.chains = tuple(given)
        self.n, self.joint_names = self.joints.n, self.joints.joint_names
        self.lower, self.upper = self.joints.lower, self.joints.upper
        h = read([0.0] * (CHAINS - 1) + [LIFT] if lifts is None else lifts, "lifts", CHAINS)
        if h.ndim != 1:
            raise WrongSizeError(f"lifts: shape {h.shape} given, ({CHAINS},) needed")
        if np.ptp(h) <= COINCIDENT:
            raise DegenerateError(
                f"hypersphere: all lifts are {h[0]:.6g} m; the five end points then lie in the hyperplane x4 = {h[0]:.6g} of R^4 for every"
                " q, and span no hypersphere; give one chain another lift, or take HypersphereSpace.balanced"
            )
        self._constant: Array | None = h
        self._length = 1.0
        self._source = Composed(KIND, self.chains, self.joints)

    @classmethod
    def balanced(cls, chains: Sequence[Chain], length: float = LIFT) -> Self:
        """With lifts that are `length` (m) times the unit affine dependency of the end points. Raises as the class does."""
        scale = read(length, "length")
        if scale.ndim or not scale > COINCIDENT:
            raise DegenerateError(f"hypersphere: length {length} given, a number of metres above {COINCIDENT:.0e} is needed")
        space = cls(chains)
        space._constant, space._length = None, float(scale)
        return space

    def __repr__(self) -> str:
        names = " + ".join(f"{chain.robot.name}/{chain.frame}" for chain in self.chains)
        lifts = f"balanced lifts, {self._length} m" if self._constant is None else f"lifts {self._constant.tolist()} m"
        return f"<HypersphereSpace of {names}: {self.n} joints, {lifts}>"

    def random(self, rng: np.random.Generator, size: int | tuple[int, ...] | None = None) -> Array:
        """Uniform positions inside the limits, shape (size..., n)."""
        return self.joints.random(rng, size)

    # ---- the primitive

    def points(self, q: ArrayLike) -> Array:
        """End points of the chains (m), (..., 5, 3)."""
        return self._source.points(self.joints.check(q))

    def point_jacobian(self, q: ArrayLike) -> Array:
        """Derivative of the points, x y z of the first chain first, (..., 15, n)."""
        return self._source.point_jacobian(self.joints.check(q))

    def lifts(self, q: ArrayLike) -> Array:
        """Lifts of the end points (m), (..., 5)."""
        return self._lifts(self.points(q))

    def primitive(self, q: ArrayLike) -> Array:
        """X = P1 ^ ... ^ P5 of the lifted points, (..., 6), coefficients of BLADES; its first is the weight. Total."""
        return self._of_points("primitive", self.points(q))

    def element(self, q: ArrayLike) -> Hypersphere:
        """The hypersphere of the end points."""
        found = self._parts(q)
        return Hypersphere(found[..., :4], found[..., 4])

    def through(self, points: ArrayLike) -> Hypersphere:
        """The hypersphere of end points (..., 5, 3) at which the chains are to be, with the lifts of this space: a target."""
        x = read(points, "points of a hypersphere", CHAINS, 3)
        return Hypersphere.from_points(x, self._lifts(x))

    def slice(self, q: ArrayLike) -> Array:
        """The sphere of R^3 at x4 = 0, (..., 4): centre (m) and rho^2 (m^2), negative where the slice is empty."""
        return self._of_points("slice", self._spanning(q))

    def insphere(self, q: ArrayLike) -> Array:
        """The in-sphere determinant (m^5), (...), whatever the lifts: P1 ^ ... ^ P5 = w e0123i without them. Total."""
        return np.asarray(self._source.unit.kernel("insphere")(self.points(q))[..., 0])

    def insphere_gradient(self, q: ArrayLike) -> Array:
        """Gradient of `insphere`, (..., n)."""
        by_points = self._source.unit.kernel("insphere_gradient")(self.points(q))
        return np.asarray((by_points[..., None, :] @ self.point_jacobian(q))[..., 0, :])

    def degeneracy(self, q: ArrayLike) -> Array:
        """How far from degenerate, (...): |det| of the four edges of the lifted points over their lengths. Never raises for finite q."""
        return np.asarray(self._of_points("degeneracy", self.points(q))[..., 0])

    def degeneracy_gradient(self, q: ArrayLike) -> Array:
        """Gradient of `degeneracy`, (..., n)."""
        return np.asarray(self._by_joints("degeneracy_gradient", q, self.points(q))[..., 0, :])

    # ---- its similarity

    def similarity(self, q: ArrayLike) -> Array:
        """V = T(C) D(r) with V X_u ~V = X over its weight and radius, (..., 6): VERSOR; X_u = e01234 + e1234i/2."""
        return self._of_points("similarity", self._spanning(q))

    def log(self, q: ArrayLike) -> Array:
        """The logarithm of V by factors, (..., 5): e0i = -log r, then the centre (m)."""
        return stack(*logarithm(np.log, parts(self._parts(q))))

    def geometric_jacobian(self, q: ArrayLike) -> Array:
        """J_G = -2 ~V dV/dq, (..., 5, n), in the hypersphere's own frame; every row moves it, so that it is the horizontal one too."""
        return self._by_joints("geometric_jacobian", q, self._spanning(q))

    def analytic_jacobian(self, q: ArrayLike) -> Array:
        """dV/dq = -1/2 V J_G, (..., 6, n)."""
        return np.stack(versor_rates(_columns(self.similarity(q)), _rows(self.geometric_jacobian(q))), axis=-2)

    def error(self, q: ArrayLike, target: Hypersphere) -> Array:
        """log(~V V_d) by factors, (..., 5): e0i = -log(r_d/r), then (C_d - C)/r (paper A, eq. 44)."""
        found = self._parts(q)
        if not isinstance(target, Hypersphere):
            raise UnknownNameError("target of a hypersphere space", type(target).__name__, ("Hypersphere",))
        one_batch("q and target", found.shape[:-1], target.radius.shape)
        return stack(*error(np.log, parts(found), (*parts(target.center), target.radius)))

    def error_jacobian(self, q: ArrayLike, target: Hypersphere) -> Array:
        """Derivative of `error` by q, (..., 5, n) (paper A, eq. 47): -J_G where the error is zero."""
        rates = error_rates(_columns(self.error(q, target)), _rows(self.geometric_jacobian(q)))
        return np.stack(np.broadcast_arrays(*rates), axis=-2)

    def nullspace(self, q: ArrayLike) -> Array:
        """N = 1 - J^+ J of the geometric Jacobian, (..., n, n): projects on what leaves the hypersphere where it is (paper A, eq. 58)."""
        return nullspace(self.geometric_jacobian(q))

    def manipulability(self, q: ArrayLike) -> Array:
        """sqrt(det(J J^T)) of the geometric Jacobian, (...) (paper A, eq. 59)."""
        return manipulability(self.geometric_jacobian(q))

    def casadi(self, name: str) -> Any:
        """A method as a casadi.Function of q with exact derivatives; error and error_jacobian also of the target's C and r (5).

        Raises UnknownNameError.
        """
        return function(Symbols(self._source, self._constant, self._length), name)

    # ---- inside

    def _lifts(self, points: Array) -> Array:
        if self._constant is not None:
            return np.broadcast_to(self._constant, points.shape[:-1])
        return np.asarray(self._length * self._source.unit.kernel("dependency")(points))

    def _spanning(self, q: ArrayLike) -> Array:
        """End points that span a hypersphere."""
        points = self.points(q)
        check(points, self._lifts(points))
        return points

    def _of_points(self, name: str, points: Array) -> Array:
        return self._source.unit.kernel(name)(points, self._lifts(points))

    def _parts(self, q: ArrayLike) -> Array:
        """C and r, (..., 5)."""
        return self._of_points("parts", self._spanning(q))

    def _by_joints(self, name: str, q: ArrayLike, points: Array) -> Array:
        """A derivative by the points, (..., m, 15), and by the lifts that follow them, as one by q, (..., m, n)."""
        unit, lifts, m = self._source.unit, self._lifts(points), -1
        by_points = unit.kernel(name)(points, lifts).reshape(*points.shape[:-2], m, 3 * CHAINS)
        if self._constant is None:
            by_lifts = unit.kernel(f"{name}_by_lifts")(points, lifts).reshape(*points.shape[:-2], m, CHAINS)
            by_points = by_points + self._length * by_lifts @ unit.kernel("dependency_jacobian")(points)
        return np.asarray(by_points @ self.point_jacobian(q))


def check(points: Array, lifts: Array) -> None:
    """DegenerateError where five lifted points span no hypersphere."""
    if (primitive_unit(KIND).kernel("degeneracy")(points, lifts) > FLAT).all():
        return
    lifted = np.concatenate([points, lifts[..., None]], axis=-1)
    first, second = np.triu_indices(CHAINS, 1)
    apart = norm(lifted[..., first, :] - lifted[..., second, :])
    if (apart <= COINCIDENT).any():
        k = int(np.argwhere(apart <= COINCIDENT)[0, -1])
        raise DegenerateError(
            f"hypersphere: points {first[k] + 1} and {second[k] + 1} coincide, lifts included (within {COINCIDENT:.0e} m)"
        )
    raise DegenerateError(
        "hypersphere: the five lifted points lie in one hyperplane of R^4: always so with equal lifts; with one that differs, where the"
        " other four points are coplanar; with balanced lifts, where all five are"
    )


def _columns(components: Array) -> list[Array]:
    """Components with one more axis, for the columns of a Jacobian."""
    return [x[..., None] for x in parts(components)]


def _rows(jacobian: Array) -> list[Array]:
    return list(np.moveaxis(jacobian, -2, 0))
