"""The usual manoeuvre, to compare a plan with: that of Ivanov et al. (2021), section 3.

Let go a few degrees tilted, with a slight rate, and one known move at half time: a mass along each
level rail by a fifth of its travel, one along each upright rail all the way down. With their masses
that is (-10, -10, -50) mm.
"""

import numpy as np

from equipoise.actuators.sliding_masses import one_a_direction
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Vector3
from equipoise.model.bench_requests import in_steps
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.planning.manoeuvre.manoeuvre_space import LEVEL

TILT = np.radians(4.0)  # as in ``verification.paper_runs``: 3 to 5 deg
RATE = (-0.010, -0.004, 0.011)  # rad/s, the paper's, about two level axes and the upright one
SHARE = 0.2  # of the travel: 10 of 50 mm


def usual(testbed: Testbed, duration: float, standing: dict[str, float]) -> Manoeuvre:
    """Return the usual manoeuvre of a testbed; masses that stand (m) where they go, go home."""
    first, second = axes_across(testbed.up)
    rate = RATE[0] * first + RATE[1] * second + RATE[2] * testbed.up
    goals = {mass.name: goal_of(mass, testbed.up) for mass in one_a_direction(testbed.masses)}
    there = {name for name, goal in goals.items() if np.isclose(standing.get(name, 0.0), goal)}
    moved = {name: 0.0 if name in there else goal for name, goal in goals.items()}
    moves = ((round(duration / 2, 1), moved),) if moved else ()
    return Manoeuvre(duration, TILT, first, rate, moves, standing=standing)


def goal_of(mass: SlidingMass, up: Vector3) -> float:
    """Return where a mass goes, m."""
    low, high = mass.travel
    slope = float(mass.axis @ up)
    if abs(slope) < LEVEL:
        return in_steps(mass, SHARE * low)
    return in_steps(mass, low if slope > 0 else high)
