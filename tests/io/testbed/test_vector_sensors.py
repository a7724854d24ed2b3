"""Accelerometer, sun sensor and magnetometer in a testbed file: in SI, and back."""

import numpy as np
import pytest

from equipoise.io.testbed.testbed_file import parse_testbed
from equipoise.io.testbed.testbed_file import text_of_testbed as text_of
from equipoise.model.errors import InputError

BARE = """
name = "bare"
[platform]
mass_kg = 10
inertia_kg_m2 = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 0.6]]
"""
FIELD = "[magnetic_field]\nfield_uT = [20, 0, -40]\n"
ACCELEROMETER = """
[sensor.accelerometer]
rate_hz = 100
noise_m_s2 = 0.01
bias_sd_m_s2 = 0.05
place_mm = [80, -20, 35]
delay_s = 0.002
"""
SUN = "[sensor.sun]\nrate_hz = 5\nnoise = 0.002\ndirection = [3, 0, 4]\n"
MAGNETOMETER = "[sensor.magnetometer]\nrate_hz = 20\nnoise_uT = 0.5\n"


def again(text):
    """Return the testbed of a text, and of what is written of it."""
    first = parse_testbed(text, "t")
    return first, parse_testbed(text_of(first), "t")


@pytest.mark.parametrize("turn", [0, 1])
def test_an_accelerometer_has_a_place_in_the_body(turn):
    sensor = again(BARE + ACCELEROMETER)[turn].accelerometer
    assert (sensor.rate, sensor.noise, sensor.bias_sd, sensor.delay) == (100, 0.01, 0.05, 0.002)
    np.testing.assert_allclose(sensor.place, [0.08, -0.02, 0.035], rtol=1e-15)


@pytest.mark.parametrize("turn", [0, 1])
def test_a_sun_sensor_knows_where_its_lamp_is(turn):
    """A direction of any length is one of unit length."""
    sensor = again(BARE + SUN)[turn].sun
    assert (sensor.rate, sensor.noise, sensor.delay) == (5, 0.002, 0)
    np.testing.assert_allclose(sensor.direction_N, [0.6, 0, 0.8], rtol=1e-15)


@pytest.mark.parametrize("turn", [0, 1])
def test_a_magnetometer_is_stated_beside_its_field(turn):
    sensor = again(BARE + FIELD + MAGNETOMETER)[turn].magnetometer
    assert sensor.noise == pytest.approx(5e-7, rel=1e-15)
    assert sensor.bias_sd == pytest.approx(1e-6, rel=1e-15)


def test_a_platform_without_them_has_none():
    testbed = parse_testbed(BARE, "t")
    assert (testbed.accelerometer, testbed.sun, testbed.magnetometer) == (None, None, None)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (MAGNETOMETER, "a magnetometer but no magnetic field"),
        (FIELD + "noise_uT = 1\n" + MAGNETOMETER, "noise_uT in \\[magnetic_field\\] as well"),
        (SUN.replace("[3, 0, 4]", "[0, 0, 0]"), "direction"),
        (SUN.replace("noise = 0.002\n", ""), "noise"),
    ],
)
def test_what_makes_no_sense_is_refused(text, words):
    with pytest.raises(InputError, match=words):
        parse_testbed(BARE + text, "t")
