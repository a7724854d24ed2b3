"""Recursive methods: rows of some formulation, each used once, and what is concluded from them.

All begin at what the testbed says of J, com and torques, so loosely that the record decides (one
sd: J itself, ten times the sd stated of com); or, as Lee does, with least squares on the first
seconds, which ask for no start. Nothing is forgotten by default: J and com are constant, and old
rows say as much of them as new ones. ``Plan.forget`` (s) is for a com that drifts or steps; J
should then be held, or the motion never rest.

The covariance is P times the mean square of what is left of the rows, widened for the correlation
of neighbours. It takes the columns for exact: noise in the rates also pulls J towards zero, which
it does not know.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise import __version__
from equipoise.estimation.formulations.rows import (
    Formulation,
    Posed,
    Rows,
    centred,
    held,
    values_of,
)
from equipoise.estimation.led_motion import led_motion
from equipoise.estimation.method import Card, Options, refused
from equipoise.estimation.observability import OPEN
from equipoise.estimation.solvers.recursive import (
    Recursion,
    State,
    advance,
    begin,
    begin_with,
)
from equipoise.maths.linalg import element_sizes, lag_one, unpack_symmetric
from equipoise.model import torque_terms
from equipoise.model.arrays import Floats, Series, Square, Vector3
from equipoise.model.estimate import COM, INERTIA, Course, Estimate, Parameter, Residual
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed

FEWEST = 12  # rows
LOOSE = 10.0  # chosen: times the stated sd of com, so that a start weighs a hundredth of it
FASTEST = 1.0  # rad/s, chosen: no platform turns faster; for momentum at the start of a piece
FIRST = 10.0  # s, chosen: of the batch that a recursion may begin with, doubled until it is seen
TORQUE_SD = {  # chosen: a hundred times what air bearings show
    "viscous": 1e-2,
    "quadratic": 1.0,
    "constant": 1e-2,
    "swirl": 1e-2,
    "sag": 1e-3,
    "drift": 1e-4,
}
NOTE = (
    " Noise in the rates biases a linear estimate of the inertia towards zero, and the intervals "
    "do not know it: use the trajectory method for numbers to rely on."
)


@dataclass(frozen=True, slots=True)
class Plan:
    """What tells one recursive method from another."""

    rows: Formulation
    noise: Callable[[Posed], Vector3]  # one sd of each equation of a row
    batch: bool = False  # begin with least squares on the first rows
    forget: float = np.inf  # s


class Solved(NamedTuple):
    """What the rows come to."""

    values: Floats  # (c,)
    covariance: Square  # P of the unknowns
    course: Series  # (n, c) after each row
    course_sd: Series  # (n, c) by P


def start_sd(testbed: Testbed, names: tuple[str, ...]) -> Floats:
    """Return one sd of the start by name: loose."""
    sd = {name: TORQUE_SD[name.split("_")[0]] for name in torque_terms.TERMS}
    sd |= dict(zip(INERTIA, element_sizes(testbed.body.inertia_P), strict=True))
    sd |= dict(zip(COM, LOOSE * testbed.com_sd, strict=True))
    return np.array([float(sd[name]) for name in names])


def recursion_of(plan: Plan, posed: Posed, names: tuple[str, ...]) -> Recursion:
    """Return where a plan begins on a testbed, and what it may forget."""
    testbed, sd = posed.testbed, start_sd(posed.testbed, names)
    known = values_of(testbed)
    stated = dict.fromkeys(INERTIA, testbed.inertia_sd) | dict.fromkeys(COM, 1.0 / LOOSE)
    return Recursion(
        np.array([known.get(name, 0.0) for name in names]),
        sd,
        plan.noise(posed),
        FASTEST * float(np.trace(testbed.body.inertia_P)),
        sd * np.array([stated.get(name, 1.0) for name in names]),
        plan.forget,
    )


def first_of(rows: Rows, n: int) -> tuple[Rows, Rows]:
    """Return the first n rows, and the others."""

    def some(part: slice) -> Rows:
        piece = None if rows.piece is None else rows.piece[part]
        return Rows(rows.t[part], rows.A[part], rows.b[part], rows.names, piece)

    return some(slice(None, n)), some(slice(n, None))


def batch_start(recursion: Recursion, rows: Rows) -> tuple[State, int]:
    """Return the state after a batch that sees everything, and its rows; else the loose start."""
    span = FIRST
    while len(rows.t) and span < 2 * (rows.t[-1] - rows.t[0]):
        n = int(np.count_nonzero(rows.t <= rows.t[0] + span))
        state = begin_with(recursion, first_of(rows, n)[0])
        if state is not None:
            return state, n
        span *= 2
    return begin(recursion, rows.piece is not None), 0


def solve(plan: Plan, posed: Posed, rows: Rows) -> Solved:
    """Return what the rows come to; a course stands still until a batch's end."""
    recursion, n = recursion_of(plan, posed, rows.names), 0
    state = begin(recursion, rows.piece is not None)
    if plan.batch:
        state, n = batch_start(recursion, rows)
    c, (_, others) = len(rows.names), first_of(rows, n)
    first, first_sd = state.x[:c], np.sqrt(np.diag(state.P)[:c])
    state, values, sd = advance(recursion, state, others)
    return Solved(
        state.x[:c],
        state.P[:c, :c],
        np.vstack([np.tile(first, (n, 1)), values]),
        np.vstack([np.tile(first_sd, (n, 1)), sd]),
    )


