"""The native columns of devices: what is reported in front, the unit behind.

wheel_<name>_rad_s  gimbal_<name>_deg  dipole_<name>_A_m2  cage_<name>_uT  jet_<name>_N_m
"""

import re

from equipoise.io.columns.column_map import NamedColumn
from equipoise.model.errors import InputError
from equipoise.model.units import DEG, UT

# What is reported: its unit in the column's name, the size of that in SI.
UNITS = {
    "wheel": ("rad_s", 1.0),
    "gimbal": ("deg", DEG),
    "dipole": ("A_m2", 1.0),
    "cage": ("uT", UT),
    "jet": ("N_m", 1.0),
}
IN_SI = {"deg": "rad", "uT": "T"}  # how a unit that is not SI is written there
COLUMN = re.compile(
    r"(wheel)_(.+)_rad_s|(gimbal)_(.+)_deg|(dipole)_(.+)_A_m2|(cage)_(.+)_uT|(jet)_(.+)_N_m"
)
DEVICE = re.compile(f"({'|'.join(UNITS)}):(.+)")


def device_of(column: str) -> NamedColumn | None:
    """Return the device of a native column; None if it is no device's."""
    match = COLUMN.fullmatch(column)
    if match is None:
        return None
    reported, name = (part for part in match.groups() if part is not None)
    return NamedColumn(f"{reported}:{name}", column, UNITS[reported][1])


def column_of(device: str) -> NamedColumn:
    """Return the native column of a device, as a recording names it."""
    match = DEVICE.fullmatch(device)
    if match is None:
        wanted = "its name after " + ", ".join(f"'{reported}:'" for reported in UNITS)
        raise InputError("recording: device_names", f"'{device}'", wanted)
    unit, factor = UNITS[match[1]]
    return NamedColumn(device, f"{match[1]}_{match[2]}_{unit}", factor)


def si_column(device: str) -> str:
    """Return the column of a device where all numbers are in SI, as in a log."""
    native = column_of(device).column
    stem, _, unit = native.rpartition("_")
    return f"{stem}_{IN_SI[unit]}" if unit in IN_SI else native


def wanted_column(name: str) -> str | None:
    """Return the form of a device's column; None if a name means no device's."""
    reported = name.split("_", 1)[0]
    return f"'{reported}_<name>_{UNITS[reported][0]}'" if reported in UNITS else None
