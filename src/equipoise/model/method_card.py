"""The properties of a method of estimation, and the records on which its coverage is measured."""

from dataclasses import dataclass
from typing import Literal

Regime = Literal["free", "driven", "moved", "drifting", "wandering", "played", "levelled", "rests"]
Choice = Literal["term", "hold", "prior", "robust"]

REGIMES: dict[Regime, str] = {
    "free": "free swing of a minute, inertia known; 0.05 deg and 0.005 deg/s/sqrt(Hz), 50 Hz",
    "driven": "a minute under known square-wave torques of 10 mN m; the same sensors",
    "moved": "two minutes with two known moves; 0.05 deg and 1e-4 rad/s, 50 Hz",
    "drifting": (
        "two minutes with a known move; com walks by 0.05 um/sqrt(s) and torque noise of "
        "1 uN m sqrt(s); J known to 5 %; 0.2 deg, 5 Hz and 1e-4 rad/s, 20 Hz"
    ),
    "wandering": (
        "free swing of a minute, com walks by 0.05 um/sqrt(s) and torque noise of 1 uN m "
        "sqrt(s); J known to 5 %; 0.2 deg, 5 Hz and 1e-4 rad/s, 20 Hz"
    ),
    "played": "the same under known square-wave torques of 10 mN m",
    "levelled": "the same swing, com across the vertical known to 1 um",
    "rests": "five minutes, damped, com 0.4 to 0.9 mm low, four moves with rests between; a camera",
}


@dataclass(frozen=True, slots=True)
class Card:
    """What to expect of a method."""

    name: str
    formulation: str
    solver: str
    source: str  # where it is published, with equation numbers
    needs: str
    cannot_see: str
    regime: Regime  # where its intervals are measured
    heeds: tuple[Choice, ...] = ()  # which of the options it knows
