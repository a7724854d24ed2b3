"""Statistics of a sensor's rows: duplicate, late, missing and frozen ones.

A row that the device has stamped or numbered before is not kept. A sensor with noise never repeats
its values for long: rows that do are frozen, and count as none.
"""

from dataclasses import dataclass, field, replace

from equipoise.model.hardware import Gives
from equipoise.model.reading import Reading

FROZEN = 0.4  # s, chosen: of the very same values, after which rows count as none
WRAP = 50  # rows, chosen: more than networks put out of order; beyond it a counter restarted


@dataclass(frozen=True, slots=True)
class Last:
    """The last row kept of a channel."""

    stamp: float | None
    number: int | None
    values: tuple[float, ...]
    since: float  # s, when these values first came


@dataclass(frozen=True, slots=True)
class Arrivals:
    """What has come so far, and the counts of what was wrong with it."""

    kept: int = 0
    duplicate: int = 0  # stamp or number of the row before
    late: int = 0  # older than a row that was kept
    frozen: int = 0
    missing: int = 0  # by the numbers that were left out
    last: dict[Gives, Last] = field(default_factory=dict["Gives", "Last"])


def arrived(arrivals: Arrivals, reading: Reading, t: float) -> tuple[Arrivals, bool]:
    """Return the arrivals with a reading that came at ``t`` s, and whether it is a row to keep."""
    last = arrivals.last.get(reading.channel)
    if last is not None and _again(last, reading):
        return replace(arrivals, duplicate=arrivals.duplicate + 1), False
    if last is not None and _older(last, reading):
        return replace(arrivals, late=arrivals.late + 1), False
    same = last is not None and last.values == reading.values
    since = last.since if last is not None and same else t
    new = Last(reading.stamp, reading.number, reading.values, since)
    missing = arrivals.missing + (0 if last is None else _left_out(last, reading))
    after = replace(arrivals, missing=missing, last=arrivals.last | {reading.channel: new})
    if t - since > FROZEN:
        return replace(after, frozen=after.frozen + 1), False
    return replace(after, kept=after.kept + 1), True


def begun_anew(arrivals: Arrivals) -> Arrivals:
    """Return the arrivals of a device that was just opened: it may number its rows from the start.

    Counts go on.
    """
    return replace(arrivals, last={})


def _again(last: Last, reading: Reading) -> bool:
    by_stamp = reading.stamp is not None and reading.stamp == last.stamp
    return by_stamp or (reading.number is not None and reading.number == last.number)


def _older(last: Last, reading: Reading) -> bool:
    """Say whether a row is older by its number; by a stamp the device's clock may have jumped."""
    if last.number is None or reading.number is None:
        return False
    return 0 < last.number - reading.number <= WRAP


def _left_out(last: Last, reading: Reading) -> int:
    if last.number is None or reading.number is None:
        return 0
    return max(reading.number - last.number - 1, 0)
