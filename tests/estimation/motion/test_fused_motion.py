"""Attitude led by the gyro and held by the camera: nearer to the truth than either."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.motion import fused_motion as module
from equipoise.estimation.motion.fused_motion import led_motion, pieces_of
from equipoise.maths.attitude import difference
from equipoise.maths.walk_smoother import smoothed_walk
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor
from tests.support.builders import noisy, platform, recording

BED = platform(gyro=True)
CLEAN, TRUTH = recording(60.0, None, 5.0, 20.0), recording(60.0, None, 20.0, 20.0)
BIAS = np.array([1e-3, -2e-3, 5e-4])


def off(motion) -> np.ndarray:
    """Attitude errors (n, 3), deg."""
    return np.degrees(difference(motion.q, TRUTH.attitude.values))


@pytest.mark.parametrize("seed", range(4))
def test_it_is_nearer_than_the_camera_and_knows_the_bias(seed):
    """0.2 deg at 5 Hz and a gyro of 0.1 mrad/s with a bias of 2: to 0.06 deg and 0.05 mrad/s."""
    motion = led_motion(noisy(CLEAN, seed, BIAS), BED)
    assert np.sqrt(np.mean(off(motion) ** 2)) < 0.06
    assert np.abs((motion.w - TRUTH.rate.values).mean(axis=0)).max() < 5e-5


def test_without_noise_it_is_the_motion():
    """To a ten-thousandth of a degree: what integrating rates at 20 Hz by halves leaves."""
    assert np.abs(off(led_motion(CLEAN, BED))).max() < 1e-3


def test_gross_errors_of_the_camera_do_not_show():
    """Every twentieth row off by 20 deg."""
    record = noisy(CLEAN, 1)
    q = record.attitude.values.copy()
    q[::20] = noisy(replace(CLEAN, rate=None), 99).attitude.values[::20][:, [1, 0, 3, 2]]
    spoiled = replace(record, attitude=Samples(record.attitude.t, q))
    assert np.sqrt(np.mean(off(led_motion(spoiled, BED)) ** 2)) < 0.08


def test_a_gap_of_the_gyro_begins_a_piece_and_nothing_is_integrated_over_it():
    record = noisy(CLEAN, 1)
    keep = (record.rate.t < 20) | (record.rate.t > 30)
    part = replace(record, rate=Samples(record.rate.t[keep], record.rate.values[keep]))
    motion = led_motion(part, BED)
    assert motion.piece.max() == 1
    assert motion.t[motion.piece == 0].max() < 20 < 30 < motion.t[motion.piece == 1].min()


def test_a_few_missing_rows_are_no_gap():
    t = np.delete(np.arange(0, 10, 0.1), [20, 21, 22, 50])
    assert pieces_of(t).max() == 0
    assert pieces_of(np.delete(np.arange(0, 10, 0.1), slice(20, 30))).max() == 1


def test_behind_a_gap_a_gyro_alone_is_lost_and_says_so():
    record = replace(noisy(CLEAN, 1), attitude=None)
    keep = (record.rate.t < 20) | (record.rate.t > 30)
    part = replace(record, rate=Samples(record.rate.t[keep], record.rate.values[keep]))
    motion = led_motion(part, BED)
    assert motion.t.min() > 30
    assert motion.notes[0].code == "longest_piece_only"


def test_more_rows_than_wanted_are_thinned_to_means(monkeypatch):
    """A third of the rows, at the middle of three, rates the mean of three."""
    whole = led_motion(noisy(CLEAN, 1), BED)
    monkeypatch.setattr(module, "MOST", 500)
    few = led_motion(noisy(CLEAN, 1), BED)
    assert len(few.t) == len(whole.t) // 3
    np.testing.assert_allclose(few.w[7], whole.w[21:24].mean(axis=0), rtol=1e-12)
    np.testing.assert_array_equal(few.q[7], whole.q[22])
    assert few.t[7] == pytest.approx(whole.t[22])


def test_nothing_recorded_is_no_motion():
    assert len(led_motion(Recording(), BED).t) == 0


# --- The walk ---------------------------------------------------------------------------------


def dense(t, z, walk, noise):
    """The same by the normal equations of all rows at once."""
    n = len(t)
    steps = np.diff(np.eye(n), axis=0) / (walk * np.sqrt(np.diff(t)))[:, None]
    normal = np.eye(n) / noise**2 + steps.T @ steps
    return np.linalg.solve(normal, z / noise**2)


def test_smoothing_a_walk_is_least_squares_on_all_its_steps():
    rng = np.random.default_rng(1)
    t = np.cumsum(rng.uniform(0.05, 0.4, 60))
    z = np.cumsum(rng.normal(size=(60, 2)), axis=0)
    np.testing.assert_allclose(smoothed_walk(t, z, 0.7, 1.3), dense(t, z, 0.7, 1.3), rtol=1e-8)


def test_two_rows_by_hand():
    """z = 0 and 3, all variances 1: x = 1 and 2 (x0 = x1 - x0, 3 - x1 = x1 - x0)."""
    found = smoothed_walk(np.array([0.0, 1.0]), np.array([[0.0], [3.0]]), 1.0, 1.0)
    np.testing.assert_allclose(found[:, 0], [1.0, 2.0], rtol=1e-9)


def test_a_camera_of_the_same_rate_as_the_gyro_is_led_too():
    both = recording(30.0, None, 20.0, 20.0)
    bed = replace(BED, attitude=AttitudeSensor(20.0, BED.attitude.noise))
    motion = led_motion(noisy(both, 3), bed)
    error = np.degrees(difference(motion.q, both.attitude.values))
    assert np.sqrt(np.mean(error**2)) < 0.06
