"""L1 adaptive balancing: the condition by hand, the adaptation's limit, recovery, learning."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm, solve_continuous_lyapunov

from equipoise.control.elements.l1_norm import l1_norm
from equipoise.control.elements.loop_stability import radius
from equipoise.control.laws import l1_adaptive as law
from equipoise.control.plant.pendulum import rate_of, tilt_of, turned
from equipoise.model.errors import InputError
from equipoise.model.units import UM
from tests.support.simple_loop import NOISE, OFFSET, Loop, Plant, fly, guess, masses, table

TURN, RATE = [0.03, -0.02, 0.4], [0.004, -0.003, 0.005]  # 2 deg of tilt, 0.4 deg/s


# --- The condition ---------------------------------------------------------------------------


@pytest.mark.parametrize(("k", "w"), [(1.0, 2.0), (0.3, 5.0), (4.0, 1.0)])
def test_norm_of_a_first_order_loop_by_hand(k, w):
    """The impulse response of s / ((s + k)(s + w)) changes sign once: twice its integral there."""
    t = np.log(w / k) / (w - k)
    by_hand = 2 * (np.exp(-k * t) - np.exp(-w * t)) / (w - k)
    assert l1_norm(np.array([[-k]]), np.ones(1), w) == pytest.approx(by_hand, rel=1e-4)


def test_norm_of_an_oscillator_is_that_of_its_worse_output():
    """Against a plain sum over the impulse response of each output."""
    A, b, w = np.array([[0.0, 1.0], [-0.16, -0.56]]), np.array([0.0, 1.0]), 1.0
    t = np.linspace(0, 60, 60001)
    whole = np.block([[A, np.zeros((2, 2))], [np.eye(2), -w * np.eye(2)]])
    step, z, rows = expm(whole * t[1]), np.array([0.0, 1.0, 0.0, 0.0]), []
    for _ in t:
        rows.append(np.abs(z[:2] - w * z[2:]))
        z = step @ z
    assert l1_norm(A, b, w) == pytest.approx(np.sum(rows, axis=0).max() * t[1], rel=2e-3)


# --- Adaptation ------------------------------------------------------------------------------

W, H = 1.6, 0.25


def test_error_matrix_is_the_exponential():
    A_s = np.array([[0.0, 1.0], [-(W**2), -2 * W]])
    np.testing.assert_allclose(law.error_matrix(W, H), expm(A_s * H), atol=1e-14)


def test_the_weights_solve_lyapunovs_equation():
    A_s = np.array([[0.0, 1.0], [-(W**2), -2 * W]])
    P = solve_continuous_lyapunov(A_s.T, -np.diag([W**2, 1.0]))
    np.testing.assert_allclose(P @ [0, 1], [0.5, 0.5 / W], atol=1e-14)


def adapted_for(strength, steps=400):
    """The size of what is wrong after so many steps: e and n, plainly, step by step."""
    e, n = np.zeros(2), 1.0
    for _ in range(steps):
        e = law.error_matrix(W, H) @ e + np.array([H**2 / 2, H]) * n
        n = n - H * strength * (0.5 * e[0] + 0.5 / W * e[1])
    return abs(n)


def test_the_largest_adaptation_is_where_the_sampled_estimates_swing_up():
    limit = law.largest_adaptation(W, H)
    assert adapted_for(0.98 * limit) < 1
    assert adapted_for(1.02 * limit) > 1e3


def test_the_adaptation_keeps_its_bounds():
    """Projection: whatever the error, th_hat stays in its ball and s_hat in its range."""
    axis = law.begin(guess(), np.zeros(3))[1].axes[0]
    beyond = np.array([-1e3, -1e3])
    th, s = law.adapted(axis, beyond, np.array([0.3, 0.1]), np.zeros(2), 0.0)
    assert np.linalg.norm(th) == pytest.approx(axis.most)
    assert s == axis.furthest


def test_a_platform_that_lags_its_prediction_is_pushed():
    """x_hat ahead of x, so the matched disturbance is less than estimated."""
    axis = law.begin(guess(), np.zeros(3))[1].axes[0]
    _, s = law.adapted(axis, np.array([0.0, 1e-3]), np.zeros(2), np.zeros(2), 0.0)
    assert s == pytest.approx(-law.PERIOD * axis.predictor**2 * 0.5e-3)


# --- The loop --------------------------------------------------------------------------------


def flown(seed, duration=1200, truth=None, **kwargs):
    begun = law.begin(guess(), np.zeros(3))
    plant = Plant(table() if truth is None else truth, TURN, RATE)
    return fly(law.LAW, begun, Loop(plant, NOISE, seed), duration, **kwargs)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_known_offset_is_removed(seed):
    """From (60, -40, -150) um to 0.15 um sideways; upward to 5 % of the last depth, 10 um."""
    run = flown(seed)
    assert run.finished[0].code == "level_at_target"
    np.testing.assert_allclose(run.left[:2], 0.0, atol=0.15 * UM)
    assert abs(run.left[2]) < 0.6 * UM
    assert np.degrees(run.tilt.max()) < 30


def test_what_it_learns_is_the_unbalance_torque():
    """J s_hat is the torque of what hangs sideways, masses at home: 5.5 and 8.2 mN m, to 2 %."""
    run = flown(0, 100)
    _, params = law.begin(guess(), np.zeros(3))
    found = np.mean([s.s for s in run.states[240:]], axis=0) / params.plant.gain
    np.testing.assert_allclose(found, turned(params.plant, OFFSET), rtol=0.02)


def test_shift_that_masses_do_not_deliver_is_no_disturbance():
    """Masses that are stuck: what is learnt stays that of the platform, and does not wind up."""
    stuck = table(np.array([5e-6, -4e-6, -400e-6]), masses=masses(1e-12))
    begun = law.begin(table(np.array([0.0, 0.0, -400e-6])), np.zeros(3))
    run = fly(law.LAW, begun, Loop(Plant(stuck, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])), 200)
    found = np.mean([s.s for s in run.states[400:]], axis=0) / begun[1].plant.gain
    np.testing.assert_allclose(found, [4e-6, 5e-6], atol=0.6e-6)


def test_a_platform_that_swings_faster_than_its_prior_is_stable():
    """Moments a third smaller than guessed, and 60 um lower: twice the stiffness."""
    quick = table(OFFSET - [0, 0, 60e-6], np.diag([0.21, 0.19, 0.3]))
    run = flown(0, 90, quick)
    assert run.tilt[-40:].max() < 2e-3


def test_turning_over_by_yaw_is_that_of_the_true_platform():
    """Nothing hangs: what changes tilt beyond the rate, and the rate, is the spin alone."""
    true = Plant(table(np.zeros(3)), [0.02, -0.03, 0.0], [0.01, 0.02, 0.3])
    params = law.begin(table(), np.zeros(3))[1]
    loop, zero, rows = Loop(true), np.zeros(3), []
    for _ in range(3):
        observed = loop.sample(zero, zero)
        rows.append([tilt_of(params.plant, observed), rate_of(params.plant, observed)])
        true.go(0.01)
    before, now, after = np.array(rows).transpose(0, 2, 1)
    slope = (after - before) / 0.02 - np.column_stack([now[:, 1], np.zeros(2)])
    expected = law.turned_about_up(now, 0.3, params)
    np.testing.assert_allclose(slope, expected, atol=3e-5)
    assert np.abs(expected).min() > 1e-3


def test_the_swing_is_that_of_the_height_masses_have_reached():
    """Asked to hang at 386 um, 286 um of them by masses; they report 200 um: 300 um so far."""
    state, params = law.begin(guess(), np.zeros(3))
    observed = Loop(Plant(table(), TURN, RATE)).sample(np.zeros(3), np.zeros(3))
    observed = replace(observed, shift=np.array([0.0, 0.0, -200e-6]))
    found = law.frequencies(state, observed, params.plant) ** 2 / params.plant.gain
    np.testing.assert_allclose(found, 300e-6)


def test_a_platform_that_spins_is_balanced():
    """6 deg/s of yaw, as fast as the raised platform swings: tilt and rate turn over."""
    begun = law.begin(guess(), np.zeros(3))
    run = fly(law.LAW, begun, Loop(Plant(table(), TURN, [0.004, -0.003, 0.1]), NOISE, 0), 800)
    assert run.finished[0].code == "level_at_target"
    np.testing.assert_allclose(run.left[:2], 0.0, atol=0.15 * UM)


# --- What it refuses -------------------------------------------------------------------------


def test_sensors_that_are_too_late_are_refused():
    late = replace(guess(), gyro=replace(guess().gyro, delay=1.5))
    with pytest.raises(InputError, match="unstable loop"):
        law.begin(late, np.zeros(3))


def test_mass_properties_too_vague_are_refused():
    """The L1 condition: inertia known to a factor of several only."""
    with pytest.raises(InputError, match="L1 condition"):
        law.begin(replace(guess(), inertia_sd=5.0), np.zeros(3))


def test_a_swing_too_fast_for_the_period_is_refused():
    """40 mm deep, 17 rad/s of predictor: beyond the largest adaptation."""
    deep = table(np.array([0.0, 0.0, -40e-3]))
    with pytest.raises(InputError, match="adaptation too fast"):
        law.begin(deep, np.zeros(3))


def test_the_sampled_loop_turns_unstable_with_delay():
    axis = law.begin(guess(), np.zeros(3))[1].axes[0]
    assert radius(law.closed(axis, axis.wanted, 1)) < 1
    assert radius(law.closed(axis, axis.wanted, 12)) > 1
