"""What it takes to identify half an hour at 100 Hz with gaps: seconds, memory, and how well."""

import time
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import Testbed
from tests.oracle import cases
from tests.support.peak_memory import peak_mb
from verification.chance import mean_square_band
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn
from verification.stated_errors import stated_correlation, stated_errors

MINUTES = (7.5, 15.0, 30.0)
LONGEST = 60.0 * MINUTES[-1]  # s
GAPS = ((300.0, 303.0), (900.0, 928.0), (1400.0, 1410.0))  # s
ROWS = 175_000
SECONDS, GIGABYTES, WORST = 20.0, 1.0, 4.0
WARM = 230.0  # s of record, dense enough to need every kernel
CAMERA, CAMERA_AND_GYRO = "camera", "camera and gyro"


class Task(NamedTuple):
    """One record to identify."""

    recording: Recording
    testbed: Testbed
    truth: MassProperties


class Found(NamedTuple):
    """What came of it."""

    rows: int
    seconds: float  # of one processor, kernels compiled
    gigabytes: float  # the most that the process ever held
    z: NDArray[np.float64]  # errors of com and inertia, in stated sd
    correlation: NDArray[np.float64]
    fine: bool  # usable, and no event found where there is none


def with_gaps(channel: Samples | None) -> Samples | None:
    """Return a channel without the rows in the gaps."""
    if channel is None:
        return None
    keep = np.ones(len(channel), dtype=bool)
    for start, end in GAPS:
        keep &= ~((channel.t > start) & (channel.t < end))
    return Samples(channel.t[keep], channel.values[keep])


def recorded(seed: int) -> Task:
    """Return half an hour of camera and gyro with three gaps."""
    logged = cases.dense(seed, LONGEST)
    whole = logged.recording
    attitude, rate = with_gaps(whole.attitude), with_gaps(whole.rate)
    return Task(replace(whole, attitude=attitude, rate=rate), logged.testbed, logged.truth)


def by_camera(task: Task) -> Task:
    """Return the same without the gyro."""
    recording, testbed = replace(task.recording, rate=None), replace(task.testbed, gyro=None)
    return Task(recording, testbed, task.truth)


def shorter(task: Task, minutes: float) -> Task:
    """Return the first minutes of it."""
    return task._replace(recording=window(task.recording, 0.0, 60.0 * minutes))


def identified(task: Task) -> Found:
    """Identify one record, once what it needs is compiled or loaded."""
    recording, testbed, truth = task
    reference_fit.estimate(window(recording, 0.0, WARM), testbed, Params())
    began = time.process_time()
    estimate = reference_fit.estimate(recording, testbed, Params())
    seconds = time.process_time() - began
    held = peak_mb() / 1e3
    z, correlation = stated_errors(estimate, truth), stated_correlation(estimate)
    rows = sum(len(c) for c in (recording.attitude, recording.rate) if c is not None)
    fine = estimate.outcome.usable and not estimate.events
    return Found(rows, seconds, held, z, correlation, fine)


def rows_of(sensors: str, found: Sequence[Found]) -> tuple[Row, ...]:
    """Return the rows of one set of sensors."""
    z = np.array([each.z for each in found])
    band = mean_square_band([each.correlation for each in found])
    return (
        at_least(f"{sensors}: rows of the shortest", min(f.rows for f in found), ROWS, "d"),
        at_most(f"{sensors}: processor time, s, slowest", max(f.seconds for f in found), SECONDS),
        at_most(f"{sensors}: memory, GB, greatest", max(f.gigabytes for f in found), GIGABYTES),
        at_most(f"{sensors}: greatest error / sd", float(np.abs(z).max()), WORST),
        between(f"{sensors}: mean square of error / sd", float(np.mean(z**2)), band),
        at_most(f"{sensors}: not usable, or with events", sum(not f.fine for f in found), 0, "d"),
    )


def lengths_of(found: Sequence[Found]) -> tuple[Row, ...]:
    """Return what records of different length take."""
    return tuple(
        at_most(
            f"camera, {minutes:g} min, {each.rows} rows: processor time, s", each.seconds, SECONDS
        )
        for minutes, each in zip(MINUTES, found, strict=True)
    )


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify half an hour for each seed, twice, and the first one in three lengths."""
    tasks = spread(recorded, seeds)
    alone = [by_camera(task) for task in tasks]
    claim = (
        "Half an hour at 100 Hz with gaps of 3, 28 and 10 s (MuJoCo, 14 kg, one move; camera of "
        "0.05 deg, gyro of 1e-4 rad/s and unknown bias; first guess of J 10 % off) is identified "
        f"in {SECONDS:g} s and {GIGABYTES:g} GB, and errors are as large as stated."
    )
    rows = (
        *rows_of(CAMERA, spread(identified, alone)),
        *rows_of(CAMERA_AND_GYRO, spread(identified, tasks)),
        *lengths_of(spread(identified, [shorter(alone[0], minutes) for minutes in MINUTES])),
    )
    return Result("long_record", claim, rows)
