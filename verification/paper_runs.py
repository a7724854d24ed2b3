"""Runs like those of Ivanov et al. (2021): the published body, three masses, one exact move.

Made with our own propagator (which `independent_truth` checks) plus white camera noise.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import evaluate
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.io.testbed.presets import read_preset
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import exponential
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Vector6
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.camera import N_SENSOR
from tests.support import builders

SECONDS, MOVED_AT = 120.0, 60.0
TRACK = builders.move_at(MOVED_AT, SECONDS)  # to (-10, -10, -50) mm at 10 mm/s
PUBLISHED = builders.INERTIA  # kg m^2 about P, xx yy zz xy xz yz
ROUNDER = PUBLISHED - np.array([0, 0, 0.0782, 0, 0, 0])  # J_zz 0.80: far from flat
TILT = np.radians([3.0, 5.0])
SHIFT = com_shift(mass_maps(builders.sliding_masses()), builders.MASS, TRACK.values[-1])  # m


def testbed() -> Testbed:
    """Return what is known beforehand: the inertia from CAD, as printed, com 100 um below."""
    cad = read_preset("sputnix").body.inertia_P
    guess = MassProperties(builders.MASS, np.array([0.0, 0.0, -100e-6]), cad)
    return replace(builders.platform(), body=guess)


testbed.__test__ = False  # pytest would take its name for a test's


def start_attitude(rng: np.random.Generator) -> Floats:
    """Return an attitude tilted by 3 to 5 deg in any direction."""
    way, tilt = rng.uniform(0, 2 * np.pi), rng.uniform(*TILT)
    return exponential(tilt * np.array([np.cos(way), np.sin(way), 0.0]))


def run(seed: int, inertia: Vector6 = PUBLISHED) -> tuple[Recording, Floats]:
    """Return what the camera recorded, and the true first attitude."""
    q0 = start_attitude(np.random.default_rng([seed, 1]))
    t = np.arange(int(SECONDS * 5) + 1) / 5.0
    line = builders.line_of(t, TRACK)
    body = body_of(builders.MASS, builders.GRAVITY, inertia, builders.MASS * builders.COM)
    motion = propagate(body, builders.maps(), line, q0, builders.RATE)
    clean = Samples(t, motion.q[line.attitude_node])
    return builders.noisy(Recording(clean, None, ("x", "y", "z"), TRACK), seed), q0


def true_point(q0: Floats, inertia: Vector6 = PUBLISHED) -> Unknowns:
    """Return the truth as a point of the search."""
    about_C = unpack_symmetric(inertia) - parallel_axis(builders.MASS, builders.COM)
    six = pseudo_inertia.from_inertia(about_C)
    rate, com = builders.RATE, builders.COM
    return Unknowns(
        q0, rate, six, com, np.zeros(N_TORQUES), np.zeros(N_SENSOR), np.zeros(0), np.zeros(3)
    )


def information(problem: Problem, q0: Floats, inertia: Vector6 = PUBLISHED) -> Floats:
    """Return the Fisher information of the data alone at the truth, physical coordinates."""
    return evaluate(problem, true_point(q0, inertia)).normal - np.diag(problem.prior.anchor)
