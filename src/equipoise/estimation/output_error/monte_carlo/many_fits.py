"""Plain fits of many records that share times and known inputs, as a Monte Carlo makes them.

Each ends where ``trajectory.fit`` of that record alone ends. What is the same in all is worked out
once; starts and descents are two compiled calls, which run without the interpreter's lock. So
chunks of records in threads or processes use all cores.

A record is fitted alone where a compiled start does not do: a first point from which only a growing
horizon leads on, a fit that does not explain its record, values held, torques, jumps, sensors of
vectors, a gyro without a camera, a budget, and rows so quick or noisy that each record's own decide
the step of integration.

The covariance is A^-1, A being the information of all rows with the stated noise and of all priors,
anchors included. Not counted: a residual larger or less white than noise, inputs that are carried
(``input_errors``), sag, and what the record does not show, which is as uncertain as the anchors
leave it. ``conclude`` counts these.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.propagation import NO_COLUMNS, NO_GROUPS, stacked
from equipoise.dynamics.sensitivities import Inputs
from equipoise.estimation.motion.observed_vectors import observed
from equipoise.estimation.motion.sampled_motion import ENOUGH
from equipoise.estimation.output_error.fixed_parameters import fixed
from equipoise.estimation.output_error.growing_horizon import CAPTURE
from equipoise.estimation.output_error.kernels.many_records import Blind, Descents, settle_each
from equipoise.estimation.output_error.monte_carlo.many_starts import first_points
from equipoise.estimation.output_error.problem import (
    Problem,
    counted_by_timing,
    longest_step,
)
from equipoise.estimation.output_error.problem import posed as as_posed
from equipoise.estimation.output_error.solution import MOST
from equipoise.estimation.output_error.trajectory import (
    LOST,
    Params,
    fastest_of,
    fit,
    held_names,
    problem_of,
)
from equipoise.estimation.parameters.fit_parameters import TURN
from equipoise.estimation.parameters.retraction import ERROR, W, coordinates
from equipoise.estimation.search_budget import UNLIMITED
from equipoise.maths.attitude import logarithm
from equipoise.maths.linalg import inverse_of_each
from equipoise.model.arrays import Bools, Floats, Ints
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples, arranged
from equipoise.model.testbed import Testbed


@dataclass(frozen=True, slots=True, eq=False)
class ManyFits:
    """Where k plain fits ended, in the order of the records."""

    names: tuple[str, ...]  # of the n unknowns
    units: tuple[str, ...]
    values: Floats  # (k, n) SI; the first attitude as a rotation vector
    covariance: Floats  # (k, n, n), of small turns of the first attitude in body axes
    cost: Floats  # (k,) half the sum of squares
    converged: Bools  # (k,)
    evaluations: Ints  # (k,)
    alone: Bools  # (k,) which were fitted one by one


def fit_each(
    recordings: Sequence[Recording], testbed: Testbed, params: Params | None = None
) -> ManyFits:
    """Return the fits of records that differ in attitudes and rates alone, at least one.

    InputError where anything else differs: times, masses, stored momentum, torques.
    """
    params = params or Params()
    records = [arranged(recording, testbed.mass_names) for recording in recordings]
    for k, record in enumerate(records):
        check_alike(records[0], record, k)
    problem = problem_of(records[0], testbed, params)
    out = room_for(problem, len(records))
    alone = np.ones(len(records), dtype=np.bool_)
    if is_for_many(problem, params):
        alone = ~settle_together(problem, records, params, out)
    for k in np.flatnonzero(alone):
        found = fit(records[k], testbed, params)
        out.points[k], out.normal[k], out.cost[k] = found.point.flat, found.at.normal, found.at.cost
        out.converged[k], out.evaluations[k] = found.converged, found.evaluations
    return concluded(problem, out, alone)


def check_alike(first: Recording, other: Recording, k: int) -> None:
    """Raise InputError where record k differs from the first in more than what it measured."""
    for name in CHANNELS:
        a, b = getattr(first, name), getattr(other, name)
        if not is_alike(a, b, name in ("attitude", "rate")):
            raise InputError(f"record {k}", f"'{name}' unlike that of the first", "one for all")


def is_alike(a: Samples | None, b: Samples | None, times_alone: bool) -> bool:
    """Say whether two channels have the same times, and the same values where these count."""
    if a is None or b is None:
        return a is b
    same = a.t is b.t or np.array_equal(a.t, b.t)
    return same and (times_alone or a.values is b.values or np.array_equal(a.values, b.values))


def room_for(problem: Problem, k: int) -> Descents:
    """Return arrays for k descents."""
    n, size = problem.layout.size, ERROR + len(problem.layout.errors) + 3
    return Descents(np.zeros((k, size)), np.empty((k, n, n)), np.full(k, np.inf),
                    np.zeros(k, dtype=np.bool_), np.zeros(k, dtype=np.int64))  # fmt: skip


def is_for_many(problem: Problem, params: Params) -> bool:
    """Say whether the problem is of the kind of which many are settled in one call."""
    record, testbed = problem.recording, problem.testbed
    camera = record.attitude is not None and len(record.attitude) >= ENOUGH
    plain = not (params.terms or params.jumps or fixed(problem).any())
    return camera and plain and params.budget is UNLIMITED and not observed(record, testbed)


def settle_together(
    problem: Problem, records: Sequence[Recording], params: Params, out: Descents
) -> Bools:
    """Write where the descents end; return which records' fits these are."""
    attitudes, rates = stacked_rows(records, "attitude", 4), stacked_rows(records, "rate", 3)
    hold = held_names(problem.recording, problem.testbed, params)
    points = first_points(problem, attitudes, rates, hold)
    settle_each(as_posed(problem), blind_of(problem), attitudes, rates, points, CAPTURE, MOST, out)
    rows = 3 * (attitudes.shape[1] + rates.shape[1])
    explained = out.converged & (2 * out.cost < LOST * rows)
    return explained & has_same_steps(problem, attitudes, rates, params)


