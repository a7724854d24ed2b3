"""The usual manoeuvre, to compare a plan with, and the swings that are made where none was planned.

That of Ivanov et al. (2021), sections 4 and 5: let go a few degrees tilted, with a slight rate, and
one known move at half time. A mass along each level rail goes a fifth of its travel, one along each
upright rail all the way down; with their masses that is (-10, -10, -50) mm.

For a measurement the move is shortened to what masses can travel in a quarter of the record, and
halved until the swing stays clear of the tilt limit. A platform that is balanced already is let go
more gently, as gravity does not turn it back, and no mass is moved.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import one_a_direction
from equipoise.maths.attitude import tilt
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Vector3
from equipoise.model.bench_requests import in_steps
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.planning.manoeuvre.manoeuvre_space import LEVEL
from equipoise.planning.manoeuvre.noiseless_record import Imagined, imagined

TILT = np.radians(4.0)  # as in ``verification.paper_runs``: 3 to 5 deg
RATE = (-0.010, -0.004, 0.011)  # rad/s, the paper's, about two level axes and the upright one
SHARE = 0.2  # of the travel: 10 of 50 mm
IN_TIME = 0.25  # of the record, chosen: a move should leave as long before as after it
GUARD = 0.85  # of the tilt limit, chosen: what ``balance`` keeps to
HALVINGS = 8  # chosen: a move of less than a hundredth shows nothing


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


class Swing(NamedTuple):
    """A manoeuvre, and the recording that it would give without noise."""

    manoeuvre: Manoeuvre
    observed: Imagined
    peak_tilt: float  # rad


def usual_swing(testbed: Testbed, duration: float) -> Swing:
    """Return a free swing of so long (s) with one move in the middle."""
    manoeuvre = in_time(usual(testbed, duration, {}), testbed)
    swing = followed(manoeuvre, testbed)
    for _ in range(HALVINGS):
        if swing.peak_tilt <= GUARD * testbed.tilt_limit:
            break
        manoeuvre = shortened(manoeuvre, testbed, 0.5)
        swing = followed(manoeuvre, testbed)
    return swing


def followed(manoeuvre: Manoeuvre, testbed: Testbed) -> Swing:
    """Return the swing of the platform as stated in a manoeuvre."""
    observed = imagined(testbed, testbed.body, manoeuvre)
    return Swing(manoeuvre, observed, float(tilt(observed.motion.q, testbed.up).max()))


def in_time(manoeuvre: Manoeuvre, testbed: Testbed) -> Manoeuvre:
    """Return the manoeuvre with moves that end within their share of the record."""
    slowest = max(
        (abs(goal) / testbed.mass_named(name).speed
         for _, targets in manoeuvre.moves for name, goal in targets.items()), default=0.0,
    )  # fmt: skip
    share = IN_TIME * manoeuvre.duration / slowest if slowest > 0 else 1.0
    return manoeuvre if share >= 1 else shortened(manoeuvre, testbed, share)


def shortened(manoeuvre: Manoeuvre, testbed: Testbed, share: float) -> Manoeuvre:
    """Return the manoeuvre with a share of its moves, in whole steps; without what is no step."""
    moves: list[tuple[float, dict[str, float]]] = []
    for t, targets in manoeuvre.moves:
        nearer = {n: towards_home(testbed.mass_named(n), share * d) for n, d in targets.items()}
        moves.append((t, {name: goal for name, goal in nearer.items() if goal != 0}))
    return replace(manoeuvre, moves=tuple(move for move in moves if move[1]))


def towards_home(mass: SlidingMass, goal: float) -> float:
    """Return the whole step of a motor next to a displacement (m) on the side of home."""
    if mass.resolution == 0:
        return goal
    return float(np.trunc(goal / mass.resolution + 1e-9 * np.sign(goal))) * mass.resolution


def gentle_swing(testbed: Testbed, duration: float) -> Manoeuvre:
    """Return a free swing of so long (s) that leaves a balanced platform within its limit."""
    start = usual(testbed, duration, {})
    level = start.rate - float(start.rate @ testbed.up) * testbed.up
    free = max(GUARD * testbed.tilt_limit - start.tilt, 0.0)
    share = min(1.0, free / (duration * float(np.linalg.norm(level))))
    return replace(start, moves=(), rate=share * start.rate)
