"""Modes of MuJoCo's platforms, with few seeds."""

from tests.support import thorough
from verification import modes


def test_modes_are_found_and_intervals_hold():
    """Other platforms than `make verify` has; one of each kind at least."""
    seeds = range(3000, 3000 + thorough.count(30, 6))
    assert modes.measure(seeds).missed == ()
