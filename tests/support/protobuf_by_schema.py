"""A protobuf message read by the schema that stands beside it in a file, nothing known otherwise.

A FileDescriptorSet is itself protobuf (public: descriptor.proto): file 1; of a file package 2,
message 4; of a message name 1, field 2, nested message 3; of a field name 1, number 3, label 4
(3: repeated), type 5, type name 6.
"""

import struct

DOUBLE, STRING, MESSAGE, BYTES, BOOL = 1, 9, 11, 12, 8
REPEATED = 3


def varint(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        value |= (byte & 0x7F) << shift
        at, shift = at + 1, shift + 7
        if byte < 0x80:
            return value, at


def wire(data):
    """Return a message's fields in order: number, value."""
    found, at = [], 0
    while at < len(data):
        tag, at = varint(data, at)
        kind = tag & 7
        if kind == 0:
            value, at = varint(data, at)
        else:
            size, at = varint(data, at) if kind == 2 else ({1: 8, 5: 4}[kind], at)
            value, at = data[at : at + size], at + size
            assert len(value) == size
        found.append((tag >> 3, value))
    return found


def every(data, number):
    return [value for key, value in wire(data) if key == number]


def last(data, number, otherwise=b""):
    return (every(data, number) or [otherwise])[-1]


def messages_of(schema):
    """Return the fields of every type of a FileDescriptorSet, by its full name."""
    types = {}

    def add(outer, data):
        name = f"{outer}.{last(data, 1).decode()}"
        types[name] = {
            last(f, 3): (last(f, 1).decode(), last(f, 4), last(f, 5), last(f, 6).decode())
            for f in every(data, 2)
        }
        for nested in every(data, 3):
            add(name, nested)

    for file in every(schema, 1):
        for message in every(file, 4):
            add(f".{last(file, 2).decode()}", message)
    return types


def decoded(schema, name, data):
    """Return a message as nested dictionaries; a field that the schema lacks is an error."""
    return _decoded(messages_of(schema), f".{name}", data)


def _decoded(types, name, data):
    found = {field: [] for field, label, _, _ in types[name].values() if label == REPEATED}
    for number, raw in wire(data):
        field, label, kind, inner = types[name][number]
        value = raw
        if kind == MESSAGE:
            value = _decoded(types, inner, raw)
        elif kind == DOUBLE:
            (value,) = struct.unpack("<d", raw)
        elif kind == STRING:
            value = raw.decode()
        if label == REPEATED:
            found[field].append(value)
        else:
            found[field] = value
    return found
