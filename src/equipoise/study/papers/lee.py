"""Lee et al.'s simulation: a large and a small slew by gyros, and what methods make of them.

Their platform starts at rest at roll, pitch and yaw (3-2-1, the roll axis vertical) and is brought
to zero by PID, with gains chosen so that the gyros meet a singularity:

    (70, 30, -30) deg      their section V, Figs. 3-16
    (30, 10, -10) deg      the same gains, Figs. 17 and 18

Gains are not printed. With those below the measure of the pyramid lies under 0.2 from 10 to 15 s of
the large slew (theirs: "at about 10~15 sec") and never in the small one.

Table 1 has a gyro's noise and no other error, so the gyro has no bias here; an attitude must have
some noise to be weighed by, and has 0.02 deg at 100 Hz. A bound shows what coarser sensors would
achieve (``coarser``).

Methods that share their record share its replicates.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.elements.attitude_pid import Gains
from equipoise.estimation.information.fisher_information import information_by
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.regression import linear_method
from equipoise.estimation.regression.linear_method import SPARE, linear_of, posed_of
from equipoise.estimation.regression.monte_carlo_replicates import PAIRS, Drawn, pairs
from equipoise.maths.attitude import from_euler321, level, multiply, to_euler321
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Quaternion, Series3
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.observability import Observability
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Testbed
from equipoise.study.papers.gyro_slew import Slew, slewed

LARGE, SMALL = (70.0, 30.0, -30.0), (30.0, 10.0, -10.0)  # deg: roll, pitch, yaw
DURATION = 100.0  # s, chosen: the slew is over after 60, the integral's tail after 100
FREQUENCY, DAMPING, INTEGRAL = 0.112, 0.5, 0.03  # rad/s, -, rad/s, chosen: singular at 10 to 15 s
MOST = 0.1  # N m, chosen: ten times the torque of the unbalance
NEAR = 0.2  # -, chosen: half of the measure below which steering gives way
ATTITUDE_RATE, ATTITUDE_NOISE = 100.0, np.radians(0.02)  # Hz, rad, chosen: next to none
COMPARED = ("averaged_printed", "averaged", "momentum_corrected", "trajectory")
SOUGHT = (*COM, *INERTIA)
UNKNOWNS = len(SOUGHT)


@dataclass(frozen=True, slots=True, eq=False)
class Manoeuvre:
    """One slew, and what was made of it."""

    start: tuple[float, float, float]  # deg
    testbed: Testbed
    slew: Slew
    estimates: dict[str, Estimate]  # by method
    bound: Observability  # of these sensors
    coarse_bound: Observability  # of the platform's own


def with_printed_errors(testbed: Testbed) -> Testbed:
    """Return the platform with the errors that the paper prints alone."""
    gyro = testbed.gyro
    assert gyro is not None
    attitude = AttitudeSensor(ATTITUDE_RATE, float(ATTITUDE_NOISE), plumb_sd=0.0)
    return replace(testbed, attitude=attitude, gyro=replace(gyro, bias_sd=0.0))


def attitude_at(testbed: Testbed, angles: Sequence[float]) -> Quaternion:
    """Return the attitude of roll, pitch and yaw (deg) from level."""
    return multiply(level(testbed.up), from_euler321(*np.radians(angles)))


def angles_of(testbed: Testbed, q: Quaternion) -> Series3:
    """Return roll, pitch and yaw (n, 3), rad, of attitudes (n, 4)."""
    turned = multiply(level(testbed.up) * np.array([1.0, -1.0, -1.0, -1.0]), q)
    return np.stack(to_euler321(turned), axis=-1)


def started(testbed: Testbed, angles: Sequence[float]) -> Testbed:
    """Return the platform, to be let go at roll, pitch and yaw (deg)."""
    assert testbed.truth is not None
    euler = np.array(to_euler321(attitude_at(testbed, angles)))
    return replace(testbed, truth=replace(testbed.truth, attitude=euler))


def gains_of(testbed: Testbed) -> Gains:
    """Return the loop of both slews; it knows the testbed's inertia."""
    return Gains(testbed.body.inertia_P, FREQUENCY, DAMPING, INTEGRAL, MOST)


def slew_from(
    testbed: Testbed, start: Sequence[float], seed: int, duration: float = DURATION
) -> Slew:
    """Return the slew from roll, pitch and yaw (deg) to zero, ``duration`` seconds of it."""
    bed = started(with_printed_errors(testbed), start)
    return slewed(bed, level(bed.up), gains_of(bed), duration, seed)


def estimates_of(recording: Recording, testbed: Testbed) -> dict[str, Estimate]:
    """Return what the compared methods make of a record."""
    posed = posed_of(recording, testbed, Options())
    draws = tuple(pairs(posed, Drawn(), max(PAIRS, UNKNOWNS + SPARE)))
    found = dict[str, Estimate]()
    for name in COMPARED:
        method, linear = METHODS[name], linear_of(METHODS[name])
        if linear is None:
            found[name] = method.run(recording, testbed, Options())
        else:
            found[name] = linear_method.estimate(method.card, linear, posed, (), draws)
    return found


def formulations() -> dict[str, str]:
    """Return what each method that is compared takes the motion to be."""
    return {name: METHODS[name].card.formulation for name in COMPARED}


def coarser(recording: Recording, testbed: Testbed) -> Recording:
    """Return the record with no more attitudes than the testbed's own sensor gives."""
    rows, sensor = recording.attitude, testbed.attitude
    assert rows is not None
    assert sensor is not None
    keep = slice(None, None, max(round(1.0 / (sensor.rate * rows.period)), 1))
    return replace(recording, attitude=Samples(rows.t[keep], rows.values[keep]))


def judged(testbed: Testbed, start: tuple[float, float, float], slew: Slew) -> Manoeuvre:
    """Return the estimates from a slew from roll, pitch and yaw (deg); the testbed is as stated."""
    bed = with_printed_errors(testbed)
    found = estimates_of(slew.recording, bed)
    bound = information_by(slew.recording, bed, Params())
    own = information_by(coarser(slew.recording, testbed), testbed, Params())
    return Manoeuvre(start, bed, slew, found, bound, own)


def singular_times(slew: Slew) -> tuple[float, float] | None:
    """Return the first and the last time (s) at which the gyros are near a singularity."""
    near = slew.t[slew.measure < NEAR]
    return (float(near[0]), float(near[-1])) if len(near) else None


def warns(estimate: Estimate) -> bool:
    """Say whether an estimate warns its reader not to rely on it: outcome or interval.

    No interval, or an infinite one, counts: a number without an interval is not known.
    """
    open_ended = not all(estimate.has(name) and estimate.sees((name,)) for name in SOUGHT)
    return estimate.outcome.warns or open_ended


def true_values(testbed: Testbed) -> dict[str, float]:
    """Return what an estimate should say, by name, SI."""
    truth = testbed.truth
    assert truth is not None
    assert truth.com is not None
    inertia = testbed.body.inertia_P if truth.inertia_P is None else truth.inertia_P
    return dict(zip(SOUGHT, map(float, (*truth.com, *pack_symmetric(inertia))), strict=True))
