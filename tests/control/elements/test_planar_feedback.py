"""Tilt integrated by masses, swing damped by coils; good moments; scale."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.elements import planar_feedback as pf
from equipoise.control.plant.move_timing import Waiting, amplitudes, watched
from equipoise.control.plant.swing_estimates import Shown, combined, held
from equipoise.maths.attitude import exponential
from equipoise.model.command import Command
from tests.control.elements.test_momentum_balance import observed_at
from tests.support.plain_loop import GRAVITY, MASS, UP, Truth, begun, go, platform, sample

DEPTH = 100e-6
PLANT = pf.Plant(0.3, MASS * GRAVITY, 1e-3)
LOOP = pf.loop_for(PLANT, DEPTH)


def hanging(r):
    """Gravity in body axes where a centre of mass at r is at rest under the pivot."""
    return GRAVITY * r / np.linalg.norm(r)


def test_at_rest_the_masses_creep_to_where_it_is_level():
    """(r + s)_p' = -w_i (r + s)_p, with w_i = k_i / depth."""
    r = np.array([3e-6, -5e-6, -DEPTH])
    speed = pf.creep(hanging(r), UP, 0.0, LOOP)
    w_i = LOOP.integral / np.linalg.norm(r)
    assert speed == pytest.approx(-w_i * np.array([3e-6, -5e-6, 0.0]))


def test_gains_keep_the_integral_well_within_routh():
    """k_d lambda > J k_i, by 1.4 / 0.2 = 7."""
    assert LOOP.damping * DEPTH == pytest.approx(7 * PLANT.inertia * LOOP.integral)
    assert LOOP.swing == pytest.approx((MASS * GRAVITY * DEPTH / 0.3) ** 0.5)


def test_in_a_swing_the_integral_is_worth_half_of_what_coils_can_give():
    """At amplitude A the integral drives the swing by m g lambda A w_i / w_n."""
    weak = pf.loop_for(PLANT._replace(coils=2e-4), DEPTH)
    A = 0.2
    gain = np.linalg.norm(pf.creep(hanging(np.array([1e-5, 0, -DEPTH])), UP, A, weak))
    free = np.linalg.norm(pf.creep(hanging(np.array([1e-5, 0, -DEPTH])), UP, 0.0, weak))
    assert MASS * GRAVITY * DEPTH * A * 0.2 * gain / free == pytest.approx(0.5 * 2e-4)


def swung(coils, seconds=150.0):
    """A platform that leans and swings, under ideal coils; return tilts over time (rad)."""
    r = np.array([8e-6, -5e-6, -DEPTH])
    truth = Truth(r, tilt=np.array([0.12, 0.1, 0.3]), rate=np.zeros(3), camera_sd=1e-6, bias=0.0)
    course, rng = begun(replace(platform(), wheels=()), truth), np.random.default_rng(2)
    loop = pf.loop_for(PLANT._replace(coils=coils), DEPTH)
    shift, tilts = np.zeros(3), []
    for _ in range(round(seconds / 0.2)):
        observed = sample(course, 0.2, rng)
        across = pf.lean(observed.gravity, UP)
        swing = np.linalg.norm(observed.rate[:2]) / loop.swing
        shift = shift + 0.2 * pf.creep(observed.gravity, UP, swing, loop)
        u = pf.damping_torque(observed.rate, loop)
        h = course.now.h.copy()
        go(course, Command(shift=shift), 0.2, rng)
        # Ideal coils: their torque enters the momentum.
        course.now.y[4:7] += 0.2 * np.clip(u, -coils, coils)
        assert np.all(course.now.h == h)
        tilts.append(np.linalg.norm(across))
    return np.array(tilts), course


def test_it_levels_a_platform_and_stops_its_swing():
    tilts, course = swung(1e-2)
    assert tilts[0] > 0.15
    assert tilts[-50:].max() < 3e-3
    assert np.abs(course.com[:2]).max() < 0.4e-6


def test_it_does_not_drive_a_swing_that_is_too_large_for_its_coils():
    """0.2 mN m against 14 mN m / rad: half a degree of swing is all the integral may have."""
    tilts, _ = swung(2e-4)
    assert tilts[-100:].max() < tilts[:100].max()


