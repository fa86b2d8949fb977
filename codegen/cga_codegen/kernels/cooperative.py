"""One system of several chains as one kernel: from joint positions straight to the cooperative primitive, its similarity and Jacobians.

The same formulas as over points (primitives, similarity), with the points and their Jacobians of the chains in place of free points, so
that a call costs one pass and joints that chains share are walked once (paper A, section 3.1, the function f from q to S).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import casadi

from cga_codegen.kernels import primitives, similarity
from cga_codegen.kernels.kinematics import jacobian_derivative_local_world_aligned
from cga_codegen.kernels.primitives import Kind
from cga_codegen.kernels.vectors import Scalar, Vector
from cga_codegen.kernels.walk import gather, outward
from cga_codegen.robots.model import Chain, ModelError

Motion = tuple[int, float, bool]
_LINEAR = 3
"""The rows of a chain's Jacobian that are velocities come first."""


@dataclass(frozen=True)
class Team:
    """Chains with a common world, and where each of their coordinates stands among the n coordinates of the system.

    index: for each chain the system's coordinate of each of its own; shared coordinates occur in several chains. names, kinds: one a
    coordinate of the system. Raises ModelError for a floating base, and where the number of chains is not that of the primitive's points.
    """

    name: str
    kind: Kind
    chains: tuple[Chain, ...]
    index: tuple[tuple[int, ...], ...]
    names: tuple[str, ...]
    kinds: tuple[str, ...]

    def __post_init__(self) -> None:
        if len(self.chains) != self.kind.count:
            raise ModelError(f"{self.name}: a {self.kind.name} needs {self.kind.count} chains, {len(self.chains)} given")
        for chain in self.chains:
            if chain.coordinates.floating:
                raise ModelError(f"{self.name}: the base of {chain.name} floats")

    @property
    def robot(self) -> str:
        """Names of the robots, each once."""
        return "_".join(dict.fromkeys(chain.robot for chain in self.chains))

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """The joints of all chains, those that several share once: coordinate, ratio, whether it slides."""
        return tuple(dict.fromkeys(motion for chain in self._motions for motion in chain))

    @cached_property
    def _motions(self) -> list[list[Motion]]:
        pairs = zip(self.chains, self.index, strict=True)
        return [[(places[k], ratio, slides) for k, ratio, slides in chain.coordinates.motions] for chain, places in pairs]

    def own(self, chain: int, values: Vector) -> list[Scalar]:
        """Entries of one chain's joints among those of all joints."""
        return [values[self.motions.index(motion)] for motion in self._motions[chain]]

    def points(self, c: Vector, s: Vector) -> list[Scalar]:
        """End points (m), row-major."""
        return [x for k, chain in enumerate(self.chains) for x in outward(chain, self.own(k, c), self.own(k, s)).position]

    def point_columns(self, c: Vector, s: Vector) -> list[list[Scalar]]:
        """For each coordinate of the system the derivative of all points."""
        columns: list[list[Scalar]] = [[0] * (3 * len(self.chains)) for _ in self.names]
        for k, chain in enumerate(self.chains):
            screws = gather(chain.coordinates, outward(chain, self.own(k, c), self.own(k, s)).screws_at_end())
            for place, screw in zip(self.index[k], screws, strict=True):
                columns[place][3 * k : 3 * k + 3] = screw.v
        return columns

    def point_column_rates(self, c: Vector, s: Vector, v: Vector) -> list[list[Scalar]]:
        """Time derivative of `point_columns`."""
        columns: list[list[Scalar]] = [[0] * (3 * len(self.chains)) for _ in self.names]
        for k, chain in enumerate(self.chains):
            own = [v[place] for place in self.index[k]]
            rates = jacobian_derivative_local_world_aligned(chain, self.own(k, c), self.own(k, s), own)
            n = len(own)
            for j, place in enumerate(self.index[k]):
                columns[place][3 * k : 3 * k + 3] = [rates[i * n + j] for i in range(_LINEAR)]
        return columns


def _times(rows: Sequence[Scalar], height: int, column: Vector) -> list[Scalar]:
    """A row-major matrix of `height` rows times a column; products with the int 0 are left out."""
    width = len(rows) // height
    values = []
    for i in range(height):
        total: Scalar = 0
        for j, x in enumerate(column):
            if not (isinstance(x, int) and x == 0):
                total = total + rows[i * width + j] * x
        values.append(total)
    return values


