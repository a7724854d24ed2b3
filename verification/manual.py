"""Balancing by hand from half a millimetre, with 1 g weights on a 25 mm grid, judged by the truth.

The platforms are those of the preset `weights-by-hand`, with the centre of mass 500 um off the
centre of rotation in any direction. The verdict asks for (2, 2, 3) um; the claim is about 5 um.

The preset's air turns a platform by 1 uN m rms that wanders within 30 s. No model of a recording
has it, and one of a minute is too short for a survey to see it. Centre of mass, J_xx and J_yy,
which gravity tells, bear it; J_zz, told by little torque, is stated too surely. So J_zz is
measured twice: in that air, with a limit of its own (``IN_AIR``), and without it, as honest.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand
from equipoise.simulation.hands import SimulatedHands
from verification.balanced import most
from verification.chance import fewest
from verification.result import Result, Row, Spread, at_least, at_most, between, in_turn

OFF, NEAR = 500e-6, 5e-6  # m
TARGET = np.array([0.0, 0.0, -100e-6])  # m
ROUNDS = 4
SHARE, WRONG = 0.95, 0.05  # chosen: of all runs
FALSE = 0.025  # of all runs, as the verdict is given at 97.5 %
HONEST = (0.8, 1.25)  # chosen: rms error in units of its stated sd
IN_AIR = 1.6  # chosen: 1.4 is found for J_zz, known as too sure
SHOWN = (*COM, *INERTIA[:3])
TALL = SHOWN.index("inertia_P_zz")


class Run(NamedTuple):
    """One platform balanced."""

    seed: int
    before: float  # m, true distance from the centre of rotation
    after: float  # m, true distance from the target
    within: bool  # truly within tolerance on every axis
    rounds: int
    handled: int
    seconds: float  # recorded
    outcome: VerdictOutcome
    sentence: str
    errors: NDArray[np.float64]  # (recordings, 6) com and moments, in units of their sd

    @property
    def passed(self) -> bool:
        """Say whether the verdict passed."""
        return self.outcome is VerdictOutcome.PASSED


def half_a_millimetre_off(testbed: Testbed, seed: int) -> Testbed:
    """Return the testbed whose true centre of mass is 500 um off in a direction of the seed's."""
    assert testbed.truth is not None
    direction = np.random.default_rng(1000 + seed).normal(size=3)
    com = OFF * direction / np.linalg.norm(direction)
    return replace(testbed, truth=replace(testbed.truth, com=com))


def in_still_air(testbed: Testbed) -> Testbed:
    """Return the testbed whose platforms no torque turns that wanders."""
    assert testbed.truth is not None
    return replace(testbed, truth=replace(testbed.truth, noise_torque=0.0))


def error_of(step: Step, hands: SimulatedHands) -> NDArray[np.float64]:
    """Return the errors of an estimate in units of their sd."""
    assert step.estimate is not None
    truth = hands.truth()
    real = np.append(truth.com, np.diag(truth.inertia_P))
    sd = np.sqrt(np.diag(step.estimate.covariance_of(SHOWN)))
    return (step.estimate.values(SHOWN) - real) / sd


def placed(seed: int) -> Run:
    """Balance the platform of one seed."""
    return balanced(read_preset("weights-by-hand"), seed)


def placed_in_still_air(seed: int) -> Run:
    """Balance the same without the torque that wanders."""
    return balanced(in_still_air(read_preset("weights-by-hand")), seed)


def balanced(testbed: Testbed, seed: int) -> Run:
    """Balance the platform of one seed of a testbed."""
    hands = SimulatedHands(half_a_millimetre_off(testbed, seed), seed)
    options = HandOptions(TARGET, max_rounds=ROUNDS)
    before, errors, placings = hands.truth().com, [], []
    last = None
    for step in balance_by_hand(hands, options):
        if step.kind == "estimate" and step.estimate.outcome.usable:
            errors.append(error_of(step, hands))
        if step.placing is not None:
            placings.append(step.placing.handled)
        last = step
    off = hands.truth().com - TARGET
    return Run(
        seed, float(np.linalg.norm(before)), float(np.linalg.norm(off)),
        bool(np.all(np.abs(off) <= options.tolerance)), len(placings), sum(placings), hands.time,
        last.verdict.outcome, last.sentence, np.array(errors).reshape(-1, 6),
    )  # fmt: skip


