"""Ivanov et al.'s experiment as a whole: records and fits, the tracker, the balancing."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.study.papers.ivanov import Fitted, Tracked, experiment, session, tracked
from equipoise.study.papers.ivanov_balancing import (
    LAWS,
    Balanced,
    Trial,
    balanced,
    balancing_rows,
)
from equipoise.study.papers.ivanov_hold import (
    HOLD,
    Held,
    HoldTrial,
    held_while_drifting,
    hold_rows,
)
from equipoise.study.papers.ivanov_rows import fit_rows, tracking_rows
from equipoise.study.papers.paper_row import PaperRow
from equipoise.study.papers.run_engine import By


@dataclass(frozen=True, slots=True, eq=False)
class IvanovRun:
    """What was simulated, and what came of it."""

    preset: Testbed
    seeds: range
    session: Recording
    fits: Sequence[Fitted]
    tracked: Tracked
    balanced: Sequence[Balanced]  # by every law, with and without drift
    held: Sequence[Held]  # for half an hour, with drift

    @property
    def rows(self) -> tuple[PaperRow, ...]:
        """The paper's numbers beside these."""
        return (
            *fit_rows(self.fits),
            *tracking_rows(self.tracked),
            *balancing_rows(self.balanced),
            *hold_rows(self.held),
        )


def ivanov_run(preset: Testbed, seeds: range, by: By, hold: float = HOLD) -> IvanovRun:
    """Return the whole experiment: as many fits, platforms to balance and to hold (s) as seeds."""
    whole = session(preset, seeds[0])
    fits = list(by("identifying")(partial(experiment, preset), seeds))
    along = tracked(preset, fits[0].estimate, seeds[0])
    trials = [
        Trial(law, preset, seed, drifts)
        for seed in seeds
        for law in LAWS
        for drifts in (False, True)
    ]
    laws = list(by("balancing")(balanced, trials))
    holds = [HoldTrial(preset, seed, hold) for seed in seeds]
    held = list(by("holding for half an hour")(held_while_drifting, holds))
    return IvanovRun(preset, seeds, whole, fits, along, laws, held)
