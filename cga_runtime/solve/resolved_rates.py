"""Differential kinematics of cooperative systems: joint velocities for a wanted twist of their primitive (paper A, sections 3.7 and 3.10).

    v = J^# b + N v2,    J^# = J^T (J J^T + l^2)^-1,    N = 1 - J^+ J                 (48), (58)

J holds the controllable rows of the horizontal Jacobian, which has full rank where nothing is singular, and b those of the twist; the
printed J_G has more rows than rank and no inverse (similarity.md, section 7). l is zero, and J^# the pseudo-inverse, unless the smallest
singular value s of J falls below a threshold: l^2 = damping^2 (1 - (s/threshold)^2) there (Nakamura and Hanafusa 1986). With both numbers
equal to t, |J^# b| <= |b| / t everywhere, and the primitive stops moving in the direction in which it cannot. N is never damped: a
secondary motion v2 does not move the primitive, to first order.

A loop that brings the primitive to a target, and uses what it leaves free to stay away from singular positions:

    twist = 2.0 * twist_towards(system, q, target)
    q = q + dt * resolved_rates(system, q, twist, secondary=system.manipulability_gradient(q))
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cga_runtime.coordinates import Array, dot, norm, one_batch, read, times
from cga_runtime.elements import Circle, PointPair, Sphere
from cga_runtime.elements.charts import direction_of
from cga_runtime.errors import WrongSizeError
from cga_runtime.solve.cooperative_targets import as_element
from cga_runtime.solve.ik_targets import IkTarget
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.jacobian_measures import RANK, damped_inverse, nullspace
from cga_runtime.versors import Similarity

THRESHOLD, DAMPING = 0.03, 0.03
"""Damped are, of random positions of Pandas around a table, 2 percent (point), 5 (point pair), 1 (circle), 12 (sphere)."""
OPPOSITE = 1e-9
"""Sine between a direction and the wanted one, opposite to it, below which the way is about e1."""


def resolved_rates(
    system: Cooperative,
    q: ArrayLike,
    twist: ArrayLike,
    secondary: ArrayLike | None = None,
    *,
    threshold: float = THRESHOLD,
    damping: float = DAMPING,
    chart: ArrayLike | None = None,
) -> Array:
    """Joint velocities (..., n) (rad/s, m/s) that move the primitive with a twist (..., 7), e12 e13 e23 e0i e1i e2i e3i.

    twist: -2 ~V V' in the primitive's own frame, in the chart that is given or the default one (see Cooperative): turns in rad/s, e0i =
    -r'/r in 1/s, and velocities of the centre in radii (of point, line and plane: metres) a second. Only the `controllable` ones count;
    the others do not move the primitive. secondary (..., n): joint velocities, of which the part is added that leaves the primitive where
    it is. threshold, damping: see above; with zero for either nothing is damped.

    Joint limits are not looked at. Singular positions raise nothing: what no joint velocity gives is left out, undamped too. Raises
    WrongSizeError, NotFiniteError, and DegenerateError where the points coincide, are collinear or coplanar, so that there is no primitive
    to be moved, or where a chart that is given has no rotor.
    """
    least, most = _size(threshold, "threshold"), _size(damping, "damping")
    jacobian = system.horizontal_jacobian(q, chart)[..., system.about.rows, :]
    wanted = read(twist, "twist", 7)[..., system.about.rows]
    one_batch("q and twist", jacobian.shape[:-2], wanted.shape[:-1])
    inverse = damped_inverse(jacobian, least, most) if least > 0.0 and most > 0.0 else np.linalg.pinv(jacobian, rcond=RANK)
    velocity = np.asarray((inverse @ wanted[..., None])[..., 0])
    if secondary is None:
        return velocity
    free = read(secondary, "secondary", system.n)
    one_batch("q, twist and secondary", velocity.shape[:-1], free.shape[:-1])
    return np.asarray(velocity + (nullspace(jacobian) @ free[..., None])[..., 0])


def twist_towards(system: Cooperative, q: ArrayLike, target: IkTarget | Similarity, chart: ArrayLike | None = None) -> Array:
    """The twist (..., 7) that would bring the primitive at q to the target in a second: twist of `resolved_rates`, in the same chart.

    target: as of inverse_kinematics, an element of the system's kind or a similarity. The direction turns by the shortest arc, log r and
    centre change evenly; times a gain k, errors fall as exp(-k t) where nothing is damped. Turns about the direction, and motions along
    lines and planes, are zero. Raises DegenerateError where the points at q span no primitive, UnknownNameError, WrongSizeError,
    NotFiniteError.
    """
    element, now = as_element(system, target), system.element(q)
    axes = Similarity(system.similarity(q, chart)).rotation().matrix()
    one_batch("q and target", axes.shape[:-2], element.batch)
    step = _turned_back(axes, element.center - now.center)
    twist = np.zeros((*step.shape[:-1], 7))
    twist[..., 4:] = step
    if isinstance(now, PointPair | Circle | Sphere) and isinstance(element, PointPair | Circle | Sphere):
        twist[..., 4:] = times(1.0 / now.radius, step)
        twist[..., 3] = -np.log(element.radius / now.radius)
    if system.about.reference is not None:
        x, y, z = np.moveaxis(_arc(system.about.reference, _turned_back(axes, direction_of(element))), -1, 0)
        twist[..., 0], twist[..., 1], twist[..., 2] = z, -y, x
    twist[..., [k for k in range(7) if k not in system.about.rows]] = 0.0
    return twist


def _turned_back(axes: Array, vector: Array) -> Array:
    """Components of vectors (..., 3) along axes (..., 3, 3), one a column."""
    return np.asarray((axes.swapaxes(-1, -2) @ vector[..., None])[..., 0])


def _arc(start: Array, end: Array) -> Array:
    """The rotation vector (..., 3) of the shortest arc between unit vectors; e1 is square to both that it may start from."""
    across, cosine = np.cross(start, end), dot(start, end)
    sine = norm(across)
    angle = np.arctan2(sine, cosine)
    clear = sine > OPPOSITE
    some = np.where((clear | (cosine > 0.0))[..., None], across, np.array([1.0, 0.0, 0.0]))
    return times(np.where(clear, angle / np.where(clear, sine, 1.0), np.where(cosine > 0.0, 1.0, angle)), some)


def _size(value: float, what: str) -> float:
    given = read(value, what)
    if given.shape != () or given < 0.0:
        raise WrongSizeError(f"{what}: {value} given, a number of at least 0 is needed")
    return float(given)
