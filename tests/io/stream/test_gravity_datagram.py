"""The datagram: bytes by hand, there and back, and what a receiver takes."""

import struct
from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.stream.gravity_datagram import (
    FIELDS,
    OFFSETS,
    SIZE,
    packed,
    replaces,
    unpacked,
    weight_at,
)
from equipoise.io.stream.gravity_message import PARTS, message_of
from equipoise.model.errors import InputError
from equipoise.model.gravity_torque import GravityTorque, TorqueStatus

NUMBERS = [np.array([k + 0.1, -k - 0.2, k * 1e-7 + 1e-9]) for k in range(5)]
CONTENT = GravityTorque(12.5, 0.0625, *NUMBERS, TorqueStatus.USABLE)
SENT_NS = 1_790_000_000_123_456_789


def test_its_bytes_are_those_of_the_page():
    """Written out from docs/feed-forward.md: 168 bytes, little endian."""
    data = packed(CONTENT, 2**32 + 7, SENT_NS)
    by_hand = struct.pack("<4sHHIIdQdd", b"EQGT", 1, 168, 7, 1, 12.5, SENT_NS, 0.0625, 2.0)
    by_hand += struct.pack("<15d", *np.concatenate(NUMBERS))
    assert data == by_hand
    assert len(data) == SIZE == 168


def test_no_field_needs_a_gap_before_it():
    for field, offset in zip(FIELDS, OFFSETS, strict=True):
        assert offset % (field.size // field.elements) == 0


def test_it_comes_back_to_the_last_bit():
    found = unpacked(packed(CONTENT, 7, SENT_NS))
    assert (found.sequence, found.host_time_ns, found.hold) == (7, SENT_NS, 2.0)
    assert packed(found.content, 7, SENT_NS) == packed(CONTENT, 7, SENT_NS)
    assert found.content.status is TorqueStatus.USABLE


@pytest.mark.parametrize(
    "spoilt",
    [
        b"",
        packed(CONTENT, 0, SENT_NS)[:-1],
        b"XXXX" + packed(CONTENT, 0, SENT_NS)[4:],
        packed(CONTENT, 0, SENT_NS)[:4] + struct.pack("<H", 2) + packed(CONTENT, 0, SENT_NS)[6:],
        packed(CONTENT, 0, SENT_NS) + b"\0",
        packed(CONTENT, 0, SENT_NS)[:12] + struct.pack("<I", 3) + packed(CONTENT, 0, SENT_NS)[16:],
        packed(replace(CONTENT, torque=np.array([0.0, np.nan, 0.0])), 0, SENT_NS),
        packed(replace(CONTENT, lead=np.inf), 0, SENT_NS),
    ],
    ids=["empty", "short", "foreign", "version", "long", "status", "nan", "infinite"],
)
def test_what_is_no_datagram_is_refused(spoilt):
    with pytest.raises(InputError, match=r"^datagram: found "):
        unpacked(spoilt)


def received(sequence, status=TorqueStatus.USABLE):
    return unpacked(packed(replace(CONTENT, status=status), sequence, SENT_NS))


@pytest.mark.parametrize(
    ("found", "last", "age", "taken"),
    [
        (received(0), None, np.inf, True),
        (received(8), received(7), 0.1, True),
        (received(7), received(7), 0.1, False),  # twice the same
        (received(6), received(7), 0.1, False),  # overtaken on its way
        (received(0), received(2**32 - 1), 0.1, True),  # across the end of 32 bits
        (received(2**32 - 1), received(0), 0.1, False),
        (received(0), received(5000), 2.1, True),  # the sender has begun anew
        (received(0), received(5000), 1.9, False),
        (received(8, TorqueStatus.STALE), received(7), 0.1, False),
        (received(8, TorqueStatus.NOT_USABLE), None, np.inf, False),
    ],
)
def test_a_receiver_takes_what_is_usable_and_newer(found, last, age, taken):
    assert replaces(found, last, age) is taken


def test_a_torque_fades_once_it_holds_no_more():
    """2 s in full, then 10 s less and less."""
    shares = [weight_at(age, 2.0) for age in (0.0, 2.0, 7.0, 12.0, 99.0)]
    assert shares == [1.0, 1.0, 0.5, 0.0, 0.0]


def test_the_message_has_each_number_under_its_name():
    message = message_of(CONTENT)
    assert message.keys() == PARTS.keys()
    assert message["status"] == "usable"
    assert message["bench_time_s"] == 12.5
    assert message["torque_N_m"] == NUMBERS[0].tolist()
    assert message["first_moment_sd_kg_m"] == NUMBERS[3].tolist()
    assert message["gravity_m_s2"] == NUMBERS[4].tolist()
