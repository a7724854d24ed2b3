"""What a file is that is no text, by its first bytes: to name it, not to read it."""

SHOWN = 8  # bytes of an unknown file that are named (chosen)
# Where a mark stands, the mark, what it says; what is surer goes first.
MARKS = (
    (0, b"\x1f\x8b", "a gzip file"),
    (0, b"PK\x03\x04", "a zip archive, or what is made of one (Excel, Word)"),
    (0, b"PK\x05\x06", "an empty zip archive"),
    (0, b"\x28\xb5\x2f\xfd", "a Zstandard file"),
    (0, b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
    (0, b"Rar!\x1a\x07", "a rar archive"),
    (0, b"\xfd7zXZ\x00", "an xz file"),
    (0, b"BZh", "a bzip2 file"),
    (257, b"ustar", "a tar archive"),
    (0, b"%PDF-", "a PDF"),
    (0, b"\x89PNG\r\n\x1a\n", "a PNG picture"),
    (0, b"\xff\xd8\xff", "a JPEG picture"),
    (
        0,
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "an old Excel file (.xls), or one with a password",
    ),
    (0, b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    (0, b"SQLite format 3\x00", "an SQLite database"),
    (0, b"\x7fELF", "a program (ELF)"),
    (0, b"MZ", "a program (Windows)"),
    (0, b"\xd4\xc3\xb2\xa1", "captured network traffic (pcap; `convert --as` reads it)"),
    (0, b"\xa1\xb2\xc3\xd4", "captured network traffic (pcap; `convert --as` reads it)"),
    (0, b"\x4d\x3c\xb2\xa1", "captured network traffic (pcap; `convert --as` reads it)"),
    (0, b"\xa1\xb2\x3c\x4d", "captured network traffic (pcap; `convert --as` reads it)"),
    (0, b"\x0a\x0d\x0d\x0a", "captured network traffic (pcapng; `convert --as` reads it)"),
    (0, b"#ROSBAG V", "a bag of ROS 1"),
    (0, b"PAR1", "a Parquet table"),
    (0, b"\x89MCAP0\r\n", "an MCAP log"),
    (0, b"MATLAB ", "a MAT file"),
    (0, b"ULog\x01\x12\x35", "a log of PX4 (ULog)"),
    (0, b"\xa3\x95\x80", "a dataflash log of ArduPilot"),
    (0, b"\xfd", "a stream of MAVLink (`convert --as mavlink` reads it)"),
    (0, b"\xfe", "a stream of MAVLink (`convert --as mavlink` reads it)"),
    (8, b"\xfd", "a telemetry log of MAVLink (`convert --as mavlink` reads it)"),
    (8, b"\xfe", "a telemetry log of MAVLink (`convert --as mavlink` reads it)"),
)


def binary_text(content: bytes) -> str:
    """Say what bytes are that are no text; their first eight in hex if that is not known."""
    for at, mark, name in MARKS:
        if content.startswith(mark, at):
            return f"binary content: {name}"
    return f"binary content that begins with 0x{content[:SHOWN].hex(' ')}"
