"""The tracker knows what it does not know: scale, contacts, odd rows, gaps, noise."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.estimation.tracker.tracker import Params, contact_alarm, first_state, track
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.linalg import element_sizes, pack_symmetric
from equipoise.model.recording import Samples, window
from tests.oracle import cases
from verification import case_s

STILL = Params("fed", 1e-10, 1e-10)
NOWHERE = np.zeros(3)


def tracked(record, seed: int, doubt: float = 0.02):
    testbed = case_s.testbed(seed, doubt)
    first = first_state(0.0, record.attitude.values[0], testbed)
    return track(record, testbed, STILL, first)


def nees(found, seed: int, shift=NOWHERE) -> float:
    true = np.concatenate([case_s.COM + shift, case_s.case(seed).inertia])
    error = np.concatenate([found.com[-1], found.inertia[-1]]) - true
    return float(error @ np.linalg.solve(found.end.posterior.covariance, error))


@pytest.mark.parametrize("doubt", [0.02, 0.2])
def test_before_a_move_nothing_is_learnt_about_the_scale(doubt):
    """Information along (J, r), where it linearises: the prior's, sum (x_i / sd_i)^2, to 10 %."""
    for seed in range(3):
        testbed = case_s.testbed(seed, doubt)
        found = tracked(window(case_s.run(seed), 0.0, 55.0), seed, doubt)
        x = found.end.memory.point
        prior = np.append(testbed.com_sd, doubt * element_sizes(testbed.body.inertia_P))
        information = x @ np.linalg.solve(found.end.posterior.covariance, x)
        assert information == pytest.approx(np.sum((x / prior) ** 2), rel=0.1)


@pytest.mark.parametrize("doubt", [0.02, 0.2])
@pytest.mark.parametrize("until", [55.0, 120.0])
def test_its_covariance_is_honest_from_a_wrong_inertia(doubt, until):
    """Mean NEES of 12 seeds, 9 unknowns each, within what chance does once in 1000 (and 15 %)."""
    values = [
        nees(tracked(window(case_s.run(seed), 0.0, until), seed, doubt), seed) for seed in range(12)
    ]
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 9 * 12) / 12
    assert low < np.mean(values) < 1.15 * high


def test_alarm_is_where_chance_comes_once_in_two_hours():
    """5 rows a second, 7200 s, two kinds: 1 in 72000, and chi-square of 3 degrees of freedom."""
    record, testbed = case_s.run(0), case_s.testbed(0, 0.02)
    assert chi2.sf(contact_alarm(testbed, record), 3) == pytest.approx(1 / 72000)


@pytest.mark.parametrize("size", [2e-3, 5e-3])
def test_an_impulse_is_reported_and_survived(size):
    """Its time to 2 s, each component within 4 sd, NEES at the end below once in 1e4 (33.7)."""
    for seed in range(3):
        impulse = size * case_s.way(seed)
        found = tracked(case_s.run(seed, case_s.Event(95.1, impulse, NOWHERE)), seed)
        assert [contact.kind for contact in found.contacts] == ["impulse"]
        (contact,) = found.contacts
        assert contact.t == pytest.approx(95.1, abs=2.0)
        assert np.all(np.abs(contact.impulse - impulse) < 4 * contact.impulse_sd)
        assert nees(found, seed) < chi2.isf(1e-4, 9)


def test_a_step_of_the_centre_of_mass_is_distinguished_from_an_impulse():
    """20 um: its time to 2 s, each component within 4 sd, NEES at the end below once in 1e4."""
    for seed in range(3):
        shift = 20e-6 * case_s.way(seed)
        found = tracked(case_s.run(seed, case_s.Event(95.1, NOWHERE, shift)), seed)
        (contact,) = found.contacts
        assert contact.kind == "step"
        assert contact.t == pytest.approx(95.1, abs=2.0)
        assert np.all(np.abs(contact.shift - shift) < 4 * contact.shift_sd)
        assert nees(found, seed, shift) < chi2.isf(1e-4, 9)


@pytest.mark.parametrize("doubt", [0.02, 0.2])
def test_a_contact_is_noticed_while_the_inertia_is_learnt(doubt):
    """2 mN m s at 40 s, before the move: to 15 s in 8 of 9 runs; median NEES as of 9 unknowns."""
    times, values = [], []
    for seed in range(9):
        event = case_s.Event(40.1, 2e-3 * case_s.way(seed), NOWHERE)
        found = tracked(case_s.run(seed, event), seed, doubt)
        times.append(min([abs(c.t - event.t) for c in found.contacts], default=np.inf))
        values.append(nees(found, seed))
    assert np.sum(np.array(times) < 15.0) >= 8
    assert np.median(values) < chi2.isf(0.05, 9)


