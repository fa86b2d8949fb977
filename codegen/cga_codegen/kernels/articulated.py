"""Forward dynamics by articulated bodies: linear in the number of joints, and cheaper than the mass matrix on long chains.

The articulated inertia of a body gives the wrench (m, f) that its motion (dw, a) needs while everything it carries moves freely:
m = J dw + H a, f = H^T dw + M a, about the body's origin in its own axes.
"""

from __future__ import annotations

from dataclasses import dataclass

from cga_codegen.kernels.dynamics import applied, solved
from cga_codegen.kernels.tree import Body, Mass, Tree, minus_gravity
from cga_codegen.kernels.vectors import Scalar, Vector, cross, dot, plus, times

Rows = list[list[Scalar]]


@dataclass(frozen=True)
class Articulated:
    """J, H, M as rows, and the bias wrench (m, f)."""

    j: Rows
    h: Rows
    m: Rows
    bias_m: list[Scalar]
    bias_f: list[Scalar]


def _sum(a: Rows, b: Rows) -> Rows:
    return [plus(x, y) for x, y in zip(a, b, strict=True)]


def _rotated(rows: Rows, body: Body, c: Vector, s: Vector) -> Rows:
    """R A R^T for any A, from the body's axes to its parent's."""
    left = [body.out([rows[i][k] for i in range(3)], c, s) for k in range(3)]  # columns of R A
    return [body.out([left[k][i] for k in range(3)], c, s) for i in range(3)]


def _skew(p: Vector, rows: Rows) -> Rows:
    """[p] A, column by column."""
    columns = [cross(p, [rows[i][k] for i in range(3)]) for k in range(3)]
    return [[columns[k][i] for k in range(3)] for i in range(3)]


def _transposed(rows: Rows) -> Rows:
    return [[rows[k][i] for k in range(3)] for i in range(3)]


def _of(mass: Mass, w: Vector, v: Vector) -> Articulated:
    """A body by itself, moving with the twist (w, v): its bias is V x* (I V)."""
    x, y, z = mass.moment
    spin = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    angular = plus(applied(mass.inertia, w), cross(mass.moment, v))
    linear = plus(times(mass.mass, v), cross(w, mass.moment))
    bias_m = plus(cross(w, angular), cross(v, linear))
    return Articulated(mass.inertia, spin, [[mass.mass if i == k else 0 for k in range(3)] for i in range(3)], bias_m, cross(w, linear))


def _seen_from_parent(a: Articulated, body: Body, c: Vector, s: Vector) -> Articulated:
    """The same body in its parent's axes and about its parent's origin."""
    p = body.origin(s)
    h, m = _rotated(a.h, body, c, s), body.turned(a.m, c, s)
    h_moved = _sum(h, _skew(p, m))  # H + [p] M
    turned = _skew(p, _transposed(h))  # H [p] is the negative transpose of [p] H^T
    j = _sum(_sum(body.turned(a.j, c, s), _transposed(turned)), _skew(p, _transposed(h_moved)))
    f = body.out(a.bias_f, c, s)
    return Articulated(j, h_moved, m, plus(body.out(a.bias_m, c, s), cross(p, f)), f)


def _together(a: Articulated, b: Articulated) -> Articulated:
    bias_m, bias_f = plus(a.bias_m, b.bias_m), plus(a.bias_f, b.bias_f)
    return Articulated(_sum(a.j, b.j), _sum(a.h, b.h), _sum(a.m, b.m), bias_m, bias_f)


