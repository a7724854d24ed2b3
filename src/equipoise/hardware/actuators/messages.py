"""What a device says in device lines: its messages, checked (docs/device-protocol.md)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, cast

from equipoise.hardware.transport.finite_numbers import all_finite
from equipoise.model.units import MS

VERSION = 1
REFUSALS = {
    1: "the line was broken",
    2: "it does not know this message",
    3: "the number of inputs is wrong",
    4: "an input is beyond its limit",
    5: "it is at rest",
    6: "the line was too long",
}


class Mode(IntEnum):
    """What a device does, and why."""

    BEGUN = 0  # at rest since its start
    WORKING = 1
    HALTED = 2  # at rest, as it was told
    DEADMAN = 3  # at rest, since nothing came


@dataclass(frozen=True, slots=True)
class Hello:
    """Who it is."""

    version: int
    name: str
    outputs: int
    deadman: float  # s


@dataclass(frozen=True, slots=True)
class Description:
    """One of its outputs; limits in the unit of the input."""

    index: int
    kind: str
    name: str
    units: tuple[str, str]  # of the input, and of what is counted
    greatest: float
    least: float
    rest: str  # what a wheel does at rest: "hold" or "spin_down"


@dataclass(frozen=True, slots=True)
class Report:
    """How it is."""

    stamp: float  # s, on its clock
    taken: int  # number of the order that it took last
    mode: Mode
    fault: int  # of its own; 0: none
    counted: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class Refusal:
    """What it did not take, and why."""

    code: int
    number: int  # of the order; 0: of none


Message = Hello | Description | Report | Refusal


def read_message(message: Mapping[str, Any]) -> Message | None:
    """Return a message as what it is; None if it is none of these, or not whole."""
    try:
        for key, read in _READ.items():
            if key in message:
                return read(message)
    except (KeyError, TypeError, ValueError, OverflowError):
        return None
    return None


def _hello(message: Mapping[str, Any]) -> Hello:
    numbers = [_whole(message[key]) for key in ("hello", "n", "deadman_ms")]
    return Hello(numbers[0], _text(message["name"]), numbers[1], numbers[2] * MS)


def _description(message: Mapping[str, Any]) -> Description:
    limits = _numbers([message["max"], message.get("min", 0)])
    texts = [_text(message[key]) for key in ("kind", "name", "in", "counts")]
    rest = _text(message.get("rest", "hold"))
    kind, name, *units = texts
    return Description(
        _whole(message["device"]), kind, name, (units[0], units[1]), limits[0], limits[1], rest
    )


def _report(message: Mapping[str, Any]) -> Report:
    t, taken, mode, fault = (_whole(message[key]) for key in ("t_ms", "a", "m", "f"))
    counted = cast("Sequence[Any]", message["y"])
    if not isinstance(counted, list):
        raise TypeError
    return Report(t * MS, taken, Mode(mode), fault, _numbers(counted))


def _refusal(message: Mapping[str, Any]) -> Refusal:
    return Refusal(_whole(message["err"]), _whole(message.get("at", 0)))


def _whole(value: Any) -> int:
    if type(value) is not int or value < 0:
        raise TypeError
    return value


def _numbers(values: Sequence[Any]) -> tuple[float, ...]:
    found = all_finite(values) if all(type(value) in (int, float) for value in values) else None
    if found is None:
        raise TypeError
    return found


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError
    return value


_READ = {"t_ms": _report, "err": _refusal, "device": _description, "hello": _hello}
