"""The native columns of a recording: names with units, to channels and back.

    time_s  q_w q_x q_y q_z  omega_x_rad_s ...  mass_<name>_mm  h_x_N_m_s ...  torque_x_N_m ...
    wheel_<name>_rad_s  gimbal_<name>_deg  dipole_<name>_A_m2  cage_<name>_uT  jet_<name>_N_m
    field_x_uT ...
    temperature_degC  lamp_power  accel_x_m_s2 ...  sun_x ...  position_x_mm position_y_mm
    torque_<cause>_x_N_m ...  torque_<cause>_sd_x_N_m ...

One table for all channels; a cell is blank where its channel has no row at that time.
"""

import re
from itertools import chain
from typing import Any

import numpy as np

from equipoise.io.columns.cause_columns import cause_column, cause_of
from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.device_columns import column_of, device_of, wanted_column
from equipoise.model.arrays import Floats, Series1
from equipoise.model.errors import InputError, nearest
from equipoise.model.recording import Recording, Samples
from equipoise.model.units import MM, UT

TIME = "time_s"
ATTITUDE = ("q_w", "q_x", "q_y", "q_z")
RATE = ("omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s")
MOMENTUM = ("h_x_N_m_s", "h_y_N_m_s", "h_z_N_m_s")
TORQUE = ("torque_x_N_m", "torque_y_N_m", "torque_z_N_m")
FIELD = ("field_x_uT", "field_y_uT", "field_z_uT")
TEMPERATURE = ("temperature_degC",)
LAMP = ("lamp_power",)  # of its full power: 0 off, 1 on
ACCELEROMETER = ("accel_x_m_s2", "accel_y_m_s2", "accel_z_m_s2")
SUN = ("sun_x", "sun_y", "sun_z")  # of a unit vector
POSITION = ("position_x_mm", "position_y_mm")  # of P on a planar table
# Of a column map: the columns, and what one of their unit is in SI.
GROUPS = {
    "quaternion": (ATTITUDE, 1.0),
    "rate": (RATE, 1.0),
    "momentum": (MOMENTUM, 1.0),
    "torque": (TORQUE, 1.0),
    "field": (FIELD, UT),
    "temperature": (TEMPERATURE, 1.0),
    "lamp": (LAMP, 1.0),
    "accelerometer": (ACCELEROMETER, 1.0),
    "sun": (SUN, 1.0),
    "position": (POSITION, MM),
}
MASS = re.compile(r"mass_(.+)_mm")
# A name that means to be one of ours.
OURS = re.compile(
    r"(time|q|omega|mass|h|torque|wheel|gimbal|dipole|cage|jet|field|temperature|lamp|accel|sun"
    r"|position)_.*"
)
NAMED = 5  # columns that a note names; chosen: a screen


def is_native(names: tuple[str, ...]) -> bool:
    """Say whether a header is ours, perhaps with a fault in it."""
    meant = any(OURS.fullmatch(name) for name in names if name != TIME)
    return (TIME in names and meant) or bool({*ATTITUDE, *RATE} & set(names))


def native_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return what a native header's columns mean; InputError for a name that is nearly ours."""
    if TIME not in names:
        wanted = f"'{TIME}', in s, beside {', '.join(names[:6])}"
        raise InputError(f"{source}, header", f"no column '{TIME}'", wanted)
    masses = [match for match in map(MASS.fullmatch, names) if match]
    devices = [device for device in map(device_of, names) if device]
    causes = [cause for cause in map(cause_of, names) if cause]
    ours = chain.from_iterable(group for group, _ in GROUPS.values())
    known = [TIME, *ours, *(m[0] for m in masses), *(e.column for e in (*devices, *causes))]
    _check_names(names, known, source)
    groups: dict[str, Any] = {
        channel: _group(names, group, source, unit) for channel, (group, unit) in GROUPS.items()
    }
    return ColumnMap(
        time=(Columns((TIME,)),),
        masses=tuple(NamedColumn(match[1], match[0], MM) for match in masses),
        devices=tuple(devices),
        torque_by_cause=tuple(causes),
        native=True,
        notes=left_aside(names, known),
        **groups,
    )


def left_aside(names: tuple[str, ...], known: list[str]) -> tuple[str, ...]:
    """Say which columns mean nothing here, such as a motor's command that nothing accounts for."""
    unknown = [name for name in names if name and name not in known]
    if not unknown:
        return ()
    more = f" and {len(unknown) - NAMED} more" if len(unknown) > NAMED else ""
    reported = ", ".join(f"'{name}'" for name in unknown[:NAMED])
    return (f"Columns that are not known were ignored: {reported}{more}.",)


def native_columns(recording: Recording) -> dict[str, Series1]:
    """Return a recording as native columns over the union of its times, NaN for blank."""
    masses = tuple(f"mass_{name}_mm" for name in recording.mass_names)
    devices = [column_of(name) for name in recording.device_names]
    per_unit = 1 / np.array([device.factor for device in devices])
    channels = (
        (recording.attitude, ATTITUDE, 1.0),
        (recording.rate, RATE, 1.0),
        (recording.masses, masses, 1 / MM),
        (recording.momentum, MOMENTUM, 1.0),
        (recording.torque, TORQUE, 1.0),
        (recording.devices, tuple(d.column for d in devices), per_unit),
        (recording.field, FIELD, 1 / UT),
        (recording.temperature, TEMPERATURE, 1.0),
        (recording.lamp, LAMP, 1.0),
        (recording.accelerometer, ACCELEROMETER, 1.0),
        (recording.sun, SUN, 1.0),
        (recording.position, POSITION, 1 / MM),
        (recording.torque_by_cause, tuple(map(cause_column, recording.cause_names)), 1.0),
    )
    present = [(c, names, unit) for c, names, unit in channels if c is not None and len(c)]
    if not present:
        return {TIME: np.zeros(0)}
    time = np.unique(np.concatenate([channel.t for channel, _, _ in present]))
    columns: dict[str, Series1] = {TIME: time}
    for channel, names, unit in present:
        spread = _spread(channel, time, unit)
        columns.update({name: spread[:, i] for i, name in enumerate(names)})
    return columns


def _spread(channel: Samples, time: Series1, unit: float | Floats) -> Floats:
    """Return a channel's rows at their places among all times."""
    wide = np.full((len(time), channel.values.shape[1]), np.nan)
    wide[np.searchsorted(time, channel.t)] = channel.values * unit
    return wide


def _group(
    names: tuple[str, ...], group: tuple[str, ...], source: str, unit: float
) -> Columns | None:
    """Return the columns of a channel: all of them or none."""
    missing = [name for name in group if name not in names]
    if len(missing) == len(group):
        return None
    if missing:
        found = f"{' '.join(n for n in group if n in names)} without {' '.join(missing)}"
        raise InputError(f"{source}, header", found, f"all of {' '.join(group)}, or none")
    return Columns(group, unit)


def _check_names(names: tuple[str, ...], known: list[str], source: str) -> None:
    """Refuse a column that means to be ours and is not, such as one in another unit."""
    for name in names:
        if OURS.fullmatch(name) and name not in known:
            mass = "'mass_<name>_mm'" if name.startswith("mass_") else None
            wanted = mass or wanted_column(name) or nearest(name, known)
            raise InputError(f"{source}, header", f"column '{name}'", wanted)
