"""What goes back and forth in device lines, in words."""

from typing import Any

from equipoise.hardware.actuators.checked_lines import message_in
from equipoise.hardware.actuators.messages import (
    REFUSALS,
    Description,
    Hello,
    Mode,
    Refusal,
    Report,
    read_message,
)
from equipoise.hardware.transport.line_splitter import Lines

MODES = {
    Mode.BEGUN: "rests since its start",
    Mode.WORKING: "works",
    Mode.HALTED: "rests",
    Mode.DEADMAN: "rests, since nothing came",
}
BROKEN = "something that is not understood"


class DeviceLinesExplained:
    """The words for one device's bytes; half a line waits for its end."""

    def __init__(self) -> None:
        self._sent, self._received = Lines(), Lines()

    def sent(self, data: bytes) -> list[str]:
        """Return what the driver has said."""
        return [_commanded(message_in(line)) for line in self._sent.cut(data)]

    def received(self, data: bytes) -> list[str]:
        """Return what the device has said."""
        return [_answered(message_in(line)) for line in self._received.cut(data)]


def _commanded(message: dict[str, Any] | None) -> str:
    if message is None:
        return BROKEN
    if "set" in message:
        inputs = ["as it is" if value is None else f"{value:g}" for value in message["u"]]
        return f"order {message['set']}: inputs {', '.join(inputs)}"
    words = {
        "hello": "who are you?",
        "describe": f"what is your output {message.get('describe')}?",
        "arm": f"order {message.get('arm')}: begin to work",
        "halt": "rest",
        "beat": "go on",
    }
    return next((text for key, text in words.items() if key in message), BROKEN)


def _answered(message: dict[str, Any] | None) -> str:
    read = None if message is None else read_message(message)
    if isinstance(read, Hello):
        return f"{read.name}, {read.outputs} outputs, version {read.version}"
    if isinstance(read, Description):
        return f"output {read.index} is {read.kind} {read.name}, {read.greatest:g} {read.units[0]}"
    if isinstance(read, Refusal):
        return f"refused: {REFUSALS.get(read.code, read.code)}"
    if isinstance(read, Report):
        trouble = f", fault {read.fault}" if read.fault else ""
        return f"{MODES[read.mode]}, has taken order {read.taken}{trouble}"
    return BROKEN
