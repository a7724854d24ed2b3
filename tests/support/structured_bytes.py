"""Valid files with something wrong in their structure: a fuzzer that knows what files are made of.

Random bytes seldom get past a checksum or a mark. Here a file is cut into what it consists of
(rows and cells, keys and values, records, members, columns), some of that is changed, and the
whole is put together as a writer would.
"""

import contextlib
import gzip
import io
import json
import sqlite3
import struct
import tempfile
import tomllib
import zipfile
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import zstandard

from tests.support.mutated_bytes import mutated

Rng = np.random.Generator
Shake = Callable[[bytes, Rng], bytes]
NUMBERS = (
    0.0, -0.0, 1e-320, 1e-12, 1e6, 1e9, 1.7e9, 1e15, 1e160, 1.7e308, -1e308, float("inf"),
    float("nan"), 2**31, 2**63, 2**64, -1,
)  # fmt: skip
TEXTS = (
    "", " ", "nan", "1e999", "-", "=1+1", "\x1b[31m", "\u202e", "[/red]", "../..", "\x00", "é",
    "1,5", "0x10", "1_000", "\uff12", "2024-05-03T14:11:40.123",
    "99:99:99", "1.0D+400", "a" * 5000, "0" * 400, "time_s", "q_w", '"', "''", "#", "%",
)  # fmt: skip
MOST_ROWS, MOST_TIMES, MOST_DEEP = 3000, 200, 2000
REGULAR = 1_000_000  # bytes of a file
BAG_HEAD, MCAP_HEAD, ULOG_HEAD, PCAP_HEAD, MAT_HEAD = 13, 8, 16, 24, 128


def one(rng: Rng, among: Sequence[Any]) -> Any:
    """Return one of several."""
    return among[int(rng.integers(len(among)))]


def shaken(parts: list[Any], rng: Rng, change: Callable[[Any], Any]) -> list[Any]:
    """Return parts of which one is changed, lost, there twice or often, or in another place."""
    at = int(rng.integers(len(parts) + 1))
    here = parts[at : at + 1]
    if not here:
        return parts
    rest = [*parts[:at], *parts[at + 1 :]]
    to = int(rng.integers(len(rest) + 1))
    times = int(rng.integers(2, MOST_TIMES))
    return one(
        rng,
        (
            lambda: [*parts[:at], change(here[0]), *parts[at + 1 :]],
            lambda: [*parts[:at], change(here[0]), *parts[at + 1 :]],
            lambda: rest,
            lambda: [*parts[: at + 1], *parts[at:]],
            lambda: [*parts[:at], *here * times, *parts[at + 1 :]],
            lambda: [*rest[:to], *here, *rest[to:]],
            lambda: parts[:at],
        ),
    )()


def several(shake: Shake) -> Shake:
    """Return what makes one to four changes, none of which makes a file too long."""

    def changes(content: bytes, rng: Rng) -> bytes:
        for _ in range(int(rng.integers(1, 5))):
            made = shake(content, rng)
            content = made if len(made) <= REGULAR else content
        return content

    return changes


# --- Tables --------------------------------------------------------------------------------------


def value(rng: Rng) -> Any:
    """Return a number or a text that few expect."""
    return one(rng, NUMBERS) if rng.random() < 0.5 else one(rng, TEXTS)


