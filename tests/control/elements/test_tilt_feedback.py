"""The printed adaptive law by masses: what it is, what it leaves, and where it is stable."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from equipoise.control.elements.tilt_feedback import (
    SPEED,
    Gains,
    followed,
    frequency_for,
    gains_at,
    owed,
    shift_for,
)
from equipoise.control.plant.offset_bounds import SAMPLED, likely_height, likely_offset
from equipoise.maths.attitude import exponential
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from tests.support.ideal_bench import (
    AT_REST,
    GRAVITY,
    INERTIA,
    MASS,
    UP,
    Bench,
    closed_loop,
    platform,
    rails,
    spring,
    tilts,
)

# The platform of the published simulations (da Silva, Chesi): kg, m/s^2, kg m^2, and its masses.
PUBLISHED = {"mass": 14.307, "gravity": 9.78, "inertia": np.diag([0.265, 0.246, 0.427])}
PRINTED_GAMMA = 1.3e-5  # s^2/kg, w_a = 1 rad/s rounded


class Params(NamedTuple):
    gains: Gains


class State(NamedTuple):
    held: np.ndarray
    gravity: np.ndarray


def printed(state, observed, params):
    """The first step alone, rh(0) = 0."""
    held = np.zeros(3)
    if state is not None:
        held = followed(params.gains, state.held, state.gravity, observed.gravity, wait=False)
    shift = shift_for(params.gains, held, observed.gravity, observed.rate)
    return State(held, observed.gravity), Command(shift=shift)


def run(com, gains, end, bench=None, first=AT_REST):
    """Rows of the printed law."""
    bench = Bench(platform(), com) if bench is None else replace(bench, com=com)
    bench = replace(bench, com=np.array(com), period=gains.period)
    return closed_loop(bench, printed, (None, Params(gains)), end, first)


def published_gains(frequency, period=0.05, **changes):
    """As in the copies: k_p = 0.5 N m s at 1 rad/s."""
    gains = gains_at(platform(**PUBLISHED), frequency, 0.0, period)
    return gains._replace(damping=0.5 * frequency, **changes)


def test_masses_give_the_requested_torque_across_gravity():
    """By hand: 14 kg, rh 10 um along x, level: the masses go 10 um the other way.

    Turning at 0.01 rad/s about x with k_p = 0.5 N m s: a torque of -5 mN m about x, from 36.4 um
    along y, as 14 * 9.81 * 36.4e-6 = 5e-3 and y x -z = -x.
    """
    gains = Gains(MASS, GRAVITY, UP, 1.0, 0.5, 0.0, 0.1)
    level = np.array([0.0, 0.0, -GRAVITY])
    here = shift_for(gains, np.array([1e-5, 0, 0]), level, np.zeros(3))
    np.testing.assert_allclose(here, [-1e-5, 0, 0], atol=1e-18)
    turning = shift_for(gains, np.zeros(3), level, np.array([0.01, 0.0, 0.3]))
    np.testing.assert_allclose(turning, [0, 3.6406e-5, 0], rtol=1e-4, atol=1e-18)
    np.testing.assert_allclose(MASS * np.cross(turning, level), [-5e-3, 0, 0], atol=1e-15)


def test_torque_of_any_attitude_is_the_laws_across_gravity():
    rng = np.random.default_rng(1)
    for _ in range(20):
        g = rng.normal(size=3)
        g *= GRAVITY / np.linalg.norm(g)
        held, rate = 1e-4 * rng.normal(size=3), 0.1 * rng.normal(size=3)
        gains = Gains(MASS, GRAVITY, UP, 1.0, 0.4, 0.0, 0.1)
        given = MASS * np.cross(shift_for(gains, held, g, rate), g)
        P = np.eye(3) - np.outer(g, g) / GRAVITY**2
        np.testing.assert_allclose(given, -MASS * np.cross(held, g) - 0.4 * P @ rate, atol=1e-14)


def test_the_estimate_is_a_static_function_of_attitude():
    """Phi^T w = m g_b', so rh(t) - rh(0) = gamma m (g_b(t) - g_b(0)), between samples, too."""
    gains = gains_at(platform(), 1.0, 0.0, 0.1)
    first = (exponential(np.array([0.1, -0.05, 0.3])), np.array([0.02, 0.05, 0.3]))
    rows = run([2e-4, 1e-4, -3e-4], gains, 20.0, first=first)
    turned = np.array([r.gravity - rows[0].gravity for r in rows[:-1]])
    held = np.array([r.state.held for r in rows[:-1]])
    assert np.abs(held).max() > 1e-4
    np.testing.assert_allclose(held, gains.gamma * MASS * turned, atol=1e-15)


