"""Balancing laws on the reference table: `verification/laws.py` with few seeds and three laws."""

from verification import laws


def test_the_best_procedure_leaves_what_is_wanted():
    some = ("momentum_buildup", "impulse_feedback", "underactuated")
    assert laws.measure(range(2), laws=some).missed == ()
