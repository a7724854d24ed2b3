"""The torque of gravity as a message in JSON: its numbers by their names in the datagram."""

from typing import Any

from equipoise.io.stream.gravity_datagram import FIELDS
from equipoise.model.gravity_torque import GravityTorque

KIND = "gravity_torque"  # of the event that carries it, and the name of its topic
VECTOR = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
LEFT_OUT = ("magic", "version", "size", "sequence", "host_time_ns", "hold_s")  # of the datagram
# The schema of each number, by its name.
PARTS: dict[str, dict[str, Any]] = {
    each.name: VECTOR if each.count == 3 else {"type": "number"}
    for each in FIELDS
    if each.name not in LEFT_OUT
} | {"status": {"type": "string"}}


def message_of(content: GravityTorque) -> dict[str, Any]:
    """Return the numbers of a torque, by name."""
    values = (
        content.status.name.lower(), content.t, content.lead, content.torque.tolist(),
        content.torque_sd.tolist(), content.first_moment.tolist(),
        content.first_moment_sd.tolist(), content.gravity.tolist(),
    )  # fmt: skip
    return dict(zip(PARTS, values, strict=True))
