"""The Coriolis matrix, and the derivatives of inverse dynamics: twists and wrenches in base axes, composite inertias by plain sums.

All is seen from the robot's base (a floating one: from the moving base, since only gravity knows how it stands). With S_j the screws,
V_j the twist and A_j the acceleration of the body behind joint j, p its parent, I, h, F the inertia, momentum and force of j and all it
carries, b the matrix of dI/dt + (.) x* h (twice the body Coriolis matrix, which gives the symbols of Christoffel), and

    dS_j = V_j x S_j,   P_j = V_p x S_j,   Q_j = A_p x S_j + V_p x P_j,

for j at or above i, with I, h, F, b of i:

    C_ji = S_j.(I dS_i + b S_i / 2),                C_ij = dS_j.(I S_i) + S_j.(b^T S_i / 2)
    dtau_i/dq_j = (b^T S_i).P_j + (I S_i).Q_j,      dtau_j/dq_i = S_j.(b P_i + I Q_i + S_i x* F)
    dtau_i/dv_j = (b^T S_i).S_j + (I S_i).(P_j + dS_j),   dtau_j/dv_i = S_j.(b S_i + I (P_i + dS_i))
"""

from __future__ import annotations

from dataclasses import dataclass

from cga_codegen.kernels.axes import STANDING, Pose
from cga_codegen.kernels.dynamics import applied
from cga_codegen.kernels.screws import Screw, add, scale
from cga_codegen.kernels.tree import Mass, Tree, minus_gravity
from cga_codegen.kernels.vectors import Scalar, Vector, combine, cross, dot, plus, times

Rows = list[list[Scalar]]
_ZERO = Screw([0, 0, 0], [0, 0, 0])


@dataclass(frozen=True)
class Wrench:
    """Moment about the origin, and force."""

    m: list[Scalar]
    f: list[Scalar]

    def __add__(self, other: Wrench) -> Wrench:
        return Wrench(plus(self.m, other.m), plus(self.f, other.f))

    def __sub__(self, other: Wrench) -> Wrench:
        return self + Wrench(times(-1, other.m), times(-1, other.f))

    def power(self, twist: Screw) -> Scalar:
        """w.m + v.f."""
        return dot(twist.w, self.m) + dot(twist.v, self.f)


def _carried(twist: Screw, wrench: Wrench) -> Wrench:
    """V x* W: the rate of a wrench that moves with the twist."""
    return Wrench(plus(cross(twist.w, wrench.m), cross(twist.v, wrench.f)), cross(twist.w, wrench.f))


def _momentum(mass: Mass, twist: Screw) -> Wrench:
    """I V: angular momentum about the origin, and linear."""
    angular = plus(applied(mass.inertia, twist.w), cross(mass.moment, twist.v))
    return Wrench(angular, plus(times(mass.mass, twist.v), cross(twist.w, mass.moment)))


def _added(a: Mass, b: Mass) -> Mass:
    inertia = [plus(x, y) for x, y in zip(a.inertia, b.inertia, strict=True)]
    return Mass(a.mass + b.mass, plus(a.moment, b.moment), inertia)


def _in_base_axes(mass: Mass, pose: Pose) -> Mass:
    """A body's constants turned and moved to the base."""
    turned = [combine(pose.columns, row) for row in mass.inertia]  # rows of I R^T, since I is symmetric
    rotated = [combine(pose.columns, [row[i] for row in turned]) for i in range(3)]
    h, p = combine(pose.columns, mass.moment), pose.origin
    g = plus(h, times(mass.mass, p))
    trace = dot(p, plus(h, g))
    rows: Rows = [[0, 0, 0] for _ in range(3)]
    for i in range(3):
        for k in range(i, 3):
            rows[i][k] = rows[k][i] = rotated[i][k] + (trace if i == k else 0) - p[i] * g[k] - h[i] * p[k]
    return Mass(mass.mass, g, rows)


