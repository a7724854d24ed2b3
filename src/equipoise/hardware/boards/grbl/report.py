"""The lines that Grbl 1.1 and its kin send, as records. Source: Grbl 1.1 wiki, "Interface".

    <Idle|MPos:1.000,2.000,3.000|FS:0,0|WCO:0.000,0.000,0.000>
    ok   error:9   ALARM:1   $100=80.000   [MSG:...]   Grbl 1.1h ['$' for help]

A position may be that of the machine (MPos) or of the work (WPos), which is less by an offset
(WCO) that the board reports now and then. FS is the feed now and the speed of a spindle; F, where
there is no spindle, the feed alone. Dialects differ in the greeting:

    Grbl 1.1f ['$' for help]                     Grbl
    GrblHAL 1.1f ['$' or '$HELP' for help]       grblHAL
    Grbl 3.7 [FluidNC v3.7.8 (wifi) '$' for help]   FluidNC
    Grbl 0.9j ['$' for help]                     too old: it has no jogs, its reports have commas
"""

import re
from dataclasses import dataclass
from enum import Enum, StrEnum

from equipoise.hardware.transport.finite_numbers import all_finite, finite

GREETING = re.compile(rb"(?:Grbl|GrblHAL) (\d+)\.(\d+)(\S*) \[.*")
OLD_STATUS = re.compile(rb"<[A-Za-z]+,MPos:.*>")  # of Grbl 0.8 and 0.9
SETTING = re.compile(rb"\$(\d+)=(.*)")
CODE = re.compile(rb"(error|ALARM):(\d{1,4})")
OLDEST = (1, 1)  # version that has jogs


class MachineState(StrEnum):
    """What a board says that it does; the firmware's own words."""

    IDLE = "Idle"
    RUN = "Run"
    JOG = "Jog"
    HOLD = "Hold"
    HOME = "Home"
    ALARM = "Alarm"
    CHECK = "Check"
    DOOR = "Door"
    SLEEP = "Sleep"
    TOOL = "Tool"  # grblHAL: it waits for a change of tools


STATES = {state.value: state for state in MachineState}


@dataclass(frozen=True, slots=True)
class Status:
    """An answer to a question mark."""

    state: MachineState
    machine: tuple[float, ...] | None = None  # mm
    work: tuple[float, ...] | None = None  # mm
    offset: tuple[float, ...] | None = None  # mm, work's zero in the machine's frame
    feed: float | None = None  # mm/min, now
    detail: int | None = None  # of Hold: 0 it stands, 1 it slows down; of Alarm: its number


@dataclass(frozen=True, slots=True)
class Greeting:
    """It has just begun."""

    text: str
    old: bool  # a version without jogs


class Word(Enum):
    """What is said without a number."""

    OK = "a line was taken"
    REMARK = "a message for people, an echo, or a setting that is a text"


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


Report = Status | Greeting | Word | Code | Setting


def parsed(line: bytes) -> Report | None:
    """Return what a line says; None for one that is none of Grbl's, or broken."""
    if line == b"ok":
        return Word.OK
    if line.startswith(b"<"):
        return _status(line)
    greeting = GREETING.fullmatch(line)
    if greeting:
        version = int(greeting[1]), int(greeting[2])
        return Greeting(line.decode("ascii", "replace"), version < OLDEST)
    code = CODE.fullmatch(line)
    if code:
        return Code(code[1] == b"ALARM", int(code[2]))
    setting = SETTING.fullmatch(line)
    if setting:
        value = finite(setting[2].partition(b" ")[0])
        return Word.REMARK if value is None else Setting(int(setting[1]), value)
    return Word.REMARK if line.startswith(b"[") and line.endswith(b"]") else None


def _status(line: bytes) -> Status | Greeting | None:
    if not line.endswith(b">"):
        return None
    if OLD_STATUS.fullmatch(line):
        return Greeting(line.decode("ascii", "replace"), old=True)
    head, *fields = line[1:-1].decode("ascii", "replace").split("|")
    name, _, detail = head.partition(":")
    if name not in STATES or not (detail.isdecimal() or not detail):
        return None
    numbers: dict[str, tuple[float, ...]] = {}
    for field in fields:
        key, _, text = field.partition(":")
        if key in ("MPos", "WPos", "WCO", "FS", "F"):
            found = all_finite(text.split(","))
            if not found:
                return None
            numbers[key] = tuple(found)
    feed = numbers.get("FS", numbers.get("F"))
    return Status(
        STATES[name], numbers.get("MPos"), numbers.get("WPos"), numbers.get("WCO"),
        None if feed is None else feed[0], int(detail) if detail else None,
    )  # fmt: skip
