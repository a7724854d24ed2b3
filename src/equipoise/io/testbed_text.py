"""A testbed as the text of its file: the way back from ``testbed_build``."""

import json
import math
from collections.abc import Iterable, Mapping

from equipoise.io.truth_build import TORQUES
from equipoise.model.testbed import AttitudeSensor, Fault, Gyro, SlidingMass, Testbed, Truth
from equipoise.model.torque_terms import GROUPS

Value = str | float | int | list[str] | list[float] | list[list[float]]
PER_UM, PER_MM, PER_GRAM, PER_PERCENT, PER_DEG = 1e6, 1e3, 1e3, 1e2, 180 / math.pi
DIGITS = 15  # 200.0 mm comes back as 200.0, not 200.00000000000003


def text_of_testbed(testbed: Testbed) -> str:
    """Return TOML that reads back as the same testbed (to the 15th digit)."""
    parts = [
        _table("", {"name": testbed.name}),
        _table("[platform]", _platform(testbed)),
        *(_table("[[sliding_mass]]", _mass(mass)) for mass in testbed.masses),
        _table("[sensor.attitude]", _attitude(testbed.attitude)),
        _table("[sensor.gyro]", _gyro(testbed.gyro)),
        _table("[disturbance]", {"consider": list(testbed.disturbances)}),
        _truth(testbed.truth),
        _table("[assumed]", {json.dumps(k): v for k, v in testbed.assumed.items()}),
    ]
    return "\n".join(filter(None, parts))


def _number(value: float, factor: float = 1.0) -> float:
    return float(f"{value * factor:.{DIGITS}g}")


def _list(values: Iterable[float], factor: float = 1.0) -> list[float]:
    return [_number(v, factor) for v in values]


def _table(head: str, keys: Mapping[str, Value]) -> str:
    """Return one table; JSON's numbers, strings and lists are TOML's."""
    if not keys:
        return ""
    lines = [f"{key} = {json.dumps(value, ensure_ascii=False)}" for key, value in keys.items()]
    return "\n".join([*([head] if head else []), *lines, ""])


def _platform(testbed: Testbed) -> dict[str, Value]:
    return {
        "mass_kg": _number(testbed.body.mass),
        "inertia_kg_m2": [_list(row) for row in testbed.body.inertia_P],
        "inertia_sd_percent": _number(testbed.inertia_sd, PER_PERCENT),
        "about": "P",
        "com_um": _list(testbed.body.com, PER_UM),
        "com_sd_um": _list(testbed.com_sd, PER_UM),
        "up": _list(testbed.up),
        "tilt_limit_deg": _number(testbed.tilt_limit, PER_DEG),
        "gravity_m_s2": _number(testbed.gravity),
    }


def _mass(mass: SlidingMass) -> dict[str, Value]:
    return {
        "name": mass.name,
        "mass_g": _number(mass.mass, PER_GRAM),
        "home_mm": _list(mass.home, PER_MM),
        "axis": _list(mass.axis),
        "travel_mm": _list(mass.travel, PER_MM),
        "resolution_mm": _number(mass.resolution, PER_MM),
        "accuracy_mm": _number(mass.accuracy, PER_MM),
        "backlash_mm": _number(mass.backlash, PER_MM),
        "speed_mm_s": _number(mass.speed, PER_MM),
    }


def _attitude(sensor: AttitudeSensor | None) -> dict[str, Value]:
    if sensor is None:
        return {}
    return {
        "rate_hz": _number(sensor.rate),
        "noise_deg": _number(sensor.noise, PER_DEG),
        "delay_s": _number(sensor.delay),
        "averaging_s": _number(sensor.averaging),
    }


def _gyro(sensor: Gyro | None) -> dict[str, Value]:
    if sensor is None:
        return {}
    return {
        "rate_hz": _number(sensor.rate),
        "noise_deg_s": _number(sensor.noise, PER_DEG),
        "bias_sd_deg_s": _number(sensor.bias_sd, PER_DEG),
        "delay_s": _number(sensor.delay),
        "averaging_s": _number(sensor.averaging),
    }


def _truth(truth: Truth | None) -> str:
    if truth is None:
        return ""
    keys: dict[str, Value] = {
        "com_low_um": _list(truth.com_low, PER_UM),
        "com_high_um": _list(truth.com_high, PER_UM),
        "inertia_error_percent": _number(truth.inertia_error, PER_PERCENT),
        "tilt_deg": _number(truth.tilt, PER_DEG),
        "rate_limit_deg_s": _number(truth.rate_limit, PER_DEG),
        "noise_torque_N_m": _number(truth.noise_torque),
        "noise_correlation_s": _number(truth.noise_correlation),
        "gyro_bias_deg_s": _list(truth.gyro_bias, PER_DEG),
    }
    keys |= _known(truth) | _torque(truth.torque)
    faults = [_table("[[truth.fault]]", _fault(fault)) for fault in truth.faults]
    return "\n".join([_table("[truth]", keys), *faults])


def _known(truth: Truth) -> dict[str, Value]:
    """Return what is given and not drawn."""
    keys: dict[str, Value] = {}
    if truth.com is not None:
        keys["com_um"] = _list(truth.com, PER_UM)
    if truth.inertia_P is not None:
        keys["inertia_kg_m2"] = [_list(row) for row in truth.inertia_P]
    if truth.attitude is not None:
        keys["attitude_deg"] = _list(truth.attitude, PER_DEG)
    if truth.rate is not None:
        keys["rate_deg_s"] = _list(truth.rate, PER_DEG)
    return keys


def _torque(torque: Mapping[str, float]) -> dict[str, Value]:
    keys: dict[str, Value] = {}
    for key, group, unit in TORQUES:
        if any(term in torque for term in GROUPS[group]):
            values = [_number(torque.get(term, 0.0), 1 / unit) for term in GROUPS[group]]
            keys[key] = values if len(values) > 1 else values[0]
    return keys


def _fault(fault: Fault) -> dict[str, Value]:
    kind: dict[str, Value] = {"kind": "slip", "gain": _number(fault.gain)}
    return {"mass": fault.mass, **(kind if fault.gain else {"kind": "stuck"})} | {
        "from_move": fault.from_move
    }
