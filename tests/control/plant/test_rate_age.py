"""How old a mean of gyro rows is."""

from dataclasses import replace

import pytest

from equipoise.control.plant.rate_age import rate_age
from equipoise.model.testbed import Gyro
from tests.support.ideal_bench import platform


@pytest.mark.parametrize(("rate", "age"), [(100.0, 0.045), (20.0, 0.025), (10.0, 0.0), (5.0, 0.0)])
def test_rows_of_a_period_are_half_of_it_old_less_half_a_row(rate, age):
    """Ten rows 10 ms from each other, the last one now: 0 to 90 ms old."""
    assert rate_age(platform(gyro=Gyro(rate, 1e-5, 0.0)), 0.1) == pytest.approx(age)


def test_without_a_gyro_a_rate_has_no_age():
    assert rate_age(replace(platform(), gyro=None), 0.1) == 0.0
