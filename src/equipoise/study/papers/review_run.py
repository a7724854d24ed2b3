"""The review's figure and tables made again: the null vector, methods, laws, balancing by hand.

Methods and laws run on the preset reference-table, a person on the same platforms with the weights
and grids of the preset weights-by-hand. Limits are those of `equipoise compare`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.model.testbed import Testbed
from equipoise.model.units import MM, MN_M, UM
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS
from equipoise.procedure.balancing.hold import FIRST_MOVES
from equipoise.procedure.balancing.run_law import lacking
from equipoise.study.compare_laws import Comparison, LawSummary, compared, summary
from equipoise.study.compare_methods import MethodComparison
from equipoise.study.law_run import Task
from equipoise.study.manual_run import manual_run
from equipoise.study.papers.null_vector import NullVector, paper_rows
from equipoise.study.papers.paper_row import PaperRow, no_larger
from equipoise.study.papers.review_rows import law_claims, method_claims
from equipoise.study.papers.run_engine import Spread

TARGET, TOLERANCE = np.zeros(3), np.array([2.0, 2.0, 3.0]) * UM  # m
LONGEST, TILT, REQUIRED = 600.0, float(np.radians(20.0)), 1e-5  # s, rad, N m
RECORD, MOVED_AT = 120.0, 60.0  # s, of each record for methods
MOVE = {"coarse_x": 2 * MM, "coarse_y": -2 * MM, "coarse_z": -5 * MM}  # chosen: 29 and 71 um
BY_HAND = 1e-2  # N m, section 3: as low as it was balanced by hand


@dataclass(frozen=True, slots=True, eq=False)
class ReviewRun:
    """What was simulated, and what came of it."""

    testbed: Testbed
    seeds: range
    null: NullVector
    methods: MethodComparison
    laws: Comparison
    by_hand: LawSummary

    @property
    def every_law(self) -> tuple[LawSummary, ...]:
        """All laws, and the person."""
        return (*self.laws.laws, self.by_hand)

    @property
    def rows(self) -> tuple[PaperRow, ...]:
        """What the review says beside these."""
        return (
            *paper_rows(self.null),
            *method_claims(self.methods.methods),
            manual_row(self.by_hand),
            *law_claims(self.every_law),
        )


def manual_row(found: LawSummary) -> PaperRow:
    """Return what a person leaves beside what people are reported to."""
    ours = found.torque.most / MN_M
    agreement = no_larger([ours], [BY_HAND / MN_M])
    why = f"{found.runs} platforms, worst of 95 %; weights of 1 g, placed as the program states"
    return PaperRow("section 3", "torque left by manual balancing", "mN m",
                    (BY_HAND / MN_M,), (ours,), agreement, why)  # fmt: skip


def tasks_of(testbed: Testbed, seeds: Sequence[int], laws: Sequence[str]) -> list[Task]:
    """Return every law on every platform."""
    options = BalanceOptions(TARGET, TOLERANCE, FIRST_MOVES, LONGEST)
    return [Task(law, testbed, seed, options, LONGEST, TILT) for seed in seeds for law in laws]


def laws_run(testbed: Testbed, seeds: Sequence[int], spread: Spread) -> Comparison:
    """Return every law that the testbed has the devices for."""
    cards = [card for card in CARDS.values() if not lacking(card, testbed)]
    tasks = tasks_of(testbed, seeds, [card.name for card in cards])
    return compared(tasks, cards, REQUIRED, spread)


def by_hand(testbed: Testbed, weights: Testbed, seeds: Sequence[int], spread: Spread) -> LawSummary:
    """Return what a person leaves of the same platforms, with another testbed's weights."""
    loaded = replace(testbed, weights=weights.weights, grids=weights.grids)
    runs = list(spread(manual_run, tasks_of(loaded, seeds, ["by_hand"])))
    return summary(runs, testbed.up, REQUIRED, TOLERANCE)
