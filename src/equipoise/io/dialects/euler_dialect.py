"""Tables of roll, pitch and yaw, as many loggers and flight controllers write them.

A column's name holds its unit: 'roll_deg', 'Pitch (deg)', 'yaw[rad]'; the time's too: 't', 'time',
'time_s', 'Time (s)', 'ms', 'timestamp_us'. Taken for granted, and said in a note, is the sequence
of aerospace: yaw about Z, pitch about the turned Y, roll about the turned X, body to
laboratory, Z up.
"""

import re

from equipoise.io.columns.column_map import ColumnMap, Columns, Euler
from equipoise.io.columns.native_columns import left_aside
from equipoise.io.toml.units import TO_SI
from equipoise.model.errors import InputError

ANGLES = ("yaw", "pitch", "roll")  # in the order of their turns
ANGLE = re.compile(r"(roll|pitch|yaw)(?:[ _]*[(\[]?(deg|rad|degrees|radians|°)[)\]]?)?", re.I)
TIME = re.compile(r"(?:(?:t|time|time_?stamp)(?:[ _]+|[ _]*[(\[]))?(s|sec|ms|us|ns)[)\]]?", re.I)
UNNAMED_TIME = re.compile(r"t|time", re.I)
UNITS = {"degrees": "deg", "°": "deg", "radians": "rad", "sec": "s"}
BY_HAND = "the unit in the name, such as '{}', or a column map (--columns)"
ASSUMED = (
    "Roll, pitch and yaw were taken as ZYX angles that turn body into a laboratory whose Z is up; "
    "a column map (--columns) states another sequence."
)


def is_euler(names: tuple[str, ...]) -> bool:
    """Say whether a header has roll, pitch and yaw."""
    found = [match[1].lower() for match in map(ANGLE.fullmatch, names) if match]
    return {*ANGLES} <= {*found}


def euler_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of a table of roll, pitch and yaw."""
    columns = {match[1].lower(): match for match in map(ANGLE.fullmatch, names) if match}
    missing = [angle for angle in ANGLES if angle not in columns]
    if missing:
        wanted = "roll, pitch and yaw, such as 'roll_deg'"
        raise InputError(f"{source}, header", f"no {' and no '.join(missing)}", wanted)
    units = tuple(_unit(columns[angle][0], columns[angle][2], source) for angle in ANGLES)
    time, guessed = _time(names, source)
    used = [*time.names, *(columns[angle][0] for angle in ANGLES)]
    return ColumnMap(
        time=(time,),
        euler=Euler(Columns(tuple(columns[angle][0] for angle in ANGLES), units), "ZYX"),
        notes=(ASSUMED, *guessed, *left_aside(names, used)),
    )


def _unit(name: str, unit: str | None, source: str) -> float:
    """Return what one of an angle's unit is in SI."""
    if unit is None:
        wanted = BY_HAND.format(f"{name}_deg")
        raise InputError(f"{source}, header", f"column '{name}' without a unit", wanted)
    return TO_SI[UNITS.get(unit.lower(), unit.lower())]


def _time(names: tuple[str, ...], source: str) -> tuple[Columns, tuple[str, ...]]:
    """Return the time, and what had to be taken for granted of it."""
    stated = next((match for match in map(TIME.fullmatch, names) if match), None)
    if stated is not None:
        unit = stated[1].lower()
        return Columns((stated[0],), TO_SI[UNITS.get(unit, unit)]), ()
    plain = next((name for name in names if UNNAMED_TIME.fullmatch(name)), None)
    if plain is None:
        wanted = "a time such as 'time_s' or 'timestamp_us', or a column map (--columns)"
        raise InputError(f"{source}, header", "no time column with its unit", wanted)
    return Columns((plain,)), (f"The column '{plain}' was taken as seconds.",)
