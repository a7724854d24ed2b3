"""The claims of `make verify` about procedures, on fewer platforms."""

from tests.support import thorough
from verification import balanced, drift, two_levels, undeclared_drift


def test_balancing_ends_within_tolerance_and_its_verdict_knows() -> None:
    """Some platforms: as many good ones as 95 % leaves in all but one of 1000 such tests."""
    assert balanced.measure(range(thorough.count(10, 3))).missed == ()


def test_hands_and_then_masses_end_within_tolerance_and_the_verdict_knows() -> None:
    """The same from 300 um off, with two placings of weights at most; what is handed over holds."""
    assert two_levels.measure(range(thorough.count(20, 3))).missed == ()


@thorough.whole
def test_drifting_platform_is_held() -> None:
    """A platform for ten minutes, within 3 um on every axis all the time."""
    assert drift.measure(range(1), hold=600.0).missed == ()


def test_a_drift_that_nobody_declared_is_followed() -> None:
    """Some platforms for minutes, within 3 um on every axis all the time; no verdict is false."""
    seeds, minutes = range(thorough.count(6, 1)), thorough.count(30, 3)
    assert undeclared_drift.measure(seeds, hold=60.0 * minutes).missed == ()