def test_its_slope_is_the_printed_one():
    """rh' = gamma Phi^T w with Phi = -m [g_b x]: to first order in a short step."""
    gains = gains_at(platform(), 1.0, 0.0, 1e-4)
    rows = run([2e-4, 1e-4, -3e-4], gains, 3e-4, first=(AT_REST[0], np.array([0.1, -0.2, 0.3])))
    a, b = rows[0], rows[1]
    middle_g, middle_w = (a.gravity + b.gravity) / 2, (a.rate + b.rate) / 2
    phi = -MASS * np.cross(middle_g, np.eye(3)).T  # Phi v = -m g x v
    slope = (b.state.held - a.state.held) / 1e-4
    np.testing.assert_allclose(slope, gains.gamma * phi.T @ middle_w, rtol=1e-4, atol=1e-9)


def energy(rows, com, gains):
    """V = w J w / 2 + |r - rh|^2 / (2 gamma), and k_p |w_p|^2."""
    w, g = np.array([r.rate for r in rows]), np.array([r.gravity for r in rows])
    held = np.array([r.state.held for r in rows])
    V = 0.5 * np.einsum("ni,ij,nj->n", w, INERTIA, w)
    V += np.sum((com - held) ** 2, axis=1) / (2 * gains.gamma)
    along = np.sum(w * g, axis=1, keepdims=True) * g / GRAVITY**2
    return V, gains.damping * np.sum((w - along) ** 2, axis=1)


def test_energy_falls_as_printed():
    """V' = -k_p |w_p|^2: here V after 6 s less what the damping took, to what 4 ms make of it."""
    gains, com = gains_at(platform(), 1.0, 0.0, 4e-3), np.array([3e-4, 2e-4, -5e-4])
    rows = run(com, gains, 6.0, first=(AT_REST[0], np.array([0.05, -0.1, 0.02])))[:-1]
    V, taken = energy(rows, com, gains)
    spent = np.concatenate([[0.0], np.cumsum((taken[1:] + taken[:-1]) / 2 * 4e-3)])
    np.testing.assert_allclose(V + spent, V[0], rtol=1e-2)
    assert spent[-1] > 0.1 * V[0]
    assert np.all(np.diff(V) < 1e-9 * V[0])


@pytest.mark.parametrize(
    ("com_mm", "predicted_um", "simulated_um"),
    [((-0.1, -0.2, -0.5), 48.2, 48.99), ((-0.01, -0.02, -0.05), 0.598, 0.595)],
)
def test_the_printed_law_leaves_what_was_published(com_mm, predicted_um, simulated_um):
    """|r - rh| across up after the run, beside the formula to first order.

    The masses lie across gravity and not across up, so that the centre of mass itself is left at
    |r.n| sin(tilt), 2 % more than |r - rh| in the first case.
    """
    bench = Bench(platform(**PUBLISHED), np.zeros(3))
    gains, com = published_gains(1.0, gamma=PRINTED_GAMMA), 1e-3 * np.array(com_mm)
    rows = run(com, gains, 30.0, bench)
    across = np.hypot(*(com - rows[-2].state.held)[:2])
    assert 1e6 * across == pytest.approx(simulated_um, rel=0.01)
    predicted = np.hypot(*com[:2]) * abs(com[2]) / (abs(com[2]) + spring(gains))
    assert 1e6 * predicted == pytest.approx(predicted_um, rel=1e-3)
    down = com + np.array([0, 0, -spring(gains)])
    n = down / np.linalg.norm(down)
    left = np.hypot(*(rows[-2].shift + com)[:2])
    assert left == pytest.approx(abs(com @ n) * np.hypot(*n[:2]), rel=1e-3)


def test_with_the_printed_gain_it_diverges_at_20_hertz():
    """gamma = 1 s^2/kg is 280 rad/s; in physical units, 1 rad/s, the same platform settles."""
    bench = Bench(platform(**PUBLISHED), np.zeros(3))
    assert 14.307 * 9.78 / np.sqrt(0.2555) == pytest.approx(277, rel=1e-2)
    com = [-1e-5, -2e-5, -5e-5]
    printed_rows = run(com, published_gains(1.0, gamma=1.0), 20.0, bench)
    assert tilts(printed_rows)[-100:].max() > np.radians(30)
    rows = run(com, published_gains(1.0), 20.0, bench)
    assert tilts(rows).max() < np.radians(1)
    assert np.ptp(tilts(rows)[-100:]) < 1e-5


def test_with_the_printed_gain_it_diverges_with_slow_masses():
    """At 500 Hz, and damped as 280 rad/s should be, masses at once would do; 1 mm/s do not."""
    masses, com = rails(mass=0.7, speed=1e-3, travel=1.0), [-1e-5, -2e-5, -5e-5]
    bench = Bench(platform(masses=masses, **PUBLISHED), np.zeros(3), instant=False)
    gains = gains_at(bench.testbed, 277.0, 0.0, 2e-3)
    assert gains.gamma == pytest.approx(1.0, rel=0.01)
    rows = run(com, gains, 5.0, bench)
    assert tilts(rows)[-1] > np.radians(2)
    quick = run(com, gains, 2.0, replace(bench, instant=True))
    assert tilts(quick).max() < np.radians(0.02)


