"""Inputs that were stated or reported: how they move an estimate, and what that adds to its sd."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.stored_momentum import with_known_inputs
from equipoise.estimation.output_error.fit_estimate import (
    conclude,
    end_rows,
    prior_shifts,
    reported_shifts,
    visibility_of,
)
from equipoise.estimation.output_error.input_errors import (
    STEP,
    cage_varied,
    devices_varied,
    input_shifts,
)
from equipoise.estimation.output_error.trajectory import METHOD, Params, fit
from equipoise.estimation.parameters.fit_parameters import JP, R
from equipoise.model.devices import CoilPair, Magnetorquer, ReactionWheel
from equipoise.model.estimate import BODY
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.recording import Recording, Samples
from tests.oracle import cases
from tests.support import thorough
from tests.support.builders import COM, INERTIA, move_at, noisy, platform, recording

SD = 0.02
AFTER = move_at(40.0, 120.0)


def fitted(testbed):
    """Return the fit of the shared record, its masses moved at 40 s."""
    record = noisy(recording(120.0, AFTER), 0)
    return record, fit(record, testbed, Params())


def weighed(testbed):
    """Return a testbed whose sliders were weighed to 2 %."""
    masses = tuple(replace(mass, mass_sd=SD) for mass in testbed.masses)
    return replace(testbed, masses=masses)


def shifts(testbed):
    """Return the shifts of J and com by input, (9,) each, relative to the values, and the fit."""
    record, found = fitted(testbed)
    values = np.concatenate([INERTIA, COM])
    moved = {s.name: np.append(s.shift[JP], s.shift[R]) / values for s in input_shifts(found)}
    return moved, record, found


def test_a_platform_heavier_than_stated_has_its_com_nearer_by_hand():
    """Known moments of the sliders fix m r and J; so r is less by as much as m is more."""
    moved, *_ = shifts(replace(platform(), mass_sd=SD))
    assert list(moved) == ["platform mass"]
    np.testing.assert_allclose(moved["platform mass"][[6, 8]], -SD, rtol=0.05)
    np.testing.assert_allclose(moved["platform mass"][:3], 0.0, atol=0.05 * SD)


def test_sliders_heavier_than_stated_make_everything_larger_by_hand():
    """All three, heavier by one sd, scale J and com by it; they are sought, and none is carried."""
    bed, values = platform(), np.concatenate([INERTIA, COM])
    _, found = fitted(weighed(bed))
    names, moved = prior_shifts(found, np.eye(found.problem.layout.size), visibility_of(found))
    assert set(names) == {f"mass {mass.name}" for mass in bed.masses}
    assert not input_shifts(found)
    body = moved.sum(axis=0)
    relative = np.append(body[JP], body[R]) / values
    np.testing.assert_allclose(relative[[0, 1, 2, 6, 8]], SD, rtol=0.05)


def test_sliders_that_contradict_each_other_are_weighed_by_the_motion():
    """One is 5 % heavier than stated, with 2 % known: its weight over the others' is found."""
    bed = weighed(platform())
    first, *rest = bed.masses
    record, found = fitted(replace(bed, masses=(replace(first, mass=first.mass / 1.05), *rest)))
    gains = conclude(found, METHOD, record).values([f"gain_{mass.name}" for mass in bed.masses])
    assert gains[0] - gains[1:].mean() == pytest.approx(0.05, rel=0.2)


def test_a_slider_that_stands_at_home_has_no_weight_to_seek():
    """And one that stands off home, all the record long, has."""
    bed = weighed(platform())
    for d, sought in ((0.0, False), (0.01, True)):
        record = replace(recording(60.0), masses=Samples(np.array([0.0, 60.0]), np.full((2, 3), d)))
        layout = fit(record, bed, Params()).problem.layout
        assert ("gain_x" in layout.errors) == sought


def test_a_fast_clock_scales_time_by_hand():
    """J w' = tau: where time is shorter by s, J is less by 2 s beside known moments; com stays."""
    bed = platform()
    moved, *_ = shifts(replace(bed, attitude=replace(bed.attitude, clock_sd=1e-3)))
    np.testing.assert_allclose(moved["clock"][:3], -2e-3, rtol=0.05)
    np.testing.assert_allclose(moved["clock"][[6, 8]], 0.0, atol=1e-4)


