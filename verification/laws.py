"""Every balancing law on the reference table, over many platforms, judged by the truth."""

from collections.abc import Sequence

import numpy as np

from equipoise.app.views.study.law_views import both
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import MM, UM, UN_M
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.hold import FIRST_MOVES
from equipoise.study.compare_laws import Comparison, LawSummary, compared
from equipoise.study.law_run import Task
from verification.chance import fewest
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

BEST = "momentum_buildup"
REQUIRED, SHARE = 1e-5, 0.95  # N m, of runs
PUBLISHED = 3.5e-5  # N m, the least that is published of hardware
LONGEST, TILT = 600.0, float(np.radians(20.0))  # s, rad
TARGET, TOLERANCE = np.zeros(3), np.array([2e-6, 2e-6, 3e-6])  # m
WRONG = 0.025  # of all runs of all laws


def tasks_of(laws: Sequence[str], seeds: Sequence[int]) -> list[Task]:
    """Return every law on every platform."""
    bed, options = read_preset("reference-table"), BalanceOptions(
        TARGET, TOLERANCE, FIRST_MOVES, LONGEST)  # fmt: skip
    return [Task(law, bed, seed + 1, options, LONGEST, TILT) for seed in seeds for law in laws]


def law_rows(law: LawSummary) -> list[Row]:
    """Return what a law leaves and what it takes."""
    left = f"{both(law.aside, UM)} aside, {both(law.height, UM)} in height"
    torque = both(law.torque, UN_M, 3)
    if law.followed is not None:
        torque += f"; masses following {both(law.followed, UN_M, 3)}"
    cost = f"{both(law.time, 1.0, 3)} s, {both(law.travel, MM, 3)} mm"
    lost = f"{law.halted} halted, {law.late} late, {law.false_passes} passed falsely"
    return [
        Row(f"{law.law}: offset (um)", left, "", True),
        Row(f"{law.law}: torque (uN m)", torque, "", True),
        Row(f"{law.law}: time, travel, failures", f"{cost}; {lost} of {law.runs}", "", True),
    ]


def best_rows(found: Comparison) -> list[Row]:
    """Return the rows about the best automatic procedure."""
    runs = [run for run in found.runs if run.law == BEST]
    good = [run.left <= REQUIRED and run.time <= LONGEST for run in runs]
    left = np.array([run.left for run in runs])
    wanted = f"{BEST}, masses following: at most {REQUIRED / UN_M:.0f} uN m within 10 min"
    return [
        at_least(wanted, float(np.mean(good)), fewest(SHARE, len(runs)), ".0%"),
        at_most(f"{BEST}: torque that 95 % of runs stay below (N m)",
                float(np.quantile(left, 0.95)), REQUIRED, ".2g"),
    ]  # fmt: skip


def measure(
    seeds: Sequence[int], spread: Spread = in_turn, laws: Sequence[str] = tuple(CARDS)
) -> Result:
    """Run some laws on the platforms of the seeds."""
    cards = [CARDS[law] for law in laws]
    found = compared(tasks_of(laws, seeds), cards, REQUIRED, lambda *work: iter(spread(*work)))
    rows = best_rows(found)
    false = sum(law.false_passes for law in found.laws) / len(found.runs)
    rows.append(at_most("verdict passes what is outside the tolerance", false, WRONG, ".1%"))
    refused = ", ".join(each.law for each in found.refusals) or "none"
    rows.append(Row("laws refused", refused, "none", not found.refusals))
    for law in sorted(found.laws, key=lambda each: each.left.most):
        rows += law_rows(law)
    below = [law.law for law in found.laws if law.torque.median <= PUBLISHED]
    claim = (
        f"Every law on the preset reference-table, {len(seeds)} platforms, target (0, 0, 0), "
        f"10 min at most: medians, in brackets what 95 % of runs stay below. Torque is rms over "
        f"directions within 20 deg of level, {both(found.before, UN_M, 3)} uN m before. Late: "
        "out of time; halted: broken off for safety; passed falsely: by a verdict, and outside the "
        "tolerance. The same table: `equipoise compare reference-table --laws --runs "
        f"{len(seeds)}`."
    )
    notes = (
        "Masses that stand still leave 11.9 uN m at the least: what no centre of mass trims of a "
        "deck that sags by 25 um. Masses that follow the tilt by the sag that a law has found "
        "leave less.",
        f"Medians below {PUBLISHED / UN_M:.0f} uN m, the best published of hardware, with masses "
        f"that stand: {', '.join(below) or 'none'}.",
    )
    return Result("laws", claim, tuple(rows), notes)
