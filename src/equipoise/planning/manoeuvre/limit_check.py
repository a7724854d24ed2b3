"""A manoeuvre tried on several platforms at once, fast: for a search that tries thousands.

The problem of a trajectory fit is posed once, for what is expected, and evaluated at each
platform's own truth. That is exact: measured values do not enter the information (see
``estimation.normal_equations``). What makes it fast is exact enough for a search only: dense
sensors are taken as means of their rows, and what hanging masses add is left out.
"""

from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from equipoise.dynamics.propagation import propagate, rigid_body
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import tilt
from equipoise.maths.linalg import inverse_where
from equipoise.model.arrays import Square, Vector3
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.planning.manoeuvre.noiseless_record import imagined
from equipoise.planning.manoeuvre.predicted_information import Known, informed, posed, true_point
from equipoise.planning.manoeuvre.scenario import Scenario, let_go

S = TypeVar("S", AttitudeSensor, Gyro, Accelerometer, SunSensor, Magnetometer)
DENSE_CAMERA, DENSE_GYRO = 5.0, 10.0  # Hz, chosen: a swing of some 10 s is well sampled
DENSE_VECTOR = 5.0  # Hz, chosen: as the camera, for it too sees where the platform is turned


class Peaks(NamedTuple):
    """The peaks of a motion."""

    tilt: float  # rad
    rate: float  # rad/s


def for_search(testbed: Testbed) -> Testbed:
    """Return the testbed with sensors of equal information in fewer rows, and with stiff drives.

    N rows of noise s, while nothing changes, are as good as one row of noise s / sqrt(N).
    """
    camera, gyro = testbed.attitude, testbed.gyro
    inertial, sun, magnetic = testbed.accelerometer, testbed.sun, testbed.magnetometer
    return replace(
        testbed,
        attitude=camera and thinned(camera, DENSE_CAMERA),
        gyro=gyro and thinned(gyro, DENSE_GYRO),
        accelerometer=inertial and thinned(inertial, DENSE_VECTOR),
        sun=sun and thinned(sun, DENSE_VECTOR),
        magnetometer=magnetic and thinned(magnetic, DENSE_VECTOR),
        masses=tuple(replace(mass, sag_sd=0.0) for mass in testbed.masses),
    )


def thinned(sensor: S, rate: float) -> S:
    """Return a sensor of a lower rate (Hz) with equal information."""
    if sensor.rate <= rate:
        return sensor
    return replace(sensor, rate=rate, noise=sensor.noise * float(np.sqrt(rate / sensor.rate)))


class Rehearsal(NamedTuple):
    """A manoeuvre posed for several platforms."""

    problem: Problem
    expected: Unknowns
    manoeuvre: Manoeuvre
    up: Vector3


def rehearsal(
    testbed: Testbed,
    expected: Scenario,
    manoeuvre: Manoeuvre,
    params: Params,
    known: Known | None = None,
) -> Rehearsal:
    """Return a manoeuvre to be tried on several platforms."""
    observed = imagined(testbed, expected.body, manoeuvre)
    problem = posed(observed, testbed, params, known)
    point = true_point(observed, expected.body, manoeuvre, problem.layout)
    return Rehearsal(problem, point, manoeuvre, testbed.up)


def started(tried: Rehearsal, scenario: Scenario) -> Unknowns:
    """Return the truth of one platform, let go nearly as planned."""
    body, point = scenario.body, tried.expected
    six = pseudo_inertia.from_inertia(body.inertia_C)
    q0, w0 = let_go(point.q0, tried.manoeuvre, scenario, tried.up)
    return replace(point, six=six, com=body.com, q0=q0, w0=w0)


def peaks(tried: Rehearsal, truth: Unknowns) -> Peaks:
    """Return the peaks of one platform."""
    problem = tried.problem
    rigid = rigid_body(truth.body(problem.mass), problem.gravity)
    motion = propagate(rigid, problem.maps, problem.line, truth.q0, truth.w0)
    rate = float(np.linalg.norm(motion.rate, axis=1).max())
    return Peaks(float(tilt(motion.q, tried.up).max()), rate)


def covariance_of(tried: Rehearsal, truth: Unknowns, known: Known | None) -> Square:
    """Return the covariance of all unknowns; unobservable ones are as wide as the fit's anchor."""
    normal = informed(tried.problem, truth, known).at.normal
    return inverse_where(normal, ~tried.problem.prior.held)
