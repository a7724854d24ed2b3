"""Flights over a table by MuJoCo, with few seeds."""

from tests.support import thorough
from verification import planar


def test_intervals_of_slope_body_and_friction_hold():
    """Other flights than `make verify` has; one run of each kind at least."""
    seeds = range(2000, 2000 + thorough.count(10, 2))
    assert planar.measure(seeds).missed == ()
