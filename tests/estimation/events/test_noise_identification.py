"""Process noise of a record whose rate was kicked at every cut, by a known spread."""

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from equipoise.estimation.events.noise_identification import (
    CALM,
    calibrated,
    excesses,
    explained,
    likeliest,
    quiet,
)
from equipoise.estimation.events.record_model import (
    RecordModel,
    improbability,
    refitted,
    smoothed,
)
from equipoise.estimation.output_error.solution import settle
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.model.recording import Recording, Samples
from tests.support.builders import ATTITUDE, RATE, line_of, noisy, travel
from tests.support.event_records import END, TRACK, TRUTH, reported

SPACING = 0.5  # s
CUTS = np.arange(1.0, END - 0.6, SPACING)
KICKS = np.array([3e-4, 2e-4, 4e-4])  # rad/s, one sd about each axis: some sd of a row of the gyro
WALK = KICKS * np.diag(reported().body.inertia_P) / np.sqrt(SPACING)


@cache
def kicked(seed):
    rng, t = np.random.default_rng(seed), np.arange(0, END + 1e-9, 0.05)
    q, w, here, rate = [], [], ATTITUDE, RATE
    for start, end in pairwise([0.0, *CUTS, END + 0.05]):
        within = t[(t >= start - 1e-9) & (t < end - 1e-9)]
        line = line_of(np.append(within, end), TRACK)
        motion = travel(line, q0=here, w0=rate)
        q += [*motion.q[line.attitude_node[:-1]]]
        w += [*motion.rate[line.attitude_node[:-1]]]
        here, rate = motion.q[-1], motion.rate[-1] + KICKS * rng.normal(size=3)
    q, w = np.array(q), np.array(w)
    clean = Recording(Samples(t[::4], q[::4]), Samples(t, w), ("x", "y", "z"), TRACK)
    return noisy(clean, seed)


def model_of(seed, times):
    """The model with process noise so many times too great."""
    record, testbed, params = kicked(seed), reported(), Params(use_prior=True)
    first = settle(problem_of(record, testbed, params), TRUTH)
    return refitted(RecordModel(record, testbed, params, CUTS, times * WALK, (), first, testbed))


@pytest.mark.parametrize("times", [0.1, 10.0])
def test_the_likeliest_process_noise_is_that_of_the_kicks(times):
    """Of n kicks about an axis the spread is known to 1 / sqrt(2 n)."""
    found = likeliest(model_of(3, times))
    freedom = explained(*smoothed(found)).freedom
    assert np.all(freedom > len(CUTS) / 2)
    off = np.log(found.walk / WALK) * np.sqrt(2 * freedom)
    assert np.abs(off).max() < 3.5
    noise = found.testbed.gyro.noise / reported().gyro.noise
    assert abs(np.log(noise)) < 4 / np.sqrt(2 * 3 * len(found.recording.rate) / 2)


def test_no_other_process_noise_makes_the_record_more_probable():
    found = likeliest(model_of(4, 3.0))
    best = improbability(found)
    for axis in range(3):
        for times in (0.6, 1.6):
            other = np.where(np.arange(3) == axis, times, 1.0) * found.walk
            assert improbability(refitted(replace(found, walk=other))) > best + 0.1


@pytest.mark.parametrize("times", [1e-2, 1e3])
def test_process_noise_is_calibrated_from_any_first_size(times):
    """Half of all cuts are as surprised as they should be, wherever it began."""
    found, _, fit = calibrated(model_of(5, times))
    after = smoothed(found)[1]
    calm = quiet(found, np.array([jump.t for jump in fit.problem.jumps]))
    assert np.all(np.abs(np.log(excesses(after, calm))) < CALM)
    assert np.all(np.abs(np.log(found.walk / WALK)) < np.log(2.0))


def test_process_noise_that_there_is_none_of_amounts_to_no_unknown():
    """A record without kicks: its walk is left where it explains nothing."""
    still = noisy(Recording(*_calm_rows(), ("x", "y", "z"), TRACK), 6)
    testbed, params = reported(), Params(use_prior=True)
    first = settle(problem_of(still, testbed, params), TRUTH)
    model = RecordModel(still, testbed, params, CUTS, 0.3 * WALK, (), first, testbed)
    found = likeliest(refitted(model))
    assert np.all(found.walk < 0.2 * WALK)


def _calm_rows():
    t = np.arange(0, END + 1e-9, 0.05)
    line = line_of(t, TRACK)
    motion = travel(line)
    q, w = motion.q[line.attitude_node], motion.rate[line.attitude_node]
    return Samples(t[::4], q[::4]), Samples(t, w)
