"""Paper A, eqs. (34)-(38), (43)-(48), (58), (59), section 5.9: what is inverted, and what it costs (similarity.md, sections 7, 9 and 10).

Arrays are those of the oracle file: 3, 6, 9 or 12 coordinates, 3 for each chain. Mass matrices are random, positive definite.
"""

import casadi
import numpy as np
import pytest
from paper_a import (
    DATA,
    KINDS,
    H,
    cases,
    columns,
    end_points,
    log,
    numbers,
    of,
    parameters,
    similarity,
    span,
    stepped,
)

from cga_codegen.algebra.blade_types import MOTOR, SIMILARITY, SIMILARITY_BIVECTOR, product_table
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.algebra.signature import CGA

CONTROLLABLE = {kind: [SIMILARITY_BIVECTOR.index(CGA.mask(name)) for name in names] for kind, names in DATA["controllable"].items()}
RANKS = {"point": 3, "pointpair": 6, "line": 4, "circle": 6, "plane": 3, "sphere": 4}
REDUNDANT = [kind for kind in KINDS if kind not in ("point", "pointpair")]  # more coordinates than rank


def versor(kind, q):
    return similarity(kind, *parameters(kind, end_points(q)))


def by_case(v):
    return of(SIMILARITY, numbers(v, SIMILARITY)[:, None])


def body_jacobian(kind, q):
    """J^G (30), (cases, 7, m)."""
    rate = Multivector(SIMILARITY, [np.imag(x) / H for x in versor(kind, stepped(q)).coefficients])
    return np.swapaxes(numbers((~by_case(versor(kind, q)) * rate).scaled(-2), SIMILARITY_BIVECTOR), -1, -2)


def error(kind, q, target):
    """(44)"""
    return log(~versor(kind, q) * target)


def error_jacobian(kind, q, target):
    """(47), corrected"""
    return columns(log(~versor(kind, stepped(q)) * by_case(target)))


def pseudo_inverse(j):
    return np.linalg.pinv(j, rcond=1e-10)


def mass_matrices(rng, count, m):
    """Symmetric positive definite, eigenvalues between 0.5 and 3, kg m^2."""
    turns, _ = np.linalg.qr(rng.normal(size=(count, m, m)))
    return turns * rng.uniform(0.5, 3, (count, 1, m)) @ np.swapaxes(turns, -1, -2)


# ---- (34)-(38)


@pytest.mark.parametrize("kind", KINDS)
def test_34_dots(kind, rng):
    """(34): dV_S/dt = J q'' + J' q'; as printed, with one dot less on each q, it is off by 0.1 and more. Differences of fourth order
    in time of V_S = J q' along q + q' t + q'' t^2 / 2."""
    q = cases(kind, "q")
    rate, acceleration = rng.uniform(-1, 1, (2, *q.shape))
    step = 1e-3

    def difference(of_time):
        return (8 * (of_time(step) - of_time(-step)) - (of_time(2 * step) - of_time(-2 * step))) / (12 * step)

    def jacobian(t):
        return body_jacobian(kind, q + rate * t + acceleration * t**2 / 2)

    twist_rate = difference(lambda t: np.einsum("cij,cj->ci", jacobian(t), rate + acceleration * t))
    jacobian_rate = difference(jacobian)
    right, printed = (
        np.einsum("cij,cj->ci", jacobian(0), a) + np.einsum("cij,cj->ci", jacobian_rate, b) for a, b in ((acceleration, rate), (rate, q))
    )
    assert np.abs(twist_rate - right).max() < 1e-9 * max(1, np.abs(right).max())
    assert np.abs(twist_rate - printed).max(axis=1).min() > 0.1


