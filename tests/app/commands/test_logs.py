"""`equipoise convert`, `repair` and `replay`."""

import json
import re

import foxglove
import numpy as np
import pytest
from foxglove.mcap import MCAPWriteOptions
from mcap.reader import make_reader

from equipoise.app.arguments.inputs import fitting_recording_of
from equipoise.app.arguments.options import WHOLE, Reading
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples, rows_between
from tests.support.hostile_logs import mcap_that_lies


@pytest.mark.parametrize("suffix", ["parquet", "mcap", "mat"])
def test_a_recording_is_converted_and_back(equipoise, record_file, suffix):
    assert equipoise("convert", record_file, f"run.{suffix}").code == 0
    reported = equipoise("convert", f"run.{suffix}", "again.csv")
    assert (reported.code, "wrote again.csv" in reported.out) == (0, True)
    first, again = read_recording(record_file), read_recording("again.csv")
    np.testing.assert_allclose(again.attitude.t, first.attitude.t, rtol=0, atol=0.5e-9)
    np.testing.assert_array_equal(again.attitude.values, first.attitude.values)
    np.testing.assert_allclose(again.masses.values, first.masses.values, rtol=1e-15, atol=0)


def test_an_unsupported_output_suffix_is_reported_before_anything_is_read(equipoise):
    reported = equipoise("convert", "none.csv", "out.bag")
    assert reported.code == 2
    assert "ending in .csv, .parquet, .mcap or .mat" in reported.err


