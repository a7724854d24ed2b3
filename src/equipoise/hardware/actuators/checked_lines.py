"""Lines with a checksum: JSON, an asterisk, and four hexadecimal digits.

    {"set":7,"u":[0.001,null,0]}*5B4C

The digits are the CRC-16 of the bytes before the asterisk, polynomial 0x1021 from 0xFFFF on, the
most significant bit first (CCITT-FALSE: of "123456789" it is 29B1).
"""

import binascii
import json
from collections.abc import Sequence
from typing import Any, cast

LONGEST = 200  # bytes, its end included; chosen: what the memory of a small microcontroller allows
DIGITS = 9  # behind the point, chosen: a nanonewton metre, a nanotesla


def checked(text: str) -> bytes:
    """Return a line to send."""
    data = text.encode("ascii")
    return b"%b*%04X\n" % (data, binascii.crc_hqx(data, 0xFFFF))


def message_in(line: bytes) -> dict[str, Any] | None:
    """Return what a line says, without its end; None if it is broken."""
    body, asterisk, digits = line.strip().rpartition(b"*")
    if not asterisk or digits != b"%04X" % binascii.crc_hqx(body, 0xFFFF):
        return None
    try:
        message = json.loads(body)
    except (ValueError, RecursionError):
        return None
    return cast("dict[str, Any]", message) if isinstance(message, dict) else None


def listed(inputs: Sequence[float | None]) -> str:
    """Return inputs as plain decimals, without an exponent; None: it goes on as it is."""
    return ",".join("null" if value is None else plain(value) for value in inputs)


def plain(value: float) -> str:
    """Return a number as a plain decimal."""
    text = f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
