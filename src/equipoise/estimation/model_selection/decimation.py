"""Condensed: a dense record as means of neighbouring rows, for the search and the survey.

A camera of 100 Hz sees a swing of 30 s three thousand times. Means of k rows, T = k p long for rows
p apart, hold as much: of noise sd each becomes one of sd / sqrt(k), and of the information of a
motion of the frequency W only the share

    1 - (sin(x) / x)^2 = W^2 T^2 / 12,     x = W T / 2

is lost. A mean is predicted as one: ``sensors.timing`` takes the variance of its moments about
their middle, (k^2 - 1) p^2 / 12, and what that leaves out is W^4 T^4 / 1920 of the amplitude. How
far the platform turns within T, and the phase of its fastest swing, stay below ``TURNED``: the
share is 0.8 %, what is left out 4e-6.

Means do not reach over gaps; rows left over before one go. So the condensed record is for finding
out, and the answer is a fit of all rows that begins where its own ends.

Cannot see what happens within T, nor a swing faster than the testbed says there can be.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from equipoise.actuators.travel_times import unresolved_steps
from equipoise.estimation.model_selection.survey import ROWS, finest_spacing
from equipoise.estimation.output_error.problem import errors_of, quickest_swing
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.sampled.straight_pieces import straight_pieces
from equipoise.model.arrays import Ints
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed

DENSE = 20_000  # rows, chosen: fewer are surveyed within seconds as they are
TURNED = 0.3  # rad, chosen: see above
MOSTLY = 95  # % of the rows between which it turns by less
SLACK = 0.1  # of a mean's length, chosen: by which missing rows may make it longer
WHOLE = 0.9  # chosen: share of the rows that must be part of some mean
DENSEST = 4  # rows, below which no row is the mean of others
FINE = 1e-2  # chosen: lines are off for parts of a second, to either side
Turn = Callable[[Samples, int], float]
Sensor = TypeVar("Sensor", AttitudeSensor, Gyro)


@dataclass(frozen=True, slots=True, eq=False)
class Condensed:
    """A record of means."""

    recording: Recording
    testbed: Testbed  # whose sensors report such means
    attitude_rows: int  # k
    rate_rows: int


def first_rows(channel: Samples, k: int) -> Ints:
    """Return where means of k rows begin that follow each other without a gap."""
    t, longest = channel.t, (k - 1) * channel.period * (1 + SLACK)
    found: list[int] = []
    first = 0
    while first + k <= len(t):
        if t[first + k - 1] - t[first] <= longest:
            found.append(first)
            first += k
        else:
            first += 1 + int(np.argmax(np.diff(t[first : first + k])))
    return np.array(found, dtype=np.int64)


def mean_rows(channel: Samples, k: int) -> Samples:
    """Return the means of k rows at their mean times."""
    rows = first_rows(channel, k)[:, None] + np.arange(k)
    return Samples(channel.t[rows].mean(axis=1), channel.values[rows].mean(axis=1))


def mean_attitudes(attitude: Samples, k: int) -> Samples:
    """Return the means of k attitudes: of their turns (body axes) from the one in the middle."""
    rows = first_rows(attitude, k)[:, None] + np.arange(k)
    middle = attitude.values[rows[:, k // 2]]
    turns = difference(attitude.values[rows], middle[:, None])
    return Samples(attitude.t[rows].mean(axis=1), multiply(middle, exponential(turns.mean(axis=1))))


def averaged(sensor: Sensor, k: int, period: float) -> Sensor:
    """Return the sensor whose rows are means of k, stamped with their mean time."""
    averaging = float(np.sqrt(sensor.averaging**2 + (k * k - 1) * period**2))
    delay = sensor.delay + 0.5 * (sensor.averaging - averaging)
    noise = sensor.noise / k**0.5
    return replace(sensor, rate=sensor.rate / k, noise=noise, averaging=averaging, delay=delay)


def swing_of(recording: Recording, testbed: Testbed) -> float:
    """Return the fastest swing (rad/s) that there can be, with the masses as far out as they go."""
    aside, masses = 0.0, recording.masses
    if masses is not None and len(masses):
        heavy = np.array([mass.mass for mass in testbed.masses])
        aside = float(np.abs(masses.values).max(axis=0) @ heavy) / testbed.body.mass
    return quickest_swing(testbed, aside)


def turned(attitude: Samples, k: int) -> float:
    """Return by how much (rad) the platform turns within k rows, mostly."""
    turns = difference(attitude.values[k:], attitude.values[:-k])
    return float(np.percentile(np.linalg.norm(turns, axis=1), MOSTLY))


def swept(rate: Samples, k: int) -> float:
    """Return by how much (rad) the platform turns within k rows of the gyro, mostly."""
    speed = np.percentile(np.linalg.norm(rate.values, axis=1), MOSTLY)
    return k * float(speed * rate.period)


def most_rows(channel: Samples | None, longest: float, turn: Turn) -> int:
    """Return how many rows a mean may be of: a power of two, 1 where means say less."""
    k = 1
    if channel is None or len(channel) < DENSEST:
        return k
    period = channel.period
    while 2 * k * period <= longest and turn(channel, 2 * k) <= TURNED:
        k *= 2
    return k if k * len(first_rows(channel, k)) >= WHOLE * len(channel) else 1


def open_rows(track: Samples, testbed: Testbed) -> Ints:
    """Return the rows between which a travel is unresolved: how long they are apart counts."""
    steps = unresolved_steps(track, testbed.masses).any(axis=1)
    return np.flatnonzero(np.append(steps, False) | np.append(False, steps))


def rows_of_means(recording: Recording, testbed: Testbed) -> tuple[int, int]:
    """Return how many rows of camera and gyro a mean is of; 1 where a record is not dense."""
    if recording.rows < DENSE:
        return 1, 1
    # s, of a mean: for the fastest swing, and for events to be found
    longest = min(TURNED / swing_of(recording, testbed), finest_spacing(recording) / ROWS)
    attitude, rate = recording.attitude, recording.rate
    return most_rows(attitude, longest, turned), most_rows(rate, longest, swept)


def with_few_bends(recording: Recording, testbed: Testbed) -> Recording:
    """Return the recording with displacements as few straight lines.

    What these are off by, d, would make the platform lean by m g d / (J W^2), W being its fastest
    swing: less than ``FINE`` of the noise of a row, or mean of rows, that the search is given.
    Unchanged where it would hide a stop.
    """
    masses, sensors = recording.masses, (testbed.attitude, testbed.gyro)
    if masses is None or len(masses) < DENSEST:
        return recording
    swing, means = swing_of(recording, testbed), rows_of_means(recording, testbed)
    units = (1.0, 1.0 / swing)  # a rate that is off turns the platform meanwhile
    sizes = zip(sensors, units, means, strict=True)
    noise = min(s.noise * x / k**0.5 for s, x, k in sizes if s is not None)
    moment = float(np.linalg.eigvalsh(testbed.body.inertia_P)[0])
    heavy = np.array([mass.mass for mass in testbed.masses]) * testbed.gravity
    tolerance = FINE * noise * moment * swing**2 / heavy
    firm = open_rows(masses, testbed)
    few = Samples(*straight_pieces(masses.t, masses.values, tolerance, firm))
    found = replace(recording, masses=few)
    same = errors_of(found, testbed).names == errors_of(recording, testbed).names
    return found if same else recording


def condensed(recording: Recording, testbed: Testbed) -> Condensed | None:
    """Return a dense record as one of means; None if it is not dense enough."""
    attitude, rate = recording.attitude, recording.rate
    k_q, k_w = rows_of_means(recording, testbed)
    if k_q == k_w == 1:
        return None
    camera, gyro = testbed.attitude, testbed.gyro
    if attitude is not None and camera is not None and k_q > 1:
        camera = averaged(camera, k_q, attitude.period)
        attitude = mean_attitudes(attitude, k_q)
    if rate is not None and gyro is not None and k_w > 1:
        gyro = averaged(gyro, k_w, rate.period)
        rate = mean_rows(rate, k_w)
    few = replace(recording, attitude=attitude, rate=rate, attitude_norm=None)
    observed = replace(testbed, attitude=camera, gyro=gyro)
    return Condensed(few, observed, k_q, k_w)
