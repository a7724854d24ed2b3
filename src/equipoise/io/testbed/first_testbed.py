"""The first testbed file of a laboratory: a few answers, and what is assumed beside them.

Whatever nobody has measured gets a wide sd and a remark that begins with ``assumed:``.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from equipoise.io.testbed.testbed_file import written
from equipoise.io.toml.write_toml import toml_text
from equipoise.model.arrays import Vector3
from equipoise.model.mass_properties import MassProperties, second_moments
from equipoise.model.units import GRAM, MM, PERCENT, UM

AttitudeSource = Literal["camera", "motion-capture", "imu", "gyro"]

RAIL_NAMES = {0: (), 3: ("x", "y", "z"), 6: ("x1", "y1", "z1", "x2", "y2", "z2")}

_ATTITUDE = """\
[sensor.attitude]
rate_hz = {rate}  # assumed: {kind}
noise_deg = {noise}  # assumed; `equipoise inspect` shows yours"""
_GYRO = """\
[sensor.gyro]
rate_hz = 50.0  # assumed
noise_deg_s = 0.05  # assumed; `equipoise inspect` shows yours
bias_sd_deg_s = 1.0  # assumed: usual for a low-cost gyro"""
_ACCELEROMETER = """\
[sensor.accelerometer]
rate_hz = 50.0  # assumed
noise_m_s2 = 0.05  # assumed; `equipoise inspect` shows yours
place_mm = [0.0, 0.0, 0.0]  # assumed; measure it from the centre of rotation"""
SENSORS: dict[AttitudeSource, str] = {
    "camera": _ATTITUDE.format(rate=5.0, noise=0.2, kind="a camera that sees markers"),
    "motion-capture": _ATTITUDE.format(rate=100.0, noise=0.05, kind="usual for motion capture"),
    "imu": f"{_ATTITUDE.format(rate=50.0, noise=0.1, kind='an attitude sensor')}\n\n{_GYRO}",
    "gyro": f"{_GYRO}\n\n{_ACCELEROMETER}",
}
# Chosen: an offset for which the platform swings well within the usual stop of 30 deg.
TRUTH = """\
# The simulated platform is drawn from this table; a real one does not need it.
[truth]
com_low_um = [-40.0, -40.0, -200.0]  # assumed: what balancing by hand leaves
com_high_um = [40.0, 40.0, -100.0]
tilt_deg = 5.0  # assumed: the release"""


@dataclass(frozen=True, slots=True, eq=False)
class StatedInertia:
    """An inertia about the centre of mass, where it comes from, and how well it is known."""

    body: MassProperties
    origin: str
    relative_sd: float


@dataclass(frozen=True, slots=True)
class StatedRails:
    """Masses on motors, the same number along each axis."""

    names: tuple[str, ...]
    mass: float  # kg, of each
    travel: float  # m, from home either way


@dataclass(frozen=True, slots=True)
class FirstAnswers:
    """What is known before the first recording."""

    mass: float  # kg
    inertia: StatedInertia
    rails: StatedRails
    attitude: AttitudeSource
    is_simulated: bool


def first_testbed(answers: FirstAnswers) -> str:
    """Return the text of a testbed file, each assumption marked."""
    extents = box_extents(answers.inertia.body)
    parts = [
        'name = "our platform"',
        _platform(answers),
        *(_rail(answers.rails, k, extents) for k in range(len(answers.rails.names))),
        SENSORS[answers.attitude],
        *([TRUTH] if answers.is_simulated else []),
        _assumed(answers),
    ]
    return "\n\n".join(parts) + "\n"


def box_extents(body: MassProperties) -> Vector3:
    """Return edges of the evenly filled box of the same mass and moments, m.

    A box has Sigma_xx = m a^2 / 12 (``mass_properties.second_moments``).
    """
    return np.sqrt(12 * np.diag(second_moments(body.inertia_C)) / body.mass)


def _platform(answers: FirstAnswers) -> str:
    inertia = answers.inertia
    rows = ",\n".join(f"    {_numbers(row)}" for row in inertia.body.inertia_C)
    return f"""\
[platform]
mass_kg = {written(answers.mass)}  # everything that floats
mass_sd_percent = 0.5  # assumed: a bench scale
inertia_kg_m2 = [  # {inertia.origin}
{rows},
]
about = "C"
inertia_sd_percent = {written(inertia.relative_sd / PERCENT)}  # assumed: usual for such a source
com_um = {_numbers(inertia.body.com / UM)}  # from the centre of rotation
com_sd_um = [500.0, 500.0, 500.0]  # assumed: a platform balanced by hand
tilt_limit_deg = 30.0  # assumed: a table on a hemisphere"""


def _rail(rails: StatedRails, number: int, extents: Vector3) -> str:
    """Return a mass that runs along an axis, at a face of the box; the second one opposite."""
    axis, travel = number % 3, written(rails.travel / MM)
    home = np.zeros(3)
    side = (axis + 1) % 3
    home[side] = (1 if number < 3 else -1) * extents[side] / 2
    return f"""\
[[sliding_mass]]
name = "{rails.names[number]}"
mass_g = {written(rails.mass / GRAM)}
home_mm = {_numbers(np.round(home / MM, 1))}  # assumed: at a face of the platform
axis = {_numbers(np.eye(3)[axis])}  # assumed
travel_mm = [-{travel}, {travel}]
resolution_mm = 0.01  # assumed: a stepper on a lead screw
accuracy_mm = 0.1  # assumed: a lead screw
speed_mm_s = 10.0  # assumed: a small stepper on a lead screw"""


def _assumed(answers: FirstAnswers) -> str:
    """Return the table that a report shows."""
    reasons = {
        "platform.mass_sd_percent": "a bench scale",
        "platform.inertia_sd_percent": answers.inertia.origin.removeprefix("assumed: "),
        "platform.com_sd_um": "a platform balanced by hand",
        "platform.tilt_limit_deg": "a table on a hemisphere",
        "sensor": f"usual for {answers.attitude}",
    }
    if answers.rails.names:
        reasons["sliding_mass"] = "places at the faces of the platform; a stepper on a lead screw"
    if answers.is_simulated:
        reasons["truth"] = "what balancing by hand leaves"
    return toml_text({"assumed": reasons}).strip()


def _numbers(values: Vector3) -> str:
    return f"[{', '.join(str(written(float(value))) for value in values)}]"
