"""Ivanov et al.'s balancing, section 5: a law on many platforms, with drift that nobody declares.

The target is theirs, 100 um below P. A platform is as ``ivanov.platform`` has it, with its centre
of mass up to NEAR from where they found it: so it hangs, as theirs did, within its tilt limit. It
drifts at a speed and in a direction that its seed draws. A law is judged by where it really leaves
the centre of mass, after how many moves and how long.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import MINUTE, UM
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import balanced_by
from equipoise.study.law_run import CountedBench
from equipoise.study.papers.ivanov import COM, drifting, platform
from equipoise.study.papers.paper_row import PaperRow, no_larger

TARGET = np.array([0.0, 0.0, -100.0]) * UM  # m, section 5
NEAR = 10 * UM  # m, chosen: along each axis, twice what their fits scatter aside
REACHED = np.full(3, 10 * UM)  # m, section 5 and conclusions
MOVES, TIME = 4, 100.0  # -, s: section 5, four moves 25 s apart
SPEEDS = np.array([1.0, 4.0]) * UM / MINUTE  # m/s, chosen: what warmth does to a table
NEARLY = 0.05  # chosen: the printed numbers have one digit or two
MOSTLY = 0.95  # of the platforms, chosen
LAWS = ("ivanov_25s", "measure_and_move")


@dataclass(frozen=True, slots=True, eq=False)
class Balanced:
    """Where a law left a platform."""

    law: str
    seed: int
    drifts: bool
    error: Vector3  # m, true centre of mass from the target, at the end
    moves: int
    last_move: float  # s
    outcome: VerdictOutcome

    @property
    def reached(self) -> bool:
        """Say whether the centre of mass is as near as the paper has it, along every axis."""
        return bool(np.all(np.abs(self.error) <= REACHED))


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """A law, a platform, and whether it drifts."""

    law: str
    preset: Testbed
    seed: int
    drifts: bool


def bed_of(trial: Trial) -> Testbed:
    """Return the platform of a trial."""
    bed = platform(trial.preset)
    assert bed.truth is not None
    box = replace(bed.truth, com=None, com_low=COM - NEAR, com_high=COM + NEAR)
    drawn = replace(bed, truth=box)
    low, high = SPEEDS if trial.drifts else (0.0, 0.0)
    speed = float(np.random.default_rng([trial.seed, 3]).uniform(low, high))
    return drifting(drawn, speed, trial.seed)


def balanced(trial: Trial) -> Balanced:
    """Return where a law leaves the platform of a trial."""
    bench = CountedBench(bed_of(trial), trial.seed)
    options = BalanceOptions(TARGET, REACHED)
    made: tuple[int, float] | None = None
    outcome = VerdictOutcome.UNDECIDED
    for step in balanced_by(trial.law, bench, options, None):
        if made is None and ended(step):
            made = bench.moves, bench.sent
        if step.verdict is not None:
            outcome = step.verdict.outcome
    error = bench.truth().com - TARGET
    moves = made or (bench.moves, bench.sent)
    return Balanced(trial.law, trial.seed, trial.drifts, error, *moves, outcome)


def ended(step: Step) -> bool:
    """Say whether a law has ended; moves after that swing the platform for the proof."""
    return any(reason.code is StepReason.LAW_RAN for reason in step.reasons)


def balancing_rows(every: Sequence[Balanced]) -> tuple[PaperRow, ...]:
    """Return the rows of Figs. 14 and 15 for each law, with and without drift."""
    found = list[PaperRow]()
    for drifts in (False, True):
        for law in LAWS:
            runs = [run for run in every if (run.law, run.drifts) == (law, drifts)]
            found += law_rows(law, runs, drifts)
    return tuple(found)


def law_rows(law: str, runs: Sequence[Balanced], drifts: bool) -> list[PaperRow]:
    """Return what a law reaches, after how many moves, and when."""
    worst = [float(np.abs(run.error).max()) / UM for run in runs]
    drift = "1 to 4 um/min of undeclared drift" if drifts else "no drift"
    why = f"{len(runs)} platforms, {drift}; worst of 95 %"
    mostly = partial(np.quantile, q=MOSTLY)
    numbers = (
        ("distance from the target along an axis", "um", REACHED[0] / UM, mostly(worst)),
        ("moves", "", MOVES, mostly([run.moves for run in runs])),
        ("the last move", "s", TIME, mostly([run.last_move for run in runs])),
    )
    return [
        PaperRow("Figs. 14, 15", f"{law}: {quantity}", unit, (float(printed),), (float(ours),),
                 no_larger([float(ours)], [float(printed)], NEARLY), why)
        for quantity, unit, printed, ours in numbers
    ]  # fmt: skip
