"""The ``[truth]`` table as text: the way back from ``truth_build`` and ``defects_build``."""

import math
from collections.abc import Mapping

from equipoise.io.testbed.truth import TORQUES
from equipoise.io.toml.write_toml import Value, number, numbers, table
from equipoise.model.defects import CameraErrors, ComStep, Contact, Gap, GyroErrors
from equipoise.model.testbed import Fault, TrueDrive, Truth
from equipoise.model.torque_terms import GROUPS

PER_UM, PER_MM, PER_UT, PER_PERCENT, PER_DEG = 1e6, 1e3, 1e6, 1e2, 180 / math.pi


def text_of_truth(truth: Truth | None) -> str:
    """Return the table of the truth and its lists, or nothing."""
    if truth is None:
        return ""
    keys: dict[str, Value] = {
        "com_low_um": numbers(truth.com_low, PER_UM),
        "com_high_um": numbers(truth.com_high, PER_UM),
        "inertia_error_percent": number(truth.inertia_error, PER_PERCENT),
        "tilt_deg": number(truth.tilt, PER_DEG),
        "rate_limit_deg_s": number(truth.rate_limit, PER_DEG),
        "noise_torque_N_m": number(truth.noise_torque),
        "noise_correlation_s": number(truth.noise_correlation),
        "gyro_bias_deg_s": numbers(truth.gyro_bias, PER_DEG),
        "mass_lag_s": number(truth.mass_lag),
    }
    keys |= _known(truth) | _torque(truth.torque) | _gyro(truth.gyro) | _camera(truth.camera)
    return "\n".join([table("[truth]", keys), *_lists(truth)])


def _lists(truth: Truth) -> list[str]:
    """Return a table for each thing that may happen more than once."""
    return [
        *(table("[[truth.fault]]", _fault(each)) for each in truth.faults),
        *(table("[[truth.drive]]", _drive(each)) for each in truth.drives),
        *(table("[[truth.contact]]", _contact(each)) for each in truth.contacts),
        *(table("[[truth.com_step]]", _com_step(each)) for each in truth.com_steps),
        *(table("[[truth.gap]]", _gap(each)) for each in truth.gaps),
    ]


def _drive(drive: TrueDrive) -> dict[str, Value]:
    keys: dict[str, Value] = {"mass": drive.mass}
    if drive.axis is not None:
        keys["axis"] = numbers(drive.axis)
    reported = (("gain", drive.gain, 1.0), ("backlash_mm", drive.backlash, PER_MM),
            ("accuracy_mm", drive.accuracy, PER_MM))  # fmt: skip
    return keys | {key: number(value, unit) for key, value, unit in reported if value is not None}


def _contact(contact: Contact) -> dict[str, Value]:
    return {"time_s": number(contact.time), "impulse_N_m_s": numbers(contact.impulse)}


def _com_step(step: ComStep) -> dict[str, Value]:
    return {"time_s": number(step.time), "com_um": numbers(step.shift, PER_UM)}


def _gap(gap: Gap) -> dict[str, Value]:
    return {"start_s": number(gap.start), "end_s": number(gap.end)}


def _gyro(errors: GyroErrors) -> dict[str, Value]:
    return {
        "gyro_scale_percent": numbers(errors.scale, PER_PERCENT),
        "gyro_misalignment_deg": numbers(errors.turn, PER_DEG),
    }


def _camera(errors: CameraErrors) -> dict[str, Value]:
    return {
        "plumb_deg": numbers(errors.plumb[:2], PER_DEG),
        "heading2_cos_deg": numbers(errors.heading_cos, PER_DEG),
        "heading2_sin_deg": numbers(errors.heading_sin, PER_DEG),
        "bad_rows_percent": number(errors.bad_share, PER_PERCENT),
        "bad_row_deg": number(errors.bad_turn, PER_DEG),
    }


def _known(truth: Truth) -> dict[str, Value]:
    """Return what is given and not drawn."""
    keys: dict[str, Value] = {}
    if truth.com is not None:
        keys["com_um"] = numbers(truth.com, PER_UM)
    if truth.inertia_P is not None:
        keys["inertia_kg_m2"] = [numbers(row) for row in truth.inertia_P]
    if truth.attitude is not None:
        keys["attitude_deg"] = numbers(truth.attitude, PER_DEG)
    if truth.rate is not None:
        keys["rate_deg_s"] = numbers(truth.rate, PER_DEG)
    if truth.field_N is not None:
        keys["field_uT"] = numbers(truth.field_N, PER_UT)
    return keys


def _torque(torque: Mapping[str, float]) -> dict[str, Value]:
    keys: dict[str, Value] = {}
    for key, group, unit in TORQUES:
        if any(term in torque for term in GROUPS[group]):
            values = [number(torque.get(term, 0.0), 1 / unit) for term in GROUPS[group]]
            keys[key] = values if len(values) > 1 else values[0]
    return keys


def _fault(fault: Fault) -> dict[str, Value]:
    kind: dict[str, Value] = {"kind": "slip", "gain": number(fault.gain)}
    return {"mass": fault.mass, **(kind if fault.gain else {"kind": "stuck"})} | {
        "from_move": fault.from_move
    }
