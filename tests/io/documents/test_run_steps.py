"""Steps of a balancing, read back from its document."""

import json

import pytest

from equipoise.io.documents.run_steps import BALANCE, read_steps
from equipoise.model.errors import InputError
from equipoise.model.recorded_step import RecordedStep

MEASURED = {"kind": "measurement", "code": "observed", "time_s": 1.6, "sentence": "Observed."}
VERIFIED = {
    "kind": "verify", "time_s": 9.0, "sentence": "Within.", "verdict": {"outcome": "passed"},
}  # fmt: skip


def written(folder, document):
    (folder / BALANCE).write_text(json.dumps(document))
    return folder


def test_steps_keep_their_order_time_sentence_and_outcome(tmp_path):
    folder = written(tmp_path, {"schema": "equipoise/balance/2", "steps": [MEASURED, VERIFIED]})
    assert read_steps(folder) == (
        RecordedStep("measurement", 1.6, "Observed."),
        RecordedStep("verify", 9.0, "Within.", "passed"),
    )


def test_a_run_that_was_no_balancing_has_none(tmp_path):
    assert read_steps(tmp_path) == ()


@pytest.mark.parametrize(
    ("document", "place"),
    [
        ({"steps": [{**MEASURED, "time_s": "soon"}]}, "time_s"),
        ({"steps": [{**VERIFIED, "verdict": {"outcome": "splendid"}}]}, "outcome"),
        ({}, "steps"),
    ],
)
def test_what_is_no_document_of_a_balancing_is_refused_by_its_place(tmp_path, document, place):
    with pytest.raises(InputError, match=rf"{BALANCE}.*{place}"):
        read_steps(written(tmp_path, document))
