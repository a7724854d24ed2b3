"""The codes of errors and alarms of Grbl 1.1, in words that are ours.

Source: Grbl 1.1 wiki, "Interface", tables of error and alarm codes.
"""

IDLE_ERROR = 8  # the state that the board is in does not take the line: it may take it later

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

# An alarm after which Grbl 1.1 takes nothing but a reset: a limit switch, a soft limit.
CRITICAL = (1, 2)


def error_text(code: int) -> str:
    """Return an error in words."""
    return ERRORS.get(code, "it refused a command")


def alarm_text(code: int) -> str:
    """Return an alarm in words."""
    return ALARMS.get(code, "it stopped with an alarm")