def _rate(mass: Mass, twist: Screw) -> Mass:
    """dI/dt of a body that moves with the twist: of its first moment m v + w x h, and of its inertia about the fixed origin."""
    w, v, h = twist.w, twist.v, mass.moment
    turned = [cross(w, row) for row in mass.inertia]  # [w] I by columns; dI/dt = [w] I + its transpose + 2 (h.v) 1 - h v^T - v h^T
    trace = 2 * dot(h, v)
    rows: Rows = [[0, 0, 0] for _ in range(3)]
    for i in range(3):
        for k in range(i, 3):
            rows[i][k] = rows[k][i] = turned[k][i] + turned[i][k] + (trace if i == k else 0) - h[i] * v[k] - v[i] * h[k]
    return Mass(0, plus(times(mass.mass, v), cross(w, h)), rows)


@dataclass
class _State:
    """The tree at (q, v, a), by body: screws of each, twists, accelerations, and composites of it and all it carries."""

    screws: list[list[Screw]]
    twists: list[Screw]
    accelerations: list[Screw]
    inertia: list[Mass]
    rate: list[Mass]
    momentum: list[Wrench]
    force: list[Wrench]

    def b(self, k: int, screw: Screw) -> Wrench:
        """b S = (dI/dt) S + S x* h."""
        return _momentum(self.rate[k], screw) + _carried(screw, self.momentum[k])

    def b_transposed(self, k: int, screw: Screw) -> Wrench:
        """b^T S."""
        return _momentum(self.rate[k], screw) - _carried(screw, self.momentum[k])


def _state(tree: Tree, c: Vector, s: Vector, v: Vector, a: Vector | None = None, base: Vector | None = None) -> _State:
    rates, accelerations = tree.rates(v), tree.rates(a) if a is not None else [0] * len(tree.screws)
    at: list[Pose] = []
    found = _State([], [], [], [], [], [], [])
    ground = Screw([0, 0, 0], minus_gravity(tree, base) if a is not None else [0, 0, 0])
    number = 0
    for body in tree.bodies:
        pose = (at[body.parent] if body.parent >= 0 else STANDING).place(body.placement) if not body.floats else STANDING
        if not body.floats:
            pose = pose.slide(s[body.number]) if body.slides else pose.turn(c[body.number], s[body.number])
        at.append(pose)
        axis = pose.columns[2]
        screws = [Screw([0, 0, 0], axis) if body.slides else Screw(axis, cross(pose.origin, axis))]
        if body.floats:
            unit = STANDING.columns
            screws = [Screw([0, 0, 0], e) for e in unit] + [Screw(e, [0, 0, 0]) for e in unit]
        twist, motion = (found.twists[body.parent], found.accelerations[body.parent]) if body.parent >= 0 else (_ZERO, ground)
        own, change = _ZERO, _ZERO
        for screw in screws:
            own, change = add(own, scale(rates[number], screw)), add(change, scale(accelerations[number], screw))
            number += 1
        twist = add(twist, own)
        motion = add(add(motion, change), twist.bracket(own))
        mass = _in_base_axes(Mass.of(body.inertia), pose)
        momentum = _momentum(mass, twist)
        found.screws.append(screws)
        found.twists.append(twist)
        found.accelerations.append(motion)
        found.inertia.append(mass)
        found.rate.append(_rate(mass, twist))
        found.momentum.append(momentum)
        found.force.append(_momentum(mass, motion) + _carried(twist, momentum))
    for k in range(len(tree.bodies) - 1, -1, -1):
        p = tree.bodies[k].parent
        if p >= 0:
            found.inertia[p] = _added(found.inertia[p], found.inertia[k])
            found.rate[p] = _added(found.rate[p], found.rate[k])
            found.momentum[p] = found.momentum[p] + found.momentum[k]
            found.force[p] = found.force[p] + found.force[k]
    return found


def _numbers(tree: Tree) -> list[list[int]]:
    """Of each body the numbers of its screws."""
    numbers: list[list[int]] = [[] for _ in tree.bodies]
    for i, (k, _) in enumerate(tree.screws):
        numbers[k].append(i)
    return numbers


