"""A view that fails leaves bench and record alone; a record that fails stops the masses."""

import contextlib
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.bench.explained_conversation import Conversations
from equipoise.app.live.observed_bench import WatchedBench
from equipoise.app.live.pace import Pace
from equipoise.app.live.replay import replayed
from equipoise.hardware.transport.tapped_port import TappedPort
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.errors import BenchStopped
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.units import MM
from equipoise.simulation.bench import SimulatedBench
from tests.support.emulated_lab import Lab, lab, over_tcp
from tests.support.recorded_events import events_of

BED = replace(over_tcp(read_preset("nanosat")), tilt_limit=3.0)

CANCEL = b"\x85"  # Grbl: cancel a jog


class Failing:
    """A listener that cannot take the verbs that are named."""

    def __init__(self, *verbs):
        self._verbs = verbs

    def _take(self, verb):
        if verb in self._verbs:
            raise RuntimeError(f"no more {verb}")

    def rows(self, recording):
        self._take("rows")

    def event(self, t, kind, sentence, data):
        self._take("event")

    def turn(self, t):
        self._take("turn")


def fails(*_what):
    raise ZeroDivisionError("in the view")


@pytest.mark.parametrize("verb", ["rows", "event", "turn"])
def test_a_live_view_that_fails_leaves_the_bench_alone_and_the_record_says_so(tmp_path, verb):
    path = tmp_path / "run.mcap"
    with lab(BED) as found, LiveRecording(path, Opening(10**18, "", BED)) as record:
        found.keeper.listen(Failing(verb), "the live view")
        found.keeper.listen(record)
        found.bench.read(0.2)
        found.bench.move({"x": 4 * MM})
        found.bench.read(3.0)
        assert found.keeper.links.positions["x"] == pytest.approx(4 * MM, abs=2e-6)
        (sentence,) = found.bench.lost
    assert sentence.startswith("the live view: failed, the bench goes on")
    assert sentence in [event.sentence for event in events_of(path)]
    assert np.ptp(read_recording(path).rate.t) > 3.0


@pytest.mark.parametrize("verb", ["rows", "event", "turn"])
def test_a_record_that_fails_in_whatever_way_stops_the_masses(verb):
    """Not an error that was foreseen, and all the same a sentence and a halt."""
    with lab(BED) as found:
        found.bench.move({"x": 14 * MM})
        found.bench.read(0.5)
        found.keeper.listen(Failing(verb))
        with contextlib.suppress(BenchStopped):
            found.bench.move({"y": 5 * MM})
            found.bench.read(0.2)
        assert f"no more {verb}" in found.keeper.trip.sentence
        found.wait(1.0)
        at = found.emulated.platform.displacements.copy()
        found.wait(0.5)
        assert np.all(found.emulated.platform.displacements == at)
        assert at[0] < 7 * MM


class SlowDisk(Failing):
    """A record whose disk takes long: what has the board been sent when it is about to write?"""

    def __init__(self, board):
        super().__init__()
        self._board, self.sent = board, {}

    def event(self, t, kind, sentence, data):
        self.sent[kind] = self._board.wire.receive()


def test_an_interlock_halts_the_masses_before_it_is_noted():
    with lab(BED) as found:
        found.bench.move({"x": 14 * MM})
        found.bench.read(0.5)
        slow = SlowDisk(found.board)
        found.keeper.listen(slow)
        found.keeper.halt(Reason(Interlock.RECORD_LOST, ("the platform is touched",)))
    assert CANCEL in slow.sent["interlock"]


class ExplainedLab(Lab):
    """A lab whose conversations are printed, which fails from the start or after some lines."""

    lines = 0

    def _print(self, _line):
        self.lines -= 1
        if self.lines < 0:
            raise OSError(28, "No space left on device")

    def _open(self, address):
        hardware = self.emulated.testbed().hardware
        self._conversations = getattr(self, "_conversations", Conversations(hardware, self._print))
        return self._conversations.open(address)


@pytest.mark.parametrize("lines", [0, 1, 40])
def test_a_conversation_that_cannot_be_printed_takes_no_port_with_it(lines, capsys):
    found = ExplainedLab(BED, 1)
    found.lines = lines
    try:
        found.bench.start()
        found.bench.watch()
        found.bench.move({"x": 4 * MM})
        found.bench.read(2.0)
        assert found.keeper.links.positions["x"] == pytest.approx(4 * MM, abs=2e-6)
    finally:
        found.keeper.close()
        found.emulated.close()
    assert capsys.readouterr().err.count("the conversation: failed") == 1


def test_what_is_sent_is_sent_before_it_is_shown():
    """It may be a halt."""
    sent = []

    class Wire:
        def send(self, data):
            sent.append(data)

    with pytest.raises(ZeroDivisionError):
        TappedPort(Wire(), fails).send(CANCEL)
    assert sent == [CANCEL]


def test_a_guard_in_front_of_an_onlooker_gets_the_rows_whatever_fails():
    guarded = []
    watched = WatchedBench(SimulatedBench(BED, 1), fails, 0.1, guard=guarded.append)
    watched.read(1.0)
    assert len(guarded) == 10


def test_what_a_guard_raises_stops_the_reading():
    def stops(_rows):
        raise BenchStopped("by the guard")

    watched = WatchedBench(SimulatedBench(BED, 1), fails, 0.1, guard=stops)
    with pytest.raises(BenchStopped, match="by the guard"):
        watched.read(1.0)
    assert watched.time == pytest.approx(0.1)


def test_a_replay_goes_on_without_a_view_that_failed(capsys):
    recording, received = SimulatedBench(BED, 1).read(3.0), []
    replayed(BED, recording, Pace(0.0), {"the live view": fails, "the terminal": received.append})
    assert sum(len(rows.rate) for rows in received) == len(recording.rate)
    said = capsys.readouterr().err
    assert said.count("the live view: failed") == 1


def test_a_replay_that_nobody_sees_any_more_ends():
    bed, recording = BED, SimulatedBench(BED, 1).read(3.0)
    replayed(bed, recording, Pace(1e-3), {"the terminal": fails})


def test_a_replay_whose_output_nobody_reads_ends_as_any_command_does():
    def closed(_rows):
        raise BrokenPipeError

    recording = SimulatedBench(BED, 1).read(3.0)
    with pytest.raises(BrokenPipeError):
        replayed(BED, recording, Pace(0.0), {"the terminal": closed, "the live view": fails})
