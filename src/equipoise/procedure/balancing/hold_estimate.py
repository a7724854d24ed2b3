"""What is known while a hold lasts: the centre of mass, what moves it on, and how much it sags."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.methods.tracker import estimate_at_end
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.known_sag import SAG
from equipoise.estimation.tracker.predict_correct import BODY, COM, RATE_OF_COM, WARM
from equipoise.model.arrays import Floats
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.reasons.reason import Reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS, unit_of
from equipoise.procedure.steps.verify import at

Known = tuple[str, Floats, slice]  # the group of terms, their values, and rows of the error state


def known_terms(state: tracker.State, testbed: Testbed) -> Iterator[Known]:
    """Yield what a state knows of drift, of warmth where that is measured, and of sag."""
    yield "drift", state.drift, RATE_OF_COM
    heated = state.inputs is not None and state.inputs.temperature is not None
    if heated or testbed.lamp is not None:
        yield "thermal", state.thermal, WARM
    if state.sag is not None:
        yield "sag", state.sag, SAG


CODES = {
    "drift": StepReason.COM_DRIFTS,
    "thermal": StepReason.COM_WARMS,
    "sag": StepReason.COM_SAGS,
}


def estimate_now(
    track: tracker.Track, acting: tracker.State, displacement: Floats, testbed: Testbed
) -> Estimate:
    """Return the estimate after the last row: com as the masses stand, inertia, and the terms."""
    shift = shift_by(testbed, displacement)
    found = estimate_at_end(replace(track, end=acting), testbed, shift)
    P, rows, terms = acting.covariance, [*range(BODY.start, BODY.stop)], list[Parameter]()
    for group, values, where in known_terms(acting, testbed):
        rows += [*range(where.start, where.stop)]
        sds = np.sqrt(np.diag(P)[where])
        for name, value, sd in zip(GROUPS[group], values.tolist(), sds.tolist(), strict=True):
            terms.append(Parameter(name, unit_of(name), value, sd))
    return replace(found, parameters=(*found.parameters, *terms), covariance=P[np.ix_(rows, rows)])


def numbers_of(group: str, values: Floats, sds: Floats) -> dict[str, float]:
    """Return the numbers of a sentence on a group of terms."""
    ends = [name.removeprefix(f"{group}_") for name in GROUPS[group]]
    found = {f"of_{end}": float(value) for end, value in zip(ends, values, strict=True)}
    return found | {f"sd_{end}": float(sd) for end, sd in zip(ends, sds, strict=True)}


def report_step(
    t: float, track: tracker.Track, acting: tracker.State, displacement: Floats, testbed: Testbed
) -> Step:
    """Return the Step of what is known at a time (s), a sentence each on com and what moves it."""
    variance = np.diag(acting.covariance)
    com = acting.com + shift_by(testbed, displacement)
    reasons = [Reason(StepReason.COM_AT, (), at(com, np.sqrt(variance[COM])))]
    for group, values, where in known_terms(acting, testbed):
        numbers = numbers_of(group, values, np.sqrt(variance[where]))
        reasons.append(Reason(CODES[group], (), numbers))
    estimate = estimate_now(track, acting, displacement, testbed)
    return Step("estimate", t, tuple(reasons), estimate=estimate)