def forward_dynamics(tree: Tree, c: Vector, s: Vector, v: Vector, tau: Vector, base: Vector | None = None) -> list[Scalar]:
    """a = M^-1 (tau - C v - g), by articulated bodies. For trees without mimicking joints."""
    first, rotors = (6 if tree.floating else 0), tree.armature()
    twists: list[tuple[Vector, Vector]] = []
    coriolis: list[tuple[list[Scalar], list[Scalar]]] = []
    bodies: list[Articulated] = []
    for body in tree.bodies:
        if body.floats:
            w, u = [v[k] for k in range(3, 6)], [v[k] for k in range(3)]
            coriolis.append(([0, 0, 0], [0, 0, 0]))
        else:
            w, u = [0, 0, 0], [0, 0, 0]
            if body.parent >= 0:
                above_w, above_v = twists[body.parent]
                w, u = body.into(above_w, c, s), body.into(plus(above_v, cross(above_w, body.origin(s))), c, s)
            rate = v[first + body.number]
            if body.slides:
                u = [u[0], u[1], u[2] + rate]
                coriolis.append(([0, 0, 0], [w[1] * rate, -(w[0] * rate), 0]))
            else:
                w = [w[0], w[1], w[2] + rate]
                coriolis.append(([w[1] * rate, -(w[0] * rate), 0], [u[1] * rate, -(u[0] * rate), 0]))
        twists.append((w, u))
        bodies.append(_of(Mass.of(body.inertia), w, u))
    gains: list[tuple[list[Scalar], list[Scalar], Scalar, Scalar]] = [([], [], 0, 0) for _ in tree.bodies]
    for k in range(len(tree.bodies) - 1, -1, -1):
        body, a = tree.bodies[k], bodies[k]
        if body.floats:
            continue
        along_m, along_f = ([row[2] for row in a.h], [row[2] for row in a.m]) if body.slides else ([r[2] for r in a.j], list(a.h[2]))
        d = (along_f[2] if body.slides else along_m[2]) + rotors[first + body.number]
        u = tau[first + body.number] - (a.bias_f[2] if body.slides else a.bias_m[2])
        inverse = 1.0 / d
        gains[k] = along_m, along_f, inverse, u
        if body.parent < 0:
            continue
        over_m, over_f = times(inverse, along_m), times(inverse, along_f)
        j = [[a.j[i][n] - over_m[i] * along_m[n] for n in range(3)] for i in range(3)]
        h = [[a.h[i][n] - over_m[i] * along_f[n] for n in range(3)] for i in range(3)]
        m = [[a.m[i][n] - over_f[i] * along_f[n] for n in range(3)] for i in range(3)]
        cw, cv = coriolis[k]
        bias_m = plus(plus(a.bias_m, plus(applied(j, cw), applied(h, cv))), times(u, over_m))
        bias_f = plus(plus(a.bias_f, plus(applied(_transposed(h), cw), applied(m, cv))), times(u, over_f))
        part = _seen_from_parent(Articulated(j, h, m, bias_m, bias_f), body, c, s)
        whole = bodies[body.parent]
        bodies[body.parent] = _together(whole, part)
    return _outward(tree, c, s, tau, bodies, gains, coriolis, minus_gravity(tree, base))


def _outward(
    tree: Tree,
    c: Vector,
    s: Vector,
    tau: Vector,
    bodies: list[Articulated],
    gains: list[tuple[list[Scalar], list[Scalar], Scalar, Scalar]],
    coriolis: list[tuple[list[Scalar], list[Scalar]]],
    up: Vector,
) -> list[Scalar]:
    """From the base to the tips: accelerations of the joints."""
    found: list[Scalar] = []
    motions: list[tuple[list[Scalar], list[Scalar]]] = []
    for k, body in enumerate(tree.bodies):
        if body.floats:
            a = bodies[k]
            rows = [[*a.m[i], *(a.h[n][i] for n in range(3))] for i in range(3)] + [[*a.h[i], *a.j[i]] for i in range(3)]
            motion = solved(rows, [tau[i] - x for i, x in enumerate([*a.bias_f, *a.bias_m])])
            found += [x - g for x, g in zip(motion[:3], up, strict=True)] + motion[3:]
            motions.append((motion[3:], motion[:3]))
            continue
        dw, a_lin = (motions[body.parent] if body.parent >= 0 else ([0, 0, 0], list(up)))
        cw, cv = coriolis[k]
        a_lin = plus(body.into(plus(a_lin, cross(dw, body.origin(s))), c, s), cv)
        dw = plus(body.into(dw, c, s), cw)
        along_m, along_f, inverse, u = gains[k]
        acceleration = inverse * (u - dot(along_m, dw) - dot(along_f, a_lin))
        found.append(acceleration)
        if body.slides:
            a_lin = [a_lin[0], a_lin[1], a_lin[2] + acceleration]
        else:
            dw = [dw[0], dw[1], dw[2] + acceleration]
        motions.append((dw, a_lin))
    return found
