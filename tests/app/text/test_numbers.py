"""Numbers show as many digits as their sd bears."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equipoise.app.text.numbers import interval, unit_for, with_sd

CASES = [
    (1.23456, 0.0123, ("1.235", "0.012")),
    (-39.0412, 0.26, ("-39.04", "0.26")),
    (8700.4, 380.0, ("8700", "380")),
    (12345.0, 1234.0, ("12300", "1200")),
    (0.0996, 0.0996, ("0.10", "0.10")),
    (1.0, 0.0996, ("1.00", "0.10")),
    (-0.0001, 0.02, ("0.000", "0.020")),
    (0.5, math.inf, ("0.5", "unobservable")),
    (-19880.0, 0.0, ("-1.988e+04", "held")),
    (-19880.0, 0.0025, ("-1.988e+04", "held")),
    (0.0, 2e-12, ("0", "held")),
]


@pytest.mark.parametrize(("value", "sd", "texts"), CASES)
def test_two_digits_of_the_sd(value, sd, texts):
    assert with_sd(value, sd) == texts


@given(
    value=st.floats(-1e6, 1e6),
    sd=st.floats(1e-3, 1e4),
)
def test_rounding_costs_less_than_a_twentieth_of_the_sd(value, sd):
    """Two digits of the sd: the last one is at most a tenth of it, rounding half of that."""
    shown, shown_sd = with_sd(value, sd)
    if shown_sd != "held":
        assert abs(float(shown) - value) <= 0.0501 * sd
        assert abs(float(shown_sd) - sd) <= 0.0501 * sd


def test_an_unobservable_value_has_no_bounds():
    assert interval(1.0, -math.inf, math.inf, math.inf) == "unbounded"


@pytest.mark.parametrize(
    ("name", "si", "shown", "value"),
    [
        ("com_x", "m", "um", 1e-6),
        ("error_x1_1", "m", "mm", 1e-3),
        ("rate_x", "rad/s", "deg/s", math.pi / 180),
        ("drift_x", "m/s", "um/min", 1e-6 / 60),
        ("swirl", "N m", "uN m", 1e-6),
        ("inertia_P_xx", "kg m2", "kg m2", 1.0),
        ("field_bias_x", "T", "uT", 1e-6),
    ],
)
def test_units_of_the_bench(name, si, shown, value):
    unit = unit_for(name, si)
    assert unit.name == shown
    assert unit.size == pytest.approx(value)
