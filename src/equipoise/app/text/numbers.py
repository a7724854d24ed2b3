"""Numbers with as many digits as their uncertainty bears, in the units of the bench.

Two digits of the sd are shown; the units are um, mm, g, deg, deg/s and uN m.
"""

import math
from dataclasses import dataclass

from equipoise.model.units import DEG, GRAM, MINUTE, MM, MS, UM, UN_M, UT

DIGITS = 2  # of the sd; the second keeps its rounding below 5 %
EXACT = 1e-6  # chosen: an sd below this share of the value is none; the value was held
FINEST = 1e-10  # chosen: an sd below this, in any unit that is shown, is none, at zero too
LEAST, MOST = 1e-3, 1e6  # numbers that people read without an exponent
FEW = 4  # significant digits of a number without an sd


def decimals_for(sd: float) -> int:
    """Return how many decimals show two digits of an sd; negative left of the point."""
    shown = float(f"{sd:.{DIGITS - 1}e}")  # 0.0996 is shown as 0.10
    return DIGITS - 1 - math.floor(math.log10(shown))


def fixed(value: float, decimals: int) -> str:
    """Return a number with so many decimals; negative ones round left of the point."""
    text = f"{round(value, decimals):.{max(decimals, 0)}f}"
    return text.removeprefix("-") if not float(text) else text


def significant(value: float, digits: int = 3) -> str:
    """Return a number with so many digits that count, without an exponent if it is of the bench."""
    if value == 0 or not math.isfinite(value) or not LEAST <= abs(value) < MOST:
        return f"{value:.{digits}g}"
    return fixed(value, digits - 1 - math.floor(math.log10(abs(value))))


def is_known(value: float, sd: float) -> bool:
    """Say whether an sd is a number from which digits can be taken."""
    return math.isfinite(sd) and sd > max(EXACT * abs(value), FINEST)


def with_sd(value: float, sd: float) -> tuple[str, str]:
    """Return value and sd as texts; in place of an sd, that a value was held or is unobservable."""
    if is_known(value, sd):
        decimals = decimals_for(sd)
        return fixed(value, decimals), fixed(sd, decimals)
    return f"{value:.{FEW}g}", "held" if math.isfinite(sd) else "unobservable"


def interval(value: float, low: float, high: float, sd: float) -> str:
    """Return a 95 % interval with the digits that the sd bears."""
    if not is_known(value, sd):
        return "" if math.isfinite(sd) else "unbounded"
    decimals = decimals_for(sd)
    return f"{fixed(low, decimals)} to {fixed(high, decimals)}"


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
    "m/K": Unit("um/K", UM),
    "T": Unit("uT", UT),
    "1/(kg m)": Unit("um/(kg m2)", UM),
}
TRAVEL = Unit("mm", MM)
ON_TABLE = {  # by the stem of a name: slopes, and how the bearing moves over a table
    "slope": Unit("um/m", UM),
    "lean": Unit("um/m", UM),
    "position": Unit("mm", MM),
    "velocity": Unit("mm/s", MM),
}
LATE = Unit("ms", MS)
TYPESET = {
    "um": "µm",
    "uN m": "µN m",
    "uN m s": "µN m s",
    "uN m s2": "µN m s²",
    "um/min": "µm/min",
    "um/K": "µm/K",
    "um/m": "µm/m",
    "uT": "µT",
    "um/sqrt(min)": "µm/√min",
    "uJ": "µJ",
    "kg m2": "kg m²",
    "um/(kg m2)": "µm/(kg m²)",
}


def typeset(text: str) -> str:
    """Return a unit as a printed page has it, and every other text as it is."""
    return TYPESET.get(text, text)


def unit_for(name: str, si: str) -> Unit:
    """Return the unit in which to show a parameter; where masses stop in mm, when in ms."""
    if si == "m" and name.startswith(("error_", "backlash_", "play_", "scatter_")):
        return TRAVEL
    if (stem := name.rpartition("_")[0]) in ON_TABLE:
        return ON_TABLE[stem]
    if si == "s" and name.startswith(("mass_lag", "departure_", "arrival_", "spread_")):
        return LATE
    return SHOWN.get(si, Unit(si, 1.0))
