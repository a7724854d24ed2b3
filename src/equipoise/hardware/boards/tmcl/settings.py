"""Comparison of a TMCL module's settings with the testbed file, and the units of its speeds.

    speed, microsteps/s                  acceleration, microsteps/s^2
    v                                    a                              with a TMC5xxx or TMC4361
    v f / (2^pulse 2048 32)              a f^2 / 2^(pulse + ramp + 29)  with a TMC428 or TMC429

The latter (TMCM-1110, 1140, 1160, 1161, 3110, 6110) have axis parameters 153 ramp and 154 pulse
divisor, f = 16 MHz and values up to 2047; the former (TMCM-1211, 1241, 3216, 6212, 6214) do not
have them, and count so while 255, where there is one, is 1. Source: TMCM-1140 Hardware Manual
V1.01, 8.1; TMCM-3212 TMCL Firmware Manual V1.07, 6.5.
"""

from collections.abc import Mapping, Sequence

from equipoise.hardware.boards.legs import SLOWING
from equipoise.hardware.boards.tmcl import words as w
from equipoise.hardware.boards.tmcl.talk import Answer
from equipoise.hardware.boards.tmcl.words import Request, refusal
from equipoise.model.hardware import Axis, MotorBoard
from equipoise.model.testbed import SlidingMass

CLOCK = 16e6  # Hz
GREATEST, MOST_DIVISOR = 2047, 13  # of a TMC429: speed and the powers of two that divide it
NEAR = 0.01  # relative, chosen: of a speed, as a TMC429 has steps of it
WANTED = (w.AT, w.MICROSTEPS, w.MOST_ACCELERATION, w.RIGHT_OFF, w.LEFT_OFF)
ONLY_SOME = (w.PULSE_DIVISOR, w.RAMP_DIVISOR, w.UNITS)

Answers = Mapping[Request, Answer]


def questions(board: MotorBoard) -> Sequence[Request]:
    """Return what is asked before anything moves."""
    return [
        Request(w.GAP, type_, int(axis.letter))
        for axis in board.axes
        for type_ in (*WANTED, *ONLY_SOME)
    ]


def disagreement(board: MotorBoard, masses: Sequence[SlidingMass], answers: Answers) -> str:
    """Return the first thing in which module and testbed file differ; empty if there is none."""
    by_name = {mass.name: mass for mass in masses}
    found = (_of_axis(axis, by_name[axis.mass], answers) for axis in board.axes)
    return next((text for text in found if text), "")


def speed_value(axis: Axis, mass: SlidingMass, answers: Answers) -> int:
    """Return a mass's speed as the module has it."""
    return round(mass.speed * axis.steps_per_m / _speed_unit(axis, answers))


def guards(axis: Axis, answers: Answers) -> Mapping[int, int]:
    """Return the limit switches that stop a motor, by the sign of the way that they end."""
    switches = {1: (w.RIGHT, w.RIGHT_OFF), -1: (w.LEFT, w.LEFT_OFF)}
    return {
        sign: switch
        for sign, (switch, off) in switches.items()
        if not _reported(axis, off, answers)
    }


def _of_axis(axis: Axis, mass: SlidingMass, answers: Answers) -> str:
    for type_ in WANTED:
        request = Request(w.GAP, type_, int(axis.letter))
        answer = answers[request]
        if not answer.done:
            what = refusal(request, answer.status)
            return f"it is no stepper module, or has no motor {axis.letter}: {what}"
    if _reported(axis, w.UNITS, answers) == 0:
        return f"motor {axis.letter} counts in units of its own (255 is 0); wanted pps (255 is 1)"
    for type_ in (w.PULSE_DIVISOR, w.RAMP_DIVISOR):
        divisor = _reported(axis, type_, answers)
        if divisor is not None and not 0 <= divisor <= MOST_DIVISOR:
            return (
                f"motor {axis.letter} has divisor {divisor} ({type_}); wanted 0 to {MOST_DIVISOR}"
            )
    return _speed(axis, mass, answers) or _slowing(axis, mass, answers)


def _speed(axis: Axis, mass: SlidingMass, answers: Answers) -> str:
    unit, value = _speed_unit(axis, answers), speed_value(axis, mass, answers)
    wanted = mass.speed * axis.steps_per_m
    divisor = _reported(axis, w.PULSE_DIVISOR, answers)
    if divisor is None or (value <= GREATEST and abs(value * unit - wanted) <= NEAR * wanted):
        return ""
    change = "less" if value > GREATEST else "more"
    return (
        f"motor {axis.letter} with pulse divisor {divisor} (154) cannot go at {wanted:g} "
        f"microsteps/s, which mass {mass.name} needs; wanted {change}"
    )


def _slowing(axis: Axis, mass: SlidingMass, answers: Answers) -> str:
    acceleration = (_reported(axis, w.MOST_ACCELERATION, answers) or 0) * _steepness(axis, answers)
    least = mass.speed * axis.steps_per_m / SLOWING
    if acceleration >= least * (1 - NEAR):
        return ""
    found = f"motor {axis.letter} changes its speed by {acceleration:g} microsteps/s^2 at most (5)"
    return f"{found}; mass {mass.name} needs {least:g} to stop within {SLOWING:g} s"


def _speed_unit(axis: Axis, answers: Answers) -> float:
    divisor = _reported(axis, w.PULSE_DIVISOR, answers)
    return 1.0 if divisor is None else CLOCK / (2.0**divisor * 2048 * 32)


def _steepness(axis: Axis, answers: Answers) -> float:
    """Return the unit of acceleration, microsteps/s^2."""
    pulse = _reported(axis, w.PULSE_DIVISOR, answers)
    ramp = _reported(axis, w.RAMP_DIVISOR, answers)
    return 1.0 if pulse is None or ramp is None else CLOCK**2 / 2.0 ** (pulse + ramp + 29)


def _reported(axis: Axis, type_: int, answers: Answers) -> int | None:
    answer = answers[Request(w.GAP, type_, int(axis.letter))]
    return answer.value if answer.done else None
