"""Paper A, eqs. (14)-(17), (28)-(31), (44), (47): the generated kernels and the class against the oracle file, from points and from q.

The file allows 1e-9 of the largest entry of each array. Its chains become robots, so that all of q -> error Jacobian is compared too,
with kernels put together and with kernels made for one system. Corrections: similarity.md, sections 5, 6 and 9.
"""

import json

import numpy as np
import pytest
from paper_a import DATA, FULL, KINDS, SIMILARITY, UNITS, cases, columns, end_points, numbers, of, stepped

import cga_runtime as cga
from cga_codegen.algebra.blade_types import BladeType
from cga_codegen.algebra.multivector import Multivector
from cga_codegen.robots.model import Frame, Joint, Placement, RobotModel, as_rotation
from cga_runtime.exp_log import BIVECTORS
from cga_runtime.spaces.cooperative_kernels import primitive_unit
from cga_runtime.spaces.primitive_kinds import PRIMITIVES
from cga_runtime.versors import Similarity

REACHED = 2e-14
"""Of the largest entry of each array, of all arrays: 9e-15 is reached by JB of spheres, of which one is 17 m wide."""
FREE = np.inf


def name_of(kind):
    """Ours of an oracle's primitive."""
    return {"pointpair": "point_pair"}.get(kind, kind)


def error(got, kind, key):
    """Largest error of each case over the largest entry of its stored array, 1 at least."""
    stored = cases(kind, key).astype(float)
    got = np.asarray(got)
    got, stored = (x.reshape(len(stored), -1) for x in (got, stored))
    assert got.shape == stored.shape
    return (np.abs(got - stored).max(axis=1) / np.maximum(1, np.abs(stored).max(axis=1))).max()


def full(type: BladeType, rows):
    """Components (..., k) as those of all 32 blades."""
    return numbers(of(type, rows), FULL)


def by_q(kind, name, chart=1.0):
    """A kernel over the oracle's points; a derivative by the points, times the complex step of the oracle's chains."""
    q = cases(kind, "q")
    points = end_points(q)
    kernel = primitive_unit(name_of(kind)).kernel(name)
    given = [points] if list(kernel.inputs) == ["points"] else [points, np.full((len(q), 1), chart)]
    value = kernel(*given)
    if not name.endswith("jacobian"):
        return value
    return value @ columns(end_points(stepped(q)).reshape(*q.shape, -1))


@pytest.mark.parametrize("kind", KINDS)
def test_kernels_over_points(kind):
    about, blades = PRIMITIVES[name_of(kind)], KINDS[kind][1]
    assert tuple(about.element.blades) == tuple(cga.Multivector(np.zeros(len(blades)), about.element.blades).blades)
    stored, points = cases(kind, "points"), end_points(cases(kind, "q"))
    assert np.abs(stored - points).max() < 1e-14
    errors = {
        "X": error(full(blades, by_q(kind, "primitive")), kind, "X"),
        "JX": error(np.swapaxes(full(blades, np.swapaxes(by_q(kind, "primitive_jacobian"), -1, -2)), -1, -2), kind, "JX"),
        "weight": error(about.weight(stored), kind, "weight"),
        "V": error(by_q(kind, "similarity"), kind, "V"),
        "JA": error(by_q(kind, "analytic_jacobian"), kind, "JA"),
        "JG": error(by_q(kind, "geometric_jacobian"), kind, "JG"),
        "JH": error(by_q(kind, "horizontal_jacobian"), kind, "JH"),
        "c": error(by_q(kind, "parts")[:, 4:7], kind, "c"),
    }
    if cases(kind, "r")[0] is not None:
        errors["r"] = error(by_q(kind, "parts")[:, 7], kind, "r")
    else:
        assert (by_q(kind, "parts")[:, 7] == 1).all()
    if cases(kind, "n")[0] is not None:
        carried = cga.Rotor(by_q(kind, "parts")[:, :4]).matrix() @ about.reference
        errors["R a"] = error(carried, kind, "n")
    assert max(errors.values()) < REACHED, errors


@pytest.mark.parametrize("kind", KINDS)
def test_the_rows_of_the_file_are_ours(kind):
    assert PRIMITIVES[name_of(kind)].controllable == tuple(DATA["controllable"][kind])
    assert BIVECTORS["similarity"] == tuple(DATA["schema"]["b7"]) and Similarity.blades == tuple(DATA["schema"]["s12"])
    if kind in DATA["refdir"]:
        np.testing.assert_array_equal(PRIMITIVES[name_of(kind)].reference, DATA["refdir"][kind])


# ---- from q: the oracle's chains as robots


