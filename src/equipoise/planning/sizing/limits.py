"""What limits a design, in sentences, from its budget and from what would better it."""

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.criterion import DESIGN, Interval
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why
from equipoise.model.units import MM, PERCENT, UM, UN_M
from equipoise.model.verdict import Verdict
from equipoise.planning.sizing.budget import Budget
from equipoise.planning.sizing.case import Case
from equipoise.planning.sizing.expected_torque import Line
from equipoise.planning.sizing.reachable_set import Reach, tolerance, unreachable
from equipoise.planning.sizing.sensitivity import MASS_LENGTHS, Bettered

ACCURACY = 0.15  # of a torque, chosen: within it predictions agree with Monte Carlo
ENOUGH = 0.95  # of platforms as stated, chosen: as many as a law has to balance in ``compare``
NOTABLE = 0.01  # of the torque, chosen: a change that brings less is not worth a line
WAYS = ("nothing", "one line", "a plane")


def limit_sentence(case: Case, budget: Budget, better: tuple[Bettered, ...]) -> str:
    """Say which line is the largest, and the result if it were better."""
    line, total = budget.lines[0], plain(budget.torque / UN_M)
    text = (
        f"{line.cause}{detail(case, line)} limits the result: {plain(line.torque / UN_M)} of "
        f"{total} uN m rms within {np.degrees(case.tilt):.3g} deg of level."
    )
    mending = [change for change in better if change.line == line.name]
    if mending:
        best = mending[0]
        after = plain(best.torque / UN_M)
        return f"{text} {capital(best.name)} would reduce it from {total} to {after} uN m."
    without = np.sqrt(max(budget.torque**2 - line.torque**2, 0.0)) / UN_M
    return f"{text} Without it {plain(without)} uN m would remain."


def detail(case: Case, line: Line) -> str:
    """Return numbers of the masses that a line is about, in brackets, or nothing."""
    if line.name in MASS_LENGTHS:
        return f" ({mass_figures(case, MASS_LENGTHS[line.name])})"
    return f" in {case.measurement_time:g} s" if line.name == "measurement" else ""


def mass_figures(case: Case, quantity: str) -> str:
    """Return a length of each mass in mm, those of one length together."""
    groups: dict[float, list[str]] = {}
    for mass in case.testbed.masses:
        groups.setdefault(getattr(mass, quantity), []).append(mass.name)
    return ", ".join(f"{size / MM:.3g} mm of {', '.join(names)}" for size, names in groups.items())


def plain(value: float) -> str:
    """Return a number with three digits, whole where it has more before the point."""
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def capital(text: str) -> str:
    """Return a text with its first letter large."""
    return text[:1].upper() + text[1:]


def reach_sentence(reach: Reach, within: float) -> str:
    """Return the correctable offset as a sentence, and the share of platforms within it."""
    share = f"{within / PERCENT:.3g} % of the platforms that the testbed describes"
    size = plain(tolerance(reach) / UM)
    if reach.rank == 3:
        return (
            f"An offset from the target of up to {size} um can be corrected in any "
            f"direction: balance by hand to within that. {capital(share)} can be "
            "brought there."
        )
    free = ", ".join(direction(v) for v in unreachable(reach).T)
    return (
        f"The masses act {WAYS[reach.rank]} only, up to {size} um in any direction of "
        f"it; nothing shifts the centre of mass along {free}. {capital(share)} can be "
        "brought to the target."
    )


def direction(v: Vector3) -> str:
    """Return a direction in body axes; its opposite is as good."""
    positive = v if v.sum() >= 0 else -v
    return "(" + ", ".join(f"{round(float(x), 3) + 0.0:g}" for x in positive) + ")"


def verdict(
    budget: Budget,
    required: float | None,
    better: tuple[Bettered, ...],
    together: tuple[Bettered, ...] = (),
) -> Verdict:
    """Say whether the required torque (N m) can be met, and if not, what would change that."""
    numbers = {"expected": budget.torque, "within": budget.within}
    if required is None:
        return Verdict(one_reason(Why.NOTHING_REQUIRED, **numbers))
    numbers |= {"required": required, "accuracy": ACCURACY}
    if budget.within < ENOUGH:
        return Verdict(one_reason(Why.OUT_OF_REACH, **numbers))
    answer = DESIGN.answer(predicted(budget.torque), required, numbers)
    enough = [change.name for change in better if change.torque <= required]
    if answer.code is DESIGN.refuted and enough:
        return Verdict(one_reason(Why.MET_BY_ONE_CHANGE, *enough, **numbers))
    if answer.code is DESIGN.refuted and together and together[-1].torque <= required:
        return Verdict(one_reason(Why.MET_BY_CHANGES, *(b.name for b in together), **numbers))
    return Verdict((answer,))


def predicted(torque: float) -> Interval:
    """Return between which torques (N m) the expected one lies."""
    return Interval((1 - ACCURACY) * torque, (1 + ACCURACY) * torque)


def worth_listing(budget: Budget, better: tuple[Bettered, ...]) -> tuple[Bettered, ...]:
    """Return the changes with an effect: less torque, or more platforms within reach."""
    return tuple(
        change
        for change in better
        if change.torque < (1 - NOTABLE) * budget.torque or change.within > budget.within + NOTABLE
    )
