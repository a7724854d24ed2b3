"""The tables of a testbed file that tell of wheels, gyros, magnetorquers, jets and the field.

A unit is part of its key. Nothing is converted here; ``devices_build`` does that once.
"""

from pydantic import Field

from equipoise.io.toml.key_types import Name, NotNegative, Positive, Table, Triple


class ReactionWheel(Table):
    """A rotor with a fixed axis; its inertia is the greatest momentum by the greatest speed."""

    name: Name
    axis: Triple
    max_momentum_N_m_s: Positive = Field(description="at the greatest speed")
    max_speed_rpm: Positive = Field(description="against the platform")
    max_torque_N_m: Positive
    speed_rpm: float = Field(0.0, description="at the start")
    speed_noise_rpm: NotNegative = Field(0.0, description="one sd of a tachometer row")
    lag_ms: NotNegative = Field(0.0, description="first-order, from what is asked to the torque")


class ControlMomentGyro(Table):
    """A rotor of constant momentum whose axis turns about a gimbal."""

    name: Name
    gimbal_axis: Triple
    spin_axis: Triple = Field(description="at angle zero; at right angles to the gimbal axis")
    momentum_N_m_s: Positive
    max_rate_deg_s: Positive
    angle_deg: float = Field(0.0, description="at the start")
    angle_noise_deg: NotNegative = Field(0.0, description="one sd of an encoder row")
    lag_ms: NotNegative = Field(0.0, description="first-order, from what is asked to the rate")
    gimbal_inertia_kg_m2: NotNegative = Field(
        0.0, description="of all that turns with the gimbal, about the gimbal axis"
    )
    asymmetry_kg_m2: float = Field(
        0.0, description="inertia of the same about the spin axis less about the third axis"
    )


class Magnetorquer(Table):
    """A coil or rod."""

    name: Name
    axis: Triple
    max_dipole_A_m2: Positive
    lag_ms: NotNegative = Field(0.0, description="first-order, from what is asked to the dipole")


class JetPair(Table):
    """On-off jets that give a pure torque about an axis, either way."""

    name: Name
    axis: Triple
    torque_N_m: Positive = Field(description="while on")
    min_pulse_ms: NotNegative = 0.0
    lag_ms: NotNegative = Field(0.0, description="first-order, from the valve to the torque")


class MagneticField(Table):
    """The field in the laboratory, uniform; of a Helmholtz cage, say."""

    field_uT: Triple = Field(description="laboratory axes, z up")
    noise_uT: Positive | None = Field(
        None, description="one sd per axis of a magnetometer's row; left out: there is none"
    )
