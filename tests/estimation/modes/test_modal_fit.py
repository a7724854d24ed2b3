"""A mode is found with its numbers, inertia and centre of mass with theirs."""

import numpy as np
import pytest

from equipoise.estimation.method_contract import Options
from equipoise.estimation.methods.trajectory import METHOD
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.modes import Mode, freed
from equipoise.model.reasons.mode_reasons import ModeReason
from tests.support import modal_records
from tests.support.modal_records import modal_record

MODE = Mode(1.3, 0.004, np.array([0.1, 0.06, 0.02]), deflection=1e-3)


@pytest.fixture(scope="module")
def found():
    recording, testbed, _ = modal_record(2, MODE)
    return METHOD.run(recording, testbed, Options())


def test_the_mode_is_reported_with_its_numbers(found):
    true = freed(MODE, modal_records.INERTIA)
    assert [r.code for r in found.outcome.reasons].count(ModeReason.MODE_FOUND) == 1
    for name, value in (("mode_1_frequency", true.frequency), ("mode_1_damping", true.damping)):
        p = found.parameters[found.index(name)]
        assert abs(p.value - value) < 4 * p.sd
        assert p.sd < 0.1 * value
    d = found.values(("mode_1_coupling_x", "mode_1_coupling_y", "mode_1_coupling_z"))
    along = d / np.linalg.norm(d)
    assert abs(along @ true.coupling) == pytest.approx(np.linalg.norm(true.coupling), rel=1e-3)
    assert not found.has("mode_2_frequency")


def test_inertia_and_com_are_within_their_intervals(found):
    J = modal_records.INERTIA[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    true = np.append(modal_records.COM, J)
    sd = np.sqrt(np.diag(found.covariance_of((*COM, *INERTIA))))
    assert np.all(np.abs(found.values((*COM, *INERTIA)) - true) < 4 * sd)
    assert found.residual.reduced_chi_square == pytest.approx(1.0, abs=0.1)
