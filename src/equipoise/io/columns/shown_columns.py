"""The columns of a recording as ``to_pandas`` names them: all in SI.

time_s  attitude_w ...  rate_x_rad_s ...  masses_<name>_m  momentum_x_N_m_s ...
torque_x_N_m ...  field_x_T ...  temperature_air_degC  lamp_power  position_x_m position_y_m
wheel:<name>_rad_s  gimbal:<name>_rad  dipole:<name>_A_m2  cage:<name>_T  jet:<name>_N_m
torque_by_cause_<cause>_x_N_m ...  torque_by_cause_<cause>_sd_x_N_m ...
"""

import re
from typing import Any

from equipoise.io.columns.column_map import ColumnMap, Columns, NamedColumn
from equipoise.io.columns.native_columns import TIME, left_aside

GROUPS = {
    "quaternion": tuple(f"attitude_{axis}" for axis in "wxyz"),
    "rate": tuple(f"rate_{axis}_rad_s" for axis in "xyz"),
    "momentum": tuple(f"momentum_{axis}_N_m_s" for axis in "xyz"),
    "torque": tuple(f"torque_{axis}_N_m" for axis in "xyz"),
    "field": tuple(f"field_{axis}_T" for axis in "xyz"),
    "temperature": ("temperature_air_degC",),
    "lamp": ("lamp_power",),
    "accelerometer": tuple(f"accelerometer_{axis}_m_s2" for axis in "xyz"),
    "sun": tuple(f"sun_{axis}" for axis in "xyz"),
    "position": tuple(f"position_{axis}_m" for axis in "xy"),
}
MASS = re.compile("masses_(.+)_m")
CAUSE = re.compile("torque_by_cause_([a-z]+_(?:sd_)?[xyz])_N_m")
DEVICE = re.compile("(?=wheel:.*_rad_s|gimbal:.*_rad|dipole:.*_A_m2|cage:.*_T|jet:.*_N_m)"
                    "([a-z]+:.+?)_(rad_s|rad|A_m2|T|N_m)")  # fmt: skip


def is_shown(names: tuple[str, ...]) -> bool:
    """Say whether a header has the time of such a table, and its attitude or its rate."""
    return TIME in names and any({*GROUPS[sensor]} <= {*names} for sensor in ("quaternion", "rate"))


def shown_map(names: tuple[str, ...]) -> ColumnMap:
    """Return what the columns of such a table mean."""
    whole = {key: group for key, group in GROUPS.items() if {*group} <= {*names}}
    masses = _named(MASS, names)
    devices, causes = _named(DEVICE, names), _named(CAUSE, names)
    known = [TIME, *(name for group in whole.values() for name in group),
             *(each.column for each in (*masses, *devices, *causes))]  # fmt: skip
    groups: dict[str, Any] = {key: Columns(group) for key, group in whole.items()}
    return ColumnMap(
        time=(Columns((TIME,)),),
        masses=masses,
        devices=devices,
        torque_by_cause=causes,
        native=True,
        notes=left_aside(names, known),
        **groups,
    )


def _named(pattern: re.Pattern[str], names: tuple[str, ...]) -> tuple[NamedColumn, ...]:
    """Return the masses, devices or causes that a header names."""
    found = filter(None, map(pattern.fullmatch, names))
    return tuple(NamedColumn(match[1], match[0], 1.0) for match in found)