def coriolis(tree: Tree, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """C(q, v), n x n, by Christoffel's symbols: C v is the Coriolis force, and dM/dt - 2 C is skew."""
    state = _state(tree, c, s, v)
    numbers, count = _numbers(tree), len(tree.screws)
    rows: Rows = [[0] * count for _ in range(count)]
    dots = [[twist.bracket(screw) for screw in screws] for screws, twist in zip(state.screws, state.twists, strict=True)]
    for j in range(len(tree.bodies)):
        for nj, screw, dot_screw in zip(numbers[j], state.screws[j], dots[j], strict=True):
            half = scale(0.5, screw)
            first = _momentum(state.inertia[j], dot_screw) + state.b(j, half)
            second, third = _momentum(state.inertia[j], screw), state.b_transposed(j, half)
            for i in tree.above[j]:
                for ni, other, dot_other in zip(numbers[i], state.screws[i], dots[i], strict=True):
                    rows[ni][nj] = first.power(other)
                    if i != j:
                        rows[nj][ni] = second.power(dot_other) + third.power(other)
    return tree.gathered_matrix(rows)


def inverse_dynamics_by_q(tree: Tree, c: Vector, s: Vector, v: Vector, a: Vector, base: Vector | None = None) -> list[Scalar]:
    """Derivative of inverse dynamics by q, n x n; of a floating base by motions in its own axes, as in Pinocchio."""
    state = _state(tree, c, s, v, a, base)
    numbers, count = _numbers(tree), len(tree.screws)
    rows: Rows = [[0] * count for _ in range(count)]
    ground = Screw([0, 0, 0], minus_gravity(tree, base))
    first: list[list[Screw]] = []
    second: list[list[Screw]] = []
    for body, screws in zip(tree.bodies, state.screws, strict=True):
        twist, motion = (state.twists[body.parent], state.accelerations[body.parent]) if body.parent >= 0 else (_ZERO, ground)
        first.append([twist.bracket(screw) for screw in screws])
        second.append([add(motion.bracket(screw), twist.bracket(p)) for screw, p in zip(screws, first[-1], strict=True)])
    for i in range(len(tree.bodies)):
        for ni, screw, p, q in zip(numbers[i], state.screws[i], first[i], second[i], strict=True):
            inertial, cross_part = _momentum(state.inertia[i], screw), state.b_transposed(i, screw)
            own = state.b(i, p) + _momentum(state.inertia[i], q) + _carried(screw, state.force[i])
            for j in tree.above[i]:
                for nj, other, pj, qj in zip(numbers[j], state.screws[j], first[j], second[j], strict=True):
                    rows[ni][nj] = cross_part.power(pj) + inertial.power(qj)
                    if i != j:
                        rows[nj][ni] = own.power(other)
    return tree.gathered_matrix(rows)


def inverse_dynamics_by_v(tree: Tree, c: Vector, s: Vector, v: Vector) -> list[Scalar]:
    """Derivative of inverse dynamics by v, n x n (it depends on neither accelerations nor gravity)."""
    state = _state(tree, c, s, v)
    numbers, count = _numbers(tree), len(tree.screws)
    rows: Rows = [[0] * count for _ in range(count)]
    sums: list[list[Screw]] = []
    for body, screws, twist in zip(tree.bodies, state.screws, state.twists, strict=True):
        above = state.twists[body.parent] if body.parent >= 0 else _ZERO
        sums.append([add(above.bracket(screw), twist.bracket(screw)) for screw in screws])
    for i in range(len(tree.bodies)):
        for ni, screw, change in zip(numbers[i], state.screws[i], sums[i], strict=True):
            inertial, cross_part = _momentum(state.inertia[i], screw), state.b_transposed(i, screw)
            own = state.b(i, screw) + _momentum(state.inertia[i], change)
            for j in tree.above[i]:
                for nj, other, change_j in zip(numbers[j], state.screws[j], sums[j], strict=True):
                    rows[ni][nj] = cross_part.power(other) + inertial.power(change_j)
                    if i != j:
                        rows[nj][ni] = own.power(other)
    return tree.gathered_matrix(rows)
