"""Logs that make much of little: a few kilobytes, by hand, that stand for gigabytes or for ever."""

import bz2
import json
import os
import sqlite3
import struct
from pathlib import Path

import lz4.frame
import zstandard

from tests.support.flight_logs import layout
from tests.support.sample_logs import IMU, ROS1, TREE, message, reported

PIECE = 1 << 20
DEFINED, MD5 = ROS1.generate_msgdef(IMU)


# --- MCAP --------------------------------------------------------------------------------------


def record(code: int, content: bytes) -> bytes:
    return struct.pack("<BQ", code, len(content)) + content


def text(value: str) -> bytes:
    return struct.pack("<I", len(value)) + value.encode()


def channel(number: int, topic: str, kind: str, encoding: str, **metadata: str) -> bytes:
    """A schema and a channel of the same number."""
    named = b"".join(text(key) + text(value) for key, value in metadata.items())
    schema = struct.pack("<H", number) + text(kind) + text("jsonschema") + text("{}")
    opened = struct.pack("<HH", number, number) + text(topic) + text(encoding)
    return record(3, schema) + record(4, opened + struct.pack("<I", len(named)) + named)


def logged(number: int, ns: int, data: bytes) -> bytes:
    return record(5, struct.pack("<HIQQ", number, 0, ns, ns) + data)


def chunk(packed: bytes, size: int, compression: str = "zstd", crc: int = 0) -> bytes:
    head = struct.pack("<QQQI", 0, 0, size, crc) + text(compression)
    return record(6, head + struct.pack("<Q", len(packed)) + packed)


def mcap(*records: bytes) -> bytes:
    magic = b"\x89MCAP0\r\n"
    start = record(1, text("") + text(""))
    return magic + start + b"".join(records) + record(15, bytes(4)) + record(2, bytes(20)) + magic


