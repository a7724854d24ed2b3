"""Tables of other programs, known by their headers.

``optitrack``  Motive's exports and tables derived from them: 'Time (Seconds)', laboratory Y up,
               rotations named X, Y, Z, W in any order. Rates beside them are differences of
               angles, not a gyro's, and are left aside.
``ros``        topics as columns: .../orientation/x or .orientation.x, .../angular_velocity/x,
               stamps in two columns or PlotJuggler's __time; laboratory Z up, SI.
"""

import re
from collections.abc import Callable

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.columns.native_columns import is_native, native_map
from equipoise.model.errors import InputError, nearest
from equipoise.model.units import NS

MOTIVE_TIME = "Time (Seconds)"
LETTERS = ("W", "X", "Y", "Z")
TURN = r".*(orientation|rotation)/"
RATE = r".*(angular_velocity|twist/angular)/"
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


def dialect_map(name: str, names: tuple[str, ...], source: str) -> ColumnMap:
    """Return what a header's columns mean in a dialect; InputError if it is not of that kind."""
    if name not in DIALECTS:
        raise InputError("dialect", f"'{name}'", nearest(name, list(DIALECTS)))
    return DIALECTS[name](names, source)


def detect(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of the dialect whose mark the header bears."""
    if is_native(names):
        return native_map(names, source)
    if MOTIVE_TIME in names or any(name.endswith(f"/{MOTIVE_TIME}") for name in names):
        return optitrack_map(names, source)
    if any(re.fullmatch(f"{TURN}w|{RATE}x", _plain(name)) for name in names):
        return ros_map(names, source)
    shown = ", ".join(filter(None, names[:8]))
    wanted = f"columns of a known dialect ({', '.join(DIALECTS)}), or a column map (--columns)"
    raise InputError(f"{source}, header", f"columns {shown}", wanted)


def optitrack_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of an OptiTrack table."""
    time = [name for name in names if name.endswith(MOTIVE_TIME)]
    found = [n.removesuffix("W") for n in names if n == "W" or n.endswith("Rotation/W")]
    bodies = [p for p in found if all(f"{p}{letter}" in names for letter in LETTERS)]
    if not time or not bodies:
        missing = "no rotation X, Y, Z, W" if time else f"no '{MOTIVE_TIME}'"
        wanted = "an OptiTrack export with its rotation as a quaternion"
        raise InputError(f"{source}, header", missing, wanted)
    left = [f"{len(bodies) - 1} further bodies were left aside."] if len(bodies) > 1 else []
    if any(name.startswith("omega") for name in names):
        left.append("The columns omega... were left aside: they are derived, not a gyro's.")
    return ColumnMap(
        time=(Columns((time[0],)),),
        quaternion=Columns(tuple(f"{bodies[0]}{letter}" for letter in LETTERS)),
        lab_up="y",
        mean_of_frames=True,
        notes=tuple(left),
    )


def ros_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of a table of ROS topics."""
    plain = [_plain(name) for name in names]
    attitude, more = _topic(names, plain, f"{TURN}w", "wxyz")
    rate, others = _topic(names, plain, f"{RATE}x", "xyz")
    if attitude is None and rate is None:
        wanted = "columns such as 'orientation/x' or 'angular_velocity/x'"
        raise InputError(f"{source}, header", "neither an orientation nor a rate", wanted)
    left = tuple(f"The columns of '{topic}' were left aside." for topic in more + others)
    return ColumnMap(
        time=_stamp(names, plain, source),
        quaternion=attitude,
        rate=rate,
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


DIALECTS: dict[str, Callable[[tuple[str, ...], str], ColumnMap]] = {
    "native": native_map,
    "optitrack": optitrack_map,
    "ros": ros_map,
}
