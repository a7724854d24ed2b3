"""Balancing by hand, then by masses, judged by the truth and by its own verdict.

The platforms are those of the preset `two-level`, with the centre of mass 300 um off the centre of
rotation in any direction, as hands find it. What the hands hand over is compared with the truth
before the masses move. It is stated rather too widely: the preset states 10 % of inertia as one sd
where errors of up to 10 % are drawn (5.8 % rms), and a camera that may lean where it does not.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.io.testbed.presets import read_preset
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.balance_manually import HandOptions
from equipoise.procedure.balancing.catalogue import OWN, balanced_by
from equipoise.procedure.balancing.hands_then_masses import hands_then_masses
from equipoise.simulation.hands import SimulatedHands
from verification.balanced import SHARE, SILENT, UNPASSED, WRONG, most, odd_runs, rms_offset
from verification.chance import fewest
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn, triple

OFF = 300 * UM
PLACINGS, MOVES = 2, 3
HONEST = (0.6, 1.25)  # chosen: rms error in units of its stated sd, see above
OPTIONS = HandOptions()


class Run(NamedTuple):
    """One platform balanced."""

    seed: int
    off: NDArray[np.float64]  # m, true, from the target
    placings: tuple[int, ...]  # weights handled in each
    moves: int
    seconds: tuple[float, float]  # recorded by hand, on the bench's clock
    known: NDArray[np.float64]  # (9,) errors of J_P and com as handed over, in units of their sd
    outcome: VerdictOutcome
    sentence: str

    @property
    def good(self) -> bool:
        """Say whether the truth is within tolerance."""
        return bool(np.all(np.abs(self.off) <= OPTIONS.tolerance))


def three_hundred_off(testbed: Testbed, seed: int) -> Testbed:
    """Return the testbed whose true centre of mass is 300 um off in a direction of the seed's."""
    assert testbed.truth is not None
    direction = np.random.default_rng(1000 + seed).normal(size=3)
    com = OFF * direction / np.linalg.norm(direction)
    return replace(testbed, truth=replace(testbed.truth, com=com))


def errors_of(known: Testbed, truth: MassProperties) -> NDArray[np.float64]:
    """Return the errors of what the masses begin with, in units of its sd."""
    assert known.body_covariance is not None
    off = [pack_symmetric(known.body.inertia_P - truth.inertia_P), known.body.com - truth.com]
    return np.concatenate(off) / np.sqrt(np.diag(known.body_covariance))


def balanced(seed: int) -> Run:
    """Balance the platform of one seed."""
    return in_two_levels(SimulatedHands(three_hundred_off(read_preset("two-level"), seed), seed))


def in_two_levels(hands: SimulatedHands, law: str = OWN.name) -> Run:
    """Balance a platform, masses by a law."""
    errors, steps = list[NDArray[np.float64]](), list[Step]()

    def go_on(known: Testbed) -> Iterator[Step]:
        errors.append(errors_of(known, hands.truth()))
        return balanced_by(law, hands.released(known), BalanceOptions(), None)

    steps += hands_then_masses(hands, OPTIONS, go_on)
    last = steps[-1]
    assert last.verdict is not None
    return Run(
        hands.seed,
        hands.truth().com - OPTIONS.target,
        tuple(step.placing.handled for step in steps if step.placing is not None),
        sum(step.move is not None for step in steps),
        (hands.time, last.time),
        errors[0] if errors else np.full(9, np.nan),
        last.verdict.outcome,
        last.sentence,
    )


def rows_of(runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows of all runs."""
    n = len(runs)
    good = np.array([run.good for run in runs])
    passed = np.array([run.outcome is VerdictOutcome.PASSED for run in runs])
    failed = np.array([run.outcome in UNPASSED for run in runs])
    tolerance = triple(1e6 * OPTIONS.tolerance, ".0f")
    com, moments = (known_rms(runs, which) for which in (slice(6, 9), slice(0, 3)))
    band = HONEST if n >= 50 else (0.4, 2.0)
    return (
        at_least(f"truly within {tolerance} um", float(good.mean()), fewest(SHARE, n), ".1%"),
        at_most("placings, most", max(len(run.placings) for run in runs), PLACINGS, "d"),
        at_most("moves, most", max(run.moves for run in runs), MOVES, "d"),
        at_most("verdict passes a bad run", float(np.mean(passed & ~good)), most(WRONG, n), ".1%"),
        at_most("verdict fails a good run", float(np.mean(failed & good)), most(WRONG, n), ".1%"),
        at_most("verdict cannot tell", float(np.mean(~passed & ~failed)), most(SILENT, n), ".1%"),
        between("com as handed over: rms error by its sd", com, band, ".2f"),
        between("moments as handed over: rms error by their sd", moments, band, ".2f"),
    )  # fmt: skip


def known_rms(runs: Sequence[Run], which: slice) -> float:
    """Return the rms error of what is handed over in units of its sd."""
    return float(np.sqrt(np.nanmean([run.known[which] ** 2 for run in runs])))


def notes_of(runs: Sequence[Run]) -> tuple[str, ...]:
    """Return a summary, and a line for every run that ended badly or was judged wrongly."""
    counts = np.bincount([len(run.placings) for run in runs])
    shared = ", ".join(f"{n} in {k}" for k, n in enumerate(counts) if n)
    handled = np.mean([sum(run.placings) for run in runs])
    by_hand, by_masses = np.median([run.seconds for run in runs], axis=0)
    first = (
        f"Placings: {shared}. Weights handled: {handled:.1f} in the mean. Median: {by_hand:.0f} s "
        f"of swings by hand, {by_masses:.0f} s of masses. RMS offset from the target "
        f"{rms_offset(runs)} um."
    )
    return (first, *(
        f"Seed {run.seed}: off by {triple(1e6 * run.off)} um after {len(run.placings)} placings "
        f"and {run.moves} moves; {run.sentence}"
        for run in odd_runs(runs)
    ))  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Balance one random platform for each seed."""
    runs = spread(balanced, seeds)
    claim = (
        "Preset two-level: 5 g blocks by hand until the masses reach the rest, then measure_and_"
        "move; centre of mass 300 um off in any direction, inertia up to 10 % off, camera alone, "
        f"target (0, 0, -100) um, {len(runs)} seeds."
    )
    return Result("two_levels", claim, rows_of(runs), notes_of(runs))
