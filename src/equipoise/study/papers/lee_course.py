"""Estimates and error indices along a record, as Lee et al. draw them (Eqs. 4-10, Figs. 10-16, 18).

At growing times t_j, of all rows up to then:

    x_j = (H^T H)^-1 H^T y,    EI and PEI of the same H and y      (``error_indices``)

Recursive least squares without forgetting (Eq. 8, W = E) that begin with a batch come to the same
at every t_j. Rows are those that the methods themselves solve, from the record's beginning (Eq. 6
has the rate at time zero), so the last estimate of a course is the method's own. Like theirs the
first one comes when the platform already turns: H is singular at rest.

Cannot see what biases x: rows are taken to err alike and independently.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.regression.error_indices import error_indices
from equipoise.estimation.regression.formulations.rows import Posed, Rows, centred
from equipoise.estimation.regression.linear_method import linear_of, posed_of, posed_rows
from equipoise.estimation.regression.solvers.least_squares import flat, solved
from equipoise.model.arrays import Floats, Series, Series1
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

DRAWN = ("averaged_printed", "averaged")  # methods
TURNING = np.radians(1.0)  # rad/s, chosen: fifty times the gyro's noise
BATCH = 2.0  # s, chosen: of rows that turn, before which nothing is estimated
EVERY = 1.0  # s
SMOOTHED = 20  # rows of the gyro, to see whether it turns


class Reported(NamedTuple):
    """Estimates from the rows up to each time; columns in the order of ``names``."""

    names: tuple[str, ...]
    t: Series1  # s
    values: Series  # (n, c) SI
    total: Floats  # (n,) EI
    parameter: Series  # (n, c) PEI as printed, in units of the values


class Courses(NamedTuple):
    """The courses of one slew, in the order of ``DRAWN``."""

    printed: Reported  # the rows as the paper has them
    corrected: Reported


def courses_of(recording: Recording, testbed: Testbed) -> Courses:
    """Return how estimates grow along a slew; InputError if the platform never turns."""
    posed, first = posed_of(recording, testbed, Options()), turning_from(recording) + BATCH
    return Courses(*(reported_along(rows_of(name, posed), first) for name in DRAWN))


def rows_of(name: str, posed: Posed) -> Rows:
    """Return the rows that a linear method solves, by its name."""
    linear = linear_of(METHODS[name])
    assert linear is not None
    return posed_rows(linear, posed, ())[0]


def turning_from(recording: Recording) -> float:
    """Return the time (s) from which the platform turns; InputError if it never does."""
    rate = recording.rate
    assert rate is not None
    kernel = np.ones(SMOOTHED) / SMOOTHED
    smooth = np.column_stack([np.convolve(w, kernel, "same") for w in rate.values.T])
    turns = np.flatnonzero(np.linalg.norm(smooth, axis=1) > TURNING)
    if not len(turns):
        raise InputError("recording", "no rate above 1 deg/s", "a platform that turns")
    return float(rate.t[turns[0]])


def reported_along(rows: Rows, first: float) -> Reported:
    """Return the course of estimates from a first time (s) to the last row."""
    end = float(rows.t[-1])
    times = np.append(np.arange(first, end, EVERY), end)
    reported = [reported_at(rows, t) for t in times]
    return Reported(
        rows.names, times, *(np.array(column) for column in zip(*reported, strict=True))
    )


def reported_at(rows: Rows, t: float) -> tuple[Floats, float, Floats]:
    """Return values, EI and PEI of the rows up to a time; nan where they determine nothing."""
    first = centred(rows_until(rows, t))
    H, y = flat(first)
    nothing = np.full(len(rows.names), np.nan)
    try:
        indices = error_indices(H, y)
    except InputError:
        return nothing, np.nan, nothing
    return solved(H.T @ H, H.T @ y), indices.index, indices.parameter


def rows_until(rows: Rows, t: float) -> Rows:
    """Return the rows up to a time, s."""
    n = int(np.searchsorted(rows.t, t, side="right"))
    piece = None if rows.piece is None else rows.piece[:n]
    return replace(rows, t=rows.t[:n], A=rows.A[:n], b=rows.b[:n], piece=piece)