@pytest.mark.parametrize("kind", KINDS)
def test_36_has_no_inverse(kind, rng):
    """(36): J M^-1 J^T is 7 x 7 of rank 3, 6, 4, 6, 3, 4: its least singular value is rounding. In the controllable
    rows of J_h it has an inverse, a positive definite inertia."""
    j = cases(kind, "JG")
    inverse_mass = np.linalg.inv(mass_matrices(rng, len(j), j.shape[2]))
    values = np.linalg.svd(j @ inverse_mass @ np.swapaxes(j, -1, -2), compute_uv=False)
    assert np.all(values[:, RANKS[kind] :] < 1e-14 * values[:, :1]) and np.all(values[:, RANKS[kind] - 1] > 1e-8 * values[:, 0])
    rows = cases(kind, "JH")[:, CONTROLLABLE[kind]]
    whole = rows @ inverse_mass @ np.swapaxes(rows, -1, -2)
    inertia = np.linalg.inv(whole)
    assert np.abs(inertia @ whole - np.eye(RANKS[kind])).max() < 1e-9 and np.linalg.eigvalsh(inertia).min() > 0


@pytest.mark.parametrize("kind", KINDS)
def test_35_to_38_in_controllable_rows(kind, rng):
    """(35): M_S V' + C_S + g_S = W for tau = J^T W, with C_S = M_S (J M^-1 C q' - J' q') (37): C has to be multiplied by q', as printed the
    sizes do not match."""
    j = cases(kind, "JH")[:, CONTROLLABLE[kind]]
    count, rows, m = j.shape
    mass = mass_matrices(rng, count, m)
    coriolis, rate, gravity, drift = (rng.normal(size=shape) for shape in ((count, m, m), (count, m), (count, m), (count, rows)))
    wrench = rng.normal(size=(count, rows))
    for case in range(count):
        jc, inverse = j[case], np.linalg.inv(mass[case])
        forces = coriolis[case] @ rate[case]
        acceleration = inverse @ (jc.T @ wrench[case] - forces - gravity[case])  # (32) with tau_ext = 0
        inertia = np.linalg.inv(jc @ inverse @ jc.T)  # (36)
        c_s = inertia @ (jc @ inverse @ forces - drift[case])  # (37), drift = J' q'
        g_s = inertia @ jc @ inverse @ gravity[case]  # (38)
        left = inertia @ (jc @ acceleration + drift[case]) + c_s + g_s
        assert np.abs(left - wrench[case]).max() < 1e-11 * np.abs(inertia).max()
        printed = jc @ inverse @ coriolis[case]
        assert printed.shape == (rows, m) and drift[case].shape == (rows,)  # not to be subtracted


# ---- (45)-(48)


@pytest.mark.parametrize("kind", KINDS)
def test_46_is_singular(kind):
    """(46): J^T J (m x m) has rank at most 3, 6, 4, 6, 3, 4: for arms of three joints an inverse exists for points and point pairs
    only. What (45) multiplies e with is J^+, m x 7, no Hessian."""
    j = cases(kind, "JE")
    values = np.linalg.svd(np.swapaxes(j, -1, -2) @ j, compute_uv=False)
    least = values[:, -1] / values[:, 0]
    assert np.all(least < 1e-14) if kind in REDUNDANT else np.all(least > 1e-10)
    if kind not in REDUNDANT:
        printed = np.linalg.inv(np.swapaxes(j, -1, -2) @ j) @ np.swapaxes(j, -1, -2)
        assert np.abs(printed - pseudo_inverse(j)).max() < 1e-9 * np.abs(printed).max()


@pytest.mark.parametrize("law", ["(45), J_e", "(48), all rows", "(48), controllable rows"])
@pytest.mark.parametrize("kind", KINDS)
def test_45_and_48_with_the_pseudo_inverse(kind, law, rng):
    """(45) with H = J_e^+ and its printed sign, and (48) with J^+ B: from up to 0.1 rad and 0.1 m off in each coordinate (spheres 0.02:
    one of them is 17 m wide, with hands nearly in a plane), eight full steps reach 1e-12 in all 11 cases."""
    q = cases(kind, "q")
    far = 0.02 if kind == "sphere" else 0.1
    target = versor(kind, q + rng.uniform(-far, far, q.shape))
    start = np.abs(error(kind, q, target)).max(axis=1)
    for _ in range(8):
        e = error(kind, q, target)
        if law == "(45), J_e":
            step = -np.einsum("cij,cj->ci", pseudo_inverse(error_jacobian(kind, q, target)), e)
        else:
            rows = CONTROLLABLE[kind] if law.endswith("controllable rows") else range(7)
            step = np.einsum("cij,cj->ci", pseudo_inverse(body_jacobian(kind, q)[:, rows]), e[:, rows])
        q = q + step
    assert np.abs(error(kind, q, target)).max() < 1e-12 and start.min() > 1e-3