def test_a_platform_let_go_from_level_is_levelled_when_it_is_back():
    """Swings of different periods about both axes: each is caught, what is left is below 10 %."""
    r, swing = np.array([8e-6, -8e-6, -DEPTH]), (MASS * GRAVITY * DEPTH / 0.3) ** 0.5
    truth = Truth(r, tilt=np.array([0.0, 0.0, 0.3]), rate=np.zeros(3), camera_sd=1e-6, bias=0.0)
    course, rng = begun(replace(platform(), wheels=()), truth), np.random.default_rng(2)
    waiting, shift = Waiting(np.array([-8e-6, 8e-6, 0.0]), swing), np.zeros(3)
    most, after = 0.0, []
    for _ in range(600):
        observed = sample(course, 0.2, rng)
        if not all(waiting.done):
            waiting, shift = watched(waiting, observed, UP, shift)
            most = max(most, np.linalg.norm(pf.lean(observed.gravity, UP)))
        else:
            after.append(np.linalg.norm(pf.lean(observed.gravity, UP)))
        go(course, Command(shift=shift), 0.2, rng)
    assert most > 0.15
    assert max(after) < 0.15 * most


def test_the_amplitude_about_level_does_not_change_along_a_small_swing():
    """The gyro's noise is 3 % of the smaller one."""
    truth = Truth(np.array([0, 0, -DEPTH]), inertia=np.diag([0.3, 0.3, 0.45]),
                  tilt=np.array([0.05, 0, 0]), rate=np.array([0.0, 0.004, 0.0]), camera_sd=1e-7,
                  bias=0.0)  # fmt: skip
    course, rng = begun(replace(platform(), wheels=()), truth), np.random.default_rng(2)
    swing, found = (MASS * GRAVITY * DEPTH / 0.3) ** 0.5, []
    for _ in range(300):
        found.append(amplitudes(sample(course, 0.1, rng), UP, swing))
        go(course, Command(), 0.1, rng)
    found = np.array(found)
    assert found.std(axis=0) / found.mean(axis=0) == pytest.approx([0, 0], abs=0.1)


SHIFTS = [np.array([0, 0, -200e-6]), np.array([-3e-6, 1e-6, 10e-6]), np.array([9e-6, 2e-6, 0])]


def test_known_shifts_between_measurements_remove_the_scale_error_of_r():
    r, k = np.array([3e-6, -2e-6, -40e-6]), 1.07
    measurements = tuple(Shown(k * (r + s) - s, np.full(3, 1e-8), s) for s in SHIFTS)
    found = combined(measurements, UP, 0.05)
    assert found.com == pytest.approx(r, abs=2e-8)
    assert found.sd[2] < 2e-8


def test_imprecise_measurements_leave_the_scale_to_the_inertia_prior():
    """One measurement: its own estimate, and its sd includes that of the inertia, 5 % of 240 um."""
    measurement = Shown(np.array([0, 0, -40e-6]), np.full(3, 1e-6), SHIFTS[0])
    found = combined((measurement,), UP, 0.05)
    assert found.com == pytest.approx(measurement.com)
    assert found.sd == pytest.approx([1e-6, 1e-6, np.hypot(1e-6, 0.05 * 240e-6)])


def test_the_error_of_the_measured_height_is_consistent_with_its_sd():
    """Over 400 draws of measurement errors and of k, the error in its sd is 1."""
    rng, r, errors = np.random.default_rng(3), np.array([0, 0, -40e-6]), []
    sds = [5e-6, 2e-6, 1e-6]
    for _ in range(400):
        k = 1 + 0.05 * rng.normal()
        measurements = tuple(
            Shown(k * (r + s) - s + sd * rng.normal() * UP, np.full(3, sd), s)
            for s, sd in zip(SHIFTS, sds, strict=True)
        )
        found = combined(measurements, UP, 0.05)
        errors.append((found.com[2] - r[2]) / found.sd[2])
    assert np.std(errors) == pytest.approx(1.0, abs=0.12)


def test_measurements_fix_a_level_moment_unobservable_inertia_sag_and_drift():
    names = held(platform(disturbances=("sag_xx", "drift_x")))
    assert set(names) == {
        "inertia_P_xx", "inertia_P_zz", "inertia_P_xz", "inertia_P_yz", "sag_xx", "drift_x"
    }  # fmt: skip


def test_lean_is_the_vertical_across_up():
    q = exponential(np.array([0.1, 0.0, 0.0]))
    assert np.linalg.norm(pf.lean(observed_at(q).gravity, UP)) == pytest.approx(np.sin(0.1))
