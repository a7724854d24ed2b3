"""A line in residuals: where it is, and that noise has none."""

import numpy as np
import pytest

from equipoise.estimation.modes.residual_line import line_in, residual_line, threshold_for
from tests.support import thorough
from tests.support.modal_records import modal_record, rigid_model

T = np.arange(0.0, 60.0, 0.02)
ONE = np.ones(len(T))


def test_the_threshold_is_exceeded_as_often_as_stated():
    """M (1 + x + x^2 / 2) exp(-x) = 0.002."""
    x = threshold_for(1000.0)
    assert 1000.0 * (1 + x + x * x / 2) * np.exp(-x) == pytest.approx(2e-3)


def test_a_sinusoid_in_noise_is_found_with_its_axis():
    rng = np.random.default_rng(1)
    axis = np.array([0.6, 0.0, -0.8])
    left = rng.normal(size=(len(T), 3)) + 0.3 * np.cos(2 * np.pi * 3.7 * T)[:, None] * axis
    line = line_in(T, left, 0.02, 0.5, 6000)
    assert line is not None
    assert line.is_sure
    assert line.frequency == pytest.approx(3.7, abs=1 / 60)
    assert abs(line.axis @ axis) == pytest.approx(1.0, abs=0.02)


def test_white_noise_has_no_line():
    found = [line_in(T, np.random.default_rng([seed, 2]).normal(size=(len(T), 3)), 0.02, 0.5, 6000)
             for seed in range(thorough.count(300, 60))]  # fmt: skip
    assert sum(line is not None and line.is_sure for line in found) <= thorough.count(4, 1)


def test_a_rigid_platform_leaves_no_line():
    for seed in range(thorough.count(100, 5)):
        recording, testbed, _ = modal_record(seed)
        line = residual_line(rigid_model(recording, testbed).fitted)
        assert line is not None
        assert not line.is_sure
