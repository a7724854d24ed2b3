"""Exports of Motive (OptiTrack), Tracker and Nexus (Vicon), and QTM (Qualisys).

``optitrack``  Motive's CSV export (https://docs.optitrack.com, "Data Export: CSV") and tables
               derived from it: 'Time (Seconds)', laboratory Y up, rotations named X, Y, Z, W in any
               order. Rates beside them are differences of angles, not a gyro's, and are ignored.
``vicon``      The blocks 'Objects' (Tracker) and 'Segments' (Nexus) of an export as CSV
               (https://docs.vicon.com, "Export data to CSV"): RX, RY, RZ are a rotation vector
               (Vicon: helical angles), with RW a quaternion; laboratory Z up; time is counted in
               frames.
``qualisys``   QTM's export of 6DOF data as TSV (https://docs.qualisys.com/qtm, "TSV file formats"):
               Rot[0] to Rot[8] is the rotation matrix, body to laboratory, column by column (in an
               export at hand a roll of -0.656 deg has Rot[5] = -0.01145, its sine); laboratory
               Z up. A body that is not tracked is all zeros.

``formats.vicon_header`` and ``formats.qualisys_header`` have made one line of their headers.
"""

import re

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.io.dialects.body_choice import chosen_body, others_left
from equipoise.io.toml.units import factor
from equipoise.model.errors import InputError

MOTIVE_TIME = "Time (Seconds)"
LETTERS = ("W", "X", "Y", "Z")
COUNTED = re.compile(r"(?:Frame|Row) \((.+) Hz\)")
VICON_TURN = re.compile(r"(.+)/R([XYZW])(?: \((.+)\))?")
QUALISYS_TURN = re.compile(r"(.+)/Rot\[(\d)\]")
BY_ROWS = (0, 3, 6, 1, 4, 7, 2, 5, 8)  # places of a matrix that is written column by column


def is_optitrack(names: tuple[str, ...]) -> bool:
    """Say whether a header has Motive's time."""
    return any(name == MOTIVE_TIME or name.endswith(f"/{MOTIVE_TIME}") for name in names)


def is_vicon(names: tuple[str, ...]) -> bool:
    """Say whether a header counts frames and has Vicon's rotations."""
    counts = any(map(COUNTED.fullmatch, names))
    return counts and any(map(VICON_TURN.fullmatch, names))


def is_qualisys(names: tuple[str, ...]) -> bool:
    """Say whether a header has QTM's rotation matrices."""
    return any(map(QUALISYS_TURN.fullmatch, names))


def optitrack_map(names: tuple[str, ...], source: str, body: str | None) -> ColumnMap:
    """Return the map of an OptiTrack table."""
    time = [name for name in names if name.endswith(MOTIVE_TIME)]
    found = [n.removesuffix("W") for n in names if n == "W" or n.endswith("Rotation/W")]
    stems = [p for p in found if all(f"{p}{letter}" in names for letter in LETTERS)]
    if not time or not stems:
        missing = "no rotation X, Y, Z, W" if time else f"no '{MOTIVE_TIME}'"
        wanted = "an OptiTrack export with its rotation as a quaternion"
        raise InputError(f"{source}, header", missing, wanted)
    bodies = {_motive_name(stem): stem for stem in stems}
    chosen = chosen_body(tuple(bodies), body, source)
    left = others_left(tuple(bodies), chosen)
    if any(name.startswith("omega") for name in names):
        left = (*left, "The columns omega... were ignored: they are derived, not a gyro's.")
    return ColumnMap(
        time=(Columns((time[0],)),),
        quaternion=Columns(tuple(f"{bodies[chosen]}{letter}" for letter in LETTERS)),
        lab_up="y",
        mean_of_frames=True,
        notes=left,
    )


def vicon_map(names: tuple[str, ...], source: str, body: str | None) -> ColumnMap:
    """Return the map of a Vicon table."""
    turns = [match for match in map(VICON_TURN.fullmatch, names) if match]
    time = _clock(names, source)
    bodies = tuple(dict.fromkeys(match[1] for match in turns))
    if not bodies:
        wanted = "an export of Tracker's objects or of Nexus's segments"
        raise InputError(f"{source}, header", "no rotation RX, RY, RZ", wanted)
    chosen = chosen_body(bodies, body, source)
    columns = {match[2]: match for match in turns if match[1] == chosen}
    if not {*"XYZ"} <= {*columns}:
        found = f"body '{chosen}' with R{' R'.join(columns)} alone"
        raise InputError(f"{source}, header", found, "RX, RY and RZ, or RX, RY, RZ and RW")
    left = others_left(bodies, chosen)
    if "W" in columns:
        quaternion = Columns(tuple(columns[letter][0] for letter in LETTERS))
        return ColumnMap(time=time, quaternion=quaternion, notes=left)
    unit = factor(columns["X"][3] or "", "angle", f"{source}, column '{columns['X'][0]}'")
    assumed = "RX, RY, RZ were taken as a rotation vector (Vicon: helical angles)."
    vector = Columns(tuple(columns[letter][0] for letter in "XYZ"), unit)
    return ColumnMap(time=time, rotation_vector=vector, notes=(*left, assumed))


def qualisys_map(names: tuple[str, ...], source: str, body: str | None) -> ColumnMap:
    """Return the map of a table of QTM."""
    turns = [match for match in map(QUALISYS_TURN.fullmatch, names) if match]
    bodies = tuple(dict.fromkeys(match[1] for match in turns))
    if not bodies:
        wanted = "a TSV export of QTM's 6DOF data, with its rotation matrix"
        raise InputError(f"{source}, header", "no rotation Rot[0] to Rot[8]", wanted)
    chosen = chosen_body(bodies, body, source)
    time = (Columns(("Time",)),) if "Time" in names else _clock(names, source)
    matrix = Columns(tuple(f"{chosen}/Rot[{place}]" for place in BY_ROWS))
    return ColumnMap(time=time, matrix=matrix, notes=others_left(bodies, chosen))


def _motive_name(stem: str) -> str:
    """Return the body in a stem such as 'Rigid Body/Platform/ID/Rotation/', '' if there is none."""
    parts = stem.split("/")
    return parts[1] if len(parts) > 3 else ""


def _clock(names: tuple[str, ...], source: str) -> tuple[Columns, ...]:
    """Return the frames' count as the time."""
    counted = next((match for match in map(COUNTED.fullmatch, names) if match), None)
    if counted is None:
        raise InputError(f"{source}, header", "no count of frames with its rate", "an export whole")
    return (Columns((counted[0],), 1 / float(counted[1])),)
