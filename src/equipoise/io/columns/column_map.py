"""How the columns of a table become a recording: names, units, frames, signs.

A dialect makes such a map from a header; a person writes one as a small TOML file
(``column_map_file``). Factors turn the column's unit into SI.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Columns:
    """Columns that belong together."""

    names: tuple[str, ...]
    factor: float | tuple[float, ...] = 1.0  # to SI, one for all or one for each
    # Our x, y, z in terms of the table's, such as ("x", "-z", "y"); None: as the whole table.
    axes: tuple[str, str, str] | None = None
    offset: float | tuple[float, ...] = 0.0  # comes off before the factor, in the column's unit


@dataclass(frozen=True, slots=True)
class Euler:
    """Three angles; ``sequence`` as in SciPy: ZYX about turned axes, zyx about fixed ones."""

    columns: Columns
    sequence: str


@dataclass(frozen=True, slots=True)
class NamedColumn:
    """A column that a recording names: of a mass 'x1', a device 'wheel:x', a cause 'gravity_x'."""

    name: str
    column: str
    factor: float  # to SI: m, N m, or what ``model.devices`` states


@dataclass(frozen=True, slots=True)
class Layout:
    """How a text is cut into cells. What is None is detected."""

    separator: str | None = None
    decimal: str | None = None
    skip_rows: int | None = None  # lines before the header
    header: bool = True  # False: none, and the columns are named 1, 2, ...
    units_row: bool | None = None  # whether a line of units follows the header


@dataclass(frozen=True, slots=True)
class ColumnMap:
    """What each column means. A map without attitude and rate holds nothing to estimate from."""

    time: tuple[Columns, ...]  # their sum is the time: seconds and nanoseconds come in two columns
    time_format: str | None = None  # of text: 'ISO' or 'clock of the day'; None: a number
    quaternion: Columns | None = None  # w, x, y, z
    euler: Euler | None = None
    matrix: Columns | None = None  # nine, row by row, body to laboratory
    rotation_vector: Columns | None = None
    rate: Columns | None = None
    masses: tuple[NamedColumn, ...] = ()
    momentum: Columns | None = None
    torque: Columns | None = None
    devices: tuple[NamedColumn, ...] = ()
    field: Columns | None = None
    temperature: Columns | None = None  # degC
    lamp: Columns | None = None  # of its full power
    accelerometer: Columns | None = None
    sun: Columns | None = None  # a unit vector, of body axes to a lamp
    position: Columns | None = None  # of P, laboratory: x, y, or three of the table's axes
    torque_by_cause: tuple[NamedColumn, ...] = ()
    lab_up: str = "z"  # the laboratory axis of the table that points up
    body: tuple[str, str, str] = ("x", "y", "z")  # our body axes in terms of the table's
    inverse: bool = False  # the attitude turns laboratory into body components
    mean_of_frames: bool = False  # rows may be means of several quaternions, hence short
    native: bool = False  # ours: no row is another clock's, time zero is as it stands
    notes: tuple[str, ...] = ()  # what the dialect ignored
    free_from: float | None = None  # s, when the platform was let go, where the file states it
    layout: Layout = Layout()

    @property
    def sensed(self) -> tuple[Columns, ...]:
        """Return the columns of clock, attitude and gyro."""
        angles = None if self.euler is None else self.euler.columns
        motion = (self.quaternion, angles, self.matrix, self.rotation_vector, self.rate)
        return (*self.time, *(each for each in motion if each is not None))

    @property
    def names(self) -> frozenset[str]:
        """Return every column that the map takes."""
        groups = (*self.sensed, self.momentum, self.torque, self.field, self.temperature, self.lamp,
                  self.accelerometer, self.sun, self.position)  # fmt: skip
        single = {c.column for c in (*self.masses, *self.devices, *self.torque_by_cause)}
        return frozenset(single.union(*(each.names for each in groups if each is not None)))
