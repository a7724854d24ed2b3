"""The testbeds of the review's table 1: `verification/table1.py` with a platform of some."""

from equipoise.study.papers.table1 import TABLE1
from tests.support import thorough
from verification import table1

QUICK = {"bologna", "unb", "aalto"}  # two motor-driven testbeds with a result, one without


def test_ours_leaves_no_more_than_is_printed():
    some = [entry for entry in TABLE1 if thorough.THOROUGH or entry.preset in QUICK]
    found = table1.measure(range(thorough.count(5, 1)), entries=some)
    assert found.missed == ()
    assert len(found.rows) == sum(
        2 - (entry.own == entry.best) + (entry.reached is not None) for entry in some
    )
