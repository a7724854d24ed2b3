"""A record as stretches of a second, about the motion that an estimate describes.

The terms, sensor errors and events are the estimate's. A torque that no term explains walks from
stretch to stretch in the coordinates ``constant``. J and com are held at the estimate's values, so
that a walk of stated size does not pull at them; ``gauss_markov`` frees them, all else linear.

The sensors are as noisy as the rows of the estimate showed them.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from equipoise.dynamics.regressor import N_TORQUES
from equipoise.estimation.events.jump_test import KINDS
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise, with_noise
from equipoise.estimation.output_error.initial_guess import as_measured
from equipoise.estimation.output_error.predict import timed_as_found
from equipoise.estimation.output_error.segment_jumps import Jump, walk
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import Params, fit, layout_of
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns
from equipoise.estimation.search_budget import Budget
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import exponential
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats, Series1
from equipoise.model.estimate import ATTITUDE, BODY, RATE, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.camera import N_SENSOR

CARRIER = torque_terms.GROUPS["constant"]  # coordinates in which the unmodelled torque walks
WALK_SD = 3e-6  # N m from one second to the next, chosen: air of most benches; it only linearises
ASIDE = 1e-3  # s, chosen: less than any event's time is known to
BIAS = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z")


def linearised(
    recording: Recording, testbed: Testbed, estimate: Estimate, cuts: Series1, budget: Budget
) -> Fitted:
    """Return the motion of a record, cut at these times (s), with the estimate's J and com."""
    recording = arranged(recording, testbed.mass_names)
    found = {p.name: p.value for p in estimate.parameters}
    timed, found = timed_as_found(described(testbed, estimate), found)
    params = params_for(recording, estimate, cuts, budget)
    first = point_of(layout_of(recording, timed, params), timed.body, found)
    if not (is_of(estimate, recording) and all(map(estimate.has, (*ATTITUDE, *RATE)))):
        first = as_measured(recording, timed, recording.span[0], first)
    return fit(recording, timed, params, first)


def params_for(recording: Recording, estimate: Estimate, cuts: Series1, budget: Budget) -> Params:
    """Return the options of a fit with the terms, sensor errors and events of an estimate."""
    names = {p.name for p in estimate.parameters}
    terms = torque_terms.among((*names.intersection(torque_terms.TERMS), *CARRIER))
    sensor = sensor_terms.among(names.intersection(sensor_terms.TERMS))
    jumps = (*walk(cuts, CARRIER, np.full(3, WALK_SD)), *event_jumps(recording, estimate, cuts))
    return Params(terms, sensor, jumps, hold=BODY, budget=budget)


def event_jumps(recording: Recording, estimate: Estimate, cuts: Series1) -> tuple[Jump, ...]:
    """Return the jumps of an estimate's events, each between two cuts.

    None where the estimate was made of another record.
    """
    events = estimate.events if is_of(estimate, recording) else ()
    found = [(beside(e.t, cuts), KINDS[e.kind]) for e in events]
    return tuple(Jump(t, k.names, (k.sd,) * len(k.names), is_event=True) for t, k in found)


def beside(t: float, cuts: Series1) -> float:
    """Return a time (s) that is not at a cut: an event belongs to one interval."""
    near = np.any(np.abs(cuts - t) < ASIDE)
    return t + 2 * ASIDE if near else t


def is_of(estimate: Estimate, recording: Recording) -> bool:
    """Say whether an estimate was made of this record: of the same file, or the same source."""
    origin = estimate.provenance
    if recording.sha256 and origin.get("sha256"):
        return origin["sha256"] == recording.sha256
    return bool(recording.source) and origin.get("source") == recording.source


def described(testbed: Testbed, estimate: Estimate) -> Testbed:
    """Return the testbed with the body that an estimate found, and the noise that it left."""
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    left = estimate.residual
    camera = (left and left.attitude_rms) or camera_noise(testbed)
    gyro = (left and left.rate_rms) or gyro_noise(testbed)
    return with_noise(replace(testbed, body=body), camera, gyro)


def point_of(layout: Layout, body: MassProperties, found: Mapping[str, float]) -> Unknowns:
    """Return the point of a body and of values by name; what has no value is zero."""

    def values(names: tuple[str, ...]) -> Floats:
        return np.array([found.get(name, 0.0) for name in names], dtype=np.float64)

    torque, sensor = np.zeros(N_TORQUES), np.zeros(N_SENSOR)
    torque[layout.torque_index] = values(layout.terms)
    sensor[layout.sensor_index] = values(layout.sensor)
    six = pseudo_inertia.from_inertia(body.inertia_C)
    q0 = exponential(values(ATTITUDE))
    return Unknowns(q0, values(RATE), six, body.com, torque, sensor, values(layout.errors),
                    values(BIAS))  # fmt: skip
