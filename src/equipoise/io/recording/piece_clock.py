"""The clock of a long table, set right piece by piece where its times are in order.

Where they are not, or where a gap could be another clock's, the column of times is judged as a
whole, as ``clock`` does; all other columns stay on the disk.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.row_faults import FaultyRows
from equipoise.io.columns.table import Table, no_rows
from equipoise.io.recording.build_recording import EPOCH, zero_note
from equipoise.io.recording.channels import Rows, read_time
from equipoise.io.recording.clock import STRAY, Clock, check_span, clock_of, untimed
from equipoise.model.arrays import Ints

Notes = tuple[str, ...]
Range = tuple[int, int]  # rows, from one to before another


@dataclass(frozen=True, slots=True, eq=False)
class PieceClock:
    """The clock of a table, and pieces of rows between which it goes on."""

    pieces: tuple[Range, ...]
    start: float  # s, taken as zero
    least: float | None  # of whole seconds that stand in a column of their own
    faulty: tuple[FaultyRows, ...]
    notes: Notes
    whole: Clock | None = None  # where it was judged as a whole

    def rows(self, table: Table, columns: ColumnMap, piece: Range) -> Rows:
        """Return the usable rows of a piece."""
        part, (begin, end) = table.part(*piece), piece
        if self.whole is None:
            time = read_time(part, columns, self.least)
            rows = np.flatnonzero(~np.isnan(time))
        else:
            time = self.whole.time[begin:end]
            first, last = np.searchsorted(self.whole.rows, [begin, end])
            rows = self.whole.rows[first:last] - begin
        return Rows(part, columns, time - self.start if self.start else time, rows)


@dataclass(frozen=True, slots=True, eq=False)
class _Steps:
    """What the steps of a clock in order are like."""

    seams: Ints  # rows at which a piece may begin
    first: float  # s
    last: float  # s
    longest: float  # s
    usual: float  # s, the least of the pieces' medians
    untimed: Ints


def piece_clock(table: Table, columns: ColumnMap, size: int) -> PieceClock:
    """Return the clock of a table in pieces of so many rows; InputError if no row has a time."""
    least = _least(table, columns.time[0], size) if len(columns.time) > 1 else None
    steps = _steps(table, columns, least, size)
    if steps is None:
        return _as_a_whole(table, columns, size)
    lost = np.concatenate([no_rows(), *(each.rows for each in table.faulty)])
    faulty = untimed(table, columns, np.setdiff1d(steps.untimed, lost))
    start, notes = _zero(columns, steps.first)
    check_span(table.source, steps.first, steps.last, len(table) - len(steps.untimed))
    pieces = _pieces(steps.seams, len(table))
    return PieceClock(pieces, start, least, faulty, notes)


def ranges(count: int, size: int) -> Iterator[Range]:
    """Yield so many rows in pieces."""
    return ((begin, min(begin + size, count)) for begin in range(0, count, size))


def _zero(columns: ColumnMap, start: float) -> tuple[float, Notes]:
    """Return what is taken off a clock that counts from a date."""
    if columns.native or abs(start) < EPOCH:
        return 0.0, ()
    return start, (zero_note(start),)


def _least(table: Table, seconds: Columns, size: int) -> float | None:
    parts = (
        table.part(*each).numbers(seconds.names[0]).values for each in ranges(len(table), size)
    )
    found = [float(np.nanmin(part)) for part in parts if np.isfinite(part).any()]
    return min(found, default=None)


def _steps(table: Table, columns: ColumnMap, least: float | None, size: int) -> _Steps | None:
    """Return what a clock is like; None where it is not in order, or may be two."""
    seams, untimed_rows, medians = [0], list[Ints](), list[float]()
    first = last = np.nan
    longest, count = 0.0, 0
    for begin, end in ranges(len(table), size):
        time = read_time(table.part(begin, end), columns, least)
        untimed_rows.append(np.flatnonzero(np.isnan(time)) + begin)
        timed = time[~np.isnan(time)]
        if not len(timed):
            continue
        steps = np.diff(timed, prepend=timed[0] if np.isnan(last) else last)
        if not (steps >= 0).all():
            return None
        if begin and steps[0] > 0:
            seams.append(begin)
        first, last = float(timed[0]) if np.isnan(first) else first, float(timed[-1])
        longest, count = max(longest, float(steps.max())), count + len(steps)
        medians.append(float(np.median(steps)))
    if np.isnan(first) or (not columns.native and longest > STRAY / 2 * count * min(medians)):
        return None
    rows = np.concatenate([no_rows(), *untimed_rows])
    return _Steps(np.array(seams), first, last, longest, min(medians), rows)


def _as_a_whole(table: Table, columns: ColumnMap, size: int) -> PieceClock:
    clock = clock_of(table, columns)
    start, notes = _zero(columns, float(clock.time[clock.rows[0]]))
    time = clock.time[clock.rows]
    seams = [0]
    for begin, _ in ranges(len(table), size):
        place = int(np.searchsorted(clock.rows, begin))
        if 0 < place < len(time) and time[place] > time[place - 1]:
            seams.append(begin)
    pieces = _pieces(np.array(seams), len(table))
    return PieceClock(pieces, start, None, clock.faulty, (*clock.notes, *notes), clock)


def _pieces(seams: Ints, count: int) -> tuple[Range, ...]:
    return tuple(zip(seams.tolist(), [*seams[1:].tolist(), count], strict=True))
