"""What goes back and forth with a TMCL module, in words."""

from equipoise.hardware.boards.tmcl import words as w
from equipoise.hardware.boards.tmcl.scripts import BANK, VARIABLE

COMMANDS = {
    w.MST: "stop motor {0}",
    w.MVP: "send motor {0} to {1} microsteps",
    w.SAP: "set parameter {2} of motor {0} to {1}",
    w.GAP: "what is parameter {2} of motor {0}?",
    w.VERSION: "which firmware are you?",
}
PARAMETERS = {
    w.AT: "where is motor {0}?",
    w.SPEED: "how quick is motor {0}?",
    w.RIGHT: "is the right switch of motor {0} pushed?",
    w.LEFT: "is the left switch of motor {0} pushed?",
}
SEARCHES = {
    w.START: "search the switch of motor {0}",
    w.STOP: "break off the search of motor {0}",
    w.STATUS: "is motor {0} still searching?",
}


class TmclExplained:
    """The words for one module's bytes; half a datagram waits for its end."""

    def __init__(self) -> None:
        self._sent = self._received = b""

    def sent(self, data: bytes) -> list[str]:
        """Return what the driver has said."""
        self._sent = (self._sent + data).lstrip(b"\0")  # which may stand before a call
        found: list[str] = []
        while len(self._sent) >= w.SIZE:
            found.append(_request(self._sent[: w.SIZE]))
            self._sent = self._sent[w.SIZE :].lstrip(b"\0")
        return found

    def received(self, data: bytes) -> list[str]:
        """Return what the module has said."""
        replies, breaks, self._received = w.replies_in(self._received + data)
        found = ["something that is not understood"] * breaks
        return found + [
            f"{reply.value}" if reply.done else f"refused: {w.REFUSALS[reply.status]}"
            for reply in replies
        ]


def _request(datagram: bytes) -> str:
    command, kind, motor = datagram[1:4]
    value = int.from_bytes(datagram[4:8], "big", signed=True)
    if command in (w.GGP, w.SGP) and (kind, motor) == (VARIABLE, BANK):
        return "is the mark still there?" if command == w.GGP else "set the mark"
    if command == w.GAP and kind in PARAMETERS:
        return PARAMETERS[kind].format(motor)
    if command == w.RFS and kind in SEARCHES:
        return SEARCHES[kind].format(motor)
    words = COMMANDS.get(command, "command {3} of type {2} to motor {0}, value {1}")
    return words.format(motor, value, kind, command)
