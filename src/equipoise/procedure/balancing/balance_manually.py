"""Balance by hand: let go, record, place the requested weights, until the verdict passes.

For platforms without actuators. Every recording is a free swing of its own, from a hand that lets
go to one that catches. It is added to the posterior (``manual_estimate``), and the weights of the
next placing should bring the centre of mass to the target (``actuators.weight_choice``). The last
placing is judged by a recording made after it.

A recording that contradicts the predicted centre of mass counts alone: a weight is not where it was
requested, or something slipped.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from equipoise.actuators.placed_weights import load_of
from equipoise.actuators.weight_choice import Wanted, chosen
from equipoise.estimation.information.single_record_information import Shown, shown_by
from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Ints, Vector3
from equipoise.model.errors import InputError
from equipoise.model.hands import Hands
from equipoise.model.mass_properties import MassProperties
from equipoise.model.placing import Placing
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording, window
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import typical_sizes
from equipoise.model.verdict import Verdict
from equipoise.model.weights import places_of, unloaded
from equipoise.procedure.balancing.known_platform import as_known
from equipoise.procedure.balancing.manual_estimate import (
    Posterior,
    alone,
    as_estimate,
    first_posterior,
    reloaded,
    taught,
)
from equipoise.procedure.steps.joint_fit import as_if_stiff
from equipoise.procedure.steps.plain_steps import measurement_step, verdict_step
from equipoise.procedure.steps.verify import CONTRADICTION, Aim, at, judged, unusable


@dataclass(frozen=True, slots=True, eq=False)
class HandOptions(Aim):
    """The aim, and the placings that may be made."""

    max_rounds: int = 4  # placings


@dataclass(frozen=True, slots=True, eq=False)
class Progress:
    """The posterior after a recording."""

    posterior: Posterior
    shown: Shown
    astray: bool = False  # the recording contradicts the prediction


def check(testbed: Testbed) -> None:
    """Raise InputError for a testbed without weights or without sensors."""
    if not testbed.weights:
        wanted = "tables [[weight]] and [[weight_grid]]; the preset weights-by-hand shows how"
        raise InputError(testbed.source or testbed.name, "no weights to place", wanted)
    if testbed.attitude is None and testbed.gyro is None:
        raise InputError(testbed.source or testbed.name, "no sensor", "a camera or a gyro")


def balance_by_hand(hands: Hands, options: HandOptions) -> Iterator[Step]:
    """Yield Steps: measurement, estimate, place, ... ; the last has the verdict."""
    testbed = as_if_stiff(hands.testbed)
    check(testbed)
    posterior, loading = first_posterior(testbed), unloaded(testbed.grids, testbed.weights)
    for left in range(options.max_rounds, -1, -1):
        fresh = caught(hands.swing(), testbed)
        yield measurement_step(hands.time, fresh)
        observed = learnt(posterior, fresh, loading, testbed)
        doubt = sag_doubt(hands.testbed, fresh)
        posterior, verdict = observed.posterior, verdict_on(observed, options, doubt * testbed.up)
        yield estimate_step(hands, observed, fresh)
        if verdict.passed or left == 0:
            known = as_known(hands.testbed, posterior) if verdict.passed else None
            yield replace(final_step(hands, verdict, fresh, loading), known=known)
            return
        placing = planned(testbed, posterior, loading, options)
        yield Step("place", hands.time, requested_of(placing, testbed, options), placing=placing)
        after = hands.place(placing.after)
        posterior, loading = reloaded(posterior, testbed, loading, after), after


def caught(recording: Recording, testbed: Testbed) -> Recording:
    """Return a recording up to the last row before the platform comes to its stop.

    The stop's push lies between that row and the next: no fit should have to explain it.
    """
    rows = recording.attitude
    if rows is None or not len(rows):
        return recording
    beyond = np.flatnonzero(tilt(rows.values, testbed.up) > testbed.tilt_at_stop)
    if not len(beyond):
        return recording
    start, _ = recording.span
    return window(recording, start, float(rows.t[max(beyond[0] - 1, 0)]))


def learnt(posterior: Posterior, fresh: Recording, loading: Ints, testbed: Testbed) -> Progress:
    """Return the posterior with a recording added, or by it alone where the two disagree."""
    added = load_of(testbed, loading)
    drawn = testbed.body.inertia_P + added.inertia_P
    known = replace(testbed, body=MassProperties(posterior.mass, posterior.com, drawn))
    shown = shown_by(fresh, known)
    if not shown.estimate.outcome.usable:
        return Progress(posterior, shown)
    single = alone(posterior, shown)
    off, spread = single.com - posterior.com, np.hypot(single.sd, posterior.sd)
    if np.any(np.abs(off) > CONTRADICTION * spread):
        return Progress(single, shown, astray=True)
    return Progress(taught(posterior, shown), shown)


def sag_doubt(testbed: Testbed, recording: Recording) -> float:
    """Return what a declared sag leaves open of the height at level, one sd, m.

    A sag of c along the vertical, C = c u u^T, turns a platform that is tilted by theta as
    c sin(theta) cos(theta) does, a height h as h sin(theta). At level they are one; farther out the
    former's slope is less by the share 1 - cos(2 theta) / cos(theta), theta the greatest tilt of
    the recording. Of c, -3/2 (C_xx + C_yy), the usual size counts. Zero where none is declared.
    """
    if not testbed.in_group("sag") or recording.attitude is None:
        return 0.0
    most = float(np.max(tilt(recording.attitude.values, testbed.up), initial=0.0))
    most = min(most, np.pi / 4)  # where that slope is nought
    usual = 1.5 * float(np.linalg.norm(typical_sizes(("sag_xx", "sag_yy"))))
    return usual * (1.0 - float(np.cos(2 * most) / np.cos(most)))


def verdict_on(observed: Progress, options: HandOptions, doubt: Vector3) -> Verdict:
    """Return the verdict after a recording; ``doubt``: m, one sd beside the posterior's."""
    posterior, outcome = observed.posterior, observed.shown.estimate.outcome
    if not outcome.usable:
        return unusable(outcome, posterior.com, posterior.sd)
    return judged(posterior.com, posterior.com_covariance + np.outer(doubt, doubt), options)


