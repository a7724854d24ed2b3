"""Wheels, gyros, magnetorquers, jets and field as text: the way back from ``devices_build``."""

import math

from equipoise.io.toml.write_toml import Value, number, numbers, table
from equipoise.model.devices import (
    ControlMomentGyro,
    JetPair,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.model.testbed import Testbed

PER_UT, PER_MS, PER_RPM, PER_DEG = 1e6, 1e3, 30 / math.pi, 180 / math.pi


def text_of_devices(testbed: Testbed) -> str:
    """Return a table for each device, and the field's."""
    tables = (
        *(table("[[reaction_wheel]]", _wheel(wheel)) for wheel in testbed.wheels),
        *(table("[[control_moment_gyro]]", _gyro(gyro)) for gyro in testbed.cmgs),
        *(table("[[magnetorquer]]", _magnetorquer(coil)) for coil in testbed.magnetorquers),
        *(table("[[jet_pair]]", _jet(jet)) for jet in testbed.jets),
        table("[magnetic_field]", _field(testbed.magnetic_field)),
    )
    return "\n".join(filter(None, tables))


def _wheel(wheel: ReactionWheel) -> dict[str, Value]:
    return {
        "name": wheel.name,
        "axis": numbers(wheel.axis),
        "max_momentum_N_m_s": number(wheel.inertia * wheel.max_speed),
        "max_speed_rpm": number(wheel.max_speed, PER_RPM),
        "max_torque_N_m": number(wheel.max_torque),
        "speed_rpm": number(wheel.speed, PER_RPM),
        "speed_noise_rpm": number(wheel.speed_noise, PER_RPM),
        "lag_ms": number(wheel.lag, PER_MS),
    }


def _gyro(gyro: ControlMomentGyro) -> dict[str, Value]:
    return {
        "name": gyro.name,
        "gimbal_axis": numbers(gyro.gimbal_axis),
        "spin_axis": numbers(gyro.spin_axis),
        "momentum_N_m_s": number(gyro.momentum),
        "max_rate_deg_s": number(gyro.max_rate, PER_DEG),
        "angle_deg": number(gyro.angle, PER_DEG),
        "angle_noise_deg": number(gyro.angle_noise, PER_DEG),
        "lag_ms": number(gyro.lag, PER_MS),
        "gimbal_inertia_kg_m2": number(gyro.gimbal_inertia),
        "asymmetry_kg_m2": number(gyro.asymmetry),
    }


def _magnetorquer(coil: Magnetorquer) -> dict[str, Value]:
    return {
        "name": coil.name,
        "axis": numbers(coil.axis),
        "max_dipole_A_m2": number(coil.max_dipole),
        "lag_ms": number(coil.lag, PER_MS),
    }


def _jet(jet: JetPair) -> dict[str, Value]:
    return {
        "name": jet.name,
        "axis": numbers(jet.axis),
        "torque_N_m": number(jet.torque),
        "min_pulse_ms": number(jet.min_pulse, PER_MS),
        "lag_ms": number(jet.lag, PER_MS),
    }


def _field(field: MagneticField | None) -> dict[str, Value]:
    if field is None:
        return {}
    noise: dict[str, Value] = {}
    if field.noise is not None:
        noise["noise_uT"] = number(field.noise, PER_UT)
    return {"field_uT": numbers(field.field_N, PER_UT), **noise}
