"""Defects of the ``[truth]`` table, in SI: contacts, slips, gaps, errors of camera and gyro."""

import math

import numpy as np

from equipoise.io.testbed import testbed_schema as schema
from equipoise.model.arrays import Vector3
from equipoise.model.defects import CameraErrors, ComStep, Contact, Gap, GyroErrors
from equipoise.model.errors import InputError

UM, PERCENT, DEG = 1e-6, 1e-2, math.pi / 180


def _vector(values: list[float], unit: float = 1.0) -> Vector3:
    return np.array(values, float) * unit


def contacts_of(truth: schema.Truth) -> tuple[Contact, ...]:
    """Return the contacts, in order of time."""
    found = [Contact(each.time_s, _vector(each.impulse_N_m_s)) for each in truth.contact]
    return tuple(sorted(found, key=lambda each: each.time))


def com_steps_of(truth: schema.Truth) -> tuple[ComStep, ...]:
    """Return the slips, in order of time."""
    found = [ComStep(each.time_s, _vector(each.com_um, UM)) for each in truth.com_step]
    return tuple(sorted(found, key=lambda each: each.time))


def gaps_of(truth: schema.Truth, where: str) -> tuple[Gap, ...]:
    """Return the gaps; InputError for one that ends before it starts."""
    for i, each in enumerate(truth.gap):
        if not each.start_s < each.end_s:
            found = f"{each.end_s:g} s, but the gap starts at {each.start_s:g} s"
            raise InputError(f"{where}.gap[{i + 1}].end_s", found, "a later time")
    return tuple(Gap(each.start_s, each.end_s) for each in truth.gap)


def camera_errors_of(truth: schema.Truth) -> CameraErrors:
    """Return what is wrong with the camera."""
    return CameraErrors(
        plumb=_vector([*truth.plumb_deg, 0.0], DEG),
        heading_cos=_vector(truth.heading2_cos_deg, DEG),
        heading_sin=_vector(truth.heading2_sin_deg, DEG),
        bad_share=truth.bad_rows_percent * PERCENT,
        bad_turn=truth.bad_row_deg * DEG,
    )


def gyro_errors_of(truth: schema.Truth) -> GyroErrors:
    """Return what is wrong with the gyro, its bias apart."""
    scale = _vector(truth.gyro_scale_percent, PERCENT)
    return GyroErrors(scale, _vector(truth.gyro_misalignment_deg, DEG))
