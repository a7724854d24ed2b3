"""A start without a camera: gyro with drift, corrected by the vectors that are measured."""

from dataclasses import replace

import numpy as np

from equipoise.estimation.motion.sampled_motion import sampled_motion
from equipoise.estimation.motion.vector_attitude import first_attitude
from equipoise.maths.attitude import difference, tilt
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed, Truth
from equipoise.model.vector_sensors import Accelerometer, SunSensor
from equipoise.sensors.vector_sensors import vector_sensors
from equipoise.simulation.bench import SimulatedBench

BIAS = np.array([0.003, -0.004, 0.002])  # rad/s: half a radian in 120 s
START = np.array([0.1, -0.15, 0.4]), np.array([0.01, 0.02, 0.03])  # rad, rad/s
UP = np.array([0.0, 0.0, 1.0])
EXACT = Accelerometer(50.0, 0.01, 0.0)
LAMP = SunSensor(5.0, 1e-3, np.array([0.8, 0.0, 0.6]))


def blind(**sensors):
    """Return a testbed whose platform swings below a gyro with a bias."""
    com, zero = np.array([0.0, 0.0, -2e-4]), np.zeros(3)
    body = MassProperties(10.0, com, np.diag([1.0, 2.0, 2.5]))
    truth = Truth(com, com, com, body.inertia_P, 0.0, START[0], 0.0, START[1], 0.0, {}, 0.0, 30.0,
                  BIAS)  # fmt: skip
    return Testbed("blind", body, 0.1, zero, UP, np.pi, 9.81, (), AttitudeSensor(50.0, 0.0),
                   Gyro(50.0, 1e-4, 0.01), truth=truth, **sensors)  # fmt: skip


def motion(**sensors):
    """Return the motion by gyro and vectors, and the attitude as it really was."""
    bed = blind(**sensors)
    record = SimulatedBench(bed, 0).read(120.0)
    return sampled_motion(replace(record, attitude=None), bed), record.attitude.values


def test_gravity_holds_the_tilt_against_the_drift_of_a_gyro():
    """Within 3 mrad through 120 s of a bias that alone turns it by half a radian."""
    found, true = motion(accelerometer=EXACT)
    np.testing.assert_allclose(tilt(found.q, UP), tilt(true, UP), atol=3e-3)
    assert np.linalg.norm(BIAS) * 120.0 > 0.5


def test_a_lamp_beside_gravity_shows_the_heading_and_the_bias():
    found, true = motion(accelerometer=EXACT, sun=LAMP)
    np.testing.assert_allclose(difference(found.q, true), 0.0, atol=3e-3)
    np.testing.assert_allclose(found.w[0], START[1], atol=6e-4)


def test_without_a_vector_the_drift_stays():
    found, true = motion()
    assert np.abs(tilt(found.q, UP) - tilt(true, UP)).max() > 0.1


def test_wild_rows_of_the_first_second_leave_the_first_attitude_as_it_is():
    """A tenth of 50 m/s^2 aside: their mean would lean by half a radian."""
    rng = np.random.default_rng(2)
    rows = np.array([0.0, 0.0, 9.81]) + rng.normal(0.0, 0.01, (50, 3))
    rows[3::10, 0] += 50.0
    (sensor,) = vector_sensors(replace(blind(), accelerometer=EXACT))
    q = first_attitude([(sensor, Samples(np.arange(50) / 50.0, rows))], 0.0)
    assert tilt(q, UP) < 3e-3
