"""The settings that a careful person would have made on an emulated Grbl board for its masses.

mm, mm/min, mm/s^2, as on the board. Source: Grbl 1.1 wiki, "Configuration".
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.emulated.grbl.motion import LETTERS
from equipoise.model.hardware import MotorBoard
from equipoise.model.testbed import SlidingMass
from equipoise.model.units import MINUTE, MM

IDLE_DELAY, PULL_OFF = 25.0, 1.0  # ms, mm: $1 and $27 as delivered
DEBOUNCE = 25.0  # ms, chosen: for optical switches; 250 as delivered
SLOWLY = 100.0  # mm/min, chosen: how a switch is found exactly
STOPS_WITHIN = 0.05  # s, chosen: half of what the driver wants
WHOLE = (0, 1, 2, 3, 4, 5, 6, 10, 13, 20, 21, 22, 23, 26, 30, 31, 32)  # printed without decimals


def careful_settings(
    board: MotorBoard, masses: Sequence[SlidingMass], count: int
) -> dict[int, float]:
    """Return all settings by number."""
    found: dict[int, float] = {0: 10, 1: IDLE_DELAY, 2: 0, 3: 0, 4: 0, 5: 0, 6: 0, 10: 1}
    found |= {11: 0.01, 12: 0.002, 13: 0, 20: 0, 21: 0, 22: 0, 23: 0, 24: SLOWLY, 25: 500.0}
    found |= {26: DEBOUNCE, 27: PULL_OFF, 30: 1000, 31: 0, 32: 0}
    for k in range(count):
        found |= {100 + k: 250.0, 110 + k: 500.0, 120 + k: 200.0, 130 + k: 200.0}
    by_name = {mass.name: mass for mass in masses}
    for axis in board.axes:
        k, speed = LETTERS.index(axis.letter), by_name[axis.mass].speed / MM
        found[100 + k] = axis.steps_per_m * MM
        found[110 + k], found[120 + k] = speed * MINUTE, speed / STOPS_WITHIN
    if board.homing:
        found |= {20: 1, 22: 1}
    return found


def homing_takes(settings: Mapping[int, float], farthest: float) -> float:
    """Return how long homing takes from so far away (mm), s: Z first, then the others at once.

    To the switch quickly, off, slowly back, and off again; debounced after each.
    """
    quick, slow, pull_off = settings[25] / MINUTE, settings[24] / MINUTE, settings[27]
    one = (farthest + 2 * pull_off) / quick + pull_off / slow + 4 * settings[26] / 1000
    return 2 * one


def shown(number: int, value: float) -> str:
    """Return a setting's value as it is printed."""
    return f"{value:.0f}" if number in WHOLE else f"{value:.3f}"
