"""The torque of each cause on a simulated platform, against the truth of its motion."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.model.defects import Contact
from equipoise.model.errors import InputError
from equipoise.model.estimate import BODY, NORMAL_95, Estimate
from equipoise.model.event import Event
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.torque_reasons import TorqueReason
from equipoise.model.recording import window
from equipoise.procedure.identification.attribute_torque import attribute_torque
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.simulation.carried_out import recorded
from equipoise.study.true_torque import TrueTorqueBench
from tests.support import thorough
from verification.torque_by_cause import KINDS
from verification.torque_by_cause import testbed_of as table_of

AIR = KINDS[0]


@pytest.fixture(scope="module")
def found():
    """Three quarters of a minute with two moves: bench, recording, testbed, estimate."""
    testbed = table_of(AIR, 0)
    bench = TrueTorqueBench(testbed, 108)
    recording = recorded(bench, 45.0, AIR.moves)
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    return bench, recording, testbed, last.estimate


@pytest.fixture(scope="module")
def torque(found):
    _, recording, testbed, estimate = found
    return attribute_torque(recording, testbed, estimate)


def test_total_is_the_true_torque_within_its_band(found, torque):
    true = found[0].torque_by_cause(np.append(torque.t, torque.t[-1] + 1.0)).sum(axis=1)
    error = torque.total - true
    assert np.mean(np.abs(error) <= NORMAL_95 * torque.total_sd) > 0.9
    assert np.sqrt(np.mean(error**2)) < 0.1 * np.sqrt(np.mean(true**2))


def test_causes_add_up_to_the_total(torque):
    assert torque.causes == ("gravity", "moves", "air")
    assert torque.torque.sum(axis=1) == pytest.approx(torque.total, rel=1e-9, abs=1e-15)


def test_moves_add_nothing_before_the_first_and_their_weight_after_it(torque):
    """x1 goes 2 mm along x at 20.5 s: 15.6 g times 2 mm times g about y, near level."""
    values, sd = torque.of("moves")
    assert np.abs(values[:20]).max() < 1e-12
    after = values[24:40, 1]
    wanted = 0.0156 * 2e-3 * 9.81
    assert np.abs(after - wanted).max() < 0.1 * wanted
    assert sd[30, 1] > sd[10, 1]


def test_sum_closes_the_momentum_balance(torque):
    assert torque.closes
    assert torque.closure.reason.code is TorqueReason.BALANCE_CLOSED
    assert 0.7 < torque.closure.normalised_rms < 1.3


def test_an_estimate_of_another_record_serves_as_well(found):
    """Its J and com with their covariance are what is known before this record."""
    bench, recording, testbed, estimate = found
    later = replace(window(recording, 15.0, 45.0), source="another")
    other = attribute_torque(later, testbed, estimate)
    true = bench.torque_by_cause(np.append(other.t, other.t[-1] + 1.0)).sum(axis=1)
    error = np.abs(other.total - true)
    assert np.mean(error <= NORMAL_95 * other.total_sd) > 0.85


def test_an_estimate_without_a_body_is_refused(found):
    _, recording, testbed, _ = found
    nothing = Estimate("equilibrium", Outcome(()), (), np.zeros((0, 0)))
    with pytest.raises(InputError, match=f"without {BODY[0]}"):
        attribute_torque(recording, testbed, nothing)


def test_a_recording_of_two_seconds_is_refused(found):
    _, recording, testbed, estimate = found
    with pytest.raises(InputError, match=r"at least 3 s"):
        attribute_torque(window(recording, 0.0, 2.0), testbed, estimate)


def test_an_estimate_of_an_impossible_body_is_refused(found):
    _, recording, testbed, estimate = found
    k = estimate.index("inertia_P_zz")
    changed = list(estimate.parameters)
    changed[k] = replace(changed[k], value=10.0)
    with pytest.raises(InputError, match="no body can have"):
        attribute_torque(recording, testbed, replace(estimate, parameters=tuple(changed)))


@thorough.whole
def test_a_touch_is_a_contact_of_its_second():
    """An impulse of 2 mN m s about a level axis is a mean of 2 mN m within that second alone."""
    testbed = table_of(AIR, 0)
    assert testbed.truth is not None
    touch = Contact(12.4, np.array([2e-3, 0.0, 0.0]))
    testbed = replace(testbed, truth=replace(testbed.truth, contacts=(touch,)))
    recording = recorded(TrueTorqueBench(testbed, 108), 20.0, ((8.5, {"x1": 2e-3}),))
    *_, last = identify(recording, testbed, IdentifyOptions("trajectory"))
    values, sd = attribute_torque(recording, testbed, last.estimate).of("contacts")
    assert np.linalg.norm(values[12]) == pytest.approx(2e-3, rel=0.1)
    assert np.linalg.norm(values[12]) > 10 * np.linalg.norm(sd[12])
    assert np.abs(np.delete(values, 12, axis=0)).max() == 0.0


def test_an_event_that_air_explains_as_well_is_none(found):
    _, recording, testbed, estimate = found
    noted = Event("impulse", 12.4, 0.01, np.zeros(3), np.eye(3), 40.0)
    torque = attribute_torque(recording, testbed, replace(estimate, events=(noted,)))
    assert "contacts" not in torque.causes
