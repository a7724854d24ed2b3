"""Balancing laws on the reference table: `verification/laws.py` with a seed and few laws."""

from tests.support import thorough
from verification import laws


def test_the_best_procedure_leaves_what_is_wanted():
    some = thorough.some(("impulse_feedback", "momentum_buildup"), 1)
    assert laws.measure(range(1), laws=some).missed == ()
