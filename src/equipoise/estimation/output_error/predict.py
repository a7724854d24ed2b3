"""What the sensors should have measured, by a set of mass properties."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from equipoise.actuators.drive_errors import on_rails, rails_of
from equipoise.actuators.lags import LAG, lagging, logged_late
from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.lamp_warmth import temperature_of
from equipoise.dynamics.propagation import propagate, rigid_body
from equipoise.dynamics.regressor import N_TORQUES, THERMAL
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import TURN_PER_STEP, timeline
from equipoise.estimation.motion.sampled_motion import sampled_motion
from equipoise.estimation.output_error.problem import errors_of, forward_of, track_of
from equipoise.estimation.output_error.trajectory import fastest_rate
from equipoise.maths.attitude import exponential
from equipoise.model import sensor_terms
from equipoise.model.arrays import Floats, Quaternion, Vector3
from equipoise.model.estimate import ATTITUDE, RATE, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS
from equipoise.sensors.camera import said_along
from equipoise.sensors.timing import measured_at


def run(
    recording: Recording,
    testbed: Testbed,
    body: MassProperties,
    q0: Quaternion,
    w0: Vector3,
    torque: Floats,
    found: Mapping[str, float],
) -> PredictedMotion:
    """Return the motion of a body through the record's moves; errors of masses are in ``found``."""
    recording = arranged(recording, testbed.mass_names)
    rows, sensor = recording.attitude, testbed.attitude
    if rows is None or not len(rows):
        rows, sensor = recording.rate, testbed.gyro
    assert rows is not None
    t = measured_at(rows.t, sensor)
    errors, rails = errors_of(recording, testbed), rails_of(testbed.masses)
    line = timeline(
        t, np.zeros(0), on_rails(track_of(recording, testbed), len(rails)), len(rails),
        min(1.0, TURN_PER_STEP / max(fastest_rate(recording), 1e-6)),
        recording.momentum, recording.torque, errors.response, errors.owner,
        temperature=temperature_of(recording, testbed) if np.any(torque[THERMAL:]) else None,
    )  # fmt: skip
    first = KNOWN_D + len(rails)
    off = [found.get(name, 0.0) for name in errors.names]
    for j, (owner, error) in enumerate(errors.owner):
        line.known[:, KNOWN_D + owner] += off[error] * line.known[:, first + j]
    rigid = rigid_body(body, testbed.gravity, torque)
    motion = propagate(rigid, mass_maps(rails), line, q0, w0)
    return PredictedMotion(rows.t, motion.q[line.attitude_node], motion.rate[line.attitude_node])


def timed_as_found(
    testbed: Testbed, found: Mapping[str, float]
) -> tuple[Testbed, dict[str, float]]:
    """Return the testbed with its rows of masses as late as found, and what else was found."""
    lags, left = [name for name in found if name.startswith(LAG)], dict(found)
    if lags:
        testbed = replace(testbed, masses=logged_late(testbed.masses))
    if len(lags) == 1:
        testbed = replace(testbed, masses=lagging(testbed.masses, found[lags[0]]))
        left[lags[0]] = 0.0
    return testbed, left


def predict(recording: Recording, testbed: Testbed, estimate: Estimate) -> PredictedMotion:
    """Return what an estimate of the trajectory method says of its own record.

    Attitudes are those that the camera says, its vertical as the estimate has it.
    """
    recording = arranged(recording, testbed.mass_names)
    torque = np.array([estimate.values((t,))[0] if estimate.has(t) else 0.0 for t in TERMS])
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    q0 = exponential(estimate.values(ATTITUDE))
    testbed, found = timed_as_found(testbed, {p.name: p.value for p in estimate.parameters})
    motion = run(recording, testbed, body, q0, estimate.values(RATE), torque, found)
    shown = np.empty_like(motion.q)
    sensor = np.array([found.get(term, 0.0) for term in sensor_terms.TERMS])
    said_along(motion.q, forward_of(testbed.up), sensor, shown)
    return motion._replace(q=shown)


def before(recording: Recording, testbed: Testbed) -> PredictedMotion:
    """Return what the testbed's first guess says, from the first attitudes (paper Fig. 6a)."""
    recording = arranged(recording, testbed.mass_names)
    motion = sampled_motion(recording, testbed)
    return run(recording, testbed, testbed.body, motion.q[0], motion.w[0], np.zeros(N_TORQUES), {})
