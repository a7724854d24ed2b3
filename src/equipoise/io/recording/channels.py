"""A table and its column map, to channels in SI that still know which row they come from."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.axis_permutation import axes_matrix
from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.table import Table
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import Samples


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


def read_time(table: Table, columns: ColumnMap) -> Series1:
    """Return the clock of every row, s, NaN where it is blank.

    A clock that counts from 1970 would lose its nanoseconds in a double: whole seconds are taken
    off before the parts are added.
    """
    parts = [_numbers(table, c)[:, 0] for c in columns.time]
    if len(parts) > 1 and len(table):
        parts[0] = parts[0] - np.nanmin(parts[0])
    time = np.sum(
        [part * np.array(c.factor) for part, c in zip(parts, columns.time, strict=True)], axis=0
    )
    blank = np.flatnonzero(np.isnan(time))
    if columns.native and len(blank):
        where = f"{table.source}, {table.place(int(blank[0]))}, column 'time_s'"
        raise InputError(where, "a blank cell", "a time in s")
    return time


def read_channel(
    name: str, table: Table, columns: Columns | None, time: Series1, rows: Ints
) -> Channel | None:
    """Return a channel at the given rows, without those where it is blank; None if it is absent."""
    if columns is None:
        return None
    values = _numbers(table, columns)[rows]
    blank = np.isnan(values)
    full = ~blank.any(axis=1)
    partly = np.flatnonzero(~full & ~blank.all(axis=1))
    if len(partly):
        column = columns.names[int(np.argmax(blank[partly[0]]))]
        where = f"{table.source}, {table.place(int(rows[partly[0]]))}, column '{column}'"
        raise InputError(where, "a blank cell", f"a number, as in the other columns of {name}")
    channel = Channel(name, time[rows][full], values[full] * np.array(columns.factor), rows[full])
    return channel if len(channel) else None


def in_body_axes(
    channel: Channel | None, columns: Columns | None, body: tuple[str, str, str]
) -> Channel | None:
    """Return a vector channel in our body axes."""
    if channel is None or columns is None:
        return channel
    axes = columns.axes or body
    if axes == ("x", "y", "z"):
        return channel  # verbatim: a product with one would be the same, but for -0.0
    return Channel(channel.name, channel.t, channel.values @ axes_matrix(axes).T, channel.rows)


def _numbers(table: Table, columns: Columns) -> Floats:
    """Return the columns side by side, in the unit of the table."""
    for name in columns.names:
        if name not in table.names:
            known = [known for known in table.names if known]
            raise InputError(f"{table.source}, header", f"no column '{name}'", nearest(name, known))
    return np.stack([table.numbers(name) for name in columns.names], axis=1)
