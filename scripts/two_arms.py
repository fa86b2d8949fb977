"""A tour of the NAO's two arms that hold one object: how it may move, which motors control it, how far singularities are.

    ./run shell python scripts/two_arms.py
"""

import numpy as np

import cga_runtime as cga
from cga_runtime.analysis.closed_forms import determinant_factors

GRASP = (0.6, -0.35, 0.9, 0.9, 0.2, 0.6, 0.35, -0.9, -0.9, -0.2)  # both arms alike, as one would hold a box
SCHEMES = ((1, 3, 7, 8), (1, 2, 3, 7), (1, 2, 6, 7))


def main() -> None:
    """Prints the tour."""
    nao = cga.load_robot("nao")
    loop = cga.ClosedChain(nao.chain("RHand"), nao.chain("LHand"))
    q = np.array(GRASP)

    found = loop.mobility(q)
    print(f"joint mobility {found.joint_mobility}; the object has {found.object_dof} degrees of freedom: {found.motion}")
    for arm, wrenches in zip(("right", "left"), found.wrenches, strict=True):
        print(f"the {arm} arm cannot give way to a force along {np.round(wrenches[0].f, 3)}")

    for scheme in SCHEMES:
        print(f"motors {scheme}: mu = {loop.conditioning(q, scheme):.3f}")
    zero = [name for name, factor in determinant_factors(loop, q, (1, 2, 3, 7)).items() if abs(factor) < 1e-12]
    print(f"(1, 2, 3, 7) fails here because of its factor {', '.join(zero)}")

    nearest = loop.nearest_singularity(q, "actuation", (1, 3, 7, 8), within_limits=True)
    print(f"nearest singularity of (1, 3, 7, 8) inside the joint limits: {nearest.distance:.2f} rad away (not certified)")

    goal = cga.Point(loop.right.point(q[:5]) + np.array([0.0, 0.0, 0.04]))
    moved = cga.reach(loop, goal, q, grasp=loop.grasp(q))
    print(f"lifting the object by 4 cm: {moved.status}, residual {moved.residual:.0e} m")


if __name__ == "__main__":
    main()
