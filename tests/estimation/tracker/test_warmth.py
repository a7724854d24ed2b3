"""The tracker under a lamp: its equations, what it keeps, and how much better it is for it."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.dynamics.regressor import DRIFT
from equipoise.estimation.tracker import event_signatures as onsets
from equipoise.estimation.tracker.kernel_records import new_tools
from equipoise.estimation.tracker.known_inputs import inputs_kept, inputs_of
from equipoise.estimation.tracker.measurements import Rows, followed_by
from equipoise.estimation.tracker.stored_covariance import SIZE, WARM_ROW
from equipoise.estimation.tracker.tracker import Params, first_state, steady, track
from equipoise.estimation.tracker.warmth import unknown_warmth, warmth_of
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.outcome import Outcome
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.torque_terms import GROUPS
from tests.support import thorough
from verification import lamp

THERMAL, COM = slice(WARM_ROW, SIZE), slice(6, 9)
STILL = Params("fed", *lamp.STILL)


def test_signatures_of_events_are_displaced_alike():
    """X <- Phi F X, with Phi the unit matrix."""
    watch, room = onsets.new_watch(), new_tools(True, SIZE).room
    watch.X[:] = np.random.default_rng(2).normal(size=watch.X.shape)
    X, phi = watch.X.reshape(SIZE, -1).copy(), np.zeros((6, 16))
    phi[range(6), range(6)] = 1.0
    onsets.follow(watch, phi.ravel(), 0.5, 0.0, room)
    X[COM] += 0.5 * X[THERMAL]
    np.testing.assert_allclose(watch.X.reshape(SIZE, -1), X, rtol=1e-14)


def test_warmth_goes_on_from_one_piece_to_the_next():
    """1 K in the first, 2 K more in the second."""
    whole, none = np.zeros(0, np.int64), np.zeros((0, 3))

    def piece(t, warm):
        known = np.zeros((len(t), 7))
        known[:, 6] = warm
        q = np.zeros((0, 4))
        return Rows(np.array(t), known, np.zeros((0, 2), np.int64), q, whole, none, whole, whole,
                    np.zeros((0, 3, 3)))  # fmt: skip

    joined = followed_by(piece([0.0, 1.0], [0.0, 1.0]), piece([1.0, 2.0, 3.0], [0.0, 0.5, 2.0]))
    np.testing.assert_array_equal(joined.t, [0.0, 1.0, 2.0, 3.0])
    np.testing.assert_array_equal(joined.known[:, 6], [0.0, 1.0, 1.5, 3.0])


def samples(t, values) -> Samples:
    return Samples(np.array(t), np.array(values)[:, None])


def test_what_later_rows_need_is_kept():
    """The temperature as it was at 2.5 s, what is later, and each switch with the last row."""
    warm = samples([0.0, 1.0, 2.0, 3.0], [20.0, 21.0, 22.0, 23.0])
    power = samples([0.0, 5.0, 7.0, 8.0, 9.0], [0.0, 0.0, 1.0, 1.0, 1.0])
    heat = Recording(temperature=warm, lamp=power)
    kept = inputs_kept(heat, 2.5)
    np.testing.assert_array_equal(kept.temperature.t, [2.5, 3.0])
    np.testing.assert_array_equal(kept.temperature.values[:, 0], [22.5, 23.0])
    np.testing.assert_array_equal(kept.lamp.t, [0.0, 7.0, 9.0])
    grown = inputs_of(kept, Recording(lamp=samples([9.0, 12.0], [1.0, 0.0])))
    np.testing.assert_array_equal(grown.lamp.t, [0.0, 7.0, 9.0, 12.0])
    np.testing.assert_array_equal(grown.temperature.t, [2.5, 3.0])


def test_drift_and_warmth_are_left_to_the_tracker():
    kept = steady(np.arange(1.0, 20.0))
    np.testing.assert_array_equal(kept, [*np.arange(1.0, DRIFT + 1.0), *[0.0] * 6])
    assert steady(None) is None


def test_an_estimate_of_warmth_is_the_prior():
    """With its covariance with com and inertia; one that did not leaves what benches have."""
    names = GROUPS["thermal"]
    three = tuple(Parameter(n, "m/K", v, 1e-8) for n, v in zip(names, (1.0, 2.0, 3.0), strict=True))
    com = (Parameter("com_x", "m", 0.0, 1e-6),)
    found = Estimate("m", Outcome(()), (*com, *three), np.arange(16.0).reshape(4, 4))
    known = warmth_of(found, ("com_x",))
    np.testing.assert_array_equal(known.thermal, [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(known.covariance[:, 0], [4.0, 8.0, 12.0])
    np.testing.assert_array_equal(known.covariance[:, 9:], np.arange(16.0).reshape(4, 4)[1:, 1:])
    unknown = unknown_warmth()
    for none in (None, replace(found, parameters=com, covariance=np.eye(1))):
        np.testing.assert_array_equal(warmth_of(none, ()).covariance, unknown.covariance)
    np.testing.assert_allclose(np.sqrt(np.diag(unknown.covariance[:, 9:])), 5e-7)


@cache
def logged(seed: int) -> lamp.Logged:
    return lamp.logged(seed)


@pytest.mark.parametrize("by", ["lamp", "temperature"])
def test_in_pieces_it_is_the_same(by):
    """Rows every 5 s, a switch within; the warmth goes on from one piece to the next."""
    log = logged(0)
    record = log.recording
    if by == "temperature":
        t = np.arange(0.0, 600.1, 2.0)
        warm = samples(t, 20.0 + np.sin(t / 60.0))
        record = replace(record, lamp=None, temperature=warm)
    state = first = first_state(0.0, record.attitude.values[0], log.testbed)
    whole = track(record, log.testbed, STILL, first).end
    for k in range(0, 600, 5):
        state = track(window(record, float(k), k + 5.0), log.testbed, STILL, state).end
    np.testing.assert_allclose(state.com, whole.com, rtol=0, atol=2e-9)
    np.testing.assert_allclose(state.thermal, whole.thermal, rtol=0, atol=2e-9)
    np.testing.assert_allclose(np.diag(state.covariance), np.diag(whole.covariance), rtol=0.02)


def test_a_lamp_that_is_recorded_is_foreseen():
    """Error of com: two thirds are left with the switch recorded, half with k known.

    Where nothing else moves it, the error is a tenth of that without the switch.
    """
    log = logged(5)
    dark, nothing = replace(log.recording, lamp=None), np.zeros(3)
    cases = ((log.recording, nothing), (dark, nothing), (log.recording, log.thermal))
    recorded, dark_error, known = (
        np.sqrt(np.mean(lamp.tracked(log, record, Params(), k)[0] ** 2)) for record, k in cases
    )
    assert recorded < dark_error / 1.5
    assert known < dark_error / 2.0
    calm, surprised = (
        np.sqrt(np.mean(lamp.tracked(log, r, STILL, nothing)[0] ** 2))
        for r in (log.recording, dark)
    )
    assert calm < surprised / 10.0


def test_errors_of_com_and_warmth_are_as_large_as_stated():
    """At the end of the record, over platforms whose com moves by warmth alone."""
    z = []
    for seed in range(thorough.count(40, 8)):
        log = logged(seed)
        error, sd, found = lamp.tracked(log, log.recording, STILL, np.zeros(3))
        of_k = (found.thermal[-1] - log.thermal) / found.sd[-1, THERMAL]
        z += [*(error / sd)[-1], *of_k]
    assert np.abs(z).max() < 4.0
    assert 0.6 < np.sqrt(np.mean(np.square(z))) < 1.35
