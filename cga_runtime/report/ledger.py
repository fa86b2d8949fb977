"""Section "limits": what of this report is proved, what is sampled, and what it does not look at; its numbers are the report's own."""

from __future__ import annotations

from typing import Any

from cga_runtime.analysis.mobility import RANK_TOLERANCE
from cga_runtime.analysis.schemes import POINTS


def ledger(data: dict[str, Any]) -> dict[str, list[str]]:
    """Sentences under the headings exact, sampled, missing."""
    table = data["schemes"]["table"]
    proved = sum(row["certified"] and row["class"] != "never" for row in table)
    never = [row for row in table if row["class"] == "never"]
    structural = sum(row["certified"] for row in never)
    hands = data["cooperative"]
    actuation = data["nearest"]["actuation"]["within_limits"]
    exact = [
        f"{proved} of {data['schemes']['admissible']} admissible schemes: six independent passive screws at a pose with rational"
        " half-angle tangents, rank by integer elimination without rounding. One such pose proves the rank almost everywhere.",
        f"{structural} of {len(never)} schemes that are never admissible: two joint axes on one line, or six axes that meet one line,"
        " so the rank is deficient in every pose.",
        "q2*: a closed form of two constants of the arm. The factorisation of the limb Jacobian is an identity; the deviation given"
        " above is the rounding of checking it.",
        "Counts of schemes and orbits: they follow from the classes.",
        "√det(J Jᵀ) = m m / (8 r⁶) for the point pair: an identity, because the arms share no joint; the deviation given is rounding.",
    ]
    sampled = [
        f"“Singular on every mirror pose”: exact rank deficiency at {POINTS} rational mirror-symmetric poses. That all of them should be"
        " so by accident is not to be expected, but it is not a proof.",
        f"Mobility and motion types: numerical ranks at the poses named (below {RANK_TOLERANCE:g} of the largest singular value).",
        f"μ: {data['schemes']['samples']} poses, joints uniform inside their limits, a free grasp each, all joints weighted alike. Expect"
        " the third digit to change with the sample. Admissible schemes still have singular surfaces.",
        f"Distances to singularities: local optimisation, so upper bounds. {actuation['found']} of {actuation['tried']} searches for an"
        " actuation singularity inside the limits found one; a search that finds none proves nothing by itself.",
        "Reaching: a solver that starts elsewhere may fail or succeed where this one did not. A failure does not prove that a target is"
        " out of reach.",
        f"Cooperative space: ranks, manipulability and motions of the hands at {hands['samples']} poses, uniform inside the limits; full"
        " rank there proves nothing about the others. Inverse kinematics and the meeting of the hands: one solver, as under reaching.",
        "Self-motions of the point pair and the line: numerical nullspaces at one pose, followed in steps and corrected.",
        "Times: one machine, one run.",
    ]
    if structural < len(never):
        words = f"rank deficient at {POINTS} exact rational poses; no structural reason was found."
        sampled.insert(0, f"The other {len(never) - structural} schemes called never admissible: {words}")
    missing = [
        "Self-collision, collision with the object, friction and the strength of the grip: the hands are taken as holding rigidly.",
        "Forces and torques of the actuators: μ is about speeds, with all joints equal.",
        "NAO V6: public arm data was not found. V3.3, V4 and V5 share the arm geometry of the robot nao; V3.2 is nao_v32.",
        "Certified bounds on distances: none of the searches is a proof that no singularity lies nearer.",
    ]
    return {"exact": exact, "sampled": sampled, "missing": missing}
