"""Rows of several series as one binary message.

    uint32 n    n bytes of JSON, padded with blanks until 4 + n is a multiple of 8    float64 ...

All little-endian. The JSON has the bench time and for each part its name, rows and columns; the
numbers follow part by part, row by row. The page reads them in place (``static/frames.js``).
"""

import json
import struct
from collections.abc import Sequence

import numpy as np

from equipoise.model.arrays import Floats

Part = tuple[str, Floats]
HEAD = struct.Struct("<I")


def encoded(t: float, parts: Sequence[Part]) -> bytes:
    """Return the message of bench time (s) and parts (n, k)."""
    shapes = [[name, *values.shape] for name, values in parts]
    header = json.dumps({"t": t, "parts": shapes}).encode()
    header += b" " * (-(HEAD.size + len(header)) % 8)
    numbers = [np.ascontiguousarray(values, "<f8").tobytes() for _, values in parts]
    return b"".join([HEAD.pack(len(header)), header, *numbers])