def sizes_of(runs: Sequence[Run]) -> NDArray[np.float64]:
    """Return the rms error of every recording's estimate in units of its sd."""
    return np.sqrt(np.mean(np.vstack([run.errors for run in runs]) ** 2, axis=0))


def honesty_rows(runs: Sequence[Run], still: Sequence[Run]) -> tuple[Row, ...]:
    """Return whether errors are as large as stated; J_zz in air and without it."""
    band, said = HONEST if len(runs) >= 50 else (0.4, 2.0), "rms error by its sd"
    found, calm = sizes_of(runs), sizes_of(still)
    return (
        *(between(f"{SHOWN[k]}: {said}", float(found[k]), band, ".2f") for k in range(TALL)),
        between(f"{SHOWN[TALL]}: {said}, no torque that wanders", float(calm[TALL]), band, ".2f"),
        at_most(f"{SHOWN[TALL]}: {said}, 1 uN m that wanders", float(found[TALL]),
                max(IN_AIR, band[1]), ".2f"),
    )  # fmt: skip


def rows_of(runs: Sequence[Run], still: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows of all runs."""
    n = len(runs)
    near = np.array([run.after <= NEAR for run in runs])
    within = np.array([run.within for run in runs])
    passed = np.array([run.passed for run in runs])
    handled = float(np.mean([run.handled for run in runs]))
    return (
        at_least("truly within 5 um of the target", float(near.mean()), fewest(SHARE, n), ".1%"),
        at_most("rounds, most", max(run.rounds for run in runs), ROUNDS, "d"),
        at_most("farthest from the target, um", 1e6 * max(r.after for r in runs), 5.0, ".2f"),
        at_most("verdict passes a bad run", float(np.mean(passed & ~within)), most(FALSE, n),
                ".1%"),
        at_most("verdict does not pass a good run", float(np.mean(~passed & within)),
                most(WRONG, n), ".1%"),
        *honesty_rows(runs, still),
        at_most("weights handled, mean", handled, 100.0, ".0f"),
    )  # fmt: skip


def notes_of(runs: Sequence[Run]) -> tuple[str, ...]:
    """Return a summary, and a line for every run that ended badly or was judged wrongly."""
    rounds = np.bincount([run.rounds for run in runs])
    counts = ", ".join(f"{n} in {k}" for k, n in enumerate(rounds) if n)
    handled = np.percentile([run.handled for run in runs], [0, 50, 100])
    seconds = np.median([run.seconds for run in runs])
    rms = 1e6 * np.sqrt(np.mean([run.after**2 for run in runs]))
    odd = [run for run in runs if not (run.within and run.passed)]
    return (
        f"Rounds: {counts}. Weights handled: {handled[0]:.0f} to {handled[2]:.0f}, median "
        f"{handled[1]:.0f}; recorded: median {seconds:.0f} s. RMS distance {rms:.2f} um.",
        *(f"Seed {run.seed}: {1e6 * run.after:.2f} um off after {run.rounds} rounds; "
          f"{run.sentence}" for run in odd),
    )  # fmt: skip


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Balance one random platform for each seed."""
    runs, still = spread(placed, seeds), spread(placed_in_still_air, seeds)
    claim = (
        "Preset weights-by-hand, 14 kg, 1 g weights on a 25 mm grid, centre of mass 500 um off in "
        "any direction, inertia up to 10 % off; camera 0.1 deg at 10 Hz that leans by 0.1 deg, "
        f"gyro 0.05 deg/s at 50 Hz; target (0, 0, -100) um; at most {ROUNDS} rounds, {len(runs)} "
        "seeds."
    )
    return Result("manual", claim, rows_of(runs, still), notes_of(runs))
