"""Which displacements shift the centre of mass as wanted.

In whole steps of the motors, inside the rails, that is a mixed integer linear programme: least
error, the stops' own included, then least travel. With g_i = (m_i / M) u_i and s_i, e_i the errors
of a mass's present and next stop,

    shift = sum g_i (D_i - s_i y_i) + error,    y_i = 1 where D_i is not 0, else 0
    least   |error| + sum y_i sd(e_i) |g_i|,    |.| summed over the axes
"""

from itertools import combinations
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.actuators.sliding_masses import shift_by_travel
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.testbed import Testbed

ERRORS, WAYS = 1e6, 1e3  # 1/m, chosen: the programme counts errors in um and ways in mm
ERROR = 1e4  # mm of travel that an error of 1 um is worth, chosen: beyond what rails have
NODES = 1000  # chosen: a quarter of a second; more found nothing better on five presets
MORE = 2  # steps, chosen: what whole steps may take beyond what fractions would
COARSE = 1e-3  # m, chosen: the programme's unit for masses that have no steps
FINE = 1e-9  # m, chosen: a step of masses that have none
ROUNDING = 1e-9  # of a step


class Programme(NamedTuple):
    """The numbers of the programme, in steps of the masses.

    Its unknowns: steps forward (k) and backward (k), which masses move (k, 0 or 1), errors over and
    under (3 + 3, um), the longest travel time (s).
    """

    gain: Floats  # (3, k) um a step
    seconds: Floats  # (k,) s a step
    travel: Floats  # (k,) mm a step
    room: Floats  # (2, k) steps that may be gone, forward and backward
    whole: Floats  # (k,) 1: whole steps alone
    least: Floats  # (k,) steps, of a mass that moves
    stood: Floats  # (3, k) um, what the errors of the present stops do
    stop: Floats  # (k,) um, one sd of what a new stop does, summed over the axes


def worth_going(gain: Floats, error: float) -> Floats:
    """Return how many steps of each mass may make up for an error (um), (k,).

    What is no better than standing still shifts by twice the error at most; in an optimum of the
    programme without whole steps three masses at most stand off the ends of their way.
    """
    steps = np.zeros(gain.shape[1])
    for size in range(1, min(3, len(steps)) + 1):
        for some in combinations(range(len(steps)), size):
            alone = np.abs(np.linalg.pinv(gain[:, some])).max(axis=1)
            steps[list(some)] = np.maximum(steps[list(some)], alone)
    return np.ceil(2 * error * steps) + MORE


def new_stops(testbed: Testbed) -> Floats:
    """Return one sd of what a stop of each mass does, summed over the axes, (k,) m."""
    accuracy = np.array([mass.accuracy for mass in testbed.masses])
    return np.abs(shift_by_travel(testbed)).sum(axis=1) * accuracy


def programme_of(testbed: Testbed, now: Floats, shift: Vector3, stood: Floats) -> Programme:
    """Return the programme for masses at displacements ``now`` with stops' errors ``stood`` (m)."""
    masses, gain = testbed.masses, shift_by_travel(testbed).T * ERRORS
    resolution = np.array([m.resolution for m in masses])
    whole = (resolution > 0).astype(float)
    step = np.where(whole > 0, resolution, COARSE)
    low, high = np.array([m.travel for m in masses]).reshape(-1, 2).T
    room = np.maximum(np.stack([high - now, now - low]) / step, 0.0)
    error = float(np.abs(shift * ERRORS).sum() + np.abs(gain * stood).sum())
    room = np.minimum(room, worth_going(gain * step, error))
    return Programme(
        gain=gain * step,
        seconds=step / np.array([m.speed for m in masses]),
        travel=step * WAYS,
        room=np.where(whole > 0, np.floor(room + ROUNDING), room),
        whole=whole,
        least=np.where(whole > 0, 1.0, FINE / step),
        stood=gain * stood,
        stop=ERRORS * new_stops(testbed),
    )


