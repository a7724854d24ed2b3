"""Another program's log as one table: channels at their own times, side by side.

Columns have the names of our own files, all in SI:

    time_s  q_w q_x q_y q_z  omega_x_rad_s ...  mass_<name>_m  h_x_N_m_s ...  torque_x_N_m ...
    wheel_<name>_rad_s  gimbal_<name>_rad  dipole_<name>_A_m2  jet_<name>_N_m  field_x_T ...
    temperature_degC  lamp_power  accel_x_m_s2 ...  sun_x ...  torque_<cause>_x_N_m ...

so that a column map can name them, and what tables need set right is set right once, for all.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.io.columns.cause_columns import cause_column
from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.device_columns import si_column
from equipoise.io.columns.native_columns import (
    ACCELEROMETER,
    ATTITUDE,
    LAMP,
    MOMENTUM,
    RATE,
    SUN,
    TEMPERATURE,
    TIME,
    TORQUE,
)
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Table, finite
from equipoise.io.files.reading_budget import Meter
from equipoise.io.formats.clock_units import seconds
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.errors import InputError
from equipoise.model.recording import INPUTS, NAMED

FIELD = ("field_x_T", "field_y_T", "field_z_T")
POSITION = ("position_x_m", "position_y_m")
LARGEST = 1e150  # chosen: its square is still a double; no sensor's number
GROUPS = {"rate": RATE, "momentum": MOMENTUM, "torque": TORQUE, "field": FIELD,
          "temperature": TEMPERATURE, "lamp": LAMP, "accelerometer": ACCELEROMETER,
          "sun": SUN, "position": POSITION}  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class LogChannel:
    """Rows of one channel of a recording, as they stand in the log."""

    name: str  # of ``model.recording.CHANNELS``
    ns: Ints  # times of the log's clock
    values: Floats  # (n, k), SI
    names: tuple[str, ...] = ()  # of masses, devices or causes

    @property
    def columns(self) -> tuple[str, ...]:
        """Return the names of its columns."""
        if self.name == "attitude":
            return ATTITUDE
        if self.name == "masses":
            return tuple(f"mass_{name}_m" for name in self.names)
        if self.name == "devices":
            return tuple(map(si_column, self.names))
        if self.name == "torque_by_cause":
            return tuple(map(cause_column, self.names))
        return GROUPS[self.name]


def log_table(
    meter: Meter, channels: Sequence[LogChannel], zero_ns: int | None, notes: tuple[str, ...] = ()
) -> Table:
    """Return a log's channels as a table; ``zero_ns`` is time zero, None: the first row is.

    InputError if there is no row, or if the table is too large.
    """
    source = meter.source
    tidy = [_tidy(channel) for channel in channels if len(channel.ns)]
    if not tidy:
        raise InputError(source, "no row of attitude or rate", "a log of a motion")
    times = np.unique(np.concatenate([each.channel.ns for each in tidy]))
    meter.take(times.itemsize * len(times) * sum(each.channel.values.shape[1] for each in tidy))
    zero = int(times[0]) if zero_ns is None else zero_ns
    columns: dict[str, Series1] = {TIME: seconds(times - zero)}
    for each in tidy:
        wide = np.full((len(times), each.channel.values.shape[1]), np.nan)
        wide[np.searchsorted(times, each.channel.ns)] = each.channel.values
        columns.update(dict(zip(each.channel.columns, wide.T, strict=True)))
    again = [f for each in tidy for f in _repeated(each, times, source)]
    late = tuple(note for each in tidy for note in each.notes)
    return Table(
        source,
        tuple(columns),
        len(times),
        lambda _, name: finite(columns[name], np.isnan(columns[name])),
        notes=(*notes, *late),
        faulty=tuple(again),
        cell=lambda name, row: str(columns[name][row]),
        blank="nothing",
    )


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
    for each in NAMED:
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


@dataclass(frozen=True, slots=True, eq=False)
class _Tidy:
    """A channel in order of time, each time once; what is no number is infinite."""

    channel: LogChannel
    repeated: Ints  # ns, times of rows that came again
    notes: tuple[str, ...]


def _tidy(channel: LogChannel) -> _Tidy:
    sound = np.abs(channel.values) < LARGEST  # not a number is not either
    values = np.where(sound, channel.values, np.inf)
    times, first = np.unique(channel.ns, return_index=True)
    late = int((np.diff(channel.ns) < 0).sum())
    notes = (f"{channel.name}: {late} rows came late; put in order of time.",) if late else ()
    again = np.delete(channel.ns, first)
    return _Tidy(LogChannel(channel.name, times, values[first], channel.names), again, notes)


def _repeated(tidy: _Tidy, times: Ints, source: str) -> list[FaultyRows]:
    """Return the rows whose time another had, as rows of the table at those times."""
    # Inputs are reported as they change, which may be twice at a time; sensors are sampled.
    if not len(tidy.repeated) or tidy.channel.name in INPUTS:
        return []
    rows, name = np.searchsorted(times, tidy.repeated), tidy.channel.name
    where = f"{source}, row {rows[0] + 1}"
    found, wanted = f"{name}: the same time again", f"a time of its own for each row of {name}"
    return [FaultyRows(RowFault.REPEATED, rows, where, found, wanted)]
