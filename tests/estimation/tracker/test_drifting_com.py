"""A tracker whose state has the drift knows it, and does not take it for contacts."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.stats import chi2

from equipoise.estimation.tracker.predict_correct import COM, RATE_OF_COM
from equipoise.estimation.tracker.tracker import Params, first_state, track
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import MINUTE, UM
from equipoise.simulation.bench import SimulatedBench

RATE = 3 * UM / MINUTE  # m/s
UNKNOWN = 4 * UM / MINUTE  # m/s, one sd before the record
SEEDS, DURATION = 6, 180.0  # s
STILL = Params("fed", com_walk=1e-10, torque_walk=1e-10)
KNOWN = np.s_[(*range(COM.start, COM.stop), *range(RATE_OF_COM.start, RATE_OF_COM.stop))]


def swinging(seed):
    """The preset, its inertia known, hanging near its target, with a drift of 3 um/min."""
    bed = read_preset("sputnix")
    way = np.random.default_rng([seed, 5]).normal(size=3)
    drift = RATE * way / np.linalg.norm(way)
    truth = replace(
        bed.truth, inertia_error=0.0, com_low=np.array([-5, -5, -105]) * UM,
        com_high=np.array([5, 5, -95]) * UM,
        torque=dict(zip(("drift_x", "drift_y", "drift_z"), drift, strict=True)),
    )  # fmt: skip
    return replace(bed, inertia_sd=0.0, truth=truth), drift


@cache
def followed(seed, unknown):
    """A track of three minutes, the truth at its end and the true drift."""
    bed, drift = swinging(seed)
    bench = SimulatedBench(bed, seed)
    record = bench.read(DURATION)
    first = first_state(0.0, record.attitude.values[0], bed)
    covariance = first.covariance.copy()
    covariance[RATE_OF_COM, RATE_OF_COM] = unknown**2 * np.eye(3)
    return track(record, bed, STILL, replace(first, covariance=covariance)), bench.truth(), drift


def test_com_and_its_drift_are_within_what_the_covariance_says():
    """NEES of 6 unknowns over the seeds, by chance beyond the band once in 1000."""
    values = []
    for seed in range(SEEDS):
        found, truth, drift = followed(seed, UNKNOWN)
        error = np.concatenate([found.end.com - truth.com, found.end.drift - drift])
        values.append(error @ np.linalg.solve(found.end.covariance[np.ix_(KNOWN, KNOWN)], error))
    low, high = chi2.ppf([5e-4, 1 - 5e-4], 6 * SEEDS) / SEEDS
    assert low < np.mean(values) < high


def test_the_drift_becomes_known():
    """From 4 um/min to some hundredths sideways; along gravity it costs more time."""
    sd = np.array([followed(seed, UNKNOWN)[0].sd[-1, RATE_OF_COM] for seed in range(SEEDS)])
    assert np.median(sd[:, :2]) < 0.1 * UM / MINUTE
    assert np.median(sd[:, 2]) < 0.4 * UM / MINUTE


def test_a_drift_in_the_state_is_no_contact():
    contacts = [c for seed in range(SEEDS) for c in followed(seed, UNKNOWN)[0].contacts]
    assert contacts == []


def test_without_it_the_drift_is_taken_for_contacts():
    """Which is what holds went wrong by when nobody had declared the drift."""
    found, _, _ = followed(0, 0.0)
    assert len(found.contacts) > 0
    np.testing.assert_array_equal(found.end.drift, 0.0)


def test_a_drift_is_kept_over_calls():
    """In pieces of 5 s, as a hold reads: the same to rounding."""
    bed, _ = swinging(1)
    bench = SimulatedBench(bed, 1)
    whole = followed(1, UNKNOWN)[0].end
    state = None
    for _ in range(int(DURATION / 5)):
        fresh = bench.read(5.0)
        if state is None:
            first = first_state(0.0, fresh.attitude.values[0], bed)
            covariance = first.covariance.copy()
            covariance[RATE_OF_COM, RATE_OF_COM] = UNKNOWN**2 * np.eye(3)
            state = replace(first, covariance=covariance)
        state = track(fresh, bed, STILL, state).end
    assert state.drift == pytest.approx(whole.drift, abs=0.02 * UM / MINUTE)
