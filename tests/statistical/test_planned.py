"""What a plan promises beside Monte Carlo: `verification/planned.py`, one manoeuvre, few seeds."""

from functools import cache

import numpy as np

from equipoise.design.promise import promise
from equipoise.model.manoeuvre import Manoeuvre
from verification.chance import mean_square_band
from verification.planned import BODY, hand_balanced, wish_of
from verification.planned_runs import by_mujoco

SEEDS = 8
SPUN = Manoeuvre(
    60.0, np.radians(9.0), np.array([1.0, 0.0, 0.0]), np.radians([0.0, 0.5, 2.0]),
    ((20.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050, "z2": -0.050}),),
)  # fmt: skip


@cache
def both():
    testbed = hand_balanced()
    promised = promise(testbed, SPUN, wish_of(testbed), 1)
    return promised, [by_mujoco(testbed, SPUN, seed) for seed in range(SEEDS)]


def test_errors_on_mujocos_records_are_as_large_as_promised():
    """Mean square of nine errors in promised sd, runs in the stated model: once in 1000 outside."""
    promised, runs = both()
    kept = [run for run in runs if run.as_stated]
    assert len(kept) >= SEEDS / 2
    found = np.mean([(run.error / promised.sd_of(BODY)) ** 2 for run in kept])
    low, high = mean_square_band([run.covariance / np.outer(run.sd, run.sd) for run in kept])
    assert low < found < high


def test_the_sd_that_identify_states_are_those_promised():
    """Its rms over the platforms of eight runs: within 30 %, as platforms differ by a half."""
    promised, runs = both()
    stated = np.sqrt(np.mean([run.sd**2 for run in runs if run.as_stated], axis=0))
    np.testing.assert_allclose(stated, promised.sd_of(BODY), rtol=0.3)


def test_platforms_tilt_as_far_as_those_imagined():
    """300 were imagined: the greatest of eight is not beyond theirs, nor below a third of it."""
    promised, runs = both()
    greatest = max(run.tilt for run in runs)
    assert promised.greatest_tilt / 3 < greatest <= promised.greatest_tilt
