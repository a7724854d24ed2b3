"""A step of every recursive estimator, beside the same filters in plain NumPy.

A gyro at 20 Hz and a camera at 5 Hz under known square-wave torques; the time is of a row, all
that leads to it included: prediction, correction, what is noted of it.
"""

import time
from typing import NamedTuple

import numpy as np

from benchmarks.ours import timed
from equipoise.estimation.filters import driver
from equipoise.estimation.filters.conclusion import noisy_rows
from equipoise.estimation.filters.rows import Rows, taken
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.ekf_6 import KIND as EKF_6
from equipoise.estimation.methods.ekf_9 import KIND as EKF_9
from equipoise.estimation.methods.ekf_12 import KIND as EKF_12
from equipoise.estimation.methods.kf_simplified import KIND as KF
from equipoise.estimation.methods.ukf_4 import KIND as UKF_4
from equipoise.estimation.methods.ukf_6 import KIND as UKF_6
from equipoise.estimation.methods.ukf_9 import KIND as UKF_9
from equipoise.estimation.methods.ukf_12 import KIND as UKF_12
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.linear_method import posed_of
from equipoise.estimation.regression.solvers.recursion import (
    Plan,
    passed,
    recursion_of,
    some,
    unfiltered,
)
from tests.estimation.filters import plain_filters
from tests.estimation.regression.solvers.plain_recursive import plain_rls
from tests.support.random_walk_records import guessed, square_waves, walked

KINDS = {
    "kf_simplified": KF, "ekf_6": EKF_6, "ekf_9": EKF_9, "ekf_12": EKF_12,
    "ukf_4": UKF_4, "ukf_6": UKF_6, "ukf_9": UKF_9, "ukf_12": UKF_12,
}  # fmt: skip
WANTED = {"ekf_6": 15.0, "ekf_9": 15.0, "ekf_12": 30.0, "ukf_12": 120.0}  # us, at most
PLAIN_ROWS, LENGTH, INERTIA_SD = 60, 60.0, 0.05


class Step(NamedTuple):
    """What a step takes."""

    name: str
    elements: int  # of the error state, what is considered included
    ours: float  # us
    plain: float  # us
    wanted: float | None  # us


def step_of(name: str) -> Step:
    """Return what a row takes."""
    kind = KINDS[name]
    record, _ = walked(1, LENGTH, square_waves(LENGTH))
    testbed = guessed(1, INERTIA_SD)
    found = noisy_rows(kind, record, testbed)
    assert found is not None
    rows, noise = found
    state = driver.begin(kind, testbed, noise)
    _, seconds = timed(lambda: driver.advance(state, rows), 15)
    twin = plain_filters.Plain(kind, testbed, state.model.axes, noise, driver.DEFAULT)
    plain = plain_seconds(twin, taken(rows, 0, PLAIN_ROWS)) / PLAIN_ROWS
    ours = 1e6 * seconds / len(rows.node)
    return Step(name, len(state.covariance), ours, 1e6 * plain, WANTED.get(name))


def regression() -> Step:
    """Return what a row of recursive least squares takes: nine unknowns and three constants."""
    record, _ = walked(1, LENGTH, square_waves(LENGTH))
    testbed = guessed(1, INERTIA_SD)
    rows = body_axes(posed_of(record, testbed, Options()))
    plan = Plan(unfiltered)
    known = recursion_of(plan, testbed, rows)
    _, seconds = timed(lambda: passed(plan, testbed, rows), 15)
    few = some(rows, slice(0, PLAIN_ROWS))
    began = time.perf_counter()
    plain_rls(known, few)
    plain = (time.perf_counter() - began) / PLAIN_ROWS
    size = len(rows.names) + 3
    return Step("momentum_recursive (RLS)", size, 1e6 * seconds / len(rows.t), 1e6 * plain, 10.0)


def plain_seconds(twin: plain_filters.Plain, rows: Rows) -> float:
    """Return the median seconds of three passes of the plain filter."""
    spent: list[float] = []
    for _ in range(3):
        began = time.perf_counter()
        plain_filters.run(twin, rows, plain_filters.begun(twin))
        spent.append(time.perf_counter() - began)
    return float(np.median(spent))


def table() -> list[Step]:
    """Return a row for every recursive estimator."""
    return [regression(), *(step_of(name) for name in KINDS)]