def stacked_rows(records: Sequence[Recording], name: str, width: int) -> Floats:
    """Return the values of a channel of all records, (k, n, width); n 0 where there is none."""
    channels = [getattr(record, name) for record in records]
    if channels[0] is None or not len(channels[0]):
        return np.zeros((len(records), 0, width))
    return np.ascontiguousarray([channel.values for channel in channels])


def has_same_steps(problem: Problem, attitudes: Floats, rates: Floats, params: Params) -> Bools:
    """Say which records are integrated in the same steps as the one that was posed."""
    record = problem.recording
    assert record.attitude is not None
    fastest = fastest_of(record.attitude.t, attitudes, rates)
    steps = [longest_step(problem.testbed, float(rate), record.rows) for rate in fastest]
    return np.array(steps) / params.fineness == problem.longest


def blind_of(problem: Problem) -> Blind:
    """Return the problem without unknowns and gyro: what the misfit of a first point takes.

    Errors of masses and of the camera are zero there.
    """
    line, none = problem.line, np.zeros(0, dtype=np.int64)
    inputs = Inputs(stacked(problem.maps), line.t, line.known, line.owners, NO_COLUMNS, NO_GROUPS)
    camera = problem.observed._replace(
        rate=np.zeros((0, 3)), rate_node=none, rate_share=np.zeros(0), terms=none
    )
    return Blind(inputs, camera)


def concluded(problem: Problem, out: Descents, alone: Bools) -> ManyFits:
    """Return the fits in physical coordinates, with their covariance."""
    layout = problem.layout
    counted = counted_by_timing(layout, problem.testbed)
    slots = layout.slots
    values = np.array([coordinates(point, problem.mass, slots) for point in out.points]) + counted
    values[:, TURN] = logarithm(out.points[:, :W])
    covariance = inverse_of_each(out.normal, ~problem.prior.held)
    return ManyFits(layout.names, layout.units, values, covariance, out.cost, out.converged,
                    out.evaluations, alone)  # fmt: skip
