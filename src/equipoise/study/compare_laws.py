"""What balancing laws are worth on one testbed, over many platforms that it may be.

Every law balances the same platforms (same seeds: same centre of mass, inertia, start, noise). What
they leave is taken from the truth, not from what they say of themselves; how often their verdict
claims more than that is counted beside it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Vector3
from equipoise.model.errors import InputError
from equipoise.model.law_card import LawCard
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import VerdictOutcome
from equipoise.study.law_run import LawRun, Task, law_run

Work = Callable[[Task], "LawRun | Refusal"]
Spread = Callable[[Work, Sequence[Task]], Iterator["LawRun | Refusal"]]


class Middle(NamedTuple):
    """The middle of many values, and what 95 % of them stay below."""

    median: float
    most: float


@dataclass(frozen=True, slots=True)
class Refusal:
    """A law that does not run on this testbed, and why."""

    law: str
    why: str


@dataclass(frozen=True, slots=True)
class LawSummary:
    """A law over many platforms."""

    law: str
    runs: int
    halted: int  # broken off, for safety
    late: int  # not broken off, but out of time
    within: int  # of the runs, with no more torque than required, following or else standing
    false_passes: int  # verdict passed, truth outside the tolerance
    aside: Middle  # m, horizontal offset from the target
    height: Middle  # m, |vertical offset|
    torque: Middle  # N m, rms over the tilt range, masses standing
    followed: Middle | None  # N m, the same with masses that follow the tilt, if the law lets them
    time: Middle  # s
    travel: Middle  # m

    @property
    def left(self) -> Middle:
        """The torque that the procedure leaves, N m: with masses that follow, if they can."""
        return self.followed or self.torque


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """The request, and its results."""

    testbed: Testbed
    seeds: Sequence[int]
    tilt: float  # rad
    required: float  # N m
    before: Middle  # N m, rms torque before any balancing
    laws: tuple[LawSummary, ...]
    refusals: tuple[Refusal, ...]
    runs: tuple[LawRun, ...]


def run_or_refusal(task: Task) -> LawRun | Refusal:
    """Return a run, or why the law does not run on this testbed."""
    try:
        return law_run(task)
    except InputError as refused:
        return Refusal(task.law, str(refused))


def middle(values: Floats) -> Middle:
    """Return median and 95th percentile."""
    return Middle(float(np.median(values)), float(np.quantile(values, 0.95)))


def halted(run: LawRun) -> bool:
    """Say whether a run was broken off, for safety."""
    return run.verdict.outcome is VerdictOutcome.HALTED


def summary(runs: Sequence[LawRun], up: Vector3, required: float, near: Vector3) -> LawSummary:
    """Return one law's runs in numbers; ``near`` is the tolerance that verdicts are about (m)."""
    offset = np.array([run.offset for run in runs])
    height: Floats = offset @ up
    aside = np.linalg.norm(offset - height[:, None] * up, axis=1)
    followed = np.array([run.followed for run in runs if run.followed is not None])
    left = np.array([run.left for run in runs])
    passed = np.array([run.verdict.passed for run in runs])
    beyond = np.any(np.abs(offset) > near, axis=1)
    return LawSummary(
        law=runs[0].law,
        runs=len(runs),
        halted=sum(halted(run) for run in runs),
        late=sum(run.late and not halted(run) for run in runs),
        within=int(np.count_nonzero(left <= required)),
        false_passes=int(np.count_nonzero(passed & beyond)),
        aside=middle(aside),
        height=middle(np.abs(height)),
        torque=middle(np.array([run.torque for run in runs])),
        followed=middle(followed) if len(followed) else None,
        time=middle(np.array([run.time for run in runs])),
        travel=middle(np.array([run.travel for run in runs])),
    )


def compared(tasks: Sequence[Task], cards: Sequence[LawCard], required: float, spread: Spread
             ) -> Comparison:  # fmt: skip
    """Return what the laws of some cards make of tasks, all on one testbed."""
    found = list(spread(run_or_refusal, tasks))
    runs = [each for each in found if isinstance(each, LawRun)]
    refused = {each.law: each for each in found if isinstance(each, Refusal)}
    by_law = [[run for run in runs if run.law == card.name] for card in cards]
    first, near = tasks[0], tasks[0].options.tolerance
    before = {run.seed: run.torque_before for run in runs}
    return Comparison(
        testbed=first.testbed,
        seeds=sorted({task.seed for task in tasks}),
        tilt=first.tilt,
        required=required,
        before=middle(np.array(list(before.values()) or [np.nan])),
        laws=tuple(summary(each, first.testbed.up, required, near) for each in by_law if each),
        refusals=tuple(refused.values()),
        runs=tuple(runs),
    )
