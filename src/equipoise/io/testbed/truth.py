"""The ``[truth]`` table: what the simulated bench is made of, and its record in SI."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from equipoise.io.testbed.inertia_check import check_inertia
from equipoise.io.testbed.platform import Platform
from equipoise.io.testbed.table_top import TrueTable
from equipoise.io.testbed.true_modes import TrueMode
from equipoise.io.testbed.true_surroundings import TrueCoilPair, TrueLamp
from equipoise.io.toml.key_types import (
    Direction,
    Five,
    Holds,
    Inertia,
    NotNegative,
    Pair,
    Positive,
    Triple,
)
from equipoise.io.toml.table_records import RecordTable, record_of, records_of
from equipoise.io.toml.units import key_factor
from equipoise.model import defects
from equipoise.model import testbed as model
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.errors import InputError, nearest
from equipoise.model.mass_properties import from_centre
from equipoise.model.torque_terms import GROUPS

# Key of the file: group of terms.
TORQUES = {
    "viscous_N_m_s": "viscous",
    "quadratic_N_m_s2": "quadratic",
    "constant_N_m": "constant",
    "swirl_N_m": "swirl",
    "sag_um": "sag",
    "drift_um_min": "drift",
    "thermal_um_K": "thermal",
}
BOX = 2.0  # sd on either side of the guess, when the file gives no box (chosen: 95 %)
ZEROS = [0.0, 0.0, 0.0]
SLIP = 0.5  # share of the way that a slipping mass goes if the file does not say (chosen)


class Fault(RecordTable):
    """A mass that does not follow its commands."""

    mass: str
    kind: Literal["stuck", "slip"] = "stuck"
    gain: float | None = Field(
        None, description="slip: fraction of the distance actually travelled"
    )
    from_move: Annotated[int, Field(ge=1)] = 1

    def record(self, where: str) -> model.Fault:
        """Return the fault."""
        if self.kind == "stuck" and self.gain:
            raise InputError(f"{where}.gain", f"{self.gain:g}", "no gain for a stuck mass")
        slip = SLIP if self.gain is None else self.gain
        gain = 0.0 if self.kind == "stuck" else slip
        return record_of(model.Fault, self, where, gain=gain)

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return the kind of fault."""
        return {"kind": "slip" if record.gain else "stuck", "gain": record.gain or None}


class Drive(RecordTable):
    """What a mass's drive really is, all its life; what is left out is as the testbed states it.

    Nothing here is relative to what is stated, so that it stays true when that is calibrated.
    """

    KIND = model.TrueDrive

    mass: str
    gain: Positive | None = Field(None, description="as the mass's key")
    axis: Direction | None = Field(None, description="direction of the rail, body axes")
    backlash_mm: NotNegative | None = None
    accuracy_mm: NotNegative | None = Field(
        None, description="standard deviation of its actual stops"
    )


class Contact(RecordTable):
    """The platform touches something for a moment."""

    KIND = defects.Contact

    time_s: Positive
    impulse_N_m_s: Triple = Field(description="about the centre of rotation, laboratory axes")


class ComStep(RecordTable):
    """A part slips, once."""

    KIND = defects.ComStep

    time_s: Positive
    com_um: Annotated[Triple, Holds("shift")] = Field(
        description="shift of the total centre of mass, body axes"
    )


class Gap(RecordTable):
    """Rows of camera and gyro that are missing, both ends included."""

    start_s: NotNegative
    end_s: Positive

    def record(self, where: str) -> defects.Gap:
        """Return the gap, which must end after it starts."""
        if not self.start_s < self.end_s:
            found = f"{self.end_s:g} s, but the gap starts at {self.start_s:g} s"
            raise InputError(f"{where}.end_s", found, "a later time")
        return record_of(defects.Gap, self, where)