def rows_of(plan: Plan, posed: Posed, hold: tuple[str, ...]) -> Rows:
    """Return the rows, without what is held."""
    rows = plan.rows(posed)
    return held(rows, posed.testbed, hold) if hold else rows


def run(
    card: Card, plan: Plan, recording: Recording, testbed: Testbed, options: Options
) -> Estimate:
    """Return what a plan makes of a record."""
    recording = arranged(recording, testbed.mass_names)
    terms = torque_terms.among((*testbed.disturbances, *options.terms))
    posed = Posed(recording, testbed, led_motion(recording, testbed), terms)
    if len(posed.motion.t) < FEWEST:
        return refused(card, f"Only {len(posed.motion.t)} rows: the regression has nothing to fit.")
    rows = rows_of(plan, posed, options.hold)
    if len(rows.t) < FEWEST:
        return refused(card, f"Only {len(rows.t)} rows are left behind the filter.")
    if not np.any(rows.b):
        return refused(card, f"Nothing known acts: {OPEN}.")
    return concluded(card, plan, posed, rows)


def concluded(card: Card, plan: Plan, posed: Posed, rows: Rows) -> Estimate:
    """Return the estimate that the rows come to."""
    found, noise = solve(plan, posed, rows), plan.noise(posed)
    middle = centred(rows)
    left = (middle.b - middle.A @ found.values) / noise
    n, correlation = left.size - len(found.values), min(max(lag_one(left), 0.0), 0.99)
    chi_square = float(np.sum(left**2))
    wider = chi_square / n * (1 + correlation) / (1 - correlation)
    order = [rows.names.index(name) for name in (*COM, *INERTIA) if name in rows.names]
    order += [k for k in range(len(rows.names)) if k not in order]
    names = tuple(rows.names[k] for k in order)
    values, covariance = found.values[order], wider * found.covariance[np.ix_(order, order)]
    course_sd = wider**0.5 * found.course_sd[:, order]
    recording = posed.recording
    return Estimate(
        card.name,
        outcome_of(posed.testbed, dict(zip(names, values, strict=True)), rows.left_out),
        named(names, values, covariance),
        covariance,
        Residual(None, None, chi_square, n, correlation),
        course=Course(names, rows.t, found.course[:, order], course_sd),
        provenance={
            "version": __version__,
            "source": recording.source,
            "sha256": recording.sha256,
        },
    )


def named(names: tuple[str, ...], values: Floats, covariance: Square) -> tuple[Parameter, ...]:
    """Return the parameters."""
    units = dict.fromkeys(COM, "m") | dict.fromkeys(INERTIA, "kg m2")
    sds = np.sqrt(np.diag(covariance))
    return tuple(
        Parameter(name, units.get(name) or torque_terms.unit_of(name), float(value), float(sd))
        for name, value, sd in zip(names, values, sds, strict=True)
    )


def outcome_of(testbed: Testbed, found: dict[str, Floats], left_out: tuple[str, ...]) -> Outcome:
    """Return whether a body can have what was found, and what to think of it."""
    values = values_of(testbed) | {name: float(value) for name, value in found.items()}
    com, six = (np.array([values[name] for name in names]) for names in (COM, INERTIA))
    text = "A recursive linear estimate." + (NOTE if INERTIA[0] in found else "")
    if left_out:
        text += " Left out: " + "; ".join(left_out) + "."
    if not is_possible(MassProperties(testbed.body.mass, com, unpack_symmetric(six))):
        return Outcome(False, "No body can have the inertia found. " + text)
    return Outcome(True, text)
