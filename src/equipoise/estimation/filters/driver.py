"""One driver for every filter: begin, then advance by as many rows as there are.

A file is one call with all its rows, a live bench one call for each row or chunk: the same code,
and the same numbers to the last bit. States are not changed; to go back, keep one.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.estimation.filters.model import (
    Kind,
    Model,
    Walks,
    axes_of,
    column_of,
    first_covariance,
    initial_state,
    model_of,
)
from equipoise.estimation.filters.predict import work_of
from equipoise.estimation.filters.rows import Rows
from equipoise.estimation.filters.walk import NOTED, follow
from equipoise.model.arrays import Floats, Series1, Square
from equipoise.model.estimate import COM, INERTIA, Course
from equipoise.model.testbed import Testbed

DEFAULT = Walks()


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The state of a filter after a row."""

    kind: Kind
    model: Model
    names: tuple[str, ...]  # of what is reported
    shown: Floats  # (names, 9) com and J to what is reported
    mean: Floats  # (16,) q, H (N m s), com (m), J (kg m^2), masses at home
    covariance: Square  # (n, n) of the error state, see ``model``


@dataclass(frozen=True, slots=True, eq=False)
class Passed:
    """The estimate after each row of a call."""

    course: Course
    surprise: Series1  # squared innovation over its covariance, 3 degrees of freedom; NaN: none


def shown_of(kind: Kind, testbed: Testbed) -> tuple[tuple[str, ...], Floats]:
    """Return what a filter reports by name, and how it is made of com and J."""
    one = column_of(kind, testbed.up)
    if one is not None:
        name, sign = one
        along = sign * axes_of(kind, testbed.up)[:, 0]
        return (name,), np.concatenate([along, np.zeros(6)])[None, :]
    return ((*COM, *INERTIA), np.eye(9)) if kind.estimated == 12 else (COM, np.eye(9)[:3])


def begin(kind: Kind, testbed: Testbed, noise: float, walks: Walks = DEFAULT) -> State:
    """Return the prior, before the first row; ``noise`` (rad or rad/s): one sd of a row."""
    model = model_of(kind, testbed, noise**2, walks)
    mean, covariance = initial_state(kind, testbed), first_covariance(kind, model, testbed)
    return State(kind, model, *shown_of(kind, testbed), mean, covariance)


def advance(state: State, rows: Rows) -> tuple[State, Passed]:
    """Return the state after some more rows, and the estimate after each."""
    mean, P = state.mean.copy(), state.covariance.copy()
    out = np.empty((len(rows.node), NOTED))
    follow(state.model, rows, mean, P, work_of(len(P)), out)
    t, values, sd, surprise = np.split(out, [1, 10, 19], axis=1)
    # summed row by row, so that a row is the same number however many come with it
    shown = np.sum(values[:, None, :] * state.shown, axis=2)
    course = Course(state.names, t[:, 0], shown, sd[:, : len(state.names)])
    after = State(state.kind, state.model, state.names, state.shown, mean, P)
    return after, Passed(course, surprise[:, 0])


def reported(state: State) -> tuple[Floats, Square]:
    """Return values of what is reported and their covariance, SI."""
    row, n = 6 if state.kind.attitude else 3, len(state.names)
    return state.shown @ state.mean[7:], state.covariance[row : row + n, row : row + n]
