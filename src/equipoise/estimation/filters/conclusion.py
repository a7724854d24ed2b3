"""From a filter's run to an estimate: what it says, how far to trust it, what it could not see.

Innovations judge the model: their square over its covariance is 3 a row on average. Beyond
``SURPRISED`` times that, no estimate is usable.

Masses stop only so well, and that is part of the centre of mass as it is, not of the one with the
masses at home: it is added once more for the masses as they stand. It is as if no row
before a move counted, so it errs to the safe side.

A camera whose vertical leans turns com by as much; that is added, too. Noise of the attitude that
a gyro's filter is given is not.

What the simplified model leaves out moves com by P_cs (``jacobian``), which is in the interval; it
is reported where it is more than the rest, beside the rule |w|^2 dJ / (m g).
"""

import numpy as np

from equipoise.estimation.filters.driver import State, advance, begin, reported
from equipoise.estimation.filters.model import Kind
from equipoise.estimation.filters.rows import Rows, camera_rows, gyro_rows
from equipoise.estimation.method_contract import SURPRISED, Method, Options, origin_of, refused
from equipoise.estimation.motion.sensor_noise import camera_noise, gyro_noise
from equipoise.estimation.parameters.flat_body import flat_reasons
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Matrix3, Series1
from equipoise.model.estimate import INERTIA, Estimate, Parameter
from equipoise.model.mass_properties import MassProperties, is_possible
from equipoise.model.method_card import Card
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, arranged
from equipoise.model.testbed import Testbed

FEWEST = 20  # rows, chosen: fewer say nothing about the innovations
WIDEST = 0.9  # chosen: of a moment of inertia, by which a point may lie off it
STEADY = 1e-9  # N m, N m s, m, chosen: a known input that changes less does not change


def lacking(kind: Kind, recording: Recording, testbed: Testbed) -> Why | None:
    """Return what a filter lacks; None: nothing."""
    if recording.attitude is None or testbed.attitude is None:
        return Why.NO_CAMERA
    if not kind.attitude and (recording.rate is None or testbed.gyro is None):
        return Why.NO_GYRO
    if kind.estimated == 12 and not drives(recording):
        return Why.NO_KNOWN_INPUT
    if kind.unscented and testbed.inertia_sd * (15 if kind.attitude else 12) ** 0.5 > WIDEST:
        return Why.INERTIA_TOO_UNCERTAIN
    return None


def drives(recording: Recording) -> bool:
    """Say whether a known input changes."""
    channels = (recording.torque, recording.momentum, recording.masses)
    return any(c is not None and len(c) > 1 and np.ptp(c.values, axis=0).max() > STEADY
               for c in channels)  # fmt: skip


def noisy_rows(kind: Kind, recording: Recording, testbed: Testbed) -> tuple[Rows, float] | None:
    """Return the rows of a filter's sensor and one sd of a row; None: too few."""
    if kind.attitude:
        rows = camera_rows(recording, testbed)
        return None if rows is None or len(rows.node) < FEWEST else (rows, camera_noise(testbed))
    found = gyro_rows(recording, testbed)
    if found is None or len(found[0].node) < FEWEST:
        return None
    return found[0], gyro_noise(testbed) / found[1] ** 0.5


def standing_covariance(rows: Rows, recording: Recording, testbed: Testbed) -> Matrix3:
    """Return the covariance (m^2) of where masses stand that have moved."""
    out = np.zeros((3, 3))
    track = recording.masses
    for i, mass in enumerate(testbed.masses if track is not None else ()):
        assert track is not None
        if np.ptp(track.values[:, i]) > STEADY and rows.drive.stopped.any():
            shift = mass.mass * mass.accuracy / testbed.body.mass * mass.axis
            out += np.outer(shift, shift)
    return out


def leaning(state: State, testbed: Testbed) -> Matrix3:
    """Return what a camera whose vertical leans adds to the covariance of com, m^2: it turns it."""
    com = state.mean[7:10]
    sd = testbed.attitude.plumb_sd if testbed.attitude else 0.0
    return sd**2 * (com @ com * np.eye(3) - np.outer(com, com))


