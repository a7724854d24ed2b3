"""Run a balancing law on a bench, step by step, and prove what it reached on fresh data.

Every ``card.period`` seconds the law receives a Sample and its Command is carried out. When it
requests a measurement, masses and devices rest, the platform swings, and the law receives the
Estimate. When it has finished, or its time is used up, the platform swings once more and is judged
by that record alone. A platform that tilts to its limit is stopped, with the reason.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from equipoise.actuators.control_moment_gyros import gyros_span
from equipoise.actuators.reaction_wheels import axes_of, span
from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.control.law import Law, Sample
from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.methods.tracker import shift_at_end
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.model.bench import Bench
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, END, Estimate
from equipoise.model.law_card import NEEDS, LawCard, Need
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording, joined, window
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS, among
from equipoise.procedure.balancing.allocation import Hands, carry_out, let_rest, opened_hands
from equipoise.procedure.steps.joint_fit import as_if_stiff
from equipoise.procedure.steps.plain_steps import estimate_step, measurement_step
from equipoise.procedure.steps.sampler import Eyes, no_attitude, opened, sample_of, sampled
from equipoise.procedure.steps.swing_verdict import stop_step, swing_verdict
from equipoise.procedure.steps.tilt_guard import guarded, tilted
from equipoise.procedure.steps.verify import Aim

TILTED = (StepReason.TILTED, LawReason.TILTED)  # as the guard says it, and as a law does
PROMPT = 1e-6  # s, chosen: rounding of clocks, by which nothing is late
SETTLE = 1.0  # s, chosen: after it the filter's rate and attitude can be used


@dataclass(frozen=True, slots=True, eq=False)
class LawOptions(Aim):
    """The aim, and the time that may be spent."""

    max_time: float = 600.0  # s on the bench's clock, the proof included
    proof: float = 40.0  # s of swinging by which the result is judged


@dataclass(frozen=True, slots=True, eq=False)
class Session:
    """Where a run stands."""

    eyes: Eyes
    hands: Hands
    parts: tuple[Recording, ...] = ()  # all that was read
    due: float | None = None  # s, when the next sample of a law at work is due


def lacking(card: LawCard, testbed: Testbed) -> list[Need]:
    """Return what a law needs and a testbed lacks."""
    has: dict[Need, bool] = {
        "masses": bool(testbed.masses),
        "momentum": span(axes_of(testbed.wheels)) or gyros_span(testbed.cmgs),
        "magnetorquers": bool(testbed.magnetorquers) and testbed.field_N() is not None,
        "jets": span(axes_of(testbed.jets)),
        "gyro": testbed.gyro is not None,
        "attitude": testbed.attitude is not None,
    }
    return [need for need in card.needs if not has[need]]


def check(card: LawCard, testbed: Testbed) -> None:
    """Raise InputError for a testbed that lacks what a law needs."""
    missing = [NEEDS[need] for need in lacking(card, testbed)]
    if missing:
        found = f"a testbed without {' and without '.join(missing)}"
        wanted = (
            "the missing devices in the testbed file, another law (equipoise laws), "
            "or balance --manual"
        )
        raise InputError(f"law {card.name}", found, wanted)


def run_law(bench: Bench, law: Law[Any, Any], options: LawOptions) -> Iterator[Step]:
    """Yield Steps; the last is a verification, or a stop that says why, with a verdict.

    Raises InputError when the testbed lacks a device, or the law would not be stable on it.
    """
    check(law.card, bench.testbed)
    state, params = law.begin(bench.testbed, options.target)
    end = bench.time + options.max_time - options.proof
    yield from warned(law, params, bench.time, end)
    session, observed = first_sight(bench)
    why, began, following = (), bench.time, None
    while not why:
        state, command = law.step(state, observed, params)
        if command.note:
            yield Step("control", bench.time, command.note)
        if command.finished or command.measurement is not None:
            hands = carry_out(bench, command, session.eyes, session.hands, law.card.period)
            session = replace(session, hands=hands)
        if command.finished:
            why, following = command.finished, command.following
            break
        if command.measurement is not None and bench.time + command.measurement.duration > end:
            why = one_reason(StepReason.TIME_USED_UP)
            break
        if command.measurement is not None:
            session, recording, observed = measurement(bench, session, command.measurement)
            yield measurement_step(bench.time, recording)
            yield estimate_step(bench.time, observed)
        else:
            session, observed, recording = control(bench, session, command, law.card.period)
        why = reason_to_stop(bench, recording, end)
    ran = one_reason(StepReason.LAW_RAN, law.card.name, duration=bench.time - began)
    yield Step("control", bench.time, (*ran, *why), following=following)
    if any(reason.code in TILTED for reason in why):
        bench.stop()
        yield stop_step(bench)
    else:
        let_all_rest(bench, session)
        yield swing_verdict(bench, session.eyes, options, options.proof)


def warned(law: Law[Any, Any], params: Any, now: float, end: float) -> Iterator[Step]:
    """Yield a step that says so if a law should take longer than until ``end`` (s)."""
    expected = None if law.expected is None else law.expected(params)
    if expected is not None and expected > end - now:
        late = one_reason(
            StepReason.LAW_WILL_BE_LATE, law.card.name, expected=expected, available=end - now
        )
        yield Step("control", now, late)


def reason_to_stop(bench: Bench, recording: Recording, end: float) -> tuple[Reason, ...]:
    """Return why to stop now, or nothing."""
    if tilted(recording, bench.testbed):
        return one_reason(StepReason.TILTED)
    return one_reason(StepReason.TIME_USED_UP) if bench.time >= end else ()


def first_sight(bench: Bench) -> tuple[Session, Sample]:
    """Return the session and the first sample, after SETTLE seconds of record."""
    testbed, fresh = bench.testbed, bench.read(SETTLE)
    before = opened(testbed)
    eyes = sampled(before, fresh, testbed)
    observed = sample_of(before, eyes, fresh, testbed)
    if observed is None:
        raise no_attitude(SETTLE)
    return Session(eyes, opened_hands(testbed, eyes.displacement), (fresh,)), observed


def control(
    bench: Bench, session: Session, command: Command, period: float
) -> tuple[Session, Sample, Recording]:
    """Carry a command out and return the sample a period after the last one was due.

    A law integrates by its period. Ports take their time: what a command or a read took too long is
    made up for by the next one, unless half a period has passed.
    """
    testbed, now = bench.testbed, bench.time
    due = (now if session.due is None else session.due) + period
    hands = carry_out(bench, command, session.eyes, session.hands, period)
    late = bench.time + period - due
    if late > period / 2:
        due, late = bench.time + period, 0.0
    fresh = bench.read(period - late if late > PROMPT else period)
    eyes = sampled(session.eyes, fresh, testbed)
    observed = sample_of(session.eyes, eyes, fresh, testbed)
    assert observed is not None  # there was one before
    return Session(eyes, hands, (*session.parts, fresh), due), observed, fresh


def let_all_rest(bench: Bench, session: Session) -> None:
    """Let masses and devices rest, and wait until they do."""
    wait = let_rest(bench, session.eyes, session.hands)[1]
    if wait > 0:
        guarded(bench, wait)


def measurement(
    bench: Bench, session: Session, requested: Measurement
) -> tuple[Session, Recording, Estimate]:
    """Let everything rest, record, and return the estimate of the requested method."""
    testbed = bench.testbed
    hands, wait = let_rest(bench, session.eyes, session.hands)
    before = guarded(bench, wait) if wait > 0 else None
    fresh = guarded(bench, requested.duration)
    parts = (*session.parts, *(part for part in (before, fresh) if part is not None))
    eyes = session.eyes
    for part in parts[len(session.parts) :]:
        eyes = sampled(eyes, part, testbed)
    recording = fresh
    if requested.since is not None:
        recording = with_known_inputs(since(parts, requested.since), testbed)
    estimate = measured_estimate(recording, testbed, requested)
    return Session(eyes, hands, parts), recording, estimate


def measured_estimate(recording: Recording, testbed: Testbed, requested: Measurement) -> Estimate:
    """Return the estimate of a method, computed quickly enough for a person at a bench.

    The trajectory fit is taken without the survey that it makes of a recording from elsewhere.
    """
    testbed = as_if_stiff(testbed)
    options = Options(requested.terms, requested.hold, use_prior=requested.use_prior)
    if requested.method != trajectory.METHOD:
        found = estimated(METHODS[requested.method], recording, testbed, options)
        return with_end(found, recording, testbed)
    # A held torque is zero: the trajectory fit leaves it out.
    terms = among({*testbed.disturbances, *requested.terms} - set(requested.hold))
    hold = tuple(name for name in requested.hold if name not in TERMS)
    params = trajectory.Params(terms, use_prior=requested.use_prior, hold=hold)
    fitted = trajectory.fit(recording, testbed, params)
    return conclude(fitted, trajectory.METHOD, recording)


def with_end(found: Estimate, recording: Recording, testbed: Testbed) -> Estimate:
    """Return an estimate with the centre of mass as masses stand, where it has it at home alone."""
    shift = shift_at_end(recording, testbed)
    if found.has(END[0]) or not found.has(COM[0]) or not shift.any():
        return found
    at_home = [found.index(name) for name in COM]
    ends = zip(END, shift, (found.parameters[k] for k in at_home), strict=True)
    moved = (replace(p, name=name, value=p.value + float(step)) for name, step, p in ends)
    every = [*range(len(found.parameters)), *at_home]
    covariance = found.covariance[np.ix_(every, every)]
    return replace(found, parameters=(*found.parameters, *moved), covariance=covariance)


def since(parts: tuple[Recording, ...], start: float) -> Recording:
    """Return the record from a time (s) on."""
    recent = [part for part in parts if part.span[1] >= start]
    return window(joined(recent), start, np.inf)
