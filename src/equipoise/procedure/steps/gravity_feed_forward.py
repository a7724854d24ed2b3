"""What the tracker expects of gravity's torque, for a controller's feed-forward.

The tracker begins with what an estimate gives: centre of mass with the masses at home, inertia, sag
and warmth; what it lacks comes from the testbed. It then follows every row, so that drift, moves
and warmth are in its centre of mass.

Sag that no estimate gives is left to the tracker's r, which then holds near one attitude alone.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.control.elements.gravity_feed_forward import (
    SAG,
    Heavy,
    Moving,
    gravity_ahead,
    is_usable,
)
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import COM, RATE_OF_COM
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import INERTIA
from equipoise.model.given_numbers import GivenNumbers
from equipoise.model.gravity_torque import GravityTorque, TorqueStatus
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS
from equipoise.model.units import UM

AGED = 1 * UM  # m, chosen: what minutes between an estimate and its use move a centre of mass by
SILENT = 0.5  # s, chosen: as long as silence that stops a real bench
STATES = np.r_[0:6, np.r_[COM], np.r_[RATE_OF_COM]]  # of attitude, rate, com and drift


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """What the tracker begins with."""

    posterior: tracker.Posterior
    params: tracker.Params
    heavy: Heavy


def known_body(testbed: Testbed, given: GivenNumbers) -> Known:
    """Return what is known of a platform before the first row."""
    prior, names = tracker.posterior_of(testbed), (*COM_NAMES, *INERTIA)
    shown = np.array([given.known((name,)) for name in names])
    values = np.concatenate([prior.com, pack_symmetric(prior.inertia_P)])
    covariance = prior.covariance.copy()
    values[shown], covariance[np.ix_(shown, shown)] = given.of(
        tuple(name for name, is_given in zip(names, shown, strict=True) if is_given)
    )
    covariance[np.diag_indices(3)] += np.where(shown[:3], AGED**2, 0.0)
    sag, sag_covariance = given.of(SAG) if given.known(SAG) else (np.zeros(5), np.zeros((5, 5)))
    torque = np.zeros(len(TERMS))
    torque[[TERMS.index(name) for name in SAG]] = sag
    return Known(
        tracker.Posterior(values[:3], unpack_symmetric(values[3:]), covariance),
        tracker.Params(torque=torque),
        Heavy(testbed.body.mass, testbed.gravity, sag, sag_covariance),
    )


def expected(
    state: tracker.State, heavy: Heavy, shift: Vector3, newest: float, lead: float
) -> GravityTorque:
    """Return gravity's torque ``lead`` (s) after the newest row (bench time, s) of any channel.

    ``shift`` (m) is by how much the masses move the centre of mass as they stand.
    """
    covariance = state.covariance[np.ix_(STATES, STATES)]
    moving = Moving(state.q, state.rate, state.com + shift, state.drift, covariance)
    ahead = gravity_ahead(moving, heavy, newest + lead - state.t)
    status = TorqueStatus.USABLE if is_usable(ahead, heavy) else TorqueStatus.NOT_USABLE
    if newest - state.t > SILENT:
        status = TorqueStatus.STALE
    sds = (np.sqrt(np.diag(each)) for each in (ahead.torque_covariance, ahead.moment_covariance))
    torque_sd, first_moment_sd = sds
    return GravityTorque(
        newest, lead, ahead.torque, torque_sd, ahead.first_moment, first_moment_sd, ahead.gravity,
        status,
    )  # fmt: skip


def heavy_of(testbed: Testbed, torque: Floats | None) -> Heavy:
    """Return what gravity acts on, of a tracker with torque coefficients taken as known."""
    names = [TERMS.index(name) for name in SAG]
    sag = np.zeros(len(SAG)) if torque is None else torque[names]
    return Heavy(testbed.body.mass, testbed.gravity, sag, np.zeros((len(SAG), len(SAG))))


def nothing_expected(newest: float, lead: float) -> GravityTorque:
    """Return what is sent before there is an attitude: zeros, not usable."""
    zero = np.zeros(3)
    return GravityTorque(
        newest, lead, zero, zero, zero, zero, zero, TorqueStatus.NOT_USABLE
    )  # fmt: skip
