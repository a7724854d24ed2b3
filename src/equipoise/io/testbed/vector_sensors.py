"""Tables of sensors that see a vector: accelerometer, sun sensor, magnetometer."""

from typing import Annotated

from pydantic import Field

from equipoise.io.toml.key_types import Direction, Holds, NotNegative, Positive, Triple
from equipoise.io.toml.table_records import RecordTable
from equipoise.model import vector_sensors as model

MOUNTING_SD: float = Field(
    0.5,
    description="standard deviation of its axes about each body axis; default: chip or bracket",
)


class Accelerometer(RecordTable):
    """An accelerometer triad; at rest it gives g upwards (columns accel_x_m_s2 ...)."""

    KIND = model.Accelerometer

    rate_hz: Positive
    noise_m_s2: Positive = Field(description="standard deviation per axis and sample")
    bias_sd_m_s2: NotNegative = Field(0.2, description="default: 20 mg, usual for a low-cost MEMS")
    place_mm: Triple = Field([0.0, 0.0, 0.0], description="from the centre of rotation")
    delay_s: NotNegative = 0.0
    mounting_sd_deg: NotNegative = MOUNTING_SD


class Sun(RecordTable):
    """A sun sensor and its lamp; it gives a unit vector (columns sun_x ...)."""

    KIND = model.SunSensor

    rate_hz: Positive
    noise: Positive = Field(description="standard deviation per axis and sample, of a unit vector")
    direction: Annotated[Direction | None, Holds("direction_N")] = Field(
        None, description="direction to the lamp, laboratory axes, z up; if omitted: as in [lamp]"
    )
    delay_s: NotNegative = 0.0
    mounting_sd_deg: NotNegative = MOUNTING_SD


class Magnetometer(RecordTable):
    """A magnetometer whose rows (columns field_x_uT ...) count as measurements of the attitude."""

    KIND = model.Magnetometer

    rate_hz: Positive
    noise_uT: Positive = Field(description="standard deviation per axis and sample")
    bias_sd_uT: NotNegative = Field(1.0, description="default: after calibration")
    delay_s: NotNegative = 0.0
    mounting_sd_deg: NotNegative = MOUNTING_SD
