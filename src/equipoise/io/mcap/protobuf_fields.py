"""The fields of a protobuf message, without its schema's library.

Wire format (public: protobuf.dev/programming-guides/encoding): a message is a row of fields, each
a tag (number * 8 + wire type, as a varint) and a value: 0 varint, 1 eight bytes, 2 a length and so
many bytes, 5 four bytes. A field that is zero is left out. Of a repeated field the last is taken.
"""

import struct
from collections.abc import Mapping

Value = int | bytes
VARINT, EIGHT, BYTES, FOUR = 0, 1, 2, 5
LONGEST = 10  # bytes of a varint of 64 bits


def fields(data: bytes) -> Mapping[int, Value]:
    """Return a message's fields by number, fixed ones as bytes; ValueError if it is none."""
    found: dict[int, Value] = {}
    at = 0
    while at < len(data):
        tag, at = _varint(data, at)
        number, kind = tag >> 3, tag & 7
        if kind == VARINT:
            found[number], at = _varint(data, at)
            continue
        if kind == BYTES:
            size, at = _varint(data, at)
        elif kind in (EIGHT, FOUR):
            size = 8 if kind == EIGHT else 4
        else:
            raise ValueError(f"wire type {kind}")
        if at + size > len(data):
            raise ValueError("a field beyond the message's end")
        found[number] = data[at : at + size]
        at += size
    return found


def message(found: Mapping[int, Value], number: int) -> Mapping[int, Value]:
    """Return the fields of a message within a message; none if it was left out."""
    inner = found.get(number, b"")
    if not isinstance(inner, bytes):
        raise ValueError(f"field {number} is no message")
    return fields(inner)


def double(found: Mapping[int, Value], number: int) -> float:
    """Return a field that is a double; 0 if it was left out."""
    value = found.get(number, bytes(8))
    if not isinstance(value, bytes) or len(value) != 8:
        raise ValueError(f"field {number} is no double")
    return struct.unpack("<d", value)[0]


def whole(found: Mapping[int, Value], number: int) -> int:
    """Return a field that is a whole number; 0 if it was left out."""
    value = found.get(number, 0)
    if not isinstance(value, int):
        raise ValueError(f"field {number} is no whole number")
    return value


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """Return a number in groups of seven bits, least first, and where it ends."""
    value = 0
    for k in range(LONGEST):
        if at + k >= len(data):
            break
        value |= (data[at + k] & 0x7F) << 7 * k
        if data[at + k] < 0x80:
            return value, at + k + 1
    raise ValueError("a number without an end")
