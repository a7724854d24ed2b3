"""How far masses shift the centre of mass, how fast, and how late fine ones are.

The shifts that masses m_i on rails u_i can give are a zonotope, the sum of their rails. The
largest ball about its centre touches a face, whose normal n is that of two rails:

    radius = min over n = u_i x u_j / |u_i x u_j| of  sum_i reach_i |u_i . n| m_i / m

with reach_i the half travel (m) for how far, and the speed (m/s) for how fast. Zero: some
direction cannot be reached. Of masses on parallel rails the one that shifts fastest counts for how
fast: a fine mass then makes up the rest of a coarse one's step, half of it at most, and until it
has done so the shift is that much off. How long that takes is a delay of small demands.
"""

from dataclasses import replace
from itertools import combinations, permutations

import numpy as np

from equipoise.actuators.sliding_masses import PARALLEL, one_a_direction
from equipoise.model.arrays import Floats
from equipoise.model.testbed import Testbed

FINER = 2.0  # -, chosen: below this ratio of steps masses are alike


def limited(vector: Floats, most: float) -> Floats:
    """Return the vector, shortened to ``most`` where it is longer; its direction is kept."""
    size = float(np.linalg.norm(vector))
    return vector if size <= most else vector * (most / size)


def ball(testbed: Testbed, reaches: Floats) -> float:
    """Return the radius (m, or m/s) of the largest ball of shifts with such reaches of masses."""
    masses = testbed.masses
    arms = np.array([m.mass * m.axis for m in masses]).reshape(-1, 3) * reaches[:, None]
    normals = [np.cross(a.axis, b.axis) for a, b in combinations(masses, 2)]
    faces = [n / np.linalg.norm(n) for n in normals if np.linalg.norm(n) > 1e-6]
    widths = [float(np.abs(arms @ n).sum()) for n in faces]
    return min(widths, default=0.0) / testbed.body.mass


def greatest_shift(testbed: Testbed) -> float:
    """Return how far (m) masses shift the centre of mass from home, whatever the direction."""
    return ball(testbed, np.array([min(-m.travel[0], m.travel[1]) for m in testbed.masses]))


def greatest_slew(testbed: Testbed) -> float:
    """Return how fast (m/s) masses shift the centre of mass, whatever the direction."""
    fastest = one_a_direction(sorted(testbed.masses, key=lambda m: -m.mass * m.speed))
    return ball(replace(testbed, masses=tuple(fastest)), np.array([m.speed for m in fastest]))


def fastest_slew(testbed: Testbed) -> float:
    """Return how fast (m/s) the fastest mass shifts the centre of mass along its rail."""
    return max([m.mass * m.speed / testbed.body.mass for m in testbed.masses], default=0.0)


def filling_time(testbed: Testbed) -> float:
    """Return the longest that a fine mass takes over half a step of a coarse one beside it, s."""
    pairs = [
        (fine, coarse)
        for fine, coarse in permutations(testbed.masses, 2)
        if abs(float(fine.axis @ coarse.axis)) >= PARALLEL
        and FINER * fine.mass * fine.resolution < coarse.mass * coarse.resolution
    ]
    times = [c.mass * c.resolution / (2 * f.mass * f.speed) for f, c in pairs]
    return max(times, default=0.0)
