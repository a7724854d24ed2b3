"""A planar table, the sensor of the position on it, and what a simulated one really is."""

from typing import Annotated

from pydantic import Field

from equipoise.io.toml.key_types import NotNegative, Pair, Positive
from equipoise.io.toml.table_records import RecordTable, record_of
from equipoise.model import table_top as model
from equipoise.model.errors import InputError
from equipoise.model.units import DEG

Four = Annotated[list[float], Field(min_length=4, max_length=4)]


class Position(RecordTable):
    """Motion capture of the centre of rotation (columns position_x_mm, position_y_mm)."""

    KIND = model.PositionSensor

    rate_hz: Positive
    noise_mm: Positive = Field(description="standard deviation per axis and sample")
    delay_s: NotNegative = 0.0


class TableTop(RecordTable):
    """A flat table, over which a sled on air pads carries the spherical bearing."""

    KIND = model.PlanarTable

    sled_mass_kg: Positive = Field(description="of all that floats beside the platform")
    sled_mass_sd_percent: NotNegative = Field(
        0.5, description="standard deviation of sled_mass_kg; default: weighed; 0: exact"
    )
    low_mm: Pair = Field(description="corner of least x and y, laboratory axes of the position")
    high_mm: Pair = Field(description="opposite corner")
    slope_sd_deg: Positive = Field(
        model.SLOPE_SD / DEG,
        description="standard deviation of its slope along x and y; default: 1 mm/m",
    )

    def record(self, where: str) -> model.PlanarTable:
        """Return the table; InputError for corners that enclose nothing."""
        for low, high in zip(self.low_mm, self.high_mm, strict=True):
            if low >= high:
                found = f"low_mm = {self.low_mm}, high_mm = {self.high_mm}"
                raise InputError(where, found, "low_mm below high_mm along x and y")
        return record_of(model.PlanarTable, self, where)


class TrueTable(RecordTable):
    """What a simulated table really is, and where its platform starts."""

    KIND = model.TrueTable

    slope_deg: Pair = Field([0.0, 0.0], description="downhill slope along x and y")
    friction_N_s_m: Four = Field(
        [0.0, 0.0, 0.0, 0.0],
        description=(
            "viscous friction at the corners: low x low y, low x high y, high x low y, high x "
            "high y; bilinear between them"
        ),
    )
    position_mm: Pair = Field([0.0, 0.0], description="of the centre of rotation at the start")
    velocity_mm_s: Pair = Field([0.0, 0.0], description="of the centre of rotation at the start")


def check_table(
    table: TableTop | None, position: Position | None, is_true: bool, source: str
) -> None:
    """Raise InputError for a table without a sensor of the position, or the other way round.

    ``is_true``: whether the file says what a simulated table really is.
    """
    if table is None and is_true:
        wanted = "a table [table] with sled_mass_kg, low_mm and high_mm"
        raise InputError(f"{source}: truth.table", "a true table, but none that is stated", wanted)
    if (table is None) == (position is None):
        return
    if position is None:
        wanted = "a table [sensor.position] with rate_hz and noise_mm"
        raise InputError(f"{source}: sensor.position", "nothing, but a [table]", wanted)
    wanted = "a table [table] with sled_mass_kg, low_mm and high_mm"
    raise InputError(f"{source}: table", "nothing, but a [sensor.position]", wanted)
