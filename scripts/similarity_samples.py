"""Prints samples for scripts/similarity_pygafro.py as JSON: multivectors, points of primitives, bivectors, versors and joint positions.

    ./run shell python scripts/similarity_samples.py > samples.json

Seeds are fixed. Most numbers are short decimals, so that they are read as they were drawn; the products are of whole numbers, so that they
have no rounding. Blades stand in canonical order (ascending bit mask), lengths are in m, angles in rad.
"""

import json
import sys

import numpy as np

from cga_runtime.motors import Motor
from cga_runtime.versors import Rotor, Similarity

COUNTS = {"point_pair": 2, "line": 2, "circle": 3, "plane": 3, "sphere": 4}
"""Points of a primitive."""
ANGLES = (1e-12, 1e-9, 1e-7, 1e-5, 2.8e-5, 2.9e-5, 1e-4, 2.8e-4, 2.9e-4, 1e-3, 1e-2, 0.1, 0.5, 1.0, 2.0, 3.0, 3.14)
"""Rotation angles of the bivectors."""
JACOBIANS_AT = (0, 2, 6, 10, 13, 15)
"""Of which of them derivatives are taken."""
SPREAD = 0.01
"""Size of a primitive far from the origin."""
ROUND = ("point_pair", "circle", "sphere")
DISTANCES = (1.0, 10.0, 100.0)
HEIGHTS = (1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 0.0)
"""Of the middle point of three over the line through the others: the last are collinear."""
ARMS = ("FrankaEmikaRobot", "KukaIIWA14")
"""pygafro's names of arms with seven joints."""
TILTS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0)
"""Angles of a circle's normal from -e3."""
HAND_POSITIONS = (
    (-0.55, -1.63, 0.86, 1.15, 0.86, 0.52, 1.74, 0.63, 1.15, -0.19, 1.49, 1.49, 1.87, 0.28, -1.33, -0.02),
    (0.31, -1.83, 1.59, 0.02, 1.46, -0.43, 1.4, -0.2, 0.68, -0.91, 1.75, 1.21, 0.48, 1.22, 0.91, 1.19),
)
"""Of the 16 joints of the LEAP hand, index to thumb. The motors of all four fingertips have a positive scalar part there, so that there
is no choice in their logarithms."""


def points(rng: np.random.Generator, *shape: int) -> np.ndarray:
    """Points of size 1, (..., 3)."""
    return rng.normal(size=(*shape, 3)).round(3)


def flat_circles() -> np.ndarray:
    """Three points that are less and less a circle, (heights, 3, 3)."""
    return np.array([[[-1.0, 0.0, 0.0], [0.25, -h, 0.0], [1.0, 0.0, 0.0]] for h in HEIGHTS])


def tilted_circles() -> np.ndarray:
    """Unit circles about the origin, turned by pi - tilt about e1: their normals are (0, -sin tilt, -cos tilt), (tilts, 3, 3)."""
    return np.array([[[1.0, 0.0, 0.0], [0.0, -np.cos(a), np.sin(a)], [-1.0, 0.0, 0.0]] for a in TILTS])


def congruent_circles(rng: np.random.Generator) -> np.ndarray:
    """Pairs of circles of one size, the second turned by a quarter about e1 and moved, (3, 2, 3, 3)."""
    first = points(rng, 3, 3)
    second = np.stack([first[..., 0], -first[..., 2], first[..., 1]], axis=-1) + points(rng, 3, 1)
    return np.stack([first, second.round(3)], axis=1)


def bivectors(rng: np.random.Generator) -> np.ndarray:
    """e12 e13 e23 e0i e1i e2i e3i, their rotation parts turning by ANGLES, (angles, 7)."""
    axes = rng.normal(size=(len(ANGLES), 3))
    axes *= (np.array(ANGLES) / np.linalg.norm(axes, axis=1))[:, None]
    return np.concatenate([axes, rng.normal(size=(len(ANGLES), 1)).round(2), rng.normal(size=(len(ANGLES), 3)).round(2)], axis=1)


def main() -> None:
    """Draws and prints."""
    rng = np.random.default_rng(18)
    b = bivectors(rng)
    rigid = b[:, [0, 1, 2, 4, 5, 6]]
    far = {kind: np.array([(SPREAD * points(rng, COUNTS[kind]) + d).round(9) for d in DISTANCES]) for kind in ROUND}
    drawn = {
        "multivectors": rng.integers(-9, 10, size=(4, 2, 32)),
        "points": {kind: points(rng, 4, count) for kind, count in COUNTS.items()},
        "far": far,
        "flat": flat_circles(),
        "tilted": tilted_circles(),
        "pairs": {kind: points(rng, 6, 2, COUNTS[kind]) for kind in ("line", "circle", "plane")},
        "congruent": congruent_circles(rng),
        "bivectors": b,
        "jacobians_at": JACOBIANS_AT,
        "versors": Similarity.exp(b).coefficients,
        "rigid_bivectors": rigid,
        "motors": Motor.exp(rigid).coefficients,
        "rotors": Rotor.exp(rigid[:, :3]).coefficients,
        "q": {arm: rng.uniform(-1.5, 1.5, (2, 7)).round(2) for arm in ARMS},
        "joint_angle": 0.5,
        "hand_q": HAND_POSITIONS,
    }
    json.dump(drawn, sys.stdout, default=np.ndarray.tolist)
    print()


if __name__ == "__main__":
    main()
