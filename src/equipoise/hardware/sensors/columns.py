"""Columns of a row that a device prints: what each is, and in which unit.

t_s t_ms t_us               time on the device's clock
n                           number of the row
qw qx qy qz                 quaternion, from the sensor's axes to its laboratory frame
yaw_deg pitch_deg roll_deg  or angles: yaw about z, then pitch about y, then roll about x
gx_rad_s gy_rad_s gz_rad_s  rate about the sensor's axes; or gx_deg_s gy_deg_s gz_deg_s
-                           not of interest
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from equipoise.hardware.sensors.attitudes import Row, from_angles, unit_row
from equipoise.hardware.sensors.settings import Settings, check_gives
from equipoise.model.errors import nearest
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading
from equipoise.model.units import DEG

TIMES = {"t_s": 1.0, "t_ms": 1e-3, "t_us": 1e-6}  # s
NUMBER, SKIPPED = "n", "-"
QUATERNION = ("qw", "qx", "qy", "qz")
ANGLES = ("yaw_deg", "pitch_deg", "roll_deg")
RATES: dict[tuple[str, ...], float] = {
    ("gx_rad_s", "gy_rad_s", "gz_rad_s"): 1.0,
    ("gx_deg_s", "gy_deg_s", "gz_deg_s"): DEG,
}
SETS: tuple[tuple[str, ...], ...] = (QUATERNION, ANGLES, *RATES)
KNOWN = [*TIMES, NUMBER, SKIPPED, *(name for each in SETS for name in each)]
Found = TypeVar("Found", str, tuple[str, ...])
UNIT = 0.011  # of two decimals, as sketches print, the length errs by 0.005 sum |q_i| <= 0.01


@dataclass(frozen=True, slots=True)
class Columns:
    """What a row holds; each field names columns, and is empty if there are none."""

    time: str
    number: str
    attitude: tuple[str, ...]
    rate: tuple[str, ...]

    def readings(self, row: Mapping[str, float]) -> list[Reading]:
        """Return the readings of a row of finite numbers; none if its quaternion is no unit one."""
        stamp = row[self.time] * TIMES[self.time] if self.time else None
        number = int(row[self.number]) if self.number else None
        found: list[Reading] = []
        if self.attitude:
            turn = attitude_of([row[name] for name in self.attitude])
            if turn is None:
                return []
            found.append(Reading("attitude", turn, stamp, number))
        if self.rate:
            scale = RATES[self.rate]
            rate = tuple(scale * row[name] for name in self.rate)
            found.append(Reading("rate", rate, stamp, number))
        return found


def attitude_of(values: Sequence[float]) -> Row | None:
    """Return the attitude of four numbers of a quaternion or three angles (deg)."""
    if len(values) == 3:
        return from_angles(values[0], values[1], values[2])
    return unit_row(values, UNIT)


def columns_of(unit: SensorUnit, settings: Settings, names: Sequence[str]) -> Columns:
    """Return the columns of these names, checked: whole sets, each once, all that is given."""
    for name in names:
        if name not in KNOWN:
            raise settings.wrong(f"column '{name}'", nearest(name, KNOWN))
    twice = [name for name, count in Counter(names).items() if count > 1 and name != SKIPPED]
    if twice:
        raise settings.wrong(f"column '{twice[0]}' twice", "each column once")
    whole = [each for each in SETS if _whole(each, names, settings)]
    columns = Columns(
        _one_of([name for name in names if name in TIMES], "time", settings, ""),
        NUMBER if NUMBER in names else "",
        _one_of([each for each in whole if each in (QUATERNION, ANGLES)], "attitude", settings, ()),
        _one_of([each for each in whole if each in RATES], "rate", settings, ()),
    )
    can: dict[Gives, tuple[str, ...]] = {"attitude": columns.attitude, "rate": columns.rate}
    check_gives(unit, [channel for channel, has in can.items() if has], "columns for it")
    return columns


def _whole(columns: Sequence[str], names: Sequence[str], settings: Settings) -> bool:
    """Say whether a set of columns is there; half a set is an error."""
    missing = [name for name in columns if name not in names]
    if missing and len(missing) < len(columns):
        there = next(name for name in columns if name in names)
        raise settings.wrong(f"'{there}' without '{missing[0]}'", "all of " + " ".join(columns))
    return not missing


def _one_of(found: Sequence[Found], what: str, settings: Settings, none: Found) -> Found:
    """Return the only one, or ``none``."""
    if len(found) > 1:
        both = " and ".join(each if isinstance(each, str) else each[0] for each in found[:2])
        raise settings.wrong(f"two columns of {what}: {both}", "one")
    return found[0] if found else none
