"""UDP datagrams in a capture of network traffic, as Wireshark and tcpdump save it.

    pcap     header of 24 bytes, of which the last four name the link; then for each packet
             seconds, micro- or nanoseconds, size here, size on the wire (u32 each), its bytes
    pcapng   blocks: u32 type, u32 size, body, u32 size again. A section header says which end
             comes first, an interface names its link and unit of time, an enhanced packet is
             interface, time in two halves, size here, size on the wire, bytes

Source: IETF drafts draft-ietf-opsawg-pcap and draft-ietf-opsawg-pcapng; RFC 791 and 768. IPv4 over
Ethernet, loopback, Linux "any" or without a link. Datagrams in fragments are counted as broken.
"""

import math
import struct
from collections.abc import Iterator
from dataclasses import dataclass

from equipoise.io.logs.byte_capture import Piece, Readable
from equipoise.model.units import NS, US

PCAP = {  # magic: which end comes first, s in a unit of time
    b"\xd4\xc3\xb2\xa1": ("<", US),
    b"\xa1\xb2\xc3\xd4": (">", US),
    b"\x4d\x3c\xb2\xa1": ("<", NS),
    b"\xa1\xb2\x3c\x4d": (">", NS),
}
PCAPNG = b"\x0a\x0d\x0d\x0a"
LITTLE = b"\x4d\x3c\x2b\x1a"  # byte-order magic of a section
SECTION, INTERFACE, PACKET = 0x0A0D0D0A, 1, 6  # blocks
RESOLUTION = 9  # option of an interface
LINKS = {0: 4, 1: 14, 101: 0, 113: 16, 228: 0, 276: 20}  # bytes before IP, by kind of link
ETHERNET, VLAN, TAG = 1, b"\x81\x00", 4
UDP, FRAGMENT = 17, 0x3FFF  # protocol; more fragments, or not the first
MOST = 1 << 24  # bytes, chosen: a packet or a block beyond it is none


@dataclass(frozen=True, slots=True)
class Interface:
    """Where packets of a pcapng were captured."""

    link: int
    unit: float  # s


class Cut(Exception):
    """The file ends within a packet, or what follows is none."""


def is_pcap(beginning: bytes) -> bool:
    """Say whether a file begins as a capture does."""
    return beginning[:4] in PCAP or beginning[:4] == PCAPNG


def pcap_pieces(file: Readable) -> Iterator[Piece]:
    """Yield every UDP datagram, when it was captured."""
    begin = file.read(4)
    packets = _of_pcapng(file) if begin == PCAPNG else _of_pcap(file, *PCAP[begin])
    try:
        for t, link, data in packets:
            piece = _datagram(t, link, data)
            if piece is not None:
                yield piece
    except Cut:
        yield Piece(b"", broken=True)


def _of_pcap(file: Readable, end: str, unit: float) -> Iterator[tuple[float, int, bytes]]:
    (link,) = struct.unpack(f"{end}16xI", _taken(file, 20))
    while head := file.read(16):
        if len(head) < 16:
            raise Cut
        seconds, fraction, size, _ = struct.unpack(f"{end}4I", head)
        yield seconds + fraction * unit, link & 0xFFFF, _taken(file, size)


def _of_pcapng(file: Readable) -> Iterator[tuple[float, int, bytes]]:
    end, head = "<", PCAPNG + _taken(file, 4)
    interfaces: list[Interface] = []
    while head:
        if head[:4] == PCAPNG:
            order = _taken(file, 4)
            end = "<" if order == LITTLE else ">"
            interfaces.clear()
        kind, size = struct.unpack(f"{end}2I", head)
        body = _taken(file, size - (16 if kind == SECTION else 12))
        _taken(file, 4)
        if kind == INTERFACE:
            interfaces.append(_interface(body, end))
        elif kind == PACKET:
            which, high, low, held, _ = struct.unpack_from(f"{end}5I", _least(body, 20))
            if which >= len(interfaces):
                raise Cut
            captured = interfaces[int(which)]
            yield ((high << 32) + low) * captured.unit, captured.link, body[20 : 20 + held]
        head = file.read(8)
        if head and len(head) < 8:
            raise Cut


def _interface(body: bytes, end: str) -> Interface:
    """Return an interface; its times are in microseconds unless it says otherwise."""
    (link,) = struct.unpack_from(f"{end}H", _least(body, 8))
    unit, at = US, 8
    while at + 4 <= len(body):
        code, size = struct.unpack_from(f"{end}2H", body, at)
        if code == RESOLUTION and size == 1 and at + 4 < len(body):
            power = body[at + 4]
            unit = math.ldexp(1.0, -(power & 0x7F)) if power & 0x80 else math.pow(10.0, -power)
        at += 4 + size + -size % 4
    return Interface(link, unit)


def _datagram(t: float, link: int, data: bytes) -> Piece | None:
    """Return the UDP datagram in a packet; None if there is none."""
    begin = LINKS.get(link)
    if begin is None:
        return None
    if link == ETHERNET and data[12:14] == VLAN:
        begin += TAG
    ip = data[begin:]
    if len(ip) < 20 or ip[0] >> 4 != 4 or ip[9] != UDP:
        return None
    (fragment,) = struct.unpack_from(">H", ip, 6)
    udp = ip[4 * (ip[0] & 0xF) :]
    if fragment & FRAGMENT or len(udp) < 8:
        return Piece(b"", t, broken=True)
    source, goal, size, _ = struct.unpack_from(">4H", udp)
    return Piece(udp[8:size], t, (source, goal))


def _taken(file: Readable, size: int) -> bytes:
    data = file.read(size) if 0 <= size <= MOST else b""
    if len(data) < max(size, 0) or size < 0:
        raise Cut
    return data


def _least(body: bytes, size: int) -> bytes:
    if len(body) < size:
        raise Cut
    return body
