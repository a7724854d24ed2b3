"""A record as others read it: whole, cut anywhere, repaired; by its index and without.

``by_message_index`` goes as Foxglove's app does: from the summary to a chunk, to the index behind
it, to each message by its offset. mcap's own readers are the other programs' voice here.
"""

import contextlib
import functools
import io
import struct
import tempfile
import zlib
from pathlib import Path

import numpy as np
import pytest
import zstandard
from mcap.exceptions import McapError
from mcap.reader import NonSeekingReader, make_reader

from equipoise.io.files.file_content import Content
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.mcap.mcap_repair import repair
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples
from tests.support import thorough

CHUNKS = 6
BED = read_preset("nanosat")
TOPICS = {"/attitude", "/rate", "/masses", "/scene", "/events", "/log"}


def rows(chunk):
    """Half a second at 20 Hz whose numbers follow from their times; a mass that moves."""
    t = chunk / 2 + np.arange(10) / 20
    q = np.stack([np.cos(t / 9), np.sin(t / 9), 0 * t, 0 * t], axis=1)
    masses = Samples(t[:3], np.stack([t[:3] * 1e-3, 0 * t[:3], 0 * t[:3]], axis=1))
    return Recording(
        Samples(t, q), Samples(t, np.stack([t, 1 - t, t / 7], axis=1)), BED.mass_names, masses
    )


@functools.cache
def recorded():
    """Return a closed record, and how long it was when each chunk had been written."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.mcap"
        sizes = []
        with LiveRecording(path, Opening(10**18, "name = 'x'\n", BED)) as file:
            for k in range(CHUNKS):
                file.rows(rows(k))
                file.event(k / 2 + 0.49, "note", f"chunk {k}", {"k": k})  # ends the chunk
                sizes.append(path.stat().st_size)
        return path.read_bytes(), sizes


def plain(found):
    return sorted((c.topic, m.log_time, m.data) for _, c, m in found)


def by_scanning(content):
    """Return what mcap's reader finds from the front, up to where it finds no more."""
    found = []
    with contextlib.suppress(McapError, struct.error, zstandard.ZstdError):
        reader = NonSeekingReader(io.BytesIO(content), validate_crcs=True)
        found.extend(reader.iter_messages(log_time_order=False))
    return plain(found)


def one_by_one(content):
    """Return the same, of each message as soon as it is found: a cut end costs none before it."""
    found = []
    with contextlib.suppress(McapError, struct.error, zstandard.ZstdError):
        for each in NonSeekingReader(io.BytesIO(content)).iter_messages(log_time_order=False):
            found.append(each)
    return plain(found)


def by_index(content):
    return plain(make_reader(io.BytesIO(content), validate_crcs=True).iter_messages())


def by_topic(content):
    """Return what the indexed reader finds when it is asked for each topic alone."""
    reader = make_reader(io.BytesIO(content))
    topics = {c.topic for c in reader.get_summary().channels.values()}
    return plain(each for topic in topics for each in reader.iter_messages(topics=[topic]))


def by_message_index(content):
    summary = make_reader(io.BytesIO(content)).get_summary()
    found = []
    for chunk in summary.chunk_indexes:
        at = chunk.chunk_start_offset
        body = content[at + 9 + 32 + len(chunk.compression) + 8 : at + chunk.chunk_length]
        inside = zstandard.decompress(body, chunk.uncompressed_size)
        assert chunk.message_index_offsets
        for channel, place in chunk.message_index_offsets.items():
            opcode, _, number, size = struct.unpack_from("<BQHI", content, place)
            assert (opcode, number) == (7, channel)
            for ns, offset in struct.iter_unpack("<QQ", content[place + 15 : place + 15 + size]):
                opcode, length, number, _, time, _ = struct.unpack_from("<BQHIQQ", inside, offset)
                assert (opcode, number, time) == (5, channel, ns)
                data = inside[offset + 31 : offset + 9 + length]
                found.append((summary.channels[channel].topic, ns, data))
    return sorted(found)


def by_us(content):
    found = salvaged(Content.of(content, "log"), "record")
    return sorted((found.channels[m.channel_id].topic, m.log_time, m.data) for m in found.messages)


INDEXED = [by_index, by_topic, by_message_index]
SCANNING = [one_by_one, by_us]


@functools.cache
def everything():
    """Return what the whole record holds: rows, a scene for each place, events."""
    return by_us(recorded()[0])


def wanted(chunks=CHUNKS):
    """Return what a record of so many chunks holds."""
    last = 10**18 + chunks * 500_000_000
    return [each for each in everything() if each[1] < last]


def test_the_record_holds_all_that_was_written():
    count = {t: sum(each[0] == t for each in wanted()) for t in TOPICS}
    assert count == {
        "/attitude": 60, "/rate": 60, "/masses": 18, "/scene": 18, "/events": 6, "/log": 6,
    }  # fmt: skip
    assert {each[0] for each in wanted()} == TOPICS


@pytest.mark.parametrize("read", [*INDEXED, *SCANNING, by_scanning])
def test_every_reader_sees_every_message_of_a_closed_record(read):
    assert read(recorded()[0]) == wanted()


