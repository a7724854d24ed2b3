"""A table of whatever origin and its column map, to a Recording with notes."""

from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np

from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.table import Table
from equipoise.io.recording.attitude_columns import euler_angles, lengths, quaternions
from equipoise.io.recording.channels import Channel, in_body_axes, read_channel, read_time
from equipoise.io.recording.time_stamps import (
    forward_rows,
    gap_notes,
    without_duplicates,
    without_strays,
)
from equipoise.model.arrays import Ints, Series1
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

Notes = tuple[str, ...]
SCALARS = ("masses", "devices", "temperature", "lamp")
FEWEST = 3  # rows of a sensor: two say nothing of how an angle's rate changes
EPOCH = 1e6  # s: a clock beyond twelve days counts from a date, not from the run (chosen)


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """The rows of a table that can be used, and their clock."""

    table: Table
    columns: ColumnMap
    time: Series1
    rows: Ints

    def channel(self, name: str, columns: Columns | None) -> tuple[Channel | None, Notes]:
        """Return a channel without duplicates and dead columns."""
        channel = read_channel(name, self.table, columns, self.time, self.rows)
        if channel is None or columns is None:
            return None, ()
        channel, twice = without_duplicates(channel, self.table)
        if name in SCALARS:
            return channel, twice  # what never changes is a fact, not a dead column
        kept, dead = _without_dead(channel, columns, self.columns.native)
        return kept, (*twice, *dead)

    def named(self, name: str) -> tuple[Channel | None, Notes]:
        """Return a channel by its name, one of vectors in our body axes."""
        found: Any = getattr(self.columns, name)
        columns: Columns | None = _together(found) if name in ("masses", "devices") else found
        channel, notes = self.channel(name, columns)
        if name in SCALARS:
            return channel, notes
        return in_body_axes(channel, columns, self.columns.body), notes


@np.errstate(invalid="ignore", over="ignore")  # an error names such a number and its row
def recording_of(table: Table, columns: ColumnMap) -> Recording:
    """Return what a table holds; InputError if it is too little or makes no sense."""
    source, order = _rows(table, columns)
    attitude, norm, of_attitude = _attitude(source)
    rate, of_rate = source.named("rate")
    _check_enough(table, attitude, rate)
    others = {name: source.named(name) for name in CHANNELS if name not in ("attitude", "rate")}
    found = {"attitude": attitude, "rate": rate, "attitude_norm": norm}
    found |= {name: channel for name, (channel, _) in others.items()}
    samples: dict[str, Any] = {name: _samples(channel) for name, channel in found.items()}
    notes = (of_attitude, of_rate, *(of_channel for _, of_channel in others.values()))
    return Recording(
        **samples,
        mass_names=tuple(mass.name for mass in columns.masses) if found["masses"] else (),
        device_names=tuple(each.name for each in columns.devices) if found["devices"] else (),
        source=table.source,
        free_from=columns.free_from,
        notes=(*table.notes, *columns.notes, *order, *chain.from_iterable(notes)),
        gaps=tuple(note for c in (attitude, rate) if c is not None for note in gap_notes(c)),
    )


def _rows(table: Table, columns: ColumnMap) -> tuple[Rows, Notes]:
    """Return the usable rows, their clock started at zero if it counts from a date."""
    time = read_time(table, columns)
    rows, notes = forward_rows(table, columns, time)
    if columns.native:
        return Rows(table, columns, time, rows), notes
    rows, strays = without_strays(table, time, rows)
    notes = (*notes, *strays)
    start = float(time[rows[0]])
    if abs(start) < EPOCH:
        return Rows(table, columns, time, rows), notes
    reported = f"The clock starts at {start:.3f} s; this is taken as zero."
    return Rows(table, columns, time - start, rows), (*notes, reported)


def _attitude(source: Rows) -> tuple[Channel | None, Channel | None, Notes]:
    """Return the attitude, whether it came as quaternions or as angles, and the lengths found."""
    columns = source.columns
    angles = None if columns.euler is None else columns.euler.columns
    raw, notes = source.channel("attitude", angles or columns.quaternion)
    if raw is None:
        return None, None, notes
    mended, reported = (
        euler_angles(raw, columns) if angles else quaternions(raw, source.table, columns)
    )
    return mended, None if angles else lengths(raw), (*notes, *reported)


def _together(columns: tuple[NamedColumn, ...]) -> Columns | None:
    """Return the columns of all masses, or of all devices, as one group."""
    if not columns:
        return None
    return Columns(tuple(c.column for c in columns), tuple(c.factor for c in columns))


def _check_enough(table: Table, *sensors: Channel | None) -> None:
    most = max((len(sensor) for sensor in sensors if sensor is not None), default=0)
    if most < FEWEST:
        count = f"{most} row{'s' * (most > 1)}"
        found = f"{count} of attitude or rate" if most else "neither attitude nor rate"
        raise InputError(table.source, found, f"at least {FEWEST} rows of attitude or of rate")


def _samples(channel: Channel | None) -> Samples | None:
    return None if channel is None else channel.samples()


def _without_dead(channel: Channel, columns: Columns, native: bool) -> tuple[Channel | None, Notes]:
    """Return a channel that something was connected to: None if it is all zero, with notes.

    A foreign gyro with one dead axis is left out as a whole: two true axes and a false zero
    mislead every estimator. In a native file a zero axis can be an exact simulation's.
    """
    dead = np.abs(channel.values).max(axis=0) == 0
    names = " ".join(n for n, zero in zip(columns.names, dead.tolist(), strict=True) if zero)
    misleads = channel.name == "rate" and not native and bool(dead.any())
    if dead.all() or misleads:
        return None, (f"{channel.name}: zero in every row ({names}); the channel was ignored.",)
    if dead.any() and channel.name == "rate":
        return channel, (f"{channel.name}: zero in every row ({names}).",)
    return channel, ()
