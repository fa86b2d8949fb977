"""What the tests of the comparison with pygafro share: the record, and readers of it.

The record, tests/data/pygafro_similarity.json, holds the samples of scripts/similarity_samples.py and what scripts/similarity_pygafro.py
got for them; null is what was not finite. The 50-digit logarithms are those of tests/runtime/oracles.
"""

import json
import sys
from pathlib import Path

import numpy as np

import cga_runtime as cga
from cga_runtime.multivectors import NAMES, Multivector

TESTS = Path(__file__).parents[2]
sys.path.insert(0, str(TESTS / "runtime" / "oracles"))
import exp_log_closed as closed  # noqa: E402  50 digits

RECORD = json.loads((TESTS / "data" / "pygafro_similarity.json").read_text())
SAMPLES, FOUND = RECORD["samples"], RECORD["found"]
MOVES, LOGS = FOUND["transformations"], FOUND["exponentials"]
SIGNS = {"FrankaEmikaRobot": np.ones(7), "KukaIIWA14": np.array([1, -1, 1, -1, 1, -1, 1])}
"""Of q: joints with a y axis turn the other way."""
KINDS = {"PointPair": cga.PointPair, "Line": cga.Line, "Circle": cga.Circle, "Plane": cga.Plane, "Sphere": cga.Sphere}
ORIGIN = Multivector([1.0], ["e0"])
GROUPS = {"similarity": (cga.Similarity, "versors", 7), "motor": (cga.Motor, "motors", 6), "rotor": (cga.Rotor, "rotors", 3)}


def numbers(values):
    """Recorded lists as floats, null as nan."""
    return np.array(values, dtype=float)


def of(kind, values):
    """Recorded coefficients with the recorded blades of a class of pygafro, null as zero."""
    return Multivector(np.nan_to_num(numbers(values)), [NAMES[mask] for mask in FOUND["blades"][kind]])


def full(x):
    """All 32 components, (..., 32)."""
    whole = np.zeros((*x.coefficients.shape[:-1], 32))
    whole[..., [NAMES.index(name) for name in x.blades]] = x.coefficients
    return whole


def apart(x, y):
    """Largest difference of components for each of the cases."""
    return np.abs(full(x) - full(y)).max(axis=-1)


def moved(v, x):
    """V X ~V by full products."""
    return v * x * ~v


def through(kind, points):
    """Our element through points (..., k, 3)."""
    return KINDS[kind].from_points(*np.moveaxis(numbers(points), -2, 0))


def joined(kind, points):
    return cga.join(*np.moveaxis(numbers(points), -2, 0), flat=kind in ("Line", "Plane"))


def within(values, low, high):
    """Every amount in a band around what was measured."""
    assert low < np.min(values) and np.max(values) < high, (np.min(values), np.max(values))


def key(kind):
    return kind.replace("Pair", "_pair").lower()


def exact_logs(group):
    """Logarithms of the sampled versors in 50 digits, rounded once, and their angles."""
    kind, versors, _ = GROUPS[group]
    truth = np.array([[float(x) for x in closed.log(group, v)] for v in SAMPLES[versors]])
    return truth, np.linalg.norm(truth[:, :3], axis=1)


def angles_apart(found, truth):
    """Error of the rotation part, by its own size."""
    return np.linalg.norm(found[:, :3] - truth[:, :3], axis=1) / np.linalg.norm(truth[:, :3], axis=1)


def spanned(kind, row):
    """X (blades) of the fingertips of a hand, and its derivatives (joints, blades), from the recorded motors and their derivatives."""
    motors = of("Motor", numbers(row["getFingerMotors"])[:, None])
    rates = of("Motor", row["getFingerAnalyticJacobian"])
    tips = [Multivector(x, cga.Point.blades) for x in numbers(row["getFingerPoints"])]
    moving = (rates * ORIGIN * ~motors + motors * ORIGIN * ~rates).grade(1)
    columns = []
    for finger in range(len(tips)):
        moved_tip = Multivector(full(moving)[finger][:, [NAMES.index(name) for name in cga.Point.blades]], cga.Point.blades)
        columns.append(full(cga.join(*tips[:finger], moved_tip, *tips[finger + 1 :])))
    return cga.join(*tips), Multivector(np.concatenate(columns), NAMES)
