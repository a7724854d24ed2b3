"""Composite adaptation: its identities, its Lyapunov function, and what its rows say."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements import parameter_adaptation as adaptation
from equipoise.control.elements.attitude_pid import Reference, error_of
from equipoise.control.law import Sample
from equipoise.maths.attitude import exponential, multiply, to_matrix
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import Gyro
from tests.support.plain_loop import GRAVITY, MASS, platform

TRUE_J = np.array([[0.30, 0.004, -0.006], [0.004, 0.28, 0.005], [-0.006, 0.005, 0.45]])
TRUE_R = np.array([20e-6, -30e-6, -60e-6])
TRUE = np.concatenate([pack_symmetric(TRUE_J), TRUE_R])


def bed(inertia=TRUE_J, com=TRUE_R):
    """The platform as stated; a quiet gyro."""
    made = replace(platform(com_sd=30e-6), gyro=Gyro(100.0, 1e-6, 0.0), inertia_sd=0.05)
    return replace(made, body=MassProperties(MASS, com, inertia))


def sampled(t, q, w, momentum, shift):
    gravity = -GRAVITY * to_matrix(q)[2]
    none = np.zeros(3)
    return Sample(t, q, w, gravity, shift, momentum, none, none, None)


def state(rng):
    q = exponential(rng.normal(0, 0.3, 3))
    w, h, s = rng.normal(0, 0.1, 3), rng.normal(0, 0.02, 3), rng.normal(0, 3e-5, 3)
    return sampled(0.0, q, w, h, s)


def reference(rng):
    return Reference(
        exponential(rng.normal(0, 0.3, 3)), rng.normal(0, 0.1, 3), rng.normal(0, 0.1, 3)
    )


def acceleration(sample, u):
    """Euler's equation, as it is."""
    w, moment = sample.rate, MASS * (TRUE_R + sample.shift)
    torque = -np.cross(w, TRUE_J @ w + sample.momentum) + u + np.cross(moment, sample.gravity)
    return np.linalg.solve(TRUE_J, torque)


