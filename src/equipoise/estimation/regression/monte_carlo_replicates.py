"""Records as they might have been: the stated errors of sensors, masses and testbed drawn anew.

What noise does to a linear estimate is found by adding it once more, always the same draws with
both signs. With x_0 from the record and x_+k, x_-k from the record with the k-th draw added and
subtracted,

    covariance = mean of d_k d_k^T,    d_k = (x_+k - x_-k) / 2
    bias       = mean of (x_+k + x_-k) / 2 - x_0

the bias being what the noise that is in the record already has done, to second order (the idea of
simulation and extrapolation, Cook and Stefanski 1994). No formulation needs a derivation of its
own, and what a smoother or an integral does to white noise is counted as it is.

Drawn are: noise of camera and gyro; how the camera's vertical leans; where masses stopped and how
late they are; and what the estimate takes as known though nobody stated it: the gyro's bias and the
first tilt where there is no camera, and the testbed's inertia where that is not sought.
Cannot draw what nobody stated.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.mass_errors import mass_errors
from equipoise.dynamics.timeline import straight_lines
from equipoise.estimation.motion.fused_motion import led_motion
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise
from equipoise.estimation.regression.formulations.rows import Posed
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import element_sizes, pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed

PAIRS = 24  # chosen: sd are known to 15 %, which intervals count (``linear``)
SEED = 20210  # of the draws, which are the same for every record
TILTED = 0.5  # of the tilt limit, chosen: where a platform without camera may begin
MOST_OFF = 2.0  # sd, chosen: an inertia drawn farther off may be none


class Drawn(NamedTuple):
    """What is drawn beside the noise of the sensors."""

    constant: bool = True  # what is off by the same all along: lean, stops, lag, bias, first tilt
    inertia: bool = False  # the testbed's, for a method that takes it as known


def pairs(posed: Posed, what: Drawn, count: int = PAIRS) -> Iterator[tuple[Posed, Posed]]:
    """Return the record with each draw added and subtracted."""
    for k in range(count):
        yield drawn(posed, k, 1.0, what), drawn(posed, k, -1.0, what)


def drawn(posed: Posed, k: int, sign: float, what: Drawn) -> Posed:
    """Return the record with the k-th draw."""
    rng = np.random.default_rng([SEED, k])
    recording, testbed = posed.recording, posed.testbed
    alone = recording.attitude is None or not len(recording.attitude)
    constant = sign * what.constant
    recording = replace(
        recording,
        attitude=turned(recording.attitude, testbed, (sign, constant), rng),
        rate=shaken(recording.rate, testbed, (sign, constant * alone), rng),
        masses=misplaced(recording, testbed, constant, rng),
    )
    if alone:
        testbed = replace(testbed, up=tilted(testbed, constant, rng))
    if what.inertia:
        testbed = with_other_inertia(testbed, sign, rng)
    return Posed(recording, testbed, led_motion(recording, testbed), posed.terms)


def turned(
    camera: Samples | None, testbed: Testbed, signs: tuple[float, float], rng: np.random.Generator
) -> Samples | None:
    """Return the camera's rows with noise, its vertical leaning."""
    if camera is None:
        return None
    lean_sd = testbed.attitude.plumb_sd if testbed.attitude else 0.0
    noise = exponential(signs[0] * camera_noise(testbed) * rng.normal(size=(len(camera), 3)))
    lean = exponential(signs[1] * lean_sd * np.array([*rng.normal(size=2), 0.0]))
    return Samples(camera.t, multiply(lean, multiply(camera.values, noise)))


def shaken(
    gyro: Samples | None, testbed: Testbed, signs: tuple[float, float], rng: np.random.Generator
) -> Samples | None:
    """Return the gyro's rows with noise, and with a bias where nobody can see it."""
    if gyro is None:
        return None
    bias_sd = testbed.gyro.bias_sd if testbed.gyro else 0.0
    noise = gyro_noise(testbed) * rng.normal(size=(len(gyro), 3))
    bias = bias_sd * rng.normal(size=3)
    return Samples(gyro.t, gyro.values + signs[0] * noise + signs[1] * bias)


def misplaced(
    recording: Recording, testbed: Testbed, sign: float, rng: np.random.Generator
) -> Samples | None:
    """Return the masses where they may have been."""
    errors = mass_errors(recording.masses, testbed.masses)
    if errors.response is None or not len(errors.sd):
        return recording.masses
    t, response = errors.response.t, errors.response.values
    off = sign * errors.sd * rng.normal(size=len(errors.sd))
    moved = straight_lines(recording.masses, t, len(testbed.masses))
    for j, (mass, k) in enumerate(errors.owner):
        moved[:, mass] += off[k] * response[:, j]
    return Samples(t, moved)


def tilted(testbed: Testbed, sign: float, rng: np.random.Generator) -> Floats:
    """Return another body axis that points up at the start."""
    turn = rng.normal(size=3)
    turn -= testbed.up * (turn @ testbed.up)
    turned_by = exponential(sign * TILTED * testbed.tilt_limit * turn)
    return to_matrix(turned_by) @ testbed.up


def with_other_inertia(testbed: Testbed, sign: float, rng: np.random.Generator) -> Testbed:
    """Return the testbed with an inertia that it may as well have; the same where none has it.

    Moments may break the triangle inequality: a flat body's draws would all be small otherwise.
    """
    J = testbed.body.inertia_P
    size = testbed.inertia_sd * element_sizes(J)
    off = size * np.clip(rng.normal(size=6), -MOST_OFF, MOST_OFF)
    drawn_P = unpack_symmetric(pack_symmetric(J) + sign * off)
    if np.linalg.eigvalsh(drawn_P)[0] <= 0:
        return testbed
    return replace(testbed, body=replace(testbed.body, inertia_P=drawn_P))
