"""Platforms without a camera, by MuJoCo: are com and inertia within their intervals?

A gyro and an accelerometer; a sun sensor beside them; a magnetometer. Masses move on the way.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from equipoise.estimation.model_selection import reference_fit
from equipoise.estimation.output_error.trajectory import Params, fit
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.estimate import COM, INERTIA
from tests.oracle.vector_records import KITS, case
from tests.support import thorough
from verification import vector_sensors

NAMES = COM + INERTIA
SEEDS = range(thorough.count(0, 1), thorough.count(20, 2))
WIDEST = 4.0  # sd: one of 15 000 numbers


@cache
def recorded(seed, kit):
    return case(seed, KITS[kit])


@cache
def estimated(seed, kit):
    _, record, bed, _ = recorded(seed, kit)
    return reference_fit.estimate(record, bed, Params())


def errors_in_sd(seed, kit):
    """Return by how many sd com and inertia are off."""
    platform, found = recorded(seed, kit).platform, estimated(seed, kit)
    sd = np.array([found.parameters[found.index(name)].sd for name in NAMES])
    true = np.concatenate([platform.com, pack_symmetric(platform.inertia_P)])
    assert found.outcome.usable
    return (found.values(NAMES) - true) / sd


@pytest.mark.parametrize("kit", KITS)
def test_com_and_inertia_are_within_their_intervals(kit):
    """Each within 4 sd; all together as chance has it: the mean square of 9 n numbers near 1."""
    off = np.array([errors_in_sd(seed, kit) for seed in SEEDS])
    assert np.abs(off).max() < WIDEST
    spread = 4.0 * np.sqrt(2 / off.size) * 2.0  # those of one record hang together
    assert np.mean(off**2) < 1 + spread
    assert np.mean(off**2) > 1 - min(spread, 0.8)


def test_errors_are_at_the_bound_and_as_large_as_stated():
    """Of an IMU of a cheap chip, and of the sensors of Lee et al."""
    assert not vector_sensors.measure(range(thorough.count(6, 1))).missed


def test_each_further_sensor_tightens_the_estimate():
    """A lamp beside gravity shows the heading: com is known better, and so is its bias."""
    sd = {}
    for kit in KITS:
        _, record, bed, _ = recorded(1, kit)
        normal = fit(record, bed, Params()).at.normal
        sd[kit] = np.sqrt(np.diag(np.linalg.inv(normal)))[12:15]
    assert (sd["sun"] < 1.001 * sd["imu"]).all()
    assert (sd["compass"] < 1.001 * sd["imu"]).all()


@pytest.mark.parametrize("share", thorough.some([0.3, 3.0], 1))
def test_a_noise_that_is_wrongly_stated_is_found(share):
    """The estimate is that with the true noise, within a tenth of an sd, and as sure."""
    _, record, bed, _ = recorded(1, "imu")
    stated = replace(bed.accelerometer, noise=share * bed.accelerometer.noise)
    wrong = replace(bed, accelerometer=stated)
    right, found = estimated(1, "imu"), reference_fit.estimate(record, wrong, Params())
    sd, other = (
        np.array([each.parameters[each.index(name)].sd for name in NAMES])
        for each in (right, found)
    )
    np.testing.assert_allclose(found.values(NAMES) / sd, right.values(NAMES) / sd, rtol=0, atol=0.1)
    np.testing.assert_allclose(other, sd, rtol=0.1)
