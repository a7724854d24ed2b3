"""Laws compared: runs spread over processes, with a sign of life."""

import math
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from equipoise.app.options import one_of
from equipoise.app.terminal import stderr
from equipoise.control.law import LawCard
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.procedure.balance import BalanceOptions
from equipoise.procedure.hold import FIRST_MOVES
from equipoise.procedure.laws import CARDS
from equipoise.procedure.run_law import check, lacking
from equipoise.study.compare_laws import Comparison, LawRun, Refusal, Work, compared
from equipoise.study.law_run import Task

DEG = math.pi / 180


@dataclass(frozen=True, slots=True, eq=False)
class Asked:
    """What is to be compared."""

    testbed: Testbed
    cards: Sequence[LawCard]
    seeds: Sequence[int]
    target: Vector3  # m
    tolerance: Vector3  # m
    tilt_deg: float
    required: float  # N m
    max_time: float  # s


def chosen(testbed: Testbed, only: Sequence[str]) -> list[LawCard]:
    """Return the laws to run; InputError for one that is unknown or lacks a device, or for none."""
    able = [card for card in CARDS.values() if not lacking(card, testbed)]
    if not able:
        found = "a testbed that has the devices for none of the laws"
        raise InputError(testbed.name, found, "what `equipoise laws` says that they need")
    if not only:
        return able
    cards = [CARDS[one_of("--only", name, list(CARDS))] for name in only]
    for card in cards:
        check(card, testbed)
    return cards


def run(asked: Asked, workers: int) -> Comparison:
    """Return the comparison; runs of one platform by all laws come one after the other."""
    options = BalanceOptions(asked.target, asked.tolerance, FIRST_MOVES, asked.max_time)
    tilt = asked.tilt_deg * DEG
    tasks = [
        Task(card.name, asked.testbed, seed, options, asked.max_time, tilt)
        for seed in asked.seeds
        for card in asked.cards
    ]

    def spread(work: Work, items: Sequence[Task]) -> Iterator[LawRun | Refusal]:
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
                   TimeElapsedColumn())  # fmt: skip
        with (
            Progress(*columns, console=stderr(), transient=True) as progress,
            ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool,
        ):
            yield from progress.track(pool.map(work, items), len(items), description="balancing")

    return compared(tasks, asked.cards, asked.required, spread)