class Truth(RecordTable):
    """What the simulated bench is made of; read by the simulator alone."""

    com_um: Triple | None = None
    com_low_um: Triple | None = None
    com_high_um: Triple | None = None
    inertia_kg_m2: Annotated[Inertia | None, Holds("inertia_P")] = Field(
        None,
        description=(
            "about the platform's reference point; in either form of the platform's inertia"
        ),
    )
    inertia_error_percent: Annotated[float, Field(ge=0, lt=100)] = 0.0
    attitude_deg: Triple | None = Field(None, description="roll, pitch, yaw (3-2-1)")
    tilt_deg: Annotated[float, Field(ge=0, le=180)] = 3.0
    rate_deg_s: Triple | None = None
    rate_limit_deg_s: NotNegative = 0.5
    viscous_N_m_s: Triple | None = None
    quadratic_N_m_s2: float | None = None
    constant_N_m: Triple | None = None
    swirl_N_m: float | None = None
    sag_um: Five | None = Field(None, description="xx, yy, xy, xz, yz")
    drift_um_min: Triple | None = None
    thermal_um_K: Triple | None = Field(
        None, description="shift of the centre of mass per kelvin of temperature rise by the lamp"
    )
    noise_torque_N_m: NotNegative = 0.0
    noise_correlation_s: Positive = 30.0
    gyro_bias_deg_s: Triple = Field(ZEROS)
    accelerometer_bias_m_s2: Triple = Field(ZEROS)
    magnetometer_bias_uT: Triple = Field(ZEROS)
    accelerometer_mounting_deg: Triple = Field(
        ZEROS, description="rotation vector from body axes to the accelerometer's"
    )
    sun_mounting_deg: Triple = Field(ZEROS)
    magnetometer_mounting_deg: Triple = Field(ZEROS)
    gyro_scale_percent: Annotated[Triple, Holds("gyro.scale")] = Field(
        ZEROS, description="bias of each axis"
    )
    gyro_misalignment_deg: Annotated[Triple, Holds("gyro.turn")] = Field(
        ZEROS, description="rotation vector from body axes to the gyro's"
    )
    plumb_deg: Annotated[Pair, Holds("camera.plumb")] = Field(
        [0.0, 0.0], description="inclination of measured attitudes about laboratory x and y"
    )
    heading2_cos_deg: Annotated[Triple, Holds("camera.heading_cos")] = Field(
        ZEROS, description="rotation of the measured attitude, times cos(2 heading); body"
    )
    heading2_sin_deg: Annotated[Triple, Holds("camera.heading_sin")] = Field(
        ZEROS, description="rotation of the measured attitude, times sin(2 heading); body"
    )
    bad_rows_percent: Annotated[float, Field(ge=0, le=100), Holds("camera.bad_share")] = Field(
        0.0, description="fraction of outliers among the camera's rows"
    )
    bad_row_deg: Annotated[float, Field(ge=0, le=180), Holds("camera.bad_turn")] = Field(
        10.0, description="rotation of an outlier about any axis; default: well outside any noise"
    )
    mass_lag_s: NotNegative = Field(0.0, description="delay of the masses behind their report")
    field_uT: Annotated[Triple | None, Holds("field_N")] = Field(
        None,
        description="true magnetic field, laboratory axes; with a coil cage, without its field",
    )
    fault: Annotated[list[Fault], Holds("faults")] = Field([])
    drive: Annotated[list[Drive], Holds("drives")] = Field([])
    contact: Annotated[list[Contact], Holds("contacts")] = Field([])
    com_step: Annotated[list[ComStep], Holds("com_steps")] = Field([])
    gap: Annotated[list[Gap], Holds("gaps")] = Field([])
    coil_pair: Annotated[list[TrueCoilPair], Holds("cage")] = Field([])
    lamp: TrueLamp | None = None
    mode: Annotated[list[TrueMode], Holds("modes")] = Field([])
    table: TrueTable | None = None

    @classmethod
    def more_keys(cls, record: Any) -> Mapping[str, Any]:
        """Return the torques by group, and the plumb without its turn about the vertical."""
        found: dict[str, Any] = {"plumb_deg": record.camera.plumb[:2]}
        for key, group in TORQUES.items():
            terms = [record.torque.get(term, 0.0) for term in GROUPS[group]]
            is_given = any(term in record.torque for term in GROUPS[group])
            found[key] = (terms if len(terms) > 1 else terms[0]) if is_given else None
        return found

    def record(self, where: str, **of_platform: Any) -> model.Truth:
        """Return the truth, given ``com_low``, ``com_high`` and ``inertia_P`` (m, kg m^2)."""
        plumb = np.array([*self.plumb_deg, 0.0]) * key_factor("plumb_deg")
        contacts = records_of(self.contact, f"{where}.contact")
        com_steps = records_of(self.com_step, f"{where}.com_step")
        return record_of(
            model.Truth,
            self,
            where,
            torque=_torque(self),
            contacts=tuple(sorted(contacts, key=lambda each: each.time)),
            com_steps=tuple(sorted(com_steps, key=lambda each: each.time)),
            camera=record_of(defects.CameraErrors, self, where, within="camera", plumb=plumb),
            gyro=record_of(defects.GyroErrors, self, where, within="gyro"),
            **of_platform,
        )


