"""The states of an emulated Grbl, what is flagged to it, and why it takes no line.

Source: Grbl 1.1 wiki, "Interface", "Real-time status reports"; the published firmware's behaviour.
"""

from enum import StrEnum


class State(StrEnum):
    """What it says that it does."""

    IDLE = "Idle"
    RUN = "Run"
    JOG = "Jog"
    HOLD = "Hold"
    HOME = "Home"
    ALARM = "Alarm"
    CHECK = "Check"
    DOOR = "Door"
    SLEEP = "Sleep"


class Flag(StrEnum):
    """What is to be looked at, set by bytes and by motors."""

    REPORT = "?"
    HOLD = "!"
    START = "~"
    CANCEL = "0x85"
    DOOR = "door"
    SLEEP = "sleep"
    STOPPED = "the motors stand"


class Suspended(StrEnum):
    """Why no line is taken."""

    STANDS = "a hold is complete"
    CANCELLED = "a jog is being cancelled"
    DROPPED = "a way is cancelled for good"
