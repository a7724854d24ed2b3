"""The claims of `make verify` about records of other laboratories and bad starts, reduced."""

import pytest

pytest.importorskip("mujoco", reason="MuJoCo is a development dependency")

from verification import laboratories, starts
from verification.workers import spread_over

QUICK = (
    "280 deg/s, spinning down", "tilts to 20 deg", "gyro in steps", "gyro that the testbed lacks",
    "pendulum in one plane, no move", "at rest, then moved", "gap over the move", "three gaps",
)  # fmt: skip


def test_no_record_fails_and_no_wrong_number_is_firm() -> None:
    """One record of each kind that takes seconds; compiling is not counted against the time."""
    result = laboratories.measure(range(1), spread_over(2), QUICK, slowest=float("inf"))
    assert result.missed == ()


def test_search_finds_the_optimum_from_anywhere() -> None:
    """Two seeds from half an inertia too much, and from nothing."""
    assert starts.measure(range(2), spread_over(2)).missed == ()
