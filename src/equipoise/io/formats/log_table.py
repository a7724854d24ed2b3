"""Another program's log as one table: channels at their own times, side by side.

Columns have the names of our own files, all in SI:

    time_s  q_w q_x q_y q_z  omega_x_rad_s ...  mass_<name>_m  h_x_N_m_s ...  torque_x_N_m ...
    wheel_<name>_rad_s  gimbal_<name>_rad  dipole_<name>_A_m2  jet_<name>_N_m  field_x_T ...
    temperature_degC  lamp_power

so that a column map can name them, and what tables need set right is set right once, for all.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.device_columns import si_column
from equipoise.io.columns.native_columns import (
    ATTITUDE,
    LAMP,
    MOMENTUM,
    RATE,
    TEMPERATURE,
    TIME,
    TORQUE,
)
from equipoise.io.columns.table import Table
from equipoise.io.formats.clock_units import seconds
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.errors import InputError

FIELD = ("field_x_T", "field_y_T", "field_z_T")
LARGEST = 1e150  # chosen: its square is still a double; no sensor's number
GROUPS = {"rate": RATE, "momentum": MOMENTUM, "torque": TORQUE, "field": FIELD,
         "temperature": TEMPERATURE, "lamp": LAMP}  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class LogChannel:
    """Rows of one channel of a recording, as they stand in the log."""

    name: str  # of ``model.recording.CHANNELS``
    ns: Ints  # times of the log's clock
    values: Floats  # (n, k), SI
    names: tuple[str, ...] = ()  # of masses or devices

    @property
    def columns(self) -> tuple[str, ...]:
        """Return the names of its columns."""
        if self.name == "attitude":
            return ATTITUDE
        if self.name == "masses":
            return tuple(f"mass_{name}_m" for name in self.names)
        if self.name == "devices":
            return tuple(map(si_column, self.names))
        return GROUPS[self.name]


def log_table(
    source: str, channels: Sequence[LogChannel], zero_ns: int | None, notes: tuple[str, ...] = ()
) -> Table:
    """Return a log's channels as a table; ``zero_ns`` is time zero, None: the first row is.

    InputError if there is no row.
    """
    tidy = [_tidy(channel) for channel in channels]
    full = [(channel, reported) for channel, reported in tidy if len(channel.ns)]
    if not full:
        raise InputError(source, "no row of attitude or rate", "a log of a motion")
    times = np.unique(np.concatenate([channel.ns for channel, _ in full]))
    zero = int(times[0]) if zero_ns is None else zero_ns
    columns: dict[str, Series1] = {TIME: seconds(times - zero)}
    for channel, _ in full:
        wide = np.full((len(times), channel.values.shape[1]), np.nan)
        wide[np.searchsorted(times, channel.ns)] = channel.values
        columns.update(dict(zip(channel.columns, wide.T, strict=True)))
    notes = (*notes, *(note for _, reported in full for note in reported))
    return Table(source, tuple(columns), len(times), lambda _, name: columns[name], notes=notes)


def log_map(
    channels: Sequence[LogChannel],
    ours: bool = False,
    lab_up: str = "z",
    body: tuple[str, str, str] = ("x", "y", "z"),
) -> ColumnMap:
    """Return what the columns of such a table mean; ``ours``: we wrote it, nothing is doubted."""
    here = {channel.name: channel for channel in channels if len(channel.ns)}
    known = {each: Columns(channel.columns) for each, channel in here.items()}
    groups: dict[str, Any] = {each: known.get(each) for each in GROUPS}
    for each in ("masses", "devices"):
        named = zip(here[each].names, here[each].columns, strict=True) if each in here else ()
        groups[each] = tuple(NamedColumn(label, column, 1.0) for label, column in named)
    return ColumnMap(
        time=(Columns((TIME,)),),
        quaternion=known.get("attitude"),
        lab_up=lab_up,
        body=body,
        native=ours,
        **groups,
    )


def _tidy(channel: LogChannel) -> tuple[LogChannel, tuple[str, ...]]:
    """Return a channel in order of time, each time once, without rows that hold no number."""
    sound = (np.abs(channel.values) < LARGEST).all(axis=1)  # not a number is not either
    ns, values = channel.ns[sound], channel.values[sound]
    times, first = np.unique(ns, return_index=True)
    reported = (
        (len(channel.ns) - len(ns), "held a value that is no number; left out"),
        (int((np.diff(ns) < 0).sum()), "came late; put in order of time"),
        (len(ns) - len(times), "had the time of another; left out"),
    )
    notes = tuple(f"{channel.name}: {count} rows {what}." for count, what in reported if count)
    return LogChannel(channel.name, times, values[first], channel.names), notes
