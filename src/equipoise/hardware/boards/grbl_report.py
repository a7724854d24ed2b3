"""The lines that Grbl 1.1 sends, as records. Source: Grbl 1.1 wiki, "Interface".

    <Idle|MPos:1.000,2.000,3.000|FS:0,0|WCO:0.000,0.000,0.000>
    ok   error:9   ALARM:1   $100=80.000   [MSG:...]   Grbl 1.1h ['$' for help]

A position may be that of the machine (MPos) or of the work (WPos), which is less by an offset
(WCO) that the board reports now and then.
"""

import re
from dataclasses import dataclass
from enum import Enum

from equipoise.hardware.transport.finite_numbers import all_finite, finite

WELCOME = re.compile(rb"Grbl \d+\.\d+\S* \[")
SETTING = re.compile(rb"\$(\d+)=([-+0-9.eE]+)")
CODE = re.compile(rb"(error|ALARM):(\d{1,4})")


@dataclass(frozen=True, slots=True)
class Status:
    """An answer to a question mark."""

    state: str  # Idle, Run, Jog, Hold, Home, Alarm, Door, Check, Sleep
    machine: tuple[float, ...] | None  # mm
    work: tuple[float, ...] | None  # mm
    offset: tuple[float, ...] | None  # mm, work's zero in the machine's frame


class Word(Enum):
    """What is said without a number."""

    OK = "a line was taken"
    WELCOME = "it has just begun"
    REMARK = "a message for people, or an echo"


@dataclass(frozen=True, slots=True)
class Code:
    """An error or an alarm."""

    alarm: bool
    number: int


@dataclass(frozen=True, slots=True)
class Setting:
    """A setting."""

    number: int
    value: float


Report = Status | Word | Code | Setting


def parsed(line: bytes) -> Report | None:
    """Return what a line says; None for one that is none of Grbl's, or broken."""
    if line == b"ok":
        return Word.OK
    if line.startswith(b"<"):
        return _status(line)
    if WELCOME.match(line):
        return Word.WELCOME
    code = CODE.fullmatch(line)
    if code:
        return Code(code[1] == b"ALARM", int(code[2]))
    setting = SETTING.fullmatch(line.partition(b" ")[0])
    if setting:
        value = finite(setting[2])
        return None if value is None else Setting(int(setting[1]), value)
    return Word.REMARK if line.startswith(b"[") and line.endswith(b"]") else None


def _status(line: bytes) -> Status | None:
    if not line.endswith(b">"):
        return None
    head, *fields = line[1:-1].decode("ascii", "replace").split("|")
    state = head.partition(":")[0]
    if not state.isalpha():
        return None
    places: dict[str, tuple[float, ...]] = {}
    for field in fields:
        key, _, text = field.partition(":")
        if key in ("MPos", "WPos", "WCO"):
            place = all_finite(text.split(","))
            if place is None:
                return None
            places[key] = place
    return Status(state, places.get("MPos"), places.get("WPos"), places.get("WCO"))
