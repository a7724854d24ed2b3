"""An emulated Motive: frames of NatNet 4.1 with two rigid bodies, of which one stands still.

Written from the SDK's samples, independently of the driver.
"""

import struct
from collections.abc import Sequence

from equipoise.hardware.emulated.device import sensed_rows
from equipoise.model.arrays import Floats
from equipoise.model.hardware import SensorUnit
from equipoise.model.recording import Recording

BEGAN = 50.0  # s, chosen: Motive's clock is ahead by so much
OTHER = 77  # id of the body that stands still
NONE = struct.pack("<ii", 0, 0)  # a section of nothing


class EmulatedNatNet:
    """Answers who it is and what its bodies are called; sends each attitude in a frame."""

    def __init__(self, unit: SensorUnit) -> None:
        self._unit, self._number = unit, 0
        body = unit.settings.get("body", 1.0)
        self._name = body if isinstance(body, str) else "platform"
        self._id = int(body) if isinstance(body, float) else 5

    def take(self, data: bytes, t: float) -> bytes:
        """Return the answer to a request: 0 who is there, 4 which bodies there are."""
        kind = data[0] if len(data) > 1 else None
        if kind == 0:
            who = b"Motive".ljust(256, b"\0") + bytes([3, 1, 0, 0]) + bytes([4, 1, 0, 0])
            return _packet(1, who)
        if kind == 4:
            bodies = _described(b"still", OTHER) + _described(self._name.encode(), self._id)
            return _packet(5, struct.pack("<i", 2) + bodies)
        return b""

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return a frame for each row, in order of time."""
        found = sensed_rows(self._unit, rows)
        return [self._frame(t, parts["attitude"]) for t, parts in found if "attitude" in parts]

    def _frame(self, t: float, q: Floats) -> bytes:
        self._number += 1
        w, x, y, z = map(float, q)
        bodies = _body(OTHER, (0.0, 0.0, 0.0, 1.0)) + _body(self._id, (x, y, z, w))
        set_of_markers = b"all\0" + struct.pack("<i3f", 1, 0.1, 0.2, 0.3)
        sections = struct.pack("<ii", 1, len(set_of_markers)) + set_of_markers + NONE
        sections += struct.pack("<ii", 2, len(bodies)) + bodies + NONE * 5
        clocks = struct.pack("<IId3QII", 0, 0, t + BEGAN, 0, 0, 0, 0, 0)
        end = struct.pack("<hi", 0, 0)
        return _packet(7, struct.pack("<i", self._number) + sections + clocks + end)


def _packet(kind: int, payload: bytes) -> bytes:
    return struct.pack("<HH", kind, len(payload)) + payload


def _body(number: int, turn: tuple[float, ...]) -> bytes:
    """Return a body in a frame: where, how turned, 0.2 mm of mean error, tracked."""
    return struct.pack("<i3f4ffh", number, 0.0, 1.0, 0.0, *turn, 2e-4, 1)


def _described(name: bytes, number: int) -> bytes:
    """Return a body's description: name, id, no parent, no offset, no markers."""
    described = name + b"\0" + struct.pack("<ii3fi", number, -1, 0.0, 0.0, 0.0, 0)
    return struct.pack("<ii", 1, len(described)) + described
