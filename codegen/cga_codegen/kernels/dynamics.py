"""Inverse and forward dynamics of a tree: Newton-Euler, composite inertias, and the sparse factorisation of the mass matrix.

Twists and wrenches are those of paper B, section IV (corrected in spec/dynamics_and_control.md 4.1: V_i = ~M_i V_p M_i + qd_i B_i,
A_i = ~M_i A_p M_i + qdd_i B_i + (qd_i B_i) x U_i, W_i = I_i[A_i] + I_i[V_i] x V_i + sum M_c W_c ~M_c, tau_i = -<B_i W_i>_0), each in the
frame of its own body. All linear accelerations are those of points, with gravity as an acceleration of the base.
"""

from __future__ import annotations

from typing import Any

from cga_codegen.kernels.tree import Mass, Tree, exact, minus_gravity
from cga_codegen.kernels.vectors import Scalar, Vector, cross, dot, minus, plus, times

Rows = list[list[Scalar]]


def zero(x: Any) -> bool:
    """Whether a scalar is structurally zero."""
    return (isinstance(x, int | float) and x == 0) or (hasattr(x, "is_zero") and bool(x.is_zero()))


def applied(rows: Rows, x: Vector) -> list[Scalar]:
    """A matrix (rows) times a vector."""
    return [dot(row, x) for row in rows]


def _spin(w: Vector, dw: Vector) -> Rows:
    """[dw] + w w^T - |w|^2 1: the acceleration of a point r of a body relative to its origin is this times r."""
    xx, yy, zz = w[0] * w[0], w[1] * w[1], w[2] * w[2]
    xy, xz, yz = w[0] * w[1], w[0] * w[2], w[1] * w[2]
    return [
        [-(yy + zz), xy - dw[2], xz + dw[1]],
        [xy + dw[2], -(xx + zz), yz - dw[0]],
        [xz - dw[1], yz + dw[0], -(xx + yy)],
    ]


def newton_euler(tree: Tree, c: Vector, s: Vector, rates: Vector, accelerations: Vector, up: Vector) -> list[Scalar]:
    """The generalised force of each screw. rates, accelerations: of each screw; `up`: acceleration of the base that stands for gravity."""
    first = 6 if tree.floating else 0
    turning: list[Vector] = []  # angular velocity, and its rate, of each body
    angular: list[Vector] = []
    spins: list[Rows] = []
    wrenches: list[tuple[list[Scalar], list[Scalar]]] = []
    moving: list[list[Scalar]] = []
    for body in tree.bodies:
        if body.floats:  # its own acceleration is the rate of a twist: the point at its origin has w x v more
            w, dw = list(rates[3:6]), list(accelerations[3:6])
            a = plus(plus(list(accelerations[:3]), cross(w, rates[:3])), up)
        else:
            u, du = rates[first + body.number], accelerations[first + body.number]
            if body.parent >= 0:
                w, dw = body.into(turning[body.parent], c, s), body.into(angular[body.parent], c, s)
                a = body.into(plus(moving[body.parent], applied(spins[body.parent], body.origin(s))), c, s)
            else:
                w, dw, a = [0, 0, 0], [0, 0, 0], body.into(up, c, s)
            if body.slides:
                a = plus(a, [2 * (w[1] * u), -2 * (w[0] * u), du])
            else:
                dw = [dw[0] + w[1] * u, dw[1] - w[0] * u, dw[2] + du]
                w = [w[0], w[1], w[2] + u]
        spin = _spin(w, dw)
        turning.append(w)
        angular.append(dw)
        spins.append(spin)
        moving.append(a)
        wrenches.append(_inertial(Mass.of(body.inertia), a, w, spin))
    return _backward(tree, c, s, wrenches)


