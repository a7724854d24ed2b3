"""Balancing laws on the reference table: `verification/laws.py` with a seed and two laws."""

from tests.support import thorough
from verification import laws


@thorough.whole
def test_the_best_procedure_leaves_what_is_wanted():
    some = ("momentum_buildup", "impulse_feedback")
    assert laws.measure(range(1), laws=some).missed == ()
