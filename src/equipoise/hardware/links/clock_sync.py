"""A device's clock against the bench's: offset and drift from stamps and arrivals.

    arrival = stamp + offset + drift * (stamp - first) + delay        delay >= 0

Delays scatter and have no upper bound, but the quickest of many rows is about as quick at any
time. So the line is the one below all arrivals that is nearest to them: through the quickest row
of each of the last ``SPANS`` spans, the one of the two outer ones that leaves none below. What it
cannot see is the least delay itself: rows are late by that.

A stamp that goes back is a clock that restarted; so is a row much earlier than the line, which is
below all rows, or one so late that no delay explains it. During the first span the line is not
settled: there a row early by that only begins the count anew.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

SPAN = 5.0  # s, chosen: some hundred rows
SPANS = 24  # chosen: two minutes, in which a quartz drifts evenly
LATE = 1.0  # s, chosen: no row is so late without a jump of the clock
EARLY = 0.05  # s, chosen: nor so early; the line is within a ms of the quickest rows


@dataclass(frozen=True, slots=True)
class DeviceClock:
    """What is known of a device's clock; each quickest row is a stamp and its arrival, s."""

    first: float = 0.0  # s, stamp where the present count began
    last: float = float("-inf")  # s, stamp
    quickest: tuple[tuple[float, float], ...] = ()  # of each span
    span_end: float = float("-inf")  # s, stamp
    jumps: int = 0


def learnt(clock: DeviceClock, stamp: float, arrival: float, waited: float = 0.0) -> DeviceClock:
    """Return the clock with one more row.

    ``waited``: s, for how long it may have lain before somebody read it.
    """
    if not clock.quickest:
        return _begun(clock, stamp, arrival)
    late = arrival - to_bench(clock, stamp)
    if stamp < clock.last or not -EARLY <= late <= LATE + waited:
        unsettled = -LATE <= late < 0 and len(clock.quickest) == 1
        return replace(_begun(clock, stamp, arrival), jumps=clock.jumps + (not unsettled))
    if stamp >= clock.span_end:
        rows = (*clock.quickest, (stamp, arrival))[-SPANS:]
        return replace(clock, last=stamp, quickest=rows, span_end=stamp + SPAN)
    best = clock.quickest[-1]
    if arrival - stamp < best[1] - best[0]:
        clock = replace(clock, quickest=(*clock.quickest[:-1], (stamp, arrival)))
    return replace(clock, last=stamp)


def to_bench(clock: DeviceClock, stamp: float) -> float:
    """Return the bench's time of a stamp, s, the least delay counted in."""
    (s0, a0), rate = _line(clock)
    return a0 + (1.0 + rate) * (stamp - s0)


def drift_of(clock: DeviceClock) -> float:
    """Return how much slower the device's clock goes, s a second; 0 until there are three spans."""
    return _line(clock)[1]


def offset_of(clock: DeviceClock) -> float:
    """Return what the bench's clock reads beyond the device's at its last row, s."""
    return to_bench(clock, clock.last) - clock.last


def _begun(clock: DeviceClock, stamp: float, arrival: float) -> DeviceClock:
    return DeviceClock(stamp, stamp, ((stamp, arrival),), stamp + SPAN, clock.jumps)


def _line(clock: DeviceClock) -> tuple[tuple[float, float], float]:
    return _line_below(clock.quickest)


@lru_cache(maxsize=64)  # most rows are not the quickest and leave it as it is
def _line_below(rows: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], float]:
    """Return a row on the line and its slope less one.

    The lower hull's edge over the middle of the spans: no row is below it, and of such lines it
    is nearest to the rows on average.
    """
    if len(rows) < 3:
        return min(rows, key=lambda row: row[1] - row[0]), 0.0
    hull = _lower_hull(tuple((s, a - s) for s, a in rows))
    middle = 0.5 * (rows[0][0] + rows[-1][0])
    k = next(k for k in range(1, len(hull)) if hull[k][0] >= middle or k == len(hull) - 1)
    (s0, d0), (s1, d1) = hull[k - 1], hull[k]
    return (s0, s0 + d0), (d1 - d0) / (s1 - s0)


def _lower_hull(points: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    """Return the corners of the lower convex hull, left to right (Andrew 1979)."""
    hull: list[tuple[float, float]] = []
    for x, y in points:
        while len(hull) > 1 and _turns_down(hull[-2], hull[-1], (x, y)):
            hull.pop()
        hull.append((x, y))
    return hull


def _turns_down(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> bool:
    """Say whether b is on or above the line from a to c."""
    return (b[1] - a[1]) * (c[0] - a[0]) >= (c[1] - a[1]) * (b[0] - a[0])
