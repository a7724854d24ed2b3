"""The clock of a table set right: counters that wrap, stamps that are wrong.

A counter of few bits, or a clock of the day, restarts: where a step back is one of few known
lengths short of a usual step forward, what follows goes on by that length. Of the rest the longest
run of times that do not go back is kept, so that a wrong stamp condemns itself and not those after
it. Few rows at either end that a gap beyond any measure cuts off are another clock's.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Table, no_rows
from equipoise.io.recording.channels import read_time
from equipoise.io.toml.plausible import SIZES
from equipoise.model.arrays import Ints, Series1
from equipoise.model.errors import InputError
from equipoise.model.growing_times import longest_rising, wraps

Notes = tuple[str, ...]
STRAY = 1000.0  # times all the rest, chosen: no bench falls silent for so long and goes on
FEW = 0.1  # share of the rows that may be stray (chosen)
FEWEST = 10  # rows together that a wrong clock may have stamped, of however few (chosen)
WANTED = "increasing times"


@dataclass(frozen=True, slots=True, eq=False)
class Clock:
    """The time of every row of a table, and which rows have one that can be used."""

    time: Series1  # s, of every row; NaN where there is none
    rows: Ints  # that can be used
    faulty: tuple[FaultyRows, ...] = ()
    notes: Notes = ()


def clock_of(table: Table, columns: ColumnMap) -> Clock:
    """Return the clock of a table; InputError if no row has a time."""
    time = read_time(table, columns)
    lost = np.concatenate([no_rows(), *(each.rows for each in table.faulty)])
    timed = np.flatnonzero(~np.isnan(time))
    without = untimed(table, columns, np.setdiff1d(np.flatnonzero(np.isnan(time)), lost))
    if not len(timed):
        where = without[0].where if without else table.source
        raise InputError(where, "no row with a time", "a time in every row")
    time, notes = _unwrapped(table, columns, time, timed)
    rows, back = _forward(table, time, timed)
    rows, strays = (rows, ()) if columns.native else _without_strays(table, time, rows)
    check_span(table.source, float(time[rows[0]]), float(time[rows[-1]]), len(rows))
    return Clock(time, rows, (*without, *back, *strays), notes)


def check_span(source: str, first: float, last: float, count: int) -> None:
    """Raise InputError for times (s) that no record of a platform has, in so many rows."""
    span, longest = last - first, SIZES["time"]
    if span > longest:
        found = f"times from {first:.9g} s to {last:.9g} s"
        raise InputError(source, found, f"at most {longest:g} s: is the unit of the time right?")
    if 0 < span < (count - 1) / SIZES["frequency"]:
        found = f"{count} rows within {span:.3g} s"
        wanted = f"at most {SIZES['frequency']:g} a second: is the unit of the time right?"
        raise InputError(source, found, wanted)


def untimed(table: Table, columns: ColumnMap, rows: Ints) -> tuple[FaultyRows, ...]:
    """Return rows without a time, as one fault; none if there are none."""
    if not len(rows):
        return ()
    row, names = int(rows[0]), [name for part in columns.time for name in part.names]
    empty = next(name for name in names if np.isnan(table.numbers(name).values[row]))
    where = f"{table.source}, {table.place(row)}, column '{empty}'"
    fault = FaultyRows(RowFault.NO_TIME, rows, where, table.found(empty, row), "a time")
    return (fault,)


def _unwrapped(
    table: Table, columns: ColumnMap, time: Series1, timed: Ints
) -> tuple[Series1, Notes]:
    """Return a clock that goes on where its counter restarted."""
    wrapped = wraps(time[timed], float(np.min(columns.time[0].factor)))
    whole = time.copy() if wrapped else time
    notes: list[str] = []
    for place, length in wrapped:
        whole[timed[place:]] += length
        where = table.place(int(timed[place]))
        notes.append(f"The clock restarted after {length:.9g} s, at {where}; taken as continuing.")
    return whole, tuple(notes)


def _forward(table: Table, time: Series1, timed: Ints) -> tuple[Ints, tuple[FaultyRows, ...]]:
    """Return the longest run of rows whose time does not go back, and the others.

    InputError where many others stand together: they are of another record, and the run may begin
    in one and end in the other.
    """
    t = time[timed]
    if (np.diff(t) >= 0).all():
        return timed, ()
    kept = longest_rising(t)
    rows, back = timed[kept], np.delete(timed, kept)
    at = int(np.argmax(np.diff(t) < 0))
    where = f"{table.source}, {table.place(int(timed[at + 1]))}"
    found = f"time going backwards, from {t[at]:.9g} s to {t[at + 1]:.9g} s"
    if _longest_together(back) > max(FEW * len(t), FEWEST):
        raise InputError(where, found, f"{WANTED}: cut the file there, if two recordings are in it")
    return rows, (FaultyRows(RowFault.BACKWARD, back, where, found, WANTED),)


def _longest_together(rows: Ints) -> int:
    """Return how many rows there are at most that follow each other."""
    edges = np.flatnonzero(np.diff(rows) != 1)
    return int(np.diff(np.concatenate([[-1], edges, [len(rows) - 1]])).max())


def _without_strays(table: Table, time: Series1, rows: Ints) -> tuple[Ints, tuple[FaultyRows, ...]]:
    """Return the rows without few at either end that a gap beyond any measure cuts off.

    A stamp of another clock, or a broken one. Where there are many, what is wrong is not known.
    """
    faulty: list[FaultyRows] = []
    while True:
        steps = np.diff(time[rows])
        if not len(steps):
            return rows, tuple(faulty)
        last = int(np.argmax(steps))
        before, after = last + 1, len(rows) - last - 1
        few = min(before, after) < FEW * len(rows)
        if not few or steps[last] <= STRAY * len(steps) * float(np.median(steps)):
            return rows, tuple(faulty)
        ahead, behind = rows[:before], rows[before:]
        stray, rows = (behind, ahead) if after < before else (ahead, behind)
        where = f"{table.source}, {table.place(int(stray[0]))}"
        found = f"a gap of {steps[last]:.3g} s, more than {STRAY:g} times all the rest"
        faulty.append(FaultyRows(RowFault.STRAY, stray, where, found, "times of one clock"))
