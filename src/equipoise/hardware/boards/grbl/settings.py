"""Comparison of a Grbl board's settings with the testbed file; mm and mm/min, as on the board.

    $100..  steps per mm     $110..  greatest speed, mm/min     $130..  greatest travel, mm
    $120..  acceleration, mm/s^2
    $13  reports in inches   $20  soft limits   $22  homing
    $24  slow and $25  quick speed of homing, mm/min   $26  debouncing, ms   $27  pull-off, mm

Source: Grbl 1.1 wiki, "Configuration". Axes are numbered X Y Z A B C.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.legs import SLOWING
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.reasons.board_faults import BoardRemark
from equipoise.model.reasons.reason import Reason
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, MM

LETTERS = "XYZABC"
NEAR = 1e-3  # relative, chosen: settings are printed to three decimals
SEARCH = 1.5  # of the travel that homing searches, Grbl's own factor
LOCATE = 5.0  # of the pull-off that homing seeks a switch anew, Grbl's own factor
MARGIN = 10.0  # s, chosen: ramps and whatever else settings do not show
UNLISTED = 120.0  # s, chosen: for homing, where a board does not list how quick it is


def disagreement(
    board: MotorBoard, masses: Sequence[SlidingMass], settings: Mapping[int, float]
) -> str:
    """Return the first thing in which board and testbed file differ; empty if there is none.

    What a board does not list (FluidNC keeps homing elsewhere) is not compared.
    """
    if settings.get(13, 0) != 0:
        return "it reports inches ($13=1); wanted millimetres ($13=0)"
    if board.homing and settings.get(22) == 0:
        return "homing is off ($22=0) and the testbed file says homing = true"
    if board.homing and settings.get(20) == 0:
        return "soft limits are off ($20=0); wanted on ($20=1), since it can home"
    by_name = {mass.name: mass for mass in masses}
    found = (_of_axis(axis, by_name[axis.mass], board, settings) for axis in board.axes)
    return next((text for text in found if text), "")


def late_to_stop(
    board: MotorBoard, masses: Sequence[SlidingMass], settings: Mapping[int, float]
) -> list[Reason]:
    """Return the masses that need more than ``SLOWING`` to stop.

    They stop later than a halt should take, and each leg takes longer than its way and speed say.
    """
    speed = {mass.name: mass.speed for mass in masses}
    found: list[Reason] = []
    for axis in board.axes:
        number = 120 + LETTERS.index(axis.letter)
        acceleration, wanted = settings.get(number, 0.0) * MM, speed[axis.mass] / SLOWING
        if 0 < acceleration < wanted * (1 - NEAR):
            numbers = {
                "taken": speed[axis.mass] / acceleration, "acceleration": acceleration,
                "wanted": wanted, "limit": SLOWING,
            }  # fmt: skip
            reason = Reason(BoardRemark.SLOW_TO_STOP, (axis.mass, f"${number}"), numbers)
            found.append(reason)
    return found


def longest_homing(settings: Mapping[int, float], count: int = len(LETTERS)) -> float:
    """Return how long homing takes at most, s: each axis after the other.

    For each axis: search over 1.5 travels and pull off quickly, seek the switch slowly over five
    pull-offs, pull off again; debounced after each of the four.
    """
    quick, slow = settings.get(25, 0.0), settings.get(24, 0.0)
    travels = [settings[130 + k] for k in range(count) if 130 + k in settings]
    if quick <= 0 or slow <= 0 or not travels:
        return UNLISTED
    pull_off, debounce = settings.get(27, 0.0), settings.get(26, 0.0) / 1000
    each = [
        MINUTE * ((SEARCH * abs(travel) + 2 * pull_off) / quick + LOCATE * pull_off / slow)
        + 4 * debounce
        for travel in travels
    ]
    return sum(each) + MARGIN


def _of_axis(
    axis: Axis, mass: SlidingMass, board: MotorBoard, settings: Mapping[int, float]
) -> str:
    k = LETTERS.index(axis.letter)
    missing = [n for n in (100 + k, 110 + k, 130 + k) if n not in settings]
    if missing:
        return f"it has no axis {axis.letter} (no ${missing[0]}), wanted for mass {mass.name}"
    steps, wanted = settings[100 + k], axis.steps_per_m * MM
    if abs(steps - wanted) > NEAR * wanted:
        return f"${100 + k}={steps:g} steps per mm of {axis.letter}; the testbed says {wanted:g}"
    speed = mass.speed * MINUTE / MM
    if settings[110 + k] < speed * (1 - NEAR):
        found = f"${110 + k}={settings[110 + k]:g} mm/min at most of {axis.letter}"
        return f"{found}; mass {mass.name} is to go with {speed:g}"
    return _travel(axis, mass, settings[130 + k]) if board.homing else ""


def _travel(axis: Axis, mass: SlidingMass, greatest: float) -> str:
    """Grbl's machine space after homing is from minus the travel to zero."""
    ends = sorted(axis.position(end) / MM for end in mass.travel)
    if -greatest * (1 + NEAR) <= ends[0] and ends[1] <= NEAR:
        return ""
    found = f"$13{LETTERS.index(axis.letter)}={greatest:g} mm of travel, {-greatest:g} to 0"
    return f"{found}; mass {mass.name} needs {ends[0]:g} to {ends[1]:g} mm"
