"""Balance, then hold for half an hour while the centre of mass drifts, and nobody declared that.

The drift is drawn: 1 to 4 um/min, in a random direction. Rails of 50 mm to either side follow no
more than so many um of it; what a platform needs in all is known from its truth.
"""

from collections.abc import Sequence
from functools import partial

import numpy as np

from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import MINUTE, UM
from equipoise.model.verdict import VerdictOutcome
from equipoise.study.papers.ivanov_balancing import SPEEDS
from equipoise.study.papers.ivanov_hold import Held, HoldTrial, held_while_drifting
from verification.drift import HOLD, LIMIT, note_of
from verification.result import Result, Row, Spread, at_least, at_most, in_turn

SLOWEST, FASTEST = SPEEDS  # m/s
SHARE, FALSE = 0.95, 0.025
PASSED = VerdictOutcome.PASSED


def held(hold: float, seed: int) -> Held:
    """Balance and hold the platform of one seed for so long (s)."""
    return held_while_drifting(HoldTrial(read_preset("sputnix"), seed, hold))


def measure(seeds: Sequence[int], spread: Spread = in_turn, hold: float = HOLD) -> Result:
    """Balance and hold one random platform for each seed."""
    runs = spread(partial(held, hold), seeds)
    near = [each.run for each in runs if each.in_reach]
    beyond = [each.run for each in runs if not each.in_reach]
    runs = [each.run for each in runs]
    false = float(np.mean([run.false for run in runs]))
    worst = np.array([run.worst.max() for run in near if run.held] or [np.nan]) / UM
    moves = np.mean([run.moves for run in near] or [np.nan])
    rows = (
        at_least(f"held within {LIMIT / UM:g} um per axis, of {len(near)} runs whose rails are "
                 "long enough", float(np.mean([run.well for run in near] or [0.0])), SHARE, ".1%"),
        at_most(f"verdicts that pass falsely, of all {len(runs)} runs", false, FALSE, ".1%"),
        Row(f"holds that pass, of {len(beyond)} runs whose rails end short of the target",
            f"{sum(run.outcome is PASSED for run in beyond)}", "", True),
        Row("holds that pass, of those with rails long enough",
            f"{np.mean([run.outcome is PASSED for run in near] or [0.0]):.1%}", "", True),
        Row("held, of all runs", f"{np.mean([run.well for run in runs]):.1%}", "", True),
    )  # fmt: skip
    notes = (
        f"Of those with rails long enough: worst axis, worst second {np.median(worst):.2f} um in "
        f"the median, {worst.max():.2f} um at most; {moves:.0f} moves each. Balancing "
        f"took {np.median([run.began for run in runs]):.0f} s in the median.",
        *(note_of(run) for run in near if not run.well),
        *(f"Passed falsely: seed {run.seed}." for run in runs if run.false),
    )
    claim = (
        f"Preset sputnix as it is, which declares no drift, with a truth that drifts by "
        f"{SLOWEST * MINUTE / UM:g} to {FASTEST * MINUTE / UM:g} um/min in a random direction: "
        f"balanced, then held for {hold / MINUTE:.0f} min within {LIMIT / UM:g} um of the target, "
        "true every second. Rails of 50 mm follow 110 um along an axis, and some drifts, with the "
        "offset at first, need more."
    )
    return Result("undeclared_drift", claim, rows, notes)
