"""Bytes of a sensor that were saved, through its driver, to a recording: `equipoise convert --as`.

The driver is the one of the bench, and so is what times and turns its rows.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from os import SEEK_CUR

from equipoise.app.runs.captures.captured_sensor import STREAM
from equipoise.hardware.links.captured_rows import CapturedRows, Timeless
from equipoise.hardware.links.health import Health
from equipoise.hardware.links.row_buffer import RowBuffer
from equipoise.hardware.sensors.natnet_packet import cut_packets
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.io.files.file_content import USUAL, opened
from equipoise.io.files.reading_budget import Meter, ReadingBudget
from equipoise.io.logs.byte_capture import CHUNK, Piece, Readable, stream_pieces
from equipoise.io.logs.counted_file import CountedFile
from equipoise.io.logs.pcap_capture import is_pcap, pcap_pieces
from equipoise.io.logs.tlog_capture import is_tlog, tlog_pieces
from equipoise.model.errors import InputError, declared
from equipoise.model.hardware import Port, SensorUnit
from equipoise.model.recording import Recording

OnProgress = Callable[[float], None]
PORTS = {"natnet": (1510, 1511), "mavlink": (14550,)}  # UDP, as they are by default
LINES = ("vectornav", "lines")  # whose rows end where a line does
DATAGRAMS, NAMED = "udp:0", "udpout:file:0"  # how a driver is to read pieces
ROW = 200  # bytes of a row, here and in the recording (chosen: measured are 130)
SHOWN = 60  # bytes, chosen: of what comes first, where nothing is understood
WANTED = "raw bytes of a sensor"


class Capture:
    """A file's pieces on their way through a driver, and what else was found."""

    def __init__(self, meter: Meter, unit: SensorUnit, rate: float | None) -> None:
        self.file, self.unit, self._meter = meter.source, unit, meter
        self.driver: SensorDriver = DRIVERS[unit.driver](unit)
        self.driver.opened()
        stated = unit.settings.get("rate_hz")
        self._rate = rate if rate is not None or not isinstance(stated, float) else stated
        self._rows, self._taken = CapturedRows(unit, self._rate), RowBuffer(())
        self._others: Counter[int] = Counter()  # datagrams, by port they went to
        self._first = self._last = b""

    def take(self, piece: Piece) -> None:
        """Read a piece, if it is of the sensor's ports."""
        ports = PORTS.get(self.unit.driver)
        if piece.ports is not None and ports is not None and not set(ports) & set(piece.ports):
            self._others[piece.ports[1]] += 1
            return
        if len(self._first) < SHOWN:
            self._first = (self._first + piece.data)[:SHOWN]
        self._last = piece.data or self._last
        before = self.driver.counts.corrupt
        self.driver.count(corrupt=piece.broken)
        readings = self.driver.feed(piece.data) if piece.data else ()
        readings = [each for each in readings if each.channel in self.unit.gives]
        try:
            rows = self._rows.rows(readings, piece.t, self.driver.counts.corrupt - before)
        except Timeless:
            wanted = "--rate-hz, the rate of the rows"
            raise InputError(self.file, "rows and a file without times", wanted) from None
        self._meter.take(ROW * len(rows))
        for row in rows:
            self._taken.row(row)

    def recording(self) -> Recording:
        """Return the rows, with notes; InputError with what was there instead if there are none."""
        recording, received = self._taken.taken(), self._rows.received
        health = Health(f"sensor {self.unit.name}", self.driver.counts, received.arrivals)
        others = f"of other ports ({', '.join(str(p) for p, _ in self._others.most_common(3))})"
        aside = _counted(self._others.total(), "datagram", others)
        if recording.attitude is None and recording.rate is None:
            begins = f"it begins {self._first!r}" if self._first else "nothing to read"
            parts = ("no row", health.sentence, begins, aside, *self._ends())
            found = "; ".join(part for part in parts if part)
            raise InputError(self.file, found, f"bytes as driver {self.unit.driver} reads them")
        jumps = sum(clock.jumps for clock in received.clocks.values())
        notes = (
            health.sentence,
            _counted(jumps, "jump", "of the device's clock; numbering continues"),
            _counted(
                self._rows.set_back, "step back", "of the capture's clock; numbering continues"
            ),
            aside,
            f"rows without times were spaced at {self._rate:g} Hz" if self._rows.spaced else "",
            *self._ends(),
        )
        return replace(recording, source=self.file, notes=tuple(note for note in notes if note))

    def _ends(self) -> Iterator[str]:
        """Yield what is left out where the file begins and ends."""
        if self.unit.port.address != STREAM or self.unit.driver not in LINES:
            return
        if self.unit.driver == "lines":
            yield "the first line is ignored: its beginning may be missing"
        if not self._last.endswith((b"\n", b"\r")):
            yield "the last line is ignored: it is incomplete"


def recording_of_capture(
    file: str,
    unit: SensorUnit,
    rate: float | None,
    reported: OnProgress,
    budget: ReadingBudget = USUAL,
) -> Recording:
    """Return the rows in a file of saved bytes, with notes of what was broken or left out."""
    with declared(file, WANTED), opened(file, WANTED, budget) as content:
        beginning, stream = content[:CHUNK], CountedFile(content)
        port = _port(unit, is_pcap(beginning))
        capture, shown = Capture(content.meter, replace(unit, port=port), rate), 0
        for piece in _pieces(stream, beginning, unit):
            capture.take(piece)
            at = stream.seek(0, SEEK_CUR)
            if at - shown > CHUNK:
                shown = at
                reported(at / len(content))
        return capture.recording()


def _port(unit: SensorUnit, datagrams: bool) -> Port:
    """Return a port by which the driver reads the file's pieces as they are: no port is opened."""
    if unit.driver == "natnet":
        return Port(NAMED)  # the file may hold the answer to what bodies are called
    return Port(DATAGRAMS if datagrams else STREAM)


def _pieces(content: Readable, beginning: bytes, unit: SensorUnit) -> Iterator[Piece]:
    """Return a file's pieces; of what kind it is shows at its beginning."""
    if is_pcap(beginning):
        return pcap_pieces(content)
    if unit.driver == "mavlink" and is_tlog(beginning):
        return tlog_pieces(content)
    if unit.driver == "natnet":
        return (Piece(packet) for packet in cut_packets(iter(lambda: content.read(CHUNK), b"")))
    return stream_pieces(content)


def _counted(count: int, thing: str, what: str) -> str:
    return f"{count} {thing}{'s' * (count != 1)} {what}" if count else ""
