"""Tables of ROS topics, one column for each number of a message.

Names follow the message's fields, with slashes (PlotJuggler, https://plotjuggler.io), with dots
(``rostopic echo -p``, https://wiki.ros.org/rostopic) or with underscores (MATLAB). Orientations
turn body into laboratory, Z up, and all is in SI (REP 103, https://ros.org/reps/rep-0103.html).
"""

import re

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.model.errors import InputError
from equipoise.model.units import NS

TURN = r".*(orientation|rotation)/"
RATE = r".*(angular_velocity|twist/angular)/"
ACCELERATION = r".*linear_acceleration/"
# Stamps of a message, then the times at which a recorder put it down; pattern, factor to s.
STAMPS = (
    (r".*header/stamp/secs?", 1.0, r".*header/stamp/n(ano)?secs?"),
    (r".*timestamp/secs?", 1.0, r".*timestamp/n(ano)?secs?"),
    (r"__time", 1.0, None),
    (r"field/header/stamp", NS, None),  # rostopic echo -p writes stamps in ns
    (r".*header/stamp", 1.0, None),
    (r"%time|rosbagTimestamp", NS, None),
    (r"[Tt]ime(_s| ?[\[(]s[\])])?", 1.0, None),
)


def is_ros(names: tuple[str, ...]) -> bool:
    """Say whether a header names an orientation or a rate as a message does."""
    return any(re.fullmatch(f"{TURN}w|{RATE}x", _plain(name)) for name in names)


def ros_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of a table of ROS topics."""
    plain = [_plain(name) for name in names]
    attitude, more = _topic(names, plain, f"{TURN}w", "wxyz")
    rate, others = _topic(names, plain, f"{RATE}x", "xyz")
    acceleration, unused = _topic(names, plain, f"{ACCELERATION}x", "xyz")
    if attitude is None and rate is None:
        wanted = "columns such as 'orientation/x' or 'angular_velocity/x'"
        raise InputError(f"{source}, header", "neither an orientation nor a rate", wanted)
    left = tuple(f"The columns of '{topic}' were ignored." for topic in more + others + unused)
    return ColumnMap(
        time=_stamp(names, plain, source),
        quaternion=attitude,
        rate=rate,
        accelerometer=acceleration,
        notes=left,
    )


def _plain(name: str) -> str:
    """Return a topic column's name with slashes throughout, as PlotJuggler writes it."""
    return re.sub(r"_([wxyz])$", r"/\1", re.sub(r"[./]+", "/", name))


def _topic(
    names: tuple[str, ...], plain: list[str], pattern: str, letters: str
) -> tuple[Columns | None, tuple[str, ...]]:
    """Return the columns of the first topic that has them all, and the topics after it."""
    stems = [name[:-1] for name in plain if re.fullmatch(pattern, name)]
    whole = [stem for stem in stems if all(stem + letter in plain for letter in letters)]
    if not whole:
        return None, ()
    chosen = tuple(names[plain.index(whole[0] + letter)] for letter in letters)
    return Columns(chosen), tuple(stem.rstrip("/") for stem in whole[1:])


def _stamp(names: tuple[str, ...], plain: list[str], source: str) -> tuple[Columns, ...]:
    """Return the columns whose sum is the time."""
    for pattern, unit, rest in STAMPS:
        first = _first(names, plain, pattern)
        second = _first(names, plain, rest) if rest else None
        if first and (second or not rest):
            fine = (Columns((second,), NS),) if second else ()
            return (Columns((first,), unit), *fine)
    wanted = "'header/stamp/sec' with 'nanosec', '__time' or 'time'"
    raise InputError(f"{source}, header", "no time column", wanted)


def _first(names: tuple[str, ...], plain: list[str], pattern: str) -> str | None:
    return next((n for n, p in zip(names, plain, strict=True) if re.fullmatch(pattern, p)), None)
