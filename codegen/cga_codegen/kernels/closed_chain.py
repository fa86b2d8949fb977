"""Two arms that hold one rigid object: closure, constraint wrenches, limb factors, actuation schemes (paper C).

Joints are numbered through, the first (right) arm before the second (left). The determinant of an actuation scheme is the bracket
(screws.py) of the six passive joints' screws; it vanishes exactly at the scheme's actuation singularities.
"""

from __future__ import annotations

from dataclasses import dataclass

from cga_codegen.algebra.blade_types import MOTOR, TWIST
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.kernels.screws import Screw
from cga_codegen.kernels.vectors import Scalar, Vector, cross, dot, minus, plus, times
from cga_codegen.kernels.versors import full_angles, motor
from cga_codegen.kernels.walk import Configuration, outward
from cga_codegen.robots.model import Chain, ModelError


@dataclass(frozen=True)
class Loop:
    """Two chains from a common root frame; `name` identifies the pair among those of a robot."""

    name: str
    right: Chain
    left: Chain

    def __post_init__(self) -> None:
        for chain in (self.right, self.left):
            for joint in chain.joints:
                if joint.follows or joint.kind == "floating":
                    what = "floats" if joint.kind == "floating" else f"mimics {joint.follows!r}"
                    raise ModelError(f"{chain.robot}: joint {joint.name!r} {what}; a closed chain needs joints that move by themselves")

    @property
    def n(self) -> int:
        """Number of joints of both arms."""
        return self.right.n + self.left.n

    def split(self, values: Vector) -> tuple[list[Scalar], list[Scalar]]:
        """Values of all joints -> those of each arm (works on symbols that only know indexing)."""
        return [values[j] for j in range(self.right.n)], [values[j] for j in range(self.right.n, self.n)]


def _configurations(loop: Loop, c: Vector, s: Vector) -> tuple[Configuration, Configuration]:
    (cr, cl), (sr, sl) = loop.split(c), loop.split(s)
    return outward(loop.right, cr, sr), outward(loop.left, cl, sl)


def _lines(loop: Loop, c: Vector, s: Vector) -> list[Screw]:
    right, left = _configurations(loop, c, s)
    return [*right.screws(), *left.screws()]


def loop_screws(loop: Loop, c: Vector, s: Vector) -> list[Scalar]:
    """World screws of all joints as bivectors, rows e12 e13 e23 e1i e2i e3i, one joint a column."""
    columns = [line.bivector() for line in _lines(loop, c, s)]
    return [column[i] for i in range(6) for column in columns]


def _motors(loop: Loop, ch: Vector, sh: Vector) -> tuple[Multivector, Multivector]:
    (cr, cl), (sr, sl) = loop.split(ch), loop.split(sh)
    return Multivector(MOTOR, motor(loop.right, cr, sr)), Multivector(MOTOR, motor(loop.left, cl, sl))


def closure_error(loop: Loop, ch: Vector, sh: Vector, grasp: Vector) -> list[Scalar]:
    """Bivector part e12 e13 e23 e1i e2i e3i of M_R X ~M_L, X the grasp motor: zero exactly when the loop is closed (the motor is +-1)."""
    right, left = _motors(loop, ch, sh)
    held = Multivector(MOTOR, [grasp[i] for i in range(8)])
    return list((right * held * ~left).project(TWIST).coefficients)


def closure_jacobian(loop: Loop, ch: Vector, sh: Vector, grasp: Vector) -> list[Scalar]:
    """Derivative of the closure error: bivector part of -1/2 S_j E (right arm) and +1/2 E S_j (left), E = M_R X ~M_L."""
    right, left = _motors(loop, ch, sh)
    held = Multivector(MOTOR, [grasp[i] for i in range(8)])
    closure = (right * held * ~left).project(MOTOR).scaled(0.5)
    (hr, hl), (gr, gl) = loop.split(ch), loop.split(sh)
    columns = []
    for screw in outward(loop.right, *full_angles(loop.right, hr, gr)).screws():
        columns.append((-(screw.multivector() * closure)).project(TWIST).coefficients)
    for screw in outward(loop.left, *full_angles(loop.left, hl, gl)).screws():
        columns.append((closure * screw.multivector()).project(TWIST).coefficients)
    return [column[i] for i in range(6) for column in columns]


def screws_pullback(loop: Loop, c: Vector, s: Vector, weights: Vector) -> list[Scalar]:
    """Gradient over q of sum_ij weights[i, j] S[i, j], S the loop's screws as bivectors (6 x n, row-major weights).

    With the cofactors of a determinant as weights it is the determinant's gradient: sum over passive j > k of the same arm of
    det(column j replaced by [S_k, S_j]) (paper C 5.2.2 made differentiable).
    """
    lines = _lines(loop, c, s)
    n = loop.n
    gradient = []
    for k in range(n):
        last = loop.right.n if k < loop.right.n else n
        total: Scalar = 0
        for j in range(k + 1, last):
            rate = lines[k].bracket(lines[j]).bivector()
            total = total + dot([weights[i * n + j] for i in range(6)], rate)
        gradient.append(total)
    return gradient


