"""A testbed file's tables, checked for sense and turned into the nouns, in SI."""

import math
from typing import Any, NoReturn, cast

import numpy as np

from equipoise.io.testbed import testbed_schema as schema
from equipoise.io.testbed.devices_build import devices_of
from equipoise.io.testbed.hardware_build import hardware_of
from equipoise.io.testbed.inertia_check import check_inertia
from equipoise.io.testbed.truth import truth_of
from equipoise.io.testbed.weights_build import grids_of, weights_of
from equipoise.io.toml.unit_vectors import unit_vector
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.testbed import AttitudeSensor, Gyro, SlidingMass, Testbed
from equipoise.model.torque_terms import expand

UM, MM, MS, GRAM, PERCENT, DEG = 1e-6, 1e-3, 1e-3, 1e-3, 1e-2, math.pi / 180
HANGS = 1e-3  # m: a centre of mass guessed this far off P hangs there on purpose (chosen)
STANDS_OUT = 10.0  # times the other components, for its axis to be the vertical one (chosen)


def testbed_of(table: schema.TestbedFile, source: str) -> Testbed:
    """Return the testbed that a file describes."""
    masses = _masses(table, source)
    body = _body(table.platform, source)
    platform, devices = table.platform, devices_of(table, source)
    return Testbed(
        name=table.name,
        body=body,
        inertia_sd=platform.inertia_sd_percent * PERCENT,
        com_sd=np.array(platform.com_sd_um) * UM,
        up=_up(platform, body.com, source),
        tilt_limit=platform.tilt_limit_deg * DEG,
        gravity=platform.gravity_m_s2,
        masses=masses,
        attitude=_attitude(table.sensor.attitude),
        gyro=_gyro(table.sensor.gyro, f"{source}: sensor.gyro"),
        disturbances=expand(tuple(table.disturbance.consider), f"{source}: disturbance.consider"),
        truth=truth_of(table, body, f"{source}: truth"),
        assumed=_assumed(table, source),
        source=source,
        wheels=devices.wheels,
        cmgs=devices.cmgs,
        magnetorquers=devices.magnetorquers,
        jets=devices.jets,
        magnetic_field=devices.magnetic_field,
        weights=weights_of(table, source),
        grids=grids_of(table, source),
        hardware=hardware_of(table.hardware, [mass.name for mass in masses], source),
    )


def _body(platform: schema.Platform, source: str) -> MassProperties:
    where = f"{source}: platform.inertia_kg_m2"
    com = np.array(platform.com_um, float) * UM
    inertia = np.array(platform.inertia_kg_m2, float)
    if platform.about == "C":
        check_inertia(inertia, where)
        return from_centre(platform.mass_kg, com, inertia)
    body = MassProperties(platform.mass_kg, com, inertia)
    check_inertia(inertia, where)
    check_inertia(body.inertia_C, f"{where}, moved to the centre of mass")
    return body


def _up(platform: schema.Platform, com: Vector3, source: str) -> Vector3:
    """Return the axis given, else the axis along which the centre of mass hangs, else z."""
    if platform.up is not None:
        return unit_vector(platform.up, f"{source}: platform.up")
    size = np.abs(com)
    main = int(np.argmax(size))
    hangs = np.linalg.norm(com) > HANGS and np.all(np.delete(size, main) * STANDS_OUT < size[main])
    return np.eye(3)[main if hangs else 2]


def _masses(table: schema.TestbedFile, source: str) -> tuple[SlidingMass, ...]:
    names = [mass.name for mass in table.sliding_mass]
    for index, name in enumerate(names):
        if name in names[:index]:
            _refuse(source, f"sliding_mass[{index + 1}].name", f"a second '{name}'", "a new name")
    total = sum(mass.mass_g for mass in table.sliding_mass) * GRAM
    if total >= table.platform.mass_kg:
        found = f"{table.platform.mass_kg:g} kg, but the sliding masses weigh {total:g} kg"
        _refuse(source, "platform.mass_kg", found, "the mass of everything that floats")
    return tuple(
        _mass(mass, f"{source}: sliding_mass[{i + 1}]") for i, mass in enumerate(table.sliding_mass)
    )


def _mass(mass: schema.SlidingMass, where: str) -> SlidingMass:
    low, high = mass.travel_mm
    if not low < high or not low <= 0 <= high:
        wanted = "the least and the greatest displacement, home (0) among them"
        raise InputError(f"{where}.travel_mm", f"[{low:g}, {high:g}]", wanted)
    return SlidingMass(
        name=mass.name,
        mass=mass.mass_g * GRAM,
        home=np.array(mass.home_mm, float) * MM,
        axis=unit_vector(mass.axis, f"{where}.axis"),
        travel=(low * MM, high * MM),
        resolution=mass.resolution_mm * MM,
        accuracy=mass.accuracy_mm * MM,
        backlash=mass.backlash_mm * MM,
        speed=mass.speed_mm_s * MM,
        lag_sd=mass.lag_sd_ms * MS,
        sag_sd=mass.sag_sd_mm * MM,
        gain=mass.gain,
    )


def _attitude(sensor: schema.Attitude | None) -> AttitudeSensor | None:
    if sensor is None:
        return None
    noise = sensor.noise_deg * DEG
    quantum = sensor.quantum_deg * DEG
    plumb_sd = sensor.plumb_sd_deg * DEG
    return AttitudeSensor(
        sensor.rate_hz, noise, sensor.delay_s, sensor.averaging_s, quantum, plumb_sd
    )


def _gyro(sensor: schema.Gyro | None, where: str) -> Gyro | None:
    if sensor is None:
        return None
    noise, density = sensor.noise_deg_s, sensor.noise_density_deg_s_rthz
    if (noise is None) == (density is None):
        found = "neither" if noise is None else "both"
        raise InputError(where, found, "one of 'noise_deg_s' and 'noise_density_deg_s_rthz'")
    per_sample = noise if density is None else density * math.sqrt(sensor.rate_hz)
    assert per_sample is not None  # one of the two is given, as checked above
    bias, quantum = sensor.bias_sd_deg_s * DEG, sensor.quantum_deg_s * DEG
    delay, averaging = sensor.delay_s, sensor.averaging_s
    return Gyro(sensor.rate_hz, per_sample * DEG, bias, delay, averaging, quantum)


def _assumed(table: schema.TestbedFile, source: str) -> dict[str, str]:
    """Return the assumed keys, after seeing that each of them is in the file."""
    content = table.model_dump(exclude_none=True)
    for key in table.assumed:
        if not _holds(content, key.split(".")):
            _refuse(source, f"assumed.'{key}'", "no such key", "the dotted name of a key in use")
    return dict(table.assumed)


def _holds(content: Any, path: list[str]) -> bool:
    """Say whether a dotted key is there; for a list of tables, in its first."""
    if not path:
        return True
    if isinstance(content, list):
        tables = cast("list[Any]", content)
        return bool(tables) and _holds(tables[0], path)
    table = cast("dict[str, Any]", content) if isinstance(content, dict) else {}
    return path[0] in table and _holds(table[path[0]], path[1:])


def _refuse(source: str, key: str, found: str, wanted: str) -> NoReturn:
    raise InputError(f"{source}: {key}", found, wanted)
