"""Balancing laws: on the reference table, on tas2, and through ports, with few seeds."""

from tests.support import thorough
from verification import fully_actuated, laws, laws_on_ports


@thorough.whole
def test_the_best_procedure_leaves_what_is_wanted():
    some = ("momentum_buildup", "impulse_feedback")
    assert laws.measure(range(1), laws=some).missed == ()


@thorough.whole
def test_the_fully_actuated_law_ends_and_leaves_what_is_wanted():
    """On tas2, and in the time that it says on three more testbeds."""
    assert fully_actuated.measure(range(2), beside=()).missed == ()


def test_faults_of_what_a_law_drives_end_in_recovery_or_at_rest_with_the_right_reason():
    """One run of some of the faults, with other moments and starts than `make verify` has."""
    step = thorough.count(1, 5)
    seeds = range(1024, 1024 + len(laws_on_ports.FAULTS), step)
    assert laws_on_ports.measure_faults(seeds).missed == ()


@thorough.whole
def test_a_law_that_drives_wheels_runs_through_ports_to_its_verdict():
    run = laws_on_ports.run_on_ports(("momentum_buildup", 1))
    assert run.verdict.passed
    assert not run.stopped
    assert not run.passed_falsely
