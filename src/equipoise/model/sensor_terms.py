"""Names and units of the errors of sensors.

Each is one coefficient that a fit may seek beside the torques (``sensors.camera``,
``sensors.gyro`` and ``sensors.vector_sensors`` have the equations). Groups are what a person asks
for by name.
"""

from collections.abc import Iterable

GYRO_CLOCK = "gyro_clock"
GROUPS: dict[str, tuple[str, ...]] = {
    "plumb": ("plumb_x", "plumb_y"),
    "heading2": tuple(f"heading2_{wave}_{axis}" for wave in ("cos", "sin") for axis in "xyz"),
    "heading3": tuple(f"heading3_{wave}_{axis}" for wave in ("cos", "sin") for axis in "xyz"),
    "camera_delay": ("camera_delay",),
    "gyro_scale": ("gyro_xx", "gyro_yy", "gyro_zz"),
    "gyro_cross": ("gyro_xy", "gyro_xz", "gyro_yx", "gyro_yz", "gyro_zx", "gyro_zy"),
    GYRO_CLOCK: (GYRO_CLOCK,),
}
# By channel; each is sought wherever its channel is used and its sd is not 0.
BIASES: dict[str, tuple[str, ...]] = {
    channel: tuple(f"{channel}_bias_{axis}" for axis in "xyz")
    for channel in ("accelerometer", "field")
}
MOUNTINGS: dict[str, tuple[str, ...]] = {
    channel: tuple(f"{channel}_mounting_{axis}" for axis in "xyz")
    for channel in ("accelerometer", "sun", "field")
}
TERMS: tuple[str, ...] = tuple(
    term for groups in (GROUPS, BIASES, MOUNTINGS) for group in groups.values() for term in group
)
UNITS: dict[str, str] = {
    "plumb": "rad", "heading2": "rad", "heading3": "rad", "camera": "s", "gyro": "1",
    "accelerometer": "m/s2", "field": "T",
}  # fmt: skip


def among(names: Iterable[str]) -> tuple[str, ...]:
    """Return the sensors' terms among some names, each once, in the package's order."""
    wanted = set(names)
    return tuple(term for term in TERMS if term in wanted)


def unit_of(term: str) -> str:
    """Return the SI unit of a term's coefficient."""
    if any(term in terms for terms in MOUNTINGS.values()):
        return "rad"
    return UNITS[term.split("_")[0]]
