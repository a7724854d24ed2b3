"""A record as stretches of a second, each linear about a state of its own.

The terms, sensor errors and events are the estimate's; the sensors are as noisy as the rows of the
estimate showed them. Stretches begin as measured at first (``multiple_shooting``): no motion is
lost, whatever pushed the platform. ``gauss_markov`` joins them, and they are taken about the joined
motion again. The unmodelled torque stands in the coordinates ``constant``.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from equipoise.dynamics.regressor import CONSTANT, N_TORQUES
from equipoise.estimation.motion.sampled_motion import sampled_motion
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise, with_noise
from equipoise.estimation.output_error.multiple_shooting import state_near
from equipoise.estimation.output_error.predict import timed_as_found
from equipoise.estimation.output_error.problem import Problem, posed
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import Fitted, settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.estimation.parameters.fit_parameters import Layout, Unknowns
from equipoise.estimation.torque_by_cause.stretch_motion import followed, known_at
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import difference, exponential
from equipoise.model import sensor_terms, torque_terms
from equipoise.model.arrays import Floats, Series1
from equipoise.model.estimate import ATTITUDE, COM, RATE, Estimate
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed
from equipoise.sensors.camera import N_SENSOR

ANY = (1.0,) * 9  # sd of jumps, of no effect: what may jump is for ``gauss_markov`` to say
CARRIER = torque_terms.GROUPS["constant"]  # coordinates in which the unmodelled torque walks
JOINED = (*ATTITUDE, *RATE, *CARRIER)  # what differs from stretch to stretch
ASIDE = 1e-3  # s, chosen: less than any event's time is known to
BIAS = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z")


def posed_for(
    recording: Recording, testbed: Testbed, estimate: Estimate, cuts: Series1
) -> tuple[Problem, list[Unknowns]]:
    """Return the problem of a record, cut at these times (s), and where stretches begin."""
    recording = arranged(recording, testbed.mass_names)
    found = {p.name: p.value for p in estimate.parameters}
    timed, found = timed_as_found(described(testbed, estimate), found)
    problem = problem_of(recording, timed, params_for(recording, estimate, cuts))
    body = point_of(problem.layout, timed.body, found)
    motion = sampled_motion(recording, timed)
    begins = problem.line.t[posed(problem).cuts.nodes[:-1]]
    states = [state_near(motion, float(t)) for t in begins]
    return problem, [replace(body, q0=q, w0=w) for q, w in states]


def params_for(recording: Recording, estimate: Estimate, cuts: Series1) -> Params:
    """Return the options of a fit with the terms, sensor errors and events of an estimate."""
    names = {p.name for p in estimate.parameters}
    terms = torque_terms.among((*names.intersection(torque_terms.TERMS), *CARRIER))
    sensor = sensor_terms.among(names.intersection(sensor_terms.TERMS))
    happened = dict(events_of(recording, estimate, cuts))
    jumps = [Jump(t, JOINED, ANY) for t in cuts.tolist()]
    jumps += [Jump(t, (*JOINED, *more), (*ANY, *ANY[: len(more)]), is_event=True)
              for t, more in happened.items()]  # fmt: skip
    return Params(terms, sensor, tuple(jumps))


def events_of(
    recording: Recording, estimate: Estimate, cuts: Series1
) -> list[tuple[float, tuple[str, ...]]]:
    """Return the times of an estimate's events, each between cuts, and what else may jump there.

    None where the estimate was made of another record.
    """
    events = estimate.events if is_of(estimate, recording) else ()
    return [(beside(e.t, cuts), COM if e.kind == "com_step" else ()) for e in events]


def beside(t: float, cuts: Series1) -> float:
    """Return a time (s) that is not at a cut: an event belongs to one interval."""
    near = np.any(np.abs(cuts - t) < ASIDE)
    return t + 2 * ASIDE if near else t


def about(problem: Problem, points: Sequence[Unknowns]) -> Fitted:
    """Return the local models of all stretches, which begin at these points."""
    nodes, known = posed(problem).cuts.nodes, known_at(problem, points[0])
    jumps = np.zeros(posed(problem).cuts.weight.shape)
    for k, jump in enumerate(problem.jumps):
        at = followed(problem, known, slice(int(nodes[k]), int(nodes[k + 1]) + 1), points[k])
        before, behind = points[k], points[k + 1]
        torque = slice(CONSTANT, CONSTANT + 3)
        jumps[k, :9] = np.concatenate([
            difference(behind.q0, at.motion.q[-1]), behind.w0 - at.motion.rate[-1],
            behind.torque[torque] - before.torque[torque],
        ])  # fmt: skip
        if COM[0] in jump.names:
            jumps[k, 9:12] = behind.com - before.com
    return settle(problem, points[0], jumps, 1)


def is_of(estimate: Estimate, recording: Recording) -> bool:
    """Say whether an estimate was made of this record: of the same file, or the same source."""
    origin = estimate.provenance
    if recording.sha256 and origin.get("sha256"):
        return origin["sha256"] == recording.sha256
    return bool(recording.source) and origin.get("source") == recording.source


def described(testbed: Testbed, estimate: Estimate) -> Testbed:
    """Return the testbed with the body that an estimate found, and the noise that it left.

    Noise that is not white counts as dense as where it is densest.
    """
    body = MassProperties(testbed.body.mass, estimate.com, estimate.inertia_P)
    left, camera, gyro = estimate.residual, camera_noise(testbed), gyro_noise(testbed)
    if left is not None:
        coloured = float(np.sqrt(left.spectral_peak))
        camera, gyro = (
            coloured * (rms or stated)
            for rms, stated in ((left.attitude_rms, camera), (left.rate_rms, gyro))
        )
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
