"""Case S: two minutes of a camera alone, three masses moved at half time.

14 kg, J 0.35 / 0.54 / 0.85 kg m^2 with small products, r = (2, -3, -80) um, 5 Hz and 0.2 deg, tilt
up to 14 deg, rates up to 1.3 deg/s; masses of 31.2 g go by (-10, -10, -50) mm at 60 s. Made with
our own propagator (which `independent_truth` checks) plus white camera noise.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.arrays import Floats, Vector6
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import SlidingMass, Testbed
from tests.support import builders

SECONDS, MOVED_AT, CAMERA = 120.0, 60.0, 5.0
MASS, COM = 14.0, np.array([2.0, -3.0, -80.0]) * 1e-6
MOMENTS = np.array([0.35, 0.54, 0.85])
PRODUCTS = 0.01  # kg m^2, one sd
TRACK = builders.move_at(MOVED_AT, SECONDS)  # to (-10, -10, -50) mm at 10 mm/s
MASSES: tuple[SlidingMass, ...] = tuple(
    replace(mass, mass=0.0312) for mass in builders.sliding_masses()
)
SHIFT = com_shift(mass_maps(MASSES), MASS, TRACK.values[-1])  # m


class Case(NamedTuple):
    """One platform, and how it starts."""

    inertia: Vector6  # kg m^2
    q0: Floats
    rate: Floats  # rad/s


def case(seed: int) -> Case:
    """Return the platform of one seed."""
    rng = np.random.default_rng([seed, 1])
    inertia = np.concatenate([MOMENTS, PRODUCTS * rng.normal(size=3)])
    way, tilt = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(4.0, 14.0))
    q0 = exponential(tilt * np.array([np.cos(way), np.sin(way), 0.0]))
    heading = rng.uniform(0, 2 * np.pi)
    q0 = multiply(q0, exponential(np.array([0.0, 0.0, heading])))
    spin = rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 0.9)
    rate = np.radians([*rng.uniform(-0.65, 0.65, 2), spin])
    return Case(inertia, q0, to_matrix(q0).T @ rate)


class Event(NamedTuple):
    """What happens to the platform, apart from free motion."""

    t: float  # s
    impulse: Floats  # N m s, body axes
    shift: Floats  # m, of the centre of mass


def clean(seed: int, event: Event | None = None) -> Recording:
    """Return what a perfect camera would have recorded."""
    t, one = np.arange(int(SECONDS * CAMERA) + 1) / CAMERA, case(seed)
    cut = SECONDS if event is None else event.t
    before = np.append(t[t < cut], cut)
    q, end, rate = stretch(before, one.inertia, COM, one.q0, one.rate)
    if event is not None:
        rate = rate + np.linalg.solve(unpack_symmetric(one.inertia), event.impulse)
        later = np.append(cut, t[t > cut])
        more, _, _ = stretch(later, one.inertia, COM + event.shift, end, rate)
        q = np.vstack([q[: int(np.sum(t < cut))], more[-int(np.sum(t >= cut)) :]])
    return Recording(Samples(t, q), None, ("x", "y", "z"), TRACK)


def stretch(
    t: Floats, inertia: Vector6, com: Floats, q0: Floats, rate: Floats
) -> tuple[Floats, Floats, Floats]:
    """Return attitudes at times t (s), and attitude and rate at the last."""
    line = builders.line_of(t, TRACK)
    body = body_of(MASS, builders.GRAVITY, inertia, MASS * com)
    motion = propagate(body, builders.maps(MASSES), line, q0, rate)
    return motion.q[line.attitude_node], motion.q[-1], motion.rate[-1]


def run(seed: int, event: Event | None = None, louder: float = 1.0) -> Recording:
    """Return what the camera recorded, its noise being ``louder`` times as stated."""
    record, rng = clean(seed, event), np.random.default_rng(seed)
    attitude = record.attitude
    error = exponential(louder * builders.CAMERA_SD * rng.normal(size=(len(attitude), 3)))
    return replace(record, attitude=Samples(attitude.t, multiply(attitude.values, error)))


def way(seed: int) -> Floats:
    """Return a direction."""
    vector = np.random.default_rng([seed, 9]).normal(size=3)
    return vector / np.linalg.norm(vector)


def estimated(true: Vector6, doubt: float, rng: np.random.Generator) -> MassProperties:
    """Return what is believed of a body, wrong by ``doubt`` (one sd of J).

    The truth is normal about what is believed, element by element of J, with an sd that is a share
    of the size sqrt(J_ii J_jj) of what is believed;
    drawn until the belief is an inertia that a body can have.
    """
    while True:
        normal, drawn = rng.normal(size=6), true
        for _ in range(50):
            drawn = true - doubt * element_sizes(unpack_symmetric(drawn)) * normal
        guess = MassProperties(MASS, np.array([0.0, 0.0, -100e-6]), unpack_symmetric(drawn))
        if np.all(drawn[:3] > 0) and is_possible(guess):
            return guess


def testbed(seed: int, doubt: float) -> Testbed:
    """Return what is known beforehand; its inertia is wrong by ``doubt``."""
    guess = estimated(case(seed).inertia, doubt, np.random.default_rng([seed, 5]))
    return replace(builders.platform(), body=guess, masses=MASSES, inertia_sd=doubt)


testbed.__test__ = False  # pytest would take its name for a test's
