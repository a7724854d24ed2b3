"""Recursive least squares as a solver: where it begins, what its rows are worth, where it ends.

It begins at what the testbed says of J, com and torques, so loosely that the record decides (one
sd: J itself, ten times the sd stated of com); or, as Lee does, with least squares on the first
seconds, which ask for no start, once the platform turns: at rest noise alone would determine J.
Nothing is forgotten by default: J and com are constant, and old
rows say as much of them as new ones. ``Plan.forget`` (s) is for a com that drifts or steps; J
should then be held, or the motion never rest.

Rows are worth what the gyro's noise makes of them: momentum errs by J_ii times it, slopes and means
by as much more or less as their filter passes.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.regression.formulations import averaged, tracked
from equipoise.estimation.regression.formulations.rows import Rows, guess_of
from equipoise.estimation.regression.formulations.torque import window_of
from equipoise.estimation.regression.solvers.least_squares import Aid, Solver
from equipoise.estimation.regression.solvers.recursive import (
    Recursion,
    State,
    advance,
    begin,
    begin_with,
)
from equipoise.maths.linalg import element_sizes
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats, Series, Series1
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.testbed import Testbed

LOOSE = 10.0  # chosen: times the stated sd of com, so that a start weighs a hundredth of it
NEAREST = 1e-5  # m, chosen: least sd stated of com that is used at the start
FASTEST = 1.0  # rad/s, chosen: no platform turns faster; for momentum at the start of a piece
FIRST = 10.0  # s, chosen: of the batch to begin with, doubled until all is observable
TURNS = 10.0  # chosen: times the noise of a momentum, rms of a batch that begins
UNKNOWN = 1e-3  # rad/s, chosen: noise of rates that no gyro of the testbed gives
TORQUE_SD = {  # chosen: a hundred times what air bearings show
    "viscous": 1e-2,
    "quadratic": 1.0,
    "constant": 1e-2,
    "swirl": 1e-2,
    "sag": 1e-3,
    "drift": 1e-4,
    "thermal": 1e-3,
}

Share = Callable[[Series1], float]


@dataclass(frozen=True, slots=True)
class Plan:
    """What distinguishes one recursion from another."""

    share: Share  # of the noise of a momentum that the filter passes, from the rows' times
    by_moments: bool = True  # rows are momenta or torques, not rates
    batch: bool = False  # begin with least squares on the first rows
    forget: float = np.inf  # s


class Passed(NamedTuple):
    """The estimate after each row."""

    state: State
    values: Series  # (n, c); stands still until a batch's end
    sd: Series  # (n, c) by P


def period_of(t: Series1) -> float:
    """Return the median step, s."""
    return float(np.median(np.diff(t))) if len(t) > 1 else 1.0


def unfiltered(t: Series1) -> float:
    """Return the share of rows as they are."""
    return 1.0


def of_increments(t: Series1) -> float:
    """Return the share of differences of neighbours."""
    return 2**0.5


def of_means(t: Series1) -> float:
    """Return the share of Lee's means."""
    return averaged.ROWS**-0.5


def of_slopes(t: Series1) -> float:
    """Return the share (1/s) of a line's slope through a window."""
    n = window_of(period_of(t), max(len(t), 3))
    return float(np.sqrt(12.0 / n**3)) / period_of(t)


def of_tracking(t: Series1) -> float:
    """Return the share (1/s) of white noise behind s F F."""
    period = period_of(t)
    return float(np.sqrt(period / (32.0 * (tracked.PERIODS * period) ** 3)))


def of_extended(t: Series1) -> float:
    """Return the share of white noise behind F."""
    return float(np.sqrt(1.0 / (4.0 * tracked.PERIODS)))


def start_sd(testbed: Testbed, names: tuple[str, ...]) -> Floats:
    """Return one sd of the start by name: loose."""
    sd = {name: TORQUE_SD[name.split("_")[0]] for name in torque_terms.TERMS}
    sd |= dict(zip(INERTIA, element_sizes(testbed.body.inertia_P), strict=True))
    sd |= dict(zip(COM, LOOSE * np.maximum(testbed.com_sd, NEAREST), strict=True))
    return np.array([float(sd[name]) for name in names])


def rate_noise(plan: Plan, testbed: Testbed, rows: Rows) -> float:
    """Return one sd of the rates behind the plan's filter, rad/s, or of their slopes."""
    rate = testbed.gyro.noise if testbed.gyro and testbed.gyro.noise > 0 else UNKNOWN
    return plan.share(rows.t) * rate


def noise_of(plan: Plan, testbed: Testbed, rows: Rows) -> Floats:
    """Return one sd of each equation of a row."""
    moments = np.diag(testbed.body.inertia_P) if plan.by_moments else np.ones(3)
    return rate_noise(plan, testbed, rows) * moments


def turns(rows: Rows, noise: float) -> bool:
    """Say whether what multiplies each sought moment is far above its noise (rad/s), rms."""
    moments = [(a, rows.names.index(J)) for a, J in enumerate(INERTIA[:3]) if J in rows.names]
    rms = [float(np.std(rows.A[:, a, i])) for a, i in moments]
    return all(size > TURNS * noise for size in rms)


def recursion_of(plan: Plan, testbed: Testbed, rows: Rows) -> Recursion:
    """Return where a plan begins on a testbed, and what it may forget."""
    sd = start_sd(testbed, rows.names)
    stated = dict.fromkeys(INERTIA, testbed.inertia_sd) | dict.fromkeys(COM, 1.0 / LOOSE)
    return Recursion(
        guess_of(rows, testbed),
        sd,
        noise_of(plan, testbed, rows),
        FASTEST * float(np.trace(testbed.body.inertia_P)),
        sd * np.array([stated.get(name, 1.0) for name in rows.names]),
        plan.forget,
    )


def some(rows: Rows, part: slice) -> Rows:
    """Return some of the rows."""
    piece = None if rows.piece is None else rows.piece[part]
    return replace(rows, t=rows.t[part], A=rows.A[part], b=rows.b[part], piece=piece, omitted=None)


def batch_start(recursion: Recursion, rows: Rows, noise: float) -> tuple[State, int]:
    """Return the state after a batch that turns and shows everything; else the loose start.

    With it the number of its rows; ``noise`` is that of the rates in them.
    """
    span = FIRST
    while len(rows.t) and span < 2 * (rows.t[-1] - rows.t[0]):
        n = int(np.count_nonzero(rows.t <= rows.t[0] + span))
        first = some(rows, slice(None, n))
        state = begin_with(recursion, first) if turns(first, noise) else None
        if state is not None:
            return state, n
        span *= 2
    return begin(recursion, rows.piece is not None), 0


def passed(plan: Plan, testbed: Testbed, rows: Rows) -> Passed:
    """Return the estimate after each row."""
    recursion, n = recursion_of(plan, testbed, rows), 0
    state = begin(recursion, rows.piece is not None)
    if plan.batch:
        state, n = batch_start(recursion, rows, rate_noise(plan, testbed, rows))
    c = len(rows.names)
    first, first_sd = state.x[:c], np.sqrt(np.diag(state.P)[:c])
    state, values, sd = advance(recursion, state, some(rows, slice(n, None)))
    before = np.ones((n, 1))
    return Passed(state, np.vstack([before * first, values]), np.vstack([before * first_sd, sd]))


def recursive(plan: Plan) -> Solver:
    """Return the solver of a plan: the estimate after the last row."""

    def solve(rows: Rows, aid: Aid) -> Floats:
        return passed(plan, aid.testbed, rows).state.x[: len(rows.names)]

    return solve
