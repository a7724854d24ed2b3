"""Period, amplitude and decay of a swing about a known axis, from attitudes with noise."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.maths.attitude import exponential, multiply
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.identification.timed_swing import timed
from tests.estimation.mass_budget.part_builders import swing

AXIS = np.array([0.6, 0.0, 0.8])
PERIOD, AMPLITUDE, DECAY = 1.7, 0.1, 0.02  # s, rad, 1/s
SD = np.radians(0.05)


def recorded(seed, amplitude=AMPLITUDE, across=0.0, seconds=40.0):
    """Turns about the axis from some attitude; a second, quicker swing across it."""
    rng = np.random.default_rng(seed)
    t = np.arange(0, seconds, 0.05)
    theta = amplitude * np.exp(-DECAY * t) * np.cos(2 * np.pi * t / PERIOD + 0.4)
    other = across * np.sin(2 * np.pi * t / 0.9)
    turn = np.outer(theta, AXIS) + np.outer(other, [0.8, 0.0, -0.6])
    q = multiply(exponential(np.array([0.3, -0.2, 1.0])), exponential(turn))
    return Recording(Samples(t, multiply(q, exponential(SD * rng.normal(size=(len(t), 3))))), None)


def test_the_period_is_that_of_the_record_within_its_sd():
    """Ten records: the greatest of the errors is a few sd, and the sd are not too wide."""
    z = []
    for seed in range(10):
        found = timed(swing(AXIS), recorded(seed, amplitude=0.02))
        z.append((found.period - PERIOD) / found.period_sd)
        assert found.period_sd < 1e-3
    assert np.max(np.abs(z)) < 4
    assert np.sqrt(np.mean(np.square(z))) > 0.2


def test_amplitude_and_decay_are_its_own():
    """rms over the record of e^(-l t): 0.1 sqrt((1 - e^-1.6) / 1.6)."""
    found = timed(swing(AXIS, amplitude_sd=0.1), recorded(1))
    assert found.period == pytest.approx(PERIOD, rel=1e-4)
    assert found.decay == pytest.approx(DECAY, rel=0.05)
    assert found.amplitude == pytest.approx(0.1 * np.sqrt((1 - np.exp(-1.6)) / 1.6), rel=0.02)
    assert found.amplitude_sd == 0.0


def test_what_swings_across_the_axis_is_not_taken_for_it():
    found = timed(swing(AXIS), recorded(2, amplitude=0.05, across=0.15))
    assert found.period == pytest.approx(PERIOD, rel=2e-3)


def test_a_record_in_which_nothing_swings_is_refused():
    with pytest.raises(InputError, match="no swing about the axis of 'swing'"):
        timed(swing(AXIS), recorded(3, amplitude=0.0))
    without = replace(recorded(3), attitude=None)
    with pytest.raises(InputError, match="without attitude"):
        timed(swing(AXIS), without)