def test_a_gyro_row_at_the_very_time_of_a_move_stays_on_its_side_of_it():
    """The rate jumps when a mass sets off: a row that changed sides would count as a drift.

    The camera's clock alone moves the moments by some shares of its error, as in the test above.
    """
    bed = platform(gyro=True)
    bed = replace(bed, attitude=replace(bed.attitude, clock_sd=1e-3))
    record = noisy(recording(120.0, AFTER, gyro=20.0), 0)
    assert set(AFTER.t[1:4]) <= set(record.rate.t)
    found = fit(record, bed, Params())
    (clock,) = (each for each in input_shifts(found) if each.name == "clock")
    relative = np.abs(clock.shift[JP] / INERTIA)[:3]
    assert 0 < relative.max() < 5e-3


def test_masses_that_are_logged_in_steps_leave_com_at_home_open_by_hand():
    """One that stands aside by its accuracy has moved com so, but not where masses stand now."""
    masses = tuple(replace(m, resolution=2e-3, accuracy=6e-4) for m in platform().masses)
    bed = replace(platform(), masses=masses)
    steps = np.clip(np.arange(121) - 40, 0, 5)  # of 2 mm, one a second
    track = Samples(np.arange(121.0), np.tile(-2e-3 * steps[:, None], 3))
    found = fit(noisy(recording(120.0, track), 0), bed, Params())
    moved = {s.name: s.shift[R] for s in input_shifts(found)}
    assert list(moved) == [f"position of mass {mass.name}" for mass in masses]
    for mass in masses:
        shift = moved[f"position of mass {mass.name}"]
        by_hand = -mass.mass * mass.accuracy / bed.body.mass * mass.axis
        np.testing.assert_allclose(shift, by_hand, atol=0.02 * np.linalg.norm(by_hand))
    rows = np.vstack([np.zeros((1, found.problem.layout.size)), end_rows(found, None)[1]])
    _, at_end = reported_shifts(found, rows, None)
    np.testing.assert_allclose(at_end[:, -3:], 0.0, atol=0.02 * np.linalg.norm(by_hand))


def test_stronger_gravity_is_larger_inertia():
    """m g r is known by the sliders' moments as g is; rates are seen: J grows with g."""
    moved, *_ = shifts(replace(platform(), gravity_sd=SD))
    np.testing.assert_allclose(moved["gravity"][:3], SD, rtol=0.05)
    np.testing.assert_allclose(moved["gravity"][[6, 8]], 0.0, atol=0.05 * SD)


def with_wheel(record, size):
    """Return a record in which a wheel's speed changes by ``size`` (rad/s) from 30 to 50 s."""
    t = np.array([0.0, 30.0, 50.0, 120.0])
    speed = Samples(t, np.array([0.0, 0.0, size, size])[:, None])
    return replace(record, device_names=("wheel:z",), devices=speed)


def test_a_wheel_turns_its_momentum_with_its_mounting_and_scales_it_with_its_gain():
    """h along z: the gain changes h_z, the mounting h_x and h_y, each by one sd of it."""
    wheel = ReactionWheel("z", np.array([0.0, 0.0, 1.0]), 1e-3, 500.0, 0.1, gain_sd=SD,
                          mounting_sd=0.01)  # fmt: skip
    bed = replace(platform(), wheels=(wheel,))
    record = with_known_inputs(with_wheel(recording(120.0, AFTER), 100.0), bed)
    found = {}
    assert [varied.axis for varied in devices_varied(record, bed)] == ["", "x", "y", "z"]
    for varied in devices_varied(record, bed):
        off = (varied.recording.momentum.values - record.momentum.values)[-1] / STEP
        found.setdefault(varied.name, []).append(off)
    np.testing.assert_allclose(found["gain of z"], [[0.0, 0.0, 0.1 * SD]], atol=1e-12)
    wanted = [[0.0, -0.1 * 0.01, 0.0], [0.1 * 0.01, 0.0, 0.0], [0.0, 0.0, 0.0]]
    np.testing.assert_allclose(found["mounting of z"], wanted, atol=1e-12)


