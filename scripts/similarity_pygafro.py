"""Evaluates pygafro's primitives, similarities, logarithms and Jacobians at given samples, for tests/papers/test_a_pygafro.py.

Only this needs pygafro, and nobody needs to run it: what it found is kept in tests/data/pygafro_similarity.json, together with the samples.
In an environment with it:

    ./run shell python scripts/similarity_samples.py > samples.json
    python scripts/similarity_pygafro.py < samples.json > tests/data/pygafro_similarity.json

A number that is not finite is written as null; a call that is missing or fails gives null, and is listed by name under "refused".
"""

import datetime
import importlib.metadata
import json
import math
import operator
import platform
import sys
from functools import reduce

ABSENT = (
    *(f"{kind}.getSimilarityTransformation" for kind in ("Point", "PointPair", "Line", "Plane", "Sphere")),
    *(f"{kind}.getMotor" for kind in ("PointPair", "Sphere")),
    *("Hand_2_2.getFingerPointPair", "Hand_2_2.getFingerLine", "Hand_2_2_2.getFingerPlane"),
    *("CooperativeTaskSpace", "DualManipulator", "Dilator"),
)
"""Names asked for to learn whether they exist."""
FINGERS = ("fingertip_center_joint", "fingertip_2_center_joint", "fingertip_3_center_joint", "thumb_center_joint")
"""Chains of the LEAP hand, as pygafro names them: index, middle, ring, thumb."""
HANDS = {
    "Hand_4_4": ((0, 3), ("getMeanMotor", "getMeanMotorAnalyticJacobian", "getMeanMotorGeometricJacobian")),
    "Hand_4_4_4": ((0, 1, 3), ("getFingerPoints", "getFingerCircle", "getFingerCircleJacobian")),
    "Hand_4_4_4_4": ((0, 1, 2, 3), ("getFingerPoints", "getFingerSphere", "getFingerSphereJacobian")),
}
"""Which fingers of that hand make a hand of two, three and four, and what is asked of it."""


def plain(found):
    """Lists, numbers and null of anything that pygafro returns."""
    if hasattr(found, "evaluate"):
        found = found.evaluate()
    if hasattr(found, "vector"):
        found = found.vector().ravel()
    if hasattr(found, "tolist"):
        found = found.tolist()
    if isinstance(found, list | tuple):
        return [plain(x) for x in found]
    return found if found is None or (isinstance(found, int | float) and math.isfinite(found)) else None


class Asked:
    """Calls of pygafro by name. What is missing or fails is noted in `refused`, and None comes back."""

    def __init__(self, package):
        self.package, self.refused = package, {}

    def make(self, name, *arguments):
        """What the call returns."""
        return self.guarded(name, lambda: reduce(getattr, name.split("."), self.package)(*arguments))

    def guarded(self, name, evaluate):
        """The value of `evaluate`, or None and a note under the name."""
        try:
            return evaluate()
        except Exception as error:  # a peer may fail in any way, and that is what is recorded
            self.refused[name] = f"{type(error).__name__}: {str(error).partition(chr(10))[0][:100]}"
            return None

    def __call__(self, name, *arguments):
        """The same as lists and numbers."""
        return plain(self.make(name, *arguments))

    def through(self, kind, points):
        """A primitive through points."""
        return self.make(kind, *(self.make("Point", *x) for x in points))


def components(x):
    """All 32 components of a multivector."""
    held = dict(zip(x.blades(), plain(x), strict=True))
    return [held.get(mask, 0.0) for mask in range(32)]


def products(ask, given):
    """Of multivectors with all 32 components."""
    names = ask.package.multivector.all_blades
    made = [[ask.package.Multivector.create(names, [float(x) for x in one]) for one in pair] for pair in given["multivectors"]]
    rules = {"geometric": operator.mul, "outer": operator.xor, "inner": operator.or_}
    return {
        **{rule: [components(product(a, b)) for a, b in made] for rule, product in rules.items()},
        **{name: [components(getattr(a, name)()) for a, _ in made] for name in ("reverse", "dual")},
        "squaredNorm": [plain(a.squaredNorm()) for a, _ in made],
    }


def snake(kind):
    """point_pair of PointPair."""
    return kind.replace("Pair", "_pair").lower()


def primitives(ask, given):
    """Coefficients through points, and what is read off them."""
    readers = {
        "PointPair": ("getPoint1", "getPoint2"),
        "Line": (),
        "Circle": ("getCenter", "getRadius"),
        "Plane": ("getNormal",),
        "Sphere": ("getCenter", "getRadius"),
    }
    found = {}
    for kind, names in readers.items():
        made = [ask.through(kind, x) for x in given["points"][snake(kind)]]
        methods = ("vector", "inverse", "squaredNorm", *names)
        found[kind] = {name: [ask(f"{kind}.{name}", x) for x in made] for name in methods}
    for kind in ("PointPair", "Circle", "Sphere"):
        made = [ask.through(kind, x) for x in given["far"][snake(kind)]]
        found[f"far {kind}"] = {name: [ask(f"{kind}.{name}", x) for x in made] for name in readers[kind]}
    return found


