"""Plan files: TOML to a manoeuvre that a testbed can make, and back. A unit is part of its key."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from pydantic import Field

from equipoise.io.files.atomic_file import write_whole
from equipoise.io.toml.key_types import Name, NotNegative, Positive, Table, Triple
from equipoise.io.toml.read_toml import parse_toml, read_toml
from equipoise.io.toml.write_toml import as_written, number, toml_text
from equipoise.model.arrays import Vector3
from equipoise.model.devices import ControlMomentGyro, ReactionWheel
from equipoise.model.errors import InputError, nearest
from equipoise.model.manoeuvre import HAND_RATE, HAND_TILT, Manoeuvre, Plan, SquareWave
from equipoise.model.testbed import Testbed
from equipoise.model.units import DEG, MM, UM

WANTED = "a plan file (TOML); `equipoise plan` writes one"
HEAD = "# A manoeuvre. `equipoise plan` wrote it; simulate, identify and balance take it.\n"
Six = Annotated[list[float], Field(min_length=6, max_length=6)]
Targets = dict[Name, float]


class Start(Table):
    """How the platform is let go."""

    tilt_deg: Annotated[float, Field(ge=0, le=180)]
    low_side: Triple = Field([1.0, 0.0, 0.0], description="body direction that is lowest")
    rate_deg_s: Triple = Field([0.0, 0.0, 0.0], description="body axes")
    tilt_sd_deg: NotNegative = Field(
        round(HAND_TILT / DEG, 9),
        description="standard deviation; default: tilt set by hand",
    )
    rate_sd_deg_s: NotNegative = Field(
        round(HAND_RATE / DEG, 9),
        description="standard deviation of each component; default: release by hand",
    )


class Standing(Table):
    """Where masses stand before, those that are not at home."""

    at_mm: Targets


class Move(Table):
    """Masses that are sent off at a time."""

    time_s: NotNegative
    to_mm: Targets = Field(description="displacements from home by mass", min_length=1)


class Wave(Table):
    """A square wave: a torque on a wheel's rotor, or a rate of a gyro's gimbal."""

    device: Name
    torque_N_m: float | None = None
    gimbal_rate_deg_s: float | None = None
    period_s: Positive
    phase: Annotated[float, Field(ge=0, lt=1)] = Field(
        0.25, description="phase at the start, in periods"
    )


class Promised(Table):
    """One sd of what a fit of the record should find."""

    com_sd_um: Triple
    inertia_sd_kg_m2: Six = Field(description="xx yy zz xy xz yz, about P")


class PlanFile(Table):
    """A plan."""

    testbed: str = ""
    duration_s: Positive
    start: Start
    standing: Standing | None = None
    move: list[Move] = Field([])
    wave: list[Wave] = Field([])
    predicted: Promised | None = None


def read_plan(path: str | Path, testbed: Testbed) -> Plan:
    """Return the plan of a file; InputError for what the testbed cannot do."""
    return plan_of(read_toml(path, PlanFile, WANTED), testbed, str(path))


def parse_plan(text: str, testbed: Testbed, source: str) -> Plan:
    """Return the plan of a text; ``source`` names it in errors."""
    return plan_of(parse_toml(text, source, PlanFile), testbed, source)


def plan_of(file: PlanFile, testbed: Testbed, source: str) -> Plan:
    """Return a plan in SI."""
    standing = {} if file.standing is None else file.standing.at_mm
    manoeuvre = Manoeuvre(
        duration=file.duration_s,
        tilt=file.start.tilt_deg * DEG,
        low_side=low_side(file.start, testbed, f"{source}: start.low_side"),
        rate=np.array(file.start.rate_deg_s) * DEG,
        moves=tuple(
            (move.time_s, targets(move.to_mm, testbed, f"{source}: move[{k}].to_mm"))
            for k, move in in_order(file, source)
        ),
        waves=tuple(
            wave_of(wave, testbed, f"{source}: wave[{k}]") for k, wave in enumerate(file.wave, 1)
        ),
        standing=targets(standing, testbed, f"{source}: standing.at_mm"),
        tilt_sd=file.start.tilt_sd_deg * DEG,
        rate_sd=file.start.rate_sd_deg_s * DEG,
    )
    said = file.predicted
    return Plan(
        file.testbed,
        manoeuvre,
        None if said is None else np.array(said.inertia_sd_kg_m2),
        None if said is None else np.array(said.com_sd_um) * UM,
        source,
    )


def in_order(file: PlanFile, source: str) -> list[tuple[int, Move]]:
    """Return the moves, counted from 1, if they are in order of time and within it."""
    before = 0.0
    for k, move in enumerate(file.move, 1):
        if not before <= move.time_s < file.duration_s:
            where, wanted = f"{source}: move[{k}].time_s", "times in order, before duration_s"
            raise InputError(where, f"{move.time_s:g}", wanted)
        before = move.time_s
    return list(enumerate(file.move, 1))


def targets(mm: Mapping[str, float], testbed: Testbed, where: str) -> dict[str, float]:
    """Return displacements (m) of masses that there are, within their travel."""
    for name, d in mm.items():
        if name not in testbed.mass_names:
            none = "no move: the testbed has no masses"
            wanted = nearest(name, list(testbed.mass_names)) if testbed.masses else none
            raise InputError(where, f"a mass '{name}'", wanted)
        low, high = testbed.mass_named(name).travel
        if not low - 1e-9 <= d * MM <= high + 1e-9:
            wanted = f"{low / MM:g} to {high / MM:g} mm"
            raise InputError(where, f"{name} = {d:g}", wanted)
    return {name: d * MM for name, d in mm.items()}


def low_side(start: Start, testbed: Testbed, where: str) -> Vector3:
    """Return the level part of the side that is lowest, as a unit vector."""
    side = np.array(start.low_side, float)
    level = side - (side @ testbed.up) * testbed.up
    size = float(np.linalg.norm(level))
    if size <= 0.5 * float(np.linalg.norm(side)):
        wanted = "a direction at right angles to the body axis that points up"
        raise InputError(where, f"{start.low_side}", wanted)
    return level / size


def wave_of(wave: Wave, testbed: Testbed, where: str) -> SquareWave:
    """Return a wave of a wheel or a gyro that there is, within what it can do."""
    known = {d.name: d for d in (*testbed.wheels, *testbed.cmgs)}
    device = known.get(wave.device)
    if device is None:
        none = "no wave: the testbed has neither wheels nor gyros"
        wanted = nearest(wave.device, list(known)) if known else none
        raise InputError(f"{where}.device", f"'{wave.device}'", wanted)
    key, most, unit = limit_of(device)
    found = {"torque_N_m": wave.torque_N_m, "gimbal_rate_deg_s": wave.gimbal_rate_deg_s}
    value = found.pop(key)
    if value is None or any(v is not None for v in found.values()):
        raise InputError(where, f"no {key} alone", f"'{key}' for '{wave.device}'")
    if abs(value * unit) > most * (1 + 1e-9):
        raise InputError(f"{where}.{key}", f"{value:g}", f"at most {most / unit:g}")
    return SquareWave(wave.device, value * unit, wave.period_s, wave.phase)


def limit_of(device: ReactionWheel | ControlMomentGyro) -> tuple[str, float, float]:
    """Return the key of a device's input, the greatest (SI), and the key's unit in SI."""
    if isinstance(device, ReactionWheel):
        return "torque_N_m", device.max_torque, 1.0
    return "gimbal_rate_deg_s", device.max_rate, DEG


def write_plan(plan: Plan, testbed: Testbed, path: str | Path) -> None:
    """Write a plan, after seeing that it can be read."""
    text = text_of_plan(plan, testbed)
    parse_plan(text, testbed, str(path))
    write_whole(path, text)


def text_of_plan(plan: Plan, testbed: Testbed) -> str:
    """Return a plan as TOML."""
    m = plan.manoeuvre
    keys: dict[str, Any] = {
        "testbed": plan.testbed,
        "duration_s": number(m.duration),
        "start": {
            "tilt_deg": number(m.tilt, DEG),
            "low_side": as_written(np.round(m.low_side, 6) + 0.0),
            "rate_deg_s": as_written(np.round(m.rate / DEG, 6) + 0.0),
            "tilt_sd_deg": number(m.tilt_sd, DEG),
            "rate_sd_deg_s": number(m.rate_sd, DEG),
        },
        "standing": {"at_mm": as_written(m.standing, MM)} if m.standing else {},
        "move": [{"time_s": number(t), "to_mm": as_written(goals, MM)} for t, goals in m.moves],
        "wave": [wave_keys(wave, testbed) for wave in m.waves],
        "predicted": predicted_keys(plan),
    }
    return HEAD + toml_text({key: value for key, value in keys.items() if value})


def wave_keys(wave: SquareWave, testbed: Testbed) -> dict[str, Any]:
    """Return the keys of a wave."""
    device = next(d for d in (*testbed.wheels, *testbed.cmgs) if d.name == wave.device)
    key, _, unit = limit_of(device)
    amplitude = float(f"{wave.amplitude / unit:.6g}")
    return {"device": wave.device, key: amplitude, "period_s": number(wave.period),
            "phase": number(wave.phase)}  # fmt: skip


def predicted_keys(plan: Plan) -> dict[str, list[float]]:
    """Return what a plan promises, if all of it is observable."""
    if plan.com_sd is None or plan.inertia_sd is None:
        return {}
    com = [float(f"{x / UM:.4g}") for x in plan.com_sd]
    inertia = [float(f"{x:.4g}") for x in plan.inertia_sd]
    return {"com_sd_um": com, "inertia_sd_kg_m2": inertia}