def planned(testbed: Testbed, posterior: Posterior, loading: Ints, options: HandOptions) -> Placing:
    """Return the placing that should bring the centre of mass to the target."""
    spread = np.hypot(options.tolerance, posterior.sd)
    wanted = Wanted(posterior.body, loading, options.target, spread)
    after = chosen(testbed, wanted)
    then = reloaded(posterior, testbed, loading, after)
    return Placing(loading, after, then.com, then.com_covariance)


def estimate_step(hands: Hands, observed: Progress, fresh: Recording) -> Step:
    """Return the step of an estimate."""
    latest, posterior = observed.shown.estimate, observed.posterior
    if not latest.outcome.usable:
        return Step("estimate", hands.time, latest.outcome.reasons, fresh, latest)
    code = StepReason.COM_ASTRAY if observed.astray else StepReason.COM_BY_HAND
    reasons = one_reason(code, **at(posterior.com, posterior.sd))
    return Step("estimate", hands.time, reasons, fresh, as_estimate(posterior, latest))


def requested_of(placing: Placing, testbed: Testbed, options: HandOptions) -> tuple[Reason, ...]:
    """Return the instructions of a placing, its predicted result, and what it cannot reach."""
    sd = np.sqrt(np.diag(placing.predicted_covariance))
    leaves = at(placing.predicted_com, sd)
    if not placing.handled:
        return one_reason(StepReason.NOTHING_TO_PLACE, **leaves)
    found = (*errands(placing, testbed), *one_reason(StepReason.PLACING_LEAVES, **leaves))
    beyond = np.abs(placing.predicted_com - options.target) > np.hypot(options.tolerance, sd)
    if not beyond.any():
        return found
    axes = ("xyz"[k] for k in np.flatnonzero(beyond))
    return (*found, *one_reason(StepReason.TARGET_OUT_OF_REACH, *axes))


def errands(placing: Placing, testbed: Testbed) -> list[Reason]:
    """Return what to move, to take off and to put on, place by place."""
    change, places = placing.after - placing.before, places_of(testbed.grids)
    moves, off, on = list[str](), list[str](), list[str]()
    for k, weight in enumerate(testbed.weights):
        givers = [p for p in range(len(places)) for _ in range(-change[p, k])]
        takers = [p for p in range(len(places)) for _ in range(change[p, k])]
        both = min(len(givers), len(takers))
        ways = Counter(zip(givers[:both], takers[:both], strict=True))
        for (a, b), n in ways.items():
            moves.append(f"{n} x {weight.name} from {places[a].name} to {places[b].name}")
        for rest, found in ((givers[both:], off), (takers[both:], on)):
            found += [f"{n} x {weight.name} at {places[p].name}" for p, n in Counter(rest).items()]
    deeds = ((StepReason.WEIGHTS_TO_MOVE, moves), (StepReason.WEIGHTS_TO_TAKE_OFF, off),
             (StepReason.WEIGHTS_TO_PUT_ON, on))  # fmt: skip
    return [Reason(code, tuple(what)) for code, what in deeds if what]


def final_step(hands: Hands, verdict: Verdict, fresh: Recording, loading: Ints) -> Step:
    """Return the verification, or the stop with its reason."""
    why = () if verdict.passed else one_reason(StepReason.ROUNDS_USED_UP)
    places = int(np.count_nonzero(loading.sum(axis=1)))
    lie = one_reason(StepReason.WEIGHTS_LIE, weights=int(loading.sum()), places=places)
    return verdict_step(hands.time, verdict, (*why, *verdict.reasons, *lie), fresh)
