"""The claims of `make verify` about estimation, with fewer seeds and bands as wide as that costs.

Bands are computed in ``verification.chance``; a sound estimator leaves one once in 1000 changes of
seeds (the seeds here are fixed, so a test that passes goes on passing).
"""

import pytest

from tests.oracle.defects import COM_STEPS, CONTACTS, HEADING
from tests.support import thorough
from verification import (
    defective_logs,
    efficiency,
    lamp,
    real_record,
    tracker_honesty,
    tracker_knows,
)


def test_fit_is_at_the_bound_and_its_intervals_are_honest() -> None:
    """Paper-like runs, and as many of a body that is not flat."""
    assert efficiency.measure(range(thorough.count(60, 20))).missed == ()


def test_tracker_is_at_the_bound_and_honest() -> None:
    """Paper-like runs, moves fed and moves ignored."""
    assert tracker_honesty.measure(range(thorough.count(40, 15))).missed == ()


def test_tracker_knows_what_it_does_not_know() -> None:
    """Some runs of each kind: doubtful inertia, contacts, steps, a gap, loud noise."""
    assert tracker_knows.measure(range(thorough.count(8, 3))).missed == ()


def test_a_lamp_is_found_by_its_switch_and_foreseen() -> None:
    """Coefficients, time constant and com within their intervals; the tracker's error halved."""
    assert lamp.measure(range(thorough.count(40, 2))).missed == ()


real_recording = pytest.mark.skipif(
    not real_record.RECORD.is_file(), reason="the real recording is not at hand"
)


@real_recording
def test_a_calm_part_of_the_real_record_agrees_with_cad_and_simple_measurements() -> None:
    """20-40 s with a held value; and what reading alone finds in the whole minute."""
    quiet = real_record.identified((real_record.QUIET, real_record.HELD))
    rows = (
        *real_record.finding_rows(),
        *real_record.quiet_rows(quiet),
        *real_record.measurement_rows(quiet),
    )
    assert [row.quantity for row in rows if not row.ok] == []


@thorough.whole
@real_recording
def test_real_record_is_explained_and_predicts() -> None:
    """All of it: 20-40 s with and without a held value, its parts, and the whole minute."""
    missed = [row.quantity for row in real_record.measure().missed]
    assert missed == []


def test_known_defects_are_found_and_intervals_stay_honest() -> None:
    """A record or two each with contacts, slips, heading errors, and five defects at once."""
    kinds = {
        "heading errors": (HEADING,),
        "contacts": (CONTACTS,),
        "steps": (COM_STEPS,),
        "together": defective_logs.TOGETHER,
    }
    for what in thorough.some(list(kinds), 1):
        names = kinds[what]
        logs = [
            defective_logs.identified(names, False, seed) for seed in range(thorough.count(2, 1))
        ]
        assert [row for row in defective_logs.rows_for(what, logs) if not row.ok] == []
