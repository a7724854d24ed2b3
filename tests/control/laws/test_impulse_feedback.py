"""Impulse feedback: the account of momentum on true motion, the printed form, recovery."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.laws import impulse_feedback as law
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import skew
from equipoise.model.devices import JetPair
from equipoise.model.errors import InputError
from equipoise.model.units import UM
from tests.support.simple_loop import (
    CALM,
    GRAVITY,
    MASS,
    NOISE,
    OFFSET,
    UP,
    Loop,
    Plant,
    fly,
    guess,
    masses,
    table,
)

HELD = law.Window(0.0, np.zeros(3), MASS * 20 * GRAVITY * skew(UP), np.zeros(3))  # level, 20 s
TURN, RATE = [0.03, -0.02, 0.4], [0.004, -0.003, 0.005]  # 2 deg of tilt, 0.4 deg/s


def params_for(testbed, target=(0.0, 0.0, 0.0)):
    return law.begin(testbed, np.array(target))[1]


@pytest.mark.parametrize(("speed", "share"), [(1e-12, 2e-4), (1e-3, 2e-3)])
def test_the_account_balances_on_true_motion(speed, share):
    """A r = b for a platform that tumbles at 20 deg/s, is kicked by jets and whose masses travel.

    To the trapezium rule; with masses that travel, to the moments that they change.
    """
    truth = table(masses=masses(speed))
    params, rng = params_for(truth), np.random.default_rng(5)
    plant = Plant(truth, [0.3, -0.2, 1.0], [0.2, -0.1, 0.3])
    loop, zero = Loop(plant), np.zeros(3)
    observed = loop.sample(zero, zero)
    window = law.opened(observed, params)
    for _ in range(200):
        before = law.Before(observed.t, to_matrix(observed.q), observed.gravity, observed.shift)
        impulse = 3e-3 * rng.normal(size=3)
        plant.request(np.array([30e-6, 20e-6, -50e-6]))
        plant.y[4:] += impulse
        plant.go(0.02)
        # The impulse falls at the beginning of the step, so it is given there.
        window = window._replace(given=window.given + before.R @ impulse)
        observed = loop.sample(zero, zero)
        window = law.summed(window, before, observed, params)
    b = law.unbalance_impulse(window, observed, params)
    np.testing.assert_allclose(b, window.A @ OFFSET, atol=share * np.linalg.norm(window.A @ OFFSET))


def test_the_shift_is_the_printed_one_at_a_held_attitude():
    """s - k g x (Delta H - I) / (m g^2 T), with k = GAIN, at an attitude that does not move."""
    params, T = params_for(table()), 20.0
    g = to_matrix(np.array([np.cos(0.1), np.sin(0.1), 0.0, 0.0])).T @ [0.0, 0.0, -GRAVITY]
    r = np.array([60.0, -40.0, -150.0]) * UM
    spent = MASS * T * np.cross(r, g)  # Delta H - I, body axes
    window = law.Window(0.0, np.zeros(3), -MASS * T * skew(g), np.zeros(3))
    printed = -law.GAIN * np.cross(g, spent) / (MASS * GRAVITY**2 * T)
    np.testing.assert_allclose(law.fed_back(window, spent, np.zeros(3), params), printed)


def test_the_sign_by_hand():
    """Level, mass at +x: weight turns it about +y, jets spend minus that, masses go to -x."""
    params = params_for(table())
    weight = MASS * np.cross([1e-5, 0.0, 0.0], [0.0, 0.0, -GRAVITY])
    assert weight[1] > 0
    shift = law.fed_back(HELD, 20 * weight, np.zeros(3), params)
    np.testing.assert_allclose(shift, [-law.GAIN * 1e-5, 0.0, 0.0], atol=1e-18)


def test_what_is_along_gravity_is_left_alone():
    params = params_for(table())
    b = HELD.A @ np.array([1e-5, 0, 5e-4])
    assert law.fed_back(HELD, b, np.zeros(3), params)[2] == pytest.approx(0.0, abs=1e-15)


def test_the_schedule_shows_all_three_directions():
    """Level alone has no information upward; all together have more than sin^2 of the tilt."""
    information = [np.eye(3) - np.outer(v, v) for v in law.schedule(UP, 0.2)]
    assert np.linalg.eigvalsh(information[0])[0] == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.eigvalsh(sum(information))[0] > np.sin(0.2) ** 2


def flown(seed, noise=NOISE, truth=None, target=(0.0, 0.0, 0.0), begun=None):
    begun = law.begin(guess(), np.array(target)) if begun is None else begun
    plant = Plant(table() if truth is None else truth, TURN, RATE)
    return fly(law.LAW, begun, Loop(plant, noise, seed), 600)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_known_offset_is_removed_on_all_axes(seed):
    """From (60, -40, -150) um to 0.05 um sideways and 0.3 um upward, in six minutes."""
    run = flown(seed)
    assert run.finished
    np.testing.assert_array_less(np.abs(run.left), [0.05e-6, 0.05e-6, 0.3e-6])
    assert np.degrees(run.tilt.max()) < 15
    assert run.t[-1] < 360


def test_a_platform_that_stands_on_its_head_is_balanced():
    """100 um above P, which no law with masses alone can hold."""
    run = flown(1, truth=table(np.array([30e-6, 20e-6, 100e-6])))
    np.testing.assert_array_less(np.abs(run.left), [0.05e-6, 0.05e-6, 0.3e-6])


def test_a_target_that_is_not_the_centre_is_reached():
    target = np.array([4.0, 5.0, -60.0]) * UM
    left = flown(2, target=target).left - target
    np.testing.assert_array_less(np.abs(left), [0.05e-6, 0.05e-6, 0.3e-6])


def test_slow_masses_do_no_harm():
    """0.1 mm/s, which a law that levels by masses would not bear."""
    slow = {"masses": masses(0.1e-3)}
    begun = law.begin(replace(guess(), **slow), np.zeros(3))
    run = flown(3, truth=table(**slow), begun=begun)
    np.testing.assert_array_less(np.abs(run.left), [0.1e-6, 0.1e-6, 0.5e-6])


def test_a_steady_torque_is_taken_for_unbalance():
    """What it cannot separate: 1e-4 N m about x is 0.73 um along y, at one attitude."""
    params = params_for(table())
    shift = law.fed_back(HELD, np.array([20e-4, 0.0, 0.0]), np.zeros(3), params)
    assert abs(shift[1]) == pytest.approx(law.GAIN * 1e-4 / (MASS * GRAVITY))


def test_jets_fire_outside_their_band_only():
    params = params_for(table())
    plant = Plant(table(), [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    zero = np.zeros(3)
    assert law.impulse_for(Loop(plant).sample(zero, zero), UP, params) is None
    fast = Plant(table(), [0.0, 0.0, 0.0], [0.01, 0.0, 0.001])
    fired = law.impulse_for(Loop(fast, CALM).sample(zero, zero), UP, params)
    np.testing.assert_allclose(fired, [-0.01 * 0.30, 0.0, 0.0], atol=1e-12)


def test_jets_turn_the_platform_back():
    """Tilted about +x: the rate to be is about -x."""
    tilted = Plant(table(), [0.05, 0.0, 0.0], [0.0, 0.0, 0.0])
    zero = np.zeros(3)
    fired = law.impulse_for(Loop(tilted).sample(zero, zero), UP, params_for(table()))
    assert fired[0] < 0
    np.testing.assert_allclose(fired[1:], 0.0, atol=1e-9)


@pytest.mark.parametrize(("q", "stable"), [(0.5, True), (1.9, True), (2.1, False)])
def test_the_jets_loop_bears_an_inertia_wrong_by_a_factor_of_two(q, stable):
    """Impulse even over a step: rate + u, tilt + h rate + h u / 2, u = -q (rate + RETURN tilt)."""
    h, k = law.PERIOD, law.RETURN
    loop = np.array([[1 - q * k * h / 2, h * (1 - q / 2)], [-q * k, 1 - q]])
    assert bool(np.abs(np.linalg.eigvals(loop)).max() < 1) is stable


def test_weak_jets_are_refused():
    weak = tuple(JetPair(j.name, j.axis, 0.05) for j in table().jets)
    with pytest.raises(InputError, match="twice the weight"):
        law.begin(replace(guess(), jets=weak), np.zeros(3))


def test_coarse_jets_are_refused():
    coarse = tuple(JetPair(j.name, j.axis, 0.2, min_pulse=0.05) for j in table().jets)
    with pytest.raises(InputError, match="minimum pulses"):
        law.begin(replace(guess(), jets=coarse), np.zeros(3))