def repeated(data: bytes, times: int) -> bytes:
    """Return a frame of Zstandard of the same bytes again and again."""
    packer = zstandard.ZstdCompressor(level=3).compressobj()
    many = data * (PIECE // len(data))
    out = [packer.compress(many) for _ in range(times * len(data) // len(many))]
    return b"".join((*out, packer.flush()))


def named_pairs(name: str, **pairs: str) -> bytes:
    """Metadata."""
    named = b"".join(text(key) + text(value) for key, value in pairs.items())
    return record(12, text(name) + struct.pack("<I", len(named)) + named)


def pose(k: int) -> bytes:
    """The k-th attitude of a topic in JSON."""
    turn = {"w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0}
    stamp = {"sec": k // 100, "nsec": k % 100 * 10_000_000}
    return json.dumps({"timestamp": stamp, "pose": {"orientation": turn}}).encode()


def poses(count: int) -> bytes:
    """A whole file of attitudes without chunks."""
    return mcap(POSE, *(logged(1, k, pose(k)) for k in range(count)))


POSE = channel(1, "/pose", "foxglove.PoseInFrame", "json")


def mcap_of_messages() -> bytes:
    """Millions of messages in a chunk of kilobytes."""
    one = logged(1, 1, b"{}")
    return mcap(POSE, chunk(repeated(one, 6_000_000), 6_000_000 * len(one)))


def mcap_of_chunks() -> bytes:
    """A chunk of a gigabyte of nothing, many times."""
    one = chunk(repeated(record(99, bytes(PIECE - 9)), 200), 200 * PIECE)
    return mcap(POSE, *[one] * 6)


def mcap_that_lies() -> bytes:
    """A chunk that says it is small, and is not."""
    return mcap(POSE, chunk(repeated(record(99, bytes(PIECE - 9)), 1500), 100))


def mcap_of_lz4() -> bytes:
    """A chunk of lz4 of half a gigabyte."""
    with lz4.frame.LZ4FrameCompressor() as packer:
        parts = [packer.begin(), *(packer.compress(bytes(PIECE)) for _ in range(500))]
        packed = b"".join((*parts, packer.flush()))
    return mcap(POSE, chunk(packed, 500 * PIECE, "lz4"))


def mcap_of_places() -> bytes:
    """Chunks that are tried and fail at each of their bytes, each after it has been unpacked."""
    packed = repeated(record(99, bytes(PIECE - 9)), 32)
    return mcap(POSE, *[chunk(packed, 32 * PIECE, crc=1)] * 12)


def mcap_of_columns() -> bytes:
    """A row of many masses beside many rows of rate: as a table, rows times masses."""
    names = [f"m{k}" for k in range(20_000)]
    ours = {"equipoise.channel": "masses", "equipoise.names": json.dumps(names)}
    masses = json.dumps({f"{name}_m": 0 for name in names}).encode()
    rate = b'{"x_rad_s":0,"y_rad_s":0,"z_rad_s":0}'
    rows = b"".join(logged(2, k, rate) for k in range(20_000))
    return mcap(
        channel(1, "/masses", "equipoise.masses", "json", **ours),
        channel(2, "/rate", "equipoise.rate", "json", **{"equipoise.channel": "rate"}),
        chunk(zstandard.compress(logged(1, 1, masses) + rows), 0),
    )


# --- ROS 1 -------------------------------------------------------------------------------------


def bag_record(data: bytes, **fields: bytes) -> bytes:
    parts = [key.encode() + b"=" + value for key, value in fields.items()]
    header = b"".join(struct.pack("<I", len(part)) + part for part in parts)
    return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data


def number(value: int) -> bytes:
    return struct.pack("<I", value)


def bag(packed: bytes, size: int, form: bytes, entries: int = 1, infos: int = 1) -> bytes:
    """A bag of a chunk, whose index is listed so many times."""
    begin, stamp = 13 + 4096, bytes(8)
    body = bag_record(packed, op=b"\5", compression=form, size=number(size))
    index = {"op": b"\4", "ver": number(1), "conn": number(0), "count": number(entries)}
    body += bag_record((stamp + number(0)) * entries, **index)
    kind = {"topic": b"/imu", "type": b"sensor_msgs/Imu", "md5sum": MD5.encode()}
    said = bag_record(b"", **kind, message_definition=DEFINED.encode())[4:-4]
    known = bag_record(said, op=b"\7", conn=number(0), topic=b"/imu")
    info = bag_record(
        number(0) + number(entries), op=b"\6", ver=number(1), count=number(1),
        chunk_pos=struct.pack("<Q", begin), start_time=stamp, end_time=stamp,
    )  # fmt: skip
    start = bag_record(
        b"", op=b"\3", index_pos=struct.pack("<Q", begin + len(body)), conn_count=number(1),
        chunk_count=number(infos),
    )[:-4]  # fmt: skip
    padding = 4096 - len(start) - 4
    return (
        b"#ROSBAG V2.0\n" + start + number(padding) + bytes(padding) + body + known + infos * info
    )


def bag_of_bz2() -> bytes:
    """A chunk of more than a gigabyte in a few kilobytes."""
    packer = bz2.BZ2Compressor()
    packed = b"".join(packer.compress(bytes(64 * PIECE)) for _ in range(8)) + packer.flush()
    return bag(packed, 512 * PIECE, b"bz2")


def bag_of_streams() -> bytes:
    """A chunk that says it is small, of many streams behind each other."""
    return bag(bz2.compress(bytes(32 * PIECE)) * 40, 1000, b"bz2")


def bag_of_lz4() -> bytes:
    """A chunk that says it is small."""
    return bag(lz4.frame.compress(bytes(500 * PIECE)), 1000, b"lz4")


def bag_of_indexes() -> bytes:
    """An index that is listed again and again."""
    return bag(b"", 0, b"none", 20_000, 1000)


# --- ROS 2 -------------------------------------------------------------------------------------

SCHEMA = """
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,
                    offered_qos_profiles TEXT);
INSERT INTO topics VALUES(1, '/imu', 'sensor_msgs/msg/Imu', 'cdr', '');
"""
TABLE = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data "
ENDLESS = """CREATE VIEW messages AS
    WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n)
    SELECT id, 1 AS topic_id, id AS timestamp, zeroblob(1000) AS data FROM n;"""
COMPUTED = f"""{TABLE} BLOB GENERATED ALWAYS AS (zeroblob(900000000)) VIRTUAL);
               INSERT INTO messages(id, topic_id, timestamp) VALUES(1, 1, 1);"""


def database(path: Path, messages: str, rows: list[bytes] | None = None) -> Path:
    with sqlite3.connect(path) as made:
        made.executescript(SCHEMA + messages)
        for k, data in enumerate(rows or []):
            made.execute("INSERT INTO messages VALUES(?, 1, ?, ?)", (k + 1, k, data))
    made.close()
    return path


def metadata(*names: str, **more: str) -> str:
    listed = "".join(f"\n    - {name}" for name in names)
    said = {"storage_identifier": "sqlite3", "version": "5"} | more
    lines = "".join(f"\n  {key}: {value}" for key, value in said.items())
    return f"rosbag2_bagfile_information:{lines}\n  relative_file_paths:{listed}\n"


def folder(path: Path, said: str) -> Path:
    path.mkdir()
    (path / "metadata.yaml").write_text(said)
    return path


def folders(place: Path) -> dict[str, Path]:
    """Return folders of bags, by what is wrong with them."""
    laughs = "".join(f"l{k + 1}: &l{k + 1} [{', '.join([f'*l{k}'] * 9)}]\n" for k in range(1, 9))
    found = {
        "laughs": folder(place / "laughs", "l1: &l1 [ha, ha]\n" + laughs + metadata("a.db3")),
        "depth": folder(place / "depth", "a: " + "[" * 30_000 + "\n" + metadata("a.db3")),
        "pipe": folder(place / "pipe", metadata("a.db3")),
        "packed file": folder(
            place / "file",
            metadata("a.db3.zstd", compression_mode="FILE", compression_format="zstd"),
        ),
        "packed message": folder(
            place / "message",
            metadata("a.db3", compression_mode="MESSAGE", compression_format="zstd"),
        ),
    }
    os.mkfifo(place / "pipe" / "a.db3")
    (place / "file" / "a.db3.zstd").write_bytes(repeated(bytes(PIECE), 5000))
    database(place / "message" / "a.db3", f"{TABLE} BLOB);", [repeated(bytes(PIECE), 1500)])
    return found


def cdr_of_a_long_tree() -> bytes:
    """A tree of frames that says it has 2^32 - 1 transforms."""
    return b"\0\1\0\0" + struct.pack("<I", 0xFFFFFFFF) + bytes(64)


def tree_of(data: bytes) -> bytes:
    """An MCAP file of a tree of frames, beside messages that are sound."""
    sound = [ROS1.serialize_ros1(message(ROS1, IMU, k), IMU) for k in range(4)]
    return mcap(
        channel(1, "/tf", TREE, "cdr"),
        channel(2, "/imu", IMU, "ros1"),
        logged(1, 1, data),
        *(logged(2, 2, bytes(each)) for each in sound),
    )


# --- Flight controllers ------------------------------------------------------------------------


def ulog_of_arrays() -> bytes:
    """Arrays of layouts of arrays of layouts: more columns than there are atoms."""
    out = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0) + reported(b"B", bytes(40))
    names = ["vehicle_attitude", "b", "c", "d"]
    for outer, inner in zip(names, [*names[1:], "uint8_t"], strict=True):
        out += reported(b"F", f"{outer}:uint64_t timestamp;{inner}[60000] q;".encode())
    out += reported(b"A", struct.pack("<BH", 0, 0) + b"vehicle_attitude")
    return out + reported(b"D", struct.pack("<H", 0) + bytes(1000)) * 3


def dataflash_of_instances(count: int) -> bytes:
    """Instruments numbered by a fraction: each row an instance of its own."""
    columns = "TimeUS,I,GyrX,GyrY,GyrZ"
    out = layout(0x80, 89, "FMT", "BBnNZ", "Type,Length,Name,Format,Columns")
    out += layout(1, 3 + 24, "GYR", "Qffff", columns)
    rows = (struct.pack("<Q4f", 10_000 * k, k / 7, 0.1, 0.2, 0.3) for k in range(count))
    return out + b"".join(b"\xa3\x95\x01" + row for row in rows)
