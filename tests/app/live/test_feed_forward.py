"""Gravity's torque along a bench: true, in time, and whatever happens to the bench."""

import socket
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.arguments.feeding import Receiver
from equipoise.app.live import feed_forward
from equipoise.app.live.feed_forward import FeedForward, fed
from equipoise.io.stream.gravity_datagram import unpacked
from equipoise.io.testbed.presets import read_preset
from equipoise.model.given_numbers import NOTHING_GIVEN
from equipoise.model.gravity_torque import TorqueStatus
from equipoise.model.recording import Recording
from equipoise.simulation.bench import SimulatedBench

BED = replace(read_preset("nanosat"), tilt_limit=3.0)


def followed(bench, seconds, each=0.25, bed=BED):
    """Return a feed-forward and what it has given along a bench."""
    found = []
    sender = FeedForward(bed, NOTHING_GIVEN, found.append)
    for _ in range(round(seconds / each)):
        sender(bench.read(each))
    return sender, found


def test_it_gives_the_true_torque_within_its_sd_through_a_move():
    """A mass that moves by 5 mm shifts the platform's centre of mass by 75 um at once."""
    bench = SimulatedBench(BED, 3)
    sender, found = followed(bench, 20.0)
    bench.move({"x": 0.005})
    for _ in range(12):
        sender(bench.read(0.25))
        moment = bench.platform.body.mass * bench.com
        error = found[-1].first_moment - moment
        assert abs(error[:2]) == pytest.approx(0, abs=4 * found[-1].first_moment_sd[:2].max())
        assert found[-1].status is TorqueStatus.USABLE
        assert found[-1].torque == pytest.approx(
            np.cross(found[-1].first_moment, found[-1].gravity), rel=1e-12
        )
    assert abs(moment[0] - found[79].first_moment[0]) > 0.9 * 0.060 * 0.005


def test_it_begins_as_not_usable_and_becomes_usable():
    bench, found = SimulatedBench(BED, 1), []
    sender = FeedForward(BED, NOTHING_GIVEN, found.append)
    for seconds in (0.025, 10.0, 10.0):
        sender(bench.read(seconds))
    assert [each.status for each in found] == [
        TorqueStatus.NOT_USABLE, TorqueStatus.USABLE, TorqueStatus.USABLE,
    ]  # fmt: skip
    sizes = [np.linalg.norm(each.torque_sd) for each in found]
    assert sizes[1] < 0.1 * sizes[0]


def test_silent_sensors_make_it_stale_and_rows_make_it_usable_again():
    """Masses report on; attitude and rate are missing for a second."""
    bench, found = SimulatedBench(BED, 1), []
    sender = FeedForward(BED, NOTHING_GIVEN, found.append)
    for k in range(120):
        rows = bench.read(0.25)
        sender(replace(rows, attitude=None, rate=None) if 80 <= k < 84 else rows)
    assert [each.status is TorqueStatus.STALE for each in found[79:86]] == [
        False, False, False, True, True, False, False,  # beyond half a second
    ]  # fmt: skip


def test_a_tracker_that_fails_restarts_and_the_stream_goes_on(monkeypatch):
    bench, found = SimulatedBench(BED, 1), []
    sender, real = FeedForward(BED, NOTHING_GIVEN, found.append), feed_forward.grown

    def failing(*_given):
        raise np.linalg.LinAlgError("singular")

    for k in range(120):
        monkeypatch.setattr(feed_forward, "grown", failing if k == 60 else real)
        sender(bench.read(0.25))
    assert len(found) == 120
    assert found[59].status is TorqueStatus.USABLE
    assert found[60].status is TorqueStatus.NOT_USABLE
    assert found[-1].status is TorqueStatus.USABLE


def test_rows_of_nothing_are_no_datagram():
    found = []
    FeedForward(BED, NOTHING_GIVEN, found.append)(Recording())
    assert found == []


def test_a_bench_that_is_fed_sends_a_datagram_for_every_slice_and_notes_it():
    notes = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5.0)
        to = Receiver("127.0.0.1", receiver.getsockname()[1], NOTHING_GIVEN)
        with fed(SimulatedBench(BED, 1), to, lambda *event: notes.append(event)) as bench:
            rows = bench.read(1.0)
        sent = [unpacked(receiver.recv(4096)) for _ in range(8)]
    assert rows.span[1] == 1.0
    assert [each.sequence for each in sent] == list(range(8))
    assert np.diff([each.host_time_ns for each in sent]).min() > 0
    assert [each.content.t for each in sent] == pytest.approx([0.125 * k for k in range(1, 9)])
    kinds, sentences, data = zip(*notes, strict=True)
    assert set(kinds) == {"gravity_torque"}
    assert set(sentences) == {""}
    assert data[-1]["torque_N_m"] == sent[-1].content.torque.tolist()


def test_without_a_receiver_the_bench_is_as_it_was():
    bench = SimulatedBench(BED, 1)
    with fed(bench, None, lambda *_event: None) as same:
        assert same is bench
