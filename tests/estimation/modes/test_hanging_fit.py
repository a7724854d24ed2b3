"""A mass that hangs is found in MuJoCo's record with its numbers; its Jacobian by differences."""

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import METHOD
from equipoise.estimation.modes.hanging_fit import by_theta, mass_at, settled_hanging, vector_of
from equipoise.estimation.modes.hanging_fit import hung as with_mass
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.hanging_mass import HangingMass
from equipoise.model.outcome import Trust
from equipoise.model.reasons.mode_reasons import ModeReason
from tests.support.hanging_records import hanging_record
from tests.support.modal_records import modal_record, rigid_model

MASS = HangingMass(1.2e-5, 0.4, 0.3)
NUMBERS = ("hanging_sag", "hanging_heading", "hanging_spring")


@pytest.fixture(scope="module")
def found():
    record = hanging_record(1)
    return METHOD.run(record.recording, record.testbed, Options())


def test_the_mass_is_found_with_its_numbers(found):
    true = hanging_record(1).mass
    codes = [reason.code for reason in found.outcome.reasons]
    assert ModeReason.MASS_HANGS in codes
    assert ModeReason.SAG_MAY_HANG not in codes
    assert found.outcome.trust is Trust.TRUSTWORTHY
    sag, heading, spring = found.values(NUMBERS)
    sd = np.sqrt(np.diag(found.covariance_of(NUMBERS)))
    off = (heading - true.heading + np.pi / 2) % np.pi - np.pi / 2  # +h is -h
    assert abs(sag - true.sag) < 4 * sd[0]
    assert abs(off) < 4 * sd[1]
    assert abs(spring - true.spring) < 4 * sd[2]
    assert sd[0] < 0.3 * true.sag


def test_inertia_and_com_are_within_their_intervals(found):
    platform = hanging_record(1).platform
    J = platform.inertia_P[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    sd = np.sqrt(np.diag(found.covariance_of((*COM, *INERTIA))))
    off = found.values((*COM, *INERTIA)) - np.append(platform.com, J)
    assert np.all(np.abs(off) < 4 * sd)
    assert found.residual.reduced_chi_square == pytest.approx(1.0, abs=0.1)


def test_the_unknowns_of_a_mass_lead_back_to_it():
    again = mass_at(vector_of(MASS))
    assert (again.sag, again.heading, again.spring) == pytest.approx((1.2e-5, 0.4, 0.3))


def test_the_derivative_of_the_numbers_is_that_by_differences():
    theta, h = vector_of(MASS), 1e-5
    numbers = [
        np.array([(m.sag, m.heading, m.spring) for m in (mass_at(theta + s), mass_at(theta - s))])
        for s in h * np.eye(3)
    ]
    slopes = np.array([(ahead - behind) / (2 * h) for ahead, behind in numbers]).T
    assert by_theta(MASS) == pytest.approx(slopes, rel=1e-7, abs=1e-12)


def test_a_mass_that_a_rigid_platform_does_not_have_is_left_out():
    recording, testbed, _ = modal_record(5)
    model = with_mass(rigid_model(recording, testbed), HangingMass(1e-7, 0.3, 0.2))
    assert model.params.modal is not None
    left = settled_hanging(model)
    assert left.hanging is None
    assert left.params.modal is None
