"""Checks that time grows. Rows that break this are refused, or left out with a note."""

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.table import Table
from equipoise.io.recording.channels import Channel
from equipoise.model.arrays import Ints, Series1
from equipoise.model.errors import InputError

Notes = tuple[str, ...]
LOST = 0.5  # share of rows that may go backward before the table is refused (chosen)
GAP = 3.0  # median intervals (chosen; one missed row is 2, two are 3)
STRAY = 1000.0  # times all the rest, chosen: no bench falls silent for so long and goes on
FEW = 0.1  # share of the rows that may be stray (chosen)
NAMED = 3  # gaps that are named one by one


def forward_rows(table: Table, columns: ColumnMap, time: Series1) -> tuple[Ints, Notes]:
    """Return the rows whose time does not go back; a native table must have no other."""
    timed = np.flatnonzero(~np.isnan(time))
    if not len(timed):
        raise InputError(table.source, "no row with a time", "a time in every row")
    t = time[timed]
    back = np.append(False, t[1:] < np.maximum.accumulate(t)[:-1])
    rows, first = timed[~back], timed[int(np.argmax(back))]
    untimed = len(time) - len(timed)
    notes = (f"{_rows(untimed)} without a time were left out.",) if untimed else ()
    if not back.any():
        return rows, notes
    place = table.place(int(first))
    if columns.native or back.mean() > LOST:
        before = t[int(np.argmax(back)) - 1]
        found = f"time going backwards, from {before:.9g} s to {time[first]:.9g} s"
        raise InputError(f"{table.source}, {place}", found, "times that grow from row to row")
    text = f"{_rows(int(back.sum()))} went back in time, first at {place}; left out."
    return rows, (*notes, text)


def without_strays(table: Table, time: Series1, rows: Ints) -> tuple[Ints, Notes]:
    """Return the rows without few at either end that a gap beyond any measure cuts off.

    A stamp of another clock, or a broken one. Where there are many, what is wrong is not known.
    """
    notes: list[str] = []
    while True:
        steps = np.diff(time[rows])
        if not len(steps):
            return rows, tuple(notes)
        last = int(np.argmax(steps))
        before, after = last + 1, len(rows) - last - 1
        if min(before, after) >= FEW * len(rows):
            return rows, tuple(notes)
        if steps[last] <= STRAY * len(steps) * float(np.median(steps)):
            return rows, tuple(notes)
        ahead, behind = rows[:before], rows[before:]
        stray, rows = (behind, ahead) if after < before else (ahead, behind)
        text = f"{_rows(len(stray))} beyond a gap of {steps[last]:.3g} s, more than {STRAY:g} times"
        notes.append(f"{text} all the rest, first at {table.place(int(stray[0]))}; left out.")


def without_duplicates(channel: Channel, table: Table) -> tuple[Channel, Notes]:
    """Return a channel with the first row of each time stamp alone."""
    again = np.append(False, np.diff(channel.t) == 0)
    if not again.any():
        return channel, ()
    place = table.place(int(channel.rows[int(np.argmax(again))]))
    count = _rows(int(again.sum()))
    note = f"{channel.name}: {count} with a duplicate time stamp, first at {place}; left out."
    return channel.keep(~again), (note,)


def gap_notes(channel: Channel) -> Notes:
    """Say where a sensor fell silent for more than three median intervals."""
    steps = np.diff(channel.t)
    if not len(steps):
        return ()
    where = np.flatnonzero(steps > GAP * np.median(steps))
    if not len(where):
        return ()
    longest = where[np.argsort(-steps[where], kind="stable")][:NAMED]
    reported = ", ".join(f"{steps[i]:.3g} s from {channel.t[i]:.6g} s" for i in sorted(longest))
    named = f"the longest: {reported}" if len(where) > NAMED else reported
    return (f"{channel.name}: {len(where)} gap{'s' * (len(where) > 1)}: {named}.",)


def _rows(count: int) -> str:
    return f"{count} row{'s' * (count != 1)}"
