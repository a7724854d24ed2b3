"""The torque on a platform second by second, divided among its causes, each with its 95 % band.

    J w|_(t+1) - J w|_t + int w x J w dt = sum of impulses of all causes,    J: masses as at first

What a term explains is its column of the one regressor times its coefficient, along the smoothed
motion. What no term explains is a Gauss-Markov torque (``gauss_markov``); the record weighs its
size and correlation time (``process_sizes``). All unknowns of the fit stand beside it: intervals
count how com, inertia, terms, attitude, rate and stops are known, and how they trade for each
other.

Priors are those of the fit: J and com are as the testbed says where the estimate does not see them
all, or as an estimate of another record says. A term that the testbed does not declare is as large
as on benches, or does not act (``term_odds``); an event that a wandering torque explains as well is
none (``earned_events``).

Cannot see which of two causes acts where they act alike. Near level, that is a constant torque and
the centre of mass across gravity: their bands are wide, that of the sum is not.
"""

from dataclasses import replace

import numpy as np

from equipoise.dynamics.timeline import SAME
from equipoise.estimation.output_error.kernels.gauss_newton import HELD
from equipoise.estimation.output_error.problem import (
    Prior,
    Problem,
    prior_of,
    with_body_covariance,
    with_torque_sds,
)
from equipoise.estimation.parameters.fit_parameters import Layout
from equipoise.estimation.torque_by_cause.by_cause import (
    chain_of,
    coordinates_of,
    impulses_of,
    points_at,
    steps_of,
)
from equipoise.estimation.torque_by_cause.closure import closure_of
from equipoise.estimation.torque_by_cause.earned_events import earned
from equipoise.estimation.torque_by_cause.posed_record import (
    CARRIER,
    about,
    is_of,
    posed_for,
)
from equipoise.estimation.torque_by_cause.process_sizes import (
    Weighed,
    mean_course,
    mixed,
    weighed,
)
from equipoise.estimation.torque_by_cause.term_odds import alternatives, doubted
from equipoise.model.arrays import Series1
from equipoise.model.estimate import BODY, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.torque_by_cause import CAUSES, TorqueByCause
from equipoise.model.torque_terms import typical_torques

INTERVAL = 1.0  # s
SURE = 1e3  # chosen: an sd of a millionth of a value comes of no measurement
ROUNDS = 3  # chosen: of the linear model about its own answer; more change nothing


def edges_of(recording: Recording) -> Series1:
    """Return where intervals begin, and where the last whole one ends, s."""
    first, last = recording.span
    count = int((last - first + SAME) / INTERVAL)
    return first + INTERVAL * np.arange(count + 1, dtype=np.float64)


def prior_for(
    recording: Recording, testbed: Testbed, estimate: Estimate, problem: Problem
) -> Prior:
    """Return the priors of a record's unknowns, before any of its rows."""
    layout, sees = problem.layout, estimate.sees(BODY)
    other = sees and not is_of(estimate, recording)
    if other:
        body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
        testbed = replace(testbed, body=body)
    prior = prior_of(testbed, problem.errors, layout, other or not sees, ())
    if other:
        prior = with_body_covariance(prior, estimate.covariance_of(BODY))
    undeclared = typical_torques(t for t in layout.terms if t not in testbed.disturbances)
    return with_held(with_torque_sds(prior, layout, undeclared), layout, estimate)


def with_held(prior: Prior, layout: Layout, estimate: Estimate) -> Prior:
    """Return a prior that keeps what an estimate was told to keep, to within rounding."""
    mean, weight = prior.mean.copy(), prior.weight.copy()
    for each in estimate.parameters:
        sd = HELD * max(abs(each.value), HELD)
        if each.name in BODY and each.sd <= SURE * sd:
            k = layout.names.index(each.name)
            mean[k], weight[k] = each.value, sd**-2
    return replace(prior, mean=mean, weight=weight)


def torque_by_cause(recording: Recording, testbed: Testbed, estimate: Estimate) -> TorqueByCause:
    """Return the mean torque of each cause over every second of a record."""
    edges, last, constant = edges_of(recording), recording.span[1], estimate.has(CARRIER[0])
    cuts = edges[(edges > edges[0]) & (edges < last - SAME)]
    problem, points = posed_for(recording, testbed, estimate, cuts)
    prior = prior_for(recording, testbed, estimate, problem)
    fitted = about(problem, points)
    for _ in range(ROUNDS):
        by = coordinates_of(fitted, testbed.up, constant)
        chain = earned(chain_of(fitted, prior, by))
        models = alternatives(chain, doubted(fitted, chain, testbed.disturbances))
        step = mean_course(weighed(models, coarsely=True))
        fitted = about(problem, points_at(fitted, by, step))
    by = coordinates_of(fitted, testbed.up, constant)
    chain = earned(chain_of(fitted, prior, by))
    found = weighed(alternatives(chain, doubted(fitted, chain, testbed.disturbances)))
    rows = mixed(found, impulses_of(fitted, chain, by, edges), INTERVAL)
    closure = closure_of(fitted, steps_of(by, mean_course(found)), edges, rows.total)
    there = [
        k for k in range(len(CAUSES)) if np.any(rows.torque[:, k]) or np.any(rows.variance[:, k])
    ]
    sd, correlation = shown_process(found)
    return TorqueByCause(
        edges[:-1], INTERVAL, tuple(CAUSES[k] for k in there), rows.torque[:, there],
        np.sqrt(rows.variance[:, there]), rows.total, np.sqrt(rows.total_variance), sd, correlation,
        closure, recording.source, recording.sha256,
    )  # fmt: skip


def shown_process(found: tuple[Weighed, ...]) -> tuple[float, float]:
    """Return the rms of the unmodelled torque (N m), and its correlation time (s)."""
    weight = np.array([each.weight for each in found])
    square = np.array([each.process.sd**2 for each in found])
    times = np.log([each.process.correlation for each in found])
    shares = weight * square / float(weight @ square)
    return float(np.sqrt(weight @ square)), float(np.exp(shares @ times))
