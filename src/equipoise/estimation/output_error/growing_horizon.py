"""A growing horizon: a start for the trajectory fit from the first part of a record.

Over a whole record a point that is a little wrong is lost by whole swings. So a first part is
fitted, as short as the point can be followed, then longer ones, each as much longer than the one
before as its fit still predicts: a move of masses first shows a scale that was open till then, and
half a swing behind it that is wrong by too much.

Cannot help where not even the first part is followed.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Evaluation, evaluate, settle
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.estimation.search_budget import Stage
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, window

CAPTURE = 0.5  # rad rms, chosen: beyond this the first guess is not followed to the end
FOLLOWED = 0.05  # rad rms, chosen: what is predicted so well is part of the next fit
GROWTH, SLOWEST = 2.0, 1.06  # chosen: times that a part is longer than the one before
SHORTEST = 0.02  # of the record, the least part to begin with
FEW = 1 / 16  # of a record on which other starts are lost, chosen
FEW_SWINGS = 1 / 32  # of a long record, chosen: 56 s of half an hour
EACH = 60  # evaluations, chosen: a part that takes longer slides along what it leaves open
FEW_ROWS = 50  # chosen: fewer are no motion


def misfit(problem: Problem, point: Unknowns) -> float:
    """Return the rms residual vector in rad (with a camera) or rad/s."""
    return misfit_at(problem, evaluate(problem, point))


def misfit_at(problem: Problem, at: Evaluation) -> float:
    """Return the same of residuals that are at hand."""
    left = at.left_q * problem.observed.attitude_sd if len(at.left_q) else at.left_w
    square: Floats = np.sum(left**2, axis=1)
    return float(np.sqrt(np.mean(square)))


def at_rest(problem: Problem, point: Unknowns) -> Unknowns:
    """Return a point with the displacement errors that a part of a record has, all zero."""
    return replace(point, error=np.zeros(len(problem.layout.errors)))


def few_swings(recording: Recording) -> float:
    """Return the first share of a long record to fit: ``FEW_SWINGS``, or more if it is sparse."""
    start_t, end_t = recording.span
    channels = [c.t for c in (recording.attitude, recording.rate) if c is not None]
    share, rows = FEW_SWINGS, np.concatenate(channels)
    while np.sum(rows < start_t + share * (end_t - start_t)) < FEW_ROWS:
        share *= 2
    return share


def grown(
    recording: Recording, posed_on: Callable[[Recording], Problem], point: Unknowns, most: float
) -> Unknowns:
    """Return a point from which the whole record can be fitted: fit a growing first part.

    The first is of the share ``most`` of the record; ``posed_on`` gives the problem of a part.
    """
    start_t, end_t = recording.span

    def posed(share: float) -> tuple[Problem, Unknowns]:
        problem = posed_on(window(recording, start_t, start_t + share * (end_t - start_t)))
        return problem, at_rest(problem, point)

    share = most
    while share > SHORTEST and misfit(*posed(share)) > CAPTURE:
        share /= 2
    while True:
        found = settle(*posed(share), most=EACH)
        point = replace(found.point, error=point.error)
        if share >= 1.0 or not found.problem.budget.allows(Stage.MOTION):
            return point
        predicted, growth = max(FOLLOWED, 2 * misfit_at(found.problem, found.at)), GROWTH
        while growth > SLOWEST and misfit(*posed(min(growth * share, 1.0))) > predicted:
            growth = growth**0.5
        share = min(growth * share, 1.0)
