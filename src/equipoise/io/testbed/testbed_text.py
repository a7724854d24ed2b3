"""A testbed as the text of its file: the way back from ``testbed_build``."""

import json
import math

from equipoise.io.testbed.devices_text import text_of_devices
from equipoise.io.testbed.hardware_text import text_of_hardware
from equipoise.io.testbed.truth_text import text_of_truth
from equipoise.io.testbed.weights_text import text_of_weights
from equipoise.io.toml.write_toml import Value, number, numbers, table
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed

PER_UM, PER_MM, PER_MS, PER_GRAM = 1e6, 1e3, 1e3, 1e3
PER_PERCENT, PER_DEG = 1e2, 180 / math.pi
# A density is written as noise per sample, and what is assumed of it goes along.
WRITTEN_AS = {"sensor.gyro.noise_density_deg_s_rthz": "sensor.gyro.noise_deg_s"}


def text_of_testbed(testbed: Testbed) -> str:
    """Return TOML that reads back as the same testbed (to the 15th digit)."""
    assumed = {json.dumps(WRITTEN_AS.get(k, k)): why for k, why in testbed.assumed.items()}
    parts = [
        table("", {"name": testbed.name}),
        table("[platform]", _platform(testbed)),
        *(table("[[sliding_mass]]", _mass(mass)) for mass in testbed.masses),
        text_of_devices(testbed),
        text_of_weights(testbed),
        table("[sensor.attitude]", _attitude(testbed.attitude)),
        table("[sensor.gyro]", _gyro(testbed.gyro)),
        table("[disturbance]", {"consider": list(testbed.disturbances)}),
        text_of_hardware(testbed.hardware),
        text_of_truth(testbed.truth),
        table("[assumed]", assumed),
    ]
    return "\n".join(filter(None, parts))


def _platform(testbed: Testbed) -> dict[str, Value]:
    return {
        "mass_kg": number(testbed.body.mass),
        "inertia_kg_m2": [numbers(row) for row in testbed.body.inertia_P],
        "inertia_sd_percent": number(testbed.inertia_sd, PER_PERCENT),
        "about": "P",
        "com_um": numbers(testbed.body.com, PER_UM),
        "com_sd_um": numbers(testbed.com_sd, PER_UM),
        "up": numbers(testbed.up),
        "tilt_limit_deg": number(testbed.tilt_limit, PER_DEG),
        "gravity_m_s2": number(testbed.gravity),
    }


def _mass(mass: SlidingMass) -> dict[str, Value]:
    return {
        "name": mass.name,
        "mass_g": number(mass.mass, PER_GRAM),
        "home_mm": numbers(mass.home, PER_MM),
        "axis": numbers(mass.axis),
        "travel_mm": numbers(mass.travel, PER_MM),
        "resolution_mm": number(mass.resolution, PER_MM),
        "accuracy_mm": number(mass.accuracy, PER_MM),
        "backlash_mm": number(mass.backlash, PER_MM),
        "speed_mm_s": number(mass.speed, PER_MM),
        "lag_sd_ms": number(mass.lag_sd, PER_MS),
        "sag_sd_mm": number(mass.sag_sd, PER_MM),
        "gain": number(mass.gain),
    }


def _attitude(sensor: AttitudeSensor | None) -> dict[str, Value]:
    if sensor is None:
        return {}
    return {
        "rate_hz": number(sensor.rate),
        "noise_deg": number(sensor.noise, PER_DEG),
        "delay_s": number(sensor.delay),
        "averaging_s": number(sensor.averaging),
        "quantum_deg": number(sensor.quantum, PER_DEG),
        "plumb_sd_deg": number(sensor.plumb_sd, PER_DEG),
    }


def _gyro(sensor: Gyro | None) -> dict[str, Value]:
    if sensor is None:
        return {}
    return {
        "rate_hz": number(sensor.rate),
        "noise_deg_s": number(sensor.noise, PER_DEG),
        "bias_sd_deg_s": number(sensor.bias_sd, PER_DEG),
        "delay_s": number(sensor.delay),
        "averaging_s": number(sensor.averaging),
        "quantum_deg_s": number(sensor.quantum, PER_DEG),
    }
