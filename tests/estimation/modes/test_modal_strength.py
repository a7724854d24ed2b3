"""How strongly a mode shows is the chi-square that a fit without it leaves more."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.modes.modal_fit import agreed
from equipoise.estimation.modes.modal_strength import strengths
from equipoise.estimation.output_error.solution import cost_of
from equipoise.model.modes import Mode, freed
from tests.support.modal_records import INERTIA, modal_record, rigid_model


def mode(deflection):
    return Mode(1.3, 0.004, np.array([0.1, 0.06, 0.02]), deflection=deflection)


@pytest.fixture(scope="module")
def models():
    recording, testbed, _ = modal_record(2, mode(1e-3))
    rigid = rigid_model(recording, testbed)
    return rigid, agreed(rigid, [freed(mode(1e-3), INERTIA)])


def test_it_is_what_chi_square_gains_by_the_mode(models):
    """Within 4 sd, the gain of a known signal being S with a variance of 4 S."""
    rigid, model = models
    (shown,) = strengths(model)
    gained = 2 * (cost_of(rigid.fitted) - cost_of(model.fitted))
    assert shown > 1000
    assert abs(gained - shown) < 4 * (4 * shown) ** 0.5 + 0.02 * shown


def test_it_grows_as_the_square_of_the_motion(models):
    """Great beside what the motion of the platform drives."""
    rigid, _ = models
    modes = [freed(mode(deflection), INERTIA) for deflection in (0.02, 0.06)]
    pair = [strengths(replace(rigid, modes=(one,)))[0] for one in modes]
    assert pair[1] / pair[0] == pytest.approx(9.0, rel=0.05)


def test_without_a_mode_there_is_none(models):
    rigid, _ = models
    assert strengths(rigid) == ()
