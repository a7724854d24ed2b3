"""A sag that nobody declared may be of a mass that hangs: it is stated, with its height."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.events.record_model import refitted
from equipoise.estimation.modes.hanging_mass import SAG, height_of, with_hanging
from equipoise.estimation.output_error.fit_estimate import conclude
from equipoise.model.modes import FreeMode
from equipoise.model.outcome import Trust
from equipoise.model.reasons.mode_reasons import ModeReason
from tests.support.modal_records import modal_record, rigid_model


@pytest.mark.parametrize(
    ("sag", "height"),
    [
        ((4.0, -2.0, 0.0, 0.0, 0.0), 6.0),  # 6 x x^T less its trace
        ((1.0, 1.0, 3.0, 0.0, 0.0), 6.0),  # 6 u u^T, u between x and y
        ((0.0, 0.0, 0.0, 0.0, 0.0), 0.0),
    ],
)
def test_the_height_of_a_pendulum_is_its_sag(sag, height):
    assert height_of(np.array(sag)) == pytest.approx(height)


@pytest.fixture(scope="module")
def sagging():
    recording, testbed, _ = modal_record(1)
    model = rigid_model(recording, testbed)
    model = refitted(replace(model, params=replace(model.params, terms=SAG)))
    return model, conclude(model.fitted, "trajectory", recording)


def test_the_height_is_stated_and_no_number_changes(sagging):
    model, plain = sagging
    found = with_hanging(plain, model, ())
    (reason,) = [r for r in found.outcome.reasons if r.code is ModeReason.SAG_MAY_HANG]
    assert reason.numbers["height"] == pytest.approx(height_of(plain.values(SAG)))
    assert found.covariance is plain.covariance
    assert found.parameters == plain.parameters
    assert found.outcome.trust is plain.outcome.trust


def test_a_declared_sag_bends(sagging):
    model, plain = sagging
    assert with_hanging(plain, model, SAG) is plain


def test_no_sag_is_no_hanging_mass(sagging):
    model, plain = sagging
    rigid = replace(model, params=replace(model.params, terms=()))
    assert with_hanging(plain, rigid, ()) is plain


def test_a_mode_beside_a_sag_is_a_mass_that_swings(sagging):
    model, plain = sagging
    mode = FreeMode(1.3, 0.01, np.array([0.1, 0.0, 0.0]))
    found = with_hanging(plain, replace(model, modes=(mode,)), ())
    assert ModeReason.MASS_SWINGS in {reason.code for reason in found.outcome.reasons}
    assert found.outcome.trust is Trust.NOT_TRUSTWORTHY
