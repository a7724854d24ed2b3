"""An estimate comes back from its document with all that another record is explained by."""

import json
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.text.json_document import estimate_json
from equipoise.io.exchange.estimate_file import read_estimate
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Parameter, Residual
from equipoise.model.event import Event
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.implausible_reasons import ImplausibleReason
from equipoise.model.reasons.reason import Reason

COVARIANCE = np.array([[4e-12, 1e-12, np.nan], [1e-12, 9e-12, np.nan], [np.nan, np.nan, np.inf]])
TOUCH = Event("impulse", 12.25, 0.02, np.array([1e-4, 0.0, -2e-4]), 1e-10 * np.eye(3), 44.0)
FOUND = Estimate(
    "trajectory",
    Outcome((Reason(Why.COLOURED_RESIDUAL, (),
                    {"lag_one": 0.3, "spectral_peak": 2.0, "widening": 1.4}),
             Reason(ImplausibleReason.INERTIA_OF_NO_BODY, (),
                    {"mass": 4.0, "radius": 1.0, "sd": 0.01, "low": 0.02, "high": 0.5}))),
    (Parameter("com_x", "m", 1 / 3e6, 2e-6), Parameter("com_y", "m", 2e-6, 3e-6),
     Parameter("sag_xx", "m", 0.0, np.inf, observable=False)),
    COVARIANCE,
    Residual(1e-3, None, 310.5, 300, 0.1, spectral_peak=2.5),
    provenance={"sha256": "ab12", "source": "run.mcap"},
    events=(TOUCH,),
)  # fmt: skip


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "estimate.json"
    path.write_text(json.dumps(estimate_json(FOUND)))
    return path


def test_all_that_counts_comes_back(path):
    found = read_estimate(path.parent)
    assert found.method == FOUND.method
    assert found.parameters == FOUND.parameters
    assert found.provenance == FOUND.provenance
    assert found.covariance_of(("com_x", "com_y")).tolist() == COVARIANCE[:2, :2].tolist()
    assert found.covariance[2].tolist() == [0.0, 0.0, np.inf]
    left = found.residual
    assert (left.attitude_rms, left.rate_rms, left.spectral_peak) == (1e-3, None, 2.5)
    (touch,) = found.events
    assert (touch.kind, touch.t, touch.t_sd) == ("impulse", 12.25, 0.02)
    assert touch.size.tolist() == TOUCH.size.tolist()


def test_reasons_come_back_by_their_codes(path):
    found = read_estimate(path)
    assert [reason.code for reason in found.outcome.reasons] == [
        Why.COLOURED_RESIDUAL, ImplausibleReason.INERTIA_OF_NO_BODY,
    ]  # fmt: skip
    assert found.outcome.trust is FOUND.outcome.trust


def test_an_estimate_that_is_not_usable_is_refused(path):
    unusable = replace(FOUND, outcome=Outcome((Reason(Why.NOT_CONVERGED),)))
    path.write_text(json.dumps(estimate_json(unusable)))
    with pytest.raises(InputError, match="wanted an estimate that is usable"):
        read_estimate(path)


def test_an_outcome_of_another_version_is_refused(path):
    path.write_text(path.read_text().replace(str(Why.COLOURED_RESIDUAL), "sunspots"))
    with pytest.raises(InputError, match="outcome 'sunspots'"):
        read_estimate(path)
