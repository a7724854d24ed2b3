"""When a row was measured."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.sensors.timing import measured_at, spread_of
from tests.support.builders import platform

LATE = replace(platform().attitude, delay=0.3, averaging=0.2)


def test_a_row_stands_for_the_middle_of_its_averaging_before_its_delay():
    """Stamped 10 s, 0.3 s late, the mean of 0.2 s: from 9.5 to 9.7 s, middle 9.6 s."""
    assert measured_at(np.array([10.0]), LATE)[0] == pytest.approx(9.6)


def test_spread_is_the_variance_of_the_moments():
    """Evenly over 0.2 s."""
    moments = np.linspace(-0.1, 0.1, 100_001)
    assert spread_of(LATE) == pytest.approx(moments.var(), rel=1e-4)


def test_without_a_sensor_stamps_are_taken_as_measurement_times():
    assert measured_at(np.array([10.0]), None)[0] == 10.0
    assert spread_of(None) == 0.0
