"""A replayed bench gives back the recording, every row once, and obeys nobody."""

import numpy as np
import pytest

from equipoise.hardware.bench.replayed_bench import RecordingEnded, ReplayedBench
from equipoise.io.testbed.presets import read_preset
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError, MoveRefused
from equipoise.model.recording import CHANNELS, Recording, Samples, joined

BED = read_preset("sputnix")


def record() -> Recording:
    """Attitude at 10 Hz from 2 s to 4 s, rate at 20 Hz, one mass reported at 3 s as 2 mm."""
    t, fine = 2 + np.arange(21) / 10, 2 + np.arange(41) / 20
    q = np.tile([1.0, 0, 0, 0], (21, 1))
    rate = np.stack([fine, -fine, fine**2], axis=1)
    name = BED.mass_names[0]
    return Recording(
        Samples(t, q), Samples(fine, rate), (name,), Samples(np.array([3.0]), np.array([[0.002]]))
    )


def test_it_is_a_bench():
    assert isinstance(ReplayedBench(BED, record()), Bench)


@pytest.mark.parametrize("step", [0.05, 0.13, 0.7, 5.0])
def test_every_row_comes_once_whatever_the_readings_lengths(step):
    bench, parts = ReplayedBench(BED, record()), []
    while bench.time < 4.0:
        parts.append(bench.read(step))
    with pytest.raises(RecordingEnded, match=r"ends at 4\.000 s"):
        bench.read(step)
    again = joined(parts)
    for name in CHANNELS[:3]:
        ours, theirs = getattr(again, name), getattr(record(), name)
        np.testing.assert_array_equal(ours.t, theirs.t)
        np.testing.assert_array_equal(ours.values, theirs.values)
    counts = sum(len(part.rate) for part in parts if part.rate is not None)
    assert counts == len(record().rate)  # none twice


def test_time_passes_by_the_requested_wait():
    waited = []
    bench = ReplayedBench(BED, record(), waited.append)
    bench.read(0.5)
    bench.read(0.25)
    assert waited == [0.5, 0.25]
    assert bench.time == 2.75


def test_a_move_beyond_the_travel_is_refused_and_one_within_is_not():
    bench, mass = ReplayedBench(BED, record()), BED.masses[0]
    bench.read(1.5)
    with pytest.raises(MoveRefused, match="at 2 mm"):
        bench.move({mass.name: mass.travel[1] + 0.001})
    bench.move({mass.name: mass.travel[1]})
    bench.stop()
    assert bench.time == 3.5


def test_what_is_no_use_of_a_bench_is_refused():
    bench = ReplayedBench(BED, record())
    for wrong in (
        lambda: bench.move({"nobody": 0.0}),
        lambda: bench.move({BED.mass_names[0]: float("nan")}),
        lambda: bench.drive({"nobody": 0.0}),
        lambda: bench.read(-1.0),
    ):
        with pytest.raises(InputError):
            wrong()