def truth_of(truth: Truth, platform: Platform, com: Vector3, where: str) -> model.Truth:
    """Return the truth of a platform whose centre of mass (m, masses at home) is guessed."""
    low, high = _box(truth, platform, where)
    if truth.com_um is not None:
        com = np.array(truth.com_um) * key_factor("com_um")
    inertia = _inertia(truth, platform, com, f"{where}.inertia_kg_m2")
    return truth.record(where, com_low=low, com_high=high, inertia_P=inertia)


def check_true_drives(truth: Truth, masses: Sequence[str], where: str) -> None:
    """Raise InputError for a fault or drive of no mass, or a second drive of one."""
    for i, fault in enumerate(truth.fault, 1):
        _check_known(fault.mass, masses, f"{where}.fault[{i}]")
    names = [drive.mass for drive in truth.drive]
    for i, name in enumerate(names):
        here = f"{where}.drive[{i + 1}]"
        _check_known(name, masses, here)
        if name in names[:i]:
            raise InputError(f"{here}.mass", f"a second '{name}'", "one table for each mass")


def _check_known(name: str, masses: Sequence[str], where: str) -> None:
    if name not in masses:
        wanted = nearest(name, list(masses)) if masses else "a testbed with sliding masses"
        raise InputError(f"{where}.mass", f"'{name}'", wanted)


def _box(truth: Truth, platform: Platform, where: str) -> tuple[Vector3, Vector3]:
    """Return the corners (m) between which the centre of mass is drawn."""
    guess, sd = np.array(platform.com_um), np.array(platform.com_sd_um)
    low = guess - BOX * sd if truth.com_low_um is None else np.array(truth.com_low_um)
    high = guess + BOX * sd if truth.com_high_um is None else np.array(truth.com_high_um)
    if np.any(low > high):
        found = f"{low.tolist()} above com_high_um = {high.tolist()}"
        raise InputError(f"{where}.com_low_um", found, "the lower corner of the box, in um")
    return low * key_factor("com_low_um"), high * key_factor("com_high_um")


def _inertia(truth: Truth, platform: Platform, com: Vector3, where: str) -> Matrix3 | None:
    """Return the true inertia about P; it is given about the same point as the platform's."""
    if truth.inertia_kg_m2 is None:
        return None
    inertia = np.array(truth.inertia_kg_m2)
    check_inertia(inertia, where)
    if platform.about == "P":
        return inertia
    return from_centre(platform.mass_kg, com, inertia).inertia_P


def _torque(truth: Truth) -> dict[str, float]:
    found: dict[str, float] = {}
    for key, group in TORQUES.items():
        value: float | list[float] | None = getattr(truth, key)
        if value is not None:
            coefficients = np.atleast_1d(np.array(value, float) * key_factor(key))
            found.update(zip(GROUPS[group], map(float, coefficients), strict=True))
    return found