def at_home(state: State, unseen: Matrix3) -> Floats:
    """Return the covariance of what is reported, com with the masses at home."""
    out, shown = reported(state)[1].copy(), state.shown[:3, :3]
    size = len(shown)
    out[:size, :size] += shown @ unseen @ shown.T
    return out


def parameters_of(state: State, covariance: Floats) -> tuple[Parameter, ...]:
    """Return what is reported."""
    values, sd = reported(state)[0], np.sqrt(np.diag(covariance))
    units = ["kg m2" if name in INERTIA else "m" for name in state.names]
    return tuple(
        Parameter(name, unit, float(value), float(spread))
        for name, unit, value, spread in zip(state.names, units, values, sd, strict=True)
    )


def left_out(state: State, rows: Rows, testbed: Testbed) -> tuple[Reason, ...]:
    """Return what the simplified model's leaving out does, where it is more than the rest."""
    if state.kind.gyroscopic:
        return ()
    P, body = state.covariance, testbed.body
    by = float(np.abs(P[3:6, 12]).max())
    rest = float(np.sqrt(np.diag(P)[3:6] - P[3:6, 12] ** 2).max())
    if by < rest:
        return ()
    moments = np.linalg.eigvalsh(body.inertia_P)
    square, separation = (
        float(np.sum(rows.observed**2)) / len(rows.observed),
        moments[-1] - moments[0],
    )
    rule = square * float(separation) / testbed.weight
    return (Reason(Why.GYROSCOPIC_TORQUE_LEFT_OUT, (), {"com": by, "rule": rule}),)


def outcome_of(surprise: Series1, more: tuple[Reason, ...]) -> Outcome:
    """Return whether the rows came as expected, and what else there is to know."""
    observed = surprise[np.isfinite(surprise)]
    ratio = float(np.mean(observed)) / 3 if len(observed) else np.nan
    code = Why.FILTERED if ratio < SURPRISED else Why.FILTER_INNOVATIONS_TOO_LARGE
    return Outcome((Reason(code, (), {"innovation": ratio}), *more))


def body_of(state: State, testbed: Testbed) -> MassProperties | None:
    """Return the body that was found; None where J is not reported."""
    if state.kind.estimated < 12:
        return None
    com, inertia = state.mean[7:10], unpack_symmetric(state.mean[10:])
    return MassProperties(testbed.body.mass, com, inertia)


def estimate(card: Card, kind: Kind, recording: Recording, testbed: Testbed) -> Estimate:
    """Return the estimate after the last row of a record, begun from the testbed."""
    recording = arranged(recording, testbed.mass_names)
    lack = lacking(kind, recording, testbed)
    if lack is not None:
        return refused(card, lack)
    found = noisy_rows(kind, recording, testbed)
    if found is None:
        return refused(card, Why.TOO_FEW_ROWS_FOR_FILTER, least=FEWEST)
    rows, noise = found
    state, passed = advance(begin(kind, testbed, noise), rows)
    unseen = standing_covariance(rows, recording, testbed) + leaning(state, testbed)
    covariance = at_home(state, unseen)
    body = body_of(state, testbed)
    flat = () if body is None else flat_reasons(body)
    ended = outcome_of(passed.surprise, (*left_out(state, rows, testbed), *flat))
    exists = body is None or is_possible(body)
    if not exists:
        ended = outcome(Why.FILTER_DIVERGED)
    return Estimate(
        card.name, ended, parameters_of(state, covariance), covariance,
        possible=exists, provenance=origin_of(recording), course=passed.course,
    )  # fmt: skip


def filter_method(card: Card, kind: Kind) -> Method:
    """Return the method of a filter; no filter has options."""

    def run(recording: Recording, testbed: Testbed, options: Options) -> Estimate:
        return estimate(card, kind, recording, testbed)

    return Method(card, run)
