"""Durations and times of the day as people type them: 2h, 90min, 1800s; 22:00-06:30."""

import re
from collections.abc import Sequence
from datetime import datetime, timedelta

from equipoise.model.errors import InputError

SECONDS = {"h": 3600.0, "min": 60.0, "s": 1.0}
DURATION = re.compile(r"(?P<number>\d{1,7}(?:\.\d{1,4})?) ?(?P<unit>h|min|s)")
QUIET = re.compile(r"(?P<a>\d{1,2}):(?P<b>\d{2})-(?P<c>\d{1,2}):(?P<d>\d{2})")
DAYS = 8  # chosen: a keeping lasts a week at most
LONGEST = 7 * 24 * 3600.0  # s


def duration_from(option: str, text: str) -> float:
    """Return a duration (s); InputError for what is none, or longer than a week."""
    read = DURATION.fullmatch(text.strip())
    seconds = 0.0 if read is None else float(read["number"]) * SECONDS[read["unit"]]
    if not 0 < seconds <= LONGEST:
        raise InputError(option, f"'{text}'", "a duration such as 2h, 90min or 1800s, up to 168h")
    return seconds


def quiet_times(
    option: str, texts: Sequence[str], start: datetime
) -> tuple[tuple[float, float], ...]:
    """Return quiet times of each day, in s since ``start``, from the day before it on.

    Local time; one that ends before it begins goes on past midnight.
    """
    midnight = start.replace(hour=0, minute=0, second=0, microsecond=0)
    found: list[tuple[float, float]] = []
    for text in texts:
        begin, end = _of_day(option, text)
        length = (end - begin) % timedelta(days=1)
        for day in range(-1, DAYS):
            first = (midnight + timedelta(days=day) + begin - start).total_seconds()
            found.append((first, first + length.total_seconds()))
    return tuple(sorted(found))


def _of_day(option: str, text: str) -> tuple[timedelta, timedelta]:
    read = QUIET.fullmatch(text.strip())
    wanted = InputError(option, f"'{text}'", "times of a day such as 22:00-06:30")
    if read is None:
        raise wanted
    a, b, c, d = (int(read[name]) for name in "abcd")
    if a > 23 or c > 23 or b > 59 or d > 59 or (a, b) == (c, d):
        raise wanted
    return timedelta(hours=a, minutes=b), timedelta(hours=c, minutes=d)
