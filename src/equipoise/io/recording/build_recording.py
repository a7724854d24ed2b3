"""A table of whatever origin and its column map, to a Recording with notes."""

from collections.abc import Container
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any

import numpy as np

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.read_options import BAD_ROWS
from equipoise.io.columns.row_faults import FaultyRows, without_faulty
from equipoise.io.columns.table import Table, no_rows
from equipoise.io.columns.unread_inputs import unread_inputs
from equipoise.io.recording.attitude_columns import (
    lengths,
    of_unit_length,
    quaternions,
)
from equipoise.io.recording.channels import (
    Channel,
    Rows,
    columns_of,
    in_body_axes,
    in_the_plane,
    read_channel,
)
from equipoise.io.recording.clock import Clock, clock_of
from equipoise.io.recording.rotation_columns import as_quaternions, blank_note, of_rotations
from equipoise.io.recording.time_stamps import gap_notes, without_duplicates
from equipoise.model.arrays import Bools, Ints
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, NAMED, Recording, Samples

Notes = tuple[str, ...]
SCALARS = ("masses", "devices", "temperature", "lamp", "torque_by_cause")  # not of these axes
FEWEST = 3  # rows of a sensor: two say nothing of how an angle's rate changes
EPOCH = 1e6  # s: a clock beyond twelve days counts from a date, not from the run (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """A channel, if there is one, what is wrong with its rows, and what was set right."""

    channel: Channel | None = None
    faulty: tuple[FaultyRows, ...] = ()
    notes: Notes = ()


def channel_of(source: Rows, name: str) -> Found:
    """Return a channel without faulty rows, duplicates and dead columns."""
    columns = columns_of(source.columns, name)
    if columns is None:
        return Found()
    channel, faulty = read_channel(source, name, columns)
    if not len(channel):
        return Found(None, tuple(faulty))
    zero: Bools = np.logical_not(np.logical_or.reduce(channel.values != 0, axis=0))
    is_dead, dead = dead_note(name, zero, columns, source.columns.native)
    if is_dead:
        return Found(None, tuple(faulty), dead)
    sound = sound_rows(channel, source, columns)
    notes = (*dead, *blank_note(sound.blank, source.table))
    kept = sound.channel if len(sound.channel) else None
    return Found(kept, (*faulty, *sound.faulty), notes)


@dataclass(frozen=True, slots=True, eq=False)
class Sound:
    """A channel's rows that can be used, and the others."""

    channel: Channel
    faulty: tuple[FaultyRows, ...]
    blank: Ints  # rows of the table that hold no reading


def sound_rows(channel: Channel, source: Rows, columns: Columns) -> Sound:
    """Return a channel that something was connected to, in body axes, without what is no reading.

    That is what has not unit length, is no rotation, or has a stamp twice.
    """
    faulty, blank = list[FaultyRows](), no_rows()
    if columns is source.columns.quaternion:
        channel, faulty = of_unit_length(channel, source.table, source.columns)
    if columns is source.columns.matrix:
        channel, faulty, blank = of_rotations(channel, source.table)
    if not len(channel):
        return Sound(channel, tuple(faulty), blank)
    channel, twice = without_duplicates(channel, source.table)
    if channel.name == "position":
        channel = in_the_plane(channel, source.columns.lab_up)
    elif channel.name not in ("attitude", *SCALARS):
        channel = in_body_axes(channel, columns, source.columns.body)
    return Sound(channel, (*faulty, *twice), blank)


def recording_of(table: Table, columns: ColumnMap, bad_rows: float = BAD_ROWS) -> Recording:
    """Return what a table holds; InputError if it is too little or makes no sense.

    At most the share ``bad_rows`` of its rows are left out as faulty.
    """
    recording = rows_of(table, columns, bad_rows)
    check_enough(table.source, recording)
    return recording


