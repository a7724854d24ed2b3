"""The five questions of ``equipoise new``, and what their answers mean."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from equipoise.app.console.questions import Question
from equipoise.app.text.escaping import for_one_line
from equipoise.estimation.mass_budget.shapes import SQUARES
from equipoise.io.exchange.body_file import read_foreign_body
from equipoise.io.testbed.first_testbed import (
    RAIL_NAMES,
    AttitudeSource,
    FirstAnswers,
    StatedInertia,
    StatedRails,
)
from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError, nearest
from equipoise.model.mass_properties import MassProperties
from equipoise.model.units import GRAM, MM

BOX_SD = 0.3  # chosen: a platform is no evenly filled box
CAD_SD = 0.1  # chosen: usual for CAD without cabling
SIMULATED: Literal["simulate"] = "simulate"
ON_BENCH: Literal["bench"] = "bench"
Origin = Path | Literal["simulate", "bench"]
Given = MassProperties | Vector3  # about C; or edges of a box, m


@dataclass(frozen=True, slots=True)
class FirstChoice:
    """The answers, and where the recording comes from."""

    answers: FirstAnswers
    origin: Origin


def read_mass(text: str) -> float:
    """Return a mass, kg."""
    (mass,) = _numbers(text, "mass", 1, "one number in kg, such as 14.2")
    return mass


def read_inertia(text: str) -> tuple[Given, str]:
    """Return a body of a file, or the edges of a box, and which it was."""
    if text[:1].isdigit():
        wanted = "a file, or length, width and height in mm, such as 400 400 300"
        edges = _numbers(text, "inertia", 3, wanted)
        return np.array(edges) * MM, f"assumed: an evenly filled box of {text} mm"
    path = Path(text).expanduser()
    body, _ = read_foreign_body(path)
    return body, f"from {for_one_line(path.name)}"


def read_rails(text: str) -> StatedRails:
    """Return how many masses there are, their mass and their travel."""
    wanted = "0, or number (3 or 6), mass in g and travel in mm, such as 3 100 30"
    words = text.split()
    if words == ["0"]:
        return StatedRails((), 0.0, 0.0)
    number, mass, travel = _numbers(text, "masses", 3, wanted)
    if number not in RAIL_NAMES:
        raise InputError("masses", f"{number:g} masses", wanted)
    return StatedRails(RAIL_NAMES[int(number)], mass * GRAM, travel * MM)


def read_attitude(text: str) -> AttitudeSource:
    """Return what measures the attitude."""
    for known in get_args(AttitudeSource):
        if text.lower() == known:
            return known
    raise InputError("attitude", f"'{text}'", nearest(text, list(get_args(AttitudeSource))))


def read_origin(text: str) -> Origin:
    """Return where the recording comes from."""
    if text == SIMULATED:
        return SIMULATED
    if text == ON_BENCH:
        return ON_BENCH
    path = Path(text).expanduser()
    if not path.is_file():
        raise InputError("recording", f"no file '{text}'", f"a file, {SIMULATED} or {ON_BENCH}")
    return path


MASS = Question("Mass of everything that floats, in kg", "10", read_mass)
INERTIA = Question(
    "Inertia: a CAD file, or length, width and height in mm", "400 400 300", read_inertia
)
RAILS = Question(
    "Masses on motors: number (0, 3 or 6), mass of each in g, travel either way in mm",
    "3 100 30", read_rails,
)  # fmt: skip
ATTITUDE = Question(
    "Attitude is measured by camera, motion-capture, imu or gyro", "imu", read_attitude
)
RECORDING = Question(
    f"Recording: a file, {SIMULATED} (try it first) or {ON_BENCH}", SIMULATED, read_origin
)


def first_choice(answer_to: Callable[[Question[Any], int], Any]) -> FirstChoice:
    """Return what a person, or each default, answers to each question and its number."""
    mass = answer_to(MASS, 1)
    inertia = stated_inertia(mass, *answer_to(INERTIA, 2))
    rails, attitude, origin = answer_to(RAILS, 3), answer_to(ATTITUDE, 4), answer_to(RECORDING, 5)
    return FirstChoice(FirstAnswers(mass, inertia, rails, attitude, origin == SIMULATED), origin)


def stated_inertia(mass: float, given: Given, origin: str) -> StatedInertia:
    """Return the inertia of a file, or of a box of that mass (kg)."""
    if isinstance(given, MassProperties):
        return StatedInertia(given, origin, CAD_SD)
    inertia = mass * np.diag(SQUARES["box"] @ given**2)
    return StatedInertia(MassProperties(mass, np.zeros(3), inertia), origin, BOX_SD)


def _numbers(text: str, where: str, size: int, wanted: str) -> tuple[float, ...]:
    """Return so many numbers above zero; ``x`` and commas may stand between them."""
    words = text.lower().replace("x", " ").replace(",", " ").split()
    try:
        numbers = tuple(map(float, words))
    except ValueError:
        raise InputError(where, f"'{text}'", wanted) from None
    if len(numbers) != size or not all(0 < number < np.inf for number in numbers):
        raise InputError(where, f"'{text}'", wanted)
    return numbers
