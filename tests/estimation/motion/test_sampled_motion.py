"""Attitude and rate at common times from camera, gyro, or both; and the start made from them."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.motion.sampled_motion import (
    averaged,
    integrate_rate,
    level,
    sampled_motion,
)
from equipoise.estimation.output_error.growing_horizon import CAPTURE, misfit
from equipoise.estimation.output_error.initial_guess import start
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.maths.attitude import difference, exponential, tilt
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.recording import Recording, Samples
from equipoise.procedure.steps.clean_record import sound
from tests.support import thorough
from tests.support.builders import (
    COM,
    INERTIA,
    RATE,
    guessed_wrong,
    move_at,
    noisy,
    platform,
    recording,
)
from verification.method_records import regime
from verification.robustness import spoiled

SPIN = np.array([0.02, -0.01, 0.05])


@pytest.mark.parametrize("up", [*np.eye(3), *-np.eye(3), np.array([0.6, 0.0, -0.8])])
def test_level_has_its_axis_up(up):
    """Whatever body axis points up when level, straight down included."""
    assert tilt(level(up), up) == pytest.approx(0.0, abs=1e-7)


def test_constant_rate_integrates_to_a_constant_turn():
    """About one axis rotations add: 60 s of it, to rounding of 1200 products."""
    t = np.linspace(0, 60, 1201)
    q = integrate_rate(t, np.tile(SPIN, (1201, 1)), np.eye(4)[0])
    np.testing.assert_allclose(difference(q, exponential(t[:, None] * SPIN)), 0.0, atol=1e-12)


def test_gyro_alone_starts_level():
    """No camera: rates as they are, attitude integrated from level."""
    clean = recording(30.0, camera=0.0, gyro=20.0)
    found = sampled_motion(clean, replace(platform(gyro=True), attitude=None))
    assert found.w.tolist() == clean.rate.values.tolist()
    assert found.q[0].tolist() == [1.0, 0.0, 0.0, 0.0]
    full = recording(30.0, camera=20.0)
    turned = difference(full.attitude.values[-1], full.attitude.values[0])
    np.testing.assert_allclose(difference(found.q[-1], found.q[0]), turned, atol=1e-6)


def test_gyro_rates_replace_those_of_the_camera():
    """Within the gyro's rows the rate is their mean over a camera period, else the camera's."""
    both = recording(30.0, gyro=20.0)
    keep = both.rate.t < 20.0
    half = replace(both, rate=Samples(both.rate.t[keep], both.rate.values[keep] + 1.0))
    found = sampled_motion(half, platform(gyro=True))
    off = found.w - sampled_motion(replace(both, rate=None), platform()).w
    np.testing.assert_allclose(off[found.t < 19.9], 1.0, atol=1e-3)
    assert (off[found.t > 20.1] == 0).all()


def test_delay_and_averaging_shift_the_times():
    """A camera row stands for the middle of its exposure, before its delay."""
    slow = platform()
    slow = replace(slow, attitude=replace(slow.attitude, delay=0.3, averaging=0.1))
    clean = recording(10.0)
    np.testing.assert_allclose(sampled_motion(clean, slow).t, clean.attitude.t - 0.35)


def test_average_by_hand():
    """Rows within half the width on either side; the nearest later one when there is none."""
    t, values = np.arange(5.0), np.arange(5.0)[:, None] ** 2
    found = averaged(t, values, np.array([1.0, 2.5, 3.4]), 2.0)
    np.testing.assert_allclose(found[:, 0], [5 / 3, 6.5, 12.5])
    assert averaged(t, values, np.array([2.5]), 0.1)[0, 0] == 9.0
    assert averaged(t, values, np.array([9.0]), 0.1)[0, 0] == 16.0


MOVED = move_at(60.0, 120.0)


@pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])
def test_start_is_near_the_truth(gyro):
    """Without noise, from a guess 79 um and 10 % off: within 2 um, and within capture."""
    clean, testbed = recording(track=MOVED, gyro=gyro), guessed_wrong(platform(gyro=gyro > 0))
    problem = problem_of(clean, testbed, Params())
    found = start(clean, testbed, problem.layout, 0.0)
    assert np.abs(found.com - COM).max() < 2e-6
    assert np.abs(found.w0 - RATE).max() < 3e-3
    assert misfit(problem, found) < 0.3 * CAPTURE


def test_start_from_a_gyro_corrects_the_inertia():
    """The rates are good: within 3 % of J_zz where the guess was 4 to 5 % of it off."""
    clean, testbed = recording(track=MOVED, gyro=20.0), guessed_wrong(platform(gyro=True))
    layout = problem_of(clean, testbed, Params()).layout
    inertia = pack_symmetric(start(clean, testbed, layout, 0.0).body(14.24).inertia_P)
    np.testing.assert_allclose(inertia, INERTIA, rtol=0, atol=0.03 * INERTIA[2])


@pytest.mark.parametrize("seed", thorough.some(range(5), 2))
def test_start_is_good_enough_with_noise(seed):
    """The fit begins at the whole record: within capture, camera alone, 0.2 deg."""
    observed, testbed = noisy(recording(track=MOVED), seed), guessed_wrong(platform())
    problem = problem_of(observed, testbed, Params())
    assert misfit(problem, start(observed, testbed, problem.layout, 0.0)) < CAPTURE


def test_start_knows_nothing_but_the_record():
    """A recording without masses has no displacement errors, torques or bias to begin with."""
    clean = Recording(attitude=recording(30.0).attitude)
    found = start(clean, platform(), problem_of(clean, platform(), Params()).layout, 0.0)
    assert not found.torque.any()
    assert found.error.shape == (0,)
    assert not found.bias.any()


@pytest.mark.parametrize("seed", thorough.some(range(4), 1))
def test_rows_of_an_impossible_body_do_not_start_wildly(seed):
    """Outliers, dropouts and a gap: the rate of the first second, within 10 deg/s.

    With seed 1 the rows' own J is nearly singular; the rate that it gives is 2700 deg/s off.
    """
    record = regime("moved", seed)
    rows, testbed = sound(spoiled(record.recording, seed), record.testbed)
    found = start(rows, testbed, problem_of(rows, testbed, Params()).layout, 0.0)
    observed = np.median(rows.rate.values[:50], axis=0)
    assert np.linalg.norm(found.w0 - observed) < np.radians(10)
