"""A table and its column map, to channels in SI that still know which row they come from."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.axis_permutation import TO_Z_UP, axes_matrix
from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.sentinels import sentinel_rows
from equipoise.io.columns.table import BLANK, Numbers, Table
from equipoise.io.toml.plausible import SIZES
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Bools, Floats, Ints, Series1
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import CHANNELS, NAMED, Samples

# Channels of readings that scatter; a setting may stand at 999 for long.
SENSORS = frozenset({"attitude", "rate", "field", "accelerometer", "sun", "position"})
# In SI, of each channel: what no bench has.
LARGEST = {
    "attitude": SIZES["number"],
    "rate": SIZES["rate"],
    "masses": SIZES["length"],
    "momentum": SIZES["momentum"],
    "torque": SIZES["torque"],
    "devices": SIZES["dipole"],
    "field": SIZES["magnetic"],
    "temperature": SIZES["temperature"],
    "lamp": SIZES["number"],
    "accelerometer": SIZES["acceleration"],
    "sun": SIZES["number"],
    "position": SIZES["length"],
    "torque_by_cause": SIZES["torque"],
}


@dataclass(frozen=True, slots=True, eq=False)
class Channel:
    """A channel's rows, before anything is set right."""

    name: str
    t: Series1  # s
    values: Floats  # (n, k), SI
    rows: Ints  # of the table

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.t)

    def keep(self, which: NDArray[np.bool_]) -> "Channel":
        """Return the rows that are marked."""
        return Channel(self.name, self.t[which], self.values[which], self.rows[which])

    def samples(self) -> Samples:
        """Return the noun."""
        return Samples(self.t, self.values)


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """The rows of a table that can be used, and their clock."""

    table: Table
    columns: ColumnMap
    time: Series1  # s, of every row
    rows: Ints
    # Of columns: the number that stands for no reading, where the rows are a part of a table.
    sentinels: Mapping[str, float | None] | None = None

    def marked(self, column: str, values: Series1) -> Ints:
        """Return the rows of a column whose number stands for no reading."""
        if self.sentinels is None:
            return sentinel_rows(values)
        return np.flatnonzero(values == self.sentinels[column])

    def alive(self) -> Bools:
        """Say of each row of the table whether some channel has a reading."""
        groups = [columns_of(self.columns, name) for name in CHANNELS]
        full = [_full(_numbers(self.table, each)) for each in groups if each is not None]
        return np.logical_or.reduce(full)


def columns_of(columns: ColumnMap, name: str) -> Columns | None:
    """Return the columns of a channel by its name."""
    if name == "attitude":
        angles = None if columns.euler is None else columns.euler.columns
        return angles or columns.matrix or columns.rotation_vector or columns.quaternion
    found: Any = getattr(columns, name)
    return _together(found) if name in NAMED else found


def _together(columns: tuple[NamedColumn, ...]) -> Columns | None:
    """Return the columns of all masses, devices or causes as one group."""
    if not columns:
        return None
    return Columns(tuple(c.column for c in columns), tuple(c.factor for c in columns))


def read_time(table: Table, columns: ColumnMap, least: float | None = None) -> Series1:
    """Return the clock of every row, s, NaN where there is none.

    A clock that counts from 1970 would lose its nanoseconds in a double: whole seconds are taken
    off before the parts are added, the ``least`` of a table that these rows are a part of.
    """
    parts = [_numbers(table, c)[0].values for c in columns.time]
    if len(parts) > 1 and np.isfinite(parts[0]).any():
        parts[0] = parts[0] - (np.nanmin(parts[0]) if least is None else least)
    return np.sum(
        [part * np.array(c.factor) for part, c in zip(parts, columns.time, strict=True)], axis=0
    )


def read_channel(source: Rows, name: str, columns: Columns) -> tuple[Channel, list[FaultyRows]]:
    """Return a channel without the rows where it is blank, and its faulty rows.

    A row of NaN throughout had no reading if another channel has one there; if none has, nothing
    was recorded, which is a fault.
    """
    rows = source.rows
    numbers = _numbers(source.table, columns)
    marked = _sentinels(source, name, columns, numbers)
    blank = [np.isnan(each.values) for each in numbers]
    garbage = _marked(source.table, [each.garbage for each in numbers])[rows]
    nan = _marked(source.table, [each.nan for each in numbers])[rows]
    full = ~np.logical_or.reduce(blank)[rows]
    none = np.logical_and.reduce(blank)[rows] & ~garbage  # no reading here
    if (none & nan).any():
        none &= ~nan | source.alive()[rows]
    sentinel = marked[rows] & ~none
    bad = (garbage | nan) & ~none & ~sentinel
    partly = ~full & ~none & ~bad & ~sentinel
    full &= ~sentinel
    found = [
        _faulty(source, name, columns, kind, mask)
        for kind, mask in ((RowFault.NOT_A_NUMBER, bad), (RowFault.PARTLY_BLANK, partly))
        if mask.any()
    ]
    found += _marked_rows(source, columns, numbers, sentinel)
    kept = rows if full.all() else rows[full]
    whole = Channel(name, source.time[kept], _si(numbers, columns, kept), kept)
    return _without_overflow(whole, source.table, columns, found)