def _inertial(mass: Mass, a: Vector, w: Vector, spin: Rows) -> tuple[list[Scalar], list[Scalar]]:
    """Moment about the origin and force that a body's motion needs: integrals of r x (a + spin r) and of a + spin r over its mass."""
    if zero(mass.mass) and all(zero(x) for row in mass.inertia for x in row):
        return [0, 0, 0], [0, 0, 0]
    force = plus(times(mass.mass, a), applied(spin, mass.moment))
    (ixx, ixy, ixz), (_, iyy, iyz), (_, _, izz) = mass.inertia
    # second moments integral of r_i r_k: half the trace minus the inertia
    sxx, syy, szz = (exact(float(x)) for x in ((iyy + izz - ixx) / 2, (ixx + izz - iyy) / 2, (ixx + iyy - izz) / 2))
    sxy, sxz, syz = -ixy, -ixz, -iyz
    xx, yy, zz = w[0] * w[0], w[1] * w[1], w[2] * w[2]
    turn = [
        (yy - zz) * -syz + spin[2][0] * sxy + spin[2][1] * syy - spin[1][0] * sxz - spin[1][2] * szz,
        (zz - xx) * -sxz + spin[0][1] * syz + spin[0][2] * szz - spin[2][0] * sxx - spin[2][1] * sxy,
        (xx - yy) * -sxy + spin[1][0] * sxx + spin[1][2] * sxz - spin[0][1] * syy - spin[0][2] * syz,
    ]
    return plus(cross(mass.moment, a), turn), force


def _backward(tree: Tree, c: Vector, s: Vector, wrenches: list[tuple[list[Scalar], list[Scalar]]]) -> list[Scalar]:
    """From the tips to the base: the power of each body's wrench, with all it carries, on its joint's screw."""
    forces: list[list[Scalar]] = [[] for _ in tree.bodies]
    for k in range(len(tree.bodies) - 1, -1, -1):
        body, (m, f) = tree.bodies[k], wrenches[k]
        forces[k] = [*f, *m] if body.floats else [f[2] if body.slides else m[2]]
        if body.parent >= 0:
            outer = body.out(f, c, s)
            above_m, above_f = wrenches[body.parent]
            moment = plus(body.out(m, c, s), cross(body.origin(s), outer))
            wrenches[body.parent] = plus(above_m, moment), plus(above_f, outer)
    return [x for force in forces for x in force]


def _with_rotors(tree: Tree, forces: Vector, accelerations: Vector) -> list[Scalar]:
    rotors = tree.armature()
    return [f + r * a if r else f for f, r, a in zip(forces, rotors, accelerations, strict=True)]


def inverse_dynamics(tree: Tree, c: Vector, s: Vector, v: Vector, a: Vector, base: Vector | None = None) -> list[Scalar]:
    """tau = M(q) a + C(q, v) v + g(q), by recursive Newton-Euler (N m, N)."""
    accelerations = tree.rates(a)
    forces = newton_euler(tree, c, s, tree.rates(v), accelerations, minus_gravity(tree, base))
    return tree.gathered(_with_rotors(tree, forces, accelerations))


def bias(tree: Tree, c: Vector, s: Vector, v: Vector, base: Vector | None = None) -> list[Scalar]:
    """C(q, v) v + g(q): inverse dynamics without acceleration (Pinocchio's nonLinearEffects)."""
    still = [0] * len(tree.screws)
    return tree.gathered(newton_euler(tree, c, s, tree.rates(v), still, minus_gravity(tree, base)))


def gravity(tree: Tree, c: Vector, s: Vector, base: Vector | None = None) -> list[Scalar]:
    """g(q): inverse dynamics at rest."""
    still = [0] * len(tree.screws)
    return tree.gathered(newton_euler(tree, c, s, still, still, minus_gravity(tree, base)))


def _composites(tree: Tree, c: Vector, s: Vector) -> list[Mass]:
    """Of each body and all it carries: mass, first moment and inertia in its own frame."""
    found = [Mass.of(body.inertia) for body in tree.bodies]
    for k in range(len(tree.bodies) - 1, -1, -1):
        body, part = tree.bodies[k], found[k]
        if body.parent < 0:
            continue
        p, h = body.origin(s), body.out(part.moment, c, s)
        inertia = body.turned(part.inertia, c, s)
        # moved by p: I + 2 (p.h) 1 - p h^T - h p^T + m (p.p 1 - p p^T) = I + p.(h + g) 1 - p g^T - h p^T with g = h + m p
        g = plus(h, times(part.mass, p))
        trace = dot(p, plus(h, g))
        whole = found[body.parent]
        rows: Rows = [[0, 0, 0] for _ in range(3)]
        for i in range(3):
            for j in range(i, 3):
                shift = (trace if i == j else 0) - p[i] * g[j] - h[i] * p[j]
                rows[i][j] = rows[j][i] = whole.inertia[i][j] + inertia[i][j] + shift
        found[body.parent] = Mass(whole.mass + part.mass, plus(whole.moment, g), rows)
    return found


