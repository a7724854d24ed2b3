"""Tables of phyphox, a program that records the sensors of a phone.

Each sensor is a table of its own (https://phyphox.org, "Export"): 'Time (s)' and 'Gyroscope x
(rad/s)' to z, or 'w', 'x', 'y', 'z' of the attitude. An experiment of one's own may put
'Acceleration x (m/s^2)' to z beside them, at rest g upwards. The quaternion turns the phone's axes
(x to the right of its screen, y up, z out of it) into east, north, up
(https://developer.android.com, SensorEvent, "Sensor.TYPE_ROTATION_VECTOR").
"""

from equipoise.io.columns.column_map import ColumnMap, Columns
from equipoise.model.errors import InputError

TIME = "Time (s)"
TURN = ("w", "x", "y", "z")
RATE = ("Gyroscope x (rad/s)", "Gyroscope y (rad/s)", "Gyroscope z (rad/s)")
ACCELERATION = ("Acceleration x (m/s^2)", "Acceleration y (m/s^2)", "Acceleration z (m/s^2)")


def is_phyphox(names: tuple[str, ...]) -> bool:
    """Say whether a header has phyphox's time beside its gyroscope or its attitude."""
    return TIME in names and (RATE[0] in names or {*TURN} <= {*names})


def phyphox_map(names: tuple[str, ...], source: str) -> ColumnMap:
    """Return the map of a table of phyphox."""
    turn, rate, acceleration = ({*group} <= {*names} for group in (TURN, RATE, ACCELERATION))
    if TIME not in names or not (turn or rate):
        missing = "neither gyroscope nor attitude" if TIME in names else f"no '{TIME}'"
        wanted = f"'{TIME}' with {', '.join(RATE)} or {', '.join(TURN)}"
        raise InputError(f"{source}, header", missing, wanted)
    return ColumnMap(
        time=(Columns((TIME,)),),
        quaternion=Columns(TURN) if turn else None,
        rate=Columns(RATE) if rate else None,
        accelerometer=Columns(ACCELERATION) if acceleration else None,
    )
