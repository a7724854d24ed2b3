"""Balancing laws: `verification/laws.py` and `fully_actuated.py` with few seeds and laws."""

from tests.support import thorough
from verification import fully_actuated, laws


@thorough.whole
def test_the_best_procedure_leaves_what_is_wanted():
    some = ("momentum_buildup", "impulse_feedback")
    assert laws.measure(range(1), laws=some).missed == ()


@thorough.whole
def test_the_fully_actuated_law_ends_and_leaves_what_is_wanted():
    """On tas2, and in the time that it says on three more testbeds."""
    assert fully_actuated.measure(range(2), beside=()).missed == ()
