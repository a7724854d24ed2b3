"""The ``[truth]`` table, in SI: what the simulated bench is made of."""

import math

import numpy as np

from equipoise.io.testbed import testbed_schema as schema
from equipoise.io.testbed.defects_build import (
    camera_errors_of,
    com_steps_of,
    contacts_of,
    gaps_of,
    gyro_errors_of,
)
from equipoise.io.testbed.inertia_check import check_inertia
from equipoise.io.toml.unit_vectors import unit_vector
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.errors import InputError, nearest
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.testbed import Fault, TrueDrive, Truth
from equipoise.model.torque_terms import GROUPS

UM, MM, UT, PERCENT, DEG = 1e-6, 1e-3, 1e-6, 1e-2, math.pi / 180
# Key of the file, group of terms, factor to SI.
TORQUES = (
    ("viscous_N_m_s", "viscous", 1.0),
    ("quadratic_N_m_s2", "quadratic", 1.0),
    ("constant_N_m", "constant", 1.0),
    ("swirl_N_m", "swirl", 1.0),
    ("sag_um", "sag", UM),
    ("drift_um_min", "drift", UM / 60),
)
BOX = 2.0  # sd on either side of the guess, when the file gives no box (chosen: 95 %)
SLIP = 0.5  # share of the way that a slipping mass goes if the file does not say (chosen)


def truth_of(table: schema.TestbedFile, guess: MassProperties, where: str) -> Truth | None:
    """Return the truth, or None for a testbed that is not simulated."""
    truth = table.truth
    if truth is None:
        return None
    if truth.field_uT is not None and table.magnetic_field is None:
        wanted = "a table [magnetic_field] with the field as known beforehand"
        raise InputError(f"{where}.field_uT", "a true field but none that is known", wanted)
    com = _scaled(truth.com_um, UM)
    low, high = _box(truth, table.platform, where)
    return Truth(
        com=com,
        com_low=low,
        com_high=high,
        inertia_P=_inertia(truth, table.platform, guess.com if com is None else com, where),
        inertia_error=truth.inertia_error_percent * PERCENT,
        attitude=_scaled(truth.attitude_deg, DEG),
        tilt=truth.tilt_deg * DEG,
        rate=_scaled(truth.rate_deg_s, DEG),
        rate_limit=truth.rate_limit_deg_s * DEG,
        torque=_torque(truth),
        noise_torque=truth.noise_torque_N_m,
        noise_correlation=truth.noise_correlation_s,
        gyro_bias=np.array(truth.gyro_bias_deg_s, float) * DEG,
        faults=_faults(table, truth, where),
        mass_lag=truth.mass_lag_s,
        contacts=contacts_of(truth),
        com_steps=com_steps_of(truth),
        gaps=gaps_of(truth, where),
        camera=camera_errors_of(truth),
        gyro=gyro_errors_of(truth),
        field_N=_scaled(truth.field_uT, UT),
        drives=_drives(table, truth, where),
    )


def _scaled(values: list[float] | None, unit: float) -> Vector3 | None:
    return None if values is None else np.array(values, float) * unit


def _box(truth: schema.Truth, platform: schema.Platform, where: str) -> tuple[Vector3, Vector3]:
    guess, sd = np.array(platform.com_um, float), np.array(platform.com_sd_um, float)
    low = guess - BOX * sd if truth.com_low_um is None else np.array(truth.com_low_um, float)
    high = guess + BOX * sd if truth.com_high_um is None else np.array(truth.com_high_um, float)
    if np.any(low > high):
        found = f"{low.tolist()} above com_high_um = {high.tolist()}"
        raise InputError(f"{where}.com_low_um", found, "the lower corner of the box, in um")
    return low * UM, high * UM


def _inertia(
    truth: schema.Truth, platform: schema.Platform, com: Vector3, where: str
) -> Matrix3 | None:
    """Return the true inertia about P; it is given about the same point as the platform's."""
    if truth.inertia_kg_m2 is None:
        return None
    inertia = np.array(truth.inertia_kg_m2, float)
    check_inertia(inertia, f"{where}.inertia_kg_m2")
    if platform.about == "P":
        return inertia
    return from_centre(platform.mass_kg, com, inertia).inertia_P


def _torque(truth: schema.Truth) -> dict[str, float]:
    found: dict[str, float] = {}
    for key, group, unit in TORQUES:
        value: float | list[float] | None = getattr(truth, key)
        if value is not None:
            coefficients = np.atleast_1d(np.array(value, float) * unit)
            found.update(zip(GROUPS[group], map(float, coefficients), strict=True))
    return found


def _faults(table: schema.TestbedFile, truth: schema.Truth, where: str) -> tuple[Fault, ...]:
    return tuple(
        _fault(fault, f"{where}.fault[{i + 1}]", table) for i, fault in enumerate(truth.fault)
    )


def _known(name: str, table: schema.TestbedFile, where: str) -> str:
    """Return the name of a mass that there is."""
    known = [mass.name for mass in table.sliding_mass]
    if name not in known:
        wanted = nearest(name, known) if known else "a testbed with sliding masses"
        raise InputError(f"{where}.mass", f"'{name}'", wanted)
    return name


def _drives(table: schema.TestbedFile, truth: schema.Truth, where: str) -> tuple[TrueDrive, ...]:
    found: dict[str, TrueDrive] = {}
    for i, drive in enumerate(truth.drive):
        here = f"{where}.drive[{i + 1}]"
        name = _known(drive.mass, table, here)
        if name in found:
            raise InputError(f"{here}.mass", f"a second '{name}'", "one table for each mass")
        found[name] = _drive(drive, here)
    return tuple(found.values())


def _drive(drive: schema.Drive, where: str) -> TrueDrive:
    axis = None if drive.axis is None else unit_vector(drive.axis, f"{where}.axis")
    backlash = None if drive.backlash_mm is None else drive.backlash_mm * MM
    accuracy = None if drive.accuracy_mm is None else drive.accuracy_mm * MM
    return TrueDrive(drive.mass, drive.gain, axis, backlash, accuracy)


def _fault(fault: schema.Fault, where: str, table: schema.TestbedFile) -> Fault:
    _known(fault.mass, table, where)
    if fault.kind == "stuck":
        if fault.gain:
            raise InputError(f"{where}.gain", f"{fault.gain:g}", "no gain for a stuck mass")
        return Fault(fault.mass, 0.0, fault.from_move)
    gain = SLIP if fault.gain is None else fault.gain
    return Fault(fault.mass, gain, fault.from_move)