def test_nothing_is_called_a_contact_where_nothing_touched():
    """Ten minutes, J 2 % wrong."""
    assert [c for seed in range(5) for c in tracked(case_s.run(seed), seed).contacts] == []


def test_one_odd_row_is_left_out_and_its_time_kept():
    """30 deg off at 80 s: not used, no contact, the estimate as if the row were not there."""
    record = case_s.run(1)
    values = record.attitude.values.copy()
    values[400] = multiply(values[400], exponential(np.array([0.5, 0.0, 0.0])))
    odd = tracked(replace(record, attitude=Samples(record.attitude.t, values)), 1)
    np.testing.assert_array_equal(odd.not_used, [80.0])
    assert odd.contacts == ()
    keep = np.arange(601) != 400
    attitude = Samples(record.attitude.t[keep], record.attitude.values[keep])
    without = tracked(replace(record, attitude=attitude), 1)
    assert np.all(np.abs(odd.com[-1] - without.com[-1]) < 0.3 * odd.com_sd[-1])


@pytest.mark.parametrize("times", [1 / 3, 1.0, 3.0])
def test_the_level_of_noise_is_found(times):
    """Within 15 %: five times what k's spread of 6 % leaves of the sd; intervals go with it."""
    found = tracked(case_s.run(2, None, times), 2)
    assert found.end.noise_levels[0] == pytest.approx(times, rel=0.15)
    stated = tracked(case_s.run(2), 2)
    share = found.com_sd[-1] / stated.com_sd[-1]
    assert np.all((share > 0.75 * times) & (share < 1.33 * times))


@pytest.mark.parametrize(("start", "fresh"), [(10.0, True), (70.0, False)])
def test_after_a_gap_of_28_s(start, fresh):
    """Early on nobody can say how it has swung since, so it restarts; later it goes on."""
    for seed in range(3):
        record = case_s.run(seed)
        t = record.attitude.t
        keep = (t <= start) | (t >= start + 28.0)
        attitude = Samples(t[keep], record.attitude.values[keep])
        found = tracked(replace(record, attitude=attitude), seed)
        assert [contact.kind for contact in found.contacts] == ["lost"] * fresh
        assert nees(found, seed) < chi2.isf(1e-4, 9)


@pytest.mark.parametrize("seed", [0, 22, 33])
def test_a_gap_that_a_better_point_cannot_foresee(seed):
    """MuJoCo, camera 5 Hz and gyro 10 Hz, nothing between 20 and 50 s, J known to 20 %.

    Kept as it was in the first pass, the gap left an element of J 11, 9 and 17 sd wrong here.
    """
    logged = cases.case_i(seed)
    spoilt = without(logged.recording, seed)
    first = first_state(0.0, spoilt.attitude.values[0], logged.testbed)
    found = track(spoilt, logged.testbed, Params(), first)
    error = found.inertia[-1] - pack_symmetric(logged.truth.inertia_P)
    assert np.all(np.abs(error) < 4 * found.sd[-1, 9:15])


def without(record, seed: int):
    """One row in ten is missing, and all between 20 and 50 s."""
    rng, channels = np.random.default_rng([seed, 77]), []
    for channel in (record.attitude, record.rate):
        keep = (rng.random(len(channel)) > 0.1) & ~((channel.t > 20.0) & (channel.t < 50.0))
        keep[[0, -1]] = True
        channels.append(Samples(channel.t[keep], channel.values[keep]))
    return replace(record, attitude=channels[0], rate=channels[1])


def test_the_inertia_estimate_matches_the_precision_of_the_batch_fit():
    """From 20 % off: every element of J within 4 sd at the end, known to 1 % of its size."""
    found = tracked(case_s.run(4), 4, 0.2)
    true = case_s.case(4).inertia
    sd = found.sd[-1, 9:15]
    assert np.all(np.abs(found.inertia[-1] - true) < 4 * sd)
    assert np.all(sd < 0.012 * element_sizes(found.end.inertia_P))
    np.testing.assert_array_equal(pack_symmetric(found.end.inertia_P), found.inertia[-1])
