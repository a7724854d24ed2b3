"""Records that hold nothing to measure by, or the wrong thing: findings, and no fault."""

import numpy as np
import pytest

from equipoise.assessment.findings.record_findings import findings
from equipoise.assessment.record_checks.exposure_averaging import row_averaging
from equipoise.assessment.record_checks.rate_quality import step_of
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.recording import Recording, Samples

BED = read_preset("nanosat")
T, FINE = 0.1 * np.arange(80), 0.02 * np.arange(400)  # s
SWING = 0.2 * np.sin(np.outer(T, [0.9, 0.7, 0.4]))
RNG = np.random.default_rng(0)
ATTITUDES = {
    "swings": exponential(SWING),
    "stands still": np.tile(exponential(SWING[5]), (len(T), 1)),
    "spins evenly": exponential(np.outer(T, [0.0, 0.0, 0.3])),
    "noise": exponential(1e-3 * RNG.normal(size=(len(T), 3))),
    "jumps once": exponential(np.where(T[:, None] > 4.0, [0.1, 0.0, 0.0], np.zeros(3))),
}
TURNS = 0.2 * np.array([0.9, 0.7, 0.4]) * np.cos(np.outer(FINE, [0.9, 0.7, 0.4]))
RATES = {
    "swings": TURNS,
    "in another unit": np.radians(TURNS),
    "zero": 0.0 * TURNS,
    "constant": np.tile([0.1, 0.2, 0.3], (len(FINE), 1)),
    "constant to rounding": 0.1 * (1 + 2e-16 * RNG.integers(-3, 4, size=(len(FINE), 3))),
    "one axis": TURNS * [1.0, 0.0, 0.0],
    "jumps once": np.where(FINE[:, None] > 4.0, [0.1, 0.0, 0.0], np.zeros(3)),
    "tiny": 1e-12 * TURNS,
}


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("rate", RATES)
@pytest.mark.parametrize("attitude", ATTITUDES)
def test_every_record_can_be_inspected(attitude, rate):
    """At full length, and cut to a few rows; every number that is said is finite."""
    for rows in (len(T), 25, 4, 1):
        record = Recording(
            attitude=Samples(T[:rows], ATTITUDES[attitude][:rows]),
            rate=Samples(FINE[: 5 * rows], RATES[rate][: 5 * rows]),
            attitude_norm=Samples(T[:rows], np.ones((rows, 1))),
        )
        found = findings(record, BED)
        numbers = [x for f in found for r in f.reasons for x in r.numbers.values()]
        assert numbers
        assert np.all(np.isfinite(numbers))


def test_values_that_differ_by_rounding_have_no_step():
    assert step_of(RATES["constant to rounding"][:, 0]) is None


def test_lengths_that_are_all_one_show_no_window():
    """As in a part of a record whose other rows are means."""
    swings = Samples(T, ATTITUDES["swings"])
    assert row_averaging(swings, Samples(T, np.ones((len(T), 1)))) is None
