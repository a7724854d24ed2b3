"""What the tracker begins with, and when its torque may be acted on."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.tracker import tracker
from equipoise.io.testbed.presets import read_preset
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.given_numbers import NOTHING_GIVEN, GivenNumbers
from equipoise.model.gravity_torque import TorqueStatus
from equipoise.model.torque_terms import GROUPS
from equipoise.model.units import UM
from equipoise.procedure.steps.gravity_feed_forward import expected, known_body, nothing_expected

BED = read_preset("nanosat")
NAMES = (*COM, *INERTIA, *GROUPS["sag"])
VALUES = np.array([1.0 * UM, 2 * UM, -30 * UM, 0.04, 0.05, 0.03, 1e-4, 2e-4, 3e-4, 1e-6, 2e-6,
                   3e-6, 4e-6, 5e-6])  # fmt: skip
SDS = np.array([0.3 * UM, 0.4 * UM, 2 * UM, *[1e-4] * 6, *[1e-7] * 5])
GIVEN = GivenNumbers(NAMES, VALUES, np.diag(SDS**2))


def test_without_an_estimate_it_begins_with_the_testbed():
    known, prior = known_body(BED, NOTHING_GIVEN), tracker.posterior_of(BED)
    assert known.posterior.com == pytest.approx(prior.com)
    assert known.posterior.inertia_P == pytest.approx(prior.inertia_P)
    assert known.posterior.covariance == pytest.approx(prior.covariance)
    assert not known.heavy.sag.any()
    assert not known.heavy.sag_covariance.any()


def test_an_estimate_goes_before_it_sag_included():
    """The centre of mass is 1 um less sure than it was: it may have drifted since."""
    known = known_body(BED, GIVEN)
    assert known.posterior.com == pytest.approx(VALUES[:3])
    assert known.posterior.inertia_P[0, 1] == 1e-4
    assert np.diag(known.posterior.covariance)[:3] == pytest.approx(SDS[:3] ** 2 + UM**2)
    assert np.diag(known.posterior.covariance)[3:] == pytest.approx(SDS[3:9] ** 2)
    assert known.heavy.sag == pytest.approx(VALUES[9:])
    assert known.heavy.sag_covariance == pytest.approx(np.diag(SDS[9:] ** 2))
    assert known.params.torque is not None
    assert known.params.torque[8:13] == pytest.approx(VALUES[9:])
    assert np.count_nonzero(known.params.torque) == 5


def test_what_the_estimate_did_not_show_comes_from_the_testbed():
    covariance = GIVEN.covariance.copy()
    covariance[2, 2] = np.inf
    known = known_body(BED, replace(GIVEN, covariance=covariance))
    assert known.posterior.com == pytest.approx([*VALUES[:2], BED.body.com[2]])
    assert known.posterior.covariance[2, 2] == pytest.approx(BED.com_sd[2] ** 2)


def state(com_sd):
    """Return a level platform at rest, its centre of mass 10 um aside."""
    q = np.array([1.0, 0, 0, 0])
    posterior = tracker.Posterior(np.array([10 * UM, 0, -50 * UM]), BED.body.inertia_P,
                                  np.diag([*[com_sd**2] * 3, *[0.0] * 6]))  # fmt: skip
    found = tracker.first_state(5.0, q, BED, posterior)
    covariance = found.covariance.copy()
    covariance[:6, :6] = 0.0
    return replace(found, covariance=covariance, drift=np.array([1.0, 0, 0]) * UM)


def test_moves_and_drift_are_in_the_torque():
    """10 um, 2 um of masses, and 1 um/s for the second until then: 13 um of 4 kg."""
    known, shift = known_body(BED, NOTHING_GIVEN), np.array([2.0, 0, 0]) * UM
    found = expected(state(1 * UM), known.heavy, shift, 5.4, 0.6)
    assert (found.t, found.lead, found.status) == (5.4, 0.6, TorqueStatus.USABLE)
    assert found.first_moment == pytest.approx([4.0 * 13 * UM, 0, -4.0 * 50 * UM])
    assert found.torque == pytest.approx([0, 4.0 * 13 * UM * 9.80665, 0])
    assert found.first_moment_sd == pytest.approx([4.0 * UM] * 3)
    assert found.torque_sd == pytest.approx([*[4.0 * UM * 9.80665] * 2, 0.0])


@pytest.mark.parametrize(
    ("com_sd", "newest", "status"),
    [
        (1 * UM, 5.5, TorqueStatus.USABLE),
        (40 * UM, 5.5, TorqueStatus.NOT_USABLE),
        (1 * UM, 5.51, TorqueStatus.STALE),
        (40 * UM, 9.0, TorqueStatus.STALE),
    ],
)
def test_it_says_whether_to_act_on_it(com_sd, newest, status):
    known = known_body(BED, NOTHING_GIVEN)
    assert expected(state(com_sd), known.heavy, np.zeros(3), newest, 0.0).status is status


def test_before_an_attitude_it_says_nothing():
    found = nothing_expected(3.0, 0.06)
    assert (found.t, found.status) == (3.0, TorqueStatus.NOT_USABLE)
    assert not found.torque.any()
