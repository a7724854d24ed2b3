"""Durations and quiet times as people type them."""

from datetime import datetime

import pytest

from equipoise.app.arguments.durations import duration_from, quiet_times
from equipoise.model.errors import InputError

NOON = datetime(2026, 3, 4, 12, 0)


@pytest.mark.parametrize(
    ("text", "seconds"), [("2h", 7200), ("90min", 5400), ("1800s", 1800), ("1.5 h", 5400)]
)
def test_durations(text, seconds):
    assert duration_from("--for", text) == seconds


@pytest.mark.parametrize("text", ["", "2", "2 hours", "-1h", "0s", "169h", "1e3s", "infs", "h"])
def test_what_is_no_duration_is_refused(text):
    with pytest.raises(InputError, match=r"--for: found .*2h, 90min or 1800s"):
        duration_from("--for", text)


def holds(times, t):
    return any(begin <= t < end for begin, end in times)


def test_quiet_times_come_every_day_and_go_on_past_midnight():
    """From noon: 22:00 is 10 h away, 06:30 is 18.5 h away; yesterday's ended 5.5 h ago."""
    times = quiet_times("--quiet", ("22:00-06:30", "12:30-12:45"), NOON)
    hours = {9.9: False, 10.1: True, 18.4: True, 18.6: False, 34.1: True, 0.6: True, 0.8: False}
    assert {h: holds(times, 3600 * h) for h in hours} == hours
    assert holds(quiet_times("--quiet", ("11:00-13:00",), NOON), 0.0)
    assert holds(quiet_times("--quiet", ("23:00-12:30",), NOON), 0.0)  # since yesterday


@pytest.mark.parametrize("text", ["22-6", "24:00-06:00", "10:60-11:00", "10:00-10:00", "at night"])
def test_what_is_no_time_of_the_day_is_refused(text):
    with pytest.raises(InputError, match=r"--quiet: found .*22:00-06:30"):
        quiet_times("--quiet", (text,), NOON)
