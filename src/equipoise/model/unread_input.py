"""A column of a table that seems to say what acted on the platform, and that no reading takes."""

from dataclasses import dataclass
from enum import StrEnum


class InputKind(StrEnum):
    """What a column's name says that it reports, or commands."""

    WHEEL = "wheel"
    GIMBAL = "gimbal"
    DIPOLE = "dipole"
    CAGE = "cage"
    JET = "jet"
    MASS = "mass"
    MOMENTUM = "momentum"
    TORQUE = "torque"
    COMMAND = "command"  # of a motor, which the name does not say more of


@dataclass(frozen=True, slots=True)
class UnreadInput:
    """One such column, which changes."""

    column: str
    kind: InputKind
    low: float  # in the column's unit, which nothing states
    high: float
