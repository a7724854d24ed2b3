"""Numbers of options that no bench has: a sentence, and no memory by their size."""

import pytest

PLAUSIBLE = {
    "simulate": ("simulate", "sputnix", "--out", "run.csv"),
    "simulate-fast": ("simulate", "nanosat", "--out", "run.csv"),
    "plan": ("plan", "sputnix"),
    "compare": ("compare", "sputnix", "--methods"),
    "balance": ("balance", "sputnix"),
    "design": ("design", "sputnix"),
}


@pytest.mark.parametrize(
    ("command", "option", "value"),
    [
        ("simulate", "--duration-s", "1e308"),
        ("simulate", "--duration-s", "1.7e9"),
        ("simulate-fast", "--duration-s", "9e6"),  # some 1e9 rows
        ("simulate", "--move", "2: x1=1e308"),
        ("simulate", "--move", "1e160: x1=1"),
        ("simulate", "--move", "nan: x1=1"),
        ("plan", "--duration-s", "1e12"),
        ("plan", "--max-rate-deg-s", "1e160"),
        ("compare", "--duration-s", "1e12"),
        ("balance", "--target-um", ("1e300", "0", "0")),
        ("balance", "--max-time-s", "1e160"),
        ("design", "--record-s", "1e30"),
        ("design", "--require-torque", "1e100"),
    ],
)
def test_a_number_that_no_bench_has_is_named(equipoise, command, option, value):
    values = (value,) if isinstance(value, str) else value
    outcome = equipoise(*PLAUSIBLE[command], option, *values)
    assert outcome.code == 2
    assert option in outcome.err
    assert "wanted" in outcome.err
