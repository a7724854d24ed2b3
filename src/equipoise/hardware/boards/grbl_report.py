"""The lines that Grbl 1.1 sends, as records. Source: Grbl 1.1 wiki, "Interface".

    <Idle|MPos:1.000,2.000,3.000|FS:0,0|WCO:0.000,0.000,0.000>
    ok   error:9   ALARM:1   $100=80.000   [MSG:...]   Grbl 1.1h ['$' for help]

A position may be that of the machine (MPos) or of the work (WPos), which is less by an offset
(WCO) that the board reports now and then. The words for its codes of errors and alarms are ours.
"""

import re
from dataclasses import dataclass
from enum import Enum

from equipoise.hardware.transport.finite_numbers import all_finite, finite

WELCOME = re.compile(rb"Grbl \d+\.\d+\S* \[")
SETTING = re.compile(rb"\$(\d+)=([-+0-9.eE]+)")
CODE = re.compile(rb"(error|ALARM):(\d{1,4})")
ERRORS = {
    1: "a G-code word lacks its letter",
    2: "a number in a command cannot be read",
    3: "it does not know this $ command",
    4: "a value must not be negative",
    5: "homing is switched off in its settings ($22)",
    6: "a step pulse must be at least 3 us long ($0)",
    7: "its settings could not be read and were set to defaults",
    8: "this $ command is for a board that stands",
    9: "it is locked by an alarm, or busy with a jog",
    10: "soft limits need homing ($20, $22)",
    11: "a line is longer than it can take",
    12: "a step rate is beyond what it can do",
    13: "its safety door is open",
    14: "a line with its settings is too long",
    15: "a way would leave its travel; it did not move",
    16: "a jog command is incomplete",
    17: "laser mode needs a PWM output",
    20: "it does not know this G-code",
    21: "two G-codes of one group in one line",
    22: "the speed is missing",
    23: "a G-code needs a whole number",
    24: "two G-codes want the same axis words",
    25: "a G-code word stands twice in one line",
    26: "no axis word is given",
    27: "a line number is out of range",
    28: "a value word is missing",
    29: "it does not have this coordinate system",
    30: "G53 needs G0 or G1",
    31: "axis words are left over",
    32: "an arc needs its plane",
    33: "the target cannot be reached",
    34: "an arc's radius cannot be",
    35: "an arc's offsets are missing",
    36: "words are left over",
    37: "the tool length offset needs its axis",
    38: "a tool number is too great",
}

ALARMS = {
    1: "a limit switch was hit; the position is likely lost",
    2: "a way would have left its travel; it did not move",
    3: "it was reset while it moved; the position is lost",
    4: "the probe was not as expected before it was used",
    5: "the probe touched nothing",
    6: "homing was broken off by a reset",
    7: "homing was broken off by the safety door",
    8: "a limit switch did not open when homing backed off",
    9: "homing did not find a limit switch",
    10: "homing with two motors did not find the second switch",
}


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


def sentence_of(alarm: bool, code: int) -> str:
    """Return an alarm or an error in words."""
    if alarm:
        return f"{ALARMS.get(code, 'it stopped with an alarm')} (ALARM:{code})"
    return f"{ERRORS.get(code, 'it refused a command')} (error:{code})"
