"""Outlying and frozen rows are found, edges included; smooth motion and touches are not flagged."""

from pathlib import Path

import numpy as np
import pytest

from equipoise.assessment.record_checks.flagged_rows import (
    odd_attitudes,
    odd_rates,
    odd_row_findings,
)
from equipoise.assessment.record_checks.frozen_rows import frozen_attitudes, frozen_rates
from equipoise.assessment.record_checks.outliers import outlying_attitudes, outlying_rates
from equipoise.io.recording.recording_file import read_recording
from equipoise.maths.attitude import exponential, multiply, normalise
from equipoise.model.recording import Recording, Samples

REAL = Path(__file__).parents[4] / "shared" / "data" / "optitrack_tumbling.csv"
NOISE = np.radians(0.03)
SPIN = np.radians([0.5, 10.0, 105.0, 280.0])


def motion(t: np.ndarray, spin: float) -> np.ndarray:
    """A tilt that swings by 5 deg within seconds and, in body axes, goes round with it."""
    tilt = np.radians(5) * np.stack([np.cos(1.9 * t), np.sin(1.3 * t), 0 * t], axis=-1)
    heading = spin * (t - t**2 / 400)
    return multiply(exponential(tilt), exponential(heading[:, None] * [0.0, 0.0, 1.0]))


def observed(rng, spin: float = SPIN[2], dt: float = 0.1, n: int = 400, noise: float = NOISE):
    """A noisy attitude record."""
    t = np.arange(n) * dt
    return Samples(t, turned(motion(t, spin), rng.normal(scale=noise, size=(n, 3))))


def turned(q: np.ndarray, vector: np.ndarray) -> np.ndarray:
    return multiply(q, exponential(vector))


def response(rng, dt: float = 0.05, n: int = 600, noise: float = 1e-3) -> Samples:
    """A noisy gyro record."""
    t = np.arange(n) * dt
    rate = np.stack([0.1 * np.sin(t), 0.1 * np.cos(0.8 * t), 0.2 + 0.05 * np.sin(0.5 * t)], 1)
    return Samples(t, rate + rng.normal(scale=noise, size=(n, 3)))


def off(rng, size: float) -> np.ndarray:
    direction = rng.normal(size=3)
    return size * direction / np.linalg.norm(direction)


@pytest.mark.parametrize("spin", SPIN)
@pytest.mark.parametrize("dt", [0.02, 0.1])
def test_smooth_motion_is_not_flagged(spin, dt) -> None:
    """At most one record in ten has a false alarm: with ten seeds, four would be one in 80."""
    alarms = [outlying_attitudes(observed(np.random.default_rng(s), spin, dt)).mask.any()
              for s in range(10)]  # fmt: skip
    assert sum(alarms) < 4


def test_motion_without_noise_is_not_flagged() -> None:
    """What the polynomial cannot follow is no outlier."""
    for spin in SPIN:
        assert not outlying_attitudes(
            observed(np.random.default_rng(1), spin, noise=0.0)
        ).mask.any()


def test_false_alarms_of_a_gyro() -> None:
    """Fewer than one in ten; of 40, nine would be one in 50."""
    assert sum(outlying_rates(response(np.random.default_rng(s))).mask.any() for s in range(40)) < 9


def test_a_flip_by_one_step_of_coarse_values_is_no_outlier() -> None:
    """Slow motion, noise far below the step: values stand still and flip; a spike still shows."""
    step = np.radians(1 / 16)
    for seed in range(10):
        slow = response(np.random.default_rng(seed))
        rate = np.round(0.05 * slow.values / step) * step
        assert not outlying_rates(Samples(slow.t, rate)).mask.any()
        rate[300] += 20 * step
        assert np.flatnonzero(outlying_rates(Samples(slow.t, rate)).mask).tolist() == [300]
        camera = observed(np.random.default_rng(seed), 0.0, dt=0.02, noise=1e-5)
        coarse = normalise(np.round(camera.values, 3))
        assert not outlying_attitudes(Samples(camera.t, coarse)).mask.any()


@pytest.mark.parametrize("size", [1.0, 3.0, 20.0])
def test_rows_that_are_off_are_found_and_no_others(size) -> None:
    """Anywhere inside a record at 105 deg/s and 10 Hz, noise 0.03 deg."""
    for seed in range(5):
        rng = np.random.default_rng(seed)
        record = observed(rng)
        q, rows = record.values.copy(), [40, int(rng.integers(100, 300)), 360]
        wrong = np.array([off(rng, np.radians(size)) for _ in rows])
        q[rows] = turned(q[rows], wrong)
        odd = outlying_attitudes(Samples(record.t, q))
        assert np.flatnonzero(odd.mask).tolist() == rows
        np.testing.assert_allclose(odd.away[rows], wrong, atol=0.02 * np.radians(size) + 8 * NOISE)


