"""A lamp, a thermometer and what is true of them, as a testbed file has them."""

import numpy as np
import pytest

from equipoise.io.testbed.testbed_file import parse_testbed, text_of_testbed
from equipoise.model.devices import Thermometer
from equipoise.model.errors import InputError
from equipoise.sensors.vector_sensors import sun_direction
from tests.io.testbed.test_devices import PLATFORM

LAMP = """
[lamp]
warms_K = 3
time_constant_s = 90
[sensor.temperature]
rate_hz = 2
noise_K = 0.05
[truth]
thermal_um_K = [1, -0.5, 0.25]
[truth.lamp]
on_s = [[0, 60], [90.5, 600]]
time_constant_s = 75
"""


def test_a_lamp_and_a_thermometer_are_read_in_si() -> None:
    """um/K become m/K; what is left out of the true lamp is as stated."""
    testbed = parse_testbed(PLATFORM + LAMP, "t")
    assert testbed.lamp is not None
    assert (testbed.lamp.warms, testbed.lamp.time_constant) == (3.0, 90.0)
    assert testbed.thermometer == Thermometer(2.0, 0.05)
    truth = testbed.truth
    assert truth is not None
    thermal = [truth.torque[f"thermal_{axis}"] for axis in "xyz"]
    np.testing.assert_allclose(thermal, [1e-6, -0.5e-6, 0.25e-6], rtol=1e-15)
    assert truth.lamp is not None
    assert truth.lamp.warms is None
    assert truth.lamp.time_constant == 75.0
    np.testing.assert_array_equal(truth.lamp.on, [[0.0, 60.0], [90.5, 600.0]])


def test_they_come_back_as_they_were_written() -> None:
    first = parse_testbed(PLATFORM + LAMP, "t")
    again = parse_testbed(text_of_testbed(first), "t")
    assert again.lamp is not None
    assert (again.lamp.warms, again.lamp.time_constant) == (3.0, 90.0)
    assert again.lamp.direction_N is None
    assert again.thermometer == first.thermometer
    assert again.truth is not None
    assert first.truth is not None
    assert again.truth.lamp is not None
    assert first.truth.lamp is not None
    np.testing.assert_array_equal(again.truth.lamp.on, first.truth.lamp.on)
    assert again.truth.lamp.time_constant == 75.0
    assert again.truth.torque == pytest.approx(first.truth.torque, rel=1e-14)


SUN = """
[lamp]
warms_K = 3
time_constant_s = 90
direction = [0, 3, 4]
[sensor.sun]
rate_hz = 5
noise = 0.01
"""


def test_the_direction_to_the_lamp_is_stated_once() -> None:
    """[lamp] has it for the sun sensor, unless that has one of its own; one of them must."""
    for text in (SUN, text_of_testbed(parse_testbed(PLATFORM + SUN, "t"))):
        testbed = parse_testbed(text if "[platform]" in text else PLATFORM + text, "t")
        assert testbed.sun is not None
        assert testbed.sun.direction_N is None
        np.testing.assert_allclose(sun_direction(testbed), [0, 0.6, 0.8], rtol=1e-15)
    own = parse_testbed(PLATFORM + SUN + "direction = [0, 0, 1]\n", "t")
    np.testing.assert_array_equal(sun_direction(own), [0, 0, 1])
    with pytest.raises(InputError, match=r"sensor\.sun\.direction: found nothing"):
        parse_testbed(PLATFORM + SUN.replace("direction = [0, 3, 4]\n", ""), "t")


@pytest.mark.parametrize(
    ("old", "new", "key", "words"),
    [
        ("[90.5, 600]", "[59, 600]", "truth.lamp.on_s", "increasing times from 0 on"),
        ("[0, 60]", "[-1, 60]", "truth.lamp.on_s", "times from 0 on"),
        ("[[0, 60], [90.5, 600]]", "[]", "truth.lamp.on_s", "1 or more"),
        ("[lamp]\nwarms_K = 3\ntime_constant_s = 90\n", "", "truth.lamp.warms_K", "[lamp]"),
        (LAMP[LAMP.index("[truth.lamp]") :], "", "truth.thermal_um_K", "on_s"),
        ("rate_hz = 2", "rate_hz = 0", "sensor.temperature.rate_hz", "above 0"),
    ],
    ids=["overlapping", "before time zero", "never", "not stated", "no lamp", "no rate"],
)
def test_what_does_not_fit_is_named(old, new, key, words) -> None:
    assert old in LAMP
    with pytest.raises(InputError) as caught:
        parse_testbed(PLATFORM + LAMP.replace(old, new, 1), "t")
    assert f"t: {key}: found" in str(caught.value)
    assert words in str(caught.value)
