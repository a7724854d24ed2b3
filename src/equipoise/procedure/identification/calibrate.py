"""Calibrate: from a recording of commanded moves to the parameters of drives and sensors.

Moves that calibrate the masses: each mass in turn goes half way, all the way, home, all the way to
the other side, half way back, home, and stands for half a swing after each:

    d / d_max = 1/2, 1, 0, -1, -1/2, 0

Half and whole on both sides show the gain (sum of d^2: 5/2 d_max^2), stops at half way and at home
that are reached from either side the backlash, and six stops against three unknowns along the rail
the scatter. d_max is limited by the rail and by the nominal platform at rest. It leans by at most
``LEAN`` of its limit, because it swings about as much beyond, and hangs between ``HEIGHT`` and
``DEPTH`` of its depth: a heavy mass on a long rail would make another pendulum of the platform, to
which no fit converges from the nominal values.

The error of the nominal values is not considered: identify and balance roughly first.
"""

import math

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.estimation.calibration import calibration
from equipoise.estimation.calibration.calibration import CalibrateOptions
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.procedure.steps.clean_record import sound

COURSE = (0.5, 1.0, 0.0, -1.0, -0.5, 0.0)
TURNS_OVER = math.pi / 3  # rad, chosen: the limit of a table that could turn over
LEAN = 0.4  # of the tilt limit, chosen: twice that in the swing, and some for nominal errors
HEIGHT = 0.5  # of the nominal depth of com below P, chosen: that is left at least
DEPTH = 2.0  # of the same, chosen: that is reached at most, a period shorter by as much
SHARES = 0.85 ** np.arange(50)  # of the travel, chosen: tried from all of it to 0.03 %
ROUND = 5.0  # s, chosen: times a person can follow

Moves = list[tuple[float, dict[str, float]]]


def calibrate(recording: Recording, testbed: Testbed, options: CalibrateOptions) -> Estimate:
    """Return the calibration by the sound rows of a recording."""
    recording, testbed = sound(recording, testbed)
    return calibration.calibrate(recording, testbed, options)


def calibration_moves(testbed: Testbed, names: tuple[str, ...] = ()) -> tuple[Moves, float]:
    """Return times (s) and targets (m), and the time to record; all masses unless named.

    InputError for a platform whose nominal centre of mass does not hang.
    """
    moves, t = Moves(), stand(testbed)
    for mass in testbed.masses:
        if not names or mass.name in names:
            before = 0.0
            for goal in course_of(mass, testbed):
                moves.append((t, {mass.name: goal}))
                way = abs(goal - before) / mass.speed
                t, before = t + ROUND * math.ceil((stand(testbed) + way) / ROUND), goal
    return moves, t


def stand(testbed: Testbed) -> float:
    """Return half a nominal period of swing, s, in whole ROUNDs."""
    body = testbed.body
    depth = -float(body.com @ testbed.up)
    if depth <= 0:
        where = f"{testbed.source or testbed.name}: platform.com_um"
        raise InputError(where, "a centre of mass that is not below P", "one that hangs")
    stiffness = testbed.weight * depth
    half = math.pi * math.sqrt(body.mean_moment / stiffness)
    return ROUND * math.ceil(half / ROUND)


def course_of(mass: SlidingMass, testbed: Testbed) -> list[float]:
    """Return the targets of one mass, m, in whole steps."""
    low, high = (share_of(mass, end, testbed) * end for end in mass.travel)
    ends = [high if share > 0 else -low for share in COURSE]
    goals = [share * end for share, end in zip(COURSE, ends, strict=True)]
    if mass.resolution > 0:  # towards home
        goals = [math.trunc(goal / mass.resolution) * mass.resolution for goal in goals]
    return [goal for k, goal in enumerate(goals) if goal != (goals[k - 1] if k else 0.0)]


def share_of(mass: SlidingMass, end: float, testbed: Testbed) -> float:
    """Return the greatest share of the way to one end of a rail with which the platform hangs."""
    shift: Vector3 = mass_maps([mass]).first_moment[0] * end / testbed.body.mass
    return next((float(f) for f in SHARES if hangs(f * shift, testbed)), 0.0)


def hangs(shift: Vector3, testbed: Testbed) -> bool:
    """Say whether the nominal platform leans little enough with its centre of mass shifted (m)."""
    com, up = testbed.body.com + shift, testbed.up
    depth, before = -float(com @ up), -float(testbed.body.com @ up)
    aside = float(np.linalg.norm(com + depth * up))
    leans = aside > math.tan(LEAN * min(testbed.tilt_limit, TURNS_OVER)) * depth
    return HEIGHT * before <= depth <= DEPTH * before and not leans
