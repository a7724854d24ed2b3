"""Platforms without a camera on MuJoCo's truth: errors beside the bound, and intervals.

The bound is that of the rows and of what is stated beforehand, at the true body, motion and zeros
of the sensors (``tests.oracle.test_vector_bound`` has it from MuJoCo alone).
"""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.model.estimate import NORMAL_95
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.sensor_terms import TERMS
from tests.oracle.vector_records import LEE, MPU6050, Case, Kit, case
from verification.chance import FULL, binomial_band, leaving, ratio_limits, share_band
from verification.result import Result, Row, Spread, at_most, between, in_turn
from verification.stated_errors import NAMES, stated_sd, true_values

KITS = {"gyro and accelerometer": MPU6050, "sun sensor, accelerometer and gyro": LEE}
LIMIT = 1.15  # RMSE / bound
COVER = (0.92, 0.98)

Array = NDArray[np.float64]


class Run(NamedTuple):
    """One record identified. Arrays are in the order of ``NAMES``."""

    error: Array  # estimate - truth
    stated: Array  # sd
    bound: Array  # covariance (9, 9)
    usable: bool


def true_point(problem: Problem, record: Case) -> Unknowns:
    """Return the truth as a point of the search; the masses' errors are zero."""
    platform, errors = record.platform, dict(record.errors)
    about_C = platform.inertia_P - parallel_axis(platform.mass, platform.com)
    gyro_bias, sensor = errors.pop("gyro_bias"), np.zeros(len(TERMS))
    for name, error in errors.items():
        first = TERMS.index(f"{name}_x")
        sensor[first : first + 3] = error
    return Unknowns(
        platform.q, platform.rate, pseudo_inertia.from_inertia(about_C), platform.com,
        np.zeros(N_TORQUES), sensor, np.zeros(len(problem.layout.errors)), gyro_bias,
    )  # fmt: skip


def information_of(record: Case) -> tuple[tuple[str, ...], Array]:
    """Return the unknowns of a record and the information about them, at the truth."""
    problem = fit(record.recording, record.testbed, Params()).problem
    return problem.layout.names, evaluate(problem, true_point(problem, record)).normal


def bound_of(record: Case, known: tuple[str, ...] = ()) -> Array:
    """Return the least covariance of centre of mass and inertia, in the order of ``NAMES``.

    What begins with one of the words ``known`` is no unknown.
    """
    names, information = information_of(record)
    free = [k for k, name in enumerate(names) if not name.startswith(known)]
    where = [[names[k] for k in free].index(name) for name in NAMES]
    return np.linalg.inv(information[np.ix_(free, free)])[np.ix_(where, where)]


def identified(kit: Kit, seed: int) -> Run:
    """Identify the record of one platform."""
    record = case(seed, kit)
    estimate = reference_fit.estimate(record.recording, record.testbed, Params())
    error = estimate.values(NAMES) - true_values(record.platform)
    return Run(error, stated_sd(estimate), bound_of(record), estimate.outcome.usable)


def ratio_rows(title: str, runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return RMSE over bound. Each error counts in units of its own run's bound."""
    n = len(runs)
    error = np.array([run.error / np.sqrt(np.diag(run.bound)) for run in runs])
    ratio = np.sqrt(np.mean(error**2, axis=0))
    chance = ratio_limits(runs[0].bound, n) if n < FULL else (0.0, 0.0)
    worst = int(np.argmax(ratio))
    return (
        at_most(f"{title}: RMSE / bound, mean of nine", float(ratio.mean()), max(LIMIT, chance[0])),
        at_most(
            f"{title}: RMSE / bound, greatest ({NAMES[worst]})", float(ratio[worst]),
            max(LIMIT, chance[1]),
        ),
    )  # fmt: skip


def cover_rows(title: str, runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return how many 95 % intervals hold the truth: all together, and the two extremes."""
    z = np.array([run.error / run.stated for run in runs])
    inside = np.mean(np.abs(z) < NORMAL_95, axis=0)
    low, high = int(np.argmin(inside)), int(np.argmax(inside))
    band = share_band(COVER, 0.95, len(runs))
    each = binomial_band(0.95, len(runs), len(NAMES))
    return (
        between(f"{title}: share of 95 % intervals that hold", float(inside.mean()), band),
        between(f"{title}: least of nine ({NAMES[low]})", float(inside[low]), each),
        between(f"{title}: greatest of nine ({NAMES[high]})", float(inside[high]), each),
    )


def rows_of(title: str, runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows of one kit of sensors."""
    unusable = sum(not run.usable for run in runs)
    return (
        *ratio_rows(title, runs),
        *cover_rows(title, runs),
        at_most(f"{title}: outcomes not usable", unusable, 0, "d"),
    )


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify one random platform for each seed, with each kit of sensors."""
    claim = (
        f"Without a camera, on MuJoCo's records of {len(seeds)} random platforms (4-40 kg, 120 s, "
        "one or two moves): errors of centre of mass and inertia are at the bound, and as large as "
        "stated. Gyro and accelerometer: 100 Hz, 0.05 deg/s, 0.033 m/s^2, zeros off by 2 deg/s and "
        "0.5 m/s^2, axes by 0.5 deg. Sun sensor, accelerometer and gyro: 0.1 deg and 0.017 m/s^2 "
        "at 10 Hz, 0.018 deg/s at 100 Hz, axes by 0.5 deg."
    )
    runs: dict[str, list[Run]] = {
        title: spread(partial(identified, kit), seeds) for title, kit in KITS.items()
    }
    left = max(leaving(COVER, [run.bound for run in each], len(seeds)) for each in runs.values())
    note = (
        f"Perfect 95 % intervals of nine parameters hold in less than {COVER[0]:.0%} or in more "
        f"than {COVER[1]:.0%} of so many seeds for at least one of them in {left:.0%} of all "
        "runs of this check; so single parameters have the band that chance leaves once in a "
        "thousand runs, all together the claimed one."
    )
    rows = tuple(row for title, each in runs.items() for row in rows_of(title, each))
    return Result("vector_sensors", claim, rows, (note,))
