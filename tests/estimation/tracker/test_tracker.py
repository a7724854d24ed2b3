"""The tracker ends where the fit ends, and follows or finds what the masses do."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error import trajectory
from equipoise.estimation.tracker.tracker import Params, first_state, track
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.estimate import END, INERTIA
from equipoise.model.recording import window
from tests.support.builders import COM, MASS, level, move_at, noisy, platform, recording

SHIFT = np.array([-10e-3, -10e-3, -50e-3]) * 0.0156 / MASS  # m, what the move does
both_sensors = pytest.mark.parametrize("gyro", [0.0, 20.0], ids=["camera", "camera and gyro"])


def bed(gyro: float):
    return platform(accuracy=1e-4, gyro=gyro > 0)


@cache
def observed(gyro: float, seed: int = 3):
    return noisy(recording(120.0, move_at(60.0, 120.0), 5.0, gyro), seed)


def tracked(gyro: float, params: Params, record=None):
    record = observed(gyro) if record is None else record
    return track(record, bed(gyro), params, start(gyro))


def start(gyro: float):
    return first_state(0.0, observed(gyro).attitude.values[0], bed(gyro))


@both_sensors
def test_with_the_inertia_known_it_ends_where_the_fit_ends(gyro):
    """Centre of mass within one combined sd of the whole-record fit, on every axis."""
    known = replace(bed(gyro), inertia_sd=1e-6)
    fit = reference_fit.estimate(observed(gyro), known, trajectory.Params(use_prior=True))
    found = tracked(gyro, Params())
    sd = np.sqrt(np.diag(fit.covariance_of(COM_NAMES)))
    assert np.all(np.abs(found.com[-1] - fit.com) < np.hypot(sd, found.com_sd[-1]))


def wrong(gyro: float):
    """The platform described with moments 2 % and products 1 % of a moment off."""
    body = bed(gyro).body
    off = np.diag([0.02, -0.02, 0.02]) * body.inertia_P
    estimated = body.inertia_P + off + 0.01 * body.inertia_P[0, 0] * (1 - np.eye(3))
    return replace(bed(gyro), body=replace(body, inertia_P=estimated), inertia_sd=0.02)


@both_sensors
def test_with_the_inertia_to_be_learnt_it_ends_where_the_fit_ends(gyro):
    """From the same prior: within one sd of the whole-record fit, and as sure of it to 15 %.

    Where the masses stopped is part of the tracker's centre of mass, so the fit's last one counts.
    The tracker takes the camera's vertical for gravity's, so the fit assumes the same.
    """
    fit = reference_fit.estimate(
        observed(gyro), level(wrong(gyro)), trajectory.Params(use_prior=True)
    )
    first = first_state(0.0, observed(gyro).attitude.values[0], wrong(gyro))
    found = track(observed(gyro), wrong(gyro), Params(com_walk=1e-10, torque_walk=1e-10), first)
    sd = np.sqrt(np.diag(fit.covariance_of((*END, *INERTIA))))
    ends = np.concatenate([found.com[-1] + SHIFT, found.inertia[-1]])
    assert np.all(np.abs(ends - fit.values((*END, *INERTIA))) < sd)
    np.testing.assert_allclose(found.sd[-1, 6:15], sd, rtol=0.15)


@both_sensors
@pytest.mark.parametrize("cut", [47.03, 62.0])
def test_in_parts_it_is_the_same(gyro, cut):
    """Called again from where it ended, in the middle of a travel too: to 1e-9 of a metre."""
    assert_same_in_parts(gyro, cut, cut)


@both_sensors
def test_in_parts_a_stop_at_the_cut_is_not_lost(gyro):
    """The third mass stops at 65 s: only a part that begins earlier shows that it travelled."""
    assert_same_in_parts(gyro, 65.0, 64.0)


def assert_same_in_parts(gyro: float, cut: float, since: float):
    whole = tracked(gyro, Params())
    first = tracked(gyro, Params(), window(observed(gyro), 0.0, cut))
    rest = track(window(observed(gyro), since, 120.0), bed(gyro), Params(), first.end)
    np.testing.assert_array_equal(np.append(first.t, rest.t), whole.t)
    np.testing.assert_allclose(np.vstack([first.com, rest.com]), whole.com, rtol=0, atol=1e-9)
    np.testing.assert_allclose(np.vstack([first.sd, rest.sd]), whole.sd, rtol=1e-6)


@both_sensors
def test_a_fed_move_is_no_surprise(gyro):
    """Centre of mass (masses at home) within 4 sd after the move; where they stop adds to it."""
    found = tracked(gyro, Params())
    after = found.t > 65.5
    assert np.all(np.abs(found.com[after] - COM) < 4 * found.com_sd[after])
    assert found.surprise.mean() / 3 == pytest.approx(1.0, abs=4 * np.sqrt(2 / 3 / len(found.t)))
    before, later = (found.com_sd[np.searchsorted(found.t, t)] for t in (60.8, 61.2))
    assert np.all(later[:2] > before[:2])


@both_sensors
def test_an_unreported_move_is_found(gyro):
    """Allowed to wander by 3 um/sqrt(s), it ends within 3 sd of where the masses left it."""
    found = tracked(gyro, Params(moves="ignored", com_walk=3e-6))
    assert np.all(np.abs(found.com[-1] - COM - SHIFT) < 3 * found.com_sd[-1])
    assert np.all(np.abs(found.com[-1] - COM)[:2] > 5e-6)


def test_a_gyro_sharpens_the_rate():
    """0.1 mrad/s at 20 Hz beside 0.2 deg at 5 Hz: the rate is known at least twice as well."""
    camera, both = (tracked(gyro, Params()).rate_sd[-1] for gyro in (0.0, 20.0))
    assert np.all(both < 0.5 * camera)
