"""The properties of a balancing law, the devices that it needs, and its prospect on a testbed."""

from dataclasses import dataclass
from typing import Literal

Need = Literal["masses", "momentum", "magnetorquers", "jets", "gyro", "attitude"]

NEEDS: dict[Need, str] = {
    "masses": "sliding masses",
    "momentum": "reaction wheels or control moment gyros along all three axes",
    "magnetorquers": "magnetorquers and a known magnetic field",
    "jets": "jets about all three axes",
    "gyro": "a gyro",
    "attitude": "an attitude sensor",
}


@dataclass(frozen=True, slots=True)
class LawCard:
    """What to expect of a law."""

    name: str
    idea: str  # one sentence
    source: str  # where it is published, with equation numbers; errata by their numbers
    needs: tuple[Need, ...]
    leaves: str  # what it does not remove, and what it cannot see
    stable: str  # where it is stable: sampling, rate limits, size of the offset
    period: float  # s, between steps
    follows: bool = False  # it states what masses can follow when it has ended


@dataclass(frozen=True, slots=True)
class Prospect:
    """What to expect of a law on a testbed."""

    law: str
    missing: tuple[Need, ...]  # devices
    refused: str | None  # why it would not be stable; None: it would, or devices are missing
    expected: float | None  # s; None: it is not begun, or cannot calculate it