def placed(motor):
    """Placement of a motor in the file's components, by its quaternion."""
    a, z, y, x = np.array(motor[:4]) * [1, -1, 1, -1]
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - a * z), 2 * (x * z + a * y)],
            [2 * (x * y + a * z), 1 - 2 * (x * x + z * z), 2 * (y * z - a * x)],
            [2 * (x * z - a * y), 2 * (y * z + a * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    whole = Multivector(SIMILARITY, np.array([*motor[:4], 0, motor[4], motor[5], 0, motor[6], 0, 0, motor[7]]))
    moved = numbers(whole.sandwich(UNITS["point"], KINDS["point"][1]))
    return Placement(as_rotation(rotation, "oracle"), tuple(moved[1:4].tolist()))


def robot(k):
    """The k-th chain of the file as a robot: base, fixed motor, joint, fixed motor, joint, ..., tool."""
    chain = DATA["chains"][k]
    joints = []
    for j, (fixed, axis, kind) in enumerate(zip(chain["fixed"], chain["axis"], chain["kind"], strict=True)):
        at = placed(chain["base"]) @ placed(fixed) if j == 0 else placed(fixed)
        joints.append(Joint(f"c{k}_{j}", kind, j - 1, at, tuple(axis), -FREE, FREE, FREE, FREE))
    model = RobotModel(f"oracle_{k}", tuple(joints), (Frame("end", 2, placed(chain["tool"])),))
    return cga.Robot(json.dumps(model.to_json(), sort_keys=True))


@pytest.fixture(scope="module")
def chains():
    return [robot(k).chain("end") for k in range(4)]


@pytest.fixture(scope="module", params=[*KINDS, "circle fused"])
def system(request, chains):
    """A primitive of the file, its system, and all its q: (cases, 3 k). One is fused: the largest that compiles in two seconds."""
    kind, *fused = request.param.split()
    made = cga.Cooperative(chains[: KINDS[kind][0]], name_of(kind))
    assert made.joint_names == tuple(f"c{k}_{j}" for k in range(KINDS[kind][0]) for j in range(3))
    made = made.fuse() if fused else made
    assert made.fused == bool(fused)
    return kind, made, cases(kind, "q")


def test_from_joint_positions(system):
    kind, cooperative, q = system
    blades, targets, chart = KINDS[kind][1], cases(kind, "Vd"), 1
    jacobian = np.swapaxes(cooperative.primitive_jacobian(q), -1, -2)
    errors = {
        "points": error(cooperative.points(q), kind, "points"),
        "X": error(full(blades, cooperative.primitive(q)), kind, "X"),
        "weight": error(cooperative.weight(q), kind, "weight"),
        "JX": error(np.swapaxes(full(blades, jacobian), -1, -2), kind, "JX"),
        "V": error(cooperative.similarity(q, chart), kind, "V"),
        "B": error(cooperative.log(q, chart), kind, "B"),
        "JA": error(cooperative.analytic_jacobian(q, chart), kind, "JA"),
        "JG": error(cooperative.geometric_jacobian(q, chart), kind, "JG"),
        "JH": error(cooperative.horizontal_jacobian(q, chart), kind, "JH"),
        "JB": error(cooperative.bivector_jacobian(q, chart), kind, "JB"),
        "err": error(cooperative.error(q, targets, chart), kind, "err"),
        "JE": error(cooperative.error_jacobian(q, targets, chart), kind, "JE"),
    }
    element = cooperative.element(q)
    errors["c"] = error(element.center, kind, "c")
    if cases(kind, "r")[0] is not None:
        errors["r"] = error(element.radius, kind, "r")
    if cases(kind, "n")[0] is not None:
        errors["n"] = error(element.normal if hasattr(element, "normal") else element.direction, kind, "n")
    assert max(errors.values()) < REACHED, errors


def test_coefficients_of_the_element_are_the_primitive_over_its_size(system):
    """X over w r, of flats over w: the element has the file's orientation; spheres are not oriented."""
    kind, cooperative, q = system
    element = cooperative.element(q)
    size = cooperative.weight(q) * (1 if cases(kind, "r")[0] is None else element.radius)
    stored = numbers(of(FULL, cases(kind, "X")).project(KINDS[kind][1])) / size[:, None]
    assert np.abs(element.coefficients - stored).max() / np.abs(stored).max() < 4e-14


def test_one_call_and_casadi_agree_with_the_file(system):
    kind, cooperative, q = system
    for name, key in (("similarity", "V"), ("log", "B"), ("bivector_jacobian", "JB"), ("horizontal_jacobian", "JH")):
        function = cooperative.casadi(name, 1)
        assert error([np.array(function(x)) for x in q], kind, key) < REACHED
    for name, key in (("error", "err"), ("error_jacobian", "JE")):
        function = cooperative.casadi(name, 1)
        assert error([np.array(function(x, v)) for x, v in zip(q, cases(kind, "Vd"), strict=True)], kind, key) < REACHED


def test_degenerate_cases_are_refused():
    """The seven cases that a library must reject, as points: the guard is below its thresholds and the element raises."""
    for case in DATA["degenerate"]:
        kind = name_of(case["kind"])
        points = np.array(case["points"])
        guard = primitive_unit(kind).kernel("guard")(points)
        assert np.isfinite(guard).all() and (guard[0] <= 1e-9 or guard[2:].min() <= 1e-18), case["what"]
        with pytest.raises(cga.DegenerateError, match="coincide|one line|one plane"):
            PRIMITIVES[kind].through(points)
