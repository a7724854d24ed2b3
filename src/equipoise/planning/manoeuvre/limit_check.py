"""A manoeuvre tried on several platforms at once, fast: for a search that tries thousands.

The problem of a trajectory fit is posed once, for what is expected, and evaluated at each
platform's own truth. That is exact: measured values do not enter the information (see
``estimation.normal_equations``). Limits need the motion alone, so they are checked before a problem
is posed. What makes it fast is exact enough for a search only: dense sensors are taken as means of
their rows, and what hanging masses add is left out.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.propagation import NO_COLUMNS, NO_GROUPS, stacked
from equipoise.dynamics.regressor import N_TORQUES
from equipoise.dynamics.sensitivities import Inputs
from equipoise.dynamics.timeline import Timeline, timeline
from equipoise.estimation.output_error.kernels.many_points import information_at, peaks_at
from equipoise.estimation.output_error.problem import Problem, longest_step
from equipoise.estimation.output_error.problem import posed as as_posed
from equipoise.estimation.output_error.trajectory import Params
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.maths.attitude import leaning
from equipoise.maths.linalg import inverse_blocks
from equipoise.model.arrays import Floats, Quaternion, Vector3
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.planning.manoeuvre.noiseless_record import imagined, known_side
from equipoise.planning.manoeuvre.predicted_information import Known, add_known, posed, true_point
from equipoise.planning.manoeuvre.scenario import Platforms, let_go

S = TypeVar("S", AttitudeSensor, Gyro, Accelerometer, SunSensor, Magnetometer)
DENSE_CAMERA, DENSE_GYRO = 2.5, 5.0  # Hz, chosen: a swing of some 10 s is well sampled
DENSE_VECTOR = 2.5  # Hz, chosen: as the camera, for it too sees where the platform is turned


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


class Course(NamedTuple):
    """What is known of a manoeuvre before anything is measured: enough for its peaks."""

    manoeuvre: Manoeuvre
    reported: Recording
    line: Timeline


def course_of(testbed: Testbed, manoeuvre: Manoeuvre, fineness: float) -> Course:
    """Return the course of a manoeuvre, in steps that are as fine as a fit's times ``fineness``."""
    reported, duration = known_side(testbed, manoeuvre), manoeuvre.duration
    rows = sum(int(s.rate * duration) for s in (testbed.attitude, testbed.gyro) if s is not None)
    longest = longest_step(testbed, float(np.linalg.norm(manoeuvre.rate)), rows) / fineness
    line = timeline(
        np.array([0.0, duration]), np.zeros(0), reported.masses, len(testbed.masses), longest,
        reported.momentum, at_nodes=False,
    )  # fmt: skip
    return Course(manoeuvre, reported, line)


def begun(q0: Quaternion, manoeuvre: Manoeuvre, platforms: Platforms, up: Vector3) -> Floats:
    """Return how each platform begins, let go nearly at ``q0``: the first part of a fit's point."""
    q, rate = let_go(q0, manoeuvre, platforms.lean, platforms.push, up)
    return np.hstack([q, rate, platforms.six, platforms.com])


def peaks(testbed: Testbed, course: Course, platforms: Platforms) -> Floats:
    """Return the greatest tilt (rad) and rate (rad/s) of each platform, (k, 2)."""
    planned, line, up = course.manoeuvre, course.line, testbed.up
    first = begun(leaning(up, planned.low_side, planned.tilt), planned, platforms, up)
    points = np.hstack([first, np.zeros((len(first), N_TORQUES))])
    maps = stacked(mass_maps(testbed.masses))
    inputs = Inputs(maps, line.t, line.known, line.owners, NO_COLUMNS, NO_GROUPS)
    return peaks_at(inputs, testbed.body.mass, testbed.gravity, points, up)


class Rehearsal(NamedTuple):
    """A manoeuvre posed for several platforms."""

    problem: Problem
    expected: Unknowns
    manoeuvre: Manoeuvre
    up: Vector3


def rehearsal(
    testbed: Testbed,
    body: MassProperties,
    course: Course,
    params: Params,
    known: Known | None = None,
) -> Rehearsal:
    """Return a manoeuvre to be tried on several platforms, of which one with this is expected."""
    manoeuvre = course.manoeuvre
    observed = imagined(testbed, body, manoeuvre, course.reported)
    problem = posed(observed, testbed, params, known)
    point = true_point(observed, body, manoeuvre, problem.layout)
    return Rehearsal(problem, point, manoeuvre, testbed.up)


def started(tried: Rehearsal, platforms: Platforms) -> Floats:
    """Return the truth of each platform, let go nearly as planned, as points (k, p) of a fit."""
    first = begun(tried.expected.q0, tried.manoeuvre, platforms, tried.up)
    points = np.tile(tried.expected.flat, (len(first), 1))
    points[:, : first.shape[1]] = first
    return points


def covariances_of(
    tried: Rehearsal, platforms: Platforms, known: Known | None, names: Sequence[str]
) -> Floats:
    """Return the covariance of some unknowns for each platform, (k, m, m).

    Unobservable ones are as wide as the fit's anchor. LinAlgError where they are wider than
    rounding lets see.
    """
    problem = tried.problem
    information = information_at(as_posed(problem), started(tried, platforms))
    if known is not None:
        add_known(information, problem.layout.names, known)
    return inverse_blocks(information, [problem.layout.names.index(name) for name in names])