@pytest.mark.parametrize(
    ("speed_mm_s", "frequency", "holds"), [(1.0, 1.0, False), (10.0, 1.0, True), (1.0, 0.3, True)]
)
def test_slow_masses_and_a_large_offset_need_a_slow_loop(speed_mm_s, frequency, holds):
    """r = (-0.1, -0.2, -0.5) mm, masses of 0.7 kg: w_a |r| / v is 4.6, 0.46 and 1.4.

    The first case reaches 85 degrees, and does not settle.
    """
    masses = rails(mass=0.7, speed=1e-3 * speed_mm_s, travel=1.0)
    bench = Bench(platform(masses=masses, **PUBLISHED), np.zeros(3), instant=False)
    rows = run([-1e-4, -2e-4, -5e-4], published_gains(frequency), 60.0, bench)
    if holds:
        assert tilts(rows).max() < np.radians(30)
        assert np.ptp(tilts(rows)[-200:]) < 1e-3
    else:
        assert tilts(rows).max() > np.radians(80)
        assert np.ptp(tilts(rows)[-200:]) > np.radians(30)


@pytest.mark.parametrize(("ratio", "holds"), [(2 * SPEED, True), (2.5, False)])
def test_masses_keep_up_with_the_loop_up_to_the_required_speed_limit(ratio, holds):
    """w_a |r| / v: at twice the limit the swing is that of masses at once, at 2.5 it falls."""
    offset, swings = 1e-4, list[float]()
    for speed in (1.0, offset / ratio):
        masses = rails(speed=speed * MASS / 5.0, travel=1.0)
        bench = Bench(platform(masses=masses), np.zeros(3), instant=False)
        gains = gains_at(bench.testbed, 1.0, 0.0, 0.1)
        swings.append(tilts(run([offset, 0, -2e-5], gains, 30.0, bench)).max())
    assert (swings[1] < 1.05 * swings[0]) == holds
    assert (swings[1] > np.radians(45)) != holds


@pytest.mark.parametrize(("turn", "holds"), [(0.9, True), (1.1, False)])
def test_samples_are_fast_enough_up_to_one_over_zeta(turn, holds):
    """Jury's limit for a double integrator with the shift held between samples: w_a T < 1/zeta."""
    bench = Bench(platform(), np.zeros(3))
    gains = gains_at(bench.testbed, 1.0, 0.0, turn)
    rows = run([2e-5, 0, -1e-7], gains, 60.0, bench)
    swing = np.abs([r.rate[1] for r in rows])
    assert (swing[-5:].max() < 0.5 * swing.max()) == holds
    assert turn > SAMPLED


def test_a_beginning_counts_as_if_level():
    """The tilt at which the law begins does not matter to where it ends: nought here, level."""
    gains = gains_at(platform(), 1.0, 0.0, 0.1)
    tilted = np.array([1.5, 0.0, -np.sqrt(GRAVITY**2 - 1.5**2)])
    held = owed(gains, tilted)
    back = followed(gains, held, tilted, np.array([0, 0, -GRAVITY]), wait=False)
    np.testing.assert_allclose(back, 0, atol=1e-18)


def test_the_frequency_is_what_masses_samples_and_tilt_allow():
    """By hand: 28.3 um likely, masses of 20 um/s: 0.354 rad/s; the tilt limit asks for 0.179.

    least^2 = m g r / (J 0.8 limit) = 137.34 * 28.3e-6 / (0.29 * 0.419) = 0.032.
    """
    slow = platform(com_sd=1e-5, masses=rails(speed=2e-5 * MASS / 5.0))
    assert likely_offset(slow) == pytest.approx(2e-5 * np.sqrt(2))
    assert likely_height(slow) == pytest.approx(2e-5)
    assert frequency_for(slow, 0.1) == pytest.approx(0.5 / np.sqrt(2))
    assert frequency_for(slow, 1.0) == pytest.approx(SAMPLED)
    assert frequency_for(platform(com_sd=1e-5), 0.1) == 1.0


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"com_sd": 1e-4, "masses": rails(speed=2e-5)}, "um/s"),  # too slow for the tilt limit
        ({"com_sd": 3e-3}, "tilt limit"),  # too far off for any loop of 1 rad/s
        ({"com_sd": 1e-4, "masses": rails(travel=1e-5)}, "reach"),
        ({"com_sd": 1e-5, "com": (0.0, 0.0, 2e-3)}, "faster than"),  # stands on its head
    ],
)
def test_what_cannot_be_stable_is_refused(changes, named):
    with pytest.raises(InputError, match=named):
        frequency_for(platform(**changes), 0.1)
