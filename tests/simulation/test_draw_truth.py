from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321, tilt, to_matrix
from equipoise.model.mass_properties import MassProperties, is_possible, smallest_second_moment
from equipoise.model.torque_terms import TERMS
from equipoise.simulation.draw_truth import LITTLE, draw_inertia, draw_truth

RUNS = 400


def drawn(testbed, runs=RUNS):
    return [draw_truth(testbed, np.random.default_rng(seed)) for seed in range(runs)]


@pytest.fixture(scope="module")
def sputnix():
    return read_preset("sputnix")


def test_what_is_given_is_used(testbed):
    attitude, rate, bias = np.array([0.1, -0.2, 0.3]), np.array([1e-3, 2e-3, 3e-3]), np.full(3, 9.0)
    given = {"attitude": attitude, "rate": rate, "gyro_bias": bias, "torque": {"swirl": 2.0}}
    platform = draw_truth(testbed((1e-4, 0.0, -1e-4), truth=given), np.random.default_rng(0))
    np.testing.assert_array_equal(platform.body.com, [1e-4, 0.0, -1e-4])
    np.testing.assert_array_equal(platform.body.inertia_P, np.diag([1.0, 2.0, 2.5]))
    np.testing.assert_allclose(platform.attitude, from_euler321(0.1, -0.2, 0.3))
    np.testing.assert_array_equal(platform.rate, rate)
    np.testing.assert_array_equal(platform.truth.gyro_bias, bias)
    assert dict(zip(TERMS, platform.torque, strict=True)) == {
        t: 2.0 * (t == "swirl") for t in TERMS
    }


def test_centre_of_mass_fills_its_box(sputnix):
    truth = sputnix.truth
    com = np.array([p.body.com for p in drawn(sputnix)])
    assert np.all((com >= truth.com_low) & (com <= truth.com_high))
    # of 400, the extremes come within 2 % of the walls but for one chance in 3000
    width = truth.com_high - truth.com_low
    assert np.all(com.min(0) < truth.com_low + 0.02 * width)
    assert np.all(com.max(0) > truth.com_high - 0.02 * width)


def test_inertia_is_possible_and_within_its_error(sputnix):
    guess = sputnix.body.inertia_C
    all_drawn = np.array([p.body.inertia_C for p in drawn(sputnix)])
    assert all(is_possible(p.body) for p in drawn(sputnix, 50))
    np.testing.assert_allclose(all_drawn, all_drawn.transpose(0, 2, 1), atol=1e-15)
    size = np.sqrt(np.diag(guess))
    off = np.outer(size, size) - np.diag(size**2)
    reach = 0.1 * (np.abs(guess) + LITTLE * off)
    error = np.abs(all_drawn - guess)
    assert np.all(error <= reach + 1e-12)
    moments = error[:, [0, 1, 2], [0, 1, 2]] / np.diag(reach)
    assert moments.max() > 0.98  # 1200 uniform draws
    assert abs(moments.mean() - 0.5) < 4 * 0.29 / np.sqrt(moments.size)


def test_impossible_inertia_is_drawn_again():
    """A flat plate: half of all draws with an error of 30 % break the triangle inequality."""
    plate, rng = np.diag([1.0, 1.0, 1.95]), np.random.default_rng(1)
    drawn = [draw_inertia(plate, 0.3, rng) for _ in range(300)]
    assert min(smallest_second_moment(J) for J in drawn) > 0


@pytest.mark.parametrize("up", [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (0.6, 0.0, -0.8), (0, 0, -1.0)])
def test_tilt_is_uniform_about_the_axis_that_points_up(testbed, up):
    up = np.array(up)
    start = {"attitude": None, "tilt": 0.2}
    q = np.array([p.attitude for p in drawn(testbed(up=up, truth=start))])
    tilts = tilt(q, up)
    assert 0.19 < tilts.max() <= 0.2 + 1e-12
    assert abs(tilts.mean() - 0.1) < 4 * 0.058 / np.sqrt(RUNS)
    # no direction of tilt and no heading is preferred: means of 400 vectors of length one
    leaning_N = (to_matrix(q) @ up)[:, :2] / np.sin(tilts)[:, None]
    level_axis = np.cross(up, [0.0, 1.0, 0.0] if abs(up[1]) < 0.9 else [1.0, 0.0, 0.0])
    heading_N = (to_matrix(q) @ level_axis)[:, :2]
    assert np.linalg.norm(leaning_N.mean(0)) < 4 / np.sqrt(RUNS)
    assert np.linalg.norm(heading_N.mean(0)) < 4 / np.sqrt(RUNS)


def test_rate_is_uniform_within_its_limit(testbed):
    rates = np.array([p.rate for p in drawn(testbed(truth={"rate": None, "rate_limit": 0.01}))])
    assert 0.0095 < np.abs(rates).max() <= 0.01
    assert np.all(np.abs(rates.mean(0)) < 4 * 0.01 / np.sqrt(3 * RUNS))


def test_what_is_given_does_not_change_the_rest(sputnix):
    com = np.array([0.0, 0.0, -1e-4])
    given = replace(sputnix, truth=replace(sputnix.truth, com=com, rate=np.zeros(3)))
    one, other = (draw_truth(t, np.random.default_rng(5)) for t in (sputnix, given))
    np.testing.assert_array_equal(one.attitude, other.attitude)
    np.testing.assert_allclose(one.body.inertia_C, other.body.inertia_C, atol=1e-15)


def test_without_a_truth_it_is_the_testbeds_own_body(testbed):
    plain = replace(testbed((0.0, 0.0, -1e-4)), truth=None)
    platforms = drawn(plain, 50)
    for platform in platforms:
        assert isinstance(platform.body, MassProperties)
        np.testing.assert_array_equal(platform.body.inertia_P, plain.body.inertia_P)
        np.testing.assert_array_equal(platform.body.com, plain.body.com)
    assert 0 < max(float(tilt(p.attitude, plain.up)) for p in platforms) < np.deg2rad(3.0)