def table(content: bytes, rng: Rng) -> bytes:
    """Change cells, rows, columns, the separator or the letters of a text."""
    text = content.decode("utf-8", "surrogateescape")
    rows = [line.split(",") for line in text.split("\n")]
    kind = rng.random()
    if kind < 0.4:
        rows = shaken(rows, rng, lambda row: shaken(row, rng, lambda _: str(value(rng))))
    elif kind < 0.6:
        which, width = value(rng), max(1, *map(len, rows))
        at = int(rng.integers(width))
        rows = [[*row[:at], str(which), *row[at + 1 :]] if k else row for k, row in enumerate(rows)]
    elif kind < 0.75:
        at = int(rng.integers(max(1, *map(len, rows))))
        to = int(rng.integers(max(1, *map(len, rows))))
        rows = [shifted(row, at, to) for row in rows]
    elif kind < 0.85:
        rows = [*rows[:1], *rows[1:] * int(rng.integers(1, 2 + MOST_ROWS // len(rows)))]
    else:
        rows = shaken(rows, rng, lambda _: one(rng, ([], [""], ["#"], ["a"] * 3000, ["1;2"])))
    separator = one(rng, (",", ",", ",", ",", ";", "\t", " ", ", ", ",,", '","', "|"))
    end = one(rng, ("\n", "\n", "\n", "\r\n", "\r", "\n\n", "\u2028"))
    code = one(rng, ("utf-8", "utf-8", "utf-8", "utf-16", "utf-16-le", "latin-1", "utf-8-sig"))
    return end.join(map(separator.join, rows)).encode(code, "replace")


def shifted(row: list[str], at: int, to: int) -> list[str]:
    """Return a row with one cell in another place."""
    cells = [*row]
    if at < len(cells):
        cells.insert(to, cells.pop(at))
    return cells


def parquet(_content: bytes, rng: Rng) -> bytes:
    """Draw a table: any types under the names of a recording."""
    rows = int(rng.integers(0, 50))
    names = ["time_s", *(f"omega_{k}_rad_s" for k in "xyz"), *(f"q_{k}" for k in "wxyz"), "x"]
    names = [one(rng, names) if rng.random() < 0.1 else name for name in names]
    columns = [column(rng, rows) for _ in names]
    stream = io.BytesIO()
    settings = {
        "compression": one(rng, ("snappy", "zstd", "gzip", "none")),
        "use_dictionary": bool(rng.integers(2)),
        "store_schema": bool(rng.integers(2)),
        "row_group_size": int(rng.integers(1, 60)),
    }
    pq.write_table(pa.table(columns, names=names), stream, **settings)
    return mutated(stream.getvalue(), rng) if rng.random() < 0.3 else stream.getvalue()


def column(rng: Rng, rows: int) -> pa.Array:
    """Draw a column of any type."""
    numbers = [None if rng.random() < 0.05 else 0.01 * k for k in range(rows)]
    made = one(
        rng,
        (
            lambda: pa.array(numbers, pa.float64()),
            lambda: pa.array(numbers, pa.float64()),
            lambda: pa.array(numbers, pa.float32()),
            lambda: pa.array([one(rng, NUMBERS[:13]) for _ in range(rows)], pa.float64()),
            lambda: pa.array(range(rows), pa.int64()),
            lambda: pa.array([one(rng, (0, 2**63 - 1, -(2**63))) for _ in range(rows)], pa.int64()),
            lambda: pa.array([str(value(rng)) for _ in range(rows)]),
            lambda: pa.array([b"\xff"] * rows, pa.binary()),
            lambda: pa.array([[1.0] * 3] * rows),
            lambda: pa.array([{"a": 1}] * rows),
            lambda: pa.nulls(rows),
            lambda: pa.array([bool(k % 2) for k in range(rows)]),
            lambda: pa.array(range(rows), pa.timestamp("ns")),
            lambda: pa.array([str(k) for k in range(rows)]).dictionary_encode(),
        ),
    )
    return made()


# --- Keys and values -----------------------------------------------------------------------------


def tree(root: Any, rng: Rng) -> Any:
    """Return a document with one node changed: another type, a limit, lost, twice, far too deep."""
    if isinstance(root, dict) and root and rng.random() < 0.85:
        name = one(rng, list(root))
        kind = rng.random()
        if kind < 0.12:
            return {key: each for key, each in root.items() if key != name}
        if kind < 0.2:
            return {**root, str(one(rng, TEXTS)) or "x": root[name]}
        return {**root, name: tree(root[name], rng)}
    if isinstance(root, list) and root and rng.random() < 0.85:
        return shaken(root, rng, lambda each: tree(each, rng))
    return odd(root, rng)


def odd(was: Any, rng: Rng) -> Any:
    """Return something in the place of a value."""
    deep: Any = was
    kind = rng.random()
    if kind < 0.08:
        for _ in range(int(rng.integers(1, MOST_DEEP))):
            deep = one(rng, ([deep], {"a": deep}))
        return deep
    if kind < 0.5 and isinstance(was, int | float):
        return one(rng, NUMBERS)
    return one(
        rng, (value(rng), [], {}, True, None, [was], [was] * MOST_ROWS, {"a": was}, "x" * 9999)
    )


def toml(content: bytes, rng: Rng) -> bytes:
    """Change keys and values of a TOML file."""
    try:
        keys = tree(tomllib.loads(content.decode()), rng)
        return "".join(f"{json.dumps(k)} = {inline(v)}\n" for k, v in keys.items()).encode()
    except (ValueError, AttributeError, RecursionError):  # no table any more, or too deep to write
        return mutated(content, rng)


def inline(found: Any) -> str:
    """Return a value as TOML in one line."""
    if isinstance(found, dict):
        return "{" + ", ".join(f"{json.dumps(k)} = {inline(v)}" for k, v in found.items()) + "}"
    if isinstance(found, list):
        return "[" + ", ".join(map(inline, found)) + "]"
    if isinstance(found, float):
        return repr(found)
    return '""' if found is None else json.dumps(found, default=str)


def document(content: bytes, rng: Rng) -> bytes:
    """Change keys and values of a JSON document."""
    try:
        return json.dumps(tree(json.loads(content), rng)).encode()
    except (ValueError, RecursionError):
        return mutated(content, rng)


# --- Records -------------------------------------------------------------------------------------


def records(begin: int, split: Callable[[bytes], list[tuple[bytes, bytes]]]) -> Shake:
    """Return what changes the records behind a head of so many bytes; each is a head and a body."""

    def shake(content: bytes, rng: Rng) -> bytes:
        parts = split(content[begin:])

        def change(part: tuple[bytes, bytes]) -> tuple[bytes, bytes]:
            head, body = part
            kind = rng.random()
            if kind < 0.3:
                return mutated(head, rng), body
            if kind < 0.4:
                return head, bytes(int(rng.integers(100_000)))
            return head, mutated(body, rng)

        whole = b"".join(head + body for head, body in shaken(parts, rng, change))
        return content[:begin] + whole

    return several(shake)


def split_by(form: str, size: Callable[[tuple[int, ...]], int]) -> Callable[[bytes], list[Any]]:
    """Return what cuts bytes into records whose head is a structure and says the body's size."""
    head = struct.Struct(form)

    def split(content: bytes) -> list[tuple[bytes, bytes]]:
        parts, at = [], 0
        while at + head.size <= len(content):
            length = max(size(head.unpack_from(content, at)), 0)
            stop = at + head.size + length
            parts.append((content[at : at + head.size], content[at + head.size : stop]))
            at = stop
        return [*parts, (content[at:], b"")]

    return split


def bag_records(content: bytes) -> list[tuple[bytes, bytes]]:
    """Cut a bag of ROS 1: length and head, length and data."""
    parts, at = [], 0
    while at + 8 <= len(content):
        size = int.from_bytes(content[at : at + 4], "little")
        middle = at + 4 + size
        length = int.from_bytes(content[middle : middle + 4], "little")
        parts.append((content[at : middle + 4], content[middle + 4 : middle + 4 + length]))
        at = middle + 4 + length
    return [*parts, (content[at:], b"")]


def marked(mark: bytes) -> Shake:
    """Return what changes what stands between marks."""

    def shake(content: bytes, rng: Rng) -> bytes:
        return mark.join(shaken(content.split(mark), rng, lambda part: mutated(part, rng)))

    return several(shake)


def matrices(content: bytes, rng: Rng) -> bytes:
    """Change the elements of a MAT file of version 5, also within compressed ones."""
    split = split_by("<II", lambda head: head[1])

    def change(part: tuple[bytes, bytes]) -> tuple[bytes, bytes]:
        head, body = part
        inside = zlib.decompress(body) if head[:1] == b"\x0f" else body
        shake = records(8, split_by("<II", lambda inner: inner[1] + -inner[1] % 8))
        shook = shake(inside, rng)
        packed = zlib.compress(shook) if head[:1] == b"\x0f" else shook
        return head[:4] + struct.pack("<I", len(packed)), packed

    parts = shaken(split(content[MAT_HEAD:]), rng, lambda part: change(part) if part[1] else part)
    return content[:MAT_HEAD] + b"".join(head + body for head, body in parts)


def hdf5(_content: bytes, rng: Rng) -> bytes:
    """Draw a MAT file of version 7.3: data sets of any type and size, groups, links, attributes."""
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=512) as file:
        for name in ("time_s", *(f"omega_{k}_rad_s" for k in "xyz"), "#refs#", "other"):
            fill(file, name, rng)
    whole = b"MATLAB 7.3 MAT-file".ljust(512, b"\0") + stream.getvalue()[512:]
    return mutated(whole, rng) if rng.random() < 0.3 else whole


def fill(group: Any, name: str, rng: Rng, deep: int = 0) -> None:
    """Put something under a name."""
    shape = one(rng, ((1, 20), (1, 20), (20, 1), (20,), (), (0, 0), (3, 20), (1, 10**9), (2, 2, 2)))
    kind = one(rng, ("f8", "f8", "f4", "i1", "u8", "b1", "S5", "c16", h5py.string_dtype()))
    if rng.random() < 0.15 and deep < 5:
        inner = group.create_group(name)
        inner.attrs["MATLAB_class"] = np.bytes_("struct")
        for each in "abc":
            fill(inner, each, rng, deep + 1)
        inner["self"] = h5py.SoftLink("/")
    elif rng.random() < 0.1:
        group[name] = one(rng, (h5py.SoftLink("/x"), h5py.ExternalLink("other.h5", "/"), group))
    else:
        chunks = (1, 10) if shape == (1, 10**9) else None
        item = group.create_dataset(name, shape, kind, chunks=chunks)
        item.attrs["MATLAB_class"] = one(rng, (np.bytes_("double"), "double", 5, np.bytes_("cell")))


def database(content: bytes, rng: Rng) -> bytes:
    """Change rows and tables of a bag of ROS 2."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bag.db3"
        path.write_bytes(content)
        with contextlib.closing(sqlite3.connect(path)) as base, contextlib.suppress(sqlite3.Error):
            base.execute(one(rng, STATEMENTS), ())
            base.commit()
        return mutated(path.read_bytes(), rng) if rng.random() < 0.3 else path.read_bytes()


STATEMENTS = (
    "UPDATE messages SET data = zeroblob(100)", "UPDATE messages SET data = NULL",
    "UPDATE messages SET data = substr(data, 1, 30)", "UPDATE messages SET timestamp = -1",
    "UPDATE messages SET timestamp = 'x'", "UPDATE messages SET timestamp = 9e18",
    "UPDATE messages SET topic_id = 77", "UPDATE topics SET type = 'x'",
    "UPDATE topics SET type = 'sensor_msgs/msg/Image'", "UPDATE topics SET name = NULL",
    "UPDATE topics SET serialization_format = 'x'", "DELETE FROM messages", "DELETE FROM topics",
    "DROP TABLE messages", "DROP TABLE topics", "ALTER TABLE messages DROP COLUMN data",
    "ALTER TABLE topics RENAME TO subjects", "CREATE VIEW more AS SELECT * FROM messages",
    "INSERT INTO messages SELECT NULL, 1, timestamp + 1, data FROM messages",
    "UPDATE messages SET data = zeroblob(10000000)",
)  # fmt: skip


# --- Files within files --------------------------------------------------------------------------


def members(content: bytes, rng: Rng) -> bytes:
    """Change the files of an archive: texts in them, their names, how many there are."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        inside = [(name, archive.read(name)) for name in archive.namelist()]

    def change(part: tuple[str, bytes]) -> tuple[str, bytes]:
        name, data = part
        if rng.random() < 0.15:
            return str(one(rng, TEXTS)) or "x", data
        return name, (markup(data, rng) if data.startswith(b"<") else table(data, rng))

    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in dict(shaken(inside, rng, change)).items():
            archive.writestr(name.replace("\0", "0"), data)
    return mutated(stream.getvalue(), rng) if rng.random() < 0.2 else stream.getvalue()


markup = marked(b"<")
inflate: dict[str, tuple[Callable[[bytes], bytes], Callable[[bytes], bytes]]] = {
    "gzip": (gzip.decompress, gzip.compress),
    "Zstandard": (zstandard.decompress, zstandard.compress),
}


def packed(kind: str) -> Shake:
    """Return what changes the table in a compressed file, or how it is packed."""
    unpack, pack = inflate[kind]

    def shake(content: bytes, rng: Rng) -> bytes:
        inside = several(table)(unpack(content), rng)
        way = rng.random()
        if way < 0.1:
            return pack(pack(inside))
        if way < 0.2:
            return pack(inside) + pack(inside * int(rng.integers(1, 30)))
        return mutated(pack(inside), rng) if way < 0.35 else pack(inside)

    return shake


lines = marked(b"\n")
SHAKES: dict[str, Shake] = {
    "CSV": several(table),
    "MCAP": records(MCAP_HEAD, split_by("<BQ", lambda head: head[1])),
    "MAT": matrices,
    "MAT of version 4": records(0, split_by("<5i", lambda head: 8 * head[1] * head[2] + head[4])),
    "MAT of version 7.3": hdf5,
    "Excel": members,
    "zip": members,
    "gzip": packed("gzip"),
    "Zstandard": packed("Zstandard"),
    "Parquet": parquet,
    "bag of ROS 1": records(BAG_HEAD, bag_records),
    "bag of ROS 2": database,
    "ULog": records(ULOG_HEAD, split_by("<HB", lambda head: head[0])),
    "log of ArduPilot": marked(b"\xa3\x95"),
    "log of MAVLink": marked(b"\xfd"),
    "telemetry log": marked(b"\xfd"),
    "log of VectorNav": lines,
    "pcap": records(PCAP_HEAD, split_by("<4I", lambda head: head[2])),
    "pcapng": records(0, split_by("<II", lambda head: head[1] - 8)),
} | dict.fromkeys(("testbed", "plan", "column map", "session", "camera"), several(toml))
