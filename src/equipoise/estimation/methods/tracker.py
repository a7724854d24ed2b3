"""The tracker as an estimator: its estimate after the last row, see ``estimation.tracker``.

After a move the centre of mass is that of the masses as they stand: where they really stopped is
part of it. The intervals allow for a centre of mass that drifts, and on a platform that does not
they are wider than need be.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.method_contract import SURPRISED, Method, Options, origin_of, refused
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.measurement_update import GATE
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import COM, END, INERTIA, RATE, Course, Estimate, Parameter
from equipoise.model.mass_properties import MassProperties
from equipoise.model.method_card import Card
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed

MOST = 0.2  # chosen: with more odd rows it is the model that is odd


def shift_at_end(recording: Recording, testbed: Testbed) -> Vector3:
    """Return what the masses, as they stand at the end, do to the centre of mass (m)."""
    if recording.masses is None:
        return np.zeros(3)
    return shift_by(testbed, recording.masses.values[-1])


def parameters_of(posterior: tracker.Posterior, shift: Vector3) -> tuple[Parameter, ...]:
    """Return the estimate, com with the masses as they stand."""
    values = [*(posterior.com + shift), *pack_symmetric(posterior.inertia_P)]
    names = (*(END if shift.any() else COM), *INERTIA)
    units = ["m"] * len(COM) + ["kg m2"] * len(INERTIA)
    sds = np.sqrt(np.diag(posterior.covariance))
    return tuple(
        Parameter(name, unit, float(value), float(sd))
        for name, unit, value, sd in zip(names, units, values, sds, strict=True)
    )


def com_course(track: tracker.Track) -> Course:
    """Return the centre of mass along a track; where moves were ignored, as the masses stand."""
    return Course(COM, track.t, track.com, track.com_sd)


def rate_course(track: tracker.Track) -> Course:
    """Return the angular velocity (rad/s, body axes) along a track."""
    return Course(RATE, track.t, track.rate, track.rate_sd)


def outcome_of(track: tracker.Track, mass: float) -> Outcome:
    """Return whether the rows came as expected, those that were used and not many were not.

    And whether the body (of a mass in kg) that it ends with is flat.
    """
    late = track.surprise[len(track.t) // 4 :]
    used = late[late <= GATE]
    surprise = float(np.mean(used)) / 3 if len(used) else np.inf
    rejected = len(track.not_used)
    code = Why.TRACKED if surprise < SURPRISED else Why.TRACKER_INNOVATIONS_TOO_LARGE
    reasons = [Reason(code, (), {"innovation": surprise})]
    if rejected:
        few = rejected < MOST * len(track.t)
        code = Why.ROWS_REJECTED if few else Why.TOO_MANY_ROWS_REJECTED
        reasons.append(Reason(code, (), {"rows": rejected}))
    body = MassProperties(mass, track.end.com, track.end.inertia_P)
    return Outcome((*reasons, *flat_reasons(body)))


def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
    """Return the estimate after the last row, begun from the prior of the testbed."""
    if recording.attitude is None or len(recording.attitude) < 2:
        return refused(METHOD.card, Why.NO_ATTITUDE)
    recording, first = arranged(recording, testbed.mass_names), recording.attitude
    state = tracker.first_state(float(first.t[0]), first.values[0], testbed)
    track = tracker.track(recording, testbed, tracker.Params(), state)
    found = estimate_at_end(track, testbed, shift_at_end(recording, testbed))
    return replace(found, provenance=origin_of(recording))


def estimate_at_end(track: tracker.Track, testbed: Testbed, shift: Vector3) -> Estimate:
    """Return the estimate after the last row, with masses that shift com by so much (m)."""
    posterior = track.end.posterior
    return Estimate(
        METHOD.card.name,
        outcome_of(track, testbed.body.mass),
        parameters_of(posterior, shift),
        posterior.covariance,
        course=com_course(track),
        rate_course=rate_course(track),
    )


METHOD = Method(
    Card(
        "tracker",
        "motion of attitude, rate, J, com and gyro bias; contacts are detected",
        "multiplicative extended Kalman filter",
        "Ivanov 2021 section 5 with errata I7-I11; inertia in the state",
        "a camera; an initial J and com with their sd",
        "com along gravity until it has tilted; scale of J and com before a known change",
        "drifting",
    ),
    run,
)
