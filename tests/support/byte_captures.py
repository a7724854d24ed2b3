"""Captures by hand, as programs save them: network traffic and telemetry logs."""

import struct


def datagram_packet(data, port):
    """Return an Ethernet frame of a UDP datagram by hand: RFC 894, 791 and 768."""
    udp = struct.pack(">4H", 50000, port, 8 + len(data), 0) + data
    ip = struct.pack(">BBHHHBBH4s4s", 0x45, 0, 20 + len(udp), 0, 0, 64, 17, 0, b"\x7f\0\0\1",
                     b"\xef\xff\x2a\x63")  # fmt: skip
    return bytes(12) + b"\x08\x00" + ip + udp


def pcap(packets):
    """Return a file as tcpdump writes it; packets are times (s) and bytes."""
    content = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 262144, 1)
    for t, data in packets:
        whole, micro = divmod(round(1e6 * t), 10**6)
        content += struct.pack("<4I", whole, micro, len(data), len(data)) + data
    return content


def block(kind, body):
    body += bytes(-len(body) % 4)
    size = struct.pack(">I", 12 + len(body))
    return struct.pack(">I", kind) + size + body + size


def pcapng(packets):
    """Return a file as Wireshark writes it, big endian, in nanoseconds."""
    content = block(0x0A0D0D0A, struct.pack(">IHHq", 0x1A2B3C4D, 1, 0, -1))
    content += block(1, struct.pack(">HHI", 1, 0, 0) + struct.pack(">HHB3x", 9, 1, 9) + bytes(4))
    for t, data in packets:
        nano = round(1e6 * t) * 1000
        content += block(5, bytes(8))  # statistics, of no interest
        head = struct.pack(">5I", 0, nano >> 32, nano & 0xFFFFFFFF, len(data), len(data))
        content += block(6, head + data)
    return content


def telemetry(frames):
    """Return a .tlog by hand: microseconds since 1970, big endian, and a frame, each."""
    return b"".join(struct.pack(">Q", round(1e6 * t)) + frame for t, frame in frames)
