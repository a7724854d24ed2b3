"""What goes back and forth with a Grbl board, in words."""

import re

from equipoise.hardware.boards.grbl.codes import alarm_text, error_text
from equipoise.hardware.boards.grbl.report import Code, Greeting, Report, Setting, Status, parsed
from equipoise.hardware.boards.grbl.talk import CANCEL, HOLD, QUERY, RESET, RESUME
from equipoise.hardware.transport.line_splitter import Lines

AT_ONCE = {
    RESET: "restart (0x18)",
    HOLD: "hold (!)",
    RESUME: "go on (~)",
    CANCEL: "throw the jog away (0x85)",
    QUERY: "where are you? (?)",
}
WORDS = re.compile(b"([" + re.escape(b"".join(AT_ONCE)) + b"])")
LINES = {
    b"$$": "list your settings ($$)",
    b"$H": "home ($H)",
    b"$X": "unlock ($X)",
    b"": "are you taking lines? (an empty line)",
}
JOG = b"$J=G53 G21 G90"


class GrblExplained:
    """The words for one board's bytes; half a line waits for its end."""

    def __init__(self) -> None:
        self._lines = Lines()

    def sent(self, data: bytes) -> list[str]:
        """Return what the driver has said."""
        found: list[str] = []
        for part in filter(None, WORDS.split(data)):
            if part in AT_ONCE:
                found.append(AT_ONCE[part])
            else:
                found += [_line(line) for line in part.split(b"\n")[:-1]]
        return found

    def received(self, data: bytes) -> list[str]:
        """Return what the board has said."""
        return [_received(line, parsed(line)) for line in self._lines.cut(data)]


def _line(line: bytes) -> str:
    if line.startswith(JOG):
        *places, feed = line[len(JOG) :].decode("ascii", "replace").split()
        return f"jog to {' '.join(places)} mm at {feed[1:]} mm/min"
    return LINES.get(line, f"the line '{line.decode('ascii', 'replace')}'")


def _received(line: bytes, report: Report | None) -> str:
    text = line.decode("ascii", "backslashreplace")
    if isinstance(report, Status):
        return f"I am in state {report.state}{_place(report)}"
    if isinstance(report, Greeting):
        return f"I have begun: {report.text}"
    if isinstance(report, Code):
        word = alarm_text(report.number) if report.alarm else error_text(report.number)
        return f"{'alarm' if report.alarm else 'refused'}: {word} ({text})"
    if isinstance(report, Setting):
        return f"setting {text}"
    if report is None:
        return f"something that is not understood: '{text}'"
    return "ok: the line is taken" if text == "ok" else f"a remark: {text}"


def _place(status: Status) -> str:
    place = status.machine if status.machine is not None else status.work
    if place is None:
        return ""
    return " at " + ", ".join(f"{value:.3f}" for value in place) + " mm"
