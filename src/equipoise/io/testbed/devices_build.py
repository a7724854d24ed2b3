"""A testbed file's wheels, gyros, magnetorquers, jets and field, checked and in SI."""

import math
from typing import NamedTuple

import numpy as np

from equipoise.io.testbed import devices as schema
from equipoise.io.testbed.testbed_schema import TestbedFile
from equipoise.io.toml.unit_vectors import square_axis, unit_vector
from equipoise.model.devices import (
    ControlMomentGyro,
    JetPair,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
)
from equipoise.model.errors import InputError

UT, MS, RPM, DEG = 1e-6, 1e-3, math.pi / 30, math.pi / 180
KINDS = ("reaction_wheel", "control_moment_gyro", "magnetorquer", "jet_pair")


class Devices(NamedTuple):
    """All that turns the platform without moving its centre of mass."""

    wheels: tuple[ReactionWheel, ...]
    cmgs: tuple[ControlMomentGyro, ...]
    magnetorquers: tuple[Magnetorquer, ...]
    jets: tuple[JetPair, ...]
    magnetic_field: MagneticField | None


def devices_of(table: TestbedFile, source: str) -> Devices:
    """Return the devices; InputError for two of one name or coils without a field."""
    _check_names(table, source)
    if table.magnetorquer and table.magnetic_field is None:
        wanted = "a table [magnetic_field] with field_uT, in laboratory axes"
        raise InputError(f"{source}: magnetorquer", "magnetorquers but no magnetic field", wanted)
    wheels, gyros = enumerate(table.reaction_wheel, 1), enumerate(table.control_moment_gyro, 1)
    coils, jets = enumerate(table.magnetorquer, 1), enumerate(table.jet_pair, 1)
    return Devices(
        tuple(_wheel(each, f"{source}: reaction_wheel[{i}]") for i, each in wheels),
        tuple(_gyro(each, f"{source}: control_moment_gyro[{i}]") for i, each in gyros),
        tuple(_magnetorquer(each, f"{source}: magnetorquer[{i}]") for i, each in coils),
        tuple(_jet(each, f"{source}: jet_pair[{i}]") for i, each in jets),
        _field(table.magnetic_field, f"{source}: magnetic_field"),
    )


def _check_names(table: TestbedFile, source: str) -> None:
    """Devices are driven by name, so all kinds share one list of names."""
    owners: dict[str, str] = {}
    for kind in KINDS:
        for i, device in enumerate(getattr(table, kind)):
            owner = f"{kind}[{i + 1}]"
            if device.name in owners:
                found = f"'{device.name}', the name of {owners[device.name]}"
                raise InputError(f"{source}: {owner}.name", found, "a name that no device has yet")
            owners[device.name] = owner


def _wheel(wheel: schema.ReactionWheel, where: str) -> ReactionWheel:
    if abs(wheel.speed_rpm) > wheel.max_speed_rpm:
        wanted = f"at most max_speed_rpm = {wheel.max_speed_rpm:g} either way"
        raise InputError(f"{where}.speed_rpm", f"{wheel.speed_rpm:g}", wanted)
    max_speed = wheel.max_speed_rpm * RPM
    return ReactionWheel(
        name=wheel.name,
        axis=unit_vector(wheel.axis, f"{where}.axis"),
        inertia=wheel.max_momentum_N_m_s / max_speed,
        max_speed=max_speed,
        max_torque=wheel.max_torque_N_m,
        speed=wheel.speed_rpm * RPM,
        speed_noise=wheel.speed_noise_rpm * RPM,
        lag=wheel.lag_ms * MS,
    )


def _gyro(gyro: schema.ControlMomentGyro, where: str) -> ControlMomentGyro:
    gimbal = unit_vector(gyro.gimbal_axis, f"{where}.gimbal_axis")
    return ControlMomentGyro(
        name=gyro.name,
        gimbal_axis=gimbal,
        spin_axis=square_axis(gyro.spin_axis, gimbal, f"{where}.spin_axis", "gimbal axis"),
        momentum=gyro.momentum_N_m_s,
        max_rate=gyro.max_rate_deg_s * DEG,
        angle=gyro.angle_deg * DEG,
        angle_noise=gyro.angle_noise_deg * DEG,
        lag=gyro.lag_ms * MS,
        gimbal_inertia=gyro.gimbal_inertia_kg_m2,
        asymmetry=gyro.asymmetry_kg_m2,
    )


def _magnetorquer(coil: schema.Magnetorquer, where: str) -> Magnetorquer:
    axis = unit_vector(coil.axis, f"{where}.axis")
    return Magnetorquer(coil.name, axis, coil.max_dipole_A_m2, coil.lag_ms * MS)


def _jet(jet: schema.JetPair, where: str) -> JetPair:
    axis = unit_vector(jet.axis, f"{where}.axis")
    return JetPair(jet.name, axis, jet.torque_N_m, jet.min_pulse_ms * MS, jet.lag_ms * MS)


def _field(field: schema.MagneticField | None, where: str) -> MagneticField | None:
    if field is None:
        return None
    if not any(field.field_uT):
        raise InputError(f"{where}.field_uT", "a field of zero", "the field, in laboratory axes")
    noise = None if field.noise_uT is None else field.noise_uT * UT
    return MagneticField(np.array(field.field_uT, float) * UT, noise)
