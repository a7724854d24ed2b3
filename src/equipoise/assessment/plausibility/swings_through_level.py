"""Whether a record shows a free swing through level: what no platform does that would fall over.

Above the pivot, a centre of mass leaves level as a e^(lt) + b e^(-lt) does, which comes to any
tilt twice at most. One that comes back to the middle of its motion again and again hangs, is
steadied by its spin, or is driven.

Needs a camera. Judges the longest part in which no mass moves.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.attitude import tilt, to_matrix
from equipoise.model.arrays import Floats, Series1
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.at_stop import at_stop

LEVEL = np.radians(60.0)  # chosen: no table on a hemisphere swings about a tilt beyond this
PART = 0.5  # of the scatter about the middle, which a swing must pass to either side (chosen)
SHOWS = 10.0  # times the rows' noise that a swing scatters by (chosen)
STANDS = 5e-4  # m, chosen: a soft drive that gives way by less stands still
FEWEST = 20  # rows (chosen)
PARTS = 4  # over which a spin is a mean, so that no row's noise is one (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Swings:
    """A part of a record in which the platform swings freely."""

    span: tuple[float, float]  # s
    count: int  # times through the middle
    spin: float  # rad/s about the vertical, either way
    displacement: Floats  # m, of the masses, (k,)


def free_swings(recording: Recording, testbed: Testbed) -> Swings | None:
    """Return how a platform swings while no mass moves; None if that shows no free swing."""
    if recording.attitude is None or is_driven(recording):
        return None
    (start, end), displacement = _standing(recording)
    rows = recording.attitude.where((recording.attitude.t >= start) & (recording.attitude.t <= end))
    if len(rows) < FEWEST or _leaves_level(rows, testbed):
        return None
    upright = to_matrix(rows.values) @ testbed.up
    count, spin = _passes(upright[:, :2]), _spin(rows, testbed)
    return Swings((float(rows.t[0]), float(rows.t[-1])), count, spin, displacement)


def is_driven(recording: Recording) -> bool:
    """Say whether anything acts on the platform, or a column that nothing reads may say so."""
    inputs = (recording.momentum, recording.torque, recording.devices)
    acts = any(each is not None and bool(np.any(each.values != 0.0)) for each in inputs)
    return acts or bool(recording.unread)


def _standing(recording: Recording) -> tuple[tuple[float, float], Floats]:
    """Return the longest part (s) without a move, and where the masses stand in it (m)."""
    first, last = recording.span
    masses = recording.masses
    if masses is None or not len(masses):
        return (first, last), np.zeros(len(recording.mass_names))
    moves = np.flatnonzero(np.any(np.abs(np.diff(masses.values, axis=0)) > STANDS, axis=1))
    begins = np.append(first, masses.t[moves + 1]).clip(first, last)
    ends = np.append(masses.t[moves], last).clip(first, last)
    k = int(np.argmax(ends - begins))
    stands = masses.values[0 if k == 0 else int(moves[k - 1]) + 1]
    return (float(begins[k]), float(ends[k])), stands


def _leaves_level(rows: Samples, testbed: Testbed) -> bool:
    """Say whether the platform tips over, or comes to its stop, which throws it back."""
    over = float(tilt(rows.values, testbed.up).max()) > LEVEL
    return over or bool(at_stop(rows, testbed).any())


def _passes(lean: Floats) -> int:
    """Return how many times a lean (n, 2) passes the middle of its motion, in its main direction.

    Zero for one that is not clearly more than noise.
    """
    off = lean - lean.mean(axis=0)
    _, _, directions = np.linalg.svd(off, full_matrices=False)
    along: Series1 = off @ directions[0]
    scatter, noise = float(along.std()), float(np.diff(along, 2).std()) / 6**0.5
    if scatter < SHOWS * noise or scatter == 0.0:
        return 0
    sides = np.sign(along[np.abs(along) > PART * scatter])
    return int(np.count_nonzero(np.diff(sides)))


def _spin(rows: Samples, testbed: Testbed) -> float:
    """Return the greatest mean rate (rad/s) of the heading, either way, over parts of the rows."""
    across = np.cross(testbed.up, np.eye(3)[int(np.argmin(np.abs(testbed.up)))])
    east, north, _ = (to_matrix(rows.values) @ across).T
    at = np.linspace(0, len(rows) - 1, PARTS + 1).astype(int)
    turned = np.diff(np.unwrap(np.arctan2(north, east))[at])
    return float(np.max(np.abs(turned) / np.diff(rows.t[at])))
