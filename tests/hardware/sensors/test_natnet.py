"""NatNet: frames by hand of both layouts, frames of space, what is no row, names."""

import math
import struct
import sys
from dataclasses import replace

import numpy as np
import pytest

from equipoise.hardware.emulated.natnet import EmulatedNatNet
from equipoise.hardware.links.frame_transform import placed
from equipoise.hardware.sensors.natnet import NatNet
from equipoise.maths.attitude import to_matrix
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port
from equipoise.model.recording import Recording, Samples
from tests.support.sensor_units import unit

HALF = math.sqrt(0.5)
TURN = (0.0, HALF, 0.0, HALF)  # x y z w: a quarter turn about y


def ints(*values):
    return b"".join(value.to_bytes(4, "little", signed=True) for value in values)


def floats(*values):
    return struct.pack(f"<{len(values)}f", *values)


def body(number, turn, flags=1):
    """Return a rigid body: id, position, quaternion x y z w, mean error, flags; 38 bytes."""
    found = ints(number) + floats(1, 2, 3, *turn, 1e-4) + flags.to_bytes(2, "little")
    assert len(found) == 38
    return found


def datagram(number, bodies, stamp=12.5, sizes=False):
    """Return a frame with something in every section.

    By hand from the SDK's PacketClient: marker sets (a name, one marker), one other marker, rigid
    bodies, a skeleton of one bone, from 4.1 on an asset, a labelled marker of 26 bytes, a force
    plate of two channels of one and two numbers, a device of none; then timecode, time, three
    times of cameras, from 4.1 on a precise time, flags, end.
    """
    channels = ints(9, 2, 1) + floats(1) + ints(2) + floats(1, 2)
    sections = [
        (1, b"cube\0" + ints(1) + floats(1, 2, 3)),
        (1, floats(4, 5, 6)),
        (len(bodies), b"".join(bodies)),
        (1, ints(3, 1) + body(1, (1, 0, 0, 0))),
        (1, ints(4, 0, 0)),
        (1, ints(8) + floats(1, 2, 3, 0.01) + b"\x02\x00" + floats(1e-4)),
        (1, channels),
        (1, ints(10, 0)),
    ]
    if not sizes:
        del sections[4]
    payload = ints(number)
    for count, data in sections:
        payload += ints(count) + (ints(len(data)) if sizes else b"") + data
    payload += ints(0, 0) + struct.pack("<d", stamp) + bytes(24) + (bytes(8) if sizes else b"")
    payload += b"\0\0" + ints(0)
    return struct.pack("<HH", 7, len(payload)) + payload


@pytest.mark.parametrize("sizes", [False, True], ids=["3.1", "4.1"])
def test_a_frame_by_hand_is_understood(sizes):
    driver = NatNet(unit("natnet"))
    (row,) = driver.feed(datagram(42, [body(2, (1, 0, 0, 0)), body(1, TURN)], 12.5, sizes))
    assert row.values == pytest.approx((HALF, 0, HALF, 0), abs=1e-7)
    assert (row.channel, row.number, row.stamp) == ("attitude", 42, 12.5)


def test_a_turn_about_the_vertical_by_hand():
    """Y is up in Motive, as set by default, so a quarter turn about y is one about our z.

    Motive's x is ours, and its z our -y: a body that pointed along x points along -z there, so
    along our y.
    """
    device = unit("natnet", "y_up")
    (row,) = NatNet(device).feed(datagram(1, [body(1, TURN)]))
    turn = to_matrix(placed(device, "attitude", np.array(row.values)))
    np.testing.assert_allclose(turn @ [1, 0, 0], [0, 1, 0], atol=1e-6)
    np.testing.assert_allclose(turn @ [0, 1, 0], [0, 0, 1], atol=1e-6)
    above = unit("natnet", "z_up")
    (row,) = NatNet(above).feed(datagram(1, [body(1, (0, 0, HALF, HALF))]))
    turn = to_matrix(placed(above, "attitude", np.array(row.values)))
    np.testing.assert_allclose(turn @ [1, 0, 0], [0, 1, 0], atol=1e-6)