def _mass_rows(tree: Tree, c: Vector, s: Vector) -> Rows:
    """The mass matrix over the velocities, entries that vanish by structure the int 0."""
    screws = tree.screws
    of_body = {k: i for i, (k, axis) in enumerate(screws) if axis < 0}
    rows: Rows = [[0] * len(screws) for _ in screws]
    for k, (body, whole) in enumerate(zip(tree.bodies, _composites(tree, c, s), strict=True)):
        if body.floats:
            x, y, z = whole.moment
            skew = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
            for i in range(3):
                rows[i][i] = whole.mass
                for j in range(3):
                    rows[i][3 + j], rows[3 + i][j], rows[3 + i][3 + j] = -skew[i][j], skew[i][j], whole.inertia[i][j]
            continue
        h = whole.moment
        m, f = ([h[1], -h[0], 0], [0, 0, whole.mass]) if body.slides else (whole.inertia[2], [-h[1], h[0], 0])
        own = of_body[k]
        rows[own][own] = f[2] if body.slides else m[2]
        at = k
        while tree.bodies[at].parent >= 0:
            joint = tree.bodies[at]
            f = joint.out(f, c, s)
            m = plus(joint.out(m, c, s), cross(joint.origin(s), f))
            at = joint.parent
            above = tree.bodies[at]
            if above.floats:
                for i, x in enumerate([*f, *m]):
                    rows[i][own] = rows[own][i] = x
            else:
                rows[of_body[at]][own] = rows[own][of_body[at]] = f[2] if above.slides else m[2]
    for i, rotor in enumerate(tree.armature()):
        rows[i][i] = rows[i][i] + rotor if rotor else rows[i][i]
    n = tree.coordinates.nv
    if all(ratio == 1.0 for _, ratio in tree.coordinates.columns) and len(screws) == n:
        return rows
    entries = tree.gathered_matrix(rows)
    return [[entries[n * max(i, k) + min(i, k)] for k in range(n)] for i in range(n)]  # sums of one half: symmetric to the last bit


def mass_matrix(tree: Tree, c: Vector, s: Vector) -> list[Scalar]:
    """M(q), symmetric, n x n, rotors included, by composite inertias."""
    return [x for row in _mass_rows(tree, c, s) for x in row]


def solved(rows: Rows, right: Vector) -> list[Scalar]:
    """M x = right by M = L^T D L, from the tips to the base: entries of branches that do not carry each other stay zero."""
    n = len(right)
    low = [list(row) for row in rows]
    inverse: list[Scalar] = [0] * n
    for k in range(n - 1, -1, -1):
        inverse[k] = 1.0 / low[k][k]
        for i in (i for i in range(k) if not zero(low[k][i])):
            factor = low[k][i] * inverse[k]
            for j in (j for j in range(i + 1) if not zero(low[k][j])):
                low[i][j] = low[i][j] - low[k][j] * factor
        for i in range(k):
            if not zero(low[k][i]):
                low[k][i] = low[k][i] * inverse[k]
    x = list(right)
    for k in range(n - 1, -1, -1):
        for i in (i for i in range(k) if not zero(low[k][i])):
            x[i] = x[i] - low[k][i] * x[k]
    x = [value * scale for value, scale in zip(x, inverse, strict=True)]
    for k in range(n):
        for i in (i for i in range(k) if not zero(low[k][i])):
            x[k] = x[k] - low[k][i] * x[i]
    return x


def forward_dynamics(tree: Tree, c: Vector, s: Vector, v: Vector, tau: Vector, base: Vector | None = None) -> list[Scalar]:
    """a = M^-1 (tau - C v - g), by the sparse factorisation of the mass matrix (see articulated.py for the other way)."""
    return solved(_mass_rows(tree, c, s), minus(list(tau), bias(tree, c, s, v, base)))