def points(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """End points of the chains (m), one a row."""
    return team.points(c, s)


def point_jacobian(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of the points, those of the first chain first, by the coordinates of the system."""
    return primitives.by_rows(team.point_columns(c, s))


def primitive(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """The cooperative primitive, not normalised (paper A, eq. 14)."""
    return primitives.primitive(team.kind, team.points(c, s))


def primitive_jacobian(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of the primitive by q (paper A, eqs. 15-17)."""
    return _by_q(team, primitives.primitive_jacobian(team.kind, team.points(c, s)), c, s)


def similarity_versor(team: Team, c: Vector, s: Vector, chart: Vector) -> list[Scalar]:
    """The cooperative similarity (paper A, eq. 28)."""
    return similarity.similarity(team.kind, team.points(c, s), chart)


def parts(team: Team, c: Vector, s: Vector, chart: Vector) -> list[Scalar]:
    """Rotor, centre and radius of the cooperative similarity."""
    return similarity.parts(team.kind, team.points(c, s), chart)


def analytic_jacobian(team: Team, c: Vector, s: Vector, chart: Vector) -> list[Scalar]:
    """Derivative of the similarity by q (paper A, eq. 29)."""
    return _by_q(team, similarity.analytic_jacobian(team.kind, team.points(c, s), chart), c, s)


def geometric_jacobian(team: Team, c: Vector, s: Vector, chart: Vector) -> list[Scalar]:
    """Body Jacobian -2 ~V dV/dq (paper A, eq. 30)."""
    return _by_q(team, similarity.geometric_jacobian(team.kind, team.points(c, s), chart), c, s)


def horizontal_jacobian(team: Team, c: Vector, s: Vector, chart: Vector) -> list[Scalar]:
    """Body Jacobian without motions that leave the primitive where it is."""
    return _by_q(team, similarity.horizontal_jacobian(team.kind, team.points(c, s), chart), c, s)


def geometric_jacobian_derivative(team: Team, c: Vector, s: Vector, v: Vector, chart: Vector) -> list[Scalar]:
    """Time derivative of `geometric_jacobian` along q' = v."""
    return _rate(team, similarity.geometric_jacobian, similarity.geometric_jacobian_derivative, c, s, v, chart)


def horizontal_jacobian_derivative(team: Team, c: Vector, s: Vector, v: Vector, chart: Vector) -> list[Scalar]:
    """Time derivative of `horizontal_jacobian` along q' = v."""
    return _rate(team, similarity.horizontal_jacobian, similarity.horizontal_jacobian_derivative, c, s, v, chart)


def degeneracy(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """How far the primitive is from degenerate."""
    return primitives.degeneracy(team.kind, team.points(c, s))


def guard(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """What is looked at before the rest is trusted, see primitives.guard."""
    return primitives.guard(team.kind, team.points(c, s))


def degeneracy_gradient(team: Team, c: Vector, s: Vector) -> list[Scalar]:
    """Derivative of `degeneracy` by q."""
    return _by_q(team, _at_points(team, primitives.degeneracy_gradient, team.points(c, s)), c, s, height=1)


def _by_q(team: Team, by_points: Sequence[Scalar], c: Vector, s: Vector, height: int = 0) -> list[Scalar]:
    rows = height or len(by_points) // (3 * team.kind.count)
    return primitives.by_rows([_times(by_points, rows, column) for column in team.point_columns(c, s)])


def _at_points(team: Team, formula: Callable[..., list[Scalar]], *values: Vector) -> list[Scalar]:
    """A formula that differentiates by its points, at expressions: built over symbols and evaluated there."""
    symbols = [casadi.SX.sym(f"x{k}", len(value)) for k, value in enumerate(values)]
    entries = casadi.vertcat(*[casadi.SX(x) for x in formula(team.kind, *[symbol.elements() for symbol in symbols])])
    made = casadi.Function("formula", symbols, [casadi.densify(entries)])
    found: list[Scalar] = casadi.SX(made(*[casadi.vertcat(*[casadi.SX(x) for x in value]) for value in values])).elements()
    return found


def _rate(
    team: Team,
    value: Callable[..., list[Scalar]],
    derivative: Callable[..., list[Scalar]],
    c: Vector,
    s: Vector,
    v: Vector,
    chart: Vector,
) -> list[Scalar]:
    """d/dt (J_x J_P) = J_x' J_P + J_x J_P'."""
    x, columns, rates = team.points(c, s), team.point_columns(c, s), team.point_column_rates(c, s, v)
    height = 7
    velocities = _times(primitives.by_rows(columns), len(x), v)
    by_points, moving = value(team.kind, x, chart), _at_points(team, derivative, x, chart, velocities)
    return primitives.by_rows(
        [
            [a + b for a, b in zip(_times(moving, height, column), _times(by_points, height, rate), strict=True)]
            for column, rate in zip(columns, rates, strict=True)
        ]
    )
