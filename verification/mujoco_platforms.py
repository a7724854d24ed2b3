"""Errors of `identify` on records made by MuJoCo, in units of the stated standard deviations."""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from tests.oracle import mujoco_bench as oracle
from verification.chance import mean_square_band
from verification.result import Result, Row, Spread, at_most, between, in_turn
from verification.stated_errors import stated_correlation, stated_errors

STATED = 20  # platforms for which the claim is stated
SQUARE = (0.7, 1.4)
WORST = 4.0  # sd
CAMERA, CAMERA_AND_GYRO = "camera", "camera and gyro"
SHARP = np.radians(0.05)
BIAS = np.array([1e-3, -2e-3, 5e-4])  # rad/s


def logged(case: str, seed: int) -> tuple[oracle.Platform, Recording, Testbed]:
    """Return a random platform, what its sensors recorded, and what is known beforehand."""
    rng = np.random.default_rng(seed)
    platform = oracle.random_platform(rng)
    run = oracle.simulate(platform, oracle.random_schedule(rng, platform))
    if case == CAMERA:
        recording = oracle.sensor_log(run, rng)
        camera = AttitudeSensor(5.0, np.radians(0.2))
        return platform, recording, oracle.testbed_for(platform, rng, attitude=camera)
    recording = oracle.sensor_log(run, rng, 50.0, SHARP, 50.0, 1e-4, BIAS)
    camera, gyro = AttitudeSensor(50.0, SHARP), Gyro(50.0, 1e-4, np.radians(1.0))
    return platform, recording, oracle.testbed_for(platform, rng, attitude=camera, gyro=gyro)


class Found(NamedTuple):
    """One record identified."""

    z: NDArray[np.float64]  # errors of com and inertia, in stated sd
    correlation: NDArray[np.float64]  # of these nine, as stated
    usable: bool


def identified(case: str, seed: int) -> Found:
    """Identify one record."""
    platform, recording, testbed = logged(case, seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    estimate = last.estimate
    z, correlation = stated_errors(estimate, platform), stated_correlation(estimate)
    return Found(z, correlation, estimate.outcome.usable)


def square_band(found: Sequence[Found]) -> tuple[float, float]:
    """Return the band of the mean square: as stated, or with fewer platforms wider by chance."""
    if len(found) >= STATED:
        return SQUARE
    low, high = mean_square_band([each.correlation for each in found])
    return min(low, SQUARE[0]), max(high, SQUARE[1])


def rows_of(case: str, seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows of one set of sensors."""
    found = spread(partial(identified, case), seeds)
    z = np.array([each.z for each in found])
    return (
        between(f"{case}: mean square of error / sd", float(np.mean(z**2)), square_band(found)),
        at_most(f"{case}: greatest error / sd", float(np.abs(z).max()), WORST),
        at_most(f"{case}: outcomes not usable", sum(not each.usable for each in found), 0, "d"),
    )


def measure(
    seeds: Sequence[int],
    spread: Spread = in_turn,
    cases: Sequence[str] = (CAMERA, CAMERA_AND_GYRO),
) -> Result:
    """Identify one random platform for each seed, with each set of sensors."""
    claim = (
        f"On MuJoCo's records of {len(seeds)} random platforms (4-40 kg, 120 s, one or two moves; "
        "first guess of J 10 % off), errors of centre of mass and inertia are as large as stated. "
        "Camera: 5 Hz, 0.2 deg; with gyro: both 50 Hz, 0.05 deg, 1e-4 rad/s and unknown bias."
    )
    rows = tuple(row for case in cases for row in rows_of(case, seeds, spread))
    return Result("mujoco_platforms", claim, rows)
