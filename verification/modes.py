"""Flexible and sloshing modes: found where they are, not where they are not; J and com with them.

Platforms are MuJoCo's (``modal_platforms``): with a wheel on a torsion spring that shows by more
than the floor or by less, with two wheels, with a pendulum, and rigid.
"""

import itertools
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.model.estimate import NORMAL_95
from equipoise.model.outcome import Trust
from equipoise.model.reasons.mode_reasons import ModeReason
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from verification.chance import fewest, mean_square_band, share_band
from verification.modal_platforms import FLOOR, Simulated, recorded, simulated
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn
from verification.stated_errors import stated_correlation, stated_errors

STATED = 200  # platforms for which the claim is stated
KINDS = ("wheel", "rigid", "pendulum", "faint", "pair")
WRONG = 4.0  # stated sd, chosen: by chance one of 16000 numbers errs by more
NEAR = 0.01  # of a frequency, chosen: so near is the same mode
BANDS = (10.0, 20.0, 40.0, 70.0, FLOOR, 1e3, 1e5)  # S, by which found wheels are counted

Array = NDArray[np.float64]
NONE = np.zeros((0, 0))


class Found(NamedTuple):
    """One record identified."""

    kind: str
    hits: tuple[bool, ...]  # whether each mode that is there is in the model
    strengths: tuple[float, ...]  # S of each
    modes: int  # in the model
    z: Array  # errors of com and inertia in stated sd; none where they are not usable
    correlation: Array
    trust: Trust
    hangs: bool  # a mass that hangs is in the model
    may_hang: bool  # it states that a part that sags may hang

    @property
    def is_wrong(self) -> bool:
        """Whether a number errs by far more than it says, and nothing warns of it."""
        stated = self.trust in {Trust.TRUSTWORTHY, Trust.WIDENED}
        return stated and not self.may_hang and bool(np.any(np.abs(self.z) > WRONG))


def identified(seed: int) -> Found:
    """Identify one record: of each kind in turn."""
    kind = KINDS[seed % len(KINDS)]
    made = simulated(kind, seed)
    recording, testbed = recorded(made.run, seed)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    found = last.estimate
    usable = found.outcome.usable
    frequencies = [p.value for p in found.parameters if p.name.endswith("_frequency")]
    codes = {reason.code for reason in found.outcome.reasons}
    return Found(
        kind, hits_of(made, frequencies), made.strengths, len(frequencies),
        stated_errors(found, made.run.platform) if usable else np.zeros(0),
        stated_correlation(found) if usable else NONE,
        found.outcome.trust, ModeReason.MASS_HANGS in codes, ModeReason.SAG_MAY_HANG in codes,
    )  # fmt: skip


def hits_of(made: Simulated, frequencies: Sequence[float]) -> tuple[bool, ...]:
    """Return which modes were found."""
    return tuple(
        any(abs(f / mode.frequency - 1.0) < NEAR for f in frequencies) for mode in made.modes
    )


def covered(what: str, runs: Sequence[Found]) -> list[Row]:
    """Return whether com and inertia are in their intervals, and how large their squares are.

    Of records that show them all.
    """
    usable = [run for run in runs if len(run.z) and np.all(np.isfinite(run.correlation))]
    if not usable:
        return []
    z = np.array([run.z for run in usable]).reshape(-1, 9)
    inside = float(np.mean(np.abs(z) < NORMAL_95))
    band = share_band((0.9, 0.99), 0.95, len(usable))
    low, high = mean_square_band([run.correlation for run in usable])
    return [
        between(f"com and inertia in their 95 % intervals, {what}", inside, band),
        between(f"the same: mean (error / sd)^2, of {len(usable)}", float(np.mean(z**2)),
                (min(low, 0.8), max(high, 1.2))),
    ]  # fmt: skip


def rows_of_wheels(runs: Sequence[Found]) -> list[Row]:
    """Return how often the modes of wheels were found, and whether intervals hold with them."""
    share = float(np.mean([run.hits[0] for run in runs]))
    wanted = fewest(0.95, len(runs))
    found = at_least(f"wheels found, S from {FLOOR:g} on, of {len(runs)}", share, wanted)
    return [found, *covered("with wheels", runs)]


def rows_of_rigid(runs: Sequence[Found]) -> list[Row]:
    """Return how often a rigid platform was given a mode or a mass that hangs."""
    false = float(np.mean([run.modes > 0 or run.hangs for run in runs]))
    most = max(0.02, most_by_chance(0.02, len(runs)))
    return [at_most(f"modes of rigid platforms, of {len(runs)}", false, most)]


def most_by_chance(share: float, seeds: int) -> float:
    """Return the greatest share of false ones that still agrees with a true ``share``."""
    return 1.0 - fewest(1.0 - share, seeds)


def rows_of_pendulums(runs: Sequence[Found]) -> list[Row]:
    """Return how often a mass that hangs was found, and an interval did not hold, by far."""
    wrong = float(np.mean([run.is_wrong for run in runs]))
    hanging = [run for run in runs if run.hangs]
    stated = float(np.mean([run.hangs or run.may_hang for run in runs]))
    quantity = f"pendulums: com or inertia {WRONG:g} sd off without a warning, of {len(runs)}"
    rows = [
        at_least("pendulums in the model, or stated to be possible", stated,
                 fewest(0.95, len(runs))),
        at_most(quantity, wrong, 0.0),
    ]  # fmt: skip
    return rows + (covered("with a pendulum in the model", hanging) if hanging else [])


def rows_of_faint(runs: Sequence[Found]) -> list[Row]:
    """Return whether intervals hold where a mode shows little, or not at all."""
    return covered("with wheels below the floor", runs)


def rows_of_pairs(runs: Sequence[Found]) -> list[Row]:
    """Return how often both of two modes were found, and whether intervals hold with them."""
    both = float(np.mean([all(run.hits) for run in runs]))
    wanted = fewest(0.95**2, len(runs))
    return [
        at_least(f"two wheels, both found, of {len(runs)}", both, wanted),
        *covered("with two wheels", runs),
    ]


ROWS = {
    "wheel": rows_of_wheels,
    "rigid": rows_of_rigid,
    "pendulum": rows_of_pendulums,
    "faint": rows_of_faint,
    "pair": rows_of_pairs,
}


def counted(runs: Sequence[Found]) -> str:
    """Return how many wheels were found in bands of S, as a sentence."""
    each = [pair for run in runs if run.kind in {"wheel", "faint"}
            for pair in zip(run.strengths, run.hits, strict=True)]  # fmt: skip
    parts = list[str]()
    for low, high in itertools.pairwise(BANDS):
        inside = [hit for strength, hit in each if low <= strength < high]
        if inside:
            parts.append(f"{low:g} to {high:g}: {sum(inside)} of {len(inside)}")
    return f"wheels found, by how strongly they show (S): {'; '.join(parts)}."


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify one record for each seed."""
    runs = spread(partial(identified), seeds)
    groups = {kind: [run for run in runs if run.kind == kind] for kind in KINDS}
    rows = [row for kind in KINDS if groups[kind] for row in ROWS[kind](groups[kind])]
    claim = (
        "One or two flexible modes of a platform are found where they show, and none where there "
        "is none. A mass that hangs is found, or stated to be possible. Inertia and centre of mass "
        "are inside their intervals all the same."
    )
    return Result("modes", claim, tuple(rows), (counted(runs),))
