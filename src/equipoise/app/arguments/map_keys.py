"""A reading of an unknown table as the keys of a column map file, which `--columns` takes."""

from collections.abc import Mapping
from typing import Any

from equipoise.assessment.hypotheses.clocks import ClockGuess
from equipoise.assessment.hypotheses.inertial_unit import InertialUnit, Triad
from equipoise.assessment.hypotheses.ranking import TableReading
from equipoise.io.toml.units import KINDS

NEXT = {"x": "y", "y": "z", "z": "x"}  # axes in cyclic order


def reading_keys(reading: TableReading, up: str, formats: Mapping[str, str]) -> dict[str, Any]:
    """Return a reading as a column map file has it; the platform's axis ``up`` stands."""
    body = _body(reading.frame.body_up, up)
    keys: dict[str, Any] = {}
    if reading.frame.lab_up != "z":
        keys["lab_up"] = reading.frame.lab_up
    if body != ["x", "y", "z"]:
        keys["body"] = body
    keys["time"] = _time_keys(reading.clock, formats)
    keys["attitude"] = _attitude_keys(reading)
    if reading.gyro is not None:
        gyro = reading.gyro
        triad = Triad(gyro.columns, gyro.signs, gyro.factor, gyro.unit)
        keys["rate"] = _triad_keys(triad, body, "rate", "rad/s")
    return keys


def unit_keys(unit: InertialUnit, up: str, formats: Mapping[str, str]) -> dict[str, Any]:
    """Return an inertial unit as a column map file has it; the platform's axis ``up`` stands."""
    body = _body(unit.up, up)
    keys: dict[str, Any] = {} if body == ["x", "y", "z"] else {"body": body}
    keys["time"] = _time_keys(unit.clock, formats)
    keys["rate"] = _triad_keys(unit.gyro, body, "rate", "rad/s")
    keys["accelerometer"] = _triad_keys(unit.accelerometer, body, "acceleration", "m/s2")
    return keys


def _time_keys(clock: ClockGuess, formats: Mapping[str, str]) -> dict[str, str]:
    name = clock.column
    written = {"format": formats[name]} if name in formats else {"unit": clock.unit}
    return {"column": name, **written}


def _attitude_keys(reading: TableReading) -> dict[str, Any]:
    attitude = reading.attitude
    keys: dict[str, Any] = {"columns": list(attitude.columns)}
    if attitude.sequence:
        places = ["XYZ".index(letter) for letter in attitude.sequence]
        keys["columns"] = [attitude.columns[k] for k in places]
        keys |= {"unit": "deg" if attitude.degrees else "rad", "sequence": attitude.sequence}
        if attitude.signs != (1, 1, 1):
            keys["signs"] = [attitude.signs[k] for k in places]
        return keys
    keys["columns"] = list(attitude.ordered)
    turns = "laboratory to body" if attitude.inverse else "body to laboratory"
    return keys | {"order": "wxyz", "turns": turns}


def _triad_keys(triad: Triad, body: list[str], kind: str, si: str) -> dict[str, Any]:
    """Return three columns in our axes, relabelled as the body's are."""
    axes = [signed(axis, triad.signs["xyz".index(axis[-1])]) for axis in body]
    keys: dict[str, Any] = {"columns": list(triad.columns)}
    if triad.unit in KINDS[kind]:
        keys["unit"] = triad.unit
    else:
        keys |= {"unit": si, "factor": float(f"{triad.factor:.6g}")}
    return keys if axes == body else keys | {"axes": axes}


def signed(axis: str, sign: int) -> str:
    """Return an axis, turned over by a negative sign."""
    return axis if sign > 0 else axis[1:] if axis.startswith("-") else f"-{axis}"


def _body(standing: str, up: str) -> list[str]:
    """Return our axes in terms of the table's, so that the table's axis that stands is our ``up``.

    The other two follow in cyclic order: the heading of the body's axes is anyone's choice.
    """
    if standing == up:
        return ["x", "y", "z"]
    sign = -1 if standing.startswith("-") != up.startswith("-") else 1
    axes = {up[-1]: signed(standing[-1], sign)}
    ours, theirs = NEXT[up[-1]], NEXT[standing[-1]]
    axes[ours] = theirs
    axes[NEXT[ours]] = signed(NEXT[theirs], sign)
    return [axes[letter] for letter in "xyz"]