def test_a_cut_recording_is_repaired_and_says_up_to_when(equipoise, record_file, tmp_path):
    equipoise("convert", record_file, "whole.mcap")
    content = (tmp_path / "whole.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(content[: len(content) * 6 // 10])
    reported = equipoise("repair", "cut.mcap", "--out", "saved.mcap")
    assert reported.code == 0
    assert "no end" in reported.out
    saved = read_recording("saved.mcap")
    cut = read_recording("cut.mcap")
    np.testing.assert_array_equal(saved.attitude.values, cut.attitude.values)
    ends = [c.t[-1] for c in (saved.attitude, saved.rate, saved.masses) if c is not None]
    assert f"up to {max(ends):.3f} s" in reported.out
    again = equipoise("repair", "saved.mcap", "--out", "twice.mcap")
    assert "saved.mcap is complete" in again.out
    assert not (tmp_path / "twice.mcap").exists()


def without_index(path):
    """Write a record as version 0.1 did: a summary that knows no chunk."""
    context = foxglove.Context()
    options = MCAPWriteOptions(
        disable_seeking=True, emit_message_indexes=False, emit_chunk_indexes=False
    )
    with foxglove.open_mcap(path, context=context, writer_options=options):
        numbers = {f"{axis}_rad_s": {"type": "number"} for axis in "xyz"}
        channel = foxglove.Channel(
            "/rate", schema={"type": "object", "properties": numbers}, context=context,
            metadata={"equipoise.channel": "rate", "equipoise.names": "[]"},
        )  # fmt: skip
        for k in range(160):
            row = {"x_rad_s": 0.01 * k, "y_rad_s": 0.0, "z_rad_s": 0.0}
            channel.log(json.dumps(row).encode(), log_time=10**18 + k * 25_000_000)


def test_a_record_without_index_is_given_one_and_keeps_every_message(equipoise, tmp_path):
    """As mcap's own reader finds: the same messages in both, chunks in the index of one."""
    without_index(tmp_path / "old.mcap")
    reported = equipoise("repair", "old.mcap", "--out", "indexed.mcap")
    assert (reported.code, "It has no index; the new file has one" in reported.out) == (0, True)
    assert chunks_and_messages("old.mcap") == (0, chunks_and_messages("indexed.mcap")[1])
    assert chunks_and_messages("indexed.mcap")[0] > 0
    again = equipoise("repair", "indexed.mcap", "--out", "twice.mcap")
    assert "indexed.mcap is complete" in again.out
    assert not (tmp_path / "twice.mcap").exists()


def test_a_live_record_needs_no_repair_once_it_is_closed(equipoise, tmp_path):
    """Its index knows every chunk; what was attached is there."""
    t, none = np.arange(80) / 40, np.zeros((80, 3))
    with LiveRecording(tmp_path / "live.mcap", Opening(10**18, "name = 'x'")) as live:
        live.event(0.5, "command", "go", {"x": 1e-3})
        live.rows(Recording(rate=Samples(t, none)))
        live.turn(2.0)
        live.rows(Recording(rate=Samples(t + 2.0, none)))
    reported = equipoise("repair", "live.mcap", "--out", "indexed.mcap")
    assert "live.mcap is complete" in reported.out
    known, messages = chunks_and_messages("live.mcap")
    assert known > 1
    assert sum(topic == "/rate" for topic, _, _ in messages) == 160
    with (tmp_path / "live.mcap").open("rb") as file:
        (attachment,) = make_reader(file).iter_attachments()
    assert (attachment.name, attachment.data) == ("testbed.toml", b"name = 'x'")


def chunks_and_messages(path):
    """Return how many chunks the index knows, and every message, read by others."""
    with open(path, "rb") as file:  # noqa: PTH123
        reader = make_reader(file)
        known = len(reader.get_summary().chunk_indexes)
        return known, [(c.topic, m.log_time, m.data) for _, c, m in reader.iter_messages()]


def test_a_garbled_recording_says_how_many_messages_are_lost(equipoise, record_file, tmp_path):
    """What is saved and what is lost is what there was."""
    equipoise("convert", record_file, "whole.mcap")
    content = (tmp_path / "whole.mcap").read_bytes()
    middle = len(content) // 3
    (tmp_path / "bad.mcap").write_bytes(content[:middle] + bytes(8) + content[middle + 8 :])
    reported = equipoise("repair", "bad.mcap", "--out", "saved.mcap").out
    all_of_it = equipoise("repair", "whole.mcap", "--out", "x.mcap").out
    total = int(all_of_it.split("complete: ")[1].split()[0])
    saved = int(reported.split("Saved: ")[1].split()[0])
    lost = int(reported.split("Lost: ")[-1].split()[0])
    assert saved + lost == total
    assert lost > 0


def test_what_is_no_mcap_is_refused(equipoise, tmp_path):
    (tmp_path / "text.mcap").write_text("no recording at all, by any means")
    reported = equipoise("repair", "text.mcap", "--out", "out.mcap")
    assert reported.code == 2
    assert "no whole message" in reported.err


def test_the_remedy_of_a_repair_that_takes_too_much_is_an_option_of_it(equipoise, tmp_path):
    """The more memory it is given, the more is named as too little."""
    (tmp_path / "lies.mcap").write_bytes(mcap_that_lies())
    repaired = "repair", "lies.mcap", "--out", "out.mcap"
    reported = equipoise(*repaired)
    option, stated = re.search(r"(--max-memory-mb) (\d+)", reported.err.replace("\n", " ")).groups()
    again = equipoise(*repaired, option, stated)
    assert (reported.code, again.code) == (2, 2)
    assert f"more than {stated} MB" in again.err.replace("\n", " ")


def test_a_replay_prints_time_tilt_and_masses_each_second(equipoise, record_file):
    """The known move of the record is shown: x1 goes to -10 mm at 60 s."""
    reported = equipoise("replay", record_file, "--terminal", "--testbed", "sputnix", "--speed", 0)
    assert reported.code == 0
    lines = reported.out.splitlines()
    assert 100 < len(lines) <= 122
    assert "tilt" in lines[0]
    assert "x1  -10.00 mm" in lines[-1]


class Clock:
    """A clock on which nothing but waiting takes time."""

    def __init__(self):
        self.waits = []

    def monotonic(self):
        return sum(self.waits)

    def time_ns(self):
        return round(1e9 * self.monotonic())

    def sleep(self, seconds):
        self.waits.append(seconds)


def test_a_replay_keeps_its_pace(equipoise, record_file, monkeypatch):
    """Two seconds of the record at four times the speed: waits of half a second in all."""
    clock = Clock()
    for module in ("pace", "replay"):
        monkeypatch.setattr(f"equipoise.app.live.{module}.time", clock)
    words = ("--speed", 4, "--from-s", 10, "--to-s", 12)
    reported = equipoise("replay", record_file, "--terminal", "--testbed", "sputnix", *words)
    assert reported.code == 0
    assert sum(clock.waits) == pytest.approx(0.5, abs=0.1)
    assert len(clock.waits) >= 5


def test_a_replay_is_served_to_foxglove(equipoise, record_file, monkeypatch):
    monkeypatch.setattr(
        "equipoise.io.mcap.foxglove_server.PORT", 0
    )  # the customary one may be taken here
    words = ("--speed", 0, "--foxglove", "--from-s", 10, "--to-s", 12)
    reported = equipoise("replay", record_file, "--testbed", "sputnix", *words)
    assert "ws://127.0.0.1:" in reported.out


def test_a_benchs_own_record_is_fitted_from_where_the_platform_was_let_go(tmp_path):
    """Rows before it stay in the file; an earlier or later time may be asked for."""
    t = np.arange(0.0, 6.0, 0.05)
    attitude = Samples(t, np.tile([1.0, 0.0, 0.0, 0.0], (len(t), 1)))
    path = tmp_path / "run.mcap"
    with LiveRecording(path, Opening(10**18)) as live:
        for start, end in ((-1.0, 2.0), (2.0, 4.0), (4.0, 6.0)):
            live.rows(rows_between(Recording(attitude=attitude), start, end))
            if end < 6.0:
                live.event(end, "start", "the platform is free from here on", {})
    assert read_recording(path).span == pytest.approx((0.0, 5.95))
    bed = read_preset("nanosat")
    fitted = fitting_recording_of(str(path), WHOLE, bed)
    assert fitted.span == pytest.approx((4.0, 5.95))
    assert fitting_recording_of(str(path), Reading(from_s=1.0), bed).span[0] == pytest.approx(1.0)
