"""Wild rows of sensors of vectors are no part of what is estimated, and are reported."""

from dataclasses import replace

import numpy as np

from equipoise.assessment.record_checks.flagged_rows import odd_row_findings
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.recording import Samples
from equipoise.planning.manoeuvre.noiseless_record import imagined
from equipoise.procedure.steps.clean_record import sound
from tests.support.without_camera import without_camera

SWING = Manoeuvre(
    40.0, np.radians(6.0), np.array([1.0, 0.0, 0.0]), np.array([-0.02, -0.01, 0.05]),
    ((20.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip
BED = without_camera("imu")


def recorded():
    record = imagined(BED, BED.body, SWING).recording
    rng, acceleration = np.random.default_rng(5), record.accelerometer
    noisy = acceleration.values + rng.normal(
        0.0, BED.accelerometer.noise, acceleration.values.shape
    )
    turning = record.rate.values + rng.normal(0.0, BED.gyro.noise, record.rate.values.shape)
    rate = Samples(record.rate.t, turning)
    return replace(record, rate=rate, accelerometer=Samples(acceleration.t, noisy))


def test_wild_rows_go_and_no_others():
    """One row in a hundred is off by 50 m/s^2; masses that start and stop are no outliers."""
    record = recorded()
    acceleration = record.accelerometer
    wild, odd = acceleration.values.copy(), np.arange(50, len(acceleration), 100)
    wild[odd] += np.random.default_rng(6).normal(0.0, 50.0, (len(odd), 3))
    spoilt = replace(record, accelerometer=Samples(acceleration.t, wild))
    kept, _ = sound(spoilt, BED)
    np.testing.assert_array_equal(kept.accelerometer.t, np.delete(acceleration.t, odd))
    (found,) = odd_row_findings(spoilt)
    assert found.reasons[0].numbers["count"] == len(odd)


def test_a_sound_record_stays_whole():
    record = recorded()
    assert len(sound(record, BED)[0].accelerometer) == len(record.accelerometer)
    assert odd_row_findings(record) == []
