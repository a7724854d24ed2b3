"""An estimate and its document give the same numbers; what nobody saw has no finite variance."""

import json

import numpy as np
import pytest

from equipoise.io.exchange.result_file import read_given
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.given_numbers import NOTHING_GIVEN, given_by
from equipoise.model.outcome import outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason

COVARIANCE = np.array([[4.0, 1.0, 0.5], [1.0, 9.0, 0.2], [0.5, 0.2, 1.0]])
PARAMETERS = (Parameter("com_x", "m", 1.0, 2.0), Parameter("com_y", "m", 2.0, 3.0),
              Parameter("sag_xx", "m", 3.0, np.inf, observable=False))  # fmt: skip


def document(usable=True, shown=COVARIANCE):
    """Return an estimate's document of which the last parameter was not seen."""
    rows = [[None if (i == 2) == (j == 2) == 1 else x for j, x in enumerate(row)]
            for i, row in enumerate(shown.tolist())]  # fmt: skip
    return {
        "schema": "equipoise/estimate/1",
        "outcome": {"usable": usable, "sentence": "As found."},
        "parameters": [{"name": p.name, "value": p.value, "sd": None} for p in PARAMETERS],
        "covariance": rows,
    }


def test_an_estimate_and_its_document_give_the_same(tmp_path):
    path = tmp_path / "estimate.json"
    path.write_text(json.dumps(document()))
    of_file = read_given(tmp_path)
    of_record = given_by(Estimate("m", outcome(EstimateReason.LINEAR), PARAMETERS, COVARIANCE))
    for given in (of_file, of_record):
        values, covariance = given.of(("com_y", "com_x"))
        assert values == pytest.approx([2.0, 1.0])
        assert covariance == pytest.approx(np.array([[9.0, 1.0], [1.0, 4.0]]))
        assert given.known(("com_x", "com_y"))
        assert not given.known(("sag_xx",))
        assert not given.known(("com_x", "com_z"))


def test_nothing_given_knows_nothing():
    assert not NOTHING_GIVEN.known(("com_x",))
    assert NOTHING_GIVEN.of(())[0].size == 0


def test_an_estimate_that_is_not_usable_is_refused(tmp_path):
    path = tmp_path / "estimate.json"
    path.write_text(json.dumps(document(usable=False)))
    with pytest.raises(InputError, match=r"As found\.; wanted an estimate that is usable"):
        read_given(path)
