"""The same problem through the library: from the same start, and from no start at all."""

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from benchmarks.problem import Array, Point, Problem
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.output_error.fit_estimate import Fitted, conclude
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.mass_properties import MassProperties, parallel_axis
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, SlidingMass, Testbed
from equipoise.sensors.camera import N_SENSOR

Answer = TypeVar("Answer")


def recording_of(problem: Problem) -> Recording:
    """Return the record as the library takes it."""
    names = tuple(f"m{k}" for k in range(len(problem.slide_mass)))
    masses = Samples(problem.knot_t, problem.knot_d)
    return Recording(Samples(problem.t, problem.q_meas), None, names, masses)


def testbed_of(problem: Problem) -> Testbed:
    """Return what is known beforehand: as much as the peers know."""
    start = problem.start
    body = MassProperties(problem.mass, start.com, unpack_symmetric(start.inertia))
    masses = tuple(
        SlidingMass(f"m{k}", float(problem.slide_mass[k]), problem.slide_home[k],
                    problem.slide_axis[k], (-0.05, 0.05), 0.0, 0.0, 0.0, 0.01, 0.0, 0.0)
        for k in range(len(problem.slide_mass))
    )  # fmt: skip
    rate = 1.0 / float(np.median(np.diff(problem.t)))
    camera = AttitudeSensor(rate, problem.sigma)
    return Testbed("bench", body, 0.2, np.full(3, 1e-4), np.array([0.0, 0.0, 1.0]), 0.5,
                   problem.gravity, masses, camera)  # fmt: skip


def unknowns_of(problem: Problem, point: Point) -> Unknowns:
    """Return one of the peers' points as the library keeps it."""
    inertia_C = unpack_symmetric(point.inertia) - parallel_axis(problem.mass, point.com)
    six = pseudo_inertia.from_inertia(inertia_C)
    still, exact = np.zeros(N_TORQUES), (np.zeros(N_SENSOR), np.zeros(0))  # sensors, stops
    none = (still, *exact, np.zeros(3))
    return Unknowns(point.q, point.rate, six, point.com, *none)


def point_of(problem: Problem, fitted: Fitted) -> Point:
    """Return the optimum as the peers keep it."""
    found = fitted.point
    inertia = pack_symmetric(found.body(problem.mass).inertia_P)
    return Point(found.q0, found.w0, inertia, found.com)


def timed(call: Callable[[], Answer], repeats: int) -> tuple[Answer, float]:
    """Return an answer and the median seconds of several calls, after one that compiles."""
    answer = call()
    seconds: list[float] = []
    for _ in range(repeats):
        began = time.perf_counter()
        answer = call()
        seconds.append(time.perf_counter() - began)
    return answer, float(np.median(seconds))


def fit(problem: Problem, given_start: bool, repeats: int = 15) -> tuple[Fitted, float, Array]:
    """Return the fit, the seconds it takes with covariance and intervals, and the sd."""
    recording, testbed = recording_of(problem), testbed_of(problem)
    guess = unknowns_of(problem, problem.start) if given_start else None

    def whole() -> Fitted:
        fitted = trajectory.fit(recording, testbed, trajectory.Params(), guess)
        conclude(fitted, "trajectory", recording)
        return fitted

    fitted, seconds = timed(whole, repeats)
    return fitted, seconds, np.sqrt(np.diag(np.linalg.inv(fitted.at.normal)))
