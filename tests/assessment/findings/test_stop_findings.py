"""When a record's platform was at its stop, by its rows and by what a simulation notes."""

from dataclasses import replace

import numpy as np

from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.findings.stop_findings import stop_findings, touch_findings
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples

LIMIT = float(np.radians(10.0))
BED = replace(read_preset("sputnix"), tilt_limit=LIMIT)


def leaning(shares):
    """Rows that lean about x by shares of the limit, ten a second."""
    turns = np.outer(np.array(shares) * LIMIT, [1.0, 0.0, 0.0])
    return Samples(0.1 * np.arange(len(shares)), exponential(turns))


def codes(found):
    return [each.reasons[0].code.name for each in found]


def test_a_swing_within_the_limit_says_nothing():
    assert stop_findings(leaning(0.97 * np.sin(np.arange(200) / 10)), BED) == []


def test_a_brief_touch_has_its_time():
    rows = leaning([0.5] * 20 + [1.0] * 5 + [0.5] * 20)
    (found,) = stop_findings(rows, BED)
    assert codes([found]) == ["MEETS_STOP"]
    assert found.kind == "problem"
    np.testing.assert_allclose(found.span, (2.0, 2.4))
    assert "its tilt limit of 10 deg at 2 s" in found.sentence


def test_lying_on_it_has_a_span():
    (found,) = stop_findings(leaning([0.5] * 20 + [1.0] * 50), BED)
    assert codes([found]) == ["LIES_ON_STOP"]
    assert "from 2 to 6.9 s" in found.sentence


def test_one_bad_row_is_no_touch():
    rows = [0.5] * 20
    for place in (0, 10, 19):
        assert stop_findings(leaning([*rows[:place], 3.0, *rows[place + 1 :]]), BED) == []


def test_many_touches_are_counted():
    spans = [(float(k), float(k) + 0.1) for k in range(8)]
    found = touch_findings(spans, LIMIT)
    assert codes(found) == ["MEETS_STOP"] * 5 + ["MORE_TOUCHES"]
    assert found[-1].reasons[0].numbers == {"count": 3}


def test_only_a_testbed_says_where_the_stop_is():
    record = Recording(attitude=leaning([0.5] * 20 + [1.0] * 50))
    named = {each.reasons[0].code.name for each in findings(record, BED)}
    assert "LIES_ON_STOP" in named
    assert "LIES_ON_STOP" not in {each.reasons[0].code.name for each in findings(record)}
