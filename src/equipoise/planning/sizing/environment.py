"""Effects of room, deck and bearing on a balanced platform, as torque within a tilt of level.

    warmth        |dr| = alpha L dT a        of a body that grows lopsidedly by the share a
    sag           C = c u u^T,  c = s g / (2 pi f)^2, u up: the rest after the best trim
    sphericity    m g delta                  the centre of rotation wanders by the form error
    buoyancy      |dr| = x rho V l / m       air that V displaces at a lever l grows denser by x
    Earth         3 (g / R) n x J n          gradient of gravity, n along it
                  |J w| Omega                gyroscopic, at a rate w; the greatest moment counts
    air           as stated, sd s; and the mean of it over a measurement of T, which is taken for
                  gravity's:  s^2 2 x (1 - x (1 - exp(-1/x))),  x = 30 s / T

g / (2 pi f)^2 is how far a mass sinks that swings at f on its spring; s is the share of it that the
centre of mass takes part in. Shifts dr may have any direction. Zero terms are left out.

Sizes of these on tables of some 14 kg: 0.7 um per K for 0.3 m of aluminium; 25 um at 100 Hz; form
errors of 0.1 to 0.5 um; air and bearing 0.4 to 3 uN m, as measured on a platform of 2.7 kg.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.sag_trim import downs, residual_torque, trimmed_com
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.testbed import AIR_TIME, Testbed
from equipoise.planning.sizing.expected_torque import (
    ASSUMED,
    PARTLY,
    REQUESTED,
    TESTBED,
    Line,
    expected_torque,
)

EARTH_RADIUS = 6.371e6  # m, mean
EARTH_RATE = 7.292e-5  # rad/s
AIR_DENSITY = 1.2  # kg/m^3, at 20 C and 1013 hPa


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The surroundings between the last measurement and the experiment. Zero: not stated."""

    temperature: float = 0.0  # K, change of
    expansion: float = 23e-6  # 1/K, aluminium
    length: float = 0.3  # m, chosen: from the bearing to what is heavy
    lopsided: float = 0.1  # -, chosen: share by which one side grows more
    bending: float = 0.0  # Hz, lowest bending mode of the deck
    bending_share: float = 1.0  # -, the greatest: all of the platform stands on the deck
    form_error: float = 0.0  # m, rms, of the bearing's sphere
    air_change: float = 0.0  # -, relative, of its density
    volume: float = 0.0  # m^3, of the platform
    lever: float = 0.05  # m, chosen: from the centre of that volume to the bearing
    slew: float = 0.0  # rad/s, at which the platform is turned
    air: float = 1e-6  # N m, rms, chosen: as others measured


PLAIN = Surroundings()


def surrounding_lines(testbed: Testbed, around: Surroundings, tilt: float) -> Iterator[Line]:
    """Yield the lines of what is stated, and of what always acts; ``tilt`` in rad."""
    weight = testbed.weight
    warm = basis_of(around, "expansion", "length", "lopsided")
    drift = any_way(testbed, warmth(around), tilt)
    yield Line("warmth", "Room temperature", *drift, warm)
    if around.bending > 0:
        left, cause = (
            sag_left(testbed, around, tilt),
            "Sag of the deck after the best trim",
        )
        yield Line("sag", cause, left, None, basis_of(around, "bending_share"))
    form = weight * around.form_error
    yield Line("sphericity", "Form error of the bearing", form, None, REQUESTED)
    lift, cause = (
        any_way(testbed, buoyancy(testbed, around), tilt),
        "Change of air density",
    )
    yield Line("buoyancy", cause, *lift, basis_of(around, "lever"))
    across = gradient(testbed, tilt)
    yield Line("gravity gradient", "The Earth's gravity gradient", across, None, TESTBED)
    turning = float(np.linalg.eigvalsh(testbed.body.inertia_P)[-1]) * around.slew * EARTH_RATE
    yield Line("Earth's rate", "The Earth's rate", turning, None, REQUESTED)
    air = ASSUMED if around.air == PLAIN.air else REQUESTED
    yield Line("air", "Air of room and bearing", around.air, None, air)


def air_in_measurement(around: Surroundings, duration: float) -> Line:
    """Return the line of air that a measurement of ``duration`` (s) takes for gravity.

    The mean over T of an Ornstein-Uhlenbeck process (``momentum_balance``), as torque.
    """
    x = AIR_TIME / duration
    share = 2 * x * (1 - x * (1 - np.exp(-1 / x)))
    taken = around.air * float(np.sqrt(share))
    basis = ASSUMED if around.air == PLAIN.air else REQUESTED
    return Line("measured air", "Air taken for gravity in the measurement", taken, None, basis)


def basis_of(around: Surroundings, *names: str) -> str:
    """Say whether some of the numbers behind a line were left as they are assumed."""
    left = any(getattr(around, name) == getattr(PLAIN, name) for name in names)
    return PARTLY if left else REQUESTED


def not_stated(around: Surroundings) -> tuple[str, ...]:
    """Return the effects that were not stated, and therefore do not count."""
    stated = {
        "warmth": around.temperature,
        "sag of the deck": around.bending,
        "form error of the bearing": around.form_error,
        "density of the air": around.air_change * around.volume,
        "Earth rate during slews": around.slew,
    }
    return tuple(name for name, value in stated.items() if value == 0)


def any_way(testbed: Testbed, size: float, tilt: float) -> tuple[float, Matrix3]:
    """Return torque and moment of a centre of mass that moves by ``size`` (m) in any direction."""
    moment: Matrix3 = size**2 / 3 * np.eye(3)
    return expected_torque(testbed, moment, tilt), moment


def warmth(around: Surroundings) -> float:
    """Return how far (m) warmth moves the centre of mass."""
    return around.expansion * around.length * around.temperature * around.lopsided


def sag_of(testbed: Testbed, around: Surroundings) -> float:
    """Return how far (m) the centre of mass of the level platform hangs by its deck's sag."""
    return around.bending_share * testbed.gravity / (2 * np.pi * around.bending) ** 2


def sag_left(testbed: Testbed, around: Surroundings, tilt: float) -> float:
    """Return the residual torque (N m) of a deck's sag after the best trim."""
    sag: Matrix3 = sag_of(testbed, around) * np.outer(testbed.up, testbed.up)
    trim: Vector3 = trimmed_com(sag, testbed.up, tilt)
    return testbed.weight * residual_torque(trim, sag, testbed.up, tilt)


def buoyancy(testbed: Testbed, around: Surroundings) -> float:
    """Return the shift (m) of the centre of mass that is equivalent to denser air."""
    displaced = AIR_DENSITY * around.volume * around.air_change
    return displaced * around.lever / testbed.body.mass


def gradient(testbed: Testbed, tilt: float) -> float:
    """Return the torque (N m) of the Earth's gravity gradient, rms within the tilt."""
    n, weight = downs(testbed.up, tilt)
    turned = np.cross(n, n @ testbed.body.inertia_P)
    return 3 * testbed.gravity / EARTH_RADIUS * float(np.sqrt(np.sum(weight * turned**2)))