def cost_of(programme: Programme, haste: float) -> Floats:
    """Return what each unknown costs: errors and new stops alike, then ways, then time."""
    k = len(programme.travel)
    order = 1.0 + 1e-3 * np.arange(k)  # of equal ways, the one that moves fewer masses
    ways = programme.travel * order
    return np.concatenate([ways, ways, ERROR * programme.stop, np.full(6, ERROR), [haste + 1e-6]])


def constraints_of(programme: Programme, shift: Vector3) -> list[scipy.optimize.LinearConstraint]:
    """Return that the shift (m) is met but for the errors, what moving means, and the time."""
    k, (gain, stood) = len(programme.travel), (programme.gain, programme.stood)
    one, none, at = np.eye(k), np.zeros((k, 6)), shift * ERRORS
    met = np.hstack([gain, -gain, -stood, np.eye(3), -np.eye(3), np.zeros((3, 1))])
    goes = [one, one, -np.diag(programme.room.max(axis=0, initial=0.0)), none, np.zeros((k, 1))]
    stays = [-one, -one, np.diag(programme.least), none, np.zeros((k, 1))]
    seconds = np.diag(programme.seconds)
    clock = [seconds, seconds, 0 * one, none, -np.ones((k, 1))]
    limits = [np.hstack(rows) for rows in (goes, stays, clock)]
    beyond = [scipy.optimize.LinearConstraint(rows, -np.inf, 0.0) for rows in limits]
    return [scipy.optimize.LinearConstraint(met, at, at), *beyond]


def displacements_for(
    testbed: Testbed, now: Floats, shift: Vector3, haste: float = 0.0, stood: Floats | None = None
) -> Floats:
    """Return displacements (m) that shift the centre of mass from where it is by ``shift`` (m).

    Rails and motor steps are kept. A mass that moves leaves the error of its present stop behind,
    which is part of where the centre of mass is found to be (``stood``, m, as far as it is known).
    It stops with a new one, whose sd counts as an error does: fine masses correct what they can.
    What cannot be reached is approached as nearly as possible: compare ``com_shift`` of the answer.
    ``haste`` weighs the longest single travel time against the sum of travels (mm per s).
    """
    k = len(testbed.masses)
    programme = programme_of(testbed, now, shift, np.zeros(k) if stood is None else stood)
    whole, free = programme.whole, np.zeros(7)
    kinds: Floats = np.concatenate([whole, whole, np.ones(k), free])
    answer = scipy.optimize.milp(
        cost_of(programme, haste),
        integrality=kinds.astype(np.int64),
        bounds=scipy.optimize.Bounds(
            0.0, np.concatenate([*programme.room, np.ones(k), free + np.inf])
        ),
        constraints=constraints_of(programme, shift),
        # With a presolve, HiGHS of SciPy 1.17 now and then prints on standard output.
        options={"node_limit": NODES, "presolve": False},
    )
    if answer.x is None:
        return now.copy()
    forward, backward = answer.x[: 2 * k].reshape(2, k)
    go = np.where(whole > 0, np.round(forward - backward), forward - backward)
    return now + go * programme.travel / WAYS


def gain_by_one(testbed: Testbed, now: Floats, shift: Vector3) -> float:
    """Return by how much (m) one mass alone comes nearer to a shift (m), summed over the axes.

    With whole steps on its rail, along the shift: a mass that would go too far stops before. One sd
    of its stop is taken off. It is no more than what ``displacements_for`` gains with all masses,
    which takes longer to find.
    """
    masses, per_m = testbed.masses, shift_by_travel(testbed)
    low, high = (np.array([m.travel[end] for m in masses]) - now for end in (0, 1))
    step = np.array([max(m.resolution, FINE) for m in masses])
    way = per_m @ shift / np.sum(per_m**2, axis=1)
    way = np.clip(way, np.minimum(low, 0.0), np.maximum(high, 0.0))
    whole = np.trunc(way / step + ROUNDING * np.sign(way)) * step
    left = shift - whole[:, None] * per_m
    gained = np.abs(shift).sum() - np.abs(left).sum(axis=1) - new_stops(testbed)
    return float(np.max(gained, initial=0.0))
