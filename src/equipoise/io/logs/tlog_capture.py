"""Telemetry logs of MAVLink (.tlog), as ground stations write them.

    u64 microseconds since 1970, big endian; a frame of MAVLink 1 or 2; and so on

    frame of version 1   FE, length n, ...            8 + n bytes
    frame of version 2   FD, length n, flags, ...    12 + n bytes, 13 more if flag 1 (signed)

Source: mavlink.io, "Serialization", and pymavlink's mavlogfile. Where no frame follows a time,
bytes are left out up to the next pair that makes sense.
"""

import struct
from collections.abc import Iterator

from equipoise.io.logs.byte_capture import CHUNK, Piece, Readable
from equipoise.model.units import US

STAMP = 8  # bytes
LONGEST = STAMP + 12 + 255 + 13  # bytes of a time and its frame
OVERHEAD = {0xFE: 8, 0xFD: 12}  # bytes around the payload
SIGNED, SIGNATURE = 1, 13  # flag; bytes
EARLIEST, LATEST = 946_684_800.0, 4_102_444_800.0  # s since 1970: 2000 and 2100, chosen
NEAR = 3 * 86_400.0  # s, between two times of a log, as pymavlink has it


def is_tlog(beginning: bytes) -> bool:
    """Say whether a file begins with a time and a frame."""
    return _size(beginning, 0, None) > 0


def tlog_pieces(file: Readable) -> Iterator[Piece]:
    """Yield the frames, each when it arrived."""
    data, at, last = b"", 0, None
    skipped = 0  # bytes, since the last frame
    while True:
        if len(data) - at < LONGEST:
            data, at = data[at:] + file.read(CHUNK), 0
        if at >= len(data):
            break
        size = _size(data, at, last)
        if size == 0:
            skipped, at = skipped + 1, at + 1
            continue
        if skipped:
            yield Piece(b"", last, broken=True)
            skipped = 0
        last = _time(data, at)
        yield Piece(data[at + STAMP : at + size], last)
        at += size
    if skipped:
        yield Piece(b"", last, broken=True)


def _size(data: bytes, at: int, last: float | None) -> int:
    """Return how many bytes a time and its frame take; 0 if there are none."""
    begin = at + STAMP
    if len(data) < begin + 3 or data[begin] not in OVERHEAD:
        return 0
    t = _time(data, at)
    if not (EARLIEST < t < LATEST if last is None else abs(t - last) < NEAR):
        return 0
    signed = data[begin] == 0xFD and data[begin + 2] & SIGNED
    size = STAMP + OVERHEAD[data[begin]] + data[begin + 1] + (SIGNATURE if signed else 0)
    return size if at + size <= len(data) else 0


def _time(data: bytes, at: int) -> float:
    (microseconds,) = struct.unpack_from(">Q", data, at)
    return float(microseconds) * US