def _centres(chain: Chain) -> tuple[float, float, float] | None:
    """For an arm of a universal joint (axes 1, 2 meet in U) and a spherical one (axes 3, 4, 5 meet in S), all revolute:
    where U lies along axis 1, where S lies along axis 3 (both from the joint frame's origin), and |US|; None for any other arm.
    """
    if chain.n != 5 or any(joint.kind == "prismatic" for joint in chain.joints):
        return None
    # one pose without special alignments decides: whether two axes meet does not depend on the joint between or before them
    at = outward(chain, [0.8, 0.6, 5 / 13, 3 / 5, 0.28], [0.6, 0.8, 12 / 13, 4 / 5, 0.96])

    def meeting(i: int, j: int) -> tuple[float, float]:
        """Distance along axis i of its point nearest to axis j, and the distance between the two axes."""
        d = minus(at.points[j], at.points[i])
        normal = cross(at.axes[i], at.axes[j])
        size = dot(normal, normal)
        if size < 1e-12:
            return 0.0, float("inf")
        return dot(cross(d, at.axes[j]), normal) / size, abs(dot(d, normal)) / size**0.5

    (u, gap12), (s34, gap34), (s35, gap35) = meeting(0, 1), meeting(2, 3), meeting(2, 4)
    if max(gap12, gap34, gap35, abs(s34 - s35)) > 1e-12:
        return None
    # a centre at a joint's origin lies there exactly; the arithmetic above is plain IEEE, so the constants are the same everywhere
    u, s = (0.0 if abs(x) < 1e-15 else x for x in (u, s34))
    arm = minus(plus(at.points[2], times(s, at.axes[2])), plus(at.points[0], times(u, at.axes[0])))
    return u, s, float(dot(arm, arm)) ** 0.5


def has_wrist_centre(loop: Loop) -> bool:
    """Whether both arms are universal-spherical, as the NAO's: then the constraint wrenches and limb factors below exist."""
    return _centres(loop.right) is not None and _centres(loop.left) is not None


def _arm(chain: Chain, at: Configuration) -> tuple[list[Scalar], list[Scalar], float]:
    """U, S - U and |S - U| of a universal-spherical arm."""
    known = _centres(chain)
    assert known is not None, "the catalogue asks for these kernels only where has_wrist_centre holds"
    u, s, length = known
    base = plus(at.points[0], times(u, at.axes[0]))
    return base, minus(plus(at.points[2], times(s, at.axes[2])), base), length


def limb_factors(loop: Loop, c: Vector, s: Vector) -> list[Scalar]:
    """Per arm (right, left) the two factors of its limb singularities: f, the signed distance (m) of the S-joint from axis 1, and sin q4.

    f = s2 . ((S - U) x s1) (for the NAO r3 cos q2 + d3 sin q2), sin q4 = -det(s3, s4, s5); sqrt det(J_S^T J_S) = |f sin q4| |US|
    (paper C 5.1, completed). Both f = 0 at once is the constraint singularity (19) of arms with collinear axes 1.
    """
    factors: list[Scalar] = []
    for chain, at in zip((loop.right, loop.left), _configurations(loop, c, s), strict=True):
        _, arm, _ = _arm(chain, at)
        factors.append(dot(at.axes[1], cross(arm, at.axes[0])))
        factors.append(-dot(at.axes[2], cross(at.axes[3], at.axes[4])))
    return factors


def constraint_wrenches(loop: Loop, c: Vector, s: Vector) -> list[Scalar]:
    """Per arm (right, left) the unit pure force through U and S that no joint of the arm can work against (paper C, eq. 15).

    Rows: wrench bivectors e01 e02 e12 e03 e13 e23 = (f_x, f_y, m_z, f_z, -m_y, m_x) about the root frame's origin.
    """
    rows: list[Scalar] = []
    for chain, at in zip((loop.right, loop.left), _configurations(loop, c, s), strict=True):
        base, arm, length = _arm(chain, at)
        f = times(1.0 / length, arm)
        m = cross(base, f)
        rows += [f[0], f[1], m[2], f[2], -m[1], m[0]]
    return rows


def wrist_centres(loop: Loop, c: Vector, s: Vector) -> list[Scalar]:
    """Per arm (right, left) the centre S of its spherical joint (m) in the root frame: points A and B of paper C."""
    rows: list[Scalar] = []
    for chain, at in zip((loop.right, loop.left), _configurations(loop, c, s), strict=True):
        base, arm, _ = _arm(chain, at)
        rows += plus(base, arm)
    return rows
