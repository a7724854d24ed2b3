"""The torque on a platform: the published floor of noise, and nothing where nothing acts."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.regression.formulations.energy import energy
from equipoise.estimation.regression.formulations.torque import savitzky_golay, torque
from equipoise.estimation.regression.inverse_dynamics_torque import residual_torque
from equipoise.estimation.regression.linear_method import posed_of
from equipoise.estimation.regression.monte_carlo_replicates import Drawn, pairs
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.support.builders import INERTIA, platform

DENSITY = 1e-4  # rad/s/sqrt(Hz)
RATE = 50.0


def at_rest(seed):
    """A platform that stands level for two minutes, its gyro noisy, its camera nearly perfect."""
    noise = DENSITY * RATE**0.5
    bed = replace(
        platform(), attitude=AttitudeSensor(5.0, 1e-7, plumb_sd=0.0), gyro=Gyro(RATE, noise, 1e-9)
    )
    t, rng = np.arange(0.0, 120.0, 1 / RATE), np.random.default_rng(seed)
    q = np.tile([1.0, 0, 0, 0], (601, 1))
    record = Recording(
        Samples(np.arange(601) * 0.2, q), Samples(t, noise * rng.normal(size=(len(t), 3)))
    )
    return posed_of(record, replace(bed, masses=()), Options())


def observed(seconds):
    posed = at_rest(1)
    draws = tuple(pairs(posed, Drawn(), 8))
    return residual_torque(torque(partial(savitzky_golay, seconds=seconds)), posed, draws)


@pytest.mark.parametrize("seconds", [2.0, 8.0])
def test_noise_leaves_the_published_floor(seconds):
    """2.5 sqrt(12) N J T^-3/2 about each axis, J here as the norm of its rows."""
    size = float(np.linalg.norm(unpack_symmetric(INERTIA)))
    expected = 2.5 * np.sqrt(12) * DENSITY * size * seconds**-1.5
    assert observed(seconds).noise == pytest.approx(expected, rel=0.08)


def test_a_torque_free_platform_has_no_significant_residual_torque():
    """What is left when noise is taken off is within three of its sd of nothing."""
    found = observed(4.0)
    assert found.rms < 3 * np.sqrt(2 * found.noise * found.rms_sd) + found.rms_sd
    assert found.rms < 0.5 * found.noise
    assert found.greatest < 6 * found.noise


def test_energy_is_known_up_to_a_constant():
    """The mean of the noise's energy, 1/2 tr(J) N^2 f, is a constant, and no swing."""
    posed = at_rest(2)
    found = residual_torque(energy, posed, tuple(pairs(posed, Drawn(), 8)), about_mean=True)
    assert abs(found.values.mean()) < 1e-12 * np.abs(found.values).max() + 1e-15
    assert found.rms < found.noise
