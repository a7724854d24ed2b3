"""Every way to balance, by name: the package's own procedure, and the published laws."""

from collections.abc import Generator, Iterator
from dataclasses import replace

from equipoise.control.laws.follow import following_law
from equipoise.control.laws.registry import LAWS
from equipoise.model.bench import Bench
from equipoise.model.law_card import LawCard
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.step import Step
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.procedure.balancing.run_law import LawOptions, check, run_law
from equipoise.procedure.steps.joint_fit import Knowledge
from equipoise.simulation.carried_out import carried_out

OWN = LawCard(
    name="measure_and_move",
    idea=(
        "Fits the whole record, moves when that improves the balance, and verifies it on "
        "fresh data."
    ),
    source="Equipoise; Ivanov 2021 section 5, with the trajectory fit instead of a filter",
    needs=("masses", "attitude"),
    leaves="the motor steps; elastic sag only if the testbed models it",
    stable=(
        "open loop between moves: always stable; it stops a platform that approaches its tilt limit"
    ),
    period=0.0,
)
LEISURE = 10.0  # s, chosen: for the first measurement, before the masses follow
CARDS: dict[str, LawCard] = {OWN.name: OWN, **{name: law.card for name, law in LAWS.items()}}


def balanced_by(
    name: str, bench: Bench, options: BalanceOptions, max_time: float | None
) -> Iterator[Step]:
    """Return the steps of a law; InputError for a testbed that lacks what it needs."""
    check(CARDS[name], bench.testbed)
    if name == OWN.name:
        return balance(bench, options)
    own = LawOptions(options.target, options.tolerance, budget=options.budget)
    return run_law(bench, LAWS[name], own if max_time is None else replace(own, max_time=max_time))


def balanced_and_followed(
    name: str, bench: Bench, options: BalanceOptions, max_time: float | None, duration: float
) -> Iterator[Step]:
    """Yield the steps of a law and, if its verdict passes, of masses that follow sag and drift.

    They follow for ``duration`` seconds; another swing proves where they leave the platform.
    """
    following, passed = None, False
    for step in balanced_by(name, bench, options, max_time):
        following = step.following or following
        passed = step.verdict is not None and step.verdict.passed
        yield step
    if following is not None and passed:
        own = LawOptions(options.target, options.tolerance, budget=options.budget)
        law = following_law(following, bench.time + duration)
        yield from run_law(bench, law, replace(own, max_time=duration + own.proof + LEISURE))


def planned_and_balanced(
    bench: Bench, options: BalanceOptions, manoeuvre: Manoeuvre
) -> Generator[Step, None, Knowledge]:
    """Yield the manoeuvre of a bench that was let go as planned, then the steps of ``balance``.

    Its time and its moves do not count among those that balancing may take. Devices rest then.
    """
    recording = carried_out(bench, manoeuvre)
    if manoeuvre.waves:
        bench.stop()
    reasons = one_reason(StepReason.PLAN_CARRIED_OUT, duration=manoeuvre.duration)
    yield Step("measurement", bench.time, reasons, recording=recording)
    return (yield from balance(bench, options, recording))