def test_the_summary_says_what_there_is():
    """Counts by mcap's own reader; each topic by name, and times from the first row to the last."""
    summary = make_reader(io.BytesIO(recorded()[0]), validate_crcs=True).get_summary()
    said = summary.statistics
    assert (said.message_count, said.chunk_count) == (len(wanted()), CHUNKS)
    assert (said.schema_count, said.channel_count) == (6, 6)
    assert (said.attachment_count, said.metadata_count) == (1, 1)
    assert said.message_start_time == min(ns for _, ns, _ in wanted())
    assert said.message_end_time == max(ns for _, ns, _ in wanted())
    assert {c.topic for c in summary.channels.values()} == TOPICS
    counts = {summary.channels[k].topic: n for k, n in said.channel_message_counts.items()}
    assert counts == {t: sum(each[0] == t for each in wanted()) for t in TOPICS}


def test_the_checksum_of_the_summary_is_right():
    """Of all from the summary's beginning to the checksum itself (spec: Footer)."""
    content = recorded()[0]
    start, _, stated = struct.unpack("<QQI", content[-28:-8])
    assert stated == zlib.crc32(content[start:-12]) != 0


def cuts():
    """Return places of a cut: where, and how many chunks are whole before it."""
    content, sizes = recorded()
    ends = [0, *sizes]
    whole = [(end, k) for k, end in enumerate(ends) if k]
    within = [(end - 1 - (end - ends[k - 1]) // 3, k - 1) for end, k in whole]
    behind = [(size, CHUNKS) for size in range(sizes[-1] + 1, len(content), 97)]
    last = [(len(content) - 1, CHUNKS), (len(content) - 8, CHUNKS)]
    return [*whole, *(cut for cut in within if cut[1]), *thorough.some(behind, 6), *last]


@pytest.mark.parametrize("read", SCANNING)
def test_a_cut_record_gives_every_message_before_the_cut(read):
    content, _ = recorded()
    for size, chunks in cuts():
        found = read(content[:size])
        assert [each for each in wanted(chunks) if each not in found] == [], size
        assert [each for each in found if each not in wanted()] == [], size


def test_an_indexed_reader_never_takes_a_cut_record_for_an_empty_one():
    """A file without its end has no summary: mcap's reader says so, others go through the file."""
    content, _ = recorded()
    for size, _ in cuts():
        with pytest.raises((McapError, struct.error)):
            by_index(content[:size])


@pytest.mark.parametrize("read", [*INDEXED, *SCANNING, by_scanning])
def test_a_repaired_record_gives_every_message_to_every_reader(tmp_path, read):
    content, _ = recorded()
    for k, (size, chunks) in enumerate(cuts()):
        cut, out = tmp_path / f"cut{k}.mcap", tmp_path / f"out{k}.mcap"
        cut.write_bytes(content[:size])
        repair(cut, out)
        found = read(out.read_bytes())
        assert [each for each in wanted(chunks) if each not in found] == [], size
        assert found == by_us(content[:size]), size


def test_a_record_that_is_not_closed_has_no_summary(tmp_path):
    """As after a kill: all chunks are there, and no footer that says there are none."""
    path = tmp_path / "run.mcap"
    file = LiveRecording(path, Opening(10**18, "", BED))
    for k in range(CHUNKS):
        file.rows(rows(k))
        file.turn(k / 2 + 0.5)
    content = path.read_bytes()
    assert not salvaged(Content.of(content, "log"), "run").ended
    assert one_by_one(content) == by_us(content)
    assert len(by_us(content)) == len(wanted()) - 2 * CHUNKS  # no events
    file.close()
    assert by_index(path.read_bytes()) == by_us(content)


def test_a_record_that_was_moved_away_is_whole_without_an_index(tmp_path):
    """Its chunks cannot be looked up under its name any more, so readers go through it."""
    path, there = tmp_path / "run.mcap", tmp_path / "moved.mcap"
    with LiveRecording(path, Opening(10**18, "", BED)) as file:
        file.rows(rows(0))
        path.rename(there)
    content = there.read_bytes()
    assert make_reader(io.BytesIO(content)).get_summary() is None
    assert by_index(content) == by_us(content) != []


def test_a_record_of_an_earlier_version_is_read_as_it_was(tmp_path):
    """No stamps within messages, chunks that no index knows, topics opened by their first row."""
    import foxglove
    from foxglove.mcap import MCAPWriteOptions

    path, context = tmp_path / "old.mcap", foxglove.Context()
    options = MCAPWriteOptions(
        disable_seeking=True, emit_message_indexes=False, emit_chunk_indexes=False
    )
    with foxglove.open_mcap(str(path), context=context, writer_options=options) as writer:
        writer.write_metadata("equipoise", {"zero_ns": str(10**18)})
        channel = foxglove.Channel(
            "/rate", schema={"title": "equipoise.rate", "type": "object"}, context=context,
            metadata={"equipoise.channel": "rate", "equipoise.names": "[]"},
        )  # fmt: skip
        for k in range(4):
            data = b'{"x_rad_s": %d.5, "y_rad_s": 0.0, "z_rad_s": 0.25}' % k
            channel.log(data, log_time=10**18 + k * 10**8)
    observed = read_recording(path).rate
    np.testing.assert_array_equal(observed.t, [0.0, 0.1, 0.2, 0.3])
    np.testing.assert_array_equal(observed.values[:, 0], [0.5, 1.5, 2.5, 3.5])
