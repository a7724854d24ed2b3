"""A dense record surveyed as means of its rows is fitted by all of them: no number may tell."""

from dataclasses import replace

import numpy as np
from scipy.signal import lfilter

from equipoise.estimation.model_selection import dense_record, reference_fit
from equipoise.estimation.model_selection.decimation import condensed
from equipoise.estimation.model_selection.survey import survey
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.maths.attitude import exponential, multiply
from equipoise.model import sensor_terms
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA as INERTIA_NAMES
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording, Samples
from tests.support import thorough
from tests.support.builders import (
    CAMERA_SD,
    COM,
    INERTIA,
    guessed_wrong,
    move_at,
    noisy,
    platform,
    recording,
)

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
    found = reference_fit.estimate(record, BED, PARAMS)
    free = replace(PARAMS, sensor=sensor_terms.GROUPS["plumb"])
    fitted = trajectory.fit(record, BED, free, early=record_before_gap(record))
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
    for seed in range(thorough.count(3, 1)):
        record = logged(seed)
        few = condensed(record, BED)
        assert few is not None
        posterior = survey(*dense_record.fitted_means(few, PARAMS))
        of_means = conclude(posterior.fitted, "trajectory", few.recording)
        of_rows = reference_fit.estimate(record, BED, PARAMS)
        off = (of_means.values(NAMES) - of_rows.values(NAMES)) / sds(of_rows)
        assert np.abs(off).max() < 0.2
        np.testing.assert_allclose(sds(of_means), sds(of_rows), rtol=0.02)
        assert of_rows.outcome.usable
        assert of_rows.events == ()
        assert np.abs((of_rows.values(NAMES) - TRUE) / sds(of_rows)).max() < 4.0


def erring_together(rho: float, seed: int) -> Recording:
    """The same with errors e_k = rho e_(k-1) + white, as large as the camera's."""
    clean = recording(DURATION, move_at(60.0, DURATION), camera=RATE)
    white = np.random.default_rng(seed).normal(size=(len(clean.attitude), 3))
    error = lfilter([np.sqrt(1 - rho**2)], [1.0, -rho], white, axis=0)
    q = multiply(clean.attitude.values, exponential(CAMERA_SD * error))
    return replace(clean, attitude=Samples(clean.attitude.t, q))


@thorough.whole
def test_rows_that_err_together_widen_the_intervals() -> None:
    """By the root of the spectral peak (1 + rho) / (1 - rho), or a little more by chance.

    Means of four, by which the motion is told, scatter by 1 + 2 (3/4 rho + 2/4 rho^2 + 1/4 rho^3)
    times what independent rows do: a widening that is less would be too little.
    """
    rho = 0.19
    scatter = np.sqrt(1 + 2 * (0.75 * rho + 0.5 * rho**2 + 0.25 * rho**3))
    white = reference_fit.estimate(erring_together(0.0, 1), BED, PARAMS)
    together = reference_fit.estimate(erring_together(rho, 1), BED, PARAMS)
    wider = sds(together) / sds(white)
    assert np.all(wider > 0.98 * scatter)
    assert np.all(wider < 1.15 * np.sqrt((1 + rho) / (1 - rho)))
