"""Which method or law to take, and why: a sentence, of what was measured and nothing else.

A method qualifies for a group of parameters (com, inertia) if on all records

    it failed in no run and missed by more than 5 sd in none,
    it stated everything in the group that the record shows, and did not warn of its intervals in at
    least nine runs of ten (``MOSTLY``),
    its coverage is not below what chance leaves of 95 % once in a hundred times (``RARE``).

Chance is that of as many draws as there are runs: parameters of one run err together. Intervals
that are too wide are honest. The one with the least RMSE / bound is recommended, and of those
within 1.5 times of it (``NEAR``) the quickest.

A law qualifies if it leaves the required torque in 95 % of its runs and its verdicts passed what is
wrong in at most 2.5 %, as often as a verdict may (``model.criterion``). Of those with the fewest
halts, the one whose torque 95 % of runs stay below is least. Runs that are too few to prove the
share, by the same rule, are said to be.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

from equipoise.model.criterion import VerdictOutcome, decided
from equipoise.model.units import MS, UN_M
from equipoise.study.bounded_share import bounded_share
from equipoise.study.compare_laws import Comparison, LawSummary
from equipoise.study.compare_methods import WRONG, MethodSummary, Ratios

Group = Literal["com", "inertia"]
COVER, RARE, MOSTLY, NEAR = 0.95, 0.01, 0.9, 1.5
WITHIN = 0.95  # of a law's runs
FALSE = 0.025  # of a law's runs, the most that may pass wrongly
FEW = 20  # runs, chosen: with fewer, coverage of 80 % passes for chance
CALLED: dict[Group, str] = {"com": "the centre of mass", "inertia": "the inertia"}


@dataclass(frozen=True, slots=True)
class Advice:
    """What is recommended, if anything is, and why."""

    name: str | None
    sentence: str


def least_share(runs: int) -> float:
    """Return the least coverage of so many runs that may be chance for intervals of 95 %."""
    if not runs:
        return 1.0
    covered = float(np.ceil(scipy.special.bdtrik(RARE, runs, COVER)))
    if (
        covered > 0 and scipy.special.bdtr(covered - 1, runs, COVER) >= RARE
    ):  # what rounding made one more
        covered -= 1
    return covered / runs


def percent(share: float) -> str:
    """Return a share as a sentence has it."""
    return f"{100 * share:.0f} %"


def ratios_of(method: MethodSummary, group: Group) -> Ratios:
    """Return a method's errors in a group."""
    return method.com if group == "com" else method.inertia


def lacks(method: MethodSummary, group: Group) -> str:
    """Return why a method does not qualify, "" if it does."""
    stated, cover, runs = ratios_of(method, group).stated, method.coverage, method.runs
    warned, least = method.warned, least_share(method.trusted)
    reasons = (
        (not stated.part, "states nothing"),
        (method.failed > 0, f"fails in {method.failed} of {runs} runs"),
        (stated.part < stated.of, f"states {stated.part} of {stated.of} values"),
        (method.confident_wrong > 0,
         f"is off by more than {WRONG:g} sd in {method.confident_wrong} of {runs} runs"),
        (method.trusted < MOSTLY * runs, f"warns about its intervals in {warned} of {runs} runs"),
        (not cover.value >= least, f"has 95 % intervals with a coverage of {percent(cover.value)}"),
    )  # fmt: skip
    return next((reason for lacking, reason in reasons if lacking), "")


def numbers(method: MethodSummary, group: Group) -> str:
    """Return what a recommendation rests on."""
    return (
        f"RMSE {ratios_of(method, group).rmse:.2g} times the bound, 95 % intervals "
        f"that hold {percent(method.coverage.value)} of {method.coverage.of} (at least "
        f"{percent(least_share(method.trusted))} is consistent with chance), no "
        f"failure in {method.runs} runs, {float(f'{method.time / MS:.2g}'):g} ms"
    )


def advised_method(methods: Sequence[MethodSummary], group: Group) -> Advice:
    """Return which method to take for a group, and why."""

    def ratio(method: MethodSummary) -> float:
        return ratios_of(method, group).rmse

    good = [method for method in methods if not lacks(method, group)]
    if not good:
        return Advice(None, nobody(methods, group, ratio))
    best = min(good, key=ratio)
    sentence = f"For {CALLED[group]} take {best.method}: {numbers(best, group)}."
    quick = min((m for m in good if ratio(m) <= NEAR * ratio(best)), key=lambda m: m.time)
    if quick is not best:
        sentence += f" Faster, within {NEAR:g} times its error: {quick.method}, "
        sentence += f"{numbers(quick, group)}."
    if best.runs < FEW:
        sentence += f" {best.runs} runs are few: more runs show whether its intervals hold."
    return Advice(best.method, sentence)


def nobody(
    methods: Sequence[MethodSummary], group: Group, ratio: Callable[[MethodSummary], float]
) -> str:
    """Say that no method qualifies, and what keeps the nearest ones from it."""
    stating = sorted((m for m in methods if ratios_of(m, group).stated.part), key=ratio)
    if not stating:
        return f"For {CALLED[group]} no method can be recommended: none states it."
    reported = "; ".join(f"{m.method} {lacks(m, group)}" for m in stating[:3])
    return (
        f"For {CALLED[group]} no method can be recommended: none has valid intervals "
        f"on all records. The most accurate: {reported}."
    )


def advised_law(found: Comparison) -> Advice:
    """Return which law to take, and why."""
    required = f"{found.required / UN_M:.3g} uN m"
    good = [law for law in found.laws if law_qualifies(law)]
    if not good:
        near = min(
            found.laws, key=lambda law: (-law.within / law.runs, law.left.most), default=None
        )
        reported = "" if near is None else f" The nearest: {near.law}, {law_numbers(near)}."
        wrong = "leaves at most the required torque in 95 % of runs with at most 2.5 % false passes"
        return Advice(
            None, f"No law can be recommended: none {wrong} (at most {required}).{reported}"
        )
    best = min(good, key=lambda law: (law.halted / law.runs, law.left.most))
    doubt = "" if proven(best) else f" {best.runs} runs are too few to prove 95 %."
    said = f"Take {best.law}: {law_numbers(best)}; {required} was required.{doubt}"
    return Advice(best.law, said)


def law_qualifies(law: LawSummary) -> bool:
    """Say whether a law leaves what is required, and hardly ever passes what does not."""
    return law.within >= WITHIN * law.runs and law.false_passes <= FALSE * law.runs


def proven(law: LawSummary) -> bool:
    """Say whether so many runs prove that the law leaves what is required in 95 % of all."""
    missed = bounded_share(law.runs - law.within, law.runs)
    return decided(missed, 1 - WITHIN) is VerdictOutcome.PASSED


def law_numbers(law: LawSummary) -> str:
    """Return what a recommendation of a law rests on."""
    return (
        f"{law.left.median / UN_M:.3g} uN m left, {law.left.most / UN_M:.3g} uN m in "
        f"the worst of 95 % of runs, within the required torque in {law.within} of "
        f"{law.runs}, {law.halted} halted, {law.false_passes} false passes, "
        f"{law.time.median:.0f} s"
    )
