"""Identify: from a recording to mass properties, coarse to fine, as Steps.

The record decides: rest positions, if there are any, give a first centre of mass; the linear
momentum integral a first inertia; the trajectory fit, which needs neither, the answer. A single
method can be requested instead.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from equipoise.assessment.plausibility.estimated_body import with_plausibility
from equipoise.estimation.method_contract import Method, Options, estimated, heeded
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.planar import planar_estimate
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.model.errors import InputError, nearest
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.steps.clean_record import sound
from equipoise.procedure.steps.plain_steps import estimate_step, measurement_step


@dataclass(frozen=True, slots=True, eq=False)
class IdentifyOptions:
    """The requested method and model."""

    method: str = "auto"
    terms: tuple[str, ...] = ()  # torques to estimate, beside the testbed's own
    hold: tuple[str, ...] = ()  # parameters kept at the testbed's value
    use_prior: bool = False  # the testbed's inertia and centre of mass as priors
    robust: bool = False
    budget: Budget = UNLIMITED  # of the search

    @property
    def requested(self) -> Options:
        """Return the options of the method itself."""
        return Options(self.terms, self.hold, self.use_prior, self.robust, self.budget)


COARSE_TO_FINE = ("equilibrium", "momentum_laboratory", "trajectory")


def identify(recording: Recording, testbed: Testbed, options: IdentifyOptions) -> Iterator[Step]:
    """Yield a measurement, then one estimate for each possible method; the last counts.

    Raises InputError for a method or a held parameter that does not exist.
    """
    if options.method not in ("auto", *METHODS):
        wanted = nearest(options.method, ["auto", *METHODS])
        raise InputError("method", f"'{options.method}'", wanted)
    end = recording.span[1]
    yield measurement_step(end, recording, StepReason.RECORDING_READ)
    recording, testbed = sound(recording, testbed)
    chosen = methods_for(recording, testbed, options.method)
    for method in chosen:
        is_last = method is chosen[-1]
        requested = options.requested if is_last else heeded(method.card, options.requested)
        found = estimated(method, recording, testbed, requested)
        estimate = with_plausibility(found, recording, testbed)
        if estimate.parameters or is_last:
            yield estimate_step(recording.span[1], estimate)


def methods_for(recording: Recording, testbed: Testbed, name: str) -> tuple[Method, ...]:
    """Return the methods to take, the one that counts last; of a moving bearing the planar fit."""
    if name != "auto":
        return (METHODS[name],)
    if planar_estimate.moves_over_table(recording, testbed):
        return (planar_estimate.METHOD,)
    return tuple(METHODS[each] for each in COARSE_TO_FINE)
