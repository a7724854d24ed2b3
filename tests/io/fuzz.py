"""Parsers of logs as fuzz targets: each takes any bytes; only the declared errors may come out."""

import contextlib
from collections.abc import Callable

from equipoise.io.mat_elements import vectors
from equipoise.io.mcap_recording import read_mcap
from equipoise.io.mcap_salvage import salvaged
from equipoise.io.protobuf_fields import fields
from equipoise.io.recording_reading import recording_of
from equipoise.io.ulog_file import read_ulog
from equipoise.model.errors import InputError


def mcap_bytes(content: bytes) -> None:
    """A file as ``read_recording`` takes it."""
    with contextlib.suppress(InputError):
        recording_of(*read_mcap(content, "fuzz"))


def salvage_bytes(content: bytes) -> None:
    """Never raises."""
    found = salvaged(content, "fuzz")
    assert found.lost_bytes <= len(content)


def protobuf_bytes(content: bytes) -> None:
    with contextlib.suppress(ValueError):
        fields(content)


def mat_bytes(content: bytes) -> None:
    with contextlib.suppress(ValueError):
        vectors(content)


def ulog_bytes(content: bytes) -> None:
    with contextlib.suppress(InputError):
        recording_of(*read_ulog(b"ULog\x01\x12\x35\x01" + bytes(8) + content, "fuzz"))


PARSERS: list[tuple[str, Callable[[bytes], None]]] = [
    ("mcap", mcap_bytes),
    ("mcap salvage", salvage_bytes),
    ("protobuf", protobuf_bytes),
    ("mat", mat_bytes),
    ("ulog", ulog_bytes),
]
