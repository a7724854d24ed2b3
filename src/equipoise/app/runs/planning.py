"""One planning: what is known, the search with a sign of life, and what comes of it."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from equipoise.app.arguments.estimated_terms import Seeking
from equipoise.app.arguments.recording_window import WHOLE
from equipoise.app.arguments.resolve import fitting_recording_of
from equipoise.app.console.terminal import busy, counted
from equipoise.app.text.units import PER_DEG
from equipoise.design.manoeuvre.criterion import NAMES, Criterion, Quantity
from equipoise.design.manoeuvre.manoeuvre_space import Space
from equipoise.design.manoeuvre.plan import Wish, planned
from equipoise.design.manoeuvre.predicted_sd import Promise, promise
from equipoise.design.manoeuvre.prior_from_record import RecordPrior, record_prior
from equipoise.design.manoeuvre.reference_manoeuvre import usual
from equipoise.design.manoeuvre.scenario import stated_prior
from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import METHOD, params_of
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.manoeuvre import Plan
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.clean_record import sound


@dataclass(frozen=True, slots=True, eq=False)
class Request:
    """What is asked for."""

    testbed: Testbed
    duration: float  # s
    requested: Quantity
    criterion: Criterion
    moves: int
    rate_deg_s: float
    seeking: Seeking
    prior_record: Path | None
    trials: int
    seed: int

    @property
    def names(self) -> tuple[str, ...]:
        """Return what is asked for, by name."""
        return tuple(n for n in NAMES[self.requested] if n not in self.seeking.hold)

    @property
    def params(self) -> Params:
        """Return what a fit of the record is told."""
        wanted = Options(self.seeking.term, self.seeking.hold, self.seeking.prior)
        return params_of(self.testbed, wanted)


@dataclass(frozen=True, slots=True, eq=False)
class Planning:
    """The plan beside the usual manoeuvre."""

    request: Request
    usual: Promise
    planned: Promise
    alone: Promise  # the plan's record, without what was seen before


def run(request: Request) -> Planning:
    """Plan, with a sign of life."""
    testbed, params = request.testbed, request.params
    if testbed.attitude is None and testbed.gyro is None:
        raise InputError(testbed.name, "no sensor", "a camera or a gyro")
    learnt = None if request.prior_record is None else learnt_from(request.prior_record, request)
    prior = stated_prior(testbed) if learnt is None else learnt.prior
    known, standing = (None, {}) if learnt is None else (learnt.known, learnt.standing)
    wish = Wish(request.requested, request.criterion, params, prior, known)
    rate = request.rate_deg_s / PER_DEG
    space = Space(testbed, request.duration, request.moves, testbed.tilt_limit, rate, standing)
    with counted("planning") as report:
        best = planned(space, wish, request.seed, request.trials, report)
    before = usual(testbed, request.duration, standing)
    with busy("trying it on other platforms", announce=False):
        first, second = (promise(testbed, m, wish, request.seed, rate) for m in (before, best))
        fresh = replace(wish, known=None)
        alone = promise(testbed, best, fresh, request.seed, rate) if known else second
    return Planning(request, first, second, alone)


def learnt_from(file: Path, request: Request) -> RecordPrior:
    """Return what an earlier recording tells, the testbed's body being its prior."""
    testbed, seeking = request.testbed, request.seeking
    recording = fitting_recording_of(str(file), WHOLE, testbed)
    with busy("identifying what was seen"):
        rows, as_observed = sound(recording, testbed)
        found = METHOD.run(rows, as_observed, Options(seeking.term, seeking.hold, use_prior=True))
    return record_prior(recording, found, testbed)


def plan_file_of(done: Planning) -> Plan:
    """Return the plan as it is written down, with what a fit of its record alone should find."""
    promised, bed = done.alone, done.request.testbed
    inertia, com = promised.sd_of(INERTIA), promised.sd_of(COM)
    all_observed = bool(np.all(np.isfinite([*inertia, *com])))
    said = (inertia, com) if all_observed else (None, None)
    return Plan(bed.name, promised.manoeuvre, *said)
