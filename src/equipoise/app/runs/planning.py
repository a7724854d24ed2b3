"""One planning: what is known, the search, and what comes of it."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import METHOD, params_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Manoeuvre, Plan
from equipoise.model.presentation import Shown
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.planning.manoeuvre.criterion import NAMES, Criterion, Quantity
from equipoise.planning.manoeuvre.manoeuvre_space import Space
from equipoise.planning.manoeuvre.plan import Trials, Wish, planned
from equipoise.planning.manoeuvre.predicted_sd import Promise, promise
from equipoise.planning.manoeuvre.prior_from_record import RecordPrior, record_prior
from equipoise.planning.manoeuvre.reference_manoeuvre import usual
from equipoise.planning.manoeuvre.scenario import stated_prior
from equipoise.procedure.steps.clean_record import sound


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """What is to be planned."""

    testbed: Testbed
    duration: float  # s
    requested: Quantity
    criterion: Criterion
    moves: int
    rate: float  # rad/s, greatest
    options: Options  # of the fit that the record is meant for
    earlier: Recording | None  # its estimate is the prior, masses stand where it left them
    trials: int
    seed: int

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of the wanted parameters."""
        return tuple(n for n in NAMES[self.requested] if n not in self.options.hold)

    @property
    def params(self) -> Params:
        """Return the parameters of a fit of the record."""
        return params_of(self.testbed, self.options)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Planning(Shown):
    """The plan beside the usual manoeuvre."""

    request: Request
    usual: Promise
    planned: Promise
    alone: Promise  # the plan's record, without the earlier recording

    @property
    def plan(self) -> Plan:
        """Return the plan as it is written down, with what a fit of its record should find."""
        promised = self.alone
        inertia, com = promised.sd_of(INERTIA), promised.sd_of(COM)
        all_observed = bool(np.all(np.isfinite([*inertia, *com])))
        reported = (inertia, com) if all_observed else (None, None)
        return Plan(self.request.testbed.name, promised.manoeuvre, *reported)


def run(request: Request, waiting: Waiting = QUIET) -> Planning:
    """Plan; InputError for a testbed without a sensor, or an earlier recording of no use."""
    testbed, params = request.testbed, request.params
    if testbed.attitude is None and testbed.gyro is None:
        raise InputError(testbed.name, "no sensor", "a camera or a gyro")
    earlier = request.earlier
    learnt = None if earlier is None else learnt_from(earlier, request, waiting)
    prior = stated_prior(testbed) if learnt is None else learnt.prior
    known, standing = (None, {}) if learnt is None else (learnt.known, learnt.standing)
    wish = Wish(request.requested, request.criterion, params, prior, known)
    rate, limit = request.rate, testbed.tilt_limit
    space = Space(testbed, request.duration, request.moves, limit, rate, standing)
    with waiting.search("planning") as report:
        best = planned(space, wish, request.seed, Trials(request.trials, waiting.spread, report))
    before = usual(testbed, request.duration, standing)
    with waiting.doing("testing it on other platforms"):
        variants = [(before, wish), (best, wish)]
        variants += [(best, replace(wish, known=None))] if known else []
        first, second, *third = waiting.spread(partial(promised, request), variants)
    return Planning(request, first, second, *(third or [second]))


def promised(request: Request, variant: tuple[Manoeuvre, Wish]) -> Promise:
    """Return the prediction for a manoeuvre and what is known before it."""
    return promise(request.testbed, *variant, request.seed, request.rate)


def learnt_from(recording: Recording, request: Request, waiting: Waiting) -> RecordPrior:
    """Return the estimate of an earlier recording, the testbed's body being its prior."""
    testbed, requested = request.testbed, request.options
    with waiting.doing("identifying the earlier recording"):
        rows, as_observed = sound(recording, testbed)
        found = METHOD.run(
            rows, as_observed, Options(requested.terms, requested.hold, use_prior=True)
        )
    return record_prior(recording, found, testbed)
