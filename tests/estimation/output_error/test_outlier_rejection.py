"""Rows far off the motion are left out of a robust estimate; a wrong model loses none."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.registry import METHODS
from equipoise.estimation.output_error.outlier_rejection import outlying, without_outliers
from equipoise.estimation.output_error.trajectory import Params
from equipoise.maths.attitude import exponential, multiply
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.recording import Samples
from equipoise.planning.manoeuvre.noiseless_record import imagined
from tests.support.builders import move_at, noisy, platform, recording
from tests.support.without_camera import without_camera

SWING = Manoeuvre(
    40.0, np.radians(6.0), np.array([1.0, 0.0, 0.0]), np.array([-0.02, -0.01, 0.05]),
    ((20.0, {"x1": -0.010, "y1": -0.010, "z1": -0.050}),),
)  # fmt: skip
BED = platform(accuracy=1e-4, gyro=True)


def spoiled():
    """Every fiftieth row of the camera off by 20 deg."""
    record = noisy(recording(60.0, move_at(20.0, 60.0), 5.0, 20.0), 1)
    q = record.attitude.values.copy()
    q[10::50] = multiply(q[10::50], exponential(np.array([0.35, 0.0, 0.0])))
    return record, replace(record, attitude=Samples(record.attitude.t, q))


def test_the_odd_rows_go_and_no_others():
    sound, odd = spoiled()
    kept, gone = without_outliers(odd, BED, Params())
    assert gone == 6
    assert len(kept.attitude) == len(sound.attitude) - 6
    assert len(kept.rate) == len(sound.rate)


def test_wild_rows_of_an_accelerometer_go_and_no_others():
    """One row in fifty is off by 50 m/s^2; the sun sensor beside it, whose rows mix, is sound."""
    bed = without_camera("sun")
    record = imagined(bed, bed.body, SWING).recording
    acceleration = record.accelerometer
    noise = np.random.default_rng(1).normal(0.0, bed.accelerometer.noise, acceleration.values.shape)
    values, odd = acceleration.values + noise, np.arange(10, len(acceleration), 50)
    values[odd] += [50.0, 0.0, 0.0]
    spoilt = replace(record, accelerometer=Samples(acceleration.t, values))
    kept, gone = without_outliers(spoilt, bed, Params())
    assert gone == len(odd)
    np.testing.assert_array_equal(kept.accelerometer.t, np.delete(acceleration.t, odd))
    assert len(kept.sun) == len(record.sun)
    assert len(kept.rate) == len(record.rate)


def test_a_robust_estimate_says_how_many_it_left_out():
    found = METHODS["trajectory"].run(spoiled()[1], BED, Options(robust=True))
    assert found.outcome.usable
    assert "6 outliers were removed." in found.outcome.sentence


def test_where_many_rows_deviate_none_is_an_outlier():
    left = np.random.default_rng(1).normal(size=(100, 3))
    left[:30] += 1000.0
    assert not outlying(left).any()
    left[:30] -= 1000.0
    left[0] += 1000.0
    assert outlying(left).tolist() == [True] + [False] * 99


def test_uniformly_loud_noise_has_no_outliers():
    """Ten times as loud as stated: the usual distance is ten, too."""
    assert not outlying(10 * np.random.default_rng(2).normal(size=(1000, 3))).any()
