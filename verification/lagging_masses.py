"""Masses that lag and sag behind their commands: MuJoCo's servos, by what they were told."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.estimation.model_selection.reference_fit import estimate
from equipoise.estimation.output_error.trajectory import Params
from equipoise.model.estimate import NORMAL_95
from equipoise.model.recording import Recording, Samples
from tests.oracle import cases
from verification.chance import mean_square_band
from verification.result import Result, Row, Spread, at_most, between, in_turn
from verification.stated_errors import stated_correlation, stated_errors, stated_sd

STATED = 40  # platforms for which the claim is stated
COVER = (0.90, 0.99)  # share of 95 % intervals that hold the truth
SQUARE = (0.7, 1.4)  # of error / sd
CHI = 0.14  # by which a chi-square a degree of freedom may differ from 1: 4 sd, Case S
WIDER = {"S": 1.1, "G": 1.2}  # chosen: what not knowing lag and sag may cost in sd, on average
LATE = 2 / cases.SOFT  # s
EARLY = 0.075  # s, by which a log is stamped before its time: 100 ms of lag in all
Array = NDArray[np.float64]
CASES: dict[str, Callable[[int], cases.Logged]] = {"S": cases.case_s, "G": cases.case_g}


class Found(NamedTuple):
    """One record identified."""

    z: Array  # (9,) errors of com and inertia, in stated sd
    sd: Array
    correlation: Array  # of these nine, as stated
    lag: tuple[float, float]  # s, and its sd; nan where none is sought
    chi_square: float  # a degree of freedom
    usable: bool


def estimated(logged: cases.Logged) -> cases.Logged:
    """Return a record whose masses are taken to be where they were told, at once."""
    masses = tuple(replace(m, lag_sd=0.0, sag_sd=0.0) for m in logged.testbed.masses)
    testbed = replace(logged.testbed, masses=masses)
    return replace(logged, case=replace(logged.case, testbed=testbed))


def stamped_early(logged: cases.Logged) -> cases.Logged:
    """Return a record whose commands are stamped ``EARLY`` before they were given."""
    reported = logged.commanded.masses
    assert reported is not None
    masses = Samples(reported.t - EARLY, reported.values)
    return replace(logged, commanded=replace(logged.commanded, masses=masses))


def identified(logged: cases.Logged, recording: Recording) -> Found:
    """Identify one record."""
    found = estimate(recording, logged.testbed, Params())
    late = [(p.value, p.sd) for p in found.parameters if p.name == "mass_lag_1"]
    z, sd = stated_errors(found, logged.truth), stated_sd(found)
    assert found.residual is not None
    chi = found.residual.reduced_chi_square
    return Found(z, sd, stated_correlation(found), late[0] if late else (np.nan, np.nan), chi,
                 found.outcome.usable)  # fmt: skip


def reported(case: str, seed: int) -> Found:
    """Identify a record by its commands."""
    logged = cases.level(CASES[case](seed))
    return identified(logged, logged.commanded)


def measured(case: str, seed: int) -> Found:
    """Identify a record by where its masses were."""
    logged = cases.level(CASES[case](seed))
    return identified(logged, logged.recording)


def reported_early(seed: int) -> Found:
    """Identify a record of Case G by commands that are stamped early."""
    logged = stamped_early(cases.level(cases.case_g(seed)))
    return identified(logged, logged.commanded)


def taken_at_their_word(seed: int) -> Found:
    """Identify a record of Case G by commands that are believed."""
    logged = estimated(cases.level(cases.case_g(seed)))
    return identified(logged, logged.commanded)


def square_band(found: Sequence[Found]) -> tuple[float, float]:
    """Return the band of the mean square: as stated, or with fewer platforms wider by chance."""
    if len(found) >= STATED:
        return SQUARE
    low, high = mean_square_band([each.correlation for each in found])
    return min(low, SQUARE[0]), max(high, SQUARE[1])


def honest_rows(label: str, found: Sequence[Found], cautious: bool = False) -> list[Row]:
    """Return the rows about errors of com and inertia, and what is left; ``cautious`` intervals
    may be too wide."""
    z = np.array([each.z for each in found])
    cover = float(np.mean(np.abs(z) < NORMAL_95))
    band = COVER if len(found) >= STATED else (0.7, 1.0)  # few and correlated
    off = CHI / np.sqrt(len(found))
    chi = float(np.mean([each.chi_square for each in found]))
    least, most = square_band(found)
    square = (0.0 if cautious else least, most)
    return [
        between(f"{label}: share of 95 % intervals that hold the truth", cover, band, ".3f"),
        between(f"{label}: mean square of error / sd", float(np.mean(z**2)), square),
        between(f"{label}: chi-square a degree of freedom, mean", chi, (1 - off, 1 + off), ".4f"),
        at_most(f"{label}: not usable", sum(not each.usable for each in found), 0, "d"),
    ]


def lag_rows(label: str, found: Sequence[Found], late: float) -> list[Row]:
    """Return the row about the lag that was found."""
    value, sd = np.array([each.lag for each in found]).T
    square = float(np.mean(((value - late) / sd) ** 2))
    ms = f"{1e3 * value.mean():.1f} +/- {1e3 * sd.mean():.1f} ms"
    quantity = f"{label}: lag {ms} (true {1e3 * late:.0f}); mean square of error / sd"
    return [at_most(quantity, square, 2.0 if len(found) >= STATED else 4.0)]


def cost_row(case: str, label: str, found: Sequence[Found], known: Sequence[Found]) -> Row:
    """Return the row about what it costs not to know where the masses are."""
    ratio = np.array([each.sd for each in found]) / np.array([each.sd for each in known])
    quantity = f"{label}: sd, times that with measured masses, mean"
    return at_most(quantity, float(ratio.mean()), WIDER[case])


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Identify cases S and G by measured masses and by commands."""
    rows: list[Row] = []
    for case in CASES:
        known, found = (spread(partial(way, case), seeds) for way in (measured, reported))
        label = f"Case {case}, told"
        rows += [*honest_rows(f"Case {case}, measured", known), *honest_rows(label, found)]
        rows += [*lag_rows(label, found, LATE), cost_row(case, label, found, known)]
    early = spread(reported_early, seeds)
    label = f"Case G, told {1e3 * EARLY:.0f} ms early"
    rows += [*honest_rows(label, early, cautious=True), *lag_rows(label, early, LATE + EARLY)]
    naive = spread(taken_at_their_word, seeds)
    rms = float(np.sqrt(np.mean(np.array([each.z for each in naive]) ** 2)))
    chi = float(np.mean([each.chi_square for each in naive]))
    claim = (
        f"Masses on servos lag their commands by {1e3 * LATE:.0f} ms and hang by "
        f"{9810 / cases.SOFT**2:.1f} mm (MuJoCo, {len(seeds)} platforms, cases S and G, cameras "
        "known not to lean, as those of the published bound). Their commands alone give centre of "
        "mass and inertia with honest intervals, and the lag."
    )
    note = (
        f"Commands of Case G believed (lag_sd_ms and sag_sd_mm 0): error / sd is {rms:.1f} rms, "
        f"with a chi-square of {chi:.3f} a degree of freedom; {sum(e.usable for e in naive)} of "
        f"{len(naive)} are called usable."
    )
    wide = (
        "Of a log that is stamped early all of the lag counts as the drives', whose dampers would "
        "take energy with it: what is carried for sag is then too much, and intervals are too wide."
    )
    return Result("lagging_masses", claim, tuple(rows), (note, wide))
