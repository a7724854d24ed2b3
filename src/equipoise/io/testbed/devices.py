"""Wheels, gyros, magnetorquers, jets and the field: their tables, and their records in SI."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any

from pydantic import Field

from equipoise.io.toml.key_types import (
    Direction,
    Holds,
    Name,
    NotNegative,
    Positive,
    Triple,
    square_axis,
    unit_vector,
)
from equipoise.io.toml.table_records import RecordTable, record_of
from equipoise.io.toml.units import key_factor
from equipoise.model import devices as model
from equipoise.model.errors import InputError

GAIN_SD: float = Field(
    1.0,
    description="standard deviation of its output, relative; default: data sheet; 0: exact",
)
MOUNTING_SD: float = Field(
    0.2,
    description=(
        "standard deviation of its axes about each transverse direction; default: bolted; 0: exact"
    ),
)


class ReactionWheel(RecordTable):
    """A rotor with a fixed axis; its inertia is the greatest momentum by the greatest speed."""

    name: Name
    axis: Direction
    max_momentum_N_m_s: Positive = Field(description="at the greatest speed")
    max_speed_rpm: Positive = Field(description="against the platform")
    max_torque_N_m: Positive
    speed_rpm: float = Field(0.0, description="at the start")
    speed_noise_rpm: NotNegative = Field(0.0, description="standard deviation of a tachometer row")
    lag_ms: NotNegative = Field(0.0, description="first-order lag from command to torque")
    gain_sd_percent: NotNegative = GAIN_SD
    mounting_sd_deg: NotNegative = MOUNTING_SD

    def record(self, where: str) -> model.ReactionWheel:
        """Return the wheel."""
        if abs(self.speed_rpm) > self.max_speed_rpm:
            wanted = f"at most max_speed_rpm = {self.max_speed_rpm:g} in either direction"
            raise InputError(f"{where}.speed_rpm", f"{self.speed_rpm:g}", wanted)
        inertia = self.max_momentum_N_m_s / (self.max_speed_rpm * key_factor("max_speed_rpm"))
        return record_of(model.ReactionWheel, self, where, inertia=inertia)

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return the momentum."""
        return {"max_momentum_N_m_s": record.inertia * record.max_speed}


class ControlMomentGyro(RecordTable):
    """A rotor of constant momentum whose axis turns about a gimbal."""

    name: Name
    gimbal_axis: Direction
    spin_axis: Triple = Field(description="at angle zero; at right angles to the gimbal axis")
    momentum_N_m_s: Positive
    max_rate_deg_s: Positive
    angle_deg: float = Field(0.0, description="at the start")
    angle_noise_deg: NotNegative = Field(0.0, description="standard deviation of an encoder row")
    lag_ms: NotNegative = Field(0.0, description="first-order lag from command to rate")
    gimbal_inertia_kg_m2: NotNegative = Field(
        0.0, description="of everything that turns with the gimbal, about the gimbal axis"
    )
    asymmetry_kg_m2: float = Field(
        0.0, description="the same inertia about the spin axis minus that about the third axis"
    )
    gain_sd_percent: NotNegative = GAIN_SD
    mounting_sd_deg: NotNegative = MOUNTING_SD

    def record(self, where: str) -> model.ControlMomentGyro:
        """Return the gyro, its spin axis exactly square to the gimbal's."""
        gimbal = unit_vector(self.gimbal_axis, f"{where}.gimbal_axis")
        spin = square_axis(self.spin_axis, gimbal, f"{where}.spin_axis", "gimbal axis")
        return record_of(model.ControlMomentGyro, self, where, spin_axis=spin)


class Magnetorquer(RecordTable):
    """A coil or rod."""

    KIND = model.Magnetorquer

    name: Name
    axis: Direction
    max_dipole_A_m2: Positive
    lag_ms: NotNegative = Field(0.0, description="first-order lag from command to dipole")
    gain_sd_percent: NotNegative = GAIN_SD
    mounting_sd_deg: NotNegative = MOUNTING_SD


class CoilPair(RecordTable):
    """A pair of coils of a Helmholtz cage around the bench; its field adds to [magnetic_field]."""

    name: Name
    axis: Annotated[Direction, Holds("axis_N")] = Field(description="laboratory axes, z up")
    max_field_uT: Positive
    field_uT: float = Field(0.0, description="along its axis, at the start")
    lag_ms: NotNegative = Field(0.0, description="first-order lag from command to field")
    gain_sd_percent: NotNegative = GAIN_SD
    mounting_sd_deg: NotNegative = MOUNTING_SD
    nonuniformity_percent: NotNegative = Field(
        1.0, description="maximum deviation within the working volume; default: near its centre"
    )

    def record(self, where: str) -> model.CoilPair:
        """Return the coil pair."""
        if abs(self.field_uT) > self.max_field_uT:
            wanted = f"at most max_field_uT = {self.max_field_uT:g} in either direction"
            raise InputError(f"{where}.field_uT", f"{self.field_uT:g}", wanted)
        return record_of(model.CoilPair, self, where)


class JetPair(RecordTable):
    """On-off jets that give a pure torque about an axis, either way."""

    KIND = model.JetPair

    name: Name
    axis: Direction
    torque_N_m: Positive = Field(description="while on")
    min_pulse_ms: NotNegative = 0.0
    lag_ms: NotNegative = Field(0.0, description="first-order lag from valve to torque")
    gain_sd_percent: NotNegative = GAIN_SD
    mounting_sd_deg: NotNegative = MOUNTING_SD


class MagneticField(RecordTable):
    """The field in the laboratory, uniform; beside a cage, what there is without it."""

    field_uT: Annotated[Triple, Holds("field_N")] = Field(description="laboratory axes, z up")
    noise_uT: Positive | None = Field(
        None,
        description="standard deviation per axis of a magnetometer; if omitted: no magnetometer",
    )

    def record(self, where: str) -> model.MagneticField:
        """Return the field, which must not be zero."""
        if not any(self.field_uT):
            wanted = "the field, in laboratory axes"
            raise InputError(f"{where}.field_uT", "a field of zero", wanted)
        return record_of(model.MagneticField, self, where)


class Lamp(RecordTable):
    """A lamp, or any heater, whose switch is recorded (column lamp_power)."""

    KIND = model.Lamp

    warms_K: Positive = Field(
        description="final temperature rise where it shines; an estimate is sufficient"
    )
    time_constant_s: Positive
    direction: Annotated[Direction | None, Holds("direction_N")] = Field(
        None,
        description="direction to it, laboratory axes, z up: [sensor.sun] has rows while it is on",
    )


class Thermometer(RecordTable):
    """A thermometer on the platform (column temperature_degC)."""

    KIND = model.Thermometer

    rate_hz: Positive
    noise_K: NotNegative = Field(0.0, description="standard deviation of a row")


Device = ReactionWheel | ControlMomentGyro | Magnetorquer | CoilPair | JetPair


def check_device_names(devices: Mapping[str, Sequence[Device]], source: str) -> None:
    """Raise InputError for two devices of one name: they are driven by name, whatever the kind."""
    owners: dict[str, str] = {}
    for kind, rows in devices.items():
        for i, device in enumerate(rows, 1):
            owner = f"{kind}[{i}]"
            if device.name in owners:
                found = f"'{device.name}', the name of {owners[device.name]}"
                raise InputError(f"{source}: {owner}.name", found, "a name that no device has yet")
            owners[device.name] = owner
