"""The units in which people at a bench think: um, mm, g, deg, deg/s, uN m."""

from dataclasses import dataclass

from equipoise.model.units import DEG, GRAM, MINUTE, MM, MS, UM, UN_M


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit to show: ``size`` is how large it is in SI."""

    name: str
    size: float


SHOWN = {
    "m": Unit("um", UM),
    "kg": Unit("g", GRAM),
    "rad": Unit("deg", DEG),
    "rad/s": Unit("deg/s", DEG),
    "N m": Unit("uN m", UN_M),
    "N m s": Unit("uN m s", UN_M),
    "N m s2": Unit("uN m s2", UN_M),
    "m/s": Unit("um/min", UM / MINUTE),
    "1/(kg m)": Unit("um/(kg m2)", UM),
}
TRAVEL = Unit("mm", MM)
LATE = Unit("ms", MS)
TYPESET = {
    "um": "µm",
    "uN m": "µN m",
    "uN m s": "µN m s",
    "uN m s2": "µN m s²",
    "um/min": "µm/min",
    "um/sqrt(min)": "µm/√min",
    "uJ": "µJ",
    "kg m2": "kg m²",
    "um/(kg m2)": "µm/(kg m²)",
}


def typeset(text: str) -> str:
    """Return a unit as a printed page has it, and every other text as it is."""
    return TYPESET.get(text, text)


def unit_for(name: str, si: str) -> Unit:
    """Return the unit in which to show a parameter; where masses stop in mm, their lag in ms."""
    if si == "m" and name.startswith(("error_", "backlash_", "play_", "scatter_")):
        return TRAVEL
    if si == "s" and name.startswith("mass_lag"):
        return LATE
    return SHOWN.get(si, Unit(si, 1.0))
