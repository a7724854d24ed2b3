"""The record of a manoeuvre by the testbed's sensors, without noise.

The motion is that of the one propagator, masses travelling as the bench's do, devices following
their waves. Rows come at the sensors' own times; masses stop where commanded, the camera stands
level and gyro, accelerometer and magnetometer have no bias, as in an estimator's priors.

Torques other than gravity's and the devices' are zero.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.actuators.square_waves import inputs_along
from equipoise.actuators.stored_momentum import stored_momentum
from equipoise.dynamics.propagation import Motion, propagate, rigid_body
from equipoise.dynamics.timeline import SAME, Timeline, place, timeline
from equipoise.estimation.output_error.problem import longest_step
from equipoise.maths.attitude import leaning
from equipoise.model.arrays import Series1
from equipoise.model.devices import at_start, recorded_name
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at
from equipoise.sensors.vector_sensors import VectorSensor, vector_sensors
from equipoise.simulation import actuator
from equipoise.simulation.camera_and_gyro import Sensor, exact_vectors, sampled_at
from equipoise.simulation.clock import samples, tick_one
from equipoise.simulation.devices import inputs_of, started
from equipoise.simulation.followers import driven, followed

Stamped = tuple[VectorSensor, Series1]  # a sensor and the stamps of its rows, s

SOURCE = "planned manoeuvre"


class Imagined(NamedTuple):
    """A recording that was never made, and the motion behind it."""

    recording: Recording
    motion: Motion  # at every node
    t: Series1  # s, of the nodes


def mass_track(testbed: Testbed, manoeuvre: Manoeuvre) -> Samples | None:
    """Return the reports of the masses (m); InputError or MoveRefused as at a bench."""
    masses = testbed.masses
    if not masses:
        return None
    unused = np.random.default_rng(0)  # of where masses stop, which is not reported
    travel = actuator.left_at(masses, manoeuvre.standing, unused)
    track = actuator.tracked(travel)
    for t, targets in manoeuvre.moves:
        goals = actuator.checked(travel, t, targets, masses)
        travel = actuator.sent(travel, t, goals, masses, (), unused)
        track = actuator.retracked(track, travel, t)
    return actuator.reported_rows(track, 0.0, manoeuvre.duration)


def device_rows(testbed: Testbed, manoeuvre: Manoeuvre, t: Series1) -> Samples | None:
    """Return the noiseless reports of wheels and gyros at times (s); others as at the start."""
    if not (testbed.wheels or testbed.cmgs):
        return None
    devices = started(testbed)
    for when, inputs in inputs_along(manoeuvre.waves, manoeuvre.duration):
        devices = driven(devices, tick_one(when), *inputs_of(testbed, inputs))
    rows = followed(devices, t)[1]
    first = len(testbed.wheels) + len(testbed.cmgs)
    rows[:, first:] = [at_start(device) for device in testbed.devices[first:]]
    return Samples(t, rows)


def row_times(sensor: Sensor | None, duration: float) -> Series1:
    """Return the stamps of a sensor's rows, s."""
    return np.zeros(0) if sensor is None else samples(sensor.rate, -1.0, duration)


def known_side(testbed: Testbed, manoeuvre: Manoeuvre) -> Recording:
    """Return a recording with the reports of masses and devices, and no rows of sensors."""
    sensor = testbed.gyro or testbed.attitude
    devices = device_rows(testbed, manoeuvre, row_times(sensor, manoeuvre.duration))
    names = tuple(recorded_name(device) for device in testbed.devices)
    reported = Recording(
        mass_names=testbed.mass_names,
        masses=mass_track(testbed, manoeuvre),
        device_names=names if devices else (),
        devices=devices,
        source=SOURCE,
    )
    return replace(reported, momentum=stored_momentum(reported, testbed))


def vector_times(testbed: Testbed, duration: float, start: float) -> list[Stamped]:
    """Return the stamps (s) of sensors of vectors; no sample is before the start of the motion."""
    stamps = [(sensor, row_times(sensor, duration)) for sensor in vector_sensors(testbed)]
    return [(sensor, t[sampled_at(sensor, t).min(axis=1) >= start]) for sensor, t in stamps]


def vectors_along(line: Timeline, motion: Motion, stamped: list[Stamped]) -> dict[str, Samples]:
    """Return the noiseless rows of sensors of vectors, by channel."""
    found = dict[str, Samples]()
    for sensor, t in stamped:
        node, _ = place(line.t, sampled_at(sensor, t) + SAME)
        vectors = exact_vectors(motion.q[node], motion.rate[node], sensor)
        found[sensor.channel] = Samples(t, vectors)
    return found


def imagined(
    testbed: Testbed,
    body: MassProperties,
    manoeuvre: Manoeuvre,
    reported: Recording | None = None,
) -> Imagined:
    """Return the noiseless recording of a manoeuvre by a platform with this body.

    ``reported``: its known side, which is the same for every body.
    """
    reported = reported or known_side(testbed, manoeuvre)
    camera, gyro = testbed.attitude, testbed.gyro
    t_q, t_w = (row_times(sensor, manoeuvre.duration) for sensor in (camera, gyro))
    moments = measured_at(t_q, camera), measured_at(t_w, gyro)
    stamped = vector_times(testbed, manoeuvre.duration, float(np.concatenate(moments).min()))
    instants = [sampled_at(sensor, t).ravel() for sensor, t in stamped]
    fastest = float(np.linalg.norm(manoeuvre.rate))
    line = timeline(
        moments[0], np.concatenate([moments[1], *instants]), reported.masses, len(testbed.masses),
        longest_step(testbed, fastest, len(t_q) + len(t_w)), reported.momentum,
    )  # fmt: skip
    maps = mass_maps(testbed.masses)
    rigid = rigid_body(body, testbed.gravity)
    q0 = leaning(testbed.up, manoeuvre.low_side, manoeuvre.tilt)
    motion = propagate(rigid, maps, line, q0, manoeuvre.rate)
    turning = motion.rate[line.rate_node[: len(t_w)]]
    recording = replace(
        reported,
        attitude=Samples(t_q, motion.q[line.attitude_node]) if camera else None,
        rate=Samples(t_w, turning) if gyro else None,
        **vectors_along(line, motion, stamped),
    )
    return Imagined(recording, motion, line.t)
