"""Modes in a fitted motion: with the true ones the fit explains the record."""

import numpy as np
import pytest

from equipoise.estimation.events.record_model import refitted
from equipoise.estimation.modes.modal_response import by_lines, with_response
from equipoise.estimation.output_error.solution import chi_square_share
from equipoise.model.modes import Mode, freed
from tests.support.modal_records import INERTIA, modal_record, rigid_model

MODE = Mode(1.3, 0.004, np.array([0.1, 0.06, 0.02]), deflection=1e-3)


def test_lines_through_a_wave_oscillate_as_much_as_the_wave():
    """The projection of the lines on the wave is that of the wave itself, to x^4."""
    t = np.arange(0.0, 20.0, 0.15)
    fine = np.linspace(t[5], t[-5], 20_001)
    points = by_lines(t, np.cos(t)[:, None], np.array([1.0]))[:, 0]
    drawn = np.interp(fine, t, points)
    wave = np.cos(fine)
    assert (drawn @ wave) / (wave @ wave) == pytest.approx(1.0, abs=5e-5)
    assert (np.interp(fine, t, np.cos(t)) @ wave) / (wave @ wave) < 1 - 1e-3


def test_true_modes_make_the_fit_explain_the_record():
    recording, testbed, _ = modal_record(2, MODE)
    model = rigid_model(recording, testbed)
    assert chi_square_share(model.fitted) > 2.0
    for _ in range(5):
        model = refitted(with_response(model, [freed(MODE, INERTIA)]))
    chance = np.sqrt(2 / model.fitted.at.residuals)
    assert chi_square_share(model.fitted) == pytest.approx(1.0, abs=4 * chance)
