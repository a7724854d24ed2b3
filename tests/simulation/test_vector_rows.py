"""Rows of sensors of vectors: at rest, when spinning, late, with bias and noise, in any reads."""

import numpy as np
import pytest

from equipoise.model.devices import MagneticField
from equipoise.model.recording import join
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.simulation.bench import SimulatedBench

FIELD = np.array([2e-5, 0.0, -4e-5])
BIAS, OFF = np.array([0.05, -0.02, 0.03]), np.array([1e-6, 2e-6, -1e-6])
EVERY = {
    "accelerometer": Accelerometer(100.0, 0.01, 0.1, np.array([0.1, 0.05, 0.02]), delay=0.013),
    "sun": SunSensor(5.0, 1e-3, np.array([0.6, 0.0, 0.8])),
    "magnetometer": Magnetometer(20.0, 1e-7, 1e-6),
    "magnetic_field": MagneticField(FIELD),
}
FAST = {"rate": np.array([0.2, -0.1, 0.4]), "attitude": np.array([0.1, 0.2, 0.3])}


def test_at_rest_an_accelerometer_reads_g_upwards(testbed):
    bed = testbed(accelerometer=Accelerometer(50.0, 0.0, 0.0, np.array([0.3, 0.0, 0.0])))
    rows = SimulatedBench(bed, 0).read(1.0).accelerometer.values
    np.testing.assert_allclose(rows, np.tile([0.0, 0.0, 9.81], (51, 1)), atol=1e-9)


def test_a_steady_spin_pulls_towards_the_axis(testbed):
    """Centripetal, w^2 r inwards; the vertical stays as it is."""
    place = np.array([0.3, 0.0, 0.1])
    spin = {"rate": np.array([0.0, 0.0, 2.0])}
    bed = testbed(truth=spin, accelerometer=Accelerometer(50.0, 0.0, 0.0, place))
    rows = SimulatedBench(bed, 0).read(1.0).accelerometer.values
    np.testing.assert_allclose(rows, np.tile([-4.0 * 0.3, 0.0, 9.81], (51, 1)), atol=1e-9)


def test_a_magnetometer_and_a_sun_sensor_see_the_laboratory_turned(testbed):
    """Rolled by 90 deg, the laboratory's z is the body's y."""
    start = {"attitude": np.array([np.pi / 2, 0.0, 0.0])}
    bed = testbed(
        truth=start, sun=SunSensor(5.0, 0.0, np.array([0.6, 0.0, 0.8])),
        magnetometer=Magnetometer(20.0, 0.0, 0.0), magnetic_field=MagneticField(FIELD),
    )  # fmt: skip
    rows = SimulatedBench(bed, 0).read(1.0)
    np.testing.assert_allclose(rows.sun.values[0], [0.6, 0.8, 0.0], atol=1e-12)
    np.testing.assert_allclose(rows.field.values[0], [2e-5, -4e-5, 0.0], atol=1e-16)


def test_bias_and_noise_are_as_stated(testbed):
    truth = {"accelerometer_bias": BIAS, "magnetometer_bias": OFF}
    rows = SimulatedBench(testbed(truth=truth, **EVERY), 0).read(30.0)
    load = rows.accelerometer.values - [0.0, 0.0, 9.81]
    np.testing.assert_allclose(load.mean(axis=0), BIAS, atol=1e-3)
    np.testing.assert_allclose(load.std(axis=0), 0.01, rtol=0.1)
    np.testing.assert_allclose(rows.field.values.mean(axis=0), FIELD + OFF, atol=3e-8)
    np.testing.assert_allclose(rows.sun.values.std(axis=0), 1e-3, rtol=0.2)


def test_a_sensor_that_is_mounted_askew_gives_a_turned_vector(testbed):
    """Turned by +90 deg about x, a sensor's y axis is the body's z."""
    turn = np.array([np.pi / 2, 0.0, 0.0])
    truth = {f"{name}_mounting": turn for name in ("accelerometer", "sun", "magnetometer")}
    quiet = {
        "accelerometer": Accelerometer(50.0, 0.0, 0.0),
        "sun": SunSensor(5.0, 0.0, np.array([0.6, 0.0, 0.8])),
        "magnetometer": Magnetometer(20.0, 0.0, 0.0),
        "magnetic_field": MagneticField(FIELD),
    }
    rows = SimulatedBench(testbed(truth=truth, **quiet), 0).read(1.0)
    np.testing.assert_allclose(rows.accelerometer.values[0], [0.0, 9.81, 0.0], atol=1e-9)
    np.testing.assert_allclose(rows.sun.values[0], [0.6, 0.8, 0.0], atol=1e-12)
    np.testing.assert_allclose(rows.field.values[0], [2e-5, -4e-5, 0.0], atol=1e-16)


def test_a_late_row_is_that_of_a_moment_before(testbed):
    place = np.array([0.1, 0.05, 0.02])
    prompt, late = (
        SimulatedBench(
            testbed((0.0, 0.0, -1e-3), truth=FAST,
                    accelerometer=Accelerometer(50.0, 0.0, 0.0, place, delay)), 0,
        ).read(4.0).accelerometer.values
        for delay in (0.0, 0.1)
    )  # fmt: skip
    np.testing.assert_allclose(late[5:], prompt[:-5], atol=1e-9)


@pytest.mark.parametrize("step", [0.1, 0.37])
def test_rows_do_not_depend_on_how_a_run_is_read(testbed, step):
    bed = testbed((0.0, 0.0, -1e-3), truth=FAST, **EVERY)
    whole, bench = SimulatedBench(bed, 3).read(3.7), SimulatedBench(bed, 3)
    parts = bench.read(step)
    for _ in range(round(3.7 / step) - 1):
        parts = join(parts, bench.read(step))
    for name in ("accelerometer", "sun", "field"):
        a, b = getattr(whole, name), getattr(parts, name)
        np.testing.assert_array_equal(a.t, b.t)
        np.testing.assert_allclose(a.values, b.values, rtol=0, atol=1e-11)