def test_a_flipped_attitude_row_does_not_flag_its_neighbours_during_a_spin() -> None:
    """150 deg off at 280 deg/s: taken from that row, all others swing round with the spin."""
    for seed in range(8):
        rng = np.random.default_rng(seed)
        record = observed(rng, SPIN[3])
        q = record.values.copy()
        q[200] = turned(q[200], off(rng, np.radians(150)))
        odd = outlying_attitudes(Samples(record.t, q))
        assert np.flatnonzero(odd.mask).tolist() == [200]


@pytest.mark.parametrize("size", [3.0, 20.0])
@pytest.mark.parametrize("row", [0, 399])
def test_the_first_and_the_last_row_are_judged(row, size) -> None:
    """At an edge a tenth of the rate is taken for a touch: 10.5 deg/s, 1 deg in 0.1 s."""
    for seed in range(5):
        rng = np.random.default_rng(seed)
        record = observed(rng)
        q = record.values.copy()
        q[row] = turned(q[row], off(rng, np.radians(size)))
        odd = outlying_attitudes(Samples(record.t, q))
        assert np.flatnonzero(odd.mask).tolist() == [row]


def test_rows_next_to_a_gap_are_not_flagged_but_judged() -> None:
    """28 s are lost; then the row before the gap is 10 deg off."""
    for seed in range(5):
        rng = np.random.default_rng(seed)
        record = observed(rng, n=700)
        keep = np.r_[0:200, 480:700]
        t, q = record.t[keep], record.values[keep].copy()
        assert not outlying_attitudes(Samples(t, q)).mask.any()
        q[199] = turned(q[199], off(rng, np.radians(10)))
        assert np.flatnonzero(outlying_attitudes(Samples(t, q)).mask).tolist() == [199]


def test_touches_are_not_flagged() -> None:
    """The rate jumps by 5 deg/s at six moments, between rows: ten records, one may be flagged."""
    flagged = 0
    for seed in range(10):
        rng = np.random.default_rng(seed)
        record = observed(rng)
        q = record.values
        for moment in 4.03 + 6.0 * np.arange(6) + rng.uniform(0, 2, 6):
            since = np.maximum(record.t - moment, 0)[:, None]
            q = multiply(exponential(since * off(rng, np.radians(5))), q)
        flagged += bool(outlying_attitudes(Samples(record.t, q)).mask.any())
    assert flagged <= 1


def test_a_push_is_no_outlier_of_a_gyro_but_a_spike_is() -> None:
    """The rate jumps for good at 10 s; at row 400 it jumps for one row."""
    for seed in range(5):
        rng = np.random.default_rng(seed)
        record = response(rng)
        pushed = record.values + (record.t > 10.02)[:, None] * off(rng, 0.1)
        assert not outlying_rates(Samples(record.t, pushed)).mask.any()
        pushed[400] += off(rng, 0.1)
        odd = outlying_rates(Samples(record.t, pushed))
        assert np.flatnonzero(odd.mask).tolist() == [400]


def test_rows_that_repeat_are_found_where_motion_goes_on() -> None:
    """Rows 50 and 51 repeat row 49; at rest in coarse steps repeats are nothing."""
    record = observed(np.random.default_rng(2))
    q = record.values.copy()
    q[50:52] = q[49]
    assert np.flatnonzero(frozen_attitudes(Samples(record.t, q))).tolist() == [50, 51]
    assert not frozen_attitudes(record).any()
    rate = response(np.random.default_rng(2))
    step = np.radians(1 / 16)
    slow = np.round(rate.values * [0.01, 0.01, 0] / step) * step
    assert not frozen_rates(Samples(rate.t, slow)).any()


def test_a_mask_holds_both_and_the_findings_name_rows_from_one() -> None:
    """Row 101 of a person is row 100 here."""
    rng = np.random.default_rng(3)
    record, gyro = observed(rng), response(rng)
    q, w = record.values.copy(), gyro.values.copy()
    q[100] = turned(q[100], np.radians([0, 6, 8]))
    w[301] = w[300]
    q[201:204] = q[200]
    attitude, rate = Samples(record.t, q), Samples(gyro.t, w)
    assert np.flatnonzero(odd_attitudes(attitude).mask).tolist()[0] == 100
    assert odd_attitudes(attitude).mask[201:204].all()
    assert odd_rates(rate).mask[301]
    said = {f.sentence: f.span for f in odd_row_findings(Recording(attitude, rate))}
    named = next(s for s in said if s.startswith("attitude: row 101 at 10 s is 10 deg off"))
    assert said[named] == (10.0, 10.0)
    assert any(s.startswith("attitude: rows 202 to 204 repeat the one before") for s in said)
    assert any(s.startswith("gyro: row 302 repeats") for s in said)


@pytest.mark.skipif(not REAL.is_file(), reason="the real recording is not at hand")
def test_the_last_row_of_the_real_record() -> None:
    """It is 2.9 deg off by a model of the motion; the touches at 3.5, 11, 18 and 26 s are not."""
    attitude = read_recording(REAL).attitude
    assert attitude is not None
    odd = odd_attitudes(attitude)
    assert np.flatnonzero(odd.mask).tolist() == [600]
    assert np.degrees(np.linalg.norm(odd.outlying.away[600])) == pytest.approx(2.9, abs=0.3)
