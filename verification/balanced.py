"""Balancing the preset `sputnix` from random starts, judged by the truth and by its own verdict."""

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binom

from equipoise.io.testbed.presets import read_preset
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.simulation.bench import SimulatedBench
from verification.chance import FULL, RARE, fewest
from verification.result import Result, Row, Spread, at_least, at_most, in_turn, triple

SHARE = 0.95  # of runs that end within tolerance
WRONG = 0.025  # of all runs
SILENT = 0.10  # chosen: of all runs, in which the verdict may be that it cannot tell
UNPASSED = (VerdictOutcome.FAILED, VerdictOutcome.HALTED)  # what a verdict is sure of
OPTIONS = BalanceOptions()
AnyRun = TypeVar("AnyRun", bound=Any)  # by hand or not, with what it was off by and its outcome


class Run(NamedTuple):
    """One platform balanced."""

    seed: int
    off: NDArray[np.float64]  # m, true, from the target
    moves: int
    seconds: float
    outcome: VerdictOutcome
    sentence: str

    @property
    def good(self) -> bool:
        """Say whether the truth is within tolerance."""
        return bool(np.all(np.abs(self.off) <= OPTIONS.tolerance))


def balanced(seed: int) -> Run:
    """Balance the platform of one seed."""
    bench = SimulatedBench(read_preset("sputnix"), seed)
    steps = list(balance(bench, OPTIONS))
    moves = sum(step.kind == "move" for step in steps)
    off = bench.truth().com - OPTIONS.target
    last = steps[-1].verdict
    return Run(seed, off, moves, bench.time, last.outcome, steps[-1].sentence)


def most(share: float, runs: int) -> float:
    """Return the greatest share of some runs that agrees with one of many."""
    return share if runs >= FULL else float(binom.ppf(1 - RARE, runs, share) / runs)


def rows_of(runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows of all runs."""
    n = len(runs)
    good = np.array([run.good for run in runs])
    passed = np.array([run.outcome is VerdictOutcome.PASSED for run in runs])
    failed = np.array([run.outcome in UNPASSED for run in runs])
    tolerance = triple(1e6 * OPTIONS.tolerance, ".0f")
    return (
        at_least(f"truly within {tolerance} um", float(good.mean()), fewest(SHARE, n), ".1%"),
        at_most("moves, most", max(run.moves for run in runs), OPTIONS.max_moves, "d"),
        at_most("bench time, longest, s", max(run.seconds for run in runs), OPTIONS.max_time,
                ".1f"),
        at_most("verdict passes a bad run", float(np.mean(passed & ~good)), most(WRONG, n), ".1%"),
        at_most("verdict fails a good run", float(np.mean(failed & good)), most(WRONG, n), ".1%"),
        at_most("verdict cannot tell", float(np.mean(~passed & ~failed)), most(SILENT, n), ".1%"),
    )  # fmt: skip


def rms_offset(runs: Sequence[Any]) -> str:
    """Return how far off runs ended, rms over all, um."""
    return triple(1e6 * np.sqrt(np.mean(np.array([run.off for run in runs]) ** 2, axis=0)))


def odd_runs(runs: Sequence[AnyRun]) -> list[AnyRun]:
    """Return the runs that ended badly or whose verdict did not pass."""
    return [run for run in runs if not (run.good and run.outcome is VerdictOutcome.PASSED)]


def notes_of(runs: Sequence[Run]) -> tuple[str, ...]:
    """Return a summary, and a line for every run that ended badly or was judged wrongly."""
    moves, seconds = (np.median([getattr(r, k) for r in runs]) for k in ("moves", "seconds"))
    first = (
        f"Median: {moves:.0f} moves, {seconds:.0f} s. RMS offset from the target "
        f"{rms_offset(runs)} um."
    )
    return (first, *(
        f"Seed {run.seed}: off by {triple(1e6 * run.off)} um after {run.moves} moves, "
        f"{run.seconds:.0f} s; {run.sentence}"
        for run in odd_runs(runs)
    ))  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Balance one random platform for each seed."""
    runs = spread(balanced, seeds)
    claim = (
        "Preset sputnix, camera alone, inertia 10 % off, centre of mass up to 60 um aside and "
        f"30-150 um below, target (0, 0, -100) um, {len(runs)} seeds."
    )
    return Result("balanced", claim, rows_of(runs), notes_of(runs))