@pytest.mark.parametrize("seed", range(4))
def test_the_rows_of_the_track_are_the_torque_that_it_takes(seed):
    """Y p = J w_r' + w_r x J w - m r x g, by a body's own numbers."""
    rng = np.random.default_rng(seed)
    sample, slope, w_r = state(rng), rng.normal(size=3), rng.normal(size=3)
    Y = adaptation.tracking_rows(sample, w_r, slope, MASS)
    wanted = TRUE_J @ slope + np.cross(w_r, TRUE_J @ sample.rate)
    wanted -= np.cross(MASS * TRUE_R, sample.gravity)
    np.testing.assert_allclose(Y @ TRUE, wanted, rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("seed", range(4))
def test_with_the_true_parameters_sigma_decays_whatever_the_motion(seed):
    """J sigma' = (J w) x sigma - K sigma, sigma' by differences of the real motion."""
    rng = np.random.default_rng(seed)
    testbed, sample, track = bed(), state(rng), reference(rng)
    known = adaptation.constants_of(testbed)
    now = adaptation.opened(testbed, sample)
    _, u = adaptation.adapted(now, sample, track, known)
    sigma, _, slope = adaptation.sigma_of(sample, track)
    change = acceleration(sample, u) - slope
    wanted = np.cross(TRUE_J @ sample.rate, sigma) - known.gain @ sigma
    np.testing.assert_allclose(TRUE_J @ change, wanted, rtol=1e-9, atol=1e-12)


def test_what_is_left_to_turn_shrinks_by_its_own_rate():
    """w_r leads q to the reference: standing, half the error is left after ln 2 / LAM s."""
    goal = Reference(exponential(np.array([0.1, -0.05, 0.02])), np.zeros(3), np.zeros(3))
    q, dt = np.array([1.0, 0, 0, 0]), 0.01
    first = np.linalg.norm(error_of(q, goal.q))
    for _ in range(round(np.log(2) / adaptation.LAM / dt)):
        _, w_r, _ = adaptation.sigma_of(sampled(0, q, np.zeros(3), np.zeros(3), np.zeros(3)), goal)
        q = multiply(q, exponential(dt * w_r))
    assert np.linalg.norm(error_of(q, goal.q)) == pytest.approx(first / 2, rel=0.01)


def track_at(t):
    """A smooth tumbling reference, its rate by differences."""

    def q(s):
        turn = np.array([0.3 * np.sin(0.2 * s), 0.3 * np.cos(0.17 * s), 0.4 * np.sin(0.11 * s)])
        return exponential(turn)

    def rate(s):
        h = 1e-4
        R0, R1 = to_matrix(q(s - h)), to_matrix(q(s + h))
        W = R0.T @ (R1 - R0) / (2 * h)
        return np.array([W[2, 1] - W[1, 2], W[0, 2] - W[2, 0], W[1, 0] - W[0, 1]]) / 2

    h = 1e-3
    return Reference(q(t), rate(t), (rate(t + h) - rate(t - h)) / (2 * h))


def tracked(testbed, seconds, dt=0.02, shift=None):
    """The loop with an ideal body: samples, adaptations and sigmas."""
    known = adaptation.constants_of(testbed)
    q, w, h = track_at(0.0).q, track_at(0.0).rate, np.zeros(3)
    now, rows = None, []
    for k in range(round(seconds / dt)):
        s = np.zeros(3) if shift is None else shift(k * dt)
        sample = sampled(k * dt, q, w, h, s)
        now = adaptation.opened(testbed, sample) if now is None else now
        now, u = adaptation.adapted(now, sample, track_at(k * dt), known)
        rows.append((sample, now, adaptation.sigma_of(sample, track_at(k * dt))[0]))
        for _ in range(4):  # the torque is held, h takes it up
            part = dt / 4
            middle = sampled(0.0, multiply(q, exponential(part / 2 * w)), w, h, s)
            half = w + part / 2 * acceleration(middle, u)
            middle = sampled(0.0, middle.q, half, h - part / 2 * u, s)
            w, q = w + part * acceleration(middle, u), multiply(q, exponential(part * half))
            h = h - part * u
    return rows


def wrong():
    """Stated 5 % and 10 to 30 um off."""
    factor = np.array([1.05, 0.96, 1.04])
    return bed(TRUE_J * np.sqrt(np.outer(factor, factor)), TRUE_R + [10e-6, -20e-6, 30e-6])


def test_momentum_in_laboratory_axes_is_linear_in_the_parameters_while_masses_travel():
    """F p = f for the true p, to what the loop's steps make of it, and for no other."""
    rows = tracked(bed(), 12.0, shift=lambda t: 2e-5 * np.array([np.sin(t), np.cos(t), 0.3 * t]))
    samples, last = [row[0] for row in rows], rows[-1][1]
    raw = adaptation.columns(last.whole, samples[-1]) - last.low
    F, f = raw[:, :9], raw[:, 9]
    size = np.linalg.norm(f)
    assert np.linalg.norm(F @ TRUE - f) < 1e-3 * size
    assert np.linalg.norm(F @ (TRUE * 1.01) - f) > 5e-3 * size


def test_parameters_and_track_converge():
    """A minute and a half of tumbling: J to 0.1 %, r to 0.1 um, of 5 % and 30 um."""
    rows = tracked(wrong(), 90.0, dt=0.05)
    last, sigma = rows[-1][1], rows[-1][2]
    np.testing.assert_allclose(unpack_symmetric(last.p[:6]), TRUE_J, atol=1e-3 * 0.45)
    np.testing.assert_allclose(last.p[6:], TRUE_R, atol=1e-7)
    assert np.linalg.norm(sigma) < 3e-4  # rad/s


def test_its_lyapunov_function_never_grows():
    """V = sigma J sigma / 2 + (p^ - p) P^-1 (p^ - p) / (2 gamma), to the step's rounding."""
    testbed = wrong()
    gamma = adaptation.constants_of(testbed).coupling
    values = []
    for _, now, sigma in tracked(testbed, 10.0, dt=0.02):
        error = now.p - TRUE
        values.append(
            sigma @ TRUE_J @ sigma / 2 + error @ np.linalg.solve(now.P, error) / (2 * gamma)
        )
    values = np.array(values)
    assert np.diff(values).max() < 2e-3 * values[0]
    assert values[-1] < 0.5 * values[0]


def test_the_track_alone_adapts_too():
    """Without momentum's rows, gradient adaptation: V falls as -sigma K sigma, and r comes near."""
    testbed = wrong()
    known = adaptation.constants_of(testbed)._replace(variance=1e9)
    sample = state(np.random.default_rng(7))
    now = adaptation.opened(testbed, sample)
    track = reference(np.random.default_rng(8))
    dt = 1e-4
    later = replace(sample, t=dt)
    after, u = adaptation.adapted(now, later, track, known)
    sigma, _, slope = adaptation.sigma_of(later, track)
    gain = known.coupling
    slope_p = (after.p - now.p) / dt
    error = now.p - TRUE
    by_error = error @ np.linalg.solve(now.P, slope_p) / gain
    by_sigma = sigma @ TRUE_J @ (acceleration(later, u) - slope)
    assert by_error + by_sigma == pytest.approx(-sigma @ known.gain @ sigma, rel=1e-3)
