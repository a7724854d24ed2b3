"""Which column may be the clock, and in which unit it counts.

A clock grows from row to row in steps that are nearly equal. Its unit follows from its name, from
an epoch that only one unit makes a date of our time, or from the rates that sensors have.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.hypotheses.number_table import NumberTable, words_of
from equipoise.model.arrays import Series1
from equipoise.model.units import MS, NS, NS_100, US

UNITS = {"s": 1.0, "ms": MS, "us": US, "ns": NS}
TICKS = "100 ns"  # of Windows and .NET; a unit of dates alone
# Words of a name that say the unit, and those that say that it is a clock.
UNIT_WORDS = {
    "s": ("s", "sec", "secs", "second", "seconds"),
    "ms": ("ms", "msec", "millis", "millisecond", "milliseconds"),
    "us": ("us", "usec", "micros", "microsecond", "microseconds", "timeus"),
    "ns": ("ns", "nsec", "nanos", "nanosec", "nanosecond", "nanoseconds"),
}
CLOCK_WORDS = frozenset({"t", "time", "timestamp", "stamp", "clock", "epoch", "utc", "tow",
    "ticks", "filetime",
})  # fmt: skip
COUNTER_WORDS = frozenset({"frame", "row", "index", "seq", "sample", "number", "count", "i", "n"})
GROWING = 0.9  # share of the steps that must be forward (chosen)
EVEN = 0.5  # of the usual step, as a robust scatter: more is no clock (chosen)
FASTEST, SLOWEST = 2e-4, 1.0  # s between rows; chosen: no attitude sensor is outside
USUAL = (2e-3, 0.25)  # s: 4 to 500 Hz (chosen)
DATES = (9.4e8, 4.2e9)  # s since 1970: 2000 to 2100
ZEROS = (11_644_473_600, 62_135_596_800)  # s before 1970: 1601 of Windows, year 1 of .NET
OUTSIDE, UNNAMED, COUNTER, OTHER_UNIT = 3.0, 1.0, 1.5, 4.0  # chosen: how much each makes unlikely


@dataclass(frozen=True, slots=True, eq=False)
class ClockGuess:
    """A column that may be the clock."""

    column: str
    unit: str  # 's', 'ms', 'us', 'ns' or '100 ns'
    step: float  # s, the usual one
    doubt: float  # 0: nothing speaks against it

    @property
    def factor(self) -> float:
        """Return what one of its unit is in s."""
        return NS_100 if self.unit == TICKS else UNITS[self.unit]


def clock_guesses(table: NumberTable) -> list[ClockGuess]:
    """Return the clocks that a table may have, the likeliest first."""
    found = [
        ClockGuess(name, unit, step * factor, _doubt(table, name, unit, step * factor))
        for name in table.names
        if (step := _step(table.column(name))) is not None
        for unit, factor in _units(table.column(name)).items()
    ]
    return sorted(found, key=lambda guess: guess.doubt)


def _units(values: Series1) -> dict[str, float]:
    """Return the units that a clock may count, in s: only ticks where these make a date."""
    first = NS_100 * float(values[np.isfinite(values)][0])
    is_date = any(DATES[0] < first - zero < DATES[1] for zero in ZEROS)
    return {TICKS: NS_100} if is_date else UNITS


def _step(values: Series1) -> float | None:
    """Return the usual step of a column that grows as a clock does; None if it does not."""
    finite = values[np.isfinite(values)]
    steps = np.diff(finite)
    moving = steps[steps != 0]
    if len(finite) < 3 or not len(moving) or len(moving) < 0.2 * len(steps):
        return None
    if np.mean(moving > 0) < GROWING:
        return None
    usual = float(np.median(moving))
    scatter = float(np.median(np.abs(moving - usual)))
    return usual if usual > 0 and scatter < EVEN * usual else None


def _doubt(table: NumberTable, name: str, unit: str, step: float) -> float:
    words = set(words_of(name))
    stated = [u for u, spoken in UNIT_WORDS.items() if words & set(spoken)]
    below = table.unit(name)
    stated = [u for u, spoken in UNIT_WORDS.items() if below in spoken] or stated
    doubt = _unlikely(step)
    if stated:
        doubt += 0.0 if unit in stated else OTHER_UNIT
    elif not words & CLOCK_WORDS:
        doubt += UNNAMED
    if words & COUNTER_WORDS and not words & CLOCK_WORDS:
        doubt += COUNTER
    values = table.column(name)
    if unit == TICKS:
        return doubt
    first = float(values[np.isfinite(values)][0]) * UNITS[unit]
    dates = [u for u, f in UNITS.items() if DATES[0] < first / UNITS[unit] * f < DATES[1]]
    if dates and not stated:
        doubt += 0.0 if unit in dates else OTHER_UNIT
    return doubt


def _unlikely(step: float) -> float:
    """Return how unlikely rows of such a distance are, by powers of ten outside what is usual."""
    if not FASTEST <= step <= SLOWEST:
        return OUTSIDE + abs(float(np.log10(step / np.clip(step, FASTEST, SLOWEST))))
    return abs(float(np.log10(step / np.clip(step, *USUAL))))