@np.errstate(invalid="ignore", over="ignore")  # an error names such a number and its row
def rows_of(table: Table, columns: ColumnMap, bad_rows: float) -> Recording:
    """Return what a table holds, however little it is; InputError if it makes no sense."""
    clock = clock_of(table, columns)
    source, from_zero = _rows(table, columns, clock)
    attitude, norm = _attitude(source)
    others = {name: channel_of(source, name) for name in CHANNELS if name != "attitude"}
    found = {"attitude": attitude, **others}
    faulty = (*table.faulty, *clock.faulty, *(f for each in found.values() for f in each.faulty))
    left_out = without_faulty(table.source, len(table), faulty, bad_rows, table.place)
    samples: dict[str, Any] = {name: _samples(each.channel) for name, each in found.items()}
    notes = chain.from_iterable(each.notes for each in found.values())
    sensors = (attitude.channel, others["rate"].channel)
    return Recording(
        **samples,
        attitude_norm=_samples(norm),
        **names_of(columns, [name for name, each in samples.items() if each]),
        source=table.source,
        free_from=columns.free_from,
        notes=(*table.notes, *columns.notes, *left_out, *clock.notes, *from_zero, *notes),
        gaps=tuple(note for c in sensors if c is not None for note in gap_notes(c)),
        unread=unread_inputs(table, columns),
    )


def names_of(columns: ColumnMap, channels: Container[str]) -> dict[str, Any]:
    """Return the names of the columns of channels that there are, as a recording has them."""
    return {
        field: tuple(each.name for each in getattr(columns, channel))
        for channel, field in NAMED.items()
        if channel in channels
    }


def _rows(table: Table, columns: ColumnMap, clock: Clock) -> tuple[Rows, Notes]:
    """Return the usable rows, their clock started at zero if it counts from a date."""
    start = float(clock.time[clock.rows[0]])
    if columns.native or abs(start) < EPOCH:
        return Rows(table, columns, clock.time, clock.rows), ()
    return Rows(table, columns, clock.time - start, clock.rows), (zero_note(start),)


def zero_note(start: float) -> str:
    """Say where a clock starts that counts from a date."""
    return f"The clock starts at {start:.3f} s; this is taken as zero."


def _attitude(source: Rows) -> tuple[Found, Channel | None]:
    """Return the attitude, as whatever rotation it came, and the lengths found."""
    columns = source.columns
    found = channel_of(source, "attitude")
    raw = found.channel
    if raw is None:
        return found, None
    is_quaternion = columns_of(columns, "attitude") is columns.quaternion
    mend = quaternions if is_quaternion else as_quaternions
    mended, reported = mend(raw, source.table, columns)
    whole = replace(found, channel=mended, notes=(*found.notes, *reported))
    return whole, lengths(raw) if is_quaternion else None


def check_enough(source: str, recording: Recording) -> None:
    """Raise InputError for a recording of so few rows that nothing follows from them."""
    sensors = (recording.attitude, recording.rate)
    check_count(source, max((len(each) for each in sensors if each is not None), default=0))


def check_count(source: str, most: int) -> None:
    """Raise InputError if the longest of attitude and rate has too few rows."""
    if most < FEWEST:
        count = f"{most} row{'s' * (most > 1)}"
        found = f"{count} of attitude or rate" if most else "neither attitude nor rate"
        raise InputError(source, found, f"at least {FEWEST} rows of attitude or of rate")


def _samples(channel: Channel | None) -> Samples | None:
    return None if channel is None else channel.samples()


def dead_note(name: str, zero: Bools, columns: Columns, native: bool) -> tuple[bool, Notes]:
    """Say whether nothing was connected to a channel, by which of its columns are all zero.

    A foreign gyro with one dead axis is left out as a whole: two true axes and a false zero
    mislead every estimator. In a native file a zero axis can be an exact simulation's.
    """
    if name in SCALARS:
        return False, ()  # what never changes is a fact, not a dead column
    names = " ".join(n for n, each in zip(columns.names, zero.tolist(), strict=True) if each)
    misleads = name == "rate" and not native and bool(zero.any())
    if zero.all() or misleads:
        return True, (f"{name}: zero in every row ({names}); the channel was ignored.",)
    if zero.any() and name == "rate":
        return False, (f"{name}: zero in every row ({names}).",)
    return False, ()
