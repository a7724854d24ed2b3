"""An onlooker gets each row of a bench once and soon; readings are as without one."""

import math
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.bench.bench_proxy import RecordedBench
from equipoise.app.live.observed_bench import WatchedBench
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import BenchStopped
from equipoise.model.recording import CHANNELS, Recording, Samples, joined
from equipoise.simulation.bench import SimulatedBench
from tests.support.emulated_lab import lab, over_tcp

BED = replace(over_tcp(read_preset("nanosat")), tilt_limit=3.0)


class CountingBench:
    """A bench of one channel, a row each 10 ms whose value is its number; it can be stopped."""

    testbed = BED

    def __init__(self, stops_at: float = math.inf):
        self.time, self._rows, self._stops_at, self.requested = 0.0, 0, stops_at, []

    def read(self, duration):
        self.requested.append(duration)
        begun, self.time = self.time, min(self.time + duration, self._stops_at)
        if begun < self._stops_at <= self.time:
            raise BenchStopped("by the test")
        first, self._rows = self._rows, int(self.time / 0.01 + 0.5)
        return numbered(first, self._rows)


def numbered(first, last):
    number = np.arange(first, last, dtype=float)
    return Recording(rate=Samples(0.01 * number, np.repeat(number[:, None], 3, axis=1)))


def numbers(rows):
    return [] if rows.rate is None else list(rows.rate.values[:, 0])


def same(a, b):
    """Say whether two recordings have the same rows, bit for bit."""
    for channel in CHANNELS:
        one, other = getattr(a, channel), getattr(b, channel)
        if (one is None) != (other is None):
            return False
        if one is not None and not (
            np.array_equal(one.t, other.t) and np.array_equal(one.values, other.values)
        ):
            return False
    return a.mass_names == b.mass_names


def test_a_long_reading_is_cut_and_put_together_again():
    observed, bench = [], CountingBench()
    rows = WatchedBench(bench, observed.append, 0.25).read(0.6)
    assert bench.requested == pytest.approx([0.25, 0.25, 0.1])
    assert [len(numbers(each)) for each in observed] == [25, 25, 10]
    assert numbers(rows) == list(range(60))


def test_a_reading_of_no_time_is_read_all_the_same():
    bench = CountingBench()
    WatchedBench(bench, lambda _rows: None, 0.25).read(0.0)
    assert bench.requested == [0.0]


def test_a_slice_that_lasts_longer_shortens_the_reading_by_so_much():
    """As on a real bench whose camera gives a row a second."""
    bench = CountingBench()
    read = bench.read
    bench.read = lambda duration: read(max(duration, 1.0))
    WatchedBench(bench, lambda _rows: None, 0.25).read(2.0)
    assert len(bench.requested) == 2
    assert bench.time == 2.0


def test_rows_before_a_stop_within_a_reading_are_all_recorded():
    """The stop comes 0.35 s after a reading began: one slice was read, the next was not."""
    observed, bench = [], CountingBench(stops_at=1.35)
    recorded = RecordedBench(WatchedBench(bench, observed.append, 0.25))
    recorded.read(1.0)
    with pytest.raises(BenchStopped, match="by the test"):
        recorded.read(5.0)
    assert numbers(recorded.recording()) == list(range(135))
    assert numbers(joined(observed)) == list(range(135))


def test_who_stops_between_slices_loses_no_row():
    class Enough(Exception):
        pass

    calls = iter(range(10))

    def between():
        if next(calls) == 3:
            raise Enough

    watched = WatchedBench(CountingBench(), lambda _rows: None, 0.25, between)
    with pytest.raises(Enough):
        watched.read(5.0)
    assert watched.time == 0.75
    assert numbers(watched.read(0.0)) == list(range(75))


def test_a_failing_observer_is_reported_once_and_the_bench_goes_on(capsys):
    requested = []

    def fails(rows):
        requested.append(rows)
        raise ZeroDivisionError("in the view")

    watched = WatchedBench(CountingBench(), fails, 0.25)
    assert numbers(watched.read(1.0)) == list(range(100))
    assert len(requested) == 1
    reported = capsys.readouterr().err
    assert reported.count("\n") == 1
    assert "the view of the bench: failed, the bench goes on without" in reported


def test_ctrl_c_is_no_failure_of_an_onlooker():
    presses = [KeyboardInterrupt]

    def interrupted(_rows):
        if presses:
            raise presses.pop()

    watched = WatchedBench(CountingBench(), interrupted, 0.25)
    with pytest.raises(KeyboardInterrupt):
        watched.read(1.0)
    assert numbers(watched.read(0.0)) == list(range(25))


def test_a_real_bench_gives_the_same_rows_watched_or_not():
    observed, found = [], []
    for watched in (False, True):
        with lab(BED) as there:
            bench = WatchedBench(there.bench, observed.append, 0.125) if watched else there.bench
            bench.move({"x": 0.004})
            found.append(bench.read(1.6))
    assert same(*found)
    assert 10 <= len(observed) <= 13  # 1.6 s in eighths, each ending with a tick of 0.02 s
    assert same(joined(observed), found[0])


def test_rows_before_an_interlock_of_a_real_bench_are_all_recorded():
    observed = []
    with lab(BED) as there:
        bench = RecordedBench(WatchedBench(there.bench, observed.append, 0.125))
        bench.move({"z": -0.014})
        begun = there.clock.now
        there.clock.at(begun + 1.0, there.board.device.hit_limit)
        with pytest.raises(BenchStopped, match="a limit switch was hit"):
            bench.read(5.0)
        rows = bench.recording()
    assert rows.attitude.t[0] < begun + 0.1
    assert rows.attitude.t[-1] > begun + 0.9
    assert np.diff(rows.attitude.t).max() < 0.05  # 40 Hz, none lost on the way
    assert same(joined(observed), rows)


def test_a_simulated_bench_in_one_slice_hands_on_the_very_rows():
    observed = []
    rows = WatchedBench(SimulatedBench(BED, 1), observed.append, math.inf).read(2.0)
    assert observed == [rows]


@pytest.mark.timeout(60)
def test_a_clock_of_whole_nanoseconds_ends_a_reading_that_it_rounds_down():
    """A rest of 0.3 ns never passes on it."""
    bench = SimulatedBench(BED, 1)
    watched = WatchedBench(bench, lambda _rows: None, 0.1)
    watched.read(0.35 + 3e-10)
    assert bench.time == 0.35
