"""Rows of a bench whose motion is known by hand: a balanced body turning about its third axis."""

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.maths.attitude import difference, exponential
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.simulation.bench import SimulatedBench

SPIN = 0.2  # rad/s
PUSH = 0.05  # N m on 2.5 kg m^2: 0.02 rad/s^2


def yaw(q):
    return 2 * np.unwrap(np.arctan2(q[:, 3], q[:, 0]))


@pytest.fixture
def spinning(testbed):
    def make(push=0.0, spin=SPIN, **sensors):
        start = {"rate": np.array([0.0, 0.0, spin]), "torque": {"constant_z": push}}
        return SimulatedBench(testbed(truth=start, **sensors), 0)

    return make


@pytest.mark.parametrize(("delay", "averaging"), [(0.0, 0.0), (0.13, 0.0), (0.0, 0.4), (0.13, 0.4)])
def test_camera_row_is_the_mean_of_its_window(spinning, delay, averaging):
    """Turning steadily, the mean of [t - delay - averaging, t - delay] is that of its middle."""
    bench = spinning(attitude=AttitudeSensor(5.0, 0.0, delay, averaging))
    row = bench.read(20.0).attitude
    np.testing.assert_allclose(row.t, np.arange(101) / 5)
    np.testing.assert_allclose(yaw(row.values), SPIN * (row.t - delay - averaging / 2), atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(row.values, axis=1), 1.0, atol=1e-14)


@pytest.mark.parametrize(("delay", "averaging"), [(0.0, 0.0), (0.07, 0.0), (0.07, 0.3)])
def test_pushed_body_is_averaged_as_by_hand(spinning, delay, averaging):
    """At angular acceleration a: mean rate a m, mean angle a (m^2 + T^2 / 12) / 2, m the middle."""
    a = PUSH / 2.5
    bench = spinning(
        PUSH,
        0.0,
        attitude=AttitudeSensor(5.0, 0.0, delay, averaging),
        gyro=Gyro(20.0, 0.0, 0.0, delay, averaging),
    )
    recording = bench.read(10.0)
    middle = recording.attitude.t - delay - averaging / 2
    by_hand = a / 2 * (middle**2 + averaging**2 / 12)
    np.testing.assert_allclose(yaw(recording.attitude.values), by_hand, atol=1e-9)
    middle = recording.rate.t - delay - averaging / 2
    np.testing.assert_allclose(recording.rate.values[:, 2], a * middle, atol=1e-10)


def test_each_sensor_keeps_its_own_time(spinning):
    bench = spinning(attitude=AttitudeSensor(3.0, 0.0), gyro=Gyro(7.0, 0.0, 0.0))
    recording = bench.read(2.0)
    np.testing.assert_allclose(recording.attitude.t, np.arange(7) / 3, atol=1e-9)
    np.testing.assert_allclose(recording.rate.t, np.arange(15) / 7, atol=1e-9)


def test_a_sensor_that_is_not_there_says_nothing(spinning):
    assert spinning(attitude=None).read(1.0).attitude is None
    assert spinning(gyro=None).read(1.0).rate is None
    assert spinning().read(1.0).masses is None


def test_noise_has_its_stated_sd_on_every_axis(spinning):
    bench = spinning(attitude=AttitudeSensor(20.0, 3e-3), gyro=Gyro(20.0, 1e-3, 0.0))
    recording = bench.read(200.0)
    n = len(recording.attitude)
    turned = np.zeros((n, 3))
    turned[:, 2] = SPIN * recording.attitude.t
    for noise, sd in (
        (difference(recording.attitude.values, exponential(turned)), 3e-3),
        (recording.rate.values - [0, 0, SPIN], 1e-3),
    ):
        low, high = chi2.ppf([1e-4, 1 - 1e-4], n) / n
        size = np.mean(noise**2, axis=0) / sd**2
        assert np.all((low < size) & (size < high))
        assert np.all(np.abs(noise.mean(0)) < 4 * sd / np.sqrt(n))
        assert np.all(np.abs(np.corrcoef(noise.T)[np.triu_indices(3, 1)]) < 4 / np.sqrt(n))
        assert abs(np.corrcoef(noise[1:, 0], noise[:-1, 0])[0, 1]) < 4 / np.sqrt(n)


def test_camera_noise_is_in_body_axes(testbed):
    """Pitched by 90 deg, a turn about body z is one about laboratory x: all of it must be small."""
    start = {"attitude": np.array([0.0, np.pi / 2, 0.0])}
    sensor = AttitudeSensor(5.0, 1e-3)
    one = SimulatedBench(testbed(truth=start, attitude=sensor), 1).read(2.0).attitude.values
    level = SimulatedBench(testbed(attitude=sensor), 1).read(2.0).attitude.values
    pitched = np.array([np.sqrt(0.5), 0.0, np.sqrt(0.5), 0.0])
    np.testing.assert_allclose(
        difference(one, pitched), difference(level, np.array([1.0, 0, 0, 0])), atol=1e-12
    )


def test_gyro_is_off_by_its_bias(testbed):
    bias = np.array([1e-3, -2e-3, 3e-3])
    bench = SimulatedBench(testbed(truth={"gyro_bias": bias}), 0)
    np.testing.assert_allclose(bench.read(1.0).rate.values, np.tile(bias, (51, 1)), atol=1e-15)
