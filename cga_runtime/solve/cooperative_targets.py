"""What inverse kinematics drives to zero for the primitive that several chains span (paper A, section 3.7; similarity.md, section 7).

Results are judged by the error of the similarity without its gauge, in metres and radians, and the search follows the incidence of the
system's own points; cooperative_errors.py has both, and log(~V_c V_d) (44). From one random start each, on Pandas around a table, these
percentages of targets are reached by up to 15 damped steps inside the limits, and by the paper's steps, up to 100 with a line search and
without limits (scripts/cooperative_ik.py; 1000 targets, seed 101; of spheres 4000, seed 11):

                        incidence   similarity   logarithm   paper
    point pair              79          78           77        100
    line                    94          94           93         99
    circle                  95          91           91         98
    plane                   99          98           98         99
    sphere                  99.5        76           80         92
      5 to 20 m             99.7        16           59         58
      above 20 m            99           0           29          3
      start below r/10      99            3          38         13
      r/10 to r/2          100           40          66         78
      above r/2             99           88          85         98

With restarts incidence reaches all targets of each kind. It is first for the fingers of a hand and for a humanoid's arms, too.

Spheres of four arms differ in this: hands that are nearly coplanar span large ones, of 1.3 m in the median, above 10 m one in twenty, up to
580 m, at a degeneracy down to 2e-4. Their centre and radius are reciprocals of the curvature k = 1/r, which is what the hands' heights
over a plane are linear in. From s = k/k_d = r_d/r above 1, Newton's step towards a larger sphere that touches it there leads

    of the similarity   to k (2 - s): from s > 2 beyond the plane, k = 0, to the other side;
    of the logarithm    to k (1 - log s), beyond the plane from s > e, and moves the hands by r (s log s - s + 1), 1.3 r for s = 3: there
                        log r and centre over r are two functions of k, and the hands' place is what makes up the difference;
    of the incidence    to k_d, the hands where they are.

Neither units nor scales cure that. But the hands' distances hardly see a large sphere change: 1e-6 m of them are 1e-2 m at the centre of a
sphere of 50 m. Hence the search stops by the similarity's error, not by its own. Circles are the same, less so.
"""

from __future__ import annotations

from dataclasses import fields
from typing import cast

import numpy as np

from cga_runtime.elements.similarities import unit_primitive
from cga_runtime.errors import UnknownNameError, WrongSizeError
from cga_runtime.solve.cooperative_errors import Errors
from cga_runtime.solve.ik_targets import Goal, IkTarget, within_reason
from cga_runtime.spaces.cooperative import Cooperative
from cga_runtime.spaces.primitive_kinds import Spanned
from cga_runtime.versors import Similarity


def cooperative_goal(system: Cooperative, target: IkTarget | Similarity, weights: tuple[float, float], as_printed: bool = False) -> Goal:
    """The goal of an element of the system's kind, or of a similarity.

    weights: of lengths (1/m) and of angles (1/rad). as_printed: the search follows log(~V_c V_d) (paper A, eq. 44). Raises what as_element
    raises, DegenerateError for coordinates beyond 1e50 m, WrongSizeError for a point or sphere without a weight of lengths.
    """
    if weights[0] == 0.0 and system.about.reference is None:
        raise WrongSizeError(f"weights: {weights} given, but lengths are all that a {system.kind} measures")
    element = as_element(system, target)
    for field in fields(element):
        within_reason(getattr(element, field.name))
    errors = Errors(system, element, weights)
    free = 0.0 in weights and system.about.reference is not None  # what is free must not be followed
    follow = errors.logarithm if as_printed else errors.similarity if free else errors.incidence
    return Goal(element.batch, follow, errors.similarity)


def as_element(system: Cooperative, target: IkTarget | Similarity) -> Spanned:
    """The primitive V_d X_u ~V_d of a similarity V_d or its components (..., 12), or the element itself.

    Raises UnknownNameError for another type; WrongSizeError, NotFiniteError, DegenerateError for components of no similarity.
    """
    if isinstance(target, system.about.element):
        return cast(Spanned, target)
    if not isinstance(target, Similarity):
        try:
            components = np.asarray(target)
        except ValueError:  # rows of different lengths
            components = np.empty(0, dtype=object)
        if components.dtype == object:
            known = (system.about.element.__name__, "Similarity", "its components (..., 12)")
            raise UnknownNameError(f"kind of target of a cooperative {system.kind}", type(target).__name__, known)
        target = Similarity(components)
    return cast(Spanned, unit_primitive(system.kind).transformed(target))
