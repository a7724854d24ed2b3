"""Rounding counts as noise, and a sensor that nobody described is as noisy as its rows."""

import numpy as np
import pytest

from equipoise.assessment.record_checks.sensor_noise import (
    shown_camera,
    shown_gyro,
    unstated_findings,
)
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from tests.support import builders

STEP, NOISE = 0.012, 0.003  # rad/s


def rates(noise: float, step: float = 0.0, n: int = 4000) -> Samples:
    """Slow swings, with noise and rounded."""
    t = np.arange(n) / 20.0
    w = 0.1 * np.sin(np.outer(t, [0.5, 0.6, 0.7])) + np.random.default_rng(1).normal(
        0, noise, (n, 3)
    )
    return Samples(t, step * np.round(w / step) if step else w)


def test_a_known_step_adds_to_the_stated_noise() -> None:
    """3 and 12 / sqrt(12) mrad/s: sqrt(9 + 12) mrad/s."""
    found = shown_gyro(rates(NOISE), Gyro(20.0, NOISE, 0.02, quantum=STEP))
    assert found is not None
    assert found.noise == pytest.approx(np.sqrt(21) * 1e-3)


def test_a_step_that_nobody_stated_is_found() -> None:
    found = shown_gyro(rates(NOISE, STEP), Gyro(20.0, NOISE, 0.02))
    assert found is not None
    assert found.noise == pytest.approx(np.sqrt(21) * 1e-3, rel=1e-6)


def test_without_steps_the_stated_noise_stays() -> None:
    found = shown_gyro(rates(NOISE), Gyro(20.0, NOISE, 0.02))
    assert found is not None
    assert found.noise == NOISE


@pytest.mark.parametrize(("step", "wanted"), [(0.0, NOISE), (STEP, np.sqrt(21) * 1e-3)])
def test_a_gyro_that_nobody_described(step, wanted) -> None:
    """White noise by third differences to some per cent; rounded rows show it to a third."""
    found = shown_gyro(rates(NOISE, step), None)
    assert found is not None
    assert found.noise == pytest.approx(wanted, rel=0.35 if step else 0.05)
    assert found.rate == pytest.approx(20.0)
    assert found.bias_sd > 0


def test_rounded_angles_add_to_the_stated_noise() -> None:
    rows = Samples(np.arange(3.0), exponential(np.zeros((3, 3))))
    found = shown_camera(rows, AttitudeSensor(1.0, 3e-3, quantum=12e-3))
    assert found is not None
    assert found.noise == pytest.approx(np.sqrt(21) * 1e-3)


def test_a_camera_that_nobody_described() -> None:
    turns = np.random.default_rng(2).normal(0, 2e-3, (2000, 3))
    rows = Samples(np.arange(2000) / 5.0, exponential(turns))
    found = shown_camera(rows, None)
    assert found is not None
    assert found.noise == pytest.approx(2e-3, rel=0.05)


def test_assumed_sensor_noise_is_reported() -> None:
    testbed, recording = builders.platform(), Recording(rate=rates(0.01))
    (reported,) = unstated_findings(recording, testbed)
    # 0.01 rad/s = 0.573 deg/s, estimated to some per cent from 4000 rows
    assert "no sensor.gyro: its noise is assumed to be 0.5" in reported.sentence
    assert unstated_findings(recording, builders.platform(gyro=True)) == []
    assert unstated_findings(recording, None) == []