# ---- (58), (59)


@pytest.mark.parametrize("kind", REDUNDANT)
def test_58_wants_the_pseudo_inverse(kind, rng):
    """(58): J is 7 x m, and J J^T is singular too: no inverse. With J^+, N is idempotent, J N = 0, its rank is m - rank J, and a step along
    it leaves X where it is: the change of X / |X| is of second order."""
    q, j = cases(kind, "q"), cases(kind, "JG")
    m = q.shape[1]
    with pytest.raises(np.linalg.LinAlgError, match="must be square"):
        np.linalg.inv(j[0])
    squared = np.linalg.svd(j @ np.swapaxes(j, -1, -2), compute_uv=False)
    assert np.all(squared[:, -1] < 1e-14 * squared[:, 0])
    n = np.eye(m) - pseudo_inverse(j) @ j
    size = np.abs(j).max()
    assert np.abs(n @ n - n).max() < 1e-12 and np.abs(j @ n).max() < 1e-12 * size
    assert np.abs(np.trace(n, axis1=1, axis2=2) - (m - RANKS[kind])).max() < 1e-12
    velocity = np.einsum("cij,cj->ci", n, rng.normal(size=q.shape))
    x, step = (span(kind, end_points(place)) for place in (q, q + 1j * H * velocity))
    size = np.sqrt(-x.scalar_product(~x))
    scale = np.imag((-step.scalar_product(~step)) ** 0.5) / H  # d |X|
    moved = numbers(step).imag / H / size[:, None] - numbers(x) * (scale / size**2)[:, None]
    assert np.abs(velocity).max(axis=1).min() > 0.1
    assert np.abs(moved).max() < 1e-11


@pytest.mark.parametrize("kind", KINDS)
def test_59_holds_and_its_inverse_does_not(kind):
    """(59), section 3.11: J J^T is 7 x 7 of rank 3 to 6, so M_S^-1, the force ellipsoid of the text, does not exist; in
    controllable rows it does."""
    j = cases(kind, "JG")
    values = np.linalg.eigvalsh(j @ np.swapaxes(j, -1, -2))
    assert np.all(np.abs(values[:, : 7 - RANKS[kind]]) < 1e-14 * values[:, -1:])
    assert np.all(values[:, 7 - RANKS[kind]] > 1e-8 * values[:, -1])
    rows = cases(kind, "JH")[:, CONTROLLABLE[kind]]
    assert np.all(np.linalg.eigvalsh(rows @ np.swapaxes(rows, -1, -2)) > 0)


# ---- section 5.9


def test_operation_counts():
    """Section 5.9: 7 and 12 components are right; a product of similarities takes 128 multiplications and 116 additions, not 112 and 100;
    of motors 48 and 40. The other rows of similarity.md, section 10, are tested with the printed products."""
    assert (len(SIMILARITY_BIVECTOR), len(SIMILARITY)) == (7, 12)
    table = product_table("geometric", SIMILARITY, SIMILARITY)
    assert (table.type, table.multiplications, table.additions) == (SIMILARITY, 128, 116)
    table = product_table("geometric", MOTOR, MOTOR)
    assert (table.type, table.multiplications, table.additions) == (MOTOR, 48, 40)


def test_operation_count_of_matrices():
    """Section 5.9: a product of two 4 x 4 poses takes 36 multiplications and 27 additions where the last rows are known, not 39 and 34."""
    known = [casadi.SX.sym(name, 3, 4) for name in "ab"]
    first, second = (casadi.vertcat(rows, casadi.DM([[0, 0, 0, 1]])) for rows in known)
    function = casadi.Function("product", known, [first @ second])
    codes = [function.instruction_id(k) for k in range(function.n_instructions())]
    assert (codes.count(casadi.OP_MUL), codes.count(casadi.OP_ADD)) == (36, 27)