def test_a_cage_moves_the_torque_of_coils_by_what_it_is_off_by():
    """0.4 A m2 along z in 50 uT along x, at rest and level: 20 uN m about y.

    2 % of gain and 3 % of deviation, uniform: hypot(0.02, 0.03 / sqrt 3) of it; 0.01 rad of the
    axis about z gives -0.4 x 0.5 uT about x, about y a field along -z, which turns no coil z.
    Where a magnetometer measured the field, nothing of this counts.
    """
    pair = CoilPair("c", np.array([1.0, 0.0, 0.0]), 1e-4, 50e-6, 0.0, 0.02, 0.01, 0.03)
    coil = Magnetorquer("m", np.array([0.0, 0.0, 1.0]), 1.0)
    bed = replace(platform(), magnetorquers=(coil,), coil_pairs=(pair,))
    t = np.array([0.0, 10.0])
    level = Samples(t, np.tile([1.0, 0.0, 0.0, 0.0], (2, 1)))
    devices = Samples(t, np.tile([0.4, 50e-6], (2, 1)))
    record = Recording(level, device_names=bed.device_names, devices=devices)
    record = with_known_inputs(record, bed)
    found = {}
    for varied in cage_varied(record, bed):
        off = (varied.recording.torque.values - record.torque.values)[-1] / STEP
        found.setdefault(varied.name, []).append((varied.sd, off))
    sd = np.hypot(0.02, 0.03 / 3**0.5)
    assert found["gain of c"][0][0] == pytest.approx(sd)
    np.testing.assert_allclose(found["gain of c"][0][1], [0.0, 2e-5 * sd, 0.0], atol=1e-15)
    _, about_y, about_z = (off for _, off in found["mounting of c"])
    np.testing.assert_allclose(about_y, 0.0, atol=1e-15)
    np.testing.assert_allclose(about_z, [-2e-5 * 0.01, 0.0, 0.0], atol=1e-15)
    measured = replace(record, field=Samples(t, np.tile([50e-6, 0.0, 0.0], (2, 1))))
    assert not list(cage_varied(measured, bed))


def test_an_input_that_gives_most_of_a_variance_is_named():
    """Platform mass: com alone. With exact inputs nothing is named."""
    record, found = fitted(replace(platform(), mass_sd=SD))
    named = [r for r in conclude(found, METHOD, record).outcome.reasons
             if r.code is Why.INPUT_LIMITS]  # fmt: skip
    assert [reason.parameters[0] for reason in named] == ["platform mass"]
    assert "com_z" in named[0].parameters
    assert "inertia_P_xx" not in named[0].parameters
    record, found = fitted(platform())
    codes = {r.code for r in conclude(found, METHOD, record).outcome.reasons}
    assert Why.INPUT_LIMITS not in codes


def test_com_at_the_end_takes_both_ways_of_an_input():
    """All masses heavier by s: com is larger by s, and so is what they add to it as they stand."""
    _, found = fitted(weighed(platform()))
    end, rows = end_rows(found, None)
    names, moved = prior_shifts(found, rows, visibility_of(found))
    assert len(names) == 3
    np.testing.assert_allclose(moved.sum(axis=0)[[0, 2]], SD * end[[0, 2]], rtol=0.05)


def off_in_sd(seed):
    """Return the errors in sd of J and com where every input is wrong within its sd, (9,)."""
    logged = cases.case_s(seed)
    bed, rng = logged.testbed, np.random.default_rng([seed, 35])
    stated = replace(
        bed,
        body=replace(bed.body, mass=bed.body.mass * (1 + SD * rng.normal())),
        mass_sd=SD,
        masses=tuple(replace(mass, mass=mass.mass * (1 + SD * rng.normal()), mass_sd=SD)
                     for mass in bed.masses),
        gravity=bed.gravity * (1 + 0.1 * SD * rng.normal()),
        gravity_sd=0.1 * SD,
    )  # fmt: skip
    found = conclude(fit(logged.recording, stated, Params()), METHOD, logged.recording)
    J = logged.truth.inertia_P[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    truth = np.concatenate([J, logged.truth.com])
    return (found.values(BODY) - truth) / np.sqrt(np.diag(found.covariance_of(BODY)))


def test_intervals_hold_where_every_input_is_wrong_within_its_sd():
    """MuJoCo, masses 2 % off: the errors are of one sd, as they are not by the record alone."""
    off = np.array([off_in_sd(seed) for seed in range(thorough.count(40, 5))])
    square = np.mean(off**2)
    assert 0.4 < square < 1.0 + 3.0 * np.sqrt(2.0 / (3 * len(off)))
    assert np.mean(np.abs(off) < 1.96) > 0.9


def test_ratios_of_an_open_scale_count_the_platform_mass_by_hand():
    """com / J is m g r / J over m g: known no better than the platform's mass, to 2 %."""
    record = noisy(recording(120.0), 0)
    sds = []
    for testbed in (platform(), replace(platform(), mass_sd=SD)):
        found = conclude(fit(record, testbed, Params()), METHOD, record)
        (ratio,) = [r for r in found.ratios if r.name.startswith("com_z/")]
        sds.append(ratio.sd / abs(ratio.value))
    assert np.sqrt(sds[1] ** 2 - sds[0] ** 2) == pytest.approx(SD, rel=0.05)
