"""Errors of `identify` on records made by MuJoCo, in units of the stated standard deviations."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.stats import chi2

from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.procedure.identify import IdentifyOptions, identify
from tests.oracle import mujoco_bench as oracle
from verification.chance import RARE
from verification.result import Result, Row, Spread, at_most, between, in_turn

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


def errors(case: str, seed: int) -> tuple[NDArray[np.float64], bool]:
    """Return the errors of com and inertia in stated sd, and whether the outcome is usable."""
    platform, recording, testbed = logged(case, seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    estimate = last.estimate
    true = np.concatenate([platform.com, pack_symmetric(platform.inertia_P)])
    sd = np.array([estimate.parameters[estimate.index(name)].sd for name in COM + INERTIA])
    return (estimate.values(COM + INERTIA) - true) / sd, estimate.outcome.usable


def square_band(platforms: int) -> tuple[float, float]:
    """Return the band of the mean square: as stated, or wider by chance with fewer platforms.

    Nine errors a platform, of which correlation leaves some five independent (measured on the
    information of twenty platforms: trace^2 of the correlation over its squared norm is 4 to 6).
    """
    if platforms >= STATED:
        return SQUARE
    low, high = chi2.ppf([RARE / 2, 1 - RARE / 2], 5 * platforms) / (5 * platforms)
    return float(min(low, SQUARE[0])), float(max(high, SQUARE[1]))


def rows_of(case: str, seeds: Sequence[int], spread: Spread) -> tuple[Row, ...]:
    """Return the rows of one set of sensors."""
    found = spread(partial(errors, case), seeds)
    z = np.array([each for each, _ in found])
    return (
        between(f"{case}: mean square of error / sd", float(np.mean(z**2)), square_band(len(seeds))),
        at_most(f"{case}: greatest error / sd", float(np.abs(z).max()), WORST),
        at_most(f"{case}: outcomes not usable", sum(not usable for _, usable in found), 0, "d"),
    )


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify one random platform for each seed, twice."""
    claim = (
        f"On MuJoCo's records of {len(seeds)} random platforms (4-40 kg, 120 s, one or two moves; "
        "first guess of J 10 % off), errors of centre of mass and inertia are as large as stated. "
        "Camera: 5 Hz, 0.2 deg; with gyro: both 50 Hz, 0.05 deg, 1e-4 rad/s and unknown bias."
    )
    rows = (*rows_of(CAMERA, seeds, spread), *rows_of(CAMERA_AND_GYRO, seeds, spread))
    return Result("mujoco_platforms", claim, rows)
