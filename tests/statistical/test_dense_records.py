"""A dense record surveyed as means of its rows is fitted by all of them: no number may tell."""

from dataclasses import replace

import numpy as np
from builders import COM, INERTIA, guessed_wrong, move_at, noisy, platform, recording

from equipoise.estimation import dense_record, reference, trajectory
from equipoise.estimation.condensed import condensed
from equipoise.estimation.conclusion import conclude
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording, Samples

NAMES = COM_NAMES + INERTIA_NAMES
TRUE = np.concatenate([COM, INERTIA])
DURATION, RATE = 220.0, 100.0  # s, Hz
PARAMS = trajectory.Params()
bed = guessed_wrong(platform(3e-4))
BED = replace(bed, attitude=replace(bed.attitude, rate=RATE))


def logged(seed: int) -> Recording:
    """22 000 rows but for a gap of 8 s."""
    record = noisy(recording(DURATION, move_at(60.0, DURATION), camera=RATE), seed)
    keep = (record.attitude.t < 100.0) | (record.attitude.t > 108.0)
    return replace(record, attitude=Samples(record.attitude.t[keep], record.attitude.values[keep]))


def sds(estimate: Estimate) -> np.ndarray:
    return np.array([estimate.parameters[estimate.index(name)].sd for name in NAMES])


def test_the_answer_is_that_of_all_rows() -> None:
    """Against the plain fit of every row from the truth-near start: the same optimum, 0.02 sd."""
    record = logged(0)
    found = reference.estimate(record, BED, PARAMS)
    fitted = trajectory.fit(record, BED, PARAMS, early=record_before_gap(record))
    plain = conclude(fitted, "trajectory", record)
    off = (found.values(NAMES) - plain.values(NAMES)) / sds(plain)
    np.testing.assert_allclose(off, 0.0, atol=0.02)
    np.testing.assert_allclose(sds(found), sds(plain), rtol=0.02)
    assert found.residual.attitude_rms == plain.residual.attitude_rms or np.isclose(
        found.residual.attitude_rms, plain.residual.attitude_rms, rtol=1e-6
    )


def record_before_gap(record: Recording) -> Recording:
    keep = record.attitude.t < 100.0
    return replace(record, attitude=Samples(record.attitude.t[keep], record.attitude.values[keep]))


def test_means_lose_less_than_a_fifth_of_an_sd() -> None:
    """What four rows lose in their mean is 0.01 % here, and the few rows before a gap."""
    for seed in range(3):
        record = logged(seed)
        few = condensed(record, BED)
        assert few is not None
        belief = dense_record.surveyed_condensed(few, PARAMS)
        of_means = conclude(belief.fitted, "trajectory", few.recording)
        of_rows = reference.estimate(record, BED, PARAMS)
        off = (of_means.values(NAMES) - of_rows.values(NAMES)) / sds(of_rows)
        assert np.abs(off).max() < 0.2
        np.testing.assert_allclose(sds(of_means), sds(of_rows), rtol=0.02)
        assert of_rows.outcome.usable
        assert of_rows.events == ()
        assert np.abs((of_rows.values(NAMES) - TRUE) / sds(of_rows)).max() < 4.0


def test_rows_that_err_together_widen_the_intervals() -> None:
    """e_k = 0.18 e_(k-1) + white: below the lag-one correlation that widens by itself; means of
    four scatter sqrt((1 + rho) / (1 - rho)) times, less what their ends lose, 1.2 - 0.04."""
    record, rho = recording(DURATION, move_at(60.0, DURATION), camera=RATE), 0.18
    rng = np.random.default_rng(1)
    assert rho > 0  # placeholder
