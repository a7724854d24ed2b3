"""Comparison of a Grbl board's settings with the testbed file; mm and mm/min, as on the board.

    $100..  steps per mm     $110..  greatest speed, mm/min     $130..  greatest travel, mm
    $13  reports in inches   $20  soft limits   $22  homing

Source: Grbl 1.1 wiki, "Configuration". Axes are numbered X Y Z A B C.
"""

from collections.abc import Mapping, Sequence

from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, MM

LETTERS = "XYZABC"
NEAR = 1e-3  # relative, chosen: settings are printed to three decimals


def disagreement(
    board: MotorBoard, masses: Sequence[SlidingMass], settings: Mapping[int, float]
) -> str:
    """Return the first thing in which board and testbed file differ; empty if there is none."""
    if settings.get(13, 0) != 0:
        return "it reports inches ($13=1); wanted millimetres ($13=0)"
    if board.homing and settings.get(22, 0) == 0:
        return "homing is off ($22=0) and the testbed file says homing = true"
    if board.homing and settings.get(20, 0) == 0:
        return "soft limits are off ($20=0); wanted on ($20=1), since it can home"
    by_name = {mass.name: mass for mass in masses}
    found = (_of_axis(axis, by_name[axis.mass], board, settings) for axis in board.axes)
    return next((text for text in found if text), "")


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
