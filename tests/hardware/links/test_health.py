"""What is reported of devices: every count in words, and the clock as it is."""

import pytest

from equipoise.hardware.links.arrival_statistics import Arrivals
from equipoise.hardware.links.clock_sync import DeviceClock, learnt, offset_of
from equipoise.hardware.links.health import Health
from equipoise.model.reading import Counts


def clock(drift, offset, jumps=0):
    """Return a clock that has received a row a second for 20 s, none of them late."""
    reported = DeviceClock()
    for k in range(21):
        reported = learnt(reported, float(k), offset + k * (1 + drift))
    return DeviceClock(reported.first, reported.last, reported.quickest, reported.span_end, jumps)


def test_nothing_wrong_is_said_so():
    assert Health("board masses", Counts(good=71)).sentence == (
        "board masses: 71 messages; nothing wrong"
    )


def test_everything_that_was_wrong_is_counted():
    arrivals = Arrivals(kept=300, duplicate=1, late=2, frozen=3, missing=4)
    reported = Health("sensor imu", Counts(good=310, corrupt=5, foreign=6), arrivals)
    assert reported.sentence == (
        "sensor imu: 310 messages, 6 of other kinds, 300 rows; "
        "5 broken, 1 twice, 2 late, 3 frozen, 4 missing"
    )
    assert reported.data == {
        "device": "sensor imu", "messages": 310, "others": 6, "rows": 300, "clocks": {},
        "broken": 5, "twice": 1, "late": 2, "frozen": 3, "missing": 4,
    }  # fmt: skip


@pytest.mark.parametrize(("drift", "pace"), [(50e-6, "50 ppm slow"), (-120e-6, "120 ppm fast")])
def test_a_clock_by_hand(drift, pace):
    """After 20 s the device reads 20 s, and the bench 3 s + 20 s (1 + drift)."""
    own = clock(drift, 3.0)
    assert offset_of(own) == pytest.approx(3.0 + 20 * drift, abs=1e-12)
    reported = Health("sensor imu", Counts(), Arrivals(), {"rate": own})
    assert reported.sentence.endswith(
        f"; clock of rate set off by {1e3 * (3.0 + 20 * drift):+.1f} ms, {pace}"
    )
    assert reported.data["clocks"]["rate"]["drift"] == pytest.approx(drift, rel=1e-6)


def test_clock_jumps_are_reported():
    reported = Health("sensor imu", Counts(), Arrivals(), {"rate": clock(0.0, 1.0, jumps=2)})
    assert reported.sentence.endswith(", 2 jumps")