@pytest.mark.parametrize("sizes", [False, True])
def test_what_is_no_row_is_counted(sizes):
    driver = NatNet(unit("natnet"))
    good = datagram(1, [body(1, TURN)], 1.0, sizes)
    for lost in ([body(1, TURN, flags=0)], [body(2, TURN)], []):
        assert driver.feed(datagram(1, lost, 1.0, sizes)) == []
    assert driver.feed(struct.pack("<HH", 8, 3) + b"hi\0") == []
    assert driver.counts.foreign == 4
    one = ints(1) + (ints(38) if sizes else b"") + body(1, TURN)
    assert one in good
    broken = [good[:-1], good[:3], struct.pack("<HH", 7, len(good) - 5) + good[4:-1],
              datagram(1, [body(1, (1, 1, 0, 0))], 1.0, sizes),
              datagram(1, [body(1, TURN)], math.nan, sizes),
              good.replace(one, ints(2**31 - 1) + one[4:])]  # fmt: skip
    for each in broken:
        assert driver.feed(each) == []
    assert driver.counts.corrupt == len(broken)
    assert len(driver.feed(good)) == 1


def test_a_body_is_found_by_its_name():
    """It asks who is there, for names, and then only says that it is alive."""
    device = replace(unit("natnet", "z_up", body="cube"), port=Port("udpout:motive:1510"))
    driver, motive = NatNet(device), EmulatedNatNet(device)
    t = np.array([0.0])
    rows = Recording(Samples(t, np.array([[HALF, 0, HALF, 0]])))
    driver.opened()
    hello = driver.due(0.0)
    assert hello == b"\x00\x00\x05\x00Ping\x00"
    assert driver.feed(motive.messages(rows)[0]) == []
    driver.feed(motive.take(hello, 0.0))
    request = driver.due(0.5)
    assert request == b"\x04\x00\x01\x00\x00"
    assert driver.due(1.0) == b"\x0a\x00\x01\x00\x00"
    assert driver.due(1.5) == request
    driver.feed(motive.take(request, 1.5))
    assert driver.due(2.0) == b"\x0a\x00\x01\x00\x00"
    (row,) = driver.feed(motive.messages(rows)[0])
    assert row.values == pytest.approx((HALF, 0, HALF, 0), abs=1e-7)
    assert driver.due(3.0) == b"\x0a\x00\x01\x00\x00"
    assert driver.due(4.0) == hello  # nothing has come for a second: Motive restarted
    assert NatNet(unit("natnet")).due(0.0) == b""


def test_a_body_that_motive_does_not_have_is_reported_with_those_it_has():
    """It is asked for again, since it may be made later."""
    port = Port("udpout:motive:1510")
    driver = NatNet(replace(unit("natnet", "z_up", body="cube"), port=port))
    motive = EmulatedNatNet(replace(unit("natnet", "z_up", body="plate"), port=port))
    for k in range(60):
        driver.feed(motive.take(driver.due(0.05 * k), 0.05 * k))
    (overdue,) = driver.requests.overdue
    assert overdue.what == "the rigid body 'cube'"
    assert overdue.answer == "rigid bodies still, plate"
    assert overdue.times == 3


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"body": "cube"}, "udpout:HOST:1510"),
        ({"body": 1.5}, "streaming id"),
        ({"body": -1.0}, "greater than zero"),
        ({"id": 1.0}, "did you mean 'body'|one of body"),
    ],
)
def test_a_declaration_that_cannot_be_is_named(settings, said):
    with pytest.raises(InputError, match=said):
        NatNet(unit("natnet", **settings))
    with pytest.raises(InputError, match="sends no rate"):
        NatNet(replace(unit("natnet"), gives=("attitude", "rate")))


@pytest.mark.skipif(sys.platform == "win32", reason="the library reads 4 of 8 bytes there")
def test_the_library_reads_the_remote_sides_frames_likewise():
    """A second reader of the format, by others; it stops before the flags at the end."""
    natnet = pytest.importorskip("natnet")
    from natnet.data_frame import DataFrame
    from natnet.packet_buffer import PacketBuffer

    t = np.array([0.25])
    (message,) = EmulatedNatNet(unit("natnet", "z_up")).messages(
        Recording(Samples(t, np.array([[0.5] * 4])))
    )
    frame = DataFrame.read_from_buffer(PacketBuffer(message[4:]), natnet.Version(4, 1))
    assert [each.id_num for each in frame.rigid_bodies] == [77, 1]
    assert frame.rigid_bodies[1].rot == (0.5, 0.5, 0.5, 0.5)
    assert frame.rigid_bodies[1].tracking_valid
    assert frame.suffix.timestamp == 50.25
    by_hand = datagram(42, [body(1, TURN)], 12.5, sizes=False)
    frame = DataFrame.read_from_buffer(PacketBuffer(by_hand[4:]), natnet.Version(3, 1))
    assert (frame.prefix.frame_number, frame.suffix.timestamp) == (42, 12.5)