def _si(numbers: list[Numbers], columns: Columns, rows: Ints) -> Floats:
    """Return some rows of columns in SI, column by column: whole copies of a long table count."""
    si = np.empty((len(rows), len(numbers)))
    offset, factor = (np.resize(each, len(numbers)) for each in (columns.offset, columns.factor))
    for k, each in enumerate(numbers):
        values = each.values if len(rows) == len(each.values) else each.values[rows]
        np.subtract(values, offset[k], out=si[:, k])
    si *= factor
    return si


def _without_overflow(
    channel: Channel, table: Table, columns: Columns, found: list[FaultyRows]
) -> tuple[Channel, list[FaultyRows]]:
    """Return a channel without the rows that no bench has, and all its faults."""
    most = LARGEST[channel.name]
    over = (channel.values > most) | (channel.values < -most)
    mask: Bools = np.logical_or.reduce(over, axis=1)
    if not mask.any():
        return channel, found
    row = int(np.argmax(mask))
    column, place = columns.names[int(np.argmax(over[row]))], int(channel.rows[row])
    where = f"{table.source}, {table.place(place)}, column '{column}'"
    value = table.numbers(column).values[place]
    said = f"{value:.9g}, beyond {most:g} in SI, more than any bench reaches"
    wanted = "a reading, with the unit, factor and offset that it has"
    fault = FaultyRows(RowFault.BEYOND, channel.rows[mask], where, said, wanted)
    return channel.keep(~mask), [*found, fault]


def in_body_axes(channel: Channel, columns: Columns, body: tuple[str, str, str]) -> Channel:
    """Return a vector channel in our body axes."""
    axes = columns.axes or body
    if axes == ("x", "y", "z"):
        return channel  # verbatim: a product with one would be the same, but for -0.0
    return Channel(channel.name, channel.t, channel.values @ axes_matrix(axes).T, channel.rows)


def in_the_plane(channel: Channel, lab_up: str) -> Channel:
    """Return a position's x and y in our laboratory axes, whose z points up.

    Three columns are the table's own axes, of which ``lab_up`` points up; two are ours already.
    """
    if channel.values.shape[1] == 2:
        return channel
    values = channel.values @ to_matrix(np.array(TO_Z_UP[lab_up])).T
    return Channel(channel.name, channel.t, values[:, :2], channel.rows)


def may_have_sentinels(name: str, columns: ColumnMap) -> bool:
    """Say whether numbers of a channel may stand for no reading: in files that are not ours."""
    return name in SENSORS and not columns.native


def _sentinels(source: Rows, name: str, columns: Columns, numbers: list[Numbers]) -> Bools:
    """Return the rows with a number that stands for no reading."""
    if not may_have_sentinels(name, source.columns):
        return np.zeros(len(source.table), dtype=bool)
    named = zip(columns.names, numbers, strict=True)
    return _marked(source.table, [source.marked(column, each.values) for column, each in named])


def _marked_rows(
    source: Rows, columns: Columns, numbers: list[Numbers], mask: Bools
) -> list[FaultyRows]:
    """Return the rows of numbers that stand for no reading, as one fault."""
    if not mask.any():
        return []
    table, faulty = source.table, source.rows[mask]
    row = int(faulty[0])
    named = zip(columns.names, numbers, strict=True)
    column = next(column for column, each in named if row in source.marked(column, each.values))
    where = f"{table.source}, {table.place(row)}, column '{column}'"
    found = f"{table.numbers(column).values[row]:.9g}, a marker of missing data"
    wanted = f"a reading, or {table.blank} for none"
    return [FaultyRows(RowFault.SENTINEL, faulty, where, found, wanted)]


def _marked(table: Table, rows: list[Ints]) -> Bools:
    mask = np.zeros(len(table), dtype=bool)
    mask[np.concatenate(rows)] = True
    return mask


def _faulty(source: Rows, name: str, columns: Columns, kind: RowFault, mask: Bools) -> FaultyRows:
    """Return the rows of a fault, and the first of their cells that holds no number."""
    table, faulty = source.table, source.rows[mask]
    row = int(faulty[0])
    empty = [each for each in columns.names if np.isnan(table.numbers(each).values[row])]
    spoken = [each for each in empty if table.found(each, row) != BLANK]
    column = (spoken or empty)[0]
    wanted = (
        f"a finite number, or {table.blank} for no reading"
        if kind == RowFault.NOT_A_NUMBER
        else f"a number, as in the other columns of {name}"
    )
    where = f"{table.source}, {table.place(row)}, column '{column}'"
    return FaultyRows(kind, faulty, where, table.found(column, row), wanted)


def _full(numbers: list[Numbers]) -> Bools:
    """Say of each row whether all of some columns hold a number."""
    return np.logical_and.reduce([np.isfinite(each.values) for each in numbers])


def _numbers(table: Table, columns: Columns) -> list[Numbers]:
    """Return the columns, in the unit of the table."""
    for name in columns.names:
        if name not in table.names:
            known = [known for known in table.names if known]
            raise InputError(f"{table.source}, header", f"no column '{name}'", nearest(name, known))
    return [table.numbers(name) for name in columns.names]