def transformations(ask, given):
    """From primitive to primitive."""
    unit = ask.make("Circle.Unit")
    found = {"unit": plain(unit)}
    for name, circles in (("points", given["points"]["circle"]), ("flat", given["flat"]), ("tilted", given["tilted"])):
        made = [ask.through("Circle", x) for x in circles]
        found[name] = [ask("Circle.getSimilarityTransformation", unit, x) for x in made]
    found["flat_radius"] = [ask("Circle.getRadius", ask.through("Circle", x)) for x in given["flat"]]
    for name, kind, pairs in (
        ("congruent", "circle", given["congruent"]),
        *((kind, kind, pairs) for kind, pairs in given["pairs"].items()),
    ):
        made = [[ask.through(kind.title(), x) for x in pair] for pair in pairs]
        found[f"{name}_motor"] = [ask(f"{kind.title()}.getMotor", *pair) for pair in made]
        if kind == "circle":
            found[f"{name}_similarity"] = [ask(f"{kind.title()}.getSimilarityTransformation", *pair) for pair in made]
    return found


def exponentials(ask, given):
    """exp of bivectors, and log of versors, of minus the versors, and of 1.3 times the versors; derivatives of both for motors."""
    import numpy as np

    def each(values, evaluate):
        return [evaluate(np.array(x)) for x in values]

    def at(values):
        return [values[k] for k in given["jacobians_at"]]

    whole, rigid = given["bivectors"], given["rigid_bivectors"]
    found = {
        "similarity_exp": each(whole, lambda b: ask("SimilarityTransformation.exp", ask.make("Multivector_e12e13e23e0ie1ie2ie3i", b))),
        "motor_exp": each(rigid, lambda b: ask("Motor.exp", ask.make("MotorGenerator", b))),
        "rotor_exp": each(rigid, lambda b: ask("Rotor.exp", ask.make("RotorGenerator", b[:3]))),
        "motor_exp_jacobian": each(at(rigid), lambda b: ask("MotorExponential.jacobian", ask.make("MotorGenerator", b))),
        "motor_log_jacobian": each(at(given["motors"]), lambda m: ask("MotorLogarithm.jacobian", ask.make("Motor", m))),
    }
    groups = {"similarity": ("SimilarityTransformation", "versors"), "motor": ("Motor", "motors"), "rotor": ("Rotor", "rotors")}
    for group, (kind, key) in groups.items():
        for name, factor in (("log", 1.0), ("log_of_minus", -1.0), ("log_of_scaled", 1.3)):
            found[f"{group}_{name}"] = each(given[key], lambda v, k=kind, f=factor: ask(f"{k}.log", ask.make(k, f * v)))
    return found


def arms(ask, given):
    """End motors of arms and their Jacobians; the motors of single joints at one angle."""
    found = {}
    for name, positions in given["q"].items():
        arm = ask.make(name)
        methods = ("getEEMotor", "getEEAnalyticJacobian", "getEEGeometricJacobian", "getEEFrameJacobian")
        found[name] = {method: [ask(f"{name}.{method}", arm, q) for q in positions] for method in methods}
        joints = ask.make(f"{name}.getEEKinematicChain", arm).getActuatedJoints()
        found[name]["axes"] = [plain(joint.getAxis()) for joint in joints]
        found[name]["rotors"] = [plain(joint.getRotor(given["joint_angle"])) for joint in joints]
    return found


def hands(ask, given):
    """The primitive of the fingertips and the mean motor of hands of two, three and four fingers, with their Jacobians."""
    import numpy as np

    found = {}
    for name, (fingers, methods) in HANDS.items():
        leap = ask.make("LeapHand")
        hand = ask.make(name, leap.getSystem(), [FINGERS[k] for k in fingers])
        rows = []
        for position in given["hand_q"]:
            apart = [position[4 * k : 4 * k + 4] for k in fingers]
            q = np.concatenate(apart)
            row = {method: ask(f"{name}.{method}", hand, q) for method in ("getFingerMotors", *methods)}
            row["getFingerAnalyticJacobian"] = [ask(f"{name}.getFingerAnalyticJacobian", hand, k, part) for k, part in enumerate(apart)]
            rows.append(row)
        found[name] = rows
    return found


def main() -> None:
    """Reads samples, prints them with what pygafro makes of them, and versions."""
    import pygafro

    given = json.load(sys.stdin)
    ask = Asked(pygafro)
    for name in ABSENT:
        ask.make(f"{name}.__doc__.strip")
    origin = {
        "package": "pygafro",
        "version": importlib.metadata.version("pygafro"),
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "machine": platform.machine(),
    }
    parts = (products, primitives, transformations, exponentials, arms, hands)
    found = {
        "blades": {
            kind: ask(f"{kind}.blades") for kind in ("PointPair", "Line", "Circle", "Plane", "Sphere", "Motor", "SimilarityTransformation")
        },
        **{part.__name__: ask.guarded(part.__name__, lambda part=part: part(ask, given)) for part in parts},
    }
    json.dump({"origin": origin, "samples": given, "found": found, "refused": ask.refused}, sys.stdout, separators=(",", ":"))
    print()


if __name__ == "__main__":
    main()
