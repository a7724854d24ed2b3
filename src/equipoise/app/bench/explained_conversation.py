"""A bench's conversations as they happen, in words, for a person who does not trust them yet."""

from collections.abc import Callable
from dataclasses import dataclass

from equipoise.app.bench.lost_onlookers import complain_of
from equipoise.hardware.actuators import registry as actuators
from equipoise.hardware.bench.onlookers import Onlookers
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.wall_clock import WallClock
from equipoise.hardware.boards import registry as boards
from equipoise.hardware.transport.explained_bytes import Explained, PlainBytes
from equipoise.hardware.transport.port import Port
from equipoise.hardware.transport.tapped_port import TappedPort
from equipoise.model.hardware import Hardware
from equipoise.model.hardware import Port as Address

THERE, BACK = "->", "<-"
FIRST = 4  # messages of a sensor, chosen: enough to see what it sends; they never end


@dataclass(slots=True)
class Said:
    """What was said last in one direction, and how often."""

    words: str = ""
    again: int = 0


class Conversations:
    """Prints who says what to whom; what is said again and again is said once, and counted.

    What cannot be printed ends the printing alone: devices hear and are heard all the same.
    """

    def __init__(self, hardware: Hardware, print_line: Callable[[str], None]) -> None:
        units = hardware.units
        self._names = {unit.port.address: unit.name for unit in units}
        spoken = {**boards.EXPLAINED, **actuators.EXPLAINED}
        self._words: dict[str, Explained] = {
            unit.port.address: spoken.get(unit.driver, PlainBytes)() for unit in units
        }
        self._endless = {unit.port.address: FIRST for unit in hardware.sensors}
        self._last: dict[tuple[str, str], Said] = {}
        self._print, self._clock = print_line, WallClock()
        self._printing = Onlookers[Callable[[str], None]](complain_of)
        self._printing.add("the conversation", print_line)

    def open(self, address: Address) -> Port:
        """Return the port at an address, open, and listened to."""
        port = open_port(address)
        self._printing.hand_on(lambda _: self._say(address.address, "--", "the port is open"))
        words = self._words[address.address]

        def explain(sent: bool, data: bytes) -> None:
            for each in words.sent(data) if sent else words.received(data):
                if sent or self._wanted(address.address):
                    self._say(address.address, THERE if sent else BACK, each)

        def tap(sent: bool, data: bytes) -> None:
            self._printing.hand_on(lambda _: explain(sent, data))

        return TappedPort(port, tap)

    def _wanted(self, address: str) -> bool:
        """Say whether what a device says is still printed; of a sensor, the beginning is."""
        left = self._endless.get(address, 1) - 1
        if address in self._endless and left >= -1:
            self._endless[address] = left
            if left == -1:
                self._say(address, BACK, "and so on; the rest is not printed")
        return left >= 0

    def _say(self, address: str, way: str, words: str) -> None:
        said = self._last.setdefault((address, way), Said())
        if words == said.words:
            said.again += 1
            return
        name = self._names[address]
        if said.again:
            self._print(f"          {way} {name}: the same {said.again} times more")
        self._last[address, way] = Said(words)
        self._print(f"{self._clock.now:7.3f} s {way} {name}: {words}")
